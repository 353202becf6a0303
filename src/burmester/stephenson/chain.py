"""Stephenson's chain as its first link of three joints sees it: where the joints are.

The joints A, B, F are of that link, C, D, E of the other one.  Links AC and BD join both: a loop of
four.  Links EG and FG join both as well, and meet at G:

    first  A, B, F      second  C, D, E      AC, BD, EG, FG

Every class of six-bars of this chain is one of its links as the ground, and every driver the angle
at one of its joints.  With other names of the joints (`exchanged`, `turned_over`) the chain is one
again, so that what holds at A holds at B, C and D, and what holds at F at E.
"""

from __future__ import annotations

from typing import Final, NamedTuple, final

import numpy as np

from burmester.mechanisms.circles import meeting, side_of
from burmester.mechanisms.four_bar_loop import FourBarLoop
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.stephenson.triad import triad

JOINTS: Final = "ABCDEFG"
EXCHANGED: Final = "BADCEFG"  # the joints of the exchanged chain, in the order of `JOINTS`
TURNED_OVER: Final = "CDABFEG"


@final
class Chain(NamedTuple):
    """Chains (*,).  A is the origin, and B on the x axis.

    base: AB; f: F as A and B see it; first, second: AC, BD.
    arm: CE; d: D as C and E see it; upper, lower: EG, FG.
    """

    base: FloatArray
    f: ComplexArray
    first: FloatArray
    second: FloatArray
    arm: FloatArray
    d: ComplexArray
    upper: FloatArray
    lower: FloatArray

    def size(self) -> FloatArray:
        """The sum of all lengths: (*,)."""
        return np.asarray(sum(np.abs(each) for each in self))

    def scaled(self, scale: FloatArray) -> Chain:
        """The same in another unit, `scale` (*,) of them for one."""
        return self._replace(**{name: each * scale for name, each in self._asdict().items()})

    def exchanged(self) -> Chain:
        """The same with other names: A for B, and C for D."""
        arm = np.abs(self.arm - self.d)
        d = -self.d * arm / (self.arm - self.d)
        back = self.base - self.f
        return Chain(self.base, back, self.second, self.first, arm, d, self.upper, self.lower)

    def turned_over(self) -> Chain:
        """The same with other names: A, B, F for C, D, E."""
        base, arm = np.abs(self.d), np.abs(self.f)
        f, d = self.arm * self.d.conj() / base, self.base * self.f.conj() / arm
        return Chain(base, f, self.first, self.second, arm, d, self.lower, self.upper)

    def loop(self) -> FourBarLoop:
        """The loop A, C, D, B."""
        a = np.zeros_like(self.f)
        return FourBarLoop.of(a, a + self.base, self.first, np.abs(self.d), self.second)

    def joints(
        self, angle: FloatArray, side: FloatArray, last: FloatArray, *, closed: bool = False
    ) -> ComplexArray:
        """The joints (*, 7) where AC is at angles (*,), in the order of `JOINTS`.

        side, last: of D, from C to B, and of G, from E to F: +1 left, -1 right, 0 in line.
        nan where a loop is open; closed: whether all are known to close, but for rounding.
        """
        c = self.first * np.exp(1j * angle)
        d = meeting(c, np.abs(self.d), self.base + 0j * c, self.second, side, closed=closed)
        return self.with_coupler(c, (d - c) / self.d, last, closed=closed)

    def with_coupler(
        self, c: ComplexArray, turn: ComplexArray, last: FloatArray, *, closed: bool = False
    ) -> ComplexArray:
        """The joints (*, 7) where C is, and the second link turned by unit numbers (*,)."""
        e = c + turn * self.arm
        g = meeting(e, self.upper, self.f + 0 * e, self.lower, last, closed=closed)
        a = np.zeros_like(c)
        every = a, a + self.base, c, c + turn * self.d, e, a + self.f, g
        return np.stack(np.broadcast_arrays(*every), axis=-1)

    @staticmethod
    def angle(joints: ComplexArray) -> FloatArray:
        """The angle (*,) at A from AB to AC where the joints are (*, 7), anywhere in the plane."""
        a, b, c = (joints[..., k] for k in range(3))
        return np.asarray(np.angle((c - a) / (b - a)))

    @staticmethod
    def sides(joints: ComplexArray) -> tuple[FloatArray, FloatArray]:
        """On which sides D and G are: (*,) each."""
        _, b, c, d, e, f, g = np.moveaxis(joints, -1, 0)
        return side_of(d, c, b), side_of(g, e, f)

    def in_line(self) -> tuple[ComplexArray, ComplexArray]:
        """Where E, G and F are in line: C and the turn of the second link, (*, 12); nan if none.

        EF is then as long as both links together, or as their difference.
        """
        shape = np.broadcast_shapes(*(each.shape for each in self))
        zero = np.zeros(shape)
        pivots = np.stack(np.broadcast_arrays(zero, self.base, self.f), axis=-1)
        body = np.stack(np.broadcast_arrays(zero, self.d, self.arm), axis=-1)
        found = [
            triad(pivots, body, np.stack(np.broadcast_arrays(self.first, self.second, far), -1))
            for far in (self.upper + self.lower, np.abs(self.upper - self.lower))
        ]
        turn, c = (np.concatenate(each, axis=-1) for each in zip(*found, strict=True))
        return c, turn


def inserted(joints: ComplexArray, own: str) -> ComplexArray:
    """The joints (*, 7) of a chain with other names, in the order of `JOINTS`; A at the origin.

    own: the names of these joints in the chain, in their order.
    """
    own_order = [own.index(joint) for joint in JOINTS]
    there = joints[..., own_order]
    a, b = there[..., :1], there[..., 1:2]
    return (there - a) * (np.abs(b - a) / (b - a))
