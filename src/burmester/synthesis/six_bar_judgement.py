"""The judgement of a six-bar that exists: what is said of it is what is said of a four-bar."""

from __future__ import annotations

from dataclasses import replace

from burmester.cures import Help
from burmester.diagnosis.checks import diagnose
from burmester.errors import InputError
from burmester.progress import limited, step
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.judged import judged_six_bar
from burmester.sixbar.kinds import KINDS, SixBar
from burmester.sixbar.search_space import FEWEST, POSES, require_kept
from burmester.sixbar.six_bars import SixBarOptions, SixBars
from burmester.synthesis.given_linkage import require_computable
from burmester.synthesis.judgement import judged_outcome
from burmester.synthesis.result import Synthesis, with_time_limit
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.explanation import cures_of
from burmester.wording import figure

__all__ = ["KINDS", "SixBar", "judge_six_bar", "judged_at_poses"]

SAME_JOINT = 1e-6  # sizes of the motion; joints of a link that are nearer to each other are one
FARTHEST = 1e6  # sizes of the motion; of what is longer rounding takes too many digits


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
