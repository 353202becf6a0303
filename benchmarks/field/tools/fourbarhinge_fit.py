"""fourbarhinge: two tracks of points of the body, or one of a path, and bounds of the lengths."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask
from benchmarks.field.tools.coupler_curves import is_dense

TITLE = "fourbarhinge"
PACKAGE = "fourbarhinge"
CALLED = (
    "Poses: `CouplerMotionSynthesis(track_p, track_q, LinkBounds(...)).solve()`.",
    "P is the body's origin, Q a quarter of the span from it.",
    "Link lengths are from a fiftieth of the span to 2 and to 5 spans in turn.",
    "The transmission angle is free; given pivots are `ground_pivot_a` and `ground_pivot_d`.",
    "Paths: `CouplerPathSynthesis(points, ...).solve(...)` with new seeds while there is time.",
    "Of ten points or more it gets 13, in both orders; of closed paths the first again at the end.",
    "`max_input_step` turns the crank half round in the mean, or once where the path is closed.",
    "Timed paths: `theta_inputs` from 24 begins of the crank, then near the best one.",
    "The result with the least greatest error comes first.",
)
SHORTEST = 0.02  # spans
LONGEST = (2.0, 5.0)  # spans
GIVEN = 13  # points of a dense path: each is an unknown of its solver
BEGINS, NEAR = 24, 0.3  # of a timed crank; radians about the best one


def refuses(task: FieldTask) -> str | None:
    if task.is_function:
        return "it takes no functions"
    if task.pivots is not None and task.pivots.kind != "points":
        return "it takes ground pivots as points only"
    if len(task.rows) < 3:
        return "it takes three poses or more"
    return None


def solve(task: FieldTask, seconds: float) -> list[FourBar]:
    from fourbarhinge import LinkBounds

    rng, longest_call = np.random.default_rng(0), 0.0
    begun, found, starts = time.process_time(), [], _begins(task)
    for number in range(10_000):
        longest = LONGEST[(number // 4 if is_dense(task) else number) % len(LONGEST)]
        bounds = LinkBounds(
            min_length=SHORTEST * task.span,
            max_length=longest * task.span,
            min_transmission_angle=0.0,
            max_input_step=_step(task),
        )
        begin = next(starts, None)
        if task.crank is not None and begin is None:
            best = min(found, key=lambda result: result.rms_error)
            begin = best.theta_inputs[0] + rng.normal() * NEAR / (1 + number / BEGINS)
        turn_begun = time.process_time()
        for pivots in _pivots(task):
            try:
                found.append(_solved(task, bounds, pivots, number, begin))
            except RuntimeError:  # "no dyad fits the motion within the bounds"
                continue
        now = time.process_time()
        if not task.is_path and number + 1 == len(LONGEST):
            break
        longest_call = max(longest_call, now - turn_begun)
        if now - begun + 1.5 * longest_call > 0.9 * seconds:
            break
    found.sort(key=lambda result: (not result.feasible, _error(result, task)))
    return [_four_bar(result) for result in found]


def _error(result: Any, task: FieldTask) -> float:
    """Its greatest error; of a path of which it got some points, that of all from its curve."""
    if not is_dense(task) or task.crank is not None:
        return float(result.max_error)
    curve = result.path(400) @ [1, 1j]
    return float(abs(task.places[:, None] - curve).min(axis=1).max())


def _begins(task: FieldTask) -> Iterator[float]:
    """The crank's begins that are tried first, for a timed path."""
    if task.crank is not None:
        yield from 2 * np.pi * np.arange(BEGINS) / BEGINS


def _step(task: FieldTask) -> float:
    """The greatest step of the crank between two points; steps begin at half of it in the mean."""
    if not is_dense(task):
        return np.pi / 2
    return (4 if task.closed else 2) * np.pi / (GIVEN - 1)


def _pivots(task: FieldTask) -> list[dict[str, Any]]:
    from fourbarhinge import Point

    if task.pivots is None:
        return [{}]
    a, b = (Point(x=place.real, y=place.imag) for place in task.pivots.places)
    return [{"ground_pivot_a": a, "ground_pivot_d": b}, {"ground_pivot_a": b, "ground_pivot_d": a}]


def _solved(
    task: FieldTask, bounds: Any, pivots: dict[str, Any], number: int, begin: float | None
) -> Any:
    from fourbarhinge import CouplerMotionSynthesis, CouplerPathSynthesis

    points = task.rows[:, :2]
    if task.is_path:
        if is_dense(task) and task.crank is None:
            way = np.column_stack([task.way.real, task.way.imag])
            points = way[np.linspace(0, len(way) - 1, GIVEN).round().astype(int)]
            points = points[:: 1 if number % 4 < 2 else -1]  # a single start turns one way
            pivots = pivots | {"branches": ((1, -1)[number % 2],)}
            return CouplerPathSynthesis(points, bounds, **pivots).solve(1, number, 1e-8)
        if task.crank is not None:
            pivots = pivots | {"theta_inputs": begin + task.crank}
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
