"""Numbers and poses in words."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from burmester.tasks.motion_task import Task
from burmester.wording import listed

__all__ = ["called", "figure", "least_angle", "length_of", "span"]


def figure(value: float) -> str:
    """A figure with two digits, or its whole part if that has more: "0.00011", "4.5", "153"."""
    if not math.isfinite(value):
        return "-"
    return f"{value:.0f}" if 99.5 <= abs(value) < 1e6 else f"{value:.2g}"


def length_of(value: float, task: Task) -> str:
    """A length with its unit, if the task has one."""
    return figure(value) + (f" {task.length_unit}" if task.length_unit else "")


def least_angle(angle: float) -> str:
    """An angle that is not fallen short of: degrees, rounded down."""
    if not math.isfinite(angle):
        return "-"
    return f"{math.floor(10 * math.degrees(angle) + 1e-6) / 10:g}°"


def called(task: Task, poses: Sequence[int], last: str = "and") -> str:
    """Poses (numbers from 0) by their names or numbers: "pose 3", "poses 2, 3 and 7"."""
    given = task.names or ("",) * task.poses.shape[0]
    names = [given[pose] or str(pose + 1) for pose in poses]
    return f"pose{'' if len(names) == 1 else 's'} {listed(names, last)}"


def span(task: Task) -> float:
    """The diagonal of the box that holds the poses' origins."""
    return float(np.linalg.norm(np.ptp(task.poses.translation, axis=0)))
