"""Linkages whose places stay inside the tolerances of the poses.

From linkages near the poses all dimensions are refined: first for the least error in the metric of
the tolerances, then under the condition that every place is inside.  A heuristic: that no linkage
stays inside where none is found is not proved.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.numerics.arrays import FloatArray
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.target import Target

if TYPE_CHECKING:
    from burmester.linkages.evaluation import Candidates

__all__ = ["into_boxes"]

MAX_POSES = 60  # refine on at most so many poses, evenly thinned
STEPS = 40  # number of steps of each of the two refinements


def into_boxes(candidates: Candidates, target: Target) -> Candidates:
    """The linkages refined into the boxes of a target, or as near to them as they come."""
    thin = target.thinned(MAX_POSES)
    batch, rows = candidates.batch, candidates.rows
    if thin is not target:
        rows = thin.places(batch)
    for each in (thin.relaxed, thin):
        batch, rows = _refined(batch, rows, each)
    return candidates._replace(batch=batch, rows=target.places(batch))


def _refined(
    batch: LinkageBatch, rows: FloatArray, target: Target
) -> tuple[LinkageBatch, FloatArray]:
    """Linkages (k,) with places (k, N, 3), refined where all constraints come to hold."""
    some = np.flatnonzero(np.isfinite(rows).all(axis=(1, 2)))
    if not len(some):
        return batch, rows
    refined = target.refine(
        batch[some],
        rows[some],
        constraints=AllConstraints(target.kept),
        constrained_steps=STEPS,
    )
    better = refined.met & np.isfinite(refined.rows).all(axis=(1, 2))
    dimensions, places = batch.dimensions.copy(), rows.copy()
    dimensions[some[better]] = refined.batch.dimensions[better]
    places[some[better]] = refined.rows[better]
    return LinkageBatch(batch.kinds, dimensions), places
