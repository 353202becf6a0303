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

from burmester.export.description import description, number, one_line
from burmester.export.options import PRECISION, Options, Reference, as_rows, require_equal
from burmester.export.parts.plates import Assembly, assembly_of
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import GROUND, LinkPlaces
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

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
    lines = [f"// {one_line(line)}" for line in description(chosen, options, "mm")]
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
            f"{own}poses = {_places(plate.at(assembly.reference.at_poses))};",
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
    """Read the numbers back and compare them; raises E160.

    Holes and slots are where the links have them, links meet at their joints in both tables, and
    the body is where it is for the poses.
    """
    reference = Reference.of(chosen, options)
    tolerance = PRECISION * reference.span
    text = re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
    values = {name: json.loads(value) for name, value in NUMBERS.findall(text)}
    for link, joints in reference.links.items():
        holes, slots = _cut_out(values, link)
        for joint in joints:
            if link in joint.holes:
                off = np.linalg.norm(holes - joint.holes[link], axis=1)
            else:
                assert joint.slot is not None
                normal, _ = joint.slot.directions
                off = np.abs(slots @ normal - joint.slot.offset).max(axis=1)
            require_equal(f"a hole of the {link}", off.min(initial=np.inf), 0, tolerance)
    for table in ("poses", "motion"):
        body = _read_places(values[table])
        places = {link: _read_link(values, link, table, body) for link in reference.links}
        places[reference.body] = body
        missed = reference.closure_error(LinkPlaces(places))
        require_equal(f"the links at the {table}", missed, 0, tolerance)
    at_poses, wanted = _read_places(values["poses"]), reference.places
    require_equal("the places", at_poses.translation, wanted.translation, tolerance)
    require_equal("the angles", as_rows(at_poses)[:, 2:], as_rows(wanted)[:, 2:], PRECISION)


def _cut_out(values: Mapping[str, Any], link: str) -> tuple[FloatArray, FloatArray]:
    """The centres (n, 2) of a link's holes, and the ends (m, 2, 2) of its slots."""
    name = link.replace("-", "_")
    if f"{name}_length" in values:
        return np.array([[0.0, 0.0], [values[f"{name}_length"], 0.0]]), np.empty((0, 2, 2))
    both = (name, f"{name}_2")  # a second ground may hold some of them
    holes, slots = (
        [each for own in both for each in values.get(f"{own}_{what}", [])]
        for what in ("holes", "slots")
    )
    return np.reshape(holes, (-1, 2)), np.reshape(slots, (-1, 2, 2))


def _read_link(
    values: Mapping[str, Any], link: str, table: str, body: Displacement
) -> Displacement:
    """The places (n,) of a link that is not the body."""
    name = link.replace("-", "_")
    if f"{name}_{table}" in values:
        return _read_places(values[f"{name}_{table}"])
    if f"{name}_fixed" not in values:
        return Displacement.identity(body.shape)
    fixed = np.array(values[f"{name}_fixed"])
    arm = body.act(np.array(values[f"{name}_moving"])) - fixed
    return Displacement(np.broadcast_to(fixed, arm.shape), np.arctan2(arm[:, 1], arm[:, 0]))


def _read_places(rows: list[list[float]]) -> Displacement:
    return Displacement(np.array(rows)[:, :2], np.radians(np.array(rows)[:, 2]))
