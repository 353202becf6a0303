"""Linkages near the points of a path: the nearest, such as transmit better, and within limits.

Without limits both come from the atlas and its descents (`curves`); with limits they are refined
again from those whose pivots and links have not far to go.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.curves.crank_linkages import CrankLinkages, linkages_of_five_points
from burmester.curves.path_fit import CurveFit, PathSearch
from burmester.fourbar.cognates import cognates
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import (
    FloatArray,
    complex_of,
    concatenate,
    even_numbers,
    pairs_of,
    take,
)
from burmester.points.point_sets import line_or_circle
from burmester.points.real_linkages import linkages_through
from burmester.progress import goes_on, step, time_for
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.defect_free_search import refined_on_branch
from burmester.refinement.kept_limits import DyadLimitsConstraint
from burmester.refinement.least_error import Refined
from burmester.refinement.target import Target
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import span
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.requirements import Requirements
from burmester.tasks.traced_path import LEAST_TIMED, TracedPath

NINE = 9

CURVES = 16  # different curves that are looked at; each with its other linkage that has a crank
LEVELS = (20.0, 30.0, 40.0, 50.0, 60.0)  # degrees; least transmission angles that are tried
RATIOS = (10.0, 5.0)  # of the longest link to the shortest, that are tried
NEAREST, STARTS = 4, 10  # number of nearest linkages, and of curves of the atlas, refined for each
LOWER = 10.0  # degrees; a start may transmit worse by so much
SANE_RATIO = 10.0  # longest link over shortest of a start from the atlas
STEPS, CHOICE, KEPT = 50, ((10, 8),), 3  # steps of each; after how many how many go on; kept of all
# Of the search within limits: starts by each weighting of how far pivots and links have to go,
# these weights, number of steps, and after how many of them how many go on.
LIMITED, OFF_WEIGHTS = 40, (0.003, 0.03, 0.3)
LIMITED_STEPS, LIMITED_CHOICE = 60, ((10, 30), (25, 12))
MANY, FEW = 200, 3  # points from which on judging takes long, and nearest curves judged then


class PathLinkages(NamedTuple):
    """Linkages (k,) of RR dyads, the crank first, with their places (k, N, 3)."""

    batch: LinkageBatch
    places: FloatArray

    def greatest_misses(self, points: FloatArray) -> FloatArray:
        """The greatest distance (k,) of a point (N, 2) from its place."""
        return np.asarray(np.linalg.norm(self.places[..., :2] - points, axis=-1).max(axis=-1))

    def keep(self, bounds: Requirements, *, turns: bool) -> NDArray[np.bool_]:
        """Which linkages (k,) keep bounds of the transmission angle and of the link ratio.

        With either driver.  turns: over the whole turn of the driver, else at the places.
        """
        kept = np.zeros(len(self.batch), dtype=bool)
        for each in (self.batch, self.batch.exchanged()):
            own, t = CrankLinkages.of(each, self.places)
            links = np.stack(own.lengths(), axis=-1)
            sane = links.max(axis=-1) <= bounds.link_ratio * links.min(axis=-1)
            least = own.least_transmission(None if turns else t)
            kept |= sane & ~(least < bounds.transmission)
        return kept


def linkages_near(task: Task, path: TracedPath, options: SynthesisOptions) -> PathLinkages:
    """Linkages near the points, or through them, and such as transmit better."""
    points, timed = task.poses.translation, path.crank_angles is not None
    if is_timed_exactly(task, path):
        assert path.crank_angles is not None
        return PathLinkages(*linkages_of_five_points(points, path.crank_angles))
    search = PathSearch.of(
        points,
        closed=path.closed,
        crank_angles=path.crank_angles,
        weights=task.weights,
        any_order=task.requirements.any_order,
    )
    starts: list[tuple[CrankLinkages, FloatArray]] = []
    asked = options.nine_point_starts and not (path.closed or timed)
    if asked and time_for("looking for linkages through nine of the points"):
        starts = nine_point_starts(points)
    most = CURVES if len(task.poses.angle) <= MANY else FEW
    found = _with_cognates(_of_fit(search.nearest(most, starts)))
    if timed:
        more = _transmitting(task, search) if time_for("looking for better transmission") else found
        return _joined([found, more])
    alike, wide = found, _without_tolerance(task, options)
    if task.limits:
        alike = _with_cognates(_of_fit(search.like_path()))
        found = _within_limits(wide, _joined([found, alike]))
    if len(found.batch) and time_for("looking for linkages that transmit better"):
        better = _better(wide, found, alike) if task.limits else [_transmitting(task, search)]
        found = _joined([found, *better])
    return found


def is_timed_exactly(task: Task, path: TracedPath) -> bool:
    """Whether linkages pass the points exactly at their crank angles."""
    return path.crank_angles is not None and len(task.poses.angle) == LEAST_TIMED


def _of_fit(fit: CurveFit) -> PathLinkages:
    return PathLinkages(fit.linkages.batch(), fit.linkages.rows(fit.t))


def _with_cognates(found: PathLinkages) -> PathLinkages:
    """The linkages, and behind them their cognates that are driven at the second fixed pivot."""
    if not len(found.batch):
        return found
    _, other = cognates(found.batch.linkage_of_all())
    beside = LinkageBatch.of_pins(Linkage(other.second, other.first))  # the crank first
    # The body of the cognate turns as the follower, and its angle is the follower's direction.
    follower = found.batch.dimensions[:, 1]
    body = Displacement(found.places[..., :2], found.places[..., 2])
    arm = body.act(follower[:, None, 2:4]) - follower[:, None, :2]
    angle = np.unwrap(np.arctan2(arm[..., 1], arm[..., 0]), axis=-1)
    places = np.concatenate([found.places[..., :2], angle[..., None]], axis=-1)
    z = beside.dimensions
    sound = np.isfinite(z).all(axis=(1, 2)) & (z[:, :, 4] > 0).all(axis=1)
    return _facing(concatenate([found, take(PathLinkages(beside, places), sound)]))


def _facing(found: PathLinkages) -> PathLinkages:
    """The same linkages, the body frame M of each turned so that its mean angle is zero.

    The angles of the points count for nothing, and stand as zero in the task: a refinement, which
    begins at the places nearest to it, would lose linkages whose bodies are turned far from that.
    """
    mean = found.places[..., 2].mean(axis=-1)
    turn = np.exp(1j * mean)[:, None]
    dimensions, places = found.batch.dimensions.copy(), found.places.copy()
    dimensions[:, :, 2:4] = pairs_of(complex_of(dimensions[:, :, 2:4]) * turn)
    places[..., 2] -= mean[:, None]
    return PathLinkages(LinkageBatch(found.batch.kinds, dimensions), places)


def _joined(parts: Sequence[PathLinkages]) -> PathLinkages:
    return concatenate([each for each in parts if len(each.batch)] or list(parts[:1]))


def _without_tolerance(task: Task, options: SynthesisOptions) -> Evaluation:
    """What linkages near the points are refined by: their distances alone, and limits."""
    wide = PoseTolerances.uniform(len(task.poses.angle), span(task), span(task), math.inf)
    problem = SynthesisProblem.of(replace(task, tolerances=wide), None, options)
    return Evaluation(problem, target_of(problem).relaxed)


def _within_limits(wide: Evaluation, found: PathLinkages) -> PathLinkages:
    """Linkages near the points within the limits, the nearest first."""
    step("refining linkages within the limits")
    target = wide.target
    if len(wide.task.limits) > 1:
        found = concatenate([found, PathLinkages(found.batch.exchanged(), found.places)])
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


def _transmitting(task: Task, search: PathSearch) -> PathLinkages:
    """Linkages that transmit better and better, and are sanely built, as near as each can be."""
    most = KEPT if len(task.poses.angle) <= MANY else 1
    asked = task.requirements.link_ratio
    ratios = (asked,) if math.isfinite(asked) else RATIOS
    return _with_cognates(
        _of_fit(search.transmitting_well(_levels(task), ratios=ratios, most=most))
    )


def _levels(task: Task) -> list[float]:
    """The least transmission angles that are tried, in degrees."""
    asked = task.requirements.transmission_deg
    return sorted({max(asked, each) for each in LEVELS})


def _better(wide: Evaluation, found: PathLinkages, alike: PathLinkages) -> list[PathLinkages]:
    """The same within limits.

    For each least transmission angle the nearest linkages and curves of the atlas whose linkages
    transmit well are refined under it, driven by their cranks.
    """
    target, task = wide.target, wide.task
    asked = task.requirements
    closed = task.path is not None and task.path.closed
    required = asked.with_standard()
    if closed and asked.types is None:
        required = replace(required, types=frozenset({"crank-rocker", "double-crank"}))
    starts = _judged_starts(target, alike, closed=closed)
    if len(task.limits) > 1:
        turned = starts._replace(batch=starts.batch.exchanged(), lead=1 - starts.lead)
        starts = concatenate([starts, turned])
    near = _judged_starts(target, take(found, slice(0, NEAREST)), closed=closed)
    out: list[PathLinkages] = []
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


def _judged_starts(target: Target, found: PathLinkages, *, closed: bool) -> _Starts:
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


def _rows(target: Target, found: PathLinkages) -> FloatArray:
    return target.rows_at(Displacement(found.places[..., :2], found.places[..., 2]))


def _refined(target: Target, refined: Refined) -> PathLinkages:
    """The linkages of a refinement that keep to their constraints, the nearest first."""
    index = np.flatnonzero(refined.met)
    index = index[np.argsort(refined.cost[index], kind="stable")]
    there = target.frames.from_canonical(target.places_of(refined.rows[index]))
    rows = np.concatenate([there.translation, there.angle[..., None]], axis=-1)
    return PathLinkages(refined.batch[index].from_canonical(target.frames), rows)


def nine_point_starts(points: FloatArray) -> list[tuple[CrankLinkages, FloatArray]]:
    """Linkages (k,) through nine of points (N, 2), evenly chosen, and crank angles (k, N) at all.

    By each of their dyads as the crank.  None where nine points lie on a line or a circle.
    """
    index = even_numbers(len(points), NINE)
    nine = points[index]
    if len(nine) < NINE or line_or_circle(nine) is not None:
        return []
    found = linkages_through(Displacement(nine, np.zeros(NINE)), np.ones(NINE, dtype=bool))
    out = []
    for batch in (found.batch, found.batch.exchanged()):
        linkages, t = CrankLinkages.of(batch, found.places)
        steps = np.diff(t, axis=1)
        one_way = (steps > 0).all(axis=1) | (steps < 0).all(axis=1)
        every = [np.interp(np.arange(len(points)), index, row) for row in t[one_way]]
        out.append((linkages[one_way], np.reshape(every, (int(one_way.sum()), len(points)))))
    return out
