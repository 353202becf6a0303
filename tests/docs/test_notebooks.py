"""Notebooks of the documentation run, cell by cell; what they assert holds.

Those of the gallery are run by `scripts/docs` alone, for their time; here their cells must compile,
and the files that they name must exist.

Figures, films and drawings have tests of their own: here only that they are asked for what exists.
The files beside a notebook are those of `burmester new`, the examples, and its own.
"""

import re
import runpy
import shutil
from pathlib import Path

import pytest

import burmester
from tests.oracles.markdown import Document

ROOT = Path(__file__).parents[2]
FOLDERS = ("tutorials", "gallery", "teaching")
OPTION = re.compile(r"(?m)\A(?::[\w-]+:.*\n)+")


def cells(page):
    """The code of a page's cells, their options left out."""
    blocks = Document.of(page).blocks
    return [(OPTION.sub("", b.text), b.line) for b in blocks if b.kind == "code-cell"]


PAGES = [page for name in FOLDERS for page in sorted((ROOT / "docs" / name).glob("*.md"))]
NOTEBOOKS = {f"{page.parent.name}/{page.stem}": page for page in PAGES if cells(page)}
RUN = {name: page for name, page in NOTEBOOKS.items() if not name.startswith("gallery/")}


@pytest.fixture
def beside(tmp_path, monkeypatch):
    """The folder in which a notebook runs; what it exports is only noted."""
    for folder in ("examples", "src/burmester/templates"):
        for file in (ROOT / folder).iterdir():
            if file.is_file():
                shutil.copy(file, tmp_path)
    monkeypatch.chdir(tmp_path)

    def export(self, path, **options):
        assert Path(path).suffix in {".dxf", ".svg", ".json", ".gif"}
        return Path(path)

    monkeypatch.setattr(burmester.ResultLinkage, "export", export)
    monkeypatch.setattr(burmester.ResultLinkage, "animate", lambda self, **how: self)
    return tmp_path


@pytest.mark.parametrize("page", RUN.values(), ids=RUN)
def test_every_cell_runs(page, beside):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    lines = [""] * len(page.read_text(encoding="utf-8").splitlines())
    for text, line in cells(page):  # where they stand on the page, so that a fault names its line
        code = text.splitlines()
        lines[line - 1 : line - 1 + len(code)] = code
    script = beside / f"{page.stem}.py"
    script.write_text("\n".join(lines), encoding="utf-8")
    runpy.run_path(str(script))
    pyplot.close("all")


@pytest.mark.parametrize("page", NOTEBOOKS.values(), ids=NOTEBOOKS)
def test_a_notebook_is_a_screenful_that_can_be_taken_home(page):
    text = page.read_text(encoding="utf-8")
    assert f"<{page.stem}.ipynb>`" in text
    assert text.startswith("---\nfile_format: mystnb\nkernelspec:\n  name: python3\n")
    assert len(text.splitlines()) < 190
    for code, _ in cells(page):
        compile(code, str(page), "exec")
    read = re.findall(r'read_task\("([^"]+)"', text) + re.findall(
        r"\{download\}`([\w-]+\.toml)`", text
    )
    written = set(re.findall(r'Path\("([^"]+)"\)', text))
    for name in set(read) - written:
        given = ("examples", "src/burmester/templates", f"docs/{page.parent.name}")
        assert any((ROOT / folder / name).is_file() for folder in given), name
