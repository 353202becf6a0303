"""Bundles: values whose arrays share their first axis, handled row by row.

A bundle is an array, a list (one item a row), None, or a tuple, NamedTuple or dataclass of bundles.
Single numbers and texts in it belong to all rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

Bundle = TypeVar("Bundle")
FOR_ALL_ROWS = bool, int, float, str  # types of values that are not picked from


def take(bundle: Bundle, index: Any) -> Bundle:
    """The rows at the indices, or where a mask is true."""

    def rows(part: Any) -> Any:
        if isinstance(part, list):
            return [part[k] for k in np.arange(len(part))[index]]
        return part[index]

    return _for_each_array(rows, bundle)


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
