"""The answers of a stack of tasks at a depth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.pencil import MIN_POSES
from burmester.errors import InputError
from burmester.numerics.bundles import concatenate, take
from burmester.stacked.answers import Depth, DyadRows, LinkageRows, StackedAnswers, joined
from burmester.stacked.best_dyads import best_dyads_in_stack
from burmester.stacked.dyad_table import rows_of_found, rows_of_tasks
from burmester.stacked.five_pose_dyads import five_pose_dyads
from burmester.stacked.one_task import TaskDyads, dyads_of_task
from burmester.stacked.pair_linkages import USABLE, Scales, pair_linkages
from burmester.stacked.pencils import pencil_dyads
from burmester.stacked.plain_tasks import computable
from burmester.stacked.task_stack import TaskStack
from burmester.stacked.vouched import Vouched
from burmester.tasks.motion_task import CONDITIONS
from burmester.tasks.repeated_poses import exact_repeats

__all__ = ["stacked_answers"]

# Poses of the tasks that are computed together: bounds the memory, and fits a cache.  The ways down
# to best dyads need more room.
POSES_AT_ONCE, POSES_DOWN_AT_ONCE = 20_000, 4_000


def stacked_answers(stack: TaskStack, depth: Depth) -> StackedAnswers:
    """The dyads of many tasks, and with the depth "linkages" the pairs of them.

    A task that the stacked road cannot vouch for takes the road of one task; its neighbours'
    answers do not change for it.
    """
    count = stack.poses.shape[1]
    most = POSES_DOWN_AT_ONCE if depth != "pencil" and count > CONDITIONS else POSES_AT_ONCE
    size = max(1, most // max(1, count))
    starts = range(0, max(1, len(stack)), size)
    return joined([_answers(stack[start : start + size], depth) for start in starts])


def _answers(stack: TaskStack, depth: Depth) -> StackedAnswers:
    """The answers of tasks that are computed together."""
    outcome, code = np.zeros(len(stack), dtype=np.int8), np.full(len(stack), "", dtype="<U4")
    alone, rows = np.ones(len(stack), dtype=bool), [DyadRows.blank(0)]
    warnings: list[tuple[int, str]] = []
    sound = np.flatnonzero(computable(stack))
    for each in _vouched(stack[sound], depth) if len(sound) else []:
        index = sound[each.tasks]
        alone[index] = False
        table = rows_of_found(each.found, each.fits.poses, each.status)
        rows.append(replace(table, task=index[table.task]))
        few = index[each.advice.pairs == 0]
        outcome[few], code[few] = StackedAnswers.OUTCOMES.index("too few dyads"), "R302"
        warnings += [(int(index[task]), name) for task, name in each.advice.warnings]
    rest = np.flatnonzero(alone).tolist()
    singles = [_answer(stack, k, depth) for k in rest]
    rows.append(rows_of_tasks(singles, rest, stack.displacements))
    outcome[rest] = [StackedAnswers.OUTCOMES.index(each.outcome) for each in singles]
    code[rest] = [each.code for each in singles]
    for task, single in zip(rest, singles, strict=True):
        warnings += [(task, name) for name in single.warnings]
    dyads = concatenate(rows)
    dyads = take(dyads, np.argsort(dyads.task, kind="stable"))
    linkages = _linkages(stack, dyads, alone) if depth == "linkages" else None
    if linkages is not None:
        made = np.bincount(linkages.task, minlength=len(stack)) > 0
        usable = np.bincount(linkages.task[linkages.verdict == USABLE], minlength=len(stack)) > 0
        solved = outcome == StackedAnswers.OUTCOMES.index("solved")
        code[solved] = np.where(made, np.where(usable, "R300", "R301"), "R302")[solved]
        outcome[solved & ~usable] = StackedAnswers.OUTCOMES.index("none usable")
        outcome[solved & ~made] = StackedAnswers.OUTCOMES.index("too few dyads")
    return StackedAnswers(
        dyads,
        linkages,
        outcome,
        code,
        alone,
        tuple(sorted(warnings, key=lambda each: each[0])),
    )


def _linkages(stack: TaskStack, dyads: DyadRows, alone: NDArray[np.bool_]) -> LinkageRows:
    """The linkages of all pairs of dyads; a repeated pose of a task counts once."""
    poses, weights = stack.displacements, stack.weights
    scales, repeated = Scales.of(poses, weights), np.zeros(len(stack), dtype=bool)
    has_dyads = np.bincount(dyads.task, minlength=len(stack)) > 1
    parts = []
    for task in np.flatnonzero(alone & has_dyads).tolist():
        first, group = exact_repeats(poses[task])
        if len(first) == len(group):
            continue
        repeated[task] = True
        merged = None
        if weights is not None:
            merged = np.bincount(group, weights[task]).astype(np.float64)[None]
        own = take(dyads, dyads.task == task)
        own = replace(own, task=own.task - task)
        found = pair_linkages(own, poses[task][first][None], merged, take(scales, [task]))
        parts.append(replace(found, task=found.task + task))
    rest = take(dyads, ~repeated[dyads.task])
    every = concatenate([pair_linkages(rest, poses, weights, scales), *parts])
    return take(every, np.argsort(every.task, kind="stable"))


def _vouched(stack: TaskStack, depth: Depth) -> list[Vouched]:
    """The tasks that the stacked road vouches for, each of them once."""
    count = stack.poses.shape[1]
    if depth == "pencil":
        return [pencil_dyads(stack)] if count >= MIN_POSES else []
    if count == CONDITIONS:
        return five_pose_dyads(stack)
    return [best_dyads_in_stack(stack)] if count > CONDITIONS else []


def _answer(stack: TaskStack, index: int, depth: Depth) -> TaskDyads:
    """What came of one task of a stack, by the road of one task."""
    try:
        task = stack.task(index)
    except InputError as error:
        return TaskDyads("refused", error.code)
    return dyads_of_task(task, depth)
