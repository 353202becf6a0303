"""Points and numbers of a file that holds a linkage; what is none of these is E156."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burmester.errors import InputError
from burmester.numerics.arrays import FloatArray
from burmester.values import shown

__all__ = ["fault", "number", "pair"]


def pair(tree: dict[str, Any], key: str, path: str) -> FloatArray:
    """The point under a key: two numbers, (2,)."""
    value = tree[key]
    if not isinstance(value, list) or len(value) != 2:
        raise fault(f"{path}.{key} is no point", f"write {key} = [X, Y]", f"it is {shown(value)}")
    return np.array([number(each, f"{path}.{key}[{k}]") for k, each in enumerate(value)])


def number(value: object, path: str) -> float:
    """A finite number."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        try:
            if math.isfinite(given := float(value)):
                return given
        except OverflowError:
            pass
    raise fault(f"{path} is no finite number", "give a number", f"it is {shown(value)}")


def fault(message: str, help: str, why: str | None = None) -> InputError:
    """E156."""
    return InputError("E156", message, why=why, help=help)
