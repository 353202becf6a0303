"""A plate with its holes and slots, and a pin that joins two; millimetres."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.geometry.outlines import convex_hull, rounded_hull
from burmester.geometry.shapes import distances
from burmester.mechanisms.bodies import LinkPlaces
from burmester.numerics.arrays import FloatArray

ARMS_APART = 2.5  # radii: least distance of an arm's end from the other arm of an angle
SLOT_RUN_OUT = 0.5  # of a hole's diameter: slot beyond each end of the pin's travel


@final
@dataclass(frozen=True, slots=True, eq=False)
class Plate:
    """A flat part in a frame of its own, millimetres.

    name: that of its link; ground-2 is the second plate of the ground, above.  owner: the link that
    it is of, in whose frame all is.
    outline: (k, 3) x, y, bulge, counter-clockwise, closed from the last to the first.
    holes: (h, 3) x, y, diameter.  slots: (s, 5) x, y of both ends' centres, width.
    marks: (m, 2), points to be marked: the body's origin.
    layer: 0 and upwards.  skeleton: (n, 2), convex; the outline is all within `radius` of it, or,
    where the plate is an angle, of its two arms from the `corner`, a number of the skeleton's.
    fixed, moving: of a link between ground and coupler both pivots, in F and in M.
    """

    name: str
    owner: str
    outline: FloatArray
    holes: FloatArray
    slots: FloatArray
    marks: FloatArray
    layer: int
    skeleton: FloatArray
    radius: float
    fixed: FloatArray | None = None
    moving: FloatArray | None = None
    corner: int | None = None

    @property
    def pieces(self) -> tuple[FloatArray, ...]:
        """Convex shapes (n, 2), or arms (2, 2): the plate is all within `radius` of them."""
        if self.corner is None:
            return (self.skeleton,)
        start, corner, end = np.roll(self.skeleton, 1 - self.corner, axis=0)
        return np.stack([start, corner]), np.stack([corner, end])

    @property
    def longest_way(self) -> FloatArray:
        """The way (2,) between the two corners of the skeleton that are farthest apart."""
        ways = self.skeleton[:, None] - self.skeleton
        return np.asarray(ways.reshape(-1, 2)[int((ways**2).sum(axis=-1).argmax())])

    def at(self, places: LinkPlaces) -> Displacement:
        """Where the plate lies (F <- plate) when the links are at places (*,)."""
        return places[self.owner]


@final
@dataclass(frozen=True, slots=True)
class Pin:
    """A pin through layers `low` to `high`, at (x, y) of the plate of that name that holds it.

    joins: the names of the plates that it joins.  name: of the joint, where it has one.
    """

    plate: str
    x: float
    y: float
    diameter: float
    low: int
    high: int
    joins: tuple[str, str]
    name: str = ""


def plate_of(
    features: Sequence[FloatArray],
    *,
    name: str,
    owner: str,
    layer: int,
    radius: float,
    hole: float,
    mark: bool = False,
    fixed: FloatArray | None = None,
    moving: FloatArray | None = None,
    corner: int | None = None,
) -> Plate:
    """A plate around features: centres (1, 2) of holes, end centres (2, 2) of slots.

    radius: between the features' centres and the outline.  hole: the diameter of holes and the
    width of slots.  mark: whether the origin is marked.  corner: of an angle, see `Plate`; a plate
    that is not one of three corners, or too slim for it, is none.
    """
    holes = [[*each[0].tolist(), hole] for each in features if len(each) == 1]
    slots = []
    for each in features:
        if len(each) == 2:
            low, high = each
            size = float(np.linalg.norm(high - low))
            out = (high - low) / size * SLOT_RUN_OUT * hole if size > 0 else np.array([0.0, 0.0])
            slots.append([*(low - out).tolist(), *(high + out).tolist(), hole])
    origin = np.zeros((1, 2)) if mark else np.empty((0, 2))
    ends = [np.reshape(slot[:4], (2, 2)) for slot in slots]
    points = np.concatenate([np.reshape(each[:2], (1, 2)) for each in holes] + ends + [origin])
    skeleton = convex_hull(points)
    outline = rounded_hull(skeleton, radius)
    if corner is not None and _has_arms(skeleton, corner, radius):
        outline = angle_outline(np.roll(skeleton, 1 - corner, axis=0), radius)
    else:
        corner = None
    return Plate(
        name,
        owner,
        outline,
        np.reshape(np.array(holes, dtype=np.float64), (-1, 3)),
        np.reshape(np.array(slots, dtype=np.float64), (-1, 5)),
        origin,
        layer,
        skeleton,
        radius,
        fixed,
        moving,
        corner,
    )


def _has_arms(skeleton: FloatArray, corner: int, radius: float) -> bool:
    """Whether there is room between two arms from a corner of a skeleton."""
    if len(skeleton) != 3:
        return False
    start, at, end = np.roll(skeleton, 1 - corner, axis=0)
    from_arms = np.stack([[at, end], [start, at]])
    return bool(distances(np.stack([[start], [end]]), from_arms).min() > ARMS_APART * radius)


def moved(plate: Plate, by: Displacement) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The outline, holes, slots and marks of a plate, carried by a displacement."""
    outline = np.column_stack([by.act(plate.outline[:, :2]), plate.outline[:, 2]])
    holes = np.column_stack([by.act(plate.holes[:, :2]), plate.holes[:, 2]])
    slots = np.column_stack(
        [by.act(plate.slots[:, :2]), by.act(plate.slots[:, 2:4]), plate.slots[:, 4]]
    )
    return outline, holes, slots, by.act(plate.marks)


def outline_points(shape: Plate | FloatArray, tolerance: float) -> FloatArray:
    """A polygon (n, 2) on the outline of a plate, or on an outline (k, 3), not closed again.

    Its sides leave the arcs by the tolerance at most; the ends of the arcs are among the points.
    """
    return points_on(shape.outline if isinstance(shape, Plate) else shape, tolerance)


def angle_outline(ends: FloatArray, radius: float) -> FloatArray:
    """The outline (7, 3), with bulges, of all within a radius of two arms that meet at a corner.

    ends: (3, 2), of one arm, the corner, of the other arm; they turn to the left, and no end is
    within two radii of the other arm.
    """
    start, corner, end = ends
    one, two = ((each / np.linalg.norm(each)) for each in (corner - start, end - corner))
    out, on = (radius * np.array([each[1], -each[0]]) for each in (one, two))
    turn = math.atan2(one[0] * two[1] - one[1] * two[0], float(one @ two))
    inner = corner - (out + on) / (1 + math.cos(turn))
    rows = [
        (start + out, 0.0),
        (corner + out, math.tan(turn / 4)),
        (corner + on, 0.0),
        (end + on, 1.0),
        (end - on, 0.0),
        (inner, 0.0),
        (start - out, 1.0),
    ]
    return np.array([[*point.tolist(), bulge] for point, bulge in rows])


def slot_outline(slot: FloatArray) -> FloatArray:
    """The outline (k, 3) with bulges of a slot (5,)."""
    ends = convex_hull(np.reshape(slot[:4], (2, 2)))
    return rounded_hull(ends, float(slot[4]) / 2)


def points_on(outline: FloatArray, tolerance: float) -> FloatArray:
    """A polygon (n, 2) on an outline (k, 3), not closed again.

    Its sides leave the arcs by the tolerance at most; the ends of the arcs are among the points.
    """
    points: list[FloatArray] = []
    for start, end in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        points.append(start[:2])
        if (bulge := float(start[2])) == 0:
            continue
        chord = complex(*(end[:2] - start[:2]))
        centre = complex(*start[:2]) + chord * (0.5 + 0.25j * (1 / bulge - bulge))
        angle, r = 4 * math.atan(bulge), abs(complex(*start[:2]) - centre)
        step = 2 * math.acos(max(1 - tolerance / r, 0.0))
        count = max(math.ceil(abs(angle) / step), 1)
        arm = complex(*start[:2]) - centre
        for k in range(1, count):
            z = centre + arm * complex(math.cos(angle * k / count), math.sin(angle * k / count))
            points.append(np.array([z.real, z.imag]))
    return np.array(points)
