"""Chances of a disagreement, with the ratio of errors of angles to errors of positions unknown.

Let errors of positions have the standard deviation s (extents), those of angles r s (radians).  For
a given r the fits of `sampson_fits` are least squares, and F tests hold to first order.  Nobody
knows r, and a test with a wrong one speaks of clean poses, or misses what is wrong.  So for each
pose i the chance is a mean over ratios.  Each ratio counts by its restricted likelihood, given the
other poses alone:

    prod_j det(S_j)^(-1/2) det(J' J)^(-1/2) Q^(-m / 2),

where S_j is the covariance of the two residuals of pose j, J the Jacobian of all residuals by the
ten dimensions, both in units of s, Q the least sum of squares and m = 2 N - 12 its degrees of
freedom (Patterson and Thompson, Biometrika 58, 1971).  The pose in question has no part in that: a
wrong angle does not make all angles look uncertain.  `benchmarks.odd_pose` holds the chance
against how often clean poses are named.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from burmester.diagnosis.sampson_fits import (
    FULL_STEPS,
    NormalizedPoses,
    fit_linkages,
    sampson_residuals,
)
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, FloatArray, concatenate, take
from burmester.numerics.linear_algebra import matvec

RATIOS = np.geomspace(0.05, 50.0, 13)  # radians per extent; every step counts the same beforehand
TESTS = 2  # per pose, one of all its numbers and one of each; the lesser chance counts
# Determinant of a pose's share of the residuals; below it the others say nothing of the pose.
MIN_REDUNDANCY = 1e-9


class ByRatio(NamedTuple):
    """Fits without one pose, or several, for each of the ratios (R,).

    linkages: (R,), the best without the pose.
    without, of_all: (R, *), least sums of squares without it, and with it.
    numbers: (R, *, 3), the same with x, y or the angle of the pose left open.
    log_likelihood: (R, *), of the ratios by all other poses, up to a constant.
    """

    linkages: LinkageBatch
    without: FloatArray
    of_all: FloatArray
    numbers: FloatArray
    log_likelihood: FloatArray

    @property
    def weights(self) -> FloatArray:
        """How much each ratio counts, (R, *), 1 in sum."""
        share = np.exp(self.log_likelihood - self.log_likelihood.max(axis=0))
        return np.asarray(share / share.sum(axis=0))

    def chance(self, count: int) -> FloatArray:
        """The chance (*,) that poses with errors alike show as much somewhere; count: of poses."""
        of_pose = chance_of_pose(count, self.without, self.of_all)
        of_number = chance_of_number(count, self.numbers, self.of_all[..., None]).min(axis=-1)
        least = np.minimum(1.0, TESTS * np.minimum(of_pose, of_number))
        return np.asarray((self.weights * least).sum(axis=0))

    def bounded(self, increase: FloatArray) -> ByRatio:
        """The same where the pose adds no more than `increase` (R, *) to the sums of squares."""
        most = self.of_all - self.without
        least = np.minimum(most, increase)
        part = np.divide(least, most, out=np.ones_like(most), where=most > 0)
        numbers = self.without[..., None] + part[..., None] * (
            self.numbers - self.without[..., None]
        )
        return self._replace(of_all=self.without + least, numbers=numbers)

    def deviations(self, count: int) -> float:
        """The distance of the pose from the others' motion by the likeliest ratio, in deviations.

        Of fits without one pose.
        """
        at = self.best_ratio()
        square = (self.of_all[at] / self.without[at] - 1) * (2 * count - 12)
        return float(np.sqrt(max(square, 0.0)))

    def best_ratio(self) -> int:
        """The index of the likeliest ratio, of fits without one pose."""
        return int(self.log_likelihood.argmax())


def floor_by_ratio(count: int, position: float, angle: float) -> FloatArray:
    """The part (R,) of sums of squares that comes from digits alone.

    position, angle: standard deviations by digits, in extents and radians.
    """
    error = np.maximum(np.maximum(position, angle / RATIOS), ROUNDING)
    return np.asarray((2 * count - 12) * error**2)


def chance_of_pose(count: int, without: FloatArray, of_all: FloatArray) -> FloatArray:
    """The chance that the least of N sums of squares without a pose is no greater (an F test).

    Formula `chance-of-pose` of the theory.
    """
    return np.asarray(np.minimum(1.0, count * np.minimum(1.0, without / of_all) ** (count - 6)))


def chance_of_number(count: int, repaired: FloatArray, of_all: FloatArray) -> FloatArray:
    """The same of 3 N sums with one number free.

    An upper bound, and close where the chance is small.
    """
    half, share = (2 * count - 11) / 2, np.minimum(1.0, repaired / of_all)
    beta = math.exp(math.lgamma(half) + math.lgamma(0.5) - math.lgamma(half + 0.5))
    with np.errstate(divide="ignore"):
        tail = share**half / (half * beta * np.sqrt(1 - share))
    return np.asarray(np.minimum(1.0, 3 * count * tail))


class _Leverage(NamedTuple):
    """What each pose adds to the sum of squares of linkages (k,), to first order.

    residuals: (k, 2 N), of the least-squares solution to first order, of all poses.
    share: (k, N, 2, 2), of each pose's own residuals that remain; the rest moves the linkage.
    log_volume: (k,), -1/2 log of all determinants in the likelihood, of all poses.
    log_share: (k, N), that of a pose; to be taken off where the pose is left out.
    directions: (k, N, 2, 3), residuals by x, y and the angle.
    """

    residuals: FloatArray
    share: FloatArray
    log_volume: FloatArray
    log_share: FloatArray
    directions: FloatArray

    @classmethod
    def of(cls, normalized: NormalizedPoses, linkages: LinkageBatch) -> _Leverage:
        """Of linkages (R,), one for each ratio."""
        number = len(normalized.rows)
        weights = np.tile(normalized.weights, (len(linkages), 1))
        residuals, jacobian = sampson_residuals(linkages, normalized.rows, weights, RATIOS)
        size = np.linalg.norm(jacobian, axis=1, keepdims=True)
        size = np.where(size > 0, size, 1.0)
        u, s, _ = np.linalg.svd(jacobian / size, full_matrices=False)
        determined = s > ROUNDING * s[:, :1]
        u = u * determined[:, None]
        residuals = residuals - matvec(u, matvec(u.swapaxes(1, 2), residuals))
        of_pose = u.reshape(len(linkages), number, 2, -1)
        share = np.eye(2) - of_pose @ of_pose.swapaxes(-1, -2)
        directions, log_normal = residuals_by_number(linkages, normalized.rows, weights)
        log_spread = np.log(np.where(determined, s, 1.0)).sum(-1) + np.log(size[:, 0]).sum(-1)
        log_share = 0.5 * np.log(np.maximum(np.linalg.det(share), MIN_REDUNDANCY)) - log_normal
        return cls(residuals, share, -log_normal.sum(-1) - log_spread, log_share, directions)

    def increases(self) -> tuple[FloatArray, FloatArray]:
        """What the sum of squares loses without each pose, (k, N), and each number, (k, N, 3)."""
        known = np.linalg.det(self.share) > MIN_REDUNDANCY
        share = np.where(known[..., None, None], self.share, np.eye(2))
        own = self.residuals.reshape(*known.shape, 2)
        of_pose = (own * matvec(np.linalg.inv(share), own)).sum(axis=-1)
        a = self.directions
        power = (a * (share @ a)).sum(axis=-2)
        along = (own[..., None] * a).sum(axis=-2) ** 2
        of_number = np.divide(along, power, out=np.zeros_like(along), where=power > 0)
        return np.where(known, of_pose, 0.0), np.where(known[..., None], of_number, 0.0)


def residuals_by_number(
    linkages: LinkageBatch, rows: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Residuals of `sampson_residuals` by x, y and angle (k, N, 2, 3), linkages one for each ratio.

    With them the logarithms (k, N) of the roots of the determinants of the residuals' covariance,
    before they are divided by it.
    """
    rows = np.broadcast_to(rows, (len(linkages), *rows.shape[-2:]))
    _, force, _ = linkages.jacobians(Displacement.from_poses(rows))
    force = np.moveaxis(force, 1, 2)
    scaled = force.copy()
    scaled[..., 2] *= RATIOS[:, None, None]
    first = np.linalg.norm(scaled[..., 0, :], axis=-1)
    one = scaled[..., 0, :] / first[..., None]
    along = (scaled[..., 1, :] * one).sum(-1)
    height = np.linalg.norm(scaled[..., 1, :] - along[..., None] * one, axis=-1)
    height = np.maximum(height, 1e-10 * np.linalg.norm(scaled[..., 1, :], axis=-1))
    top = force[..., 0, :] / first[..., None]
    bottom = (force[..., 1, :] - along[..., None] * top) / height[..., None]
    root = np.sqrt(weights)[..., None, None]
    return root * np.stack([top, bottom], axis=-2), np.log(first * height)


def first_order_chances(
    normalized: NormalizedPoses, linkages: LinkageBatch, floor: FloatArray
) -> FloatArray:
    """The chance (N,) of each pose, all to first order from a linkage (1,) of all poses."""
    count = len(normalized.rows)
    linkages = take(linkages, np.zeros(len(RATIOS), dtype=np.intp))
    leverage = _Leverage.of(normalized, linkages)
    of_pose, of_number = leverage.increases()
    total = (leverage.residuals**2).sum(axis=-1)[:, None]
    without = np.maximum(total - of_pose, 0.0) + floor[:, None]
    numbers = np.maximum(total[..., None] - of_number, 0.0) + floor[:, None, None]
    likelihood = _log_likelihood(leverage, count, without)
    of_all = np.broadcast_to(total + floor[:, None], without.shape)
    return ByRatio(linkages, without, of_all, numbers, likelihood).chance(count)


def _log_likelihood(leverage: _Leverage, count: int, without: FloatArray) -> FloatArray:
    """Of the ratios (R, N) without each pose."""
    volume = leverage.log_volume[:, None] - leverage.log_share
    return np.asarray(volume - (count - 6) * np.log(without))


def fits_by_ratio(
    normalized: NormalizedPoses,
    without: LinkageBatch,
    of_all: LinkageBatch,
    pose: int,
    floor: FloatArray,
) -> ByRatio:
    """Fits without a pose for each ratio, and what it adds to them.

    without, of_all: linkages (*,) that fit the poses without it and with it, to start from.
    """
    left = _fit_each_ratio(normalized, without, pose)
    linkages, cost = left
    leverage = _Leverage.of(normalized, linkages)
    of_pose, of_number = (each[:, pose] for each in leverage.increases())
    _, joint = _fit_each_ratio(normalized, concatenate([of_all, without]), -1, linkages)
    increase = np.minimum(of_pose, np.maximum(joint - cost, 0.0))
    share = of_number / np.where(of_pose > 0, of_pose, 1.0)[:, None]
    without_floor = cost + floor
    numbers = without_floor[:, None] + increase[:, None] * (1 - share)
    likelihood = _log_likelihood(leverage, len(normalized.rows), without_floor[:, None])[:, pose]
    return ByRatio(linkages, without_floor, without_floor + increase, numbers, likelihood)


def _fit_each_ratio(
    normalized: NormalizedPoses,
    starts: LinkageBatch,
    left_out: int,
    one_each: LinkageBatch | None = None,
) -> tuple[LinkageBatch, FloatArray]:
    """The best linkage (R,) for each ratio, and the costs (R,); one_each: a further start."""
    times = len(starts) + (one_each is not None)
    every = take(starts, np.tile(np.arange(len(starts)), len(RATIOS)))
    ratio = np.repeat(RATIOS, len(starts))
    if one_each is not None:
        every, ratio = concatenate([every, one_each]), np.append(ratio, RATIOS)
    share = normalized.weights_without(np.full(len(every), left_out))
    linkages, cost = fit_linkages(every, normalized.rows, share, FULL_STEPS, ratio)
    groups = np.arange(len(starts) * len(RATIOS)).reshape(len(RATIOS), -1)
    if one_each is not None:
        groups = np.column_stack([groups, np.arange(len(groups) * (times - 1), len(every))])
    best = groups[np.arange(len(RATIOS)), cost[groups].argmin(axis=1)]
    return take(linkages, best), cost[best]
