"""Pivots where one would look for them, where the task says nothing of them.

The linkage nearest to six poses or more may have its pivots a street away.  Where it has them
farther away than is ever assumed for few poses, and one whose pivots lie beside the motion comes
nearly as near, that one comes first, and the assumption is told.  The farther ones stay in the
list.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from burmester.cures import Help
from burmester.errors import Advice
from burmester.fourbar.dyad import PR, RP, RR
from burmester.linkages.by_all_poses import judged_at_all
from burmester.linkages.evaluation import Evaluation, at_given_poses, numbered
from burmester.linkages.from_dyads import sample_refined, target_of
from burmester.linkages.further_pairs import FurtherPairs, closer_linkages
from burmester.linkages.sound_linkages import sound_linkages
from burmester.progress import time_for
from burmester.refinement.kept_limits import DyadLimitsConstraint
from burmester.tasks.limits import Limits
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.assumptions import (
    FIXED_PIVOT,
    MOVING_PIVOT,
    REACH,
    WIDE,
    Assumptions,
    assumed_advice,
)
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.limit_check import LIMIT_TOLERANCE, outside
from burmester.verdicts.ranking import closest_usable, digits_leave_open, ranked, states_tolerance
from burmester.wording import figure

ERROR_RATIO = 1.5  # a linkage with usual pivots comes first up to this many times the first's error


def with_usual_pivots(
    problem: SynthesisProblem, linkages: tuple[FoundLinkage, ...]
) -> tuple[tuple[FoundLinkage, ...], list[Advice]]:
    """The linkages by rank, one with usual pivots first if it comes near enough, and W215 then.

    Nothing changes where the task limits all pivots or states tolerances, where the poses determine
    the first linkage within their digits, and where nothing is refined.
    """
    if not _leaves_pivots_open(problem, linkages):
        return linkages, []
    first, floor = linkages[0], digits_leave_open(problem)
    closest = closest_usable(linkages)
    if closest is None or (closest.determined and closest.combined_error <= floor):
        return linkages, []
    if _is_within(first, _regions(problem, Assumptions.of(problem, WIDE)), problem):
        return linkages, []
    most = ERROR_RATIO * max(first.combined_error, floor)
    for reach in (REACH, WIDE):
        assumed = Assumptions.of(problem, reach)
        regions = _regions(problem, assumed)
        near = _sound_within(linkages, regions, most, problem)
        every = linkages
        if not near and time_for("looking for linkages with pivots beside the motion"):
            every = _with_more(problem, linkages, regions, most)
            near = _sound_within(every, regions, most, problem)
        if near:
            order = [near[0], *(each for each in every if each is not near[0])]
            linkages = tuple(numbered(order))
            return linkages, [_advice(linkages, first, assumed)]
    return linkages, []


def _leaves_pivots_open(problem: SynthesisProblem, linkages: Sequence[FoundLinkage]) -> bool:
    """Whether there is a first linkage whose pivots nothing bounds."""
    task = problem.task
    limits = task.limits or (Limits(),)
    return (
        bool(linkages)
        and linkages[0].usable
        and problem.options.refines
        and problem.options.method == "complete"
        and not states_tolerance(task)
        and task.requirements.footprint is None  # it holds all pivots
        and any(None in (each.fixed_pivot, each.moving_pivot) for each in limits)
    )


def _regions(problem: SynthesisProblem, assumed: Assumptions) -> tuple[Limits, ...]:
    """The limits of the task, with what is assumed where they say nothing; the kinds stay open."""
    return tuple(
        Limits(each.fixed_pivot or assumed.fixed, each.moving_pivot or assumed.moving)
        for each in problem.task.limits or (Limits(),)
    )


def _is_within(found: FoundLinkage, regions: Sequence[Limits], problem: SynthesisProblem) -> bool:
    """Whether all pivots of a linkage lie in the regions of their dyads; a line has no pivot."""
    slack = LIMIT_TOLERANCE * problem.motion_size
    for dyad, each in zip(
        (found.linkage.first, found.linkage.second), (regions[0], regions[-1]), strict=True
    ):
        places = []
        if isinstance(dyad, RR | RP):
            places.append((each.fixed_pivot, dyad.fixed_pivot))
        if isinstance(dyad, RR | PR):
            places.append((each.moving_pivot, dyad.moving_pivot))
        if any(region is not None and outside(region, at) > slack for region, at in places):
            return False
    return True


def _sound_within(
    linkages: Sequence[FoundLinkage],
    regions: Sequence[Limits],
    most: float,
    problem: SynthesisProblem,
) -> list[FoundLinkage]:
    """Those of linkages, by rank, that are sound, near enough, and have their pivots there."""
    near = [each for each in linkages if each.usable and each.combined_error <= most]
    return [each for each in near if not each.shortcomings and _is_within(each, regions, problem)]


def _with_more(
    problem: SynthesisProblem,
    linkages: Sequence[FoundLinkage],
    regions: Sequence[Limits],
    most: float,
) -> tuple[FoundLinkage, ...]:
    """The linkages, and sound ones that were looked for with their pivots in the regions."""
    whole, sample = Evaluation(problem, target_of(problem)), sample_refined(problem)
    evaluation = whole if sample is None else whole.sampled(sample)
    target = evaluation.target
    kept = tuple(
        DyadLimitsConstraint(side, regions[min(side, len(regions) - 1)], target.frames)
        for side in (0, 1)
    )
    evaluation = replace(evaluation, target=replace(target, kept=(*target.kept, *kept)))
    inside = replace(problem, task=replace(evaluation.task, limits=tuple(regions)))
    starts = FurtherPairs.of([], replace(evaluation, problem=inside))
    closer = closer_linkages(starts, evaluation, [])
    own = [each for each in linkages if _is_within(each, regions, problem)]
    if any(each.error.places.shape != evaluation.target.poses.shape for each in own):
        own = judged_at_all(own, evaluation)  # they have places at poses left out or merged here
    near = [each for each in (*closer, *own) if each.combined_error <= most]
    found = [*closer, *sound_linkages(near, evaluation, most)] if near else []
    if sample is not None:
        found = judged_at_all(found, whole)
    if problem.options.rounds:
        found = whole.rounded(found)
    found = whole.with_spreads(found)
    return tuple(ranked([*linkages, *at_given_poses(found, problem)], problem))


def _advice(
    linkages: Sequence[FoundLinkage], farther: FoundLinkage, assumed: Assumptions
) -> Advice:
    """W215: what was assumed of the pivots, and which linkage is nearer without it."""
    options = Help(FIXED_PIVOT), Help(MOVING_PIVOT)
    advice = assumed_advice("W215", [each for each in assumed.bounds if each.option in options])
    id = next(each.id for each in linkages if each.linkage is farther.linkage)
    ratio = farther.combined_error / linkages[0].combined_error
    nearer = f"or take {id}, whose error is {figure(ratio)} times that of L1"
    return replace(advice, help=Help.of("{}; {}", advice.help or "", nearer))
