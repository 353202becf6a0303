"""The best of the linkages within a stated tolerance: they transmit more, and miss as allowed.

Within a tolerance not the closest linkage is wanted.  Close ones are refined again, each under
several least transmission angles at once, from the one that is reached to nearly a right angle.
What stays within the tolerance is refined again, between its angle and the next one, which was too
much.  A heuristic: that no linkage within the tolerance transmits better is not proved.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.further_pairs import MAX_POSES_SEARCHED
from burmester.numerics.arrays import FloatArray, concatenate, take
from burmester.refinement.defect_free_search import driving_sides, refined_on_branch
from burmester.refinement.target import Target
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.verdicts.ranking import by_quality

MOST_CLOSEST = 4  # number of linkages that are refined again, with either driver
# Of the way from an angle that is reached to GREATEST_ANGLE: the angles that are tried next.
SHARES = 0.03, 0.08, 0.2, 0.5
ROUNDS = 3  # number of refinements one after the other
MOST_GOING_ON = 3  # number of linkages that are refined further
STEPS = 30  # number of steps of these refinements
GREATEST_ANGLE = math.radians(89.0)  # no greater least transmission angle is tried
MOST_KEPT = 4  # number of linkages at most


class _Starts(NamedTuple):
    """Linkages (k,) with their places, origins and drivers, and the angles that they reach.

    rows: (k, N, 3); driver: (k,); least: (k,), radians.
    """

    batch: LinkageBatch
    rows: FloatArray
    pairs: list[Pair]
    driver: NDArray[np.intp]
    least: FloatArray


def best_within(found: Sequence[FoundLinkage], evaluation: Evaluation) -> list[FoundLinkage]:
    """Usable linkages within the task's tolerance that transmit better than those found so far."""
    standard = evaluation.task.requirements.with_standard()
    target = replace(evaluation.target, requirements=standard).thinned(MAX_POSES_SEARCHED)
    starts, good, shares = _closest(found, target), [], np.array(SHARES)
    for _ in range(ROUNDS):
        better = _refined(starts, target, shares)
        if len(better.least):
            good.append(better)
            starts = better
        else:
            shares = shares * SHARES[0]
    return _evaluated(good, evaluation) if good else []


def _closest(found: Sequence[FoundLinkage], target: Target) -> _Starts:
    """The closest linkages with either driver, to transmit better than those that work."""
    reached = [each.driven.least_over_range for each in found if each.usable]
    best = max([target.requirements.transmission, *reached])
    near = [each for each in found if math.isfinite(each.combined_error)]
    near = sorted(near, key=lambda each: each.combined_error)[:MOST_CLOSEST]
    batch = LinkageBatch.of([each.linkage for each in near]).to_canonical(target.frames)
    sides = driving_sides(target.requirements)
    every, driver = np.repeat(np.arange(len(near)), len(sides)), np.tile(sides, len(near))
    pairs, least = [near[k].dyads for k in every.tolist()], np.full(len(every), best)
    return _Starts(batch[every], target.places(batch)[every], pairs, driver, least)


def _refined(starts: _Starts, target: Target, shares: FloatArray) -> _Starts:
    """The starts refined under several greater angles each: the best of those that keep to all.

    shares: of the way to GREATEST_ANGLE.  All: what is asked, and the tolerance.
    """
    every, share = (
        np.repeat(np.arange(len(starts.least)), len(shares)),
        np.tile(shares, len(starts.least)),
    )
    start = take(starts, every)
    least = start.least + share * np.maximum(GREATEST_ANGLE - start.least, 0.0)
    refined = refined_on_branch(
        start.batch, start.rows, target, start.driver, steps=STEPS, transmission=least
    )
    tried = start._replace(batch=refined.batch, rows=refined.rows, least=least)
    tried = take(tried, np.flatnonzero(refined.met & _inside(refined.rows, target)))
    return take(tried, np.argsort(-tried.least, kind="stable")[:MOST_GOING_ON])


def _inside(rows: FloatArray, target: Target) -> NDArray[np.bool_]:
    """Whether rows (k, N, 3) of places stay within the greatest errors that are asked for."""
    asked = target.requirements
    if asked.within is None:
        return np.ones(len(rows), dtype=bool)
    unit = float(target.frames.length)
    reach, length = (each / unit for each in asked.reach(asked.within, target.length * unit))
    away = rows - rows_of(target.poses, target.length)
    gap = np.abs(away if target.boxes is None else target.boxes.counted(rows))
    missed = np.maximum(np.hypot(gap[..., 0], gap[..., 1]), length / target.length * gap[..., 2])
    return np.asarray((missed <= reach).all(axis=-1))


def _evaluated(good: Sequence[_Starts], evaluation: Evaluation) -> list[FoundLinkage]:
    """The usable ones of all rounds, the best first."""
    every = concatenate(good)
    rows = evaluation.target.places(every.batch)
    found = evaluation.evaluate(Candidates(every.batch, rows, every.pairs, from_search=True))
    usable = [each for each in found if each.usable and not each.shortcomings]
    return by_quality(usable, evaluation.target.requirements)[:MOST_KEPT]
