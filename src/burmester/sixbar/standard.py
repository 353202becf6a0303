"""Where a six-bar falls short of the standard of linkages to build, in words; least lengths."""

from __future__ import annotations

import numpy as np

from burmester.mechanisms.skeleton import Skeleton
from burmester.numerics.arrays import FloatArray
from burmester.requirements.figures import Figures
from burmester.requirements.table import shortcomings as falls_short
from burmester.requirements.table import standard
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.degeneracy import least_cranks, least_link

__all__ = ["least_bars", "shortcomings"]


def shortcomings(figures: Figures, size: float, task: Task) -> tuple[str, ...]:
    """Where a six-bar falls short of the standard of linkages to build, in words."""
    bounds = standard(task.requirements.bounds, size)
    below = falls_short(bounds, figures, lambda value: length_of(value, task))
    return tuple(each.message for each in below)


def least_bars(problem: SynthesisProblem, skeleton: Skeleton) -> FloatArray:
    """The least distances (b,) between joints of one link, in the order of the skeleton's bars.

    A six-bar with a shorter one is degenerate (`verdicts.degeneracy`).
    """
    least = dict.fromkeys(skeleton.bars, least_link(problem))
    arms = [skeleton.arm(pivot) for pivot in skeleton.drivers]
    for arm, length in zip(arms, least_cranks(problem), strict=False):
        least[arm if arm in least else arm[::-1]] = length
    return np.array(list(least.values()))
