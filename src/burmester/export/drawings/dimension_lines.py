"""Dimension lines of a flat part: distances of its holes, diameters, length and width; millimetres.

They are laid out once, in the plane, and DXF, SVG and PDF draw the same.  Text is never turned, and
keeps clear of the part, of other text and of other dimension lines as far as there is room.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations
from typing import Literal, Self, TypeAlias, final

import numpy as np

from burmester.export.parts.plate import Plate, moved, points_on
from burmester.geometry.displacement import Displacement
from burmester.geometry.shapes import distances
from burmester.numerics.arrays import FloatArray

LETTER_WIDTH = 0.68  # of the height of text: mean width of a letter, with room to spare
# All others are shares of the height of text.
ARROW = 0.8  # length of an arrow
ARROW_HALF_WIDTH = 0.15
OVERSHOOT = 0.5  # of an extension line beyond its dimension line
CLEAR = 0.35  # least distance of text from what it is not to touch
FIRST_LEVEL = 1.8  # of a dimension line from the part
LEVEL = 0.6  # step to the next level that is tried
LINES_APART = 1.2  # least distance of two dimension lines
OTHER_SIDE = 6.0  # by how much farther the part may reach on the other side, to draw a line there
LEVELS = 16  # levels that are tried, at most
LEADER_ANGLES = np.radians([45, 135, 60, 120, 75, 105, -45, -135, 20, 160, -20, -160])
STEEP = 0.26  # sine of the inclination from which text stands beside its line, not above
SAME_POINT = 1e-6  # of the part's size: distance below which there is nothing to measure
SAME_REACH = 1e-14  # of the part's size: corners that reach as far up to rounding

Kind = Literal["distance", "length", "width", "diameter"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class DimensionLine:
    """One dimension, millimetres.

    measured: (2, 2), the points whose distance it tells, along `lines[0]`; of a diameter both ends.
    lines: (k, 2, 2), the dimension line or leader first; arrows: (k, 3, 2), filled triangles.
    text stands around the point `at` (2,), letters (a height) tall; box: the corners (4, 2) of what
    it takes, counter-clockwise.  low, high: corners (2,) of the box around everything.
    """

    kind: Kind
    measured: FloatArray
    lines: FloatArray
    arrows: FloatArray
    text: str
    at: FloatArray
    letters: float
    box: FloatArray
    low: FloatArray
    high: FloatArray

    @property
    def value(self) -> float:
        """The measured length: along the dimension line, or the diameter."""
        way = self.lines[0, 1] - self.lines[0, 0]
        if self.kind == "diameter":
            way = self.measured[1] - self.measured[0]
        return float(abs((self.measured[1] - self.measured[0]) @ way) / np.linalg.norm(way))

    def shifted(self, way: FloatArray) -> Self:
        """The same, moved by (2,)."""
        points = ("measured", "lines", "arrows", "at", "box", "low", "high")
        return replace(self, **{name: getattr(self, name) + way for name in points})


Lines: TypeAlias = Sequence[DimensionLine]


def dimension_lines(
    plate: Plate, turn: float, letters: float, text: Callable[[float], str]
) -> list[DimensionLine]:
    """All dimension lines of a plate that is turned by an angle about its frame's origin.

    Distances of all holes, ends of slots and marks from each other, length and width of the whole,
    and the diameters of holes and ends of slots.  letters: height of text; text: how a length is
    written.
    """
    outline, holes, slots, marks = moved(plate, Displacement(np.zeros(2), np.array(turn)))
    corners = plate.skeleton @ [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
    shape = points_on(outline, 0.01 * plate.radius)
    layout = _Layout(shape, corners, plate.radius, letters, text)
    least = SAME_POINT * float(np.ptp(layout.shape, axis=0).max())
    centres, slot_ends = holes[:, :2], slots[:, :4].reshape(-1, 2, 2)
    features = [*centres[:, None], *slot_ends]
    for mark in marks:
        if all(np.linalg.norm(each - mark, axis=1).min() > least for each in features):
            features.append(mark[None])
    pairs = [(one[0], one[-1]) for one in features]
    pairs += [
        (start, end) for one, two in combinations(features, 2) for start in one for end in two
    ]
    lengths = [float(np.linalg.norm(end - start)) for start, end in pairs]
    for length, (start, end) in sorted(zip(lengths, pairs, strict=True), key=lambda each: each[0]):
        if length > least:
            layout.add(partial(layout.distance, start, end))
    layout.add(partial(layout.overall, "length"))
    layout.add(partial(layout.overall, "width"))
    for centre, diameter in zip(centres, holes[:, 2].tolist(), strict=True):
        layout.add(partial(layout.diameter, centre, diameter))
    for ends, width in zip(slot_ends, slots[:, 4].tolist(), strict=True):
        layout.add(partial(layout.diameter, ends[int(ends[:, 0].argmax())], width))
    return layout.settled()


class _Layout:
    """Dimension lines around a convex part, each where there is room beside the others.

    shape: (n, 2), the part; exactly it is all within `radius` of corners (m, 2).

    Each is a function from the others to the places where it may be drawn, the best ones first.
    """

    def __init__(
        self,
        shape: FloatArray,
        corners: FloatArray,
        radius: float,
        letters: float,
        text: Callable[[float], str],
    ) -> None:
        self.shape = shape
        self.corners = corners
        self.radius = radius
        self.letters = letters
        self.text = text
        self.choices = list[Callable[[Lines], Iterable[DimensionLine]]]()
        self.drawn = list[DimensionLine]()

    def add(self, choices: Callable[[Lines], Iterable[DimensionLine]]) -> None:
        """Draw one more beside those that are drawn."""
        self.drawn.append(self._best(choices, self.drawn))
        self.choices.append(choices)

    def settled(self) -> list[DimensionLine]:
        """All of them, once more with regard to those that came later."""
        for k, choices in enumerate(self.choices):
            others = self.drawn[:k] + self.drawn[k + 1 :]
            if self._conflicts(self.drawn[k], others):
                self.drawn[k] = self._best(choices, others)
        return self.drawn

    def _best(
        self, choices: Callable[[Lines], Iterable[DimensionLine]], others: Lines
    ) -> DimensionLine:
        """The first of some choices that is in nobody's way, or the one that is least."""
        found, least = None, math.inf
        for line in choices(others):
            conflicts = self._conflicts(line, others)
            if conflicts < least:
                found, least = line, conflicts
            if not conflicts:
                break
        assert found is not None
        return found

    def distance(
        self, start: FloatArray, end: FloatArray, others: Lines
    ) -> Iterable[DimensionLine]:
        """The distance of two points, on the side where the part reaches less far beyond them."""
        way = (end - start) / np.linalg.norm(end - start)
        sides = [np.array([-way[1], way[0]]), np.array([way[1], -way[0]])]
        sides.sort(key=lambda each: (round(float(each[1]), 9), -float(each[0])))
        reach = [float(((self.shape - start) @ side).max()) for side in sides]
        if reach[1] < reach[0] - SAME_POINT * self.letters:  # below where both are alike
            sides.reverse()
            reach.reverse()
        for side, beyond in zip(sides, reach, strict=True):
            if beyond > reach[0] + OTHER_SIDE * self.letters:
                return
            level = float(start @ side) + beyond + FIRST_LEVEL * self.letters
            for n in range(LEVELS):
                here = level + n * LEVEL * self.letters
                yield self._straight("distance", (start, end), side, here)

    def overall(self, kind: Literal["length", "width"], others: Lines) -> Iterable[DimensionLine]:
        """The size of the whole, beyond all that is drawn: below or above, or beside."""
        along, across = (0, 1) if kind == "length" else (1, 0)
        straight = [each for each in others if each.kind != "diameter"]
        ends = [self.shape, *(np.stack([each.low, each.high]) for each in straight)]
        every = np.concatenate(ends)
        for sign in (-1.0, 1.0) if kind == "length" else (1.0, -1.0):
            side = np.zeros(2)
            side[across] = sign
            axis = np.eye(2)[along]
            nearer, ends = self.corners @ side, []
            for way in (-1, 1):
                # Of two corners that reach as far, the one on the side of the dimension line.
                reach = way * (self.corners @ axis)
                as_far = reach >= reach.max() - SAME_REACH * float(np.ptp(self.corners))
                farthest = self.corners[int(np.where(as_far, nearer, -np.inf).argmax())]
                ends.append(farthest + way * self.radius * axis)
            first = float((every @ side).max()) + FIRST_LEVEL * self.letters
            yield self._straight(kind, (ends[0], ends[1]), side, first)

    def diameter(
        self, centre: FloatArray, diameter: float, others: Lines
    ) -> Iterable[DimensionLine]:
        """The diameter of a hole, told outside of the part at the end of a leader."""
        for n in range(LEVELS):
            for angle in LEADER_ANGLES:
                yield self._leader(centre, diameter, angle, (2 + LEVEL * n) * self.letters)

    def _straight(
        self, kind: Kind, measured: tuple[FloatArray, FloatArray], side: FloatArray, level: float
    ) -> DimensionLine:
        """The dimension line across `side`, a unit vector, at a level along it."""
        letters = self.letters
        ends = np.stack([point + side * (level - point @ side) for point in measured])
        way = ends[1] - ends[0]
        length = float(np.linalg.norm(way))
        way = way / length
        arrow, beyond, told = ARROW * letters, OVERSHOOT * letters, self.text(length)
        half = np.array([LETTER_WIDTH * len(told), 1.0]) * letters / 2
        fits = 2 * float(np.abs(way) @ half) < length - 2 * CLEAR * letters
        above = abs(way[1]) < STEEP and fits
        outwards = np.array([-way[1], way[0]]) * np.sign(way[0]) if above else side
        clear = (CLEAR + (0.0 if fits else OVERSHOOT)) * letters + float(np.abs(outwards) @ half)
        # An extension line begins at a centre, or near what it leaves.
        gap = 0.0 if kind == "distance" else CLEAR * letters
        lines = [ends] + [
            np.stack([point + gap * side, end + beyond * side])
            for point, end in zip(measured, ends, strict=True)
        ]
        inside = length > 3 * arrow
        tips = zip(ends, (way, -way) if inside else (-way, way), strict=True)
        arrows = [_arrow(tip, inwards, letters) for tip, inwards in tips]
        if not inside:
            lines[0] = np.stack([ends[0] - 2 * arrow * way, ends[1] + 2 * arrow * way])
        return _made(
            kind,
            np.stack(measured),
            np.stack(lines),
            np.stack(arrows),
            told,
            at=ends.mean(axis=0) + clear * outwards,
            letters=letters,
        )

    def _leader(
        self, centre: FloatArray, diameter: float, angle: float, length: float
    ) -> DimensionLine:
        """A diameter at the end of a leader of a length, away from the middle of the part."""
        told = f"Ø{self.text(diameter)}"
        u = np.array([np.cos(angle), np.sin(angle)])
        if u[0] * (centre[0] - self.shape[:, 0].mean()) < 0:
            u[0] = -u[0]
        right = np.array([np.sign(u[0]), 0.0])
        tip = centre + diameter / 2 * u
        elbow = tip + length * u
        shelf = elbow + 0.4 * self.letters * right
        half = (LETTER_WIDTH * len(told) / 2 + 0.2) * self.letters
        return _made(
            "diameter",
            np.stack([2 * centre - tip, tip]),
            np.stack([np.stack([tip, elbow]), np.stack([elbow, shelf])]),
            _arrow(tip, u, self.letters)[None],
            told,
            at=shelf + half * right,
            letters=self.letters,
        )

    def _conflicts(self, line: DimensionLine, others: Lines) -> int:
        """How much a dimension line is in the way of the part and of others: text counts most."""
        clear = CLEAR * line.letters
        count = 3 * _near(line.box, self.shape, clear)
        least = (LINES_APART + CLEAR) * line.letters
        for other in others:
            if max((line.low - other.high).max(), (other.low - line.high).max()) > least:
                continue
            count += 3 * _near(line.box, other.box, clear)
            count += any(_near(line.box, each, clear) for each in other.lines)
            count += any(_near(each, other.box, clear) for each in line.lines)
            count += _too_close(line, other)
        return count


def _made(
    kind: Kind,
    measured: FloatArray,
    lines: FloatArray,
    arrows: FloatArray,
    text: str,
    *,
    at: FloatArray,
    letters: float,
) -> DimensionLine:
    """A dimension line with its boxes."""
    half = np.array([LETTER_WIDTH * len(text), 1.0]) * letters / 2
    box = at + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    points = np.concatenate([lines.reshape(-1, 2), arrows.reshape(-1, 2), box])
    low, high = points.min(axis=0), points.max(axis=0)
    return DimensionLine(kind, measured, lines, arrows, text, at, letters, box, low, high)


def _too_close(line: DimensionLine, other: DimensionLine) -> bool:
    """Whether two dimension lines are in each other's way; a leader only where they cross."""
    leader = "diameter" in (line.kind, other.kind)
    least = SAME_POINT if leader else LINES_APART
    return _near(line.lines[0], other.lines[0], least * line.letters)


def _near(one: FloatArray, two: FloatArray, least: float) -> bool:
    """Whether convex shapes (n, 2) and (m, 2) are nearer than this; their boxes tell first."""
    gap = np.maximum(one.min(axis=0) - two.max(axis=0), two.min(axis=0) - one.max(axis=0))
    return bool(gap.max() < least and distances(one, two) < least)


def _arrow(tip: FloatArray, back: FloatArray, letters: float) -> FloatArray:
    """A triangle (3, 2) with its tip at a point, its body in the direction `back`."""
    foot = tip + ARROW * letters * back
    across = ARROW_HALF_WIDTH * letters * np.array([-back[1], back[0]])
    return np.stack([tip, foot + across, foot - across])
