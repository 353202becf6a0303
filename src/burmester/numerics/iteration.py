"""Iterations of many rows at once, each until its own end."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import Bundle, copied, put, row_count, take
from burmester.progress import goes_on

MAX_QUARTERINGS = 20  # trials of a step before it is given up, each a quarter of the one before

Point = TypeVar("Point")
Advance: TypeAlias = Callable[[NDArray[np.intp], Point], tuple[Point, NDArray[np.bool_]]]
"""From the indices (r,) of rows and their points: the next points, and which rows have ended."""


def iterate(
    advance: Advance[Bundle], start: Bundle, rows: NDArray[np.intp], max_steps: int
) -> tuple[Bundle, NDArray[np.intp]]:
    """Advance the rows of a bundle at the given indices together, each until its own end.

    Returns the points of all rows (k,), and the step (k,) with which each ended, counted from 1;
    0 for a row that did not end or was not among the given ones.  Rows do not end where the time
    is over (`progress.limited`).
    """
    points = copied(start)
    ended_at = np.zeros(row_count(points), dtype=np.intp)
    here = take(points, rows)
    for step in range(1, max_steps + 1):
        if not len(rows) or not goes_on(step, max_steps):
            break
        here, ended = advance(rows, here)
        if ended.any():
            put(points, rows[ended], take(here, ended))
            ended_at[rows[ended]] = step
            rows, here = rows[~ended], take(here, ~ended)
    put(points, rows, here)
    return points, ended_at


def shortened(
    trial: Callable[[FloatArray], Point],
    step: FloatArray,
    worse: Callable[[Point], NDArray[np.bool_]],
) -> tuple[Point, NDArray[np.bool_]]:
    """Steps (*, n), each divided by four until it makes nothing worse.

    trial: from steps to the points they lead to; worse: which (*,) of these are worse than before.
    Returns the points after the last trial, and which of them are worse even then.
    """
    factor = np.ones(step.shape[:-1])
    for _ in range(MAX_QUARTERINGS):
        there = trial(factor[..., None] * step)
        still_worse = worse(there)
        if not still_worse.any():
            break
        factor = np.where(still_worse, factor / 4, factor)
    return there, still_worse
