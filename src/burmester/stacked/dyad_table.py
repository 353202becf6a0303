"""The columns of dyads, from the dyads of tasks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad, line_direction_deg
from burmester.fourbar.linkage_batch import DYAD_KINDS
from burmester.geometry.displacement import Displacement
from burmester.stacked.answers import DyadRows
from burmester.stacked.found_dyads import Found
from burmester.stacked.one_task import TaskDyads

__all__ = ["rows_of_found", "rows_of_tasks"]


def rows_of_found(found: Found, poses: Displacement, status: NDArray[np.int8]) -> DyadRows:
    """The dyads (D,) that were found in a stack, as rows; poses: (T, N), status: (D,)."""
    rows = DyadRows.blank(len(found.task))
    rows.task[:], rows.kind[:] = found.task, found.kind
    rows.rms[:], rows.worst[:] = found.rms, found.worst
    rows.status[:] = status
    z = found.dimensions
    circle, fixed, moving = (found.kind == DYAD_KINDS.index(kind) for kind in (RR, PR, RP))
    rows.fixed[circle | moving] = z[circle | moving, :2]
    rows.moving[circle | fixed] = z[circle | fixed, 2:4]
    rows.length[circle] = z[circle, 4]
    for of, normal, pivot, seen in ((fixed, 0, 2, False), (moving, 2, 0, True)):
        if index := np.flatnonzero(of).tolist():
            line = PR(z[index, normal], z[index, normal + 1], z[index, pivot : pivot + 2])
            places = poses[found.task[index]]
            _tell_lines(rows, index, line, places.inverse() if seen else places)
    return rows


def rows_of_tasks(
    found: Sequence[TaskDyads], tasks: Sequence[int], poses: Displacement
) -> DyadRows:
    """The dyads that were found for single tasks, as rows; poses: (T, N), of the whole stack."""
    every = [
        (task, each, status)
        for task, answer in zip(tasks, found, strict=True)
        for each, status in zip(answer.dyads, answer.statuses, strict=True)
    ]
    rows = DyadRows.blank(len(every))
    for k, (task, each, status) in enumerate(every):
        rows.task[k], rows.kind[k] = task, DyadRows.KINDS.index(type(each.dyad).__name__)
        rows.rms[k], rows.worst[k] = each.rms_error, each.max_error
        rows.status[k] = DyadRows.STATUSES.index(status)
        _tell(rows, k, each.dyad, poses[task])
    return rows


def _tell(rows: DyadRows, k: int, dyad: Dyad, poses: Displacement) -> None:
    """Write the dimensions of one dyad to a row."""
    if isinstance(dyad, PP):
        rows.angle_deg[k] = np.degrees(dyad.angle)
    if isinstance(dyad, RR | RP):
        rows.fixed[k] = dyad.fixed_pivot
    if isinstance(dyad, RR | PR):
        rows.moving[k] = dyad.moving_pivot
    if isinstance(dyad, RR):
        rows.length[k] = dyad.radius
    if isinstance(dyad, PR):
        _tell_lines(rows, [k], dyad[None], poses[None])
    if isinstance(dyad, RP):
        line = PR(dyad.normal_angle, dyad.offset, dyad.fixed_pivot)
        _tell_lines(rows, [k], line[None], poses.inverse()[None])


def _tell_lines(rows: DyadRows, index: list[int], line: PR, places: Displacement) -> None:
    """Write lines (k,) to rows; places: (k, N), of the frame whose point is on the line."""
    rows.direction_deg[index] = line_direction_deg(line.normal_angle)
    rows.normal_deg[index], rows.offset[index] = np.degrees(line.normal_angle), line.offset
    rows.point[index] = line.middle_of_travel(places)
