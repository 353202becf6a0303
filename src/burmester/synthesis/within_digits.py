"""Nearly undetermined motions: what the digits of the poses allow is a tolerance.

Where a body turns little, or its poses have few digits, many linkages pass within the digits, far
from each other.  Then the closest one is chance, and the best of them is wanted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from burmester.linkages.evaluation import at_given_poses
from burmester.linkages.from_dyads import linkages_from_dyads
from burmester.progress import time_for
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.verdicts.ranking import ranked

__all__ = ["tolerances_of_digits", "with_linkages_within_digits"]


def tolerances_of_digits(task: Task) -> PoseTolerances | None:
    """The resolution of the poses as their tolerances; None where they have some, or are exact."""
    position, angle = task.resolution
    exact = task.exact is not None and bool(task.exact.any())
    if task.tolerances is not None or exact or not (position > 0 and angle > 0):
        return None
    return PoseTolerances.uniform(task.poses.shape[0], position, position, angle)


def with_linkages_within_digits(
    problem: SynthesisProblem, pairs: Sequence[Pair], known: Sequence[FoundLinkage]
) -> tuple[FoundLinkage, ...]:
    """The known linkages and those that pass within the digits of the poses, by rank.

    pairs: of the dyads.  Nothing is added where the poses are exact, or have tolerances already.
    """
    tolerances = tolerances_of_digits(problem.task)
    if tolerances is None or not problem.options.refines or problem.options.rounds:
        return tuple(known)
    if not time_for("looking for the best linkages within the digits"):
        return tuple(known)
    loose = replace(problem, task=replace(problem.task, tolerances=tolerances))
    found = [
        replace(each, within_tolerance=None)
        for each in linkages_from_dyads(loose, pairs)
        if each.usable
    ]
    every = ranked([*known, *at_given_poses(found, problem)], problem)
    return tuple(
        replace(each, id=f"L{rank}", rank=rank) for rank, each in enumerate(every, start=1)
    )
