"""Solutions of one Alt-Burmester problem carried over to another, each on a path of its own.

Straight ways in points, turns of poses and pivots; Runge and Kutta's prediction of fourth order,
Newton's correction, steps that adapt to each path (`path_kernel`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.points.alt_burmester import UNKNOWNS, Positions
from burmester.points.path_kernel import follow, polish

ACCURACY: Final = 3e-4  # relative; Newton's first step on a prediction, beyond it the step was long
TOGETHER: Final = 16  # paths that are followed in one call, some hundredths of a second


class Paths(NamedTuple):
    """The ends of paths.

    x: (n, 8); turns: (n, J); arrived: (n,); steps: (n,), how many each took; 0 of those that were
    not begun.
    """

    x: ComplexArray
    turns: ComplexArray
    arrived: NDArray[np.bool_]
    steps: NDArray[np.int64]


def tracked(
    x: ComplexArray,
    turns: ComplexArray,
    start: Positions,
    end: Positions,
    *,
    accuracy: float = ACCURACY,
    watch: Callable[[float], bool] | None = None,
) -> Paths:
    """Solutions x (n, 8) with turns (n, J) of a problem, carried over to another one.

    Both problems have the leading axis 1.  watch: called now and then with the share of paths that
    have ended; False ends it.
    """
    one, two = _rows(start), _rows(end)
    ends, end_turns = np.array(x), _filled(turns, 1.0)
    n, count = len(x), turns.shape[1]
    arrived, steps = np.zeros(n, dtype=np.uint8), np.zeros(n, dtype=np.int64)
    for k in range(0, n, TOGETHER):
        if watch is not None and not watch(k / n):
            break
        part = slice(k, k + TOGETHER)
        follow(
            one,
            two - one,
            count,
            start.further_poses,
            start.pivots,
            accuracy,
            ends[part],
            end_turns[part],
            arrived[part],
            steps[part],
        )
    return Paths(ends, end_turns[:, :count], arrived.astype(bool), steps)


def polished(
    x: ComplexArray, turns: ComplexArray, positions: Positions
) -> tuple[ComplexArray, ComplexArray, FloatArray]:
    """Solutions after Newton's steps, and the relative length (n,) of the shortest of these."""
    ends, end_turns, count = np.array(x), _filled(turns, 1.0), turns.shape[1]
    miss = np.empty(len(x))
    polish(
        _rows(positions),
        count,
        positions.further_poses,
        positions.pivots,
        ends,
        end_turns,
        miss,
    )
    return ends, end_turns[:, :count], miss


def _rows(positions: Positions) -> ComplexArray:
    """A problem (leading axis 1) as rows (5, 8), filled up with zeros."""
    return np.concatenate([_filled(each, 0.0) for each in positions])


def _filled(values: ComplexArray, rest: float) -> ComplexArray:
    """Rows (n, J) filled up to (n, 8)."""
    out = np.full((len(values), UNKNOWNS), rest, dtype=np.complex128)
    out[:, : values.shape[1]] = values
    return out
