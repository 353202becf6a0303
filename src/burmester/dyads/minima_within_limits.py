"""The best dyads within limits: on every face of the regions, and with the link at its bounds.

A dyad that is best within limits lies on some face of them: the fixed pivot inside its region, on
an edge or at a corner, the moving pivot likewise, the link's length free or at a bound.  On each of
these faces all stationary points of the squared residual are found (`parameter_homotopy`).  All of
them, complex ones by their real parts, and long links along the best lines are followed to minima
of the true distance on the face, the minima among them down to minima within the limits.  Those are
kept that lie within the limits and from which no direction into them leads down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from itertools import product
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_minima import circle_ends
from burmester.dyads.critical_points import residual_rows
from burmester.dyads.face_descent import Block, LengthRange, descend, inside
from burmester.dyads.geometric_fit import (
    DistanceFunction,
    FitProblem,
    GeometricFit,
    circle_distances,
    least_squares,
    least_worst,
    line_distances,
)
from burmester.dyads.parameter_homotopy import (
    Condition,
    Parameters,
    Shape,
    StationaryPoints,
    circle_shape,
    line_shape,
    stationary_points,
)
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Face, Region
from burmester.numerics.arrays import FloatArray
from burmester.numerics.weights import shares
from burmester.tasks.limits import Limits
from burmester.tasks.options import Norm

__all__ = ["LimitedDyads", "limited_dyads"]

SAME_DYAD = 1e-7  # relative; dyads whose coordinates differ by less are one
NEAR_DYAD = 1e-6  # relative; from a circle so near to a dyad no way down is looked for
EXACT_TOLERANCE = 1e-9  # relative; an exact pose missed by less is met
EXACT_WEIGHT = 1e4  # of an exact pose, where all weights are 1, on the way to its neighbourhood
START_LENGTH = 20.0  # characteristic lengths; the links that start along a line
NEARLY_EXACT = 0.01  # relative; an exact pose missed by more there has no dyad nearby
SLIDER_LENGTH = (
    1e3  # characteristic lengths; a longer link that still grows is on its way to a line
)

_CIRCLE = circle_shape(2, 2, 0, "none")
_LINE = line_shape(2, 0)


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
    distances is least, or the worst distance.
    On every face all minima of the squared residual are found, with probability one.  That the
    true distance has no other minima than those they lead to is not proved, nor that the worst
    distance has none.
    """
    frames, seen = CanonicalFrames.of(poses, weights)
    held = np.zeros(poses.shape, dtype=bool) if exact is None else exact
    limits = _limits_in(frames, limits or Limits())
    search = _Search(shares(weights, poses.shape), held, norm)
    kinds = limits.allowed
    rr = _circles(seen, limits, search) if "RR" in kinds else np.empty((0, 5))
    sliders: list[PR | RP] = []
    if "PR" in kinds:
        sliders += [PR(*line) for line in _lines(seen, limits.moving_pivot, search)]
    if "RP" in kinds:
        lines = _lines(seen.inverse(), limits.fixed_pivot, search)
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


@dataclass
class _Search:
    """What is minimised, and counts of the search: see `LimitedDyads`."""

    share: FloatArray
    exact: NDArray[np.bool_]
    norm: Norm
    systems: int = 0
    found: int = 0
    lost: int = 0
    unsettled: int = 0

    def centre(self, rows: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Residual rows (N, f) without the row of the best constant.

        That row is the mean where no pose is exact, or the first exact one's.
        Returns it, the Gram matrix G (f, f) of the rest, and the conditions A (k, f) of the other
        exact poses.
        """
        marked = np.flatnonzero(self.exact)
        base, others = rows[marked[0]] if len(marked) else self.share @ rows, marked[1:]
        loose = np.sqrt(np.where(self.exact, 0.0, self.share))[:, None] * (rows - base)
        conditions = rows[others] - base
        size = np.linalg.norm(conditions, axis=1, keepdims=True)
        return base, loose.T @ loose, conditions / np.where(size > 0, size, 1.0)

    def solve(self, shape: Shape, parameters: list[Parameters]) -> list[StationaryPoints]:
        """The stationary points of systems of one shape."""
        stacked = Parameters(*(np.stack(part) for part in zip(*parameters, strict=True)))
        every = stationary_points(shape, stacked)
        for one in every:
            self.systems += 1
            self.found += one.finite
            self.lost += one.lost
        return every

    def leaning(self) -> FloatArray:
        """The weights (N,) of squared distances whose minima lie near those with exact poses."""
        return np.where(self.exact, EXACT_WEIGHT, self.share)

    def nearly_exact(self, distances: DistanceFunction, z: FloatArray) -> bool:
        """Whether a dyad z nearly meets the exact poses."""
        gap = np.abs(distances(z).distance[self.exact]).max(initial=0)
        return bool(gap < NEARLY_EXACT * (1 + np.abs(z).max()))

    def follow_up(
        self,
        dyads: list[FloatArray],
        z: FloatArray,
        distances: DistanceFunction,
        blocks: Sequence[Block],
        *,
        may_leave: bool = True,
    ) -> bool:
        """Add the minimum of the norm to which a dyad z leads, if it is within limits and new.

        may_leave: whether the way down may leave the edges on which z lies.
        Returns False where the way down was given up.
        """
        problem = FitProblem(distances, np.eye(len(z)), self.share, self.exact)

        def newton_step(z: FloatArray, basis: FloatArray) -> GeometricFit:
            return least_squares(problem._replace(basis=basis), z, max_steps=1)

        def minimax(z: FloatArray, basis: FloatArray) -> GeometricFit:
            best = least_worst(problem._replace(basis=basis), z)
            if not best.settled and np.abs(best.z).max() > SLIDER_LENGTH:
                return best._replace(z=np.full_like(z, np.nan))  # on its way to a slider
            return best._replace(settled=True)

        if not inside(z, blocks) or _is_known(z, dyads, NEAR_DYAD):
            return True
        best = descend(z, distances, newton_step, blocks, may_leave=may_leave)
        if best.settled and self.norm == "worst" and not self.exact.all():
            best = descend(best.z, distances, minimax, blocks)
        size = 1 + np.abs(best.z).max()
        if not best.settled and not size < SLIDER_LENGTH:
            return True  # on its way to a slider
        # On an edge or at a corner there may be too little freedom to meet the exact poses.
        gap = np.abs(distances(best.z).distance[self.exact]).max(initial=0)
        if not best.settled or gap > EXACT_TOLERANCE * size:
            return False
        if not _is_known(best.z, dyads, SAME_DYAD):
            dyads.append(best.z)
        return True


def _is_known(z: FloatArray, dyads: list[FloatArray], tolerance: float) -> bool:
    """Whether a dyad z is one of some others, up to a share of its size."""
    gap = tolerance * (1 + np.abs(z).max())
    return any(np.abs(z - other).max() <= gap for other in dyads)


def _circles(seen: Displacement, limits: Limits, search: _Search) -> FloatArray:
    """The RR dyads (k, 5): c, m, r."""
    base, gram, conditions = search.centre(residual_rows(seen))
    distances = circle_distances(seen)
    blocks = (
        Block(slice(0, 2), limits.fixed_pivot),
        Block(slice(2, 4), limits.moving_pivot),
        Block(slice(4, 5), LengthRange(*limits.length)),
    )
    dyads: list[FloatArray] = []

    def circles(faces: tuple[Face, ...], points: FloatArray) -> FloatArray:
        """The circles (k, 5) of points (k, i + j) of a pair of faces, of the best length."""
        fixed, moving, length = faces
        i = fixed.basis.shape[1]
        z = np.zeros((len(points), 5))
        z[:, :2] = fixed.origin + points[:, :i] @ fixed.basis.T
        z[:, 2:4] = moving.origin + points[:, i:] @ moving.basis.T
        centred = RR(z[:, :2], z[:, 2:4], z[:, 4])
        kept = np.where(search.exact, 1.0, 0.0) if search.exact.any() else search.share
        mean = centred[:, None].residual(seen) @ (kept / kept.sum())
        z[:, 4] = mean if length.basis.shape[1] else length.origin
        return z

    systems: dict[str, tuple[Shape, list[tuple[tuple[Face, ...], Parameters]]]] = {}
    for faces in product(*(block.faces() for block in blocks)):
        i, j, free = (face.basis.shape[1] for face in faces)
        kind: Condition = "none"
        if not free:
            kind = "hard" if search.exact.any() else "soft"
        if i + j < len(conditions) + (kind == "hard"):
            continue
        if i + j == 0:
            (z,) = circles(faces, np.empty((1, 0)))
            search.unsettled += not search.follow_up(dyads, z, distances, blocks)
            continue
        at, features = _circle_map(faces[0], faces[1])
        linear = features.T @ base
        linear[0] += at @ at
        square = np.asarray(faces[2].origin[0] ** 2)
        system = Parameters(features.T @ gram @ features, conditions @ features, linear, square)
        shape = circle_shape(i, j, len(conditions), kind)
        systems.setdefault(shape.name, (shape, []))[1].append((faces, system))
    for shape, members in systems.values():
        starts, along, minima, far = [], [], [], []
        points = search.solve(shape, [system for _, system in members])
        for (faces, _), of_face in zip(members, points, strict=True):
            far.append(circles(faces, _far_points(faces, seen, search.leaning())))
            others = np.concatenate([of_face.complex_parts, np.zeros((1, shape.unknowns))])
            starts += [circles(faces, of_face.points), circles(faces, others), far[-1]]
            along += [_directions(faces)] * sum(map(len, starts[-3:]))
            minima += [*of_face.minimum, *[False] * (len(others) + len(far[-1]))]
        # The true distance has minima to which no minimum of the squared residual leads.
        z = np.concatenate(starts)
        ends, _ = circle_ends(z, seen, search.leaning(), np.stack(along))
        for end in ends[np.isfinite(ends).all(axis=1)]:
            if search.nearly_exact(distances, end):
                search.follow_up(dyads, end, distances, blocks, may_leave=False)
        for start, end in zip(z[minima], ends[minima], strict=True):
            if not _is_known(end, dyads, NEAR_DYAD):
                search.unsettled += not search.follow_up(dyads, start, distances, blocks)
        if search.exact.any():  # long links come to rest slowly where exact poses weigh most
            for start in np.concatenate(far):
                search.follow_up(dyads, start, distances, blocks)
    return np.array(sorted(dyads, key=lambda z: _cost(distances, z))).reshape(-1, 5)


def _far_points(faces: tuple[Face, ...], poses: Displacement, share: FloatArray) -> FloatArray:
    """Points (*, i + j) of a pair of faces whose links are long: nearly the best lines across them.

    Where a pivot moves along a line, it is far off on either side.
    """
    fixed, moving = faces[:2]
    points = []
    for far, near, motion in ((fixed, moving, poses), (moving, fixed, poses.inverse())):
        if far.basis.shape[1] != 1:
            continue
        normal = far.basis[:, 0]
        columns = [motion.rotate(along) @ normal for along in near.basis.T]
        rows = np.stack([*columns, np.ones(poses.shape)], axis=-1)
        root = np.sqrt(share)
        best = np.linalg.lstsq(root[:, None] * rows, -root * (motion.act(near.origin) @ normal))[0]
        for away in (-START_LENGTH, START_LENGTH):
            points.append([away, *best[:-1]] if far is fixed else [*best[:-1], away])
    return np.array(points).reshape(len(points), fixed.basis.shape[1] + moving.basis.shape[1])


def _directions(faces: tuple[Face, ...]) -> FloatArray:
    """The directions (5, d) in which a circle may move along its faces."""
    fixed, moving, length = (face.basis for face in faces)
    i, j = fixed.shape[1], moving.shape[1]
    out = np.zeros((5, i + j + length.shape[1]))
    out[:2, :i], out[2:4, i : i + j], out[4:, i + j :] = fixed, moving, length
    return out


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


def _lines(
    seen: Displacement, region: Region | None, search: _Search
) -> list[tuple[FloatArray, FloatArray, FloatArray]]:
    """The PR dyads: normal angle, offset, moving pivot in the region."""
    rows = np.concatenate(
        [seen.translation, np.cos(seen.angle)[:, None], np.sin(seen.angle)[:, None]], axis=-1
    )
    base, gram, conditions = search.centre(rows)
    distances = line_distances(seen)
    block = Block(slice(2, 4), region)
    dyads: list[FloatArray] = []
    for face in block.faces():
        j = face.basis.shape[1]
        if 1 + j < len(conditions):
            continue
        features = _line_map(face)
        shape = line_shape(j, len(conditions))
        zero = np.zeros(features.shape[1])
        gram_of_face = features.T @ gram @ features
        system = Parameters(gram_of_face, conditions @ features, zero, np.ones(()))
        (found,) = search.solve(shape, [system])
        for x in found.points[found.minimum]:
            n, pivot = x[:2], face.origin + face.basis @ x[2:]
            offset = base @ _LINE.features(np.concatenate([n, pivot]))
            z = np.array([np.arctan2(n[1], n[0]), offset, *pivot])
            search.unsettled += not search.follow_up(dyads, z, distances, (block,))
    dyads.sort(key=lambda z: _cost(distances, z))
    return [_with_upper_normal(z) for z in dyads]


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


def _cost(distances: DistanceFunction, z: FloatArray) -> float:
    return float((distances(z).distance ** 2).sum())


def _limits_in(frames: CanonicalFrames, limits: Limits) -> Limits:
    """Limits as canonical frames see them."""

    def moved(region: Region | None, origin: FloatArray) -> Any:
        if region is None:
            return None
        values = {f.name: (getattr(region, f.name) - origin) / unit for f in fields(region)}
        return replace(region, **values)

    unit = float(frames.length)
    return replace(
        limits,
        fixed_pivot=moved(limits.fixed_pivot, frames.fixed_origin),
        moving_pivot=moved(limits.moving_pivot, frames.moving_origin),
        length=(limits.length[0] / unit, limits.length[1] / unit),
    )
