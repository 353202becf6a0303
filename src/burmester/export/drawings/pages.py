"""Plates at 1:1 on pages of paper: A4, or Letter for tasks in inches and feet; millimetres.

Plates lie in rows, as many on a page as it holds.  One that is larger than a page goes on a grid of
pages of its own, which overlap; crosses in the overlap are at the same place of the plate on both.

E162 more pages than anybody prints
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, final

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.drawings.sheet import Laid, laid_lengthwise
from burmester.export.parts.plate import outline_points
from burmester.export.parts.plates import Assembly
from burmester.export.parts.stock import INCH, stock_for
from burmester.geometry.shapes import distances
from burmester.numerics.arrays import FloatArray

PAPERS: Final = {  # by whether the task's lengths are in inches or feet: width and height, mm
    False: ("A4", (210.0, 297.0)),
    True: ("Letter", (8.5 * INCH, 11 * INCH)),
}
MARGIN: Final = 12.0  # mm: on all sides; printers leave up to 6.4 mm white
HEAD: Final = 22.0  # mm: of the title, five lines
FOOT: Final = 13.0  # mm: of the ruler
LETTERS: Final = 2.5  # mm: height of text, the least of ISO 3098 that copies well
SPACING: Final = 6.0  # mm: between plates
OVERLAP: Final = 15.0  # mm: of pages that are put together
MOST_PAGES: Final = 60
SHARES: Final = (0.25, 0.75)  # of a side: where its two crosses are


@final
@dataclass(frozen=True, slots=True, eq=False)
class Page:
    """A page, in millimetres from its lower left corner.

    parts: plates where they are on it; labels: where their names begin; title: what it holds.
    tiled: whether it is one of a grid; marks: (m, 2), crosses that it shares with its neighbours.
    """

    parts: tuple[Laid, ...]
    labels: tuple[FloatArray, ...]
    title: str
    tiled: bool
    marks: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class Pages:
    """All pages: the name of the paper, its size (width, height), and where plates may be drawn.

    ruler: the length (mm) of the ruler on each page, its divisions and its name.
    """

    paper: str
    size: tuple[float, float]
    low: FloatArray
    high: FloatArray
    ruler: tuple[float, int, str]
    pages: tuple[Page, ...]


def pages_of(assembly: Assembly, decimals: int, dimensions: bool) -> Pages:
    """The pages of an assembly, upright or lying, whichever are fewer; raises E162."""
    inches = stock_for(assembly.unit).inches
    name, (width, height) = PAPERS[inches]
    laid = laid_lengthwise(assembly, LETTERS, decimals, dimensions)
    best: Pages | None = None
    for size in ((width, height), (height, width)):
        low = np.array([MARGIN, MARGIN + FOOT])
        high = np.array([size[0] - MARGIN, size[1] - MARGIN - HEAD])
        if sum(math.prod(_grid(each, high - low)) for each in laid) > MOST_PAGES:
            continue
        pages = tuple(_pages(laid, low, high))
        if best is None or len(pages) < len(best.pages):
            ruler = (4 * INCH, 16, "4 in") if inches else (100.0, 20, "100 mm")
            best = Pages(name, size, low, high, ruler, pages)
    if best is None:
        raise InputError(
            "E162",
            f"at 1:1 the plates take more than {MOST_PAGES} pages of {name}",
            why="the longest is "
            f"{max(float(each.high[0] - each.low[0]) for each in laid) / 1000:.3g} m long",
            help=Help.of("write a drawing instead: {}", Cure("to", "dxf")),
        )
    return best


def _grid(laid: Laid, room: FloatArray) -> tuple[int, int]:
    """On how many pages (columns, rows) a plate with its name goes."""
    size = laid.high - laid.low + [0, 2 * LETTERS]
    if (size <= room).all():
        return 1, 1
    columns, rows = np.ceil((size - OVERLAP) / (room - OVERLAP)).astype(int)
    return max(int(columns), 1), max(int(rows), 1)


def _pages(laid: list[Laid], low: FloatArray, high: FloatArray) -> Iterator[Page]:
    room = high - low
    small = [each for each in laid if _grid(each, room) == (1, 1)]
    yield from _rows(small, low, high)
    for each in laid:
        if _grid(each, room) != (1, 1):
            yield from _tiles(each, low, high)


def _rows(laid: list[Laid], low: FloatArray, high: FloatArray) -> Iterator[Page]:
    """Plates in rows from the top of a page, the next page where there is no room left."""
    parts, labels = list[Laid](), list[FloatArray]()
    x, y, row = float(low[0]), float(high[1]), 0.0
    for each in laid:
        wide, tall = (each.high - each.low + [0, 2 * LETTERS]).tolist()
        if x > low[0] and x + wide > high[0]:
            x, y, row = float(low[0]), y - row - SPACING, 0.0
        if parts and y - max(row, tall) < low[1]:
            yield _page(parts, labels)
            parts, labels = [], []
            x, y, row = float(low[0]), float(high[1]), 0.0
        parts.append(each.shifted(np.array([x, y - tall]) - each.low))
        labels.append(np.array([x, y - LETTERS]))
        x, row = x + max(wide, 0.7 * LETTERS * len(each.label)) + SPACING, max(row, tall)
    if parts:
        yield _page(parts, labels)


def _page(parts: list[Laid], labels: list[FloatArray]) -> Page:
    title = ", ".join(each.plate.name for each in parts)
    return Page(tuple(parts), tuple(labels), title, False, np.empty((0, 2)))


def _tiles(laid: Laid, low: FloatArray, high: FloatArray) -> Iterator[Page]:
    """A plate on a grid of pages, row by row from the top; pages without any of it are left out."""
    room = high - low
    columns, rows = _grid(laid, room)
    size = laid.high - laid.low + [0, 2 * LETTERS]
    whole = room * [columns, rows] - OVERLAP * np.array([columns - 1, rows - 1])
    # In the middle of the grid.
    part = laid.shifted(low - laid.low + (whole - size) / 2)
    label = np.array([part.low[0], part.high[1] + LETTERS])
    step = room - OVERLAP
    shapes = [part.place.act(outline_points(part.plate, 0.01 * part.plate.radius))]
    shapes += [each for line in part.lines for each in (line.box, *line.lines)]
    for row in reversed(range(rows)):
        for column in range(columns):
            corner = low + step * [column, row]
            page = corner + room * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
            if not any(distances(page, each) <= 0 for each in shapes):
                continue
            shift = low - corner
            sides = (column > 0, column < columns - 1, row > 0, row < rows - 1)
            yield Page(
                (part.shifted(shift),),
                (label + shift,),
                f"{laid.plate.name}, column {column + 1} of {columns}, row {rows - row} of {rows}",
                True,
                low + _crosses(room, sides),
            )


def _crosses(room: FloatArray, sides: tuple[bool, bool, bool, bool]) -> FloatArray:
    """Two crosses (n, 2) at each side, left, right, below and above, that has a neighbour."""
    (width, height), half = room.tolist(), OVERLAP / 2
    upright = [[(x, share * height) for share in SHARES] for x in (half, width - half)]
    level = [[(share * width, y) for share in SHARES] for y in (half, height - half)]
    pairs = zip(upright + level, sides, strict=True)
    return np.array([pair for pair, has in pairs if has]).reshape(-1, 2)
