"""The dyads of a problem, by its method, and the pairs of them that may be linkages."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import combinations, product
from typing import final

import numpy as np

from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.local_minima import best_dyads
from burmester.dyads.pencil import fit_pencil
from burmester.dyads.selection import Fit, FoundDyad, found_dyads, same_dyad
from burmester.tasks.limits import Limits
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import Pair

__all__ = ["DyadSearch", "exact_dyads", "search_dyads"]

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
        every: Iterable[Pair] = combinations(self.dyads, 2)
        if len(self.fits) > 1:
            one, other = ([each for each in self.dyads if each.limits == k] for k in (1, 2))
            every = product(one, other)
        pairs: list[Pair] = []
        twice: list[Pair] = []
        for first, second in every:
            same = same_dyad(first.dyad, second.dyad, length)
            (twice if same else pairs).append((first, second))
        return pairs, [] if len(self.fits) > 1 else twice


def search_dyads(problem: SynthesisProblem) -> DyadSearch:
    """The dyads of a problem whose method is chosen."""
    fits, task = _fits(problem), problem.task
    lists, left_out = [], 0
    for number, fit in enumerate(fits, start=1):
        found, dropped = found_dyads(fit, task)
        left_out += dropped
        lists.append([replace(each, limits=number if len(fits) > 1 else 0) for each in found])
    meeting = sum(map(len, lists))
    if problem.options.method == "exact" and not task.limits and meeting < 2:
        nearest, _ = found_dyads(best_dyads(task.poses, task.weights), task)
        known = [each.dyad for each in lists[0]]
        lists[0] += [
            each
            for each in nearest
            if not any(same_dyad(each.dyad, other, problem.length) for other in known)
        ]
    dyads = (each for found in lists for each in found)
    numbered = tuple(replace(each, id=f"D{i}") for i, each in enumerate(dyads, start=1))
    return DyadSearch(fits, numbered, meeting, left_out)


def exact_dyads(problem: SynthesisProblem) -> int:
    """How many dyads meet all poses within their digits, by the rank of the design matrix.

    Two where two quadrics hold more poses than any two quadrics can; else 0, which claims nothing.
    """
    motion = problem.motion
    if motion is None:
        return 0
    by_count = max(0, 8 - problem.task.poses.shape[0])
    return LINKAGE_QUADRICS if motion.nullity >= LINKAGE_QUADRICS > by_count else 0


def _fits(problem: SynthesisProblem) -> tuple[Fit, ...]:
    """What the method makes of the poses, once for each of the task's limits."""
    task, motion, options = problem.task, problem.motion, problem.options
    if options.method == "pencil":
        return (fit_pencil(task.poses, task.weights, normalise=options.normalise),)
    if options.method == "complete":
        if not task.limits:
            return (best_dyads(task.poses, task.weights, task.exact, None, options.norm),)
        fits = []
        for each, missing in zip(task.limits, problem.missing_conditions, strict=True):
            # Beside a rail there may be a dyad that few poses leave open: links of the pivot maps.
            own = Limits(kinds=frozenset({"PP"})) if missing > 0 else each
            fits.append(best_dyads(task.poses, task.weights, task.exact, own, options.norm))
        return tuple(fits)
    if not task.limits:
        five = slice(None) if motion is None or motion.five is None else motion.five
        return (dyads_of_five(task.poses[five]),)
    every = np.ones(task.poses.shape, dtype=bool)
    return tuple(best_dyads(task.poses, None, every, each) for each in task.limits)
