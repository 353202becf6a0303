"""Pivots that a hand put somewhere: the best dyad of each, and what two of them make.

Of four poses and more a pivot has one best dyad, of three poses one that meets them all; of two
the nearest to the origin of M, or of F, of those that do.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

import numpy as np

from burmester.cures import for_page
from burmester.dyads.pivot_map import fixed_pivot_map, moving_pivot_map
from burmester.dyads.selection import FoundDyad
from burmester.dyads.three_poses import dyad_with_fixed_pivot, dyad_with_moving_pivot
from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.io.linkage_data import number
from burmester.numerics.arrays import FloatArray
from burmester.studio.exports import links_of
from burmester.synthesis.given_linkage import OpenLink
from burmester.synthesis.judgement import judge_linkage
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.values import real_numbers
from burmester.web.data import dyad_report, linkage_report

PLANES: Final = ("F", "M")


def placed(task: Task, pivots: Any, options: SynthesisOptions, frames: int) -> dict[str, Any]:
    """The dyads of one or two pivots, and the linkage that two of them make, judged.

    pivots: [{"plane": "F" or "M", "at": [x, y]}]; or both pivots of two links, to be judged as
    they are: [{"fixed_pivot": [x, y], "moving_pivot": [x, y], "radius": r}] x 2, where lengths that
    are left out follow from the poses.  Raises InputError E153 for what is no pivot.
    """
    whole = isinstance(pivots, list) and any(
        isinstance(each, dict) and "fixed_pivot" in each for each in pivots
    )
    dyads = (
        [_link(task, each) for each in links_of(pivots)]
        if whole
        else [_dyad(task, *each) for each in _pivots(pivots)]
    )
    found = [FoundDyad.of(f"P{k}", dyad, task.poses) for k, dyad in enumerate(dyads, start=1)]
    answer: dict[str, Any] = {
        "dyads": [dyad_report(each, task) for each in found],
        "linkage": None,
        "cost": None,
        "messages": [],
    }
    if len(dyads) < 2:
        return answer
    try:
        judged = judge_linkage(task, Linkage(*dyads), options)
    except InputError as error:
        return {**answer, "messages": [error.to_dict(for_page)]}
    (one, two), first = judged.linkages[0].dyads, judged.linkages[0]
    first = replace(first, dyads=(replace(one, id="P1"), replace(two, id="P2")))
    return {
        **answer,
        "linkage": linkage_report(judged, first, frames),
        "cost": {"rms": number(first.error.rms), "worst": number(first.error.worst)},
        "messages": [judged.outcome.to_dict(for_page)],
    }


def _pivots(given: Any) -> list[tuple[str, FloatArray]]:
    """Planes and points of one or two pivots."""
    pivots = given if isinstance(given, list) else []
    if not 1 <= len(pivots) <= 2:
        raise InputError("E153", "one or two pivots make dyads", help="put one or two pivots")
    out = []
    for k, each in enumerate(pivots, start=1):
        plane = each.get("plane") if isinstance(each, dict) else None
        if plane not in PLANES:
            message = f"pivot {k} is in no plane"
            raise InputError(
                "E153", message, help='give "plane": "F" (the ground) or "M" (the body)'
            )
        out.append((plane, real_numbers(each.get("at"), (2,), f"pivot {k}", code="E153")))
    return out


def _link(task: Task, given: dict[str, Any]) -> RR:
    """A link with both its pivots."""
    fixed, moving = (
        real_numbers(given.get(f"{name}_pivot"), (2,), f"a {name} pivot", code="E153")
        for name in ("fixed", "moving")
    )
    if given.get("radius") is None:
        return OpenLink(fixed, moving).at(task)
    return RR(fixed, moving, real_numbers(given["radius"], (), "a length", code="E153"))


def _dyad(task: Task, plane: str, at: FloatArray) -> RR:
    """The best link with one pivot at a point of a plane."""
    poses, count = task.poses, task.poses.shape[0]
    if count > 3:
        best = fixed_pivot_map if plane == "F" else moving_pivot_map
        dyad = best(poses, at, task.weights).dyads
    elif count == 3:
        exact = dyad_with_fixed_pivot if plane == "F" else dyad_with_moving_pivot
        dyad = exact(poses, at)
    elif plane == "F":
        there = _nearest_of_two(poses.inverse(), at)
        dyad = RR(at, there.fixed_pivot, there.radius)
    else:
        dyad = _nearest_of_two(poses, at)
    if not all(np.isfinite(each).all() for each in (dyad.fixed_pivot, dyad.moving_pivot)):
        where = f"({at[0]:.6g}, {at[1]:.6g})"
        raise InputError(
            "E153",
            f"no link with a pivot at {where} is determined",
            why="the poses move that point along a line, or not at all",
            help="put the pivot somewhere else, or take a slider",
        )
    return dyad


def _nearest_of_two(poses: Displacement, moving: FloatArray) -> RR:
    """Of two poses the link of a moving pivot whose fixed pivot is nearest to the origin."""
    if poses.shape[0] < 2:
        raise InputError("E120", "one pose has every dyad", help="give two poses or more")
    a, b = poses[0].act(moving), poses[1].act(moving)
    along = b - a
    with np.errstate(divide="ignore", invalid="ignore"):
        fixed = along * ((b @ b - a @ a) / 2 / (along @ along))
    return RR(fixed, moving, np.hypot(*(a - fixed)))
