"""Regions so thin that rounding makes one face of all their faces: a segment, or a point."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.geometry.regions import Region, narrowed
from burmester.tasks.limits import Limits, frames_of
from burmester.tasks.motion_task import CONDITIONS, Task

# Characteristic lengths, or a share of the way to a farther corner.  Four times the distance at
# which a descent takes a pivot for one that lies on an edge (`face_descent`).
LEAST_WIDTH = 4e-8


def with_limits_to_search(task: Task) -> Task:
    """The task, each region of its limits that is too thin taken for its segment or point."""
    exact = 0 if task.exact is None else int(task.exact.sum())
    limits = tuple(
        without_thin_regions(each, frames_of(task.poses, task.weights, (each,))[0], exact)
        for each in task.limits
    )
    same = all(old is new for old, new in zip(task.limits, limits, strict=True))
    return task if same else replace(task, limits=limits)


def without_thin_regions(limits: Limits, frames: CanonicalFrames, exact: int) -> Limits:
    """Limits whose regions are wide enough, or taken for the segments and points in their middle.

    exact: how many poses are met exactly.  A region stays as it is where its segment or point
    would be one condition too many: there the exact poses leave no way along its faces.
    """
    origins = {"fixed_pivot": frames.fixed_origin, "moving_pivot": frames.moving_origin}
    for name, origin in origins.items():
        region: Region | None = getattr(limits, name)
        corners = None if region is None else region.corners()
        if region is None or corners is None:
            continue
        reach = max(float(frames.length), float(np.abs(corners - origin).max()))
        flat = narrowed(region, LEAST_WIDTH * reach)
        if flat is region:
            continue
        changed: dict[str, Any] = {name: flat}
        less = replace(limits, **changed)
        if less.conditions + exact <= CONDITIONS:
            limits = less
    return limits
