"""Articles, plurals and lists, beside sentences written by hand."""

import math

import pytest

from burmester.wording import count, figure, in_runs, listed, shortened, with_article


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


@pytest.mark.parametrize(
    ("numbers", "text"),
    [
        ("3", "3"),
        ("3 4", "3 and 4"),
        ("3 4 5", "3-5"),
        ("1 2 4 5 6 9", "1, 2, 4-6 and 9"),
        ("66 67 68 69 71 73 75 77 79 81 82 83", "66-69, 71, 73, 75, 77 and 4 others"),
        ("open 2 3 4 closed 07 8", "open, 2-4, closed, 07 and 8"),
        ("5 4 3", "5, 4 and 3"),
    ],
)
def test_successive_numbers_are_told_as_ranges(numbers, text):
    assert in_runs(numbers.split(), 6) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (1.234e-4, "0.00012"),
        (12.34, "12"),
        (99.4, "99"),
        (123.4, "123"),
        (123456.0, "123456"),
        (1.234e6, "1.2e6"),
        (-1.234e12, "-1.2e12"),
        (math.inf, "-"),
    ],
)
def test_a_figure_has_two_digits_and_no_plus(value, text):
    assert figure(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [(-1180.4, "-1180"), (999.4, "999"), (12.936, "12.9"), (0.012345, "0.0123"), (2.5e6, "2.5e6")],
)
def test_forces_have_three_digits_and_no_exponent_that_hides_their_size(value, text):
    assert figure(value, 3) == text
