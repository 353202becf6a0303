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
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.numerics.bundles import take

__all__ = ["DIMENSIONS", "DYAD_KINDS", "ConstraintForms", "ConstraintJacobians", "LinkageBatch"]

DYAD_KINDS: Final = (RR, PR, RP)  # the kinds of dyads, by their number in a batch
DIMENSIONS: Final = 5  # number of dimensions of a dyad; a slider leaves the last one unused


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
class LinkageBatch:
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
                if isinstance(dyad, RR):
                    row = [*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius]
                elif isinstance(dyad, PR):
                    row = [dyad.normal_angle, dyad.offset, *dyad.moving_pivot, 0.0]
                elif isinstance(dyad, RP):
                    row = [*dyad.fixed_pivot, dyad.normal_angle, dyad.offset, 0.0]
                else:
                    raise TypeError("a batch has no PP dyads")
                kinds[k, side] = DYAD_KINDS.index(type(dyad))
                dimensions[k, side] = row
        return cls(kinds, dimensions)

    def __len__(self) -> int:
        return len(self.kinds)

    def __getitem__(self, index: Any) -> LinkageBatch:
        """Pick linkages (slices, masks, index arrays)."""
        return take(self, index)

    def linkage(self, index: int) -> Linkage:
        """The linkage at an index."""
        return Linkage(*(self._dyads(side, index) for side in (0, 1)))

    def exchanged(self) -> LinkageBatch:
        """The same with the two dyads exchanged."""
        return LinkageBatch(self.kinds[:, ::-1], self.dimensions[:, ::-1])

    def alike(self) -> Iterator[tuple[NDArray[np.intp], Linkage]]:
        """For each pair of kinds the indices (n,) and the linkages (n,)."""
        number = self.kinds[:, 0] * len(DYAD_KINDS) + self.kinds[:, 1]
        for pair in sorted(set(number.tolist())):
            index = np.flatnonzero(number == pair)
            yield index, Linkage(*(self._dyads(side, index) for side in (0, 1)))

    def _dyads(self, side: int, index: Any) -> RR | PR | RP:
        """The dyads of one side; those indexed are of one kind."""
        kind = DYAD_KINDS[int(np.ravel(self.kinds[index, side])[0])]
        row = self.dimensions[index, side]
        if kind is RR:
            return RR(row[..., :2], row[..., 2:4], row[..., 4])
        if kind is PR:
            return PR(row[..., 0], row[..., 1], row[..., 2:4])
        return RP(row[..., :2], row[..., 2], row[..., 3])

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
        """With lengths times `before`, origins moved by fixed and moving, then times `after`.

        All for one task, or for each linkage (k,).
        """
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

    def forms(self) -> ConstraintForms:
        """The constraint manifolds of both dyads, scaled as in `jacobians`."""
        one, two, last = (
            self.dimensions[..., :2],
            self.dimensions[..., 2:4],
            self.dimensions[..., 4],
        )
        c, m = complex_of(one), complex_of(two)
        out = ConstraintForms(
            *(np.zeros(c.shape, dtype) for dtype in (float, complex, complex, complex, float))
        )
        rr, pr, rp = (self.kinds == kind for kind in range(len(DYAD_KINDS)))
        if rr.any():
            fixed, moving, r = c[rr], m[rr], last[rr]
            constant = (np.abs(moving) ** 2 + np.abs(fixed) ** 2) / r - r
            terms = (0.5 / r, -fixed / r, moving / r, -moving * fixed.conj() / r, constant / 2)
            for whole, part in zip(out, terms, strict=True):
                whole[rr] = part
        if pr.any():
            normal = np.exp(1j * one[pr][:, 0])
            out.still[pr], out.both[pr] = normal, normal.conj() * m[pr]
            out.constant[pr] = -one[pr][:, 1]
        if rp.any():
            normal = np.exp(1j * two[rp][:, 0])
            out.turned[rp], out.both[rp] = -normal, normal * c[rp].conj()
            out.constant[rp] = -two[rp][:, 1]
        return out

    def jacobians(self, places: Displacement) -> ConstraintJacobians:
        """The constraints of both dyads at coupler places (k, *), and their derivatives."""
        d, turn = complex_of(places.translation)[:, None], np.exp(1j * places.angle)[:, None]
        miss, push, swing = self.forms().at(d, turn)
        force = np.stack([push.real, push.imag, -swing.imag], axis=-1)
        by_dimension = np.zeros((*miss.shape, DIMENSIONS))
        on_body = push * turn.conj()
        for kind in range(len(DYAD_KINDS)):
            row, side = np.nonzero(self.kinds == kind)
            if not len(row):
                continue
            z = self.dimensions[row, side].T
            z = z.reshape(*z.shape, *[1] * (places.angle.ndim - 1))
            at, body, moved, spun = push[row, side], on_body[row, side], d[row, 0], turn[row, 0]
            if kind == 0:
                slope = [-at.real, -at.imag, body.real, body.imag]
                slope.append(-(at.real**2 + at.imag**2 + 1) / 2)
            elif kind == 1:
                point = moved + (z[2] + 1j * z[3]) * spun
                slope = [(at.conj() * point).imag, -1.0, body.real, body.imag]
            else:
                point = z[0] + 1j * z[1] - moved
                slope = [-at.real, -at.imag, -(at.conj() * point).imag, -1.0]
            for k, value in enumerate(slope):
                by_dimension[row, side, ..., k] = value
        return ConstraintJacobians(miss, force, by_dimension)


class ConstraintForms(NamedTuple):
    """Constraint manifolds in complex numbers, (*,) each: with d and turn = e^(i angle),

    f = round |d|² + Re(d* (still + turned turn)) + Re(both turn) + constant = 0.

    The eight coefficients of `constraint_manifold` in another order; RR is scaled by 1 / (2 r),
    lines by 1.
    """

    round: FloatArray
    still: ComplexArray
    turned: ComplexArray
    both: ComplexArray
    constant: FloatArray

    def at(
        self, d: ComplexArray, turn: ComplexArray
    ) -> tuple[FloatArray, ComplexArray, ComplexArray]:
        """f, the force and `swing` of forms (k, 2) at places (k, 1, *).

        All are (k, 2, *), the latter two complex.  The moment of the force about the origin of M
        is -swing.imag; f's second derivative by the angle is -swing.real.
        """
        spread = (..., *[None] * (d.ndim - 2))
        round, still = self.round[spread], self.still[spread]
        arm = self.turned[spread] * turn
        swing = d.conj() * arm + self.both[spread] * turn
        along = (d.conj() * still).real + swing.real + self.constant[spread]
        return round * (d.real**2 + d.imag**2) + along, 2 * round * d + still + arm, swing

    def bend(
        self, turn: ComplexArray, swing: ComplexArray, v: ComplexArray, omega: FloatArray
    ) -> FloatArray:
        """Second derivatives (k, 2, *) of f along velocities v, omega (k, 1, *)."""
        spread = (..., *[None] * (turn.ndim - 2))
        turning = 2 * omega * (v.conj() * (1j * turn * self.turned[spread])).real
        speed = v.real**2 + v.imag**2
        return np.asarray(2 * self.round[spread] * speed + turning - omega**2 * swing.real)
