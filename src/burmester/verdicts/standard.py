"""The standard that a linkage is held to where its task asks for nothing.

A linkage that is closest to the poses may be one that nobody builds: it nearly locks, or its links
are tiny beside the motion.  The bounds here are those of practice, not of a proof.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Self, final

import numpy as np

from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import GRASHOF_SUMS
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import least_angle, length_of, span
from burmester.tasks.repeated_poses import rotation_range
from burmester.tasks.requirements import Requirements
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import figure

__all__ = ["LEAST_TRANSMISSION", "Standard"]

LEAST_TRANSMISSION = 30.0  # degrees; below it friction and play grow quickly
MOST_LINK_RATIO = 10.0  # longest over shortest of four links
# Spans of the motion: a shorter link magnifies the errors of its pins at the body; a longer one is
# hardly to be placed.
SHORTEST_LINK, LONGEST_LINK = 0.05, 10.0
SAME_ANGLE = 1e-9  # radians; a body that turns by less has nothing but parallelograms
CHANGE_POINT = 1e-3  # of all links together: a linkage whose Grashof excess is less may flip over
ROUNDING_DEGREES = 1e-6  # degrees; an angle lower by less is as good


@final
@dataclass(frozen=True, slots=True)
class Standard:
    """What makes a linkage one to build; a bound that the task itself sets is not asked again.

    transmission_deg: the least transmission angle over the range, degrees; 0 asks for none.
    link_ratio: of the longest of four links to the shortest; infinite asks for none.
    span: of the motion, in the task's unit.
    change_point: whether a linkage may be at a change point.
    """

    transmission_deg: float
    link_ratio: float
    span: float
    change_point: bool

    @classmethod
    def of(cls, task: Task) -> Self:
        """The standard for linkages of a task."""
        asked = task.requirements
        return cls(
            0.0 if asked.transmission_deg else LEAST_TRANSMISSION,
            math.inf if math.isfinite(asked.link_ratio) else MOST_LINK_RATIO,
            span(task),
            asked.types is not None or rotation_range(task.poses.angle) <= SAME_ANGLE,
        )

    @property
    def shortest(self) -> float:
        """The length of the shortest link to build, in the task's unit."""
        return SHORTEST_LINK * self.span

    def requirements(self, asked: Requirements) -> Requirements:
        """What a task asks, and this standard."""
        return replace(
            asked,
            transmission_deg=max(asked.transmission_deg, self.transmission_deg),
            link_ratio=min(asked.link_ratio, self.link_ratio),
        )

    def shortcomings(self, found: FoundLinkage, task: Task) -> tuple[str, ...]:
        """Where a linkage falls short of the standard, in words that follow "it"; () is good."""
        out = []
        least = found.driven.least_over_range
        if not math.degrees(least) >= self.transmission_deg - ROUNDING_DEGREES:
            out.append(f"transmits at {least_angle(least)} only")
        every = found.linkage.links
        links = [float(link) for link in every or ()]
        if links and max(links) > self.link_ratio * min(links):
            out.append(f"has a link {figure(max(links) / min(links))} times as long as another")
        built = links or [
            float(dyad.radius)
            for dyad in (found.linkage.first, found.linkage.second)
            if isinstance(dyad, RR)
        ]
        if built and min(built) < self.shortest:
            out.append(f"has a link of {length_of(min(built), task)}")
        elif built and max(built) > LONGEST_LINK * self.span:
            out.append(f"has a link of {length_of(max(built), task)}")
        excess = float(np.abs(GRASHOF_SUMS @ links).min()) if links else math.inf
        if not self.change_point and excess < CHANGE_POINT * sum(links):
            out.append("is at a change point")
        return tuple(out)
