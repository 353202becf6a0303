"""What is asked of the whole linkage, as it is said in a file or on the command line.

Each requirement is said once: in the file or on the command line.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from burmester.errors import InputError
from burmester.tasks.requirements import GROUPS, TYPES, Requirements

__all__ = ["FILE_KEYS", "REQUIREMENT_KEYS", "Asked", "ask", "joined", "plain", "requirements"]

# Under `requirements` in a file, and the field of `Requirements` that it sets.
FILE_KEYS: Mapping[str, str] = {
    "transmission_deg": "transmission",
    "types": "types",
    "driver": "driver",
    "footprint": "footprint",
    "link_ratio": "link_ratio",
    "within": "within",
    "any_order": "any_order",
}

# `requirements`, and what may be met beside the poses by mistake, where it would ask for nothing
REQUIREMENT_KEYS = ("requirements", "requirement", *FILE_KEYS)

_SAID = {  # of a requirement that is said twice
    "transmission": "the least transmission angle is",
    "types": "the types are",
    "driver": "the driver is",
    "footprint": "the footprint is",
    "link_ratio": "the greatest link ratio is",
    "within": "the greatest acceptable error is",
    "any_order": "the order of the poses is",
}


class Asked(NamedTuple):
    """One requirement: a field of `Requirements`, its value, and where it is said."""

    field: str
    value: Any
    where: str


def joined(*places: str) -> str:
    """Several places in one line, without the lines of text that one alone is shown with."""
    some = list(dict.fromkeys(filter(None, places)))
    return some[0] if len(some) == 1 else ", and ".join(each.partition("\n")[0] for each in some)


def ask(field: str, value: Any, where: str, place: str | None = None) -> Asked:
    """A requirement that is sound by itself; raises what `Requirements` does, at `place`."""
    try:
        Requirements(**{field: value})
    except InputError as error:
        error.where = place or where
        raise
    return Asked(field, value, where)


def requirements(said: Sequence[Asked]) -> Requirements:
    """What they come to; raises E108 where one is said twice, and E132 as `Requirements` does."""
    known: dict[str, Asked] = {}
    for each in said:
        if each.field in known:
            raise InputError(
                "E108",
                f"{_SAID[each.field]} said twice",
                where=joined(known[each.field].where, each.where),
                help="leave one of the two out",
            )
        known[each.field] = each
    try:
        return Requirements(**{field: each.value for field, each in known.items()})
    except InputError as error:
        # No others contradict each other.
        error.where = joined(*(each.where for each in said if each.field in ("types", "driver")))
        raise


def plain(asked: Requirements) -> dict[str, Any]:
    """The table `requirements` of a file that asks for the same; empty where nothing is asked."""
    data: dict[str, Any] = {}
    if asked.transmission:
        data["transmission_deg"] = math.degrees(asked.transmission)
    if asked.types is not None:
        data["types"] = [name for name in (*TYPES, *GROUPS) if name in asked.types]
    if asked.driver != "any":
        data["driver"] = asked.driver
    if asked.footprint is not None:
        data["footprint"] = {"polygon": asked.footprint.vertices.tolist()}
    if asked.link_ratio != math.inf:
        data["link_ratio"] = asked.link_ratio
    if asked.within is not None:
        data["within"] = asked.within
    if asked.any_order:
        data["any_order"] = True
    return data
