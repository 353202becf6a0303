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
Started from the multipliers of a program like it, one or two steps are enough.  Where they are not,
as with many more constraints than unknowns, a primal-dual interior-point method goes near the
solution, which tells the multipliers that are held, and Newton's method goes on from there.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import matvec, solve

__all__ = ["SoftProgram"]

STEPS_FROM_START = 4  # of the projected Newton method from multipliers that may be far off
STEPS_FROM_INSIDE = 2  # of it from where the interior-point method led
SIDES = np.array([1.0, -1.0])[:, None]  # of the upper bound, and of the lower one
INTERIOR_STEPS = 25  # of the interior-point method at most; it takes about twelve
INSIDE = 0.995  # share of the way to the nearest bound
NEAR_BOUND = 1e-9  # of the way between the bounds; a multiplier that is nearer is held
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
    # Where more are free than there are unknowns the start is far off.
    y, settled = box.descended(y * size, STEPS_FROM_START, root.shape[2])
    hard = np.flatnonzero(~settled)
    if len(hard):
        box = box.at(hard)
        y[hard], _ = box.descended(box.interior(), STEPS_FROM_INSIDE, root.shape[1])
    return np.asarray(y / size)


class _BoxProgram(NamedTuple):
    """Programs (k,) for m multipliers between bounds, the rows of the root of A of unit length."""

    root: FloatArray
    b: FloatArray
    low: FloatArray
    high: FloatArray

    def at(self, index: NDArray[np.intp]) -> _BoxProgram:
        """Some of the programs."""
        return _BoxProgram(*(each[index] for each in self))

    def off(self, y: FloatArray) -> FloatArray:
        """The way downhill (k, m) at y (k, m): w."""
        return np.asarray(self.b - matvec(self.root, (y[:, None] @ self.root)[:, 0]))

    def descended(
        self, y: FloatArray, steps: int, most: int
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """The y (k, m) after steps of the projected Newton method, and which of them settled.

        Those with more than `most` free multipliers make no further step.
        """
        run, settled = np.arange(len(y)), np.zeros(len(y), dtype=bool)
        for last in range(steps + 1):
            some, here = self.at(run), y[run]
            off = some.off(here)
            free = ~(((here <= some.low) & (off < 0)) | ((here >= some.high) & (off > 0)))
            terms = np.abs(np.where(free, some.b, here)).max(axis=1)
            going = np.where(free, np.abs(off), 0.0).max(axis=1) > SETTLED * terms
            settled[run[~going]] = True
            going &= free.sum(axis=1) <= most
            if last == steps or not going.any():
                break
            some, run = some.at(np.flatnonzero(going)), run[going]
            y[run], better, least = some.stepped(here[going], off[going], free[going])
            settled[run[least]] = True
            run = run[better & ~least]
        return y, settled

    def stepped(
        self, y: FloatArray, off: FloatArray, free: NDArray[np.bool_]
    ) -> tuple[FloatArray, NDArray[np.bool_], NDArray[np.bool_]]:
        """The y (k, m) after one step of those that are free, and which of them (k,) are better.

        off: (k, m), w at y.  A step that is not better is not taken.  Also, which (k,) were at the
        least height but for rounding: Newton's step promises no more, and is taken for its w.
        """
        every = np.arange(len(y))[:, None]
        # Only the free multipliers, side by side: few of many constraints bind.
        index = np.argsort(~free, axis=1, kind="stable")[:, : free.sum(axis=1).max()]
        free, root, here = free[every, index], self.root[every, index], y[every, index]
        low, high = self.low[every, index], self.high[every, index]
        downhill = np.where(free, off[every, index], 0.0)
        step = _newton_step(root, downhill, free)
        promise = (step * downhill).sum(axis=1) / 2
        whole = np.clip(here + step, low, high)
        held = free & (((here <= low) & (step < 0)) | ((here >= high) & (step > 0)))
        if held.any():
            step = _newton_step(root, downhill, free & ~held)
        # Along the step bent at the bounds: at its end, at each bend, and a little downhill.
        with np.errstate(divide="ignore", invalid="ignore"):
            reach = np.where(step > 0, high - here, low - here) / step
        share = np.where(step == 0, 1.0, np.minimum(reach, 1.0))
        share = np.concatenate([np.ones((len(y), 1)), share], axis=1)
        ways = share[..., None] * step[:, None]
        ways = np.concatenate([ways, SHARES_DOWNHILL[:, None] * downhill[:, None]], axis=1)
        tried = np.clip(here[:, None] + ways, low[:, None], high[:, None])
        ways = tried - here[:, None]
        rise = ((ways @ root) ** 2).sum(axis=-1) / 2 - matvec(ways, downhill)
        best = rise.argmin(axis=1)
        # The height is y · A y / 2 - b · y, and off = b - A y.
        height = ((self.b + off) * y).sum(axis=1) / 2
        hidden = HEIGHT_ROUNDING * np.abs(height)
        better, least = -rise[every[:, 0], best] > hidden, promise <= hidden
        there = np.where(least[:, None], whole, tried[every[:, 0], best])
        taken = better | least
        y[every[taken], index[taken]] = there[taken]
        return y, better, least

    def interior(self) -> FloatArray:
        """The y (k, m) by the interior-point method, those near a bound put on it.

        From the middle; w = b - A y is the difference of the prices of both bounds, but for
        rounding.
        """
        y, bounds = (self.low + self.high) / 2, np.stack([self.high, self.low], axis=1)
        off = self.off(y)
        slack = np.abs(off).mean(axis=1)[:, None, None] + np.finfo(float).tiny
        price = np.maximum(SIDES * off[:, None], 0.0) + slack
        least = np.finfo(float).eps * (bounds[:, :1] - bounds[:, 1:])
        run, count = np.arange(len(y)), 2 * y.shape[1]
        for _ in range(INTERIOR_STEPS):
            some, gap = self.at(run), np.maximum(SIDES * (bounds[run] - y[run, None]), least[run])
            here = _InteriorPoint(some.root, some.off(y[run]), gap, price[run])
            rest = (gap * here.price).sum(axis=(1, 2), keepdims=True) / count
            # Mehrotra's step: aimed as far ahead as the plain one leads, and bent as that bends.
            system = here.system()
            step, narrowed, cheaper = here.step(system, np.zeros_like(gap))
            share = here.share(narrowed, cheaper)
            ahead = (gap + share * narrowed) * (here.price + share * cheaper)
            aim = rest * np.clip(ahead.sum(axis=(1, 2), keepdims=True) / count / rest, 0, 1) ** 3
            step, narrowed, cheaper = here.step(system, aim - narrowed * cheaper)
            share = INSIDE * here.share(narrowed, cheaper)
            y[run] += share[:, 0] * step
            price[run] += share * cheaper
            height = np.abs(some.b * y[run]).sum(axis=1) + np.finfo(float).tiny
            run = run[count * rest[:, 0, 0] > SETTLED_GAP * height]
            if not len(run):
                break
        near = NEAR_BOUND * (self.high - self.low)
        y = np.where(y - self.low < near, self.low, y)
        return np.where(self.high - y < near, self.high, y)


class _InteriorPoint(NamedTuple):
    """Multipliers between their bounds: gaps to the upper and the lower one, and prices (k, 2, m).

    off: (k, m), w.  A gap times its price is 0 at the solution, and the same for all on the way to
    it (Mehrotra, On the implementation of a primal-dual interior point method, SIAM J. Optim. 2,
    1992).
    """

    root: FloatArray
    off: FloatArray
    gap: FloatArray
    price: FloatArray

    def system(self) -> tuple[FloatArray, FloatArray]:
        """What Newton's steps are solved by: weights (k, m), and a matrix (k, n, n)."""
        weight = 1 / ((self.price / self.gap).sum(axis=1) + ROUNDING)
        matrix = np.swapaxes(self.root, -1, -2) @ (weight[..., None] * self.root)
        return weight, matrix + np.eye(self.root.shape[-1])

    def step(
        self, system: tuple[FloatArray, FloatArray], aim: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Newton's step to where gaps times prices are `aim` (k, 2, m).

        Of the multipliers (k, m), of the gaps and of the prices (k, 2, m).
        """
        weight, matrix = system
        right = weight * (self.off - (SIDES * aim / self.gap).sum(axis=1))
        inner = solve(matrix, (right[:, None] @ self.root)[:, 0])
        step = right - weight * matvec(self.root, inner)
        narrowed = -SIDES * step[:, None]
        return step, narrowed, (aim - self.price * narrowed) / self.gap - self.price

    def share(self, narrowed: FloatArray, cheaper: FloatArray) -> FloatArray:
        """The greatest share (k, 1, 1) of a step, at most 1, that leaves all of them above 0."""
        fall = np.maximum(-narrowed / self.gap, -cheaper / self.price).max(axis=(1, 2))
        return np.asarray(1 / np.maximum(fall, 1.0))[:, None, None]


def _newton_step(root: FloatArray, downhill: FloatArray, free: NDArray[np.bool_]) -> FloatArray:
    """Newton's step (k, m) of the free multipliers; the others keep still."""
    own = np.where(free[..., None], root, 0.0)
    matrix = own @ np.swapaxes(own, -1, -2)
    at = np.arange(free.shape[1])
    matrix[:, at, at] += np.where(free, ROUNDING, 1.0)
    return solve(matrix, np.where(free, downhill, 0.0))
