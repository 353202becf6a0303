"""Damped least squares (Levenberg-Marquardt), from many start values at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import Bundle, FloatArray, row_count, where
from burmester.numerics.iteration import iterate
from burmester.numerics.linear_algebra import solve

MAX_STEPS = 200  # of `levenberg_marquardt`, taken or refused
START_DAMPING = 1e-3  # of its first step, in units of the squared columns of the Jacobian
MIN_DAMPING, MAX_DAMPING = 1e-13, 1e13  # the same; beyond the second no step helps any more
SETTLED_COST_SHARE = 1e-14  # a Gauss-Newton step that promises less of the cost is none
RESIDUAL_ROUNDING = 1e-15  # rounding of a residual, as a share of its terms; a cost hides less


class Attempt(NamedTuple, Generic[Bundle]):
    """A damped step of rows (r,), tried.

    there: the points that it leads to; better: (r,), whether it is taken; damping: (r,), of the
    next step; ended: (r,), which rows make no further step.
    """

    there: Bundle
    better: NDArray[np.bool_]
    damping: FloatArray
    ended: NDArray[np.bool_]


def damped_descent(
    attempt: Callable[[NDArray[np.intp], Bundle, FloatArray], Attempt[Bundle]],
    start: Bundle,
    rows: NDArray[np.intp],
    *,
    damping: float,
    max_steps: int,
) -> tuple[Bundle, NDArray[np.bool_]]:
    """Damped steps of the rows of a bundle at the given indices, each until its own end.

    attempt: a step from the indices (r,) of rows, their points and their damping (r,); points
    hold all that the step needs, residuals and Jacobians in particular.
    damping: of the first step.
    Returns the points of all rows (k,), and which (k,) came to an end within `max_steps`.
    """

    def advance(
        rows: NDArray[np.intp], here: tuple[Bundle, FloatArray]
    ) -> tuple[tuple[Bundle, FloatArray], NDArray[np.bool_]]:
        point, damping = here
        tried = attempt(rows, point, damping)
        there = tried.there if tried.better.all() else where(tried.better, tried.there, point)
        return (there, tried.damping), tried.ended

    damped = (start, np.full(row_count(start), damping))
    (points, _), ended_at = iterate(advance, damped, rows, max_steps)
    return points, ended_at > 0


# Residuals (k, m) and their Jacobians (k, m, n) at x (k, n).
Kernel: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray]]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Descent:
    """Where each start value (k, n) has led.

    x: (k, n); cost: (k,), the sum of squares, inf where the start value has none;
    steps: (k,), taken; evaluations: (k,), of the kernel.
    converged: (k,), a Gauss-Newton step promises to take no more than 1e-14 of the cost off, or
        what rounding hides; a valley that sinks to infinity is not at its end.
    """

    x: FloatArray
    cost: FloatArray
    steps: NDArray[np.int_]
    evaluations: NDArray[np.int_]
    converged: NDArray[np.bool_]


class _Point(NamedTuple):
    """Values x (k, n), their cost (k,), and the normal equations there, in units `scale` (k, n).

    scale: the greatest columns of the Jacobian on the way here; normal: (k, n, n), JᵀJ; gradient:
    (k, n), half that of the cost; sound: (k,), whether cost and Jacobian are finite.
    """

    x: FloatArray
    cost: FloatArray
    scale: FloatArray
    normal: FloatArray
    gradient: FloatArray
    sound: NDArray[np.bool_]
    converged: NDArray[np.bool_]

    @classmethod
    def at(cls, kernel: Kernel, x: FloatArray, scale: FloatArray) -> _Point:
        """The point at x, its Jacobian's columns in units no smaller than `scale`."""
        with np.errstate(all="ignore"):
            residual, jacobian = kernel(x)
            cost = (residual**2).sum(axis=-1)
            columns = np.linalg.norm(jacobian, axis=-2)
            sound = np.isfinite(cost) & np.isfinite(columns).all(axis=-1)
            jacobian = np.where(sound[:, None, None], jacobian, 0.0)
            scale = np.maximum(scale, columns)
            scaled = jacobian / np.where(scale > 0, scale, 1.0)[:, None, :]
            gradient = (residual[:, None, :] @ scaled)[:, 0]
            normal = np.swapaxes(scaled, -1, -2) @ scaled
            gauss_newton = _damped_step(normal, gradient, np.full(len(x), MIN_DAMPING))
            terms = (columns * np.abs(x)).sum(axis=-1)
            least = SETTLED_COST_SHARE * cost + RESIDUAL_ROUNDING * terms * np.sqrt(cost)
            converged = sound & (-(gauss_newton * gradient).sum(axis=-1) <= least)
            cost = np.where(np.isfinite(cost), cost, np.inf)
        return cls(x, cost, scale, normal, gradient, sound, converged)


def levenberg_marquardt(kernel: Kernel, x: FloatArray) -> Descent:
    """The least sums of squares that lie downhill from each x (k, n).

    Steps are damped in units of the greatest columns of derivatives met so far (Moré 1978), by
    a damping that follows the gain of the last step (Nielsen 1999).
    """
    start = _Point.at(kernel, x, np.zeros(x.shape))
    growth = np.full(len(x), 2.0)  # of the damping, after a refused step
    steps, evaluations = np.zeros(len(x), dtype=int), np.ones(len(x), dtype=int)

    def attempt(rows: NDArray[np.intp], here: _Point, damping: FloatArray) -> Attempt[_Point]:
        step = _damped_step(here.normal, here.gradient, damping)
        promise = (step * (damping[:, None] * step - here.gradient)).sum(axis=-1)
        unit = np.where(here.scale > 0, here.scale, 1.0)
        there = _Point.at(kernel, here.x + step / unit, here.scale)
        with np.errstate(all="ignore"):
            gain = (here.cost - there.cost) / promise
            factor = np.maximum(1 / 3, 1 - (2 * gain - 1) ** 3)
        better = (gain > 0) & there.sound
        raised = damping * growth[rows]
        damping = np.where(better, np.maximum(damping * factor, MIN_DAMPING), raised)
        growth[rows] = np.where(better, 2.0, 2 * growth[rows])
        steps[rows] += better
        evaluations[rows] += 1
        ended = (better & there.converged) | (damping >= MAX_DAMPING)
        return Attempt(there, better, damping, ended)

    rows = np.flatnonzero(start.sound & ~start.converged)
    ends, _ = damped_descent(attempt, start, rows, damping=START_DAMPING, max_steps=MAX_STEPS)
    return Descent(ends.x, ends.cost, steps, evaluations, ends.converged)


def _damped_step(normal: FloatArray, gradient: FloatArray, damping: FloatArray) -> FloatArray:
    """The steps (k, n) downhill for normal equations (k, n, n) with a multiple of 1 added."""
    return -solve(normal + damping[:, None, None] * np.eye(gradient.shape[-1]), gradient)
