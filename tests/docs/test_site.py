"""What is checked of the built pages, on pages with a fault each; nothing is built."""

from pathlib import Path

import pytest
from docs.building import checks

GOOD = """<html><head><link rel="stylesheet" href="_static/a.css"></head><body id="top">
<a href="other.html#there">x</a> <a href="#top">x</a> <a href="https://example.org">x</a>
<img src="a.png"></body></html>"""


@pytest.fixture
def site(tmp_path) -> Path:
    (tmp_path / "_static").mkdir()
    (tmp_path / "_static" / "a.css").write_text("b { background: url('a.png') }")
    (tmp_path / "a.png").write_bytes(b"png")
    (tmp_path / "index.html").write_text(GOOD)
    (tmp_path / "other.html").write_text('<p id="there"></p>')
    return tmp_path


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
