"""Poses timed by the crank that leave no driver exact: the linkages nearest to poses and angles.

Drivers start from dyads through some of the timed poses at the angles of the crank, and from the
dyads of all poses; the others are dyads of the poses.  Their pairs are refined with the angles of
the driver as exact conditions, by the same search as all linkages of many poses.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from burmester.cures import Cure, Help
from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.local_minima import best_dyads
from burmester.dyads.selection import Fit, Found, FoundDyad, found_dyads, same_dyads
from burmester.dyads.timed_dyads import nearest_timed, timed_dyads
from burmester.errors import Advice, InputError
from burmester.families.dyad_samples import drawn_dyads
from burmester.families.open_task import OpenTask
from burmester.fourbar.dyad import RP, RR
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.evaluation import at_given_poses, with_own_dyads
from burmester.linkages.from_dyads import linkages_from_dyads, target_of
from burmester.synthesis.outcome import linkage_advice
from burmester.synthesis.path_generation import different
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import CONDITIONS, Task
from burmester.tasks.notation import length_of
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem, driving_side
from burmester.verdicts.assumptions import WIDE, Assumptions
from burmester.verdicts.explanation import hints, in_short, meets_exactly
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.wording import count, figure

MOST_DRIVERS, MOST_OTHERS, MOST_PAIRS = 12, 16, 60  # dyads that are paired, and pairs refined
SAME = 0.01  # motion sizes; linkages whose pivots and links differ by less are listed once
SHOWN = 12  # number of linkages that are told at most
DRAWN = {0: 60, 1: 16, 2: 16}  # dyads of each kind that are drawn where poses leave them open
LINES = (1, 2)  # kinds of dyads with a line


def near_timed_poses(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis:
    """The linkages whose driver is at the angles of the crank, as near to the poses as can be.

    Raises InputError E123 for methods and proofs that know nothing of them.
    """
    _require_method(problem.options)
    problem = replace(problem, options=replace(problem.options, method="complete"))
    fits, dyads = _dyads(problem)
    sides = [[each for each in dyads if each.limits == number] for number in (1, 2)]
    length = np.array([problem.length])
    pairs: list[Pair] = [
        (one, other)
        for one, other in product(*sides)
        if not len(same_dyads(Found.of((one, other)), length)[0])
    ]
    pairs.sort(key=lambda pair: pair[0].rms_error + pair[1].rms_error)
    found = linkages_from_dyads(problem, pairs[:MOST_PAIRS])
    apart = different(found, SAME * problem.motion_size)[:SHOWN]
    linkages = at_given_poses(with_own_dyads(apart), problem)
    outcome = _outcome(linkages, problem)
    warnings = (*findings, *linkage_advice(problem.given, linkages, outcome.code))
    listed = tuple(dyad for each in linkages for dyad in each.dyads)
    return Synthesis(problem, outcome, listed, linkages, warnings, fits)


def _require_method(options: SynthesisOptions) -> None:
    """Refuse methods and proofs that know nothing of crank angles: E123."""
    if options.method not in ("auto", "complete") or options.certify or not options.normalise:
        option = Cure("certify") if options.certify else Cure("method")
        if not options.normalise and not options.certify:
            option = Cure("normalise", option="--raw")
        raise InputError(
            "E123",
            f"{Help(option)} knows nothing of the angles of the crank",
            why="poses that are timed more than fully are met as nearly as possible, by a search",
            help=Help.of("leave {} out, or the crank angles", option),
        )


def of_timed_drivers(problem: SynthesisProblem, outcome: Outcome) -> Outcome:
    """The outcome of few poses, with the number of drivers that have the angles of the crank."""
    task = problem.task
    assert task.timing is not None
    found = timed_dyads(task.poses, task.timing)
    if found is None:
        return outcome
    if not found:
        help = "move a pose, or give another crank angle, or leave one blank"
        return Outcome("R306", "no linkage: no driving link turns by these crank angles", help)
    turns = f"{count(len(found), 'driving link')} {'turns' if len(found) == 1 else 'turn'}"
    text = f"{turns} by these crank angles, and no other"
    return replace(outcome, message=f"{outcome.message}; {text}")


def _dyads(problem: SynthesisProblem) -> tuple[tuple[Fit, ...], list[FoundDyad]]:
    """The dyads to pair, those of the first side before those of the second, numbered."""
    task, side = problem.task, driving_side(problem.task)
    assert task.timing is not None
    fits: list[Fit] = []
    lists: list[list[FoundDyad]] = []
    for number, limits in enumerate(task.limits):
        given = problem.given.limits
        own = given[min(number, len(given) - 1)] if given else Limits()
        if task.poses.shape[0] < CONDITIONS:
            found = _drawn(problem, number)
        elif fits and len(given) < 2:
            found = found_dyads(fits[0], task)[0]
        else:
            fits.append(_fit(task, own, problem))
            found = found_dyads(fits[-1], task)[0]
        if number == side:
            kinds = tuple(kind for kind in (RR, RP) if kind.__name__ in limits.allowed)
            found = [each for each in found if isinstance(each.dyad, kinds)]
            timed = [
                FoundDyad.of("", each, task.poses, minimum=False)
                for each in nearest_timed(task.poses, task.timing)
            ]
            timed.sort(key=lambda each: each.rms_error)
            found = [*timed[: MOST_DRIVERS // 2], *found][:MOST_DRIVERS]
        lists.append([replace(each, limits=number + 1) for each in found[:MOST_OTHERS]])
    dyads = (each for found in lists for each in found)
    return tuple(fits), [replace(each, id=f"D{k}") for k, each in enumerate(dyads, start=1)]


def _fit(task: Task, limits: Limits, problem: SynthesisProblem) -> Fit:
    """The dyads of five poses or more within the limits of a user."""
    free = limits.conditions == 0 and not limits.has_length
    if free and limits.fixed_pivot is None and limits.moving_pivot is None:
        if task.poses.shape[0] == CONDITIONS:
            return dyads_of_five(task.poses)
        return best_dyads(task.poses, task.weights, task.exact, None, problem.options.norm)
    return best_dyads(task.poses, task.weights, task.exact, limits, problem.options.norm)


def _drawn(problem: SynthesisProblem, side: int) -> list[FoundDyad]:
    """Dyads of one side through fewer than five poses, whatever angles they have."""
    target = target_of(problem)
    open_ = OpenTask.of(problem, target, Assumptions.of(problem, WIDE, strict=False))
    free = replace(open_.sides[side], timing=None, given=None)
    none = np.zeros((problem.task.poses.shape[0], 3))
    samples = drawn_dyads(open_, free, none, DRAWN, np.random.default_rng(0))
    kinds = np.stack([samples.kinds, samples.kinds], axis=1)
    z = np.stack([samples.dimensions, samples.dimensions], axis=1)
    own = LinkageBatch(kinds, z).from_canonical(target.frames)
    index = np.linspace(0, len(samples) - 1, min(len(samples), MOST_OTHERS)).astype(int)
    poses = problem.task.poses
    return [FoundDyad.of("", own.linkage(int(k)).first, poses, minimum=False) for k in index]


def _outcome(linkages: Sequence[FoundLinkage], problem: SynthesisProblem) -> Outcome:
    """What came of it, with the misses of the nearest linkage that works."""
    poses, task = count(problem.given.poses.shape[0], "pose"), problem.given
    usable = [each for each in linkages if each.usable]
    if not linkages:
        return Outcome("R306", f"no linkage has its crank at these angles near {poses}", None)
    if not usable:
        return Outcome(
            "R301",
            f"{count(len(linkages), 'four-bar')} near {poses} and their crank angles, none of them "
            "usable",
            hints(linkages, problem),
            f"the nearest, {linkages[0].id}, {in_short(linkages[0], task, problem.length)}",
        )
    nearest = min(usable, key=lambda each: each.combined_error)
    assert nearest.timing_error is not None
    turned = math.degrees(float(np.nanmax(np.abs(nearest.timing_error))))
    if meets_exactly(nearest, problem.length):
        told = "passes every pose exactly"
    else:
        told = f"misses them by {length_of(nearest.error.worst, task)} at most"
    return Outcome(
        "R300",
        f"{count(len(usable), 'usable four-bar')} near {poses} and their crank angles; the "
        f"nearest, {nearest.id}, {told}, and its crank angles by {figure(turned)}°",
    )
