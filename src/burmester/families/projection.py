"""The way from any linkage to one near it that meets the poses, its pivots where they may lie.

Newton's method with the shortest step in the dimensions: each dyad is one equation a pose, in five
unknowns.  A pivot outside its region goes to the region's edge and stays on that edge.  Poses with
tolerances move within them, as further unknowns that both dyads share.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.timed_dyads import timing_equations
from burmester.families.open_task import DyadFreedom, OpenTask, Trials
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.numerics.arrays import FloatArray

STEPS: Final = 12  # number of Newton steps
LONGEST_STEP: Final = 1.0  # lengths; a longer step is shortened to it
SHORTEST_RADIUS: Final = 1e-3  # lengths; a link is kept at least as long on the way
MET: Final = 1e-10  # lengths; a pose that is missed by less is met
SLACK: Final = 1e-9  # relative; a length that is off its limit by less keeps it
RIDGE: Final = 1e-13  # relative; added where equations depend on each other


def projected(
    trials: Trials, task: OpenTask, steps: int = STEPS
) -> tuple[Trials, NDArray[np.bool_]]:
    """Linkages (k,) near those given, and which dyads (k, 2) meet the poses within their limits.

    Formula `shortest-step` of the theory.
    """
    batch, offsets = trials.batch, trials.offsets.copy()
    z = batch.dimensions.copy()
    sides = np.arange(2)
    free = np.stack([side.metric() for side in task.sides])[sides, batch.kinds]
    _clip(z, batch.kinds, free, task)
    for _ in range(steps):
        now = LinkageBatch(batch.kinds, z)
        residual, force, slope = _equations(now, task, offsets)
        worst = np.abs(residual).max(axis=(1, 2))
        if not (worst > MET).any():
            break
        along = slope @ free  # (k, 2, N, 5)
        step, moved = _shortest(residual, along, slope, force, task)
        size = np.sqrt((step * step).sum(axis=(1, 2)))
        shorter = np.minimum(1.0, LONGEST_STEP / np.maximum(size, 1e-300))
        z -= shorter[:, None, None] * step
        z[..., 4] = np.where(batch.kinds == 0, np.maximum(np.abs(z[..., 4]), SHORTEST_RADIUS), 0.0)
        if moved is not None:
            bound = task.half_widths
            offsets = np.clip(offsets - shorter[:, None, None] * moved, -bound, bound)
        _clip(z, batch.kinds, free, task)
    out = replace(trials, batch=LinkageBatch(batch.kinds, z), offsets=offsets)
    residual, _, _ = _equations(out.batch, task, offsets)
    with np.errstate(invalid="ignore"):
        met = np.abs(residual).max(axis=2) <= MET
    return out, met & _within_lengths(out.batch, task.sides)


def _equations(
    batch: LinkageBatch, task: OpenTask, offsets: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Residuals (k, 2, m), forces (k, 2, m, 3), derivatives (k, 2, m, 5): poses, then timing."""
    places = task.places(offsets)
    residual, force, slope = batch.jacobians(places)
    timings = [side.timing for side in task.sides]
    for side, timing in enumerate(timings):
        if timing is None or side > timings.index(timing):  # both sides, while dyads are drawn
            continue
        own = [k for k, each in enumerate(timings) if each is timing]
        parts = [timing_equations(batch.dimensions[:, k], places, timing) for k in own]
        count, more = parts[0][0].shape
        value, by = np.zeros((count, 2, more)), np.zeros((count, 2, more, slope.shape[-1]))
        for k, part in zip(own, parts, strict=True):
            turning = batch.kinds[:, k] == 0
            value[turning, k], by[turning, k] = part[0][turning], part[1][turning]
        residual = np.concatenate([residual, value], axis=2)
        slope = np.concatenate([slope, by], axis=2)
        force = np.concatenate([force, np.zeros((count, 2, more, 3))], axis=2)
    return residual, force, slope


def _shortest(
    residual: FloatArray, along: FloatArray, slope: FloatArray, force: FloatArray, task: OpenTask
) -> tuple[FloatArray, FloatArray | None]:
    """The shortest steps of the dimensions (k, 2, 5) and of the poses (k, N, 3), to take off."""
    k, _, n = residual.shape
    gram = along @ slope.swapaxes(-1, -2)  # (k, 2, N, N)
    if task.is_exact:
        right = _solved(gram, residual)
        return np.einsum("ksnj,ksn->ksj", along, right), None
    push = np.einsum("ksni,nij->ksnj", force / np.array([1, 1, task.length]), task.axes)
    width = np.minimum(task.half_widths, 1.0) ** 2
    shared = np.einsum("ksnj,nj,ktnj->kstn", push, width, push)
    whole = np.zeros((k, 2, n, 2, n))
    for s in (0, 1):
        whole[:, s, :, s] = gram[:, s]
        for t in (0, 1):
            whole[:, s, np.arange(n), t, np.arange(n)] += shared[:, s, t]
    right = _solved(whole.reshape(k, 2 * n, 2 * n), residual.reshape(k, 2 * n)).reshape(k, 2, n)
    moved = np.einsum("ksnj,ksn,nj->knj", push, right, width)
    return np.einsum("ksnj,ksn->ksj", along, right), moved


def _solved(gram: FloatArray, right: FloatArray) -> FloatArray:
    """Solutions of systems with positive semidefinite matrices (*, n, n)."""
    n = gram.shape[-1]
    size = np.einsum("...ii->...", gram)[..., None, None]
    ridge = (RIDGE * size + 1e-300) * np.eye(n)
    return np.asarray(
        np.linalg.solve(np.nan_to_num(gram) + ridge, np.nan_to_num(right)[..., None])[..., 0]
    )


def _clip(z: FloatArray, kinds: NDArray[np.int8], free: FloatArray, task: OpenTask) -> None:
    """Bring pivots that lie outside back to the edge, and keep them on it; in place."""
    for side, freedom in enumerate(task.sides):
        for place, at, other in ((freedom.fixed, 0, 1), (freedom.moving, 2, 2)):
            has = np.flatnonzero(kinds[:, side] != other)
            part = slice(at, at + 2)
            points = z[has, side, part]
            back, along = place.nearest(points)
            out = np.flatnonzero((back != points).any(axis=1))
            z[has[out], side, part] = back[out]
            free[has[out], side, part, part] = along[out]
        if freedom.rail is not None:
            part = freedom.rail.at
            z[:, side, part], free[:, side, part, part] = freedom.rail.nearest(z[:, side, part])
        least, most = freedom.length
        turning = kinds[:, side] == 0
        z[turning, side, 4] = z[turning, side, 4].clip(least, most)


def _within_lengths(
    batch: LinkageBatch, sides: tuple[DyadFreedom, DyadFreedom]
) -> NDArray[np.bool_]:
    """Whether the links (k, 2) of linkages are as long as they may be."""
    radius = batch.dimensions[..., 4]
    least, most = np.array([side.length for side in sides]).T
    inside = (radius >= least * (1 - SLACK)) & (radius <= most * (1 + SLACK))
    return np.asarray(inside | (batch.kinds != 0))
