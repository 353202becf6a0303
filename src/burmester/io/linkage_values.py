"""Dyads, points, numbers and texts of a file that holds a linkage.

E156 what is no dyad, point or number
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dyad import PR, RP, RR
from burmester.io.reading.dyads_text import line_through
from burmester.numerics.arrays import FloatArray
from burmester.printable import printable
from burmester.synthesis.given_linkage import OpenLink
from burmester.values import shown

MOST_TEXT = 10_000  # characters of a sentence

LINE_KEYS = ({"point", "direction_deg"}, {"normal_deg", "offset"})


def dyad_of(tree: dict[str, Any], path: str, help: str) -> RR | PR | RP | OpenLink:
    """A dyad from its object; help: for an object that is none."""
    parts = {key for key in ("fixed_pivot", "moving_pivot", "line") if tree.get(key) is not None}
    kind = {
        frozenset({"fixed_pivot", "moving_pivot"}): "RR",
        frozenset({"line", "moving_pivot"}): "PR",
        frozenset({"fixed_pivot", "line"}): "RP",
    }.get(frozenset(parts))
    if kind is None or tree.get("kind", kind) != kind:
        has = ", ".join(sorted(parts)) or "neither pivot"
        stated = f" and is of kind {shown(tree['kind'])}" if "kind" in tree else ""
        raise fault(f"{path} is no dyad", help, f"it has {has}{stated}")
    if kind == "RR":
        fixed, moving = (pair(tree, key, path) for key in ("fixed_pivot", "moving_pivot"))
        lengths = [key for key in ("length", "radius") if tree.get(key) is not None]
        if not lengths:
            return OpenLink(fixed, moving)
        if len(lengths) > 1:
            raise fault(f"{path} has a length and a radius", "give the length alone")
        length = number(tree[lengths[0]], f"{path}.{lengths[0]}")
        if not length > 0:
            above = "give a length above zero, or leave it out: then it follows from the poses"
            raise fault(f"{path}.{lengths[0]} is {length:g}", above)
        return RR(fixed, moving, np.asarray(length))
    line = _line(tree["line"], f"{path}.line")
    if kind == "PR":
        return PR(*line, pair(tree, "moving_pivot", path))
    return RP(pair(tree, "fixed_pivot", path), *line)


def _line(tree: object, path: str) -> tuple[FloatArray, FloatArray]:
    """A line by its normal and offset, or by a point and its direction."""
    if isinstance(tree, dict):
        if LINE_KEYS[1] <= tree.keys():
            normal = number(tree["normal_deg"], f"{path}.normal_deg")
            offset = number(tree["offset"], f"{path}.offset")
            return np.asarray(math.radians(normal)), np.asarray(offset)
        if LINE_KEYS[0] <= tree.keys():
            direction = number(tree["direction_deg"], f"{path}.direction_deg")
            return line_through(pair(tree, "point", path), direction)
    help = "write line = {point = [X, Y], direction_deg = 30}"
    raise fault(f"{path} is no line", help, f"it is {shown(tree)}")


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


def text_of(given: Any) -> str | None:
    """A text of the file as a screen may show it."""
    return printable(given[:MOST_TEXT]) if isinstance(given, str) else None


def assumed_of(given: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """What the file says was assumed, each with the option that changes it."""
    every = given.get("assumed")
    texts = [
        (text_of(each.get("message")), text_of(each.get("option")) or "")
        for each in (every if isinstance(every, list) else ())
        if isinstance(each, dict)
    ]
    return tuple((message, option) for message, option in texts if message)
