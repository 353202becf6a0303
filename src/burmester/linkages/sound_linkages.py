"""Linkages to build, from those that are close and not sound.

The closest linkages are refined again, with either dyad driving, under the standard of
`requirements.table`: they give up some nearness for a transmission angle and sane links.  A
heuristic: that no other linkage within the bound is sound is not proved.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.refinement.defect_free_search import driving_sides, refined_on_branch
from burmester.verdicts.found_linkage import FoundLinkage

__all__ = ["sound_linkages"]

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
    )
    index = np.flatnonzero(refined.met)
    candidates = Candidates(
        refined.batch[index],
        refined.rows[index],
        [near[k].dyads for k in every[index].tolist()],
        np.ones(len(index), dtype=bool),
    )
    return [
        each
        for each in evaluation.evaluate(candidates)
        if each.usable
        and (transmission_deg or not each.shortcomings)
        and each.combined_error <= most
    ]
