"""Where a pivot may lie: a region, how to draw points of it, and the way back into it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count as counting
from typing import Final, Self, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.regions import Line, Point, Polygon, Region, Segment, feet
from burmester.numerics.arrays import FloatArray

ZONES: Final = 5  # number of zones, each twice as wide as the one before; beyond, dyads are rare
LEAST_ZONE: Final = 0.25  # of a zone's diagonal; a zone that holds less of the region is left out
TRIES: Final = 40  # number of rounds in which the points of a zone are drawn by rejection

Box: TypeAlias = tuple[FloatArray, FloatArray]  # lower left and upper right corner, (2,)


@final
@dataclass(frozen=True, slots=True, eq=False)
class PivotFreedom:
    """A region with its frame moved to `origin` and the unit `unit`.

    region: the region, in the task's own frame; around: where pivots lie that no region holds.
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

    @property
    def zones(self) -> list[Box]:
        """The boxes in which points of the region are drawn, the innermost first.

        Zones are boxes around the motion, each twice as wide as the one before.  Equally many
        points from each of them are spread evenly over the logarithm of the distance, and what is
        near the motion does not depend on how far the region reaches.
        """
        corners = self.around.vertices
        low, high = corners.min(axis=0), corners.max(axis=0)
        middle, half = (low + high) / 2, (high - low) / 2
        out: list[Box] = []
        for k in counting():
            zone = middle - 2**k * half, middle + 2**k * half
            part, is_whole = _part(self.region, zone)
            if part is not None:
                size = np.linalg.norm(part[1] - part[0])
                if is_whole or size >= LEAST_ZONE * np.linalg.norm(zone[1] - zone[0]):
                    out.append(part)
            if is_whole or (out and k >= ZONES - 1):
                return out
        return out

    def draw(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Points (count, 2) of the region, equally many of each zone, in random order."""
        zones = self.zones
        each = np.bincount(np.arange(count) % len(zones), minlength=len(zones))
        parts = [
            _drawn(self.region, zone, n, rng) for zone, n in zip(zones, each.tolist(), strict=True)
        ]
        own = np.concatenate(parts)
        if len(zones) > 1:
            own = rng.permutation(own)
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
            near, along[outside] = _nearest_on_edges(own[outside], region.vertices)
            back[outside] = (near - self.origin) / self.unit
            return back, along
        if isinstance(region, Point):
            own = np.broadcast_to(region.at, points.shape)
        else:
            endless = isinstance(region, Line)
            own = points * self.unit + self.origin
            own = _foot(own, region.start, region.end, endless=endless)
        return np.asarray((own - self.origin) / self.unit), along


def _part(region: Region, zone: Box) -> tuple[Box | None, bool]:
    """The box that holds the part of a region within a zone, and whether that is all of it."""
    low, high = zone
    if isinstance(region, Line | Segment):
        share = _shares_within(region, zone)
        if share is None:
            return None, False
        ends = region.start + np.array(share)[:, None] * (region.end - region.start)
        is_whole = isinstance(region, Segment) and share == (0.0, 1.0)
    else:
        corners = region.corners()
        is_whole = bool(((corners >= low) & (corners <= high)).all())
        ends = corners if is_whole else _clipped(corners, zone)
    if not len(ends):
        return None, False
    return (ends.min(axis=0), ends.max(axis=0)), is_whole


def _shares_within(region: Line | Segment, zone: Box) -> tuple[float, float] | None:
    """From where to where, in shares of its two points, a line is within a zone."""
    along = region.end - region.start
    first, last = (-np.inf, np.inf) if isinstance(region, Line) else (0.0, 1.0)
    for axis in range(2):
        if along[axis] == 0:
            if not zone[0][axis] <= region.start[axis] <= zone[1][axis]:
                return None
            continue
        ends = [float((side[axis] - region.start[axis]) / along[axis]) for side in zone]
        first, last = max(first, min(ends)), min(last, max(ends))
    return (first, last) if first <= last else None


def _clipped(corners: FloatArray, zone: Box) -> FloatArray:
    """The corners (k, 2) of the part of a polygon within a box (Sutherland and Hodgman)."""
    for axis in range(2):
        for side, sign in zip(zone, (1, -1), strict=True):
            inside = sign * (corners[:, axis] - side[axis])
            out = []
            for k in range(len(corners)):
                if (inside[k - 1] < 0) != (inside[k] < 0):
                    share = inside[k - 1] / (inside[k - 1] - inside[k])
                    out.append(corners[k - 1] + share * (corners[k] - corners[k - 1]))
                if inside[k] >= 0:
                    out.append(corners[k])
            corners = np.reshape(out, (-1, 2))
    return corners


def _drawn(region: Region, zone: Box, count: int, rng: np.random.Generator) -> FloatArray:
    """Points (count, 2), even over a region's part in a zone; of thin polygons on their edges."""
    if isinstance(region, Point):
        return np.broadcast_to(region.at, (count, 2))
    if isinstance(region, Line | Segment):
        first, last = _shares_within(region, zone) or (0.0, 1.0)
        share = first + (last - first) * rng.uniform(size=(count, 1))
        return np.asarray(region.start + share * (region.end - region.start))
    found = np.empty((0, 2))
    for _ in range(TRIES):
        points = rng.uniform(*zone, size=(2 * count, 2))
        found = np.concatenate([found, points[region.signed_distance(points) <= 0]])
        if len(found) >= count:
            return found[:count]
    near, _ = _nearest_on_edges(points[: count - len(found)], region.vertices)
    return np.concatenate([found, near])


def _outside(points: FloatArray, polygon: Polygon) -> NDArray[np.bool_]:
    """Which points (k, 2) lie outside a polygon."""
    if not polygon.is_convex:
        return np.asarray(polygon.signed_distance(points) > 0)
    return np.asarray((points @ polygon.outward > polygon.reach).any(axis=1))


def _foot(points: FloatArray, start: FloatArray, end: FloatArray, *, endless: bool) -> FloatArray:
    """The points of the line or segment nearest to points (*, 2)."""
    along = end - start
    share = ((points - start) @ along) / (along @ along)
    if not endless:
        share = share.clip(0, 1)
    return np.asarray(start + share[..., None] * along)


def _nearest_on_edges(points: FloatArray, vertices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The points of a polygon's edges nearest to points (k, 2), and the edges' projectors."""
    ends = np.roll(vertices, -1, axis=0)
    near, along = feet(points[:, None], vertices, ends), ends - vertices
    best = ((near - points[:, None]) ** 2).sum(axis=-1).argmin(axis=1)
    square = (along * along).sum(axis=-1)
    projectors = along[:, :, None] * along[:, None, :] / square[:, None, None]
    return near[np.arange(len(points)), best], projectors[best]
