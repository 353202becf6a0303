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
from burmester.stacked.datasheet import datasheet
from burmester.stacked.depths import stacked_answers
from burmester.stacked.random_linkages import RandomLinkages, SampleOptions, random_linkages
from burmester.stacked.task_stack import TaskStack

__all__ = [
    "Depth",
    "DyadRows",
    "LinkageRows",
    "Outcome",
    "RandomLinkages",
    "SampleOptions",
    "StackedAnswers",
    "Status",
    "TaskStack",
    "datasheet",
    "joined",
    "random_linkages",
    "stacked_answers",
]
