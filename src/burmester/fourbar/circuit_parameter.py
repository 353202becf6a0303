"""The input range of a circuit between dead points, its type, and a parameter along the circuit.

For each type of range both e^(i psi) (psi itself where the input slides) and the root q (see
`loop_closure`) are written in the sine and cosine of one parameter.  The root changes its sign
where the circuit passes a dead point, and nothing jumps there.
"""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.loop_closure import DrivenLoop
from burmester.numerics.arrays import ComplexArray, FloatArray

# Smallest `DrivenLoop.margin` (relative) at which the two circuits count as separate.
CHANGE_POINT = 1e-9
# At a change point a bound may be violated by rounding, up to this fraction of its scale.
BOUND_ROUNDING = 1e-7


class RangeType(IntEnum):
    """The part of the range of f (see `loop_closure`) that a circuit covers.

    `sign` is the second number that `range_types` returns for the circuit.
    """

    NONE = 0  # no circuit
    WHOLE = 1  # the whole range of f, in one closure: q has the sign `sign`
    BELOW = 2  # from the least f to the dead point `high`, in both closures
    ABOVE = 3  # from the dead point `low` to the greatest f, in both closures
    BETWEEN = 4  # between both dead points, in both closures; psi has the sign `sign`
    BEYOND = 5  # from `low` without end, in both closures; psi has the sign `sign`
    HALF = 6  # half a turn, psi of the sign `sign`; the coupler comes from and goes to infinity


SIGNS = np.array([1.0, -1.0])  # of the two circuits
ONE_SIDED = (RangeType.BETWEEN, RangeType.BEYOND, RangeType.HALF)  # psi keeps its sign


class RangeKind(NamedTuple):
    """What circuits have in common whose places follow one formula."""

    turns: bool
    range_type: RangeType


class Parameter(NamedTuple):
    """A parameter s (*,) with its sine and cosine.

    up: 1 - cos s; down: 1 + cos s; both without cancellation.
    """

    s: FloatArray
    sin: FloatArray
    cos: FloatArray
    up: FloatArray
    down: FloatArray

    @classmethod
    def of(cls, s: FloatArray) -> Self:
        half_sin, half_cos = np.sin(s / 2), np.cos(s / 2)
        up, down = 2 * half_sin * half_sin, 2 * half_cos * half_cos
        return cls(s, 2 * half_sin * half_cos, np.where(up < down, 1 - up, down - 1), up, down)

    def rows(self, index: NDArray[np.intp]) -> Parameter:
        """Some rows of it."""
        return Parameter(*(part[index] for part in self))


def near_change_point(loop: DrivenLoop) -> NDArray[np.bool_]:
    """Whether linkages (*,) are within 1e-9 of a change point."""
    return ~(loop.margin > CHANGE_POINT)


def clamped_at_change_points(loop: DrivenLoop) -> DrivenLoop:
    """The loops with bounds that rounding violates at a change point moved back to the range of f.

    So each of these circuits has at least one place.
    """
    if not near_change_point(loop).any():
        return loop
    high, low = loop.high, loop.low
    return loop.clamped(_clamped(loop, high.down, high.scale), _clamped(loop, low.up, low.scale))


def _clamped(loop: DrivenLoop, room: FloatArray, scale: FloatArray) -> FloatArray:
    """A scaled distance (*,) from a bound to an end of the range: 0 where rounding made it < 0."""
    small = (-room <= BOUND_ROUNDING * scale) | ~loop.turns
    return np.where(near_change_point(loop) & (room < 0) & small, 0.0, room)


def range_types(loop: DrivenLoop, as_given: bool = False) -> tuple[NDArray[np.int8], FloatArray]:
    """Range types (*, 2) and signs (*, 2) of the two circuits of linkages (*,).

    as_given: linkages at change points have circuits, too; the loops are then those of
    `clamped_at_change_points`.
    """
    high, low, turns = loop.high, loop.low, loop.turns
    change = near_change_point(loop)
    if as_given:
        none = ~((high.down >= 0) & (low.up >= 0)) | (change & loop.is_point)
    else:
        none = change | ~((high.down > 0) & (low.up > 0))
    # A sliding input has no greatest f other than the dead point itself.
    ends_above = np.where(turns, high.up, high.scale) > 0
    ends_below = low.down > 0
    whole = np.where(loop.on_slot_and_rail, RangeType.HALF, RangeType.WHOLE)
    below = np.where(ends_below, np.where(turns, RangeType.ABOVE, RangeType.BEYOND), whole)
    above = np.where(ends_below, RangeType.BETWEEN, RangeType.BELOW)
    range_type = np.where(none, RangeType.NONE, np.where(ends_above, above, below))
    alone = (range_type == RangeType.BELOW) | (range_type == RangeType.ABOVE)
    alone |= (range_type == RangeType.WHOLE) & (loop.closures == 1)
    both = np.empty((*range_type.shape, 2), dtype=np.int8)
    both[..., 0] = range_type
    both[..., 1] = np.where(alone, RangeType.NONE, range_type)
    return both, np.broadcast_to(SIGNS, both.shape)


def input_and_root(
    loop: DrivenLoop, kind: RangeKind, sign: FloatArray, at: Parameter
) -> tuple[FloatArray | ComplexArray, FloatArray]:
    """e^(i psi) (psi of sliding inputs) and q at parameters of circuits (*,) of one kind."""
    return (_rotary_input_and_root if kind.turns else _sliding_input_and_root)(
        loop, kind.range_type, sign, at
    )


def _rotary_input_and_root(
    loop: DrivenLoop, range_type: RangeType, sign: FloatArray, at: Parameter
) -> tuple[ComplexArray, FloatArray]:
    high, low = loop.high, loop.low
    if range_type == RangeType.HALF:
        return at.cos + 1j * (sign * at.sin), np.ones_like(at.s)
    if range_type == RangeType.WHOLE:
        q = np.sqrt((high.scale * at.up - high.up) * (low.scale * at.down - low.down))
        return at.cos + 1j * at.sin, sign * q
    if range_type == RangeType.BETWEEN:
        least, greatest = low.down / low.scale, high.down / high.scale
        half = (greatest - least) / 2
        down, up = least + half * at.down, high.up / high.scale + half * at.up
        q = np.sqrt(high.scale * low.scale) * half * at.sin
        return (down - up) / 2 + 1j * (sign * np.sqrt(up * down)), q
    if range_type == RangeType.ABOVE:
        size = low.up / low.scale
        up = size * at.cos**2
        q = np.sqrt(low.up * (high.scale * up - high.up)) * at.sin
        return 1 - up - 1j * (np.sqrt(size * (2 - up)) * at.cos), q
    size = high.down / high.scale
    down = size * at.cos**2
    q = np.sqrt(high.down * (low.scale * down - low.down)) * at.sin
    return down - 1 + 1j * (np.sqrt(size * (2 - down)) * at.cos), q


def _sliding_input_and_root(
    loop: DrivenLoop, range_type: RangeType, sign: FloatArray, at: Parameter
) -> tuple[FloatArray, FloatArray]:
    high, low = loop.high, loop.low
    if range_type == RangeType.WHOLE:
        down = at.s * at.s
        q = np.sqrt((high.down - high.scale * down) * (low.scale * down - low.down))
        return at.s, sign * q
    if range_type == RangeType.BEYOND:
        return sign * np.sqrt(low.down / low.scale + at.s**2), np.sqrt(high.down * low.scale) * at.s
    size = high.down / high.scale
    if range_type == RangeType.BETWEEN:
        least = low.down / low.scale
        half = (size - least) / 2
        q = np.sqrt(high.scale * low.scale) * half * at.sin
        return sign * np.sqrt(least + half * at.down), q
    q = np.sqrt(high.down * (low.scale * size * at.cos**2 - low.down)) * at.sin
    return -np.sqrt(size) * at.cos, q


def parameter_of(loop: DrivenLoop, kind: RangeKind, w: ComplexArray, q: FloatArray) -> FloatArray:
    """The parameter (*,) at e^(i psi) (or psi) and q, of one kind; see `input_and_root`."""
    high, low, (turns, range_type) = loop.high, loop.low, kind
    if range_type == RangeType.HALF:
        return np.abs(np.angle(w))
    if range_type == RangeType.BEYOND:
        return q / np.sqrt(high.down * low.scale)
    if range_type == RangeType.WHOLE:
        return np.angle(w) % (2 * np.pi) if turns else w.real
    down, up = (1 + w.real, 1 - w.real) if turns else (w.real**2, w.real)
    if range_type == RangeType.BETWEEN:
        least, greatest = low.down / low.scale, high.down / high.scale
        half = (greatest - least) / 2
        sine, cosine = q / np.sqrt(high.scale * low.scale), down - least - half
    elif range_type == RangeType.ABOVE:
        sine = q / np.sqrt(low.up * np.maximum(high.scale * up - high.up, 0))
        cosine = -w.imag / np.sqrt(low.up / low.scale * down)
    else:
        size = high.down / high.scale
        sine = q / np.sqrt(high.down * np.maximum(low.scale * down - low.down, 0))
        cosine = w.imag / np.sqrt(size * up) if turns else -w.real / np.sqrt(size)
    if range_type != RangeType.BETWEEN and (change := near_change_point(loop)).any():
        # Half way between dead points rounding may hide the root, or the circuit may be a point.
        cosine = np.where(change & np.isnan(cosine), 0.0, cosine)
        middle = change & ~(np.abs(cosine) > 0.5)
        sine = np.where(middle, np.copysign(np.sqrt(1 - np.minimum(cosine**2, 1)), q), sine)
    return np.arctan2(sine, cosine) % (2 * np.pi)
