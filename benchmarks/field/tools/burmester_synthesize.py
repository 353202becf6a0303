"""Ours: `burmester.synthesize`, one call, all options as they come."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask

TITLE = "burmester"
PACKAGE = "burmester"
CALLED = (
    "Poses: `burmester.synthesize(task, length_per_radian=...)`, ground pivots as `Limits`.",
    "Paths: the same, with free angles; `TracedPath` where it is closed or timed.",
    "Functions: `burmester.synthesize_function(pairs, minimax=True)`.",
    "The linkages of the result in their order.",
)


def refuses(task: FieldTask) -> str | None:
    return None


def solve(task: FieldTask, seconds: float) -> list[FourBar]:
    import burmester
    from burmester.tasks.pose_tolerances import PoseTolerances
    from burmester.tasks.traced_path import TracedPath

    if task.is_function:
        made = burmester.synthesize_function(task.rows, angle_unit="rad", minimax=True)
        pairs = [_four_bar(each.linkage) for each in made.generators]
        return [four_bar for four_bar in pairs if four_bar is not None]
    count, points = len(task.rows), task.is_path
    traced = TracedPath(task.closed, task.crank) if task.closed or task.crank is not None else None
    rows = np.column_stack([task.rows, np.full(count, np.nan)]) if points else task.rows
    free = PoseTolerances.uniform(count, 0, 0, np.inf) if points else None
    given = burmester.Task.from_rows(rows, angle_unit="rad", limits=_limits(task), tolerances=free)
    given = given if traced is None else replace(given, path=traced)
    radian = None if points else task.disc
    # A time limit is one of the clock; this one ends searches only, and the limit here is CPU time.
    result = burmester.synthesize(given, length_per_radian=radian, time_limit=0.9 * seconds)
    found = [_four_bar(each.driver_first) for each in result]
    return [four_bar for four_bar in found if four_bar is not None]


def _limits(task: FieldTask) -> tuple[Any, ...]:
    import burmester

    if task.pivots is None:
        return ()
    a, b = ((place.real, place.imag) for place in task.pivots.places)
    if task.pivots.kind == "box":
        return (burmester.Limits(fixed_pivot=burmester.box(a, b)),)
    if task.pivots.kind == "line":
        return (burmester.Limits(fixed_pivot=burmester.Line(a, b)),)
    return tuple(burmester.Limits(fixed_pivot=burmester.Point(place)) for place in (a, b))


def _four_bar(linkage: Any) -> FourBar | None:
    dyads = [plain(dyad) for dyad in (linkage.first, linkage.second)]
    return FourBar(dyads[0], dyads[1]) if dyads[0] and dyads[1] else None


def plain(dyad: Any) -> Dyad | None:
    """A dyad of the package in plain numbers; none for two sliders, which no tracer drives."""
    kind = type(dyad).__name__
    if kind == "PP":
        return None
    fixed = complex(*getattr(dyad, "fixed_pivot", (0, 0)))
    moving = complex(*getattr(dyad, "moving_pivot", (0, 0)))
    if kind == "RR":
        return Dyad("RR", fixed, moving, float(dyad.radius))
    return Dyad(kind, fixed, moving, float(dyad.offset), float(dyad.normal_angle))  # type: ignore[arg-type]
