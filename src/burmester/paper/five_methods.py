"""The same task by five methods side by side: what each finds, and from how many start values.

The three classical fits (`normal_distance`) search from start values; the pencil and the complete
method need none.  All see the task in its canonical frames, and the three get the same starts.

A start is a pair of dyads.  Their pivots are drawn from a normal distribution around the
canonical origins of F and M, three canonical lengths wide in x and in y; the radius is the
mean distance of the moving pivot from the fixed one over the poses.  `ravani_roth` starts from
the pair, the other two from its first dyad.  Width and shape are a choice: the counts of starts
depend on it, the answers do not.

The best answer of Ravani and Roth's fit is the settled end with the least sum of squared
distances.  A fit of one dyad needs two ends for a linkage: the two lowest that differ.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from burmester.dyads.image_space_fits import NormalFit, algebraic_fit, larochelle, ravani_roth
from burmester.dyads.local_minima import best_dyads
from burmester.dyads.pencil import fit_pencil
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.io.cases import load
from burmester.numerics.arrays import FloatArray
from burmester.progress import step
from burmester.tasks.motion_task import Task

START_SPREAD = 3.0  # canonical lengths: spread of the start pivots
SAME_END = 1e-4  # relative distance below which two ends are one


@final
@dataclass(frozen=True, slots=True, eq=False)
class Answer:
    """The linkage that a method gives.

    dyads: (2,), by the x of their fixed pivots; (1,) or (0,) if the method finds no more.
    rms_error, max_error: (2,), the distance of the moving pivot from its circle over the poses,
        in the task's unit.
    reached: of `starts`, how many led to each dyad; to both at once by Ravani and Roth's fit.
    settled: how many led anywhere.  needed: starts until the answer is complete, on average.
        All four are None for a method without start values.
    seconds: wall time on the machine at hand, of all starts together.
    """

    method: str
    dyads: RR
    rms_error: FloatArray
    max_error: FloatArray
    seconds: float
    starts: int | None = None
    settled: int | None = None
    reached: tuple[int, ...] | None = None
    needed: float | None = None


def by_every_method(poses: Displacement, starts: int, seed: int) -> tuple[Answer, ...]:
    """What the five methods make of poses (N,), N >= 6; the same seed gives the same starts.

    Raises InputError as `best_dyads` does.
    """
    frames, seen = CanonicalFrames.of(poses)
    pairs = random_starts(seen, starts, seed)
    best_dyads(poses)  # once before it is timed: it loads and builds what it keeps
    return (
        _searched("Ravani-Roth", ravani_roth, pairs, frames, poses),
        _searched("Larochelle", larochelle, pairs[:, 0], frames, poses),
        _searched("algebraic", algebraic_fit, pairs[:, 0], frames, poses),
        _computed("pencil", fit_pencil, poses),
        _computed("complete", best_dyads, poses),
    )


def random_starts(poses: Displacement, count: int, seed: int) -> RR:
    """Pairs of dyads (count, 2) to start from, for poses (N,) in canonical frames."""
    pivots = np.random.default_rng(seed).normal(scale=START_SPREAD, size=(2, count, 2, 2))
    centred = RR(pivots[0], pivots[1], np.zeros((count, 2)))
    return RR(pivots[0], pivots[1], centred[..., None].residual(poses).mean(axis=-1))


def starts_needed(reached: tuple[int, ...], starts: int) -> float:
    """How many starts it takes on average to meet every end, each reached so often of `starts`.

    One end or two; the time to wait for both is that for either and then for the other one.
    """
    if min(reached, default=0) == 0:
        return np.inf
    waits = [starts / count for count in reached]
    return sum(waits) - (starts / sum(reached) if len(waits) == 2 else 0.0)


def _searched(
    name: str,
    method: Callable[[Displacement, RR], NormalFit],
    starts: RR,
    frames: CanonicalFrames,
    poses: Displacement,
) -> Answer:
    began = time.perf_counter()
    fit = method(frames.to_canonical(poses), starts)
    seconds = time.perf_counter() - began
    count, pairs = len(fit.residual), starts.radius.ndim == 2
    parts = (fit.dyads.fixed_pivot, fit.dyads.moving_pivot, fit.dyads.radius[..., None])
    ends = np.concatenate(parts, axis=-1).reshape(count, -1, 5)
    # The two dyads of a pair may come in either order.
    ends = np.take_along_axis(ends, np.argsort(ends[..., 0], axis=1)[..., None], axis=1)
    going = np.flatnonzero(fit.converged)
    going = going[np.argsort(fit.residual[going])]
    lowest: list[FloatArray] = []
    reached: list[int] = []
    while len(going) and len(lowest) < (1 if pairs else 2):
        end = ends[going[0]]
        here = np.abs(ends[going] - end).max(axis=(1, 2)) < SAME_END * (1 + np.abs(end).max())
        lowest.append(end)
        reached.append(int(here.sum()))
        going = going[~here]
    if not pairs:
        order = np.argsort([end[0, 0] for end in lowest])
        lowest, reached = [lowest[k] for k in order], [reached[k] for k in order]
    x = np.concatenate([*lowest, np.empty((0, 5))])
    return _answer(
        name,
        frames.circle_from_canonical(RR(x[:, :2], x[:, 2:4], x[:, 4])),
        poses,
        seconds,
        starts=count,
        settled=int(fit.converged.sum()),
        reached=tuple(reached),
        needed=starts_needed(tuple(reached), count) if len(x) == 2 else np.inf,
    )


def _computed(name: str, method: Callable[[Displacement], Any], poses: Displacement) -> Answer:
    began = time.perf_counter()
    found = method(poses)
    seconds = time.perf_counter() - began
    best = np.argsort(found.rms_error)[: np.isfinite(found.rms_error).sum()][:2]
    best = best[np.argsort(found.dyads.fixed_pivot[best, 0])]
    return _answer(name, found.dyads[best], poses, seconds)


def _answer(name: str, dyads: RR, poses: Displacement, seconds: float, **of_starts: Any) -> Answer:
    miss = np.abs(dyads[:, None].residual(poses))
    rms = np.sqrt((miss**2).mean(axis=-1))
    return Answer(name, dyads, rms, miss.max(axis=-1), seconds, **of_starts)


@final
@dataclass(frozen=True, slots=True, eq=False)
class SideBySide:
    """What five methods make of one of the paper's tasks."""

    title: str
    case: str
    answers: tuple[Answer, ...]


def side_by_side(starts: int = 100, seed: int = 2012) -> tuple[SideBySide, ...]:
    """The paper's two tasks by five methods; the same seed gives the same starts."""
    tasks = {"Table 2 (pose 6 at 52.87 deg)": "ge2012-exact", "Table 5": "ge2012-approximate"}
    result = []
    for title, case in tasks.items():
        step(f"solving {title} by every method")
        poses = Task.from_rows(load(case)["poses"], angle_unit="deg").poses
        result.append(SideBySide(title, case, by_every_method(poses, starts, seed)))
    return tuple(result)


def side_by_side_data(task: SideBySide) -> dict[str, Any]:
    """One task as plain data."""
    answers = [_answer_data(answer) for answer in task.answers]
    return {"title": task.title, "case": task.case, "answers": answers}


def _answer_data(answer: Answer) -> dict[str, Any]:
    dyads = [
        {
            "fixed_pivot": answer.dyads.fixed_pivot[k].tolist(),
            "moving_pivot": answer.dyads.moving_pivot[k].tolist(),
            "radius": float(answer.dyads.radius[k]),
            "rms_error": float(answer.rms_error[k]),
            "max_error": float(answer.max_error[k]),
        }
        for k in range(len(answer.rms_error))
    ]
    needed = answer.needed
    return {
        "method": answer.method,
        "dyads": dyads,
        "starts": answer.starts,
        "settled": answer.settled,
        "reached": answer.reached,
        "starts_needed": needed if needed is not None and math.isfinite(needed) else None,
        "seconds_on_this_machine": answer.seconds,
    }
