"""Shapes of the plane by their corners, and how far they are apart.

One corner is a point, two are a segment, more are a simple polygon with its inside, in either
sense.  Shapes of as many corners are one array (*, k, 2).
"""

from __future__ import annotations

import numpy as np

from burmester.geometry.regions import feet, first_meeting
from burmester.geometry.shape_kernel import nearest
from burmester.numerics.arrays import FloatArray


def distances(ones: FloatArray, others: FloatArray, enough: float = 0.0) -> FloatArray:
    """How far shapes (*, k, 2) and (*, m, 2) are apart, (*,), broadcast; 0 where they touch.

    enough: distances up to it may be told as any up to it, which is faster.
    """
    return _nearest(ones, others, enough)[0]


def nearest_points(ones: FloatArray, others: FloatArray) -> FloatArray:
    """The points (*, 2, 2) of shapes (*, k, 2) and (*, m, 2) that are nearest to each other.

    Some common point, twice, where they touch or overlap.
    """
    return _nearest(ones, others, 0.0)[1]


def simplified(corners: FloatArray, tolerance: float) -> FloatArray:
    """Fewer corners (m, 2) of a simple polygon (n, 2), which stays simple.

    No corner is left out that is farther from the new sides than the tolerance (Douglas and Peucker
    1973); where sides would cross, fewer are left out.
    """
    while True:
        few = corners[_corners_kept(corners, tolerance)]
        if len(few) > 2 and (len(few) == len(corners) or first_meeting(few) is None):
            return few
        tolerance /= 2


def _corners_kept(corners: FloatArray, tolerance: float) -> list[int]:
    """The numbers of the corners of a closed curve that are kept, rising."""
    ring = np.concatenate([corners, corners[:1]])
    far = int(np.linalg.norm(corners - corners[0], axis=1).argmax())
    kept, pieces = {0, far}, [(0, far), (far, len(corners))]
    while pieces:
        start, end = pieces.pop()
        between = ring[start + 1 : end]
        if not len(between):
            continue
        apart = np.linalg.norm(between - feet(between, ring[start], ring[end]), axis=1)
        if apart.max() > tolerance:
            middle = start + 1 + int(apart.argmax())
            kept.add(middle)
            pieces += [(start, middle), (middle, end)]
    return sorted(kept)


def _nearest(ones: FloatArray, others: FloatArray, enough: float) -> tuple[FloatArray, FloatArray]:
    shape = np.broadcast_shapes(ones.shape[:-2], others.shape[:-2])
    first = np.broadcast_to(ones, (*shape, *ones.shape[-2:])).reshape(-1, *ones.shape[-2:])
    second = others.reshape(-1, *others.shape[-2:])
    if len(second) != 1:
        second = np.broadcast_to(others, (*shape, *others.shape[-2:])).reshape(
            -1, *others.shape[-2:]
        )
    square, points = np.empty(len(first)), np.empty((len(first), 4))
    nearest(first, second, enough, square, points)
    return np.sqrt(square).reshape(shape), points.reshape(*shape, 2, 2)
