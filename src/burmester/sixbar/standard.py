"""Where a six-bar falls short of the standard of linkages to build, in words; least lengths."""

from __future__ import annotations

import math

import numpy as np

from burmester.numerics.arrays import FloatArray
from burmester.sixbar.candidates import WIDEST
from burmester.sixbar.watt import BARS, WattLinkage
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
    linkage: WattLinkage, transmission: float, extent: float, size: float, task: Task
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


def least_bars(problem: SynthesisProblem) -> FloatArray:
    """The least distances (10,) between joints of one link, in the order of `BARS`.

    A six-bar with a shorter one is degenerate (`verdicts.degeneracy`).
    """
    least = dict.fromkeys(BARS, least_link(problem))
    least["AC"], least["BD"] = least_cranks(problem)
    return np.array(list(least.values()))
