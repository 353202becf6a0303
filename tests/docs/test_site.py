"""What is checked of the built pages, on pages with a fault each; nothing is built."""

from pathlib import Path

import nbformat
import pytest
from docs.building import checks, notebooks
from nbformat import v4

GOOD = """<html><head><link rel="stylesheet" href="_static/a.css"></head><body id="top">
<a href="other.html#there">x</a> <a href="#top">x</a> <a href="https://example.org">x</a>
<img src="a.png"></body></html>"""


@pytest.fixture
def site(tmp_path) -> Path:
    folder = tmp_path / "pages"
    (folder / "_static").mkdir(parents=True)
    (folder / "_static" / "a.css").write_text("b { background: url('a.png') }")
    (folder / "a.png").write_bytes(b"png")
    (folder / "index.html").write_text(GOOD)
    (folder / "other.html").write_text('<p id="there"></p>')
    return folder


def test_sound_pages_pass(site):
    assert checks.troubles(site) == []


@pytest.mark.parametrize(
    ("file", "old", "new", "told"),
    [
        ("index.html", "other.html#there", "gone.html", "index.html: gone.html leads nowhere"),
        ("index.html", "#there", "#gone", "index.html: other.html#gone names no place"),
        ("index.html", 'href="#top"', 'href="#gone"', "index.html: #gone names no place"),
        ("index.html", 'src="a.png"', 'src="b.png"', "index.html: b.png leads nowhere"),
        ("index.html", 'src="a.png"', 'src="//x.org/b.png"', "index.html: loads //x.org/b.png"),
        ("index.html", "_static/a.css", "https://x.org/a.css", "loads https://x.org/a.css"),
        ("_static/a.css", "'a.png'", "https://x.org/f.woff", "a.css: loads https://x.org/f.woff"),
    ],
)
def test_a_fault_is_told(site, file, old, new, told):
    path = site / file
    path.write_text(path.read_text().replace(old, new))
    (only,) = checks.troubles(site)
    assert told in only


def test_pages_that_are_too_large_are_told(site, monkeypatch):
    monkeypatch.setattr(checks, "MOST_MEGABYTES", 1e-4)
    assert "MB are more than" in checks.troubles(site)[0]


def test_a_notebook_to_take_home_shows_what_the_build_showed(site):
    """Outputs of the run, words of the page; SVG comes once; other code is a fault."""
    shown = {"text/plain": "4", "text/html": "<svg/>", "image/svg+xml": "<svg/>"}
    ran = v4.new_notebook(
        cells=[
            v4.new_markdown_cell("{bent} words"),
            v4.new_code_cell("print(1)\n", outputs=[v4.new_output("stream", text="1\n")]),
            v4.new_code_cell("2 + 2", outputs=[v4.new_output("execute_result", shown)]),
        ]
    )
    plain = v4.new_notebook(
        cells=[
            v4.new_markdown_cell("Words"),
            v4.new_code_cell("print(1)"),
            v4.new_code_cell("2 + 2"),
        ]
    )
    for folder, notebook in ((site.parent / notebooks.RUN, ran), (site / "_downloads/0a", plain)):
        folder.mkdir(parents=True)
        nbformat.write(notebook, folder / "one.ipynb")
    assert notebooks.give_outputs(site) == 1
    given = nbformat.read(site / "_downloads" / "0a" / "one.ipynb", as_version=4)
    nbformat.validate(given)
    words, first, second = given.cells
    assert words.source == "Words"
    assert first.outputs[0].text == "1\n"
    assert (first.execution_count, second.execution_count) == (1, 2)
    assert dict(second.outputs[0].data) == {"text/plain": "4", "text/html": "<svg/>"}
    plain.cells[-1].source = "2 + 3"
    with pytest.raises(AssertionError, match=r"2 \+ 3"):
        notebooks.copy_outputs(ran, plain)
