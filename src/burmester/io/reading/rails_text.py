"""Rails and slots as the command line states them.

What is stated stands in one text, in any order, with blanks between: direction:DEG or
direction:DEG+-DEG (± likewise), through:REGION and travel:REGION, with regions as for pivots.
What does not fit is E131, or E137 where the rail itself is refused.
"""

from __future__ import annotations

from typing import Any, Final

from burmester.errors import InputError
from burmester.io.reading.limits_text import number_from_text, option_fault, region_from_text
from burmester.io.reading.pose_table import Source, shown
from burmester.tasks.rails import Rail

__all__ = ["rail_from_text"]

RAIL_HELP: Final = (
    "write direction:DEG or direction:DEG+-DEG, through:REGION and travel:REGION, or some of them, "
    'such as "direction:0+-2 through:0,0", or any'
)


def rail_from_text(source: Source) -> Rail:
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
