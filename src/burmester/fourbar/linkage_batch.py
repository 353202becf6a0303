"""Batches of linkages of mixed kinds: each dyad's five dimensions, its constraint and derivatives.

For RR, PR and RP alike each dyad is one equation f = 0 of the coupler's place, with a gradient (the
force that the dyad can bear) and derivatives by its dimensions.  So a batch of pairs of any kinds
is a few arrays.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.coupler_kernel import (
    constraint_jacobians,
    least_transmissions,
    transmission_slopes,
    transmissions,
)
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, Indexed

DYAD_KINDS: Final = (RR, PR, RP)  # the kinds of dyads, by their number in a batch
DIMENSIONS: Final = 5  # number of dimensions of a dyad; a slider leaves the last one unused
FIXED, MOVING = slice(0, 2), slice(2, 4)  # the pivots' coordinates in an RR dyad's dimensions


class ConstraintJacobians(NamedTuple):
    """The constraints of both dyads of linkages (k,) at coupler places (k, *), and derivatives.

    residual: (k, 2, *), the equation f, near its zero the distance from the constraint.
    force: (k, 2, *, 3), its derivatives by d1, d2 and the angle: a force and its moment.
    by_dimension: (k, 2, *, 5), its derivatives by the dyad's dimensions.
    """

    residual: FloatArray
    force: FloatArray
    by_dimension: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class LinkageBatch(Indexed):
    """Linkages (k,) of two dyads each, RR, PR or RP.

    kinds: (k, 2), indices in DYAD_KINDS.
    dimensions: (k, 2, 5): RR fixed pivot, moving pivot, radius; PR normal angle, offset, moving
        pivot, 0; RP fixed pivot, normal angle, offset, 0.
    """

    kinds: NDArray[np.int8]
    dimensions: FloatArray

    @classmethod
    def of(cls, linkages: Sequence[Linkage]) -> Self:
        """The batch of single linkages without PP dyads."""
        kinds = np.zeros((len(linkages), 2), dtype=np.int8)
        dimensions = np.zeros((len(linkages), 2, DIMENSIONS))
        for k, linkage in enumerate(linkages):
            for side, dyad in enumerate((linkage.first, linkage.second)):
                if isinstance(dyad, PP):
                    raise TypeError("a batch has no PP dyads")
                dimensions[k, side] = row_of(dyad)
                kinds[k, side] = DYAD_KINDS.index(type(dyad))
        return cls(kinds, dimensions)

    @classmethod
    def of_pins(cls, linkages: Linkage) -> Self:
        """The batch of linkages (k,) of RR dyads."""
        dimensions = np.stack([row_of(linkages.first), row_of(linkages.second)], axis=1)
        return cls(np.zeros(dimensions.shape[:2], dtype=np.int8), dimensions)

    def __len__(self) -> int:
        return len(self.kinds)

    def linkage(self, index: int) -> Linkage:
        """The linkage at an index."""
        return Linkage(*(self._dyads(side, index) for side in (0, 1)))

    def linkage_of_all(self) -> Linkage:
        """All linkages (k,) of one pair of kinds as one value."""
        return Linkage(*(self._dyads(side, slice(None)) for side in (0, 1)))

    def exchanged(self) -> LinkageBatch:
        """The same with the two dyads exchanged."""
        return LinkageBatch(self.kinds[:, ::-1], self.dimensions[:, ::-1])

    def in_order(self, sides: NDArray[np.intp]) -> LinkageBatch:
        """The same with their dyads in the order of the sides (k, 2)."""
        every = np.arange(len(self))[:, None]
        return LinkageBatch(self.kinds[every, sides], self.dimensions[every, sides])

    def alike(self) -> Iterator[tuple[NDArray[np.intp], Linkage]]:
        """For each pair of kinds the indices (n,) and the linkages (n,)."""
        number = self.kinds[:, 0] * len(DYAD_KINDS) + self.kinds[:, 1]
        for pair in sorted(set(number.tolist())):
            index = np.flatnonzero(number == pair)
            yield index, Linkage(*(self._dyads(side, index) for side in (0, 1)))

    def _dyads(self, side: int, index: Any) -> RR | PR | RP:
        """The dyads of one side; those indexed are of one kind."""
        kind = self.kinds[index, side]
        return dyads_of(int(kind if kind.ndim == 0 else kind[0]), self.dimensions[index, side])

    def distances(self, poses: Displacement) -> FloatArray:
        """The signed distances (k, 2, *) of poses (*,) from the constraints of both dyads."""
        out = np.empty((*self.kinds.shape, *poses.shape))
        for kind in range(len(DYAD_KINDS)):
            if (own := self.kinds == kind).any():
                rows = self.dimensions[own].reshape(-1, *(1 for _ in poses.shape), DIMENSIONS)
                out[own] = dyads_of(kind, rows).residual(poses)
        return out

    def to_canonical(self, frames: CanonicalFrames) -> LinkageBatch:
        """The same linkages in the frames of one task, or of each one's own (k,)."""
        one = np.ones_like(frames.length)
        return self._moved(-frames.fixed_origin, -frames.moving_origin, one, 1 / frames.length)

    def from_canonical(self, frames: CanonicalFrames) -> LinkageBatch:
        """The inverse of `to_canonical`."""
        one = np.ones_like(frames.length)
        return self._moved(frames.fixed_origin, frames.moving_origin, frames.length, one)

    def _moved(
        self, fixed: FloatArray, moving: FloatArray, before: FloatArray, after: FloatArray
    ) -> LinkageBatch:
        """With lengths times `before`, origins moved, then times `after`."""
        out, shape = self.dimensions.copy(), self.kinds.shape
        before, after = (np.broadcast_to(each[..., None], shape) for each in (before, after))
        for at, kind, origin in ((0, 1, fixed), (2, 2, moving)):
            line = self.kinds == kind
            shift = np.broadcast_to(origin[..., None, :], (*shape, 2))
            points, lines = out[~line], out[line]
            moved = before[~line, None] * points[:, at : at + 2] + shift[~line]
            points[:, at : at + 2] = moved * after[~line, None]
            normal = lines[:, at]
            along = np.cos(normal) * shift[line, 0] + np.sin(normal) * shift[line, 1]
            lines[:, at + 1] = (before[line] * lines[:, at + 1] + along) * after[line]
            out[~line], out[line] = points, lines
        out[..., 4] *= before * after
        return LinkageBatch(self.kinds, out)

    def jacobians(self, places: Displacement) -> ConstraintJacobians:
        """The constraints of both dyads at coupler places (k, *), and their derivatives.

        Formula `constraint-form` of the theory.
        """
        shape = places.angle.shape
        rows = np.concatenate([places.translation, places.angle[..., None]], axis=-1)
        count, number = len(self), int(np.prod(shape[1:]))
        out = tuple(np.empty((count, 2, number, *last)) for last in ((), (3,), (DIMENSIONS,)))
        constraint_jacobians(self.kinds, self.dimensions, rows.reshape(count, number, 3), *out)
        return ConstraintJacobians(
            *(each.reshape(count, 2, *shape[1:], *each.shape[3:]) for each in out)
        )


def row_of(dyad: Dyad) -> FloatArray:
    """The dimensions (*, 5) of dyads (*,), zeros behind them; of a PP dyad its angle."""
    parts = ((getattr(dyad, name), name.endswith("pivot")) for name in dyad.__match_args__)
    row = np.concatenate([part if pivot else part[..., None] for part, pivot in parts], axis=-1)
    out = np.zeros((*row.shape[:-1], DIMENSIONS))
    out[..., : row.shape[-1]] = row
    return out


def dyads_of(kind: int, rows: FloatArray) -> RR | PR | RP:
    """The dyads of a kind, by its number, with dimensions (*, 5)."""
    if DYAD_KINDS[kind] is RR:
        return RR(rows[..., :2], rows[..., 2:4], rows[..., 4])
    if DYAD_KINDS[kind] is PR:
        return PR(rows[..., 0], rows[..., 1], rows[..., 2:4])
    return RP(rows[..., :2], rows[..., 2], rows[..., 3])


def pin_distances(batch: LinkageBatch) -> FloatArray:
    """The distances (k, 4) of the pins at both ends of links; nan where a slider is at one end.

    In the order of the dyads' own links, the ground link, the coupler.
    """
    kinds, z = batch.kinds, batch.dimensions
    ground, coupler = (np.linalg.norm(z[:, 1, at] - z[:, 0, at], axis=-1) for at in (FIXED, MOVING))
    return np.column_stack(
        [
            np.where(kinds == 0, z[:, :, -1], np.nan),
            np.where((kinds == 1).any(axis=1), np.nan, ground),
            np.where((kinds == 2).any(axis=1), np.nan, coupler),
        ]
    )


class Transmission(NamedTuple):
    """Linkages (k,) at places (k, N).

    sine: (k, N), of the transmission angle, signed.  It changes its sign at the dead points of the
    driver.  It is the power that the driver transmits: the determinant of three wrenches (the
    driver's effort and both constraints), over its lever.
    drive: (k, N), the input, see `loop_closure`; turns: (k,), whether it is an angle.

    Formula `signed-transmission` of the theory.
    """

    sine: FloatArray
    drive: FloatArray
    turns: NDArray[np.bool_]

    @classmethod
    def of(
        cls, batch: LinkageBatch, rows: FloatArray, length: float, driver: NDArray[np.intp]
    ) -> Transmission:
        """At rows (k, N, 3)."""
        sine, drive = np.empty((2, *rows.shape[:2]))
        transmissions(batch.kinds, batch.dimensions, rows, length, driver, sine, drive)
        return cls(sine, drive, batch.kinds[np.arange(len(batch)), driver] != 1)

    @classmethod
    def differentiated(
        cls,
        batch: LinkageBatch,
        rows: FloatArray,
        length: float,
        driver: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> tuple[Transmission, FloatArray, FloatArray]:
        """Also the derivatives (k, N, n) of sine and drive, as difference quotients.

        place_jacobian: (k, N, 3, n), of the rows by the unknowns: the ten dimensions, and if n is
        more, a step along the motion for each place.
        """
        shape, own = rows.shape[:2], 2 * DIMENSIONS
        sine, drive = np.empty((2, *shape))
        slopes = np.empty((2, *shape, own + 1))
        transmission_slopes(
            *(batch.kinds, batch.dimensions, rows, place_jacobian, length, driver),
            *(sine, drive, *slopes),
        )
        out = np.zeros((2, *shape, place_jacobian.shape[-1]))
        out[..., :own] = slopes[..., :own]
        if place_jacobian.shape[-1] > own:
            each = np.arange(shape[1])
            out[:, :, each, own + each] = slopes[..., own]
        turns = batch.kinds[np.arange(len(batch)), driver] != 1
        return cls(sine, drive, turns), out[0], out[1]


class LeastTransmission(NamedTuple):
    """Where the transmission angle of linkages (k,) may be least between two places.

    at: (k, 2), inputs, the ends of the range of f (see `loop_closure`); nan for pairs without such
    a minimum.  cosine: (k, 2), of the transmission angle there, above 1 where the linkage does not
    close; slope: (k, 2, 10), its derivatives by the dimensions.
    """

    at: FloatArray
    cosine: FloatArray
    slope: FloatArray

    @classmethod
    def of(cls, batch: LinkageBatch, driver: NDArray[np.intp]) -> LeastTransmission:
        """That of linkages (k,)."""
        at, cosine = np.empty((2, len(batch), 2))
        slope = np.empty((len(batch), 2, 2 * DIMENSIONS))
        least_transmissions(batch.kinds, batch.dimensions, driver, at, cosine, slope)
        return cls(np.where(np.isnan(cosine), np.nan, at), cosine, slope)
