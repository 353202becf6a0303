"""Limits as the command line states them.

A region is X,Y (a point) or line:X,Y:X,Y, segment:X,Y:X,Y, box:X,Y:X,Y or
polygon:X,Y:X,Y:X,Y with any more corners; a length is MIN:MAX, either side may be empty; kinds
are RR,PR.  A rail or slot is direction:DEG+-DEG, through:REGION and travel:REGION, or some of them,
with blanks between.  `any` is no limit.  What does not fit is E131, with a caret below the text.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

from burmester.errors import InputError
from burmester.io.reading.option_text import (
    ANY,
    number_from_text,
    option_fault,
    option_text,
    region_from_text,
)
from burmester.io.reading.pose_table import Source, shown
from burmester.io.reading.specification import LengthRange, OptionalKinds, Specification
from burmester.tasks.limits import KINDS
from burmester.tasks.rails import Rail

RAIL_HELP = (
    "write direction:DEG or direction:DEG+-DEG, through:REGION and travel:REGION, or some of them, "
    'such as "direction:0+-2 through:0,0", or any'
)
LENGTH_HELP = "write 10:200, 10: for at least 10, :200 for at most 200, or any"


def limits_from_options(**given: Sequence[str]) -> Specification:
    """The limits in the texts of the options, by the names of the limits.

    Raises E131, E132 for an empty box, and E137.
    """
    limits: dict[str, Any] = {}
    where = {}
    for name, texts in given.items():
        option = f"--{name.replace('_', '-')}"
        if len(texts) > 2:
            raise InputError(
                "E131",
                f"{option} is given {len(texts)} times, and a linkage has two dyads",
                where=option_text(option, texts),
                help=f"give {option} once for both dyads, or twice, once for each",
            )
        limits[name] = tuple(
            None if text.strip() == ANY else _READ[name](Source(option, text)) for text in texts
        )
        if texts:
            where[name] = option_text(option, texts)
    return Specification(**limits, where=where)


def _length(source: Source) -> LengthRange:
    low, colon, high = source.text.partition(":")
    if not colon or ":" in high:
        raise option_fault(source, f"{shown(source.text)} is not a range MIN:MAX", LENGTH_HELP)
    least = number_from_text(source, low, 0) if low.strip() else 0.0
    most = number_from_text(source, high, len(low) + 1) if high.strip() else float("inf")
    return least, most


def _kinds(source: Source) -> OptionalKinds:
    at, kinds = 0, set()
    for item in source.text.split(","):
        known = [kind for kind in KINDS if kind == item.strip().upper()]
        if not known:
            message = f"there is no dyad kind {shown(item)}"
            help = f"choose among {', '.join(KINDS)}, with commas between them"
            raise option_fault(source, message, help, at=at, width=len(item))
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
        begin, fault = at + len(name) + 1, None
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
            stated[name] = region_from_text(Source(source.label, rest))
        at += len(word)
    if not stated:
        raise option_fault(source, "it is empty", RAIL_HELP)
    try:
        return Rail(**stated)
    except InputError as error:
        error.where = error.where or source.where(0, len(source.text))
        raise


_READ: Final[Mapping[str, Callable[[Source], Any]]] = {
    "fixed_pivot": region_from_text,
    "moving_pivot": region_from_text,
    "length": _length,
    "kinds": _kinds,
    "rail": _rail,
    "slot": _rail,
}
