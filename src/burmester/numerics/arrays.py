"""Array types and helpers that know no mechanism, and weights of observations."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]

ROUNDING = 1e-11  # errors below this are rounding of the computation, and all equally good


Rows = TypeVar("Rows", bound=NDArray[Any])


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


def weights_or_ones(weights: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """Weights as they are, broadcast to a shape; ones where there are none."""
    return np.ones(shape) if weights is None else np.broadcast_to(weights, shape)


def shares(weights: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """Weights (*, N) over their sum, so that those of the last axis add up to 1."""
    whole = weights_or_ones(weights, shape)
    return np.asarray(whole / whole.sum(axis=-1, keepdims=True))


def weights_of_mean_one(weights: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """Weights (*, N) over their mean, so that a sum over the last axis is as without weights."""
    whole = weights_or_ones(weights, shape)
    return np.asarray(whole / whole.mean(axis=-1, keepdims=True))


def unique_rows(rows: Rows, tolerance: float, norm: Literal["euclidean", "maximum"]) -> Rows:
    """Rows (k, n), real or complex, without those that repeat an earlier one.

    A row repeats an earlier one if their difference is smaller than `tolerance` times 1 + the
    earlier one's norm.
    """
    unique: Any = rows[unique_index(rows, tolerance, norm)]
    return cast("Rows", unique)


def unique_index(
    rows: NDArray[Any], tolerance: float, norm: Literal["euclidean", "maximum"]
) -> NDArray[np.bool_]:
    """Which of rows (*, k, n) repeat no earlier one: (*, k)."""
    order = 2 if norm == "euclidean" else np.inf
    size = 1 + np.linalg.norm(rows, order, axis=-1)
    apart = np.linalg.norm(rows[..., :, None, :] - rows[..., None, :, :], order, axis=-1)
    return ~np.asarray(np.tril(apart < tolerance * size[..., None, :], -1).any(axis=-1))
