"""The whole road: from a task to dyads, from dyads to linkages, everything kept and ranked."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from burmester.diagnosis.checks import diagnose, disagreement
from burmester.dyads.critical_points import CriticalDyads
from burmester.dyads.five_poses import FivePoseDyads
from burmester.dyads.local_minima import BestDyads, best_dyads
from burmester.dyads.selection import found_dyads
from burmester.errors import Advice, InputError
from burmester.fourbar.dyad import Dyad
from burmester.linkages.bearing_linkages import bearing_linkages
from burmester.linkages.evaluation import Candidates, Evaluation, at_given_poses, numbered
from burmester.linkages.from_dyads import linkages_from_dyads, target_of
from burmester.progress import limited, step, time_for
from burmester.synthesis.dyad_search import DyadSearch, dyads_of_motion, search_dyads, with_method
from burmester.synthesis.outcome import (
    dyad_advice,
    family,
    linkage_advice,
    offering_six_bars,
    sample_advice,
    summary,
    undetermined,
)
from burmester.synthesis.point_approximation import with_nearest_angles
from burmester.synthesis.point_conditions import each_once, special_curve
from burmester.synthesis.result import Outcome, Synthesis, with_time_limit
from burmester.synthesis.usual_pivots import with_usual_pivots
from burmester.tasks.feasibility import require_feasible
from burmester.tasks.motion_kinds import FewPoses, MotionKind, Rest, Undetermined
from burmester.tasks.motion_task import CONDITIONS, Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.special_motions import CircularTranslation
from burmester.tasks.traced_path import TracedPath
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.verdicts.ranking import digits_leave_open, ranked

if TYPE_CHECKING:  # loaded where a task asks for it
    from burmester.certificates.certificate import Certificate

FEW_POSES = 2  # a rail or slot leaves so many to be met exactly, or not at all
# Outcomes that a limit may be to blame for: nothing works, or nothing but what falls short.
MAY_BE_BARRED = ("R301", "R302", "R306", "R308", "R309")
MAX_POSES = 200_000  # of a task, so that no method takes more than a gigabyte of memory
FAR_BEYOND_DIGITS = 10.0  # times the error of the digits; farther off none is looked for in them


def synthesize(
    task: Task,
    options: SynthesisOptions = SynthesisOptions(),  # noqa: B008  frozen
) -> Synthesis:
    """The dyads of a task and the linkages made of them.

    Linkages are refined as a whole, but those of the pencil are the paper's.  Fewer than five
    conditions have infinitely many dyads: see `three_poses` and `burmester_curve` for them all.
    Where a time limit ends something, a warning W221 says what.
    Raises InputError E121 (the method does not take that number of poses), E123 (it does not take
    limits, exact poses, the norm or a certificate), E126 (more poses than there is memory for),
    E130 (proofs lack their library), and E132 (limits that no link can meet).
    """
    _require_few(task)
    with limited(options.time_limit) as watch:
        answer = _synthesis(task, options)
        if answer.outcome.code in MAY_BE_BARRED:
            from burmester.synthesis.none_explained import explained  # noqa: PLC0415  seldom

            answer = explained(answer, _synthesis)
        return with_time_limit(answer, watch)


def _require_few(task: Task) -> None:
    """Refuse more poses than there is memory for, before anything is computed; raises E126."""
    if (count := task.poses.shape[0]) > MAX_POSES:
        each = math.ceil(count / MAX_POSES)
        raise InputError(
            "E126",
            f"{count} poses are too many",
            why=f"they would need more than a gigabyte of memory, and {MAX_POSES} are the most",
            help=f"take one pose in {each}, with --every {each}: so many hardly tell more",
        )


def _synthesis(task: Task, options: SynthesisOptions) -> Synthesis:
    both = task.limits * (2 if len(task.limits) == 1 else 1)
    require_feasible(task.poses, both, task.exact)
    task, repeats = each_once(task)
    if task.path is not None:
        from burmester.synthesis.path_generation import near_points  # noqa: PLC0415  paths only

        return near_points(task, options, (*task.notes, *repeats))
    step(f"looking at {task.poses.shape[0]} poses")
    task, note = with_nearest_angles(task, options)
    diagnosis = diagnose(task)
    problem = SynthesisProblem.of(task, diagnosis.motion, options)
    known = (*task.notes, *repeats, *note, *diagnosis.findings)
    if (asked := _of_points(problem, known) or _of_timed_poses(problem, known)) is not None:
        return asked
    open_ = max(problem.missing_conditions) > 0 and options.method in ("auto", "exact")
    if problem.is_special:
        parallel = isinstance(_kind(problem), CircularTranslation)
        chosen = _of_family(problem.merged(), known) if open_ and parallel else None
        if isinstance(_kind(problem), Undetermined):
            chosen = _within_digits(problem, known)
        return chosen or _special_motion(problem, known)
    exceeded = open_ and min(problem.missing_conditions) < 0
    if exceeded and not problem.has_rails:
        return _dyad_family(problem, known)
    if open_:
        chosen = None if exceeded and task.tolerances is None else _of_family(problem, known)
        works = chosen is not None and any(each.usable for each in chosen.linkages)
        if works or not problem.has_rails or task.poses.shape[0] <= FEW_POSES:
            return chosen or _no_family(problem, known)
        known = (*known, _exceeded_by_rail(problem))
    problem = with_method(problem)
    step("looking for dyads")
    search = search_dyads(problem)
    pairs, twice = search.pairs(problem.length)
    linkages = _linkages(problem, pairs)
    if problem.leaves_linkages_open or open_:  # no pose determines their pivots
        linkages = tuple(
            replace(each, uncertainty=None, determined=True, other_types=()) for each in linkages
        )
    outcome = summary(problem, search, linkages)
    if outcome.code == "R305":
        linkages = with_linkages_within_digits(problem, pairs, linkages)
        outcome = summary(problem, search, linkages)
    linkages, assumed = with_usual_pivots(problem, linkages)
    if assumed:
        outcome = summary(problem, search, linkages)
    outcome = offering_six_bars(problem, outcome)
    warnings = (
        *_odd_pose(problem, search),
        *known,
        *dyad_advice(problem, search, linkages),
        *(
            Advice(
                "W205",
                f"{first.id} and {second.id} are the same dyad within rounding",
                "only one constraint was found; give more poses, or more different ones",
            )
            for first, second in twice
        ),
        *assumed,
        *linkage_advice(task, linkages, outcome.code),
        *sample_advice(problem, linkages),
    )
    proves = options.certify and time_for("proving what was found", whole=True)
    proved = _certificate(problem, search) if proves else None
    return Synthesis(problem, outcome, search.dyads, linkages, warnings, search.fits, proved)


def _kind(problem: SynthesisProblem) -> MotionKind | None:
    return None if problem.motion is None else problem.motion.kind


def _of_points(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis | None:
    """Poses and points with finitely many linkages: all, of fewer points some; else None."""
    task, options = problem.given, problem.options
    if task.tolerances is None or options.method not in ("auto", "exact"):
        return None
    from burmester.synthesis.path_generation import near_points  # noqa: PLC0415  few need it
    from burmester.synthesis.point_generation import through_points  # noqa: PLC0415  the same

    found = through_points(problem, findings)
    traced = task.tolerances.are_points and problem.task.poses.shape[0] >= CONDITIONS
    open_ = problem.leaves_linkages_open or special_curve(task) is not None
    if found is None and traced and open_:
        return near_points(replace(task, path=TracedPath()), options, findings)
    return found


def _of_timed_poses(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis | None:
    """Poses that the crank times more than fully: the nearest linkages; None for others."""
    timed = problem.given.timing is not None and not problem.is_special
    if not timed or min(problem.missing_conditions) >= 0:
        return None
    from burmester.synthesis.timed_poses import near_timed_poses  # noqa: PLC0415  few need it

    return near_timed_poses(problem, findings)


def _of_family(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis | None:
    """Too few conditions leave infinitely many linkages: the best of them; None if none meets."""
    # Few tasks need them.
    from burmester.families.family import best_of_family, recommended_first  # noqa: PLC0415
    from burmester.families.least_excess import last_search  # noqa: PLC0415
    from burmester.synthesis.family_outcome import family_summary  # noqa: PLC0415  the same

    target = target_of(problem)
    step("looking at the linkages of the family")
    found = best_of_family(problem, target)
    if found is None or not (found.works or found.family.loaded):
        found = last_search(problem, target, found)
    if found is None:
        return None
    evaluation = Evaluation(problem, target)
    own = found.batch.from_canonical(target.frames)
    some = Candidates.of_own_dyads(found.batch, found.rows, own, from_search=True)
    members = evaluation.members(some._replace(drivers=found.drivers))
    if bearing := bearing_linkages(members, evaluation):
        members = recommended_first([*members, *bearing], problem)
    if problem.options.rounds:
        members = recommended_first(evaluation.rounded(members), problem)
    linkages = at_given_poses(numbered(evaluation.with_spreads(members)), problem)
    dyads = tuple(dyad for each in linkages for dyad in each.dyads)
    outcome, advice = family_summary(problem, found.family, linkages)
    if problem.task.timing is not None:
        from burmester.synthesis.timed_poses import of_timed_drivers  # noqa: PLC0415  the same

        outcome = of_timed_drivers(problem, outcome)
    more = [] if found.family.given_up else linkage_advice(problem.given, linkages, outcome.code)
    warnings = (*findings, *advice, *more)
    return Synthesis(problem, outcome, dyads, linkages, warnings, family=found.family)


def _exceeded_by_rail(problem: SynthesisProblem) -> Advice:
    """Poses that no linkage was found to meet on the rail: they are met as nearly as can be."""
    return Advice(
        "W256",
        f"no linkage was found that meets the {problem.given.poses.shape[0]} poses with this rail "
        "or slot: what follows comes as near to them as it can",
        "give the rail or slot more room (a tolerance of its direction, a longer segment that it "
        "passes through), or mark with --exact what must be met",
    )


def _no_family(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis:
    """Too few conditions, and no linkage that meets them within the limits."""
    from burmester.synthesis.family_outcome import none_within_limits  # noqa: PLC0415  seldom

    outcome = none_within_limits(problem)
    if problem.task.timing is not None:
        from burmester.synthesis.timed_poses import of_timed_drivers  # noqa: PLC0415  the same

        outcome = of_timed_drivers(problem, outcome)
    return Synthesis(problem, outcome, warnings=tuple(findings))


def _within_digits(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis | None:
    """Poses that determine no dyads: the best linkages that pass within their digits, if any."""
    few = max(problem.missing_conditions) > 0
    if few or tolerances_of_digits(problem.given) is None or problem.options.method != "auto":
        return None
    problem = with_method(problem.merged())
    search = search_dyads(problem)
    pairs, _ = search.pairs(problem.length)
    linkages = with_linkages_within_digits(problem, pairs, ())
    if not linkages:
        return None
    outcome = undetermined(problem, search, linkages)
    warnings = (
        *findings,
        *linkage_advice(problem.given, linkages, outcome.code),
        *sample_advice(problem, linkages),
    )
    return Synthesis(problem, outcome, search.dyads, linkages, warnings, search.fits)


def _dyad_family(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis:
    """Infinitely many dyads, and no pair of them that meets the poses: those of one limit."""
    task, missing, dyads = problem.task, problem.missing_conditions, []
    for number, (each, left) in enumerate(zip(task.limits, missing, strict=False), start=1):
        if left <= 0:
            every = np.full(task.poses.shape, left == 0)
            found, _ = found_dyads(best_dyads(task.poses, None, every, each), task)
            dyads += [replace(one, limits=number) for one in found]
    outcome, warning = family(problem)
    numbered = tuple(replace(each, id=f"D{i}") for i, each in enumerate(dyads, start=1))
    return Synthesis(problem, outcome, numbered, warnings=(*findings, warning))


def _special_motion(problem: SynthesisProblem, findings: Sequence[Advice]) -> Synthesis:
    """A special motion: what is certain of it is the whole answer."""
    assert problem.motion is not None
    kind, task = problem.motion.kind, problem.given
    dyads = dyads_of_motion(kind, task)
    pairs = list(combinations(dyads, 2))
    if task.timing is not None:  # either may be the driver
        pairs += [pair[::-1] for pair in pairs]
    linkages = _linkages(problem.merged(), pairs, refine=False) if pairs else ()
    outcome = Outcome(kind.code, kind.message, kind.help)
    if isinstance(kind, Rest | FewPoses):  # these outcomes name the repeated poses themselves
        findings = [each for each in findings if each.code != "W208"]
    warnings = (*findings, *linkage_advice(task, linkages, outcome.code))
    return Synthesis(problem, outcome, dyads, linkages, warnings)


def _linkages(
    problem: SynthesisProblem, pairs: Sequence[Pair], *, refine: bool = True
) -> tuple[FoundLinkage, ...]:
    """The linkages of pairs of dyads, with their errors at all poses, repeated ones too."""
    return at_given_poses(linkages_from_dyads(problem, pairs, refine=refine), problem)


def _odd_pose(problem: SynthesisProblem, search: DyadSearch) -> list[Advice]:
    """One pose that does not agree with all others."""
    task = problem.task
    every = problem.options.method == "complete" and not task.limits and task.exact is None
    dyads = [each.dyad for each in search.dyads] if every else []
    odd = disagreement(problem.given, problem.motion, dyads)
    return [] if odd is None else [odd]


def _certificate(problem: SynthesisProblem, search: DyadSearch) -> Certificate:
    """What is proved of the dyads."""
    from burmester.certificates.certificate import certify, certify_five  # noqa: PLC0415  on demand

    task, fit = problem.task, search.fits[0]
    dyads: list[Dyad] = [each.dyad for each in search.dyads]
    if isinstance(fit, FivePoseDyads):
        return certify_five(task.poses, fit, dyads)
    assert isinstance(fit, BestDyads)
    assert isinstance(fit.search, CriticalDyads)
    return certify(task.poses, task.weights, fit.search, dyads)


def tolerances_of_digits(task: Task) -> PoseTolerances | None:
    """The resolution of the poses as their tolerances; None where they have some, or are exact."""
    position, angle = task.resolution
    exact = task.exact is not None and bool(task.exact.any())
    if task.tolerances is not None or exact or not (position > 0 and angle > 0):
        return None
    return PoseTolerances.uniform(task.poses.shape[0], position, position, angle)


def with_linkages_within_digits(
    problem: SynthesisProblem, pairs: Sequence[Pair], known: Sequence[FoundLinkage]
) -> tuple[FoundLinkage, ...]:
    """The known linkages and those that pass within the digits of the poses, by rank.

    pairs: of the dyads.  Nothing is added where the poses are exact, or have tolerances already,
    and where the nearest of the known ones misses them by far more than their digits.
    """
    tolerances = tolerances_of_digits(problem.task)
    if tolerances is None or not problem.options.refines or problem.options.rounds:
        return tuple(known)
    nearest = min((each.combined_error for each in known), default=0.0)
    if nearest > FAR_BEYOND_DIGITS * digits_leave_open(problem):
        return tuple(known)
    if not time_for("looking for the best linkages within the digits"):
        return tuple(known)
    loose = replace(problem, task=replace(problem.task, tolerances=tolerances))
    found = [
        replace(each, within_tolerance=None)
        for each in linkages_from_dyads(loose, pairs)
        if each.usable
    ]
    every = ranked([*known, *at_given_poses(found, problem)], problem)
    return tuple(numbered(every))
