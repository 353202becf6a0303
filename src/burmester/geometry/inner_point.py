"""A point well inside a polygon, convex or not: where its name is written."""

from __future__ import annotations

import numpy as np

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
    start, end = vertices, np.roll(vertices, -1, axis=0)
    low, high = start.min(axis=0), start.max(axis=0)
    share = (np.arange(GRID_SIDE) + 0.5) / GRID_SIDE
    x, y = (low + share[:, None] * (high - low)).T
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 1, 2)
    # The rays to the right of a point inside cross an odd number of edges.
    across = (start[:, 1] > points[..., 1]) != (end[:, 1] > points[..., 1])
    rise = np.where(end[:, 1] == start[:, 1], 1.0, end[:, 1] - start[:, 1])
    at = start[:, 0] + (points[..., 1] - start[:, 1]) / rise * (end[:, 0] - start[:, 0])
    inside = (across & (points[..., 0] < at)).sum(axis=1) % 2 == 1
    if not inside.any():
        return np.asarray((start[0] + end[0]) / 2)
    way = end - start
    along = ((points - start) * way).sum(axis=-1) / (way * way).sum(axis=-1)
    foot = start + np.clip(along, 0, 1)[..., None] * way
    away = np.linalg.norm(points - foot, axis=-1).min(axis=1)
    deep = inside & (away >= AS_DEEP * away[inside].max())
    off = np.linalg.norm(points[:, 0] - (low + high) / 2, axis=-1)
    return np.asarray(points[int(np.where(deep, off, np.inf).argmin()), 0])
