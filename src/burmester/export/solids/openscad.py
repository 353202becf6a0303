"""OpenSCAD (millimetres): numbers at the top, a module per link, moved by $t through the poses.

The links are made from the numbers: pivots, holes, widths and thicknesses can be changed there.
The places of the coupler are a table; its links turn towards their pivots.

E160 the file does not contain the linkage
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np

from burmester.export.escaping import line_comment
from burmester.export.numbers import number
from burmester.export.options import Options
from burmester.export.parts.plates import assembly_of
from burmester.export.reference import PRECISION, Reference, description, require_equal
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = ["check", "write"]

NUMBERS = re.compile(r"^(\w+) = ([-+.\d\[][^;a-z]*(?:e[-+]?\d[^;a-z]*)*);", re.MULTILINE)
MOTION_ROWS = 121  # rows of the motion
COLOURS = {
    "ground": "DimGray",
    "ground_2": "DarkGray",
    "driver": "FireBrick",
    "coupler": "SteelBlue",
    "follower": "SeaGreen",
}
MODULES = """
// A plate around points, with round holes and slots [x1, y1, x2, y2].
module plate(points, holes, slots) {
  linear_extrude(thickness) difference() {
    hull() for (p = points) translate(p) circle(d = width);
    for (h = holes) translate(h) circle(d = hole);
    for (s = slots) hull() {
      translate([s[0], s[1]]) circle(d = hole);
      translate([s[2], s[3]]) circle(d = hole);
    }
  }
}

// Something of the layer with that number.
module layer(number) { translate([0, 0, number * (thickness + gap)]) children(); }

// Something in the frame of the coupler, at a place [x, y, angle].
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


def write(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write the model."""
    assembly = assembly_of(chosen, options)
    made = assembly.dimensions
    motion = assembly.motion
    pick = np.unique(np.linspace(0, motion.shape[0] - 1, MOTION_ROWS).round().astype(int))
    lines = [f"// {line_comment(line)}" for line in description(chosen, options, "mm")]
    lines += [
        "// View > Animate plays the motion, with FPS 25 and Steps 100. At $t = 0 the coupler is",
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
                f"{name}_points = {_list(plate.skeleton)};",
                f"{name}_holes = {_list(plate.holes[:, :2])};",
                f"{name}_slots = {_list(plate.slots[:, :4])};",
            ]
        lines.append(f"{name}_layer = {plate.layer};")
        if plate.owner == "ground":
            place = ""
        elif plate.owner == "coupler":
            place = "at_place(place) "
        else:
            place = f"towards({name}_fixed, on_coupler(place, {name}_moving)) "
        colour = COLOURS[name]
        shown.append(f'layer({name}_layer) {place}color("{colour}") {name}();')
    for pin in assembly.pins:
        where = f"translate([{number(pin.x)}, {number(pin.y)}, 0]) pin({pin.low}, {pin.high});"
        shown.append(f"at_place(place) {where}" if pin.plate == "coupler" else where)
    lines += [
        "",
        "// x, y, angle in degrees: of the coupler at the poses, and along the motion.",
        f"poses = {_places(assembly.places)};",
        f"motion = {_places(motion[pick])};",
        "place = $t == 0 ? poses[pose - 1] : motion[floor($t * len(motion))];",
        MODULES,
    ]
    for plate in assembly.plates:
        name = plate.name.replace("-", "_")
        if plate.fixed is None:
            body = f"plate({name}_points, {name}_holes, {name}_slots);"
        else:
            body = f"plate([[0, 0], [{name}_length, 0]], [[0, 0], [{name}_length, 0]], []);"
        lines.append(f"module {name}() {{ {body} }}")
    path.write_text("\n".join([*lines, "", *shown, ""]), encoding="utf-8", newline="\n")


def _list(values: FloatArray) -> str:
    return json.dumps((values + 0.0).tolist())


def _places(places: Displacement) -> str:
    rows = np.column_stack([places.translation, np.degrees(places.angle)])
    return "[\n  " + ",\n  ".join(_list(row) for row in rows) + "\n]"


def check(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Read the numbers back and compare them; raises E160."""
    reference = Reference.of(chosen, options)
    tolerance = PRECISION * reference.span
    text = re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
    values = {name: json.loads(value) for name, value in NUMBERS.findall(text)}
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
