"""Linkages fitted to poses by Sampson distances: hundreds at once, each to poses of its own.

`refinement.least_error` follows the places of the coupler and has the same poses for all linkages.
Here every linkage has its own poses and weights, so distances are taken to first order (Sampson):
|f| over its gradient, without the places.  They differ from the true ones by squares of the
distances.  Numbers for users come from `refine_best`, by true distances.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.foot_points import foot_points, places_of, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, median, take, weights_of_mean_one
from burmester.numerics.least_squares import Attempt, damped_descent
from burmester.numerics.linear_algebra import matvec, solve
from burmester.refinement.least_error import refine
from burmester.refinement.residuals import SIZE

SCREENING_STEPS = 6  # of the first descent, from every start
FULL_STEPS = 30  # of the second descent, from the best starts of each label
FITS_PER_LABEL = 3  # linkages kept of each label
UNIFORM_EXTENT_SQUARED = 12.0  # variances; the squared length of a line with points spread evenly
MAX_IDLE_GAIN = 1e-4  # relative, of a step; a descent that gains less has ended
START_DAMPING = 1e-3  # relative, of the normal equations with columns of length one
EQUAL_ERRORS = np.ones(1)  # ratio of errors of angles (radians) to those of positions (extents)
MIN_DAMPING, MAX_DAMPING = 1e-10, 1e6  # the same; at the greater one a descent ends


class NormalizedPoses(NamedTuple):
    """Distinct poses in canonical frames, with the extent of the poses as the unit of length.

    poses: (N,) in these frames; rows: (N, 3), x, y, angle of the same.
    weights: (N,), 1 on average.
    frames: the way back to the task's frames.

    The extent is the length of a line over which poses of the same variance are spread evenly.  A
    radian counts as one extent, where no other ratio of errors is given (`noise_ratio`).
    """

    poses: Displacement
    rows: FloatArray
    weights: FloatArray
    frames: CanonicalFrames

    @classmethod
    def of(cls, poses: Displacement, weights: FloatArray | None) -> NormalizedPoses:
        """Poses (N,) of a task; the one farthest from their middle has no part in the extent."""
        share = weights_of_mean_one(weights, poses.shape)
        middle = median(poses.translation, 0)[0]
        away = np.sort(((poses.translation - middle) ** 2).sum(axis=-1))[:-1]
        length = np.sqrt(UNIFORM_EXTENT_SQUARED * away.mean())
        frames = CanonicalFrames(middle, np.zeros(2), length if length > 0 else np.ones(()))
        own = frames.to_canonical(poses)
        return cls(own, rows_of(own, 1.0), share, frames)

    def mask_without(self, pose: int | None) -> NDArray[np.bool_]:
        """Which poses (N,) are left without one (None: all)."""
        return np.asarray(np.arange(len(self.rows)) != (-1 if pose is None else pose))

    def weights_without(self, left_out: NDArray[np.intp]) -> FloatArray:
        """The weights (k, N), zero for the poses left_out (k,); -1 leaves out none."""
        share = np.tile(self.weights, (len(left_out), 1))
        rows = np.flatnonzero(left_out >= 0)
        share[rows, left_out[rows]] = 0.0
        return share


class Fits(NamedTuple):
    """Linkages (k,) fitted to weighted poses.

    cost: (k,), the sums of their squared distances.
    labels: (k,), which fit each belongs to: the pose left out, or an index of other poses.
    """

    linkages: LinkageBatch
    cost: FloatArray
    labels: NDArray[np.intp]

    def of(self, label: int) -> Fits:
        """Those of one label, the best first."""
        index = np.flatnonzero(self.labels == label)
        return take(self, index[np.argsort(self.cost[index], kind="stable")])

    def labels_by_cost(self) -> list[int]:
        """The labels, in the order of their least costs."""
        return list(dict.fromkeys(self.labels[np.argsort(self.cost, kind="stable")].tolist()))

    def best(self, number: int) -> Fits:
        """At most `number` of each label, those of the least cost."""
        return take(self, _best(self.cost, self.labels, number))


def fit_in_two_steps(
    starts: LinkageBatch, labels: NDArray[np.intp], rows: FloatArray, share: FloatArray
) -> Fits:
    """Starts (k,) fitted to rows (N, 3) or (k, N, 3) weighed by share (k, N); the best of a label.

    labels: (k,), see `Fits`.
    """
    linkages, cost = fit_linkages(starts, rows, share, SCREENING_STEPS)
    index = _best(cost, labels, FITS_PER_LABEL)
    rows = rows if rows.ndim == 2 else rows[index]
    linkages, cost = fit_linkages(linkages[index], rows, share[index], FULL_STEPS)
    return Fits(linkages, cost, labels[index])


def _best(cost: FloatArray, labels: NDArray[np.intp], number: int) -> NDArray[np.intp]:
    """The indices of at most `number` of each label, those of the least cost."""
    order = np.lexsort((cost, labels))
    first = np.searchsorted(labels[order], labels[order])
    return np.asarray(order[np.arange(len(order)) - first < number])


def fit_linkages(
    linkages: LinkageBatch,
    rows: FloatArray,
    share: FloatArray,
    steps: int,
    ratio: FloatArray = EQUAL_ERRORS,
) -> tuple[LinkageBatch, FloatArray]:
    """Linkages (k,) fitted to poses (N, 3) or (k, N, 3) weighed by share (k, N), and their costs.

    By at most `steps` steps of Levenberg and Marquardt's method.  ratio: (k,) or (1,), see
    `sampson_residuals`.
    """
    kinds, z = linkages.kinds, linkages.dimensions.reshape(-1, SIZE)
    rows = np.broadcast_to(rows, (len(linkages), *rows.shape[-2:]))
    ratio = np.broadcast_to(ratio, (len(linkages),))

    def point(which: NDArray[np.intp], z: FloatArray) -> _Point:
        linkages = LinkageBatch(kinds[which], z.reshape(-1, 2, DIMENSIONS))
        residual, jacobian = sampson_residuals(linkages, rows[which], share[which], ratio[which])
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
        idle = better & (there.cost > here.cost * (1 - MAX_IDLE_GAIN))
        return Attempt(there, better, damping, idle | (damping > MAX_DAMPING))

    every = np.arange(len(linkages))
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


def sampson_residuals(
    linkages: LinkageBatch,
    rows: FloatArray,
    share: FloatArray,
    ratio: FloatArray = EQUAL_ERRORS,
) -> tuple[FloatArray, FloatArray]:
    """Distances (k, 2 N) of poses (k, N, 3) from the motions of linkages (k,), to first order.

    In two directions normal to the motion, times the roots of share (k, N).  With them the Jacobian
    (k, 2 N, 10) by the dimensions, in which the normals count as constant.
    ratio: (k,) or (1,), errors of angles in radians over errors of positions in extents; an angle
        that is wrong by `ratio` radians counts as one extent.
    """
    count, number = len(linkages), rows.shape[-2]
    rows = np.broadcast_to(rows, (count, number, 3))
    with np.errstate(all="ignore"):
        miss, force, partial = linkages.jacobians(Displacement.from_poses(rows))
        force[..., 2] *= ratio[:, None, None]
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


def refine_best(
    normalized: NormalizedPoses, linkages: LinkageBatch, left_out: int | None, length: float = 1.0
) -> tuple[float, LinkageBatch]:
    """The least cost of linkages (k,) refined for all poses but one, and the linkage (1,) with it.

    The cost is the sum of squared true distances, a radian counting as much as `length`; infinite
    where no linkage could be followed through its places.
    """
    keep = normalized.mask_without(left_out)
    poses, weights = normalized.poses[keep], normalized.weights[keep]
    rows = rows_of(poses, length)
    with np.errstate(all="ignore"):
        start = foot_points(
            linkages, np.broadcast_to(rows, (len(linkages), *rows.shape)), rows, length
        )
        places = places_of(start, length)
        fine = refine(linkages, places, poses, length, weights=weights)
        cost = (weights * ((fine.rows - rows) ** 2).sum(axis=-1)).sum(axis=-1)
    cost = np.nan_to_num(cost, nan=np.inf)
    best = int(cost.argmin())
    return float(cost[best]), fine.batch[[best]]
