"""Regions as linear conditions on a point: each side, and each end, one by itself."""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.geometry.regions import Polygon, Region
from burmester.numerics.arrays import FloatArray

MAX_SIDES: Final = 8  # number of sides of a convex polygon that are conditions each


def half_planes(region: Region) -> FloatArray | None:
    """Rows (m, 3) whose product with (1, X, Y) is 0 (the region's equations) or at most 0 in it.

    Each side of a convex polygon is one by itself: its distance has a kink at a corner, where a
    descent would be held.  None for other polygons, and such with many sides.
    """
    if isinstance(region, Polygon):
        return _sides(region)
    rows, ends = region.equations(), region.corners()
    if len(rows) == 2:
        return rows
    beyond = np.array([[-1.0, 0.0, 0.0]] * 2)
    if ends is not None:
        along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        beyond = np.array([[ends[0] @ along, *-along], [-ends[1] @ along, *along]])
    return np.concatenate([rows, beyond])


def _sides(polygon: Polygon) -> FloatArray | None:
    """The sides of a convex polygon, (k, 3): row · (1, X, Y) at most 0; else None."""
    v = polygon.corners()
    along = np.roll(v, -1, axis=0) - v
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    after = np.roll(along, -1, axis=0)
    turn = along[:, 0] * after[:, 1] - along[:, 1] * after[:, 0]
    if len(v) > MAX_SIDES or (turn < 0).any():
        return None
    outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
    return np.column_stack([-(outward * v).sum(axis=1), outward])
