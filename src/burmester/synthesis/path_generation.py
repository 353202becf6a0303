"""Path generation by approximation: the linkages that come nearest to many points, and good ones.

The nearest ones say how near one can come.  Where the task states no tolerance, a multiple of the
least worst distance is assumed, and told; within it quality chooses, as it does for poses with
tolerances: the linkages are refined again under ever greater transmission angles.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.curves.crank_linkages import CrankLinkages
from burmester.curves.curve_descent import CurveFit
from burmester.curves.nine_point_starts import nine_point_starts
from burmester.curves.path_fit import PathSearch
from burmester.curves.timed_paths import linkages_of_five_points
from burmester.dyads.selection import FoundDyad
from burmester.errors import Advice
from burmester.fourbar.cognates import cognates
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import FloatArray, complex_of, pairs_of
from burmester.numerics.bundles import concatenate, take
from burmester.progress import goes_on, step, time_for
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.defect_free_search import refined_on_branch
from burmester.refinement.kept_limits import DyadLimitsConstraint
from burmester.refinement.least_error import Refined
from burmester.refinement.target import Target
from burmester.synthesis.outcome import linkage_advice
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.traced_path import LEAST_TIMED, TracedPath
from burmester.verdicts.explanation import in_short
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.verdicts.ranking import ranked
from burmester.verdicts.standard import Standard
from burmester.wording import count

__all__ = ["near_points", "with_tolerance"]

ASSUMED_RATIO = 2.0  # of the assumed tolerance to the worst distance of the nearest linkage
LEAST_ASSUMED = 1e-4  # spans of the path; a smaller tolerance is not assumed
CURVES = 16  # different curves that are looked at; each with its other linkage that has a crank
LEVELS = (15.0, 22.0, 30.0, 40.0, 50.0, 60.0)  # degrees; least transmission angles that are tried
NEAREST, STARTS = 4, 10  # number of nearest linkages, and of curves of the atlas, refined for each
LOWER = 10.0  # degrees; a start may transmit worse by so much
SANE_RATIO = 10.0  # longest link over shortest of a start from the atlas
STEPS, CHOICE, KEPT = 50, ((10, 8),), 3  # steps of each; after how many how many go on; kept of all
# Of the search within limits: starts by each weighting of how far pivots and links have to go,
# these weights, number of steps, and after how many of them how many go on.
LIMITED, OFF_WEIGHTS = 40, (0.003, 0.03, 0.3)
LIMITED_STEPS, LIMITED_CHOICE = 60, ((10, 30), (25, 12))
MOST_TOLD = 12  # linkages that are told
ALIKE_ERROR, ALIKE_ANGLE = 0.01, math.radians(0.5)  # of the greatest error; radians; no difference
SAME = 0.01  # spans of the path; linkages whose pivots and links differ by less are listed once
EXACT = 1e-7  # spans of the path; points that are missed by less are met
MANY, FEW = 200, 3  # points from which on judging takes long, and nearest curves judged then
LEAST_DIFFERENT = 3  # points that make a path
FAR = 20.0  # spans of the path; a linkage of five timed points with a longer link is left out


class _Found(NamedTuple):
    """Linkages (k,) of RR dyads, the crank first, with their places (k, N, 3)."""

    batch: LinkageBatch
    places: FloatArray


def near_points(
    task: Task, options: SynthesisOptions, findings: Sequence[Advice] = ()
) -> Synthesis:
    """The linkages whose coupler point traces the points of a task, or comes nearest to them.

    The task's positions are the points; its angles are free and count for nothing.  Its `path` says
    whether it is closed and how the crank times it.
    """
    task = _once(task)
    path = task.path or TracedPath()
    step(f"looking at {count(len(task.poses.angle), 'point')}")
    if not span(task) > 0:
        return _none(task, options, findings)
    found = _linkages(task, path, options)
    if not len(found.batch):
        return _none(task, options, findings)
    given, note = _with_tolerance(task, found, path)
    problem = SynthesisProblem.of(given, None, options)  # the angles say nothing of a motion
    evaluation = Evaluation(problem, target_of(problem))
    judged = _judged(evaluation, found)
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
    task = _once(task)
    path = task.path or TracedPath()
    if _stated(task, path) is None and span(task) > 0:
        found = _linkages(task, path, options)
        if len(found.batch):
            return _with_tolerance(task, found, path)
    position = _stated(task, path)
    if position is None:
        position = np.full((len(task.poses.angle), 2), LEAST_ASSUMED * span(task))
    return replace(task, tolerances=_of_points(position)), []


def _linkages(task: Task, path: TracedPath, options: SynthesisOptions) -> _Found:
    """Linkages near the points, or through them, and such as transmit better."""
    points, timed = task.poses.translation, path.crank_angles is not None
    if _is_exact(task, path):
        return _timed_exactly(points, path)
    search = PathSearch.of(
        points, closed=path.closed, crank_angles=path.crank_angles, weights=task.weights
    )
    starts: list[tuple[CrankLinkages, FloatArray]] = []
    asked = options.nine_point_starts and not (path.closed or timed)
    if asked and time_for("looking for linkages through nine of the points"):
        starts = nine_point_starts(points)
    found = _nearest(task, search, starts)
    if timed:
        return found
    alike, wide = found, _without_tolerance(task, options)
    if task.limits:
        alike = _with_cognates(_of_fit(search.like_path()))
        found = _within_limits(wide, _joined([found, alike]))
    if len(found.batch) and time_for("looking for linkages that transmit better"):
        better = _better(wide, found, alike) if task.limits else [_transmitting(task, search)]
        found = _joined([found, *better])
    return found


def _is_exact(task: Task, path: TracedPath) -> bool:
    """Whether linkages pass the points exactly at their crank angles."""
    return path.crank_angles is not None and len(task.poses.angle) == LEAST_TIMED


def _once(task: Task) -> Task:
    """The task without points that repeat the one before, whose weights add up.

    Points with crank angles stay: a crank may turn while the point rests.
    """
    points = task.poses.translation
    new = np.concatenate([[True], (np.diff(points, axis=0) != 0).any(axis=1)])
    timed = task.path is not None and task.path.crank_angles is not None
    if new.all() or timed or new.sum() < LEAST_DIFFERENT:
        return task
    index, group = np.flatnonzero(new), np.cumsum(new) - 1
    weights = np.ones(len(points)) if task.weights is None else task.weights
    return replace(
        task,
        poses=task.poses[index],
        weights=np.asarray(np.bincount(group, weights=weights), dtype=np.float64),
        names=None if task.names is None else tuple(task.names[k] for k in index.tolist()),
        exact=None,
        tolerances=None if task.tolerances is None else task.tolerances.at(index),
        path=task.path or TracedPath(),
    )


def _nearest(
    task: Task, search: PathSearch, starts: Sequence[tuple[CrankLinkages, FloatArray]]
) -> _Found:
    """The nearest linkages, and the cognates of them that have a crank as well."""
    most = CURVES if len(task.poses.angle) <= MANY else FEW
    return _with_cognates(_of_fit(search.nearest(most, starts)))


def _of_fit(fit: CurveFit) -> _Found:
    return _Found(fit.linkages.batch(), fit.linkages.rows(fit.t))


def _timed_exactly(points: FloatArray, path: TracedPath) -> _Found:
    """All linkages of five timed points but those with endless links."""
    assert path.crank_angles is not None
    batch, places = linkages_of_five_points(points, path.crank_angles)
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    sane = batch.dimensions[:, :, 4].max(axis=-1, initial=0.0) < FAR * size
    return _Found(batch[sane], places[sane])


def _with_cognates(found: _Found) -> _Found:
    """The linkages, and behind them their cognates with the second fixed pivot.

    Of these the new link at the third pivot turns as the crank does.
    """
    if not len(found.batch):
        return found
    _, other = cognates(found.batch.linkage_of_all())
    one, two = other.second, other.first  # the crank first
    assert isinstance(one, RR)
    assert isinstance(two, RR)
    dimensions = np.stack(
        [
            np.concatenate([each.fixed_pivot, each.moving_pivot, each.radius[:, None]], axis=-1)
            for each in (one, two)
        ],
        axis=1,
    )
    # The body of the cognate turns as the follower, and its angle is the follower's direction.
    follower = found.batch.dimensions[:, 1]
    body = Displacement(found.places[..., :2], found.places[..., 2])
    arm = body.act(follower[:, None, 2:4]) - follower[:, None, :2]
    angle = np.unwrap(np.arctan2(arm[..., 1], arm[..., 0]), axis=-1)
    places = np.concatenate([found.places[..., :2], angle[..., None]], axis=-1)
    sound = np.isfinite(dimensions).all(axis=(1, 2)) & (dimensions[:, :, 4] > 0).all(axis=1)
    more = _Found(LinkageBatch(found.batch.kinds, dimensions), places)
    return _facing(concatenate([found, _Found(more.batch[sound], more.places[sound])]))


def _facing(found: _Found) -> _Found:
    """The same linkages, the body frame M of each turned so that its mean angle is zero.

    The angles of the points count for nothing, and stand as zero in the task: a refinement, which
    begins at the places nearest to it, would lose linkages whose bodies are turned far from that.
    """
    mean = found.places[..., 2].mean(axis=-1)
    turn = np.exp(1j * mean)[:, None]
    dimensions, places = found.batch.dimensions.copy(), found.places.copy()
    dimensions[:, :, 2:4] = pairs_of(complex_of(dimensions[:, :, 2:4]) * turn)
    places[..., 2] -= mean[:, None]
    return _Found(LinkageBatch(found.batch.kinds, dimensions), places)


def _joined(parts: Sequence[_Found]) -> _Found:
    return concatenate([each for each in parts if len(each.batch)] or list(parts[:1]))


def _without_tolerance(task: Task, options: SynthesisOptions) -> Evaluation:
    """What linkages near the points are refined by: their distances alone, and limits."""
    wide = PoseTolerances.uniform(len(task.poses.angle), span(task), span(task), math.inf)
    problem = SynthesisProblem.of(replace(task, tolerances=wide), None, options)
    return Evaluation(problem, target_of(problem).relaxed)


def _within_limits(wide: Evaluation, found: _Found) -> _Found:
    """Linkages near the points with their pivots and links within the limits, the nearest first.

    Refined from those first whose pivots and links have not far to go.
    """
    step("refining linkages within the limits")
    target = wide.target
    if len(wide.task.limits) > 1:
        found = concatenate([found, _Found(found.batch.exchanged(), found.places)])
    batch, rows = found.batch.to_canonical(target.frames), _rows(target, found)
    bounds = AllConstraints(tuple(e for e in target.kept if isinstance(e, DyadLimitsConstraint)))
    value, equal = bounds(batch, rows, np.arange(len(batch)))
    off = (np.where(equal, np.abs(value), np.maximum(value, 0.0)) ** 2).sum(axis=1)
    near = target.cost(rows) / rows.shape[1]
    some = np.unique(
        np.concatenate([np.argsort(near + w * off, kind="stable")[:LIMITED] for w in OFF_WEIGHTS])
    )
    refined = target.refine(
        batch[some],
        rows[some],
        constraints=AllConstraints(target.kept),
        constrained_steps=LIMITED_STEPS,
        selection=LIMITED_CHOICE,
    )
    return _refined(target, refined)


def _transmitting(task: Task, search: PathSearch) -> _Found:
    """Linkages that transmit better and better, and are sanely built, as near as each can be."""
    asked = Standard.of(task).requirements(task.requirements)
    most = KEPT if len(task.poses.angle) <= MANY else 1
    fit = search.transmitting_well(_levels(task), ratio=asked.link_ratio, most=most)
    return _with_cognates(_of_fit(fit))


def _levels(task: Task) -> list[float]:
    """The least transmission angles that are tried, in degrees."""
    asked = task.requirements.transmission_deg
    return sorted({max(asked, each) for each in LEVELS})


def _better(wide: Evaluation, found: _Found, alike: _Found) -> list[_Found]:
    """The same within limits.

    For each least transmission angle the nearest linkages and curves of the atlas whose linkages
    transmit well are refined under it, driven by their cranks.
    """
    target, task = wide.target, wide.task
    asked = task.requirements
    closed = task.path is not None and task.path.closed
    required = Standard.of(task).requirements(asked)
    if closed and asked.types is None:
        required = replace(required, types=frozenset({"crank-rocker", "double-crank"}))
    starts = _judged_starts(target, alike, closed=closed)
    if len(task.limits) > 1:
        turned = starts._replace(batch=starts.batch.exchanged(), lead=1 - starts.lead)
        starts = concatenate([starts, turned])
    near = _judged_starts(target, take(found, slice(0, NEAREST)), closed=closed)
    out: list[_Found] = []
    levels = _levels(task)
    for number, level in enumerate(levels, start=1):
        if not goes_on(number, len(levels), "transmission angle", has_steps=True):
            break
        cost = np.where(starts.transmission > level - LOWER, starts.cost, np.inf)
        some = concatenate([near, take(starts, np.argsort(cost, kind="stable")[:STARTS])])
        now = replace(target, requirements=replace(required, transmission_deg=level))
        refined = refined_on_branch(
            some.batch, some.rows, now, some.lead, steps=STEPS, selection=CHOICE
        )
        new = take(_refined(target, refined), slice(0, KEPT))
        if len(new.batch):
            out.append(new)
            near = _judged_starts(target, new, closed=closed)
    return out


class _Starts(NamedTuple):
    """Linkages (k,) with places as rows (k, N, 3), in the frames of a target.

    lead: (k,), the side of the crank; transmission: (k,), the least angle in degrees; cost: (k,),
    infinite for those that are not sanely built.
    """

    batch: LinkageBatch
    rows: FloatArray
    lead: NDArray[np.intp]
    transmission: FloatArray
    cost: FloatArray


def _judged_starts(target: Target, found: _Found, *, closed: bool) -> _Starts:
    batch, rows = found.batch.to_canonical(target.frames), _rows(target, found)
    places = target.places_of(rows)
    own, t = CrankLinkages.of(
        batch, np.concatenate([places.translation, places.angle[..., None]], axis=-1)
    )
    links = np.stack(own.lengths(), axis=-1)
    sane = links.max(axis=-1) <= SANE_RATIO * links.min(axis=-1)
    return _Starts(
        batch,
        rows,
        np.where(own.turns_fully() | ~closed, 0, 1).astype(np.intp),
        np.degrees(own.least_transmission(None if closed else t)),
        np.where(sane, target.cost(rows), np.inf),
    )


def _rows(target: Target, found: _Found) -> FloatArray:
    return target.rows_at(Displacement(found.places[..., :2], found.places[..., 2]))


def _refined(target: Target, refined: Refined) -> _Found:
    """The linkages of a refinement that keep to their constraints, the nearest first."""
    index = np.flatnonzero(refined.met)
    index = index[np.argsort(refined.cost[index], kind="stable")]
    there = target.frames.from_canonical(target.places_of(refined.rows[index]))
    rows = np.concatenate([there.translation, there.angle[..., None]], axis=-1)
    return _Found(refined.batch[index].from_canonical(target.frames), rows)


def _with_tolerance(task: Task, found: _Found, path: TracedPath) -> tuple[Task, list[Advice]]:
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
    return np.zeros((len(task.poses.angle), 2)) if _is_exact(task, path) else None


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


def _judged(evaluation: Evaluation, found: _Found) -> list[FoundLinkage]:
    """The linkages with errors and verdicts, in the order of `ranking`.

    Those that cannot be inside the tolerances only where no other is usable: told they are not.
    """
    step(f"judging {count(len(found.batch), 'linkage')}")
    near = _may_be_inside(evaluation.task, found)
    judged = _members(evaluation, found, np.flatnonzero(near))
    if not any(each.usable for each in judged):
        judged += _members(evaluation, found, np.flatnonzero(~near))
    judged = ranked(judged, evaluation.problem)
    return _front(_different(judged, SAME, span(evaluation.task)))


def _may_be_inside(task: Task, found: _Found) -> NDArray[np.bool_]:
    """Which linkages (k,) may have places inside the tolerances of all points.

    Their places are nearest to the points, and what is inside is no farther than the corners.
    """
    assert task.tolerances is not None
    away = np.linalg.norm(found.places[..., :2] - task.poses.translation, axis=-1)
    corner = np.linalg.norm(task.tolerances.position, axis=-1)
    return np.asarray((away <= corner + EXACT * span(task)).all(axis=-1))


def _members(evaluation: Evaluation, found: _Found, index: NDArray[np.intp]) -> list[FoundLinkage]:
    """Some of the linkages, judged."""
    if not len(index):
        return []
    target, some = evaluation.target, take(found, index)
    places = Displacement(some.places[..., :2], some.places[..., 2])
    pairs = [_numbered(found.batch, k, evaluation.task) for k in index.tolist()]
    candidates = Candidates(
        some.batch.to_canonical(target.frames),
        target.rows_at(places),
        pairs,
        np.ones(len(pairs), dtype=bool),
        some.batch,
    )
    return evaluation.members(candidates)


def _numbered(batch: LinkageBatch, k: int, task: Task) -> Pair:
    """The dyads of a linkage, numbered by it."""
    linkage, out = batch.linkage(k), []
    for side, dyad in enumerate((linkage.first, linkage.second), start=1):
        miss = np.abs(dyad.residual(task.poses))
        rms, worst = float(np.sqrt((miss**2).mean())), float(miss.max())
        out.append(FoundDyad(f"D{2 * k + side}", dyad, rms, worst))
    return out[0], out[1]


def _front(found: Sequence[FoundLinkage]) -> list[FoundLinkage]:
    """The usable linkages that no other one beats in distance, transmission and extent at once.

    In their order, MOST_TOLD of them at most, the nearest one among these; where none is usable,
    all of them.
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
    slack = np.array([ALIKE_ERROR * figures[:, 0].max(), ALIKE_ANGLE, 0.0])
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
