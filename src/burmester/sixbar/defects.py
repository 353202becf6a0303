"""Why a six-bar does not go through its poses on one branch and in order, in words."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import Finding
from burmester.fourbar.defect_messages import PoseNames
from burmester.fourbar.pose_error import PoseError
from burmester.fourbar.pose_order import REPEATED_POSE_STEP
from burmester.fourbar.traversal import DEAD_POINT_ANGLE
from burmester.numerics.arrays import FloatArray
from burmester.tasks.motion_task import Task
from burmester.verdicts.explanation import too_far_from
from burmester.verdicts.tolerance_words import outside

ELSEWHERE: Final = {"branch": 1, "circuit": 2}  # where a pose is met that is missed here


@final
class Course(NamedTuple):
    """How a six-bar goes past poses (N,) on one branch.

    missed: (N,), whether it misses them by more than is allowed.  elsewhere: (N,), 1 where it meets
    a pose on another branch of the same circuit, 2 where on another circuit, else 0.
    along: (N,), the drive, unwrapped; full: whether it turns fully; out_of_order: whether it meets
    the poses in another order.
    transmission: (N,), radians.
    """

    missed: NDArray[np.bool_]
    elsewhere: NDArray[np.intp]
    along: FloatArray
    full: bool
    out_of_order: bool
    transmission: FloatArray


def defects_of(
    course: Course, error: PoseError, shares: FloatArray | None, task: Task, names: Sequence[str]
) -> tuple[Finding, ...]:
    """All of them, missed poses first; poses by their numbers from 0 among those of `task`.

    error: on the branch; shares: (N, 3), of the tolerances that are used, where these decide.
    """
    told, any_order = PoseNames(names), task.requirements.any_order
    out = []
    far = np.flatnonzero(course.missed & (course.elsewhere == 0)).tolist()
    if far:
        text = outside(far, shares, names) if shares is not None else too_far_from(far, error, task)
        out.append(Finding("assembly", text, tuple(far)))
    here = ~course.missed
    away = course.missed & (course.elsewhere == ELSEWHERE["circuit"])
    if away.any():
        out.append(_circuit(here, away, told, any_order=any_order))
    away = course.missed & (course.elsewhere == ELSEWHERE["branch"])
    if away.any():
        out.append(_branch(here, away, told, any_order=any_order))
    stuck = np.flatnonzero(here & (course.transmission < DEAD_POINT_ANGLE)).tolist()
    if stuck:
        text = f"is at a dead point at {told.phrase(stuck)}"
        out.append(Finding("branch", text, tuple(stuck), certain=False))
    if course.out_of_order and not course.elsewhere.any():  # an order is that of one branch
        out.append(_order(course, told))
    return tuple(out)


def _circuit(
    here: NDArray[np.bool_], away: NDArray[np.bool_], names: PoseNames, *, any_order: bool
) -> Finding:
    one, other = _numbers(here), _numbers(away)
    verb = "is" if len(one) == 1 else "are"
    text = f"{names.phrase(one)} {verb} on one assembly, {names.listed(other)} on another"
    taken = "them" if any_order else names.between(_changes(here, away)).removeprefix("between ")
    return Finding("circuit", f"{text}: it must be taken apart between {taken}", other)


def _branch(
    here: NDArray[np.bool_], away: NDArray[np.bool_], names: PoseNames, *, any_order: bool
) -> Finding:
    if any_order:
        one, other = names.phrase(_numbers(here)), names.listed(_numbers(away))
        return Finding("branch", f"locks at a dead point between {one} and {other}", _numbers(away))
    pairs = _changes(here, away)
    points = "a dead point" if len(pairs) == 1 else "dead points"
    text = f"locks {names.between(pairs)}, at {points}"
    return Finding("branch", text, tuple(sorted({pose for pair in pairs for pose in pair})))


def _order(course: Course, names: PoseNames) -> Finding:
    """The order in which the poses are met, of both senses the one with the lower number first."""
    poses = np.arange(len(course.along))
    steps = np.round(course.along / REPEATED_POSE_STEP)
    sequences = []
    for sense in (1, -1):
        sequence = poses[np.lexsort((poses, sense * steps))].tolist()
        start = sequence.index(0) if course.full else 0
        sequences.append(sequence[start:] + sequence[:start])
    met = min(sequences)
    moved = tuple(a for a, b in zip(poses.tolist(), met, strict=True) if a != b)
    return Finding("order", f"meets the poses in the order {names.in_order(met)}", moved)


def _changes(here: NDArray[np.bool_], away: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """The pairs of successive poses, of those met here or elsewhere, between which that changes."""
    return [(a, b) for a, b in pairwise(_numbers(here | away)) if here[a] != here[b]]


def _numbers(mask: NDArray[np.bool_]) -> tuple[int, ...]:
    return tuple(np.flatnonzero(mask).tolist())
