"""Where the extremes along a motion are: more places about peaks that a few places may miss.

Near a dead point all forces grow and fall within a small part of the motion.  So places are added
where a value peaks and its neighbours are far below, and where what forces are divided by, such as
the determinant of the loops, is least and may be much less in between.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

ERROR: Final = 2e-4  # of the greatest magnitude; a peak that is off by less is found
PARTS: Final = 8  # of an interval beside a peak
MOST: Final = 4096  # places added in a round; where more would be, the values are no curves
ROUNDS: Final = 4  # the last intervals are 1e-6 of the motion
NARROW: Final = 0.5  # of a divisor; where it bends more from one place to the next it is narrow


class Seen(NamedTuple):
    """What is seen at places (n,).

    values: (q, n), whose greatest and least are told; divisors: (r, n), not negative; others:
    (s, n), whose peaks nobody asks for.
    """

    values: FloatArray
    divisors: FloatArray
    others: FloatArray


def with_peaks(places: FloatArray, look: Callable[[FloatArray], Seen]) -> tuple[FloatArray, Seen]:
    """Places (n,), ascending, and those about the peaks of what is seen there; and all that."""
    seen = look(places)
    for _ in range(ROUNDS):
        near = _near(seen.values, seen.divisors)
        if not near.any() or near.sum() * (PARTS - 1) > MOST:
            break
        low, wide = places[:-1][near], np.diff(places)[near]
        more = (low[:, None] + wide[:, None] * np.arange(1, PARTS) / PARTS).ravel()
        order = np.argsort(np.concatenate([places, more]), kind="stable")
        places = np.concatenate([places, more])[order]
        both = zip(seen, look(more), strict=True)
        seen = Seen(*(np.concatenate(each, axis=-1)[:, order] for each in both))
    return places, seen


def _near(values: FloatArray, divisors: FloatArray) -> NDArray[np.bool_]:
    """The intervals (n - 1,) between places (n,) in which a peak may be higher."""
    scale = ERROR * np.nanmax(np.abs(values), axis=1, initial=0.0)[:, None]
    rows, off = np.concatenate([values, -values]), np.concatenate([scale, scale])
    top = np.fmax.reduce(rows, axis=1, initial=-np.inf)[:, None]
    with np.errstate(invalid="ignore"):
        bend = 2 * rows[:, 1:-1] - rows[:, :-2] - rows[:, 2:]
        peak = (rows[:, 1:-1] >= rows[:, :-2]) & (rows[:, 1:-1] >= rows[:, 2:])
        peak &= (bend > 2 * off) & (rows[:, 1:-1] + 2 * bend > top)
        first = 4 * rows[:, 1] - 3 * rows[:, 0] - rows[:, 2]
        last = 4 * rows[:, -2] - 3 * rows[:, -1] - rows[:, -3]
        ends = [
            ((slope > 2 * off[:, 0]) & (here >= beside) & (here + slope > top[:, 0])).any()
            for slope, here, beside in (
                (first, rows[:, 0], rows[:, 1]),
                (last, rows[:, -1], rows[:, -2]),
            )
        ]
        dip = divisors[:, :-2] + divisors[:, 2:] - 2 * divisors[:, 1:-1]
        narrow = (divisors[:, 1:-1] <= divisors[:, :-2]) & (divisors[:, 1:-1] <= divisors[:, 2:])
        narrow &= dip > NARROW * divisors[:, 1:-1]
    found = peak.any(axis=0) | narrow.any(axis=0)
    near = np.append(found, ends[1]) | np.append(ends[0], found)
    return np.asarray(near)
