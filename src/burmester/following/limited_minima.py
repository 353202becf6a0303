"""The minima within limits: each moves along the faces on which it lies.

Where one leaves a face or comes to one, it goes down as in the search.  A dyad that appears is not
seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self, final

import numpy as np
from numpy.typing import NDArray

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
from burmester.dyads.limited_block import Block, circle_blocks, face_conditions, face_numbers
from burmester.dyads.local_minima import BestDyads
from burmester.dyads.minima_within_limits import LimitedDyads
from burmester.following.minimum_step import moved_fit, moved_minima, twins
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.fourbar.linkage_batch import row_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, shares
from burmester.tasks.limits import Limits, limits_in

EXACT_ROUNDING = 1e-9  # relative; an exact pose that is missed by less is met


@final
@dataclass(frozen=True, slots=True, eq=False)
class LimitedMinima:
    """The minima of one kind within one limits.

    kind: RR, PR or RP; z: (k, 5) circles or (k, 4) lines in the frames of the fit, an RP dyad as
    the PR dyad of the inverse motion.  blocks: of `limits`; numbers: (k, blocks), the faces on
    which the minima lie.
    """

    kind: type[RR] | type[PR] | type[RP]
    limits: Limits
    blocks: tuple[Block, ...]
    z: FloatArray
    numbers: NDArray[np.intp]

    @classmethod
    def every(cls, fit: BestDyads, limits: Limits) -> tuple[Self, ...]:
        """The minima of a fit, those of one kind together."""
        out = []
        for kind in (RR, PR, RP):
            z = _coordinates(kind, fit)
            if len(z):
                blocks = _blocks(kind, limits, fit.frames)
                out.append(cls(kind, limits, blocks, z, face_numbers(z, blocks)))
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
        doubts, blocks = [], self.blocks
        if limits is not self.limits:
            blocks = _blocks(self.kind, limits, frames)
            if any(a.count != b.count for a, b in zip(blocks, self.blocks, strict=True)):
                doubts.append("a limit has another number of edges than before")
                blocks = self.blocks
        poses = seen.inverse() if self.kind is RP else seen
        distances = circle_distances(poses) if self.kind is RR else line_distances(poses)
        share = shares(weights, poses.shape)
        kept = face_conditions(blocks, self.numbers, self.z.shape[1])
        there = moved_minima(self.z, distances, share, exact, kept)
        z, numbers = there.z.copy(), self.numbers.copy()
        outside = np.any([block.outside(z) for block in blocks], axis=0)
        events = np.flatnonzero(~there.sound | there.let_go | outside)
        if len(events):
            starts = [
                _onto(self.z[k], there.z[k], blocks, numbers[k], bool(there.sound[k]))
                for k in events
            ]
            z[events] = np.stack(starts)
            events = events[inside(z[events], blocks)]
            z[events] = _down(z[events], distances, share, exact, blocks)
            events = events[np.isfinite(z[events]).all(axis=1)]
            numbers[events] = face_numbers(z[events], blocks)
        lost = np.flatnonzero(~(np.isfinite(z).all(axis=1) & inside(np.nan_to_num(z), blocks)))
        index = np.delete(np.arange(len(z)), lost)
        if len(lost):
            doubts.append("a dyad within the limits was lost")
        if len(met := twins(z[index])):
            doubts.append("two dyads within the limits have met")
            index = np.delete(index, met)
        new = replace(self, limits=limits, blocks=blocks, z=z[index], numbers=numbers[index])
        return new, index, doubts

    def dyads(self, frames: CanonicalFrames) -> list[Dyad]:
        """The minima in the task's frames."""
        if self.kind is RR:
            z = self.z
            every = frames.circle_from_canonical(RR(z[:, :2], z[:, 2:4], z[:, 4]))
            return [every[k] for k in range(len(z))]
        return [frames.line_from_canonical(each) for each in self.sliders]

    @property
    def sliders(self) -> list[PR | RP]:
        """The minima that are no circles, in the frames of the fit."""
        if self.kind is PR:
            return [PR(each[0], each[1], each[2:]) for each in self.z]
        return [RP(each[2:], each[0], each[1]) for each in self.z if self.kind is RP]


def _coordinates(kind: type[RR] | type[PR] | type[RP], fit: BestDyads) -> FloatArray:
    """The minima of one kind in a fit, as `_Limited` has them."""
    if kind is RR:
        return row_of(fit.circles)
    rows = []
    for each in fit.sliders:
        if isinstance(each, PR) and kind is PR:
            rows.append([each.normal_angle, each.offset, *each.moving_pivot])
        if isinstance(each, RP) and kind is RP:
            rows.append([each.normal_angle, each.offset, *each.fixed_pivot])
    return np.array(rows, dtype=float).reshape(-1, 4)


def _blocks(
    kind: type[RR] | type[PR] | type[RP], limits: Limits, frames: CanonicalFrames
) -> tuple[Block, ...]:
    """What limits say in the coordinates of one kind."""
    own = limits_in(frames, limits)
    if kind is RR:
        return circle_blocks(own)
    return (Block(slice(2, 4), own.moving_pivot if kind is PR else own.fixed_pivot),)


def _onto(
    old: FloatArray,
    new: FloatArray,
    blocks: Sequence[Block],
    numbers: NDArray[np.intp],
    sound: bool,
) -> FloatArray:
    """A start (n,) inside the limits: where the faces are now, as near to `new` as they allow."""
    if sound and not any(block.outside(new) for block in blocks):
        return new
    start = old.copy()
    kept = face_conditions(blocks, numbers[None], len(start))
    rows, gap = kept.rows[0][kept.active[0]], kept.gap(start[None])[0][kept.active[0]]
    start = start - np.linalg.pinv(rows) @ gap if len(rows) else start
    for block in blocks:  # on the nearest face, where an edge came over the dyad
        if block.outside(start):
            start = block.nearest_face(start)[1]
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


def limited_fit(fit: BestDyads, strands: Sequence[LimitedMinima], seen: Displacement) -> BestDyads:
    """The fit with the minima where they are now."""
    z = next((strand.z for strand in strands if strand.kind is RR), np.empty((0, 5)))
    sliders = tuple(each for strand in strands for each in strand.sliders)
    new = moved_fit(fit, z, sliders, seen)
    assert isinstance(fit.search, LimitedDyads)
    return replace(new, search=replace(fit.search, circles=new.circles, sliders=new.sliders))
