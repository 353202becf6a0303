"""How far the driver of a linkage is from the angles at which the crank times the poses."""

from __future__ import annotations

import math

import numpy as np

from burmester.numerics.arrays import FloatArray
from burmester.requirements.table import Violation
from burmester.tasks.motion_task import Task
from burmester.wording import figure

__all__ = ["mistimed", "timing_error"]


def timing_error(inputs: FloatArray, task: Task) -> FloatArray | None:
    """How far driver angles (N,) are from those of a task, signed, in radians; nan where untimed.

    None for a task that is not timed.
    """
    return None if task.timing is None else task.timing.missed(inputs)


def mistimed(inputs: FloatArray, task: Task, numbers: list[int]) -> tuple[Violation, ...]:
    """The violation of a driver's angles at the poses, if it is one; numbers: of the poses."""
    if (timing := task.timing) is None or (missed := timing_error(inputs, task)) is None:
        return ()
    known = np.abs(missed[timing.timed])
    if (known <= timing.bound).all():
        return ()
    at = int(timing.timed[np.nan_to_num(known, nan=np.inf).argmax()])
    away = math.degrees(float(np.abs(missed[at])))
    given = "" if task.names is None else f" ({task.names[at]})"
    told = f"is {figure(away)}° off" if math.isfinite(away) else "is not at"
    text = f"its crank {told} its angle at pose {numbers[at] + 1}{given}"
    return (Violation("timing", f"{text}; {figure(math.degrees(timing.bound))}° is allowed"),)
