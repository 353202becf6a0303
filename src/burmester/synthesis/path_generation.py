"""Path generation by approximation: the linkages that come nearest to many points, and good ones.

The nearest ones say how near one can come.  Where the task states no tolerance, a multiple of the
least worst distance is assumed, and told; within it quality chooses, as it does for poses with
tolerances: the linkages are refined again under ever greater transmission angles.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Advice
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import take
from burmester.progress import step
from burmester.synthesis.outcome import linkage_advice
from burmester.synthesis.path_linkages import PathLinkages, is_timed_exactly, linkages_near
from burmester.synthesis.point_conditions import special_curve
from burmester.synthesis.point_generation import (
    is_traced_by_crank,
    missed_on_curve,
    none_on_curve,
)
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.motion_task import MOST_POINTS, Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_sample import PoseSample
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.traced_path import TracedPath
from burmester.verdicts.explanation import in_short
from burmester.verdicts.found_linkage import FoundLinkage, numbered_pair
from burmester.verdicts.ranking import ranked
from burmester.wording import count

__all__ = ["near_points", "with_tolerance"]

ASSUMED_RATIO = 2.0  # of the assumed tolerance to the worst distance of the nearest linkage
LEAST_ASSUMED = 1e-4  # spans of the path; a smaller tolerance is not assumed
MOST_TOLD = 12  # linkages that are told
MOST_JUDGED = 2000  # points; of more a sample says which linkages are judged at all of them
ALIKE_ERROR, ALIKE_ANGLE = 0.01, math.radians(0.5)  # of the greatest error; radians; no difference
SAME = 0.01  # spans of the path; linkages whose pivots and links differ by less are listed once
EXACT = 1e-7  # spans of the path; points that are missed by less are met
ROUNDING = 1e-6  # relative; extents that differ by less are alike


def near_points(
    task: Task, options: SynthesisOptions, findings: Sequence[Advice] = ()
) -> Synthesis:
    """The linkages whose coupler point traces the points of a task, or comes nearest to them.

    The task's positions are the points; its angles are free and count for nothing.  Its `path` says
    whether it is closed and how the crank times it.
    """
    path = task.path or TracedPath()
    step(f"looking at {count(len(task.poses.angle), 'point')}")
    if not span(task) > 0:
        return _none(task, options, findings)
    if (special := special_curve(task)) is not None:
        if is_traced_by_crank(special, task):
            problem = SynthesisProblem.of(task, None, options)
            return Synthesis(problem, none_on_curve(special, task), warnings=tuple(findings))
        findings = (*findings, missed_on_curve(special, task))
    found = linkages_near(task, path, options)
    if not len(found.batch):
        return _none(task, options, findings)
    given, note = _with_tolerance(task, found, path)
    problem = SynthesisProblem.of(given, None, options)  # the angles say nothing of a motion
    evaluation = Evaluation(problem, target_of(problem))
    judged = _judged(evaluation, _by_sample(evaluation, found))
    if options.rounds:
        judged = evaluation.rounded(judged)
    judged = evaluation.with_spreads(judged)
    linkages = tuple(_with_rank(each, rank) for rank, each in enumerate(judged, start=1))
    outcome = _outcome(given, linkages, path, problem.length)
    warnings = (*findings, *note, *linkage_advice(given, linkages, outcome.code))
    dyads = tuple(dyad for each in linkages for dyad in each.dyads)
    return Synthesis(problem, outcome, dyads, linkages, warnings)


def with_tolerance(task: Task, options: SynthesisOptions) -> tuple[Task, list[Advice]]:
    """A path as its linkages are judged: with a tolerance, stated or assumed, and what is said.

    Where none is stated, the nearest linkages are looked for, as they say what is assumed.
    """
    path = task.path or TracedPath()
    if _stated(task, path) is None and span(task) > 0:
        found = linkages_near(task, path, options)
        if len(found.batch):
            return _with_tolerance(task, found, path)
    position = _stated(task, path)
    if position is None:
        position = np.full((len(task.poses.angle), 2), LEAST_ASSUMED * span(task))
    return replace(task, tolerances=_of_points(position)), []


def _with_tolerance(task: Task, found: PathLinkages, path: TracedPath) -> tuple[Task, list[Advice]]:
    """The task with a tolerance of its points, and what is to be said where it is assumed.

    Its angles are those of the nearest linkage, to draw the body with; they are free.
    """
    points, number = task.poses.translation, len(task.poses.translation)
    poses = Displacement(points, found.places[0, :, 2])
    position, note = _stated(task, path), list[Advice]()
    if position is None:
        least = float(np.abs(found.places[..., :2] - points).max(axis=(1, 2)).min())
        assumed = max(ASSUMED_RATIO * least, LEAST_ASSUMED * span(task))
        assumed = float(f"{assumed:.2g}")
        position, note = np.full((number, 2), assumed), [_assumed(task, least, assumed)]
    return replace(task, poses=poses, tolerances=_of_points(position)), note


def _stated(task: Task, path: TracedPath) -> FloatArray | None:
    """The tolerances (N, 2) of x and y that a path says, or that its linkages can keep exactly."""
    stated = None if task.tolerances is None else task.tolerances.position
    if stated is not None and (stated > 0).any():
        return stated
    if task.requirements.within is not None:
        return np.full((len(task.poses.angle), 2), task.requirements.within)
    exactly = is_timed_exactly(task, path) or _are_few(task, path)
    return np.zeros((len(task.poses.angle), 2)) if exactly else None


def _are_few(task: Task, path: TracedPath) -> bool:
    """Whether infinitely many linkages pass the points, one way or the other."""
    untimed = path.crank_angles is None and not path.closed
    few = untimed and len(task.poses.angle) + task.pivot_conditions < MOST_POINTS
    return few and special_curve(task) is None


def _of_points(position: FloatArray) -> PoseTolerances:
    """Tolerances of points, whose angles are free."""
    return PoseTolerances(position, np.full(len(position), math.inf))


def _assumed(task: Task, least: float, assumed: float) -> Advice:
    return Advice(
        "W226",
        f"a tolerance of {length_of(assumed, task)} was assumed for x and y of every point",
        f"say how far the points may be missed: --pose-tolerance {assumed:g},{assumed:g},free",
        f"the nearest linkage misses them by {length_of(least, task)} at most, and within "
        f"{ASSUMED_RATIO:g} times that the one that transmits best is chosen",
    )


def _judged(evaluation: Evaluation, found: PathLinkages) -> list[FoundLinkage]:
    """The linkages with errors and verdicts, in the order of `ranking`.

    Those that cannot be inside the tolerances only where no other is usable: told they are not.
    """
    step(f"judging {count(len(found.batch), 'linkage')}")
    near = _may_be_inside(evaluation.task, found)
    judged = _members(evaluation, found, np.flatnonzero(near))
    if not any(each.usable for each in judged):
        judged += _members(evaluation, found, np.flatnonzero(~near))
    task = evaluation.task
    judged = _different(ranked(judged, evaluation.problem), SAME, span(task))
    if is_timed_exactly(task, task.path or TracedPath()):
        return judged  # they are few: all that there are
    return _front(judged, EXACT * span(task))


def _by_sample(evaluation: Evaluation, found: PathLinkages) -> PathLinkages:
    """Of linkages near very many points those that are worth judging at all, by a sample of them.

    All of them where none is usable there.
    """
    task, problem = evaluation.task, evaluation.problem
    if len(task.poses.angle) <= MOST_JUDGED:
        return found
    sample = PoseSample.of_task(task, MOST_JUDGED)
    few = SynthesisProblem.of(task.at(sample.index, sample.cells), None, problem.options)
    there = found._replace(places=found.places[:, sample.index])
    judged = _judged(Evaluation(few, target_of(few)), there)
    if not any(each.usable for each in judged):
        return found
    # `_members` numbers the dyads of each by its place.
    index = [(int(each.dyads[0].id[1:]) - 1) // 2 for each in judged]
    return take(found, np.array(index, dtype=np.intp))


def _may_be_inside(task: Task, found: PathLinkages) -> NDArray[np.bool_]:
    """Which linkages (k,) may have places inside the tolerances of all points.

    Their places are nearest to the points, and what is inside is no farther than the corners.
    """
    assert task.tolerances is not None
    away = np.linalg.norm(found.places[..., :2] - task.poses.translation, axis=-1)
    corner = np.linalg.norm(task.tolerances.position, axis=-1)
    return np.asarray((away <= corner + EXACT * span(task)).all(axis=-1))


def _members(
    evaluation: Evaluation, found: PathLinkages, index: NDArray[np.intp]
) -> list[FoundLinkage]:
    """Some of the linkages, judged."""
    if not len(index):
        return []
    target, some = evaluation.target, take(found, index)
    places = Displacement(some.places[..., :2], some.places[..., 2])
    pairs = [numbered_pair(found.batch.linkage(k), 2 * k + 1) for k in index.tolist()]
    candidates = Candidates(
        some.batch.to_canonical(target.frames),
        target.rows_at(places),
        pairs,
        np.ones(len(pairs), dtype=bool),
        some.batch,
    )
    return evaluation.members(candidates)


def _front(found: Sequence[FoundLinkage], met: float) -> list[FoundLinkage]:
    """The usable linkages that no other one beats in distance, transmission and extent at once.

    In their order, MOST_TOLD of them at most, the nearest one among these; where none is usable,
    all of them.  met: points that are missed by less are met.
    """
    usable = [each for each in found if each.usable and each.quality is not None]
    if not usable:
        return list(found)[:MOST_TOLD]
    figures = np.array(
        [
            (each.error.rms, -each.driven.least_over_range, each.quality.extent)
            for each in usable
            if each.quality is not None
        ]
    )
    error = max(ALIKE_ERROR * figures[:, 0].max(), met)
    slack = np.array([error, ALIKE_ANGLE, ROUNDING * figures[:, 2].max()])
    beaten = (figures[:, None] > figures[None] - slack).all(axis=-1) & (
        figures[:, None] > figures[None] + slack
    ).any(axis=-1)
    best = [each for k, each in enumerate(usable) if not beaten[k].any()]
    nearest = min(usable, key=lambda each: each.error.rms)
    told = best[: MOST_TOLD - 1]
    return told if nearest in told else [*told, nearest]


def _with_rank(found: FoundLinkage, rank: int) -> FoundLinkage:
    """A linkage with its rank, its dyads numbered by it."""
    first, second = (
        replace(each, id=f"D{2 * rank - 2 + number}")
        for number, each in enumerate(found.dyads, start=1)
    )
    return replace(found, id=f"L{rank}", rank=rank, dyads=(first, second))


def _different(found: Sequence[FoundLinkage], share: float, size: float) -> list[FoundLinkage]:
    """The first of linkages that are alike: pivots and links, however the body's frame is turned.

    share: of the path's size, by which alike ones differ.
    """
    kept: list[FoundLinkage] = []
    told: list[FloatArray] = []
    for each in found:
        batch = LinkageBatch.of([each.driver_first])
        z, arms = batch.dimensions[0], np.linalg.norm(batch.dimensions[0, :, 2:4], axis=-1)
        own = np.concatenate([z[:, :2].ravel(), z[:, 4], arms])
        if not any(np.abs(own - other).max() <= share * size for other in told):
            kept.append(each)
            told.append(own)
    return kept


def _outcome(
    task: Task, linkages: Sequence[FoundLinkage], path: TracedPath, size: float
) -> Outcome:
    points, usable = count(task.poses.shape[0], "point"), [e for e in linkages if e.usable]
    timed = " at their crank angles" if path.crank_angles is not None else ""
    if not usable:
        nearest = min(linkages, key=lambda each: each.combined_error)
        return Outcome(
            "R351",
            f"no usable linkage: {count(len(linkages), 'four-bar')} near {points}{timed}, none of "
            "which works",
            "give the limits more room, ask for less, or state a wider --pose-tolerance; of noisy "
            "points that lie closer than their noise, take fewer with --every, or --any-order",
            f"the nearest, {nearest.id}, {in_short(nearest, task, size)}",
        )
    nearest = min(usable, key=lambda each: each.error.worst)
    if nearest.error.worst <= EXACT * span(task):
        how = f"that {'passes' if len(usable) == 1 else 'pass'} {points}{timed}"
        if _are_few(task, path):
            how = f"of the infinitely many that pass {points}"
    else:
        how = (
            f"near {points}{timed}; the nearest, {nearest.id}, misses them by "
            f"{length_of(nearest.error.rms, task)} rms and {length_of(nearest.error.worst, task)} "
            "at most"
        )
    return Outcome("R350", f"{count(len(usable), 'usable four-bar')} {how}")


def _none(task: Task, options: SynthesisOptions, findings: Sequence[Advice]) -> Synthesis:
    """Nothing that traces the points at all."""
    problem = SynthesisProblem.of(task, None, options)
    timed = task.path is not None and task.path.crank_angles is not None
    more = "give more than five points, which may then be missed a little"
    help = more if timed else "give the limits more room"
    if not span(task) > 0:
        help = "give points that lead somewhere, in the order in which they are traced"
    outcome = Outcome("R351", _why_none(task), help)
    return Synthesis(problem, outcome, warnings=tuple(findings))


def _why_none(task: Task) -> str:
    points = count(task.poses.shape[0], "point")
    if not span(task) > 0:
        return f"no four-bar: the {points} are all the same, and no path"
    if task.path is not None and task.path.crank_angles is not None:
        return f"no four-bar traces {points} at these crank angles"
    return f"no four-bar was found near {points} within the limits"
