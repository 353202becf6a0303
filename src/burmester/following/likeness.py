"""What two tasks must share so that answers can be followed from one to the other.

E157 a task or a synthesis that cannot be followed
"""

from __future__ import annotations

import numpy as np

from burmester.errors import InputError
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.tasks.motion_task import Task
from burmester.tasks.problem import SynthesisProblem
from burmester.wording import count, in_unit

__all__ = ["require_followable", "require_like"]

ANEW = "call burmester.synthesize with the new task, and follow from there"


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
