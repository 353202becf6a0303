"""Texts of others on a screen, beside what they must look like, written by hand."""

import pytest

from burmester.printable import blanked, printable


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("Pose 1, geöffnet, 開, 45°", "Pose 1, geöffnet, 開, 45°"),
        ("\x1b[31mred", r"\x1b[31mred"),
        ("two\r\nlines", r"two\r\nlines"),
        ("a\tb\x00c\x7f", r"a\tb\x00c\x7f"),
        ("\x9b2J", r"\x9b2J"),
        ("\u202egnp.exe", r"\u202egnp.exe"),
        ("a\u2028b", r"a\u2028b"),
        ("\ud800", r"\ud800"),
        ("caf\udce9.csv", r"caf\xe9.csv"),
        ("\U000e0041", r"\U000e0041"),
        ("\ufffe and \ue000", r"\ufffe and \ue000"),
        ("10\xa0mm\u3000x", "10\xa0mm\u3000x"),
    ],
)
def test_what_a_screen_would_obey_or_hide_is_escaped(text, shown):
    assert printable(text) == shown
    assert printable(shown) == shown


def test_line_ends_stay_where_they_are_wanted():
    assert printable("a\nb\x07", keep="\n") == "a\nb\\x07"


def test_blanks_keep_every_column():
    assert blanked("x\ty\x1b[0m\nz\u202e") == "x y [0m\nz "
