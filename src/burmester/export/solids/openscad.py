"""OpenSCAD (millimetres): numbers at the top, a module per link, moved by $t through the poses.

The links are made from the numbers: pivots, holes, widths and thicknesses can be changed there.
The places of the coupler are a table; its links turn towards their pivots.  Of a six-bar, all
moving links have their places in tables.

E160 the file does not contain the linkage
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from burmester.export.description import description, reference_of
from burmester.export.escaping import line_comment
from burmester.export.numbers import number
from burmester.export.options import Options
from burmester.export.parts.links import GROUND
from burmester.export.parts.plates import Assembly, assembly_of
from burmester.export.reference import PRECISION, require_equal
from burmester.export.six_bar_reference import SixBarReference, plates_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

__all__ = ["check", "write"]

NUMBERS = re.compile(r"^(\w+) = ([-+.\d\[][^;a-z]*(?:e[-+]?\d[^;a-z]*)*);", re.MULTILINE)
MOTION_ROWS = 121  # rows of the motion
GROUNDS = {"ground": "DimGray", "ground_2": "DarkGray"}
COLOURS = ("FireBrick", "SteelBlue", "SeaGreen", "Chocolate", "MediumPurple")  # of moving links
MODULES = """
// A plate around pieces of points, with round holes and slots [x1, y1, x2, y2].
module plate(pieces, holes, slots) {
  linear_extrude(thickness) difference() {
    union() for (points = pieces) hull() for (p = points) translate(p) circle(d = width);
    for (h = holes) translate(h) circle(d = hole);
    for (s = slots) hull() {
      translate([s[0], s[1]]) circle(d = hole);
      translate([s[2], s[3]]) circle(d = hole);
    }
  }
}

// Something of the layer with that number.
module layer(number) { translate([0, 0, number * (thickness + gap)]) children(); }

// Something in the frame of a link, at a place [x, y, angle].
module at_place(place) { translate([place[0], place[1], 0]) rotate(place[2]) children(); }

function on_coupler(place, p) = [
  place[0] + cos(place[2]) * p[0] - sin(place[2]) * p[1],
  place[1] + sin(place[2]) * p[0] + cos(place[2]) * p[1]];

// A link with its x axis from one point towards another.
module towards(from, to) {
  translate([from[0], from[1], 0]) rotate(atan2(to[1] - from[1], to[0] - from[0])) children();
}

module pin(low, high) {
  translate([0, 0, low * (thickness + gap)])
    cylinder(d = pin_diameter, h = (high - low) * (thickness + gap) + thickness);
}
"""


def write(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the model."""
    assembly = assembly_of(chosen, options)
    made = assembly.dimensions
    lines = [f"// {line_comment(line)}" for line in description(chosen, options, "mm")]
    lines += [
        "// View > Animate plays the motion, with FPS 25 and Steps 100. At $t = 0 the "
        f"{assembly.body} is",
        "// at the chosen pose.",
        "",
        f"width = {number(made.width)};",
        f"hole = {number(made.hole)};",
        f"pin_diameter = {number(made.pin)};",
        f"thickness = {number(made.thickness)};",
        f"gap = {number(made.gap)};",
        f"pose = {options.pose};  // drawn at $t = 0",
        "$fn = 96;",
        "",
    ]
    shown = []
    for plate in assembly.plates:
        name = plate.name.replace("-", "_")
        if plate.fixed is not None and plate.moving is not None:
            lines += [
                f"{name}_length = {number(float(plate.holes[1, 0]))};",
                f"{name}_fixed = {_list(plate.fixed)};  // on the ground",
                f"{name}_moving = {_list(plate.moving)};  // on the coupler",
            ]
        else:
            lines += [
                f"{name}_pieces = [{', '.join(map(_list, plate.pieces))}];",
                f"{name}_holes = {_list(plate.holes[:, :2])};",
                f"{name}_slots = {_list(plate.slots[:, :4])};",
            ]
        lines.append(f"{name}_layer = {plate.layer};")
        if plate.fixed is not None:
            place = f"towards({name}_fixed, on_coupler(place, {name}_moving)) "
        else:
            place = _at(assembly, plate.owner)
        colour = GROUNDS.get(name) or COLOURS[assembly.moving.index(plate.owner)]
        shown.append(f'layer({name}_layer) {place}color("{colour}") {name}();')
    for pin in assembly.pins:
        where = f"translate([{number(pin.x)}, {number(pin.y)}, 0]) pin({pin.low}, {pin.high});"
        holder = assembly.plate(pin.plate)
        assert holder is not None
        shown.append(_at(assembly, holder.owner) + where)
    pick = np.unique(np.linspace(0, assembly.motion.shape[0] - 1, MOTION_ROWS).round().astype(int))
    for plate in assembly.plates:
        if plate.owner == GROUND or plate.fixed is not None:
            continue
        own = _prefix(assembly, plate.owner)
        lines += [
            "",
            f"// x, y, angle in degrees: of the {plate.owner} at the poses, and along the motion.",
            f"{own}poses = {_places(plate.at(assembly.poses))};",
            f"{own}motion = {_places(plate.at(assembly.motion)[pick])};",
            f"{own}place = $t == 0 ? {own}poses[pose - 1] "
            f": {own}motion[floor($t * len({own}motion))];",
        ]
    lines.append(MODULES)
    for plate in assembly.plates:
        name = plate.name.replace("-", "_")
        if plate.fixed is None:
            body = f"plate({name}_pieces, {name}_holes, {name}_slots);"
        else:
            body = f"plate([[[0, 0], [{name}_length, 0]]], [[0, 0], [{name}_length, 0]], []);"
        lines.append(f"module {name}() {{ {body} }}")
    path.write_text("\n".join([*lines, "", *shown, ""]), encoding="utf-8", newline="\n")


def _prefix(assembly: Assembly, link: str) -> str:
    """What the names of a link's places begin with; those of the body with nothing."""
    return "" if link == assembly.body else f"{link.replace('-', '_')}_"


def _at(assembly: Assembly, link: str) -> str:
    """What puts something of a link to its place."""
    return "" if link == GROUND else f"at_place({_prefix(assembly, link)}place) "


def _list(values: FloatArray) -> str:
    return json.dumps((values + 0.0).tolist())


def _places(places: Displacement) -> str:
    rows = np.column_stack([places.translation, np.degrees(places.angle)])
    return "[\n  " + ",\n  ".join(_list(row) for row in rows) + "\n]"


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the numbers back and compare them; raises E160."""
    reference = reference_of(chosen, options)
    tolerance = PRECISION * reference.span
    text = re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
    values = {name: json.loads(value) for name, value in NUMBERS.findall(text)}
    if isinstance(reference, SixBarReference):
        _check_six_bar(reference, values, tolerance)
        return
    rows = np.array(values["poses"])
    require_equal("the places", rows[:, :2], reference.places.translation, tolerance)
    require_equal("the angles", np.radians(rows[:, 2]), reference.places.angle, 1e-12)
    path_rows = np.array(values["motion"])
    missed = reference.closure_error(Displacement(path_rows[:, :2], np.radians(path_rows[:, 2])))
    require_equal("the links along the motion", missed, 0, tolerance)
    on_ground = np.array(values["ground_holes"] + values.get("ground_2_holes", [])).reshape(-1, 2)
    on_coupler = np.array(values["coupler_holes"]).reshape(-1, 2)
    for side, name in ((0, "driver"), (1, "follower")):
        fixed, moving, radius = (
            reference.fixed[side],
            reference.moving[side],
            reference.radius[side],
        )
        if radius is not None:
            assert fixed is not None
            assert moving is not None
            require_equal(f"the length of the {name}", values[f"{name}_length"], radius, tolerance)
            require_equal(f"the {name}'s fixed pivot", values[f"{name}_fixed"], fixed, tolerance)
            require_equal(f"the {name}'s moving pivot", values[f"{name}_moving"], moving, tolerance)
        for holes, point in ((on_ground, fixed), (on_coupler, moving)):
            if point is not None:
                gap = np.linalg.norm(holes - point, axis=1).min(initial=np.inf)
                require_equal(f"a hole for the {name}", gap, 0, tolerance)
        if (line := reference.line[side]) is not None:
            where = ("ground", "ground_2") if reference.kinds[side] == "PR" else ("coupler",)
            slots = np.array([each for name in where for each in values.get(f"{name}_slots", [])])
            ends = slots.reshape(-1, 2, 2)
            off = np.abs(ends @ [np.cos(line[0]), np.sin(line[0])] - line[1]).max(axis=1)
            require_equal(f"the slot of the {name}", off.min(initial=np.inf), 0, tolerance)


def _check_six_bar(reference: SixBarReference, values: Mapping[str, Any], tolerance: float) -> None:
    """Raise E160 where links do not meet at their joints, or joints at poses are elsewhere."""
    where: dict[str, dict[str, list[FloatArray]]] = {}
    at, body = reference.at, plates_of(reference.found.skeleton)[reference.found.carries]
    for link, joints in reference.plates.items():
        name = link.replace("-", "_")
        holes = np.array(values[f"{name}_holes"] + values.get(f"{name}_2_holes", []))
        require_equal(f"the number of holes of the {link}", len(holes), len(joints), 0)
        if link == GROUND:  # a second ground may hold any of them
            pivots = np.array([at[joint][0] for joint in joints])
            holes = holes[np.linalg.norm(holes - pivots[:, None], axis=-1).argmin(axis=-1)]
        own = "" if link == body else f"{name}_"
        for table in ("poses", "motion"):
            rows = np.array(values[f"{table if link == GROUND else own + table}"])
            places = Displacement(rows[:, :2], np.radians(rows[:, 2]))
            if link == GROUND:
                places = Displacement.identity(places.shape)
            for joint, hole in zip(joints, holes, strict=True):
                where.setdefault(joint, {}).setdefault(table, []).append(places.act(hole))
    for joint, tables in where.items():
        for one, two in tables.values():
            require_equal(f"joint {joint} of two links", one, two, tolerance)
        require_equal(f"joint {joint} at the poses", tables["poses"][0], at[joint], tolerance)
    rows = np.array(values["poses"])
    require_equal("the places", rows[:, :2], reference.places.translation, tolerance)
    turned = np.exp(1j * (np.radians(rows[:, 2]) - reference.places.angle))
    require_equal("the angles", np.abs(turned - 1), np.zeros(len(rows)), PRECISION)
