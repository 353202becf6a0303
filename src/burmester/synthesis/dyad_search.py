"""The dyads of a problem, by its method, and the pairs of them that may be linkages."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.cures import Cure, Help
from burmester.dyads.five_poses import FivePoseDyads, dyads_of_five
from burmester.dyads.local_minima import BestDyads, ManyBestDyads, best_dyads, best_dyads_of_tasks
from burmester.dyads.pencil import Pencil, fit_pencil
from burmester.dyads.selection import (
    Fit,
    Fits,
    Found,
    FoundDyad,
    GivenPoses,
    beside,
    dyads_of_fits,
    found_dyads,
    same_dyads,
)
from burmester.errors import InputError
from burmester.numerics.arrays import take
from burmester.tasks.limits import Limits
from burmester.tasks.motion_kinds import MotionKind
from burmester.tasks.motion_task import CONDITIONS, Task
from burmester.tasks.option_table import Method
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import Pair

MEETING = 2  # dyads that make a linkage
LINKAGE_QUADRICS = 2  # that hold all poses of a four-bar; poses of no linkage have none


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadSearch:
    """Every dyad that the method found.

    fits: what the method learnt, once for each of the task's limits.
    dyads: by rising rms error, those of the first limits first.
    meeting: how many of the dyads the method itself found; the rest are the nearest others, where
        fewer than two real dyads pass through five poses.
    left_out: how many solutions are no dyads (`found_dyads`).
    """

    fits: tuple[Fit, ...]
    dyads: tuple[FoundDyad, ...]
    meeting: int
    left_out: int

    def pairs(self, length: float) -> tuple[list[Pair], list[Pair]]:
        """Pairs of two dyads, and pairs of one dyad that was found twice.

        length: the characteristic length of the task.  What obeys both of two limits is found
        twice, and no pair.
        """
        _, one, other = same_dyads(Found.of(self.dyads), np.array([length]))
        same = set(zip(one.tolist(), other.tolist(), strict=True))
        pairs: list[Pair] = []
        twice: list[Pair] = []
        for (i, first), (j, second) in combinations(enumerate(self.dyads), 2):
            if len(self.fits) == 1 or first.limits != second.limits:
                (twice if (i, j) in same else pairs).append((first, second))
        return pairs, [] if len(self.fits) > 1 else twice


class Searched(NamedTuple):
    """The dyads of tasks (T,) without limits by one method.

    fit: what the method learnt; nearest: (D,), which of the dyads only come near to the poses, as
    fewer than two meet all five.
    """

    fit: Pencil | FivePoseDyads | ManyBestDyads
    given: GivenPoses
    found: Found
    nearest: NDArray[np.bool_]


def dyads_of_tasks(
    method: Method,
    given: GivenPoses,
    *,
    normalise: bool = True,
    five: NDArray[np.int_] | None = None,
    fit: Pencil | FivePoseDyads | ManyBestDyads | None = None,
) -> Searched:
    """The dyads of tasks without limits, exact poses and another norm.

    five: where five of the poses determine all dyads, which; fit: of all tasks, where it is known.
    """
    poses, weights, few = given.poses, given.weights, np.zeros(len(given.length), dtype=bool)
    if fit is not None:
        pass
    elif method == "pencil":
        fit = fit_pencil(poses, weights, normalise=normalise)
    elif method == "exact":
        fit = dyads_of_five(poses if five is None else poses[:, five])
    else:
        fit = best_dyads_of_tasks(poses, weights)
    fits = Fits.of(fit, given)
    found = dyads_of_fits(fits)
    if method == "exact":
        few = np.bincount(found.task, minlength=len(few)) < MEETING
    if not few.any():
        return Searched(fit, given, found, np.zeros(len(found.task), dtype=bool))
    near = dyads_of_tasks("complete", take(given, few)).found
    near = near._replace(task=np.flatnonzero(few)[near.task])
    return Searched(fit, given, *beside(found, near, given.length))


def search_dyads(problem: SynthesisProblem) -> DyadSearch:
    """The dyads of a problem whose method is chosen."""
    task, motion, options = problem.task, problem.motion, problem.options
    bound = options.norm != "rms" or (task.exact is not None and task.exact.any())
    if task.limits or (bound and options.method == "complete"):
        return _under_conditions(problem)
    five = None if motion is None else motion.five
    given = GivenPoses.of(task, problem.length if task is problem.given else None)
    some = dyads_of_tasks(options.method, given, normalise=options.normalise, five=five)
    fit = some.fit.of_one() if isinstance(some.fit, ManyBestDyads) else take(some.fit, 0)
    meeting, left_out = int((~some.nearest).sum()), int(some.found.left_out[0])
    return DyadSearch((fit,), tuple(some.found.listed()), meeting, left_out)


def _under_conditions(problem: SynthesisProblem) -> DyadSearch:
    """The dyads of one task within limits, of exact poses or another norm."""
    fits, task = _fits(problem), problem.task
    dyads, left_out = [], 0
    for number, fit in enumerate(fits, start=1):
        found, dropped = found_dyads(fit, task)
        left_out += dropped
        dyads += [replace(each, limits=number if len(fits) > 1 else 0) for each in found]
    numbered = tuple(replace(each, id=f"D{i}") for i, each in enumerate(dyads, start=1))
    return DyadSearch(fits, numbered, len(numbered), left_out)


def dyads_of_motion(kind: MotionKind, task: Task) -> tuple[FoundDyad, ...]:
    """The dyads that a special motion itself tells, with their distances from the poses."""
    return tuple(
        FoundDyad.of(f"D{k}", each, task.poses) for k, each in enumerate(kind.dyads, start=1)
    )


def exact_dyads(nullity: int | NDArray[np.int_], count: int) -> NDArray[np.int_]:
    """How many dyads meet all of `count` poses within their digits, by the nullities (*,).

    Two where two quadrics hold more poses than any two quadrics can; else 0, which claims nothing.
    """
    sure = (np.asarray(nullity) >= LINKAGE_QUADRICS) & (max(0, 8 - count) < LINKAGE_QUADRICS)
    return np.where(sure, LINKAGE_QUADRICS, 0)


def _fits(problem: SynthesisProblem) -> tuple[BestDyads, ...]:
    """The best dyads of the poses, once for each of the task's limits."""
    task, options = problem.task, problem.options
    if not task.limits:
        return (best_dyads(task.poses, task.weights, task.exact, None, options.norm),)
    if options.method != "complete":
        every = np.ones(task.poses.shape, dtype=bool)
        return tuple(best_dyads(task.poses, None, every, each) for each in task.limits)
    fits = []
    for each, missing in zip(task.limits, problem.missing_conditions, strict=True):
        # Beside a rail there may be a dyad that few poses leave open: links of the pivot maps.
        own = Limits(kinds=frozenset({"PP"})) if missing > 0 else each
        fits.append(best_dyads(task.poses, task.weights, task.exact, own, options.norm))
    return tuple(fits)


def with_method(problem: SynthesisProblem) -> SynthesisProblem:
    """The problem with the method that it gets; raises E121 and E123 where that cannot be."""
    options, task = problem.options, problem.task
    method = _chosen(problem)
    if method != "pencil" and not options.normalise:
        raise InputError(
            "E123",
            f"only the pencil can be fitted raw, not the {method} method",
            help=Help.of(
                "leave {} out, or use {}",
                Cure("normalise", option="--raw"),
                Cure("method", "pencil"),
            ),
        )
    conditions = {
        "limits": bool(task.limits),
        "exact poses": task.exact is not None and bool(task.exact.any()),
        "the least worst distance": options.norm != "rms",
    }
    first = next((name for name, given in conditions.items() if given), None)
    if method == "pencil" and first is not None:
        raise InputError(
            "E123",
            f"the pencil knows nothing of {first}",
            why="it fits one pencil of quadrics to all poses alike",
            help=Help.of("use {}", Cure("method", "complete")),
        )
    if options.certify and (first is not None or method == "pencil"):
        raise InputError(
            "E123",
            "certificates exist only for tasks without limits, or for five poses",
            why="the pencil's dyads are not the best ones"
            if first is None
            else f"this task has {first}",
            help=Help(
                "leave ", Cure("certify"), " out" if first is None else " out, or what it has"
            ),
        )
    _require_poses(problem, method)
    return replace(problem, options=replace(options, method=method))


def _chosen(problem: SynthesisProblem) -> Method:
    """What "auto" stands for."""
    if problem.options.method != "auto":
        return problem.options.method
    settled = max(problem.missing_conditions) == 0
    if _all_in_five(problem) or (settled and not _five_in_regions(problem)):
        return "exact"
    return "complete" if problem.options.normalise else "pencil"


def _all_in_five(problem: SynthesisProblem) -> bool:
    """Whether five of the poses already determine all dyads."""
    motion = problem.motion
    return motion is not None and motion.five is not None and not problem.task.limits


def _five_in_regions(problem: SynthesisProblem) -> bool:
    """Whether limits or a rail may keep five poses from being met exactly."""
    if problem.has_rails:
        return True
    return bool(problem.task.limits) and problem.task.poses.shape[0] == CONDITIONS


def _require_poses(problem: SynthesisProblem, method: Method) -> None:
    """E121 where the method does not take that number of poses."""
    number, free = problem.task.poses.shape[0], max(problem.missing_conditions)
    takes = {
        "pencil": number >= 6,
        "complete": free < 0 or _five_in_regions(problem),
        "exact": free == 0 or _all_in_five(problem),
    }
    if not takes[method]:
        needs = {"pencil": "6 poses or more", "complete": "6 poses or more", "exact": "5 poses"}
        raise InputError(
            "E121",
            f"the {method} method takes {needs[method]}, not {number}",
            why="up to five poses are met exactly, six or more only by chance",
            help=Help.of("leave {} out, and the number of poses decides", Cure("method")),
        )
