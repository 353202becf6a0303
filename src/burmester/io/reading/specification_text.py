"""Limits, requirements, and how exact poses are, as the command line states them.

Angles are in degrees, lengths in the unit of the poses; `any` is no limit.  A limit that is
malformed is E131, a requirement E134 (its region E131), with a caret below the text.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from burmester.errors import InputError
from burmester.io.reading.option_text import ANY, numbers_from_text, option_text
from burmester.io.reading.pose_table import Source
from burmester.io.reading.specification import Specification, StatedRequirement, checked_requirement
from burmester.io.reading.stated_tolerances import FREE_WORDS, DefaultTolerance
from burmester.io.reading.trees.specification_tree import VALUE_KINDS
from burmester.requirements.requirement import Requirement
from burmester.requirements.table import ASKED
from burmester.tasks.option_table import LIMIT_OPTIONS


def limits_from_options(**given: Sequence[str]) -> Specification:
    """The limits in the texts of the options, by the names of the limits.

    Raises E131, E132 for an empty box, and E137.
    """
    limits: dict[str, Any] = {}
    where = {}
    for each in LIMIT_OPTIONS:
        texts, option = given.get(each.name, ()), each.option
        if len(texts) > 2:
            raise InputError(
                "E131",
                f"{option} is given {len(texts)} times, and a linkage has two dyads",
                where=option_text(option, texts),
                help=f"give {option} once for both dyads, or twice, once for each",
            )
        read = VALUE_KINDS[each.kind].from_text
        limits[each.name] = tuple(
            None if text.strip() == ANY else read(Source(option, text)) for text in texts
        )
        if texts:
            where[each.name] = option_text(option, texts)
    return Specification(**limits, where=where)


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
    bound = VALUE_KINDS[each.form or ""].from_text(source)
    fault_at = None if each.form == "choice" else source.where(0, len(value))
    return checked_requirement(each.name, bound, where, fault_at)


def _names(each: Requirement, source: Source) -> list[str]:
    names, at = [], 0
    for item in source.text.split(","):
        name = item.strip()
        fault_at = source.where(at + len(item) - len(item.lstrip()), len(name))
        names += checked_requirement(each.name, [name], source.label, fault_at).value
        at += len(item) + 1
    return names


def pose_sigma(text: str) -> tuple[float, float]:
    """Standard deviations LENGTH,DEG of positions and angles, as a length and in radians."""
    source = Source("--pose-sigma", text)
    help = "write a length and an angle in degrees, such as 0.05,0.1; 0 is for exact numbers"
    length, angle = numbers_from_text(source, text, 0, "LENGTH,DEG", help, code="E134", least=0)
    return length, math.radians(angle)


def pose_tolerance(text: str) -> DefaultTolerance:
    """The tolerance X,Y,DEG of all poses, each a number or "free"; ",body" may follow."""
    source = Source("--pose-tolerance", text)
    numbers, _, axes = text.rpartition(",")
    if axes.strip().lower() not in ("body", "fixed"):
        numbers, axes = text, "fixed"
    help = "write X,Y,DEG, such as 0.1,0.1,0.5; free in place of a number, 0 for exact; and ,body "
    help += "behind them for tolerances along the body's own axes"
    x, y, angle = numbers_from_text(
        source, numbers, 0, "X,Y,DEG", help, code="E135", words=FREE_WORDS, least=0
    )
    where = source.where(0, len(text))
    body = axes.strip().lower() == "body"
    return DefaultTolerance((x, y, angle), "body" if body else "fixed", "deg", where)
