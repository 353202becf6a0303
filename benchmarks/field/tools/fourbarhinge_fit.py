"""fourbarhinge: two tracks of points of the body, or one of a path, and bounds of the lengths."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask

TITLE = "fourbarhinge"
PACKAGE = "fourbarhinge"
CALLED = (
    "`CouplerMotionSynthesis(track_p, track_q, LinkBounds(...)).solve()`, P the body's origin and "
    "Q a quarter of the span from it, link lengths from a fiftieth of the span to 2 and to 5 spans "
    "in turn, transmission angle free, given pivots as `ground_pivot_a` and "
    "`ground_pivot_d`; for paths `CouplerPathSynthesis(points, ...).solve(n_starts=4, seed=0, 1, "
    "...)` while there is time; the result with the least greatest error first"
)
SHORTEST = 0.02  # spans
LONGEST = (2.0, 5.0)  # spans


def refuses(task: FieldTask) -> str | None:
    if task.pivots is not None and task.pivots.kind != "points":
        return "it takes ground pivots as points only"
    if len(task.rows) < 3:
        return "it takes three poses or more"
    return None


def solve(task: FieldTask, seconds: float) -> list[FourBar]:
    from fourbarhinge import LinkBounds

    begun, found = time.process_time(), []
    for number in range(10_000):
        longest = LONGEST[number % len(LONGEST)]
        bounds = LinkBounds(
            min_length=SHORTEST * task.span,
            max_length=longest * task.span,
            min_transmission_angle=0.0,
        )
        turn_begun = time.process_time()
        for pivots in _pivots(task):
            try:
                found.append(_solved(task, bounds, pivots, number))
            except RuntimeError:  # "no dyad fits the motion within the bounds"
                continue
        now = time.process_time()
        if not task.is_path and number + 1 == len(LONGEST):
            break
        if now - begun + 1.5 * (now - turn_begun) > 0.9 * seconds:
            break
    found.sort(key=lambda result: (not result.feasible, result.max_error))
    return [_four_bar(result) for result in found]


def _pivots(task: FieldTask) -> list[dict[str, Any]]:
    from fourbarhinge import Point

    if task.pivots is None:
        return [{}]
    a, b = (Point(x=place.real, y=place.imag) for place in task.pivots.places)
    return [{"ground_pivot_a": a, "ground_pivot_d": b}, {"ground_pivot_a": b, "ground_pivot_d": a}]


def _solved(task: FieldTask, bounds: Any, pivots: dict[str, Any], number: int) -> Any:
    from fourbarhinge import CouplerMotionSynthesis, CouplerPathSynthesis

    points = task.rows[:, :2]
    if task.is_path:
        return CouplerPathSynthesis(points, bounds, **pivots).solve(n_starts=4, seed=number)
    angles = task.angles
    tracked = points + task.disc * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return CouplerMotionSynthesis(points, tracked, bounds, **pivots).solve()


def _four_bar(result: Any) -> FourBar:
    """Its coupler's frame is B, x towards C; ours is P, x towards Q."""
    p = result.params
    a = complex(p["ax"], p["ay"])
    d = a + p["lg"] * np.exp(1j * p["theta_ground"])
    back = np.exp(-1j * p.get("w", 0.0))
    here = complex(p["u"], p["v"])
    return FourBar(
        Dyad("RR", a, complex(-here * back), p["li"]),
        Dyad("RR", complex(d), complex((p["lc"] - here) * back), p["lo"]),
    )
