"""Collisions of solid parts along the motion; millimetres."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from burmester.export.parts.plates import Assembly

TOUCHING_VOLUME: Final = 1e-6  # of a hole's volume: common volume up to which parts only touch
SAME_HEIGHT: Final = 1e-6  # mm: heights closer than this are equal
PLACES: Final = 12  # places along the motion at which parts are compared


def collision(cad: Any, read: dict[str, Any], made: Assembly) -> tuple[str, str] | None:
    """Two parts that overlap somewhere along the motion, if there are any."""
    heights = {name: (box.min.Z, box.max.Z) for name, box in _boxes(read).items()}
    least = TOUCHING_VOLUME * made.dimensions.hole**2 * made.dimensions.thickness
    names = list(read)
    pairs = [
        (one, two)
        for k, two in enumerate(names)
        for one in names[:k]
        if max(heights[one][0], heights[two][0])
        < min(heights[one][1], heights[two][1]) - SAME_HEIGHT
    ]
    carriers = {plate.name: plate for plate in made.plates}
    pins = {f"pin-{k}": carriers[pin.plate] for k, pin in enumerate(made.pins, start=1)}
    carriers |= pins
    ways = np.linspace(0, made.motion.shape[0] - 1, PLACES).astype(np.intp)
    for place in [made.drawn, *(made.motion[k] for k in ways)]:
        there = {}
        for name, shape in read.items():
            move = carriers[name].at(place) @ carriers[name].at(made.drawn).inverse()
            x, y = move.translation.tolist()
            there[name] = shape.moved(cad.Location((x, y, 0), (0, 0, math.degrees(move.angle))))
        boxes = _boxes(there)
        for one, two in pairs:
            a, b = boxes[one], boxes[two]
            if max(a.min.X - b.max.X, b.min.X - a.max.X, a.min.Y - b.max.Y, b.min.Y - a.max.Y) > 0:
                continue
            common = there[one].intersect(there[two])
            if common is not None and sum(each.volume for each in _listed(common)) > least:
                return one, two
    return None


def _boxes(shapes: dict[str, Any]) -> dict[str, Any]:
    return {name: shape.bounding_box() for name, shape in shapes.items()}


def _listed(shape: Any) -> list[Any]:
    return list(shape) if isinstance(shape, list) else [shape]
