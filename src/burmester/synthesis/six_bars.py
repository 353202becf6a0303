"""From a task to six-bars, for poses that no four-bar meets; the judgement of one that exists."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from burmester.cures import Cure, Help
from burmester.diagnosis.checks import diagnose
from burmester.errors import Advice, InputError
from burmester.progress import limited, step
from burmester.requirements.transmission import TRANSMISSION
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.judged import judged_six_bar
from burmester.sixbar.kinds import KINDS, SixBar
from burmester.sixbar.search_space import FEWEST, POSES, require_kept
from burmester.sixbar.six_bars import SixBarOptions, SixBars, best_six_bars
from burmester.synthesis.given_linkage import require_computable
from burmester.synthesis.judgement import judged_outcome
from burmester.synthesis.result import Outcome, Synthesis, with_time_limit
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.assumptions import assumed_advice
from burmester.verdicts.explanation import cures_of
from burmester.wording import count, figure, least_angle, listed

MORE = 10  # times as many chains are proposed where none was found


__all__ = ["KINDS", "SixBar", "judge_six_bar", "judged_at_poses"]

SAME_JOINT = 1e-6  # sizes of the motion; joints of a link that are nearer to each other are one
FARTHEST = 1e6  # sizes of the motion; of what is longer rounding takes too many digits


def synthesize_six_bars(
    task: Task,
    six_bars: SixBarOptions = SixBarOptions(),  # noqa: B008  frozen
    options: SynthesisOptions = SynthesisOptions(),  # noqa: B008  frozen
) -> Synthesis:
    """The best six-bars (Watt I, Stephenson I and III) that a random search finds for a task.

    Of `options` the time limit counts.  Where it ends the search, a warning W221 says so.
    Raises InputError E195 (poses that do not fit), E196 (what six-bars are not looked for with).
    """
    with limited(options.time_limit) as watch:
        step(f"looking at {task.poses.shape[0]} poses")
        problem = SynthesisProblem.of(task, diagnose(task).motion, options)
        result = best_six_bars(problem, six_bars)
        warnings = (*task.notes, *_advice(result))
        synthesis = Synthesis(problem, _outcome(task, result), warnings=warnings, six_bars=result)
        return with_time_limit(synthesis, watch)


def six_bars_of_chains(task: Task, chains: int | None, options: SynthesisOptions) -> Synthesis:
    """The same for faces, which know no kind of linkage: of so many chains, or as many as usual."""
    usual = SixBarOptions()
    return synthesize_six_bars(
        task, usual if chains is None else replace(usual, chains=chains), options
    )


def _outcome(task: Task, result: SixBars) -> Outcome:
    """What came of it, in one sentence."""
    looked = f"{result.designs:,} from {count(result.chains, '3R chain')}"
    if result.found:
        first = result.found[0]
        return Outcome(
            "R370",
            f"{result.working:,} six-bars that work, of {looked}; {first.id} transmits at "
            f"{least_angle(first.transmission)} or more",
        )
    chains = MORE * result.options.chains
    narrow = bool(task.limits) or task.requirements.has_any
    return Outcome(
        "R371",
        f"no six-bar that works: none of {looked}",
        Help(
            "look at more chains, such as ",
            Cure("chains", chains),
            ", or ask for less" if narrow else ", or move a pose",
        ),
        "the chains were drawn at random, so that this proves nothing",
    )


def _advice(result: SixBars) -> Iterator[Advice]:
    """What was assumed, what was free, and whether one would build the best of them."""
    if result.assumed:
        yield assumed_advice("W234", result.assumed)
    if result.free_poses:
        free = count(result.free_poses, "pose")
        yield Advice(
            "W235",
            f"{POSES - result.free_poses} poses leave a six-bar free; {free} between them "
            f"{'was' if result.free_poses == 1 else 'were'} drawn at random",
            f"give {POSES} poses, if the way between them counts",
        )
    if result.found and result.found[0].shortcomings:
        first = result.found[0]
        yield Advice(
            "W236",
            f"no six-bar was found that meets the standard of linkages to build; {first.id} "
            f"{listed(first.shortcomings)}",
            Help.of(
                "look at more chains, such as {}, give the pivots more room, or move a pose",
                Cure("chains", MORE * result.options.chains),
            ),
            f"the standard is a transmission angle of {TRANSMISSION.standard:g}° or more and "
            "links of like lengths, within some sizes of the motion",
        )


def judge_six_bar(
    task: Task,
    linkage: SixBar,
    options: SynthesisOptions = SynthesisOptions(),  # noqa: B008  frozen
) -> Synthesis:
    """One six-bar at the poses of a task, with errors, verdict, defects and violations.

    It has the dimensions that are given: nothing is refined.  It is judged on the branch where it
    works, else on that where it is nearest to the poses, and driven at the better crank.
    task: two poses or more; they may be points, and have tolerances.
    linkage: no leading axes.

    Raises InputError E112 (numbers too large), E154 (two joints at one place), E155 (a six-bar that
    can be assembled nowhere), E195 (one pose), E196 (what six-bars do not keep).
    """
    require_kept(task, judged=True)
    with limited(options.time_limit) as watch:
        step(f"looking at {task.poses.shape[0]} poses")
        motion = diagnose(task).motion
        if motion is None or motion.distinct < FEWEST:
            message = "a six-bar is judged at two different poses or more, and here is one"
            raise InputError("E195", message, help="give another pose as well")
        problem = SynthesisProblem.of(task, motion, options)
        step("judging the six-bar")
        found = judged_at_poses(linkage, problem)
        six_bars = SixBars((found,), 0, 1, int(found.usable), SixBarOptions(), (), 0, given=True)
        outcome = judged_outcome(found, problem)
        if not found.usable:
            outcome = replace(outcome, help=_help(found, problem))
        judged = Synthesis(problem, outcome, warnings=task.notes, six_bars=six_bars)
        return with_time_limit(judged, watch)


def judged_at_poses(
    linkage: SixBar, problem: SynthesisProblem, driver: object = None
) -> FoundSixBar:
    """A six-bar where it works, else where it is nearest; raises E112, E154 and E155.

    driver: the crank that is to drive, where it works so; what is none is as nothing.
    """
    _require_links(linkage, problem)
    for pivot in linkage.skeleton.drivers:
        if linkage.driver_name(pivot) == driver:
            found = judged_six_bar(linkage, problem, (pivot,))
            if found.usable:
                return found
    return judged_six_bar(linkage, problem)


def _require_links(linkage: SixBar, problem: SynthesisProblem) -> None:
    """Refuse numbers that cannot be computed with, E112, and links without length, E154."""
    task, size = problem.given, problem.motion_size
    require_computable("the six-bar", linkage.numbers())
    skeleton = linkage.skeleton
    lengths = dict(zip(skeleton.bars, linkage.lengths().tolist(), strict=True))
    for bar, length in lengths.items():
        link = next(name for name, own in skeleton.links.items() if set(bar) <= set(own))
        if length <= SAME_JOINT * size:
            raise InputError(
                "E154",
                f"joints {bar[0]} and {bar[1]} of the six-bar are at one place",
                why=f"both are on the {link}, and are {figure(length)} apart",
                help="give each joint of a link a place of its own, in the frame of that link",
            )
        if length > FARTHEST * size:
            raise InputError(
                "E112",
                f"the {link} is too long to compute with",
                why=f"{bar} is {length_of(length, task)} long; the poses span "
                f"{length_of(span(task), task)}",
                help="give the six-bar in the unit of the poses",
            )


def _help(found: FoundSixBar, problem: SynthesisProblem) -> str:
    """What would make it work: options where they do, else another six-bar."""
    cures = cures_of(found, problem)
    texts: list[str] = [Help.of("with {} it would do", cures)] if cures else []
    if FEWEST <= problem.given.poses.shape[0] <= POSES:
        texts.append("look for six-bars that work with `burmester synthesize --six-bars`")
    elif not texts:
        texts.append("move a pose, or leave one out")
    return Help.joined("; or ", texts)
