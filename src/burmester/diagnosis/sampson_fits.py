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
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.fourbar.nearest_places import rows_of, settled
from burmester.geometry.displacement import Displacement
from burmester.linkages.refinement import refine
from burmester.linkages.residuals import SIZE
from burmester.numerics.arrays import FloatArray

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
        share = np.ones(poses.shape) if weights is None else weights / weights.mean()
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

    def some(self, index: NDArray[np.intp]) -> Fits:
        """Those at the indices."""
        return Fits(self.stack[index], self.cost[index], self.own[index])

    def and_(self, other: Fits) -> Fits:
        """These, and then others."""
        return Fits(
            self.stack.and_(other.stack),
            np.append(self.cost, other.cost),
            np.append(self.own, other.own),
        )

    def of(self, own: int) -> Fits:
        """Those of one task, the best first."""
        index = np.flatnonzero(self.own == own)
        return self.some(index[np.argsort(self.cost[index], kind="stable")])

    def by_cost(self) -> list[int]:
        """Whose they are, by the least cost of each."""
        return list(dict.fromkeys(self.own[np.argsort(self.cost, kind="stable")].tolist()))

    def best(self, number: int) -> Fits:
        """The best of each, so many at most."""
        return self.some(_best(self.cost, self.own, number))


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
    z, kinds, count = stack.dimensions.reshape(-1, SIZE).copy(), stack.kinds, len(stack)
    rows = np.broadcast_to(rows, (count, *rows.shape[-2:]))
    damping = np.full(count, 1e-3)
    miss, slope = misses(stack, rows, share)
    cost = (miss * miss).sum(axis=-1)
    run = np.arange(count)
    for _ in range(steps):
        turned = np.swapaxes(slope, -1, -2)
        flat = turned @ slope
        size = np.sqrt(np.einsum("kii->ki", flat))
        size = np.where(size > 1e-9 * size.max(axis=-1, keepdims=True), size, 1.0)
        flat /= size[:, :, None] * size[:, None]
        flat[:, range(SIZE), range(SIZE)] += damping[run, None]
        downhill = (turned @ miss[..., None])[..., 0] / size
        step = -np.linalg.solve(flat, downhill[..., None])[..., 0] / size
        to = z[run] + step
        there = LinkageBatch(kinds[run], to.reshape(-1, 2, DIMENSIONS))
        new_miss, new_slope = misses(there, rows[run], share[run])
        after = (new_miss * new_miss).sum(axis=-1)
        positive = (to.reshape(-1, 2, DIMENSIONS)[..., -1] > 0) | (kinds[run] > 0)
        better = (after < cost[run]) & positive.all(axis=-1)
        done = better & (after > cost[run] * (1 - CONVERGED))
        z[run[better]], cost[run[better]] = to[better], after[better]
        miss = np.where(better[:, None], new_miss, miss)
        slope = np.where(better[:, None, None], new_slope, slope)
        damping[run] = np.maximum(damping[run] * np.where(better, 0.1, 10.0), 1e-10)
        keep = ~(done | (damping[run] > STIFF))
        run, miss, slope = run[keep], miss[keep], slope[keep]
        if not len(run):
            break
    return LinkageBatch(kinds, z.reshape(-1, 2, DIMENSIONS)), cost


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
        start = settled(stack, np.broadcast_to(rows, (len(stack), *rows.shape)), rows, length)
        places = Displacement(start[..., :2], start[..., 2] / length)
        fine = refine(stack, places, poses, length, weights=weights)
        cost = (weights * ((fine.rows - rows) ** 2).sum(axis=-1)).sum(axis=-1)
    cost = np.nan_to_num(cost, nan=np.inf)
    best = int(cost.argmin())
    return float(cost[best]), fine.stack[[best]]
