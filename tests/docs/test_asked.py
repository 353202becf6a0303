"""The page of what can be asked has every row of the tables, and links to pages that exist."""

import re
from importlib.resources import files

import pytest
from docs.building.asked import asked_page
from docs.building.generated import cell

from burmester.io.task_schema import task_schema
from burmester.requirements.table import ASKED, NOT_ASKED
from burmester.tasks.option_table import LIMIT_OPTIONS, OPTIONS

PAGE = asked_page(cell)


def section(name):
    """The rows of a section: their cells without marks of code."""
    text = PAGE.partition(f"\n## {name}\n")[2].partition("\n## ")[0]
    rows = [line.split(" | ") for line in text.splitlines() if line.startswith("| `")]
    return [[each.strip("| `") for each in row] for row in rows]


def test_every_requirement_has_its_option_bounds_and_standard():
    rows = section("Requirements")
    asked = {row[0]: row for row in rows[: len(ASKED)]}
    assert [*asked] == [each.name for each in ASKED]
    for each in ASKED:
        _, option, value, usual, meaning, kind = asked[each.name]
        assert option.split()[0] == each.option
        assert meaning.split(";")[0].rstrip(".") == each.help.split(";")[0].rstrip(".")
        assert kind == each.kind
        assert ("sound" in usual) == (each.standard is not None)
        for name in (*each.choices, *each.known):
            assert f"`{name}" in f"`{value}`"
    assert asked["transmission_deg"][2] == "degrees, from 0 to below 90"
    assert asked["transmission_deg"][3] == "sound: 30; few poses: 30, else 5"
    assert asked["link_ratio"][2] == "number, from 1"
    assert asked["within"][2] == "length, above 0"
    assert [row[0] for row in rows[len(ASKED) :]] == [each.name for each in NOT_ASKED]


@pytest.mark.parametrize(
    ("name", "table"), [("Limits", LIMIT_OPTIONS), ("Options of a search", OPTIONS)]
)
def test_every_limit_and_option_is_there(name, table):
    rows = section(name)
    assert [row[0].partition("=")[0] for row in rows] == [each.name for each in table]
    assert [row[1].split()[0] for row in rows] == [each.option for each in table]


def test_every_key_of_a_task_is_there():
    keys = task_schema()["properties"]
    assert [row[0] for row in section("Keys of a task")] == [*keys]
    assert all(len(row) == 3 and row[2] for row in section("Keys of a task"))
    for key in ("surroundings", "tolerance", "function", "loads", "springs", "drive"):
        assert section(key), key
    assert ["within_deg", "number above 0"] in [row[:2] for row in section("crank")]


def test_codes_have_pages():
    pages = files("burmester.io").joinpath("messages.md").read_text("utf-8")
    codes = set(re.findall(r"\(#([EWR]\d{3})\)", PAGE))
    assert len(codes) >= 5
    assert all(f"## {code} " in pages for code in codes)
