"""Where a six-bar falls short of the standard of linkages to build, in words."""

from __future__ import annotations

import math

from burmester.sixbar.candidates import WIDEST
from burmester.sixbar.watt import WattLinkage
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import least_angle, length_of
from burmester.verdicts.standard import (
    LEAST_TRANSMISSION,
    LONGEST_LINK,
    MOST_LINK_RATIO,
    SHORTEST_LINK,
)
from burmester.wording import figure

__all__ = ["shortcomings"]


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
