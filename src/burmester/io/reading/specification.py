"""A design specification as a file or the command line states it, and the limits it makes.

Each of the four limits (region of the fixed pivot, region of the moving pivot, length of the link,
kinds of dyads) is stated not at all, once for both dyads of a linkage, or twice, once for each.  A
point stated once is for the first dyad alone: two dyads that share a pivot only turn about it.
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

__all__ = [
    "LIMIT_KEYS",
    "SHAPES",
    "TOP_KEYS",
    "LengthRange",
    "OptionalKinds",
    "OptionalRegion",
    "Specification",
]

LengthRange: TypeAlias = tuple[float, float]
OptionalRegion: TypeAlias = Region | None  # None leaves a dyad free
OptionalKinds: TypeAlias = frozenset[Kind] | None

# The keys at the top of a task in a file.
TOP_KEYS = (
    "poses", "angle_unit", "length_unit", "pose_sigma", "tolerance", "body", "keep_out",
    "surroundings", "limits", "requirements", "path",
)  # fmt: skip

# `limits`, and keys that may stand beside the poses by mistake, where they would limit nothing.
LIMIT_KEYS = ("limits", "limit", "exact", "fixed_pivot", "moving_pivot", "length", "kinds")

_FIELDS = ("fixed_pivot", "moving_pivot", "length", "kinds")

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
    where: Mapping[str, str] = MappingProxyType({})
    requirements: tuple[StatedRequirement, ...] = ()

    def merged(self, other: Specification) -> Specification:
        """Both together; raises E108 where they limit the same quantity."""
        for name in _FIELDS:
            if getattr(self, name) and getattr(other, name):
                what = name.replace("_", " ")
                raise InputError(
                    "E108",
                    f"the {what} is limited twice"
                    if name != "kinds"
                    else "the kinds are given twice",
                    where=one_line(self.where.get(name, ""), other.where.get(name, "")),
                    help="leave one of the two out",
                )
        return Specification(
            self.fixed_pivot + other.fixed_pivot,
            self.moving_pivot + other.moving_pivot,
            self.length + other.length,
            self.kinds + other.kinds,
            {**self.where, **other.where},
            self.requirements + other.requirements,
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
        locations = [self.where.get(name, "") for name in _FIELDS if getattr(self, name)]
        fields = ("types", "driver", "footprint")
        return one_line(*locations, *(r.where for r in self.requirements if r.field in fields))

    def _of(self, dyad: int) -> dict[str, Any]:
        """The limits stated for the first dyad (0) or the second (1)."""
        out = {}
        for name in _FIELDS:
            values: Sequence[Any] = getattr(self, name)
            value = values[min(dyad, len(values) - 1)] if values else None
            shared = len(values) == 1 and dyad == 1
            if value is not None and not (shared and isinstance(value, Point)):
                out[name] = value
        return out
