"""What is the matter with a task, told before any linkage is looked for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.diagnosis.odd_pose import odd_pose
from burmester.diagnosis.swapped_poses import out_of_order
from burmester.errors import Advice
from burmester.fourbar.dyad import Dyad
from burmester.tasks.motion_class import MotionClass, classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.repeated_poses import ULPS
from burmester.tasks.wording import length_of, span

__all__ = ["Diagnosis", "diagnose", "disagreement"]

FAR = 1e8  # times their own span; half of a double's digits are gone there
DIGITS = 16  # that a double holds


@final
@dataclass(frozen=True, slots=True, eq=False)
class Diagnosis:
    """What a task's poses are, and what stands out among them.

    motion: what the poses are; None for one or two of them.
    findings: what a user should look at, in the order of the checks; nothing is changed by them.
    """

    task: Task
    motion: MotionClass | None
    findings: tuple[Advice, ...]

    @property
    def sound(self) -> bool:
        """Whether nothing stands out, and a fit is of use."""
        return not self.findings and (self.motion is None or self.motion.determined)


def diagnose(task: Task) -> Diagnosis:
    """Look for repeated poses, lost digits and poses out of order; whether all agree costs more."""
    motion = classify_motion(task) if task.poses.shape[0] > 2 else None
    checks = [_far_away(task), _exchanged(task)]
    if motion is not None:
        checks.insert(0, _repeats(task, motion))
    return Diagnosis(task, motion, tuple(each for each in checks if each is not None))


def disagreement(
    task: Task, motion: MotionClass | None, dyads: Sequence[Dyad] = ()
) -> Advice | None:
    """W201: one pose that does not agree with all the others.

    dyads: the best of all poses, where they are known; see `agreement`.
    """
    found = None if motion is None else odd_pose(task, motion, dyads)
    return None if found is None else Advice("W201", found.message, found.help, found.why)


def _repeats(task: Task, motion: MotionClass) -> Advice | None:
    """W208: poses that are given more than once."""
    if motion.distinct == len(motion.group):
        return None
    again = sorted(set(range(len(motion.group))) - set(motion.first.tolist()))
    first = [int(motion.first[motion.group[i]]) for i in again]
    pairs = [f"{i + 1} repeats {j + 1}" for i, j in zip(again, first, strict=True)]
    shown = ", ".join(pairs[:3]) + (f" and {len(pairs) - 3} more" if len(pairs) > 3 else "")
    return Advice(
        "W208",
        f"only {motion.distinct} of the {len(motion.group)} poses are different; each counts once"
        + ("" if task.weights is None else ", with all its weight"),
        "delete the repeats; to let a pose count more give it a weight",
        f"pose {shown}",
    )


def _exchanged(task: Task) -> Advice | None:
    """W202: two poses that seem to stand in each other's place."""
    found = out_of_order(task)
    return None if found is None else Advice("W202", found.message, found.help, found.why)


def _far_away(task: Task) -> Advice | None:
    """W211: poses so far from the origin that their numbers have few digits left for them."""
    size, reach = span(task), float(np.abs(task.poses.translation).max())
    if not 0 < size * FAR < reach:
        return None
    lost = math.log10(reach / size)
    return Advice(
        "W211",
        f"the poses lie {reach / size:.0e} times their own size from the origin",
        "subtract the same point from all poses in the file that they come from",
        f"of the {DIGITS} digits that a number holds {lost:.0f} say only that; the rest tells "
        f"positions to {length_of(ULPS * reach, task)}",
    )
