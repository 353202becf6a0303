"""Requirements on the whole linkage as a file or the command line states them.

Each requirement is stated once: in the file or on the command line.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from burmester.errors import InputError
from burmester.requirements.table import ASKED
from burmester.tasks.requirements import Requirements

FILE_KEYS = tuple(each.name for each in ASKED)  # under `requirements` in a file


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
            subject = ASKED[FILE_KEYS.index(each.field)].subject
            raise InputError(
                "E108",
                f"{subject} given twice",
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
    return {each.name: each.plain(bound) for each, bound in requirements.bounds.items()}
