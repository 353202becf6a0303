"""How far convex shapes in the plane are from each other.

A shape (n, k, 2) is at n places: a point (k = 1), a segment (2) or a convex polygon,
counter-clockwise.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray


def distance(one: FloatArray, two: FloatArray) -> float:
    """The distance of two features: points (1, 2) or segments (2, 2)."""
    return float(distances(one[None], two[None])[0])


def distances(one: FloatArray, two: FloatArray) -> FloatArray:
    """The distances (n,) of convex polygons, segments or points (n, k, 2) and (n, m, 2)."""
    gap = np.minimum(_corner_gap(one, two), _corner_gap(two, one))
    inside = _cross(one, two) | _within(one[:, 0], two) | _within(two[:, 0], one)
    return np.where(inside, 0.0, gap)


def _sides(shape: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Starts (n, s, 2) of the sides of shapes (n, k, 2), and the ways to their ends."""
    if shape.shape[1] <= 2:
        return shape[:, :1], shape[:, -1:] - shape[:, :1]
    return shape, np.roll(shape, -1, axis=1) - shape


def _corner_gap(points: FloatArray, shape: FloatArray) -> FloatArray:
    """The least distances (n,) of points (n, k, 2) from the sides of shapes (n, m, 2)."""
    start, way = (each[:, None] for each in _sides(shape))
    to = points[:, :, None] - start
    squared = (way * way).sum(axis=-1)
    share = np.divide(
        (to * way).sum(axis=-1),
        squared,
        out=np.zeros(np.broadcast_shapes(to.shape[:-1], squared.shape)),
        where=squared > 0,
    )
    away = to - np.clip(share, 0, 1)[..., None] * way
    return np.asarray(np.linalg.norm(away, axis=-1).min(axis=(1, 2)))


def _cross(one: FloatArray, two: FloatArray) -> NDArray[np.bool_]:
    """Whether (n,) any side of one crosses one of the other."""
    (a, u), (b, v) = _sides(one), _sides(two)
    a, u, b, v = a[:, :, None], u[:, :, None], b[:, None], v[:, None]
    meet = (_turn(u, b - a) * _turn(u, b + v - a) < 0) & (_turn(v, a - b) * _turn(v, a + u - b) < 0)
    return np.asarray(meet.any(axis=(1, 2)))


def _within(points: FloatArray, shape: FloatArray) -> NDArray[np.bool_]:
    """Whether points (n, 2) are inside counter-clockwise polygons (n, k, 2)."""
    if shape.shape[1] <= 2:
        return np.zeros(len(shape), dtype=bool)
    start, way = _sides(shape)
    return np.asarray((_turn(way, points[:, None] - start) > 0).all(axis=1))


def _turn(one: FloatArray, two: FloatArray) -> FloatArray:
    return np.asarray(one[..., 0] * two[..., 1] - one[..., 1] * two[..., 0])
