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

The kinds of the dyads differ only in the terms of a few linear forms.  So linkages of any kinds are
rows of the same arrays, and are driven together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple, Self, TypeAlias, TypeVar, cast, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.fourbar.dead_points import Bound, Closing, of_crank, of_rail, of_slot
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad, broadcast_to, shape_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch, row_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of

DyadOrLoop = TypeVar("DyadOrLoop", bound="Dyad | DrivenLoop")

NO_PLACE: Final = complex(np.nan, np.nan)
KINDS: Final = (RR, PR, RP, PP)  # the kinds of dyads, by their number in `DrivenLoop.kinds`
# Relative.  An input that passes a dead point by less than this counts as the dead point.
DEAD_POINT_ROUNDING: Final = 1e-14
FLAGS, NUMBERS = 6, 8 + 2 * DIMENSIONS  # numbers of rows in the arrays of a loop


class Terms(NamedTuple):
    """The terms (*,), complex, by which the kinds of a linkage's dyads differ.

    With w = e^(i psi) (or psi of slides), the coupler's place d and turn = e^(i angle):

    still, swung: the driving pin, still + swung w, where an RR or a PR drives; the slot's pivot and
        its normal swung w, where an RP does.
    hand: the driving pin in M; of an RP the offset of the slot.
    normal: of the slot in M, or of the rail in F.
    The second link of a pin is to = base + reach pin, and Re(z turn) = e with
        e = rest + bend |to|² + Re(tilt* pin), turn = (e + iq) to / |to|² lay.
    The coupler of a slot slides along it by (rest + Re(base n*) + bend q) / (tilt + Im(reach* n)).
    input_rest, input_d, input_turn: their sum times 1, d and turn is e^(i psi), of any size; of a
        rail its imaginary part is psi + centre.
    link_rest, link_d, link_turn, link_lay: with these the second link is closing* = link_lay*
        turn* (link_rest + link_d d + link_turn turn); see `DrivenLoop.closure_at`.
    force, lever_rest, lever_d, lever_turn: the force on the second dyad is force turn, and its
        lever the sum of the others times 1, d and turn.
    """

    still: ComplexArray
    swung: ComplexArray
    hand: ComplexArray
    normal: ComplexArray
    base: ComplexArray
    reach: ComplexArray
    rest: ComplexArray
    bend: ComplexArray
    tilt: ComplexArray
    lay: ComplexArray
    input_rest: ComplexArray
    input_d: ComplexArray
    input_turn: ComplexArray
    link_rest: ComplexArray
    link_d: ComplexArray
    link_turn: ComplexArray
    link_lay: ComplexArray
    force: ComplexArray
    lever_rest: ComplexArray
    lever_d: ComplexArray
    lever_turn: ComplexArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class DrivenLoop:
    """Linkages (*,), each driven by its first dyad; see the top of the file.

    flags: (6, *), numbers: (18, *), rows: (21, *), the properties below in one array of a type
        each, so that picking linkages takes three steps.
    """

    flags: NDArray[np.int8]
    numbers: FloatArray
    rows: ComplexArray

    @classmethod
    def of(cls, linkage: Linkage | LinkageBatch) -> DrivenLoop:
        """The driven loops of a batch, or of linkages whose dyads broadcast against each other.

        Raises InputError E401 where the first dyad cannot drive: PP, or RP with PP.
        """
        with np.errstate(invalid="ignore", divide="ignore"):
            if isinstance(linkage, Linkage):
                first, second = linkage.first, linkage.second
                shape = np.broadcast_shapes(shape_of(first), shape_of(second))
                # Rows of one linkage, too: NumPy rounds arrays and single numbers differently.
                some = shape or (1,)
                first, second = broadcast_to(first, some), broadcast_to(second, some)
                loop = cls._of_pair(first, second)
                for dimensions, dyad in zip(loop.dimensions, (first, second), strict=True):
                    dimensions[:] = np.moveaxis(row_of(dyad), -1, 0)
                return loop if shape else loop[0]
            count = len(linkage)
            flags = np.empty((FLAGS, count), dtype=np.int8)
            numbers = np.empty((NUMBERS, count))
            rows = np.empty((len(Terms._fields), count), dtype=complex)
            for index, each in linkage.alike():
                own = cls._of_pair(each.first, each.second)
                flags[:, index], numbers[:, index] = own.flags, own.numbers
                rows[:, index] = own.rows
            numbers[8:] = linkage.dimensions.reshape(count, 2 * DIMENSIONS).T
            return cls(flags, numbers, rows)

    @classmethod
    def _of_pair(cls, first: Dyad, second: Dyad) -> Self:
        """The loops of dyads (*,) of one pair of kinds, without their dimensions."""
        if isinstance(first, PP) or (isinstance(first, RP) and isinstance(second, PP)):
            raise InputError(
                "E401",
                "this linkage cannot be driven by its first dyad",
                why="a PP dyad keeps the coupler from turning, and has no one joint to drive",
                help="drive it by the other dyad, if that is RR or PR: exchange the two",
            )
        closing, terms = _slot(first, second) if isinstance(first, RP) else _pin(first, second)
        margin = closing.margin
        flags = np.empty((FLAGS, *margin.shape), dtype=np.int8)
        flags[0], flags[1] = not isinstance(first, PR), closing.closures
        flags[2] = isinstance(first, RP) and isinstance(second, PR)
        flags[3] = _is_point(first, second, closing)
        flags[4], flags[5] = KINDS.index(type(first)), KINDS.index(type(second))
        numbers = np.zeros((NUMBERS, *margin.shape))
        numbers[0], numbers[7] = closing.centre, margin
        numbers[1], numbers[2], numbers[3] = closing.high
        numbers[4], numbers[5], numbers[6] = closing.low
        rows = np.empty((len(terms), *margin.shape), dtype=complex)
        for row, term in enumerate(terms):
            rows[row] = term
        return cls(flags, numbers, rows)

    @classmethod
    def joined(cls, several: Sequence[DrivenLoop]) -> Self:
        """Loops (k, *) of several linkages in one row."""
        return cls(
            np.concatenate([each.flags for each in several], axis=1),
            np.concatenate([each.numbers for each in several], axis=1),
            np.concatenate([each.rows for each in several], axis=1),
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes: () for one linkage."""
        return self.flags.shape[1:]

    @property
    def turns(self) -> NDArray[np.bool_]:
        """Whether the input is an angle, (*,)."""
        return np.asarray(self.flags[0] != 0)

    @property
    def closures(self) -> NDArray[np.int8]:
        """2, or 1 for pairs of dyads that close in one way only, (*,)."""
        return np.asarray(self.flags[1])

    @property
    def on_slot_and_rail(self) -> NDArray[np.bool_]:
        """Whether a slot drives a coupler on a rail, (*,): it goes to infinity twice a turn."""
        return np.asarray(self.flags[2] != 0)

    @property
    def is_point(self) -> NDArray[np.bool_]:
        """Whether a link has no length, or both rails or slots are parallel, (*,).

        Such a linkage has no determined circuits where it is at a change point.
        """
        return np.asarray(self.flags[3] != 0)

    @property
    def kinds(self) -> tuple[NDArray[np.int8], NDArray[np.int8]]:
        """The kinds of the first and of the second dyads, (*,) each, by their number in KINDS."""
        return self.flags[4], self.flags[5]

    @property
    def centre(self) -> FloatArray:
        """The input where psi = 0, (*,)."""
        return np.asarray(self.numbers[0])

    @property
    def high(self) -> Bound:
        """The dead points where f is greatest."""
        return Bound(self.numbers[1], self.numbers[2], self.numbers[3])

    @property
    def low(self) -> Bound:
        """The dead points where f is least."""
        return Bound(self.numbers[4], self.numbers[5], self.numbers[6])

    @property
    def margin(self) -> FloatArray:
        """How far linkages are off a change point, (*,).

        The smallest length by which the linkage is off it or a link is longer than a point, as a
        fraction of the sum of the lengths; of two rails or two slots, the sine of the angle between
        them.
        """
        return np.asarray(self.numbers[7])

    @property
    def dimensions(self) -> tuple[FloatArray, FloatArray]:
        """The dimensions (5, *) of the first and of the second dyads, as in `LinkageBatch`."""
        return self.numbers[8 : 8 + DIMENSIONS], self.numbers[8 + DIMENSIONS :]

    @property
    def terms(self) -> Terms:
        """The terms of the linear forms."""
        return Terms(*self.rows)

    def __getitem__(self, index: Any) -> DrivenLoop:
        """Pick along the leading axes (indices, slices, masks, new axes)."""
        at = (slice(None), *(index if isinstance(index, tuple) else (index,)))
        return DrivenLoop(self.flags[at], self.numbers[at], self.rows[at])

    def clamped(self, high: FloatArray, low: FloatArray) -> DrivenLoop:
        """The same with other distances (*,) of `high` from the least f, of `low` from the most."""
        numbers = self.numbers.copy()
        numbers[2], numbers[6] = high, low
        return DrivenLoop(self.flags, numbers, self.rows)

    def exchanged(self) -> DrivenLoop:
        """The loops of the same linkages (*,), driven by their second dyads."""
        kinds = np.stack(self.kinds[::-1], axis=-1)
        dimensions = np.stack([np.moveaxis(each, 0, -1) for each in self.dimensions[::-1]], axis=-2)
        batch = LinkageBatch(kinds.reshape(-1, 2), dimensions.reshape(-1, 2, DIMENSIONS))
        loop = DrivenLoop.of(batch)
        return DrivenLoop(
            loop.flags.reshape(FLAGS, *self.shape),
            loop.numbers.reshape(NUMBERS, *self.shape),
            loop.rows.reshape(len(Terms._fields), *self.shape),
        )

    def closed_at(self, inputs: FloatArray) -> Displacement:
        """Coupler places (*, 2) at inputs (*,): the two closures, q > 0 first.

        The inputs' leading axes are those of the linkages.  nan where the loop does not close,
        and for the second closure where there is one only.
        """
        inputs = np.asarray(inputs, dtype=np.float64)
        at = with_trailing_axes(self, inputs.ndim)
        turns, psi = at.turns, inputs - at.centre
        down = np.where(turns, 2 * np.cos(psi / 2) ** 2, psi * psi)
        up = np.where(turns, 2 * np.sin(psi / 2) ** 2, 0.0)
        slope = np.where(turns, np.sin(psi), 2 * psi)
        w = np.where(turns, np.exp(1j * np.where(turns, psi, 0.0)), psi)
        # The change of f by the rounding of the input itself.
        slack = np.abs(slope) * (np.abs(inputs) + np.abs(at.centre))
        q = np.sqrt(
            np.prod([_without_rounding(*parts, slack) for parts in at.factors(down, up)], axis=0)
        )
        other = np.where(at.closures == 1, np.nan, -q)
        roots = np.stack([q, other], axis=-1)
        with np.errstate(invalid="ignore", divide="ignore"):
            d, turn = at[..., None].place(w[..., None], roots)
        open_ = np.isnan(roots)
        return displacement_of(np.where(open_, NO_PLACE, d), np.where(open_, NO_PLACE, turn))

    def factors(self, down: FloatArray, up: FloatArray) -> _Factors:
        """The two factors of q², each as (scale, a, b) for a - b.

        down, up: f - least f, greatest f - f.
        """
        high, low, turns = self.high, self.low, self.turns
        more = np.where(turns, high.scale * up, high.down)
        less = np.where(turns, high.up, high.scale * down)
        return (high.scale, more, less), (low.scale, low.scale * down, low.down)

    def place(self, w: FloatArray | ComplexArray, q: FloatArray) -> tuple[ComplexArray, ...]:
        """Coupler places (d, e^(i angle)), complex, from e^(i psi) (or psi of slides) and q."""
        t, slot = self.terms, self.kinds[0] == SLOT
        with np.errstate(invalid="ignore", divide="ignore"):  # pins that coincide, parallel lines
            swung = t.swung * w
            pin = t.still + swung
            to = t.base + t.reach * pin
            size = to.real * to.real + to.imag * to.imag
            e = t.rest.real + t.bend.real * size + (t.tilt.conj() * pin).real
            turn = (e + 1j * q) * to / size * t.lay
            d = pin - t.hand * turn
            if not slot.any():
                return d, turn
            along = t.rest.real + (t.base * swung.conj()).real + t.bend.real * q
            along = along / (t.tilt.real + (t.reach.conj() * swung).imag)
            slid = t.still - swung * (t.hand + 1j * along)
        return np.where(slot, slid, d), np.where(slot, swung * t.normal.conj(), turn)

    def closure_at(self, pose: Displacement) -> tuple[ComplexArray, ComplexArray]:
        """e^(i psi) (or psi) and e + iq at coupler places (*,): the inverse of `place`.

        e + iq is z e^(i angle) of the closing equation or, after an RP, the second link's
        components across and along the slot; the sign of the sine of its argument tells the
        closure.  i for pairs with one closure.
        """
        t, (first, _) = self.terms, self.kinds
        d, turn = complex_of(pose.translation), np.exp(1j * pose.angle)
        w = t.input_rest + t.input_d * d + t.input_turn * turn
        w = np.where(self.turns, w / np.abs(w), w.imag - self.centre)
        closing = (t.link_rest + t.link_d * d + t.link_turn * turn).conj() * turn * t.link_lay
        closing = np.where(first == SLOT, closing.conj(), closing)
        return w, np.where(self.closures == 1, 1j, closing)

    def transmission(self, pose: Displacement) -> FloatArray:
        """The transmission angles (*,) at coupler places (*,); see `transmission_angle`."""
        t, turn = self.terms, np.exp(1j * pose.angle)
        lever = t.lever_rest + t.lever_d * complex_of(pose.translation) + t.lever_turn * turn
        product = (t.force * turn).conj() * lever
        return np.asarray(np.arctan2(np.abs(product.imag), np.abs(product.real)))

    def arm(self, pose: Displacement) -> FloatArray:
        """The length (*,) from a driving pin to the second dyad's pin, at coupler places (*,)."""
        t, (_, second) = self.terms, self.kinds
        turn = np.exp(1j * pose.angle)
        lever = t.lever_rest + t.lever_d * complex_of(pose.translation) + t.lever_turn * turn
        return np.asarray(np.abs(np.where(second == SLOT, lever, t.force * turn)))


SLOT: Final = KINDS.index(RP)
Row: TypeAlias = tuple[Any, ...]  # terms of a part, each (*,) or one number
_Factors: TypeAlias = tuple[tuple[FloatArray, FloatArray, FloatArray], ...]


def _pin(first: Dyad, second: Dyad) -> tuple[Closing, list[Any]]:
    """The closing and the terms of a driving pin, on a crank or on a rail."""
    if isinstance(first, RR):
        closing, fixed = of_crank(first, second), complex_of(first.fixed_pivot)
        direction, normal = np.exp(1j * closing.centre), 1.0
        still, swung = fixed, first.radius * direction
        rest, way = -fixed * direction.conj(), direction.conj()
    else:
        assert isinstance(first, PR)
        closing, normal = of_rail(first, second), np.exp(1j * first.normal_angle)
        still, swung = (first.offset + 1j * closing.centre) * normal, 1j * normal
        rest, way = 0.0, normal.conj()
    hand = complex_of(first.moving_pivot)
    driver: Row = (still, swung, hand, normal)
    inputs: Row = (rest, way, hand * way)
    link: Row
    close: Row
    bear: Row
    if isinstance(second, RR):
        fixed, other = complex_of(second.fixed_pivot), complex_of(second.moving_pivot)
        arm = other - hand
        e = (second.radius**2 - abs(arm) ** 2) / 2
        link = (-fixed, 1.0, e, -0.5, 0.0, 1 / arm)
        close, bear = (-fixed, 1.0, hand, arm), (arm, -fixed, 1.0, other)
    elif isinstance(second, PR):
        n, other = np.exp(1j * second.normal_angle), complex_of(second.moving_pivot)
        z = n.conj() * (other - hand)
        link = (1.0, 0.0, second.offset, 0.0, -n, 1 / z)
        close, bear = (1.0, 0.0, 0.0, z), (other - hand, n, 0.0, 0.0)
    elif isinstance(second, RP):
        n, fixed = np.exp(1j * second.normal_angle), complex_of(second.fixed_pivot)
        e = second.offset - (n.conj() * hand).real
        link = (fixed, -1.0, e, 0.0, 0.0, n.conj())
        close, bear = (fixed, -1.0, -hand, n), (n, -fixed, 1.0, hand)
    else:
        link = (1.0, 0.0, 0.0, 0.0, 0.0, -1j * np.exp(1j * second.angle))  # q is 1
        close, bear = (1.0, 0.0, 0.0, 1.0), (1.0, np.nan, 0.0, 0.0)
    return closing, [*driver, *link, *inputs, *close, *bear]


def _slot(first: RP, second: Dyad) -> tuple[Closing, list[Any]]:
    """The closing and the terms of a driving slot."""
    assert isinstance(second, RR | PR | RP)
    closing, fixed = of_slot(first, second), complex_of(first.fixed_pivot)
    direction, n = np.exp(1j * closing.centre), np.exp(1j * first.normal_angle)
    driver: Row = (fixed, direction, first.offset, n)
    inputs: Row = (0.0, 0.0, n * direction.conj())
    link: Row
    close: Row
    bear: Row
    if isinstance(second, RR):
        pivot, other = complex_of(second.fixed_pivot), complex_of(second.moving_pivot)
        hand = other * n.conj()
        link = (-1j * (fixed - pivot), 0.0, hand.imag, -1.0, 1.0, 1.0)
        close, bear = (-pivot, 1.0, other, n), (n, -pivot, 1.0, other)
    elif isinstance(second, PR):
        normal = np.exp(1j * second.normal_angle)
        hand = complex_of(second.moving_pivot) * n.conj()
        rest = second.offset - (normal.conj() * fixed).real
        link = (-normal * (hand - first.offset).conj(), normal, rest, 0.0, 0.0, 1.0)
        close, bear = (1.0, 0.0, 0.0, 1.0), (n, normal, 0.0, 0.0)
    else:
        between = np.exp(1j * second.normal_angle) * n.conj()
        to = complex_of(second.fixed_pivot) - fixed
        rest = second.offset - first.offset * between.real
        link = (-between.conj() * to, 0.0, rest, 0.0, between.imag, 1.0)
        close, bear = (1.0, 0.0, 0.0, 1.0), (n, 0.0, 0.0, np.exp(1j * second.normal_angle))
    return closing, [*driver, *link, *inputs, *close, *bear]


def _is_point(first: Dyad, second: Dyad, closing: Closing) -> NDArray[np.bool_]:
    """See `DrivenLoop.is_point`."""
    out = np.zeros(closing.margin.shape, dtype=bool)
    if isinstance(first, RP):
        return out | isinstance(second, RP)
    assert not isinstance(first, PP)
    if isinstance(first, RR):
        out = out | (first.radius == 0)
    if not isinstance(second, RP | PP):
        out = out | (second.moving_pivot == first.moving_pivot).all(axis=-1)
    if isinstance(first, PR) and isinstance(second, PR):
        out = out | (closing.high.scale > 0)
    return np.asarray(out)


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
    return cast("DyadOrLoop", value[(..., *[None] * (ndim - len(own)))])
