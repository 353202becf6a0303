"""The dyads of a task, continued to a task that differs a little.

Five poses and the pencil have closed forms: their dyads are found anew, all of them.  Without
limits and exact poses every minimum moves by Newton's method, and so do all critical points of the
squared residual, complex ones too: where two of them come near to each other, a dyad may appear or
vanish, and all are found anew.  Within limits each minimum moves along the faces on which it lies;
where it leaves one or comes to one, it goes down as in the search.  A dyad that appears there is
not seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.critical_points import CriticalDyads, continued_points, critical_dyads
from burmester.dyads.face_descent import descend, inside
from burmester.dyads.geometric_fit import (
    DistanceFunction,
    FitProblem,
    GeometricFit,
    Point,
    circle_distances,
    line_distances,
)
from burmester.dyads.least_powers import least_squares_step
from burmester.dyads.limited_block import Block, LengthRange
from burmester.dyads.local_minima import BestDyads
from burmester.dyads.minima_within_limits import LimitedDyads, limits_in
from burmester.dyads.selection import Fit, FoundDyad, found_dyads
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.following.face_table import FaceTable, face_numbers, held, nearest_face
from burmester.following.identity import Identities, identities
from burmester.following.minimum_step import moved_minima
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.weights import shares
from burmester.synthesis.dyad_search import search_dyads
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.problem import SynthesisProblem

__all__ = ["DyadStrands", "NewDyads"]

ANYWHERE = Limits()  # of a task without limits
SAME_DYAD = 1e-7  # relative; dyads that differ by less have become one
EXACT_ROUNDING = 1e-9  # relative; an exact pose that is missed by less is met


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadStrands:
    """What of the dyads goes on from task to task.

    fits: as `Synthesis` has them; empty where dyads are chosen from a family.
    watched: the critical points of the squared residual, where there are no limits.
    limited: the minima within limits, a list for each of the task's limits.
    """

    fits: tuple[Fit, ...]
    watched: _Watched | None = None
    limited: tuple[tuple[_Limited, ...], ...] = ()

    @classmethod
    def of(cls, fits: Sequence[Fit], problem: SynthesisProblem) -> Self:
        """The strands of a synthesis."""
        first = next(iter(fits), None)
        if isinstance(first, BestDyads) and isinstance(first.search, CriticalDyads):
            return cls(tuple(fits), _Watched.of(first.search))
        if isinstance(first, BestDyads):
            limits = problem.task.limits or (ANYWHERE,)
            return cls(
                tuple(fits),
                limited=tuple(
                    _Limited.every(fit, each)
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
        if self.watched is not None:
            return self._minima(problem, self.watched)
        if self.limited:
            return self._within_limits(problem)
        return _found_anew(problem)

    def _minima(self, problem: SynthesisProblem, watched: _Watched) -> NewDyads:
        """The minima without limits; all found anew where one is lost, or may appear."""
        task, fit = problem.task, self.fits[0]
        assert isinstance(fit, BestDyads)
        seen = fit.frames.to_canonical(task.poses)
        there = watched.continued(task)
        # Fewer circles than minima of the squared residual: one more may come to exist unseen.
        if there is None or len(fit.circles.radius) < there.minima:
            return _found_anew(problem)
        z = np.concatenate(
            [fit.circles.fixed_pivot, fit.circles.moving_pivot, fit.circles.radius[:, None]],
            axis=-1,
        )
        moved = moved_minima(z, circle_distances(seen), shares(task.weights, task.poses.shape))
        if not moved.sound.all() or len(_twins(moved.z)):
            return _found_anew(problem)
        sliders = tuple(lines(seen, task.weights)[0][0] for lines in (fixed_lines, moving_lines))
        new = _with_errors(fit, moved.z, sliders, seen)
        found, _ = found_dyads(new, task)
        moves = list(zip(_listed(fit), _listed(new), strict=True))
        return NewDyads(replace(self, fits=(new,), watched=there), found, [], moves)

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
            fit = _limited_fit(fit, new, seen)  # noqa: PLW2901
            fits.append(fit)
            limited.append(tuple(new))
            listed, _ = found_dyads(fit, task)
            found += [replace(one, limits=number if len(limits) > 1 else 0) for one in listed]
        there = replace(self, fits=tuple(fits), limited=tuple(limited))
        return NewDyads(there, found, doubts, moves)


class _Watched(NamedTuple):
    """Critical points (k, 4) in frames, and how many of them are real, and minima."""

    frames: CanonicalFrames
    points: ComplexArray
    real: int
    minima: int

    @classmethod
    def of(cls, critical: CriticalDyads) -> _Watched:
        """Those of one task."""
        points = critical.points[: int(critical.found)]
        return cls(critical.frames, points, int(critical.real.sum()), int(critical.minimum.sum()))

    def continued(self, task: Task) -> _Watched | None:
        """Those of another task; None where others of them are real, or minima."""
        seen = self.frames.to_canonical(task.poses)
        points = continued_points(self.points, seen, task.weights)
        if points is not None:
            return self._replace(points=points)
        anew = _Watched.of(critical_dyads(task.poses, task.weights))
        same = (len(anew.points), *anew[2:]) == (len(self.points), *self[2:])
        return anew if same else None


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


def _found_anew(problem: SynthesisProblem) -> NewDyads:
    """All dyads, by the method of the whole road."""
    search = search_dyads(problem)
    return NewDyads(DyadStrands.of(search.fits, problem), list(search.dyads), [], [])


def _listed(fit: BestDyads) -> list[Dyad]:
    """The circles and sliders of a fit, in the task's frames."""
    every: list[Dyad] = [
        RR(fit.dyads.fixed_pivot[k], fit.dyads.moving_pivot[k], fit.dyads.radius[k])
        for k in range(len(fit.dyads.radius))
    ]
    return every + [fit.frames.line_from_canonical(each) for each in fit.sliders]


def _with_errors(
    fit: BestDyads, z: FloatArray, sliders: tuple[PR | RP, ...], seen: Displacement
) -> BestDyads:
    """The fit with other circles z (k, 5) and sliders, in the same frames."""
    every = RR(z[:, :2], z[:, 2:4], z[:, 4])
    distance, unit = every[:, None].residual(seen), fit.frames.length
    rms, worst = np.sqrt((distance**2).mean(axis=-1)), np.abs(distance).max(axis=-1, initial=0)
    own = fit.frames.circle_from_canonical(every)
    return BestDyads(fit.search, every, own, sliders, rms * unit, worst * unit, 0)


def _twins(z: FloatArray) -> NDArray[np.intp]:
    """The numbers of dyads (k, n) that are the same as one before them."""
    apart = np.abs(z[:, None] - z).max(axis=-1) / (1 + np.abs(z).max(axis=-1))
    return np.flatnonzero(np.tril(apart < SAME_DYAD, -1).any(axis=1))


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Limited:
    """The minima of one kind within one limits.

    kind: RR, PR or RP; z: (k, 5) circles or (k, 4) lines in the frames of the fit, an RP dyad as
    the PR dyad of the inverse motion.  tables: the faces of `limits`; numbers: (k, blocks), those
    on which the minima lie.
    """

    kind: type[RR] | type[PR] | type[RP]
    limits: Limits
    tables: tuple[FaceTable, ...]
    z: FloatArray
    numbers: NDArray[np.intp]

    @classmethod
    def every(cls, fit: BestDyads, limits: Limits) -> tuple[Self, ...]:
        """The minima of a fit, those of one kind together."""
        out = []
        for kind in (RR, PR, RP):
            z = _coordinates(kind, fit)
            if len(z):
                tables = _tables(kind, limits, fit.frames)
                out.append(cls(kind, limits, tables, z, face_numbers(z, tables)))
        return tuple(out)

    def moved(
        self,
        seen: Displacement,
        limits: Limits,
        frames: CanonicalFrames,
        weights: FloatArray | None,
        exact: NDArray[np.bool_],
    ) -> tuple[Self, NDArray[np.intp], list[str]]:
        """The minima of other poses (N,) within other limits.

        With the number that each had, and what is doubtful of them.
        """
        doubts, tables = [], self.tables
        if limits is not self.limits:
            tables = _tables(self.kind, limits, frames)
            if any(len(a.at) != len(b.at) for a, b in zip(tables, self.tables, strict=True)):
                doubts.append("a limit has another number of edges than before")
                tables = self.tables
        poses = seen.inverse() if self.kind is RP else seen
        distances = circle_distances(poses) if self.kind is RR else line_distances(poses)
        share = shares(weights, poses.shape)
        kept = held(tables, self.numbers)
        there = moved_minima(self.z, distances, share, exact, kept)
        z, numbers = there.z.copy(), self.numbers.copy()
        blocks = [table.block for table in tables]
        outside = np.any([block.outside(z) for block in blocks], axis=0)
        events = np.flatnonzero(~there.sound | there.let_go | outside)
        if len(events):
            starts = [
                _onto(self.z[k], there.z[k], tables, numbers[k], bool(there.sound[k]))
                for k in events
            ]
            z[events] = np.stack(starts)
            events = events[inside(z[events], blocks)]
            z[events] = _down(z[events], distances, share, exact, blocks)
            events = events[np.isfinite(z[events]).all(axis=1)]
            numbers[events] = face_numbers(z[events], tables)
        lost = np.flatnonzero(~(np.isfinite(z).all(axis=1) & inside(np.nan_to_num(z), blocks)))
        index = np.delete(np.arange(len(z)), lost)
        if len(lost):
            doubts.append("a dyad within the limits was lost")
        if len(twins := _twins(z[index])):
            doubts.append("two dyads within the limits have met")
            index = np.delete(index, twins)
        new = replace(self, limits=limits, tables=tables, z=z[index], numbers=numbers[index])
        return new, index, doubts

    def dyads(self, frames: CanonicalFrames) -> list[Dyad]:
        """The minima in the task's frames."""
        out: list[Dyad] = []
        for each in self.z:
            if self.kind is RR:
                one = frames.circle_from_canonical(RR(each[None, :2], each[None, 2:4], each[4:]))
                out.append(RR(one.fixed_pivot[0], one.moving_pivot[0], one.radius[0]))
            elif self.kind is PR:
                out.append(frames.line_from_canonical(PR(each[0], each[1], each[2:])))
            else:
                out.append(frames.line_from_canonical(RP(each[2:], each[0], each[1])))
        return out


def _coordinates(kind: type[RR] | type[PR] | type[RP], fit: BestDyads) -> FloatArray:
    """The minima of one kind in a fit, as `_Limited` has them."""
    if kind is RR:
        some = fit.circles
        return np.concatenate([some.fixed_pivot, some.moving_pivot, some.radius[:, None]], axis=-1)
    rows = []
    for each in fit.sliders:
        if isinstance(each, PR) and kind is PR:
            rows.append([each.normal_angle, each.offset, *each.moving_pivot])
        if isinstance(each, RP) and kind is RP:
            rows.append([each.normal_angle, each.offset, *each.fixed_pivot])
    return np.array(rows, dtype=float).reshape(-1, 4)


def _tables(
    kind: type[RR] | type[PR] | type[RP], limits: Limits, frames: CanonicalFrames
) -> tuple[FaceTable, ...]:
    """The faces of limits in the coordinates of one kind."""
    own = limits_in(frames, limits)
    if kind is RR:
        blocks = (
            Block(slice(0, 2), own.fixed_pivot),
            Block(slice(2, 4), own.moving_pivot),
            Block(slice(4, 5), LengthRange(*own.length)),
        )
        return tuple(FaceTable.of(block, 5) for block in blocks)
    region = own.moving_pivot if kind is PR else own.fixed_pivot
    return (FaceTable.of(Block(slice(2, 4), region), 4),)


def _onto(
    old: FloatArray,
    new: FloatArray,
    tables: Sequence[FaceTable],
    numbers: NDArray[np.intp],
    sound: bool,
) -> FloatArray:
    """A start (n,) inside the limits: where the faces are now, as near to `new` as they allow."""
    if sound and not any(table.block.outside(new) for table in tables):
        return new
    start = old.copy()
    kept = held(tables, numbers[None])
    rows, gap = kept.rows[0][kept.active[0]], kept.gap(start[None])[0][kept.active[0]]
    start = start - np.linalg.pinv(rows) @ gap if len(rows) else start
    for table in tables:  # on the nearest face, where an edge came over the dyad
        if table.block.outside(start):
            start = nearest_face(start, table)[1]
    return start


def _down(
    starts: FloatArray,
    distances: DistanceFunction,
    share: FloatArray,
    exact: NDArray[np.bool_],
    blocks: Sequence[Block],
) -> FloatArray:
    """The minima within limits to which dyads (k, n) lead, as the search goes down; or nan."""
    problem = FitProblem(distances, share, exact)

    def step(at: Point, along: FloatArray) -> GeometricFit:
        return least_squares_step(problem, at, along)

    z, settled = descend(starts, distances, step, blocks)
    missed = np.abs(distances.only(z)[:, exact]).max(axis=1, initial=0)
    good = settled & (missed <= EXACT_ROUNDING * (1 + np.abs(z).max(axis=1)))
    return np.where(good[:, None], z, np.nan)


def _limited_fit(fit: BestDyads, strands: Sequence[_Limited], seen: Displacement) -> BestDyads:
    """The fit with the minima where they are now."""
    z = np.empty((0, 5))
    sliders: list[PR | RP] = []
    for strand in strands:
        if strand.kind is RR:
            z = strand.z
        elif strand.kind is PR:
            sliders += [PR(each[0], each[1], each[2:]) for each in strand.z]
        else:
            sliders += [RP(each[2:], each[0], each[1]) for each in strand.z]
    new = _with_errors(fit, z, tuple(sliders), seen)
    assert isinstance(fit.search, LimitedDyads)
    return replace(new, search=replace(fit.search, circles=new.circles, sliders=new.sliders))
