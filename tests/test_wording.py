"""Articles, plurals and lists, beside sentences written by hand."""

import pytest

from burmester.wording import count, listed, shortened, with_article


@pytest.mark.parametrize(
    "text",
    [
        "a crank-rocker",
        "an inverted slider-crank",
        "an Oldham linkage",
        "a Rapson slide",
        "an Uhing drive",
        "an ellipse",
        "an arc",
    ],
)
def test_an_article_goes_by_the_first_letter(text):
    assert with_article(text.split(" ", 1)[1]) == text


@pytest.mark.parametrize("text", ["no dyads", "1 dyad", "2 dyads", "21 dyads"])
def test_plurals(text):
    number = text.split()[0]
    assert count(0 if number == "no" else int(number), "dyad") == text


@pytest.mark.parametrize("text", ["D1", "D1 or D2", "D1, D2 or D3", "D1, D2, D3 or D4"])
def test_lists_read_as_people_write_them(text):
    assert listed(text.replace(" or ", ", ").split(", "), "or") == text


def test_long_lists_are_counted_at_the_end():
    assert listed(shortened([*"abcd"], 4)) == "a, b, c and d"
    assert listed(shortened([*"abcde"], 4)) == "a, b and 3 others"
    assert listed(shortened([*"abcdefg"], 3, "times")) == "a and 6 times"
