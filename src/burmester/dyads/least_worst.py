"""The least worst distance of a dyad from its circle or line."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import FitProblem, GeometricFit, Point
from burmester.dyads.least_powers import (
    SETTLED_STEP,
    least_powers,
    least_squares,
    pseudo_inverse,
)
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import put, where
from burmester.numerics.iteration import iterate
from burmester.numerics.linear_algebra import matvec

SINGULAR = 1e-15  # share of the greatest singular value, below which one is zero
MAX_MINIMAX_STEPS = 20  # of Newton's method once the worst poses are known
FIRST_MINIMAX_POWER = 32  # of the distances, from which on the worst poses are looked for
MAX_POWER = 4096  # of the distances; no higher sums are minimised
WORST_POSE_SHARE = 1e-3  # of the greatest multiplier, below which a pose is none of the worst
MAX_MINIMAX_STEP = 10.0  # lengths; a longer step has left the minimum
LEVEL_TOLERANCE = 1e-9  # relative; worst distances this near to each other are equal
BALANCE_TOLERANCE = 1e-8  # relative; what is left of the gradient at a minimax
MULTIPLIER_ROUNDING = 1e-9  # a multiplier so far below zero is zero
EXACT_TOLERANCE = 1e-11  # relative; an exact pose missed by less is met


def least_worst(problem: FitProblem, z: FloatArray, along: FloatArray) -> GeometricFit:
    """Local minima of the worst distance, counted by the root of weight / mean weight.

    Sums of ever higher powers of the distances; and once it is plain which poses are the worst,
    Newton's method on their distances being equal.
    """
    exact, weights = problem.exact, problem.weights
    root = np.where(exact, 1.0, np.sqrt(weights / weights[~exact].mean()))
    counted = problem.distances.times(root)
    unweighted = FitProblem(counted, np.where(exact, 0.0, 1.0), exact)
    best = least_squares(problem, z, along)
    worst = np.abs(unweighted.loose * counted.only(best.z)).max(axis=-1)
    rows, power = np.flatnonzero(~(worst < SETTLED_STEP)), 2
    while len(rows) and power < MAX_POWER:
        power *= 2
        fit = least_powers(unweighted, best.z[rows], along[rows], power)
        fit = fit._replace(settled=np.zeros(len(rows), dtype=bool))
        if power >= FIRST_MINIMAX_POWER:
            minimax = _minimax(unweighted, fit, along[rows])
            fit = where(minimax.settled, minimax, fit)
        unscaled = problem.distances.at(fit.z)
        put(best, rows, GeometricFit(unscaled, root * fit.by_distance, fit.settled))
        rows = rows[~fit.settled]
    return best


class _Balance(NamedTuple):
    """Dyads (k, n) on the way to where their worst distances are equal.

    level: (k,), of these; worst: (k, W), the poses that may be worst, sign: (k, W), of their
    distances, 0 where a pose is none of them; multipliers: (k, W + e), theirs and those of the
    exact poses; along: (k, n, n), projectors; failed: (k,).
    """

    at: Point
    level: FloatArray
    worst: NDArray[np.intp]
    sign: FloatArray
    multipliers: FloatArray
    along: FloatArray
    failed: NDArray[np.bool_]

    def by_distance(self, exact: NDArray[np.bool_]) -> FloatArray:
        """The derivatives (k, N) by the distances that the multipliers stand for."""
        out, count = np.zeros(self.at.here.distance.shape), self.worst.shape[1]
        np.put_along_axis(out, self.worst, self.multipliers[:, :count] * self.sign, axis=-1)
        out[:, exact] = self.multipliers[:, count:]
        return out

    def conditions(self, exact: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
        """What has to be zero (k, W + e), and its Jacobian (k, W + e, n + 1) by z and level."""
        here, among = self.at.here, self.sign != 0
        distance = np.take_along_axis(here.distance, self.worst, axis=-1)
        gap = np.where(among, self.sign * distance - self.level[:, None], 0.0)
        jacobian = here.jacobian @ self.along
        rows = np.take_along_axis(jacobian, self.worst[..., None], axis=1)
        rows = np.concatenate([self.sign[..., None] * rows, -among[..., None].astype(float)], -1)
        held = np.pad(jacobian[:, exact], ((0, 0), (0, 0), (0, 1)))
        return (
            np.concatenate([gap, here.distance[:, exact]], axis=-1),
            np.concatenate([rows, held], axis=1),
        )


def _minimax(problem: FitProblem, near: GeometricFit, along: FloatArray) -> GeometricFit:
    """Where the worst distances are equal and the exact poses met; settled if that is a minimum.

    Newton's method on z, the level, and the multipliers of these poses.
    """
    exact, size = problem.exact, near.z.shape[1]
    right = np.eye(size + 1)[-1]

    def advance(_: NDArray[np.intp], old: _Balance) -> tuple[_Balance, NDArray[np.bool_]]:
        gap, matrix = old.conditions(exact)
        transposed, count = np.swapaxes(matrix, -1, -2), size + 1 + gap.shape[1]
        whole = np.zeros((len(gap), count, count))
        curvature = old.at.here.curvature(old.by_distance(exact))
        whole[:, :size, :size] = old.along @ curvature @ old.along
        whole[:, : size + 1, size + 1 :], whole[:, size + 1 :, : size + 1] = transposed, matrix
        residual = np.concatenate([right + matvec(transposed, old.multipliers), gap], axis=-1)
        step = -matvec(pseudo_inverse(whole, SINGULAR), residual)
        z = old.at.z + matvec(old.along, step[:, :size])
        failed = ~(np.abs(step[:, :size]).max(axis=-1) <= MAX_MINIMAX_STEP)
        at = problem.distances.at(np.where(failed[:, None], old.at.z, z))
        short = np.abs(step[:, : size + 1]).max(axis=-1) < SETTLED_STEP * (
            1 + np.abs(z).max(axis=-1)
        )
        there = old._replace(
            at=at,
            level=old.level + step[:, size],
            multipliers=old.multipliers + step[:, size + 1 :],
            failed=failed,
        )
        return there, failed | short

    start = _start(problem, near, along)
    end, _ = iterate(advance, start, np.arange(len(near.z)), MAX_MINIMAX_STEPS)
    by_distance, distance = end.by_distance(exact), np.abs(end.at.here.distance)
    gradient = np.abs(((by_distance[:, None] @ end.at.here.jacobian) @ along)[:, 0]).max(axis=-1)
    sound = ~end.failed & (gradient < BALANCE_TOLERANCE * (1 + np.abs(by_distance).max(axis=-1)))
    highest = distance[:, ~exact].max(axis=-1)
    for level in (end.level, start.level):
        sound &= highest <= level * (1 + LEVEL_TOLERANCE)
    met = EXACT_TOLERANCE * (1 + np.abs(end.at.z).max(axis=-1))
    sound &= distance[:, exact].max(axis=-1, initial=0) < met
    sound &= (end.multipliers[:, : end.worst.shape[1]] > -MULTIPLIER_ROUNDING).all(axis=-1)
    return GeometricFit(end.at, by_distance, sound)


def _start(problem: FitProblem, near: GeometricFit, along: FloatArray) -> _Balance:
    """The poses that are worst near the least sum of high powers, and their multipliers."""
    exact, (count, size) = problem.exact, near.z.shape
    shares = np.where(exact, 0.0, np.abs(near.by_distance))
    worst = np.argsort(-shares, axis=-1, kind="stable")[:, : size + 1]
    largest = np.take_along_axis(shares, worst, axis=-1)
    most = np.rint(np.trace(along, axis1=-2, axis2=-1)) - exact.sum() + 1
    among = np.arange(worst.shape[1]) < most[:, None]
    among &= largest > WORST_POSE_SHARE * shares.max(axis=-1, keepdims=True)
    distance = near.at.here.distance
    sign = np.where(among, np.sign(np.take_along_axis(distance, worst, axis=-1)), 0.0)
    level = np.where(exact, 0.0, np.abs(distance)).max(axis=-1)
    none = np.zeros((count, worst.shape[1] + int(exact.sum())))
    start = _Balance(near.at, level, worst, sign, none, along, np.zeros(count, dtype=bool))
    _, matrix = start.conditions(exact)
    balance = pseudo_inverse(np.swapaxes(matrix, -1, -2), SINGULAR)
    return start._replace(multipliers=-balance[..., -1])
