"""Where a six-bar falls short of the standard of linkages to build, in words; least lengths."""

from __future__ import annotations

import math

import numpy as np

from burmester.mechanisms.skeleton import Skeleton
from burmester.numerics.arrays import FloatArray
from burmester.sixbar.candidates import WIDEST
from burmester.sixbar.kinds import SixBar
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import least_angle, length_of
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.degeneracy import least_cranks, least_link
from burmester.verdicts.standard import (
    LEAST_TRANSMISSION,
    LONGEST_LINK,
    MOST_LINK_RATIO,
    SHORTEST_LINK,
)
from burmester.wording import figure

__all__ = ["least_bars", "shortcomings"]


def shortcomings(
    linkage: SixBar, transmission: float, extent: float, size: float, task: Task
) -> tuple[str, ...]:
    """Where a six-bar falls short of the standard of four-bars, or is large; in words."""
    out, lengths, asked = [], linkage.lengths().tolist(), task.requirements
    least, most = min(lengths), max(lengths)
    if math.degrees(transmission) < LEAST_TRANSMISSION and not asked.transmission:
        out.append(f"transmits at {least_angle(transmission)} only")
    if most > MOST_LINK_RATIO * least and not math.isfinite(asked.link_ratio):
        ratio = figure(most / least)
        out.append(f"has joints {ratio} times as far from each other on one link as on another")
    if least < SHORTEST_LINK * size:
        out.append(f"has joints {length_of(least, task)} from each other")
    elif most > LONGEST_LINK * size:
        out.append(f"has joints {length_of(most, task)} from each other")
    if extent > WIDEST * size:
        out.append(f"needs room of {length_of(extent, task)}")
    return tuple(out)


def least_bars(problem: SynthesisProblem, skeleton: Skeleton) -> FloatArray:
    """The least distances (b,) between joints of one link, in the order of the skeleton's bars.

    A six-bar with a shorter one is degenerate (`verdicts.degeneracy`).
    """
    least = dict.fromkeys(skeleton.bars, least_link(problem))
    arms = [skeleton.arm(pivot) for pivot in skeleton.drivers]
    for arm, length in zip(arms, least_cranks(problem), strict=False):
        least[arm if arm in least else arm[::-1]] = length
    return np.array(list(least.values()))
