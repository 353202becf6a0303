"""Courses: how a circuit runs between dead points, and a parameter along it.

On each course both e^(i psi) (or psi, of slides) and the root q (see `drive`) are written in the
sine and cosine of one parameter, so that the root changes its sign where a dead point is passed
and nothing jumps.
"""

from __future__ import annotations

from dataclasses import replace
from enum import IntEnum
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.fourbar.loop_closure import DrivenLoop
from burmester.numerics.arrays import ComplexArray, FloatArray

__all__ = [
    "CHANGE_POINT",
    "ONE_SIDED",
    "Parameter",
    "RangeType",
    "along",
    "parameter_of",
    "range_types",
    "settled",
    "tied",
]

CHANGE_POINT = 1e-9  # of `Drive.margin`, below which the circuits are not told apart
A_POINT = 1e-7  # of a bound's scale: what an impossible bound may be off by at a change point


class RangeType(IntEnum):
    """How f runs along a circuit."""

    NONE = 0  # there is no such circuit
    WHOLE = 1  # over all of its range, in the way to close that `sign` is the sign of
    BELOW = 2  # from its least value to the dead point `high`, both ways
    ABOVE = 3  # from the dead point `low` to its greatest value, both ways
    BETWEEN = 4  # between both dead points, both ways, psi having the sign `sign`
    BEYOND = 5  # from `low` on without end, both ways, psi having the sign `sign`
    HALF = 6  # half a turn with psi of the sign `sign`, from infinity to infinity


ONE_SIDED = (RangeType.BETWEEN, RangeType.BEYOND, RangeType.HALF)


class Parameter(NamedTuple):
    """A parameter s (*,), its sine and cosine, and 1 - cos s and 1 + cos s without cancellation."""

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


def tied(drive: DrivenLoop) -> NDArray[np.bool_]:
    """Whether linkages (*,) are within 1e-9 of a change point."""
    return ~(drive.margin > CHANGE_POINT)


def settled(drive: DrivenLoop) -> DrivenLoop:
    """With room for one place, at least, where rounding at a change point has left none."""

    def settle(room: FloatArray, scale: FloatArray) -> FloatArray:
        near = (-room <= A_POINT * scale) if drive.turns else True
        return np.where(tied(drive) & (room < 0) & near, 0.0, room)

    high, low = drive.high, drive.low
    high = high._replace(down=settle(high.down, high.scale))
    return replace(drive, high=high, low=low._replace(up=settle(low.up, low.scale)))


def _lost(drive: DrivenLoop) -> NDArray[np.bool_]:
    """Where nothing can be told, even as given; see `Circuits.of`."""
    first, second, change = drive.first, drive.second, tied(drive)
    if isinstance(first, RP):
        return change if isinstance(second, RP) else np.zeros_like(change)
    a_point = first.radius == 0 if isinstance(first, RR) else np.zeros_like(change)
    if not isinstance(second, RP | PP):
        a_point = a_point | (second.moving_pivot == first.moving_pivot).all(axis=-1)
    if isinstance(first, PR) and isinstance(second, PR):
        a_point = a_point | (drive.high.scale > 0)
    return np.asarray(change & a_point)


def range_types(drive: DrivenLoop, as_given: bool = False) -> tuple[NDArray[np.int8], FloatArray]:
    """Course and sign (*, 2) of the circuits of linkages (*,); as given, of settled drives."""
    high, low = drive.high, drive.low
    if as_given:
        none = ~((high.down >= 0) & (low.up >= 0)) | _lost(drive)
    else:
        none = tied(drive) | ~((high.down > 0) & (low.up > 0))
    # A slide has no greatest f but the one it is held below.
    ends_above = high.up > 0 if drive.turns else high.scale > 0
    ends_below = low.down > 0
    course = np.select(
        [none, ends_above & ends_below, ends_above, ends_below],
        [
            RangeType.NONE,
            RangeType.BETWEEN,
            RangeType.BELOW,
            RangeType.ABOVE if drive.turns else RangeType.BEYOND,
        ],
        RangeType.HALF
        if isinstance(drive.first, RP) and isinstance(drive.second, PR)
        else RangeType.WHOLE,
    )
    alone = (course == RangeType.BELOW) | (course == RangeType.ABOVE)
    if drive.ways == 1:
        alone = alone | (course == RangeType.WHOLE)
    both = np.stack([course, np.where(alone, RangeType.NONE, course)], axis=-1).astype(np.int8)
    return both, np.broadcast_to(np.array([1.0, -1.0]), both.shape)


def along(
    drive: DrivenLoop, course: RangeType, sign: FloatArray, at: Parameter
) -> tuple[FloatArray | ComplexArray, FloatArray]:
    """e^(i psi), or psi of slides, and q at parameters of circuits (*,) of one course."""
    return (_turning if drive.turns else _sliding)(drive, course, sign, at)


def _turning(
    drive: DrivenLoop, course: RangeType, sign: FloatArray, at: Parameter
) -> tuple[ComplexArray, FloatArray]:
    high, low = drive.high, drive.low
    if course == RangeType.HALF:
        return at.cos + 1j * (sign * at.sin), np.ones_like(at.s)
    if course == RangeType.WHOLE:
        q = np.sqrt((high.scale * at.up - high.up) * (low.scale * at.down - low.down))
        return at.cos + 1j * at.sin, sign * q
    if course == RangeType.BETWEEN:
        least, greatest = low.down / low.scale, high.down / high.scale
        half = (greatest - least) / 2
        down, up = least + half * at.down, high.up / high.scale + half * at.up
        q = np.sqrt(high.scale * low.scale) * half * at.sin
        return (down - up) / 2 + 1j * (sign * np.sqrt(up * down)), q
    if course == RangeType.ABOVE:
        size = low.up / low.scale
        up = size * at.cos**2
        q = np.sqrt(low.up * (high.scale * up - high.up)) * at.sin
        return 1 - up - 1j * (np.sqrt(size * (2 - up)) * at.cos), q
    size = high.down / high.scale
    down = size * at.cos**2
    q = np.sqrt(high.down * (low.scale * down - low.down)) * at.sin
    return down - 1 + 1j * (np.sqrt(size * (2 - down)) * at.cos), q


def _sliding(
    drive: DrivenLoop, course: RangeType, sign: FloatArray, at: Parameter
) -> tuple[FloatArray, FloatArray]:
    high, low = drive.high, drive.low
    if course == RangeType.WHOLE:
        down = at.s * at.s
        q = np.sqrt((high.down - high.scale * down) * (low.scale * down - low.down))
        return at.s, sign * q
    if course == RangeType.BEYOND:
        return sign * np.sqrt(low.down / low.scale + at.s**2), np.sqrt(high.down * low.scale) * at.s
    size = high.down / high.scale
    if course == RangeType.BETWEEN:
        least = low.down / low.scale
        half = (size - least) / 2
        q = np.sqrt(high.scale * low.scale) * half * at.sin
        return sign * np.sqrt(least + half * at.down), q
    q = np.sqrt(high.down * (low.scale * size * at.cos**2 - low.down)) * at.sin
    return -np.sqrt(size) * at.cos, q


def parameter_of(
    drive: DrivenLoop,
    course: RangeType,
    sign: FloatArray,
    w: FloatArray | ComplexArray,
    q: FloatArray,
) -> FloatArray:
    """What `along` undoes: the parameter, of circuits of one course."""
    high, low = drive.high, drive.low
    if course == RangeType.HALF:
        return np.abs(np.angle(w))
    if course == RangeType.BEYOND:
        return q / np.sqrt(high.down * low.scale)
    if course == RangeType.WHOLE:
        return np.angle(w) % (2 * np.pi) if drive.turns else w.real
    down, up = (1 + w.real, 1 - w.real) if drive.turns else (w.real**2, w.real)
    if course == RangeType.BETWEEN:
        least, greatest = low.down / low.scale, high.down / high.scale
        half = (greatest - least) / 2
        sine, cosine = q / np.sqrt(high.scale * low.scale), down - least - half
    elif course == RangeType.ABOVE:
        sine = q / np.sqrt(low.up * np.maximum(high.scale * up - high.up, 0))
        cosine = -w.imag / np.sqrt(low.up / low.scale * down)
    else:
        size = high.down / high.scale
        sine = q / np.sqrt(high.down * np.maximum(low.scale * down - low.down, 0))
        cosine = w.imag / np.sqrt(size * up) if drive.turns else -w.real / np.sqrt(size)
    if course != RangeType.BETWEEN and (change := tied(drive)).any():
        # Half way between dead points the root may be lost in rounding, or the circuit a point.
        cosine = np.where(change & np.isnan(cosine), 0.0, cosine)
        middle = change & ~(np.abs(cosine) > 0.5)
        sine = np.where(middle, np.copysign(np.sqrt(1 - np.minimum(cosine**2, 1)), q), sine)
    return np.arctan2(sine, cosine) % (2 * np.pi)
