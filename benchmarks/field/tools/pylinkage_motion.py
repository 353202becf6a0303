"""pylinkage: `motion_generation` for three to five poses, `path_generation` for as many points."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask

TITLE = "pylinkage"
PACKAGE = "pylinkage"
CALLED = (
    "`motion_generation(poses, ground_pivot_a, ground_pivot_d, max_solutions=50, "
    "require_grashof=False)` for three to five poses, for three without given pivots "
    "`motion_generation_3_poses` as well; `path_generation(points, ..., max_solutions=10, "
    "require_grashof=False)` for three to five points"
)
LEAST, MOST = 3, 5


def refuses(task: FieldTask) -> str | None:
    if task.pivots is not None and task.pivots.kind != "points":
        return "it takes ground pivots as points only"
    if not LEAST <= len(task.rows) <= MOST:
        return "it takes three to five poses or points (of more poses it takes the first five)"
    return None


def solve(task: FieldTask, seconds: float) -> list[FourBar]:
    from pylinkage.synthesis import (
        Pose,
        motion_generation,
        motion_generation_3_poses,
        path_generation,
    )

    pivots: dict[str, Any] = {}
    if task.pivots is not None:
        a, b = ((place.real, place.imag) for place in task.pivots.places)
        pivots = {"ground_pivot_a": a, "ground_pivot_d": b}
    if task.is_path:
        points = [(float(x), float(y)) for x, y in task.rows]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # that five points take a while
            found = path_generation(points, max_solutions=10, require_grashof=False, **pivots)
        return [_of_path(each) for each in found.raw_solutions]
    poses = [Pose(*map(float, row)) for row in task.rows]
    raw = motion_generation(poses, max_solutions=50, require_grashof=False, **pivots).raw_solutions
    if len(poses) == LEAST and not pivots:
        raw = raw + motion_generation_3_poses(poses).raw_solutions
    turn = np.exp(-1j * task.angles[0])
    return [_four_bar(each, task.places[0], turn) for each in raw]


def _of_path(found: Any) -> FourBar:
    return _four_bar(found, complex(*found.coupler_point), 1.0)


def _four_bar(found: Any, origin: complex, turn: complex) -> FourBar:
    """Its moving pivots are where they stand at the first pose."""
    ends = (
        (found.ground_pivot_a, found.crank_pivot_b, found.crank_length),
        (found.ground_pivot_d, found.coupler_pivot_c, found.rocker_length),
    )
    return FourBar(
        *(
            Dyad("RR", complex(*fixed), complex((complex(*pin) - origin) * turn), float(size))
            for fixed, pin, size in ends
        )
    )
