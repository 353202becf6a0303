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

STEPS_FROM_START = 2  # of the projected Newton method from multipliers that may be far off
STEPS_FROM_INSIDE = 4  # of it from where the interior-point method led
INTERIOR_STEPS = 25  # of the interior-point method; it takes about ten
INSIDE = 0.995  # share of the way to the nearest bound
SETTLED_GAP = 1e-9  # of the height; a smaller gap between what is reached and possible is none
SHARES_DOWNHILL = np.array([1.0, 0.3, 0.1])  # of the gradient that are tried beside Newton's step
SETTLED = 1e-11  # of the terms of w; a free constraint that is off by less is met
HEIGHT_ROUNDING = 1e-13  # relative; a smaller decrease ends the steps
ROUNDING = 1e-12  # added to A's diagonal in units of it, for steps with dependent constraints
SMALLEST = 1e-6  # relative; a row of the root of A that is shorter counts as that long


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
        factor = np.linalg.cholesky(hessian)
        right = np.concatenate([gradient[..., None], np.swapaxes(jacobian, -1, -2)], axis=-1)
        solutions = np.linalg.solve(factor, right)
        down, root = solutions[..., 0], np.swapaxes(solutions[..., 1:], -1, -2)
        y = np.clip(0.0 if start is None else start, low, high)
        y = np.clip(_multipliers(root, value - matvec(root, down), y, low, high), low, high)
        down = down + (y[:, None] @ root)[:, 0]
        return solve(np.swapaxes(factor, -1, -2), -down), y


def _multipliers(
    root: FloatArray, b: FloatArray, y: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """The y (k, m) with the least |y root|² / 2 - b · y between low and high, from y.

    root: (k, m, n), a root of A.
    """
    size = np.linalg.norm(root, axis=2)
    size = np.maximum(size, SMALLEST * size.max(axis=1, keepdims=True) + np.finfo(float).tiny)
    box = _BoxProgram(root / size[..., None], b / size, low * size, high * size)
    y, settled = box.descended(y * size, STEPS_FROM_START)
    hard = np.flatnonzero(~settled)
    if len(hard):
        box = _BoxProgram(*(each[hard] for each in box))
        y[hard], _ = box.descended(box.interior(), STEPS_FROM_INSIDE)
    return np.asarray(y / size)


class _BoxProgram(NamedTuple):
    """Programs (k,) for m multipliers between bounds, the rows of the root of A of unit length."""

    root: FloatArray
    b: FloatArray
    low: FloatArray
    high: FloatArray

    def descended(self, y: FloatArray, steps: int) -> tuple[FloatArray, NDArray[np.bool_]]:
        """The y (k, m) after steps of the projected Newton method, and which of them settled.

        Each step is downhill.
        """
        run, settled = np.arange(len(y)), np.zeros(len(y), dtype=bool)
        for last in range(steps + 1):
            (root, b, low, high), here = (each[run] for each in self), y[run]
            reached = (here[:, None] @ root)[:, 0]
            off = b - matvec(root, reached)  # w, and the way downhill
            free = ~(((here <= low) & (off < 0)) | ((here >= high) & (off > 0)))
            terms = np.abs(np.where(free, b, here)).max(axis=1)
            going = np.where(free, np.abs(off), 0.0).max(axis=1) > SETTLED * terms
            settled[run[~going]] = True
            if last == steps or not going.any():
                break
            run, here, reached, free = run[going], here[going], reached[going], free[going]
            before = (reached * reached).sum(axis=-1) / 2 - (b[going] * here).sum(axis=-1)
            # From here on only the free multipliers, side by side: few of many constraints bind.
            every = np.arange(len(run))[:, None]
            index = np.argsort(~free, axis=1, kind="stable")[:, : free.sum(axis=1).max()]
            free, own, at = free[every, index], root[going][every, index], run[:, None]
            here, least, most = here[every, index], self.low[at, index], self.high[at, index]
            downhill = np.where(free, off[going][every, index], 0.0)
            step = _newton_step(own, downhill, free)
            held = free & (((here <= least) & (step < 0)) | ((here >= most) & (step > 0)))
            if held.any():
                step = _newton_step(own, downhill, free & ~held)
            # Along the step bent at the bounds: at its end, at each bend, and a little downhill.
            with np.errstate(divide="ignore", invalid="ignore"):
                reach = np.where(step > 0, most - here, least - here) / step
            share = np.where(step == 0, 1.0, np.minimum(reach, 1.0))
            share = np.concatenate([np.ones((len(run), 1)), share], axis=1)
            ways = share[..., None] * step[:, None]
            ways = np.concatenate([ways, SHARES_DOWNHILL[:, None] * downhill[:, None]], axis=1)
            tried = np.clip(here[:, None] + ways, least[:, None], most[:, None])
            ways = tried - here[:, None]
            rise = ((ways @ own) ** 2).sum(axis=-1) / 2 - matvec(ways, downhill)
            best = rise.argmin(axis=1)
            better = -rise[every[:, 0], best] > HEIGHT_ROUNDING * np.abs(before)
            settled[run[~better]] = True
            y[at[better], index[better]] = tried[every[:, 0], best][better]
            run = run[better]
        return y, settled

    def interior(self) -> FloatArray:
        """The y (k, m) by the primal-dual interior-point method, those near a bound put on it.

        From the middle, where w = b - A y is the difference of the prices (k, m) of both bounds; it
        stays so, since prices and multipliers take steps of the same share.
        """
        y = (self.low + self.high) / 2
        off = self.b - matvec(self.root, (y[:, None] @ self.root)[:, 0])
        slack = np.abs(off).mean(axis=1, keepdims=True) + np.finfo(float).tiny
        above, below = np.maximum(off, 0.0) + slack, np.maximum(-off, 0.0) + slack
        run = np.arange(len(y))
        for _ in range(INTERIOR_STEPS):
            root, low, high = self.root[run], self.low[run], self.high[run]
            here, over, under = y[run], above[run], below[run]
            rounding = np.finfo(float).eps * (high - low)
            up, down = np.maximum(high - here, rounding), np.maximum(here - low, rounding)
            weight = 1 / (over / up + under / down + ROUNDING)
            matrix = np.swapaxes(root, -1, -2) @ (weight[..., None] * root)
            matrix = matrix + np.eye(root.shape[-1])

            def newton(right: FloatArray) -> FloatArray:
                right = weight * right
                inner = solve(matrix, (right[:, None] @ root)[:, 0])
                return right - weight * matvec(root, inner)

            step = newton(over - under)
            gaps = np.concatenate([over * up, under * down], axis=1).mean(axis=1, keepdims=True)
            price_up, price_down = (step / up - 1) * over, (-step / down - 1) * under
            share = _inside(up, down, over, under, step, price_up, price_down)
            after = (over + share * price_up) * (up - share * step)
            after = after + (under + share * price_down) * (down + share * step)
            aim = gaps * np.clip(after.mean(axis=1, keepdims=True) / 2 / gaps, 0, 1) ** 3
            rest_up, rest_down = aim + step * price_up, aim - step * price_down
            step = newton(over - under - rest_up / up + rest_down / down)
            price_up = rest_up / up + (step / up - 1) * over
            price_down = rest_down / down + (-step / down - 1) * under
            share = INSIDE * _inside(up, down, over, under, step, price_up, price_down)
            y[run] += share * step
            above[run] += share * price_up
            below[run] += share * price_down
            scale = np.abs(self.b[run] * y[run]).sum(axis=1) + np.finfo(float).tiny
            run = run[2 * self.b.shape[1] * gaps[:, 0] > SETTLED_GAP * scale]
            if not len(run):
                break
        y = np.where(below > y - self.low, self.low, y)
        return np.where(above > self.high - y, self.high, y)


def _inside(
    up: FloatArray,
    down: FloatArray,
    over: FloatArray,
    under: FloatArray,
    step: FloatArray,
    price_up: FloatArray,
    price_down: FloatArray,
) -> FloatArray:
    """The greatest share (k, 1), at most 1, of steps that lets no slack and price be negative."""
    parts = np.concatenate([up, down, over, under], axis=1)
    falls = np.concatenate([step, -step, -price_up, -price_down], axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = np.where(falls > 0, parts / falls, 1.0)
    return np.asarray(np.minimum(shares.min(axis=1, keepdims=True), 1.0))


def _newton_step(root: FloatArray, downhill: FloatArray, free: NDArray[np.bool_]) -> FloatArray:
    """Newton's step (k, m) of the free multipliers; the others keep still."""
    own = np.where(free[..., None], root, 0.0)
    matrix = own @ np.swapaxes(own, -1, -2)
    at = np.arange(free.shape[1])
    matrix[:, at, at] += np.where(free, ROUNDING, 1.0)
    return solve(matrix, np.where(free, downhill, 0.0))
