"""The least values of many functions of one number between bounds, by the golden section."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from burmester.numerics.arrays import FloatArray

STEPS = 55  # 3e-12 of the distance between the bounds is left
GOLDEN = (math.sqrt(5) - 1) / 2


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
