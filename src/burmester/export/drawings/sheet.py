"""Plates laid out apart for cutting, beside the assembly: the sheet that DXF and SVG draw.

The assembly is where F has it, in millimetres; the plates lie in rows below it, each turned so that
it lies lengthwise, with its dimension lines.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final, final

import numpy as np

from burmester.describe.decimals import figures_of
from burmester.export.drawings.dimension_lines import LETTER_WIDTH, DimensionLine, dimension_lines
from burmester.export.options import Reference
from burmester.export.parts.plate import Plate, outline_points
from burmester.export.parts.plates import Assembly
from burmester.export.parts.stock import INCH, stock_for
from burmester.geometry.displacement import Displacement
from burmester.geometry.outlines import inner_point
from burmester.numerics.arrays import FloatArray
from burmester.tasks.length_units import MILLIMETRES
from burmester.tasks.motion_task import Task

ARC_TOLERANCE = 1e-3  # of the width: tolerance of arcs for the size of the sheet
PLATE_SPACING = 0.7  # of the width: space between plates
LETTER_HEIGHT = 0.35  # of the width: height of the text
FINEST = 1e-3  # of the text's height: what the last decimal of a dimension line is worth, at least


HATCH_SPACING: Final = 1.6  # of the text's height: between the lines of a hatch, at least
MOST_LINES: Final = 60  # of a hatch, about; over a large region they are farther apart


@final
@dataclass(frozen=True, slots=True, eq=False)
class Laid:
    """A plate where it is laid, with its dimension lines; millimetres.

    place: sheet <- plate; low, high: corners (2,) of the box around all; label: its name.
    """

    plate: Plate
    place: Displacement
    lines: tuple[DimensionLine, ...]
    low: FloatArray
    high: FloatArray
    label: str

    def shifted(self, way: FloatArray) -> Laid:
        """The same, moved by (2,)."""
        place = Displacement(self.place.translation + way, self.place.angle)
        lines = tuple(each.shifted(way) for each in self.lines)
        return Laid(self.plate, place, lines, self.low + way, self.high + way, self.label)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """Where everything is drawn, millimetres.

    parts: plates where they are laid; labels: where their names begin, (2,) each; low, high:
    corners (2,) of all; letters: the height of text; axes: the length of the axes that show a pose;
    decimals: of dimension lines.
    """

    parts: tuple[Laid, ...]
    labels: tuple[FloatArray, ...]
    low: FloatArray
    high: FloatArray
    letters: float
    axes: float
    notes: FloatArray
    decimals: int


def laid_lengthwise(
    assembly: Assembly, letters: float, decimals: int, dimensions: bool, unit: str = "mm"
) -> list[Laid]:
    """The plates of an assembly, each turned by 90° at most, so that its longest way is level.

    letters: height of text; dimensions: whether they have dimension lines; unit: of the lengths
    that these tell, with so many decimals.
    """
    decimals = shown_decimals(decimals, letters, unit)
    stock = stock_for(assembly.unit)

    def text(length: float) -> str:
        shown = _plain(length / MILLIMETRES[unit], decimals)
        if not stock.inches or (unit == "in" and not stock.has(length)):
            return shown
        own = f"{_plain(length / INCH, decimals + 1)} in"
        return f"{shown} [{stock.name(length) if stock.has(length) else own}]"

    laid = []
    for plate in assembly.plates:
        far = plate.longest_way
        turn = -math.atan(far[1] / far[0]) if far[0] else -math.pi / 2 * bool(far[1])
        place = Displacement(np.zeros(2), np.array(turn))
        lines = dimension_lines(plate, turn, letters, text) if dimensions else []
        box = [place.act(outline_points(plate, ARC_TOLERANCE * plate.radius))]
        box += [np.stack([each.low, each.high]) for each in lines]
        points = np.concatenate(box)
        joints = "".join(pin.name for pin in assembly.pins if plate.name in pin.joins)
        label = " ".join([plate.name, joints] if joints else [plate.name])
        label += f", layer {plate.layer}"
        laid.append(Laid(plate, place, tuple(lines), points.min(axis=0), points.max(axis=0), label))
    return laid


def shown_decimals(decimals: int, letters: float, unit: str = "mm") -> int:
    """The decimals of dimension lines: those that keep the linkage's error, or a workshop's."""
    return min(decimals, figures_of(FINEST * letters / MILLIMETRES[unit]))


def _plain(value: float, decimals: int) -> str:
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".") if decimals else text


def sheet_of(
    assembly: Assembly,
    outlines: Outlines,
    notes: int,
    decimals: int,
    *,
    dimensions: bool,
    unit: str,
) -> Sheet:
    """The layout of an assembly, what else is drawn about it, and a number of lines of notes.

    decimals, unit: of the lengths in dimension lines.
    """
    width = assembly.dimensions.width
    between, letters, axes = PLATE_SPACING * width, LETTER_HEIGHT * width, 0.8 * width
    points = [
        plate.at(assembly.drawn).act(outline_points(plate, ARC_TOLERANCE * width))
        for plate in assembly.plates
    ]
    ends = np.array([[0.0, 0.0], [axes, 0.0], [0.0, axes]])
    points += [assembly.reference.poses[:, None].act(ends).reshape(-1, 2), outlines.corners()]
    both = np.concatenate(points)
    low, high = both.min(axis=0), both.max(axis=0)
    high[0] += 2 * letters  # a pose's number stands to the right of it
    laid = laid_lengthwise(assembly, letters, decimals, dimensions, unit)
    widest = max(*(float(each.high[0] - each.low[0]) for each in laid), float(high[0] - low[0]))
    x, y, row = float(low[0]), float(low[1]) - 2 * between, 0.0
    start, right = x, float(high[0])
    parts, labels = [], []
    for each in laid:
        size = each.high - each.low
        if x > start and x + size[0] > start + widest * (1 + 1e-9):
            x, y, row = start, y - row - between, 0.0
        tall = float(size[1]) + 2 * letters
        parts.append(each.shifted(np.array([x, y - tall]) - each.low))
        labels.append(np.array([x, y - 1.2 * letters]))
        name = LETTER_WIDTH * len(each.label) * letters
        x, row = x + max(float(size[0]), name) + between, max(row, tall)
        right = max(right, x - between)
    y -= row + between
    bottom = np.array([start, y])
    low = np.array([start, y - notes * 1.6 * letters])
    high = np.array([max(right, start + 45 * letters), float(high[1])])
    names = outlines.names(letters)  # they may be long, and move nothing else
    low, high = np.vstack([low, names]).min(axis=0), np.vstack([high, names]).max(axis=0)
    return Sheet(
        tuple(parts),
        tuple(labels),
        low - between,
        high + between,
        letters,
        axes,
        bottom,
        shown_decimals(decimals, letters, unit),
    )


def beside(pose: Displacement, sheet: Sheet) -> FloatArray:
    """Where the number (2,) of a pose begins: behind its axes."""
    behind = pose.act(np.full(2, -0.8 * sheet.letters))
    return np.asarray(behind - np.array([0.3, 0.35]) * sheet.letters)


def joint_names(assembly: Assembly, sheet: Sheet) -> list[tuple[str, FloatArray]]:
    """The names of joints, and where (2,) they begin in the assembly: beside their holes."""
    names = []
    for pin in assembly.pins:
        plate = assembly.plate(pin.plate)
        assert plate is not None
        if pin.name:
            at = plate.at(assembly.drawn).act(np.array([pin.x, pin.y]))
            names.append((pin.name, at + assembly.dimensions.hole / 2 + 0.1 * sheet.letters))
    return names


def notes_on(assembly: Assembly) -> list[str]:
    """Sentences on how the plates are made and put together."""
    made, name = assembly.dimensions, stock_for(assembly.unit).name
    notes = [
        f"Holes {name(made.hole)}, pins {name(made.pin)}, links {name(made.width)} wide, plates "
        f"{name(made.thickness)} thick, {name(made.gap)} apart."
    ]
    if assembly.assumed:
        notes.append(
            "They follow the linkage's size. With --length-unit they are sizes of drills, bars and "
            "sheets."
        )
    if assembly.plate("ground-2") is not None:
        notes.append(
            "Nothing moves of ground and ground-2: fix them to each other, out of the links' way, "
            "as the assembly has them."
        )
    return [*notes, f"The assembly is drawn at pose {assembly.pose + 1}."]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Outlines:
    """Outlines in millimetres: body: (N, n, 2), at the place for each pose, n = 0 without one.

    regions: their names, which may be empty, and their corners (k, 2).
    """

    body: FloatArray
    regions: tuple[tuple[str, FloatArray], ...]

    @classmethod
    def of(cls, task: Task, reference: Reference) -> Outlines:
        """Those of a task, at the places of its linkage."""
        corners = np.empty((0, 2)) if task.body is None else task.body.vertices * reference.scale
        around = () if task.surroundings is None else task.surroundings.keep_out
        regions = ((each.name or "", each.polygon.vertices * reference.scale) for each in around)
        return cls(reference.places[:, None].act(corners), tuple(regions))

    def corners(self) -> FloatArray:
        """All corners (k, 2)."""
        return np.concatenate([self.body.reshape(-1, 2), *(each for _, each in self.regions)])

    def names(self, letters: float) -> FloatArray:
        """Where names begin and end (k, 2), in letters of that height."""
        ends = []
        for name, corners in self.regions:
            start = name_start(name, corners, letters)
            across = np.array([LETTER_WIDTH * len(name) * letters, letters])
            ends += [start, start + across]
        return np.reshape(ends, (-1, 2))


def name_start(name: str, corners: FloatArray, letters: float) -> FloatArray:
    """Where a region's name begins (2,), so that its middle is inside the region."""
    half = np.array([LETTER_WIDTH * len(name) * letters, letters]) / 2
    return np.asarray(inner_point(corners) - half)


def hatch(corners: FloatArray, letters: float) -> FloatArray:
    """The lines (m, 2, 2) of a hatch at 45 degrees inside a polygon (k, 2), convex or not."""
    across = np.array([-1.0, 1.0]) / np.sqrt(2)
    along = np.array([1.0, 1.0]) / np.sqrt(2)
    height, place = corners @ across, corners @ along
    low, high = float(height.min()), float(height.max())
    spacing = max(HATCH_SPACING * letters, (high - low) / MOST_LINES)
    lines = []
    for level in np.arange(low + spacing / 2, high, spacing).tolist():
        # Where the level crosses the edges; between an odd crossing and the next it is inside.
        after, beyond = np.roll(height, -1), np.roll(place, -1)
        crossed = (height > level) != (after > level)
        share = (level - height[crossed]) / (after[crossed] - height[crossed])
        at = np.sort(place[crossed] + share * (beyond[crossed] - place[crossed])).reshape(-1, 2)
        lines += [level * across + ends[:, None] * along for ends in at]
    return np.array(lines).reshape(-1, 2, 2)
