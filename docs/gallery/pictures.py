"""Draw the still pictures of the gallery, NAME.svg for each job: the linkage that its page chooses.

The page's own cells say which one that is.  Run it from the project's root:

    .venv/bin/python -m docs.gallery.pictures
"""

import os
import re
import runpy
import shutil
import tempfile
from pathlib import Path

from burmester.web.still import still

HERE = Path(__file__).resolve().parent
TEMPLATES = HERE.parents[1] / "src" / "burmester" / "templates"
CELL = re.compile(r"(?ms)^```\{code-cell\}[^\n]*\n(.*?)^```$")


def chosen(page):
    """What the cells of a page call `chosen`; films and drawings are left out."""
    script = Path(f"{page.stem}.py")
    cells = CELL.findall(page.read_text(encoding="utf-8"))
    script.write_text(
        "".join(each for each in cells if not re.search(r"\.(animate|export)\(", each))
    )
    return runpy.run_path(str(script))["chosen"]


def main():
    with tempfile.TemporaryDirectory() as folder:
        for file in (*TEMPLATES.glob("*.toml"), *HERE.glob("*.toml"), *HERE.glob("*.csv")):
            shutil.copy(file, folder)
        os.chdir(folder)
        for page in sorted(HERE.glob("*.md")):
            if page.stem != "index":
                saved = chosen(page).saved()
                drawn = still(saved.linkage, saved.error.places, saved.task, page.stem)
                page.with_suffix(".svg").write_text(drawn + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
