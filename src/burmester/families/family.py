"""The best linkages of a family: of all that meet few poses, or poses within tolerances.

Dyads are drawn from the family, all their pairs are looked at, and the best of those that work are
improved for each of several aims.  Kept are linkages of which none is worse in all three figures
of quality, far from each other.  A search: that none better exists is not proved.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.families.assessment import AIMS, Assessment, assessed, costs
from burmester.families.dyad_samples import drawn_dyads
from burmester.families.evolution import improved
from burmester.families.open_task import Conditions, OpenTask, Trials
from burmester.families.pairing import promising_pairs
from burmester.fourbar.dyad import RP, RR
from burmester.fourbar.linkage_batch import DYAD_KINDS, LinkageBatch
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.numerics.arrays import FloatArray, concatenate, even_numbers, take, where
from burmester.progress import time_for
from burmester.refinement.target import Target
from burmester.requirements.figures import Figures
from burmester.requirements.loads import OF_LOADS
from burmester.requirements.table import excess
from burmester.tasks.option_table import Preference
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.assumptions import Assumptions, Bound
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.quality import (
    PROPORTIONS,
    best_first,
    enough_transmission,
    proportions,
    rule,
)

# Of what the least, or nearly the least, is recommended, by what is preferred.
PREFERRED: Final[Mapping[Preference, str]] = {
    "transmission": PROPORTIONS,
    "size": "extent",
    "accuracy": "sensitivity",
}
# Ratio to the least of it, up to which another one is as good, and in words.
AS_GOOD: Final = {"transmission": 1.25, "size": 1.1, "accuracy": 1.1}
AS_GOOD_WORDS: Final = {1.25: "quarter", 1.1: "tenth"}
# Radians; more than is assumed.  Where a task asks for as much, proportions come first.
GOOD_TRANSMISSION: Final = math.radians(40)

# How many dyads are drawn of each kind: RR, PR, RP; with pins alone, and with sliders.
PINS: Final = {0: 450}
SLIDERS: Final = {0: 200, 1: 80, 2: 80}
JUDGED: Final = 1500  # number of pairs of each two kinds that are judged
POPULATIONS: Final = (8, 3, 3, 4)  # number of starts for each of the AIMS
# Of the evolution from them, by the number of poses: two poses leave more freedom than four.
GENERATIONS: Final = {2: 45, 3: 30, 4: 20}
MOST_GENERATIONS: Final = 60  # with tolerances, which leave more
APART: Final = 0.15  # motion sizes; starts are farther from each other
SHOWN: Final = 12  # number of linkages that are kept at most
SHOWN_SLIDERS: Final = 4  # of these with sliders, where pins alone work
SHOWN_FAILING: Final = 3  # number of linkages that are told where none works
SLIDER_GENERATIONS: Final = 12  # of the evolution of linkages with sliders
MIN_DRAWN: Final = 24  # number of dyads of a kind that are drawn at least
MOST_STARTS: Final = 300  # number of linkages among which starts are looked for
PINNED: Final = frozenset({RR})  # the kinds of a linkage with pins alone
SHOWN_APART: Final = 0.3  # motion sizes; least distance of those
MOST_COMPARED: Final = 2000  # number of linkages that are compared with each other, about
MOST_LOADED: Final = 60  # number of linkages that are loaded, where loads are held to bounds
UNLOADED: Final = 10.0  # violation of a linkage that cannot be loaded
VARIANTS: Final = 12  # number of draws of poses within their tolerances


@final
@dataclass(frozen=True, slots=True, eq=False)
class Family:
    """How linkages were chosen from a family.

    rule: by which one is recommended, as a sentence.
    bounds: what was assumed.
    given_up: whether bounds that were only assumed had to be given up.
    dyads, pairs: how many were drawn, and looked at.  loaded: how many of those that work were
    loaded, to see whether they bear what is asked.
    """

    rule: str
    bounds: tuple[Bound, ...]
    given_up: bool
    dyads: int
    pairs: int
    loaded: int = 0


class FoundFamily(NamedTuple):
    """The best linkages of a family, the recommended one first, and how they were chosen.

    batch: linkages (k,) in the frames of the target, the driver first unless the task has two
        limits; drivers: (k,), the sides that drive; rows: (k, N, 3), their places at the poses.
    works: whether they meet all conditions; else they are the nearest to doing so.
    """

    family: Family
    batch: LinkageBatch
    drivers: NDArray[np.intp]
    rows: FloatArray
    works: bool


class Pool(NamedTuple):
    """Linkages that were judged, and of how many dyads and pairs."""

    trials: Trials
    value: Assessment
    dyads: int
    pairs: int
    loaded: int = 0


def best_of_family(problem: SynthesisProblem, target: Target) -> FoundFamily | None:
    """The best linkages of all that meet the poses of a problem; None where no dyad does.

    Where none keeps what is assumed, pivots may lie farther away, then the rest is given up.
    """
    first: FoundFamily | None = None
    for assumed, given_up in Assumptions.attempts(problem):
        if first is not None and not time_for("looking again under looser assumptions"):
            break
        task = OpenTask.of(problem, target, assumed)
        found = _searched(task, assumed, Evaluation(problem, target))
        if found is not None and found.works:
            return found._replace(family=replace(found.family, given_up=given_up))
        first = first or found
    if first is None:
        return None
    return first._replace(family=replace(first.family, given_up=True))


def _searched(task: OpenTask, assumed: Assumptions, evaluation: Evaluation) -> FoundFamily | None:
    """The best linkages of an open task, or the nearest to meeting its conditions."""
    rng = np.random.default_rng(0)
    kinds = task.conditions.kinds
    pools: list[Pool] = []
    for counts, pairs, generations in (
        (PINS, kinds & {PINNED}, GENERATIONS.get(task.poses.shape[0], MOST_GENERATIONS)),
        (SLIDERS, kinds - {PINNED}, SLIDER_GENERATIONS),
    ):
        able = all(set(side.kinds) & set(counts) for side in task.sides)
        if not (pairs and able):
            continue
        if any(pool.value.good.any() for pool in pools) and not time_for("looking at sliders"):
            break
        pool = drawn_pool(task, pairs, counts, rng)
        if pool is not None:
            many = generations if pools or counts is PINS else MOST_GENERATIONS  # sliders alone
            pools.append(_bearing(_improved(pool, task, many, rng), task, evaluation))
    if not pools:
        return None
    index = [_shown(pool, task) for pool in pools]
    good = [int(pool.value.good[k[:1]].sum()) for pool, k in zip(pools, index, strict=True)]
    if len(pools) > 1:  # sliders come after pins, and are few beside them
        index[1] = index[1][: SHOWN_SLIDERS if good[0] else SHOWN]
        if any(good):
            index = [k if works else k[:0] for k, works in zip(index, good, strict=True)]
        index[0] = index[0][: SHOWN - len(index[1])]
    chosen = [take(pool.trials, k) for pool, k in zip(pools, index, strict=True)]
    trials = concatenate(chosen)
    names = ("dyads", "pairs", "loaded")
    dyads, pairs, loaded = (sum(getattr(pool, name) for pool in pools) for name in names)
    return FoundFamily(
        Family(rule_in_words(task.conditions), assumed.bounds, False, dyads, pairs, loaded),
        driver_first(trials, task),
        np.zeros_like(trials.driver) if task.is_symmetric else trials.driver,
        task.rows(trials.offsets),
        any(good),
    )


def drawn_pool(
    task: OpenTask,
    kinds: frozenset[frozenset[type]],
    counts: Mapping[int, int],
    rng: np.random.Generator,
) -> Pool | None:
    """Linkages of dyads drawn at random, judged; None where no two dyads meet the poses.

    kinds: the pairs of kinds of dyads; counts: how many dyads of each kind.
    """
    trials, dyads, pairs = [], 0, 0
    variants = 1 if task.is_exact else VARIANTS
    share = {kind: max(count // variants, MIN_DRAWN) for kind, count in counts.items()}
    for variant in range(variants):
        offsets = rng.uniform(-1, 1, size=task.half_widths.shape) * task.half_widths
        if variant == 0:
            offsets[:] = 0.0
        one = drawn_dyads(task, task.sides[0], offsets, share, rng)
        other = one if task.is_symmetric else drawn_dyads(task, task.sides[1], offsets, share, rng)
        dyads += len(one) + (0 if task.is_symmetric else len(other))
        poses = task.places(offsets[None])[0]
        for side, (first, second) in enumerate(((one, other), (other, one))):
            if side not in task.conditions.drivers or (side == 1 and task.is_symmetric):
                continue
            most = JUDGED // variants
            found = promising_pairs(first, second, poses, task.conditions, kinds=kinds, most=most)
            pairs += found.seen
            ends = (first, found.driver), (second, found.follower)
            ends = ends[::-1] if side else ends
            batch = LinkageBatch(
                np.stack([dyad.kinds[k] for dyad, k in ends], axis=1),
                np.stack([dyad.dimensions[k] for dyad, k in ends], axis=1),
            )
            every = np.broadcast_to(offsets, (len(batch), *offsets.shape))
            trials.append(Trials(batch, every, np.full(len(batch), side)))
    every_trial = concatenate(trials)
    if not len(every_trial):
        return None
    return Pool(every_trial, assessed(every_trial, task), dyads, pairs)


def _improved(pool: Pool, task: OpenTask, generations: int, rng: np.random.Generator) -> Pool:
    """The linkages that work, with those that evolve from the best of each aim."""
    points = pin_places(pool.trials, task) / task.conditions.span
    starts, aims = [], []
    for aim, most in enumerate(POPULATIONS):
        cost = costs(pool.value, np.full(len(points), aim), task.conditions.enough)
        first = np.argsort(cost, kind="stable")[:MOST_STARTS]
        apart = spread_out(points[first], most)
        starts += first[apart].tolist()
        aims += [aim] * len(apart)
        if not pool.value.good.any():
            break  # all aims are the same: to meet the conditions
    index = np.array(starts, dtype=np.intp)
    if not time_for("improving linkages of the family"):
        generations = 0
    trials, value = improved(
        take(pool.trials, index),
        take(pool.value, index),
        np.array(aims, dtype=np.intp),
        task,
        generations=generations,
        rng=rng,
    )
    good = np.flatnonzero(pool.value.good)
    every = concatenate([take(pool.trials, good), trials])
    if not len(every):
        return pool
    worth = concatenate([take(pool.value, good), value])
    most = MOST_COMPARED if task.conditions.around is None else MOST_COMPARED // 4
    some = np.arange(0, len(every), max(1, len(every) // most))
    for aim in (0, len(AIMS) - 1):
        cost = costs(worth, np.full(len(every), aim), task.conditions.enough)
        some = np.union1d(some, np.argsort(cost, kind="stable")[: most // 8])
    return _better_driven(pool._replace(trials=take(every, some), value=take(worth, some)), task)


def _better_driven(pool: Pool, task: OpenTask) -> Pool:
    """The same linkages, each driven by the allowed dyad that transmits better."""
    own = pool.value
    if task.conditions.around is not None:
        own = assessed(pool.trials, task, thorough=True)
    pool = pool._replace(value=own)
    if len(task.conditions.drivers) == 1:
        return pool
    other = replace(pool.trials, driver=1 - pool.trials.driver)
    value = assessed(other, task, thorough=True)
    better = value.good & (value.transmission > pool.value.transmission)
    return pool._replace(
        trials=replace(pool.trials, driver=np.where(better, other.driver, pool.trials.driver)),
        value=where(better, value, pool.value),
    )


def _bearing(pool: Pool, task: OpenTask, evaluation: Evaluation) -> Pool:
    """Of linkages that work, some, loaded: those that do not bear what is asked do not work."""
    loads, good = evaluation.problem.given.loads, np.flatnonzero(pool.value.good)
    if loads is None or not len(good):
        return pool
    asked = {
        each: bound
        for each, bound in evaluation.problem.given.requirements.bounds.items()
        if each in OF_LOADS
    }
    if not (asked or loads.springs):
        return pool
    index = good[even_numbers(len(good), MOST_LOADED)]
    trials, value = take(pool.trials, index), take(pool.value, index)
    batch = driver_first(trials, task)
    own = batch.from_canonical(evaluation.target.frames)
    rows = task.rows(trials.offsets)
    some = Candidates.of_own_dyads(batch, rows, own, from_search=True)
    if not task.is_symmetric:
        some = some._replace(drivers=trials.driver)
    violation = np.full(len(index), UNLOADED)
    for each in evaluation.members(some, quality=False, clearance=False):
        if each.loads is not None:
            number = (min(int(dyad.id[1:]) for dyad in each.dyads) - 1) // 2
            missed = float(excess(asked, Figures(**each.loads.measures)))
            violation[number] = missed + len(each.loads.findings)
    value = value._replace(violation=np.asarray(violation))
    return pool._replace(trials=trials, value=value, loaded=len(index))


def spread_out(points: FloatArray, most: int) -> list[int]:
    """The first of points (k, n), best first, and further ones that are APART from these."""
    chosen: list[int] = []
    for k in range(len(points)):
        if len(chosen) == most:
            break
        if not chosen or np.linalg.norm(points[chosen] - points[k], axis=1).min() > APART:
            chosen.append(k)
    return chosen


def _shown(pool: Pool, task: OpenTask) -> NDArray[np.intp]:
    """The recommended linkage and others of the front, far from each other, best first."""
    value = pool.value
    if not value.good.any():
        return np.argsort(value.violation, kind="stable")[:SHOWN_FAILING]
    good = np.flatnonzero(value.good)
    asked = task.conditions
    best = good[_recommended(take(value, good), asked.prefer, asked.transmission)]
    transmission = np.minimum(value.transmission, asked.enough)
    figures = np.stack([-transmission, value.extent, value.sensitivity], axis=1)
    on_front = good[front(figures[good])]
    on_front = np.concatenate([[best], on_front[on_front != best]])
    aims = [int(aim(take(value, on_front), asked.enough).argmin()) for aim in AIMS]
    points = pin_places(take(pool.trials, on_front), task) / task.conditions.span
    chosen = far_apart(points, [0, *aims], SHOWN, SHOWN_APART)
    rest = on_front[chosen[1:]]
    rest = rest[best_first(*(figure[rest] for figure in value[1:]), enough=asked.enough)]
    return np.concatenate([[best], rest])


def _recommended(value: Assessment, prefer: Preference, least: float) -> int:
    """The index of the linkage that the rule recommends; least: transmission asked for, radians."""
    figure = np.ones(len(value.violation))
    if _proportions_first(prefer, least):
        figure = proportions(value.extent, value.sensitivity)
    elif prefer != "transmission":
        figure = value.extent if prefer == "size" else value.sensitivity
    alike = np.flatnonzero(figure <= AS_GOOD[prefer] * figure.min())
    return int(alike[best_first(*take(value, alike)[1:], enough=enough_transmission(least))[0]])


def _proportions_first(prefer: Preference, least: float) -> bool:
    """Whether extent and sensitivity come before transmission: what a task asks is enough."""
    return prefer == "transmission" and least >= GOOD_TRANSMISSION


def rule_in_words(asked: Conditions) -> str:
    """The rule by which a linkage is recommended, as a sentence."""
    alike = ""
    if asked.prefer != "transmission" or _proportions_first(asked.prefer, asked.transmission):
        share = AS_GOOD_WORDS[AS_GOOD[asked.prefer]]
        alike = f"of those within a {share} of the least {PREFERRED[asked.prefer]} "
    return (
        "Recommended is a linkage with pins before one with a slider, then "
        f"{alike}{rule(asked.enough)}"
    )


def pin_places(trials: Trials, task: OpenTask) -> FloatArray:
    """Where pivots and lines (k, 8) are at the first pose, the driver first."""
    batch = driver_first(trials, task, always=True)
    z = batch.dimensions[..., :4].copy()
    first = task.poses[0]
    for side in (0, 1):
        moving = batch.kinds[:, side] != DYAD_KINDS.index(RP)
        z[moving, side, 2:4] = first.act(z[moving, side, 2:4])
    return z.reshape(len(z), -1)


def driver_first(trials: Trials, task: OpenTask, *, always: bool = False) -> LinkageBatch:
    """The linkages with the driver first, unless each side has limits of its own."""
    if not (always or task.is_symmetric):
        return trials.batch
    return trials.batch.in_order(np.stack([trials.driver, 1 - trials.driver], axis=1))


def recommended_first(
    found: Sequence[FoundLinkage], problem: SynthesisProblem
) -> list[FoundLinkage]:
    """Linkages of a family, evaluated as they are to be built, in the order of its rule.

    Those that work come first, of these those that meet the standard, then pins before sliders.
    """

    def group(k: int) -> tuple[bool, bool, bool]:
        sliders = {type(each.dyad) for each in found[k].dyads} != PINNED
        return not found[k].usable, bool(found[k].shortcomings), sliders

    groups: dict[tuple[bool, bool, bool], list[int]] = {}
    for k in range(len(found)):
        groups.setdefault(group(k), []).append(k)
    least = problem.task.requirements.transmission
    order = []
    for _, index in sorted(groups.items()):
        qualities = [found[k].quality for k in index]
        rows = [
            (0.0, np.inf, np.inf) if q is None else (q.transmission, q.extent, q.sensitivity)
            for q in qualities
        ]
        value = Assessment(np.zeros(len(rows)), *np.array(rows).reshape(-1, 3).T)
        best = _recommended(value, problem.options.prefer, least)
        rest = best_first(*value[1:], enough=enough_transmission(least))
        order += [index[k] for k in (best, *rest[rest != best])]
    return [found[k] for k in order]


def front(figures: FloatArray) -> NDArray[np.intp]:
    """The indices of the rows (k, n) that no other row surpasses: less is better in each column."""
    order = np.lexsort(figures.T[::-1])
    rows = figures[order]
    kept = np.ones(len(rows), dtype=bool)
    for k in range(len(rows)):  # nothing after a row surpasses it
        if kept[k]:
            after = kept[k + 1 :]
            after &= (rows[k + 1 :] < rows[k]).any(axis=1)
    return np.asarray(order[kept])


def far_apart(points: FloatArray, first: list[int], most: int, least: float) -> list[int]:
    """At most `most` indices of points (k, n), those in `first` and others far from them.

    Each next point is the farthest from all before, by at least `least`.
    """
    chosen: list[int] = []
    away = np.full(len(points), np.inf)

    def take(k: int) -> None:
        chosen.append(k)
        np.minimum(away, np.linalg.norm(points - points[k], axis=1), out=away)

    for k in first:
        if away[k] >= least and len(chosen) < most:
            take(k)
    while len(chosen) < min(most, len(points)):
        k = int(away.argmax())
        if away[k] < least:
            break
        take(k)
    return chosen
