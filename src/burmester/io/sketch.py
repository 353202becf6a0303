"""A linkage in a few lines of braille, for a terminal: a glance, not a drawing.

The linkage stands at its first pose, and in dots at its last one.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import numpy as np

from burmester.numerics.arrays import FloatArray
from burmester.scene.linkage_scene import scene_at
from burmester.verdicts.found_linkage import FoundLinkage

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
    origins = places.translation[reached]
    scenes = {k: scene_at(found, k) for k in (last, first)}
    middle = (origins.min(axis=0) + origins.max(axis=0)) / 2
    joints = [pivot.at for scene in scenes.values() for pivot in scene.pivots]
    size = float(np.ptp(origins, axis=0).max()) or float(
        max((np.abs(joint - middle).max() for joint in joints), default=1.0)
    )
    near = [each for each in joints if np.abs(each - middle).max() <= FAR * size]
    canvas = _Canvas.around(np.array([*origins, *near]), columns)
    for k, scene in scenes.items():
        for role, points in scene.shapes:
            if role in ("spring", "hand"):
                continue
            ends = np.vstack([points, points[:1]]) if role == "body" else points
            for line in pairwise(ends):
                canvas.draw(*line, every=1 if k == first else SPARSE)
    for k in dict.fromkeys((first, last)):
        canvas.put(places.translation[k], str(k + 1))
    for pivot in scenes[first].pivots:
        moving = MOVING if pivot.block is None else BLOCK
        canvas.put(pivot.at, FIXED if pivot.fixed else moving)
    return canvas.lines()


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
