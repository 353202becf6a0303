"""Array types and helpers that know no mechanism."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]

ROUNDING = 1e-11  # errors below this are rounding of the computation, and all equally good


def complex_of(pairs: FloatArray) -> ComplexArray:
    """Points (*, 2) as complex numbers (*,)."""
    return pairs[..., 0] + 1j * pairs[..., 1]


def pairs_of(numbers: ComplexArray | complex) -> FloatArray:
    """Complex numbers (*,) as points (*, 2)."""
    return np.stack([numbers.real, numbers.imag], axis=-1)


def median(values: FloatArray, axis: int) -> FloatArray:
    """The medians of finite numbers along an axis, which remains with size 1.

    `np.median` loads `numpy.ma` at its first call, which takes half as long as NumPy itself.
    """
    ordered, count = np.sort(values, axis=axis), values.shape[axis]
    both = np.take(ordered, [(count - 1) // 2, count // 2], axis=axis)
    return np.asarray(both.sum(axis=axis, keepdims=True) / 2)


def wrapped_angle(angle: FloatArray) -> FloatArray:
    """Angles (*,) within half a turn, [-pi, pi]."""
    return np.asarray(angle - 2 * np.pi * np.round(angle / (2 * np.pi)))


def even_numbers(count: int, most: int) -> NDArray[np.intp]:
    """At most `most` of the numbers below `count`, evenly chosen; the first and the last stay."""
    if count <= most:
        return np.arange(count)
    return np.linspace(0, count - 1, most).round().astype(np.intp)
