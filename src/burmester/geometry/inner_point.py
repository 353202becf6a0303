"""A point well inside a polygon, convex or not: where its name is written."""

from __future__ import annotations

import numpy as np

from burmester.geometry.regions import outside_corners
from burmester.numerics.arrays import FloatArray

GRID_SIDE = 40  # points along a side of the grid; the point is the best of these, not the very best
AS_DEEP = (
    0.95  # of the greatest depth: of points as deep as that the one nearest to the middle is taken
)


def inner_point(vertices: FloatArray) -> FloatArray:
    """The point (2,) of a grid over a polygon (n, 2) that is about the farthest from its edges.

    The vertices stand in order around it, in either sense.  Of points about as far the one nearest
    to the middle of the vertices' box is taken.  The point lies inside the polygon, unless that is
    thinner than the grid is fine: then it is the middle of an edge.
    """
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    share = (np.arange(GRID_SIDE) + 0.5) / GRID_SIDE
    x, y = (low + share[:, None] * (high - low)).T
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    depth = -outside_corners(points, vertices)
    if not (depth > 0).any():
        return np.asarray((vertices[0] + vertices[1]) / 2)
    off = np.linalg.norm(points - (low + high) / 2, axis=-1)
    deep = depth >= AS_DEEP * depth.max()
    return np.asarray(points[int(np.where(deep, off, np.inf).argmin())])
