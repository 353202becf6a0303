"""Springs for the linkages of a task: each usable linkage with the springs that balance it best."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.linkages.bearing_linkages import (
    meets_exactly,
    only_bears_too_much,
    refined_under_loads,
)
from burmester.linkages.evaluation import Evaluation, at_given_poses
from burmester.linkages.from_dyads import target_of
from burmester.loads.balance import Balanced, Offer, balanced
from burmester.numerics.arrays import FloatArray
from burmester.progress import step, time_for
from burmester.requirements.loads import DRIVER_TORQUE, HAND_FORCE, OF_LOADS
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.result import Synthesis
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.judged_linkage import LinkageAtPoses
from burmester.verdicts.ranking import digits_leave_open, farthest_recommended

MOST_LINKAGES = 6  # of an answer, the best first
EACH = 3  # springs that are told of a linkage
MOST_SPRINGS = 6  # the same of one that is chosen
MOST_MOVED = 2  # linkages whose pivots are moved
TURNS = 6  # at which pivots are moved, then the spring
LESS, MOST_SHARE = 0.7, 0.95  # of the force that is left, at first and at most the next aim
ENOUGH = 0.99  # of the force; less gained ends it
FARTHEST = 0.01  # motion sizes; poses are missed by no more, where the task states no tolerance
WIDER = 0.5  # sizes of the linkage by which the usual region of the ground is wider than its pivots


class BalanceRegions(NamedTuple):
    """Where a spring may attach: boxes (2, 2) of corners in F and in M; None for the usual ones."""

    ground: FloatArray | None = None
    body: FloatArray | None = None


def balance(
    task: Task,
    offers: Sequence[Offer],
    regions: BalanceRegions | None = None,
    options: SynthesisOptions | None = None,
    *,
    with_linkage: bool = False,
) -> tuple[Synthesis, list[Balanced]]:
    """The answer of a task without bounds on its loads, and its linkages with springs.

    Those that keep all bounds come first, then those with the least force of the hand, or with the
    most reserve in its corridor.
    with_linkage: whether pivots move too, of the best few; the poses stay as near as is asked.
    Raises InputError E134 where the task has no loads.
    """
    if task.loads is None:
        raise nothing_to_balance()
    asked = task.requirements
    free = {each.name: each.default for each in OF_LOADS}
    answer = synthesize(
        replace(task, requirements=replace(asked, **free)), options or SynthesisOptions()
    )
    out = list[Balanced]()
    for found in [each for each in answer.linkages if each.usable][:MOST_LINKAGES]:
        step(f"looking at springs for {found.id}")
        own = replace(found, task=replace(found.task, requirements=asked))
        out += springs_for(own, offers, regions, EACH)
    out.sort(key=lambda each: each.order)
    if with_linkage:
        first = {each.found.id: each for each in reversed(out)}
        for each in sorted(first.values(), key=lambda each: each.order)[:MOST_MOVED]:
            if time_for(f"moving the pivots of {each.found.id}"):
                out += with_moved_pivots(each, answer.problem, offers, regions)
        out.sort(key=lambda each: each.order)
    return answer, out


def nothing_to_balance() -> InputError:
    """E134: a task without loads."""
    return InputError(
        "E134",
        "there is nothing to balance: the task has no loads",
        help="state the mass of the body and where the hand is, in the table loads",
    )


def springs_for(
    found: LinkageAtPoses,
    offers: Sequence[Offer],
    regions: BalanceRegions | None = None,
    most: int = MOST_SPRINGS,
) -> list[Balanced]:
    """The best springs for one linkage, in the regions; raises InputError E134 without loads."""
    if found.task.loads is None:
        raise nothing_to_balance()
    ground, body = (
        usual if given is None else given
        for given, usual in zip(regions or BalanceRegions(), usual_regions(found), strict=True)
    )
    return balanced(found, offers, ground, body, most)


def with_moved_pivots(
    start: Balanced,
    problem: SynthesisProblem,
    offers: Sequence[Offer],
    regions: BalanceRegions | None = None,
) -> list[Balanced]:
    """A linkage moved for its spring and the spring for it, by turns with less force; or none.

    start: of a linkage of four bars, its task without that spring being that of the problem.
    """
    asked = start.found.task.requirements
    given = start.found
    assert isinstance(given, FoundLinkage)
    assert given.task.loads is not None
    bare = replace(
        given.task, loads=replace(given.task.loads, springs=given.task.loads.springs[:-1])
    )
    bound = HAND_FORCE if start.figures.hand is not None else DRIVER_TORQUE
    best, share = start, LESS
    for _ in range(TURNS):
        corridor = isinstance(asked.bounds.get(bound), tuple)  # is aimed at as it is
        force: dict[str, Any] = {} if corridor else {bound.name: share * best.worst}
        assert isinstance(best.found, FoundLinkage)
        found = replace(
            best.found, task=replace(best.found.task, requirements=replace(asked, **force))
        )
        better = list[Balanced]()
        for each in _refined(found, problem):
            own = replace(each, id=f"{given.id}'", task=bare)
            better += springs_for(own, offers, regions, 1)
        one = min(better, key=lambda each: each.order, default=best)
        gains = one.keeps > best.keeps or one.cost < ENOUGH * best.cost
        if gains and one.keeps >= best.keeps:
            best = one
        elif share < MOST_SHARE:
            share = math.sqrt(share)
        else:
            break
    return [] if best is start else [replace(best, before=start.before, unmoved=start)]


def _refined(found: FoundLinkage, problem: SynthesisProblem) -> list[FoundLinkage]:
    """A linkage refined under the bounds of its task, if it comes near enough to the poses."""
    one = replace(problem.task, requirements=found.task.requirements, loads=found.task.loads)
    problem = replace(problem, given=found.task, task=one)
    evaluation = Evaluation(problem, target_of(problem))
    most = farthest_recommended(found, problem)
    most = digits_leave_open(problem) if meets_exactly(evaluation) else max(
        most, FARTHEST * problem.motion_size
    )  # fmt: skip
    judged = evaluation.members(refined_under_loads(found, evaluation), quality=False)
    good = [
        each
        for each in judged
        if (each.usable or only_bears_too_much(each)) and each.combined_error <= most
    ]
    return list(at_given_poses(good, problem))


def usual_regions(found: LinkageAtPoses) -> tuple[FloatArray, FloatArray]:
    """Boxes about the pins on the ground, and about the body: its pins and its outline."""
    bodies = found.bodies
    fixed, moving = (
        np.array([each.holes[name] for each in bodies.joints if name in each.holes])
        for name in ("ground", bodies.body)
    )
    size = max(float(np.ptp(each, axis=0).max()) for each in (fixed, moving))
    wider = WIDER * size
    outline = found.task.body
    own = moving if outline is None else np.concatenate([moving, outline.vertices])
    return (
        np.array([fixed.min(axis=0) - wider, fixed.max(axis=0) + wider]),
        np.array([own.min(axis=0), own.max(axis=0)]),
    )
