"""Linkages improved by evolution: one population for each start, all of them in one batch.

Evolution strategy with covariance matrix adaptation (Hansen and Ostermeier, Completely derandomized
self-adaptation in evolution strategies, Evolutionary Computation 9, 2001), here with the rank-mu
update alone and a step length that follows success.  The least transmission angle over a range is
no smooth function of the pivots, and its best value often lies on a limit: this needs neither
derivatives nor an inside.  Each child is brought to the poses before it is assessed.  A heuristic:
it finds no optimum for certain.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.families.assessment import Assessment, assessed, costs
from burmester.families.open_task import OpenTask, Trials
from burmester.families.projection import projected
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.numerics.arrays import FloatArray, concatenate, replaced, take
from burmester.progress import goes_on

CHILDREN: Final = 12  # number of children of each population in a generation
PARENTS: Final = 4  # number of the best of them that the next generation follows
FIRST_STEP: Final = 0.08  # lengths, about; the step of the first generation
LEAST_STEP: Final = 1e-4  # lengths; a population whose step is less has ended
LEARNING: Final = 0.3  # share of a generation in the next covariance
LONGER, SHORTER = 1.4, 0.75  # of the step, after a generation with and without success
PROJECTION_STEPS: Final = 5  # number of Newton steps from a child to the poses
PIVOTS: Final = 4  # number of dimensions of a dyad that evolve; its length follows


def improved(
    trials: Trials,
    value: Assessment,
    aims: NDArray[np.intp],
    task: OpenTask,
    *,
    generations: int,
    rng: np.random.Generator,
    assess: Callable[[Trials], Assessment] | None = None,
) -> tuple[Trials, Assessment]:
    """All linkages that were met on the way from linkages (k,) and meet all conditions.

    value: what the linkages are worth; aims: (k,), the number of each population's aim in AIMS.
    assess: what linkages are worth, `assessed` by the task where nothing else is given.
    """
    count = len(trials)
    enough = task.conditions.enough
    best, cost = trials, costs(value, aims, enough)
    mean = _genes(trials, task)
    size = mean.shape[1]
    covariance = np.broadcast_to(np.eye(size), (count, size, size)).copy()
    step = np.full(count, FIRST_STEP)
    weights = np.log(PARENTS + 0.5) - np.log(np.arange(1, PARENTS + 1))
    weights /= weights.sum()
    kept = [(trials, value)]
    for number in range(1, generations + 1):
        alive = np.flatnonzero(step > LEAST_STEP)
        if not len(alive) or not goes_on(number, generations, "generation"):
            break
        root = np.linalg.cholesky(covariance[alive] + 1e-12 * np.eye(size))
        draws = rng.normal(size=(len(alive), CHILDREN, size)) @ root.swapaxes(-1, -2)
        genes = mean[alive, None] + step[alive, None, None] * draws
        parent = np.repeat(alive, CHILDREN)
        start = _with_genes(take(best, parent), genes.reshape(-1, size), task)
        children, met = projected(start, task, PROJECTION_STEPS)
        worth = assessed(children, task) if assess is None else assess(children)
        worth = worth._replace(violation=np.where(met.all(axis=1), worth.violation, np.inf))
        own = costs(worth, aims[parent], enough).reshape(len(alive), CHILDREN)
        order = np.argsort(own, axis=1)[:, :PARENTS]
        at = np.arange(len(alive))[:, None]
        found = _genes(children, task).reshape(len(alive), CHILDREN, size)[at, order]
        usable = np.isfinite(own[at, order])
        share = weights * usable
        total = share.sum(axis=1)
        share = share / np.maximum(total, 1e-300)[:, None]
        ok = total > 0
        moved = (found - mean[alive, None]) / step[alive, None, None]
        spread = np.einsum("kp,kpi,kpj->kij", share, moved, moved)
        new = np.einsum("kp,kpi->ki", share, found)
        index = alive[ok]
        covariance[index] = (1 - LEARNING) * covariance[index] + LEARNING * spread[ok]
        mean[index] = new[ok]
        first = order[:, 0]
        better = own[at[:, 0], first] < cost[alive]
        winners = np.flatnonzero(better)
        if len(winners):
            child = winners * CHILDREN + first[winners]
            best = replaced(best, alive[winners], take(children, child))
            cost[alive[winners]] = own[winners, first[winners]]
        step[alive] *= np.where(better, LONGER, SHORTER)
        good = np.flatnonzero(worth.good)
        kept.append((take(children, good), take(worth, good)))
    every, worths = (concatenate(list(parts)) for parts in zip(*kept, strict=True))
    good = np.flatnonzero(worths.good)
    return take(every, good), take(worths, good)


def _genes(trials: Trials, task: OpenTask) -> FloatArray:
    """What evolves, (k, n): pivots and lines, and the offsets from poses that have tolerances."""
    pivots = trials.batch.dimensions[..., :PIVOTS].reshape(len(trials), -1)
    loose = task.half_widths > 0
    return np.concatenate([pivots, trials.offsets[:, loose] / _widths(task)], axis=1)


def _with_genes(trials: Trials, genes: FloatArray, task: OpenTask) -> Trials:
    """Linkages (k,) with other pivots, lines and offsets."""
    dimensions, offsets = trials.batch.dimensions.copy(), trials.offsets.copy()
    pivots = 2 * PIVOTS
    dimensions[..., :PIVOTS] = genes[:, :pivots].reshape(-1, 2, PIVOTS)
    loose = task.half_widths > 0
    bound = task.half_widths[loose]
    offsets[:, loose] = (genes[:, pivots:] * _widths(task)).clip(-bound, bound)
    return replace(trials, batch=LinkageBatch(trials.batch.kinds, dimensions), offsets=offsets)


def _widths(task: OpenTask) -> FloatArray:
    """By how much a step of one moves an offset, for those that may move."""
    loose = task.half_widths[task.half_widths > 0]
    return np.minimum(2 * loose / FIRST_STEP, 1.0)
