"""Iterations of many rows at once, each until its own end, and the golden section."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import Bundle, FloatArray, copied, put, row_count, take
from burmester.progress import goes_on

MAX_QUARTERINGS = 20  # trials of a step before it is given up, each a quarter of the one before

Point = TypeVar("Point")
Advance: TypeAlias = Callable[[NDArray[np.intp], Point], tuple[Point, NDArray[np.bool_]]]
"""From the indices (r,) of rows and their points: the next points, and which rows have ended."""


STEPS = 55  # 3e-12 of the distance between the bounds is left
GOLDEN = (math.sqrt(5) - 1) / 2


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


def golden_section(
    function: Callable[[FloatArray], FloatArray],
    low: FloatArray,
    high: FloatArray,
    steps: int = STEPS,
) -> tuple[FloatArray, FloatArray]:
    """Where functions are least between low and high (*,), which hold one minimum, and the values.

    function: from numbers (*,) to values (*,).  steps: half as many do for the value of a smooth
    minimum.
    """
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = function(left), function(right)
    for _ in range(steps):
        down = at_left < at_right
        low, high = np.where(down, low, left), np.where(down, right, high)
        new = np.where(down, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        there = function(new)
        left, right = np.where(down, new, right), np.where(down, left, new)
        at_left, at_right = np.where(down, there, at_right), np.where(down, at_left, there)
    better = at_left <= at_right
    return np.where(better, left, right), np.where(better, at_left, at_right)
