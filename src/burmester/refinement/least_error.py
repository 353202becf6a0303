"""The refinement of linkages: all dimensions at once, for the least error at the poses.

Two dyads that are best one by one do not make the best linkage.  Gauss and Newton's method moves
the coupler's nearest places towards the poses, on their circuits, in all ten dimensions of both
dyads (four of each slider), with exact derivatives (`residuals`).  With constraints (limits, a
branch, exact poses) quadratic programs take its place (`constrained_refinement`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, take
from burmester.numerics.least_squares import Attempt, damped_descent
from burmester.numerics.linear_algebra import matvec, solve
from burmester.refinement.constraints import Constraints
from burmester.refinement.residuals import (
    SIZE,
    Linearisation,
    Problem,
    State,
    linearised,
    power_ratio,
    secant,
)
from burmester.refinement.under_constraints import (
    CONVERGED_STEP,
    COST_ROUNDING,
    MAX_DAMPING,
    MIN_DAMPING,
    START_DAMPING,
    STEPS_BEFORE_CURVATURE,
    Selection,
    refine_constrained,
)

MAX_STEPS = 60  # number of steps without constraints at most
MAX_CONSTRAINED_STEPS = 120  # number of steps with constraints at most
# Exponents of the distances in the sums that are minimised one after the other; the minimum of the
# last is nearly the one of the greatest distance.
POWERS = (2.0, 8.0, 32.0, 128.0, 512.0)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Refined:
    """Refined linkages (k,), in the frames in which they were given.

    rows: (k, N, 3), the coupler's places as x, y, length x angle; nan where a linkage was lost.
    cost: (k,), half the weighted sum of squared distances (or the greatest distance).
    settled: (k,), whether the steps converged; met: (k,), whether all constraints hold.
    """

    batch: LinkageBatch
    rows: FloatArray
    cost: FloatArray
    settled: NDArray[np.bool_]
    met: NDArray[np.bool_]


def refine(
    batch: LinkageBatch,
    places: Displacement,
    poses: Displacement,
    length: float,
    *,
    weights: FloatArray | None = None,
    exact: NDArray[np.bool_] | None = None,
    constraints: Constraints | None = None,
    free: NDArray[np.bool_] | None = None,
    metric: FloatArray | None = None,
    worst: bool = False,
    steps: int = MAX_STEPS,
    constrained_steps: int = MAX_CONSTRAINED_STEPS,
    selection: Selection = (),
    damping: float = START_DAMPING,
) -> Refined:
    """Linkages (k,) refined to a local minimum of the error at poses (N,).

    In frames where lengths are about 1 (`pose_error.error_frames`), from places (k, N) nearest to
    the poses.  Places change continuously, so they stay on their circuits.

    Formula `refinement-step` of the theory.

    weights, exact: (N,), of the squared distances; poses that are met exactly.
    free: (k, 10), the dimensions that may change; by default all.
    metric: (k, N, 3, 3), times the gap (x, y, length x angle) gives what counts at each pose.
    worst: the greatest distance is least, to half a percent: by sums of ever higher powers.
    selection: numbers of constrained steps, and after each how many of the best linkages go on;
    the others are not `met`.
    damping: the first one without constraints; less for linkages nearly at a minimum.
    """
    count = len(batch)
    problem = Problem.of(
        batch,
        poses,
        length,
        weights=weights,
        exact=exact,
        constraints=constraints,
        free=free,
        metric=metric,
    )
    state = problem.start(batch.dimensions.reshape(count, SIZE), rows_of(places, length))
    keeping = bool(problem.exact.any()) or constraints is not None
    rows, met = state.rows, np.ones(count, dtype=bool)
    for power in POWERS if worst else POWERS[:1]:
        if keeping:
            z, rows, done, met = refine_constrained(
                problem, state.z, rows, power, constrained_steps, selection=selection
            )
            state = state._replace(z=z)
        else:
            state, done = _descend(problem, state, power, steps, damping)
            rows = state.rows
    away = problem.counted(np.arange(count), rows - problem.wanted)
    size = problem.share * np.sqrt((away**2).sum(axis=-1))
    cost = size.max(axis=-1) if worst else (size * size).sum(axis=-1) / 2
    lost = ~np.isfinite(cost)
    return Refined(problem.batch(np.arange(count), state.z), rows, cost, done & ~lost, met & ~lost)


class _Point(NamedTuple):
    """Linkages (k,) with their places, and the residuals that a step makes less."""

    state: State
    model: Linearisation


def _descend(
    problem: Problem, state: State, power: float, steps: int, damping: float
) -> tuple[State, NDArray[np.bool_]]:
    """Levenberg and Marquardt's method without conditions."""
    count = len(state.z)
    start = _Point(state, linearised(problem, np.arange(count), state, power))
    hessian_estimate, good_steps = np.zeros((count, SIZE, SIZE)), np.zeros(count, dtype=int)

    def attempt(rows: NDArray[np.intp], here: _Point, damping: FloatArray) -> Attempt[_Point]:
        free = problem.free[rows]
        step = _step(here.model, damping, free)
        use_curvature = good_steps[rows] >= STEPS_BEFORE_CURVATURE
        if use_curvature.any():
            step[use_curvature] = _curved_step(
                take(here.model, use_curvature),
                hessian_estimate[rows[use_curvature]],
                damping[use_curvature],
            )
        step = np.where(free, step, 0.0)  # but for rounding it is so
        step, shift = problem.limited(here.state, step)
        z = here.state.z + step
        state = problem.state(rows, z, here.state.rows + shift)
        there = _Point(state, linearised(problem, rows, state, power))
        with np.errstate(invalid="ignore", over="ignore"):
            before, after = (
                (point.model.residual * point.model.residual).sum(axis=-1)
                for point in (here, there)
            )
        if power != 2.0:  # measured in the top distance of before
            after = after * power_ratio(problem, here.state, state, power)
        better = problem.sound(rows, z) & (after <= before * (1 + COST_ROUNDING))
        refused = np.where(use_curvature, 0, good_steps[rows])
        good_steps[rows] = np.where(better, good_steps[rows] + 1, refused)
        taken = rows[better]
        hessian_estimate[taken] = secant(
            hessian_estimate[taken],
            step[better],
            take(here.model, better),
            take(there.model, better),
        )
        damping = np.clip(np.where(better, damping / 10, damping * 10), MIN_DAMPING, None)
        small = np.abs(step).max(axis=-1) < CONVERGED_STEP * (1 + np.abs(here.state.z).max(axis=-1))
        idle = better & (before - after < COST_ROUNDING * before)
        return Attempt(there, better, damping, small | idle | (damping > MAX_DAMPING))

    rows = np.flatnonzero(np.isfinite(state.rows).all(axis=(1, 2)))
    ends, done = damped_descent(attempt, start, rows, damping=damping, max_steps=steps)
    return ends.state, done


def _step(model: Linearisation, damping: FloatArray, free: NDArray[np.bool_]) -> FloatArray:
    """Levenberg and Marquardt's step (k, 10)."""
    residual, jacobian = model
    size = np.sqrt((jacobian * jacobian).sum(axis=1))
    top = size.max(axis=-1, keepdims=True) + np.finfo(float).tiny
    size = np.where(free, np.maximum(size, 1e-12 * top), top)
    whole = np.concatenate([jacobian / size[:, None], residual[..., None]], axis=-1)
    low = np.zeros((len(residual), SIZE, SIZE + 1))
    low[:, range(SIZE), range(SIZE)] = np.sqrt(damping)[:, None]
    upper = np.asarray(np.linalg.qr(np.concatenate([whole, low], axis=1), mode="r"))
    return np.asarray(-solve(upper[:, :SIZE, :SIZE], upper[:, :SIZE, SIZE]) / size)


def _curved_step(
    model: Linearisation, hessian_estimate: FloatArray, damping: FloatArray
) -> FloatArray:
    """Newton's step (k, 10), with what is known of the curvature of the residuals."""
    flat = np.swapaxes(model.jacobian, -1, -2) @ model.jacobian
    size = np.sqrt(np.maximum(np.einsum("kii->ki", flat), np.finfo(float).tiny))
    size = np.maximum(size, 1e-12 * size.max(axis=-1, keepdims=True))
    gradient = model.gradient(model.residual) / size
    values, axes = np.linalg.eigh((flat + hessian_estimate) / (size[:, None] * size[..., None]))
    values = np.maximum(np.abs(values), 1e-8) + damping[:, None]
    along = matvec(np.swapaxes(axes, -1, -2), gradient) / values
    return np.asarray(-matvec(axes, along) / size)
