"""The dyads of a task, continued to a task that differs a little.

Five poses and the pencil have closed forms: their dyads are found anew, all of them.  The minima of
more poses are followed as `free_minima` describes, within limits as `limited_minima` does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Self, final

import numpy as np

from burmester.dyads.critical_points import CriticalDyads
from burmester.dyads.local_minima import BestDyads
from burmester.dyads.selection import Fit, FoundDyad, found_dyads
from burmester.following.free_minima import FreeMinima
from burmester.following.identity import Identities, identities
from burmester.following.limited_minima import LimitedMinima, limited_fit
from burmester.fourbar.dyad import Dyad
from burmester.synthesis.dyad_search import search_dyads
from burmester.tasks.limits import Limits
from burmester.tasks.problem import SynthesisProblem

__all__ = ["DyadStrands", "NewDyads"]

ANYWHERE = Limits()  # of a task without limits


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadStrands:
    """What of the dyads goes on from task to task.

    fits: as `Synthesis` has them; empty where dyads are chosen from a family.
    free: what is followed beside the minima, where there are no limits.
    limited: the minima within limits, a list for each of the task's limits.
    """

    fits: tuple[Fit, ...]
    free: FreeMinima | None = None
    limited: tuple[tuple[LimitedMinima, ...], ...] = ()

    @classmethod
    def of(cls, fits: Sequence[Fit], problem: SynthesisProblem) -> Self:
        """The strands of a synthesis."""
        first = next(iter(fits), None)
        if isinstance(first, BestDyads) and isinstance(first.search, CriticalDyads):
            return cls(tuple(fits), FreeMinima.of(first.search))
        if isinstance(first, BestDyads):
            limits = problem.task.limits or (ANYWHERE,)
            return cls(
                tuple(fits),
                limited=tuple(
                    LimitedMinima.every(fit, each)
                    for fit, each in zip(fits, limits, strict=True)
                    if isinstance(fit, BestDyads)
                ),
            )
        return cls(tuple(fits))

    @property
    def complete(self) -> bool:
        """Whether a dyad that appears is seen."""
        return not self.limited

    def continued(self, problem: SynthesisProblem) -> NewDyads:
        """The dyads of a problem, and how they go on."""
        if not self.fits:
            return NewDyads(self, [], [], [])
        if self.limited:
            return self._within_limits(problem)
        fit = self.fits[0]
        moved = None
        if self.free is not None:
            assert isinstance(fit, BestDyads)
            moved = self.free.moved(fit, problem.task)
        if moved is None:  # by the method of the whole road
            search = search_dyads(problem)
            return NewDyads(DyadStrands.of(search.fits, problem), list(search.dyads), [], [])
        found, _ = found_dyads(moved.fit, problem.task)
        strands = replace(self, fits=(moved.fit,), free=moved.strand)
        return NewDyads(strands, found, [], moved.moves)

    def _within_limits(self, problem: SynthesisProblem) -> NewDyads:
        """The minima within limits, and what is doubtful of them."""
        task, doubts, found, moves = problem.task, [], [], []
        fits: list[Fit] = []
        limited = []
        limits = task.limits or (ANYWHERE,)
        exact = np.zeros(task.poses.shape, dtype=bool) if task.exact is None else task.exact
        if problem.options.method == "exact":
            exact = np.ones(task.poses.shape, dtype=bool)
        for number, (fit, old, each) in enumerate(
            zip(self.fits, self.limited, limits, strict=True), start=1
        ):
            assert isinstance(fit, BestDyads)
            seen = fit.frames.to_canonical(task.poses)
            new = []
            for strand in old:
                moved, index, said = strand.moved(seen, each, fit.frames, task.weights, exact)
                new.append(moved)
                doubts += said
                start, end = strand.dyads(fit.frames), moved.dyads(fit.frames)
                moves += [(start[k], one) for k, one in zip(index, end, strict=True)]
            fit = limited_fit(fit, new, seen)  # noqa: PLW2901
            fits.append(fit)
            limited.append(tuple(new))
            listed, _ = found_dyads(fit, task)
            found += [replace(one, limits=number if len(limits) > 1 else 0) for one in listed]
        there = replace(self, fits=tuple(fits), limited=tuple(limited))
        return NewDyads(there, found, doubts, moves)


class NewDyads(NamedTuple):
    """The dyads of a new task, without ids of their own yet.

    doubts: in sentences; moves: where dyads went, as far as that is known.
    """

    strands: DyadStrands
    found: list[FoundDyad]
    doubts: list[str]
    moves: list[tuple[Dyad, Dyad]]

    def identities(self, before: Sequence[FoundDyad]) -> Identities:
        """Which of the dyads before each continues."""
        return identities(before, self.found, self.moves, self.strands.fits[0].frames)
