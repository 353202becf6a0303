"""The coordinates of a dyad that one region limits, and the region's faces among many dyads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.regions import PLANE, Face, Polygon, Region
from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import matvec
from burmester.tasks.limits import Limits

BOUNDARY_ROUNDING = 1e-9  # lengths, or a share of greater ones: a point so far outside is inside
ON_FACE_ROUNDINGS = 10  # times the rounding; a point nearer to a face than this lies on it


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


class FaceConditions(NamedTuple):
    """Linear conditions on dyads z (k, n): rows (k, m, n) · z = at (k, m), where active (k, m).

    inward: (k, w, n), directions from the faces into their regions; zero where there is none.
    """

    rows: FloatArray
    at: FloatArray
    active: NDArray[np.bool_]
    inward: FloatArray

    def gap(self, z: FloatArray) -> FloatArray:
        """By how much (k, m) active conditions are missed."""
        return np.where(self.active, (self.rows @ z[..., None])[..., 0] - self.at, 0.0)


class _Faces(NamedTuple):
    """The faces of a region as arrays, the smallest first; the last one is the inside, or all.

    origin: (F, d); projector: (F, d, d), on their directions; across: (F, d, d), on the others;
    normals: (F, d, d), orthonormal ones of these, zeros behind them.
    inward: (F, w, d), zeros where a face has fewer; dimension, ways: (F,), numbers of directions.
    edges: the numbers (E,) of a polygon's edges, begin, end: (E, d), their ends.
    """

    origin: FloatArray
    projector: FloatArray
    across: FloatArray
    normals: FloatArray
    inward: FloatArray
    dimension: NDArray[np.intp]
    ways: NDArray[np.intp]
    edges: NDArray[np.intp]
    begin: FloatArray
    end: FloatArray


@final
@dataclass(frozen=True, eq=False)
class Block:
    """The coordinates of dyads z (k, n) that one region limits; no region where they are free."""

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

    @property
    def count(self) -> int:
        """The number of its faces."""
        return len(self._faces.dimension)

    @cached_property
    def _faces(self) -> _Faces:
        faces = sorted(self.faces(), key=lambda face: face.basis.shape[1])
        origin = np.stack([face.origin for face in faces])
        projector = np.stack([face.basis @ face.basis.T for face in faces])
        ways = np.array([len(face.inward) for face in faces])
        inward = np.zeros((len(faces), max(1, int(ways.max())), origin.shape[1]))
        for row, face in zip(inward, faces, strict=True):
            row[: len(face.inward)] = face.inward
        dimension = np.array([face.basis.shape[1] for face in faces])
        across = np.eye(origin.shape[1]) - projector
        normals = across.copy()
        for row, face in zip(normals, faces, strict=True):
            if face.basis.shape == (2, 1):
                row[:] = [-face.basis[1, 0], face.basis[0, 0]], [0.0, 0.0]
        edges, begin = np.empty(0, dtype=np.intp), np.empty((0, origin.shape[1]))
        if isinstance(self.region, Polygon):  # sorted by dimension its edges keep their order
            edges, begin = np.flatnonzero(dimension == 1), self.region.vertices
        end = np.roll(begin, -1, axis=0)
        return _Faces(
            origin, projector, across, normals, inward, dimension, ways, edges, begin, end
        )

    def outside(self, z: FloatArray) -> NDArray[np.bool_]:
        """Whether dyads z (*, n) lie outside by more than rounding."""
        return self._lie_outside(z[..., self.at])

    def lying_on(self, z: FloatArray) -> NDArray[np.intp]:
        """The smallest faces (k,) on which dyads inside the region lie."""
        return np.asarray(self._near(z[:, self.at]).argmax(axis=1))

    def past_edges(self, z: FloatArray, on: NDArray[np.intp]) -> NDArray[np.intp]:
        """The faces (k,), or wider ones where dyads have gone along an edge's line past its end.

        At a corner that points into the region the line goes on inside.
        """
        if not isinstance(self.region, Polygon) or self.region.is_convex:
            return on
        now, dimension = self.lying_on(z), self._faces.dimension
        return np.where(dimension[now] > dimension[on], now, on)

    def along(self, on: NDArray[np.intp]) -> FloatArray:
        """The projectors (k, d, d) on the directions of faces."""
        return self._faces.projector[on]

    def projected(self, z: FloatArray, on: NDArray[np.intp]) -> FloatArray:
        """Dyads moved to the nearest points of faces (k,)."""
        origin, moved = self._faces.origin[on], z.copy()
        moved[:, self.at] = origin + matvec(self._faces.projector[on], z[:, self.at] - origin)
        return moved

    def nearest_face(self, z: FloatArray) -> tuple[int, FloatArray]:
        """The number of the face nearest to a dyad (n,) outside, and the dyad moved there."""
        every = np.arange(self.count)
        on = self.projected(np.tile(z, (len(every), 1)), every)
        away = np.where(self.outside(on), np.inf, np.linalg.norm(on - z, axis=-1))
        best = int(away.argmin())
        return best, on[best]

    def conditions(self, on: NDArray[np.intp], size: int) -> FaceConditions:
        """Faces (k,) as conditions on dyads with `size` coordinates; -1 is the last one, too."""
        faces = self._faces
        normals, across = faces.normals[on], faces.inward[on]
        width, free = normals.shape[1], faces.dimension[on, None]
        rows = np.zeros((len(on), width, size))
        inward = np.zeros((len(on), across.shape[1], size))
        rows[..., self.at], inward[..., self.at] = normals, across
        offset = matvec(normals, faces.origin[on])
        return FaceConditions(rows, offset, np.arange(width) < width - free, inward)

    def share_inside(self, z: FloatArray, to: FloatArray) -> FloatArray:
        """The shares (k,) of the ways from dyads to others on which they stay in the region."""
        share, leaves = np.ones(len(z)), self.outside(to)
        # Of a way between two places in a convex region, all is inside.
        straight = not isinstance(self.region, Polygon) or self.region.is_convex
        rows = np.flatnonzero(leaves) if straight else np.arange(len(z))
        if self.region is None or not len(rows):
            return share
        begin, way = z[rows, self.at], (to - z)[rows, self.at]
        normal, offset = self._walls
        with np.errstate(divide="ignore", invalid="ignore"):
            meets = (offset - begin @ normal.T) / (way @ normal.T)
        # Between two places where it meets the line of an edge, all of it is inside or outside.
        meets = np.where((meets > 0) & (meets < 1), meets, 1.0)
        ends = np.zeros((len(rows), 1)), np.sort(meets, axis=1), np.ones((len(rows), 1))
        places = np.concatenate(ends, axis=1)
        middle = (places[:, :-1] + places[:, 1:]) / 2
        outside = self._lie_outside(begin[:, None] + middle[..., None] * way[:, None])
        first = np.where(outside, places[:, :-1], 1.0).min(axis=1)
        last = np.where(places < 1, places, 0.0).max(axis=1)
        share[rows] = np.where(leaves[rows], np.minimum(first, last), first)
        return share

    def steepest_inward(
        self, jacobian: FloatArray, by_distance: FloatArray, on: NDArray[np.intp]
    ) -> tuple[FloatArray, FloatArray]:
        """The directions (k, d) of steepest descent among those from faces into their region.

        jacobian: (k, N, n), by_distance: (k, N), of the objective.
        Returns how steep they are (k,), the objective's derivative as a share of its terms, and
        the directions.
        """
        inward = self._faces.inward[on]
        along = jacobian[..., self.at] @ np.swapaxes(inward, -1, -2)
        terms = (np.abs(by_distance)[:, None] @ np.abs(along))[:, 0]
        steepness = (by_distance[:, None] @ along)[:, 0] / np.maximum(terms, 1e-300)
        best = steepness.argmin(axis=1)
        rows = np.arange(len(on))
        return np.minimum(steepness[rows, best], 0.0), inward[rows, best]

    def wider(self, z: FloatArray, on: NDArray[np.intp], direction: FloatArray) -> NDArray[np.intp]:
        """The smallest faces (k,) that hold those on which dyads lie, and directions (k, d)."""
        faces = self._faces
        off = np.abs(np.einsum("fij,kj->kfi", faces.across, direction)).max(axis=-1)
        larger = faces.dimension > faces.dimension[on, None]
        wider = larger & self._near(z[:, self.at]) & (off < BOUNDARY_ROUNDING)
        return np.asarray(wider.argmax(axis=1))

    @cached_property
    def _walls(self) -> tuple[FloatArray, FloatArray]:
        """Where the region ends: normals (w, d) and offsets (w,) of lines or points."""
        if isinstance(self.region, LengthRange):
            bounds = np.array([self.region.least, self.region.most])
            return np.ones((2, 1)), bounds
        walls = self._faces.ways == 1
        normal = self._faces.inward[walls, 0]
        return normal, (normal * self._faces.origin[walls]).sum(axis=1)

    def _near(self, at: FloatArray) -> NDArray[np.bool_]:
        """Which faces (k, F), whose edges end, points (k, d) lie on, up to rounding."""
        faces, near = self._faces, ON_FACE_ROUNDINGS * _rounding(at)[:, None]
        off = np.einsum("fij,kfj->kfi", faces.across, at[:, None] - faces.origin)
        on = np.abs(off).max(axis=-1) < near
        along = ((at[:, None] - faces.begin) * (faces.end - at[:, None])).sum(axis=-1)
        on[:, faces.edges] &= along > -near * np.linalg.norm(faces.end - faces.begin, axis=-1)
        return np.asarray(on)

    def _lie_outside(self, points: FloatArray) -> NDArray[np.bool_]:
        """Whether points (*, d) lie outside by more than rounding."""
        if self.region is None:
            return np.zeros(points.shape[:-1], dtype=bool)
        return np.asarray(self.region.distance(points) > _rounding(points))


def _rounding(points: FloatArray) -> FloatArray:
    """How far (*,) points (*, d) may lie outside a region by rounding alone: far ones farther."""
    return np.asarray(BOUNDARY_ROUNDING * np.maximum(1.0, np.abs(points).max(axis=-1)))


def circle_blocks(limits: Limits) -> tuple[Block, Block, Block]:
    """What limits say of circles (k, 5): of both pivots and of the length."""
    return (
        Block(slice(0, 2), limits.fixed_pivot),
        Block(slice(2, 4), limits.moving_pivot),
        Block(slice(4, 5), LengthRange(*limits.length)),
    )


def face_numbers(z: FloatArray, blocks: Sequence[Block]) -> NDArray[np.intp]:
    """The numbers (k, blocks) of the smallest faces on which dyads z (k, n) lie."""
    return np.stack([block.lying_on(z) for block in blocks], axis=-1)


def face_conditions(
    blocks: Sequence[Block], numbers: NDArray[np.intp], size: int
) -> FaceConditions:
    """The conditions of dyads (k, size) on the faces of these numbers (k, blocks)."""
    parts = [block.conditions(on, size) for block, on in zip(blocks, numbers.T, strict=True)]
    return FaceConditions(*(np.concatenate(part, axis=1) for part in zip(*parts, strict=True)))
