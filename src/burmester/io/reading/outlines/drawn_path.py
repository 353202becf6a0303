"""The path in a drawing: its one closed curve, or its one open curve, as points at equal steps.

E170 not readable, or no drawing        E173 no such layer or id
E172 more than one closed curve         E188 not one curve
E130 ezdxf or svgelements missing
"""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.errors import Advice, InputError
from burmester.io.reading.outlines.curves import FLATNESS, JOINT, Curve, extent, joined
from burmester.io.reading.outlines.outline_file import (
    OutlineFile,
    drawing_in,
    only_closed_curve,
    outline_named,
)
from burmester.io.reading.pose_table import PoseTable, Rows
from burmester.io.reading.stated_tolerances import StatedTolerances
from burmester.numerics.arrays import FloatArray
from burmester.printable import printable
from burmester.tasks.traced_path import TracedPath
from burmester.wording import count

POINTS: Final = 60  # taken of a curve, at equal steps along it


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
