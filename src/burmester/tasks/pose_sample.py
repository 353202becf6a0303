"""A few of many poses, that stand for all of them: even in number and even along the motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, weights_or_ones
from burmester.tasks.motion_task import Task

# Of the way of a motion, measured between the means of so many runs of poses: errors of single
# poses make a way of their own, which grows with their number.
RUNS = 500
# Share of the sample that is even along the way; the rest is even in the number of poses.
ALONG_THE_WAY = 0.5


@final
@dataclass(frozen=True, slots=True, eq=False)
class PoseSample:
    """Some poses of N, and what they count.

    index: (n,), which poses, in their order.
    cells: (n,), how much all poses weigh that each of them stands for: those nearest to it in the
        order of the poses.
    of_all: N.
    """

    index: NDArray[np.intp]
    cells: FloatArray
    of_all: int

    @classmethod
    def of(
        cls,
        poses: Displacement,
        weights: FloatArray | None,
        most: int,
        required: NDArray[np.bool_] | None = None,
    ) -> Self:
        """About `most` of poses (N,); the first, the last and all that are required (N,) stay."""
        count = poses.shape[0]
        share = _shares_of_the_way(poses)
        index = np.searchsorted(share, np.linspace(0.0, 1.0, most)).clip(0, count - 1)
        if required is not None:
            index = np.union1d(index, np.flatnonzero(required))
        return cls._at(np.unique(index).astype(np.intp), weights, count)

    @classmethod
    def _at(cls, index: NDArray[np.intp], weights: FloatArray | None, count: int) -> Self:
        starts = np.concatenate([[0], (index[:-1] + index[1:] + 1) // 2])
        return cls(index, np.add.reduceat(weights_or_ones(weights, (count,)), starts), count)

    def joined(self, more: NDArray[np.intp], weights: FloatArray | None) -> Self:
        """The sample with more of all poses, whose weights are (N,)."""
        return self._at(np.union1d(self.index, more), weights, self.of_all)

    @classmethod
    def of_task(cls, task: Task, most: int) -> Self:
        """That of a task: exact poses stay, and poses with a tolerance that is tighter than most.

        The latter where they are no more than `most`.
        """
        stay = np.zeros(task.poses.shape, dtype=bool)
        if task.tolerances is not None:
            bounds = task.tolerances.bounds
            tight = (bounds < np.median(bounds, axis=0)).any(axis=1)
            stay |= task.tolerances.exact_poses | (tight & (tight.sum() <= most))
        if task.exact is not None:
            stay |= task.exact
        return cls.of(task.poses, task.weights, most, stay)


def _shares_of_the_way(poses: Displacement) -> FloatArray:
    """Rising numbers (N,) from 0 to 1, half by the number of each pose, half by the way so far."""
    count = poses.shape[0]
    number = np.linspace(0.0, 1.0, count)
    run = np.arange(count) * min(RUNS, count) // count
    rows = np.column_stack([poses.translation, poses.angle])
    sums = np.stack([np.bincount(run, each) for each in rows.T], axis=-1)
    means = sums / np.bincount(run)[:, None]
    spread = np.hypot(*np.ptp(means[:, :2], axis=0)), np.ptp(means[:, 2])
    size = np.array([spread[0], spread[0], spread[1]])
    steps = np.diff(means, axis=0) / np.where(size > 0, size, 1.0)
    way = np.concatenate([[0.0], np.cumsum(np.sqrt((steps * steps).sum(axis=-1)))])
    if not way[-1] > 0:
        return number
    along = np.interp(number, np.linspace(0.0, 1.0, len(way)), way / way[-1])
    return np.asarray(ALONG_THE_WAY * along + (1 - ALONG_THE_WAY) * number)
