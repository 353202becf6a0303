"""The linkages of a task, continued to a task that differs a little.

A linkage that is its pair of dyads goes with them.  One that was refined stays the least error of
its neighbourhood, by Newton's method along the faces of the limits on which it lies.  Every other
one (from a search, a trade or a family, and within tolerances) moves with the poses: by the least
change of its dimensions that keeps its errors; whether it is the best under its conditions then is
not asked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import FoundDyad
from burmester.following.linkage_faces import (
    brought_inside,
    faces_met,
    linkage_face_numbers,
    linkages_held,
    outside_limits,
)
from burmester.following.linkage_steps import (
    Least,
    curvatures,
    gains,
    least_errors,
    moved_with_places,
)
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.evaluation import sizable
from burmester.numerics.arrays import FloatArray, concatenate, replaced, take
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.residuals import SIZE, Problem
from burmester.refinement.target import Target
from burmester.tasks.limits import Limits
from burmester.verdicts.found_linkage import FoundLinkage, Pair

LEAST_GAIN = 1e-6  # share of the squared error; where a step gains more, a linkage is no minimum
SAME_DIMENSIONS = 1e-9  # relative; a linkage that differs by less is its pair of dyads
PASSED = 1e-10  # lengths; dyads that miss a pose by less pass it
RESTLESS_STEP = 1e-3  # relative; a linkage whose last step is as long has lost its minimum
FACES_MET = 4  # that linkages come to on their way with the poses, at most
REFINING_STEPS = 20  # where a linkage comes to a face of the limits, or leaves one


class Way(IntEnum):
    """How a linkage goes on: with its dyads, as a least error, or with the poses."""

    DYADS, LEAST, MOVED = 0, 1, 2


class NewLinkages(NamedTuple):
    """Linkages continued to a new task.

    strands: of those that go on; batch, rows: in the frames of the target, with their places.
    vanished: the ids of those whose dyads vanished, or became one; doubts: in sentences.
    """

    strands: LinkageStrands
    batch: LinkageBatch
    rows: FloatArray
    vanished: list[str]
    doubts: list[str]

    def with_pairs(self, pairs: Sequence[Pair], target: Target, last: int) -> NewLinkages:
        """The same and linkages of pairs of dyads, as they are; last: the greatest number in use.

        Their places are looked for from nothing.
        """
        if not pairs:
            return self
        own = LinkageBatch.of([Linkage(one.dyad, two.dyad) for one, two in pairs])
        batch, count = own.to_canonical(target.frames), len(pairs)
        rows, strands = target.places(batch), self.strands
        numbers = range(last + 1, last + 1 + count)
        places = target.frames.from_canonical(target.places_of(rows))
        new = LinkageStrands(
            [f"L{number}" for number in numbers],
            list(numbers),
            [(one.id, two.id) for one, two in pairs],
            [True] * count,
            np.zeros(count, dtype=bool),
            own,
            places,
            np.full(count, Way.DYADS, dtype=np.int8),
            np.zeros((count, SIZE, SIZE)),
            np.full((count, 2, 3), -1, dtype=np.intp),
        )
        return self._replace(
            strands=concatenate([strands, new]),
            batch=concatenate([self.batch, batch]),
            rows=np.concatenate([self.rows, rows]),
        )


@final
@dataclass(frozen=True, slots=True, eq=False)
class LinkageStrands:
    """What of linkages (k,) goes on from task to task.

    ids, ranks, pairs, determined, from_search: as in the synthesis; pairs are the ids of the dyads.
    own: the linkages in the task's frames; places: (k, N), theirs nearest to the poses.
    way: (k,); curvature: (k, 10, 10), of the residuals, as far as it is known.
    numbers: (k, 2, 3), the faces of the limits on which fixed pivot, moving pivot and length of
    both dyads lie.
    """

    ids: list[str]
    ranks: list[int]
    pairs: list[tuple[str, str]]
    determined: list[bool]
    from_search: NDArray[np.bool_]
    own: LinkageBatch
    places: Displacement
    way: NDArray[np.int8]
    curvature: FloatArray
    numbers: NDArray[np.intp]

    @classmethod
    def of(
        cls,
        found: Sequence[FoundLinkage],
        dyads: Sequence[FoundDyad],
        limits: Sequence[Limits],
        at: Sequence[int],
        target: Target,
    ) -> Self:
        """The strands of linkages of a synthesis; at: the poses (N,) of the target among theirs.

        dyads: those that go on by themselves.
        """
        count, number = len(found), len(at)
        places = Displacement(
            np.array([each.error.places.translation[at] for each in found]).reshape(-1, number, 2),
            np.array([each.error.places.angle[at] for each in found]).reshape(-1, number),
        )
        own = LinkageBatch.of([each.linkage for each in found])
        batch = own.to_canonical(target.frames)
        strands = cls(
            [each.id for each in found],
            [each.rank for each in found],
            [(each.dyads[0].id, each.dyads[1].id) for each in found],
            [each.determined for each in found],
            np.array([each.from_search for each in found], dtype=bool),
            own,
            places,
            np.full(count, Way.MOVED, dtype=np.int8),
            np.zeros((count, SIZE, SIZE)),
            linkage_face_numbers(batch, limits, target.frames),
        )
        if not count or not dyads:
            return strands
        known = {each.id: each for each in dyads}
        way = strands.way.copy()
        rows, curvature = target.rows_at(places), strands.curvature
        if target.boxes is None:
            kept = linkages_held(strands.numbers, limits, target.frames)
            problem, z = _problem(batch, target), batch.dimensions.reshape(count, SIZE)
            with np.errstate(all="ignore"):
                state = problem.state(np.arange(count), z, rows)
                curvature = curvatures(problem, state)
                gain = np.nan_to_num(gains(problem, state, curvature, kept), nan=np.inf)
            way[gain < LEAST_GAIN] = Way.LEAST
        way[np.array([_is_pair(each, known) for each in found])] = Way.DYADS
        return replace(strands, way=way, curvature=curvature)

    def __len__(self) -> int:
        return len(self.ids)

    def continued(
        self,
        target: Target,
        limits: Sequence[Limits],
        before: Displacement,
        dyads: Mapping[str, FoundDyad],
    ) -> NewLinkages:
        """The linkages of a new task.

        target, limits: its own; before: (N,), the poses that the places belong to; dyads: the new
        ones by their ids.
        """
        gone = [
            way == Way.DYADS and not all(each in dyads for each in pair)
            for way, pair in zip(self.way, self.pairs, strict=True)
        ]
        vanished = [id for id, lost in zip(self.ids, gone, strict=True) if lost]
        strands = take(self, np.flatnonzero(~np.array(gone, dtype=bool))) if vanished else self
        if not len(strands):
            none = np.empty((0, target.poses.shape[0], 3))
            return NewLinkages(strands, strands.own, none, vanished, [])
        frames = target.frames
        own = _with_dyads(strands, dyads)
        wanted, batch = rows_of(target.poses, target.length), own.to_canonical(frames)
        rows = target.rows_at(strands.places) + wanted - target.rows_at(before)
        rows = np.where(_passed(batch, target.poses)[..., None], wanted, rows)
        stretch = _Stretch(target, limits, strands.way, strands.curvature)
        start = stretch.start(batch, rows, strands.numbers)
        there, curvature, last = stretch.with_least_errors(start)
        lost = np.flatnonzero(~np.isfinite(there.rows).all(axis=(1, 2)))
        if len(lost):  # nowhere near, or no longer where they were
            there.rows[lost] = target.places(there.batch[lost])
        with_dyads = (strands.way == Way.DYADS)[:, None, None]
        moved = there.batch.from_canonical(frames).dimensions
        strands = replace(
            strands,
            own=LinkageBatch(own.kinds, np.where(with_dyads, own.dimensions, moved)),
            places=frames.from_canonical(target.places_of(there.rows)),
            curvature=curvature,
            numbers=there.numbers,
        )
        if not (sound := sizable(there.batch)).all():
            vanished += [strands.ids[k] for k in np.flatnonzero(~sound)]
            kept, last = np.flatnonzero(sound), last[sound]
            there, strands = take((there, strands), kept)
        lost = np.flatnonzero(last > RESTLESS_STEP)
        if len(lost):
            way = strands.way.copy()
            way[lost] = Way.MOVED
            strands = replace(strands, way=way)
        doubts = [f"{strands.ids[k]} has lost its minimum, and moves with the poses" for k in lost]
        return NewLinkages(strands, there.batch, there.rows, vanished, doubts)


class _Here(NamedTuple):
    """Linkages (k,) with places (k, N, 3) and faces (k, 2, 3)."""

    batch: LinkageBatch
    rows: FloatArray
    numbers: NDArray[np.intp]


class _Stretch(NamedTuple):
    """The stretch from one task to the next, of linkages (k,) in the frames of the target."""

    target: Target
    limits: Sequence[Limits]
    way: NDArray[np.int8]
    curvature: FloatArray

    def start(self, batch: LinkageBatch, rows: FloatArray, numbers: NDArray[np.intp]) -> _Here:
        """The linkages, those that move with the poses where they go.

        rows: their places, moved as the poses are.
        """
        frames, dimensions = self.target.frames, batch.dimensions.copy()
        index, numbers = np.flatnonzero(self.way == Way.MOVED), numbers.copy()
        if self.target.poses.shape[0] <= DIMENSIONS:  # all are met: no face is kept for nothing
            numbers[index] = -1
        left = index
        for _ in range(FACES_MET):
            if not len(left):
                break
            kept = linkages_held(numbers[left], self.limits, frames)
            some, places = batch[left], self.target.places_of(rows[left])
            there = moved_with_places(some, places, kept)
            out = outside_limits(there, self.limits, frames)
            if out.any():  # once more, along the faces to which they came
                there, numbers[left] = faces_met(there, numbers[left], self.limits, frames)
            dimensions[left] = there.dimensions
            left = left[out]
        there, rows = LinkageBatch(batch.kinds, dimensions), rows.copy()
        others = np.flatnonzero(self.way != Way.LEAST)  # these come to their places by themselves
        if len(others):
            some, every = there[others], np.arange(len(others))
            z = some.dimensions.reshape(-1, SIZE)
            with np.errstate(all="ignore"):
                rows[others] = _problem(some, self.target).state(every, z, rows[others]).rows
        return _Here(there, rows, numbers)

    def with_least_errors(self, here: _Here) -> tuple[_Here, FloatArray, FloatArray]:
        """The linkages, each least error where it is now; curvature, and the last steps (k,)."""
        count, curvature = len(here.batch), self.curvature.copy()
        last, index = np.zeros(count), np.flatnonzero(self.way == Way.LEAST)
        if not len(index):
            return here, curvature, last
        found = self._least(here, index)
        curvature[index], last[index] = found.curvature, found.last
        z = found.state.z.reshape(-1, 2, DIMENSIONS)
        batch = LinkageBatch(here.batch.kinds[index], z)
        there = replaced(here, index, _Here(batch, found.state.rows, here.numbers[index]))
        if not self.limits:
            return there, curvature, last
        left = outside_limits(there.batch[index], self.limits, self.target.frames)
        events = index[found.let_go | left]
        if len(events):
            there = self._along_other_faces(there, events)
        return there, curvature, last

    def _least(self, here: _Here, index: NDArray[np.intp]) -> Least:
        """Newton's steps of the linkages at the indices."""
        problem, z = _problem(here.batch[index], self.target), here.batch.dimensions[index]
        kept = linkages_held(here.numbers[index], self.limits, self.target.frames)
        every = np.arange(len(index))
        with np.errstate(all="ignore"):
            state = problem.state(every, z.reshape(-1, SIZE), here.rows[index])
            return least_errors(problem, state, self.curvature[index], kept)

    def _along_other_faces(self, here: _Here, index: NDArray[np.intp]) -> _Here:
        """Linkages refined under their limits, and the faces on which they lie then."""
        frames = self.target.frames
        start = brought_inside(here.batch[index], self.limits, frames)
        refined = self.target.refine(
            start,
            here.rows[index],
            constraints=AllConstraints(self.target.kept),
            constrained_steps=REFINING_STEPS,
        )
        good = np.isfinite(refined.rows).all(axis=(1, 2))
        batch, rows = refined.batch[good], refined.rows[good]
        numbers = linkage_face_numbers(batch, self.limits, frames)
        return replaced(here, index[good], _Here(batch, rows, numbers))


def _is_pair(found: FoundLinkage, known: Mapping[str, FoundDyad]) -> bool:
    """Whether a linkage has the dimensions of its two dyads."""
    pair = [known.get(each.id) for each in found.dyads]
    one, two = pair
    if one is None or two is None:
        return False
    kinds = [type(each.dyad) for each in (one, two)]
    if kinds != [type(found.linkage.first), type(found.linkage.second)]:
        return False
    a, b = (LinkageBatch.of([each]) for each in (found.linkage, Linkage(one.dyad, two.dyad)))
    size = 1 + np.abs(a.dimensions).max(axis=-1)
    return bool((np.abs(a.dimensions - b.dimensions).max(axis=-1) < SAME_DIMENSIONS * size).all())


def _with_dyads(strands: LinkageStrands, dyads: Mapping[str, FoundDyad]) -> LinkageBatch:
    """The linkages in the task's frames, those that go with their dyads as these are now."""
    index = np.flatnonzero(strands.way == Way.DYADS)
    if not len(index):
        return strands.own
    pairs = [strands.pairs[k] for k in index]
    new = LinkageBatch.of([Linkage(dyads[one].dyad, dyads[two].dyad) for one, two in pairs])
    return replaced(strands.own, index, new)


def _passed(batch: LinkageBatch, poses: Displacement) -> NDArray[np.bool_]:
    """Which poses (N,) linkages (k,) pass: of a pose at a dead point no other place is near."""
    every = np.broadcast_to(np.arange(poses.shape[0]), (len(batch), poses.shape[0]))
    away = np.abs(batch.jacobians(poses[every]).residual).max(axis=1)
    return np.asarray(away < PASSED)


def _problem(batch: LinkageBatch, target: Target) -> Problem:
    """What linkages (k,) are refined for."""
    return Problem.of(
        batch, target.poses, target.length, weights=target.weights, exact=target.exact
    )
