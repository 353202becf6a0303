"""SVG, 1:1 in millimetres: the plates laid out for cutting, and the assembly above them.

Everything has its last coordinates in the file, y downwards, without transformations: programs
for cutters do not all know them.  Lines are hairlines; classes say what they are.

E160 the file does not contain the linkage
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from burmester.export.description import (
    description,
    dimension_notes,
    length_decimals,
    reference_of,
)
from burmester.export.drawings.dimension_lines import DimensionLine
from burmester.export.drawings.measured import Measured, require_dimensions, require_drawn
from burmester.export.drawings.outlines import Outlines, hatch, name_start, require_outlines
from burmester.export.drawings.sheet import beside, carried, joint_names, notes_on, sheet_of
from burmester.export.escaping import xml_text
from burmester.export.numbers import error_within
from burmester.export.options import Options
from burmester.export.parts.holes import joints_of
from burmester.export.parts.plate import moved
from burmester.export.parts.plates import Assembly, Plate, assembly_of, slot_outline
from burmester.export.reference import require_equal
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

__all__ = ["check", "write"]

DIGITS = 15  # of each number
LINE_WIDTH_MM = 0.1  # at most, and no more than a share of the link width
OF_WIDTH = 0.02
FONT_MIDDLE = 0.36  # of a font's size: middle of its capitals above the base line
INKSCAPE = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
MAX_BULGE = 0.57  # bulge above which an arc is drawn as two
COLOURS = ("#c1272d", "#0057b8", "#1b7f3b", "#b36b00", "#6b3fa0")  # of moving links
STYLE = """
  path, circle, line { fill: none; stroke: #000; stroke-width: %s; stroke-linejoin: round }
  .driver { stroke: #c1272d } .coupler { stroke: #0057b8 } .follower { stroke: #1b7f3b }
  .first-crank { stroke: #c1272d } .second-crank { stroke: #1b7f3b }
  .floating-link { stroke: #b36b00 } .body-link { stroke: #6b3fa0 }
  .ground { stroke: #555 } .hole, .slot { stroke: #000 }
  .mark { stroke: #888 } .pose { stroke: #a3238e } text.pose { stroke: none; fill: #a3238e }
  .body { stroke: #00785a } .keep-out { stroke: #666 } .hatch { stroke: #999 }
  text.keep-out { stroke: none; fill: #444 }
  .dimension { stroke: #a65200 } polygon.dimension { stroke: none; fill: #a65200 }
  text.dimension { stroke: none; fill: #a65200; text-anchor: middle }
  text { text-rendering: geometricPrecision; font-family: sans-serif; font-size: %spx; fill: #000 }
"""


def write(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the drawing."""
    assembly = assembly_of(chosen, options)
    reference = reference_of(chosen, options)
    poses, outlines = reference.poses, Outlines.of(chosen.task, reference)
    notes = description(chosen, options, "mm") + dimension_notes(chosen, options)
    notes += notes_on(assembly)
    decimals = length_decimals(chosen, options)
    sheet = sheet_of(assembly, poses, len(notes), decimals, options.dimensions, outlines=outlines)
    hair = min(LINE_WIDTH_MM, OF_WIDTH * assembly.dimensions.width)
    size = sheet.high - sheet.low
    box = f"{_n(sheet.low[0])} {_n(-sheet.high[1])} {_n(size[0])} {_n(size[1])}"
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" {INKSCAPE} width="{_n(size[0])}mm" '
        f'height="{_n(size[1])}mm" viewBox="{box}" role="img">',
        f"<title>{xml_text(notes[0])}</title>",
        f"<desc>{' '.join(map(xml_text, notes[1:]))}</desc>",
        f"<style>{STYLE % (_n(hair), _n(sheet.letters))}{_colours(assembly)}</style>",
        '<g id="parts">',
    ]
    for part in sheet.parts:
        lines.append(f'<g id="part-{part.plate.name}">')
        lines += _plate(moved(part.plate, part.place), part.plate.owner, sheet.letters)
        lines.append("</g>")
    lines += ["</g>", '<g id="names">']
    lines += [_text(part.label, at) for part, at in zip(sheet.parts, sheet.labels, strict=True)]
    lines += [_text(name, at) for name, at in joint_names(assembly, sheet)]
    lines.append("</g>")
    if options.dimensions:
        lines.append('<g id="dimensions" inkscape:groupmode="layer" inkscape:label="dimensions">')
        for part in sheet.parts:
            lines.append(f'<g id="dimensions-{part.plate.name}">')
            for line in part.lines:
                lines += _dimension(line)
            lines.append("</g>")
        lines.append("</g>")
    lines += _outlines(outlines, sheet.letters)
    lines.append('<g id="assembly">')
    for plate in sorted(assembly.plates, key=lambda each: each.layer):
        lines.append(f'<g id="placed-{plate.name}">')
        lines += _plate(moved(plate, plate.at(assembly.drawn)), plate.owner, sheet.letters)
        lines.append("</g>")
    lines += ["</g>", '<g id="poses">']
    for number in range(poses.shape[0]):
        ends = poses[number][None].act(
            np.array([[0.0, 0.0], [sheet.axes, 0.0], [0.0, sheet.axes / 2]])
        )
        lines += [_line(ends[0], end, "pose") for end in ends[1:]]
        lines.append(_text(str(number + 1), beside(poses[number], sheet), ' class="pose"'))
    lines += ["</g>", '<g id="notes">']
    for k, note in enumerate(notes):
        lines.append(_text(note, sheet.notes - [0, 1.6 * k * sheet.letters]))
    lines += ["</g>", "</svg>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _colours(assembly: Assembly) -> str:
    """Those of links that the style does not name."""
    return "".join(
        f"  .{name} {{ stroke: {colour} }}\n"
        for name, colour in zip(assembly.moving, COLOURS, strict=False)
        if f" .{name} " not in STYLE
    )


def _plate(
    drawn: tuple[FloatArray, FloatArray, FloatArray, FloatArray], owner: str, letters: float
) -> list[str]:
    outline, holes, slots, marks = drawn
    lines = [f'<path class="outline {owner}" d="{_path(outline)}"/>']
    lines += [
        f'<circle class="hole" cx="{_n(x)}" cy="{_n(-y)}" r="{_n(diameter / 2)}"/>'
        for x, y, diameter in holes.tolist()
    ]
    lines += [f'<path class="slot" d="{_path(slot_outline(slot))}"/>' for slot in slots]
    for mark in marks:
        for way in ([0.3 * letters, 0], [0, 0.3 * letters]):
            lines.append(_line(mark - way, mark + way, "mark"))
    return lines


def _outlines(outlines: Outlines, letters: float) -> list[str]:
    """Two groups, layers in Inkscape, of which either may have nothing in it."""
    lines = ['<g id="keep-out" inkscape:groupmode="layer" inkscape:label="keep out">']
    for name, corners in outlines.regions:
        lines.append('<g class="region">')
        lines.append(f'<path class="keep-out" d="{_path(_straight(corners))}"/>')
        lines += [_line(start, end, "hatch") for start, end in hatch(corners, letters)]
        if name:
            lines.append(_text(name, name_start(name, corners, letters), ' class="keep-out"'))
        lines.append("</g>")
    lines += ["</g>", '<g id="body" inkscape:groupmode="layer" inkscape:label="body">']
    if outlines.body.size:
        lines += [f'<path class="body" d="{_path(_straight(each))}"/>' for each in outlines.body]
    return [*lines, "</g>"]


def _straight(corners: FloatArray) -> FloatArray:
    """Corners (k, 2) as an outline (k, 3) without arcs."""
    return np.column_stack([corners, np.zeros(len(corners))])


def _dimension(line: DimensionLine) -> list[str]:
    """A dimension line with its arrows and its text, of which the middle is given."""
    told = f'<g class="{line.kind}" data-length="{_n(line.value)}">'
    lines = [_line(start, end, "dimension") for start, end in line.lines]
    for arrow in line.arrows:
        corners = " ".join(f"{_n(x)},{_n(-y)}" for x, y in arrow.tolist())
        lines.append(f'<polygon class="dimension" points="{corners}"/>')
    # The middle of capitals is 0.36 of their size above the base line.
    foot = line.at - [0, FONT_MIDDLE * line.letters]
    return [told, *lines, _text(line.text, foot, ' class="dimension"'), "</g>"]


def _halved(outline: FloatArray) -> FloatArray:
    """The outline with its arcs of a third of a turn or more in two.

    Its ends and its radius determine half a circle to half the digits only.
    """
    rows: list[list[float]] = []
    for (x0, y0, bulge), (x, y, _) in zip(
        outline.tolist(), np.roll(outline, -1, axis=0).tolist(), strict=True
    ):
        if abs(bulge) < MAX_BULGE:
            rows.append([x0, y0, bulge])
            continue
        half = math.tan(math.atan(bulge) / 2)
        middle = (x0 + x + bulge * (y - y0)) / 2, (y0 + y - bulge * (x - x0)) / 2
        rows += [[x0, y0, half], [*middle, half]]
    return np.array(rows)


def _path(outline: FloatArray) -> str:
    """The outline with arcs of circles; y downwards turns their sense round."""
    outline = _halved(outline)
    x, y, _ = outline[0].tolist()
    parts = [f"M{_n(x)} {_n(-y)}"]
    for (x0, y0, bulge), (x, y, _) in zip(
        outline.tolist(), np.roll(outline, -1, axis=0).tolist(), strict=True
    ):
        if bulge == 0:
            parts.append(f"L{_n(x)} {_n(-y)}")
        else:
            # Chord and bulge give the radius of the arc.
            radius = math.hypot(x - x0, y - y0) * (1 + bulge * bulge) / (4 * abs(bulge))
            wide, sense = int(abs(bulge) > 1), int(bulge < 0)
            parts.append(f"A{_n(radius)} {_n(radius)} 0 {wide} {sense} {_n(x)} {_n(-y)}")
    return " ".join([*parts, "Z"])


def _line(start: FloatArray, end: FloatArray, name: str) -> str:
    (x1, y1), (x2, y2) = start.tolist(), end.tolist()
    ends = f'x1="{_n(x1)}" y1="{_n(-y1)}" x2="{_n(x2)}" y2="{_n(-y2)}"'
    return f'<line class="{name}" {ends}/>'


def _text(text: str, at: FloatArray, more: str = "") -> str:
    return f'<text{more} x="{_n(at[0])}" y="{_n(-at[1])}">{xml_text(text)}</text>'


def _n(value: float) -> str:
    return f"{float(value) + 0.0:.{DIGITS}g}"


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the drawing back by its XML and compare it; raises E160."""
    reference = reference_of(chosen, options)
    assembly = assembly_of(chosen, options)
    root = ElementTree.parse(path).getroot()
    groups = {each.get("id"): each for each in root.iter() if each.get("id")}
    wide, _, _ = (root.get("width") or "").partition("mm")
    box = [float(part) for part in (root.get("viewBox") or "").split()]
    require_equal("millimetres per unit of the drawing", float(wide) / box[2], 1, 1e-12)
    drawn = np.concatenate([path for each in groups.values() for path in _paths(each)])
    tolerance = error_within(DIGITS, float(np.abs(drawn).max()))
    for joint in joints_of(reference, assembly, options.pose):
        if joint.point is not None:
            holes = [each for name in joint.plates for each in _holes(groups[f"placed-{name}"])]
            gap = np.linalg.norm(np.reshape(holes, (-1, 3))[:, :2] - joint.point, axis=1)
            what = f"a pivot in the {joint.plates[0]}"
            require_equal(what, gap.min(initial=np.inf), 0, tolerance)
    placed, read = list[tuple[Plate, Displacement]](), list[Measured]()
    for plate in assembly.plates:
        group = groups[f"part-{plate.name}"]
        half = replace(plate, outline=_halved(plate.outline))
        placed.append((plate, carried(half, _paths(group)[0])))
        _check_plate(group, *placed[-1], tolerance)
        if options.dimensions:
            read += [_measured(each, tolerance) for each in groups[f"dimensions-{plate.name}"]]
        group = groups[f"placed-{plate.name}"]
        _check_plate(group, plate, plate.at(assembly.drawn), tolerance)
    if options.dimensions:
        require_dimensions(placed, read, tolerance)
    outlines = Outlines.of(chosen.task, reference)
    regions = [path for each in groups["keep-out"] for path in _paths(each)]
    require_outlines(outlines, _paths(groups["body"]), regions, tolerance)
    lines = _lines(groups["poses"])
    start, way = lines[::2, :2], lines[::2, 2:] - lines[::2, :2]
    require_equal("the places of the poses", start, reference.poses.translation, tolerance)
    require_equal("their second axes", lines[1::2, :2], start, tolerance)
    angle = np.exp(1j * (np.arctan2(way[:, 1], way[:, 0]) - reference.poses.angle))
    require_equal("the angles of the poses", np.abs(angle - 1), np.zeros(len(angle)), 1e-6)


def _check_plate(
    group: ElementTree.Element, plate: Plate, by: Displacement, tolerance: float
) -> None:
    """Compare what a group draws with a plate carried by a displacement."""
    outline, holes, slots, _ = moved(plate, by)
    drawn, *inside = _paths(group)
    require_equal(f"the outline of {plate.name}", drawn, _halved(outline), tolerance)
    read = np.array(_holes(group)).reshape(-1, 3)
    require_equal(f"the holes of {plate.name}", read, holes, tolerance)
    require_equal(f"the number of slots of {plate.name}", len(inside), len(slots), 0)
    for rows, slot in zip(inside, slots, strict=True):
        require_equal(f"a slot of {plate.name}", rows, _halved(slot_outline(slot)), tolerance)


def _paths(group: ElementTree.Element) -> list[FloatArray]:
    return [_read_path(each.get("d") or "") for each in group if each.tag.endswith("path")]


def _lines(group: ElementTree.Element) -> FloatArray:
    """The lines (n, 4) of a group, y upwards."""
    keys = ("x1", "y1", "x2", "y2")
    lines = np.array(
        [[float(e.get(k) or "nan") for k in keys] for e in group.iter() if e.tag.endswith("line")]
    )
    lines[:, 1::2] *= -1
    return lines


def _measured(group: ElementTree.Element, tolerance: float) -> Measured:
    """A dimension line by its lines: where its extension lines begin, or from its leader's tip."""
    value = float(group.get("data-length") or "nan")
    lines = _lines(group).reshape(-1, 2, 2)
    diameter = group.get("class") == "diameter"
    if diameter:
        tip, elbow = lines[0]
        inwards = (tip - elbow) / np.linalg.norm(tip - elbow)
        ends = np.stack([tip + value * inwards, tip])
    else:
        ends = lines[1:, 0]
    require_drawn(lines, ends, diameter, tolerance)
    (text,) = (each.text or "" for each in group if each.tag.endswith("text"))
    return Measured(ends, value, text, diameter)


def _holes(group: ElementTree.Element) -> list[list[float]]:
    """Centre, y upwards, and diameter of the circles in a group."""
    found = []
    for each in group:
        if each.tag.endswith("circle"):
            x, y, r = (float(each.get(key) or "nan") for key in ("cx", "cy", "r"))
            found.append([x, -y, 2 * r])
    return found


def _read_path(d: str) -> FloatArray:
    """Rows (x, y, bulge), y upwards, of a closed path of lines and arcs; arcs by their radius."""
    rows: list[list[float]] = []
    for letter, text in re.findall(r"([MLAZ])([^MLAZ]*)", d):
        numbers = [float(part) for part in text.split()]
        if letter == "Z":
            continue
        x, y = numbers[-2], -numbers[-1]
        if letter == "A":
            x0, y0, _ = rows[-1]
            half = math.hypot(x - x0, y - y0) / (2 * numbers[0])
            angle = 2 * math.asin(min(half, 1.0))
            angle = 2 * math.pi - angle if numbers[3] else angle
            rows[-1][2] = math.tan(angle / 4) * (1 if numbers[4] == 0 else -1)
        rows.append([x, y, 0.0])
    first, last = rows[0], rows.pop()
    if math.hypot(last[0] - first[0], last[1] - first[1]) > 0:
        raise ValueError("the path is not closed")
    return np.array(rows)
