"""The paths on the pages of a PDF that Matplotlib has written, read back.

Only what such a file holds: pages in one list, one compressed stream of content each, and in it
lines and cubic curves under transformations.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final, final

import numpy as np

from burmester.numerics.arrays import FloatArray

POINT: Final = 25.4 / 72  # mm
TOKEN: Final = re.compile(rb"\((?:\\.|[^\\)])*\)|<[^>]*>|\[|\]|/[^\s/<>\[\]()]+|[^\s/<>\[\]()]+")


@final
@dataclass(frozen=True, slots=True, eq=False)
class PagePaths:
    """What is drawn on a page, millimetres from its lower left corner.

    size: (2,), of the page; lines: (n, 2, 2), paths of one straight line; circles: (m, 3), x, y and
    diameter of closed paths of curves only; outlines: (k, 2) each, the corners and ends of curves
    of other closed paths.
    """

    size: FloatArray
    lines: FloatArray
    circles: FloatArray
    outlines: tuple[FloatArray, ...]


def read_pages(path: Path) -> list[PagePaths]:
    """The pages of a file; raises ValueError where it is not one of those described above."""
    try:
        return _pages(path.read_bytes())
    except (LookupError, zlib.error) as error:
        raise ValueError(f"its pages cannot be read: {error}") from None


def _pages(data: bytes) -> list[PagePaths]:
    objects = {
        int(match[1]): match[2]
        for match in re.finditer(rb"(?:^|\n)(\d+) 0 obj\n(.*?)\nendobj", data, re.DOTALL)
    }
    lists = [each for each in objects.values() if re.search(rb"/Type /Pages\b", each)]
    if len(lists) != 1:
        raise ValueError(f"the file has {len(lists)} lists of pages")
    kids = re.search(rb"/Kids \[([^\]]*)\]", lists[0])
    pages = []
    for number in re.findall(rb"(\d+) 0 R", kids[1] if kids else b""):
        page = objects[int(number)]
        content, box = re.search(rb"/Contents (\d+) 0 R", page), _box(page)
        if content is None:
            raise ValueError("a page has no content")
        stream = objects[int(content[1])].partition(b"stream\n")[2].rpartition(b"\nendstream")[0]
        pages.append(_paths(zlib.decompress(stream), box))
    return pages


def _box(page: bytes) -> FloatArray:
    """The size (2,) of a page in points."""
    found = re.search(rb"/MediaBox \[([^\]]*)\]", page)
    numbers = [float(each) for each in found[1].split()] if found else []
    if len(numbers) != 4 or numbers[:2] != [0, 0]:
        raise ValueError("a page has no size")
    return np.array(numbers[2:])


def _paths(content: bytes, size: FloatArray) -> PagePaths:
    lines, circles, outlines = list[FloatArray](), list[FloatArray](), list[FloatArray]()
    for points, curved, closed in _subpaths(content):
        rows = np.array(points) * POINT
        if len(rows) == 2 and not any(curved):
            lines.append(rows)
        elif closed and len(curved) >= 4 and all(curved):
            centre = (rows.min(axis=0) + rows.max(axis=0)) / 2
            radius = np.linalg.norm(rows - centre, axis=1)
            circles.append(np.array([*centre, radius.min() + radius.max()]))
        elif closed and any(curved):
            outlines.append(rows)
    return PagePaths(
        size * POINT,
        np.array(lines).reshape(-1, 2, 2),
        np.array(circles).reshape(-1, 3),
        tuple(outlines),
    )


def _subpaths(content: bytes) -> Iterator[tuple[list[tuple[float, float]], list[bool], bool]]:
    """Each subpath: its points but for control points, which pieces are curves, whether closed."""
    matrix, stack = np.eye(3), list[FloatArray]()
    operands, points, curved = list[float](), list[tuple[float, float]](), list[bool]()
    for token in TOKEN.findall(content):
        if re.fullmatch(rb"[-+]?\d*\.?\d+|[-+]?\d+\.", token):
            operands.append(float(token))
            continue
        numbers, operands = operands, []
        if token == b"q":
            stack.append(matrix)
        elif token == b"Q":
            matrix = stack.pop()
        elif token == b"cm":
            a, b, c, d, e, f = numbers
            matrix = np.array([[a, b, 0], [c, d, 0], [e, f, 1]]) @ matrix
        elif token in (b"m", b"l", b"c"):
            if token == b"m" and points:
                yield points, curved, False
            if token == b"m":
                points, curved = [], []
            else:
                curved.append(token == b"c")
            x, y, _ = np.array([*numbers[-2:], 1.0]) @ matrix
            points.append((float(x), float(y)))
        elif token == b"h":
            if points[-1] == points[0] and not curved[-1]:  # a line back to where it already is
                points, curved = points[:-1], curved[:-1]
            yield points, curved, True
            points, curved = [], []
        elif token in (b"S", b"f", b"n", b"B", b"s", b"b") and points:
            yield points, curved, False
            points, curved = [], []
