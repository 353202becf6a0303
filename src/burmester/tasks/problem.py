"""A task on its way to linkages: what travels from room to room."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self, final

import numpy as np

from burmester.errors import InputError
from burmester.numerics.arrays import wrapped_angle
from burmester.tasks.length_per_radian import default_length_per_radian
from burmester.tasks.limits import Kind, Limits
from burmester.tasks.motion_class import MotionClass
from burmester.tasks.motion_kinds import FewPoses, Rest, Undetermined
from burmester.tasks.motion_task import CONDITIONS, Task, characteristic_length
from burmester.tasks.notation import span
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_sample import PoseSample
from burmester.tasks.thin_regions import with_limits_to_search
from burmester.wording import listed

SAME_TURN = 1e-9  # radians; a crank and a body whose turns differ by less turn alike


@final
@dataclass(frozen=True, slots=True, eq=False)
class SynthesisProblem:
    """A task with all that is known of it before any fit.

    given: the task as its user gave it.
    task: the same, but every repeated pose once where dyads are looked for; weights add up.  A
        region thinner than rounding is its segment or point.  Where the crank times poses, it has
        two limits, the driver is that of one of them, and these allow turning dyads only.
    motion: the class of its motion; None for one pose.
    length: its characteristic length, in its unit.
    length_per_radian: what a radian of angle error counts as, in the same unit.
    sample: where `task` holds only some poses: which of those that it held before.
    """

    given: Task
    task: Task
    motion: MotionClass | None
    length: float
    options: SynthesisOptions
    length_per_radian: float
    sample: PoseSample | None = None

    @classmethod
    def of(cls, task: Task, motion: MotionClass | None, options: SynthesisOptions) -> Self:
        """A task of a known class of motion, and how it is to be solved."""
        wide = _with_driver(with_limits_to_search(task))
        radian = options.length_per_radian or default_length_per_radian(task)
        problem = cls(task, wide, motion, characteristic_length(task), options, radian)
        return problem if problem.is_special else problem.merged()

    @property
    def motion_size(self) -> float:
        """The span of the poses' origins, or the length per radian where that is more."""
        return max(span(self.given), self.length_per_radian)

    @property
    def is_special(self) -> bool:
        """Whether the motion itself says which dyads there are, and none is to be fitted.

        Pivots at points or on lines may settle what too few or too small motions leave open.
        """
        if self.motion is None or self.motion.determined:
            return False
        kind = self.motion.kind
        if self.given.tolerances is not None:  # what is nearly special may be met otherwise
            return isinstance(kind, Rest)
        settled = any(each.conditions for each in self.given.limits)
        few = isinstance(kind, FewPoses) and (settled or kind.repeats)
        small = isinstance(kind, Undetermined) and settled
        return not (few or small)

    @property
    def missing_conditions(self) -> list[int]:
        """How many more conditions leave finitely many dyads, for each of the task's limits."""
        conditions = [limits.conditions for limits in self.task.limits] or [0]
        if self.task.timing is not None:
            conditions[driving_side(self.task)] += self.task.timing.conditions
        return [CONDITIONS - each - self.task.poses.shape[0] for each in conditions]

    @property
    def has_rails(self) -> bool:
        """Whether a dyad has a rail or a slot, which few poses may determine more than fully."""
        return any(each.line is not None for each in self.task.limits)

    @property
    def leaves_linkages_open(self) -> bool:
        """Whether poses with free components leave infinitely many linkages."""
        stated = self.given.tolerances
        if stated is None or not stated.free.any():
            return False
        return stated.constraints + self.given.pivot_conditions < 2 * CONDITIONS

    @property
    def pose_numbers(self) -> list[int]:
        """The numbers (from 0) that the poses of `task` have in the task as given."""
        numbers = np.arange(self.given.poses.shape[0])
        if self.motion is not None and self.is_merged:
            numbers = self.motion.first
        return [int(n) for n in (numbers if self.sample is None else numbers[self.sample.index])]

    @property
    def is_merged(self) -> bool:
        """Whether `task`, before a sample was taken of it, holds repeated poses once."""
        count = self.task.poses.shape[0] if self.sample is None else self.sample.of_all
        return count != self.given.poses.shape[0]

    def merged(self) -> Self:
        """The same problem, its task with every repeated pose once."""
        motion, task = self.motion, self.task
        if motion is None or motion.distinct == task.poses.shape[0]:
            return self
        size, first, exact, weights = motion.distinct, motion.first, task.exact, task.weights
        tolerances = task.tolerances
        if weights is not None:
            weights = np.bincount(motion.group, weights, size).astype(np.float64)
        once = replace(
            task,
            poses=task.poses[first],
            weights=weights,
            names=None if task.names is None else tuple(task.names[i] for i in first),
            exact=None if exact is None else np.bincount(motion.group, exact, size) > 0,
            tolerances=None if tolerances is None else tolerances.merged(motion.group),
            timing=None if task.timing is None else task.timing.merged(motion.group),
        )
        return replace(self, task=once)

    def sampled(self, sample: PoseSample) -> Self:
        """The same problem by a sample of the poses of its task, each with the weight of its cell.

        The worst error is that of single poses: for it they keep their own weights.
        """
        weights = None if self.options.norm == "worst" else sample.cells
        some = self.task.at(sample.index, weights)
        return replace(self, task=some, sample=sample)


def driving_side(task: Task) -> int:
    """The side, 0 or 1, of the driver in a task timed by the crank: the first, if not stated."""
    return 1 if task.requirements.driver == "second" else 0


def _with_driver(task: Task) -> Task:
    """A task timed by the crank with limits for both dyads and a turning driver; raises E186."""
    if task.timing is None:
        return task
    both = list((task.limits * 2)[:2] if task.limits else (Limits(), Limits()))
    side, index = driving_side(task), task.timing.timed
    swung = task.poses.angle[index] - task.timing.angles[index]
    # A slot turns as the body does; a link alone may turn otherwise.
    alike = np.abs(wrapped_angle(swung - swung[0])).max() <= SAME_TURN
    kinds: frozenset[Kind] = frozenset({"RR", "RP"} if alike else {"RR"})
    if not both[side].allowed & kinds:
        raise InputError(
            "E186",
            "poses are timed by the crank, and the limits allow no dyad that turns so",
            why=f"they allow {listed(sorted(both[side].allowed))}"
            + ("" if alike else "; a slot turns as the body does, and the crank does not"),
            help="let the driver be an RR dyad, or leave the crank angles out",
        )
    both[side] = replace(both[side], kinds=both[side].kinds & kinds)
    asked = replace(task.requirements, driver=("first", "second")[side])
    return replace(task, limits=tuple(both), requirements=asked)
