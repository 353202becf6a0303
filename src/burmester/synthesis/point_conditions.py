"""What poses and points ask for, with fixed pivots at points: how many linkages that leaves.

A pose that is exact in x and y and free in its angle is a point of the body.  With M poses, N
points and k fixed pivots at points, 2 (M - 1) + N + 2 k = 8, there are finitely many four-bars;
without a pose the first point has no angle to begin with, and N is one more.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.diagnosis.checks import repeats_advice
from burmester.errors import Advice
from burmester.geometry.regions import Point
from burmester.numerics.arrays import FloatArray
from burmester.points.alt_burmester import CLASS
from burmester.points.point_sets import PointSet, line_or_circle
from burmester.points.start_systems import CASES, Case
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import CONDITIONS, MOST_POINTS, Task
from burmester.tasks.repeated_poses import repeats_in_sequence
from burmester.wording import count, listed

LEAST_DIFFERENT = 3  # rows; where fewer differ, that is told of the task as given


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


def each_once(task: Task) -> tuple[Task, list[Advice]]:
    """A task with points, each row that repeats another taken out, and what is to be said of it.

    Weights add up.  What is left is then a task like any other: nine points where a path of ten
    held one twice.  Points with crank angles stay: a crank may turn while the point rests.
    """
    stated, path = task.tolerances, task.path
    traced = path is not None and path.crank_angles is None
    if stated is None or not (traced or (path is None and stated.are_poses_and_points)):
        return task, []
    first, group = repeats_in_sequence(task.poses, task.free_angles)
    if len(first) == len(group) or len(first) < LEAST_DIFFERENT:
        return task, []
    if path is not None and not path.closed and stated.are_points and len(first) <= MOST_POINTS:
        path = None
    weights = task.weights
    if path is not None or weights is not None:
        weights = np.bincount(group, weights, len(first)).astype(np.float64)
    exact = None if task.exact is None else np.bincount(group, task.exact) > 0
    once = replace(task.at(first, weights), path=path, exact=exact)
    if once.path is not None:  # of many points a repeat adds to the weight, and that is all
        return once, []
    told = repeats_advice(task, first, group, "point" if stated.are_points else "row")
    return once, [] if told is None else [told]


def special_curve(task: Task) -> PointSet | None:
    """The line or circle that holds more positions of a task than a coupler curve meets of it.

    Within the digits of the positions; None where the crank times them.
    """
    if task.path is not None and task.path.crank_angles is not None:
        return None
    return line_or_circle(task.poses.translation, task.resolution[0])


def given_pivots(limits: Sequence[Limits]) -> tuple[FloatArray, bool]:
    """Fixed pivots (k, 2) at points, and whether the one given belongs to the second dyad."""
    given = [each.fixed_pivot for each in limits] if len(limits) == 2 else []
    pivots = [each.at for each in given if isinstance(each, Point)]
    later = len(pivots) == 1 and isinstance(given[1], Point)
    return np.reshape(np.array(pivots, dtype=float), (-1, 2)), later
