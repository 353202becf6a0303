"""What is said of a linkage of any kind that was judged by a task."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from burmester.errors import Finding
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import Bodies, LinkPlaces
from burmester.numerics.arrays import FloatArray
from burmester.requirements.figures import Figures
from burmester.requirements.loads import OF_LOADS
from burmester.tasks.motion_task import Task
from burmester.verdicts.motion import Configuration, Motion, Way

if TYPE_CHECKING:  # few tasks have any of these
    from burmester.loads.load_figures import LoadFigures
    from burmester.tasks.function_task import FunctionTask


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class JudgedLinkage:
    """A linkage with what is wrong with it, and where it falls short.

    Attributes
    ----------
    id : str
        "L1", "L2", ... by rank; of six-bars "S1", "S2", ...
    violations : tuple of Finding
        The limits and requirements of the task that it does not keep, with its driver.
    shortcomings : tuple of str
        Where it falls short of what a linkage to build is to be, where the task asks for nothing
        (`requirements.table`), in words that follow "it"; () is good.
    task : Task or FunctionTask
        The task of the answer that it belongs to, as it was given.
    """

    id: str
    violations: tuple[Finding, ...] = ()
    shortcomings: tuple[str, ...] = ()
    task: Task | FunctionTask

    if TYPE_CHECKING:

        @property
        def usable(self) -> bool:
            """Whether it does what the task asks, and keeps what is required."""

    @property
    @abstractmethod
    def defects(self) -> tuple[Finding, ...]:
        """Why it does not do what the task asks, whatever else is required."""

    @property
    @abstractmethod
    def figures(self) -> Figures:
        """What it measures and does with its driver, but for the footprint."""

    @property
    def unit(self) -> str | None:
        """The unit of lengths."""
        return self.task.length_unit

    @property
    def faults(self) -> tuple[Finding, ...]:
        """All that keeps it from being usable: its defects, then its violations."""
        return self.defects + self.violations


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LinkageAtPoses(JudgedLinkage):
    """A linkage that guides a body, with its errors at the poses.

    Attributes
    ----------
    error : PoseError
        Of the body's places nearest to the poses: of a four-bar on one circuit, unless there is a
        circuit defect, of a six-bar on one branch.
    within_tolerance : (N, 3) array, optional
        How much of its tolerance each component of each pose uses, where the task has tolerances:
        at most 1 inside, 0 for free components.
    loads : LoadFigures, optional
        What it bears, where the task has loads; None of one that leads through no poses.
    id, violations, shortcomings, task
        As in `JudgedLinkage`.
    """

    error: PoseError
    within_tolerance: FloatArray | None = None
    loads: LoadFigures | None = None
    task: Task

    @property
    def on_branches(self) -> bool:
        """Whether it meets poses on other branches than the one of which its errors are."""
        return False

    def with_loads(self, figures: Figures) -> Figures:
        """Figures, and what it bears where the task bounds it."""
        if self.loads is None or not {*OF_LOADS} & {*self.task.requirements.bounds}:
            return figures
        return figures._replace(**self.loads.measures)

    @property
    @abstractmethod
    def bodies(self) -> Bodies:
        """Its bodies and joints, in the task's unit, as it is driven."""

    @abstractmethod
    def bodies_at(self, drive: FloatArray, body: Displacement) -> LinkPlaces:
        """Where its bodies are when the driver is at (*,) and M at places (*,)."""

    @abstractmethod
    def joints_at(self, drive: FloatArray, body: Displacement) -> dict[str, FloatArray]:
        """Its joints (*, 2) by name when the driver is at (*,) and M at places (*,)."""

    def motion(self, count: int = 100) -> Configuration:
        """So many places of body and joints from the first pose to the last, at even steps.

        See `at`.  Raises InputError E163 where it goes from no pose to another.
        """
        motion = Motion.of(self, count)
        driver = np.degrees(motion.drive) if motion.in_turns else motion.drive
        return Configuration(driver, motion.places, self.joints_at(motion.drive, motion.places))

    @abstractmethod
    def scaled(self, scale: float) -> Self:
        """The same in another unit of length: its dimensions, and its errors at the poses."""

    @abstractmethod
    def at_poses(self) -> LinkPlaces:
        """Where its bodies are for the poses (N,)."""

    @abstractmethod
    def all_places(self, count: int) -> LinkPlaces:
        """Where its bodies are along all branches that have poses, and for these; count: of each.

        Whole turns are cut where the poses leave the widest gap.
        """

    @abstractmethod
    def travel(self, whole: bool = False) -> Way:
        """Its motion, at whatever shares of it; see `Motion.of`."""
