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

from burmester.cures import Help
from burmester.errors import Advice
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import FloatArray, concatenate, even_numbers
from burmester.points.real_linkages import linkages_through
from burmester.points.start_systems import CASES
from burmester.progress import step
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.least_error import Refined
from burmester.refinement.target import Target
from burmester.synthesis.point_conditions import given_pivots
from burmester.tasks.motion_task import CONDITIONS, Task
from burmester.tasks.notation import length_of
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances, tolerance_cure
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import worst_miss
from burmester.verdicts.found_linkage import FoundLinkage

ASSUMED_RATIO = 2.0  # of the assumed tolerance to the worst error of the nearest linkage
LEAST_ASSUMED = 1e-4  # motion sizes, or spans of a path; a smaller tolerance is not assumed
MOST_CHOICES, PATHS = 10, 900  # of rows for one case, and paths that are followed for them all
FAR = 20.0  # motion sizes; a linkage with a longer link is not refined
MOST_ROWS = 30  # poses, and points, by which linkages are refined
REFINED, JUDGED = 60, 12  # linkages that are refined, and how many of them are judged
STEPS, CHOICE = 300, ((20, 30), (60, 16))  # of the refinement; after how many how many go on
FARTHER = 5.0  # times as far as the nearest one may be one that is better to build
SAME = 1e-6  # relative; refined linkages whose costs differ by less are one
WIDE = 3.0  # radians, and lengths per radian; a tolerance that all near places keep


def with_nearest_angles(task: Task, options: SynthesisOptions) -> tuple[Task, list[Advice]]:
    """The task with the angles of the nearest linkage at its points, and with a tolerance.

    Where it states none, one is assumed, and said.  The same task where it has no points beside
    its poses, or so few that linkages meet them all.
    """
    stated = task.tolerances
    if stated is None or not _are_too_many(task, stated):
        return task, []
    nearest = nearest_linkage(task, options)
    if nearest is None:
        return task, []
    angle = np.where(task.free_angles, nearest.error.places.angle, task.poses.angle)
    task = replace(task, poses=Displacement(task.poses.translation, angle))
    return (task, []) if stated.gives_room else _with_tolerance(task, nearest, options)


def _are_too_many(task: Task, stated: PoseTolerances) -> bool:
    """Whether poses and points are more than a linkage meets exactly, tolerances or not."""
    if task.path is not None:
        return False
    free = stated.free
    mixed = free[:, 2].any() and not free[:, 2].all() and not free[:, :2].any()
    return bool(mixed) and stated.constraints + task.pivot_conditions > 2 * CONDITIONS


def nearest_linkage(task: Task, options: SynthesisOptions) -> FoundLinkage | None:
    """The nearest linkage found that is sound, or at least works, or at all; None without any.

    Nearest by the tolerances that are stated; else by squares, a radian as the length per radian.
    Sound: without shortcomings (`requirements.table`), and not much farther than the nearest.
    """
    step("looking for the linkage nearest to poses and points")
    few = _few_rows(task)
    evaluation = _evaluation(few, options)
    refined = _refined(evaluation.problem, evaluation.target.relaxed)
    if refined is None:
        return None
    index = np.flatnonzero(refined.met & np.isfinite(refined.cost))
    index = index[np.argsort(refined.cost[index], kind="stable")]
    cost = refined.cost[index]
    index = index[np.diff(cost, prepend=-np.inf) > SAME * cost][:JUDGED]
    best = _best(evaluation, refined.batch[index], refined.rows[index])
    if best is None or few is task:
        return best
    whole = _evaluation(task, options)
    batch = LinkageBatch.of([best.linkage]).to_canonical(whole.target.frames)
    return _best(whole, batch, whole.target.places(batch))


def _evaluation(task: Task, options: SynthesisOptions) -> Evaluation:
    """How linkages near the rows are judged: within what is stated, or anywhere near."""
    problem = SynthesisProblem.of(task, None, options)
    assert task.tolerances is not None
    if not task.tolerances.gives_room:
        wide = _tolerances(task, WIDE * problem.length_per_radian, math.degrees(WIDE))
        problem = SynthesisProblem.of(replace(task, tolerances=wide), None, options)
    return Evaluation(problem, target_of(problem))


def _best(evaluation: Evaluation, batch: LinkageBatch, rows: FloatArray) -> FoundLinkage | None:
    """Of linkages with their places the nearest sound one, or that works, or the nearest."""
    if not len(batch):
        return None
    own = batch.from_canonical(evaluation.target.frames)
    candidates = Candidates.of_own_dyads(batch, rows, own, from_search=False)
    judged = evaluation.members(candidates, quality=False)
    first = min(judged, key=lambda each: (not each.usable, each.combined_error), default=None)
    sound = [
        each
        for each in judged
        if first is not None
        and each.usable
        and not each.shortcomings
        and each.combined_error <= FARTHER * first.combined_error
    ]
    return min(sound, key=lambda each: each.combined_error, default=first)


def _few_rows(task: Task) -> Task:
    """The task with MOST_ROWS of its poses, and so many of its points; with all that are exact."""
    if task.poses.shape[0] <= 2 * MOST_ROWS:
        return task
    free = task.free_angles
    some = [rows[even_numbers(len(rows), MOST_ROWS)] for rows in map(np.flatnonzero, (free, ~free))]
    index = np.unique(np.concatenate(some))
    if task.exact is not None:
        index = np.union1d(index, np.flatnonzero(task.exact))
    return task.at(index)


def _refined(problem: SynthesisProblem, target: Target) -> Refined | None:
    """Four-bars through some of the rows, refined to the least error at all; None without any."""
    starts = [*_through_some(problem.given, problem.motion_size)]
    if not starts:
        return None
    batch = concatenate(starts)
    if len(problem.task.limits) > 1:
        batch = concatenate([batch, batch.exchanged()])
    batch = batch.to_canonical(target.frames)
    rows = target.places(batch)
    some = np.argsort(np.nan_to_num(target.cost(rows), nan=np.inf), kind="stable")[:REFINED]
    return target.refine(
        batch[some],
        rows[some],
        constraints=AllConstraints(target.kept),
        constrained_steps=STEPS,
        selection=CHOICE,
    )


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
    task: Task, nearest: FoundLinkage, options: SynthesisOptions
) -> tuple[Task, list[Advice]]:
    """The task with a tolerance, asked or twice the nearest error, and what is said."""
    problem, asked = SynthesisProblem.of(task, None, options), task.requirements
    length = problem.length_per_radian
    if asked.within is not None:
        reach, length = asked.reach(asked.within, length)
        return replace(task, tolerances=_tolerances(task, reach, math.degrees(reach / length))), []
    turn = np.where(task.free_angles, 0.0, nearest.error.angle).max()
    worst = max(nearest.error.worst, length * float(turn))
    least = LEAST_ASSUMED * problem.motion_size
    floor, worst = worst < least, max(worst, least)
    position = float(f"{ASSUMED_RATIO * worst:.2g}")
    angle = float(f"{math.degrees(ASSUMED_RATIO * worst / length):.2g}")
    sound = "" if nearest.shortcomings else "sound "
    out = replace(task, tolerances=_tolerances(task, position, angle))
    how = f"within {ASSUMED_RATIO:g} times that the one that transmits best is chosen"
    if floor:
        how = f"at least {length_of(position, task)} is assumed"
    return out, [
        Advice(
            "W226",
            f"a tolerance of {length_of(position, task)} was assumed for x and y of every pose and "
            f"point, and {angle:g}° for the angles",
            Help.of(
                "say how far they may be missed: {}", tolerance_cure(position, position, angle)
            ),
            f"the nearest {sound}linkage misses them by {worst_miss(nearest, out)} at most, and "
            + how,
        )
    ]


def _tolerances(task: Task, position: float, degrees: float) -> PoseTolerances:
    """The same tolerance for all poses and points; poses that are marked exact stay so."""
    loose = np.ones(task.poses.shape)
    if task.exact is not None:
        loose[task.exact] = 0.0
    angle = np.where(task.free_angles, np.inf, math.radians(degrees) * loose)
    return PoseTolerances(position * np.column_stack([loose, loose]), angle)
