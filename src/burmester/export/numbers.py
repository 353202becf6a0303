"""Numbers as models and scripts hold them: with all their digits."""

from __future__ import annotations

from xml.etree.ElementTree import Element

from burmester.numerics.arrays import FloatArray

__all__ = ["number", "numbers_in", "xy"]


def number(value: float) -> str:
    """The shortest text that reads back as the same number; -0 is written as 0."""
    return repr(float(value) + 0.0)


def xy(point: FloatArray | list[float]) -> str:
    """The two coordinates of a point of the plane."""
    return f"{number(point[0])} {number(point[1])}"


def numbers_in(element: Element, key: str) -> list[float]:
    """The numbers in an attribute of an element, none where it has none."""
    return [float(part) for part in (element.get(key) or "").split()]
