"""Downhill within limits: from a dyad that is best on one face to one that no way leads down from.

A dyad z moves along the faces on which it lies (`polish`).  Where that would leave a region it
stops at the edge and goes on along it; where a way into a region leads down it lets go of the edge.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import Misses, Polished
from burmester.geometry.regions import PLANE, Face, Region
from burmester.numerics.arrays import FloatArray

__all__ = ["Block", "Range", "descend", "inside", "lying_on"]

INSIDE = 1e-9  # lengths (or shares of greater ones) outside a region that are rounding
STEP = 100  # times what is rounding, to look across an edge
DOWNHILL = 1e-7  # share of the pull that is rounding
MOVES = 200
TRIES, FINER = 65, 7  # places looked at on the way out of a region, and how often between two

Polish: TypeAlias = Callable[[FloatArray, FloatArray], Polished]
"""From a dyad z a step, or the whole way, to the best along given directions (columns)."""


@final
@dataclass(frozen=True, slots=True, eq=False)
class Range:
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
    """The numbers of a dyad z that one region limits; None where nothing does."""

    at: slice
    region: Region | Range | None

    def faces(self) -> list[Face]:
        """Its faces, each with the origin of its line as near to zero as can be."""
        if self.region is None:
            return [PLANE]
        return [
            face._replace(origin=face.origin - face.basis @ (face.basis.T @ face.origin))
            for face in self.region.faces()
        ]

    def outside(self, z: FloatArray) -> NDArray[np.bool_]:
        """Whether dyads z (*, k) lie outside, rounding apart."""
        if self.region is None:
            return np.zeros(z.shape[:-1], dtype=bool)
        return np.asarray(self.region.distance(z[..., self.at]) > _rounding(z[..., self.at]))


def _rounding(points: FloatArray) -> FloatArray:
    """How far outside (*,) a region points (*, d) are by rounding alone, far away ones more."""
    return np.asarray(INSIDE * np.maximum(1.0, np.abs(points).max(axis=-1)))


def inside(z: FloatArray, blocks: Sequence[Block]) -> bool:
    """Whether a dyad z lies within all limits."""
    return not any(block.outside(z) for block in blocks)


def lying_on(z: FloatArray, blocks: Sequence[Block]) -> list[Face]:
    """The smallest faces on which a dyad z inside all limits lies, one for each block."""
    return [_smallest(z, block, block.faces()) for block in blocks]


def descend(
    z: FloatArray,
    misses: Misses,
    polish: Polish,
    blocks: Sequence[Block],
) -> Polished:
    """The local minimum within limits to which a dyad z inside them leads; not settled: none."""
    on = lying_on(z, blocks)
    for _ in range(MOVES):
        polished = polish(z, _directions(len(z), blocks, on))
        if not np.isfinite(polished.z).all():
            break
        shares = [_share_inside(z, polished.z, block) for block in blocks]
        first = int(np.argmin(shares))
        if shares[first] < 1:
            z = z + shares[first] * (polished.z - z)
            on[first] = _smallest(z, blocks[first], blocks[first].faces())
            z[blocks[first].at] = _onto(on[first], z[blocks[first].at])
            continue
        z = polished.z
        if not polished.settled:
            continue
        slope = misses(z).slope
        ways = [
            _way_down(slope[:, block.at], polished.pull, face)
            for block, face in zip(blocks, on, strict=True)
        ]
        best = int(np.argmin([steep for steep, _ in ways]))
        steep, d = ways[best]
        if steep >= -DOWNHILL:
            return polished
        at = z[blocks[best].at]
        wider = [
            face
            for face in blocks[best].faces()
            if _dimension(face) > _dimension(on[best])
            and _off(face, at) < 10 * _rounding(at)
            and np.abs(d - face.basis @ (face.basis.T @ d)).max() < INSIDE
        ]
        on[best] = min(wider, key=_dimension)
    return polished._replace(settled=False)


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
    """How far of the way from z to another dyad its block stays in its region: 1 is all of it."""
    low, high = 0.0, 1.0
    for _ in range(FINER):
        shares = np.linspace(low, high, TRIES)
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
    near = 10 * float(_rounding(at))

    def on(face: Face) -> bool:
        if _off(face, at) >= near:
            return False
        if face.basis.shape[1] != 1 or len(face.inward) != 1 or block.region is None:
            return True
        across = block.region.distance(at - STEP * near * face.inward[0])
        return bool(across > near)

    return min(filter(on, faces), key=_dimension)


def _dimension(face: Face) -> int:
    return int(face.basis.shape[1])


def _off(face: Face, at: FloatArray) -> float:
    """How far a point (d,) is off a face."""
    return float(np.abs(at - _onto(face, at)).max())


def _onto(face: Face, at: FloatArray) -> FloatArray:
    """The point (d,) of a face that is nearest to another."""
    return np.asarray(face.origin + face.basis @ (face.basis.T @ (at - face.origin)))


def _way_down(slope: FloatArray, pull: FloatArray, face: Face) -> tuple[float, FloatArray]:
    """The steepest way (d,) into a region from a face of it, and how steep it is.

    That is the objective's derivative as a share of what pulls either way, at most 0.
    """
    along = slope @ face.inward.T
    steep = (pull @ along) / np.maximum(np.abs(pull) @ np.abs(along), 1e-300)
    if not len(steep) or steep.min() >= 0:
        return 0.0, np.zeros(slope.shape[1])
    return float(steep.min()), face.inward[steep.argmin()]
