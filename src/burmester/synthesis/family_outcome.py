"""What came of a task whose poses leave infinitely many linkages, in words."""

from __future__ import annotations

from collections.abc import Sequence

from burmester.errors import Advice
from burmester.families.family import Family
from burmester.requirements.links import LINK_RATIO
from burmester.requirements.transmission import TRANSMISSION
from burmester.synthesis.result import Outcome
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.stated_limits import stated_limits
from burmester.verdicts.assumptions import assumed_advice
from burmester.verdicts.explanation import SPRING_HELP, in_short
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.wording import count, listed


def family_summary(
    problem: SynthesisProblem, family: Family, linkages: Sequence[FoundLinkage]
) -> tuple[Outcome, list[Advice]]:
    """The outcome and the warnings of a task whose linkages were chosen from a family."""
    poses = count(problem.given.poses.shape[0], "pose")
    advice = [assumed_advice("W215", family.bounds)] if family.bounds else []
    looked = f"{family.pairs:,} pairs of {family.dyads:,} dyads"
    usable = [each for each in linkages if each.usable]
    if not usable:
        why = None
        if linkages:
            nearest = linkages[0]
            why = f"the nearest to it, {nearest.id}, "
            why += in_short(nearest, problem.given, problem.length)
        message = f"and none works of {looked} that were looked at"
        if family.loaded:
            message = (
                f"{family.loaded} of {looked} that work without their loads were loaded, and none "
                "bears what is asked"
            )
        help = "give the limits more room, ask for less, or move a pose"
        outcome = Outcome(
            "R309",
            f"no usable linkage: {poses} leave infinitely many, {message}",
            f"{SPRING_HELP}; or {help}" if family.loaded else help,
            why,
        )
        return outcome, advice
    if family.given_up:
        first = usable[0]
        advice.append(
            Advice(
                "W216",
                f"no linkage was found that transmits at {TRANSMISSION.assumed[0]:g}° and has a "
                f"link ratio of {LINK_RATIO.assumed[0]:g} at most, or what the task asks instead; "
                f"{first.id} " + listed(first.shortcomings or ("comes nearest",)),
                "give the pivots more room, or move a pose",
            )
        )
    message = f"{poses} leave infinitely many linkages; these were chosen from {looked}. "
    message += family.rule
    return Outcome("R308", message), advice


def none_within_limits(problem: SynthesisProblem) -> Outcome:
    """The outcome where no two dyads of the family were found within the limits."""
    poses = count(problem.given.poses.shape[0], "pose")
    where, help = "within the limits", "give the limits more room, or allow another kind of dyad"
    if not any(stated_limits(problem.given)):
        where, help = "that can be built near the motion", "move a pose, or leave one out"
    return Outcome(
        "R309", f"no linkage: {poses} leave infinitely many dyads, and none was found {where}", help
    )
