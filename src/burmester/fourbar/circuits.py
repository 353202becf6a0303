"""Circuits: what a linkage can reach without being taken apart, in closed form.

Chase and Mirth (Circuits and branches of single-degree-of-freedom planar linkages, Journal of
Mechanical Design 115, 1993): a circuit is the set of places that one assembly can reach, a branch
is a piece of it between dead points of the input.  A linkage of two dyads has two circuits at most.
Each covers one range of the input (see `circuit_parameter`).  That range, a parameter along the
circuit that passes dead points without a jump, and the circuit, branch and parameter of a place
are all exact; nothing is sampled.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, Self, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuit_parameter import (
    ONE_SIDED,
    Parameter,
    RangeType,
    clamped_at_change_points,
    input_and_root,
    near_change_point,
    parameter_of,
    range_types,
)
from burmester.fourbar.dyad import RP
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.loop_closure import NO_PLACE, DrivenLoop, displacement_of, with_trailing_axes
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.numerics.bundles import put

__all__ = ["Circuits", "Location", "circuit_of"]

PLACES_PER_BLOCK = 8192  # places computed at once; their arrays fit the processor's cache
# Step of the parameter (radians or a length) away from a change point, where a place is undefined.
CHANGE_POINT_NUDGE = 1e-8


@final
@dataclass(frozen=True, slots=True, eq=False)
class Circuits:
    """Circuits (*,) of linkages driven by their first dyads.

    loop: (*,), the linkage of each circuit, driven by its first dyad.
    range_type, sign: (*,), see `RangeType`.

    A parameter runs along a circuit: an angle in [0, 2 pi) on a closed one, with the branches
    (0, pi) and (pi, 2 pi) where it has two; on an open one an angle in (0, pi) if the input
    turns, else any length, with the branches below and above 0 where it has two.
    """

    loop: DrivenLoop
    range_type: NDArray[np.int8]
    sign: FloatArray

    @classmethod
    def of(cls, linkage: Linkage, as_given: bool = False) -> Self:
        """The circuits (*, 2) of linkages (*,), existing ones first.

        Within 1e-9 of a change point, and where a link is that short, both are NONE and
        `near_change_point` holds.  The numbering depends on which dyad is first.

        as_given: the numbers of such a linkage are taken as exact, with the signs that rounding
        left in them: the linkage passes the change point or turns back there.  Even so there is
        no circuit for two rails or two slots that are parallel within rounding (rails parallel to
        1e-14 are parallel), for a crank of length 0, and for a coupler whose moving pivots
        coincide.

        Raises InputError E401 where the first dyad cannot drive.
        """
        loop = DrivenLoop.of(linkage)
        if as_given:
            loop = clamped_at_change_points(loop)
        return cls(loop[..., None][..., [0, 0]], *range_types(loop, as_given))

    def __getitem__(self, index: Any) -> Circuits:
        """Pick along the leading axes (indices, slices, masks, new axes)."""
        return Circuits(self.loop[index], self.range_type[index], self.sign[index])

    def flattened(self) -> Circuits:
        """The same in one row, (n,)."""
        row = self if self.shape else self[None]
        return row[np.unravel_index(np.arange(row.range_type.size), row.shape)]

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes."""
        return self.range_type.shape

    @property
    def groups(self) -> tuple[tuple[slice, Circuits], ...]:
        """All of them, as the one group of `CircuitBatch.groups`."""
        return ((slice(None), self),)

    def exchanged(self) -> Circuits:
        """The circuits (*, 2) of the same linkages (*,) as given, driven by their second dyads."""
        loop = self.loop if len(self.shape) < 2 else self.loop[..., 0]
        return Circuits.of(Linkage(loop.second, loop.first), as_given=True)

    @property
    def turns(self) -> NDArray[np.bool_]:
        """Whether the input is an angle, (*,)."""
        return np.full(self.shape, self.loop.turns)

    @property
    def exists(self) -> NDArray[np.bool_]:
        """Whether the circuit exists, (*,)."""
        return np.asarray(self.range_type != RangeType.NONE)

    @property
    def near_change_point(self) -> NDArray[np.bool_]:
        """Whether the linkage is within 1e-9 of a change point, (*,)."""
        return near_change_point(self.loop)

    @property
    def branches(self) -> NDArray[np.int8]:
        """The number of branches of the circuit, (*,): 1 without dead points, else 2."""
        of_range_type = np.array([0, 1, 2, 2, 2, 2, 1], dtype=np.int8)
        return of_range_type[self.range_type]

    @property
    def closed(self) -> NDArray[np.bool_]:
        """Whether the circuit returns to its start, (*,)."""
        loop = (self.range_type >= RangeType.BELOW) & (self.range_type <= RangeType.BETWEEN)
        return np.asarray(loop | ((self.range_type == RangeType.WHOLE) & self.loop.turns))

    @property
    def input_range(self) -> FloatArray:
        """The least and the greatest input of each circuit, (*, 2); nan where there is none.

        Dead points where it has two branches; one whole turn, or infinite, otherwise.
        """
        psi = np.full((2, *self.shape), np.nan)
        ends = self._turning_ends() if self.loop.turns else self._sliding_ends()
        for range_type, (least, greatest) in ends.items():
            psi = np.where(self.range_type == range_type, np.stack([least, greatest]), psi)
        mirrored = np.isin(self.range_type, ONE_SIDED) & (self.sign < 0)
        psi = np.where(mirrored, -psi[::-1], psi)
        return np.moveaxis(self.loop.centre + psi, 0, -1)

    def _turning_ends(self) -> _Ends:
        """Psi (*,) at both ends of each type of range, psi > 0 on one side, of turning inputs."""
        with np.errstate(invalid="ignore"):
            at_high, at_low = (
                2 * np.arctan2(np.sqrt(bound.up), np.sqrt(bound.down))
                for bound in (self.loop.high, self.loop.low)
            )
        half_turn = np.full(self.shape, np.pi)
        return {
            RangeType.WHOLE: (-half_turn, half_turn),
            RangeType.BELOW: (at_high, 2 * np.pi - at_high),  # f is least at half a turn
            RangeType.ABOVE: (-at_low, at_low),
            RangeType.BETWEEN: (at_high, at_low),  # f = cos psi falls as psi rises
            RangeType.HALF: (np.zeros(self.shape), half_turn),
        }

    def _sliding_ends(self) -> _Ends:
        """The same of sliding inputs, with f = psi²."""
        with np.errstate(invalid="ignore", divide="ignore"):
            at_high, at_low = (
                np.sqrt(bound.down / bound.scale) for bound in (self.loop.high, self.loop.low)
            )
        infinite = np.full(self.shape, np.inf)
        return {
            RangeType.WHOLE: (-infinite, infinite),
            RangeType.BELOW: (-at_high, at_high),
            RangeType.BETWEEN: (at_low, at_high),
            RangeType.BEYOND: (at_low, infinite),
        }

    def couplers(self, parameter: FloatArray) -> Displacement:
        """Coupler places (*, n) at parameters (n,) or (*, n); nan where there is no circuit."""
        change = self.near_change_point & self.exists
        if change.any():
            with np.errstate(invalid="ignore", divide="ignore"):
                d, turn = self._places(parameter)
                self._restore(change, parameter, d, turn)
        else:
            d, turn = self._places(parameter)
        shape = (*self.shape, d.shape[-1])
        return displacement_of(d.reshape(shape), turn.reshape(shape))

    def _places(self, parameter: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Places d and e^(i angle), (m, n), of all circuits in one row; see `couplers`."""
        d = np.full((self.range_type.size, np.shape(parameter)[-1]), NO_PLACE)
        turn = d.copy()
        for loop, rows, span, (w, q) in self._blocks(parameter):
            d[rows, span], turn[rows, span] = loop.place(w, q)
        return d, turn

    def _restore(
        self, change: NDArray[np.bool_], parameter: FloatArray, d: ComplexArray, turn: ComplexArray
    ) -> None:
        """Repair d and e^(i angle) (m, n), in place, of circuits at change points, a mask (*,).

        Where the driving pin meets the other fixed pivot, the coupler takes the angle that it has
        just after.
        """
        some = self[change]
        rows = np.flatnonzero(change)
        parameter = np.asarray(parameter, dtype=np.float64)
        if parameter.ndim > 1:
            parameter = np.broadcast_to(parameter, (*self.shape, parameter.shape[-1]))[change]
        lost = np.isnan(turn[rows])
        if lost.any():
            beside = some._places(parameter + CHANGE_POINT_NUDGE)
            for whole, value in zip((d, turn), beside, strict=True):
                whole[rows] = np.where(lost, value, whole[rows])
        if not isinstance(some.loop.first, RP):
            hand = complex_of(some.loop.first.moving_pivot)[:, None]
            unit = turn[rows] / np.abs(turn[rows])
            d[rows] += hand * (turn[rows] - unit)
            turn[rows] = unit

    def at_inputs(self, inputs: FloatArray, branch: int = 0) -> Displacement:
        """Coupler places (*, n) at inputs (*, n) of the first dyad, on one branch.

        The linkage stays on its circuit: an input beyond a dead point counts as the dead point.
        nan where there is no circuit.
        """
        low, high = (self.input_range[..., None, end] for end in (0, 1))
        if self.loop.turns:
            with np.errstate(invalid="ignore"):
                middle = (low + high) / 2
                inputs = middle + (inputs - middle + np.pi) % (2 * np.pi) - np.pi
        both = self.loop.closed_at(np.clip(inputs, low, high))
        second = np.where(
            self.branches == 2, branch == 1, (self.sign < 0) & (self.loop.closures == 2)
        )
        return _chosen(both, second[..., None])

    def inputs(self, parameter: FloatArray, places: Displacement) -> FloatArray:
        """The inputs (*, n) at places (*, n) of these circuits, without jumps.

        parameter: (*, n), of the places; it counts the turns of an input that turns fully.
        """
        loop = with_trailing_axes(self.loop, np.ndim(parameter))
        with np.errstate(invalid="ignore", divide="ignore"):
            w = loop.closure_at(places)[0]
        if not loop.turns:
            return np.asarray(loop.centre + w.real)
        range_type = self.range_type[..., None]
        # Unless the range is whole, psi stays within half a turn of its middle.
        middle = np.where(range_type == RangeType.BELOW, np.pi, 0.0)
        swung = middle + np.angle(w * np.exp(-1j * middle))
        return np.asarray(loop.centre + np.where(range_type == RangeType.WHOLE, parameter, swung))

    def locate(self, places: Displacement) -> Location:
        """As `circuit_of`, for coupler places (*, ...) and the circuits (*, 2) of `of`."""
        first = self[..., 0]
        own = with_trailing_axes(first.loop, len(places.shape))
        number = np.broadcast_to(np.arange(first.range_type.size).reshape(own.shape), places.shape)
        circuits, found = first.flattened(), Location.none(places.shape)
        with np.errstate(invalid="ignore", divide="ignore"):
            w, closing = own.closure_at(places)
            for range_type in set(circuits.range_type.tolist()) - {RangeType.NONE}:
                here = circuits.range_type[number] == range_type
                values = _located(circuits[number[here]], w[here], closing[here])
                put(found, here, Location(*values))
        return found

    def curve(self, point: FloatArray, parameter: FloatArray) -> FloatArray:
        """Coupler curves (*, n, 2) of points (2,) or (*, 2) of M, at parameters (n,) or (*, n)."""
        if (self.near_change_point & self.exists).any():
            return self.couplers(parameter).act(np.asarray(point, dtype=np.float64)[..., None, :])
        x = np.full((self.range_type.size, np.shape(parameter)[-1]), NO_PLACE)
        point = np.asarray(point, dtype=np.float64)
        points = np.broadcast_to(complex_of(point), self.shape).reshape(-1, 1)
        for loop, rows, span, (w, q) in self._blocks(parameter):
            d, turn = loop.place(w, q)
            x[rows, span] = d + points[rows] * turn
        return x.view(np.float64).reshape(*self.shape, x.shape[-1], 2)

    def _blocks(self, parameter: FloatArray) -> Iterator[_Block]:
        """Loops (k, 1) of circuits of one range type, their rows and columns, w and q (k, n)."""
        parameter = np.asarray(parameter, dtype=np.float64)
        count, shared = parameter.shape[-1], parameter.ndim == 1
        flat = self.flattened()
        if not shared:
            parameter = np.broadcast_to(parameter, (*self.shape, count)).reshape(-1, count)
        width = max(1, min(count, PLACES_PER_BLOCK))
        rows_per_block = max(1, PLACES_PER_BLOCK // width)
        for start in range(0, count, width):
            span = slice(start, start + width)
            common = Parameter.of(parameter[None, span]) if shared else None
            for range_type in RangeType:
                all_rows = np.flatnonzero(flat.range_type == range_type)
                for begin in range(0, len(all_rows) if range_type else 0, rows_per_block):
                    rows = all_rows[begin : begin + rows_per_block]
                    at = common or Parameter.of(parameter[rows, span])
                    some = flat[rows][:, None]
                    yield (
                        some.loop,
                        rows,
                        span,
                        input_and_root(some.loop, range_type, some.sign, at),
                    )


def _chosen(both: Displacement, which: NDArray[np.bool_]) -> Displacement:
    """Of two places (*, n, 2) the second where `which` (*, n) holds, else the first: (*, n)."""
    angle = np.where(which, both.angle[..., 1], both.angle[..., 0])
    points = both.translation
    return Displacement(np.where(which[..., None], points[..., 1, :], points[..., 0, :]), angle)


_Ends: TypeAlias = dict[RangeType, tuple[FloatArray, FloatArray]]
_Block: TypeAlias = tuple[
    DrivenLoop, NDArray[np.intp], slice, tuple[FloatArray | ComplexArray, FloatArray]
]


class Location(NamedTuple):
    """The circuit, the branch and the parameter of coupler places (*,).

    circuit: its number in `Circuits.of`; -1 near a change point and where there is none.
    branch: 0, or 1 for the second branch of a circuit.
    parameter: along the circuit, see `Circuits`.
    circuit_margin: the smaller of two numbers: `DrivenLoop.margin` of the linkage, and the quantity
        that is 0 between two circuits.  That is the sine of an angle (the one between coupler and
        diagonal, or psi) or, for slides on one side of their centre, psi over the hypotenuse of
        psi and its value at the dead point.
    branch_margin: the sine of the angle that is 0 at a dead point; 1 where there is none.
    """

    circuit: NDArray[np.int8]
    branch: NDArray[np.int8]
    parameter: FloatArray
    circuit_margin: FloatArray
    branch_margin: FloatArray

    @classmethod
    def none(cls, shape: tuple[int, ...]) -> Self:
        """On no circuit."""
        margins = (np.full(shape, np.nan) for _ in range(3))
        return cls(np.full(shape, -1, np.int8), np.zeros(shape, np.int8), *margins)


def circuit_of(linkage: Linkage, places: Displacement, as_given: bool = False) -> Location:
    """The circuit of coupler places (*, ...), and their branch where the first dyad drives.

    The linkages' axes (*,) are the places' first ones.  Two signs decide, of q and of psi (see
    `loop_closure`).  A place off the linkage (a pose that it misses) is judged by the input and
    the coupler angle that it has, so the answer is certain only where the margins are well above
    its error.  as_given: see `Circuits.of`; at a change point itself two circuits or branches
    meet, and rounding chooses one.  Raises InputError E401 as `Circuits.of` does.
    """
    return Circuits.of(linkage, as_given).locate(places)


def _located(
    circuits: Circuits, w: FloatArray | ComplexArray, closing: ComplexArray
) -> tuple[Any, ...]:
    """The fields of `Location` of places (n,) on circuits (n,) of one range type or their twins."""
    loop, range_type = circuits.loop, circuits.range_type[0]
    q, always = closing.imag, np.ones(closing.shape)
    size = np.abs(closing)
    sine = np.where(size == 0, 0.0, q / size)
    if range_type in ONE_SIDED:
        side = w.imag if loop.turns else w / np.hypot(w, np.sqrt(loop.low.down / loop.low.scale))
    else:
        side = sine if range_type == RangeType.WHOLE and loop.closures == 2 else always
    sign = np.where(side < 0, -1.0, 1.0)
    parameter = parameter_of(loop, range_type, sign, w, q)
    two = circuits.branches == 2
    return (
        sign < 0,
        two & (q < 0),
        parameter,
        np.minimum(np.abs(side), loop.margin),
        np.where(two, np.abs(sine), 1.0),
    )
