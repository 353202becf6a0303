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
as with many more constraints than unknowns, a primal-dual interior-point method (Mehrotra, On the
implementation of a primal-dual interior point method, SIAM J. Optim. 2, 1992) goes near the
solution, which tells the multipliers that are held, and Newton's method goes on from there.

The numbers are worked off in `soft_program_kernel`, which is compiled.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.numerics.arrays import FloatArray
from burmester.numerics.soft_program_kernel import solve_programs


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
        step = np.empty(self.gradient.shape)
        multipliers = np.zeros(self.value.shape) if start is None else np.array(start)
        solve_programs(*self, multipliers, step)
        return step, multipliers
