"""Rails: which line the slider of a dyad runs along, and how far its pin goes.

The rail of a PR dyad lies on the ground: its line and the pin's places are seen in F.  The slot of
an RP dyad lies in the body: all of it is seen in M.

E137 (a rail that is malformed), E138 (a rail whose line misses the travel of its pin).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Any, Self, final, get_args

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.geometry.regions import Line, Point, Polygon, Region, Segment
from burmester.numerics.arrays import FloatArray
from burmester.values import real_numbers, require_instance

ROUNDING = 1e-9  # share of coordinates by which a line may miss its travel
DIRECTIONS = 181  # number of directions in which a line may meet its travel
HALF_TURN = 180.0  # degrees, after which a line has the same direction


@final
@dataclass(frozen=True, slots=True, eq=False)
class Rail:
    """The line that a slider runs along, and the places of its pin.

    Parameters
    ----------
    direction_deg : float or None
        Direction of the line in degrees, counter-clockwise from the x axis of its frame; None is
        any direction.
    tolerance_deg : float
        How far the direction may be off, in degrees, from 0 (exact) to less than 90.
    through : Point, Segment, Polygon or None
        What the line passes through.
    travel : Segment, Line, Polygon or None
        Where the pin stays at the poses and between them.  A segment or line is the rail itself: it
        settles the direction and what the line passes through.

    Raises
    ------
    InputError
        E137 (malformed), E138 (no line with that direction and place meets the travel).

    Examples
    --------
    >>> from burmester.geometry.regions import box
    >>> rail = Rail(0, tolerance_deg=2, through=Point([0, 0]), travel=box((0, -5), (400, 5)))
    >>> print(rail)
    at 0° ± 2°, through a point at (0, 0), with its pin in the box from (0, -5) to (400, 5)
    >>> rail.conditions
    2
    """

    direction_deg: float | None = None
    tolerance_deg: float = 0.0
    through: Point | Segment | Polygon | None = None
    travel: Segment | Line | Polygon | None = None

    def __post_init__(self) -> None:
        for name in ("direction_deg", "tolerance_deg"):
            if (value := getattr(self, name)) is not None:
                number = float(real_numbers(value, (), name, code="E137"))
                object.__setattr__(self, name, number)
        for name, other, what in (
            ("through", Line, "a line passes through"),
            ("travel", Point, "a pin travels along"),
        ):
            region = getattr(self, name)
            if region is None:
                continue
            kinds = [kind for kind in get_args(Region) if kind is not other]
            help = f"give a {', a '.join(kind.__name__.lower() for kind in kinds)}, or nothing"
            require_instance(region, get_args(Region), name, help, code="E137")
            if isinstance(region, other):
                message = f"{name} is no region that {what}: {region}"
                raise InputError("E137", message, help=help)
        tolerance = self.tolerance_deg
        if self.direction_deg is None and self.through is None and self.travel is None:
            raise InputError(
                "E137",
                "a rail says neither direction nor a place",
                help="give its direction, what it passes through, or the travel of its pin; "
                "any slider is one of kind PR, any slot one of kind RP",
            )
        if not 0 <= tolerance < HALF_TURN / 2 or (tolerance and self.direction_deg is None):
            of_none = "" if self.direction_deg is not None else " of no direction"
            raise InputError(
                "E137",
                f"a rail's tolerance is {tolerance:g}°{of_none}",
                why="within 90° of a direction lies every direction"
                if tolerance >= HALF_TURN / 2
                else None,
                help="give a direction with a tolerance from 0 to less than 90°, or neither",
            )
        if self.is_thin and (self.direction_deg is not None or self.through is not None):
            raise InputError(
                "E137",
                f"the line of a rail is given twice: its pin stays {self.travel}",
                why="the pin of a straight rail runs along its line",
                help="leave out direction and through, or give the travel as a box",
            )

        self._require_meeting()

    def _require_meeting(self) -> None:
        """Refuse a travel that no line meets with this direction and place: E138."""
        if self.heading is None or self.anchors is None or not isinstance(self.travel, Polygon):
            return
        direction, within = self.heading
        angle = direction + np.pi / 2 + within * np.linspace(-1, 1, DIRECTIONS)
        low, high = self._offsets(angle)
        normal = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        across = normal @ self.travel.vertices.T
        slack = ROUNDING * max(np.abs(self.travel.vertices).max(), np.abs(self.anchors).max())
        beside = np.maximum(across.min(axis=-1) - high, low - across.max(axis=-1))
        if (miss := float(beside.min())) > slack:
            raise InputError(
                "E138",
                f"the line of a rail misses the travel of its pin by {miss:.3g}",
                why=f"the rail is {self}",
                help="widen the travel, move what the rail passes through, or give the direction a "
                "greater tolerance",
            )

    def __str__(self) -> str:
        parts = []
        if self.direction_deg is not None:
            within = f" ± {self.tolerance_deg:g}°" if self.tolerance_deg else ""
            parts.append(f"at {self.direction_deg:g}°{within}")
        if self.through is not None:
            parts.append(f"through a point {self.through}")
        if self.travel is not None:
            parts.append(f"with its pin {self.travel}")
        return ", ".join(parts)

    @property
    def is_thin(self) -> bool:
        """Whether the travel has no width, and so is the line itself."""
        return isinstance(self.travel, Segment | Line)

    @property
    def heading(self) -> tuple[float, float] | None:
        """The direction of the line and how far it may be off, in radians; None for any."""
        if isinstance(self.travel, Segment | Line):
            x, y = self.travel.end - self.travel.start
            return math.atan2(y, x), 0.0
        if self.direction_deg is None:
            return None
        return math.radians(self.direction_deg), math.radians(self.tolerance_deg)

    @property
    def anchors(self) -> FloatArray | None:
        """Points (k, 2) that the line passes through (k = 1) or between; None for anywhere."""
        if isinstance(self.travel, Segment | Line):
            return self.travel.start[None]
        return None if self.through is None else self.through.corners()

    @property
    def conditions(self) -> int:
        """The number of exact conditions: one for a slider, one for each exact part of its line."""
        heading, anchors = self.heading, self.anchors
        exact = heading is not None and heading[1] == 0
        return 1 + exact + (anchors is not None and len(anchors) == 1)

    def moved(self, origin: FloatArray, unit: float) -> Self:
        """The same rail in a frame with another origin (2,) and unit of length."""
        through, travel = (moved_region(each, origin, unit) for each in (self.through, self.travel))
        return replace(self, through=through, travel=travel)

    def line_excess(
        self, normal_angle: FloatArray, offset: FloatArray
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """How far lines (*,) miss direction (radians) and place (length): (*, m), at most 0 is met.

        With a mask (m,) of the values that are to be 0.
        """
        parts: list[FloatArray] = []
        equal: list[bool] = []
        if (heading := self.heading) is not None:
            off = self.turned(normal_angle)
            exact = heading[1] == 0
            parts += [off] if exact else [off - heading[1], -off - heading[1]]
            equal += [True] if exact else [False] * 2
        if self.anchors is not None:
            low, high = self._offsets(normal_angle)
            one = len(self.anchors) == 1
            parts += [low - offset] if one else [offset - high, low - offset]
            equal += [True] if one else [False] * 2
        shape = (*np.shape(normal_angle), len(parts))
        value = np.stack(parts, axis=-1) if parts else np.empty(shape)
        return value, np.array(equal, dtype=bool)

    def turned(self, normal_angle: FloatArray) -> FloatArray:
        """The angles (*,) from the direction asked for to that of lines, -pi/2 to pi/2."""
        assert self.heading is not None
        off = normal_angle - self.heading[0] - np.pi / 2
        return np.asarray(np.mod(off + np.pi / 2, np.pi) - np.pi / 2)

    def passed(self, normal_angle: FloatArray, offset: FloatArray) -> FloatArray:
        """How far lines (*,) pass beside what they are to pass through; 0 where they do not."""
        if self.anchors is None:
            return np.zeros(np.shape(offset))
        low, high = self._offsets(normal_angle)
        return np.asarray(np.maximum(np.maximum(low - offset, offset - high), 0.0))

    def _offsets(self, normal_angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The least and the greatest offset (*,) that lines with normals at angles may have."""
        assert self.anchors is not None
        normal = np.stack([np.cos(normal_angle), np.sin(normal_angle)], axis=-1)
        at = normal @ self.anchors.T
        return at.min(axis=-1), at.max(axis=-1)

    def travel_excess(self, pins: FloatArray) -> FloatArray:
        """How far pins (*, 2) on the line are beyond the travel, (*,); at most 0 within it."""
        if isinstance(self.travel, Polygon):
            return self.travel.signed_distance(pins)
        if isinstance(self.travel, Segment):
            start, end = self.travel.start, self.travel.end
            along = (end - start) / np.linalg.norm(end - start)
            return np.asarray(np.maximum((start - pins) @ along, (pins - end) @ along))
        return np.full(np.shape(pins)[:-1], -np.inf)


def moved_region(region: Any, origin: FloatArray, unit: float) -> Any:
    """A region in a frame with another origin (2,) and unit of length; None of None."""
    if region is None:
        return None
    values = {f.name: (getattr(region, f.name) - origin) / unit for f in fields(region) if f.init}
    return replace(region, **values)
