"""The answers of a stack of tasks at a depth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import CIRCLE, FIXED_LINE, KINDS, MOVING_LINE, Found
from burmester.fourbar.dyad import PP, PR, line_direction_deg
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import concatenate, take
from burmester.stacked.answers import Depth, DyadRows, LinkageRows, StackedAnswers, joined
from burmester.stacked.dyads_of_stack import SOLVED, groups_of
from burmester.stacked.pair_linkages import USABLE, Scales, pair_linkages
from burmester.stacked.task_stack import TaskStack
from burmester.tasks.motion_task import CONDITIONS

# Poses of the tasks that are computed together: bounds the memory, and fits a cache.  The ways down
# to best dyads need more room.
POSES_AT_ONCE, POSES_DOWN_AT_ONCE = 20_000, 4_000


def stacked_answers(stack: TaskStack, depth: Depth) -> StackedAnswers:
    """The dyads of many tasks, and with the depth "linkages" the pairs of them.

    A bad task changes no bit of its neighbours' answers.
    """
    count = stack.poses.shape[1]
    most = POSES_DOWN_AT_ONCE if depth != "pencil" and count > CONDITIONS else POSES_AT_ONCE
    size = max(1, most // max(1, count))
    starts = range(0, max(1, len(stack)), size)
    return joined([_answers(stack[start : start + size], depth) for start in starts])


def _answers(stack: TaskStack, depth: Depth) -> StackedAnswers:
    """The answers of tasks that are computed together."""
    outcome, code = np.zeros(len(stack), dtype=np.int8), np.full(len(stack), "", dtype="<U4")
    rows, linkages = [DyadRows.blank(0)], [LinkageRows.blank(0)]
    warnings: list[tuple[int, str]] = []
    poses, weights = stack.displacements, stack.weights
    scales = Scales.of(poses, weights) if depth == "linkages" else None
    for each in groups_of(stack, depth):
        index = each.tasks
        outcome[index], code[index] = each.outcome, each.code
        warnings += each.warnings
        table = rows_of_found(each.found, poses[index], each.status)
        rows.append(replace(table, task=index[table.task]))
        if scales is not None and each.given is not None:
            own = each.given.poses, each.given.weights, take(scales, index)
            pairs = pair_linkages(each.found, *own)
            linkages.append(replace(pairs, task=index[pairs.task]))
    dyads, made = concatenate(rows), concatenate(linkages)
    dyads = take(dyads, np.argsort(dyads.task, kind="stable"))
    made = take(made, np.argsort(made.task, kind="stable"))
    if depth == "linkages":
        count = np.bincount(made.task, minlength=len(stack))
        usable = np.bincount(made.task[made.verdict == USABLE], minlength=len(stack)) > 0
        solved = outcome == SOLVED
        code[solved] = np.where(count > 0, np.where(usable, "R300", "R301"), "R302")[solved]
        outcome[solved & ~usable] = StackedAnswers.OUTCOMES.index("none usable")
        outcome[solved & (count == 0)] = StackedAnswers.OUTCOMES.index("too few dyads")
    return StackedAnswers(
        dyads,
        made if depth == "linkages" else None,
        outcome,
        code,
        tuple(sorted(warnings, key=lambda each: each[0])),
    )


def rows_of_found(found: Found, poses: Displacement, status: NDArray[np.int8]) -> DyadRows:
    """The dyads (D,) of tasks with poses (T, N) as rows; status: (D,)."""
    rows, z, kind = DyadRows.blank(len(found.task)), found.dimensions, found.kind
    rows.task[:], rows.kind[:], rows.status[:] = found.task, kind, status
    rows.rms[:], rows.worst[:] = found.rms, found.worst
    circle, fixed, moving = (kind == each for each in (CIRCLE, FIXED_LINE, MOVING_LINE))
    rows.fixed[circle | moving] = z[circle | moving, :2]
    rows.moving[circle | fixed] = z[circle | fixed, 2:4]
    rows.length[circle] = z[circle, 4]
    angles = kind == KINDS.index(PP)
    rows.angle_deg[angles] = np.degrees(z[angles, 0])
    for of, normal, pivot in ((fixed, 0, 2), (moving, 2, 0)):
        if not len(index := np.flatnonzero(of)):
            continue
        line = PR(z[index, normal], z[index, normal + 1], z[index, pivot : pivot + 2])
        places = poses[found.task[index]]
        rows.direction_deg[index] = line_direction_deg(line.normal_angle)
        rows.normal_deg[index], rows.offset[index] = np.degrees(line.normal_angle), line.offset
        rows.point[index] = line.middle_of_travel(places.inverse() if normal else places)
    return rows
