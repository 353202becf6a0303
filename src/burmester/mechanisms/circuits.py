"""The circuits of a mechanism: closed ways through all places that it reaches without a tool.

Between two places at which a loop locks, a piece, the joints are a function of the generator.  At
such a place the joint that closes this loop goes over to the other side of it, and the piece there
goes on from the same angle.  So pieces follow each other until the first comes again.  A circuit
knows no driver.

A place on a circuit is told by a share: k to k + 1 is on its piece k.  Towards a locked place the
generator goes as the cosine does, so that all joints move smoothly over the share, also past it.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.mechanisms.contract import Mechanism
from burmester.numerics.arrays import TURN, ComplexArray, FloatArray

SHORTEST = 1e-6  # radians; on a shorter piece of the generator a mechanism does not move
SAME = 1e-6  # radians; pieces that end as near to each other end at one place


@final
class Circuits(NamedTuple):
    """The circuits (c,) of one mechanism, and their pieces (p,), in order along each.

    circuit: (p,), whose piece it is.  sides: (p, loops), on which the loops are closed.
    low, high: (p,), the generator's angles between which it goes, in radians.
    onward: (p,), whether the generator's angle rises along the circuit.
    whole: (p,), whether nothing locks and the piece is a whole turn.
    first: (c,), the number of the first piece; length: (c,), how many pieces it has.
    closed: (c,); a circuit that is not closed ends where no other piece was found to go on.
    """

    circuit: NDArray[np.intp]
    sides: FloatArray
    low: FloatArray
    high: FloatArray
    onward: NDArray[np.bool_]
    whole: NDArray[np.bool_]
    first: NDArray[np.intp]
    length: NDArray[np.intp]
    closed: NDArray[np.bool_]

    def joints(
        self, mechanism: Mechanism, circuit: NDArray[np.intp] | int, share: FloatArray
    ) -> ComplexArray:
        """The joints (*, j) at shares (*,) of circuits; shares count past the seam."""
        length = self.length[circuit]
        share = np.where(self.closed[circuit], np.mod(share, length), share)
        known = np.isfinite(share)
        number = np.floor(np.where(known, share, 0.0))
        number = np.clip(number, 0, length - 1)
        piece = self.first[circuit] + number.astype(np.intp)
        angle = self._angle(piece, share - number)
        return mechanism.generated(angle, self.sides[piece], closed=True)

    def _angle(self, piece: NDArray[np.intp], part: FloatArray) -> FloatArray:
        """The generator's angles (*,) at parts (*,) of pieces, from 0 to 1."""
        low, high, onward = self.low[piece], self.high[piece], self.onward[piece]
        wave = np.sin(np.pi / 2 * part) ** 2
        return np.where(
            onward,
            low + (high - low) * np.where(self.whole[piece], part, wave),
            high - (high - low) * wave,
        )

    def found(
        self, mechanism: Mechanism, joints: ComplexArray
    ) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
        """On which circuits the joints are (m, j), at which shares, and how far off: (m,) each.

        Infinitely far where there is no circuit.
        """
        angle = mechanism.generator_angle(joints)[:, None]
        width = self.high - self.low
        over = np.mod(angle - self.low + SAME, TURN) - SAME
        part = np.clip(over / width, 0.0, 1.0)
        part = np.where(self.whole, part, 2 / np.pi * np.arcsin(np.sqrt(part)))
        part = np.where(self.onward, part, 1 - part)
        share = np.arange(len(self.low)) - self.first[self.circuit] + part
        there = self.joints(mechanism, self.circuit, share)
        off = np.abs(there - joints[:, None]).max(axis=-1)
        off = np.where((over <= width + SAME) & np.isfinite(off), off, np.inf)
        rows, best = np.arange(len(joints)), off.argmin(axis=-1)
        return self.circuit[best], share[rows, best], off[rows, best]


class _Piece(NamedTuple):
    """A piece; loops: which one locks at its low and at its high end, -1 where none does."""

    sides: tuple[float, ...]
    low: float
    high: float
    loops: tuple[int, int]


def circuits_of(mechanism: Mechanism) -> Circuits:
    """Those of one mechanism; none where it cannot be assembled."""
    pieces = [
        piece
        for sides in product((1.0, -1.0), repeat=mechanism.loops)
        for piece in _pieces(mechanism, sides)
    ]
    ways, closed, left = list[list[tuple[int, bool]]](), list[bool](), set(range(len(pieces)))
    while left:
        way, ends = _walk(pieces, min(left))
        ways.append(way)
        closed.append(ends)
        left -= {number for number, _ in way}
    order = [number for way in ways for number, _ in way]
    length = np.array([len(way) for way in ways], dtype=np.intp)
    picked = [pieces[number] for number in order]
    return Circuits(
        circuit=np.repeat(np.arange(len(ways)), length),
        sides=np.array([each.sides for each in picked]).reshape(-1, mechanism.loops),
        low=np.array([each.low for each in picked]),
        high=np.array([each.high for each in picked]),
        onward=np.array([onward for way in ways for _, onward in way], dtype=bool),
        whole=np.array([each.loops[0] < 0 for each in picked], dtype=bool),
        first=np.cumsum(length) - length,
        length=length,
        closed=np.array(closed, dtype=bool),
    )


def _pieces(mechanism: Mechanism, sides: tuple[float, ...]) -> list[_Piece]:
    """The pieces on some sides, by rising angle."""
    on = np.array(sides)
    locked = mechanism.locked(on)
    angle = np.mod(locked.angle, TURN)
    order = np.argsort(angle)[: int(np.isfinite(angle).sum())]
    spans, ends = [(0.0, TURN)], [(-1, -1)]
    if len(order):
        at, loop = angle[order].tolist(), locked.loop[order].tolist()
        spans = list(zip(at, [*at[1:], at[0] + TURN], strict=True))
        ends = list(zip(loop, [*loop[1:], loop[0]], strict=True))
    middle = np.array([(low + high) / 2 for low, high in spans])
    there = mechanism.generated(middle, np.broadcast_to(on, (len(middle), len(on))))
    closes = np.asarray(np.isfinite(there).all(axis=-1)).tolist()
    return [
        _Piece(sides, low, high, loops)
        for (low, high), loops, close in zip(spans, ends, closes, strict=True)
        if close and high - low > SHORTEST
    ]


def _walk(pieces: list[_Piece], start: int) -> tuple[list[tuple[int, bool]], bool]:
    """The pieces of a circuit from one of them on, each with whether its angle rises; if closed."""
    way = [(start, True)]
    if pieces[start].loops[0] < 0:
        return way, True
    for _ in range(2):
        while (after := _after(pieces, *way[-1])) is not None:
            if after[0] == start and len(way) > 1 and after == way[0]:
                return way, True
            if after[0] in {number for number, _ in way}:
                break
            way.append(after)
        way = [(number, not onward) for number, onward in reversed(way)]  # and the other way
    return way, False


def _after(pieces: list[_Piece], number: int, onward: bool) -> tuple[int, bool] | None:
    """The piece that goes on where one ends: that on the other side of the loop that locks."""
    own, end = pieces[number], int(onward)
    loop, at = own.loops[end], (own.low, own.high)[end]
    sides = list(own.sides)
    sides[loop] = -sides[loop]
    gaps = {
        k: abs(np.angle(np.exp(1j * ((each.low, each.high)[end] - at))))
        for k, each in enumerate(pieces)
        if each.loops[end] == loop and each.sides == tuple(sides)
    }
    best = min(gaps, key=lambda k: gaps[k], default=None)
    return None if best is None or gaps[best] > SAME else (best, not onward)
