"""Dimension lines as a drawing that is read back has them, compared with the plates that it has.

E160 the file does not contain the linkage
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from burmester.export.options import MILLIMETRES
from burmester.export.parts.plate import Plate, moved
from burmester.export.reference import require_equal
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["Measured", "require_dimensions", "require_drawn"]


class Measured(NamedTuple):
    """A dimension line that was read: the ends (2, 2) of what it measures, and what it tells.

    value: what its entity says that it measures, or the numbers of its lines; text: what is shown;
    diameter: whether it is one, not a length.
    """

    ends: FloatArray
    value: float
    text: str
    diameter: bool


def require_dimensions(
    placed: Iterable[tuple[Plate, Displacement]],
    read: Sequence[Measured],
    tolerance: float,
    unit: str = "mm",
) -> None:
    """Compare dimension lines with plates and their places on the sheet; raises E160.

    Every two holes of a plate have their distance, every hole its diameter, every plate its length
    and its width; and there is no dimension line but of these, of ends of slots and of marks.  Text
    is the value in the unit, rounded.
    """
    lengths = [each for each in read if not each.diameter]
    diameters = [each for each in read if each.diameter]
    centres, points, boxes = np.empty((0, 3)), np.empty((0, 2)), list[FloatArray]()
    for plate, by in placed:
        _, holes, slots, marks = moved(plate, by)
        ends = np.concatenate([slots[:, [0, 1, 4]], slots[:, [2, 3, 4]]])
        centres = np.concatenate([centres, holes, ends])
        points = np.concatenate([points, holes[:, :2], ends[:, :2], marks])
        for pair in combinations(holes[:, :2], 2):
            gap = min((_apart(each, np.stack(pair)) for each in lengths), default=np.inf)
            require_equal(f"a distance of {plate.name}", gap, 0, tolerance)
        for hole in holes:
            gap = min((_off_centre(each, hole[None]) for each in diameters), default=np.inf)
            require_equal(f"a diameter of {plate.name}", gap, 0, tolerance)
        corners = by.act(plate.skeleton)
        box = [corners.min(axis=0) - plate.radius, corners.max(axis=0) + plate.radius]
        boxes.append(np.stack(box))
        for axis, what in enumerate(("length", "width")):
            gap = min((_off_box(each, boxes[-1], axis) for each in lengths), default=np.inf)
            require_equal(f"the {what} of {plate.name}", gap, 0, tolerance)
    for each in read:
        if each.diameter:
            gap = _off_centre(each, centres)
        else:
            gap = float(np.linalg.norm(each.ends[:, None] - points, axis=-1).min(axis=1).max())
            gap = max(gap, abs(each.value - float(np.linalg.norm(each.ends[1] - each.ends[0]))))
            own = [_off_box(each, box, axis) for box in boxes for axis in (0, 1)]
            gap = min(gap, *own)
        require_equal("what a dimension line measures", gap, 0, tolerance)
        shown = each.text.partition(" [")[0].removeprefix("Ø")
        half = 0.5 * 10.0 ** -len(shown.partition(".")[2])
        value = each.value / MILLIMETRES[unit]
        require_equal(f"the text {each.text}", float(shown), value, half * (1 + 1e-6))


def require_drawn(lines: FloatArray, ends: FloatArray, diameter: bool, tolerance: float) -> None:
    """Compare the lines (k, 2, 2) of a dimension with the points that it measures; raises E160.

    The dimension line comes first, then its extension lines, or the leader and its shelf.
    """
    if diameter:
        leader, shelf = lines
        off = [_aside(leader, ends.mean(axis=0)), np.abs(leader[1] - shelf[0]).max()]
        off.append(abs(shelf[1, 1] - shelf[0, 1]))
    else:
        line, *extensions = lines
        way = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
        feet = [line[0] + way * float((each[0] - line[0]) @ way) for each in extensions]
        beyond = [
            float(np.linalg.norm(each[1] - foot))
            for each, foot in zip(extensions, feet, strict=True)
        ]
        longer = [float((feet[0] - line[0]) @ way), float((line[1] - feet[1]) @ way)]
        off = [_aside(each, end) for each, end in zip(extensions, ends, strict=True)]
        off += [float((each[1] - each[0]) @ way) for each in extensions]
        off += [beyond[1] - beyond[0], longer[1] - longer[0]]
    require_equal("how a dimension is drawn", off, np.zeros(len(off)), 10 * tolerance)


def _aside(line: FloatArray, point: FloatArray) -> float:
    """How far a point is from the line through two points (2, 2)."""
    (x, y), (u, v) = line[1] - line[0], point - line[0]
    return float((x * v - y * u) / np.hypot(x, y))


def _apart(read: Measured, ends: FloatArray) -> float:
    """The larger distance of the ends that were read from two points, in their better order."""
    both = (read.ends, read.ends[::-1])
    return min(float(np.linalg.norm(each - ends, axis=1).max()) for each in both)


def _off_centre(read: Measured, circles: FloatArray) -> float:
    """How far a diameter is from that of the nearest of circles (n, 3), and from its centre."""
    middle = read.ends.mean(axis=0)
    drawn = float(np.linalg.norm(read.ends[1] - read.ends[0]))
    off = np.abs(circles - [*middle, read.value]).max(axis=1).min(initial=np.inf)
    return max(float(off), abs(drawn - read.value))


def _off_box(read: Measured, box: FloatArray, axis: int) -> float:
    """How far a length is from that of a box (2, 2), low and high, along an axis."""
    ends = np.sort(read.ends[:, axis])
    off = float(np.abs(ends - box[:, axis]).max())
    return max(off, abs(read.value - float(ends[1] - ends[0])))
