"""DXF (R2010): the plates laid out for cutting, and the assembly as a block.

In millimetres, or in inches where the task is in inches or feet.

Outlines are closed polylines with exact arcs, holes are circles, slots are closed polylines.
Dimensions are entities that measure, on the layer DIMENSIONS, which can be switched off.  The block
ASSEMBLY is inserted where F has it, with the coupler at the chosen pose.  The bytes depend on the
linkage and the options only, but for the order of two entries that ezdxf keeps in a set.

E160 the file does not contain the linkage
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from burmester.export.description import dxf_text, error_within
from burmester.export.drawings.dimension_lines import DimensionLine
from burmester.export.drawings.drawing import Drawing, Item, Kind, require_drawing
from burmester.export.drawings.sheet import Sheet
from burmester.export.options import Options, fault, require_equal, unit_of
from burmester.export.parts.plates import Assembly
from burmester.export.parts.stock import stock_for
from burmester.mechanisms.bodies import GROUND
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.tasks.length_units import MILLIMETRES

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
ROLE_LAYERS = {
    "hole": "HOLES",
    "slot": "SLOTS",
    "mark": "MARKS",
    "pose": "POSES",
    "body": "BODY",
    "keep-out": "KEEP_OUT",
    "hatch": "KEEP_OUT",
    "name": "TEXT",
    "note": "TEXT",
}


DIMENSION_STYLE = "BURMESTER"
DIAMETER_TYPE = 3  # of dimension entities


def write(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the drawing."""
    unit = _unit_of(chosen, options)
    drawing = Drawing.of(chosen, options, unit)
    assembly, sheet = drawing.assembly, drawing.sheet
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
        _draw(document, drawing)
        _scale(document, 1 / size)
        middle, tall = (low + high) / 2, float((high - low).max())
        document.set_modelspace_vport(tall, center=tuple(middle.tolist()))
        _order_classes(document)
        document.saveas(path)
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = fixed


def _unit_of(chosen: Candidate, options: Options) -> str:
    """The unit of the drawing."""
    return "in" if stock_for(unit_of(chosen, options)).inches else "mm"


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


def _draw(document: Any, drawing: Drawing) -> None:
    space, block = document.modelspace(), None
    for item in drawing.items:
        if _is_placed(item):
            block = block or document.blocks.new("ASSEMBLY", base_point=(0, 0))
        elif item.role == "pose" and not space.query("INSERT"):
            space.add_blockref("ASSEMBLY", (0, 0), dxfattribs={"layer": "ASSEMBLY"})
        _add(block if _is_placed(item) else space, item, drawing)
        for plate, line in drawing.dimensions if item.role == "name" else ():
            if plate == item.group:
                add_dimension(document, line)


def _is_placed(item: Item) -> bool:
    """Whether an item is of the assembly's block."""
    return item.group.startswith("placed-")


def _add(space: Any, item: Item, drawing: Drawing) -> None:
    """Draw an item on its layer."""
    attributes: dict[str, Any] = {"layer": _layer_of(item, drawing.assembly)}
    if item.kind == "outline":
        rows = item.at.tolist()
        space.add_lwpolyline(rows, format="xyb", close=True, dxfattribs=attributes)
    elif item.kind == "circle":
        x, y, diameter = item.at.tolist()
        space.add_circle((x, y), diameter / 2, dxfattribs=attributes)
    elif item.kind == "line":
        space.add_line(*map(tuple, item.at.tolist()), dxfattribs=attributes)
    else:
        attributes["insert"] = tuple(item.at.tolist())
        space.add_text(dxf_text(item.text), height=drawing.sheet.letters, dxfattribs=attributes)


def _layer_of(item: Item, assembly: Assembly) -> str:
    """The name of an item's layer."""
    if _is_placed(item):
        return "ASSEMBLY"
    if item.role == "outline":
        plate = assembly.plate(item.group)
        assert plate is not None
        return _layer(plate.owner)
    return ROLE_LAYERS[item.role]


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the drawing back, audit it and compare it; raises E160."""
    document = ezdxf.readfile(path)
    auditor = document.audit()
    if auditor.has_errors or auditor.has_fixes:
        faults = [str(each.message) for each in (*auditor.errors, *auditor.fixes)]
        message = "what was written is no sound DXF file, so nothing was kept"
        raise fault("; ".join(faults[:3]), message)
    unit = _unit_of(chosen, options)
    drawing = Drawing.of(chosen, options, unit)
    require_equal("the unit of the drawing", document.header["$INSUNITS"], CODES[unit], 0)
    _scale(document, MILLIMETRES[unit])
    space, block = document.modelspace(), document.blocks.get("ASSEMBLY")
    assert block is not None
    (insert,) = space.query("INSERT")
    require_equal("the place of the assembly", tuple(insert.dxf.insert)[:2], (0, 0), 0)
    read = [*_read(space, drawing, placed=False), *_read(block, drawing, placed=True)]
    largest = max(float(np.abs(each.at).max()) for each in read if each.kind == "outline")
    tolerance = error_within(DIGITS, largest)
    read += read_dimensions(document, [line for _, line in drawing.dimensions], tolerance)
    require_drawing(read, drawing, tolerance, dxf_text)


def _read(space: Any, drawing: Drawing, *, placed: bool) -> Iterable[Item]:
    """The items on a sheet, which are in the order of the drawing's own; raises E160."""
    kinds: dict[str, Kind] = {
        "LWPOLYLINE": "outline",
        "CIRCLE": "circle",
        "LINE": "line",
        "TEXT": "text",
    }
    entities = [each for each in space if each.dxftype() in kinds]
    wanted = [each for each in drawing.items if _is_placed(each) == placed]
    require_equal("the number of entities", len(entities), len(wanted), 0)
    for entity, own in zip(entities, wanted, strict=True):
        dxf, kind, at = entity.dxf, kinds[entity.dxftype()], list[Any]()
        layer = _layer_of(own, drawing.assembly)
        require_equal(f"the layer of {own.role} {own.group}", dxf.layer == layer, True, 0)
        if kind == "outline":
            require_equal(f"whether {own.role} is closed", entity.closed, True, 0)
            at = [tuple(point) for point in entity.get_points(format="xyb")]
        elif kind == "circle":
            at = [*tuple(dxf.center)[:2], 2 * dxf.radius]
        elif kind == "line":
            at = [tuple(dxf.start)[:2], tuple(dxf.end)[:2]]
        else:
            at = [*tuple(dxf.insert)[:2]]
        yield own._replace(kind=kind, at=np.array(at), text=dxf.text if kind == "text" else "")


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
