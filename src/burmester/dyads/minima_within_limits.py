"""The best dyads within limits: on every face of the regions, and with the link at its bounds.

A dyad that is best within limits lies on some face of them: the fixed pivot inside its region, on
an edge or at a corner, the moving pivot likewise, the link's length free or at a bound.  On each of
these faces all stationary points of the squared residual are found (`stationary_points`).  All of
them, complex ones by their real parts, and long links along the best lines are followed to minima
of the true distance on the face, the minima among them down to minima within the limits.  Those are
kept that lie within the limits and from which no direction into them leads down.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.critical_points import residual_rows
from burmester.dyads.face_search import Descents, FaceSearch
from burmester.dyads.geometric_fit import circle_distances, line_distances
from burmester.dyads.limited_block import Block, circle_blocks
from burmester.dyads.rail_sliders import sliders_on_rail
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Face, Region
from burmester.numerics.arrays import FloatArray, concatenate, shares
from burmester.numerics.linear_algebra import matvec
from burmester.polynomials.bilinear_fit import (
    Condition,
    Parameters,
    Shape,
    circle_shape,
    line_shape,
)
from burmester.polynomials.stationary_points import StationaryPoints
from burmester.tasks.limits import Limits, frames_of, limits_in
from burmester.tasks.option_table import Norm
from burmester.tasks.rails import Rail
from burmester.tasks.thin_regions import without_thin_regions

_LINE = line_shape(2, 0)


START_LENGTH = 20.0  # characteristic lengths; the links that start along a line

_CIRCLE = circle_shape(2, 2, 0, "none")


@final
@dataclass(frozen=True, slots=True, eq=False)
class LimitedDyads:
    """The locally best dyads within limits, by distance from their circles and lines.

    circles: (k,), sliders: PR and RP dyads, all in `frames`; by rising rms error each.
    systems: how many faces were searched; found: their stationary points, complex ones included;
    lost: paths that ended nowhere: where there are any, a dyad may be missing.
    unsettled: how many ways down from minima of the squared residual were given up, and did not
        lead to a dyad.
    """

    frames: CanonicalFrames
    circles: RR
    sliders: tuple[PR | RP, ...]
    systems: int
    found: int
    lost: int
    unsettled: int


def limited_dyads(
    poses: Displacement,
    weights: FloatArray | None = None,
    exact: NDArray[np.bool_] | None = None,
    limits: Limits | None = None,
    norm: Norm = "rms",
) -> LimitedDyads:
    """Every locally best dyad of poses (N,) within limits, and through the exact ones of them.

    weights: (N,) or None; exact: (N,), or None for no exact poses; norm: the sum of squared
    distances is least, or the worst distance.  A region thinner than rounding is its segment or its
    point (`without_thin_regions`).
    On every face all stationary points of the squared residual are found, with probability one.
    That the true distance has no other minima than those they lead to is not proved, nor that the
    worst distance has none.
    """
    limits = limits or Limits()
    frames, seen = frames_of(poses, weights, (limits,))
    held = np.zeros(poses.shape, dtype=bool) if exact is None else exact
    limits = limits_in(frames, without_thin_regions(limits, frames, int(held.sum())))
    search = FaceSearch(shares(weights, poses.shape), held, norm)
    kinds = limits.allowed
    rr = circles_within_limits(seen, limits, search) if "RR" in kinds else np.empty((0, 5))
    sliders: list[PR | RP] = []
    if "PR" in kinds:
        sliders += [PR(*line) for line in _lines(seen, limits.moving_pivot, search, limits.rail)]
    if "RP" in kinds:
        lines = _lines(seen.inverse(), limits.fixed_pivot, search, limits.slot)
        sliders += [RP(pivot, angle, offset) for angle, offset, pivot in lines]
    return LimitedDyads(
        frames,
        RR(rr[:, :2], rr[:, 2:4], rr[:, 4]),
        tuple(sliders),
        search.systems,
        search.found,
        search.lost,
        search.unsettled,
    )


def _lines(
    seen: Displacement, region: Region | None, search: FaceSearch, rail: Rail | None
) -> list[tuple[FloatArray, FloatArray, FloatArray]]:
    """The PR dyads, on the rail if there is one: normal angle, offset, moving pivot."""
    if rail is not None:
        lines = sliders_on_rail(seen, rail, region, search.share, search.exact)
        return [_with_upper_normal(z) for z in lines]
    rows = np.concatenate(
        [seen.translation, np.cos(seen.angle)[:, None], np.sin(seen.angle)[:, None]], axis=-1
    )
    base, gram, conditions = search.centre(rows)
    block = Block(slice(2, 4), region)
    descents = Descents(search, line_distances(seen), (block,), np.empty((0, 4)))
    starts = [np.empty((0, 4))]
    systems: dict[Shape, list[tuple[Face, Parameters]]] = {}
    for face in block.faces():
        j = face.basis.shape[1]
        if 1 + j < len(conditions):
            continue
        features = _line_map(face)
        gram_of_face, zero = features.T @ gram @ features, np.zeros(features.shape[1])
        system = Parameters(gram_of_face, conditions @ features, zero, np.ones(()))
        systems.setdefault(line_shape(j, len(conditions)), []).append((face, system))
    for shape, members in systems.items():
        parts = zip(*(system for _, system in members), strict=True)
        every = search.solve(shape, Parameters(*(np.stack(part) for part in parts)))
        for (face, _), found in zip(members, every, strict=True):
            x = found.points[found.minimum]
            n, pivot = x[:, :2], face.origin + x[:, 2:] @ face.basis.T
            offset = _LINE.features(np.concatenate([n, pivot], axis=-1)) @ base
            starts.append(np.column_stack([np.arctan2(n[:, 1], n[:, 0]), offset, pivot]))
    descents.follow(np.concatenate(starts))
    return [_with_upper_normal(z) for z in descents.in_order()]


def _with_upper_normal(z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Normal angle, offset and pivot (2,) of a dyad z (4,), the normal in the upper half plane."""
    angle = np.arctan2(np.sin(z[0]), np.cos(z[0]))
    flip = angle < 0 or angle == np.pi
    angle = np.mod(angle, np.pi)
    return angle, -z[1] if flip else z[1], z[2:]


def _line_map(face: Face) -> FloatArray:
    """The matrix (4, f) from the features of a face to (n, n · m, n x m)."""
    normals, step = np.eye(2), face.basis.T
    at = [_LINE.features(np.concatenate([n, face.origin])) for n in normals]
    if len(step) == 2:
        return np.eye(4)
    more = [
        _LINE.features(np.concatenate([n, face.origin + step[0]])) - zero
        for n, zero in zip(normals, at, strict=True)
        if len(step)
    ]
    return np.stack(at + more, axis=-1)


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
    """Origins (P, 4) of pairs of faces, and matrices (P, 7, f) to features of two free pivots."""
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
