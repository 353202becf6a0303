"""Whether two poses stand in each other's place: exchanged, the way through all is much shorter.

A guess from the poses alone, before any linkage is known: a body that is led through its poses in
their order does not run to and fro.  Where a linkage meets the poses in another order,
`defects.judge` says so with certainty.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.tasks.motion_task import Task
from burmester.tasks.repeated_poses import different

__all__ = ["Swapped", "out_of_order"]

LEAST, MOST = 6, 1000  # poses
SHORTER = 0.8  # times the way: exchanging two poses must save so much,
CLEAR = 1.1  # times that way: any other exchange must leave so much more,
DONE = 0.9  # and no second one may save as much again


@final
@dataclass(frozen=True, slots=True, eq=False)
class Swapped:
    """Two poses that seem to be exchanged.

    first, second: their indices.
    way, way_exchanged: through all poses in order, as given and with the two exchanged, in the
        task's unit; a radian counts as much as the poses' spread.
    """

    task: Task
    first: int
    second: int
    way: float
    way_exchanged: float

    @property
    def order(self) -> tuple[int, ...]:
        """All indices, in the order that is better."""
        order = list(range(self.task.poses.shape[0]))
        order[self.first], order[self.second] = self.second, self.first
        return tuple(order)

    @property
    def message(self) -> str:
        """What is wrong."""
        names = [str(k + 1) for k in (self.first, self.second)]
        if self.task.names is not None:
            own = (self.task.names[self.first], self.task.names[self.second])
            names = [f"{number} ({name})" for number, name in zip(names, own, strict=True)]
        return f"poses {names[0]} and {names[1]} seem to be exchanged"

    @property
    def why(self) -> str:
        """By which numbers."""
        less = 100 * (1 - self.way_exchanged / self.way)
        return (
            f"the way through all poses in their order is {less:.0f} % shorter the other way round"
        )

    @property
    def help(self) -> str:
        """What to do."""
        return (
            f"exchange rows {self.first + 1} and {self.second + 1}, or keep them if the body is to "
            "go to and fro"
        )


def out_of_order(task: Task) -> Swapped | None:
    """The two poses of a task that seem to be exchanged, if that is clear.

    None for fewer than 6 or more than 1000 different poses, where a pose comes twice (the body
    comes back), where any order will do, and where no exchange, or more than one, is called for.
    """
    count = task.poses.shape[0]
    if task.requirements.any_order or not LEAST <= count <= MOST:
        return None
    if len(different(task.poses)[0]) < count:
        return None
    away, unit = _distances(task.poses)
    if not unit > 0:
        return None
    order = np.arange(count)
    way, (pair, other) = _way(away, order), _best(away, order)
    (first, second), saved = pair
    if way - saved > SHORTER * way or way - other < CLEAR * (way - saved):
        return None
    order[[first, second]] = second, first
    (_, again), _ = _best(away, order)
    if again > (1 - DONE) * (way - saved):
        return None
    return Swapped(task, first, second, way * unit, (way - saved) * unit)


def _distances(poses: Displacement) -> tuple[FloatArray, float]:
    """How far (N, N) poses are apart, in their spread, and the spread (zero: all in one place)."""
    middle = poses.translation.mean(axis=0)
    spread = float(np.sqrt(((poses.translation - middle) ** 2).sum(axis=-1).mean()))
    if not spread > 0:
        return np.zeros((0, 0)), 0.0
    d = (poses.translation - middle) @ np.array([1, 1j]) / spread
    turn = wrapped_angle(poses.angle[:, None] - poses.angle)
    return np.hypot(np.abs(d[:, None] - d), turn), spread


def _way(away: FloatArray, order: np.ndarray) -> float:
    return float(away[order[:-1], order[1:]].sum())


def _best(away: FloatArray, order: np.ndarray) -> tuple[tuple[tuple[int, int], float], float]:
    """The two places whose exchange saves most of the way, what it saves, and what the next."""
    count = len(order)
    apart = np.zeros((count, count + 2))  # from those at a place to none before and after
    apart[:, 1:-1] = away[np.ix_(order, order)]
    before, after = apart[:, :-2], apart[:, 2:]  # [i, k]: from i to what is before, after place k
    at = np.arange(count)
    own = before[at, at] + after[at, at]
    saved = own[:, None] + own - (before + after) - (before + after).T
    near = at[:-1]  # neighbours keep the way between them
    saved[near, near + 1] -= 2 * away[order[:-1], order[1:]]
    saved = np.where(at[:, None] < at, saved, -np.inf)
    best = int(saved.argmax())
    first, second = divmod(best, count)
    top = float(saved[first, second])
    saved[first, second] = -np.inf
    return ((first, second), top), float(saved.max())
