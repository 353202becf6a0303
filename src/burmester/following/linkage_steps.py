"""From linkages of one task to those of the next: Newton's steps, many linkages at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.limited_block import FaceConditions
from burmester.following.minimum_step import INWARD_ROUNDING, saddle_system
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, take, where
from burmester.numerics.linear_algebra import matvec, solve_or_shortest
from burmester.refinement.residuals import SIZE, Linearisation, Problem, State, linearised, secant

STEPS = 3  # of Newton's method from the linkages before
SETTLED_STEP = 1e-6  # relative; after a shorter step the error is less than its square
LONG_STEP = 0.02  # relative; after a longer one the curvature is another
STRIDE = 1e-6  # lengths; of difference quotients
DAMPING = 1e-12  # of the scaled Hessian's greatest eigenvalue
REFUSED_DAMPING = 1e-1  # the same after a step that did not help
COST_ROUNDING = 1e-9  # relative; an error that rises by less has not
# Shares of the greatest singular value; ways in which the places determine dimensions less are not
# gone: of places that all can be met, and of more.
FLAT, FLAT_OF_MANY = 1e-9, 1e-3
MOVING_STEPS = 4  # with the poses
MET = 1e-13  # lengths; places that are missed by less are met


def moved_with_places(
    batch: LinkageBatch, places: Displacement, kept: FaceConditions | None
) -> LinkageBatch:
    """Linkages (k,) changed by as little as leads them through places (k, N), or nearest to them.

    Newton's shortest step in the dimensions of each dyad, along the faces that it keeps.
    """
    z, few = batch.dimensions, places.shape[1] <= DIMENSIONS
    flat = FLAT if few else FLAT_OF_MANY
    if kept is not None:
        off = kept.gap(z.reshape(len(z), SIZE))[:, None]
        z = z - (off @ np.where(kept.active[..., None], kept.rows, 0.0)).reshape(z.shape)
    for _ in range(MOVING_STEPS if few else 1):  # more places cannot all be met
        residual, _, by_dimension = LinkageBatch(batch.kinds, z).jacobians(places)
        jacobian = by_dimension
        if kept is not None:
            jacobian = jacobian @ _along(kept)
        with np.errstate(invalid="ignore"):
            finite = np.isfinite(jacobian).all(axis=(1, 2, 3))
            sound = np.asarray(finite & np.isfinite(residual).all(axis=(1, 2)))
        inverse = np.linalg.pinv(np.where(sound[:, None, None, None], jacobian, 0.0), rcond=flat)
        step = matvec(inverse, np.where(sound[:, None, None], residual, 0.0))
        z = z - step
        if not (np.abs(step).max(initial=0) > MET):
            break
    return LinkageBatch(batch.kinds, z)


def _along(kept: FaceConditions) -> FloatArray:
    """The projections (k, 2, 5, 5) of both dyads' dimensions along their faces."""
    rows = np.where(kept.active[..., None], kept.rows, 0.0)
    whole = np.eye(SIZE) - np.swapaxes(rows, -1, -2) @ rows
    one, two = slice(0, DIMENSIONS), slice(DIMENSIONS, SIZE)
    return np.stack([whole[:, one, one], whole[:, two, two]], axis=1)


class Least(NamedTuple):
    """Linkages (k,) after some steps towards the least error.

    curvature: (k, 10, 10), learnt from the steps; last: (k,), the size of the last one, relative;
    let_go: (k,), whether a direction from a face into its region leads down.
    """

    state: State
    curvature: FloatArray
    last: FloatArray
    let_go: NDArray[np.bool_]


def least_errors(
    problem: Problem, state: State, curvature: FloatArray, kept: FaceConditions | None
) -> Least:
    """Linkages (k,) some of Newton's steps nearer to their least errors.

    Where a step does not help, the curvature is computed anew, and in the end the step is damped.
    """
    every = np.arange(len(state.z))
    model = linearised(problem, every, state, 2.0)
    damping = np.full(len(every), DAMPING)
    last, let_go = np.zeros(len(every)), np.zeros(len(every), dtype=bool)
    for attempt in range(STEPS):
        step, let_go = _step(problem, state, model, curvature, damping, kept)
        step, shift = problem.limited(state, step)
        there = problem.state(every, state.z + step, state.rows + shift)
        ahead = linearised(problem, every, there, 2.0)
        with np.errstate(invalid="ignore", over="ignore"):
            before, after = ((each.residual**2).sum(axis=1) for each in (model, ahead))
            off = _missed(problem, state, kept) > MET
            better = (after <= before * (1 + COST_ROUNDING)) | (off & np.isfinite(after))
        better = better & problem.sound(every, there.z)
        last = np.abs(step).max(axis=1) / (1 + np.abs(state.z).max(axis=1))
        learns = (better & (last > SETTLED_STEP))[:, None, None]
        curvature = np.where(learns, secant(curvature, step, model, ahead), curvature)
        refused = np.flatnonzero(~better | (last > LONG_STEP))
        state, model = where(better, there, state), where(better, ahead, model)
        if len(refused):
            if attempt == 0:
                some = problem.part(refused)
                curvature[refused] = curvatures(some, take(state, refused))
            else:
                damping[refused] = REFUSED_DAMPING
        if not (last > SETTLED_STEP).any():
            break
    return Least(state, curvature, last, let_go)


def curvatures(problem: Problem, state: State) -> FloatArray:
    """The part (k, 10, 10) of the Hessians of half the squares that the Jacobian does not know.

    By difference quotients of the gradient.
    """
    count = len(state.z)
    which = np.tile(np.arange(count), 1 + SIZE)
    z = np.concatenate([state.z[None], state.z + STRIDE * np.eye(SIZE)[:, None]])
    z = np.where(problem.free, z, state.z)
    many = problem.part(which)
    rows = np.tile(state.rows, (1 + SIZE, 1, 1))
    there = many.state(np.arange(len(which)), z.reshape(-1, SIZE), rows)
    model = linearised(many, np.arange(len(which)), there, 2.0)
    gradient = model.gradient(model.residual).reshape(1 + SIZE, count, SIZE)
    hessian = np.moveaxis((gradient[1:] - gradient[0]) / STRIDE, 0, 1)
    jacobian = model.jacobian[:count]
    rest = (hessian + np.swapaxes(hessian, -1, -2)) / 2
    rest = rest - np.swapaxes(jacobian, -1, -2) @ jacobian
    free = problem.free[:, None] & problem.free[..., None]
    return np.where(free & np.isfinite(rest), rest, 0.0)


def gains(
    problem: Problem, state: State, curvature: FloatArray, kept: FaceConditions | None
) -> FloatArray:
    """What share (k,) of the squared error one step of Newton's method would gain."""
    every = np.arange(len(state.z))
    model = linearised(problem, every, state, 2.0)
    residual, jacobian = model
    damping = np.full(len(every), DAMPING)
    step, _ = _step(problem, state, model, curvature, damping, kept)
    gain = -((residual[:, None] @ jacobian)[:, 0] * step).sum(axis=1)
    return np.asarray(gain / np.maximum((residual**2).sum(axis=1), np.finfo(float).tiny))


def _missed(problem: Problem, state: State, kept: FaceConditions | None) -> FloatArray:
    """By how much linkages (k,) miss exact poses and faces."""
    off = np.abs(state.residual[:, problem.exact]).max(axis=(1, 2), initial=0)
    if kept is not None:
        off = np.maximum(off, np.abs(kept.gap(state.z)).max(axis=1, initial=0))
    return np.asarray(off)


def _step(  # noqa: PLR0917  all of it belongs to a step
    problem: Problem,
    state: State,
    model: Linearisation,
    curvature: FloatArray,
    damping: FloatArray,
    kept: FaceConditions | None,
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Newton's step (k, 10) under exact poses and faces; which (k,) faces are to be let go."""
    count, free = len(state.z), problem.free
    residual, jacobian = model
    flat = np.swapaxes(jacobian, -1, -2) @ jacobian
    size = np.sqrt(np.einsum("kii->ki", flat))
    size = np.maximum(size, 1e-6 * size.max(axis=1, keepdims=True) + np.finfo(float).tiny)
    size = np.where(free, size, 1.0)
    scale = size[:, None] * size[..., None]
    values, axes = np.linalg.eigh((flat + curvature) / scale)
    values = np.abs(values)
    values = np.maximum(values, 1e-10) + (damping * values[:, -1])[:, None]
    hessian = (axes * values[:, None]) @ np.swapaxes(axes, -1, -2)
    gradient = (residual[:, None] @ jacobian)[:, 0] / size
    exact = problem.exact
    rows = np.where(
        free[:, None], state.jacobian[:, exact].reshape(count, 2 * int(exact.sum()), SIZE), 0.0
    )
    gap = state.residual[:, exact].reshape(count, 2 * int(exact.sum()))
    active = np.ones(gap.shape, dtype=bool)
    if kept is not None:
        rows = np.concatenate([rows, kept.rows], axis=1)
        gap = np.concatenate([gap, kept.gap(state.z)], axis=1)
        active = np.concatenate([active, kept.active], axis=1)
    matrix, right = saddle_system(hessian, gradient, rows / size[:, None], gap, active)
    solution = solve_or_shortest(matrix, right)
    step = np.where(free, solution[:, :SIZE] / size, 0.0)
    let_go = np.zeros(count, dtype=bool)
    if kept is not None:
        own = gap.shape[1] - kept.at.shape[1]
        force = (solution[:, None, SIZE : SIZE + own] @ rows[:, :own])[:, 0]
        slope = matvec(kept.inward, gradient * size + force)
        terms = matvec(np.abs(kept.inward), (np.abs(residual)[:, None] @ np.abs(jacobian))[:, 0])
        let_go = np.asarray((slope < -INWARD_ROUNDING * terms).any(axis=1))
    return step, let_go
