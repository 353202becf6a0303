"""The last step to a linkage: all its dimensions at once, for the least error at the poses.

Two dyads that are best one by one do not make the best linkage.  Here the places of the coupler
nearest to the poses, on the circuits where they are, are brought nearer by Gauss and Newton's
method in all ten dimensions of both dyads (four of each slider), by exact derivatives (`misses`),
and under conditions (limits, a branch to be kept, exact poses) by quadratic programs (`held`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.fourbar.nearest_places import rows_of
from burmester.geometry.displacement import Displacement
from burmester.linkages.constrained_refinement import (
    CURVED,
    DAMPING,
    FAR,
    FARTHEST,
    GAIN,
    LEAST,
    MOST,
    SETTLED,
    held,
)
from burmester.linkages.constraints import Constraints
from burmester.linkages.residuals import SIZE, Problem, State, free_part, rescaled, secant
from burmester.numerics.arrays import FloatArray

__all__ = ["Refined", "refine"]

STEPS = 60  # of Gauss and Newton, at most
HELD = 120  # steps under conditions, at most
POWERS = (2.0, 8.0, 32.0, 128.0, 512.0)  # sums of ever higher powers lead to the least worst


@final
@dataclass(frozen=True, slots=True, eq=False)
class Refined:
    """Linkages (k,) as they came out, in the frames they were given in.

    rows: (k, N, 3), the coupler's places as x, y, length x angle; nan where a linkage was lost.
    cost: (k,), half the weighted sum of squared distances (or the greatest distance).
    settled: (k,), whether the steps came to an end; met: whether all conditions hold.
    """

    stack: LinkageBatch
    rows: FloatArray
    cost: FloatArray
    settled: NDArray[np.bool_]
    met: NDArray[np.bool_]


def refine(
    stack: LinkageBatch,
    places: Displacement,
    poses: Displacement,
    length: float,
    *,
    weights: FloatArray | None = None,
    exact: NDArray[np.bool_] | None = None,
    conditions: Constraints | None = None,
    free: NDArray[np.bool_] | None = None,
    worst: bool = False,
    steps: int = STEPS,
    held_steps: int = HELD,
) -> Refined:
    """Linkages (k,) with the least error at poses (N,), from those given and their places (k, N).

    In frames where lengths are about 1 (`accuracy.error_frames`).  The places go along
    continuously, so they stay on their circuits.  free: (k, 10), which dimensions may change.
    worst: the greatest distance is to be least, not the sum of squares; by sums of ever higher
    powers of the distances, so to about half a percent.  steps, and held_steps where something
    is held: at most.
    All minima are local ones.
    """
    count, number = len(stack), poses.shape[0]
    exact = np.zeros(number, dtype=bool) if exact is None else exact
    weights = np.ones(number) if weights is None else weights / weights.mean()
    share = np.where(exact, 0.0, np.sqrt(weights))
    slots = np.ones((count, 2, DIMENSIONS), dtype=bool)
    slots[..., -1] = stack.kinds == 0
    used = slots.reshape(count, SIZE) & (True if free is None else free)
    problem = Problem(stack.kinds, rows_of(poses, length), length, share, exact, conditions, used)
    state = problem.state(
        np.arange(count), stack.dimensions.reshape(count, SIZE), rows_of(places, length)
    )
    keeping = bool(exact.any()) or conditions is not None
    rows, met = state.rows, np.ones(count, dtype=bool)
    for power in POWERS if worst else POWERS[:1]:
        if keeping:
            z, rows, done, met = held(problem, state.z, rows, power, held_steps)
            state = state._replace(z=z)
        else:
            state, done = _descend(problem, state, power, steps)
            rows = state.rows
    size = share * np.sqrt(((rows - problem.wanted) ** 2).sum(axis=-1))
    cost = size.max(axis=-1) if worst else (size * size).sum(axis=-1) / 2
    lost = ~np.isfinite(cost)
    return Refined(problem.stack(np.arange(count), state.z), rows, cost, done & ~lost, met & ~lost)


def _descend(
    problem: Problem, state: State, power: float, steps: int
) -> tuple[State, NDArray[np.bool_]]:
    """Levenberg and Marquardt's method without conditions."""
    z, rows = state.z.copy(), state.rows.copy()
    parts = [np.array(part) for part in (state.miss, state.slope, state.moved)]
    count = len(z)
    run = np.flatnonzero(np.isfinite(rows).all(axis=(1, 2)))
    bent, trust = np.zeros((count, SIZE, SIZE)), np.zeros(count, dtype=int)
    done, damping = np.zeros(count, dtype=bool), np.full(count, DAMPING)
    here = State(z, rows, *parts).some(run)
    residual, slope = free_part(problem, run, here, power)
    for _ in range(steps):
        if not len(run):
            break
        cost = (residual * residual).sum(axis=-1)
        step = _step(residual, slope, damping[run], problem.free[run])
        curved = trust[run] >= CURVED
        if curved.any():
            step[curved] = _curved_step(
                residual[curved], slope[curved], bent[run[curved]], damping[run[curved]]
            )
        step = np.where(problem.free[run], step, 0.0)  # but for rounding it is so
        shift = (here.moved @ step[:, None, :, None])[..., 0]
        part = np.minimum(1.0, FAR / np.maximum(np.abs(shift).max(axis=(1, 2)), FAR))
        step, shift = part[:, None] * step, part[:, None, None] * shift
        to, start = here.z + step, here.rows + shift
        there = problem.state(run, to, start)
        next_residual, next_slope = free_part(problem, run, there, power)
        with np.errstate(invalid="ignore", over="ignore"):
            after = (next_residual * next_residual).sum(axis=-1)
        if power != 2.0:  # measured in the top distance of before
            after = after * rescaled(problem, here, there, power)
        radius = to.reshape(-1, 2, DIMENSIONS)[..., -1]
        sound = ((radius > 0) | (problem.kinds[run] > 0)).all(axis=-1)
        sound &= np.abs(to).max(axis=-1) < FARTHEST
        better = sound & (after <= cost * (1 + GAIN))
        small = np.abs(step).max(axis=-1) < SETTLED * (1 + np.abs(here.z).max(axis=-1))
        idle = better & (cost - after < GAIN * cost)
        trust[run] = np.where(better, trust[run] + 1, np.where(curved, 0, trust[run]))
        go = np.flatnonzero(better)
        bent[run[go]] = secant(
            bent[run[go]], step[go], residual[go], slope[go], next_residual[go], next_slope[go]
        )
        here = here.but(better, there)
        residual = np.where(better[:, None], next_residual, residual)
        slope = np.where(better[:, None, None], next_slope, slope)
        damping[run] = np.clip(np.where(better, damping[run] / 10, damping[run] * 10), LEAST, None)
        for whole, part in zip((z, rows, *parts), here, strict=True):
            whole[run] = part
        end = small | idle | (damping[run] > MOST)
        done[run[end]] = True
        here, residual, slope, run = here.some(~end), residual[~end], slope[~end], run[~end]
    return State(z, rows, *parts), done


def _step(
    residual: FloatArray, slope: FloatArray, damping: FloatArray, free: NDArray[np.bool_]
) -> FloatArray:
    """Levenberg and Marquardt's step (k, 10)."""
    size = np.sqrt((slope * slope).sum(axis=1))
    top = size.max(axis=-1, keepdims=True) + np.finfo(float).tiny
    size = np.where(free, np.maximum(size, 1e-12 * top), top)
    whole = np.concatenate([slope / size[:, None], residual[..., None]], axis=-1)
    low = np.zeros((len(residual), SIZE, SIZE + 1))
    low[:, range(SIZE), range(SIZE)] = np.sqrt(damping)[:, None]
    upper = np.asarray(np.linalg.qr(np.concatenate([whole, low], axis=1), mode="r"))
    return np.asarray(
        -np.linalg.solve(upper[:, :SIZE, :SIZE], upper[:, :SIZE, SIZE:])[..., 0] / size
    )


def _curved_step(
    residual: FloatArray, slope: FloatArray, bent: FloatArray, damping: FloatArray
) -> FloatArray:
    """Newton's step (k, 10), with what is known of the curvature of the residuals."""
    flat = np.swapaxes(slope, -1, -2) @ slope
    size = np.sqrt(np.maximum(np.einsum("kii->ki", flat), np.finfo(float).tiny))
    size = np.maximum(size, 1e-12 * size.max(axis=-1, keepdims=True))
    downhill = (np.swapaxes(slope, -1, -2) @ residual[..., None])[..., 0] / size
    values, axes = np.linalg.eigh((flat + bent) / (size[:, None] * size[..., None]))
    values = np.maximum(np.abs(values), 1e-8) + damping[:, None]
    along = (np.swapaxes(axes, -1, -2) @ downhill[..., None])[..., 0] / values
    return np.asarray(-(axes @ along[..., None])[..., 0] / size)
