"""Loop closure: the coupler's places as functions of the input, where the first dyad drives.

The input is the coordinate of the first dyad's joint with the ground: the angle of an RR's link
(from the fixed to the moving pivot), the position of a PR's pivot along its line (n · X = offset
plus input times n turned by +90 degrees), the angle in F of the normal of an RP's line.  With
psi = input - centre, where the centre depends on the dimensions only, everything depends on

    f = cos psi (turning inputs)   or   f = psi² (sliding inputs).

The loop has two closures, which differ by the sign of a root q with

    q² = const (high - f) (f - low),

so f = low and f = high are the dead points (see `dead_points`).  A pair of dyads may lack either
bound, or have one closure only.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self, TypeAlias, TypeVar, cast, final

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dead_points import Bound, of_crank, of_rail, of_slot
from burmester.fourbar.dyad import (
    PP,
    PR,
    RP,
    RR,
    Dyad,
    broadcast_to,
    shape_of,
)
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of

__all__ = ["NO_PLACE", "DrivenLoop", "displacement_of", "with_trailing_axes"]

DyadOrLoop = TypeVar("DyadOrLoop", bound="Dyad | DrivenLoop")

NO_PLACE = complex(np.nan, np.nan)
# Relative.  An input that passes a dead point by less than this counts as the dead point.
DEAD_POINT_ROUNDING = 1e-14


@final
@dataclass(frozen=True, slots=True, eq=False)
class DrivenLoop:
    """Linkages (*,), each driven by its first dyad; see the top of the file.

    turns: whether the input is an angle.
    closures: 2, or 1 for pairs of dyads that close in one way only.
    centre: (*,), the input where psi = 0.
    high, low: the dead points.
    margin: (*,), the smallest length by which the linkage is off a change point or a link is
        longer than a point, as a fraction of the sum of the lengths; of two rails or two slots,
        the sine of the angle between them.
    """

    first: RR | PR | RP
    second: Dyad
    turns: bool
    closures: int
    centre: FloatArray
    high: Bound
    low: Bound
    margin: FloatArray

    @classmethod
    def of(cls, linkage: Linkage) -> Self:
        """The driven loops of linkages whose dyads broadcast against each other.

        Raises InputError E401 where the first dyad cannot drive: PP, or RP with PP.
        """
        first, second = linkage.first, linkage.second
        shape = np.broadcast_shapes(shape_of(first), shape_of(second))
        first, second = broadcast_to(first, shape), broadcast_to(second, shape)
        if isinstance(first, PP) or (isinstance(first, RP) and isinstance(second, PP)):
            raise InputError(
                "E401",
                "this linkage cannot be driven by its first dyad",
                why="a PP dyad keeps the coupler from turning, and has no one joint to drive",
                help="drive it by the other dyad, if that is RR or PR: exchange the two",
            )
        with np.errstate(invalid="ignore", divide="ignore"):
            if isinstance(first, RR):
                return cls(first, second, True, *of_crank(first, second))
            if isinstance(first, PR):
                return cls(first, second, False, *of_rail(first, second))
            return cls(first, second, True, *of_slot(first, cast(RR | PR | RP, second)))

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes: () for one linkage."""
        return self.margin.shape

    def __getitem__(self, index: Any) -> DrivenLoop:
        """Pick along the leading axes (indices, slices, masks, new axes)."""
        return DrivenLoop(
            self.first[index],
            self.second[index],
            self.turns,
            self.closures,
            self.centre[index],
            Bound(*(room[index] for room in self.high)),
            Bound(*(room[index] for room in self.low)),
            self.margin[index],
        )

    def closed_at(self, inputs: FloatArray) -> Displacement:
        """Coupler places (*, 2) at inputs (*,): the two closures, q > 0 first.

        The inputs' leading axes are those of the linkages.  nan where the loop does not close,
        and for the second closure where there is one only.
        """
        inputs = np.asarray(inputs, dtype=np.float64)
        at = with_trailing_axes(self, inputs.ndim)
        psi = inputs - at.centre
        if self.turns:
            down, up, slope = 2 * np.cos(psi / 2) ** 2, 2 * np.sin(psi / 2) ** 2, np.sin(psi)
            w: FloatArray | ComplexArray = np.exp(1j * psi)
        else:
            down, up, slope, w = psi * psi, np.zeros_like(psi), 2 * psi, psi
        # The change of f by the rounding of the input itself.
        slack = np.abs(slope) * (np.abs(inputs) + np.abs(at.centre))
        q = np.sqrt(
            np.prod([_without_rounding(*parts, slack) for parts in at.factors(down, up)], axis=0)
        )
        other = np.full_like(q, np.nan) if self.closures == 1 else -q
        roots = np.stack([q, other], axis=-1)
        with np.errstate(invalid="ignore", divide="ignore"):
            d, turn = at[..., None].place(w[..., None], roots)
        open_ = np.isnan(roots)
        return displacement_of(np.where(open_, NO_PLACE, d), np.where(open_, NO_PLACE, turn))

    def factors(self, down: FloatArray, up: FloatArray) -> _Factors:
        """The two factors of q², each as (scale, a, b) for a - b.

        down, up: f - least f, greatest f - f.
        """
        high, low = self.high, self.low
        above = (high.scale * up, high.up) if self.turns else (high.down, high.scale * down)
        return (high.scale, *above), (low.scale, low.scale * down, low.down)

    def place(self, w: FloatArray | ComplexArray, q: FloatArray) -> tuple[ComplexArray, ...]:
        """Coupler places (d, e^(i angle)), complex, from e^(i psi) (or psi of slides) and q."""
        first, second = self.first, self.second
        if isinstance(first, RP):
            return self._place_of_slot(first, cast(RR | PR | RP, second), w, q)
        if isinstance(first, RR):
            lever = first.radius * np.exp(1j * self.centre)
            pin = complex_of(first.fixed_pivot) + lever * w
        else:
            along = np.exp(1j * first.normal_angle)
            pin = (first.offset + 1j * self.centre) * along + (1j * along) * w
        hand = complex_of(first.moving_pivot)
        # Re(z turn) = e, and q = Im(z turn).
        if isinstance(second, RR):
            arm = complex_of(second.moving_pivot) - hand
            to = pin - complex_of(second.fixed_pivot)
            size = to.real * to.real + to.imag * to.imag
            e = (second.radius**2 - abs(arm) ** 2) / 2 - size / 2
            turn = (e + 1j * q) * to / size * (1 / arm)
        elif isinstance(second, PR):
            n = np.exp(1j * second.normal_angle)
            z = n.conj() * (complex_of(second.moving_pivot) - hand)
            turn = (second.offset - (n.conj() * pin).real + 1j * q) * (1 / z)
        elif isinstance(second, RP):
            n = np.exp(1j * second.normal_angle)
            to = complex_of(second.fixed_pivot) - pin
            e = second.offset - (n.conj() * hand).real
            size = to.real * to.real + to.imag * to.imag
            with np.errstate(invalid="ignore", divide="ignore"):  # where the pins coincide
                turn = (e + 1j * q) * to / size * n.conj()
        else:
            turn = np.exp(1j * second.angle)
        return pin - hand * turn, turn

    def _place_of_slot(
        self, first: RP, second: RR | PR | RP, w: FloatArray | ComplexArray, q: FloatArray
    ) -> tuple[ComplexArray, ...]:
        j = np.exp(1j * self.centre) * w  # the normal of the slot
        back = np.exp(-1j * first.normal_angle)
        c = complex_of(first.fixed_pivot)
        if isinstance(second, RR):
            c2, hand = complex_of(second.fixed_pivot), complex_of(second.moving_pivot) * back
            across = (j.conj() * (c - c2)).real + (hand.real - first.offset)
            return c2 + j * (across - hand + 1j * q), j * back
        if isinstance(second, PR):
            n, hand = np.exp(1j * second.normal_angle), complex_of(second.moving_pivot) * back
            off = (n.conj() * (c + j * (hand - first.offset))).real - second.offset
            along, slope = -off, (n.conj() * j).imag
        else:
            between = np.exp(1j * second.normal_angle) * back
            to = (complex_of(second.fixed_pivot) - c) * j.conj() + first.offset
            along, slope = second.offset - (between.conj() * to).real, between.imag
        with np.errstate(invalid="ignore", divide="ignore"):  # where both lines are parallel
            return c - j * (first.offset + 1j * (along / slope)), j * back

    def closure_at(self, pose: Displacement) -> tuple[FloatArray | ComplexArray, ComplexArray]:
        """e^(i psi) (or psi) and e + iq at coupler places (*,): the inverse of `place`.

        e + iq is z e^(i angle) of the closing equation or, after an RP, the second link's
        components across and along the slot; the sign of the sine of its argument tells the
        closure.  i for pairs with one closure.
        """
        first, second = self.first, self.second
        d, turn = complex_of(pose.translation), np.exp(1j * pose.angle)
        if isinstance(first, RP):
            j = turn * np.exp(1j * first.normal_angle)
            w = j * np.exp(-1j * self.centre)
            if isinstance(second, RR):
                arm = d + complex_of(second.moving_pivot) * turn - complex_of(second.fixed_pivot)
                return w, arm * j.conj()
            return w, np.full_like(w, 1j)
        hand = complex_of(first.moving_pivot)
        pin = d + hand * turn
        if isinstance(first, RR):
            w = (pin - complex_of(first.fixed_pivot)) * np.exp(-1j * self.centre)
            w = w / np.abs(w)
        else:
            w = (pin * np.exp(-1j * first.normal_angle)).imag - self.centre
        if isinstance(second, RR):
            arm = complex_of(second.moving_pivot) - hand
            return w, (pin - complex_of(second.fixed_pivot)).conj() * arm * turn
        if isinstance(second, PR):
            n = np.exp(1j * second.normal_angle)
            return w, n.conj() * (complex_of(second.moving_pivot) - hand) * turn
        if isinstance(second, RP):
            n = np.exp(1j * second.normal_angle)
            return w, (complex_of(second.fixed_pivot) - pin).conj() * n * turn
        return w, np.full(pin.shape, 1j)


_Factors: TypeAlias = tuple[tuple[FloatArray, FloatArray, FloatArray], ...]


def _without_rounding(
    scale: FloatArray, more: FloatArray, less: FloatArray, slack: FloatArray
) -> FloatArray:
    """A factor `more - less` of q²: 0 where it is rounding, nan where it is negative."""
    room = more - less
    rounding = DEAD_POINT_ROUNDING * (np.abs(more) + scale * slack)
    return np.where(np.abs(room) <= rounding, 0.0, np.where(room < 0, np.nan, room))


def displacement_of(d: ComplexArray, turn: ComplexArray) -> Displacement:
    """Displacements of d and e^(i angle), both complex."""
    return Displacement(np.stack([d.real, d.imag], axis=-1), np.angle(turn))


def with_trailing_axes(value: DyadOrLoop, ndim: int) -> DyadOrLoop:
    """A dyad or loop (*,) with axes of size 1 added behind, `ndim` axes in all."""
    own = value.shape if isinstance(value, DrivenLoop) else shape_of(value)
    return cast(DyadOrLoop, value[(..., *[None] * (ndim - len(own)))])
