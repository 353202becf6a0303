"""The limits of a dyad as constraints on linkages while all their dimensions are refined."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.regions import Polygon, Region, half_planes
from burmester.numerics.arrays import FloatArray, complex_of, pairs_of
from burmester.refinement.constraints import QUOTIENTS, ConstraintSlopes, FromSlopes
from burmester.tasks.limits import Limits
from burmester.tasks.rails import Rail

PR_KIND, RP_KIND = 1, 2  # numbers of the kinds in a batch


class KeptPivot(NamedTuple):
    """A pivot's region, in canonical frames.

    at: the number of the pivot's first dimension; line: the kind of dyad that has none there.
    normals (m, 2), offset (m,): what is to be 0 (the first `equations`) or at most 0 is offset +
    normals · point.  polygon: one whose signed distance is, seen from origin in its unit; its rows
    of normals and offset are unused.
    """

    at: int
    line: int
    normals: FloatArray
    offset: FloatArray
    equations: int
    polygon: Polygon | None
    unit: float
    origin: FloatArray

    @classmethod
    def of(cls, region: Region, at: int, line: int, unit: float, origin: FloatArray) -> KeptPivot:
        rows, polygon = half_planes(region), None
        if rows is None:
            assert isinstance(region, Polygon)
            rows, polygon = np.zeros((1, 3)), region
        offset = (rows[:, 0] + rows[:, 1:] @ origin) / unit
        number = len(region.equations())
        return cls(at, line, rows[:, 1:], offset, number, polygon, unit, origin)

    def distances(self, points: FloatArray) -> FloatArray:
        """The distances (k, m) of points (k, 2) outside."""
        if self.polygon is None:
            return np.asarray(points @ self.normals.T + self.offset)
        out = self.polygon.signed_distance(points * self.unit + self.origin) / self.unit
        return np.asarray(out)[:, None]

    def differentiated(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Also the derivatives (k, m, 2)."""
        if self.polygon is None:
            slope = np.broadcast_to(self.normals, (len(points), *self.normals.shape))
            return self.distances(points), slope
        beside = QUOTIENTS.points(points, np.eye(2)[:, None])
        value = self.distances(beside.reshape(-1, 2)).reshape(3, len(points), 1)
        return value[0], QUOTIENTS.jacobian(value)


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadLimitsConstraint(FromSlopes):
    """The limits of the dyad on one side, the same for all linkages."""

    side: int
    limits: Limits
    frames: CanonicalFrames
    ends: FloatArray = field(init=False, repr=False)
    sense: FloatArray = field(init=False, repr=False)
    pivots: tuple[KeptPivot, ...] = field(init=False, repr=False)
    uses_places: ClassVar[bool] = False

    def __post_init__(self) -> None:
        unit, frames = float(self.frames.length), self.frames
        regions = (
            (self.limits.fixed_pivot, 0, 1, frames.fixed_origin),
            (self.limits.moving_pivot, 2, 2, frames.moving_origin),
        )
        pivots = tuple(
            KeptPivot.of(region, at, line, unit, np.asarray(origin))
            for region, at, line, origin in regions
            if region is not None
        )
        object.__setattr__(self, "pivots", pivots)
        ends = np.array(self.limits.length) / unit
        object.__setattr__(self, "ends", ends)
        object.__setattr__(self, "sense", np.where(np.isfinite(ends), [-1.0, 1.0], 0.0))

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """By the dimensions alone."""
        kind, z = batch.kinds[:, self.side], batch.dimensions[:, self.side]
        first, sense = DIMENSIONS * self.side, self.sense
        with np.errstate(invalid="ignore"):
            link = np.where(sense != 0, sense * (z[:, 4:] - self.ends), -1.0)
        rod = (kind == 0)[:, None]
        values, equal = [np.where(rod, link, -1.0)], [np.zeros(2, dtype=bool)]
        slopes = [(slice(first + 4, first + 5), np.where(rod, sense, 0.0)[..., None])]
        for pivot in self.pivots:
            off, by_point = pivot.differentiated(z[:, pivot.at : pivot.at + 2])
            point = (kind != pivot.line)[:, None]
            columns = slice(first + pivot.at, first + pivot.at + 2)
            slopes.append((columns, np.where(point[..., None], by_point, 0.0)))
            values.append(np.where(point, off, 0.0))
            equal.append(np.arange(off.shape[1]) < pivot.equations)
        value, at = np.concatenate(values, axis=1), 0
        slope = np.zeros((*value.shape, place_jacobian.shape[-1]))
        for columns, part in slopes:
            slope[:, at : at + part.shape[1], columns] = part
            at += part.shape[1]
        return value, slope, np.concatenate(equal)


@final
@dataclass(frozen=True, slots=True, eq=False)
class RailConstraint(FromSlopes):
    """The rail (kind PR) or the slot (kind RP) of the dyad on one side, the same for all linkages.

    rail: in the frames of the linkages; travel: of the pin there, None where nothing limits it;
    length: what a radian counts as in rows.
    """

    side: int
    kind: int
    rail: Rail
    travel: KeptPivot | None
    length: float

    @classmethod
    def of(cls, side: int, limits: Limits, frames: CanonicalFrames, length: float) -> Self | None:
        """The constraint that limits on one side set in frames; None without a rail and a slot."""
        if limits.line is None:
            return None
        kind = RP_KIND if limits.rail is None else PR_KIND
        origin = frames.fixed_origin if kind == PR_KIND else frames.moving_origin
        rail = limits.line.moved(np.asarray(origin), float(frames.length))
        travel = None
        if rail.travel is not None:
            travel = KeptPivot.of(rail.travel, 0, 0, 1.0, np.zeros(2))
        return cls(side, kind, rail, travel, length)

    @property
    def uses_places(self) -> bool:
        """Whether the pin's places count."""
        return self.travel is not None

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """By the line's angle and offset, and by whatever moves the pin."""
        z, count = batch.dimensions[:, self.side], len(batch)
        own = (batch.kinds[:, self.side] == self.kind)[:, None]
        at = 0 if self.kind == PR_KIND else 2
        beside = QUOTIENTS.points(z[:, at : at + 2], np.eye(2)[:, None])
        line, equal = self.rail.line_excess(beside[..., 0], beside[..., 1])
        slope = np.zeros((count, line.shape[-1], place_jacobian.shape[-1]))
        first = DIMENSIONS * self.side + at
        slope[..., first : first + 2] = QUOTIENTS.jacobian(line)
        value = line[0]
        if self.travel is not None:
            pins, by_unknown = self._pins(z, rows, place_jacobian)
            off, by_pin = self.travel.differentiated(pins.reshape(-1, 2))
            ends = slice(self.travel.equations, None)  # a segment's line is the rail's
            shape = (count, pins.shape[1])
            off, by_pin = off[:, ends].reshape(*shape, -1), by_pin[:, ends].reshape(*shape, -1, 2)
            side = off.argmax(axis=-1)[..., None]
            worst = np.take_along_axis(off, side, axis=-1)[..., 0]
            by_pin = np.take_along_axis(by_pin, side[..., None], axis=-2)[..., 0, :]
            value = np.concatenate([value, worst], axis=1)
            slope = np.concatenate([slope, np.einsum("knc,knci->kni", by_pin, by_unknown)], axis=1)
            equal = np.concatenate([equal, np.zeros(worst.shape[1], dtype=bool)])
        value = np.where(own, np.nan_to_num(value, nan=-1.0), np.where(equal, 0.0, -1.0))
        return value, np.where(own[..., None], np.nan_to_num(slope), 0.0), equal

    def _pins(
        self, z: FloatArray, rows: FloatArray, place_jacobian: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """The pins (k, N, 2) in the frame of the line, and their derivatives (k, N, 2, n)."""
        on_ground = self.kind == PR_KIND
        turn = np.exp((1j if on_ground else -1j) * rows[..., 2] / self.length)
        own = complex_of(z[:, 2:4] if on_ground else z[:, :2])[:, None]
        place, moved = complex_of(rows), place_jacobian[..., 0, :] + 1j * place_jacobian[..., 1, :]
        pin = place + turn * own if on_ground else turn * (own - place)
        about = turn * own if on_ground else -pin
        by = (moved if on_ground else -turn[..., None] * moved) + (
            1j * about[..., None] * place_jacobian[..., 2, :] / self.length
        )
        first = DIMENSIONS * self.side + (2 if on_ground else 0)
        by[..., first] += turn
        by[..., first + 1] += 1j * turn
        return pairs_of(pin), np.stack([by.real, by.imag], axis=2)
