"""How far convex shapes in the plane are from each other."""

from __future__ import annotations

import numpy as np
import shapely

from burmester.numerics.arrays import FloatArray


def distances(one: FloatArray, two: FloatArray) -> FloatArray:
    """The distances (*,) of shapes (*, k, 2) and (*, m, 2), 0 where they overlap.

    A shape is a point (k = 1), a segment (2), or the corners of a convex polygon in their order.
    """
    return np.asarray(shapely.distance(_shapes(one), _shapes(two)))


def _shapes(points: FloatArray) -> object:
    if points.shape[-2] == 1:
        return shapely.points(points[..., 0, :])
    return (shapely.linestrings if points.shape[-2] == 2 else shapely.polygons)(points)
