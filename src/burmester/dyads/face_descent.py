"""Active-set descent over faces: from a dyad within limits down to a local minimum within them.

A dyad z moves along the faces on which it lies (`minimise`).  Where that would leave a region it
stops at the edge and goes on along it; where a direction into a region leads down it leaves the
edge.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import DistanceFunction, GeometricFit
from burmester.geometry.regions import PLANE, Face, Polygon, Region
from burmester.numerics.arrays import FloatArray

__all__ = ["Block", "LengthRange", "descend", "inside", "lying_on"]

BOUNDARY_ROUNDING = 1e-9  # lengths, or a share of greater ones: a point so far outside is inside
ON_FACE_ROUNDINGS = 10  # times the rounding; a point nearer to a face than this lies on it
ACROSS_ROUNDINGS = 100  # times the distance from a face, to look whether a step across leads out
STEEPNESS_ROUNDING = 1e-7  # share of the terms of a directional derivative that is rounding
MAX_MOVES = 200  # along a face, or from one face to another
BRACKETING_ROUNDS, BRACKETING_SAMPLES = 7, 65  # to find where a step leaves a region

Minimise: TypeAlias = Callable[[FloatArray, FloatArray], GeometricFit]
"""From a dyad z a step, or the whole way, to the minimum along given directions (columns)."""


@final
@dataclass(frozen=True, slots=True, eq=False)
class LengthRange:
    """A link's length from least to most: a region of one dimension."""

    least: float
    most: float

    def faces(self) -> list[Face]:
        """Between the bounds, and at each."""
        between = Face(np.zeros(1), np.eye(1), np.empty((0, 1)))
        if self.least == self.most:
            return [Face(np.array([self.least]), np.empty((1, 0)), np.empty((0, 1)))]
        ends = ((self.least, 1.0), (self.most, -1.0))
        return [between] + [
            Face(np.array([at]), np.empty((1, 0)), np.array([[inward]]))
            for at, inward in ends
            if 0 < at < np.inf
        ]

    def distance(self, points: FloatArray) -> FloatArray:
        """How far lengths (*, 1) lie outside it, (*,)."""
        return np.maximum(np.maximum(self.least - points, points - self.most), 0.0)[..., 0]


class Block(NamedTuple):
    """The coordinates of a dyad z that one region limits; no region where they are free."""

    at: slice
    region: Region | LengthRange | None

    def faces(self) -> list[Face]:
        """Its faces, each with the origin of its line as near to zero as can be."""
        if self.region is None:
            return [PLANE]
        return [
            face._replace(origin=face.origin - face.basis @ (face.basis.T @ face.origin))
            for face in self.region.faces()
        ]

    def outside(self, z: FloatArray) -> NDArray[np.bool_]:
        """Whether dyads z (*, k) lie outside by more than rounding."""
        if self.region is None:
            return np.zeros(z.shape[:-1], dtype=bool)
        return np.asarray(self.region.distance(z[..., self.at]) > _rounding(z[..., self.at]))


def _rounding(points: FloatArray) -> FloatArray:
    """How far (*,) points (*, d) may lie outside a region by rounding alone: far ones farther."""
    return np.asarray(BOUNDARY_ROUNDING * np.maximum(1.0, np.abs(points).max(axis=-1)))


def inside(z: FloatArray, blocks: Sequence[Block]) -> bool:
    """Whether a dyad z lies within all limits."""
    return not any(block.outside(z) for block in blocks)


def lying_on(z: FloatArray, blocks: Sequence[Block]) -> list[Face]:
    """The smallest faces on which a dyad z inside all limits lies, one for each block."""
    return [_smallest(z, block, block.faces()) for block in blocks]


def descend(
    z: FloatArray,
    distances: DistanceFunction,
    minimise: Minimise,
    blocks: Sequence[Block],
    *,
    may_leave: bool = True,
) -> GeometricFit:
    """The local minimum within limits to which a dyad z inside them leads.

    may_leave: whether it may leave an edge into the region.
    Not settled where there is none.
    """
    on = lying_on(z, blocks)
    for _ in range(MAX_MOVES):
        fit = minimise(z, _directions(len(z), blocks, on))
        if not np.isfinite(fit.z).all():
            break
        shares = [_share_inside(z, fit.z, block) for block in blocks]
        first = int(np.argmin(shares))
        if shares[first] < 1:
            z = z + shares[first] * (fit.z - z)
            on[first] = _smallest(z, blocks[first], blocks[first].faces())
            z[blocks[first].at] = _projection(on[first], z[blocks[first].at])
            continue
        z = fit.z
        if not fit.settled:
            continue
        jacobian = distances(z).jacobian
        inward = [
            _steepest_inward(jacobian[:, block.at], fit.by_distance, face)
            for block, face in zip(blocks, on, strict=True)
        ]
        best = int(np.argmin([steepness for steepness, _ in inward]))
        steepness, direction = inward[best]
        if steepness >= -STEEPNESS_ROUNDING:
            return fit
        if not may_leave:
            break
        at = z[blocks[best].at]
        wider = [
            face
            for face in blocks[best].faces()
            if _dimension(face) > _dimension(on[best])
            and _distance(face, at) < ON_FACE_ROUNDINGS * _rounding(at)
            and _holds(face, direction)
        ]
        on[best] = min(wider, key=_dimension)
    return fit._replace(settled=False)


def _directions(size: int, blocks: Sequence[Block], faces: Sequence[Face]) -> FloatArray:
    """The directions (size, k) in which a dyad z (size,) may move."""
    limited = {i for block in blocks for i in range(block.at.start, block.at.stop)}
    columns = [np.eye(size)[i] for i in range(size) if i not in limited]
    for block, face in zip(blocks, faces, strict=True):
        for along in face.basis.T:
            columns.append(np.zeros(size))
            columns[-1][block.at] = along
    return np.array(columns).reshape(-1, size).T


def _share_inside(z: FloatArray, to: FloatArray, block: Block) -> float:
    """The share of the way from z to another dyad on which a block stays in its region."""
    if block.region is None:
        return 1.0
    straight = not isinstance(block.region, Polygon) or block.region.is_convex
    if straight and not block.outside(to):  # so is all between
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(BRACKETING_ROUNDS):
        shares = np.linspace(low, high, BRACKETING_SAMPLES)
        outside = block.outside(z + shares[:, None] * (to - z))
        if not outside.any():
            return high
        first = int(outside.argmax())
        low, high = shares[max(first - 1, 0)], shares[first]
    return float(low)


def _smallest(z: FloatArray, block: Block, faces: Sequence[Face]) -> Face:
    """The smallest of some faces of a block on which a dyad z lies.

    The line of an edge may go on through a polygon that is not convex, or meet another edge.
    There a step across it does not lead out, and z is not on that edge.
    """
    at = z[block.at]
    near = ON_FACE_ROUNDINGS * float(_rounding(at))

    def on(face: Face) -> bool:
        if _distance(face, at) >= near:
            return False
        if face.basis.shape[1] != 1 or len(face.inward) != 1 or block.region is None:
            return True
        across = block.region.distance(at - ACROSS_ROUNDINGS * near * face.inward[0])
        return bool(across > near)

    return min(filter(on, faces), key=_dimension)


def _dimension(face: Face) -> int:
    return int(face.basis.shape[1])


def _distance(face: Face, at: FloatArray) -> float:
    """The greatest coordinate of the way from a point (d,) to a face."""
    return float(np.abs(at - _projection(face, at)).max())


def _holds(face: Face, direction: FloatArray) -> bool:
    """Whether a unit direction (d,) lies in a face."""
    off = direction - face.basis @ (face.basis.T @ direction)
    return bool(np.abs(off).max() < BOUNDARY_ROUNDING)


def _projection(face: Face, at: FloatArray) -> FloatArray:
    """The point (d,) of a face that is nearest to another."""
    return np.asarray(face.origin + face.basis @ (face.basis.T @ (at - face.origin)))


def _steepest_inward(
    jacobian: FloatArray, by_distance: FloatArray, face: Face
) -> tuple[float, FloatArray]:
    """The direction (d,) of steepest descent among those from a face into its region.

    Returns how steep it is, the objective's derivative as a share of its terms, at most 0, and
    the direction.
    """
    along = jacobian @ face.inward.T
    steepness = (by_distance @ along) / np.maximum(np.abs(by_distance) @ np.abs(along), 1e-300)
    if not len(steepness) or steepness.min() >= 0:
        return 0.0, np.zeros(jacobian.shape[1])
    return float(steepness.min()), face.inward[steepness.argmin()]
