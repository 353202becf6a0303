"""Limits as the command line states them.

A region is X,Y (a point) or line:X,Y:X,Y, segment:X,Y:X,Y, box:X,Y:X,Y or
polygon:X,Y:X,Y:X,Y with any more corners; a length is MIN:MAX, either side may be empty; kinds
are RR,PR.  A rail or slot is direction:DEG+-DEG, through:REGION and travel:REGION, or some of them,
with blanks between.  `any` is no limit.  Numbers have a decimal point; what does not fit is E131,
with a caret below the text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np

from burmester.errors import InputError
from burmester.geometry.regions import Region
from burmester.io.reading.pose_table import Source, plain_number, shown, unheld
from burmester.io.reading.specification import SHAPES, LengthRange, OptionalKinds, Specification
from burmester.tasks.limits import KINDS, Kind
from burmester.tasks.rails import Rail

__all__ = [
    "ANY",
    "limits_from_options",
    "number_from_text",
    "option_fault",
    "option_text",
    "region_from_text",
]

ANY = "any"
REGION_HELP = "write X,Y for a point, or line:X,Y:X,Y, segment:, box: or polygon: likewise, or any"
RAIL_HELP = (
    "write direction:DEG or direction:DEG+-DEG, through:REGION and travel:REGION, or some of them, "
    'such as "direction:0+-2 through:0,0", or any'
)
LENGTH_HELP = "write 10:200, 10: for at least 10, :200 for at most 200, or any"

T = TypeVar("T")


def limits_from_options(
    fixed_pivot: Sequence[str] = (),
    moving_pivot: Sequence[str] = (),
    length: Sequence[str] = (),
    kinds: Sequence[str] = (),
    *,
    rail: Sequence[str] = (),
    slot: Sequence[str] = (),
) -> Specification:
    """The limits in the texts of the options; raises E131, E132 for an empty box, and E137."""
    given = {
        "fixed_pivot": fixed_pivot,
        "moving_pivot": moving_pivot,
        "length": length,
        "kinds": kinds,
        "rail": rail,
        "slot": slot,
    }
    return Specification(
        _each(fixed_pivot, "--fixed-pivot", region_from_text),
        _each(moving_pivot, "--moving-pivot", region_from_text),
        _each(length, "--length", _length),
        _each(kinds, "--kinds", _kinds),
        _each(rail, "--rail", _rail),
        _each(slot, "--slot", _rail),
        {n: option_text(f"--{n.replace('_', '-')}", texts) for n, texts in given.items() if texts},
    )


def option_text(option: str, texts: Sequence[str]) -> str:
    """An option with its values as typed, in one line; empty where there is none."""
    return " ".join(f"{option} {quoted(text)}" for text in texts)


def quoted(text: str) -> str:
    """A text of the command line as one types it: in quotes if there is a blank in it."""
    plain = "".join(c if c.isprintable() else " " for c in text)
    plain = plain if len(plain) <= 60 else f"{plain[:57]}..."
    return plain if plain and plain.split() == [plain] else f'"{plain}"'


def _each(texts: Sequence[str], option: str, read: Callable[[Source], T]) -> tuple[T | None, ...]:
    if len(texts) > 2:
        raise InputError(
            "E131",
            f"{option} is given {len(texts)} times, and a linkage has two dyads",
            where=option_text(option, texts),
            help=f"give {option} once for both dyads, or twice, once for each",
        )
    return tuple(None if text.strip() == ANY else read(Source(option, text)) for text in texts)


def region_from_text(source: Source, help: str = REGION_HELP) -> Region:
    """The region in a text; raises E131, or E132 for an empty box, with a caret."""
    head, colon, rest = source.text.partition(":")
    shape = head.strip() if colon else "point"
    if shape not in SHAPES:
        raise option_fault(source, f"there is no region {shown(shape)}", help, width=len(head))
    at = len(head) + 1 if colon else 0
    parts = (rest if colon else source.text).split(":")
    points, (count, make) = [], SHAPES[shape]
    for part in parts:
        cells = part.split(",")
        if len(cells) != 2:
            message = f"{shown(part)} is not a point X,Y"
            why = "a comma separates X and Y and is no decimal mark" if len(cells) > 2 else None
            raise option_fault(source, message, help, at=at, width=len(part), why=why)
        points.append(
            [
                number_from_text(source, cells[0], at),
                number_from_text(source, cells[1], at + len(cells[0]) + 1),
            ]
        )
        at += len(part) + 1
    if count not in (None, len(points)):
        message = f"a {shape} takes {count} point{'' if count == 1 else 's'}, not {len(points)}"
        raise option_fault(source, message, help)
    try:
        return make(np.array(points))
    except InputError as error:
        error.where = source.where(0, len(source.text))
        raise


def _length(source: Source) -> LengthRange:
    parts = source.text.split(":")
    if len(parts) != 2:
        raise option_fault(source, f"{shown(source.text)} is not a range MIN:MAX", LENGTH_HELP)
    low, high = parts
    least = number_from_text(source, low, 0) if low.strip() else 0.0
    most = number_from_text(source, high, len(low) + 1) if high.strip() else float("inf")
    return least, most


def _kinds(source: Source) -> OptionalKinds:
    kinds: set[Kind] = set()
    at = 0
    for item in source.text.split(","):
        known: list[Kind] = [kind for kind in KINDS if kind == item.strip().upper()]
        if not known:
            help = f"choose among {', '.join(KINDS)}, with commas between them"
            raise option_fault(
                source, f"there is no dyad kind {shown(item)}", help, at=at, width=len(item)
            )
        kinds.update(known)
        at += len(item) + 1
    return frozenset(kinds)


def _rail(source: Source) -> Rail:
    """The rail in a text; raises E131 and E137."""
    stated: dict[str, Any] = {}
    at = 0
    for word in source.text.split():
        at = source.text.index(word, at)
        name, _, rest = word.partition(":")
        part, begin = Source(source.label, rest), at + len(name) + 1
        fault = None
        if name not in ("direction", "through", "travel") or not rest:
            fault = f"{shown(word)} says nothing of a rail"
        elif name in stated or f"{name}_deg" in stated:
            fault = f"{name} is given twice"
        if fault is not None:
            raise option_fault(source, fault, RAIL_HELP, at=at, width=len(word))
        if name == "direction":
            mark = "±" if "±" in rest else "+-"
            angle, within, tolerance = rest.partition(mark)
            stated["direction_deg"] = number_from_text(source, angle, begin)
            if within:
                place = begin + len(angle) + len(mark)
                stated["tolerance_deg"] = number_from_text(source, tolerance, place)
        else:
            stated[name] = region_from_text(part)
        at += len(word)
    if not stated:
        raise option_fault(source, "it is empty", RAIL_HELP)
    try:
        return Rail(**stated)
    except InputError as error:
        error.where = error.where or source.where(0, len(source.text))
        raise


def number_from_text(source: Source, cell: str, at: int, code: str = "E131") -> float:
    """The finite number in a cell that begins `at` this place of a text, or an error.

    E131 for a coordinate or a bound, E153 for one of a dyad; E134 for one that has to be positive.
    """
    plain, mark = plain_number(cell.strip(), ",")
    if mark is None:
        at += len(cell) - len(cell.lstrip())
        such = "12.5 or 3e-4" if code == "E134" else "-12.5 or 3e-4"
        help = f"write digits with at most a decimal point and an exponent, such as {such}"
        message = f"{shown(cell.strip())} is not a finite number"
        short = len(cell) <= 40 and cell.isprintable()
        why, edit = _number_slip(cell.strip()) if short else (None, None)
        width = len(cell.strip())
        raise option_fault(source, message, edit or help, at=at, width=width, code=code, why=why)
    return float(plain)


def _number_slip(cell: str) -> tuple[str | None, str | None]:
    """Why a cell is no number, and the edit that makes it one, where both are plain."""
    if re.fullmatch(r"[-+]?[0-9]+,[0-9]+", cell):
        return "a comma is no decimal mark here", f"write {cell.replace(',', '.')}"
    if found := re.fullmatch(r"([-+]?[0-9]*\.?[0-9]+) *([^\W\d_]+|°|%)", cell):
        return f"a number is written without {found[2]}", f"write {found[1]}"
    if re.fullmatch(r"[-+]?[0-9]+(_[0-9]+)+", cell):
        return "underscores between digits are not allowed here", f"write {cell.replace('_', '')}"
    if cell[:1] in tuple("−–"):
        return f"{cell[0]} is a dash, not a minus sign", f"write -{cell[1:]}"
    if re.fullmatch(r"[-+]?[0-9.]+[eE][+-]?[0-9]+", cell):
        return unheld(cell), None
    return None, None


def option_fault(
    source: Source,
    message: str,
    help: str,
    *,
    at: int = 0,
    width: int | None = None,
    code: str = "E131",
    why: str | None = None,
) -> InputError:
    """An error with carets below the faulty part of an option's text.

    at, width: index and length of that part; the whole text by default.
    """
    where = source.where(at, len(source.text) if width is None else width)
    return InputError(code, f"{source.label}: {message}", where=where, why=why, help=help)
