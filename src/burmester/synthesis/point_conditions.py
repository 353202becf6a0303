"""What poses and points ask for, with fixed pivots at points: how many linkages that leaves.

A pose that is exact in x and y and free in its angle is a point of the body.  With M poses, N
points and k fixed pivots at points, 2 (M - 1) + N + 2 k = 8, there are finitely many four-bars;
without a pose the first point has no angle to begin with, and N is one more.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.regions import Point
from burmester.numerics.arrays import FloatArray
from burmester.points.classes import CLASS
from burmester.points.start_systems import CASES, Case
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import CONDITIONS, Task
from burmester.wording import count, listed

__all__ = ["PointConditions", "given_pivots", "point_conditions"]


@final
class PointConditions(NamedTuple):
    """Poses and points (N,), and fixed pivots at points.

    is_point: (N,), where the angle is free.
    pivots: (k, 2), fixed pivots, in F; later: whether the one given belongs to the second dyad.
    """

    is_point: NDArray[np.bool_]
    pivots: FloatArray
    later: bool

    @property
    def case(self) -> Case | None:
        """The case of the problem; None where it leaves infinitely many linkages, or none."""
        poses, points = int((~self.is_point).sum()), int(self.is_point.sum())
        case = Case(max(poses, 1), points - (not poses), len(self.pivots))
        return case if case in CASES else None

    @property
    def has_cognates(self) -> bool:
        """Whether linkages come in classes of three."""
        return self.case is not None and self.case.has_cognates

    def __str__(self) -> str:
        """What is asked for: "3 poses and 4 points", "2 poses, 2 points and 2 fixed pivots"."""
        poses, points = int((~self.is_point).sum()), int(self.is_point.sum())
        pivots = len(self.pivots)
        parts = [(poses, "pose"), (points, "point"), (pivots, "fixed pivot")]
        return listed([count(number, name) for number, name in parts if number])

    @property
    def are_too_many(self) -> bool:
        """Whether they are more than a linkage can meet exactly."""
        points = int(self.is_point.sum())
        return 2 * len(self.is_point) - points + 2 * len(self.pivots) > 2 * CONDITIONS

    def in_words(self) -> str:
        """What is asked for, and how many linkages that leaves, for those who look at a task."""
        if self.are_too_many:
            return f"{self}: more than a four-bar can meet; those near them are looked for"
        if self.case is None:
            return f"{self}: infinitely many four-bars, of which good ones are chosen"
        number, also = CASES[self.case], ""
        if self.case.has_cognates:
            number, also = CLASS * number, " with cognates"
        return f"{self}: {number:,} four-bars{also}, complex ones counted"


def point_conditions(task: Task) -> PointConditions | None:
    """What a task asks for; None where no pose is a point, or poses have other tolerances."""
    if task.tolerances is None or not task.tolerances.are_poses_and_points:
        return None
    return PointConditions(task.free_angles, *given_pivots(task.limits))


def given_pivots(limits: Sequence[Limits]) -> tuple[FloatArray, bool]:
    """Fixed pivots (k, 2) at points, and whether the one given belongs to the second dyad."""
    given = [each.fixed_pivot for each in limits] if len(limits) == 2 else []
    pivots = [each.at for each in given if isinstance(each, Point)]
    later = len(pivots) == 1 and isinstance(given[1], Point)
    return np.reshape(np.array(pivots, dtype=float), (-1, 2)), later
