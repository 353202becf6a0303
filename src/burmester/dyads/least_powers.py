"""The least sum of squares of true distances, or of higher powers of them, by Newton's method.

Many dyads at once, and each goes to its own end.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import (
    DIVISOR_FLOOR,
    NEGLIGIBLE_GAIN,
    Distances,
    FitProblem,
    GeometricFit,
    Point,
)
from burmester.numerics.arrays import FloatArray
from burmester.numerics.iteration import iterate
from burmester.numerics.linear_algebra import matvec

MIN_SCALE = 1e-100  # lengths; distances below this are not magnified by higher powers
MAX_NEWTON_STEPS = 40  # of a sum of powers
MAX_FREE_STEPS = 30  # to a free minimum
MAX_RESTORING_STEPS = 8  # of Newton's method back to the exact poses
SETTLED_STEP = 1e-13  # relative; a shorter step is rounding, and ends an iteration
NEAR_STEP = 1e-9  # relative; a shorter step is the last one to a free minimum
MAX_SIZE = 1e3  # characteristic lengths; a circle with greater coordinates is a line
# A step is tried with these factors before it is given up, those of a row at once.
FACTORS = 4.0 ** -np.arange(1, 21).reshape(5, 4)
FLAT_EIGENVALUE = 1e-14  # share of the greatest; directions below it are not moved along
SUM_ROUNDING = 1e-13  # share of a sum of powers, by which it may grow in a step
RANK_TOLERANCE = 1e-12  # share of the greatest singular value, below which one is zero
MET = 1e-14  # relative; an exact pose missed by less is not restored


class _Way(NamedTuple):
    """Dyads z (k, n) on their way, and which have come to rest (k,)."""

    z: FloatArray
    settled: NDArray[np.bool_]


def least_squares(problem: FitProblem, z: FloatArray, along: FloatArray) -> GeometricFit:
    """The local minima of the weighted sum of squared distances, by Newton's method.

    along: (k, n, n), projectors on the directions in which dyads z (k, n) may move.
    Where the sum is not convex, Gauss and Newton's step is taken.  After every step the exact
    poses are met again; a step is shortened until it helps.
    """
    return least_powers(problem, z, along, 2)


def least_squares_step(problem: FitProblem, at: Point, along: FloatArray) -> GeometricFit:
    """One step of `least_squares`."""
    if problem.exact.any():
        at = problem.distances.at(_restored(problem, at.z, along, at.here.distance))
    there, _, failed = _newton_step(problem, at, along, 2)
    return _fit(problem, there, along, 2, failed | _rests(at.z, there, SETTLED_STEP))


def free_minima(problem: FitProblem, z: FloatArray, along: FloatArray) -> FloatArray:
    """The local minima (k, n) of the weighted sum of squares near dyads z, with fewer digits.

    Not a number where a dyad does not come to rest where the sum is convex, or grows so far that
    it is a slider.
    """

    def advance(rows: NDArray[np.intp], at: _Way) -> tuple[_Way, NDArray[np.bool_]]:
        there, convex, failed = _newton_step(problem, problem.distances.at(at.z), along[rows], 2)
        settled = convex & _rests(at.z, there, NEAR_STEP)
        too_far = np.abs(there).max(axis=-1) > MAX_SIZE
        return _Way(there, settled), settled | failed | too_far

    z = _restored(problem, z, along, problem.distances.only(z))
    start = _Way(z, np.zeros(len(z), dtype=bool))
    ends, _ = iterate(advance, start, np.arange(len(z)), MAX_FREE_STEPS)
    return np.where(ends.settled[:, None], ends.z, np.nan)


def least_powers(problem: FitProblem, z: FloatArray, along: FloatArray, power: int) -> GeometricFit:
    """The local minima of the weighted sum of some even power of the distances.

    Formula `powers` of the theory.
    """

    def advance(rows: NDArray[np.intp], at: _Way) -> tuple[_Way, NDArray[np.bool_]]:
        here = problem.distances.at(at.z)
        there, _, failed = _newton_step(problem, here, along[rows], power)
        settled = failed | _rests(at.z, there, SETTLED_STEP)
        return _Way(there, settled), settled

    z = _restored(problem, z, along, problem.distances.only(z))
    start = _Way(z, np.zeros(len(z), dtype=bool))
    ends, _ = iterate(advance, start, np.arange(len(z)), MAX_NEWTON_STEPS)
    return _fit(problem, ends.z, along, power, ends.settled)


def _rests(before: FloatArray, after: FloatArray, tolerance: float) -> NDArray[np.bool_]:
    """Whether steps from dyads (k, n) to others were shorter than a share of their size."""
    size = 1 + np.abs(after).max(axis=-1)
    return np.asarray(np.abs(after - before).max(axis=-1) < tolerance * size)


def _fit(
    problem: FitProblem, z: FloatArray, along: FloatArray, power: int, settled: NDArray[np.bool_]
) -> GeometricFit:
    """The end of a fit, with the objective's derivatives."""
    here = problem.distances.of(z)
    gradient = _leaning(problem, here.distance, power) * here.distance
    by_distance = _with_multipliers(problem, here, along, gradient)
    return GeometricFit(Point(z, here), by_distance, settled)


def _scale(problem: FitProblem, distance: FloatArray) -> FloatArray:
    """The greatest of the distances (k, N) that count, (k, 1)."""
    counted = np.abs(distance) * (problem.loose > 0)
    return np.asarray(np.maximum(counted.max(axis=-1, keepdims=True, initial=0), MIN_SCALE))


def _leaning(problem: FitProblem, distance: FloatArray, power: int) -> FloatArray:
    """What poses (k, N) count as in a sum of squares that has the gradient of the powers."""
    if power == 2:
        return np.broadcast_to(problem.loose, distance.shape)
    shares = np.minimum(np.abs(distance) / _scale(problem, distance), 1.0)
    return np.asarray(problem.loose * shares ** (power - 2))


def _newton_step(
    problem: FitProblem, at: Point, along: FloatArray, power: int
) -> tuple[FloatArray, NDArray[np.bool_], NDArray[np.bool_]]:
    """A Newton or Gauss-Newton step: where it leads, positive Hessians, where none helps (k,)."""
    here = at.here
    weighted = _leaning(problem, here.distance, power)
    by_distance = _with_multipliers(problem, here, along, weighted * here.distance)
    free = along
    if problem.exact.any():
        held = here.jacobian[:, problem.exact] @ along
        free = along - pseudo_inverse(held) @ held
    jacobian, weights = here.jacobian @ free, (power - 1) * weighted[..., None]
    gradient = (by_distance[:, None] @ jacobian)[:, 0]
    gauss_newton = np.swapaxes(weights * jacobian, -1, -2) @ jacobian
    # Directions that are not free belong to a sum of their own: no step leads along them.
    unit = (weights * here.jacobian**2).sum(axis=(-2, -1))[:, None, None]
    gauss_newton += np.maximum(unit, DIVISOR_FLOOR) * (np.eye(at.z.shape[-1]) - free)
    hessian = gauss_newton + free @ here.curvature(by_distance) @ free
    sound = np.asarray(np.isfinite(hessian).all(axis=(-2, -1)))
    if not sound.all():  # beyond all measure: there no step is made
        hessian[~sound], gauss_newton[~sound], gradient[~sound] = np.eye(at.z.shape[-1]), 0.0, 0.0
    values, axes = np.linalg.eigh(hessian)
    convex = values[:, 0] > 0
    if not convex.all():
        values[~convex], axes[~convex] = np.linalg.eigh(gauss_newton[~convex])
    known = values > FLAT_EIGENVALUE * np.maximum(values[:, -1:], DIVISOR_FLOOR)
    uphill = (gradient[:, None] @ axes)[:, 0]
    uphill = np.where(known, uphill / np.where(known, values, 1.0), 0.0)
    step = -matvec(free, matvec(axes, uphill))
    gain = np.where(convex, -(step * gradient).sum(axis=-1), np.inf)
    z, failed = _shortened(problem, at, along, _Step(step, gain, power))
    return z, convex, failed


class _Step(NamedTuple):
    """Steps (k, n), and what they gain of a sum of powers (k,), were it its second-order model."""

    step: FloatArray
    gain: FloatArray
    power: int


def _shortened(
    problem: FitProblem, at: Point, along: FloatArray, taken: _Step
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Where steps, divided by four until they help, lead; those of before where none does (k,)."""
    step, gain, power = taken
    unit, loose = _scale(problem, at.here.distance), problem.loose

    def total(distance: FloatArray, unit: FloatArray) -> FloatArray:
        with np.errstate(over="ignore"):
            return np.asarray((np.where(loose > 0, distance, 0.0) / unit) ** power @ loose)

    before = total(at.here.distance, unit)
    # Newton's last steps gain so little that the sum would tell by its rounding only.
    negligible = (gain < NEGLIGIBLE_GAIN * before * unit[:, 0] ** 2) & (power == 2)
    allowed = np.where(negligible, np.inf, before * (1 + SUM_ROUNDING))
    moves = np.asarray(step.any(axis=-1))
    there, distance = _moved(problem, at.z + step, along, power)
    there = np.where(moves[:, None], there, at.z)
    worse = np.flatnonzero(moves & ~(total(distance, unit) <= allowed))
    for factors in FACTORS:
        if not len(worse):
            break
        rows = np.repeat(worse, len(factors))
        factor = np.tile(factors, len(worse))[:, None]
        trial, distance = _moved(problem, at.z[rows] + factor * step[rows], along[rows], power)
        better = (total(distance, unit[rows]) <= allowed[rows]).reshape(-1, len(factors))
        first, helps = better.argmax(axis=1), better.any(axis=1)
        chosen = np.arange(len(worse)) * len(factors) + first
        there[worse[helps]] = trial[chosen[helps]]
        worse = worse[~helps]
    there[worse] = at.z[worse]
    failed = np.zeros(len(step), dtype=bool)
    failed[worse] = True
    return there, failed


def _moved(
    problem: FitProblem, z: FloatArray, along: FloatArray, power: int
) -> tuple[FloatArray, FloatArray]:
    """Dyads z (k, n) where exact poses are met, else of the best level; their distances (k, N)."""
    distance, level, held = problem.distances.only(z), problem.distances.level, problem.exact
    if power == 2 or held.any():
        weights = held if held.any() else problem.weights
        free = along[:, level, level] > 1 - RANK_TOLERANCE
        raised = np.where(free, distance @ weights / weights.sum(), 0.0)
        z = z + raised[:, None] * np.eye(z.shape[1])[level]
        distance = distance - raised[:, None]
    if held.any():
        z = _restored(problem, z, along, distance)
        distance = problem.distances.only(z)
    return z, distance


def _restored(
    problem: FitProblem, z: FloatArray, along: FloatArray, distance: FloatArray
) -> FloatArray:
    """Dyads (k, n) moved along to where exact poses are met, by Newton's method."""
    if not problem.exact.any():
        return z

    def missed(z: FloatArray, distance: FloatArray) -> NDArray[np.bool_]:
        gap = np.abs(distance[:, problem.exact]).max(axis=-1)
        return np.asarray(~(gap <= MET * (1 + np.abs(z).max(axis=-1))))

    z, rows = z.copy(), np.flatnonzero(missed(z, distance))
    for _ in range(MAX_RESTORING_STEPS):
        if not len(rows):
            break
        here = problem.distances.of(z[rows])
        across = here.jacobian[:, problem.exact] @ along[rows]
        step = matvec(along[rows] @ pseudo_inverse(across), here.distance[:, problem.exact])
        z[rows] -= step
        size = 1 + np.abs(z[rows]).max(axis=-1)
        short = np.abs(step).max(axis=-1) < SETTLED_STEP * size
        rows = rows[~short]
    return z


def _with_multipliers(
    problem: FitProblem, here: Distances, along: FloatArray, gradient: FloatArray
) -> FloatArray:
    """The gradient (k, N) by the distances, with the multipliers of exact poses in their places."""
    if not problem.exact.any():
        return gradient
    jacobian = here.jacobian @ along
    left = (gradient[:, None] @ jacobian)[:, 0]
    multipliers = np.zeros(gradient.shape)
    held = pseudo_inverse(np.swapaxes(jacobian[:, problem.exact], -1, -2))
    multipliers[:, problem.exact] = -matvec(held, left)
    return gradient + multipliers


def pseudo_inverse(matrix: FloatArray, tolerance: float = RANK_TOLERANCE) -> FloatArray:
    """The pseudo-inverses of matrices (k, m, n); of one that is not finite, no numbers.

    tolerance: share of the greatest singular value, below which one is zero.
    """
    if 1 in matrix.shape[1:]:
        square = (matrix**2).sum(axis=(-2, -1), keepdims=True)
        return np.asarray(np.swapaxes(matrix, -1, -2) / np.where(square > 0, square, np.inf))
    sound = np.asarray(np.isfinite(matrix).all(axis=(-2, -1)))[:, None, None]
    if not (whole := bool(sound.all())):
        matrix = np.where(sound, matrix, 0.0)
    # As `np.linalg.pinv` does, which takes twice as long for a few small ones.
    u, values, v = np.linalg.svd(matrix, full_matrices=False)
    kept = values > tolerance * values[:, :1]
    values = np.divide(1.0, values, out=np.zeros_like(values), where=kept)
    inverse = np.swapaxes(v, -1, -2) @ (values[..., None] * np.swapaxes(u, -1, -2))
    return inverse if whole else np.where(sound, inverse, np.nan)
