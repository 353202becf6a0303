"""The check of a six-bar against limits and requirements of its task, and against the standard."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from burmester.errors import Finding
from burmester.geometry.regions import Polygon, Region
from burmester.mechanisms.skeleton import Skeleton
from burmester.numerics.arrays import FloatArray
from burmester.requirements.figures import Figures
from burmester.requirements.table import shortcomings as falls_short
from burmester.requirements.table import standard
from burmester.requirements.table import violations as violations_of
from burmester.sixbar.kinds import SixBar
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.limit_check import LIMIT_TOLERANCE, off_region, outside, wrong_length
from burmester.verdicts.requirement_check import least_cranks, least_link


def violations(linkage: SixBar, figures: Figures, task: Task, size: float) -> tuple[Finding, ...]:
    """The limits and requirements of a task that a six-bar does not keep; size: of the motion."""
    out = list(violations_of(task.requirements.bounds, figures, task.length_unit))
    if task.limits:
        first, second = task.limits[0], task.limits[-1]
        broken = _broken(linkage, first, second, task, LIMIT_TOLERANCE * size)
        out += [Finding("limit", message) for message in broken]
    return tuple(out)


def _broken(
    linkage: SixBar, first: Limits, second: Limits, task: Task, slack: float
) -> Iterator[str]:
    """The limits that it does not keep; any one pivot is in the first of two regions."""
    skeleton, frames = linkage.skeleton, linkage.frames()
    for name, regions, pivots in (
        ("fixed", (first.fixed_pivot, second.fixed_pivot), frames[skeleton.ground]),
        ("moving", (first.moving_pivot, second.moving_pivot), frames[linkage.carries]),
    ):
        out = _least_outside(regions, list(pivots.values()))
        for (joint, at), away in zip(pivots.items(), out, strict=True):
            yield from off_region(f"the {name} pivot {joint}", at, away, slack, task.length_unit)
    lengths = dict(zip(skeleton.bars, linkage.lengths().tolist(), strict=True))
    for pivot in skeleton.drivers:
        arm = next(bar for bar in lengths if set(bar) == set(skeleton.arm(pivot)))
        limits = first if pivot == skeleton.drivers[0] else second
        yield from wrong_length(f"the {skeleton.crank(pivot)} {arm}", lengths[arm], limits, slack)


def _least_outside(
    regions: tuple[Region | None, Region | None], pivots: list[FloatArray]
) -> list[float]:
    """How far pivots are outside the regions, that one in the first for which this is best."""
    one, other = regions
    if one is other and one is not None and not isinstance(one, Polygon):
        other = None  # two pivots do not share a point or a line: the search keeps it with one
    ways = [
        [_away(one if k == own else other, at) for k, at in enumerate(pivots)]
        for own in range(len(pivots))
    ]
    return min(ways, key=sum)


def _away(region: Region | None, at: FloatArray) -> float:
    return 0.0 if region is None else max(0.0, outside(region, np.asarray(at)))


def shortcomings(figures: Figures, size: float, task: Task) -> tuple[str, ...]:
    """Where a six-bar falls short of the standard of linkages to build, in words."""
    bounds = standard(task.requirements.bounds, size)
    below = falls_short(bounds, figures, lambda value: length_of(value, task))
    return tuple(each.message for each in below)


def least_bars(problem: SynthesisProblem, skeleton: Skeleton) -> FloatArray:
    """The least distances (b,) between joints of one link, in the order of the skeleton's bars.

    A six-bar with a shorter one is degenerate (`verdicts.requirement_check`).
    """
    least = dict.fromkeys(skeleton.bars, least_link(problem))
    arms = [skeleton.arm(pivot) for pivot in skeleton.drivers]
    for arm, length in zip(arms, least_cranks(problem), strict=False):
        least[arm if arm in least else arm[::-1]] = length
    return np.array(list(least.values()))
