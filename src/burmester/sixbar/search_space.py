"""Where six-bars are looked for: what a task says of pivots and lengths, and what is assumed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, final

import numpy as np

from burmester.cures import Help
from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Region, Segment, box_around
from burmester.numerics.arrays import FloatArray
from burmester.sixbar.candidates import Conditions
from burmester.sixbar.kinds import KINDS
from burmester.sixbar.requirement_check import least_bars
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, poses_in_words
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.assumptions import FIXED_PIVOT, MOVING_PIVOT
from burmester.wording import listed

POSES: Final = 5  # that a 3R chain with two added dyads meets
FEWEST: Final = 2
REACH: Final = 1.0  # motion sizes; how far pivots may lie from the poses where the task is silent


@final
@dataclass(frozen=True, slots=True, eq=False)
class SearchSpace:
    """Where chains are looked for.

    poses: (N,), two to five; free ones are drawn between them where they are fewer.
    fixed, moving: the regions, in F of A and B, and in M of E and H.
    lengths: least and greatest of the first crank, and of the others; bars: (b,), the least of
    all bars of each class.
    size: of the motion.
    assumed: what the task does not say, in words, each with the option that changes it.
    """

    poses: Displacement
    fixed: tuple[Region, Region]
    moving: tuple[Region, Region]
    lengths: tuple[tuple[float, float], tuple[float, float]]
    size: float
    conditions: Conditions
    bars: Mapping[str, FloatArray]
    assumed: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(cls, problem: SynthesisProblem) -> SearchSpace:
        """That of a task; raises E195 (poses that do not fit), E196 (what six-bars do not keep)."""
        task, asked = problem.given, problem.given.requirements
        _require_poses(task)
        require_kept(task)
        limits = task.limits * (2 if len(task.limits) == 1 else 1) or (Limits(), Limits())
        size = problem.motion_size
        assumed = []
        around = box_around(task.poses.translation, REACH * size)
        own = box_around(np.zeros((1, 2)), REACH * size)
        fixed = _regions([each.fixed_pivot for each in limits], around, "fixed")
        moving = _regions([each.moving_pivot for each in limits], own, "moving")
        far = length_of(REACH * size, task)
        if around in fixed:
            words = f"fixed pivots within {far} of the body's origin at the poses"
            assumed.append((words, Help(FIXED_PIVOT)))
        if own in moving:
            words = f"moving pivots within {far} of the origin of M"
            assumed.append((words, Help(MOVING_PIVOT)))
        conditions = Conditions(
            crank=asked.driver == "crank",
            any_order=asked.any_order,
            asked=asked.bounds,
        )
        lengths = limits[0].length, limits[1].length
        return cls(
            task.poses,
            fixed,
            moving,
            lengths,
            size,
            conditions,
            {name: least_bars(problem, kind.skeleton) for name, kind in KINDS.items()},
            tuple(assumed),
        )


def _require_poses(task: Task) -> None:
    """Refuse poses that no six-bar is found for here; raises E195."""
    number = task.poses.shape[0]
    if not FEWEST <= number <= POSES:
        raise InputError(
            "E195",
            f"six-bars are looked for through {FEWEST} to {POSES} poses, and these are {number}",
            why="the two dyads that make a 3R chain a six-bar pass through five poses exactly",
            help=f"choose {POSES} of them, for example with --every or --drop"
            if number > POSES
            else "give two poses or more",
        )
    x = np.column_stack([task.poses.translation, np.exp(1j * task.poses.angle)])
    apart = np.abs(x[:, None] - x).max(axis=-1) + np.eye(number)
    if (apart <= 1e-9 * max(1.0, float(np.abs(x).max()))).any():
        i, k = (int(each[0]) for each in np.nonzero(np.triu(apart == apart.min(), 1)))
        raise InputError(
            "E195",
            f"{poses_in_words(task, [i, k])} are the same, and six-bars need different ones",
            why="a pose that comes twice leaves infinitely many dyads",
            help="leave one of them out, for example with --drop",
        )


def require_kept(task: Task, *, judged: bool = False) -> None:
    """Refuse what six-bars are not looked for with, rather than pass over it; raises E196.

    judged: whether one is judged that exists: tolerances of poses are kept then.
    """
    asked = task.requirements
    tried = {
        "a footprint": asked.footprint is not None,
        "types of linkage": asked.types is not None,
        "a driver by its limits": asked.driver in ("first", "second") and task.timing is None,
        "crank angles at the poses": task.timing is not None,
        "regions to keep out of": task.surroundings is not None,
        "a path to trace": task.path is not None,
        "tolerances of poses": task.tolerances is not None and task.path is None and not judged,
        "kinds of dyads without RR": any("RR" not in each.allowed for each in task.limits),
    }
    if not_kept := [name for name, given in tried.items() if given]:
        raise InputError(
            "E196",
            f"{listed(not_kept)}: six-bars cannot be asked for "
            f"{'this' if len(not_kept) == 1 else 'these'}",
            why="a six-bar keeps regions of pivots, lengths of cranks, a least transmission angle, "
            "a link ratio, the order of the poses, and a driver that turns fully",
            help="leave it out, and look at the answer yourself"
            if task.path is None
            else "give poses with their angles",
        )


def _regions(given: list[Region | None], default: Polygon, name: str) -> tuple[Region, Region]:
    """The region of the pivot of the chain, and that of the added dyad, which needs an inside."""
    first, second = (default if each is None else each for each in given)
    if isinstance(second, Point | Line | Segment):
        first, second = second, first
    if isinstance(second, Point | Line | Segment):
        if first is second:
            return first, default
        raise InputError(
            "E196",
            f"both {name} pivots have a region without an inside, {first} and {second}",
            why="one of them follows from the five poses and the other, and meets a line by chance "
            "only",
            help="give one of the two room, such as box:X,Y:X,Y",
        )
    return first, second
