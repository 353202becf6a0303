"""DXF (R2010): the plates laid out for cutting, and the assembly as a block.

In millimetres, or in inches where the task is in inches or feet.

Outlines are closed polylines with exact arcs, holes are circles, slots are closed polylines.
Dimensions are entities that measure, on the layer DIMENSIONS, which can be switched off.  The block
ASSEMBLY is inserted where F has it, with the coupler at the chosen pose.  The bytes depend on the
linkage and the options only, but for the order of two entries that ezdxf keeps in a set.

E160 the file does not contain the linkage
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from burmester.errors import BurmesterError
from burmester.export.description import (
    description,
    dimension_notes,
    length_decimals,
    reference_of,
)
from burmester.export.drawings.dxf_dimensions import add_dimension, add_style, measured_in
from burmester.export.drawings.measured import require_dimensions
from burmester.export.drawings.outlines import Outlines, hatch, name_start, require_outlines
from burmester.export.drawings.sheet import Sheet, beside, carried, joint_names, notes_on, sheet_of
from burmester.export.escaping import dxf_text
from burmester.export.numbers import error_within
from burmester.export.options import MILLIMETRES, Options
from burmester.export.parts.holes import joints_of
from burmester.export.parts.links import GROUND
from burmester.export.parts.plate import moved
from burmester.export.parts.plates import Assembly, Plate, assembly_of, slot_outline
from burmester.export.parts.stock import stock_for
from burmester.export.reference import require_equal
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

__all__ = ["check", "write"]

ezdxf: Any = import_module("ezdxf")

DIGITS = 15  # of each number, those that survive arithmetic; the file has them all
CODES = {"mm": 4, "in": 1}  # of units of length in DXF
GROUND_COLOUR, LINK_COLOURS = 8, (1, 5, 3, 40, 150)  # by the index of AutoCAD
LAYERS = {  # and their colours, beside those of links
    "HOLES": 7,
    "SLOTS": 7,
    "MARKS": 9,
    "ASSEMBLY": 9,
    "POSES": 6,
    "BODY": 4,
    "KEEP_OUT": 8,
    "DIMENSIONS": 30,
    "TEXT": 7,
}


def write(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the drawing."""
    assembly = assembly_of(chosen, options)
    reference = reference_of(chosen, options)
    outlines = Outlines.of(chosen.task, reference)
    unit = _unit_of(assembly)
    notes = description(chosen, options, unit) + dimension_notes(chosen, options, unit)
    notes += notes_on(assembly)
    sheet = sheet_of(
        assembly,
        reference.poses,
        len(notes),
        length_decimals(chosen, options, unit),
        options.dimensions,
        outlines=outlines,
        unit=unit,
    )
    fixed = ezdxf.options.write_fixed_meta_data_for_testing
    try:
        ezdxf.options.write_fixed_meta_data_for_testing = True  # no dates and no random numbers
        document = ezdxf.new("R2010", units=CODES[unit])
        document.header["$MEASUREMENT"] = int(unit == "mm")
        document.header["$INSUNITS"] = CODES[unit]
        size = MILLIMETRES[unit]
        low, high = sheet.low / size, sheet.high / size
        corners = ((*each.tolist(), 0.0) for each in (low, high))
        document.modelspace().reset_extents(*corners)
        owners = dict.fromkeys(each.owner for each in assembly.plates)
        colours = {GROUND: GROUND_COLOUR, **dict(zip(assembly.moving, LINK_COLOURS, strict=False))}
        links = {_layer(each): colours[each] for each in owners}
        for name, colour in (links | LAYERS).items():
            document.layers.add(name, color=colour)
        add_style(document, sheet, size)
        _draw(document, assembly, sheet, reference.poses, notes)
        _draw_outlines(document.modelspace(), outlines, sheet.letters)
        _scale(document, 1 / size)
        middle, tall = (low + high) / 2, float((high - low).max())
        document.set_modelspace_vport(tall, center=tuple(middle.tolist()))
        _order_classes(document)
        document.saveas(path)
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = fixed


def _unit_of(assembly: Assembly) -> str:
    """The unit of the drawing."""
    return "in" if stock_for(assembly.unit).inches else "mm"


def _scale(document: Any, scale: float) -> None:
    """Make all that is drawn larger, what dimensions measure included."""
    if scale == 1.0:
        return
    matrix = ezdxf.math.Matrix44.scale(scale)
    for entity in (*document.modelspace(), *document.blocks.get("ASSEMBLY")):
        if entity.dxftype() != "INSERT":  # whose block is made larger
            entity.transform(matrix)
        if entity.dxftype() == "DIMENSION":
            entity.dxf.actual_measurement *= scale


def _layer(link: str) -> str:
    """The name of a link's layer."""
    return link.upper().replace("-", "_")


def _order_classes(document: Any) -> None:
    """Classes by name: ezdxf takes them from a set, in another order in each process."""
    document.classes.add_required_classes(document.dxfversion)
    by_name = sorted(document.classes, key=lambda each: each.key)
    document.classes.classes.clear()
    document.classes.register(by_name)


def _draw(
    document: Any,
    assembly: Assembly,
    sheet: Sheet,
    poses: Displacement,
    notes: list[str],
) -> None:
    space = document.modelspace()
    for part, label in zip(sheet.parts, sheet.labels, strict=True):
        layers = (_layer(part.plate.owner), "HOLES", "SLOTS", "MARKS")
        _plate(space, moved(part.plate, part.place), layers, sheet)
        _text(space, part.label, label, sheet.letters)
        for each in part.lines:
            add_dimension(document, each)
    block = document.blocks.new("ASSEMBLY", base_point=(0, 0))
    for plate in assembly.plates:
        drawn = moved(plate, plate.at(assembly.drawn))
        _plate(block, drawn, ("ASSEMBLY",) * 4, sheet)
    for name, at in joint_names(assembly, sheet):
        _text(space, name, at, sheet.letters)
    space.add_blockref("ASSEMBLY", (0, 0), dxfattribs={"layer": "ASSEMBLY"})
    for number in range(poses.shape[0]):
        place = poses[number]
        ends = place[None].act(np.array([[0.0, 0.0], [sheet.axes, 0.0], [0.0, sheet.axes / 2]]))
        for end in ends[1:]:
            space.add_line(_point(ends[0]), _point(end), dxfattribs={"layer": "POSES"})
        _text(space, str(number + 1), beside(place, sheet), sheet.letters, layer="POSES")
    for k, line in enumerate(notes):
        at = sheet.notes - [0, 1.6 * k * sheet.letters]
        _text(space, line, at, sheet.letters)


def _draw_outlines(space: Any, outlines: Outlines, letters: float) -> None:
    """Draw the body at every pose, and the regions with hatches and names."""
    for corners in outlines.body if outlines.body.size else ():
        _ring(space, corners, "BODY")
    for name, corners in outlines.regions:
        _ring(space, corners, "KEEP_OUT")
        for start, end in hatch(corners, letters):
            space.add_line(_point(start), _point(end), dxfattribs={"layer": "KEEP_OUT"})
        if name:
            _text(space, name, name_start(name, corners, letters), letters, layer="KEEP_OUT")


def _ring(space: Any, corners: FloatArray, layer: str) -> None:
    _closed(space, np.column_stack([corners, np.zeros(len(corners))]), layer)


def _plate(
    space: Any,
    drawn: tuple[FloatArray, FloatArray, FloatArray, FloatArray],
    layers: tuple[str, ...],
    sheet: Sheet,
) -> None:
    """Draw the outline, the holes, the slots and the marks of a plate, each on its layer."""
    outline, holes, slots, marks = drawn
    outline_layer, hole_layer, slot_layer, mark_layer = layers
    _closed(space, outline, outline_layer)
    for x, y, diameter in holes.tolist():
        space.add_circle((x, y), diameter / 2, dxfattribs={"layer": hole_layer})
    for slot in slots:
        _closed(space, slot_outline(slot), slot_layer)
    for mark in marks:
        arm = 0.3 * sheet.letters
        for way in ([arm, 0], [0, arm]):
            ends = _point(mark - way), _point(mark + way)
            space.add_line(*ends, dxfattribs={"layer": mark_layer})


def _closed(space: Any, outline: FloatArray, layer: str) -> None:
    space.add_lwpolyline(outline.tolist(), format="xyb", close=True, dxfattribs={"layer": layer})


def _text(space: Any, text: str, at: FloatArray, height: float, layer: str = "TEXT") -> None:
    space.add_text(dxf_text(text), height=height, dxfattribs={"layer": layer, "insert": _point(at)})


def _point(at: FloatArray) -> tuple[float, float]:
    return float(at[0]), float(at[1])


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the drawing back, audit it and compare it; raises E160."""
    reference = reference_of(chosen, options)
    assembly = assembly_of(chosen, options)
    poses = reference.poses
    document = ezdxf.readfile(path)
    auditor = document.audit()
    if auditor.has_errors or auditor.has_fixes:
        faults = [str(each.message) for each in (*auditor.errors, *auditor.fixes)]
        raise BurmesterError(
            "E160",
            "what was written is no sound DXF file, so nothing was kept",
            why="; ".join(faults[:3]),
            help="this is a fault of burmester: report it, with the result file",
        )
    unit = _unit_of(assembly)
    require_equal("the unit of the drawing", document.header["$INSUNITS"], CODES[unit], 0)
    _scale(document, MILLIMETRES[unit])
    every = np.concatenate([_rows(each) for each in document.modelspace().query("LWPOLYLINE")])
    tolerance = error_within(DIGITS, float(np.abs(every).max()))
    # The assembly holds a hole or a slot's middle line where the dyads have their pivots.
    block = document.blocks.get("ASSEMBLY")
    assert block is not None
    (insert,) = document.modelspace().query("INSERT")
    require_equal("the place of the assembly", tuple(insert.dxf.insert)[:2], (0, 0), 0)
    circles = np.array([tuple(each.dxf.center)[:2] for each in block.query("CIRCLE")])
    circles = circles.reshape(-1, 2)
    joints = joints_of(reference, assembly, options.pose)
    expected = [(each.plates[0], each.point) for each in joints if each.point is not None]
    for name, pivot in expected:
        gap = np.linalg.norm(circles - pivot, axis=1)
        what = f"a pivot of the {name} in the assembly"
        require_equal(what, gap.min(initial=np.inf), 0, tolerance)
    for point in circles:
        gap = min(float(np.linalg.norm(point - each)) for _, each in expected)
        require_equal("a hole in the assembly", gap, 0, tolerance)
    drawn = iter(block.query("LWPOLYLINE"))
    for plate in assembly.plates:
        outline, _, slots, _ = moved(plate, plate.at(assembly.drawn))
        for rows in (outline, *map(slot_outline, slots)):
            require_equal(f"{plate.name} in the assembly", _rows(next(drawn)), rows, tolerance)
    placed = _check_plates(document, assembly, tolerance)
    if options.dimensions:
        require_dimensions(placed, measured_in(document, tolerance), tolerance, unit)
    body, regions = (
        [_rows(each) for each in document.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')]
        for layer in ("BODY", "KEEP_OUT")
    )
    require_outlines(Outlines.of(chosen.task, reference), body, regions, tolerance)
    axes = document.modelspace().query('LINE[layer=="POSES"]')
    starts = np.array([tuple(each.dxf.start)[:2] for each in axes])
    require_equal("the poses", starts, np.repeat(poses.translation, 2, axis=0), tolerance)
    ends = np.array([tuple(each.dxf.end)[:2] for each in axes])[::2] - starts[::2]
    turned = np.exp(1j * (np.arctan2(ends[:, 1], ends[:, 0]) - poses.angle))
    require_equal("the angles of the poses", np.abs(turned - 1), np.zeros(len(turned)), 1e-6)


def _check_plates(
    document: Any, assembly: Assembly, tolerance: float
) -> list[tuple[Plate, Displacement]]:
    """The plates laid out, by what lies within their outlines, and where they lie."""
    space = document.modelspace()
    outlines = {
        owner: [each for each in space.query("LWPOLYLINE") if each.dxf.layer == _layer(owner)]
        for owner in {plate.owner for plate in assembly.plates}
    }
    circles = np.array(
        [(*tuple(each.dxf.center)[:2], 2 * each.dxf.radius) for each in space.query("CIRCLE")]
    ).reshape(-1, 3)
    slots = list(space.query('LWPOLYLINE[layer=="SLOTS"]'))
    require_equal(
        "the number of holes", len(circles), sum(len(p.holes) for p in assembly.plates), 0
    )
    require_equal("the number of slots", len(slots), sum(len(p.slots) for p in assembly.plates), 0)
    placed = []
    for plate in assembly.plates:
        own = outlines[plate.owner].pop(0)
        require_equal(f"whether the outline of {plate.name} is closed", own.closed, True, 0)
        rows = _rows(own)
        placed.append((plate, carried(plate, rows)))
        outline, holes, wanted, _ = moved(*placed[-1])
        require_equal(f"the outline of {plate.name}", rows, outline, tolerance)
        if len(holes):
            gaps = np.abs(circles[:, None] - holes).max(axis=-1).min(axis=0)
            require_equal(f"the holes of {plate.name}", gaps, np.zeros(len(gaps)), tolerance)
        for slot in wanted:
            gaps_of = [
                float(np.abs(each - slot_outline(slot)).max())
                for each in map(_rows, slots)
                if each.shape == slot_outline(slot).shape
            ]
            require_equal(f"the slot of {plate.name}", min(gaps_of, default=np.inf), 0, tolerance)
    return placed


def _rows(polyline: Any) -> FloatArray:
    return np.array([tuple(point) for point in polyline.get_points(format="xyb")])
