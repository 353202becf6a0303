"""Quadratic programs with soft constraints, many at once: the step of a constrained descent.

min over s of  s · H s / 2 + c · s + sum of rho |w_i| over equalities + rho max(0, w_i) over the
inequalities, with w = g + G s.  It always has a solution; for rho large enough it keeps all
constraints that can be kept together.

Solved in its multipliers y, each within 0 and rho (-rho and rho for equalities).  They minimise
y · A y / 2 - b · y with A = G inv(H) Gᵀ, and w is b - A y.  Newton's method does so on the
multipliers that are not held by a bound; its steps are bent at the bounds (Bertsekas, Projected
Newton methods for optimization problems with simple constraints, SIAM J. Control Optim. 20, 1982)
and go as far as is best, or down the gradient where that is better (Moré and Toraldo, On the
solution of large quadratic programming problems with bound constraints, SIAM J. Optim. 1, 1991).
Started from the multipliers of a program like it, one or two steps are enough.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import matvec, solve

__all__ = ["SoftProgram"]

MAX_STEPS = 8  # of the projected Newton method; a program that needs more is solved nearly
SHARES_DOWNHILL = np.array([1.0, 0.3, 0.1])  # of the gradient that are tried beside Newton's step
SETTLED = 1e-11  # of the terms of w; a free constraint that is off by less is met
HEIGHT_ROUNDING = 1e-13  # relative; a smaller decrease ends the steps
ROUNDING = 1e-12  # added to A's diagonal in units of it, for steps with dependent constraints


class SoftProgram(NamedTuple):
    """Programs (k,) in n unknowns with m soft constraints.

    hessian: (k, n, n), H, positive definite; gradient: (k, n), c; value: (k, m), g, and jacobian:
    (k, m, n), G, of the constraints; low, high: (k, m), the bounds of the multipliers.
    """

    hessian: FloatArray
    gradient: FloatArray
    value: FloatArray
    jacobian: FloatArray
    low: FloatArray
    high: FloatArray

    def solved(self, start: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
        """The solutions, from multipliers to start with (k, m).

        Returns the steps s (k, n) and the multipliers y (k, m).
        """
        hessian, gradient, value, jacobian, low, high = self
        if not value.shape[1]:
            return solve(hessian, -gradient), np.zeros_like(value)
        right = np.concatenate([gradient[..., None], np.swapaxes(jacobian, -1, -2)], axis=-1)
        solutions = np.linalg.solve(hessian, right)
        products = jacobian @ solutions
        matrix, b = products[..., 1:], value - products[..., 0]
        y = np.clip(0.0 if start is None else start, low, high)
        y = np.clip(_multipliers(matrix, b, y, low, high), low, high)
        return -solutions[..., 0] - matvec(solutions[..., 1:], y), y


def _multipliers(
    matrix: FloatArray, b: FloatArray, y: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """The y (k, m) with the least y · A y / 2 - b · y between low and high, from y.

    As near as `MAX_STEPS` steps come; each of them is downhill.
    """
    diagonal = np.einsum("kii->ki", matrix)
    least = ROUNDING * diagonal.max(axis=1, keepdims=True) + np.finfo(float).tiny
    size, eye = np.sqrt(np.maximum(diagonal, least)), np.eye(b.shape[1])
    matrix = matrix / (size[:, :, None] * size[:, None])
    y, low, high, b = y * size, low * size, high * size, b / size
    run = np.arange(len(y))
    for _ in range(MAX_STEPS):
        a, c, here, least, most = matrix[run], b[run], y[run], low[run], high[run]
        off = c - matvec(a, here)  # w, and the way downhill
        free = ~(((here <= least) & (off < 0)) | ((here >= most) & (off > 0)))
        downhill = np.where(free, off, 0.0)
        terms = np.abs(np.where(free, c, here)).max(axis=1)
        going = np.abs(downhill).max(axis=1) > SETTLED * terms
        if not going.all():
            run = run[going]
            if not len(run):
                break
            a, c, here, off, free = a[going], c[going], here[going], off[going], free[going]
            least, most, downhill = least[going], most[going], downhill[going]
        step = _newton_step(a, downhill, free, eye)
        held = free & (((here <= least) & (step < 0)) | ((here >= most) & (step > 0)))
        if held.any():
            free &= ~held
            step = _newton_step(a, downhill, free, eye)
        # Along the step bent at the bounds: at its end, at each bend, and a little downhill.
        with np.errstate(divide="ignore", invalid="ignore"):
            reach = np.where(step > 0, most - here, least - here) / step
        share = np.where(step == 0, 1.0, np.minimum(reach, 1.0))
        share = np.concatenate([np.ones((len(run), 1)), share], axis=1)
        ways = share[..., None] * step[:, None]
        ways = np.concatenate([ways, SHARES_DOWNHILL[:, None] * downhill[:, None]], axis=1)
        tried = np.clip(here[:, None] + ways, least[:, None], most[:, None])
        height = ((tried @ a / 2 - c[:, None]) * tried).sum(axis=-1)
        every, best = np.arange(len(run)), height.argmin(axis=1)
        before = -((c + off) * here).sum(axis=-1) / 2
        better = before - height[every, best] > HEIGHT_ROUNDING * np.abs(before)
        y[run[better]] = tried[every, best][better]
        run = run[better]
        if not len(run):
            break
    return np.asarray(y / size)


def _newton_step(
    matrix: FloatArray, downhill: FloatArray, free: NDArray[np.bool_], eye: FloatArray
) -> FloatArray:
    """Newton's step (k, m) of the free multipliers; the others keep still."""
    own = np.where(free[:, :, None] & free[:, None], matrix + ROUNDING * eye, eye)
    return solve(own, np.where(free, downhill, 0.0))
