"""Values that callers construct: real numbers of a shape and instances of a type, or E125."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from decimal import Decimal
from numbers import Real
from reprlib import Repr
from types import EllipsisType
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.printable import printable
from burmester.wording import listed

# Lengths of axes; None is any length, an ellipsis any number of leading axes.
Shape: TypeAlias = tuple[int | EllipsisType | None, ...]

_REPR = Repr()
_REPR.maxstring = _REPR.maxother = 40  # characters of one value in a message


def real_numbers(
    value: object, shape: Shape, what: str, *, code: str | None = None, finite: bool = True
) -> NDArray[np.float64]:
    """A read-only copy of real numbers as doubles; whatever else is given is refused.

    Refused are complex numbers, booleans, text, masked arrays and rows of different lengths:
    NumPy would convert most of them without a word.  In `shape` None is any length, a leading
    ellipsis any number of axes.  Raises E125 (wrong type or shape) and E103 (not finite, where
    that is asked for), or `code` for both.

    >>> real_numbers([[0, 1], [2, 3]], (None, 2), "corners")
    array([[0., 1.],
           [2., 3.]])
    >>> real_numbers([1, 2, 3], (2,), "a point")
    Traceback (most recent call last):
        ...
    burmester.errors.InputError: error[E125]: a point: not real numbers of shape (2,)
      why: the shape is (3,)
      help: give an array or a list of shape (2,)
    """
    noun = f"real numbers of shape {_written(shape)}" if shape else "a real number"
    kind = f"an array or a list of shape {_written(shape)}" if shape else "a number, such as 0.5"

    def refusal(why: str, help: str) -> InputError:
        return InputError(code or "E125", f"{what}: not {noun}", why=why, help=help)

    if _is_masked(value):
        raise refusal("it is a masked array", "leave the masked entries out, or fill them")
    try:
        given = np.asarray(value, dtype=None if hasattr(value, "__array__") else object)
    except (TypeError, ValueError):
        raise refusal("its rows have different lengths", f"give {kind}") from None
    for entry in _first_of_each_type(given):
        if isinstance(entry, Sequence | np.ndarray) and not isinstance(entry, str | bytes):
            raise refusal("its rows have different lengths", f"give {kind}")
        if isinstance(entry, complex | np.complexfloating):
            raise refusal(f"it has the complex number {entry}", "give its real part alone")
        if isinstance(entry, bool | np.bool_) or not isinstance(entry, Real | Decimal):
            why = f"it is {shown(entry)}" if given.ndim == 0 else f"it has the entry {shown(entry)}"
            raise refusal(why, f"give {kind}")
    if not _fits(given.shape, shape):
        raise refusal(f"the shape is {given.shape}" if given.shape else "it is one number",
                      f"give {kind}")  # fmt: skip
    try:
        numbers = np.array(given, dtype=np.float64)
    except OverflowError:
        numbers = np.array([_double(entry) for entry in given.ravel().tolist()])
        numbers = numbers.reshape(given.shape)
    if finite and not (known := np.isfinite(numbers)).all():
        at = tuple(np.argwhere(~known)[0].tolist())
        place = f"entry {at[0] if len(at) == 1 else at}" if at else "it"
        raise InputError(
            code or "E103",
            f"{what}: not finite",
            why=f"{place} is {shown(given[at])}",
            help="give finite numbers only" if at else "give a finite number",
        )
    numbers.setflags(write=False)
    return numbers


def require_instance(
    value: object, types: type | tuple[type, ...], what: str, help: str, *, code: str = "E125"
) -> None:
    """Refuse a value of another type than `types`: E125, or `code`; help: what to give instead."""
    if isinstance(value, types):
        return
    names = [each.__name__ for each in (types if isinstance(types, tuple) else (types,))]
    raise InputError(
        code,
        f"{what}: not of type {listed(names, 'or')}",
        why=f"it is {shown(value)}",
        help=help,
    )


def short_text(text: str, most: int, what: str, help: str, *, code: str) -> str:
    """A text as any screen can show it; an error of a code for one of too many characters."""
    short = printable(text)
    if len(short) > most:
        why = f"it has {len(short)} characters, and {most} are the most"
        raise InputError(code, f"{what} is too long", why=why, help=help)
    return short


def shown(value: object) -> str:
    """A value as it was written, on one line, the middle of a long one left out."""
    return " ".join(_REPR.repr(value.item() if isinstance(value, np.generic) else value).split())


def _double(number: Any) -> float:
    try:
        return float(number)
    except OverflowError:  # a whole number beyond the range of doubles
        return np.inf


def _written(shape: Shape) -> str:
    axes = ["*" if n is ... else "N" if n is None else str(n) for n in shape]
    return f"({', '.join(axes)}{',' if len(axes) == 1 else ''})"


def _fits(given: tuple[int, ...], shape: Shape) -> bool:
    if shape[:1] == (...,):
        shape = shape[1:]
        given = given[len(given) - len(shape) :] if len(given) >= len(shape) else ()
    return len(given) == len(shape) and all(
        n is None or n == m for n, m in zip(shape, given, strict=True)
    )


def _is_masked(value: object) -> bool:
    if isinstance(value, list | tuple):
        return any(map(_is_masked, value))
    # Whoever has a masked array has loaded `numpy.ma`, which takes as long as half of NumPy.
    return "numpy.ma" in sys.modules and isinstance(value, np.ma.MaskedArray)


def _first_of_each_type(given: NDArray[np.generic]) -> list[object]:
    """One entry of every type in an array: of a plain one the first entry stands for all."""
    if given.dtype.kind in "iuf":
        return []
    if given.dtype != object:
        return list(given.ravel()[:1])
    return list({type(entry): entry for entry in reversed(given.ravel().tolist())}.values())
