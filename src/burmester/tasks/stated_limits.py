"""The limits and requirements that a task states, one by one, and the task without one of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Final, final

import numpy as np

from burmester.geometry.regions import Polygon, Region
from burmester.tasks.motion_task import Task

PIVOTS: Final = ("fixed pivot", "moving pivot")


@final
@dataclass(frozen=True, slots=True)
class StatedLimit:
    """One limit of a task; number: of the dyad's limits, or of the keep-out region, from 0."""

    kind: str
    number: int = 0


def stated_limits(task: Task) -> Iterator[StatedLimit]:
    """Every limit and requirement that a task states, but how far its poses may be missed."""
    asked, around = task.requirements, task.surroundings
    for number, limits in enumerate(task.limits):
        of_dyad: dict[str, bool] = {
            "fixed pivot": limits.fixed_pivot is not None,
            "moving pivot": limits.moving_pivot is not None,
            "length": limits.has_length,
        }
        yield from (StatedLimit(kind, number) for kind, given in of_dyad.items() if given)
    parts = around is not None and (around.margin or around.link_width or around.body_in_plane)
    of_linkage: dict[str, bool] = {
        "kinds": any({"RR", "PR", "RP"} - limits.kinds for limits in task.limits),
        **{each.kind: True for each in asked.bounds if each.kind},
        "margin": bool(parts),
    }
    yield from (StatedLimit(kind) for kind, given in of_linkage.items() if given)
    for number in range(0 if around is None else len(around.keep_out)):
        yield StatedLimit("keep-out", number)


def without(task: Task, limit: StatedLimit, room: Callable[[str], Polygon | None]) -> Task:
    """The task without one of its limits.

    room: for "fixed pivot" and "moving pivot", a box in which pivots are looked for instead of
    everywhere.
    """
    number = limit.number
    if limit.kind in PIVOTS:
        name = limit.kind.replace(" ", "_")
        one, wide = task.limits[number], room(limit.kind)
        region = _around(getattr(one, name), wide)
        return with_limits(task, number, **{name: region}, kinds=one.allowed)  # no new sliders
    if limit.kind == "length":
        return with_limits(task, number, length=(0.0, math.inf))
    if limit.kind == "kinds":
        every = tuple(replace(each, kinds=each.kinds | {"RR", "PR", "RP"}) for each in task.limits)
        return replace(task, limits=every)
    if limit.kind in ("margin", "keep-out"):
        around = task.surroundings
        assert around is not None
        if limit.kind == "margin":
            bare = replace(around, margin=0.0, link_width=0.0, body_in_plane=False)
            return replace(task, surroundings=bare if around.keep_out else None)
        rest = around.keep_out[:number] + around.keep_out[number + 1 :]
        none = not rest and not around.body_in_plane
        return replace(task, surroundings=None if none else replace(around, keep_out=rest))
    open_ = {
        each.name: each.default for each in task.requirements.bounds if each.kind == limit.kind
    }
    return replace(task, requirements=replace(task.requirements, **open_))


def with_limits(task: Task, number: int, **changes: Any) -> Task:
    """The task with other limits in the place of those with a number."""
    limits = list(task.limits)
    limits[number] = replace(limits[number], **changes)
    return replace(task, limits=tuple(limits))


def _around(region: Region, wide: Polygon | None) -> Polygon | None:
    """The box that holds a region and a wide box; None where there is no wide box."""
    if wide is None:
        return None
    corners = region.corners()
    points = wide.vertices if corners is None else np.concatenate([wide.vertices, corners])
    (x, y), (z, w) = points.min(axis=0), points.max(axis=0)
    return Polygon(np.array([(x, y), (z, y), (z, w), (x, w)]))
