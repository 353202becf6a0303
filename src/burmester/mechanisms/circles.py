"""Joints of two links are where two circles meet; angles between lines and in triangles."""

from __future__ import annotations

import numpy as np

from burmester.numerics.arrays import ComplexArray, FloatArray


def meeting(
    centre: ComplexArray,
    radius: FloatArray,
    other: ComplexArray,
    other_radius: FloatArray,
    side: FloatArray,
    *,
    closed: bool = False,
) -> ComplexArray:
    """Where two circles meet, to the left (+1) or right (-1) of the line from one centre to other.

    All (*,); nan where they do not meet.  side: 0 says that they touch.  closed: whether they are
    known to meet, but for rounding.
    """
    way = other - centre
    squared = np.abs(way) ** 2
    with np.errstate(invalid="ignore", divide="ignore"):
        along = (squared + radius**2 - other_radius**2) / (2 * squared)
        across = radius**2 / squared - along**2
        across = np.where(side == 0, 0.0, np.maximum(across, 0.0) if closed else across)
        return np.asarray(centre + way * (along + 1j * side * np.sqrt(across)))


def side_of(point: ComplexArray, start: ComplexArray, end: ComplexArray) -> FloatArray:
    """Whether points (*,) are to the left (+1) or right (-1) of the line from start to end."""
    return np.sign(((point - start) * (end - start).conj()).imag)


def acute_angle(one: ComplexArray, other: ComplexArray) -> FloatArray:
    """The angle (*,) between two lines, from zero to a quarter turn."""
    product = one * other.conj()
    return np.asarray(np.arctan2(np.abs(product.imag), np.abs(product.real)))


def arccos_or_nan(one: FloatArray, other: FloatArray, opposite: FloatArray) -> FloatArray:
    """The angle between sides one and other (*,) of triangles with `opposite` (*, k); or nan."""
    one, other = one[..., None], other[..., None]
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.arccos((one**2 + other**2 - opposite**2) / (2 * one * other)))
