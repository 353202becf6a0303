"""Linkages near others that bear too much: they bear what is asked, and miss the poses by more.

Those that work but for their loads are refined again on their branch, under all that they keep and
the bounds of their loads (`loads.excesses`), whose derivatives are difference quotients.  A local
search: that no other linkage bears less is not proved.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Final, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.fourbar.defects import judge
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.numerics.arrays import FloatArray, replaced
from burmester.numerics.differences import DifferenceQuotients
from burmester.progress import goes_on, step
from burmester.refinement.constraints import ConstraintSlopes, ConstraintValues
from burmester.refinement.defect_free_search import FEW_POSES, refined_on_branch
from burmester.refinement.target import Target
from burmester.requirements.loads import (
    DRIVER_TORQUE,
    HAND_FORCE,
    KINDS_OF_LOADS,
    PIN_FORCE,
)
from burmester.tasks.motion_task import characteristic_length
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.ranking import closest_usable, digits_leave_open
from burmester.wording import count

MOST: Final = 4  # linkages that are refined
ENOUGH: Final = 2  # of them, if one has led to another linkage
STEPS: Final = 30  # of a refinement
SAME: Final = 1e-3  # motion sizes; linkages whose dimensions differ by less are one
TWICE: Final = 2.0  # so much too great a force is not halved by moving pivots a little
QUOTIENTS: Final = DifferenceQuotients(stride=1e-6)


def only_bears_too_much(found: FoundLinkage) -> bool:
    """Whether a linkage would be usable but for its loads."""
    kinds = {each.kind for each in found.violations}
    return not found.defects and bool(kinds) and kinds <= KINDS_OF_LOADS


def bearing_linkages(
    found: Sequence[FoundLinkage],
    evaluation: Evaluation,
    judged: Callable[[Candidates], list[FoundLinkage]] | None = None,
) -> list[FoundLinkage]:
    """Usable linkages near the first of those that bear too much, in their order.

    Where a linkage that bears what is asked is nearer, none is looked for; nor where the crank
    times a path.  judged: as the others were, by default `Evaluation.members`.
    """
    problem, closest = evaluation.problem, closest_usable(found)
    most = math.inf if closest is None else closest.combined_error
    near = [
        each
        for each in found
        if only_bears_too_much(each) and each.combined_error < most and _is_within_reach(each)
    ]
    path = evaluation.target.path
    near = near[:MOST] if path is None or path.crank_angles is None else []
    if near:
        step(f"refining {count(len(near), 'linkage')} under loads", whole=False)
    out = list[FoundLinkage]()
    for number, each in enumerate(near, start=1):
        if (out and number > ENOUGH) or not goes_on(number, len(near), "linkage", has_steps=True):
            break
        refined = refined_under_loads(each, evaluation)
        out += [
            one
            for one in (judged or evaluation.members)(refined)
            if one.usable
            and (not meets_exactly(evaluation) or one.combined_error <= digits_leave_open(problem))
            and not any(_alike(one, other, SAME * problem.motion_size) for other in out)
        ]
    return out


def _is_within_reach(found: FoundLinkage) -> bool:
    """Whether none of its greatest forces is more than twice its bound."""
    return not any(
        float(each.excess(found.figures, bound)) > math.log(TWICE)
        for each, bound in found.task.requirements.bounds.items()
        if each in (HAND_FORCE, DRIVER_TORQUE, PIN_FORCE) and not isinstance(bound, tuple)
    )


def _alike(one: FoundLinkage, other: FoundLinkage, most: float) -> bool:
    """Whether the dimensions of two linkages are alike, in either order of their dyads."""
    own, theirs = (LinkageBatch.of([each.linkage]) for each in (one, other))
    return any(
        (own.kinds == each.kinds).all() and np.abs(own.dimensions - each.dimensions).max() <= most
        for each in (theirs, theirs.exchanged())
    )


def meets_exactly(evaluation: Evaluation) -> bool:
    """Whether infinitely many linkages meet the poses, so that none need be missed."""
    return evaluation.target.boxes is None and max(evaluation.problem.missing_conditions) > 0


def refined_under_loads(found: FoundLinkage, evaluation: Evaluation) -> Candidates:
    """A linkage refined under the bounds of its loads, with its driver, on its branch."""
    from burmester.loads.excesses import excesses  # noqa: PLC0415  tasks with loads only

    target, asked = evaluation.target, evaluation.task.requirements
    if not found.shortcomings:
        asked = asked.with_standard()
    batch = LinkageBatch.of([found.linkage]).to_canonical(target.frames)
    rows = target.rows_at(found.error.places)[None]
    few, index = target.thinned(FEW_POSES), target.thin_numbers(FEW_POSES)
    kept = (*few.kept, _Bearing(found, few, index, len(excesses(found))))
    exact = few.exact
    if meets_exactly(evaluation):
        exact = np.ones(len(index), dtype=bool)
    few = replace(few, requirements=asked, kept=kept, exact=exact)
    side = np.array([int(found.preferred_driver == "second")])
    refined = refined_on_branch(batch, rows[:, index], few, side, steps=STEPS)
    sound = np.isfinite(refined.rows).all(axis=(1, 2))
    new = refined.batch[sound]
    return Candidates(new, target.places(new), [found.dyads] * len(new), from_search=True)


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Bearing:
    """The constraint that one linkage bears what is asked.

    found: it, with its driver; index: of the poses that are looked at; number: of excesses.
    """

    found: FoundLinkage
    target: Target
    index: NDArray[np.intp]
    number: int
    uses_places: ClassVar[bool] = True

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        own = batch.from_canonical(self.target.frames)
        there = self.target.frames.from_canonical(self.target.places_of(rows))
        error, task = self.found.error, self.found.task
        lost = np.full((len(own), len(error.angle), 3), np.nan)
        places = replaced(Displacement.from_poses(lost), (slice(None), self.index), there)
        length = characteristic_length(task)
        missed = np.hypot(error.position, length * error.angle)
        verdicts = judge(
            own,
            places,
            missed=np.tile(missed, (len(own), 1)),
            reach=np.inf,
            length=length,
            any_order=task.requirements.any_order,
        )
        beside = [
            replace(
                self.found,
                linkage=own.linkage(k),
                verdict=verdict,
                error=replace(error, places=places[k]),
            )
            for k, verdict in enumerate(verdicts)
        ]
        return np.array([*map(self._excesses, beside)]), np.zeros(self.number, dtype=bool)

    def _excesses(self, found: FoundLinkage) -> FloatArray:
        """Those of one linkage; nan where it does not move."""
        from burmester.loads.excesses import excesses  # noqa: PLC0415  tasks with loads only

        try:
            return excesses(found)
        except InputError:
            return np.full(self.number, np.nan)

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """By difference quotients of the dimensions; steps along the motion change little."""
        (count, unknowns), size = (len(batch), place_jacobian.shape[-1]), 2 * DIMENSIONS
        z = QUOTIENTS.points(batch.dimensions.reshape(count, size), np.eye(size)[:, None])
        places = QUOTIENTS.points(rows, np.moveaxis(place_jacobian[..., :size], -1, 0))
        kinds = np.tile(batch.kinds, (size + 1, 1))
        beside = LinkageBatch(kinds, z.reshape(-1, 2, DIMENSIONS))
        value, equal = self(beside, places.reshape(-1, *rows.shape[1:]), np.tile(which, size + 1))
        value = value.reshape(size + 1, count, -1)
        slope = np.zeros((*value.shape[1:], unknowns))
        slope[..., :size] = QUOTIENTS.jacobian(value)
        return value[0], slope, equal
