"""Draw the still pictures of the gallery, NAME.svg for each job: the linkage that its page chooses.

The page's own cells say which one that is.  pictures.json keeps its pivots, so that a test can tell
whether a picture is still true without a search.  Run it from the project's root:

    .venv/bin/python -m docs.gallery.pictures
"""

import json
import os
import re
import runpy
import shutil
import tempfile
from pathlib import Path

from burmester.web.still import still

KEPT = Path(__file__).with_suffix(".json")
HERE = Path(__file__).resolve().parent
TEMPLATES = HERE.parents[1] / "src" / "burmester" / "templates"
CELL = re.compile(r"(?ms)^```\{code-cell\}[^\n]*\n(.*?)^```$")


def beside(folder):
    """Lay out in a folder the files that the pages read."""
    for file in (*TEMPLATES.glob("*.toml"), *HERE.glob("*.toml"), *HERE.glob("*.csv")):
        shutil.copy(file, folder)


def pages():
    """The pages of the jobs."""
    return [page for page in sorted(HERE.glob("*.md")) if page.stem != "index"]


def run(page):
    """The names that the cells of a page set; films and drawings are left out."""
    script = Path(f"{page.stem}.py")
    cells = CELL.findall(page.read_text(encoding="utf-8"))
    script.write_text(
        "".join(each for each in cells if not re.search(r"\.(animate|export|report)\(", each))
    )
    return runpy.run_path(str(script))


def drawn(chosen, name):
    """The picture of a linkage at its poses."""
    return still(chosen, name) + "\n"


def numbers(linkage):
    """The pivots and the length of both dyads, the driver's first."""
    return [
        {
            "fixed": dyad.fixed_pivot.tolist(),
            "moving": dyad.moving_pivot.tolist(),
            "length": float(dyad.radius),
        }
        for dyad in (linkage.first, linkage.second)
    ]


def main():
    kept = {}
    with tempfile.TemporaryDirectory() as folder:
        beside(folder)
        os.chdir(folder)
        for page in pages():
            chosen = run(page)["chosen"]
            kept[page.stem] = numbers(chosen.driver_first)
            page.with_suffix(".svg").write_text(drawn(chosen, page.stem), encoding="utf-8")
    text = json.dumps(kept, indent=1)
    KEPT.write_text(re.sub(r"\[\s+(\S+)\s+(\S+)\s+\]", r"[\1 \2]", text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
