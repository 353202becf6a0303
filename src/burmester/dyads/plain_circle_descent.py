"""Newton's plain way from circles down to their distance from the poses, of many tasks at once.

The steps are those of `circle_kernel`, which is compiled: one circle after the other, so what
becomes of a circle depends on its own task alone, to the last bit, whatever tasks it is computed
with.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_kernel import steps_down, sums_of_squares
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.progress import goes_on

__all__ = ["MAX_NEWTON_STEPS", "Descent", "plain_descent", "steady_starts"]

MAX_NEWTON_STEPS = 60  # from each start
START_BITS = 20  # of a start's coordinates; no rounding of where it comes from is in these


class Descent(NamedTuple):
    """Where circles (k,) ended: z (k, 5), c, m, r, with sums of squares (k,).

    settled: whether they came to rest at a minimum; ended_at: the step, from 1, 0 for no end.
    """

    z: FloatArray
    cost: FloatArray
    settled: NDArray[np.bool_]
    ended_at: NDArray[np.intp]


def plain_descent(
    z: FloatArray,
    task: NDArray[np.intp],
    poses: Displacement,
    share: FloatArray,
    longest: FloatArray,
    *,
    steps: int = MAX_NEWTON_STEPS,
) -> Descent:
    """The way down from circles z (k, 5), of tasks (k,) with poses (T, N) and shares (T, N).

    Newton's method; where the sum is not convex, Gauss and Newton's step; shortened until it
    helps.  longest: (T,), the greatest coordinate of a circle; one that is greater has left; steps:
    how many of them at most.
    """
    count, angle = len(z), poses.angle
    x, y = np.moveaxis(poses.translation, -1, 0)
    seen = np.stack(np.broadcast_arrays(np.cos(angle), np.sin(angle), x, y, share), axis=1)
    ends, cost, run = np.array(z, dtype=float), np.empty(count), np.arange(count)
    settled, ended = np.zeros((2, count), dtype=np.uint8)
    ended_at = np.zeros(count, dtype=np.intp)
    sums_of_squares(ends, task, seen, cost)
    for number in range(1, steps + 1):
        if not len(run) or not goes_on(number, steps):
            break
        steps_down(run, ends, cost, task, seen, longest, settled, ended)
        ended_at[run[ended[run] > 0]] = number
        run = run[ended[run] == 0]
    return Descent(ends, cost, settled > 0, ended_at)


def steady_starts(z: FloatArray) -> FloatArray:
    """Circles (k, 5) to start from, with START_BITS of the greatest coordinate of each.

    Where the sum is not convex a way may turn by the last bit of its start: it would end elsewhere
    on another machine, or with another eigenproblem.
    """
    _, exponent = np.frexp(np.abs(z).max(axis=1, keepdims=True))
    return np.asarray(np.ldexp(np.round(np.ldexp(z, START_BITS - exponent)), exponent - START_BITS))
