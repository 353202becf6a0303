"""Linkages fitted to poses by distances to first order: many at once, each to poses of its own.

`refinement` brings the places of the coupler along, and has the same poses for all linkages.  Here
every linkage has poses and weights of its own, and there are hundreds: so distances are those from
the tangents, |f| over its gradient, without the places.  They differ from the true ones by squares
of the distances.  What is told of a fit is refined by true distances (`refined`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.foot_points import foot_points, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.refinement import refine
from burmester.linkages.residuals import SIZE
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import take
from burmester.numerics.least_squares import Attempt, damped_descent
from burmester.numerics.linear_algebra import matvec, solve
from burmester.numerics.weights import weights_of_mean_one

__all__ = [
    "EVEN",
    "KEPT",
    "LONG",
    "SHORT",
    "Fits",
    "Seen",
    "fitted",
    "in_two_steps",
    "misses",
    "refined",
]

SHORT, LONG, KEPT = 6, 30, 3  # steps for all starts, and for so many of each fit
EVEN = 12.0  # squares of an extent to a variance
CONVERGED, STIFF = 1e-4, 1e6  # of the steps: the last gain, and the last damping
START_DAMPING, MIN_DAMPING = 1e-3, 1e-10  # relative, of the normal equations


class Seen(NamedTuple):
    """Different poses as rows (N, 3), in lengths of their extent, and their weights, 1 on average.

    The extent is that of poses with the same variance, spread evenly over a line.  In these frames
    a radian is as much: errors are taken to be as large a share of it as they are in radians.
    """

    poses: Displacement
    rows: FloatArray
    weights: FloatArray
    frames: CanonicalFrames

    @classmethod
    def of(cls, poses: Displacement, weights: FloatArray | None) -> Seen:
        """Poses (N,); the one that is farthest off is not to set the frames."""
        share = weights_of_mean_one(weights, poses.shape)
        middle = np.median(poses.translation, axis=0)
        away = np.sort(((poses.translation - middle) ** 2).sum(axis=-1))[:-1]
        length = np.sqrt(EVEN * away.mean())
        frames = CanonicalFrames(middle, np.zeros(2), length if length > 0 else np.ones(()))
        seen = frames.see(poses)
        return cls(seen, rows_of(seen, 1.0), share, frames)

    def without(self, pose: int | None) -> NDArray[np.bool_]:
        """Which poses are left."""
        return np.asarray(np.arange(len(self.rows)) != (-1 if pose is None else pose))

    def shares(self, left_out: NDArray[np.intp]) -> FloatArray:
        """The weights (k, N) without the poses left_out (k,); -1 for none."""
        share = np.tile(self.weights, (len(left_out), 1))
        some = np.flatnonzero(left_out >= 0)
        share[some, left_out[some]] = 0.0
        return share


class Fits(NamedTuple):
    """Linkages (k,) fitted to weighted poses, sums (k,) of squares, and whose (k,) they are."""

    stack: LinkageBatch
    cost: FloatArray
    own: NDArray[np.intp]

    def of(self, own: int) -> Fits:
        """Those of one task, the best first."""
        index = np.flatnonzero(self.own == own)
        return take(self, index[np.argsort(self.cost[index], kind="stable")])

    def by_cost(self) -> list[int]:
        """Whose they are, by the least cost of each."""
        return list(dict.fromkeys(self.own[np.argsort(self.cost, kind="stable")].tolist()))

    def best(self, number: int) -> Fits:
        """The best of each, so many at most."""
        return take(self, _best(self.cost, self.own, number))


def in_two_steps(
    starts: LinkageBatch, own: NDArray[np.intp], rows: FloatArray, share: FloatArray
) -> Fits:
    """Starts (k,) fitted to rows (N, 3) or (k, N, 3) weighed by share (k, N); the best of each own.

    own: (k,), to which task each of them belongs.
    """
    stack, cost = fitted(starts, rows, share, SHORT)
    index = _best(cost, own, KEPT)
    rows = rows if rows.ndim == 2 else rows[index]
    stack, cost = fitted(stack[index], rows, share[index], LONG)
    return Fits(stack, cost, own[index])


def _best(cost: FloatArray, own: NDArray[np.intp], number: int) -> NDArray[np.intp]:
    """The indices of so many of each own, those of the least cost."""
    order = np.lexsort((cost, own))
    first = np.searchsorted(own[order], own[order])
    return np.asarray(order[np.arange(len(order)) - first < number])


def fitted(
    stack: LinkageBatch, rows: FloatArray, share: FloatArray, steps: int
) -> tuple[LinkageBatch, FloatArray]:
    """Linkages (k,) nearer to poses (N, 3) or (k, N, 3), weighed by share (k, N).

    With their sums (k,) of squares.  Levenberg and Marquardt's method.
    """
    kinds, z = stack.kinds, stack.dimensions.reshape(-1, SIZE)
    rows = np.broadcast_to(rows, (len(stack), *rows.shape[-2:]))

    def point(which: NDArray[np.intp], z: FloatArray) -> _Point:
        linkages = LinkageBatch(kinds[which], z.reshape(-1, 2, DIMENSIONS))
        residual, jacobian = misses(linkages, rows[which], share[which])
        return _Point(z, residual, jacobian, (residual * residual).sum(axis=-1))

    def attempt(which: NDArray[np.intp], here: _Point, damping: FloatArray) -> Attempt[_Point]:
        transposed = np.swapaxes(here.jacobian, -1, -2)
        normal = transposed @ here.jacobian
        size = np.sqrt(np.einsum("kii->ki", normal))
        size = np.where(size > 1e-9 * size.max(axis=-1, keepdims=True), size, 1.0)
        normal /= size[:, :, None] * size[:, None]
        normal[:, range(SIZE), range(SIZE)] += damping[:, None]
        step = -solve(normal, matvec(transposed, here.residual) / size) / size
        there = point(which, here.z + step)
        radius = there.z.reshape(-1, 2, DIMENSIONS)[..., -1]
        positive = ((radius > 0) | (kinds[which] > 0)).all(axis=-1)
        better = (there.cost < here.cost) & positive
        damping = np.maximum(damping * np.where(better, 0.1, 10.0), MIN_DAMPING)
        idle = better & (there.cost > here.cost * (1 - CONVERGED))
        return Attempt(there, better, damping, idle | (damping > STIFF))

    every = np.arange(len(stack))
    ends, _ = damped_descent(
        attempt, point(every, z), every, damping=START_DAMPING, max_steps=steps
    )
    return LinkageBatch(kinds, ends.z.reshape(-1, 2, DIMENSIONS)), ends.cost


class _Point(NamedTuple):
    """Linkages with dimensions z (k, 10), residuals, their Jacobian, and the sum of squares."""

    z: FloatArray
    residual: FloatArray
    jacobian: FloatArray
    cost: FloatArray


def misses(
    stack: LinkageBatch, rows: FloatArray, share: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Distances (k, 2 N) of poses (k, N, 3) from the motions of linkages (k,), to first order.

    In two directions normal to the motion, times the roots of share (k, N); and the derivatives
    (k, 2 N, 10) by the dimensions, but for the turn of the normals.
    """
    count, number = len(stack), rows.shape[-2]
    rows = np.broadcast_to(rows, (count, number, 3))
    with np.errstate(all="ignore"):
        miss, force, partial = stack.bearing(Displacement(rows[..., :2], rows[..., 2]))
        a, b, c = ((force[:, i] * force[:, j]).sum(-1) for i, j in ((0, 0), (0, 1), (1, 1)))
        first, height = np.sqrt(a), np.sqrt(np.maximum(c - b * b / a, 1e-20 * c))
        root = np.sqrt(share)
        out = np.empty((count, number, 2))
        out[..., 0] = root * miss[:, 0] / first
        out[..., 1] = root * (miss[:, 1] - b / a * miss[:, 0]) / height
        slope = np.zeros((count, number, 2, SIZE))
        slope[..., 0, :DIMENSIONS] = (root / first)[..., None] * partial[:, 0]
        slope[..., 1, :DIMENSIONS] = -(root * b / a / height)[..., None] * partial[:, 0]
        slope[..., 1, DIMENSIONS:] = (root / height)[..., None] * partial[:, 1]
    lost = ~(np.isfinite(out).all(axis=(1, 2)) & np.isfinite(slope).all(axis=(1, 2, 3)))
    out[lost], slope[lost] = 1e50, 0.0
    return out.reshape(count, -1), slope.reshape(count, -1, SIZE)


def refined(
    seen: Seen, stack: LinkageBatch, left_out: int | None, length: float = 1.0
) -> tuple[float, LinkageBatch]:
    """The least sum of squared distances of poses, but for one, and the linkage (1,) that has it.

    By true distances, a radian counting as much as `length`; infinite where the places of all
    linkages (k,) were lost.
    """
    keep = seen.without(left_out)
    poses, weights = seen.poses[keep], seen.weights[keep]
    rows = rows_of(poses, length)
    with np.errstate(all="ignore"):
        start = foot_points(stack, np.broadcast_to(rows, (len(stack), *rows.shape)), rows, length)
        places = Displacement(start[..., :2], start[..., 2] / length)
        fine = refine(stack, places, poses, length, weights=weights)
        cost = (weights * ((fine.rows - rows) ** 2).sum(axis=-1)).sum(axis=-1)
    cost = np.nan_to_num(cost, nan=np.inf)
    best = int(cost.argmin())
    return float(cost[best]), fine.stack[[best]]
