"""Plates laid out apart for cutting, beside the assembly: the sheet that DXF and SVG draw.

The assembly is where F has it, in millimetres; the plates lie in rows below it, each moved
without being turned.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.export.plates import Assembly, Plate, outline_points
from burmester.export.stock import stock_for
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["Sheet", "beside", "moved", "notes_on", "sheet_of"]

ARC_TOLERANCE = 1e-3  # of the width: tolerance of arcs for the size of the sheet
PLATE_SPACING = 0.7  # of the width: space between plates
LETTER_HEIGHT = 0.35  # of the width: height of the text


@final
@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """Where everything is drawn, millimetres.

    parts: plates with the ways (2,) that they are moved from their own frames; labels: where
    their names begin, (2,) each; low, high: corners (2,) of all; letters: the height of text;
    axes: the length of the axes that show a pose.
    """

    parts: tuple[tuple[Plate, FloatArray], ...]
    labels: tuple[FloatArray, ...]
    low: FloatArray
    high: FloatArray
    letters: float
    axes: float
    notes: FloatArray


def sheet_of(assembly: Assembly, poses: Displacement, notes: int) -> Sheet:
    """The layout of an assembly, poses (N,) in millimetres, and a number of lines of notes."""
    width = assembly.dimensions.width
    between, letters, axes = PLATE_SPACING * width, LETTER_HEIGHT * width, 0.8 * width
    points = [
        plate.at(assembly.drawn).act(outline_points(plate, ARC_TOLERANCE * width))
        for plate in assembly.plates
    ]
    ends = np.array([[0.0, 0.0], [axes, 0.0], [0.0, axes]])
    points.append(poses[:, None].act(ends).reshape(-1, 2))
    both = np.concatenate(points)
    low, high = both.min(axis=0), both.max(axis=0)
    high[0] += 2 * letters  # a pose's number stands to the right of it
    boxes = [outline_points(plate, ARC_TOLERANCE * width) for plate in assembly.plates]
    widest = max(*(float(np.ptp(box[:, 0])) for box in boxes), float(high[0] - low[0]))
    x, y, row = float(low[0]), float(low[1]) - 2 * between, 0.0
    start, right = x, float(high[0])
    parts, labels = [], []
    for plate, box in zip(assembly.plates, boxes, strict=True):
        size = np.ptp(box, axis=0)
        if x > start and x + size[0] > start + widest * (1 + 1e-9):
            x, y, row = start, y - row - between, 0.0
        tall = float(size[1]) + 2 * letters
        shift = np.array([x, y - tall]) - box.min(axis=0)
        parts.append((plate, shift))
        labels.append(np.array([x, y - 1.2 * letters]))
        x, row = x + max(float(size[0]), 12 * letters) + between, max(row, tall)
        right = max(right, x - between)
    y -= row + between
    bottom = np.array([start, y])
    low = np.array([start, y - notes * 1.6 * letters])
    return Sheet(
        tuple(parts),
        tuple(labels),
        low - between,
        np.array([max(right, start + 45 * letters), float(high[1])]) + between,
        letters,
        axes,
        bottom,
    )


def moved(plate: Plate, by: Displacement) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The outline, holes, slots and marks of a plate, carried by a displacement."""
    outline = np.column_stack([by.act(plate.outline[:, :2]), plate.outline[:, 2]])
    holes = np.column_stack([by.act(plate.holes[:, :2]), plate.holes[:, 2]])
    slots = np.column_stack(
        [by.act(plate.slots[:, :2]), by.act(plate.slots[:, 2:4]), plate.slots[:, 4]]
    )
    return outline, holes, slots, by.act(plate.marks)


def beside(pose: Displacement, sheet: Sheet) -> FloatArray:
    """Where the number (2,) of a pose begins: behind its axes."""
    behind = pose.act(np.full(2, -0.8 * sheet.letters))
    return np.asarray(behind - np.array([0.3, 0.35]) * sheet.letters)


def notes_on(assembly: Assembly) -> list[str]:
    """Sentences on how the plates are made and put together."""
    made, name = assembly.dimensions, stock_for(assembly.unit).name
    notes = [
        f"Holes {name(made.hole)}, pins {name(made.pin)}, links {name(made.width)} wide, plates "
        f"{name(made.thickness)} thick, {name(made.gap)} apart."
    ]
    if assembly.assumed:
        notes.append(
            "They follow the linkage's size. With --unit they are sizes of drills, bars and sheets."
        )
    if assembly.plate("ground-2") is not None:
        notes.append(
            "Nothing moves of ground and ground-2: fix them to each other, out of the links' way, "
            "as the assembly has them."
        )
    return [*notes, f"The assembly is drawn at pose {assembly.pose + 1}."]
