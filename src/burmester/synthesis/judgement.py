"""The judgement of a linkage that exists: what is said of it is what synthesis says of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from burmester.cures import Cure, Help
from burmester.diagnosis.checks import diagnose
from burmester.errors import Advice, InputError
from burmester.families.family import best_of_family
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.pose_error import PoseError
from burmester.linkages.evaluation import (
    PLACES_AT_ONCE,
    Candidates,
    Evaluation,
    at_given_poses,
    numbered,
    pair_of,
    sizable,
)
from burmester.linkages.from_dyads import target_of
from burmester.linkages.judged_places import best_places
from burmester.linkages.nearby_linkages import greatest_move, nearby_linkages
from burmester.progress import limited, step, time_for
from burmester.synthesis.given_linkage import GivenDyad, dyads_at_poses, require_linkage
from burmester.synthesis.outcome import linkage_advice
from burmester.synthesis.point_approximation import with_nearest_angles
from burmester.synthesis.point_conditions import each_once
from burmester.synthesis.result import Candidate, Outcome, Synthesis, with_time_limit
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, poses_in_words
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import hints, in_short
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.wording import count, listed

EXACT_SHARE = 1e-4  # motion sizes; it is said where a pose to be met exactly is missed by more


def judge_linkage(
    task: Task,
    linkage: Linkage | Sequence[GivenDyad],
    options: SynthesisOptions = SynthesisOptions(),  # noqa: B008  frozen
    *,
    improve: bool = False,
) -> Synthesis:
    """One linkage at the poses of a task, with errors, verdict, uncertainty and violations.

    It has the dimensions that are given: nothing is refined.  It is judged at its places nearest to
    the poses; where it works on one of its circuits, on that one.  Of a task with two limits, the
    dyads are judged in the order that keeps more of them.

    task: any number of poses.
    linkage: the linkage, or its two dyads, RR, PR or RP, or pivots alone (`OpenLink`).

    Raises InputError E112 (numbers too large), E154 (two dyads that make no linkage), E155
    (lengths that can be assembled nowhere), E158 (pivots alone at points) and E159 (better ones
    at points that the crank times).
    """
    if improve and _is_timed(task):
        raise InputError(
            "E159",
            "better linkages are not looked for where the crank times the points",
            why="the search near a linkage keeps to points, and not to the angles of its crank",
            help=Help.of(
                "leave {} out, and compare with what `burmester synthesize` finds", Cure("improve")
            ),
        )
    with limited(options.time_limit) as watch:
        return with_time_limit(_judgement(task, linkage, options, improve), watch)


def _judgement(
    task: Task, linkage: Linkage | Sequence[GivenDyad], options: SynthesisOptions, improve: bool
) -> Synthesis:
    dyads: Sequence[GivenDyad] = (
        (linkage.first, linkage.second) if isinstance(linkage, Linkage) else linkage
    )
    both, advice = dyads_at_poses(dyads, task)
    lengths = any(isinstance(each, RR) for each in dyads) and not isinstance(linkage, Linkage)
    require_linkage(both, task, assembled=lengths)
    problem, findings = _problem(task, options)
    task = problem.given
    evaluation = Evaluation(problem, target_of(problem))
    given = pair_of(*both, task.poses)
    step("judging the linkage")
    orders = [given, given[::-1]] if len(problem.task.limits) > 1 else [given]
    judged = _judged(orders, np.zeros(len(orders), dtype=bool), evaluation)
    found = replace(judged[best_places(judged)], id="L1", rank=1)
    every = [found]
    if improve and time_for("looking for better linkages near it"):
        near = nearby_linkages(found, evaluation) or _of_family(found, evaluation)
        every += numbered(near, first=2)
    linkages = _told(every, evaluation)
    outcome = _outcome(linkages, problem, improve)
    warnings = (
        *task.notes,
        *advice,
        *findings,
        *linkage_advice(task, linkages, outcome.code),
    )
    return Synthesis(problem, outcome, given, linkages, warnings)


def _problem(task: Task, options: SynthesisOptions) -> tuple[SynthesisProblem, tuple[Advice, ...]]:
    """The task as synthesis judges its linkages, and what is to be said of it.

    The points of a path have free angles, and a tolerance where the task states none; so have poses
    and points that are more than a linkage can meet.
    """
    task, repeats = each_once(task)
    if task.path is not None:
        from burmester.synthesis.path_generation import with_tolerance  # noqa: PLC0415  paths only

        given, note = with_tolerance(task, options)
        return SynthesisProblem.of(given, None, options), tuple(note)
    step(f"looking at {task.poses.shape[0]} poses")
    task, note = with_nearest_angles(task, options)
    diagnosis = diagnose(task)
    problem = SynthesisProblem.of(task, diagnosis.motion, options).merged()
    return problem, (*repeats, *note, *diagnosis.findings)


def _judged(
    pairs: Sequence[Pair], searched: NDArray[np.bool_], evaluation: Evaluation
) -> list[FoundLinkage]:
    """Linkages (k,), each on the circuit where it works or is nearest; searched: (k,), as found."""
    found: list[FoundLinkage] = []
    at_once = max(1, PLACES_AT_ONCE // evaluation.task.poses.shape[0])
    judged = evaluation.evaluated if evaluation.target.path is None else evaluation.members
    for at in range(0, len(pairs), at_once):
        some = list(pairs[at : at + at_once])
        own = LinkageBatch.of([Linkage(first.dyad, second.dyad) for first, second in some])
        batch = own.to_canonical(evaluation.target.frames)
        rows, chosen = evaluation.target.places(batch), searched[at : at + at_once]
        found += judged(Candidates(batch, rows, some, chosen, own))
    return found


def judged_again(
    problem: SynthesisProblem, pairs: Sequence[Pair], searched: Sequence[bool]
) -> list[FoundLinkage | None]:
    """The linkages of an answer judged once more, in their order: as `judge_linkage` does.

    None stands for one whose ground link or coupler has no length.
    pairs: their dyads, of which each two make a linkage (`require_linkage`); searched: which come
    from the search for defect-free linkages.
    """
    out: list[FoundLinkage | None] = [None] * len(pairs)
    if pairs:
        evaluation = Evaluation(problem, target_of(problem))
        some = np.flatnonzero(sizable(evaluation.stacked(pairs))).tolist()
        chosen = np.array([searched[k] for k in some], dtype=bool)
        found = _judged([pairs[k] for k in some], chosen, evaluation)
        for k, each in zip(some, _told(found, evaluation), strict=True):
            out[k] = each
    return out


def _told(found: Sequence[FoundLinkage], evaluation: Evaluation) -> tuple[FoundLinkage, ...]:
    """The linkages with their errors at all poses as given, and with their spreads."""
    problem = evaluation.problem
    if _is_open(problem) or problem.given.free_angles.any():  # no pose determines its pivots
        found = [replace(each, uncertainty=None, determined=True, other_types=()) for each in found]
    return at_given_poses(evaluation.with_spreads(list(found)), problem)


def _of_family(given: FoundLinkage, evaluation: Evaluation) -> list[FoundLinkage]:
    """Of the linkages that few poses leave open the nearest of the same kinds, as D1 and D2."""
    problem = evaluation.problem
    if given.usable or problem.is_special or not _is_open(problem):
        return []
    if not time_for("looking at the linkages of the family"):
        return []
    family = best_of_family(problem, evaluation.target)
    if family is None or not family.works:
        return []
    own = family.batch.from_canonical(evaluation.target.frames)
    kinds = [type(each.dyad) for each in given.dyads]
    index, pairs = [], []
    for k in range(len(own)):
        linkage = own.linkage(k)
        if [type(linkage.first), type(linkage.second)] == kinds:
            index.append(k)
            pairs.append(given.dyads)
    if not index:
        return []
    some = Candidates(family.batch[index], family.rows[index], pairs, from_search=True)
    found = evaluation.members(some)
    usable = [each for each in found if each.usable]
    return sorted(usable, key=lambda each: greatest_move(given, each))[:1]


def _is_timed(task: Task) -> bool:
    """Whether the crank times the points of a path."""
    return task.path is not None and task.path.crank_angles is not None


def _is_open(problem: SynthesisProblem) -> bool:
    """Whether so few poses leave every pivot open."""
    return max(problem.missing_conditions) > 0


def _exact_note(error: PoseError, task: Task, size: float) -> str | None:
    """Of the poses that are to be met exactly the one that is missed most, if one is."""
    if task.exact is None or not task.exact.any():
        return None
    missed = np.where(task.exact, np.nan_to_num(error.position, nan=np.inf), 0.0)
    worst = int(missed.argmax())
    if missed[worst] <= EXACT_SHARE * size:
        return None
    pose = poses_in_words(task, [worst])
    return f"it misses {pose}, which is to be met exactly, by {length_of(missed[worst], task)}"


def _outcome(linkages: Sequence[FoundLinkage], problem: SynthesisProblem, improve: bool) -> Outcome:
    """R330 or R331 of the first linkage, the given one, and what to do."""
    found, *near = linkages
    outcome = judged_outcome(found, problem)
    ways: list[str] = []
    message = outcome.message
    if improve and found.usable:
        message += f"; {count(len(near), 'better one')} near it"
    elif improve:
        message += (
            f"; {len(near)} near it {'does' if len(near) == 1 else 'do'}"
            if near
            else ("; none was found near it that does")
        )
    elif (not found.usable or found.shortcomings) and not _is_timed(problem.given):
        better = "better ones near it" if found.usable else "one near it that works"
        ways.append(Help.of(f"look for {better} with {{}}", Cure("improve", True)))
    if not found.usable:
        ways.append(hints([found], problem))
    return replace(outcome, message=message, help=Help.joined("; or ", ways) or None)


def judged_outcome(found: Candidate, problem: SynthesisProblem) -> Outcome:
    """R330 or R331 of a linkage that was given, and why; what helps is left open."""
    task = problem.given
    within = " within the requirements" if task.requirements.has_any else ""
    if not found.usable:
        why = f"it {in_short(found, task, problem.length)}"
        return Outcome("R331", f"the linkage does not work{within}", None, why)
    notes = [f"it {listed(found.shortcomings)}"] if found.shortcomings else []
    if (note := _exact_note(found.error, task, problem.motion_size)) is not None:
        notes.append(note)
    return Outcome("R330", f"the linkage works{within}", None, "; ".join(notes) or None)
