"""All dyads through five poses, for a stack of plain tasks."""

from __future__ import annotations

import numpy as np

from burmester.dyads.five_poses import dyads_of_five
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.stacked.advice import DyadAdvice
from burmester.stacked.answers import DyadRows
from burmester.stacked.best_dyads import best_dyads_in_stack
from burmester.stacked.found_dyads import Fits, Solutions, beside, found_in_stack
from burmester.stacked.plain_tasks import plain_tasks
from burmester.stacked.task_stack import TaskStack
from burmester.stacked.vouched import Vouched

__all__ = ["five_pose_dyads"]

MEETING = 2  # dyads that make a linkage


def five_pose_dyads(stack: TaskStack) -> list[Vouched]:
    """All dyads through the five poses of tasks that can be computed with.

    Of tasks of which fewer than two are real, the nearest other ones stand beside them.
    """
    index = np.flatnonzero(plain_tasks(stack)[0])
    stack = stack[index]
    poses = stack.displacements
    four = dyads_of_five(poses)
    length = CanonicalFrames.of(poses, stack.weights)[0].length
    fits = Fits(stack, four.frames, four.frames.to_canonical(poses), length, exact=True)
    found = found_in_stack(fits, Solutions.of(four), fits.blur(four.noise, four.gap))
    exact = Vouched.of(index, "exact", fits, found)
    met = np.bincount(found.task, minlength=len(index)) >= MEETING
    if met.all():
        return [exact]
    return [exact.of_those(met), _with_nearest(exact.of_those(~met))]


def _with_nearest(exact: Vouched) -> Vouched:
    """The same dyads with the nearest others after those that meet the poses."""
    near = best_dyads_in_stack(exact.fits.stack)
    some = np.zeros(len(exact.tasks), dtype=bool)
    some[near.tasks] = True
    exact = exact.of_those(some)
    found, late = beside(exact.found, near.found, exact.fits.length)
    advice = DyadAdvice.of(exact.fits, found)._replace(missing=exact.advice.missing)
    met, nearest = (DyadRows.STATUSES.index(each) for each in ("exact", "nearest"))
    status = np.where(late, nearest, met).astype(np.int8)
    return Vouched(exact.tasks, exact.fits, found, advice, status)
