"""Numbers as models and scripts hold them: with all their digits."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import Final
from xml.etree.ElementTree import Element

from burmester.numerics.arrays import FloatArray

OF_LAST_DIGIT: Final = 1000.0  # units of the last digit that outlines of arcs and tangents lose
MOST_DECIMALS: Final = 25  # decimals of a rounded number, at most


def number(value: float) -> str:
    """The shortest text that reads back as the same number; -0 is written as 0."""
    return repr(float(value) + 0.0)


def decimals_within(error: float) -> int:
    """The fewest decimals that change no number by more than this error."""
    if not error > 0:
        return MOST_DECIMALS
    return min(max(math.ceil(-math.log10(2 * error)), 0), MOST_DECIMALS)


def error_within(digits: int, largest: float) -> float:
    """How far off may be what is computed from numbers of a file.

    digits: with which the file carries them; largest: of these numbers.
    """
    return OF_LAST_DIGIT * 10.0 ** (1 - digits) * largest


def rounded(value: float, decimals: int) -> str:
    """A number to these decimals, without zeros behind them: 0.3 for 0.30000000000000004."""
    return format(Decimal(repr(round(float(value), decimals) + 0.0)), "f").removesuffix(".0")


def xy(point: FloatArray | list[float]) -> str:
    """The two coordinates of a point of the plane."""
    return f"{number(point[0])} {number(point[1])}"


def numbers_in(element: Element, key: str) -> list[float]:
    """The numbers in an attribute of an element, none where it has none."""
    return [float(part) for part in (element.get(key) or "").split()]
