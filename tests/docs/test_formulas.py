"""Each formula of the theory names the functions that compute it, and their docstrings name it."""

import re
from pathlib import Path

import pytest
from docs.building import formulas

import burmester

ROOT = Path(__file__).parents[2]
THEORY = formulas.theory()


def test_formulas_and_docstrings_name_each_other():
    told = formulas.on_page(THEORY)
    told_back = formulas.in_docstrings(ROOT / "src" / "burmester")
    assert told - told_back == set(), "the docstring does not say so"
    assert told_back - told == set(), "the page does not say so"
    assert len({name for name, _ in told}) > 40


def test_every_formula_has_a_name_and_every_function_exists():
    assert THEORY.count("\n$$\n") == 2 * len(formulas.ON_PAGE.findall(THEORY))
    names = [name for name, _ in formulas.ON_PAGE.findall(THEORY)]
    assert len(set(names)) == len(names)
    for _, function in formulas.on_page(THEORY):
        assert callable(formulas.owner(function)), function


def test_the_chapter_names_every_formula_once():
    chapter = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
    names = formulas.in_prose(chapter)
    known = {name for name, _ in formulas.on_page(THEORY)}
    assert sorted(names) == sorted(known)
    linked = formulas.prose_linked("formulas `one`, `two` and `three`, a `word`")
    assert linked == (
        "formulas {ref}`one <formula-one>`, {ref}`two <formula-two>` and "
        "{ref}`three <formula-three>`, a `word`"
    )


def test_a_formula_without_its_function_is_told(tmp_path):
    page = "Formula `one`, computed by `geometry.displacement.image_multiply`, `a.b.gone`.\n"
    assert formulas.on_page(page) == {
        ("one", "geometry.displacement.image_multiply"),
        ("one", "a.b.gone"),
    }
    with pytest.raises(ModuleNotFoundError):
        formulas.owner("a.b.gone")
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "b.py").write_text(
        'class C:\n    def f():\n        """It.\n\n    Formulas `one`, `two` of the theory."""\n'
    )
    assert formulas.in_docstrings(tmp_path) == {("one", "a.b.C.f"), ("two", "a.b.C.f")}


def test_links_of_the_site_take_the_short_name_where_there_is_one():
    assert (
        formulas.on_site("geometry.displacement.Displacement.act") == "burmester.Displacement.act"
    )
    assert formulas.on_site("dyads.local_minima.best_dyads") == "burmester.best_dyads"
    assert formulas.on_site("dyads.pencil.fit_pencil") == "burmester.dyads.pencil.fit_pencil"
    assert formulas.on_site("dyads.pencil.Pencil.at") == "burmester.dyads.pencil.Pencil.at"


def test_the_page_of_the_api_has_every_public_name():
    page = (ROOT / "docs" / "reference" / "api.md").read_text(encoding="utf-8")
    described = set(re.findall(r"(?m)^\.\. auto\w+:: burmester\.(\w+)$", page))
    assert set(burmester.__all__) - described == {"__version__"}
    assert {name for name in described if not hasattr(burmester, name)} == set()
