"""Two poses in each other's place: with the two exchanged the path through all is much shorter.

A guess from the poses alone, before any linkage is known: a body guided through its poses in their
order does not run to and fro.  Where a linkage meets the poses in another order,
`fourbar.defects.judge` says so with certainty.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import poses_in_words
from burmester.tasks.repeated_poses import exact_repeats

MIN_POSES_IN_ORDER = 6  # of fewer the order says too little
MAX_POSES_IN_ORDER = 1000  # of more all distances between them take too much memory
MAX_PATH_SHARE = 0.8  # of the path as given, left by the best exchange; else nothing is said
MIN_NEXT_PATH = 1.1  # times the shortest path, left by the next best exchange; else it is a tie
MAX_FURTHER_SAVING = 0.1  # of the shortest path, by a second exchange; else more than two are mixed


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
