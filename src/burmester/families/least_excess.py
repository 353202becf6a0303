"""Linkages that keep all limits of a task but one, and exceed that one least.

The search of `family` where that limit is dropped; what evolves towards the least is how far the
linkages are from keeping it.  A search: that none exceeds it less is not proved.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.families.assessment import Assessment, assessed, costs
from burmester.families.evolution import improved
from burmester.families.family import (
    PINNED,
    SLIDERS,
    Family,
    FoundFamily,
    drawn_pool,
    driver_first,
    pin_places,
    rule_in_words,
    spread_out,
)
from burmester.families.open_task import OpenTask, Trials
from burmester.numerics.arrays import FloatArray, concatenate, take
from burmester.progress import time_for
from burmester.refinement.target import Target
from burmester.requirements.table import without
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.assumptions import WIDE, Assumptions

BY_EXTENT: Final = 1  # the number of that aim in AIMS; its place is taken by the excess
STARTS: Final = 8  # number of populations
# Of the evolution: of that which looks whether there is any linkage, and of that towards the least.
GENERATIONS: Final = (8, 20)
DRAWN: Final = {0: 450}  # number of dyads with pins that are drawn
MOST_STARTS: Final = 300  # number of linkages among which starts are looked for
TAKEN: Final = 3  # number of linkages that are told of
NEVER: Final = 1.0  # excess of a dyad of a kind that is not allowed
FLOOR: Final = 1e-9  # keeps the logarithm of an excess finite


@final
class LeastExcess(NamedTuple):
    """Linkages (k,) that keep all but one limit, the least excess first.

    excess: (k,), lengths, radians, logarithms of ratios, or shares of the motion, by the limit;
        zero where a linkage keeps that one, too.
    met: how many linkages that keep the other limits were looked at.
    """

    trials: Trials
    excess: FloatArray
    met: int


def least_excess(
    stated: OpenTask, loose: OpenTask, near: Trials | None, *, wide: bool
) -> LeastExcess | None:
    """The linkages nearest to keeping the limits that `loose` lacks; None if none keeps the rest.

    stated, loose: the same task with and without these limits, in the same frames.
    near: `linkages_within_limits` as stated.  wide: whether others are drawn beside them, as
        `loose` has more room for dyads.
    """
    rng = np.random.default_rng(0)
    every: list[tuple[Trials, FloatArray]] = []

    def assess(trials: Trials) -> Assessment:
        value = assessed(trials, loose)
        extent = np.full(len(trials), np.inf)
        good = np.flatnonzero(value.good)
        extent[good] = excesses(take(trials, good), stated) + FLOOR
        return value._replace(extent=extent)

    pools = [] if near is None else [near]
    if wide:
        pools += _drawn(loose, rng)
    for pool in pools:
        trials, value = pool, assess(pool)
        every.append(_good(trials, value))
        for generations in GENERATIONS:
            start = _starts(trials, value, loose)
            trials, value = improved(
                take(trials, start),
                take(value, start),
                np.full(len(start), BY_EXTENT),
                loose,
                generations=generations,
                rng=rng,
                assess=assess,
            )
            every.append((trials, value.extent))
            if not len(trials):
                break
            best = np.argsort(value.extent, kind="stable")[:MOST_STARTS]
            trials, value = take(trials, best), take(value, best)
    if not sum(len(excess) for _, excess in every):
        return None
    trials = concatenate([each for each, _ in every])
    excess = np.maximum(np.concatenate([each for _, each in every]) - FLOOR, 0.0)
    order = np.argsort(excess, kind="stable")
    kept = []
    for k in order[: 20 * TAKEN]:
        one = take(trials, np.array([k]))
        if loose.conditions.around is None or assessed(one, loose, thorough=True).good[0]:
            kept.append(int(k))
        if len(kept) == TAKEN:
            break
    if not kept:
        return None
    return LeastExcess(take(trials, np.array(kept)), excess[kept], len(excess))


def assumed_to_build(problem: SynthesisProblem, reach: float = WIDE) -> Assumptions:
    """What a linkage to build must be where the task says nothing; reach: motion sizes."""
    known = Assumptions.of(problem, reach)
    stated = problem.given.requirements.bounds
    usual = {each: each.standard for each in known.asked if each.assumed and each not in stated}
    return replace(known, asked={**known.asked, **usual})


def last_search(
    problem: SynthesisProblem, target: Target, before: FoundFamily | None
) -> FoundFamily | None:
    """Where no linkage of a family works: one to build that evolves towards doing so, or `before`.

    Pairs that transmit too little evolve towards what is asked; others keep all else.
    """
    if not time_for("looking once more for a linkage that works"):
        return before
    assumed = assumed_to_build(problem)
    stated = OpenTask.of(problem, target, assumed)
    asked = without(stated.conditions.asked, {"transmission"})
    loose = replace(stated, conditions=replace(stated.conditions, asked=asked))
    near = least_excess(stated, loose, linkages_within_limits(stated), wide=False)
    if near is None or near.excess[0] > 0:
        return before
    trials = take(near.trials, np.flatnonzero(near.excess == 0))
    dyads, pairs = (0, 0) if before is None else (before.family.dyads, before.family.pairs)
    rule = rule_in_words(stated.conditions)
    return FoundFamily(
        Family(rule, assumed.bounds, False, dyads, near.met + pairs),
        driver_first(trials, stated),
        np.zeros_like(trials.driver) if stated.is_symmetric else trials.driver,
        stated.rows(trials.offsets),
        True,
    )


def linkages_within_limits(stated: OpenTask) -> Trials | None:
    """Linkages drawn within the limits of a task, whether they keep its other conditions or not."""
    pools = _drawn(stated, np.random.default_rng(0))
    return concatenate(pools) if pools else None


def _drawn(task: OpenTask, rng: np.random.Generator) -> list[Trials]:
    """Linkages with pins alone, and with sliders, where a task allows them."""
    out = []
    for counts, kinds in ((DRAWN, {PINNED}), (SLIDERS, task.conditions.kinds - {PINNED})):
        allowed = frozenset(kinds & task.conditions.kinds)
        if allowed and all(set(side.kinds) & set(counts) for side in task.sides):
            pool = drawn_pool(task, allowed, counts, rng)
            out += [] if pool is None else [pool.trials]
    return out


def _good(trials: Trials, value: Assessment) -> tuple[Trials, FloatArray]:
    """The linkages that keep all but the limit, and their excess, under the name of extent."""
    good = np.flatnonzero(value.good)
    return take(trials, good), value.extent[good]


def _starts(trials: Trials, value: Assessment, task: OpenTask) -> NDArray[np.intp]:
    """The best linkages, far from each other."""
    cost = costs(value, np.full(len(trials), BY_EXTENT), task.conditions.enough)
    first = np.argsort(cost, kind="stable")[:MOST_STARTS]
    points = pin_places(take(trials, first), task) / task.conditions.span
    return np.asarray(first[spread_out(points, STARTS)])


def excesses(trials: Trials, task: OpenTask) -> FloatArray:
    """How far linkages (k,) are from keeping all limits of a task, (k,)."""
    out = assessed(trials, task).violation.copy()
    kinds, z = trials.batch.kinds, trials.batch.dimensions
    for number, side in enumerate(task.sides):
        kind, own = kinds[:, number], z[:, number]
        away = np.zeros(len(own))
        fixed, moving = kind != 1, kind != 2
        for holds, freedom, at in (
            (fixed, side.fixed, slice(0, 2)),
            (moving, side.moving, slice(2, 4)),
        ):
            points = own[holds, at]
            away[holds] += np.linalg.norm(points - freedom.nearest(points)[0], axis=-1)
        least, most = side.length
        link = np.where(kind == 0, own[:, 4], np.clip(0.0, least, most))
        away += np.maximum(least - link, 0.0) + np.maximum(link - most, 0.0)
        out += away + NEVER * ~np.isin(kind, side.kinds)
    return np.asarray(out)
