"""A linkage in a few lines of braille, for a terminal: a glance, not a drawing.

The linkage stands at its first pose, and in dots at its last one.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.numerics.arrays import FloatArray
from burmester.verdicts.found_linkage import FoundLinkage

__all__ = ["MOST_ROWS", "sketch"]

MOST_ROWS = 14  # lines of the sketch
FAR = 3.0  # sizes of the motion; pivots farther from its middle are outside the sketch
WIDE, HIGH = 2, 4  # dots of a character
# The bit of each dot of a braille character, by row and column.
BITS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
FIXED, MOVING, BLOCK = "▲", "●", "■"  # a pivot on the ground, one on the body, a slider's block
SPARSE = 3  # dots; of the linkage at its last pose one in so many is drawn


def sketch(found: FoundLinkage, columns: int) -> list[str] | None:
    """A linkage in lines of at most `columns` characters; None where it is nowhere near the poses.

    1 and the last pose's number stand at the origin of the body, where they have room.
    """
    places = found.error.places
    reached = np.flatnonzero(np.isfinite(places.angle))
    if not len(reached):
        return None
    first, last = int(reached[0]), int(reached[-1])
    ways = {k: [_shape(each.dyad, found, k) for each in found.dyads] for k in (last, first)}
    origins = places.translation[reached]
    middle = (origins.min(axis=0) + origins.max(axis=0)) / 2
    joints = [joint for shapes in ways.values() for shape in shapes for joint in shape]
    size = float(np.ptp(origins, axis=0).max()) or float(
        max((np.abs(joint - middle).max() for joint in joints), default=1.0)
    )
    near = [each for each in joints if np.abs(each - middle).max() <= FAR * size]
    canvas = _Canvas.around(np.array([*origins, *near]), columns)
    for k, shapes in ways.items():
        body = [shape[-1] for shape in shapes]
        lines = [(shape[a], shape[a + 1]) for shape in shapes for a in range(len(shape) - 1)]
        triangle = [*body, places.translation[k]]
        lines += [(triangle[a - 1], triangle[a]) for a in range(3)]
        for line in lines:
            canvas.draw(*line, every=1 if k == first else SPARSE)
    for k in dict.fromkeys((first, last)):
        canvas.put(places.translation[k], str(k + 1))
    for each, shape in zip(found.dyads, ways[first], strict=True):
        if isinstance(each.dyad, RR | RP):
            canvas.put(shape[0], FIXED)
        if isinstance(each.dyad, RR | PR):
            canvas.put(shape[-1], BLOCK if isinstance(each.dyad, PR) else MOVING)
    return canvas.lines()


def _shape(dyad: Dyad, found: FoundLinkage, pose: int) -> list[FloatArray]:
    """The points of a dyad from the ground to the body, as lines join them, on the ground.

    A rail is drawn along its travel and back to the block; a slot from the pin to its middle.
    """
    places = found.error.places
    here = places[pose]
    match dyad:
        case RR():
            return [dyad.fixed_pivot, here.act(dyad.moving_pivot)]
        case PR():
            points = places.act(dyad.moving_pivot)
            points = points[np.isfinite(points).all(axis=-1)]
            ahead = np.array([-math.sin(dyad.normal_angle), math.cos(dyad.normal_angle)])
            along = points @ ahead
            return [points[along.argmin()], points[along.argmax()], here.act(dyad.moving_pivot)]
        case RP():
            return [dyad.fixed_pivot, here.act(dyad.middle_of_travel(places))]
    return [here.translation]


class _Canvas:
    """Dots in a grid, with characters over them."""

    def __init__(self, low: FloatArray, dot: float, columns: int, rows: int) -> None:
        self.low, self.dot = low, dot
        self.bits = np.zeros((rows, columns), dtype=np.int64)
        self.over: dict[tuple[int, int], str] = {}

    @classmethod
    def around(cls, points: FloatArray, columns: int) -> _Canvas:
        """A canvas for these points (n, 2), in all of its columns or all of its rows."""
        low, high = points.min(axis=0), points.max(axis=0)
        extent = np.maximum(high - low, 1e-3 * float((high - low).max()) or 1.0)
        room = np.array([WIDE * (columns - 1), HIGH * (MOST_ROWS - 1)])
        dot = float((extent / room).max())
        across, up = (int(each) for each in np.floor(extent / dot + 0.5))
        return cls(low, dot, across // WIDE + 1, up // HIGH + 1)

    def _dots(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Dots from the left and from the top of points (*, 2)."""
        at = np.floor((points - self.low) / self.dot + 0.5)
        return at[..., 0], HIGH * len(self.bits) - 1 - at[..., 1]

    def draw(self, start: FloatArray, end: FloatArray, every: int) -> None:
        """A straight line, one in `every` dots of it, as far as it is inside."""
        count = int(min(np.abs(end - start).max() / self.dot + 1, 1e5))
        share = np.linspace(0, 1, count + 1)[::every, None]
        for x, y in np.column_stack(self._dots(start + share * (end - start))).tolist():
            row, column = int(y // HIGH), int(x // WIDE)
            if 0 <= row < self.bits.shape[0] and 0 <= column < self.bits.shape[1]:
                self.bits[row, column] |= BITS[int(y % HIGH)][int(x % WIDE)]

    def put(self, point: FloatArray, text: str) -> None:
        """Characters at a point, unless it is outside."""
        x, y = self._dots(point)
        row, column = int(y // HIGH), int(x // WIDE)
        if not (0 <= row < self.bits.shape[0] and 0 <= column < self.bits.shape[1]):
            return
        column = max(0, min(column, self.bits.shape[1] - len(text)))
        beside = (self.over.get((row, column + k), "") for k in range(-1, len(text) + 1))
        if not (text.isdigit() and any(each.isdigit() for each in beside)):
            self.over |= {(row, column + k): char for k, char in enumerate(text)}

    def lines(self) -> list[str]:
        """The characters, line by line, without blanks at the ends."""
        return ["".join(self._row(row)).rstrip() for row in range(len(self.bits))]

    def _row(self, row: int) -> Iterable[str]:
        for column, bits in enumerate(self.bits[row].tolist()):
            yield self.over.get((row, column)) or (chr(0x2800 + bits) if bits else " ")
