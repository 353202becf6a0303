"""Texts in which the place of a fault is marked, «like this», and where that is."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Marked", "carets", "marked"]


class Marked(NamedTuple):
    """A text without its marks, and the line, the column and the width of what they hold."""

    text: str
    line: int
    column: int
    width: int


def marked(text: str) -> Marked:
    """What a text with one pair of marks is about; lines and columns are counted from 1."""
    before, _, rest = text.partition("«")
    inside, _, after = rest.partition("»")
    lines = before.split("\n")
    return Marked(before + inside + after, len(lines), len(lines[-1]) + 1, len(inside))


def carets(where: str) -> tuple[str, int, int, int]:
    """The file, line, column and width that an error points at; they agree with its excerpt."""
    place, line, below = where.split("\n")
    name, number, column = place.rsplit(":", 2)
    start, width = below.index("^"), below.count("^")
    assert line.split("|")[0].strip() == number
    assert below[start : start + width] == "^" * width
    assert start == line.index("|") + 1 + min(int(column), 61)
    return name, int(number), int(column), width
