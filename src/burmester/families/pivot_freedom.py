"""Where a pivot may lie: a region, how to draw points of it, and the way back into it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.regions import Line, Point, Polygon, Region, Segment
from burmester.numerics.arrays import FloatArray

__all__ = ["PivotFreedom"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class PivotFreedom:
    """A region with its frame moved to `origin` and the unit `unit`.

    region: the region, in the task's own frame; around: a polygon that cuts off what is endless.
    """

    region: Region
    around: Polygon
    origin: FloatArray
    unit: float

    @classmethod
    def of(cls, region: Region | None, around: Polygon, origin: FloatArray, unit: float) -> Self:
        """The freedom of a pivot within a region, or within `around` where there is none."""
        return cls(around if region is None else region, around, origin, unit)

    @property
    def projector(self) -> FloatArray:
        """The directions (2, 2) in which the pivot moves freely: none at a point, one on a line."""
        rows = self.region.equations()
        if not len(rows):
            return np.eye(2)
        if len(rows) == 2:
            return np.zeros((2, 2))
        return np.eye(2) - np.outer(rows[0, 1:], rows[0, 1:]) / (rows[0, 1:] @ rows[0, 1:])

    def draw(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Points (count, 2) of the region, evenly spread over it."""
        region = self.region
        if isinstance(region, Point):
            own = np.broadcast_to(region.at, (count, 2))
        elif isinstance(region, Segment):
            share = rng.uniform(size=(count, 1))
            own = region.start + share * (region.end - region.start)
        elif isinstance(region, Line):
            own = _foot(_drawn(self.around, count, rng), region.start, region.end, endless=True)
        else:
            own = _drawn(region, count, rng)
        return np.asarray((own - self.origin) / self.unit)

    def nearest(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The points of the region nearest to points (k, 2), and how they may move (k, 2, 2).

        A point from outside may move along the edge that it comes to.
        """
        region = self.region
        along = np.broadcast_to(self.projector, (*points.shape, 2)).copy()
        if isinstance(region, Polygon):
            own = points * self.unit + self.origin
            outside = _outside(own, region)
            if not outside.any():
                return points, along
            back = points.copy()
            feet, along[outside] = _nearest_on_edges(own[outside], region.vertices)
            back[outside] = (feet - self.origin) / self.unit
            return back, along
        if isinstance(region, Point):
            own = np.broadcast_to(region.at, points.shape)
        else:
            endless = isinstance(region, Line)
            own = points * self.unit + self.origin
            own = _foot(own, region.start, region.end, endless=endless)
        return np.asarray((own - self.origin) / self.unit), along


def _drawn(polygon: Polygon, count: int, rng: np.random.Generator) -> FloatArray:
    """Points (count, 2) of the inside of a polygon, by rejection from its box."""
    low, high = polygon.vertices.min(axis=0), polygon.vertices.max(axis=0)
    found = np.empty((0, 2))
    while len(found) < count:
        points = rng.uniform(low, high, size=(2 * count, 2))
        found = np.concatenate([found, points[polygon.signed_distance(points) <= 0]])
    return found[:count]


def _outside(points: FloatArray, polygon: Polygon) -> NDArray[np.bool_]:
    """Which points (k, 2) lie outside a polygon."""
    if not polygon.is_convex:
        return np.asarray(polygon.signed_distance(points) > 0)
    x, y = np.roll(polygon.vertices, -1, axis=0).T - polygon.vertices.T
    outward = np.stack([y, -x])  # the corners go round counterclockwise
    beyond = points @ outward > (polygon.vertices * outward.T).sum(axis=1)
    return np.asarray(beyond.any(axis=1))


def _foot(points: FloatArray, start: FloatArray, end: FloatArray, *, endless: bool) -> FloatArray:
    """The points of the line or segment nearest to points (*, 2)."""
    along = end - start
    share = ((points - start) @ along) / (along @ along)
    if not endless:
        share = share.clip(0, 1)
    return np.asarray(start + share[..., None] * along)


def _nearest_on_edges(points: FloatArray, vertices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The points of a polygon's edges nearest to points (k, 2), and the edges' projectors."""
    along = np.roll(vertices, -1, axis=0) - vertices
    square = (along * along).sum(axis=-1)
    share = ((points[:, None] - vertices) * along).sum(axis=-1) / square
    feet = vertices + share.clip(0, 1)[..., None] * along
    best = ((feet - points[:, None]) ** 2).sum(axis=-1).argmin(axis=1)
    projectors = along[:, :, None] * along[:, None, :] / square[:, None, None]
    return feet[np.arange(len(points)), best], projectors[best]
