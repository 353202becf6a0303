"""Lengths, angles and poses of a task as messages write them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias

import numpy as np

from burmester.tasks.motion_task import Task
from burmester.wording import figure, in_runs

# "name": its name, or its number where it has none; "number and name": "3 (open)", or "3".
MOST_NAMES = 6  # poses, or ranges of poses, that one phrase lists
PoseFormat: TypeAlias = Literal["name", "number and name"]


def length_of(value: float, task: Task) -> str:
    """A length with its unit, if the task has one."""
    return figure(value) + (f" {task.length_unit}" if task.length_unit else "")


def pose_labels(task: Task, poses: Sequence[int], form: PoseFormat = "name") -> list[str]:
    """Poses (numbers from 0) in one of the two formats, with numbers from 1."""
    labels = []
    for pose in poses:
        name = task.names[pose] if task.names else ""
        number = str(pose + 1)
        labels.append(name or number if form == "name" else number + (f" ({name})" if name else ""))
    return labels


def poses_in_words(
    task: Task, poses: Sequence[int], last: str = "and", form: PoseFormat = "name"
) -> str:
    """Poses (numbers from 0) in one phrase: "pose 3", "poses 2, 3 and 7", "poses 4-7"."""
    labels = pose_labels(task, poses, form)
    return f"pose{'' if len(labels) == 1 else 's'} {in_runs(labels, MOST_NAMES, last)}"


def span(task: Task) -> float:
    """The diagonal of the box around the poses' origins."""
    return float(np.linalg.norm(np.ptp(task.poses.translation, axis=0)))
