"""Following: the answers of a task that differs a little, each continued from its predecessor."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from burmester.dyads.selection import FoundDyad
from burmester.errors import InputError
from burmester.following.dyad_strands import DyadStrands, NewDyads
from burmester.following.followed import Change, Followed
from burmester.following.linkage_strands import LinkageStrands, NewLinkages
from burmester.fourbar.dyad import PP
from burmester.linkages.evaluation import Candidates, Evaluation, at_given_poses
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import take
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.tasks.problem import SynthesisProblem
from burmester.values import require_instance
from burmester.verdicts.explanation import reasons
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.wording import count, in_unit, listed

ANEW = "call burmester.synthesize with the new task, and follow from there"


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
    strands = take(there.strands, np.array(index, dtype=np.intp))
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


def require_followable(synthesis: Synthesis) -> None:
    """Refuse a synthesis whose answers have nothing to be followed by: E157."""
    options = synthesis.options
    reason = None
    if synthesis.outcome.code in JUDGED:
        reason = "it is the judgement of a given linkage"
    elif options.norm != "rms":
        reason = "it minimises the worst distance, which has kinks"
    elif options.rounds:
        reason = "its dimensions are rounded, and would jump"
    elif not synthesis.fits and synthesis.family is None:
        reason = f"its outcome is {synthesis.outcome.code}: {synthesis.outcome.message}"
    if reason is not None:
        raise InputError("E157", "this synthesis cannot be followed", why=reason, help=ANEW)


def require_like(old: SynthesisProblem, new: SynthesisProblem, *, is_family: bool = False) -> None:
    """Refuse a task that differs from the one before by more than its numbers: E157.

    is_family: whether linkages of too few poses are followed, which any motion has.
    """
    before, after = old.given, new.given
    one, two = before.poses.shape[0], after.poses.shape[0]
    reason = None
    if one != two:
        reason = f"it has {count(two, 'pose')} instead of {one}"
    elif before.length_unit != after.length_unit:
        units = [in_unit(each.length_unit or "no unit") for each in (after, before)]
        reason = f"its lengths are{units[0]}, not{units[1]}"
    elif not _same_marks(before, after):
        reason = "other poses are exact"
    elif (before.tolerances is None) != (after.tolerances is None):
        reason = "it has tolerances of its poses, or has them no more"
    elif before.timing is not None or after.timing is not None:
        reason = "its poses are timed by the crank"
    elif [each.allowed for each in before.limits] != [each.allowed for each in after.limits]:
        reason = "its limits allow other kinds of dyads"
    elif any(each.line is not None for each in (*before.limits, *after.limits)):
        reason = "a dyad has a rail or a slot"
    elif new.is_special and not is_family:
        reason = "its motion is a special one"
    elif old.task.poses.shape != new.task.poses.shape:
        reason = "poses that were one are two now, or two are one"
    if reason is not None:
        raise InputError("E157", "this task cannot be followed", why=reason, help=ANEW)


def _same_marks(before: Task, after: Task) -> bool:
    none = np.zeros(before.poses.shape, dtype=bool)
    one, two = (none if each.exact is None else each.exact for each in (before, after))
    return np.array_equal(one, two)


def dyad_changes(
    before: Sequence[FoundDyad], after: Sequence[FoundDyad], task: Task
) -> list[Change]:
    """The dyads that vanished and that appeared."""
    old, new = {each.id for each in before}, {each.id for each in after}
    gone = [
        Change(each.id, "vanished", f"{each.id} vanished: no dyad is left near where it was")
        for each in before
        if each.id not in new
    ]
    come = [
        Change(
            each.id,
            "appeared",
            f"{each.id} appeared; it misses the poses by {length_of(each.max_error, task)} at most",
        )
        for each in after
        if each.id not in old
    ]
    return gone + come


def linkage_changes(
    before: Mapping[str, FoundLinkage],
    after: Sequence[FoundLinkage],
    vanished: Sequence[str],
    task: Task,
) -> list[Change]:
    """The linkages that vanished or appeared, and those that crossed a verdict."""
    out = [
        Change(id, "vanished", f"{id} vanished with {_pair(before[id])}")
        for id in vanished
        if id in before
    ]
    for each in after:
        old = before.get(each.id)
        if old is None:
            out.append(Change(each.id, "appeared", f"{each.id} appeared, of {_pair(each)}"))
        elif each.usable and not old.usable:
            out.append(Change(each.id, "works", f"{each.id} works now"))
        elif not each.usable and _why(each) != _why(old):
            why = "; ".join(reasons(each, task))
            if old.usable:
                out.append(Change(each.id, "fails", f"{each.id} no longer works: {why}"))
            else:
                out.append(Change(each.id, "other defects", f"{each.id} fails: {why}"))
    return out


def _pair(found: FoundLinkage) -> str:
    return listed([each.id for each in found.dyads])


def _why(found: FoundLinkage) -> tuple[str, ...]:
    """The kinds of defects and violations, which are a verdict's name."""
    kinds: set[str] = {each.kind for each in found.defects}
    return tuple(sorted(kinds | {each.kind for each in found.violations}))
