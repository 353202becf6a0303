"""Levenberg-Marquardt: least sums of squares from many start values at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

__all__ = ["Descent", "Kernel", "levenberg_marquardt"]

STEPS = 200  # at most, taken or refused
DAMPING = 1e-3  # of a first step, in units of the squared columns of derivatives
LEAST_DAMPING, MOST_DAMPING = 1e-13, 1e13
SETTLED = 1e-14  # share of the cost that a free step may still promise at the end
ROUNDING = 1e-15  # of the terms of a residual; a cost does not show less

# Residuals (k, m) and their derivatives (k, m, n) at x (k, n).
Kernel: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray]]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Descent:
    """Where each start value (k, n) has led.

    x: (k, n); cost: (k,), the sum of squares, inf where the start value has none;
    steps: (k,), taken; evaluations: (k,), of the kernel.
    converged: (k,), a free (Gauss-Newton) step promises to take no more than 1e-14 of the
        cost off, or what rounding hides; a slope that sinks to infinity is not at its end.
    """

    x: FloatArray
    cost: FloatArray
    steps: NDArray[np.int_]
    evaluations: NDArray[np.int_]
    converged: NDArray[np.bool_]


def levenberg_marquardt(kernel: Kernel, x: FloatArray) -> Descent:
    """The least sums of squares that lie downhill from each x (k, n).

    Steps are damped in units of the greatest columns of derivatives met so far (Moré 1978), by
    a damping that follows the gain of the last step (Nielsen 1999).
    """
    x = x.copy()
    miss, slope = kernel(x)
    cost = (miss**2).sum(axis=-1)
    cost = np.where(np.isfinite(cost), cost, np.inf)
    size = np.linalg.norm(slope, axis=-2)
    damping, raised = np.full(len(x), DAMPING), np.full(len(x), 2.0)
    steps, evaluations = np.zeros(len(x), dtype=int), np.ones(len(x), dtype=int)
    converged = np.zeros(len(x), dtype=bool)
    going = np.flatnonzero(np.isfinite(cost) & np.isfinite(size).all(axis=-1))
    for _ in range(STEPS):
        unit = np.where(size[going] > 0, size[going], 1.0)
        j = slope[going] / unit[:, None, :]
        pull = (miss[going][:, None, :] @ j)[:, 0]
        square = np.swapaxes(j, -1, -2) @ j
        free = _damped(square, pull, np.full(len(going), LEAST_DAMPING))
        terms = (np.linalg.norm(slope[going], axis=-2) * np.abs(x[going])).sum(axis=-1)
        least = SETTLED * cost[going] + ROUNDING * terms * np.sqrt(cost[going])
        converged[going] = -(free * pull).sum(axis=-1) <= least
        keep = ~converged[going] & (damping[going] < MOST_DAMPING)
        going, unit, pull, square = going[keep], unit[keep], pull[keep], square[keep]
        if not len(going):
            break
        step = _damped(square, pull, damping[going])
        promise = (step * (damping[going, None] * step - pull)).sum(axis=-1)
        trial = x[going] + step / unit
        with np.errstate(all="ignore"):
            new_miss, new_slope = kernel(trial)
            new_cost = (new_miss**2).sum(axis=-1)
            gain = (cost[going] - new_cost) / promise
        evaluations[going] += 1
        better = (gain > 0) & np.isfinite(new_slope).all(axis=(-1, -2))
        at, factor = going[better], 1 - (2 * gain[better] - 1) ** 3
        x[at], miss[at], slope[at] = trial[better], new_miss[better], new_slope[better]
        cost[at], steps[at] = new_cost[better], steps[at] + 1
        size[at] = np.maximum(size[at], np.linalg.norm(slope[at], axis=-2))
        damping[at] = np.maximum(damping[at] * np.maximum(1 / 3, factor), LEAST_DAMPING)
        raised[at] = 2.0
        at = going[~better]
        damping[at], raised[at] = damping[at] * raised[at], 2 * raised[at]
    return Descent(x, cost, steps, evaluations, converged)


def _damped(square: FloatArray, pull: FloatArray, damping: FloatArray) -> FloatArray:
    """The steps (k, n) downhill from gradients `pull`, in a bowl `square` made rounder."""
    bowl = square + damping[:, None, None] * np.eye(pull.shape[-1])
    return -np.asarray(np.linalg.solve(bowl, pull[..., None])[..., 0])
