"""The dyads of one task at a depth, by the road of one task.

It is what the stacked road must equal; where that one cannot vouch for a task, this one is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from burmester.dyads.five_poses import FivePoseDyads
from burmester.dyads.selection import FoundDyad
from burmester.errors import InputError
from burmester.fourbar.dyad import Dyad
from burmester.stacked.answers import Depth, Outcome, Status
from burmester.synthesis.dyad_search import search_dyads
from burmester.synthesis.method import with_method
from burmester.synthesis.outcome import dyad_advice
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_kinds import Undetermined
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem

__all__ = ["TaskDyads", "dyads_of_task"]


class TaskDyads(NamedTuple):
    """What came of one task, up to its dyads.

    statuses: of each dyad; code: of the outcome, "" where dyads were found; warnings: codes.
    """

    outcome: Outcome
    code: str = ""
    dyads: Sequence[FoundDyad] = ()
    statuses: Sequence[Status] = ()
    warnings: Sequence[str] = ()


def dyads_of_task(task: Task, depth: Depth) -> TaskDyads:
    """The dyads of one task, by the pencil or by the method that the number of poses decides."""
    options = SynthesisOptions(method="pencil" if depth == "pencil" else "auto")
    problem = SynthesisProblem.of(task, classify_motion(task), options)
    motion = problem.motion
    assert motion is not None
    if problem.is_special:
        if isinstance(motion.kind, Undetermined):
            return TaskDyads("not determined", motion.kind.code)
        dyads = [
            FoundDyad(f"D{number}", dyad, *_miss(dyad, task))
            for number, dyad in enumerate(motion.kind.dyads, start=1)
        ]
        every: list[Status] = ["of the motion"] * len(dyads)
        return TaskDyads("special motion", motion.kind.code, dyads, every)
    repeats = ["W208"] if motion.distinct < len(motion.group) else []
    if depth != "pencil" and max(problem.missing_conditions) > 0:
        return TaskDyads("infinitely many", "R303", warnings=repeats)
    try:
        problem = with_method(problem)
    except InputError as error:
        return TaskDyads("not at this depth", error.code, warnings=repeats)
    found = search_dyads(problem)
    pairs, twice = found.pairs(problem.length)
    exact = isinstance(found.fits[0], FivePoseDyads)
    status: Status = "exact" if exact else "pencil" if depth == "pencil" else "locally best"
    statuses: list[Status] = [status] * len(found.dyads)
    for late in range(found.meeting, len(found.dyads)):
        statuses[late] = "nearest"
    advice = [each.code for each in dyad_advice(problem, found)] + ["W205"] * len(twice)
    warnings = repeats + list(dict.fromkeys(advice))
    if not pairs:
        return TaskDyads("too few dyads", "R302", found.dyads, statuses, warnings)
    return TaskDyads("solved", "", found.dyads, statuses, warnings)


def _miss(dyad: Dyad, task: Task) -> tuple[float, float]:
    """The root mean square and the greatest distance of a dyad from the poses of a task."""
    distance = np.abs(dyad.residual(task.poses))
    return float(np.sqrt((distance**2).mean())), float(distance.max())
