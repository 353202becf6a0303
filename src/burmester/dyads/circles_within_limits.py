"""The best RR dyads within limits, on every pair of faces of the pivots' regions."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.critical_points import residual_rows
from burmester.dyads.face_search import Descents, FaceSearch
from burmester.dyads.geometric_fit import circle_distances
from burmester.dyads.limited_block import circle_blocks
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Face
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import concatenate
from burmester.numerics.linear_algebra import matvec
from burmester.polynomials.bilinear_fit import Condition, Parameters, Shape, circle_shape
from burmester.polynomials.stationary_points import StationaryPoints
from burmester.tasks.limits import Limits

START_LENGTH = 20.0  # characteristic lengths; the links that start along a line

_CIRCLE = circle_shape(2, 2, 0, "none")


class _Faces(NamedTuple):
    """The faces on which the pivots and the length of an RR dyad lie."""

    fixed: Face
    moving: Face
    length: Face

    @property
    def free(self) -> tuple[int, int, int]:
        """In how many dimensions the fixed pivot, the moving pivot and the length are free."""
        i, j, k = (face.basis.shape[1] for face in self)
        return i, j, k


class _FaceArrays(NamedTuple):
    """The faces of many pairs, M in number, that are free in as many dimensions each.

    origin: (M, 5), of both pivots and the length; fixed: (M, 2, i), moving: (M, 2, j), bases;
    free_length: (M,), whether the length is free.
    """

    origin: FloatArray
    fixed: FloatArray
    moving: FloatArray
    free_length: NDArray[np.bool_]

    @classmethod
    def of(cls, members: list[_Faces]) -> _FaceArrays:
        """Those of a list."""
        origin = np.array([np.concatenate([face.origin for face in faces]) for faces in members])
        fixed, moving = (np.stack([faces[k].basis for faces in members]) for k in (0, 1))
        free = np.array([faces.length.basis.shape[1] == 1 for faces in members])
        return cls(origin, fixed, moving, free)

    @property
    def along(self) -> FloatArray:
        """The projectors (M, 5, 5) on the directions in which circles may move along them."""
        out = np.zeros((len(self.origin), 5, 5))
        out[:, :2, :2] = self.fixed @ np.swapaxes(self.fixed, -1, -2)
        out[:, 2:4, 2:4] = self.moving @ np.swapaxes(self.moving, -1, -2)
        out[:, 4, 4] = self.free_length
        return out

    def circles(
        self, points: FloatArray, at: NDArray[np.intp], poses: Displacement, search: FaceSearch
    ) -> FloatArray:
        """The circles z (k, 5) of points (k, i + j) of the pairs at (k,), of the best length."""
        z, share = self.origin[at].copy(), search.exact_or_share
        i = self.fixed.shape[-1]
        z[:, :2] += matvec(self.fixed[at], points[:, :i])
        z[:, 2:4] += matvec(self.moving[at], points[:, i:])

        def best_length(pivots: FloatArray) -> FloatArray:
            centred = RR(pivots[:, :2], pivots[:, 2:], np.zeros(len(pivots)))
            return np.asarray(centred[:, None].residual(poses) @ share / share.sum())

        best = search.in_batches(best_length, z[:, :4])
        z[:, 4] = np.where(self.free_length[at], best, z[:, 4])
        return z

    def far_points(
        self, poses: Displacement, share: FloatArray
    ) -> tuple[FloatArray, NDArray[np.intp]]:
        """Points (k, i + j) of long links that nearly follow the best lines, and whose (k,).

        Where a pivot is free along one line, it is far off on either side of it.
        """
        every, root = np.arange(len(self.origin)), np.sqrt(share)
        c, m = self.origin[:, :2], self.origin[:, 2:4]
        ways = (self.fixed, self.moving, m, poses), (self.moving, self.fixed, c, poses.inverse())
        points = [np.empty((0, self.fixed.shape[-1] + self.moving.shape[-1]))]
        for k, (far, near, at, motion) in enumerate(ways):
            if far.shape[-1] != 1:
                continue
            normal = far  # (M, 2, 1), by which all is multiplied across the line
            columns = motion[None, :, None].rotate(np.swapaxes(near, -1, -2)[:, None])
            across = motion.act(at[:, None]) @ normal
            ones = np.ones((*across.shape[:2], 1))
            rows = np.concatenate([(columns @ normal[:, None])[..., 0], ones], axis=-1)
            inverse = np.linalg.pinv(root[:, None] * rows)
            best = -matvec(inverse, root * across[..., 0])[:, :-1]
            for away in (-START_LENGTH, START_LENGTH):
                parts = [np.full((len(every), 1), away), best]
                points.append(np.concatenate(parts if k == 0 else parts[::-1], axis=-1))
        return np.concatenate(points), np.tile(every, len(points) - 1)


class _Starts(NamedTuple):
    """Circles z (k, 5) from which ways lead down, and in which directions.

    along: (k, 5, 5), the projectors on the directions of their faces; minimum: (k,), which are
    minima of the squared residual there.
    """

    z: FloatArray
    along: FloatArray
    minimum: NDArray[np.bool_]


def circles_within_limits(seen: Displacement, limits: Limits, search: FaceSearch) -> FloatArray:
    """The best RR dyads z (k, 5), c, m, r, of poses (N,), by rising error."""
    base, gram, conditions = search.centre(residual_rows(seen))
    blocks = circle_blocks(limits)
    descents = Descents(search, circle_distances(seen), blocks, np.empty((0, 5)))
    systems: dict[Shape, list[tuple[list[_Faces], Parameters]]] = {}
    corners: list[_Faces] = []
    regions = (_by_dimension(block.faces()) for block in blocks[:2])
    for (i, fixed), (j, moving) in product(*regions):
        pairs = list(product(fixed, moving))
        at, features = _circle_maps(pairs)
        back = np.swapaxes(features, 1, 2)
        gram_of_faces, rows, linear = back @ gram @ features, conditions @ features, back @ base
        linear[:, 0] += (at * at).sum(axis=1)
        for length in blocks[2].faces():
            members = [_Faces(*pair, length) for pair in pairs]
            kind: Condition = "none"
            if not members[0].free[2]:
                kind = "hard" if search.exact.any() else "soft"
            if i + j < len(conditions) + (kind == "hard"):
                continue
            if i + j == 0:
                corners += members
                continue
            square = np.full(len(pairs), length.origin[0] ** 2)
            shape = circle_shape(i, j, len(conditions), kind)
            system = Parameters(gram_of_faces, rows, linear, square)
            systems.setdefault(shape, []).append((members, system))
    settled: list[FloatArray] = [np.empty((0, 5))]
    starts: list[_Starts] = []
    if corners:
        settled.append(_settled(corners, [np.empty((1, 0))] * len(corners), seen, search))
    for shape, groups in systems.items():
        points = search.solve(shape, concatenate([system for _, system in groups]))
        faces_of_shape = [faces for members, _ in groups for faces in members]
        if shape.is_settled:  # by the exact poses: there are no other dyads
            minima = [each.points[each.minimum] for each in points]
            settled.append(_settled(faces_of_shape, minima, seen, search))
        else:
            starts.append(_starts(faces_of_shape, points, seen, search))
    if starts:
        every = concatenate(starts)
        ends = descents.free_minima(every.z, every.along)
        descents.look(ends[np.isfinite(ends).all(axis=1)])
        settled.append(every.z[every.minimum & ~descents.knows(ends)])
    descents.follow(np.concatenate(settled))
    return descents.in_order()


def _by_dimension(faces: Iterable[Face]) -> list[tuple[int, list[Face]]]:
    """Faces of the same dimension together."""
    groups: dict[int, list[Face]] = {}
    for face in faces:
        groups.setdefault(face.basis.shape[1], []).append(face)
    return list(groups.items())


def _starts(
    members: list[_Faces], points: list[StationaryPoints], seen: Displacement, search: FaceSearch
) -> _Starts:
    """From all stationary points on faces of one shape, complex ones too, and long links."""
    faces = _FaceArrays.of(members)
    far, far_at = faces.far_points(seen, search.leaning)
    every = [of_face.points for of_face in points]
    beside = [of_face.complex_parts for of_face in points]
    counts = [len(each) for each in (*every, *beside)]
    numbers = np.tile(np.arange(len(members)), 2)
    at = np.concatenate([np.repeat(numbers, counts), np.arange(len(members)), far_at])
    middle = np.zeros((len(members), far.shape[1]))
    lowest = np.concatenate([of_face.minimum for of_face in points])
    minimum = np.concatenate([lowest, np.zeros(len(at) - len(lowest), dtype=bool)])
    z = faces.circles(np.concatenate([*every, *beside, middle, far]), at, seen, search)
    return _Starts(z, faces.along[at], minimum)


def _settled(
    members: list[_Faces], points: list[FloatArray], seen: Displacement, search: FaceSearch
) -> FloatArray:
    """The circles (k, 5) of points on faces of one shape."""
    at = np.repeat(np.arange(len(members)), [len(each) for each in points])
    return _FaceArrays.of(members).circles(np.concatenate(points), at, seen, search)


def _circle_maps(pairs: list[tuple[Face, Face]]) -> tuple[FloatArray, FloatArray]:
    """How the features of pairs (P,) of faces make those of the whole plane; same dimensions each.

    Returns the origins (c, m) of the faces (P, 4), and the matrices (P, 7, f) from their features
    to the seven of two free pivots.
    """
    fixed = np.stack([face.basis.T for face, _ in pairs])
    moving = np.stack([face.basis.T for _, face in pairs])
    i, j = fixed.shape[1], moving.shape[1]
    at = np.array([[*one.origin, *other.origin] for one, other in pairs])
    if i == j == 2:
        return at, np.broadcast_to(np.eye(7), (len(pairs), 7, 7))
    steps = np.zeros((len(pairs), i + j, 4))
    steps[:, :i, :2], steps[:, i:, 2:] = fixed, moving
    zero, one = _CIRCLE.features(at)[:, None], _CIRCLE.features(at[:, None] + steps)
    columns = [zero, one - zero]
    for u, v in product(range(i), range(i, i + j)):
        both = _CIRCLE.features(at + steps[:, u] + steps[:, v])
        columns.append((both - one[:, u] - one[:, v] + zero[:, 0])[:, None])
    return at, np.swapaxes(np.concatenate(columns, axis=1), 1, 2)
