"""Outlines of flat parts: closed polylines whose bulges make arcs exact.

Rows (x, y, bulge) as in DXF: the bulge, the tangent of a quarter of the arc's angle, says how the
way to the next point bends (0 straight, 1 half a circle to the left).
"""

from __future__ import annotations

import math

import numpy as np
import shapely

from burmester.geometry.outlines import convex_hull, rounded_hull
from burmester.numerics.arrays import FloatArray


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


def distances(one: FloatArray, two: FloatArray) -> FloatArray:
    """The distances (*,) of shapes (*, k, 2) and (*, m, 2), 0 where they overlap.

    A shape is a point (k = 1), a segment (2), or the corners of a convex polygon in their order.
    """
    return np.asarray(shapely.distance(_shapes(one), _shapes(two)))


def _shapes(points: FloatArray) -> object:
    if points.shape[-2] == 1:
        return shapely.points(points[..., 0, :])
    return (shapely.linestrings if points.shape[-2] == 2 else shapely.polygons)(points)
