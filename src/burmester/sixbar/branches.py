"""The branches of one six-bar: pieces of the drive on which nothing locks, and their circuits.

A branch ends where a loop locks (`dead_points`).  There the joint that closes this loop may go over
to the other side of it, as somebody helps by hand: the branch on the other side begins at the same
drive.  Branches that hang together so are one circuit; from one circuit to another the six-bar has
to be taken apart.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray
from burmester.sixbar.dead_points import dead_points
from burmester.sixbar.motion import Sides, joints_at
from burmester.sixbar.watt import Drive, WattLinkage

__all__ = ["Branches", "branches_of"]

TURN = 2 * np.pi
SHORTEST = 1e-6  # radians; on a shorter piece of the drive a six-bar does not move
SAME = 1e-9  # radians; two branches that end as near to each other end at one dead point
OF_FIRST_LOOP = 4  # so many dead points are those of the first loop; the others are the second's


@final
class Branches(NamedTuple):
    """The branches (k,) of a six-bar with one driver.

    low, high: (k,), the drives between which they go, in radians; a turn apart where the driver
    turns fully.  full: (k,), whether it does.  circuit: (k,), numbers; the branches of one circuit
    share theirs.
    """

    sides: Sides
    low: FloatArray
    high: FloatArray
    full: NDArray[np.bool_]
    circuit: NDArray[np.intp]


class _Piece(NamedTuple):
    """A branch; loops: which one locks at its low and at its high end, 0 or 1, or -1 for none."""

    sides: tuple[float, float]
    low: float
    high: float
    loops: tuple[int, int]


def branches_of(linkage: WattLinkage, driver: Drive) -> Branches:
    """Those of one linkage; none where it cannot be assembled."""
    pieces = [
        piece
        for first, second in product((1.0, -1.0), repeat=2)
        for piece in _pieces(linkage, (first, second), driver)
    ]
    sides = np.array([each.sides for each in pieces]).reshape(-1, 2)
    ends = np.array([(each.low, each.high) for each in pieces]).reshape(-1, 2)
    full = np.array([each.loops[0] < 0 for each in pieces], dtype=bool)
    circuit = np.array(_circuits(pieces), dtype=np.intp)
    return Branches(Sides(sides[:, 0], sides[:, 1]), ends[:, 0], ends[:, 1], full, circuit)


def _pieces(linkage: WattLinkage, sides: tuple[float, float], driver: Drive) -> list[_Piece]:
    """The branches on two sides, by rising drive."""
    both = Sides(np.array(sides[0]), np.array(sides[1]))
    dead = np.mod(dead_points(linkage, both, driver), TURN)
    order = np.argsort(dead)
    order = order[: int(np.isfinite(dead).sum())]
    if not len(order):
        spans, ends = [(0.0, TURN)], [(-1, -1)]
    else:
        at = dead[order].tolist()
        loop = (order >= OF_FIRST_LOOP).astype(int).tolist()
        spans = list(zip(at, [*at[1:], at[0] + TURN], strict=True))
        ends = list(zip(loop, [*loop[1:], loop[0]], strict=True))
    out = []
    for (low, high), loops in zip(spans, ends, strict=True):
        middle = joints_at(linkage, np.array((low + high) / 2), both, driver)
        if high - low > SHORTEST and np.isfinite(middle).all():
            out.append(_Piece(sides, low, high, loops))
    return out


def _circuits(pieces: list[_Piece]) -> list[int]:
    """The number of the circuit of each branch."""
    circuit = list(range(len(pieces)))
    for i, k in product(range(len(pieces)), repeat=2):
        if circuit[i] != circuit[k] and _meet(pieces[i], pieces[k]):
            circuit = [circuit[k] if each == circuit[i] else each for each in circuit]
    return circuit


def _meet(one: _Piece, other: _Piece) -> bool:
    """Whether two branches end at one dead point, and differ in the side of the loop that locks."""
    for end in (0, 1):
        loop = one.loops[end]
        if loop < 0 or other.loops[end] != loop or one.sides[1 - loop] != other.sides[1 - loop]:
            continue
        gap = (one.low, one.high)[end] - (other.low, other.high)[end]
        if one.sides[loop] != other.sides[loop] and abs(np.angle(np.exp(1j * gap))) < SAME:
            return True
    return False
