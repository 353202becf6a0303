"""A linkage as its first dyad drives it: where the drive can be, and where the coupler is then.

The drive is the coordinate of the first dyad's joint with the ground: the angle of an RR's link
(from the fixed to the moving pivot), the place of a PR's pivot along its line (n · X = offset
plus drive times n turned by +90 degrees), the angle in F of the normal of an RP's line.  With
psi = drive - centre, for a centre that depends on the dimensions only, everything depends on

    f = cos psi (drives that turn)   or   f = psi² (drives that slide).

The coupler closes in two ways, told apart by the sign of a root q with

    q² = const (high - f) (f - low),

so f = low and f = high are the dead points (see `dead_points`).  A pair may lack either bound, or
close in one way only.
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

__all__ = ["NOWHERE", "DrivenLoop", "displacement_of", "facing"]

Drives = TypeVar("Drives", bound="Dyad | DrivenLoop")

NOWHERE = complex(np.nan, np.nan)
AT_LIMIT = 1e-14  # relative; a drive beyond its limit by less stands on it


@final
@dataclass(frozen=True, slots=True, eq=False)
class DrivenLoop:
    """Linkages (*,), each driven by its first dyad; see the top of the file.

    turns: whether the drive is an angle.  ways: 2, or 1 where the other dyad closes in one way.
    centre: (*,), the drive where psi = 0.  high, low: the dead points.
    margin: (*,), the least length by which the linkage misses a change point (or a link misses
    being a point), in shares of the sum of its lengths; of two rails or two slots, the sine
    between them.
    """

    first: RR | PR | RP
    second: Dyad
    turns: bool
    ways: int
    centre: FloatArray
    high: Bound
    low: Bound
    margin: FloatArray

    @classmethod
    def of(cls, linkage: Linkage) -> Self:
        """The drive of linkages whose dyads broadcast against each other.

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
            self.ways,
            self.centre[index],
            Bound(*(room[index] for room in self.high)),
            Bound(*(room[index] for room in self.low)),
            self.margin[index],
        )

    def assembled(self, drive: FloatArray) -> Displacement:
        """Coupler places (*, 2) at drives (*,): the two ways to close, q > 0 first.

        The drives' leading axes are those of the linkages.  nan where the linkage does not
        close, and in the second place where there is one way only.
        """
        drive = np.asarray(drive, dtype=np.float64)
        at = facing(self, drive.ndim)
        psi = drive - at.centre
        if self.turns:
            down, up, slope = 2 * np.cos(psi / 2) ** 2, 2 * np.sin(psi / 2) ** 2, np.sin(psi)
            w: FloatArray | ComplexArray = np.exp(1j * psi)
        else:
            down, up, slope, w = psi * psi, np.zeros_like(psi), 2 * psi, psi
        # What the rounding of the drive itself changes f by.
        slack = np.abs(slope) * (np.abs(drive) + np.abs(at.centre))
        q = np.sqrt(np.prod([_settled(*parts, slack) for parts in at.factors(down, up)], axis=0))
        if self.ways == 1:
            ways = np.stack([q, np.full_like(q, np.nan)], axis=-1)
        else:
            ways = np.stack([q, -q], axis=-1)
        with np.errstate(invalid="ignore", divide="ignore"):
            d, turn = at[..., None].place(w[..., None], ways)
        open_ = np.isnan(ways)
        return displacement_of(np.where(open_, NOWHERE, d), np.where(open_, NOWHERE, turn))

    def factors(self, down: FloatArray, up: FloatArray) -> _Factors:
        """The two factors of q², each as (scale, a, b) for a - b.

        down, up: f - least f, greatest f - f.
        """
        high, low = self.high, self.low
        above = (high.scale * up, high.up) if self.turns else (high.down, high.scale * down)
        return (high.scale, *above), (low.scale, low.scale * down, low.down)

    def place(self, w: FloatArray | ComplexArray, q: FloatArray) -> tuple[ComplexArray, ...]:
        """Coupler places from e^(i psi), or psi of slides, and q: d and e^(i angle), complex."""
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
            turn = (e + 1j * q) * to / (to.real * to.real + to.imag * to.imag) * n.conj()
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
            miss = (n.conj() * (c + j * (hand - first.offset))).real - second.offset
            along = -miss / (n.conj() * j).imag
        else:
            between = np.exp(1j * second.normal_angle) * back
            to = (complex_of(second.fixed_pivot) - c) * j.conj() + first.offset
            along = (second.offset - (between.conj() * to).real) / between.imag
        return c - j * (first.offset + 1j * along), j * back

    def reading(self, pose: Displacement) -> tuple[FloatArray | ComplexArray, ComplexArray]:
        """What `place` undoes, for coupler places (*,): e^(i psi) or psi, and e + iq.

        e + iq is z e^(i angle) of the closing equation or, after an RP, the second link seen
        across and along the slot; the sine of its argument is what decides between the two
        ways.  i for pairs that close in one way.
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


def _settled(
    scale: FloatArray, more: FloatArray, less: FloatArray, slack: FloatArray
) -> FloatArray:
    """A factor of q²: 0 where it is rounding, nan where it is negative."""
    room = more - less
    rounding = AT_LIMIT * (np.abs(more) + scale * slack)
    return np.where(np.abs(room) <= rounding, 0.0, np.where(room < 0, np.nan, room))


def displacement_of(d: ComplexArray, turn: ComplexArray) -> Displacement:
    """Displacements of d and e^(i angle), both complex."""
    return Displacement(np.stack([d.real, d.imag], axis=-1), np.angle(turn))


def facing(value: Drives, ndim: int) -> Drives:
    """A dyad or drive (*,) with axes added behind, to meet arrays of so many axes."""
    own = value.shape if isinstance(value, DrivenLoop) else shape_of(value)
    return cast(Drives, value[(..., *[None] * (ndim - len(own)))])
