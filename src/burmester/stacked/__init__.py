"""Many tasks of one number of poses at once: their dyads and linkages as columns."""

from burmester.stacked.answers import (
    Depth,
    DyadRows,
    LinkageRows,
    Outcome,
    StackedAnswers,
    Status,
    joined,
)
from burmester.stacked.depths import stacked_answers
from burmester.stacked.task_stack import TaskStack

__all__ = [
    "Depth",
    "DyadRows",
    "LinkageRows",
    "Outcome",
    "StackedAnswers",
    "Status",
    "TaskStack",
    "joined",
    "stacked_answers",
]
