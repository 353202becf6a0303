"""Dyads joined in pairs: every linkage refined, judged, and ranked by whether it works.

A linkage works where its coupler meets all poses on one circuit, on one branch of a drive, in
their order, and keeps to what is asked of it.  Where the closest linkage does not, the search goes
on under these conditions (`search`), so that the answer is not only what fails, and why.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PP
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import DYAD_KINDS, LinkageBatch
from burmester.fourbar.pose_error import error_frames
from burmester.linkages.bearing_linkages import bearing_linkages, only_bears_too_much
from burmester.linkages.best_within import best_within
from burmester.linkages.by_all_poses import judged_at_all, refined_by_all, worst_left_out
from burmester.linkages.evaluation import Candidates, Evaluation, numbered
from burmester.linkages.further_pairs import FurtherPairs, PairsToSearch, closer_linkages
from burmester.linkages.judged_places import NearestPlaces, at_nearest
from burmester.linkages.sound_linkages import sound_linkages, trade_offs
from burmester.numerics.arrays import ROUNDING, FloatArray, replaced, take
from burmester.progress import goes_on, step, time_for
from burmester.refinement.constraints import AllConstraints, Constraints
from burmester.refinement.defect_free_search import (
    FEW_POSES,
    MAX_CONTINUED,
    defect_free_linkages,
    on_more_poses,
)
from burmester.refinement.kept_limits import DyadLimitsConstraint, RailConstraint
from burmester.refinement.kept_timing import TimingConstraint
from burmester.refinement.target import Target
from burmester.refinement.tolerance_boxes import ToleranceBoxes
from burmester.tasks.pose_sample import PoseSample
from burmester.tasks.problem import SynthesisProblem, driving_side
from burmester.verdicts.explanation import by_nearness
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.verdicts.ranking import (
    closest_usable,
    digits_leave_open,
    farthest_recommended,
    only_too_far,
    ranked,
    states_tolerance,
)
from burmester.verdicts.requirement_check import least_links
from burmester.wording import count

MAX_POSES_INTO_BOXES = 60  # refine on at most so many poses, evenly thinned
STEPS_INTO_BOXES = 40  # number of steps of each of the two refinements

# Number of refinement steps of all linkages, and of further steps of the near ones.
FIRST_STEPS, FURTHER_STEPS = 8, 52
# Refine fully the best MIN_REFINED and all within REFINED_COST_RATIO times the lowest cost.
MIN_REFINED, REFINED_COST_RATIO = 4, 100.0
# Of more poses a sample of about so many is refined on, and a last few steps are made by all.
MAX_POSES_REFINED = 200
# Each place of a timed pose is an unknown.
MAX_TIMED_REFINED = 24
# Numbers of steps of linkages of timed poses, and after each the number of those that go on.
TIMED_SELECTION = (8, 24), (20, 10)
# For the least worst error the worst poses join it, and all is done again, at most so many times.
MAX_EXCHANGES = 5
# Degrees by which a greater least transmission angle is asked for within tolerances, and how often.
RISE, MAX_RISES = 8.0, 6
MAX_SEARCHED = 5  # number of linkages kept from the search for defect-free linkages
MAX_TOO_FAR = 2  # number of those kept that only come too far from the poses, if none is usable
KEPT_OF_RISE = 2  # number of linkages kept of each rise; the others are like them


def linkages_from_dyads(
    problem: SynthesisProblem, pairs: Sequence[Pair], *, refine: bool = True
) -> tuple[FoundLinkage, ...]:
    """The linkages of pairs of dyads, in the order of `ranking`.

    refine: False leaves the dimensions as the dyads have them, whatever the options say.  Pairs
    with a PP dyad are left out: no single joint drives them.  Within limits there may be no pair,
    and linkages nevertheless: of links that are not the locally best ones.
    """
    options, refine = problem.options, refine and problem.options.refines
    pairs = [pair for pair in pairs if not any(isinstance(each.dyad, PP) for each in pair)]
    if not pairs and not (refine and problem.task.limits and options.method == "complete"):
        return ()
    if len(problem.task.limits) < 2:  # pairs of the same kinds are computed together
        kind = {each.id: DYAD_KINDS.index(type(each.dyad)) for pair in pairs for each in pair}
        pairs = [(b, a) if kind[b.id] < kind[a.id] else (a, b) for a, b in pairs]
    whole = Evaluation(problem, target_of(problem))
    sample = sample_refined(problem) if refine else None
    found = _by_sample(pairs, whole, sample, refine)
    for number in range(1, MAX_EXCHANGES + 1):
        if sample is None or not whole.target.worst:
            break
        more = worst_left_out(found, whole.target, sample)
        text = f"refining linkages for the poses that they miss by most, round {number}"
        if not len(more) or not time_for(text):
            break
        sample = sample.joined(more, problem.task.weights)
        found = _by_sample(pairs, whole, sample, refine)
    if options.rounds:
        found = whole.rounded(found)
    found = whole.with_spreads(found)
    return tuple(numbered(found))


def _by_sample(
    pairs: list[Pair], whole: Evaluation, sample: PoseSample | None, refine: bool
) -> list[FoundLinkage]:
    """The linkages of pairs, looked for by a sample of the poses if given, judged by all."""
    problem, evaluation = whole.problem, whole if sample is None else whole.sampled(sample)
    start = evaluation.stacked(pairs)
    found: list[FoundLinkage] = []
    if pairs:
        number = count(len(pairs), "linkage")
        now = refine and time_for(f"refining {number}")
        candidates = _of_pairs(start, pairs, evaluation.target, now)
        step(f"judging {number}")
        found = evaluation.evaluate(candidates)
    if refine and (found or not pairs):
        found = _with_search(start, pairs, evaluation, found)
        if found and found[0].usable:
            if not states_tolerance(problem.task):
                better = trade_offs(found[0], evaluation)
            elif time_for("looking for the best within the tolerance"):
                better = best_within(found, evaluation)
            else:
                better = []
            found = ranked([*found, *better], problem)
        if more := bearing_linkages(found, evaluation, evaluation.evaluate):
            found = ranked([*found, *more], problem)
    if evaluation is not whole:
        step(f"judging {count(len(found), 'linkage')} at all poses")
        found = judged_at_all(found, whole)
    return found


def sample_refined(problem: SynthesisProblem) -> PoseSample | None:
    """The poses by which the linkages of a problem are refined; None where they are all."""
    most = MAX_POSES_REFINED if problem.task.timing is None else MAX_TIMED_REFINED
    if not problem.options.refines or problem.task.poses.shape[0] <= most:
        return None
    return PoseSample.of_task(problem.task, most)


def target_of(problem: SynthesisProblem) -> Target:
    """The target of a problem's linkages, in the frames in which errors are computed."""
    task, length = problem.task, problem.length_per_radian
    frames = error_frames(task.poses, length)
    unit = float(frames.length)
    kept: tuple[Constraints, ...] = ()
    if task.limits:
        both = (task.limits[0], task.limits[-1])
        kept = tuple(DyadLimitsConstraint(side, each, frames) for side, each in enumerate(both))
        rails = (RailConstraint.of(*each, frames, length / unit) for each in enumerate(both))
        kept += tuple(each for each in rails if each is not None)
    poses = frames.to_canonical(task.poses)
    boxes = None
    if task.tolerances is not None:
        boxes = ToleranceBoxes.of(task.tolerances, poses, length / unit, unit)
        kept = (*kept, boxes)
    if task.timing is not None:
        kept = (*kept, TimingConstraint(driving_side(task), task.timing, length / unit))
    return Target(
        poses,
        length / unit,
        frames,
        task.requirements,
        kept,
        task.weights,
        task.exact if boxes is None else None,
        problem.options.norm == "worst",
        boxes,
        task.path,
        least_links(problem) / unit,
    )


def _of_pairs(start: LinkageBatch, pairs: list[Pair], target: Target, refine: bool) -> Candidates:
    """The pairs with their places, on one circuit where that costs little, and refined."""
    every = np.arange(len(start))
    if target.boxes is not None:
        candidates = Candidates(start, target.places(start), pairs)
        return into_boxes(candidates, target) if refine else candidates
    both, _, one, best, apart = NearestPlaces.of(start, target)
    twice = apart & np.isfinite(one).all(axis=(1, 2)) & refine
    index = np.concatenate([every, np.flatnonzero(twice)])
    rows = np.concatenate([np.where(apart[:, None, None], best, one), one[twice]])
    rows = target.at_angles(start[index], rows)
    candidates = Candidates(start[index], rows, [pairs[k] for k in index], both=both[index])
    if refine:
        candidates = _refined(candidates, target)
        # Refinement may leave places in local minima that are not the nearest.
        some = np.flatnonzero(_differ(candidates.batch, start[index]))
        near, around = at_nearest(candidates.batch[some], candidates.rows[some], target)
        there = target.at_angles(candidates.batch[some], near), around
        rows, both = replaced((candidates.rows, both[index]), some, there)
        candidates = refined_by_all(candidates._replace(rows=rows, both=both), target)
    # Linkages that did not change keep all their digits.
    own = LinkageBatch.of([Linkage(a.dyad, b.dyad) for a, b in candidates.pairs]).dimensions
    changed = _differ(candidates.batch, start[index])[:, None, None]
    own = np.where(changed, candidates.batch.from_canonical(target.frames).dimensions, own)
    return candidates._replace(own=LinkageBatch(candidates.batch.kinds, own))


def _differ(one: LinkageBatch, other: LinkageBatch) -> NDArray[np.bool_]:
    """Which (k,) of linkages have other dimensions."""
    return np.asarray((one.dimensions != other.dimensions).any(axis=(1, 2)))


def _refined(candidates: Candidates, target: Target) -> Candidates:
    """The linkages, refined unless they meet the poses within rounding already.

    All of them by FIRST_STEPS, the near ones by FURTHER_STEPS.
    """
    cost = target.cost(candidates.rows)
    some = np.flatnonzero(cost > ROUNDING**2 * candidates.rows.shape[1])
    if not len(some):
        return candidates
    kept = AllConstraints(target.kept) if target.kept else None
    dimensions, rows = candidates.batch.dimensions.copy(), candidates.rows.copy()
    timed = any(isinstance(each, TimingConstraint) for each in target.kept)
    fewer: dict[str, Any] = {"selection": TIMED_SELECTION} if timed else {}
    plain = not target.worst and kept is None and target.exact is None
    for steps in (FIRST_STEPS, FURTHER_STEPS) if plain else (FURTHER_STEPS,):
        batch = LinkageBatch(candidates.batch.kinds[some], dimensions[some])
        refined = target.refine(
            batch, rows[some], constraints=kept, worst=target.worst, steps=steps, **fewer
        )
        with np.errstate(invalid="ignore"):
            better = refined.met & (target.worst | (target.cost(refined.rows) <= cost[some]))
        dimensions[some[better]] = refined.batch.dimensions[better]
        rows[some[better]] = refined.rows[better]
        cost = target.cost(rows)
        near = np.sort(np.nan_to_num(cost, nan=np.inf))[: min(MIN_REFINED, len(cost))]
        some = some[~refined.settled]
        some = some[cost[some] <= max(REFINED_COST_RATIO * near[0], near[-1])]
        if not len(some):
            break
    return candidates._replace(batch=LinkageBatch(candidates.batch.kinds, dimensions), rows=rows)


def _with_search(
    start: LinkageBatch, pairs: list[Pair], evaluation: Evaluation, found: list[FoundLinkage]
) -> list[FoundLinkage]:
    """The linkages, and those of the searches where none of them is the closest and good.

    Where the closest one works, closer ones are looked for from further pairs; where it does not,
    such as work.  Where none near enough is sound, the closest ones are made sound.
    """
    problem = evaluation.problem
    if problem.task.tolerances is not None:
        return _inside_tolerances(start, pairs, evaluation, found)
    nearest = _nearest(found, problem)
    further = None
    if nearest is None or (nearest.usable and nearest.combined_error > digits_leave_open(problem)):
        if time_for("looking for closer linkages"):
            further = FurtherPairs.of(pairs, evaluation)
            found = ranked([*found, *closer_linkages(further, evaluation, found)], problem)
        nearest = _nearest(found, problem)
    works = nearest is not None and nearest.usable
    if not works and time_for("looking for linkages that work"):
        further = further or FurtherPairs.of(pairs, evaluation)
        starts = further.beside(start, pairs, found, evaluation)
        best = closest_usable(found)
        more = _searched(starts, evaluation, inf if best is None else best.combined_error)
        found = ranked(found + more, problem)
    closest = closest_usable(found)
    if closest is None or not found[0].shortcomings:
        return found
    most = farthest_recommended(closest, problem)
    # Poses that determine a linkage within their digits leave no other one but the pairs.
    unique = closest.determined and closest.combined_error <= digits_leave_open(problem)
    if (most == inf or not unique) and time_for("looking for linkages of better proportions"):
        found = ranked([*found, *sound_linkages(found, evaluation, most)], problem)
    return found


def _nearest(found: Sequence[FoundLinkage], problem: SynthesisProblem) -> FoundLinkage | None:
    """The closest linkage, and of those that are as close within rounding one that works."""
    rounding = ROUNDING * problem.length_per_radian
    return min(
        found,
        key=lambda each: (max(each.combined_error, rounding), not each.usable),
        default=None,
    )


def _inside_tolerances(
    start: LinkageBatch, pairs: list[Pair], evaluation: Evaluation, found: list[FoundLinkage]
) -> list[FoundLinkage]:
    """The linkages, others from further pairs inside the tolerances, and ever better ones."""
    if not time_for("looking for linkages that stay inside the tolerances"):
        return found
    starts = FurtherPairs.of(pairs, evaluation).beside(start, pairs, found, evaluation)
    found = ranked([*found, *_searched(starts, evaluation, inf)], evaluation.problem)
    if not any(each.usable for each in found):
        return found
    if not time_for("looking for better linkages within the tolerances"):
        return found
    for number in range(1, MAX_RISES + 1):
        if not goes_on(number, MAX_RISES, "round", has_steps=True):
            break
        best = math.degrees(found[0].driven.least_over_range)
        more = ranked(sound_linkages(found, evaluation, inf, best + RISE), evaluation.problem)
        found = ranked([*found, *more[:KEPT_OF_RISE]], evaluation.problem)
        if not math.degrees(found[0].driven.least_over_range) > best + RISE / 2:
            break
    return found


def _searched(starts: PairsToSearch, evaluation: Evaluation, most: float) -> list[FoundLinkage]:
    """Usable linkages of the search whose combined error is below `most`.

    Where nothing is usable, the nearest ones that only come too far from the poses.
    """
    whole = evaluation.target
    target = whole.thinned(FEW_POSES)
    # Tolerances bind once a linkage is found: as constraints they would shut the search's ways.
    found = defect_free_linkages(starts.batch, target.relaxed, starts.parts)
    if found is None:
        return []
    index = np.flatnonzero(found.refined.met)
    if not len(index):
        return []
    if target is not whole:
        index = index[np.argsort(found.refined.cost[index], kind="stable")][:MAX_CONTINUED]
    batch, rows = found.refined.batch[index], found.refined.rows[index]
    if target is not whole or target.boxes is not None:
        batch, rows, _ = on_more_poses(batch, found.driver[index], whole)
    origins = [starts.origin(k) for k in found.pair[index].tolist()]
    evaluated = evaluation.evaluate(
        Candidates(batch, rows, origins, np.ones(len(index), dtype=bool))
    )
    good = [each for each in evaluated if each.usable or only_bears_too_much(each)]
    near = [each for each in good if each.combined_error < most]
    if not near and most == inf:
        near = by_nearness(filter(only_too_far, evaluated), evaluation.problem.length)[:MAX_TOO_FAR]
    return near[:MAX_SEARCHED]


def into_boxes(candidates: Candidates, target: Target) -> Candidates:
    """The linkages refined into the boxes of a target, or as near to them as they come."""
    thin = target.thinned(MAX_POSES_INTO_BOXES)
    batch, rows = candidates.batch, candidates.rows
    if thin is not target:
        rows = thin.places(batch)
    for each in (thin.relaxed, thin):
        batch, rows = _brought_nearer(batch, rows, each)
    return candidates._replace(batch=batch, rows=target.places(batch))


def _brought_nearer(
    batch: LinkageBatch, rows: FloatArray, target: Target
) -> tuple[LinkageBatch, FloatArray]:
    """Linkages (k,) with places (k, N, 3), refined where all constraints come to hold."""
    some = np.flatnonzero(np.isfinite(rows).all(axis=(1, 2)))
    if not len(some):
        return batch, rows
    refined = target.refine(
        batch[some],
        rows[some],
        constraints=AllConstraints(target.kept),
        constrained_steps=STEPS_INTO_BOXES,
    )
    better = refined.met & np.isfinite(refined.rows).all(axis=(1, 2))
    return replaced((batch, rows), some[better], take((refined.batch, refined.rows), better))
