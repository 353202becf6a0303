"""Dimensions in DXF: entities that measure, drawn as the sheet has them and read back; in mm.

E160 the file does not contain the linkage
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from burmester.export.drawings.dimension_lines import DimensionLine
from burmester.export.drawings.drawing import Item
from burmester.export.drawings.sheet import Sheet
from burmester.export.reference import require_equal
from burmester.numerics.arrays import FloatArray

DIMENSION_STYLE = "BURMESTER"
DIAMETER_TYPE = 3  # of dimension entities


def add_style(document: Any, sheet: Sheet, unit: float) -> None:
    """The style of dimensions: the letters and decimals of the sheet, closed arrows.

    unit: of the drawing, in millimetres.
    """
    style, letters = document.dimstyles.new(DIMENSION_STYLE), sheet.letters / unit
    for key, value in {
        "dimtxt": letters,
        "dimasz": 0.8 * letters,
        "dimexo": 0,
        "dimexe": 0.5 * letters,
        "dimgap": 0.35 * letters,
        "dimdec": sheet.decimals,
        "dimzin": 8,  # no zeros behind
        "dimtad": 1,  # text above its line
        "dimtih": 1,  # and not turned
        "dimtoh": 1,
        "dimtmove": 2,
        "dimdsep": ord("."),
        "dimscale": 1,
    }.items():
        style.set_dxf_attrib(key, value)


def add_dimension(document: Any, line: DimensionLine) -> None:
    """A dimension that measures; what it shows is drawn as the sheet has it."""
    space = document.modelspace()
    one, two = (_point(each) for each in line.measured)
    start, end = line.lines[0]
    _, *inches = line.text.partition(" [")
    common = {
        "text": "<>" + "".join(inches),
        "dimstyle": DIMENSION_STYLE,
        "dxfattribs": {"layer": "DIMENSIONS"},
    }
    if line.kind == "diameter":
        middle = _point(line.measured.mean(axis=0))
        made = space.add_diameter_dim(middle, mpoint=two, **common)
    elif line.kind == "distance":
        along = line.measured[1] - line.measured[0]
        away = start - line.measured[0]
        side = along[0] * away[1] - along[1] * away[0]
        level = abs(side) / float(np.linalg.norm(along))
        made = space.add_aligned_dim(one, two, distance=float(np.copysign(level, side)), **common)
    else:
        angle = 0.0 if line.kind == "length" else 90.0
        made = space.add_linear_dim(_point(end), one, two, angle=angle, **common)
    made.render()
    entity = made.dimension
    entity.dxf.text_midpoint = _point(line.at)
    if line.kind != "diameter":
        entity.dxf.defpoint = _point(end)
    entity.dxf.actual_measurement = line.value
    block = document.blocks.get(entity.dxf.geometry)
    block.delete_all_entities()
    for piece in line.lines:
        block.add_line(*map(_point, piece), dxfattribs={"layer": "DIMENSIONS"})
    for arrow in line.arrows:
        block.add_solid([_point(each) for each in arrow], dxfattribs={"layer": "DIMENSIONS"})
    block.add_mtext(
        line.text.replace("Ø", "%%c"),
        dxfattribs={
            "layer": "DIMENSIONS",
            "char_height": line.letters,
            "insert": _point(line.at),
            "attachment_point": 5,
        },
    )


def read_dimensions(document: Any, wanted: Sequence[DimensionLine], tolerance: float) -> list[Item]:
    """The items of the dimension entities, which measure what is wanted; raises E160."""
    found = list[Item]()
    entities = list(document.modelspace().query("DIMENSION"))
    require_equal("the number of dimensions", len(entities), len(wanted), 0)
    for entity, line in zip(entities, wanted, strict=True):
        dxf, diameter = entity.dxf, entity.dimtype == DIAMETER_TYPE
        block = document.blocks.get(dxf.geometry)
        layers = {dxf.layer, *(each.dxf.layer for each in block)}
        require_equal("the layers of a dimension", layers == {"DIMENSIONS"}, True, 0)
        ends = (dxf.defpoint, dxf.defpoint4) if diameter else (dxf.defpoint2, dxf.defpoint3)
        rows = np.array([tuple(each)[:2] for each in ends])
        wanted_at = line.measured
        if diameter:  # its ends have no order
            rows, wanted_at = rows.mean(axis=0), wanted_at.mean(axis=0)
        require_equal("what a dimension measures", rows, wanted_at, tolerance)
        measured = float(entity.get_measurement())
        require_equal("a measurement", measured, line.value, tolerance)
        (shown,) = block.query("MTEXT")
        require_equal("where a text is", dxf.text_midpoint, shown.dxf.insert, tolerance)
        if not diameter:
            own = tuple(dxf.defpoint)[:2]
            require_equal("a dimension line", own, line.lines[0, 1], tolerance)
        for each in block:
            if each.dxftype() == "LINE":
                at = np.array([tuple(each.dxf.start)[:2], tuple(each.dxf.end)[:2]])
                found.append(Item("line", "dimension", at))
            elif each.dxftype() == "SOLID":
                corners = [tuple(each.dxf.get(f"vtx{k}"))[:2] for k in range(3)]
                found.append(Item("arrow", "dimension", np.array(corners)))
        at, text = np.array(tuple(shown.dxf.insert)[:2]), shown.text.replace("%%c", "Ø")
        found.append(Item("text", "dimension", at, text=text))
    return found


def _point(at: FloatArray) -> tuple[float, float]:
    return float(at[0]), float(at[1])
