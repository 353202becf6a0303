"""How uncertain the pivots of a dyad are, because the poses are known to a few digits only.

A small error of a linkage does not mean certain pivots: where the body hardly turns, or nearly
as a parallelogram's coupler does, the circle residual hardly changes as the pivots move together.
"""

from __future__ import annotations

import numpy as np

from burmester.displacement import Displacement
from burmester.dyad import RR
from burmester.task import Task

__all__ = ["pivot_uncertainty"]


def pivot_uncertainty(dyad: RR, task: Task) -> tuple[float, float] | None:
    """About how far the errors of the poses leave the fixed and the moving pivot free.

    Twice the standard deviation in the worst direction, in the task's unit, to first order, for
    independent errors spread evenly within `Task.resolution`; None where that is zero.
    """
    position, angle = task.resolution
    if not (position > 0 or angle > 0):
        return None
    slope = dyad.gradient(task.poses)
    error = np.sqrt(((slope * [position, position, angle]) ** 2).sum(axis=-1) / 3)
    force = slope[:, :2]
    on_body = Displacement(np.zeros(2), -task.poses.angle).rotate(force)
    jacobian = np.column_stack([-force, on_body, -np.ones(len(force))])
    moved = 2 * np.linalg.pinv(jacobian, rcond=1e-15) * error
    return float(np.linalg.norm(moved[:2], 2)), float(np.linalg.norm(moved[2:4], 2))
