"""The columns of dyads, from the dyads of tasks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from burmester.fourbar.dyad import PP, PR, RP, RR, line_direction_deg
from burmester.geometry.displacement import Displacement
from burmester.stacked.answers import DyadRows
from burmester.stacked.one_task import TaskDyads

__all__ = ["rows_of_tasks"]


def rows_of_tasks(
    found: Sequence[TaskDyads], tasks: Sequence[int], poses: Displacement
) -> DyadRows:
    """The dyads that were found for tasks, as rows; poses: (T, N), of the whole stack."""
    every = [
        (task, each, status)
        for task, answer in zip(tasks, found, strict=True)
        for each, status in zip(answer.dyads, answer.statuses, strict=True)
    ]
    rows = DyadRows.blank(len(every))
    for k, (task, each, status) in enumerate(every):
        dyad = each.dyad
        rows.task[k], rows.kind[k] = task, DyadRows.KINDS.index(type(dyad).__name__)
        rows.rms[k], rows.worst[k] = each.rms_error, each.max_error
        rows.status[k] = DyadRows.STATUSES.index(status)
        if isinstance(dyad, RR | RP):
            rows.fixed[k] = dyad.fixed_pivot
        if isinstance(dyad, RR | PR):
            rows.moving[k] = dyad.moving_pivot
        if isinstance(dyad, RR):
            rows.length[k] = dyad.radius
        if isinstance(dyad, PR | RP):
            rows.point[k] = dyad.middle_of_travel(poses[task])
            rows.direction_deg[k] = line_direction_deg(dyad.normal_angle)
            rows.normal_deg[k], rows.offset[k] = np.degrees(dyad.normal_angle), dyad.offset
        if isinstance(dyad, PP):
            rows.angle_deg[k] = np.degrees(dyad.angle)
    return rows
