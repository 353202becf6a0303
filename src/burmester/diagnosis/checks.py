"""Checks of a task's poses before any linkage is looked for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.diagnosis.conventions import other_convention
from burmester.diagnosis.odd_pose import odd_pose
from burmester.diagnosis.swapped_poses import swapped_poses
from burmester.errors import Advice
from burmester.fourbar.dyad import Dyad
from burmester.tasks.motion_class import MotionClass, classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.repeated_poses import COORDINATE_ROUNDING
from burmester.values import require_instance
from burmester.wording import figure, listed, shortened

MAX_DISTANCE = 1e8  # spans of the poses, from the origin; beyond it half of the digits are lost
DOUBLE_DIGITS = 16  # decimal ones of a double
MAX_LISTED = 5  # repeats in a message; of more three and their number


@final
@dataclass(frozen=True, slots=True, eq=False)
class Diagnosis:
    """What a task's poses are, and what stands out among them.

    Attributes
    ----------
    task : Task
        The task as given.
    motion : MotionClass or None
        The class of its motion; None for one pose.
    findings : tuple of Advice
        What to look at, in the order of the checks; nothing is changed by them.

    Examples
    --------
    >>> import burmester
    >>> rows = [(0, 0, 0), (1, 1, 20), (3, 2, 40), (1, 1, 20)]
    >>> found = burmester.diagnose(burmester.Task.from_rows(rows, angle_unit="deg"))
    >>> found.sound, [finding.code for finding in found.findings]
    (False, ['W208'])
    """

    task: Task
    motion: MotionClass | None
    findings: tuple[Advice, ...]

    @property
    def sound(self) -> bool:
        """Whether nothing stands out, and a fit is of use."""
        doubtful = any(note.code == "W243" for note in self.task.notes)
        return not (self.findings or doubtful) and (self.motion is None or self.motion.determined)


def diagnose(task: Task) -> Diagnosis:
    """Look for repeated poses, lost digits and exchanged poses.

    Whether one pose disagrees with all the others takes longer: see `odd_pose`.

    Parameters
    ----------
    task : Task
        The poses.

    Returns
    -------
    Diagnosis

    Raises
    ------
    InputError
        E125 (no `Task`).

    Examples
    --------
    >>> rows = [(0, 0, 0), (3, 1, 40), (4, 3, 70), (3, 1, 40)]
    >>> found = diagnose(Task.from_rows(rows, angle_unit="deg"))
    >>> [advice.why for advice in found.findings]
    ['pose 4 repeats 2']
    >>> found.motion.kind.name
    'general'
    """
    require_instance(
        task, Task, "task", 'give a Task, such as Task.from_rows(rows, angle_unit="deg")'
    )
    motion = classify_motion(task) if task.poses.shape[0] > 1 else None
    swap = None if _has_free_parts(task) else swapped_poses(task)
    exchanged = None if swap is None else Advice("W202", swap.message, swap.help, swap.why)
    checks = [_far_away(task), exchanged]
    if motion is not None:
        checks.insert(0, repeats_advice(task, motion.first, motion.group))
    return Diagnosis(task, motion, tuple(each for each in checks if each is not None))


def disagreement(
    task: Task, motion: MotionClass | None, dyads: Sequence[Dyad] = ()
) -> Advice | None:
    """What keeps the poses from agreeing: another convention (W242), or one odd pose (W201).

    dyads: the best of all poses, where they are known; see `odd_pose`.
    """
    if _has_free_parts(task) or motion is None:
        return None
    if (other := other_convention(task, motion, dyads)) is not None:
        return Advice("W242", other.message, other.help, other.why)
    odd = odd_pose(task, motion, dyads)
    return None if odd is None else Advice("W201", odd.message, odd.help, odd.why)


def _has_free_parts(task: Task) -> bool:
    """Whether numbers of the poses are there for drawing only, and say nothing."""
    return task.tolerances is not None and bool(task.tolerances.free.any())


def repeats_advice(
    task: Task, first: NDArray[np.int_], group: NDArray[np.int_], row: str = "pose"
) -> Advice | None:
    """W208: rows of a task that repeat others; None where none does.

    first: (k,), the distinct rows; group: (N,), which of them each row is; row: what it is called.
    """
    if len(first) == len(group):
        return None
    again = sorted(set(range(len(group))) - set(first.tolist()))
    pairs = [f"{i + 1} repeats {int(first[group[i]]) + 1}" for i in again]
    return Advice(
        "W208",
        f"only {len(first)} of the {len(group)} {row}s are different; each counts once"
        + ("" if task.weights is None else ", with all its weight"),
        f"delete the repeats; to let a {row} count more give it a weight",
        f"{row} {listed(shortened(pairs, MAX_LISTED, 'more'))}",
    )


def _far_away(task: Task) -> Advice | None:
    """W211: poses so far from the origin that their numbers lose half of their digits."""
    size, reach = span(task), float(np.abs(task.poses.translation).max())
    if not 0 < size * MAX_DISTANCE < reach:
        return None
    lost = math.log10(reach / size)
    return Advice(
        "W211",
        f"the poses lie {figure(reach / size)} times their own size from the origin",
        "subtract the same point from all poses in their file",
        f"{lost:.0f} of a double's {DOUBLE_DIGITS} digits go into that distance; positions are "
        f"resolved only to {length_of(COORDINATE_ROUNDING * reach, task)}",
    )
