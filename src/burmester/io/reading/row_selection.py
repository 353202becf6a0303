"""Rows of a file by their numbers, names or times: --exact, --drop, --every, --from and --to.

The numbers are those of the file, from 1, whichever rows are left out; in a recording with a
column of frame numbers they are those.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.io.reading.pose_table import Source, shown
from burmester.io.reading.tables.grid import Row
from burmester.numerics.arrays import FloatArray

_TIME = re.compile(r"([+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)) *(s|ms)")
TIME_ROUNDING = 1e-9  # seconds; a row this far outside still counts as inside


class RowLabels(NamedTuple):
    """What the rows of a file are called."""

    size: int
    names: Sequence[str] = ()  # one a row, or none
    frames: bool = False  # the names are numbers of frames, and rows have no others
    times: Callable[[], FloatArray | None] | None = None  # reads them, (size,) in seconds

    def of_kept(self, kept: NDArray[np.intp]) -> list[str]:
        """The names of the rows that are kept: their numbers if they have none and some are not."""
        if len(kept) < self.size:
            return [(self.names[k] if self.names else "") or str(k + 1) for k in kept]
        counted = self.frames and all(name == str(k) for k, name in enumerate(self.names, 1))
        return [] if counted else list(self.names)


class RowSelection(NamedTuple):
    """The rows that are asked for."""

    every: int | None = None
    first: str | None = None
    last: str | None = None
    drop: Sequence[str] = ()

    def in_range(self, labels: RowLabels) -> NDArray[np.bool_]:
        """The rows from the first to the last one, both included."""
        inside = np.ones(labels.size, dtype=np.bool_)
        if self.first is not None:
            inside &= _beside("--from", self.first, labels, after=True)
        if self.last is not None:
            inside &= _beside("--to", self.last, labels, after=False)
        if labels.size and not inside.any():
            message = f"no {_noun(labels)} lies from {self.first or 'the first'} to " + (
                self.last or "the last"
            )
            help = "give --from a row that comes before the one of --to, or leave one of them out"
            raise InputError("E122", message, where=_where("--from", self.first or ""), help=help)
        return inside

    def kept(self, labels: RowLabels) -> NDArray[np.bool_]:
        """Every Nth row of the range, without those to be dropped; raises E122 and E125."""
        if self.every is not None and (isinstance(self.every, bool) or self.every < 1):
            message = f"every {shown(self.every)}th row cannot be taken"
            raise InputError("E125", message, help="give a whole number of 1 or more")
        inside = self.in_range(labels)
        rows = np.flatnonzero(inside)[:: self.every or 1]
        kept = np.zeros(labels.size, dtype=np.bool_)
        kept[rows] = True
        return kept & ~row_marks("--drop", self.drop, labels)


def row_marks(option: str, texts: Sequence[str], labels: RowLabels) -> NDArray[np.bool_]:
    """Which rows an option names, by numbers from 1 or by names; raises E122."""
    marks = np.zeros(labels.size, dtype=np.bool_)
    for text in texts:
        items = Row(Source(option, text), 0, [text] if text in labels.names else text.split(","))
        for i, item in enumerate(items.cells):
            marks[_row(item.strip(), labels, option, items.where(i))] = True
    return marks


def _row(word: str, labels: RowLabels, option: str, where: str) -> int:
    """The row that a number or a name stands for, counted from 0."""
    names, count, noun = labels.names, labels.size, _noun(labels)
    found = {k for k, name in enumerate(names) if word and name == word}
    is_number = word.isascii() and word.isdigit() and len(word) < 10
    if is_number and not labels.frames and 1 <= int(word) <= count:
        found.add(int(word) - 1)
    if len(found) == 1:
        return found.pop()
    known = " or by their names" if names and not labels.frames else ""
    ends = (names[0], names[-1]) if labels.frames and names else ("1", str(count))
    several = f"{ends[0]},{ends[1]}" if option in ("--drop", "--exact") else ends[0]
    message = f"there is no {noun} {shown(word)}"
    help = f"name {noun}s by their numbers, {ends[0]} to {ends[1]}{known}, as in {option} {several}"
    if found:
        which = " and ".join(str(k + 1) for k in sorted(found)[:5])
        message = f"{shown(word)} may be {noun} {which}"
        help = f"give the {noun}s names that differ and are no numbers, or none"
    raise InputError("E122", message, where=where, help=help)


def _beside(option: str, text: str, labels: RowLabels, *, after: bool) -> NDArray[np.bool_]:
    """The rows from a row or a time on, or up to it."""
    word, where = text.strip(), _where(option, text)
    time = _TIME.fullmatch(word)
    if time is None or word in labels.names:
        rows, row = np.arange(labels.size), _row(word, labels, option, where)
        return rows >= row if after else rows <= row
    times = labels.times() if labels.times else None
    if times is None:
        message = f"there is no time {shown(word)}: the file has no column of times"
        number = labels.names[0] if labels.frames else "1"
        help = f"name a {_noun(labels)} by its number, as in {option} {number}"
        raise InputError("E122", message, where=where, help=help)
    seconds = float(time[1]) / (1000 if time[2] == "ms" else 1)
    return times >= seconds - TIME_ROUNDING if after else times <= seconds + TIME_ROUNDING


def _noun(labels: RowLabels) -> str:
    return "frame" if labels.frames else "pose"


def _where(option: str, text: str) -> str:
    return Source(option, text).where(0, len(text))
