"""Random numbers that are counted: each is a function of a seed and of its own numbers alone.

A generator that goes on from number to number gives a task other numbers when it is drawn alone or
in another order.  Here the number is hashed: the mixing of SplitMix64 (Steele, Lea and Flood, Fast
splittable pseudorandom number generators, 2014), once for each of seed, task and draw.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

_STEP = np.uint64(0x9E3779B97F4A7C15)
_FIRST, _SECOND = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
BITS = 53  # of a double below 1


def uniform_draws(seed: int, number: NDArray[np.integer], first: int, count: int) -> FloatArray:
    """Numbers (k, count) spread evenly over [0, 1), of things with numbers (k,).

    first: the number of the first of these draws among all draws of one thing.

    Examples
    --------
    >>> both = uniform_draws(7, np.array([3, 5]), 0, 2)
    >>> bool((uniform_draws(7, np.array([5]), 1, 1) == both[1:, 1:]).all())
    True
    """
    draw = np.arange(first, first + count, dtype=np.uint64)
    with np.errstate(over="ignore"):
        own = _mixed(_mixed(np.array([seed % 2**64], dtype=np.uint64)) + number.astype(np.uint64))
        bits = _mixed(own[:, None] + draw)
    return np.asarray((bits >> np.uint64(64 - BITS)).astype(np.float64) * 2.0**-BITS)


def normal_draws(seed: int, number: NDArray[np.integer], first: int, count: int) -> FloatArray:
    """Numbers (k, count) of a normal distribution of mean 0 and deviation 1; as `uniform_draws`.

    Each takes two draws (Box and Muller), from `first` on.
    """
    u = uniform_draws(seed, number, first, 2 * count)
    radius = np.sqrt(-2 * np.log1p(-u[:, :count]))
    return np.asarray(radius * np.cos(2 * np.pi * u[:, count:]))


def _mixed(value: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """The output of SplitMix64 for states (*,)."""
    z = value * _STEP + _STEP
    z = (z ^ (z >> np.uint64(30))) * _FIRST
    z = (z ^ (z >> np.uint64(27))) * _SECOND
    return np.asarray(z ^ (z >> np.uint64(31)))
