"""The answers of a stack of tasks at a depth."""

from __future__ import annotations

import numpy as np

from burmester.errors import InputError
from burmester.stacked.answers import Depth, LinkageRows, StackedAnswers
from burmester.stacked.dyad_table import rows_of_tasks
from burmester.stacked.one_task import TaskDyads, dyads_of_task
from burmester.stacked.task_stack import TaskStack

__all__ = ["stacked_answers"]


def stacked_answers(stack: TaskStack, depth: Depth) -> StackedAnswers:
    """The dyads of many tasks, and with the depth "linkages" the pairs of them."""
    found = [_answer(stack, k, depth) for k in range(len(stack))]
    rows = rows_of_tasks(found, range(len(stack)), stack.displacements)
    return StackedAnswers(
        rows,
        LinkageRows.blank(0) if depth == "linkages" else None,
        np.array([StackedAnswers.OUTCOMES.index(each.outcome) for each in found], dtype=np.int8),
        np.array([each.code for each in found], dtype="<U4"),
        np.ones(len(stack), dtype=bool),
        tuple((task, code) for task, each in enumerate(found) for code in each.warnings),
    )


def _answer(stack: TaskStack, index: int, depth: Depth) -> TaskDyads:
    """What came of one task of a stack."""
    try:
        task = stack.task(index)
    except InputError as error:
        return TaskDyads("refused", error.code)
    return dyads_of_task(task, depth)
