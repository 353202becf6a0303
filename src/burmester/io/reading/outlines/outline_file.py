"""The outline in a drawing: the one closed curve of a DXF or SVG file, or of one of its parts.

A path to trace is that curve, or the only open one, as points at equal steps.

Its lengths are turned into the unit of the task.  Arcs and splines become chords, open curves
whose ends meet are joined; how far both may be off is told.

E170 not readable, or no drawing        E171 no closed curve
E172 more than one                      E173 no such layer or id
E174 units that do not fit              E130 ezdxf or svgelements missing
E131 an outline that crosses itself     E188 not one curve to trace
"""

from __future__ import annotations

import os
import re
from pathlib import PurePath
from typing import Final, NamedTuple

import numpy as np

from burmester.errors import Advice, InputError
from burmester.geometry.regions import MAX_CORNERS, Polygon
from burmester.io.files import open_plain
from burmester.io.reading.outlines.curves import (
    FLATNESS,
    JOINT,
    Curve,
    Drawing,
    extent,
    joined,
    unreadable,
)
from burmester.io.reading.outlines.dxf_drawing import read_dxf
from burmester.io.reading.outlines.svg_drawing import read_svg
from burmester.io.reading.pose_table import PoseTable, Rows, shown
from burmester.io.reading.stated_tolerances import StatedTolerances
from burmester.numerics.arrays import FloatArray
from burmester.printable import printable
from burmester.tasks.traced_path import TracedPath
from burmester.wording import count, figure, in_unit, listed

FROM_PAGE: Final = "<page>/"  # in front of the name of a task that a page sent

MAX_BYTES: Final = 8_000_000  # of a drawing: some 60,000 lines, ten seconds
MAX_NAMED: Final = 8  # outlines or parts that a message lists
METRES: Final = {
    "um": 1e-6, "µm": 1e-6, "mm": 1e-3, "cm": 1e-2, "dm": 0.1, "m": 1.0, "in": 0.0254,
    "inch": 0.0254, "inches": 0.0254, '"': 0.0254, "ft": 0.3048, "feet": 0.3048,
    "px": 0.0254 / 96,
}  # fmt: skip
ALONE: Final = "draw the outline on a layer of its own, or give it an id, and name that"
_NAMED = re.compile(r"(.*?\.(?:dxf|svg))(?::(.*))?", re.IGNORECASE | re.DOTALL)
POINTS: Final = 60  # taken of a curve, at equal steps along it


class OutlineFile(NamedTuple):
    """A drawing and the part of it that is meant: a layer of DXF, an id of SVG, or None."""

    path: str
    part: str | None = None

    @property
    def kind(self) -> str:
        """The suffix in small letters."""
        return PurePath(self.path).suffix.lower()


def outline_named(text: str) -> OutlineFile:
    """The drawing in FILE or FILE:PART, as the command line names it."""
    found = _NAMED.fullmatch(text)
    return OutlineFile(found[1], found[2] or None) if found else OutlineFile(text)


def folder_of(label: str) -> str:
    """The folder of a task file, in which it names drawings; that of the command for others.

    Raises E170 for a task that a page sent: it has no folder, and no file is opened for it.
    """
    if label.startswith(FROM_PAGE):
        raise unreadable(
            "what a page sends names no files of this machine",
            "write the corners of the outline, or open the drawing itself on the page",
        )
    return "" if label == "<stdin>" or label.startswith("case:") else os.path.dirname(label)


def read_outline(
    file: OutlineFile, folder: str, length_unit: str | None, data: bytes | None = None
) -> tuple[Polygon, Advice]:
    """The outline in a file, in the unit of the task, and how it was read (W218).

    folder: that a path without a root is in; data: what the file holds, where that is known.
    Raises E130, E131 and E170 to E174, which name the file but not where it is named.
    """
    label = printable(file.path)
    try:
        drawing = drawing_in(file, data, folder)
        curve, size, left_open = only_closed_curve(drawing, file.part)
        factor = _factor(drawing.unit, length_unit)
        points, shortened = _few_corners(curve.points * factor, FLATNESS * size * factor)
        outline = Polygon(points)
    except InputError as error:
        error.message = f"{label}: {error.message}"
        raise
    unit = f" {length_unit}" if length_unit else ""
    wide, high = np.ptp(outline.vertices, axis=0)
    said = list(drawing.assumed)
    within = figure((2 if shortened else 1) * FLATNESS * size * factor)
    if len(curve.points) > 8 or shortened:
        said.append(f"arcs and splines are chords within {within}{unit}")
    if "+" in curve.kind:
        gap = figure(JOINT * size * factor)
        said.append(f"{curve.kind.count('+') + 1} curves are joined at ends within {gap}{unit}")
    if left_open:
        said.append(f"{count(left_open, 'open curve')} beside it are passed over")
    if drawing.unit is None:
        said.append("the drawing states no unit, so its numbers are in the unit of the poses")
    elif factor != 1:
        said.append(f"1 {drawing.unit} of the drawing is {factor:.6g}{unit}")
    return outline, Advice(
        "W218",
        f"{label} is read as an outline of {count(len(outline.vertices), 'corner')}, "
        f"{wide:.5g} by {high:.5g}{unit}",
        "look at it in the figure or the report; to have nothing said, write its corners into the "
        "task",
        "; ".join(said) or None,
    )


def read_curves(file: OutlineFile, length_unit: str | None, data: bytes) -> list[FloatArray]:
    """All curves of a drawing as polylines (n, 2), in the unit of the task; closed ones end where
    they begin.

    Raises E130, E170, E173 and E174.
    """
    drawing = drawing_in(file, data)
    factor = _factor(drawing.unit, length_unit)
    rings = (np.vstack([e.points, e.points[:1]]) if e.closed else e.points for e in drawing.curves)
    return [factor * each for each in rings]


def drawing_in(file: OutlineFile, data: bytes | None = None, folder: str = "") -> Drawing:
    """The drawing in a file, or its part; raises E130, E170 and E173."""
    if file.kind not in (".dxf", ".svg"):
        why = f"its name ends in {shown(file.kind)}" if file.kind else "its name has no suffix"
        raise unreadable(why, "give a DXF or an SVG file, named .dxf or .svg")
    data = _content(file, folder) if data is None else data
    if len(data) > MAX_BYTES:
        why = f"it has more than {MAX_BYTES / 1e6:.0f} MB"
        raise unreadable(why, "save the outline alone to a file of its own")
    if not data.strip():
        raise unreadable("the file is empty", "give a DXF or an SVG file with the outline in it")
    drawing = read_dxf(data, file.part) if file.kind == ".dxf" else read_svg(data, file.part)
    if file.part is not None and not drawing.curves:
        names = [shown(each) for each in drawing.parts[:MAX_NAMED]]
        further = len(drawing.parts) - MAX_NAMED
        more = f" and {further} more" if further > 0 else ""
        raise InputError(
            "E173",
            f"there is no {drawing.part_word} {shown(file.part)} with a curve",
            why=f"there are {listed(names)}{more}" if names else f"it has no {drawing.part_word}",
            help=f"name one of these, or no {drawing.part_word}"
            if names
            else f"leave the {drawing.part_word} out",
        )
    return drawing


def _content(file: OutlineFile, folder: str) -> bytes:
    """The bytes of the file."""
    path = file.path if os.path.isabs(file.path) else os.path.join(folder, file.path)
    try:
        with open_plain(path, "rb") as opened:
            return opened.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        why = getattr(error, "strerror", None) or str(error)
        near = "of the task" if folder else "of the command"
        raise unreadable(why, f"check the path, which begins at the folder {near}") from None


def only_closed_curve(drawing: Drawing, part: str | None) -> tuple[Curve, float, int]:
    """The one closed curve, the extent of the drawing, and the number of open curves beside it."""
    size = extent(drawing.curves)
    closed, ends, left_open = joined(drawing.curves, JOINT * size)
    closed = [each for each in closed if extent([each]) > 2 * JOINT * size]  # no dots
    where = f" on {drawing.part_word} {shown(part)}" if part else ""
    if not closed:
        why = "it has no curves"
        if drawing.curves:
            why = f"it has {count(len(drawing.curves), 'curve')}, and none closes"
        if np.isfinite(ends.gap):
            at = f"({ends.at[0]:.6g}, {ends.at[1]:.6g})"
            why += f"; ends {ends.gap:.3g} apart are at {at}, and {JOINT * size:.2g} is the most"
        help = "close the outline in the drawing, with two ends at each corner"
        raise InputError("E171", f"there is no closed curve{where}", why=why, help=help)
    if len(closed) > 1:
        raise InputError(
            "E172",
            f"there are {len(closed)} closed curves{where}, and it is not said which is meant",
            why=_listing(drawing, sorted(closed, key=lambda each: -extent([each]))),
            help=f"name one by its {drawing.part_word} if it is alone there, or {ALONE}",
        )
    return closed[0], size, left_open


def _listing(drawing: Drawing, curves: list[Curve]) -> str:
    """Closed curves by size, kind and name."""
    out = []
    for each in curves[:MAX_NAMED]:
        wide, high = np.ptp(each.points, axis=0)
        kind = each.kind if "+" not in each.kind else f"{each.kind.count('+') + 1} joined curves"
        name = f" ({drawing.part_word} {shown(each.names[0])})" if each.names else ""
        out.append(f"{kind}{name} {wide:.5g} by {high:.5g}")
    further = len(curves) - MAX_NAMED
    return listed(out) + (f" and {further} more" if further > 0 else "")


def _factor(drawn: str | None, wanted: str | None) -> float:
    """The unit of the drawing in units of the task; raises E174."""
    if drawn is None or (drawn == "px" and wanted is None):
        return 1.0
    if wanted is None:
        raise InputError(
            "E174",
            f"the drawing is{in_unit(drawn)}, and the task states no unit",
            why="units are never guessed",
            help='write length_unit = "mm" into the task, or the unit that its poses are in',
        )
    if (metres := METRES.get(wanted.strip().lower())) is None:
        raise InputError(
            "E174",
            f"the drawing is{in_unit(drawn)}, and the unit of the task, {shown(wanted)}, is not "
            "known",
            why=f"known are {listed(list(METRES)[:7])}",
            help="state the unit of the poses as one of these, or draw without a unit",
        )
    return METRES[drawn] / metres


def _few_corners(points: np.ndarray, tolerance: float) -> tuple[np.ndarray, bool]:
    """The corners of a ring, fewer where there are too many, and whether there were."""
    if len(points) <= MAX_CORNERS:
        return points, False
    from burmester.geometry.shapes import simplified

    return simplified(points, tolerance), True


def drawing_named(text: str) -> OutlineFile | None:
    """The drawing in FILE or FILE:PART; None for a file of another kind."""
    file = outline_named(text)
    return file if file.kind in (".svg", ".dxf") else None


def read_drawn_path(file: OutlineFile, data: bytes | None = None) -> PoseTable:
    """The points of the curve in a drawing, in the drawing's unit, and how it was read (W227).

    A closed curve where there is one; else the only open curve.
    data: what the file holds, where that is known.
    """
    drawing = drawing_in(file, data)
    size = extent(drawing.curves)
    closed, _, _ = joined(drawing.curves, JOINT * size)
    if any(extent([each]) > 2 * JOINT * size for each in closed):
        curve, size, _ = only_closed_curve(drawing, file.part)
    else:
        curve = _only_open(drawing.curves)
    points = _at_equal_steps(curve)
    free = StatedTolerances(np.tile([np.nan, np.nan, np.inf], (POINTS, 1)), [""] * POINTS)
    values = np.column_stack([points, np.full(POINTS, np.nan)])
    decimals = float(np.ceil(-np.log10(FLATNESS * size))) if size > 0 else 0.0
    label, unit = printable(file.path), drawing.unit
    wide, high = np.ptp(curve.points, axis=0)
    kind = "a closed" if curve.closed else "an open"
    note = Advice(
        "W227",
        f"{label} is read as {kind} curve, {wide:.5g} by {high:.5g}"
        + (f" {unit}" if unit else "")
        + f", and {count(POINTS, 'point')} are taken of it at equal steps",
        "look at it in the figure or the report; a file of points x,y says which count",
        "; ".join(drawing.assumed) or None,
    )
    return PoseTable(
        Rows(values, (decimals, 0.0), [], [], tolerances=free),
        length_unit=unit,
        angle_unit="deg",
        where=label,
        say_unit="",
        notes=(note,),
        path=TracedPath(curve.closed),
        read_as="a drawing",
    )


def _only_open(curves: list[Curve]) -> Curve:
    """The one open curve of a drawing; raises E188."""
    if len(curves) == 1:
        return curves[0]
    raise InputError(
        "E188",
        "the drawing has not one curve to trace",
        why=f"it has {count(len(curves), 'open curve')}, and none closes"
        if curves
        else "it has no curve",
        help="draw the path as one curve, or name its layer (DXF) or its id (SVG) as FILE:PART",
    )


def _at_equal_steps(curve: Curve) -> FloatArray:
    """POINTS points (n, 2) along a curve; the first of a closed one is not repeated."""
    points = curve.points
    if curve.closed:
        points = np.concatenate([points, points[:1]])
    arc = np.concatenate([[0.0], np.hypot(*np.diff(points, axis=0).T).cumsum()])
    wanted = np.linspace(0, arc[-1], POINTS, endpoint=not curve.closed)
    return np.column_stack([np.interp(wanted, arc, column) for column in points.T])
