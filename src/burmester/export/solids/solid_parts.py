"""The solids of plates and pins, each in its place: extruded, with holes and slots; millimetres.

One layer lies over the other with a gap between, the first on z = 0.  Pins have a running fit.
`cad` is the build123d module, for it may be missing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, Final, NamedTuple

import numpy as np

from burmester.export.parts.plate import Plate, slot_outline
from burmester.export.parts.plates import Assembly
from burmester.geometry.displacement import Displacement
from burmester.geometry.outlines import outline_moments, rounded_hull
from burmester.mechanisms.bodies import GROUND
from burmester.numerics.arrays import FloatArray

MIN_EDGE: Final = 1e-4  # of a plate: shorter pieces of its outline are left out
FLAT_SPACING: Final = 2.0  # widths of a link between parts that are laid flat
GROUND_COLOUR, PIN_COLOUR = (0.48, 0.53, 0.58), (0.20, 0.24, 0.28)
COLOURS: Final = (  # of moving links
    (0.90, 0.62, 0.0),
    (0.0, 0.45, 0.70),
    (0.0, 0.62, 0.45),
    (0.84, 0.37, 0.0),
    (0.80, 0.47, 0.65),
)


TOUCHING_VOLUME: Final = 1e-6  # of a hole's volume: common volume up to which parts only touch
SAME_HEIGHT: Final = 1e-6  # mm: heights closer than this are equal
PLACES: Final = 12  # places along the motion at which parts are compared


class Part(NamedTuple):
    """A solid in a frame of its own, and where it lies: its frame in F, and the height of z = 0.

    area: of its outline without what is cut out; height: of the solid.
    """

    name: str
    kind: str
    colour: tuple[float, float, float]
    solid: Any
    place: Displacement
    z: float
    area: float
    height: float


def parts_of(cad: Any, made: Assembly) -> list[Part]:
    """The plates and pins of an assembly."""
    size = made.dimensions
    step = size.thickness + size.gap
    colours = {GROUND: GROUND_COLOUR, **dict(zip(made.moving, COLOURS, strict=False))}
    parts = [
        Part(
            plate.name,
            plate.owner,
            colours[plate.owner],
            cad.Solid.extrude(_face(cad, plate), (0, 0, size.thickness)),
            plate.at(made.drawn),
            plate.layer * step,
            area_of(plate),
            size.thickness,
        )
        for plate in made.plates
    ]
    places = {part.name: part.place for part in parts}
    for number, pin in enumerate(made.pins, start=1):
        radius = pin.diameter / 2
        height = (pin.high - pin.low) * step + size.thickness
        parts.append(
            Part(
                f"pin-{number}",
                "pin",
                PIN_COLOUR,
                cad.Solid.make_cylinder(radius, height),
                Displacement(places[pin.plate].act(np.array([pin.x, pin.y])), np.zeros(())),
                pin.low * step,
                math.pi * radius**2,
                height,
            )
        )
    return parts


def placed(cad: Any, part: Part) -> Any:
    """A copy of a part where it lies, with its name and colour."""
    x, y = part.place.translation.tolist()
    there = part.solid.moved(cad.Location((x, y, part.z), (0, 0, math.degrees(part.place.angle))))
    there.label = part.name
    there.color = cad.Color(*part.colour)
    return there


def laid(parts: Iterable[Part], made: Assembly) -> list[Part]:
    """The parts in a column, the longest first, each lengthwise, and the pins behind them."""
    plates = {plate.name: plate for plate in made.plates}
    apart = FLAT_SPACING * made.dimensions.width
    rows = []
    for part in parts:
        plate = plates.get(part.name)
        if plate is None:
            r = math.sqrt(part.area / math.pi)
            rows.append((part, Displacement.identity(), np.array([[-r, -r], [r, r]])))
            continue
        turn = Displacement(np.zeros(2), -np.arctan2(*plate.longest_way[::-1]))
        corners = turn.act(plate.skeleton)
        box = np.stack([corners.min(axis=0) - plate.radius, corners.max(axis=0) + plate.radius])
        rows.append((part, turn, box))
    rows.sort(key=lambda row: (row[0].kind == "pin", -float(np.ptp(row[2][:, 0]))))
    x, y, out = 0.0, 0.0, list[Part]()
    for part, turn, (low, high) in rows:
        place = Displacement(np.array([x, y]) - low, turn.angle)
        out.append(part._replace(place=place, z=0.0))
        if part.kind == "pin":  # side by side
            x += float(high[0] - low[0]) + apart
        else:
            y += float(high[1] - low[1]) + apart
    return out


def _face(cad: Any, plate: Plate) -> Any:
    """The plate's outline with its holes and slots, on z = 0."""
    inner = [
        cad.Wire.make_circle(diameter / 2, cad.Plane((x, y, 0))) for x, y, diameter in plate.holes
    ]
    inner += [_wire(cad, slot_outline(slot)) for slot in plate.slots]
    return cad.Face(_wire(cad, _plain(plate.outline)), inner)


def _plain(outline: FloatArray) -> FloatArray:
    """An outline (k, 3) without pieces so short that no mesh has room for them."""
    rows = [outline[0].copy()]
    least = MIN_EDGE * float(np.ptp(outline[:, :2], axis=0).max())
    for row in outline[1:]:
        if np.hypot(*(row - rows[-1])[:2]) < least:
            rows[-1][2] = row[2]  # what comes after the short piece follows here
        else:
            rows.append(row.copy())
    return np.array(rows)


def _wire(cad: Any, outline: FloatArray) -> Any:
    """A closed outline (k, 3) x, y, bulge as lines and arcs."""
    edges = []
    for (x, y, bulge), (u, v, _) in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        if bulge == 0:
            edges.append(cad.Edge.make_line((x, y), (u, v)))
        else:
            middle = ((x + u + bulge * (v - y)) / 2, (y + v - bulge * (u - x)) / 2)
            edges.append(cad.Edge.make_three_point_arc((x, y), middle, (u, v)))
    return cad.Wire(edges)


def area_of(plate: Plate) -> float:
    """The area of a plate without its holes and slots."""
    cuts = [rounded_hull(each[None, :2], each[2] / 2) for each in plate.holes]
    cuts += [slot_outline(each) for each in plate.slots]
    outline, *areas = (
        outline_moments(each, plate.outline[0, :2])[0] for each in (_plain(plate.outline), *cuts)
    )
    return float(outline - sum(areas))


def collision(cad: Any, read: dict[str, Any], made: Assembly) -> tuple[str, str] | None:
    """Two parts that overlap somewhere along the motion, if there are any."""
    heights = {name: (box.min.Z, box.max.Z) for name, box in _boxes(read).items()}
    least = TOUCHING_VOLUME * made.dimensions.hole**2 * made.dimensions.thickness
    names = list(read)
    pairs = [
        (one, two)
        for k, two in enumerate(names)
        for one in names[:k]
        if max(heights[one][0], heights[two][0])
        < min(heights[one][1], heights[two][1]) - SAME_HEIGHT
    ]
    carriers = {plate.name: plate for plate in made.plates}
    pins = {f"pin-{k}": carriers[pin.plate] for k, pin in enumerate(made.pins, start=1)}
    carriers |= pins
    ways = np.linspace(0, made.motion.shape[0] - 1, PLACES).astype(np.intp)
    for place in [made.drawn, *(made.motion[k] for k in ways)]:
        there = {}
        for name, shape in read.items():
            move = carriers[name].at(place) @ carriers[name].at(made.drawn).inverse()
            x, y = move.translation.tolist()
            there[name] = shape.moved(cad.Location((x, y, 0), (0, 0, math.degrees(move.angle))))
        boxes = _boxes(there)
        for one, two in pairs:
            a, b = boxes[one], boxes[two]
            if max(a.min.X - b.max.X, b.min.X - a.max.X, a.min.Y - b.max.Y, b.min.Y - a.max.Y) > 0:
                continue
            common = there[one].intersect(there[two])
            if common is not None and sum(each.volume for each in _listed(common)) > least:
                return one, two
    return None


def _boxes(shapes: dict[str, Any]) -> dict[str, Any]:
    return {name: shape.bounding_box() for name, shape in shapes.items()}


def _listed(shape: Any) -> list[Any]:
    return list(shape) if isinstance(shape, list) else [shape]
