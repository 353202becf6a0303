"""A design specification as a file or the command line states it, and the limits it makes.

Each limit (region of the fixed pivot, region of the moving pivot, length of the link, kinds of
dyads, rail, slot) is stated not at all, once for both dyads of a linkage, or twice, once for each.
A point stated once is for one dyad alone: two dyads that share a pivot only turn about it.  A rail
or slot stated once is for one dyad, too; what such a dyad does not have is then for the other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias

from burmester.errors import InputError
from burmester.geometry.regions import Line, Point, Polygon, Region, Segment, box
from burmester.io.reading.stated_requirements import StatedRequirement, one_line
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Kind, Limits
from burmester.tasks.option_table import LIMIT_OPTIONS
from burmester.tasks.rails import Rail

LengthRange: TypeAlias = tuple[float, float]
OptionalRegion: TypeAlias = Region | None  # None leaves a dyad free
OptionalKinds: TypeAlias = frozenset[Kind] | None

# The tables at the top of a task in a file, and all keys there.
TABLES = (
    "pose_sigma", "tolerance", "body", "keep_out", "surroundings", "limits", "requirements", "path",
    "crank",
)  # fmt: skip
TOP_KEYS = ("poses", "angle_unit", "length_unit", *TABLES)

LIMITS = tuple(each.name for each in LIMIT_OPTIONS)

# What a dyad with a rail and one with a slot have none of, and their kinds.
_LACKING: Mapping[str, tuple[str, ...]] = {
    "rail": ("fixed_pivot", "length", "slot"),
    "slot": ("moving_pivot", "length", "rail"),
}
_KIND: Mapping[str, Kind] = {"rail": "PR", "slot": "RP"}

# Name of a region: its number of points (None: any number), and its constructor.
SHAPES: Mapping[str, tuple[int | None, Callable[[FloatArray], Region]]] = {
    "point": (1, lambda points: Point(points[0])),
    "line": (2, lambda points: Line(*points)),
    "segment": (2, lambda points: Segment(*points)),
    "box": (2, lambda points: box(*points)),
    "polygon": (None, Polygon),
}


class Specification(NamedTuple):
    """Limits as stated, at most two of each, and requirements on the whole linkage.

    where: the locations of the limits, by their names; a requirement has its own.
    """

    fixed_pivot: tuple[OptionalRegion, ...] = ()
    moving_pivot: tuple[OptionalRegion, ...] = ()
    length: tuple[LengthRange | None, ...] = ()
    kinds: tuple[OptionalKinds, ...] = ()
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
        """The rail or slot stated for the first dyad (0) or the second (1).

        One stated once is for the first; where both are, the slot is for the second.
        """
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
