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

from burmester.cures import Help
from burmester.errors import Advice
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.bearing_linkages import bearing_linkages
from burmester.linkages.evaluation import Candidates, Evaluation, with_own_dyads
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import FloatArray, take
from burmester.progress import step
from burmester.requirements.poses import ANY_ORDER, WITHIN
from burmester.requirements.requirement import above
from burmester.synthesis.outcome import linkage_advice
from burmester.synthesis.path_linkages import PathLinkages, is_timed_exactly, linkages_near
from burmester.synthesis.point_approximation import ASSUMED_RATIO, LEAST_ASSUMED
from burmester.synthesis.point_conditions import special_curve
from burmester.synthesis.point_generation import is_traced_by_crank, missed_on_curve, none_on_curve
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.motion_task import MOST_POINTS, Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_sample import PoseSample
from burmester.tasks.pose_tolerances import PoseTolerances, tolerance_cure
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.requirements import Requirements
from burmester.tasks.traced_path import TracedPath
from burmester.verdicts.explanation import hints, in_short
from burmester.verdicts.found_linkage import FoundLinkage, numbered_pair
from burmester.verdicts.ranking import (
    DEFAULT_TOLERANCE,
    ERROR_RATIO,
    closest_usable,
    only_too_far,
    ranked,
)
from burmester.verdicts.tracing import MET, Tracing, nearest_both_ways, price_list, strays
from burmester.wording import count, figure

# A sound linkage sets it if it misses by no more than that share of the path's span, or by no more
# than ERROR_RATIO times as much as the nearest one; never by more than DEFAULT_TOLERANCE.
SOUND_SHARE = 0.03
GROWTH, MOST_TRIED = 1.5, 4  # from tolerance to tolerance under which linkages are judged; of them
MOST_JUDGED = 2000  # points; of more a sample says which linkages are judged at all of them
MOST_TOLD, FEW_TOLD = 12, 6  # linkages that are told, and of MOST_JUDGED points
ALIKE_ERROR, ALIKE_ANGLE = 0.01, math.radians(0.5)  # of the greatest error; radians; no difference
SAME = 0.01  # spans of the path; linkages whose pivots and links differ by less are listed once
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
    given, judged, note = _judged(task, found, path, options)
    problem = SynthesisProblem.of(given, None, options)  # the angles say nothing of a motion
    evaluation = Evaluation(problem, target_of(problem))
    if more := bearing_linkages(judged, evaluation):
        judged = ranked([*judged, *more], problem)
    if options.rounds:
        judged = evaluation.rounded(judged)
    judged = evaluation.with_spreads(judged)
    linkages = tuple(with_own_dyads(judged))
    outcome = _outcome(given, linkages, path, problem)
    warnings = (*findings, *note, *linkage_advice(given, linkages, outcome.code))
    dyads = tuple(dyad for each in linkages for dyad in each.dyads)
    return Synthesis(problem, outcome, dyads, linkages, warnings)


def with_tolerance(task: Task, options: SynthesisOptions) -> tuple[Task, list[Advice]]:
    """A path as its linkages are judged: with a tolerance, stated or assumed, and what is said.

    Where none is stated, the nearest linkages are looked for, as they say what is assumed.
    """
    path = task.path or TracedPath()
    position = _stated(task, path)
    if position is None and span(task) > 0:
        found = linkages_near(task, path, options)
        if len(found.batch):
            given, _, note = _judged(task, found, path, options)
            return given, note
    if position is None:
        position = np.full((len(task.poses.angle), 2), LEAST_ASSUMED * span(task))
    return replace(task, tolerances=_of_points(position)), []


def _judged(
    task: Task, found: PathLinkages, path: TracedPath, options: SynthesisOptions
) -> tuple[Task, list[FoundLinkage], list[Advice]]:
    """The task with its tolerance, linkages judged by it, and what is said where it is assumed.

    Where none is stated, ASSUMED_RATIO times what the nearest linkage misses that is sound when
    judged so; without any that is near enough, the nearest that works; without any, the nearest.
    The angles of the task are those of the nearest linkage, to draw the body with; they are free.
    """
    poses = Displacement(task.poses.translation, found.places[0, :, 2])
    task, known = replace(task, poses=poses), None
    if len(task.poses.angle) > MOST_JUDGED:
        found, known = _by_sample(task, found, path, options)
    given, told, base = _in_tolerance(task, found, path, options, known)
    return given, told, [] if _stated(task, path) is not None else [_assumed(given, told, base)]


def _in_tolerance(
    task: Task,
    found: PathLinkages,
    path: TracedPath,
    options: SynthesisOptions,
    known: int | None = None,
) -> tuple[Task, list[FoundLinkage], FoundLinkage | None]:
    """The task with its tolerance, linkages told by it, the one (numbered `known`) that sets it."""
    if (stated := _stated(task, path)) is not None:
        given = replace(task, tolerances=_of_points(stated))
        return given, _told(_evaluated(given, found, options), given), None
    by_known = None if known is None else _by_one(known, task, found, options)
    given, judged, base = by_known or _by_nearest(task, found, path, options)
    return given, _told(judged, given), base


def _by_one(
    number: int, task: Task, found: PathLinkages, options: SynthesisOptions
) -> tuple[Task, list[FoundLinkage], FoundLinkage] | None:
    """The task with a tolerance by the linkage of a number, all judged by it, that one; or None."""
    away = float(found.greatest_misses(task.poses.translation)[number])
    given, judged = _within(away, task, found, options)
    base = next((each for each in judged if each.usable and _number(each) == number), None)
    return None if base is None else (given, judged, base)


def _by_nearest(
    task: Task, found: PathLinkages, path: TracedPath, options: SynthesisOptions
) -> tuple[Task, list[FoundLinkage], FoundLinkage | None]:
    """The task with a tolerance by a linkage, all linkages judged by it, and that linkage.

    None where no linkage works; the tolerance is then that of the nearest sound one but for what is
    asked, so that the answer can say what would do.
    """
    asked, nothing = task.requirements, Requirements()
    usual = nothing.with_standard()
    wanted, away = (
        asked.with_standard(),
        found.greatest_misses(task.poses.translation),
    )
    most = max(ERROR_RATIO * float(away.min()), SOUND_SHARE * span(task))
    near = away <= min(most, DEFAULT_TOLERANCE * span(task))
    kept = [found.keep(each, turns=path.closed) for each in (wanted, asked, usual)]
    for demanding, some in ((True, kept[0] & near), (False, kept[1])):
        for miss in _growing(away[some]):
            given, judged = _within(miss, task, found, options)
            base = closest_usable(e for e in judged if not (demanding and e.shortcomings))
            if base is None:
                continue
            if base.error.worst > GROWTH * miss:  # another one, or far from where it was found
                given, judged = _within(base.error.worst, task, found, options)
            return given, judged, base
    some = kept[2] & near
    return *_within(float(away[some if some.any() else ...].min()), task, found, options), None


def _growing(misses: FloatArray) -> list[float]:
    """The least of the misses and some of the others, each by a share greater than the last."""
    out: list[float] = []
    for each in np.sort(misses).tolist():
        if not out or each > GROWTH * out[-1]:
            out.append(each)
    return out[:MOST_TRIED]


def _within(
    miss: float, task: Task, found: PathLinkages, options: SynthesisOptions
) -> tuple[Task, list[FoundLinkage]]:
    """The task with the tolerance that such a miss makes, and the linkages judged by it."""
    assumed = max(ASSUMED_RATIO * miss, LEAST_ASSUMED * span(task))
    position = np.full((len(task.poses.angle), 2), float(f"{assumed:.2g}"))
    given = replace(task, tolerances=_of_points(position))
    return given, _evaluated(given, found, options)


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


def _assumed(given: Task, judged: Sequence[FoundLinkage], base: FoundLinkage | None) -> Advice:
    """What is said of a tolerance that is assumed from a linkage, and of the nearest (`base`)."""
    assert given.tolerances is not None
    assumed = float(given.tolerances.position.max())
    nearest = closest_usable(judged) or min(judged, key=lambda each: each.error.worst)
    why = f"the nearest linkage misses them by {length_of(nearest.error.worst, given)} at most"
    least = nearest.error.worst if base is None else base.error.worst
    if (farther := length_of(least, given)) != length_of(nearest.error.worst, given):
        why += f", and is not sound; the nearest sound one by {farther}"
    if ASSUMED_RATIO * least < LEAST_ASSUMED * span(given):
        why += f"; at least {length_of(assumed, given)}, a ten-thousandth of their span, is assumed"
    elif base is not None:
        times = figure(assumed / least)
        why += f", and within {times} times that the one that transmits best is chosen"
    help = "say how far the points may be missed"
    if base is None:
        help += ", once a linkage keeps what is asked"
    else:
        help = Help.of("{}: {}", help, tolerance_cure(assumed, assumed, math.inf))
    what = f"a tolerance of {length_of(assumed, given)} was assumed for x and y of every point"
    return Advice("W226", what, help, why)


def _evaluated(task: Task, found: PathLinkages, options: SynthesisOptions) -> list[FoundLinkage]:
    """The linkages with verdicts in the order of `ranking`; those surely outside only if needed."""
    step(f"judging {count(len(found.batch), 'linkage')}")
    problem = SynthesisProblem.of(task, None, options)
    evaluation = Evaluation(problem, target_of(problem))
    near = _may_be_inside(task, found)
    judged = _members(evaluation, found, np.flatnonzero(near))
    if not any(each.usable for each in judged):
        judged += _members(evaluation, found, np.flatnonzero(~near))
    judged = ranked(judged, problem)
    if not any(each.usable for each in judged):
        judged = nearest_both_ways(judged, task)
    return judged


def _by_sample(
    task: Task, found: PathLinkages, path: TracedPath, options: SynthesisOptions
) -> tuple[PathLinkages, int | None]:
    """Of linkages near many points those worth judging, and which sets the tolerance."""
    sample = PoseSample.of_task(task, MOST_JUDGED)
    there = found._replace(places=found.places[:, sample.index])
    part = task.at(sample.index, sample.cells)
    _, judged, base = _in_tolerance(part, there, path, options)
    if not any(each.usable for each in judged):
        return found, None
    index = [_number(each) for each in judged]
    known = None if base is None or base not in judged else judged.index(base)
    return take(found, np.array(index, dtype=np.intp)), known


def _may_be_inside(task: Task, found: PathLinkages) -> NDArray[np.bool_]:
    """Which linkages (k,) may have places inside the tolerances of all points."""
    assert task.tolerances is not None
    away = np.linalg.norm(found.places[..., :2] - task.poses.translation, axis=-1)
    corner = np.linalg.norm(task.tolerances.position, axis=-1)
    return np.asarray((away <= corner + MET * span(task)).all(axis=-1))


def _members(
    evaluation: Evaluation, found: PathLinkages, index: NDArray[np.intp]
) -> list[FoundLinkage]:
    """Some of the linkages, judged."""
    if not len(index):
        return []
    target, some = evaluation.target, take(found, index)
    places = Displacement(some.places[..., :2], some.places[..., 2])
    pairs = [numbered_pair(found.batch.linkage(k), 2 * k + 1) for k in index.tolist()]
    batch, rows = some.batch.to_canonical(target.frames), target.rows_at(places)
    return evaluation.members(Candidates(batch, rows, pairs, True, some.batch))


def _number(found: FoundLinkage) -> int:
    """The place of a linkage among those that are judged: `_members` numbers its dyads by it."""
    return (int(found.dyads[0].id[1:]) - 1) // 2


def _told(judged: Sequence[FoundLinkage], task: Task) -> list[FoundLinkage]:
    """What is listed of judged linkages: each once, and of those that are many the front."""
    apart = different(judged, SAME * span(task))
    if is_timed_exactly(task, task.path or TracedPath()):
        return apart  # they are few: all that there are
    return _front(apart, task)


def _front(found: Sequence[FoundLinkage], task: Task) -> list[FoundLinkage]:
    """The usable linkages that no other one beats in distance, transmission and extent at once.

    In their order, MOST_TOLD or FEW_TOLD of them at most, those of the price list among these, and
    the one with the least root mean square.
    Where none is usable, the nearest, and those that lack least.
    """
    usable = [each for each in found if each.usable and each.quality is not None]
    most = MOST_TOLD if len(task.poses.angle) < MOST_JUDGED else FEW_TOLD
    if not usable:
        nearest = list(found)[: most // 2]  # and those that lack least
        far = _nearest_too_far(found)
        others = sorted(
            found[len(nearest) :],
            key=lambda each: (each is not far, bool(each.defects), len(each.violations)),
        )
        return [*nearest, *others[: most - len(nearest)]]
    figures = np.array(
        [
            (each.combined_error, -each.driven.least_over_range, each.quality.extent)
            for each in usable
            if each.quality is not None
        ]
    )
    error = max(ALIKE_ERROR * figures[:, 0].max(), MET * span(task))
    slack = np.array([error, ALIKE_ANGLE, ROUNDING * figures[:, 2].max()])
    beaten = (figures[:, None] > figures[None] - slack).all(axis=-1) & (
        figures[:, None] > figures[None] + slack
    ).any(axis=-1)
    priced = [each.found for each in price_list(usable, task)]
    if (squares := min(usable, key=lambda each: each.error.rms)) not in priced:
        priced.append(squares)
    best = [e for k, e in enumerate(usable) if e not in priced and not beaten[k].any()]
    told = [*priced, *best[: max(most - len(priced), 0)]]
    return [each for each in usable if each in told]


def different(found: Sequence[FoundLinkage], least: float) -> list[FoundLinkage]:
    """The first of linkages that are alike: pivots and links, however the body's frame is turned.

    The nearest one that works stays.  least: length by which alike ones differ.
    """
    nearest = closest_usable(found)
    kept: list[FoundLinkage] = []
    told: list[FloatArray] = []
    for each in sorted(found, key=lambda one: one is not nearest):
        batch = LinkageBatch.of([each.driver_first])
        z, arms = batch.dimensions[0], np.linalg.norm(batch.dimensions[0, :, 2:4], axis=-1)
        own = np.concatenate([z[:, :2].ravel(), z[:, 4], arms])
        if not any(np.abs(own - other).max() <= least for other in told):
            kept.append(each)
            told.append(own)
    return [each for each in found if each in kept]


def _outcome(
    task: Task, linkages: Sequence[FoundLinkage], path: TracedPath, problem: SynthesisProblem
) -> Outcome:
    points, usable = count(task.poses.shape[0], "point"), [e for e in linkages if e.usable]
    timed = " at their crank angles" if path.crank_angles is not None else ""
    if not usable and all(map(strays, linkages)):
        return _all_stray(task, linkages)
    if not usable:
        nearest = min(linkages, key=lambda each: (strays(each), each.combined_error))
        return Outcome(
            "R351",
            f"no usable linkage: {count(len(linkages), 'four-bar')} near {points}{timed}, none of "
            "which works",
            _what_would_do(linkages, problem),
            f"the nearest, {nearest.id}, {in_short(nearest, task, problem.length)}",
        )
    nearest = price_list(usable, task)[0].found
    if nearest.error.worst <= MET * span(task):
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


def _what_would_do(linkages: Sequence[FoundLinkage], problem: SynthesisProblem) -> str:
    """What to change where no linkage of a path works."""
    texts = [text] if (text := hints(linkages, problem)).cures else []
    if (far := _nearest_too_far(linkages)) is not None:
        room = float(above(far.error.worst))
        within = problem.given.requirements.within is not None
        cure = WITHIN.given(room) if within else tolerance_cure(room, room, math.inf)
        texts.append(Help.of(f"with {{}} {far.id} would do", cure))
    return Help.joined("; or ", texts) or (
        "give the limits more room, ask for less, or state a wider --pose-tolerance; of noisy "
        "points that lie closer than their noise, take fewer with --every, or --any-order"
    )


def _nearest_too_far(linkages: Sequence[FoundLinkage]) -> FoundLinkage | None:
    """The nearest linkage that would work if the points might be missed by more."""
    return min(filter(only_too_far, linkages), key=lambda each: each.combined_error, default=None)


def _all_stray(task: Task, linkages: Sequence[FoundLinkage]) -> Outcome:
    """R352, with the linkage that is nearest both ways, which comes first."""
    nearest, points = linkages[0], count(task.poses.shape[0], "point")
    traced = Tracing.of(nearest, task)
    away = length_of(nearest.error.worst, task)
    left = "" if traced is None else f" and leaves the path by {length_of(traced.to_path[1], task)}"
    return Outcome(
        "R352",
        f"no usable linkage: each of {count(len(linkages), 'four-bar')} near {points} leaves the "
        "path between some of them",
        Help.of(
            "round the corners of the path, or trace a part of it; if the curve may go anywhere "
            "between the points, say so with {}",
            ANY_ORDER.given(True),
        ),
        f"the nearest both ways, {nearest.id}, misses the points by {away}{left} at most",
    )


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
