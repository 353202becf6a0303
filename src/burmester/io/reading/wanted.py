"""What a designer wants as it is said, in a file or on the command line, and what it comes to.

Each of the four limits (where the fixed pivot may be, where the moving one, how long the link,
which kinds) is said not at all, once for both dyads of a linkage, or twice, once for each.  A
point said once is for the first dyad alone: two dyads that share a pivot only turn about it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias

from burmester.errors import InputError
from burmester.geometry.regions import Line, Point, Polygon, Region, Segment, box
from burmester.io.reading.asked import Asked, joined
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Kind, Limits

__all__ = ["LIMIT_KEYS", "SHAPES", "TOP_KEYS", "Length", "Wanted", "WantedKinds", "WantedRegion"]

Length: TypeAlias = tuple[float, float]
WantedRegion: TypeAlias = Region | None  # None leaves a dyad free
WantedKinds: TypeAlias = frozenset[Kind] | None

# What stands at the top of a task in a file.
TOP_KEYS = ("poses", "angle_unit", "length_unit", "pose_sigma", "limits", "requirements")

# `limits`, and what may be met beside the poses by mistake, where it would limit nothing
LIMIT_KEYS = ("limits", "limit", "exact", "fixed_pivot", "moving_pivot", "length", "kinds")

_FIELDS = ("fixed_pivot", "moving_pivot", "length", "kinds")

# The word for a region, how many points it takes (None: any number), and what it makes of them.
SHAPES: Mapping[str, tuple[int | None, Callable[[FloatArray], Region]]] = {
    "point": (1, lambda points: Point(points[0])),
    "line": (2, lambda points: Line(*points)),
    "segment": (2, lambda points: Segment(*points)),
    "box": (2, lambda points: box(*points)),
    "polygon": (None, Polygon),
}


class Wanted(NamedTuple):
    """Limits as said, at most two of each, and what is asked of the whole linkage.

    where: the places of the limits, by their names; a requirement has its own.
    """

    fixed_pivot: tuple[WantedRegion, ...] = ()
    moving_pivot: tuple[WantedRegion, ...] = ()
    length: tuple[Length | None, ...] = ()
    kinds: tuple[WantedKinds, ...] = ()
    where: Mapping[str, str] = MappingProxyType({})
    asked: tuple[Asked, ...] = ()

    def joined(self, other: Wanted) -> Wanted:
        """What both say; raises E108 where they limit the same thing."""
        for name in _FIELDS:
            if getattr(self, name) and getattr(other, name):
                what = name.replace("_", " ")
                raise InputError(
                    "E108",
                    f"the {what} is limited twice" if name != "kinds" else "kinds are said twice",
                    where=joined(self.where.get(name, ""), other.where.get(name, "")),
                    help="leave one of the two out",
                )
        return Wanted(
            self.fixed_pivot + other.fixed_pivot,
            self.moving_pivot + other.moving_pivot,
            self.length + other.length,
            self.kinds + other.kinds,
            {**self.where, **other.where},
            self.asked + other.asked,
        )

    def limits(self) -> tuple[Limits, ...]:
        """None; one for both dyads; or one for each.  Raises E131 and E132 as `Limits` does."""
        first, second = self._of(0), self._of(1)
        if not first and not second:
            return ()
        # Compared as objects: the same region said twice is two regions.
        same = first.keys() == second.keys() and all(first[k] is second[k] for k in first)
        try:
            return tuple(Limits(**said) for said in ([first] if same else [first, second]))
        except InputError as error:
            error.where = error.where or joined(*self.where.values())
            raise

    @property
    def places(self) -> str:
        """Where the limits are said, and the requirements that they may contradict."""
        places = [self.where.get(name, "") for name in _FIELDS if getattr(self, name)]
        asked = ("types", "driver", "footprint")
        return joined(*places, *(each.where for each in self.asked if each.field in asked))

    def _of(self, dyad: int) -> dict[str, Any]:
        """What is said of the first dyad (0) or of the second (1)."""
        out = {}
        for name in _FIELDS:
            values: Sequence[Any] = getattr(self, name)
            value = values[min(dyad, len(values) - 1)] if values else None
            shared = len(values) == 1 and dyad == 1
            if value is not None and not (shared and isinstance(value, Point)):
                out[name] = value
        return out
