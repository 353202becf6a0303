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
from burmester.following.limited_minima import LimitedMinima, limited_fit
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.constraint_manifold import INVARIANT
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.dyad_search import search_dyads
from burmester.tasks.limits import Limits
from burmester.tasks.problem import SynthesisProblem

FARTHEST = 0.1  # sine of the angle between two manifolds; farther ones are never one dyad
AS_NEAR = 3.0  # ratio of the distances from two dyads, up to which neither is surely the one
ROUNDING = 1e-6  # sine; dyads that moved by less are themselves, whatever is near

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


class Identities(NamedTuple):
    """old: for each new dyad the number of the old one that it continues, or -1.

    doubtful: pairs of an old dyad and another one that came as near to the same new one.
    """

    old: list[int]
    doubtful: list[tuple[int, int]]


def identities(
    before: Sequence[FoundDyad],
    after: Sequence[FoundDyad],
    moves: Sequence[tuple[Dyad, Dyad]],
    frames: CanonicalFrames,
) -> Identities:
    """Each new dyad with the old one nearest to it, each old one once, nearest pairs first.

    Near as points of the space of manifolds, where a long link on one side of its slider is
    beside one on the other side.  Dyads under different limits are never one.
    moves: dyads of which it is known where they went; these are looked for there.
    """
    one, two = (_vectors([each.dyad for each in some], frames) for some in (before, after))
    if moves and len(one):
        start, end = (_vectors(some, frames) for some in zip(*moves, strict=True))
        near = _sines(one, start)
        nearest = near.argmin(axis=1)
        known = near.min(axis=1) < ROUNDING
        one = np.where(known[:, None], end[nearest], one)
    chosen = [-1] * len(after)
    if not len(one) or not len(two):
        return Identities(chosen, [])
    sine = _sines(two, one)
    limits = [np.array([each.limits for each in some]) for some in (after, before)]
    sine = np.where(limits[0][:, None] == limits[1], sine, np.inf)
    doubtful, free = [], set(range(len(before)))
    for at in np.argsort(sine, axis=None, kind="stable"):
        new, old = divmod(int(at), len(before))
        if not sine[new, old] <= FARTHEST:
            break
        if chosen[new] < 0 and old in free:
            chosen[new] = old
            free.discard(old)
            others = np.delete(sine[new], old)
            moved = sine[new, old]
            if moved > ROUNDING and len(others) and others.min() < AS_NEAR * moved:
                other = int(others.argmin())
                doubtful.append((old, other + (other >= old)))
    return Identities(chosen, doubtful)


def _sines(one: FloatArray, two: FloatArray) -> FloatArray:
    """The sines (k, n) of the angles between unit vectors (k, 8) and (n, 8)."""
    cosine = one @ two.T
    return np.asarray(np.linalg.norm(one[:, None] - cosine[..., None] * two, axis=-1))


def _vectors(dyads: Sequence[Dyad], frames: CanonicalFrames) -> FloatArray:
    """The manifolds of dyads, as unit vectors (k, 8) that rotations turn only."""
    out = np.zeros((len(dyads), 8))
    links = [k for k, dyad in enumerate(dyads) if isinstance(dyad, RR)]
    for k, dyad in enumerate(dyads):
        if not isinstance(dyad, RR):
            out[k] = _slider_in(frames, dyad).coefficients()
    if links:
        some = [dyad for dyad in dyads if isinstance(dyad, RR)]
        unit = frames.length
        fixed = np.array([each.fixed_pivot for each in some]) - frames.fixed_origin
        moving = np.array([each.moving_pivot for each in some]) - frames.moving_origin
        radius = np.array([each.radius for each in some])
        out[links] = RR(fixed / unit, moving / unit, radius / unit).coefficients()
    out /= INVARIANT
    return np.asarray(out / np.linalg.norm(out, axis=-1, keepdims=True))


def _slider_in(frames: CanonicalFrames, dyad: Dyad) -> Dyad:
    """A slider as canonical frames see it; a PP dyad is the same in all."""
    unit, fixed, moving = frames.length, frames.fixed_origin, frames.moving_origin
    if not isinstance(dyad, PR | RP):
        return dyad
    n = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
    if isinstance(dyad, PR):
        offset = (dyad.offset - n @ fixed) / unit
        return PR(dyad.normal_angle, offset, (dyad.moving_pivot - moving) / unit)
    offset = (dyad.offset - n @ moving) / unit
    return RP((dyad.fixed_pivot - fixed) / unit, dyad.normal_angle, offset)
