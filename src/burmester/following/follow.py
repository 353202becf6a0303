"""Following: the answers of a task that differs a little, each continued from its predecessor."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from burmester.dyads.selection import FoundDyad
from burmester.following.changes import dyad_changes, linkage_changes
from burmester.following.dyad_strands import DyadStrands, NewDyads
from burmester.following.followed import Followed
from burmester.following.likeness import require_followable, require_like
from burmester.following.linkage_strands import LinkageStrands, NewLinkages
from burmester.fourbar.dyad import PP
from burmester.linkages.evaluation import Candidates, Evaluation, at_given_poses
from burmester.linkages.from_dyads import target_of
from burmester.synthesis.result import Synthesis
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.problem import SynthesisProblem
from burmester.values import require_instance
from burmester.verdicts.found_linkage import FoundLinkage, Pair

__all__ = ["follow"]


def follow(
    previous: Synthesis | Followed, task: Task, *, judged: Collection[str] | None = None
) -> Followed:
    """The answers of a task that differs a little from that of a synthesis, each with its id.

    Dyads and linkages are continued from their predecessors: nothing is searched for and nothing
    is ranked, so that a person who drags a pose sees every answer move.  Verdicts are those of the
    new places, by the code that judges every linkage.

    Parameters
    ----------
    previous : Synthesis, Result or Followed
        The answers before: of `burmester.synthesize`, or what an earlier follow returned.
    task : Task
        The new task.  Poses, weights, limits, requirements and tolerances may have other numbers;
        a step should be short, such as a hundredth of the motion.
    judged : collection of str, optional
        The ids of the linkages that are judged anew; all if it is not given.  The others are
        continued, too, but keep the errors and verdicts of the answers before until a follow judges
        them: that is quicker, for the steps of a hand.

    Returns
    -------
    Followed
        The answers, what changed, and where the follow is not sure of itself (`uncertain`): then
        `burmester.synthesize` should be run.

    Raises
    ------
    InputError
        E125 (no `Task`, or nothing to follow), E157 (a task that differs in more than its numbers,
        a special motion, dimensions that are rounded, or the norm "worst").

    Examples
    --------
    >>> import burmester
    >>> from burmester import Displacement, Task
    >>> task = burmester.read_task("case:motiongen-shoulder")
    >>> result = burmester.synthesize(task)
    >>> moved = task.poses.translation.copy()
    >>> moved[2] += [0.02, 0]
    >>> followed = burmester.follow(result, Task(Displacement(moved, task.poses.angle)))
    >>> [linkage.id for linkage in followed.usable], followed.changes
    (['L1', 'L2', 'L3'], ())
    """
    require_instance(
        previous, (Synthesis, Followed), "previous", "give what synthesize or follow returned"
    )
    require_instance(
        task, Task, "task", 'give a Task, such as Task.from_rows(rows, angle_unit="deg")'
    )
    start = previous if isinstance(previous, Followed) else _started(previous)
    motion = classify_motion(task) if task.poses.shape[0] > 1 else None
    problem = SynthesisProblem.of(task, motion, start.problem.options)
    is_family = not start.dyad_strands.fits
    if is_family:
        problem = problem.merged()
    require_like(start.problem, problem, is_family=is_family)
    new = start.dyad_strands.continued(problem)
    dyads, doubts = _named(new, start)
    target = target_of(problem)
    known = {each.id: each for each in dyads}
    there = start.linkage_strands.continued(
        target, problem.task.limits, start.problem.task.poses, known
    )
    appeared = [each for each in dyads if each.id not in {old.id for old in start.dyads}]
    there = there.with_pairs(_new_pairs(appeared, dyads, problem), target, start.last_numbers[1])
    linkages = _judged(start, there, known, judged, Evaluation(problem, target))
    last = (
        max([start.last_numbers[0], *(int(each.id[1:]) for each in dyads)]),
        max([start.last_numbers[1], *(int(each.id[1:]) for each in linkages)]),
    )
    before = {each.id: each for each in start.linkages}
    if is_family:
        dyads = tuple(dyad for each in linkages for dyad in each.dyads)
    changes = [] if is_family else dyad_changes(start.dyads, dyads, task)
    changes += linkage_changes(before, linkages, there.vanished, task)
    return Followed(
        problem,
        dyads,
        linkages,
        tuple(changes),
        (*new.doubts, *doubts, *there.doubts),
        new.strands,
        there.strands,
        last,
    )


def _started(synthesis: Synthesis) -> Followed:
    """A synthesis as if it had been followed."""
    require_followable(synthesis)
    problem = synthesis.problem
    dyads = synthesis.dyads if synthesis.fits else ()
    strands = LinkageStrands.of(
        synthesis.linkages,
        dyads,
        problem.task.limits,
        problem.pose_numbers,
        target_of(problem),
    )
    return Followed(
        problem,
        synthesis.dyads,
        synthesis.linkages,
        (),
        (),
        DyadStrands.of(synthesis.fits, problem),
        strands,
        (len(synthesis.dyads), len(synthesis.linkages)),
    )


def _named(new: NewDyads, start: Followed) -> tuple[tuple[FoundDyad, ...], list[str]]:
    """The new dyads with the ids of those that they continue, and what is doubtful of that."""
    if not new.strands.fits:
        return start.dyads, []
    old, doubtful = new.identities(start.dyads)
    last, dyads = start.last_numbers[0], []
    for found, number in zip(new.found, old, strict=True):
        if number < 0:
            last += 1
        id = start.dyads[number].id if number >= 0 else f"D{last}"
        dyads.append(replace(found, id=id))
    dyads.sort(key=lambda each: int(each.id[1:]))
    return tuple(dyads), [
        f"{start.dyads[one].id} and {start.dyads[other].id} are too near to each other to be told "
        "apart"
        for one, other in doubtful
    ]


def _new_pairs(
    appeared: Sequence[FoundDyad], dyads: Sequence[FoundDyad], problem: SynthesisProblem
) -> list[Pair]:
    """The pairs of dyads that one of those that appeared belongs to."""
    new = {each.id for each in appeared}
    pairs = []
    for first, second in combinations(sorted(dyads, key=lambda each: each.limits), 2):
        apart = len(problem.task.limits) < 2 or first.limits != second.limits
        kinds = any(isinstance(each.dyad, PP) for each in (first, second))
        if apart and not kinds and not new.isdisjoint((first.id, second.id)):
            pairs.append((first, second))
    return pairs


def _judged(
    start: Followed,
    there: NewLinkages,
    dyads: dict[str, FoundDyad],
    only: Collection[str] | None,
    evaluation: Evaluation,
) -> tuple[FoundLinkage, ...]:
    """The linkages with errors and verdicts, in the order of their ids; only: of these ids anew."""
    before = {each.id: each for each in start.linkages}
    index = [
        k
        for k, id in enumerate(there.strands.ids)
        if only is None or id in only or id not in before
    ]
    if not index:
        return tuple(before[id] for id in there.strands.ids)
    strands = there.strands.at(np.array(index, dtype=np.intp))
    known = {each.id: each for old in start.linkages for each in old.dyads} | dyads
    pairs = [(known[one], known[two]) for one, two in strands.pairs]
    rows = there.rows[index]
    found = evaluation.members(
        Candidates(there.batch[index], rows, pairs, strands.from_search, strands.own), quality=False
    )
    named = [
        replace(each, id=id, rank=rank, determined=determined)
        for each, id, rank, determined in zip(
            found, strands.ids, strands.ranks, strands.determined, strict=True
        )
    ]
    new = {each.id: each for each in at_given_poses(named, evaluation.problem)}
    return tuple(new[id] if id in new else before[id] for id in there.strands.ids)
