"""The best RR dyads within limits, on every pair of faces of the pivots' regions."""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np

from burmester.dyads.critical_points import residual_rows
from burmester.dyads.face_descent import Block, LengthRange
from burmester.dyads.face_search import Descents, FaceSearch
from burmester.dyads.geometric_fit import circle_distances
from burmester.dyads.parameter_homotopy import (
    Condition,
    Parameters,
    Shape,
    StationaryPoints,
    circle_shape,
)
from burmester.dyads.plain_circle_descent import circle_ends
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Face
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Limits

__all__ = ["circles_within_limits"]

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

    @property
    def basis(self) -> FloatArray:
        """The directions (5, d) in which a circle may move along its faces."""
        i, j, k = self.free
        out = np.zeros((5, i + j + k))
        out[:2, :i], out[2:4, i : i + j], out[4:, i + j :] = (face.basis for face in self)
        return out

    def circles(self, points: FloatArray, poses: Displacement, share: FloatArray) -> FloatArray:
        """The circles z (k, 5) of points (k, i + j) of both pivots' faces, of the best length."""
        i, _, free_length = self.free
        z = np.zeros((len(points), 5))
        z[:, :2] = self.fixed.origin + points[:, :i] @ self.fixed.basis.T
        z[:, 2:4] = self.moving.origin + points[:, i:] @ self.moving.basis.T
        centred = RR(z[:, :2], z[:, 2:4], z[:, 4])
        best = centred[:, None].residual(poses) @ share / share.sum()
        z[:, 4] = best if free_length else self.length.origin
        return z

    def far_points(self, poses: Displacement, share: FloatArray) -> FloatArray:
        """Points (*, i + j) of long links that nearly follow the best lines.

        Where a pivot is free along one line, it is far off on either side of it.
        """
        points, root = [], np.sqrt(share)
        ways = (self.fixed, self.moving, poses), (self.moving, self.fixed, poses.inverse())
        for far, near, motion in ways:
            if far.basis.shape[1] != 1:
                continue
            normal = far.basis[:, 0]
            columns = [motion.rotate(along) @ normal for along in near.basis.T]
            rows = np.stack([*columns, np.ones(poses.shape)], axis=-1)
            across = motion.act(near.origin) @ normal
            best = np.linalg.lstsq(root[:, None] * rows, -root * across)[0][:-1]
            for away in (-START_LENGTH, START_LENGTH):
                points.append([away, *best] if far is self.fixed else [*best, away])
        return np.array(points).reshape(len(points), sum(self.free[:2]))


def circles_within_limits(seen: Displacement, limits: Limits, search: FaceSearch) -> FloatArray:
    """The best RR dyads z (k, 5), c, m, r, of poses (N,), by rising error."""
    base, gram, conditions = search.centre(residual_rows(seen))
    blocks = (
        Block(slice(0, 2), limits.fixed_pivot),
        Block(slice(2, 4), limits.moving_pivot),
        Block(slice(4, 5), LengthRange(*limits.length)),
    )
    descents = Descents(search, circle_distances(seen), blocks)
    systems: dict[str, tuple[Shape, list[tuple[_Faces, Parameters]]]] = {}
    for combination in product(*(block.faces() for block in blocks)):
        faces = _Faces(*combination)
        i, j, free_length = faces.free
        kind: Condition = "none"
        if not free_length:
            kind = "hard" if search.exact.any() else "soft"
        if i + j < len(conditions) + (kind == "hard"):
            continue
        if i + j == 0:
            descents.follow(faces.circles(np.empty((1, 0)), seen, search.exact_or_share))
            continue
        at, features = _circle_map(faces.fixed, faces.moving)
        linear = features.T @ base
        linear[0] += at @ at
        square = np.asarray(faces.length.origin[0] ** 2)
        system = Parameters(features.T @ gram @ features, conditions @ features, linear, square)
        shape = circle_shape(i, j, len(conditions), kind)
        systems.setdefault(shape.name, (shape, []))[1].append((faces, system))
    for shape, members in systems.values():
        points = search.solve(shape, [system for _, system in members])
        _go_down([faces for faces, _ in members], points, shape, seen, descents)
    return np.array(descents.in_order()).reshape(-1, 5)


def _go_down(
    members: list[_Faces],
    points: list[StationaryPoints],
    shape: Shape,
    seen: Displacement,
    descents: Descents,
) -> None:
    """Find the minima of the true distance to which stationary points of one shape lead."""
    search = descents.search
    minima: list[FloatArray] = []
    others: list[FloatArray] = []
    far: list[FloatArray] = []
    along, along_others = [], []
    for faces, of_face in zip(members, points, strict=True):
        long = faces.far_points(seen, search.leaning)
        low, high = of_face.points[of_face.minimum], of_face.points[~of_face.minimum]
        more = np.concatenate([high, of_face.complex_parts, np.zeros((1, high.shape[1])), long])
        for circles, each in ((minima, low), (others, more), (far, long)):
            circles.append(faces.circles(each, seen, search.exact_or_share))
        along += [faces.basis] * len(low)
        along_others += [faces.basis] * len(more)
    lowest = np.concatenate(minima)
    if shape.is_settled:  # by the exact poses: there are no other dyads
        descents.follow(lowest)
        return
    starts, basis = np.concatenate([lowest, *others]), np.stack(along + along_others)
    ends, _ = circle_ends(starts, seen, search.leaning, basis)
    descents.look(ends[np.isfinite(ends).all(axis=1)], may_leave=False)
    own = ends[: len(lowest)]
    descents.follow(z for z, end in zip(lowest, own, strict=True) if not descents.knows(end))
    if search.exact.any():  # long links come to rest slowly where exact poses weigh most
        descents.look(np.concatenate(far))


def _circle_map(fixed: Face, moving: Face) -> tuple[FloatArray, FloatArray]:
    """How the features of a pair of faces make those of the whole plane.

    Returns the origin (c, m) of the faces (4,), and the matrix (7, f) from their features to the
    seven of two free pivots.
    """
    i, j = fixed.basis.shape[1], moving.basis.shape[1]
    at = np.concatenate([fixed.origin, moving.origin])
    steps = np.zeros((i + j, 4))
    steps[:i, :2], steps[i:, 2:] = fixed.basis.T, moving.basis.T
    if i == j == 2:
        return at, np.eye(7)
    zero, one = _CIRCLE.features(at), _CIRCLE.features(at + steps)
    columns = [zero, *(one - zero)]
    for u, v in product(range(i), range(i, i + j)):
        columns.append(_CIRCLE.features(at + steps[u] + steps[v]) - one[u] - one[v] + zero)
    return at, np.stack(columns, axis=-1)
