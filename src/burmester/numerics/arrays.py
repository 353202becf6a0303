"""Array types and helpers that know no mechanism."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["ROUNDING", "ComplexArray", "FloatArray", "complex_of", "wrapped_angle"]

FloatArray = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]

ROUNDING = 1e-11  # errors below this are rounding of the computation, and all equally good


def complex_of(pairs: FloatArray) -> ComplexArray:
    """Points (*, 2) as complex numbers (*,)."""
    return pairs[..., 0] + 1j * pairs[..., 1]


def wrapped_angle(angle: FloatArray) -> FloatArray:
    """Angles (*,) within half a turn, [-pi, pi]."""
    return np.asarray(angle - 2 * np.pi * np.round(angle / (2 * np.pi)))
