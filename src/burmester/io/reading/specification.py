"""A design specification as a file or the command line states it, and the limits it makes.

Each limit (region of the fixed pivot, region of the moving pivot, length of the link, kinds of
dyads, rail, slot) is stated not at all, once for both dyads of a linkage, or twice, once for each.
A point stated once is for one dyad alone: two dyads that share a pivot only turn about it.  A rail
or slot stated once is for one dyad, too; what such a dyad does not have is then for the other.
A requirement on the whole linkage is stated once: in the file or on the command line.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from burmester.errors import InputError
from burmester.geometry.regions import Point, Region
from burmester.requirements.table import ASKED
from burmester.tasks.limits import Kind, Limits
from burmester.tasks.option_table import LIMIT_OPTIONS
from burmester.tasks.rails import Rail
from burmester.tasks.requirements import Requirements
from burmester.tasks.surroundings import KeepOut, Surroundings

LIMITS = tuple(each.name for each in LIMIT_OPTIONS)
REQUIREMENTS = tuple(each.name for each in ASKED)  # the keys under `requirements` in a file

# What a dyad with a rail and one with a slot have none of, and their kinds.
_LACKING: Mapping[str, tuple[str, ...]] = {
    "rail": ("fixed_pivot", "length", "slot"),
    "slot": ("moving_pivot", "length", "rail"),
}
_KIND: Mapping[str, Kind] = {"rail": "PR", "slot": "RP"}


class StatedRequirement(NamedTuple):
    """One requirement: a field of `Requirements`, its value, and its location."""

    field: str
    value: Any
    where: str


def one_line(*locations: str) -> str:
    """Several locations in one line, without the lines of text that a single one is shown with."""
    known = list(dict.fromkeys(filter(None, locations)))
    return known[0] if len(known) == 1 else ", and ".join(w.partition("\n")[0] for w in known)


class Specification(NamedTuple):
    """Limits as stated, at most two of each, and requirements on the whole linkage.

    where: the locations of the limits, by their names; a requirement has its own.
    """

    fixed_pivot: tuple[Region | None, ...] = ()
    moving_pivot: tuple[Region | None, ...] = ()
    length: tuple[tuple[float, float] | None, ...] = ()
    kinds: tuple[frozenset[Kind] | None, ...] = ()
    rail: tuple[Rail | None, ...] = ()
    slot: tuple[Rail | None, ...] = ()
    where: Mapping[str, str] = MappingProxyType({})
    requirements: tuple[StatedRequirement, ...] = ()

    def merged(self, other: Specification) -> Specification:
        """Both together; raises E108 where they limit the same quantity."""
        for name in LIMITS:
            if getattr(self, name) and getattr(other, name):
                message = f"the {name.replace('_', ' ')} {'are' if name == 'kinds' else 'is'} given"
                raise InputError(
                    "E108",
                    f"{message} twice",
                    where=one_line(self.where.get(name, ""), other.where.get(name, "")),
                    help="leave one of the two out",
                )
        limits: dict[str, Any] = {
            name: getattr(self, name) + getattr(other, name) for name in LIMITS
        }
        return Specification(
            **limits,
            where={**self.where, **other.where},
            requirements=self.requirements + other.requirements,
        )

    def limits(self) -> tuple[Limits, ...]:
        """None; one for both dyads; or one for each.  Raises E131 and E132 as `Limits` does."""
        first, second = self._of(0), self._of(1)
        if not first and not second:
            return ()
        # Compared as objects: the same region stated twice is two regions.
        same = first.keys() == second.keys() and all(first[k] is second[k] for k in first)
        try:
            return tuple(Limits(**each) for each in ([first] if same else [first, second]))
        except InputError as error:
            error.where = error.where or one_line(*self.where.values())
            raise

    @property
    def locations(self) -> str:
        """The locations of the limits, and of the requirements that they may contradict."""
        locations = [self.where.get(name, "") for name in LIMITS if getattr(self, name)]
        fields = ("types", "driver", "footprint")
        return one_line(*locations, *(r.where for r in self.requirements if r.field in fields))

    def _of(self, dyad: int) -> dict[str, Any]:
        """The limits stated for the first dyad (0) or the second (1)."""
        lines = self._lines(dyad)
        other = self._lines(1 - dyad)
        lacking = {name for line in lines for name in _LACKING[line]}
        out: dict[str, Any] = {}
        for name in LIMITS:
            values: Sequence[Any] = getattr(self, name)
            if not values or name in _LACKING:
                continue
            value, shared = values[min(dyad, len(values) - 1)], len(values) == 1
            if shared and name in lacking:
                continue
            if shared and isinstance(value, Point):
                # Of one dyad; of the second where the first has none there.
                first_lacks = any(name in _LACKING[line] for line in (other if dyad else lines))
                if dyad != int(first_lacks):
                    continue
            if (
                shared
                and name == "kinds"
                and not {_KIND[line] for line in lines} <= set(value or ())
            ):
                continue
            if value is not None:
                out[name] = value
        return out | lines

    def _lines(self, dyad: int) -> dict[str, Rail]:
        """The rail or slot stated for a dyad, 0 or 1; one alone is the first's."""
        out = {}
        for name in _LACKING:
            values: tuple[Rail | None, ...] = getattr(self, name)
            own = 1 if name == "slot" and self.rail and len(self.rail) == 1 else 0
            value = None
            if len(values) == 1:
                value = values[0] if dyad == own else None
            elif values:
                value = values[dyad]
            if value is not None:
                out[name] = value
        return out


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
            subject = ASKED[REQUIREMENTS.index(each.field)].subject
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


class StatedSurroundings(NamedTuple):
    """Surroundings as stated: regions, the other fields of `Surroundings`, and where."""

    keep_out: tuple[KeepOut, ...] = ()
    values: Mapping[str, Any] = MappingProxyType({})
    where: str = ""

    def surroundings(self) -> Surroundings | None:
        """The surroundings, or None where nothing is stated."""
        if not self.keep_out and not self.values:
            return None
        return Surroundings(self.keep_out, **self.values)


def surroundings_data(around: Surroundings) -> dict[str, Any]:
    """The surroundings as a file may hold them: the keys `keep_out` and `surroundings`."""
    regions = []
    for each in around.keep_out:
        region: dict[str, Any] = {"polygon": each.polygon.vertices.tolist()}
        regions.append({"name": each.name, **region} if each.name else region)
    values = {
        "link_width": around.link_width,
        "margin": around.margin,
        "body_in_plane": around.body_in_plane,
    }
    return {"keep_out": regions, "surroundings": values}
