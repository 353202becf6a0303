"""Modules that name a requirement by its key: few, and only fewer."""

from pathlib import Path

SOURCE = Path(__file__).parents[2] / "src" / "burmester"
# Beside `requirements` and the fields of `Requirements`, the figure of that name is a column, a key
# of JSON or a method in some.
MOST = 18


def test_modules_that_name_the_link_ratio_get_fewer():
    named = [file for file in SOURCE.rglob("*.py") if "link_ratio" in file.read_text("utf-8")]
    assert len(named) <= MOST, sorted(map(str, named))


def test_no_script_of_a_page_names_it():
    """The form of the studio is made of the table; bundles are made of the scripts."""
    scripts = [file for file in (SOURCE / "web").rglob("*.mjs") if file.parent.name != "assets"]
    assert scripts
    assert [file.name for file in scripts if "link_ratio" in file.read_text("utf-8")] == []


def test_conventions_stand_in_the_table_only():
    """No other module has a constant of the standard: 30 degrees, ratio 10, 0.05 and 10 spans."""
    said = ("LEAST_TRANSMISSION = 30", "LEAST_TRANSMISSION: Final = 30", "MOST_LINK_RATIO")
    found = {
        file.name: word
        for file in SOURCE.rglob("*.py")
        for word in said
        if word in file.read_text("utf-8")
    }
    assert found == {}
