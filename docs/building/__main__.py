"""Lay out the sources, build the pages, check them; exit code 1 where something is wrong."""

import os
import shutil
import sys
import time
from pathlib import Path

from docs.building import checks, notebooks, sources
from sphinx.cmd.build import main as sphinx

ROOT = Path(__file__).resolve().parents[2]
REMAINS = (".buildinfo", "reports")  # what no reader opens


def main(folder: Path) -> int:
    """The exit code."""
    began = time.monotonic()
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", PYTHONHASHSEED="0")
    laid_out = folder.parent / f"{folder.name}-sources"
    doctrees = folder.parent / f"{folder.name}-doctrees"
    run = folder.parent / notebooks.RUN
    for each in (folder, laid_out, doctrees, run):
        shutil.rmtree(each, ignore_errors=True)
    sources.lay_out(ROOT, laid_out)
    os.environ["IPYTHONDIR"] = str(notebooks.own_settings(doctrees))
    if code := sphinx(
        ["-b", "html", "-W", "--keep-going", "-q", "-j", "2", "-c", str(ROOT / "docs"),
         "-d", str(doctrees), str(laid_out), str(folder)]
    ):  # fmt: skip
        return code
    notebooks.give_outputs(folder)
    for report in sorted((laid_out / "gallery").glob("*-report.html")):
        shutil.copy(report, folder / "gallery")  # written by the cells of a page that shows it
    shutil.rmtree(run, ignore_errors=True)
    for each in REMAINS:
        path = folder / each
        shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    wrong = checks.troubles(folder) + checks.formulas_without_links(folder)
    for each in wrong:
        print(f"docs: {each}", file=sys.stderr)
    pages = sum(1 for _ in folder.rglob("*.html"))
    print(
        f"{pages} pages, {checks.megabytes(folder):.1f} MB, {time.monotonic() - began:.0f} s: "
        f"{os.path.relpath(folder / 'index.html')}"
    )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else "build/docs").resolve()))
