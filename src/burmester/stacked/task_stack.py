"""Many tasks of one number of poses, as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, Indexed
from burmester.tasks.motion_task import MOST, MOST_RATIO, MOST_TURN, Task
from burmester.values import real_numbers

SAFE = 1.001  # by which a task has to keep off the border of what can be computed with


@final
@dataclass(frozen=True, slots=True, eq=False)
class TaskStack(Indexed):
    """Tasks (T,) of N poses each, without limits, requirements and tolerances.

    Attributes
    ----------
    poses : (T, N, 3) array of float
        x, y and angle in radians of each pose.
    weights : (T, N) array of float, optional
        As in `Task`.
    exact : (T, N) array of bool, optional
        The poses that must be met exactly.
    resolution : (float, float)
        How exactly the poses of all tasks are known, as in `Task`.

    Whether a task can be computed with is not asked here: one that cannot is refused alone, as
    its outcome.

    Raises
    ------
    InputError
        E103 (a number that is not finite), E125 (values of a wrong type or shape).

    Examples
    --------
    >>> TaskStack(np.zeros((3, 5, 3)))[1:].poses.shape
    (2, 5, 3)
    """

    poses: FloatArray
    weights: FloatArray | None = None
    exact: NDArray[np.bool_] | None = None
    resolution: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        poses = real_numbers(self.poses, (None, None, 3), "the poses of the tasks")
        own: dict[str, object] = {"poses": poses}
        if self.weights is not None:
            own["weights"] = real_numbers(self.weights, poses.shape[:2], "the weights of the poses")
        if self.exact is not None:
            exact = np.array(self.exact)
            if exact.dtype != np.bool_ or exact.shape != poses.shape[:2]:
                raise InputError(
                    "E125",
                    "the marks for exact poses do not fit the poses",
                    why=f"their shape is {exact.shape}, their type {exact.dtype}",
                    help=f"give an array of bool of shape {poses.shape[:2]}",
                )
            exact.setflags(write=False)
            own["exact"] = exact
        position, angle = real_numbers(self.resolution, (2,), "the resolution").tolist()
        own["resolution"] = (position, angle)
        for name, value in own.items():
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.poses)

    @property
    def displacements(self) -> Displacement:
        """The poses as displacements (T, N)."""
        return Displacement.from_poses(self.poses)

    @property
    def computable(self) -> NDArray[np.bool_]:
        """Which tasks (T,) `Task` accepts, no number near the border of that, and no pose exact."""
        reach = np.abs(self.poses[..., :2]).max(axis=(1, 2))
        turn = np.abs(self.poses[..., 2]).max(axis=1)
        sound = (reach <= MOST / SAFE) & (reach >= SAFE / MOST) & (turn <= MOST_TURN / SAFE)
        if self.weights is not None:
            least, most = self.weights.min(axis=1), self.weights.max(axis=1)
            sound &= (least > 0) & (most * SAFE <= MOST_RATIO * least)
        if self.exact is not None:
            sound &= ~self.exact.any(axis=1)
        return np.asarray(sound)

    def task(self, index: int) -> Task:
        """The task at an index; raises what `Task` raises."""
        return Task(
            Displacement.from_poses(self.poses[index]),
            weights=None if self.weights is None else self.weights[index],
            exact=None if self.exact is None else self.exact[index],
            resolution=self.resolution,
        )
