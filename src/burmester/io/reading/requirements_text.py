"""Requirements, and lengths to compute with, as the command line states them.

Angles are in degrees, lengths in the unit of the poses.  A malformed value is E134, with a caret
below the text (a malformed region is E131, as for pivots).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from burmester.io.reading.limits_text import (
    ANY,
    number_from_text,
    option_fault,
    option_text,
    region_from_text,
)
from burmester.io.reading.pose_table import Source, shown
from burmester.io.reading.stated_requirements import StatedRequirement, checked_requirement
from burmester.io.reading.stated_tolerances import FREE_WORDS, DefaultTolerance
from burmester.requirements.requirement import Requirement
from burmester.requirements.table import ASKED

__all__ = [
    "lengths",
    "pose_sigma",
    "pose_tolerance",
    "positive_length",
    "positive_seconds",
    "requirements_from_options",
]

FOOTPRINT_HELP = "write box:X,Y:X,Y from lower left to upper right, or polygon:X,Y:X,Y:X,Y, or any"


def requirements_from_options(**given: Any) -> tuple[StatedRequirement, ...]:
    """The requirements in the texts of the options; raises E134, E131 and E132.

    given: by `Requirement.argument`.  The types' option adds up where it is given more than once.
    """
    values = ((each, given.get(each.argument)) for each in ASKED)
    return tuple(_stated(each, value) for each, value in values if value not in (None, False, ()))


def _stated(each: Requirement, value: Any) -> StatedRequirement:
    option = each.option
    if each.form == "flag":
        return checked_requirement(each.name, value, option)
    if each.form == "names":
        names = frozenset(name for text in value for name in _names(each, Source(option, text)))
        return StatedRequirement(each.name, names, option_text(option, value))
    where, source = option_text(option, [value]), Source(option, value)
    if each.form == "choice":
        return checked_requirement(each.name, value, where)
    fault_at = source.where(0, len(value))
    if each.form == "area":
        area = None if value.strip() == ANY else region_from_text(source, FOOTPRINT_HELP)
        return checked_requirement(each.name, area, where, fault_at)
    bound = number_from_text(source, value, 0, "E134")
    return checked_requirement(each.name, bound, where, fault_at)


def positive_length(option: str, text: str) -> float:
    """The one length that an option takes; raises E134 where it is not above zero."""
    (value,) = lengths(option, [text], one=True)
    return value


def positive_seconds(option: str, text: str) -> float:
    """The seconds that an option takes; raises E134 where they are not above zero."""
    source = Source(option, text)
    if (value := number_from_text(source, text, 0, "E134")) <= 0:
        help = f"give seconds above zero, such as 2, or leave {option} out"
        message = f"{shown(text.strip())} is not above zero"
        raise option_fault(source, message, help, at=0, width=len(text), code="E134")
    return value


def lengths(option: str, texts: Sequence[str], *, one: bool = False) -> tuple[float, ...]:
    """Lengths separated by commas, in one text or several; raises E134 as `positive_length`."""
    out = []
    for text in texts:
        source, at = Source(option, text), 0
        for cell in [text] if one else text.split(","):
            value = number_from_text(source, cell, at, "E134")
            if value <= 0:
                help = f"give a length above zero, in the unit of the poses, or leave {option} out"
                message = f"{shown(cell.strip())} is not above zero"
                raise option_fault(source, message, help, at=at, width=len(cell), code="E134")
            out.append(value)
            at += len(cell) + 1
    return tuple(out)


def pose_sigma(text: str) -> tuple[float, float]:
    """Standard deviations LENGTH,DEG of positions and angles, as a length and in radians."""
    source = Source("--pose-sigma", text)
    cells = text.split(",")
    help = "write a length and an angle in degrees, such as 0.05,0.1; 0 is for exact numbers"
    if len(cells) != 2:
        raise option_fault(source, f"{shown(text)} is not LENGTH,DEG", help, code="E134")
    values, at = [], 0
    for cell in cells:
        values.append(number_from_text(source, cell, at, "E134"))
        if values[-1] < 0:
            message = f"{shown(cell.strip())} is below zero"
            raise option_fault(source, message, help, at=at, width=len(cell), code="E134")
        at += len(cell) + 1
    return values[0], math.radians(values[1])


def pose_tolerance(text: str) -> DefaultTolerance:
    """The tolerance X,Y,DEG of all poses, each a number or "free"; ",body" may follow."""
    source = Source("--pose-tolerance", text)
    *cells, end = text.split(",")
    body = end.strip().lower() == "body"
    cells += [] if body or end.strip().lower() == "fixed" else [end]
    help = "write X,Y,DEG, such as 0.1,0.1,0.5; free in place of a number, 0 for exact; and ,body "
    help += "behind them for tolerances along the body's own axes"
    if len(cells) != 3:
        raise option_fault(source, f"{shown(text)} is not X,Y,DEG", help, code="E135")
    bounds, at = [], 0
    for cell in cells:
        free = cell.strip().lower() in FREE_WORDS
        bounds.append(math.inf if free else number_from_text(source, cell, at, "E135"))
        if bounds[-1] < 0:
            message = f"{shown(cell.strip())} is below zero"
            raise option_fault(source, message, help, at=at, width=len(cell), code="E135")
        at += len(cell) + 1
    x, y, angle = bounds
    where = source.where(0, len(text))
    return DefaultTolerance((x, y, angle), "body" if body else "fixed", "deg", where)


def _names(each: Requirement, source: Source) -> list[str]:
    names, at = [], 0
    for item in source.text.split(","):
        name = item.strip()
        fault_at = source.where(at + len(item) - len(item.lstrip()), len(name))
        names += checked_requirement(each.name, [name], source.label, fault_at).value
        at += len(item) + 1
    return names
