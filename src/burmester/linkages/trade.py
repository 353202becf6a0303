"""Position against angle: what a linkage gains in one of its two errors, and pays in the other.

One length says how much an angle counts.  Where the errors pull apart another length would choose
quite another linkage; so the recommended one is refined again under lengths to both sides.
"""

from __future__ import annotations

import math

import numpy as np

from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.progress import time_for
from burmester.refinement.defect_free_search import refined_on_branch
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.ranking import digits_leave_open, is_trade

__all__ = ["trades"]

LENGTH_RATIOS = 0.25, 4.0  # of the lengths per radian that are tried beside the chosen one
STEPS = 40  # number of steps of these refinements


def trades(best: FoundLinkage, evaluation: Evaluation) -> list[FoundLinkage]:
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
        steps=STEPS,
        metric=metric,
    )
    batch = refined.batch[refined.met]
    count = len(batch)
    found = evaluation.evaluate(
        Candidates(
            batch, target.places(batch), [best.dyads] * count, np.full(count, best.from_search)
        )
    )
    return [each for each in found if each.usable and is_trade(each, best)]
