"""Circuits: what a linkage can reach without being taken apart, written down, not sampled.

Chase and Mirth (Circuits and branches of single-degree-of-freedom planar linkages, Journal of
Mechanical Design 115, 1993): a circuit is all that can be reached in one assembly, a branch is a
piece of it between dead points of the drive.  A linkage of two dyads has two circuits at most.
Each is one course of the drive (see `course`) in closed form; and so are a parameter along it,
through dead points without a jump, and the circuit, the branch and the parameter of a place.
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
    along,
    parameter_of,
    range_types,
    settled,
    tied,
)
from burmester.fourbar.dyad import RP
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.loop_closure import NOWHERE, DrivenLoop, displacement_of, facing
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of

__all__ = ["Circuits", "Location", "circuit_of", "locate"]

BLOCK = 8192  # places computed together: what they need stays in the cache
BESIDE = 1e-8  # along a circuit, from where it is at a change point and its place is lost


@final
@dataclass(frozen=True, slots=True, eq=False)
class Circuits:
    """Circuits (*,) of linkages driven by their first dyads.

    drive: (*,), the linkage of each circuit; course, sign: (*,), see `RangeType`.

    A parameter runs along a circuit: an angle in [0, 2 pi) on a closed one, with the branches
    (0, pi) and (pi, 2 pi) where it has two; on an open one an angle in (0, pi) if the drive
    turns, else any length, with the branches below and above 0 where it has two.
    """

    drive: DrivenLoop
    course: NDArray[np.int8]
    sign: FloatArray

    @classmethod
    def of(cls, linkage: Linkage, as_given: bool = False) -> Self:
        """The circuits (*, 2) of linkages (*,), those that there are first.

        At a change point, and where a link is so short that nothing can be told, both are
        NONE (and `undecided`).  Their numbers depend on which dyad is first.

        as_given: such a linkage is taken as its numbers have it, with the signs that rounding
        left: a change point is passed, or turned back at, as if it were told from one.  There is
        nothing even so for two rails or two slots that are parallel but for rounding (rails
        parallel to 1e-14 are parallel), for a crank of length 0, and for a coupler whose moving
        pivots are one point.

        Raises InputError E401 where the first dyad cannot drive.
        """
        drive = DrivenLoop.of(linkage)
        if as_given:
            drive = settled(drive)
        return cls(drive[..., None][..., [0, 0]], *range_types(drive, as_given))

    def __getitem__(self, index: Any) -> Circuits:
        """Pick along the leading axes (indices, slices, masks, new axes)."""
        return Circuits(self.drive[index], self.course[index], self.sign[index])

    def flattened(self) -> Circuits:
        """The same in one row, (n,)."""
        row = self if self.shape else self[None]
        return row[np.unravel_index(np.arange(row.course.size), row.shape)]

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes."""
        return self.course.shape

    @property
    def exists(self) -> NDArray[np.bool_]:
        """Whether there is such a circuit, (*,)."""
        return np.asarray(self.course != RangeType.NONE)

    @property
    def undecided(self) -> NDArray[np.bool_]:
        """Whether the linkage is within 1e-9 of a change point, (*,)."""
        return tied(self.drive)

    @property
    def branches(self) -> NDArray[np.int8]:
        """How many branches the circuit has, (*,): 1 without dead points, else 2."""
        of_course = np.array([0, 1, 2, 2, 2, 2, 1], dtype=np.int8)
        return of_course[self.course]

    @property
    def closed(self) -> NDArray[np.bool_]:
        """Whether the circuit comes back to where it began, (*,)."""
        loop = (self.course >= RangeType.BELOW) & (self.course <= RangeType.BETWEEN)
        return np.asarray(loop | ((self.course == RangeType.WHOLE) & self.drive.turns))

    @property
    def limits(self) -> FloatArray:
        """The least and the greatest drive of each circuit, (*, 2); nan where there is none.

        Dead points where it has two branches; one whole turn, or infinite, otherwise.
        """
        drive, turns = self.drive, self.drive.turns
        with np.errstate(invalid="ignore", divide="ignore"):
            if turns:
                high, low = (
                    2 * np.arctan2(np.sqrt(bound.up), np.sqrt(bound.down))
                    for bound in (drive.high, drive.low)
                )
            else:
                high, low = (np.sqrt(bound.down / bound.scale) for bound in (drive.high, drive.low))
        end = np.full(self.shape, np.pi if turns else np.inf)
        inner, outer = (high, low) if turns else (low, high)
        first = {  # psi at both ends; of a course on one side, of that with psi > 0
            RangeType.WHOLE: (-end, end),
            RangeType.BELOW: (high, 2 * np.pi - high) if turns else (-high, high),
            RangeType.ABOVE: (-low, low),
            RangeType.BETWEEN: (inner, outer),
            RangeType.BEYOND: (low, end),
            RangeType.HALF: (np.zeros_like(end), end),
        }
        psi = np.full((2, *self.shape), np.nan)
        for course, ends in first.items():
            psi = np.where(self.course == course, np.stack(ends), psi)
        one_side = np.isin(self.course, ONE_SIDED)
        psi = np.where(one_side & (self.sign < 0), -psi[::-1], psi)
        return np.moveaxis(drive.centre + psi, 0, -1)

    def couplers(self, parameter: FloatArray) -> Displacement:
        """Coupler places (*, n) at parameters (n,) or (*, n); nan where there is no circuit."""
        change = self.undecided & self.exists
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
        d = np.full((self.course.size, np.shape(parameter)[-1]), NOWHERE)
        turn = d.copy()
        for drive, rows, span, (w, q) in self._blocks(parameter):
            d[rows, span], turn[rows, span] = drive.place(w, q)
        return d, turn

    def _restore(
        self, change: NDArray[np.bool_], parameter: FloatArray, d: ComplexArray, turn: ComplexArray
    ) -> None:
        """Mend d and e^(i angle) (m, n) of circuits at change points, a mask (*,).

        Where the driving pin meets the other fixed pivot, the coupler's angle there is the one
        just after.
        """
        some = self[change]
        rows = np.flatnonzero(change)
        parameter = np.asarray(parameter, dtype=np.float64)
        if parameter.ndim > 1:
            parameter = np.broadcast_to(parameter, (*self.shape, parameter.shape[-1]))[change]
        lost = np.isnan(turn[rows])
        if lost.any():
            for room, found in zip((d, turn), some._places(parameter + BESIDE), strict=True):
                room[rows] = np.where(lost, found, room[rows])
        if not isinstance(some.drive.first, RP):
            hand = complex_of(some.drive.first.moving_pivot)[:, None]
            unit = turn[rows] / np.abs(turn[rows])
            d[rows] += hand * (turn[rows] - unit)
            turn[rows] = unit

    def held(self, drive: FloatArray, branch: int = 0) -> Displacement:
        """Coupler places (*, n) at values (*, n) of the first dyad's drive, on one branch.

        Whatever the drive jumps to, the linkage stays assembled as it is: beyond a dead point it
        is held there.  nan where there is no circuit.
        """
        low, high = (self.limits[..., None, end] for end in (0, 1))
        if self.drive.turns:
            with np.errstate(invalid="ignore"):
                middle = (low + high) / 2
                drive = middle + (drive - middle + np.pi) % (2 * np.pi) - np.pi
        both = self.drive.assembled(np.clip(drive, low, high))
        second = np.where(self.branches == 2, branch == 1, (self.sign < 0) & (self.drive.ways == 2))
        return _picked(both, second[..., None])

    def drives(self, parameter: FloatArray, places: Displacement) -> FloatArray:
        """The drive's coordinates (*, n) at places (*, n) of these circuits, without jumps.

        parameter: (*, n), those of the places, which count the turns where the drive goes round.
        """
        drive = facing(self.drive, np.ndim(parameter))
        with np.errstate(invalid="ignore", divide="ignore"):
            w = drive.reading(places)[0]
        if not drive.turns:
            return np.asarray(drive.centre + w.real)
        course = self.course[..., None]
        # But for whole circuits psi keeps within half a turn of a middle.
        middle = np.where(course == RangeType.BELOW, np.pi, 0.0)
        swung = middle + np.angle(w * np.exp(-1j * middle))
        return np.asarray(drive.centre + np.where(course == RangeType.WHOLE, parameter, swung))

    def curve(self, point: FloatArray, parameter: FloatArray) -> FloatArray:
        """Coupler curves (*, n, 2) of points (2,) or (*, 2) of M, at parameters as above."""
        if (self.undecided & self.exists).any():
            return self.couplers(parameter).act(np.asarray(point, dtype=np.float64)[..., None, :])
        x = np.full((self.course.size, np.shape(parameter)[-1]), NOWHERE)
        point = np.asarray(point, dtype=np.float64)
        points = np.broadcast_to(complex_of(point), self.shape).reshape(-1, 1)
        for drive, rows, span, (w, q) in self._blocks(parameter):
            d, turn = drive.place(w, q)
            x[rows, span] = d + points[rows] * turn
        return x.view(np.float64).reshape(*self.shape, x.shape[-1], 2)

    def _blocks(self, parameter: FloatArray) -> Iterator[_Block]:
        """Drives (k, 1) of circuits of one course, their rows and columns, and w and q (k, n)."""
        parameter = np.asarray(parameter, dtype=np.float64)
        count, shared = parameter.shape[-1], parameter.ndim == 1
        flat = self.flattened()
        if not shared:
            parameter = np.broadcast_to(parameter, (*self.shape, count)).reshape(-1, count)
        width = max(1, min(count, BLOCK))
        many = max(1, BLOCK // width)
        for start in range(0, count, width):
            span = slice(start, start + width)
            common = Parameter.of(parameter[None, span]) if shared else None
            for course in RangeType:
                all_rows = np.flatnonzero(flat.course == course)
                for begin in range(0, len(all_rows) if course else 0, many):
                    rows = all_rows[begin : begin + many]
                    at = common or Parameter.of(parameter[rows, span])
                    some = flat[rows][:, None]
                    yield some.drive, rows, span, along(some.drive, course, some.sign, at)


def _picked(both: Displacement, which: NDArray[np.bool_]) -> Displacement:
    """Of two places (*, n, 2) the ones that are meant, (*, n)."""
    angle = np.where(which, both.angle[..., 1], both.angle[..., 0])
    points = both.translation
    return Displacement(np.where(which[..., None], points[..., 1, :], points[..., 0, :]), angle)


_Block: TypeAlias = tuple[
    DrivenLoop, NDArray[np.intp], slice, tuple[FloatArray | ComplexArray, FloatArray]
]


class Location(NamedTuple):
    """Where coupler places (*,) are on the circuits of their linkage.

    circuit: its number in `Circuits.of`, -1 where it is undecided or there is none.
    branch: 0, or 1 for the second branch of a circuit.
    parameter: along the circuit, see `Circuits`; places are met in its order.
    circuit_margin: what would have to pass through 0 for another circuit, and the linkage's own
        `Drive.margin` from a change point, whichever is less.  The former is the sine of an
        angle (the one between coupler and diagonal, or of psi) or, for slides on one side of
        their centre, psi over the hypotenuse of psi and its value at the dead point.
    branch_margin: the sine of the angle that is 0 at a dead point; 1 where there is none.
    """

    circuit: NDArray[np.int8]
    branch: NDArray[np.int8]
    parameter: FloatArray
    circuit_margin: FloatArray
    branch_margin: FloatArray


def circuit_of(linkage: Linkage, places: Displacement, as_given: bool = False) -> Location:
    """On which circuit, and on which branch of the first dyad's drive, coupler places (*, ...) are.

    The linkages' axes (*,) are the places' first ones.  Decided by two signs, of q and of psi
    (see `drive`), and by the exact limits; a place off the linkage, as a pose is that the
    linkage misses, is judged by the drive and the coupler angle that it has: a call whose margins
    are not well above its error is open.  As given: see `Circuits.of`; at a change point itself
    two circuits or branches meet, and rounding takes one.  Raises InputError E401 as
    `Circuits.of` does.
    """
    return locate(Circuits.of(linkage, as_given), places)


def locate(circuits: Circuits, places: Displacement) -> Location:
    """As `circuit_of`, on circuits (*, 2) that `Circuits.of` gave."""
    first = circuits[..., 0]
    own = facing(first.drive, len(places.shape))
    number = np.broadcast_to(np.arange(first.course.size).reshape(own.shape), places.shape)
    circuits = first.flattened()
    found = [np.full(places.shape, fill) for fill in (-1, 0, np.nan, np.nan, np.nan)]
    with np.errstate(invalid="ignore", divide="ignore"):
        w, closing = own.reading(places)
        for course in set(np.unique(circuits.course)) - {RangeType.NONE}:
            here = circuits.course[number] == course
            for result, value in zip(
                found, _located(circuits[number[here]], w[here], closing[here]), strict=True
            ):
                result[here] = value
    circuit, branch, *rest = found
    return Location(circuit.astype(np.int8), branch.astype(np.int8), *rest)


def _located(
    circuits: Circuits, w: FloatArray | ComplexArray, closing: ComplexArray
) -> tuple[Any, ...]:
    """The fields of `Location` of places (n,) on circuits (n,) of one course or their twins."""
    drive, course = circuits.drive, circuits.course[0]
    q, always = closing.imag, np.ones(closing.shape)
    size = np.abs(closing)
    sine = np.where(size == 0, 0.0, q / size)
    if course in ONE_SIDED:
        side = w.imag if drive.turns else w / np.hypot(w, np.sqrt(drive.low.down / drive.low.scale))
    else:
        side = sine if course == RangeType.WHOLE and drive.ways == 2 else always
    sign = np.where(side < 0, -1.0, 1.0)
    parameter = parameter_of(drive, course, sign, w, q)
    two = circuits.branches == 2
    return (
        sign < 0,
        two & (q < 0),
        parameter,
        np.minimum(np.abs(side), drive.margin),
        np.where(two, np.abs(sine), 1.0),
    )
