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
from burmester.errors import Advice
from burmester.fourbar.dyad import Dyad
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.tasks.motion_class import MotionClass, classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, poses_in_words, span
from burmester.tasks.repeated_poses import COORDINATE_ROUNDING, exact_repeats
from burmester.values import require_instance
from burmester.wording import figure, listed, shortened

MAX_DISTANCE = 1e8  # spans of the poses, from the origin; beyond it half of the digits are lost
DOUBLE_DIGITS = 16  # decimal ones of a double
MAX_LISTED = 5  # repeats in a message; of more three and their number


MIN_POSES_IN_ORDER = 6  # of fewer the order says too little
MAX_POSES_IN_ORDER = 1000  # of more all distances between them take too much memory
MAX_PATH_SHARE = 0.8  # of the path as given, left by the best exchange; else nothing is said
MIN_NEXT_PATH = 1.1  # times the shortest path, left by the next best exchange; else it is a tie
MAX_FURTHER_SAVING = 0.1  # of the shortest path, by a second exchange; else more than two are mixed


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


@final
@dataclass(frozen=True, slots=True, eq=False)
class Swap:
    """Two poses that seem to be exchanged.

    first, second: their indices.
    path, path_exchanged: the lengths of the path through all poses in order, as given and with the
        two exchanged, in the task's unit; a radian counts as much as the poses' spread.
    """

    task: Task
    first: int
    second: int
    path: float
    path_exchanged: float

    @property
    def order(self) -> tuple[int, ...]:
        """All indices, in the order that is better."""
        order = list(range(self.task.poses.shape[0]))
        order[self.first], order[self.second] = self.second, self.first
        return tuple(order)

    @property
    def message(self) -> str:
        """What is wrong."""
        which = poses_in_words(self.task, (self.first, self.second), form="number and name")
        return f"{which} seem to be exchanged"

    @property
    def why(self) -> str:
        """By which numbers."""
        less = 100 * (1 - self.path_exchanged / self.path)
        return (
            f"the path through all poses in their order is {less:.0f} % shorter with the two "
            "exchanged"
        )

    @property
    def help(self) -> str:
        """What to do."""
        return (
            f"exchange rows {self.first + 1} and {self.second + 1}, or keep them if the body is to "
            "go to and fro"
        )


def swapped_poses(task: Task) -> Swap | None:
    """The two poses of a task that seem to be exchanged, if that is clear.

    None for fewer than 6 or more than 1000 poses, where a pose comes twice (the body comes back),
    where any order will do, and where no exchange, or more than one, shortens the path.
    """
    count = task.poses.shape[0]
    if task.requirements.any_order or not MIN_POSES_IN_ORDER <= count <= MAX_POSES_IN_ORDER:
        return None
    if len(exact_repeats(task.poses)[0]) < count:
        return None
    distances, unit = distances_between(task.poses)
    if not unit > 0:
        return None
    order = np.arange(count)
    path, (pair, next_saving) = path_length(distances, order), best_exchange(distances, order)
    (first, second), saving = pair
    shortest = path - saving
    if shortest > MAX_PATH_SHARE * path or path - next_saving < MIN_NEXT_PATH * shortest:
        return None
    order[[first, second]] = second, first
    (_, further), _ = best_exchange(distances, order)
    if further > MAX_FURTHER_SAVING * shortest:
        return None
    return Swap(task, first, second, path * unit, shortest * unit)


def distances_between(poses: Displacement) -> tuple[FloatArray, float]:
    """Distances (N, N) between poses, in their spread, and the spread.

    A radian counts as one spread; (0, 0) and zero where all poses are in one place.
    """
    middle = poses.translation.mean(axis=0)
    spread = float(np.sqrt(((poses.translation - middle) ** 2).sum(axis=-1).mean()))
    if not spread > 0:
        return np.zeros((0, 0)), 0.0
    d = (poses.translation - middle) @ np.array([1, 1j]) / spread
    turn = wrapped_angle(poses.angle[:, None] - poses.angle)
    return np.hypot(np.abs(d[:, None] - d), turn), spread


def path_length(distances: FloatArray, order: NDArray[np.int_]) -> float:
    """The length of the path through all poses in an order (N,)."""
    return float(distances[order[:-1], order[1:]].sum())


def best_exchange(
    distances: FloatArray, order: NDArray[np.int_]
) -> tuple[tuple[tuple[int, int], float], float]:
    """The two places in an order whose exchange saves most of the path, with its saving.

    And the saving of the next best exchange.
    """
    count = len(order)
    apart = np.zeros((count, count + 2))  # from those at a place to none before and after
    apart[:, 1:-1] = distances[np.ix_(order, order)]
    before, after = apart[:, :-2], apart[:, 2:]  # [i, k]: from i to what is before, after place k
    at = np.arange(count)
    own = before[at, at] + after[at, at]
    saved = own[:, None] + own - (before + after) - (before + after).T
    near = at[:-1]  # neighbours keep the piece between them
    saved[near, near + 1] -= 2 * distances[order[:-1], order[1:]]
    saved = np.where(at[:, None] < at, saved, -np.inf)
    best = int(saved.argmax())
    first, second = divmod(best, count)
    top = float(saved[first, second])
    saved[first, second] = -np.inf
    return ((first, second), top), float(saved.max())
