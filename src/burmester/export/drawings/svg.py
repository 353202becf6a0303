"""SVG, 1:1 in millimetres: the plates laid out for cutting, and the assembly above them.

Everything has its last coordinates in the file, y downwards, without transformations: programs
for cutters do not all know them.  Lines are hairlines; classes say what they are.

E160 the file does not contain the linkage
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from pathlib import Path
from xml.etree import ElementTree
from xml.sax.saxutils import unescape

import numpy as np

from burmester.export.description import error_within, xml_text
from burmester.export.drawings.dimension_lines import DimensionLine
from burmester.export.drawings.drawing import Drawing, Item, Kind, halved, require_drawing
from burmester.export.options import Options, require_equal
from burmester.export.parts.plates import Assembly
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

DIGITS = 15  # of each number
LINE_WIDTH_MM = 0.1  # at most, and no more than a share of the link width
OF_WIDTH = 0.02
FONT_MIDDLE = 0.36  # of a font's size: middle of its capitals above the base line
INKSCAPE = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
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
    drawing = Drawing.of(chosen, options)
    assembly, sheet, items = drawing.assembly, drawing.sheet, drawing.items
    hair = min(LINE_WIDTH_MM, OF_WIDTH * assembly.dimensions.width)
    size = sheet.high - sheet.low
    box = f"{_n(sheet.low[0])} {_n(-sheet.high[1])} {_n(size[0])} {_n(size[1])}"
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" {INKSCAPE} width="{_n(size[0])}mm" '
        f'height="{_n(size[1])}mm" viewBox="{box}" role="img">',
        f"<title>{xml_text(drawing.notes[0])}</title>",
        f"<desc>{' '.join(map(xml_text, drawing.notes[1:]))}</desc>",
        f"<style>{STYLE % (_n(hair), _n(sheet.letters))}{_colours(assembly)}</style>",
        '<g id="parts">',
    ]
    owners = {plate.name: plate.owner for plate in assembly.plates}

    def drawn(group: str) -> list[str]:
        """What is of a plate, or of a region."""
        owner = owners.get(group.removeprefix("placed-"), "")
        own = (each for each in items if each.group == group and each.role != "name")
        return [_item(each, owner) for each in own]

    for part in sheet.parts:
        lines += [f'<g id="part-{part.plate.name}">', *drawn(part.plate.name), "</g>"]
    lines += ["</g>", '<g id="names">']
    lines += [_item(each) for each in items if each.role == "name"]
    lines.append("</g>")
    if options.dimensions:
        lines.append('<g id="dimensions" inkscape:groupmode="layer" inkscape:label="dimensions">')
        for part in sheet.parts:
            lines.append(f'<g id="dimensions-{part.plate.name}">')
            for line in part.lines:
                lines += _dimension(line)
            lines.append("</g>")
        lines.append("</g>")
    lines.append('<g id="keep-out" inkscape:groupmode="layer" inkscape:label="keep out">')
    for group in dict.fromkeys(each.group for each in items if each.role == "keep-out"):
        lines += ['<g class="region">', *drawn(group), "</g>"]
    lines += ["</g>", '<g id="body" inkscape:groupmode="layer" inkscape:label="body">']
    lines += [_item(each) for each in items if each.role == "body"]
    lines += ["</g>", '<g id="assembly">']
    for plate in sorted(assembly.plates, key=lambda each: each.layer):
        group = f"placed-{plate.name}"
        lines += [f'<g id="{group}">', *drawn(group), "</g>"]
    for name, role in (("poses", "pose"), ("notes", "note")):
        lines += ["</g>", f'<g id="{name}">', *(_item(each) for each in items if each.role == role)]
    lines += ["</g>", "</svg>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _colours(assembly: Assembly) -> str:
    """Those of links that the style does not name."""
    return "".join(
        f"  .{name} {{ stroke: {colour} }}\n"
        for name, colour in zip(assembly.moving, COLOURS, strict=False)
        if f" .{name} " not in STYLE
    )


def _item(item: Item, owner: str = "") -> str:
    """An element; owner: the link that it is of."""
    kind, role, at, _, text = item
    match kind:
        case "circle":
            x, y, diameter = at.tolist()
            return f'<circle class="{role}" cx="{_n(x)}" cy="{_n(-y)}" r="{_n(diameter / 2)}"/>'
        case "line":
            (x1, y1), (x2, y2) = at.tolist()
            ends = f'x1="{_n(x1)}" y1="{_n(-y1)}" x2="{_n(x2)}" y2="{_n(-y2)}"'
            return f'<line class="{role}" {ends}/>'
        case "arrow":
            corners = " ".join(f"{_n(x)},{_n(-y)}" for x, y in at.tolist())
            return f'<polygon class="{role}" points="{corners}"/>'
        case "text":
            named = "" if role in ("name", "note") else f' class="{role}"'
            return f'<text{named} x="{_n(at[0])}" y="{_n(-at[1])}">{xml_text(text)}</text>'
        case "outline":
            named = f"outline {owner}" if role == "outline" else role
            return f'<path class="{named}" d="{_path(at)}"/>'


def _dimension(line: DimensionLine) -> list[str]:
    """A dimension line with its arrows and its text, of which the middle is given."""
    # The middle of capitals is 0.36 of their size above the base line.
    foot = line.at - [0, FONT_MIDDLE * line.letters]
    return [
        f'<g class="{line.kind}" data-length="{_n(line.value)}">',
        *(_item(Item("line", "dimension", ends)) for ends in line.lines),
        *(_item(Item("arrow", "dimension", corners)) for corners in line.arrows),
        _item(Item("text", "dimension", foot, text=line.text)),
        "</g>",
    ]


def _path(outline: FloatArray) -> str:
    """The outline with arcs of circles; y downwards turns their sense round."""
    outline = halved(outline)
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


def _n(value: float) -> str:
    return f"{float(value) + 0.0:.{DIGITS}g}"


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the drawing back by its XML and compare it; raises E160."""
    drawing = Drawing.of(chosen, options)
    root = ElementTree.parse(path).getroot()
    wide, _, _ = (root.get("width") or "").partition("mm")
    box = [float(part) for part in (root.get("viewBox") or "").split()]
    require_equal("millimetres per unit of the drawing", float(wide) / box[2], 1, 1e-12)
    read = list(_read(root, FONT_MIDDLE * drawing.sheet.letters))
    # The assembly is drawn from its lowest layer upwards.
    order = {f"placed-{plate.name}": k for k, plate in enumerate(drawing.assembly.plates)}
    read.sort(key=lambda each: order.get(each.group, -1))
    largest = max(float(np.abs(each.at).max()) for each in read if each.kind == "outline")
    tolerance = error_within(DIGITS, largest)
    require_drawing(read, drawing, tolerance, lambda text: unescape(xml_text(text)))
    told = [each.get("data-length") for each in root.iter()]
    lengths = [line.value for _, line in drawing.dimensions]
    require_equal("the lengths", [float(each) for each in told if each], lengths, tolerance)


def _read(root: ElementTree.Element, raised: float, inside: str = "") -> Iterable[Item]:
    """The items of a group and of all that are in it; raised: the middle of a dimension's text."""
    kinds: dict[str, Kind] = {
        "path": "outline",
        "circle": "circle",
        "line": "line",
        "polygon": "arrow",
        "text": "text",
    }
    for each in root:
        tag = each.tag.rpartition("}")[2]
        if tag == "g":
            yield from _read(each, raised, each.get("id") or inside)
        if tag not in kinds:
            continue
        role = (each.get("class") or inside.removesuffix("s")).split()[0]
        keys = {"circle": ("cx", "cy", "r"), "line": ("x1", "y1", "x2", "y2"), "text": ("x", "y")}
        at = np.array([float(each.get(key) or "nan") for key in keys.get(tag, ())])
        if tag == "path":
            at = _read_path(each.get("d") or "")
        elif tag == "polygon":
            corners = (each.get("points") or "").split()
            at = np.array([[float(x) for x in corner.split(",")] for corner in corners]) * [1, -1]
        elif tag == "circle":
            at = at * [1, -1, 2]
        else:
            at = (at.reshape(-1, 2) * [1, -1]).reshape((2,) if tag == "text" else (2, 2))
            if tag == "text" and role == "dimension":
                at[1] += raised
        yield Item(kinds[tag], role, at, inside.removeprefix("part-"), each.text or "")  # type: ignore[arg-type]


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
