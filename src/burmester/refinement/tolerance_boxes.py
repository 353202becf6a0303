"""Tolerances of poses while linkages are refined and judged: boxes, a metric, a constraint.

The distance of a place from its pose counts in a metric of that pose: each component by its
tolerance, a free one not at all.  That the place is inside is a constraint beside it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.box_places import Boxes
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.refinement.constraints import ConstraintSlopes, FromSlopes
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances

EXACT_ROUNDING = 1e-7  # motion sizes and radians; an exact component missed by less is met
INSIDE_MARGIN = 1e-6  # relative; kept from the border of a tolerance
WEIGHT_RANGE = 1e3  # of the metric: least and greatest weight over the median one


@final
@dataclass(frozen=True, slots=True, eq=False)
class ToleranceBoxes(FromSlopes):
    """The tolerances of N poses in the frames of a target, as rows are measured.

    boxes: with the rounding of exact components as their bounds.
    exact, free: (N, 3), which components are.
    binding: whether places have to be inside; else only the metric counts.
    """

    boxes: Boxes
    exact: NDArray[np.bool_]
    free: NDArray[np.bool_]
    binding: bool = True
    uses_places: ClassVar[bool] = True

    @classmethod
    def of(
        cls, tolerances: PoseTolerances, poses: Displacement, length: float, unit: float
    ) -> Self:
        """Those of poses in frames whose unit of length is `unit`; length: as rows are measured."""
        bounds = tolerances.bounds / np.array([unit, unit, 1.0 / length])
        least = EXACT_ROUNDING * np.array([1.0, 1.0, length])
        boxes = Boxes(
            rows_of(poses, length), tolerances.directions(poses), np.maximum(bounds, least), length
        )
        return cls(boxes, tolerances.exact, tolerances.free)

    @property
    def give_room(self) -> bool:
        """Whether some component may be missed by a tolerance, and is neither exact nor free."""
        return not bool((self.exact | self.free).all())

    @property
    def free_directions(self) -> FloatArray:
        """The unit vectors (N, 3, 3) of rows along which components are free; 0 for the others."""
        out = np.zeros((len(self.free), 3, 3))
        out[:, :2, :2] = self.boxes.directions
        out[:, 2, 2] = 1.0
        return out * self.free[..., None]

    @property
    def metric(self) -> FloatArray:
        """The matrices (N, 3, 3) whose product with a gap is what counts of it.

        By the tolerances, relative to their median, so that lengths stay about what they were.
        """
        number = len(self.free)
        wide = self.boxes.bounds[~self.free & ~self.exact]
        usual = float(np.median(wide)) if len(wide) else 1.0
        weight = np.where(self.exact, WEIGHT_RANGE, usual / self.boxes.bounds)
        weight = np.where(self.free, 0.0, np.clip(weight, 1 / WEIGHT_RANGE, WEIGHT_RANGE))
        if not len(wide):
            weight = np.where(self.free, 0.0, 1.0)
        out = np.zeros((number, 3, 3))
        out[:, :2, :2] = weight[:, :2, None] * self.boxes.directions
        out[:, 2, 2] = weight[:, 2]
        return out

    def counted(self, rows: FloatArray) -> FloatArray:
        """The deviations (*, N, 3) of rows (*, N, 3), 0 for free components."""
        return np.where(self.free, 0.0, self.boxes.deviations(rows))

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """The constraint that all places are inside: exact components are equations."""
        inside = ~self.exact & ~self.free & self.binding
        exact = self.exact & self.binding
        bounds = self.boxes.bounds[inside] * (1 - INSIDE_MARGIN)
        away, slope = self.boxes.deviations(rows), place_jacobian.copy()
        slope[..., :2, :] = self.boxes.directions @ place_jacobian[..., :2, :]
        on, off, none = away[:, exact], away[:, inside], np.full((len(rows), 1), -1.0)
        by_on, by_off = slope[:, exact], slope[:, inside]
        value = np.concatenate([on, off - bounds, -off - bounds, none], axis=1)
        still = np.zeros((len(rows), 1, slope.shape[-1]))
        by_all = np.concatenate([by_on, by_off, -by_off, still], axis=1)
        return value, by_all, np.arange(value.shape[1]) < on.shape[1]


def shares_used(places: Displacement, task: Task, size: float) -> FloatArray:
    """How much of its tolerance each component (*, N, 3) of places (*, N) uses; at most 1 inside.

    0 for free components.  size: of the motion, by which rounding is measured.  The task has
    tolerances.
    """
    assert task.tolerances is not None
    rounding = EXACT_ROUNDING * np.array([size, size, 1.0])
    return task.tolerances.share(places, task.poses, rounding)


def counted_error(places: Displacement, task: Task) -> PoseError:
    """The error at places (N,) for the poses of a task; its free components count as none."""
    error = PoseError.at(places, task.poses)
    if task.tolerances is None:
        return error
    away = task.tolerances.deviations(places, task.poses)
    away = np.where(task.tolerances.free & np.isfinite(away), 0.0, np.abs(away))
    return PoseError(error.places, np.hypot(away[:, 0], away[:, 1]), away[:, 2])


def poses_counted(places: Displacement, task: Task) -> Displacement:
    """The poses (N,) of a task, free angles being those of places (N,).

    A linkage moved to them turns as it does, not as the angle that the pose is drawn with.
    """
    if task.tolerances is None:
        return task.poses
    free = task.tolerances.free[:, 2] & np.isfinite(places.angle)
    return Displacement(task.poses.translation, np.where(free, places.angle, task.poses.angle))
