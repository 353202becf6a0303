"""Poses and points that are more than a four-bar can meet: how near one can come to all of them.

Some of the rows, evenly chosen and so many that finitely many four-bars meet them, are solved
completely (Alt-Burmester), and these four-bars refined to the least error at all rows.  The nearest
one says how the body is turned at the points, which is where the search for linkages begins.  Where
the task states no tolerance, it says as well what is assumed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import FoundDyad
from burmester.errors import Advice
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import concatenate
from burmester.points.real_linkages import linkages_through
from burmester.points.start_systems import CASES
from burmester.progress import step
from burmester.refinement.constraints import AllConstraints
from burmester.synthesis.point_conditions import given_pivots
from burmester.tasks.motion_task import CONDITIONS, Task
from burmester.tasks.notation import length_of
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import worst_miss
from burmester.verdicts.found_linkage import FoundLinkage, Pair

__all__ = ["with_nearest_angles"]

ASSUMED_RATIO = 2.0  # of the assumed tolerance to the worst error of the nearest linkage
LEAST_ASSUMED = 1e-4  # motion sizes; a smaller tolerance is not assumed
MOST_CHOICES, PATHS = 10, 900  # of rows for one case, and paths that are followed for them all
FAR = 20.0  # motion sizes; a linkage with a longer link is not refined
REFINED, JUDGED = 60, 12  # linkages that are refined, and how many of them are judged
STEPS, CHOICE = 300, ((20, 30), (60, 16))  # of the refinement; after how many how many go on
SAME = 1e-6  # relative; refined linkages whose costs differ by less are one
WIDE = 3.0  # radians, and lengths per radian: a tolerance that only says what counts how much


def with_nearest_angles(task: Task, options: SynthesisOptions) -> tuple[Task, list[Advice]]:
    """The task with the angles of the nearest linkage at its points, and a tolerance if it has none.

    The same task where it has no points beside its poses, or so few that linkages meet them all.
    """
    if not _are_too_many(task):
        return task, []
    assert task.tolerances is not None
    step("looking for the linkage nearest to poses and points")
    wide = task if task.tolerances.gives_room else replace(task, tolerances=_wide(task, options))
    problem = SynthesisProblem.of(wide, None, options)
    nearest = _nearest(problem)
    if nearest is None:
        return task, []
    angle = np.where(task.free_angles, nearest.error.places.angle, task.poses.angle)
    task = replace(task, poses=Displacement(task.poses.translation, angle))
    if wide.tolerances is task.tolerances:
        return task, []
    return _with_tolerance(task, nearest, problem)


def _are_too_many(task: Task) -> bool:
    """Whether poses and points are more than a linkage meets exactly, tolerances or not."""
    if task.path is not None or task.tolerances is None:
        return False
    free = task.tolerances.free
    mixed = free[:, 2].any() and not free[:, 2].all() and not free[:, :2].any()
    pivots = sum(each.conditions for each in task.limits) * (3 - len(task.limits))
    return bool(mixed) and int((2 - free[:, 2]).sum()) + pivots > 2 * CONDITIONS


def _wide(task: Task, options: SynthesisOptions) -> PoseTolerances:
    """Tolerances that near places keep, in the proportion by which a radian counts as a length.

    Poses that are marked exact stay so.
    """
    length = SynthesisProblem.of(task, None, options).length_per_radian
    loose = np.full(task.poses.shape, WIDE)
    if task.exact is not None:
        loose[task.exact] = 0.0
    position = np.column_stack([loose, loose]) * length
    return PoseTolerances(position, np.where(task.free_angles, np.inf, loose))


def _nearest(problem: SynthesisProblem) -> FoundLinkage | None:
    """The nearest linkage found that works; where none does, the nearest; None where none is."""
    evaluation = Evaluation(problem, target_of(problem))
    target = evaluation.target.relaxed
    starts = [*_through_some(problem.given, problem.motion_size)]
    if not starts:
        return None
    batch = concatenate(starts)
    if len(problem.task.limits) > 1:
        batch = concatenate([batch, batch.exchanged()])
    batch = batch.to_canonical(target.frames)
    rows = target.places(batch)
    some = np.argsort(np.nan_to_num(target.cost(rows), nan=np.inf), kind="stable")[:REFINED]
    refined = target.refine(
        batch[some],
        rows[some],
        constraints=AllConstraints(target.kept),
        constrained_steps=STEPS,
        selection=CHOICE,
    )
    index = np.flatnonzero(refined.met & np.isfinite(refined.cost))
    if not len(index):
        return None
    index = index[np.argsort(refined.cost[index], kind="stable")]
    cost = refined.cost[index]
    index = index[np.diff(cost, prepend=-np.inf) > SAME * cost][:JUDGED]
    own = refined.batch[index].from_canonical(target.frames)
    pairs = [_pair(own, k) for k in range(len(own))]
    none = np.zeros(len(index), dtype=bool)
    candidates = Candidates(refined.batch[index], refined.rows[index], pairs, none, own)
    judged = evaluation.members(candidates, quality=False)
    return min(judged, key=lambda each: (not each.usable, each.combined_error), default=None)


def _pair(batch: LinkageBatch, k: int) -> Pair:
    """The dyads of a linkage; their errors follow."""
    linkage = batch.linkage(k)
    return FoundDyad("D1", linkage.first, 0.0, 0.0), FoundDyad("D2", linkage.second, 0.0, 0.0)


def _through_some(task: Task, size: float) -> Iterator[LinkageBatch]:
    """All four-bars through some of the poses and points, by every case that these allow."""
    is_point = task.free_angles
    posed, pointed = np.flatnonzero(~is_point), np.flatnonzero(is_point)
    pivots, later = given_pivots(task.limits)
    for case in CASES:
        few = case.poses > len(posed) or case.points > len(pointed)
        most = min(len(posed), CONDITIONS - len(pivots))
        if few or case.pivots != len(pivots) or case.poses < most - 1:
            continue
        choices = max(1, min(MOST_CHOICES, PATHS // CASES[case]))
        for share in np.arange(choices) / choices:
            one = _some(len(posed), case.poses, share)
            other = _some(len(pointed), case.points, share)
            chosen = np.union1d(posed[one], pointed[other])
            found = linkages_through(task.poses[chosen], is_point[chosen], pivots).batch
            sane = found.dimensions[:, :, 4].max(axis=-1, initial=0.0) < FAR * size
            if sane.any():
                yield found[sane].exchanged() if later else found[sane]


def _some(count: int, wanted: int, share: float) -> NDArray[np.intp]:
    """So many of `count` rows: evenly, shifted by a share of their distance from each other."""
    if not wanted:
        return np.empty(0, dtype=np.intp)
    return np.floor((np.arange(wanted) + share) * count / wanted).astype(np.intp)


def _with_tolerance(
    task: Task, nearest: FoundLinkage, problem: SynthesisProblem
) -> tuple[Task, list[Advice]]:
    """The task with a tolerance of twice the worst error of the nearest linkage, and what is said.

    A radian counts as the length per radian.
    """
    length, free = problem.length_per_radian, task.free_angles
    places = nearest.error.places
    away = np.abs(places.translation - task.poses.translation).max()
    turn = np.where(free, 0.0, nearest.error.angle).max()
    worst = max(float(away), length * float(turn), LEAST_ASSUMED * problem.motion_size)
    position = float(f"{ASSUMED_RATIO * worst:.2g}")
    angle = float(f"{math.degrees(ASSUMED_RATIO * worst / length):.2g}")
    loose = np.ones(task.poses.shape) if task.exact is None else np.where(task.exact, 0.0, 1.0)
    tolerances = PoseTolerances(
        position * np.column_stack([loose, loose]),
        np.where(free, np.inf, math.radians(angle) * loose),
    )
    advice = Advice(
        "W226",
        f"a tolerance of {length_of(position, task)} was assumed for x and y of every pose and "
        f"point, and one of {angle:g}° for the angles",
        "say how far they may be missed: --pose-tolerance "
        f"{position:g},{position:g},{angle:g}",
        f"the nearest linkage misses them by {worst_miss(nearest, task)} at most, and within "
        f"{ASSUMED_RATIO:g} times that the one that transmits best is chosen",
    )
    return replace(task, tolerances=tolerances), [advice]
