"""From the minima of one task to those of the next: Newton's method, many dyads at once.

The first step of Newton's method at the old minimum is the derivative of the minimum by the poses
(implicit function theorem) times their change, so it predicts; the steps after it correct.  Exact
poses and faces of limits are equations with multipliers.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import DistanceFunction
from burmester.dyads.limited_block import FaceConditions
from burmester.dyads.local_minima import BestDyads, with_errors
from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import matvec, solve_or_shortest

SAME_DYAD = 1e-6  # relative; dyads that differ by less have become one

MAX_STEPS = 8  # of Newton's method; more than 4 are taken only where something is wrong
SETTLED_STEP = 1e-10  # relative; the error after so short a step is rounding
PREDICTED_SHARE = 0.5  # of the first step; a correction that is longer contradicts it
SHORT_CORRECTION = 0.02  # relative; so short a correction contradicts nothing
FLAT = 1e-13  # share of the greatest eigenvalue; what is less curved is as good as flat
INWARD_ROUNDING = 1e-7  # of the terms of a derivative; what leads down less does not


class MovedMinima(NamedTuple):
    """Dyads z (k, n) where Newton's method came to rest.

    sound: (k,), whether it did, at a minimum along the faces, near where the first step said.
    let_go: (k,), whether a direction from a face into its region leads down.
    """

    z: FloatArray
    sound: NDArray[np.bool_]
    let_go: NDArray[np.bool_]


def saddle_system(
    hessian: FloatArray, gradient: FloatArray, rows: FloatArray, gap: FloatArray, active: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Matrices (k, n + m, n + m) and right sides of steps under linear equations.

    The solutions are the step (k, n) and the multipliers (k, m), 0 of equations not active (k, m).
    """
    n, m = hessian.shape[-1], rows.shape[1]
    matrix = np.zeros((len(hessian), n + m, n + m))
    matrix[:, :n, :n] = hessian
    if m:
        kept = np.where(active[..., None], rows, 0.0)
        matrix[:, n:, :n] = kept
        matrix[:, :n, n:] = np.swapaxes(kept, -1, -2)
        at = np.arange(n, n + m)
        matrix[:, at, at] = np.where(active, 0.0, 1.0)
    return matrix, -np.concatenate([gradient, np.where(active, gap, 0.0)], axis=1)


def moved_minima(
    z: FloatArray,
    distances: DistanceFunction,
    share: FloatArray,
    exact: NDArray[np.bool_] | None = None,
    kept: FaceConditions | None = None,
) -> MovedMinima:
    """The minima of the weighted sum of squares to which old ones z (k, n) move.

    share: (N,), the weights; exact: (N,), the poses that are met exactly; kept: the faces.
    """
    if not len(z):
        none = np.zeros(0, dtype=bool)
        return MovedMinima(z, none, none)
    start, first = z, np.zeros_like(z)
    n = z.shape[1]
    marked = np.flatnonzero(exact) if exact is not None else np.empty(0, dtype=np.intp)
    loose = share.copy()
    loose[marked] = 0.0
    multipliers = np.zeros((len(z), len(marked)))
    for step_number in range(MAX_STEPS):
        here = distances.of(z)
        distance, jacobian = here.distance, here.jacobian
        force = loose * distance
        force[:, marked] = multipliers
        gradient = ((loose * distance)[:, None] @ jacobian)[:, 0]
        hessian = np.swapaxes(loose[:, None] * jacobian, -1, -2) @ jacobian
        hessian += here.curvature(force)
        rows, gap = jacobian[:, marked], distance[:, marked]
        active = np.ones(gap.shape, dtype=bool)
        if kept is not None:
            rows = np.concatenate([rows, kept.rows], axis=1)
            gap = np.concatenate([gap, kept.gap(z)], axis=1)
            active = np.concatenate([active, kept.active], axis=1)
        matrix, right = saddle_system(hessian, gradient, rows, gap, active)
        solution = solve_or_shortest(matrix, right)
        step, multipliers = solution[:, :n], solution[:, n : n + len(marked)]
        z = z + step
        if step_number == 0:
            first = step
        size = 1 + np.abs(z).max(axis=1)
        length = np.abs(step).max(axis=1)
        if not (length > SETTLED_STEP * size).any():
            break
    with np.errstate(invalid="ignore"):
        settled = length <= SETTLED_STEP * size
        off = np.abs(z - start - first).max(axis=1)
        near = off <= np.maximum(
            PREDICTED_SHARE * np.abs(first).max(axis=1), SHORT_CORRECTION * size
        )
    # A minimum along the faces: as many negative eigenvalues as equations, and none that is flat.
    settled &= np.isfinite(z).all(axis=1)
    values = np.linalg.eigvalsh(np.where(settled[:, None, None], matrix, np.eye(matrix.shape[-1])))
    convex = values[np.arange(len(z)), active.sum(axis=1)] > FLAT * np.abs(values).max(axis=1)
    let_go = np.zeros(len(z), dtype=bool)
    if kept is not None:
        force = loose * distance
        force[:, marked] = multipliers
        along = np.swapaxes(jacobian @ np.swapaxes(kept.inward, -1, -2), -1, -2)
        slope, terms = matvec(along, force), matvec(np.abs(along), np.abs(force))
        let_go = np.asarray((slope < -INWARD_ROUNDING * terms).any(axis=1))
    return MovedMinima(z, np.asarray(settled & near & convex), let_go)


def moved_fit(
    fit: BestDyads, z: FloatArray, sliders: tuple[PR | RP, ...], seen: Displacement
) -> BestDyads:
    """The fit with other circles z (k, 5) and sliders, in the same frames."""
    every = RR(z[:, :2], z[:, 2:4], z[:, 4])
    return with_errors(fit.search, every, sliders, every[:, None].residual(seen))


def twins(z: FloatArray) -> NDArray[np.intp]:
    """The numbers of dyads (k, n) that are the same as one before them."""
    apart = np.abs(z[:, None] - z).max(axis=-1) / (1 + np.abs(z).max(axis=-1))
    return np.flatnonzero(np.tril(apart < SAME_DYAD, -1).any(axis=1))
