"""Requirements on the whole linkage as a file or the command line states them.

Each requirement is stated once: in the file or on the command line.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields
from typing import Any, NamedTuple

from burmester.errors import InputError
from burmester.requirements.types import GROUPS, TYPES
from burmester.tasks.requirements import Requirements

__all__ = [
    "FILE_KEYS",
    "REQUIREMENT_KEYS",
    "StatedRequirement",
    "checked_requirement",
    "combined_requirements",
    "one_line",
    "requirements_data",
]

# Under `requirements` in a file: the fields of `Requirements`, in their order.
FILE_KEYS = tuple(field.name for field in fields(Requirements))

# `requirements`, and keys that may stand beside the poses by mistake, where they require nothing.
REQUIREMENT_KEYS = ("requirements", "requirement", *FILE_KEYS)

_SUBJECTS = {  # of the message about a requirement that is given twice
    "transmission_deg": "the least transmission angle is",
    "types": "the types are",
    "driver": "the driver is",
    "footprint": "the footprint is",
    "link_ratio": "the greatest link ratio is",
    "within": "the greatest acceptable error is",
    "within_deg": "the greatest acceptable angle error is",
    "any_order": "the order of the poses is",
}


class StatedRequirement(NamedTuple):
    """One requirement: a field of `Requirements`, its value, and its location."""

    field: str
    value: Any
    where: str


def one_line(*locations: str) -> str:
    """Several locations in one line, without the lines of text that a single one is shown with."""
    known = list(dict.fromkeys(filter(None, locations)))
    return known[0] if len(known) == 1 else ", and ".join(w.partition("\n")[0] for w in known)


def checked_requirement(
    field: str, value: Any, where: str, fault_at: str | None = None
) -> StatedRequirement:
    """A requirement that is valid by itself; raises the errors of `Requirements`.

    fault_at: the location that the error shows, where it is narrower than `where`.
    """
    try:
        Requirements(**{field: value})
    except InputError as error:
        error.where = fault_at or where
        raise
    return StatedRequirement(field, value, where)


def combined_requirements(stated: Sequence[StatedRequirement]) -> Requirements:
    """All requirements together; raises E108 for one given twice, and E132 as `Requirements`."""
    known: dict[str, StatedRequirement] = {}
    for each in stated:
        if each.field in known:
            raise InputError(
                "E108",
                f"{_SUBJECTS[each.field]} given twice",
                where=one_line(known[each.field].where, each.where),
                help="leave one of the two out",
            )
        known[each.field] = each
    try:
        return Requirements(**{field: each.value for field, each in known.items()})
    except InputError as error:
        # No others contradict each other.
        error.where = one_line(
            *(each.where for each in stated if each.field in ("types", "driver"))
        )
        raise


def requirements_data(requirements: Requirements) -> dict[str, Any]:
    """The table `requirements` of a file with the same ones; empty where there are none."""
    data: dict[str, Any] = {}
    if requirements.transmission_deg:
        data["transmission_deg"] = requirements.transmission_deg
    if requirements.types is not None:
        data["types"] = [name for name in (*TYPES, *GROUPS) if name in requirements.types]
    if requirements.driver != "any":
        data["driver"] = requirements.driver
    if requirements.footprint is not None:
        data["footprint"] = {"polygon": requirements.footprint.vertices.tolist()}
    if requirements.link_ratio != math.inf:
        data["link_ratio"] = requirements.link_ratio
    if requirements.within is not None:
        data["within"] = requirements.within
    if requirements.within_deg is not None:
        data["within_deg"] = requirements.within_deg
    if requirements.any_order:
        data["any_order"] = True
    return data
