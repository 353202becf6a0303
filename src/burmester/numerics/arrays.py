"""Arrays: their types, bundles of those that share their first axis, weights of observations."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any, Literal, Self, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]

TURN = 2 * np.pi  # radians
ROUNDING = 1e-11  # errors below this are rounding of the computation, and all equally good


Rows = TypeVar("Rows", bound=NDArray[Any])


Bundle = TypeVar("Bundle")
FOR_ALL_ROWS = bool, int, float, str  # types of values that are not picked from


def complex_of(pairs: FloatArray) -> ComplexArray:
    """Points (*, 2) as complex numbers (*,)."""
    return pairs[..., 0] + 1j * pairs[..., 1]


def pairs_of(numbers: ComplexArray | complex) -> FloatArray:
    """Complex numbers (*,) as points (*, 2)."""
    return np.stack([numbers.real, numbers.imag], axis=-1)


def dot(one: ComplexArray, other: ComplexArray) -> FloatArray:
    """Scalar products (*,) of vectors as complex numbers (*,)."""
    return np.asarray(one.real * other.real + one.imag * other.imag)


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


def take(bundle: Bundle, index: Any) -> Bundle:
    """The rows at the indices, or where a mask is true."""

    def rows(part: Any) -> Any:
        if isinstance(part, list):
            return [part[k] for k in np.arange(len(part))[index]]
        return part[index]

    return _for_each_array(rows, bundle)


class Indexed:
    """A bundle that is picked from like an array."""

    __slots__ = ()

    def __getitem__(self, index: Any) -> Self:
        """Pick along the leading axes (indices, slices, masks)."""
        return take(self, index)


def concatenate(bundles: Sequence[Bundle]) -> Bundle:
    """The rows of all bundles, in their order."""

    def joined(*parts: Any) -> Any:
        if isinstance(parts[0], list):
            return [item for part in parts for item in part]
        return np.concatenate(parts)

    return _for_each_array(joined, *bundles)


def where(mask: NDArray[np.bool_], chosen: Bundle, other: Bundle) -> Bundle:
    """The rows of `chosen` where a mask (k,) is true, else those of `other`."""

    def merged(one: Any, two: Any) -> Any:
        return np.where(mask.reshape(-1, *[1] * (two.ndim - 1)), one, two)

    return _for_each_array(merged, chosen, other)


def put(bundle: Bundle, index: Any, rows: Bundle) -> None:
    """Write rows over those at the indices, in place."""

    def written(whole: Any, part: Any) -> Any:
        whole[index] = part
        return whole

    _for_each_array(written, bundle, rows)


def replaced(bundle: Bundle, index: Any, rows: Bundle) -> Bundle:
    """The same with other rows at the indices."""
    out = copied(bundle)
    put(out, index, rows)
    return out


def copied(bundle: Bundle) -> Bundle:
    """The same rows in arrays of their own."""
    return _for_each_array(np.array, bundle)


def row_count(bundle: Any) -> int:
    """How many rows a bundle has."""
    counts: list[int] = []
    _for_each_array(lambda part: counts.append(len(part)), bundle)
    return counts[0]


def _for_each_array(function: Callable[..., Any], *bundles: Bundle) -> Bundle:
    """A bundle of what a function makes of the arrays (or lists) that bundles of one type hold."""
    first: Any = bundles[0]
    made: Any
    if isinstance(first, np.ndarray):  # most often, so first
        made = function(*bundles)
    elif first is None or type(first) in FOR_ALL_ROWS:
        made = first
    elif isinstance(first, tuple):
        parts = _each(function, zip(*cast("Any", bundles), strict=True))
        made = tuple(parts) if type(first) is tuple else type(first)(*parts)
    elif names := _fields(cast("Any", type(first))):
        made = type(first)(*_each(function, ([getattr(b, n) for b in bundles] for n in names)))
    else:
        made = function(*bundles)
    return cast("Bundle", made)


def _each(function: Callable[..., Any], columns: Iterable[Sequence[Any]]) -> list[Any]:
    """What the function makes of each column of parts of bundles."""
    return [
        function(*column)
        if isinstance(column[0], np.ndarray)
        else _for_each_array(function, *column)
        for column in columns
    ]


@cache
def _fields(kind: type) -> tuple[str, ...]:
    """The names of the fields of a dataclass; none of any other type."""
    return tuple(field.name for field in fields(kind)) if is_dataclass(kind) else ()
