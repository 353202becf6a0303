"""Quadratic programs with soft constraints, many at once: the step of a constrained descent.

min over s of  s · H s / 2 + c · s + sum of rho |w_i| over equalities + rho max(0, w_i) over the
inequalities, with w = g + G s.  It always has a solution; for rho large enough it keeps all
constraints that can be kept together.

Solved in its multipliers y, each within 0 and rho (-rho and rho for equalities), by a primal-dual
interior-point method (Wright, Primal-dual interior-point methods, SIAM 1997).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import matvec, solve

__all__ = ["SoftProgram"]

INTERIOR_POINT_STEPS = 14  # of the interior-point method; each takes about a digit off the gap
CENTRING = 0.1  # share of the complementarity gap that a step aims at
BOUNDARY_SHARE = 0.99  # of the way to the nearest bound; a step goes no farther
MIN_ROOM = 1e-15  # of the range of a multiplier, which it keeps off its bounds
MAX_STIFFNESS = 1e12  # of a constraint, as the change of its multiplier with its value
ROUNDING = 1e-14  # share of the trace that is added to the Hessian's diagonal


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

    def solved(self) -> tuple[FloatArray, FloatArray]:
        """The solutions.

        Returns the steps s (k, n) and the multipliers y (k, m).
        """
        hessian, gradient, value, jacobian, low, high = self
        if not value.shape[1]:
            return solve(hessian, -gradient), np.zeros_like(value)
        transposed = np.swapaxes(jacobian, -1, -2)

        def step(y: FloatArray) -> FloatArray:
            return -solve(hessian, gradient + matvec(transposed, y))

        width, eye = high - low, np.eye(hessian.shape[-1])
        y = np.where(low < 0, 0.0, 0.1 * high)
        w = value + matvec(jacobian, step(y))
        # u - v = w all along: u belongs to the multiplier's upper bound, v to its lower one.
        start = 0.01 + 0.1 * np.abs(w)
        u = np.maximum(w, 0.0) + start
        v = u - w
        for _ in range(INTERIOR_POINT_STEPS):
            u, v = np.maximum(u, MIN_ROOM), np.maximum(v, MIN_ROOM)
            above, below = (np.maximum(room, MIN_ROOM * width) for room in (high - y, y - low))
            target = CENTRING * (u * above + v * below).mean(axis=1, keepdims=True) / 2
            stiffness = np.minimum(1 / (u / above + v / below), MAX_STIFFNESS)
            unopposed = stiffness * (u - v - target / above + target / below)
            reduced = hessian + transposed @ (stiffness[..., None] * jacobian)
            reduced = reduced + (ROUNDING * np.einsum("kii->k", reduced))[:, None, None] * eye
            back = solve(reduced, matvec(transposed, unopposed))
            dy = unopposed - stiffness * matvec(jacobian, back)
            du, dv = (target + u * dy) / above - u, (target - v * dy) / below - v
            with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                reaches = [above / np.maximum(dy, 0.0), below / np.maximum(-dy, 0.0)]
                reaches += [u / np.maximum(-du, 0.0), v / np.maximum(-dv, 0.0)]
            reach = np.min(reaches, axis=(0, 2))
            share = np.minimum(1.0, BOUNDARY_SHARE * reach)[:, None]
            y, u, v = y + share * dy, u + share * du, v + share * dv
        return step(y), y
