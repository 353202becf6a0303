"""Linkages that were refined on a sample of many poses: the last steps by all, and the verdicts.

A sample of the poses leads to the same minimum but for its errors, so few steps of all poses are
left.  They start at the places nearest to the sample, which lie close along the whole motion.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.numerics.arrays import FloatArray
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.kept_timing import TimingConstraint
from burmester.refinement.target import Target
from burmester.tasks.pose_sample import PoseSample
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.ranking import ranked

# Steps by all poses: so many places are computed for a linkage, in at least and at most so many
# steps; their first damping.
PLACES, STEPS, DAMPING = 200_000, (3, 40), 1e-9
MOST, COST_RATIO = 4, 4.0  # the nearest so many linkages get them, and all within that cost ratio
# Least worst errors: poses join the sample that are missed by more than those in it times this
# ratio, so many of each linkage at once.
WORSE_RATIO, JOINED = 1.001, 8
POSES_PER_BLOCK = 20_000  # number of poses whose nearest samples are looked for at once


def refined_by_all(candidates: Candidates, target: Target) -> Candidates:
    """The near ones of linkages, refined on a sample, refined by all poses; their places there.

    Not where places have to be inside tolerances, nor for the least worst error: there the poses
    that are missed by most join the sample (`worst_left_out`).
    """
    whole, index = target.whole, target.index
    if whole is None or index is None or whole.worst or whole.boxes is not None:
        return candidates
    if any(isinstance(each, TimingConstraint) for each in whole.kept):
        return candidates  # places that the crank times are unknowns, and of many poses too many
    cost = np.nan_to_num(target.cost(candidates.rows), nan=np.inf)
    near = np.sort(cost)[: min(MOST, len(cost))]
    some = np.flatnonzero(np.isfinite(cost) & (cost <= max(COST_RATIO * near[0], near[-1])))
    kept = AllConstraints(whole.kept) if whole.kept else None
    steps = int(np.clip(PLACES // whole.poses.shape[0], *STEPS))
    dimensions, rows = candidates.batch.dimensions.copy(), candidates.rows.copy()
    for k in some.tolist():  # one by one: that bounds the memory
        refined = whole.refine(
            candidates.batch[[k]],
            places_along(candidates.rows[k], whole)[None],
            constraints=kept,
            steps=steps,
            constrained_steps=steps,
            damping=DAMPING,
        )
        if refined.met[0]:
            dimensions[k], rows[k] = refined.batch.dimensions[0], refined.rows[0, index]
    batch = LinkageBatch(candidates.batch.kinds, dimensions)
    return candidates._replace(batch=batch, rows=rows, both=None)


def worst_left_out(
    found: Sequence[FoundLinkage], target: Target, sample: PoseSample
) -> NDArray[np.intp]:
    """The poses outside a sample that linkages judged at all miss by more than those in it.

    Those of the first linkage and of the nearest one, the farthest missed of each.
    """
    out: list[NDArray[np.intp]] = [np.empty(0, dtype=np.intp)]
    nearest = min(found, key=lambda each: each.combined_error, default=None)
    for each in {id(one): one for one in (*found[:1], nearest) if one is not None}.values():
        gap = target.rows_at(each.error.places) - rows_of(target.poses, target.length)
        away = np.linalg.norm(gap, axis=-1)
        beyond = np.flatnonzero(away > WORSE_RATIO * away[sample.index].max())
        out.append(beyond[np.argsort(-away[beyond])][:JOINED])
    return np.unique(np.concatenate(out))


def places_along(rows: FloatArray, whole: Target) -> FloatArray:
    """For each of all poses (N,) the nearest of the places (n, 3) of a linkage: (N, 3).

    Angles within half a turn of the poses'.  Near is meant in the plane and on the circle of
    orientations, where one product compares all with all.
    """
    wanted, length = rows_of(whole.poses, whole.length), whole.length

    def flat(at: FloatArray) -> FloatArray:
        turn = length * np.exp(1j * at[:, 2] / length)
        return np.column_stack([at[:, :2], turn.real, turn.imag])

    places = flat(rows)
    half = (places * places).sum(axis=1) / 2
    out = np.empty_like(wanted)
    for at in range(0, len(wanted), POSES_PER_BLOCK):
        block = slice(at, at + POSES_PER_BLOCK)
        out[block] = rows[(half - flat(wanted[block]) @ places.T).argmin(axis=1)]
    turn = 2 * np.pi * length
    out[:, 2] += turn * np.round((wanted[:, 2] - out[:, 2]) / turn)
    return out


def judged_at_all(found: Sequence[FoundLinkage], evaluation: Evaluation) -> list[FoundLinkage]:
    """Linkages judged at other poses, evaluated at those of the evaluation, and ranked."""
    out: list[FoundLinkage] = []
    for each in found:
        own = LinkageBatch.of([each.linkage])
        batch = own.to_canonical(evaluation.target.frames)
        rows = np.full((1, *evaluation.target.poses.shape, 3), np.nan)
        if evaluation.target.boxes is not None:
            rows = evaluation.target.places(batch)
        out += evaluation.evaluate(Candidates(batch, rows, [each.dyads], each.from_search, own))
    return ranked(out, evaluation.problem)
