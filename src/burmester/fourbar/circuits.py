"""Circuits: what a linkage can reach without being taken apart, in closed form.

Chase and Mirth (Circuits and branches of single-degree-of-freedom planar linkages, Journal of
Mechanical Design 115, 1993): a circuit is the set of places that one assembly can reach, a branch
is a piece of it between dead points of the input.  A linkage of two dyads has two circuits at most.
Each covers one range of the input (see `circuit_parameter`).  That range, a parameter along the
circuit that passes dead points without a jump, and the circuit, branch and parameter of a place
are all exact; nothing is sampled.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Self, TypeAlias, cast, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuit_parameter import (
    ONE_SIDED,
    Parameter,
    RangeKind,
    RangeType,
    clamped_at_change_points,
    input_and_root,
    near_change_point,
    parameter_of,
    range_types,
)
from burmester.fourbar.dyad import RP
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.loop_closure import (
    KINDS,
    NO_PLACE,
    DrivenLoop,
    displacement_of,
    with_trailing_axes,
)
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of, put

PLACES_PER_BLOCK = 8192  # places computed at once; their arrays fit the processor's cache
# Step of the parameter (radians or a length) away from a change point, where a place is undefined.
INPUT_ROUNDING = 1e-12  # an input that passes a dead point by less is at it
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
    def of(cls, linkage: Linkage | LinkageBatch, as_given: bool = False) -> Self:
        """The circuits (*, 2) of a batch, or of linkages (*,) of one pair of kinds.

        The existing ones are first.  Within 1e-9 of a change point, and where a link is that short,
        both are NONE and `near_change_point` holds.  The numbering depends on which dyad is first.

        as_given: the numbers of such a linkage are taken as exact, with the signs that rounding
        left in them: the linkage passes the change point or turns back there.  Even so there is
        no circuit for two rails or two slots that are parallel within rounding (rails parallel to
        1e-14 are parallel), for a crank of length 0, and for a coupler whose moving pivots
        coincide.

        Raises InputError E401 where the first dyad cannot drive.
        """
        return cls._of(DrivenLoop.of(linkage), as_given)

    @classmethod
    def _of(cls, loop: DrivenLoop, as_given: bool) -> Self:
        if as_given:
            loop = clamped_at_change_points(loop)
        return cls(loop[..., None][..., [0, 0]], *range_types(loop, as_given))

    @classmethod
    def joined(cls, several: Sequence[Circuits]) -> Circuits:
        """Circuits (k, ...) of several linkages in one row."""
        loop = DrivenLoop.joined([each.loop for each in several])
        range_type = np.concatenate([each.range_type for each in several])
        return cls(loop, range_type, np.concatenate([each.sign for each in several]))

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

    def exchanged(self) -> Circuits:
        """The circuits (*, 2) of the linkages of circuits (*,), as given, by their second dyads."""
        return Circuits._of(self.loop.exchanged(), as_given=True)

    @property
    def turns(self) -> NDArray[np.bool_]:
        """Whether the input is an angle, (*,)."""
        return self.loop.turns

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
        return np.asarray(loop | ((self.range_type == RangeType.WHOLE) & self.turns))

    @property
    def turns_fully(self) -> NDArray[np.bool_]:
        """Whether the driver turns through full turns, without dead points, (*,)."""
        return np.asarray(self.closed & (self.branches == 1))

    @property
    def input_range(self) -> FloatArray:
        """The least and the greatest input of each circuit, (*, 2); nan where there is none.

        Dead points where it has two branches; one whole turn, or infinite, otherwise.
        """
        psi = np.full((2, *self.shape), np.nan)
        for turns, ends in ((True, self._turning_ends()), (False, self._sliding_ends())):
            for range_type, (least, greatest) in ends.items():
                here = (self.range_type == range_type) & (self.turns == turns)
                psi = np.where(here, np.stack([least, greatest]), psi)
        mirrored = np.isin(self.range_type, ONE_SIDED) & (self.sign < 0)
        psi = np.where(mirrored, -psi[::-1], psi)
        return np.moveaxis(self.loop.centre + psi, 0, -1)

    def _turning_ends(self) -> _Ends:
        """Psi (*,) at both ends of each type of range, psi > 0 on one side, of turning inputs."""
        with np.errstate(invalid="ignore", divide="ignore"):
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

    def between(self, ends: FloatArray, count: int) -> Displacement:
        """Coupler places (k, count) at parameters evenly from one end (k, 2) to the other."""
        share = np.linspace(0.0, 1.0, count)
        return self.couplers(ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * share)

    def _places(self, parameter: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Places d and e^(i angle), (m, n), of all circuits in one row; see `couplers`."""
        parameter = np.asarray(parameter, dtype=np.float64)
        count, shared = parameter.shape[-1], parameter.ndim == 1
        flat = self.flattened()
        size = flat.range_type.size
        if not shared:
            parameter = np.broadcast_to(parameter, (*self.shape, count)).reshape(-1, count)
        d, turn = np.empty((2, size, count), dtype=complex)
        width = max(1, min(count, PLACES_PER_BLOCK))
        height = max(1, PLACES_PER_BLOCK // width)
        for start in range(0, count, width):
            span = slice(start, start + width)
            for begin in range(0, size, height):
                rows = slice(begin, begin + height)
                at = parameter[None, span] if shared else parameter[rows, span]
                some = flat if height >= size else flat[rows]
                d[rows, span], turn[rows, span] = some._block(at)
        return d, turn

    def _block(self, parameter: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Places d and e^(i angle), (m, n), of circuits (m,) at parameters (m, n) or (1, n)."""
        shape, at = (len(self.range_type), parameter.shape[-1]), Parameter.of(parameter)
        w, q = np.full(shape, NO_PLACE), np.full(shape, np.nan)
        for kind, rows in self._kinds():
            loop, sign = self.loop[rows][:, None], self.sign[rows, None]
            own = at if len(parameter) < shape[0] else at.rows(rows)
            w[rows], q[rows] = input_and_root(loop, kind, sign, own)
        return cast("tuple[ComplexArray, ComplexArray]", self.loop[:, None].place(w, q))

    def _kinds(self) -> Iterator[tuple[RangeKind, NDArray[np.intp]]]:
        """The kinds of circuits (m,) that exist, and which circuits are of each."""
        code = 2 * self.range_type + self.turns
        for each in set(code.tolist()):
            range_type, turns = divmod(each, 2)
            if range_type != RangeType.NONE:
                kind = RangeKind(bool(turns), RangeType(range_type))
                yield kind, np.flatnonzero(code == each)

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
        pinned = (some.loop.kinds[0] != KINDS.index(RP))[:, None]
        unit = turn[rows] / np.abs(turn[rows])
        hand = some.loop.terms.hand[:, None]
        d[rows] = np.where(pinned, d[rows] + hand * (turn[rows] - unit), d[rows])
        turn[rows] = np.where(pinned, unit, turn[rows])

    def at_inputs(self, inputs: FloatArray, branch: int = 0) -> Displacement:
        """Coupler places (*, n) at inputs (*, n) of the first dyad, on one branch.

        The linkage stays on its circuit: an input beyond a dead point counts as the dead point.
        nan where there is no circuit.
        """
        inputs, low, high = self._in_range(inputs)
        both = self.loop.closed_at(np.clip(inputs, low, high))
        second = np.where(
            self.branches == 2, branch == 1, (self.sign < 0) & (self.loop.closures == 2)
        )
        return _chosen(both, second[..., None])

    def reached_at(self, inputs: FloatArray, branch: int = 0) -> Displacement:
        """The same, nan at inputs beyond a dead point."""
        places, (turned, low, high) = self.at_inputs(inputs, branch), self._in_range(inputs)
        slack = INPUT_ROUNDING * (1 + np.abs(turned))
        lost = np.where((turned < low - slack) | (turned > high + slack), np.nan, 0.0)
        return Displacement(places.translation + lost[..., None], places.angle + lost)

    def _in_range(self, inputs: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Inputs (*, n), angles within half a turn of the middle of the range, and its ends."""
        low, high = (self.input_range[..., None, end] for end in (0, 1))
        with np.errstate(invalid="ignore"):
            middle = (low + high) / 2
            turned = middle + (inputs - middle + np.pi) % (2 * np.pi) - np.pi
        return np.where(self.turns[..., None], turned, inputs), low, high

    def inputs(self, parameter: FloatArray, places: Displacement) -> FloatArray:
        """The inputs (*, n) at places (*, n) of these circuits, without jumps.

        parameter: (*, n), of the places; it counts the turns of an input that turns fully.
        """
        loop = with_trailing_axes(self.loop, np.ndim(parameter))
        with np.errstate(invalid="ignore", divide="ignore"):
            w = loop.closure_at(places)[0]
            range_type = self.range_type[..., None]
            # Unless the range is whole, psi stays within half a turn of its middle.
            below = range_type == RangeType.BELOW
            swung = np.angle(np.where(below, -w, w)) + np.where(below, np.pi, 0.0)
        turned = np.where(range_type == RangeType.WHOLE, parameter, swung)
        return np.asarray(loop.centre + np.where(loop.turns, turned, w.real))

    def locate(self, places: Displacement) -> Location:
        """As `circuit_of`, for coupler places (*, ...) and the circuits (*, 2) of `of`."""
        first = self[..., 0]
        with np.errstate(invalid="ignore", divide="ignore"):
            w, closing = with_trailing_axes(first.loop, len(places.shape)).closure_at(places)
            flat = (first.range_type.size, math.prod(places.shape[first.range_type.ndim :]))
            first, w, closing = first.flattened(), w.reshape(flat), closing.reshape(flat)
            found = Location.none(flat)
            for kind, rows in first._kinds():
                put(found, rows, _located(first.loop[rows][:, None], kind, w[rows], closing[rows]))
        return found.reshaped(places.shape)

    def curve(self, point: FloatArray, parameter: FloatArray) -> FloatArray:
        """Coupler curves (*, n, 2) of points (2,) or (*, 2) of M, at parameters (n,) or (*, n)."""
        if (self.near_change_point & self.exists).any():
            return self.couplers(parameter).act(np.asarray(point, dtype=np.float64)[..., None, :])
        points = np.broadcast_to(
            complex_of(np.asarray(point, dtype=np.float64)), self.shape
        ).reshape(-1, 1)
        d, turn = self._places(parameter)
        x = d + points * turn
        return x.view(np.float64).reshape(*self.shape, x.shape[-1], 2)


def _chosen(both: Displacement, which: NDArray[np.bool_]) -> Displacement:
    """Of two places (*, n, 2) the second where `which` (*, n) holds, else the first: (*, n)."""
    angle = np.where(which, both.angle[..., 1], both.angle[..., 0])
    points = both.translation
    return Displacement(np.where(which[..., None], points[..., 1, :], points[..., 0, :]), angle)


_Ends: TypeAlias = dict[RangeType, tuple[FloatArray, FloatArray]]


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

    def reshaped(self, shape: tuple[int, ...]) -> Location:
        """The same of other axes."""
        circuit, branch, *rest = self
        return Location(
            circuit.reshape(shape), branch.reshape(shape), *(r.reshape(shape) for r in rest)
        )


def circuit_of(linkage: Linkage, places: Displacement, as_given: bool = False) -> Location:
    """The circuit of coupler places (*, ...), and their branch where the first dyad drives.

    The linkages' axes (*,) are the places' first ones.  Two signs decide, of q and of psi (see
    `loop_closure`).  A place off the linkage (a pose that it misses) is judged by the input and
    the coupler angle that it has, so the answer is certain only where the margins are well above
    its error.  as_given: see `Circuits.of`; at a change point itself two circuits or branches
    meet, and rounding chooses one.  Raises InputError E401 as `Circuits.of` does.
    """
    return Circuits.of(linkage, as_given).locate(places)


def _located(loop: DrivenLoop, kind: RangeKind, w: ComplexArray, closing: ComplexArray) -> Location:
    """The locations of places (m, n) on circuits (m, 1) of one kind or their twins."""
    turns, range_type = kind
    q, always = closing.imag, np.ones(closing.shape)
    size = np.abs(closing)
    sine = np.where(size == 0, 0.0, q / size)
    if range_type in ONE_SIDED:
        side = (
            w.imag if turns else w.real / np.hypot(w.real, np.sqrt(loop.low.down / loop.low.scale))
        )
    elif range_type == RangeType.WHOLE:
        side = np.where(loop.closures == 2, sine, always)
    else:
        side = always
    two = range_type not in (RangeType.WHOLE, RangeType.HALF)
    return Location(
        (side < 0).astype(np.int8),
        (q < 0).astype(np.int8) if two else np.zeros(q.shape, np.int8),
        parameter_of(loop, kind, w, q),
        np.minimum(np.abs(side), loop.margin),
        np.abs(sine) if two else always,
    )
