"""Position against angle: what a linkage gains in one of its two errors, and pays in the other.

One length says how much an angle counts.  Where the errors pull apart another length would choose
quite another linkage; so the recommended one is refined again under lengths to both sides.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.constraints import AllConstraints
from burmester.linkages.defect_free_search import refined_on_branch
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.found_linkage import FoundLinkage
from burmester.linkages.ranking import digits_leave_open, is_trade
from burmester.linkages.target import Target
from burmester.progress import time_for

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
    out = []
    for ratio in LENGTH_RATIOS:
        other = replace(target, length=ratio * target.length)
        batch = _refined(best, other)
        if batch is None:
            continue
        rows = target.places(batch)
        found = evaluation.evaluate(
            Candidates(batch, rows, [best.dyads], np.array([best.from_search]))
        )
        out += [each for each in found if each.usable and is_trade(each, best)]
    return out


def _refined(best: FoundLinkage, target: Target) -> LinkageBatch | None:
    """A linkage refined for another length per radian; None where it was lost."""
    batch = LinkageBatch.of([best.linkage]).to_canonical(target.frames)
    rows = target.rows_at(best.error.places)[None]
    if best.from_search or target.requirements.has_any:
        driver = np.array([int(best.preferred_driver == "second")])
        found = refined_on_branch(batch, rows, target, driver, steps=STEPS)
    else:
        kept = AllConstraints(target.kept) if target.kept else None
        found = target.refine(batch, rows, constraints=kept, worst=target.worst, steps=STEPS)
    return found.batch if found.met.all() else None
