"""The standard that a linkage is held to where its task asks for nothing: `requirements.table`."""

from __future__ import annotations

from dataclasses import replace

from burmester.requirements.links import CHANGE_POINT, EXTENT
from burmester.requirements.requirement import Bounds, Requirement
from burmester.requirements.table import ASKED, shortcomings, standard
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.repeated_poses import rotation_range
from burmester.tasks.requirements import Requirements
from burmester.verdicts.found_linkage import FoundLinkage

__all__ = ["falls_short", "not_asked", "standard_of", "with_standard"]

SAME_ANGLE = 1e-9  # radians; a body that turns by less has nothing but parallelograms


def standard_of(task: Task) -> Bounds:
    """The standard of four-bars for a task; a bound that it sets itself is not asked again."""
    return standard(task.requirements.bounds, span(task), not_asked(task))


def not_asked(task: Task) -> tuple[Requirement, ...]:
    """What of the standard is not asked of four-bars for a task."""
    either = task.requirements.types is not None or rotation_range(task.poses.angle) <= SAME_ANGLE
    return (EXTENT, CHANGE_POINT) if either else (EXTENT,)


def with_standard(asked: Requirements) -> Requirements:
    """What a task asks, and the bounds of the standard that it could ask."""
    bounds = standard(asked.bounds, 0.0)
    return replace(asked, **{each.name: bounds[each] for each in ASKED if each in bounds})


def falls_short(found: FoundLinkage, task: Task, bounds: Bounds) -> tuple[str, ...]:
    """Where a linkage falls short of the standard of its task, in words that follow "it"."""
    return shortcomings(bounds, found.figures, lambda value: length_of(value, task))
