"""Linkages to build, from those that are close and not sound.

The closest linkages are refined again, with either dyad driving, under the standard of
`requirements.table`: they give up some nearness for a transmission angle and sane links.  A
heuristic: that no other linkage within the bound is sound is not proved.

One length says how much an angle counts.  Where position and angle error pull apart another length
would choose another linkage, so the recommended one is refined again under lengths to both sides.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.progress import time_for
from burmester.refinement.defect_free_search import driving_sides, refined_on_branch
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.ranking import digits_leave_open, is_trade

LENGTH_RATIOS = 0.25, 4.0  # of the lengths per radian that are tried beside the chosen one
TRADE_STEPS = 40  # number of steps of these refinements

MOST_CLOSEST = 12  # number of linkages that are refined again
STEEPEST = 85.0  # degrees; no more is asked of a transmission angle
STEPS = 40  # number of steps of these refinements
CHOICE = ((8, 4),)  # where few are asked for: steps, and the number of the best that go on


def sound_linkages(
    found: Sequence[FoundLinkage],
    evaluation: Evaluation,
    most: float,
    transmission_deg: float = 0.0,
) -> list[FoundLinkage]:
    """Usable linkages that meet the standard, with a combined error of `most` or less.

    transmission_deg: the least transmission angle over the range that is looked for in place of
        the standard's; then from the first linkages found, not from the closest, and whatever
        else they lack.
    """
    asked = evaluation.task.requirements
    required = asked.with_standard()
    if transmission_deg:
        least = max(asked.transmission_deg, min(transmission_deg, STEEPEST))
        required = replace(required, transmission_deg=least)
    target = replace(evaluation.target, requirements=required)
    near = [each for each in found if np.isfinite(each.combined_error)]
    if not transmission_deg:
        near = sorted(near, key=lambda each: each.combined_error)
    near = near[:MOST_CLOSEST]
    sides = driving_sides(asked)
    every, lead = np.repeat(np.arange(len(near)), len(sides)), np.tile(sides, len(near))
    batch = LinkageBatch.of([each.linkage for each in near]).to_canonical(target.frames)
    rows = np.stack([target.rows_at(each.error.places) for each in near])
    refined = refined_on_branch(
        batch[every],
        rows[every],
        target,
        lead,
        steps=STEPS,
        selection=CHOICE if transmission_deg else (),
        most=most / float(target.frames.length),
    )
    index = np.flatnonzero(refined.met)
    candidates = Candidates(
        refined.batch[index],
        refined.rows[index],
        [near[k].dyads for k in every[index].tolist()],
        from_search=True,
    )
    return [
        each
        for each in evaluation.evaluate(candidates)
        if each.usable
        and (transmission_deg or not each.shortcomings)
        and each.combined_error <= most
    ]


def trade_offs(best: FoundLinkage, evaluation: Evaluation) -> list[FoundLinkage]:
    """Linkages near a usable one that are truer in one error, as usable, and not much worse."""
    problem, target = evaluation.problem, evaluation.target
    if target.boxes is not None:  # the tolerances say what an angle counts as
        return []
    if not math.isfinite(best.combined_error) or (
        best.combined_error <= digits_leave_open(problem)
    ):
        return []
    if not time_for("trading position against angle"):
        return []
    every = np.zeros(len(LENGTH_RATIOS), dtype=int)
    metric = np.stack([np.diag([1.0, 1.0, ratio]) for ratio in LENGTH_RATIOS])[:, None]
    refined = refined_on_branch(
        LinkageBatch.of([best.linkage]).to_canonical(target.frames)[every],
        target.rows_at(best.error.places)[None][every],
        target,
        every + (best.preferred_driver == "second"),
        steps=TRADE_STEPS,
        metric=metric,
    )
    batch = refined.batch[refined.met]
    rows, pairs = target.places(batch), [best.dyads] * len(batch)
    found = evaluation.evaluate(Candidates(batch, rows, pairs, best.from_search))
    return [each for each in found if each.usable and is_trade(each, best)]
