"""From a task to six-bars, for poses that no four-bar guides a body through."""

from __future__ import annotations

from collections.abc import Iterator

from burmester.cures import Cure, Help
from burmester.diagnosis.checks import diagnose
from burmester.errors import Advice
from burmester.progress import limited, step
from burmester.requirements.transmission import TRANSMISSION
from burmester.sixbar.search_space import POSES
from burmester.sixbar.six_bars import SixBarOptions, SixBars, best_six_bars
from burmester.synthesis.result import Outcome, Synthesis, with_time_limit
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.assumptions import assumed_advice
from burmester.wording import count, least_angle, listed

MORE = 10  # times as many chains are proposed where none was found


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
