"""pylinkage: its closed forms for three to five poses or points, its optimisers for dense paths.

For functions its `function_generation` takes the angles of both links from the ground link, so that
the zeros of both are searched.
"""

from __future__ import annotations

import time
import warnings
from typing import Any

import numpy as np

from benchmarks.field.linkage import Dyad, FourBar
from benchmarks.field.task import FieldTask
from benchmarks.field.tools import generators
from benchmarks.field.tools.closure import Scaled
from benchmarks.field.tools.coupler_curves import BODY, REACH, STEPS, Laid, is_dense, of_shape

TITLE = "pylinkage"
PACKAGE = "pylinkage"
CALLED = (
    "Poses, three to five: `motion_generation(poses, max_solutions=50, require_grashof=False)`.",
    "For three without given pivots `motion_generation_3_poses` as well.",
    "Paths of three to five points: `path_generation(points, require_grashof=False)`.",
    "Paths of ten points or more, closed or timed: `differential_evolution_optimization`.",
    "Then `minimize_linkage`; six runs. The objective is ours: the curve laid over the path.",
    "Simulated are a crank, an `RRRDyad` and a `FixedDyad`, by `step_fast` with numba.",
    "Functions: `function_generation(pairs, require_grashof=False)`, both zeros on a grid.",
    "Then closer about the best, as `verify_function_generation` says.",
)
LEAST, MOST = 3, 5
GRID, FINER = 30, 6  # steps of each zero round the circle; zeros from which finer ones are tried
RUNS = 6  # of its optimisers, with the assembly on either side in turn
BEGINS, LENGTHS = 16, 6  # windows of a curve that are laid over an open path


def refuses(task: FieldTask) -> str | None:
    if task.is_function or is_dense(task):
        return None
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

    if task.is_function:
        return _functions(task, seconds)
    if is_dense(task):
        return _dense(task, seconds)
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


def _dense(task: FieldTask, seconds: float) -> list[FourBar]:
    """Shapes of cranks by its optimisers, the assembly on either side in turn."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import FixedDyad, RRRDyad
    from pylinkage.optimization import differential_evolution_optimization, minimize_linkage
    from pylinkage.simulation import Linkage

    begun, scaled = time.process_time(), Scaled(task)
    laid = Laid(task, scaled)
    windows = _windows(laid)
    pivots = Ground(0, 0), Ground(1, 0)
    crank = Crank(anchor=pivots[0], radius=0.4, angular_velocity=2 * np.pi / STEPS)
    rocker = RRRDyad(anchor1=crank.output, anchor2=pivots[1], distance1=1.1, distance2=0.9)
    tracer = FixedDyad(anchor1=crank.output, anchor2=rocker, distance=0.6, angle=0.7)
    linkage = Linkage([*pivots, crank, rocker, tracer])
    coords = [(0.0, 0.0), (1.0, 0.0), (0.4, 0.0), (1.03, 0.9), (0.35, 0.6)]

    def score(one: Linkage, sizes: Any, places: Any) -> float:
        return _lying(one, sizes, places, laid, windows)[0]

    def late(*_: object, **__: object) -> bool:
        return time.process_time() - begun > 0.8 * seconds

    low = [np.exp(-REACH)] * 3 + [0.0, -np.pi]
    high = [np.exp(REACH)] * 3 + [BODY * np.exp(REACH), np.pi]
    found: list[tuple[float, FourBar]] = []
    for seed in range(RUNS):
        if late():
            break
        side = (-1.0) ** seed
        linkage.set_coords([(x, side * y) for x, y in coords])
        how = {"order_relation": min, "verbose": False}
        most = {"maxiter": 150, "popsize": 12, "tol": 1e-6, "seed": seed, "polish": False}
        found_by = differential_evolution_optimization(
            score, linkage, (low, high), callback=late, **most, **how
        )
        best = found_by[0].dimensions
        linkage.set_coords([(x, side * y) for x, y in coords])
        better = minimize_linkage(score, linkage, list(best), maxiter=400, tol=1e-10, **how)
        sizes = np.asarray(better[0].dimensions)
        places = [(x, side * y) for x, y in coords]
        error, window = _lying(linkage, sizes, places, laid, windows)
        if np.isfinite(error):
            hand = sizes[3] * np.exp(1j * sizes[4]) / sizes[1]
            shape = np.append(np.log(sizes[:3]), [hand.real, hand.imag])
            found.append((error, of_shape(shape, side, window, laid).four_bar(scaled)))
    found.sort(key=lambda each: each[0])
    return [four_bar for _, four_bar in found]


def _windows(laid: Laid) -> np.ndarray:
    """The parts of a curve that are laid over a path."""
    if laid.windows == 0:
        return np.empty((1, 0))
    begins = np.arange(BEGINS) / BEGINS
    if laid.windows == 1:
        return np.arange(3 * BEGINS)[:, None] / (3 * BEGINS)
    a, b = np.meshgrid(begins, np.linspace(0.05, 0.95, LENGTHS))
    return np.column_stack([a.ravel(), b.ravel()])


def _lying(
    linkage: Any, sizes: Any, places: Any, laid: Laid, windows: np.ndarray
) -> tuple[float, np.ndarray]:
    """How far the simulated curve is from the path at the best window, and that window."""
    sizes = np.asarray(sizes, dtype=float)
    if min(sizes[:3]) <= 0:
        return np.inf, windows[0]
    linkage.set_coords(places)
    linkage.set_constraints(sizes.tolist())
    way = linkage.step_fast(iterations=STEPS)[:, -1]
    if not np.isfinite(way).all():
        return np.inf, windows[0]
    curve = way[:, 0] + 1j * way[:, 1]
    at = np.arange(1, STEPS + 1) * 2 * np.pi / STEPS
    points = np.interp(laid.angles(windows), at, curve, period=2 * np.pi)
    errors = laid.of(points)[0]
    best = int(errors.argmin())
    return float(errors[best]), windows[best]


def _functions(task: FieldTask, seconds: float) -> list[FourBar]:
    from pylinkage.synthesis import function_generation, verify_function_generation

    begun, found = time.process_time(), []

    def tries(p: float, q: float) -> None:
        pairs = [(float(p + x), float(q + y)) for x, y in task.rows]
        result = function_generation(pairs, require_grashof=False)
        for linkage, one in zip(result.solutions, result.raw_solutions, strict=True):
            worst = max(verify_function_generation(linkage, pairs)[1])
            found.append((worst, p, q, one))

    wide = 2 * np.pi / GRID
    for p in np.arange(GRID) * wide:
        for q in np.arange(GRID) * wide:
            if time.process_time() - begun < 0.5 * seconds:
                tries(p, q)
    while found and wide > 1e-6:
        wide /= 2.5
        found.sort(key=lambda each: each[0])
        for _, p, q, _ in found[:FINER]:
            for dp, dq in np.ndindex(3, 3):
                if time.process_time() - begun > 0.85 * seconds:
                    break
                tries(p + (dp - 1) * wide, q + (dq - 1) * wide)
    found.sort(key=lambda each: each[0])
    lengths = [(one.crank_length, one.coupler_length, one.rocker_length) for *_, one in found[:50]]
    return [generators.four_bar(np.log([*row, 1, 1])) for row in lengths]
