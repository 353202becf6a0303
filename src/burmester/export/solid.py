"""Solid parts: STEP for CAD, STL for printing, in millimetres.

The plates are extruded with their holes and slots, one layer of them over the other with a gap
between, and held by pins that have a running fit.  The first plate lies on z = 0.

E130 build123d is missing        E160 what was written is not the linkage
E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.displacement import Displacement, FloatArray
from burmester.errors import BurmesterError, InputError
from burmester.export.options import Options
from burmester.export.plates import Assembly, Plate, assembly_of, slot_outline
from burmester.export.truth import PRECISION, Truth
from burmester.io.saved import SavedLinkage

__all__ = [
    "Joint",
    "check_flat",
    "check_step",
    "check_stl",
    "joints_of",
    "read_stl",
    "shells_of",
    "write_flat",
    "write_step",
    "write_stl",
]

FIT: Final = 0.02  # of a hole's diameter: by how much its pin is thinner, so that it turns
FACET: Final = 0.1  # radians of an arc for a facet of an STL: 0.13% of the radius off, at most
COARSE: Final = 0.1  # of an edge's length: the same tolerance as a length, which is not to decide
SHORTEST: Final = 1e-4  # of a plate: pieces of its outline that are shorter are left out
APART: Final = 2.0  # widths of a link between parts that are laid flat
FILLED: Final = 1e-9  # relative: how exactly a volume is area times thickness
FACETED: Final = 0.01  # relative: how near to it a volume is that chords have cut off
ROUNDING: Final = 1e-6  # of the size: what numbers of 32 bits leave of a place
SHARED: Final = 1e-6  # of a hole's volume: what two parts have in common when they only touch
TOUCH: Final = 1e-6  # mm between heights, below which they are the same
MET_AT: Final = 12  # places along the motion at which parts are compared
RING: Final = 0.2  # of a hole's radius, within which its facets are looked for
NO_TIME: Final = (
    "2000-01-01T00:00:00"  # in every STEP file, so that the same one has the same bytes
)
COLOURS: Final = {
    "ground": (0.48, 0.53, 0.58),
    "driver": (0.90, 0.62, 0.0),
    "coupler": (0.0, 0.45, 0.70),
    "follower": (0.0, 0.62, 0.45),
    "pin": (0.20, 0.24, 0.28),
}

Triangles: TypeAlias = NDArray[np.float64]


class Part(NamedTuple):
    """A solid in a frame of its own, and where it lies: its frame in F, and the height of z = 0.

    area: of its outline without what is cut out; height: of the solid.
    """

    name: str
    kind: str
    solid: Any
    place: Displacement
    z: float
    area: float
    height: float


@dataclass(frozen=True, slots=True)
class Joint:
    """Where two plates are joined, on the plate of one of them.

    plates: the names of those of which one has it.  point: (2,) in F, the axis of a hole; or None,
    where line holds a slot: a normal (2,) and an offset in F, with both ends' axes on it.
    """

    plates: tuple[str, ...]
    point: FloatArray | None
    line: tuple[FloatArray, float] | None = None


def write_step(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write the assembly at `options.pose` as STEP: named parts in colours, in their places."""
    cad, made = _cad(), assembly_of(chosen, options)
    parts = [_placed(cad, part) for part in _parts(cad, made)]
    whole = cad.Compound(label=f"{chosen.id} {chosen.type}", children=parts)
    cad.export_step(whole, str(path), timestamp=NO_TIME)


def write_stl(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write the assembly at `options.pose` as a binary STL: each part a closed shell of its own."""
    cad, made = _cad(), assembly_of(chosen, options)
    _write_stl(cad, _parts(cad, made), path)


def write_flat(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write all parts beside each other on z = 0, as they are printed or cut, as a binary STL."""
    cad, made = _cad(), assembly_of(chosen, options)
    _write_stl(cad, _laid(_parts(cad, made), made), path)


def check_step(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Read a STEP file back; raises E160 unless its holes are at this linkage's pivots.

    Axes to 1e-9 of the span, volumes to 1e-9 of themselves, and no part is inside another.
    """
    cad, made = _cad(), assembly_of(chosen, options)
    read = {each.label: each for each in cad.import_step(str(path)).children}
    wanted = {part.name: part for part in _parts(cad, made)}
    if read.keys() != wanted.keys():
        raise _off(f"its parts are {', '.join(read)}, not {', '.join(wanted)}")
    for name, part in wanted.items():
        volume = part.area * part.height
        if not abs(read[name].volume - volume) <= FILLED * volume:
            raise _off(f"the {name} has {read[name].volume:.9g} mm³, not {volume:.9g} mm³")
    truth, radius = Truth.of(chosen, options), made.dimensions.hole / 2
    for joint in joints_of(truth, made, options.pose):
        away = min(_away(joint, _axes(cad, read[each], radius)) for each in joint.plates)
        if not away <= PRECISION * truth.span:
            raise _off(f"a hole of the {joint.plates[0]} is {away:.3g} mm from its pivot")
    met = _met(cad, read, made)
    if met is not None:
        raise _off(f"the {met[0]} and the {met[1]} are in each other's way")


def check_stl(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Read an STL back; raises E160 unless it is closed, with holes at this linkage's pivots."""
    made = assembly_of(chosen, options)
    shells, tolerance = _checked_shells(path, made)
    height = made.dimensions.thickness + made.dimensions.gap
    radius = made.dimensions.hole / 2
    heights = {plate.name: plate.layer * height for plate in made.plates}
    rims = {}
    for name, low in heights.items():
        # Of a plate's own height, so that it is no pin.
        own = [
            shell
            for shell in shells
            if abs(shell[..., 2].min() - low) <= tolerance
            and abs(np.ptp(shell[..., 2]) - made.dimensions.thickness) <= tolerance
        ]
        rims[name] = np.concatenate([np.zeros((0, 3)), *(each.reshape(-1, 3) for each in own)])
    for joint in joints_of(Truth.of(chosen, options), made, options.pose):
        away = min(_ring_away(joint, rims[each][:, :2], radius) for each in joint.plates)
        if not away <= tolerance:
            raise _off(f"a hole of the {joint.plates[0]} is {away:.3g} mm from its pivot")


def check_flat(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Read such an STL back; raises E160 unless its shells are closed and lie apart on z = 0."""
    made = assembly_of(chosen, options)
    shells, tolerance = _checked_shells(path, made)
    if any(abs(shell[..., 2].min()) > tolerance for shell in shells):
        raise _off("a part is not on z = 0")
    boxes = [(s[..., :2].min(axis=(0, 1)), s[..., :2].max(axis=(0, 1))) for s in shells]
    for k, (low, high) in enumerate(boxes):
        if any((low < there[1]).all() and (there[0] < high).all() for there in boxes[:k]):
            raise _off("two parts lie on each other")


# Solids -------------------------------------------------------------------------------------------


def _cad() -> Any:
    """The build123d module."""
    try:
        return import_module("build123d")
    except ImportError:
        raise InputError(
            "E130",
            "STEP and STL need build123d",
            why="it cannot be imported",
            help="pip install 'burmester[solid]'",
        ) from None


def _parts(cad: Any, made: Assembly) -> list[Part]:
    """The plates and pins of an assembly."""
    size = made.dimensions
    step = size.thickness + size.gap
    parts = [
        Part(
            plate.name,
            plate.owner,
            cad.Solid.extrude(_face(cad, plate), (0, 0, size.thickness)),
            plate.at(made.drawn),
            plate.layer * step,
            _area(plate),
            size.thickness,
        )
        for plate in made.plates
    ]
    places = {part.name: part.place for part in parts}
    for number, pin in enumerate(made.pins, start=1):
        radius = pin.diameter * (1 - FIT) / 2
        height = (pin.high - pin.low) * step + size.thickness
        parts.append(
            Part(
                f"pin-{number}",
                "pin",
                cad.Solid.make_cylinder(radius, height),
                Displacement(places[pin.plate].act(np.array([pin.x, pin.y])), np.zeros(())),
                pin.low * step,
                math.pi * radius**2,
                height,
            )
        )
    return parts


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
    least = SHORTEST * float(np.ptp(outline[:, :2], axis=0).max())
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


def _area(plate: Plate) -> float:
    """The area of a plate without its holes and slots."""
    cut = sum(math.pi * diameter**2 / 4 for diameter in plate.holes[:, 2])
    slots = sum(_within(slot_outline(each)) for each in plate.slots)
    return float(_within(_plain(plate.outline)) - cut - slots)


def _within(outline: FloatArray) -> float:
    """The area within a closed outline (k, 3): of its polygon, and of the arcs' segments."""
    (x, y, bulge), (u, v, _) = outline.T, np.roll(outline, -1, axis=0).T
    quarter = np.arctan(bulge)
    chord = np.hypot(u - x, v - y)
    bent = bulge != 0
    radius = chord[bent] / (2 * np.sin(2 * quarter[bent]))
    segments = radius**2 * (4 * quarter[bent] - np.sin(4 * quarter[bent])) / 2
    return float((x * v - u * y).sum() / 2 + (np.sign(bulge[bent]) * np.abs(segments)).sum())


def _placed(cad: Any, part: Part) -> Any:
    """A copy of a part where it lies, with its name and colour."""
    x, y = part.place.translation.tolist()
    there = part.solid.moved(cad.Location((x, y, part.z), (0, 0, math.degrees(part.place.angle))))
    there.label = part.name
    there.color = cad.Color(*COLOURS[part.kind])
    return there


def _laid(parts: Iterable[Part], made: Assembly) -> list[Part]:
    """The parts in a column, the longest first, each lengthwise, and the pins behind them."""
    plates = {plate.name: plate for plate in made.plates}
    apart = APART * made.dimensions.width
    rows = []
    for part in parts:
        plate = plates.get(part.name)
        if plate is None:
            r = math.sqrt(part.area / math.pi)
            rows.append((part, Displacement.identity(), np.array([[-r, -r], [r, r]])))
            continue
        ends = plate.skeleton[:, None] - plate.skeleton
        far = ends.reshape(-1, 2)[int((ends**2).sum(axis=-1).argmax())]
        turn = Displacement(np.zeros(2), -np.arctan2(far[1], far[0]))
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


def _write_stl(cad: Any, parts: list[Part], path: Path) -> None:
    whole = cad.Compound(children=[_placed(cad, part) for part in parts])
    if not cad.export_stl(whole, str(path), COARSE, FACET):
        raise OSError(f"{path} cannot be written")


# Read back ----------------------------------------------------------------------------------------


def joints_of(truth: Truth, made: Assembly, pose: int) -> list[Joint]:
    """Where the linkage itself, at a pose from 1, wants holes and slots of plates; millimetres."""
    place = truth.places[pose - 1]
    names = [plate.name for plate in made.plates]
    ground = tuple(name for name in names if name.startswith("ground"))
    joints = list[Joint]()
    for side, name in enumerate(("driver", "follower")):
        fixed, moving, line = truth.fixed[side], truth.moving[side], truth.line[side]
        link = [(name,)] if name in names else []
        if fixed is not None:
            joints += [Joint(each, fixed) for each in (ground, *link)]
        if moving is not None:
            pivot = place.act(moving)
            joints += [Joint(each, pivot) for each in (("coupler",), *link)]
        if line is not None:
            normal = np.array([math.cos(line[0]), math.sin(line[0])])
            if moving is not None:
                joints.append(Joint(ground, None, (normal, line[1])))
            else:
                normal = place.rotate(normal)
                offset = line[1] + float(normal @ place.translation)
                joints.append(Joint(("coupler",), None, (normal, offset)))
    return joints


def _axes(cad: Any, part: Any, radius: float) -> FloatArray:
    """Where the axes (n, 2) of a part's hollow cylinders of a radius go through z = 0."""
    gp, adaptor = import_module("OCP.GeomAbs"), import_module("OCP.BRepAdaptor")
    found = []
    for face in part.faces():
        surface = adaptor.BRepAdaptor_Surface(face.wrapped)
        if surface.GetType() != gp.GeomAbs_SurfaceType.GeomAbs_Cylinder:
            continue
        cylinder = surface.Cylinder()
        if abs(cylinder.Radius() - radius) > 1e-6 * radius:
            continue
        at, along = cylinder.Axis().Location(), cylinder.Axis().Direction()
        share = at.Z() / along.Z()
        found.append((at.X() - share * along.X(), at.Y() - share * along.Y()))
    return np.reshape(np.array(found), (-1, 2))


def _away(joint: Joint, axes: FloatArray) -> float:
    """How far a joint's axis is from the nearest one found; both of a slot from their line."""
    if joint.point is not None:
        away = np.linalg.norm(axes - joint.point, axis=1)
        return float(away.min()) if len(away) else math.inf
    assert joint.line is not None
    normal, offset = joint.line
    away = np.sort(np.abs(axes @ normal - offset))
    return float(away[1]) if len(away) > 1 else math.inf


def _met(cad: Any, read: dict[str, Any], made: Assembly) -> tuple[str, str] | None:
    """Two parts that share some volume somewhere on their way, if there are any."""
    heights = {name: (box.min.Z, box.max.Z) for name, box in _boxes(read).items()}
    least = SHARED * made.dimensions.hole**2 * made.dimensions.thickness
    names = list(read)
    pairs = [
        (one, two)
        for k, two in enumerate(names)
        for one in names[:k]
        if max(heights[one][0], heights[two][0]) < min(heights[one][1], heights[two][1]) - TOUCH
    ]
    carriers = {plate.name: plate for plate in made.plates}
    pins = {f"pin-{k}": carriers[pin.plate] for k, pin in enumerate(made.pins, start=1)}
    carriers |= pins
    ways = np.linspace(0, made.motion.shape[0] - 1, MET_AT).astype(np.intp)
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


def read_stl(path: Path) -> Triangles:
    """The triangles (n, 3, 3) of a binary STL; raises ValueError where it is none."""
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * count or count == 0:
        raise ValueError(f"{len(data)} bytes are not {count} triangles")
    rows = np.frombuffer(data, dtype=np.uint8, offset=84).reshape(count, 50)
    numbers = np.ascontiguousarray(rows[:, 12:48]).view("<f4")
    return numbers.astype(np.float64).reshape(count, 3, 3)


def shells_of(triangles: Triangles) -> list[Triangles] | None:
    """The triangles (n, 3, 3) by shells, written one after the other; None unless all are closed.

    In a closed shell each edge is run through once in each sense.
    """
    names = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)[1].reshape(-1, 3)
    shells, first, open_ = list[Triangles](), 0, set[tuple[int, int]]()
    for number, (a, b, c) in enumerate(names.tolist()):
        for start, end in ((a, b), (b, c), (c, a)):
            if start == end or (start, end) in open_:
                return None
            if (end, start) in open_:
                open_.remove((end, start))
            else:
                open_.add((start, end))
        if not open_:
            shells.append(triangles[first : number + 1])
            first = number + 1
    return None if open_ else shells


def _checked_shells(path: Path, made: Assembly) -> tuple[list[Triangles], float]:
    """The closed shells of an STL, one for each part with its volume, and how exact they are."""
    size = made.dimensions
    try:
        triangles = read_stl(path)
    except ValueError as error:
        raise _off(str(error)) from None
    shells = shells_of(triangles)
    if shells is None:
        raise _off("its surface is not closed")
    step = size.thickness + size.gap
    pin = math.pi * (size.hole * (1 - FIT) / 2) ** 2
    wanted = [_area(plate) * size.thickness for plate in made.plates]
    wanted += [pin * ((each.high - each.low) * step + size.thickness) for each in made.pins]
    found = sorted(_volume(shell) for shell in shells)
    close = len(found) == len(wanted) and np.allclose(found, sorted(wanted), rtol=FACETED, atol=0)
    if not close:
        raise _off(f"its {len(found)} parts do not have the volumes of the plates and pins")
    reach = float(np.abs(triangles).max())
    return shells, ROUNDING * reach


def _volume(shell: Triangles) -> float:
    """The volume within a closed shell, outward normals by the right hand."""
    shell = shell - shell.mean(axis=(0, 1))
    return float(np.einsum("ij,ij", np.cross(shell[:, 0], shell[:, 1]), shell[:, 2]) / 6)


def _ring_away(joint: Joint, points: FloatArray, radius: float) -> float:
    """How far the middle of a hole's rim, of points (n, 2) by least squares, is from its pivot.

    Of a slot, how far the sides that run along its line are from the radius, on both sides.
    """
    if joint.point is not None:
        from_pivot = points - joint.point
        near = np.abs(np.linalg.norm(from_pivot, axis=1) - radius) <= RING * radius
        ring = np.unique(from_pivot[near], axis=0)
        if len(ring) < 8:
            return math.inf
        left = np.column_stack([2 * ring, np.ones(len(ring))])
        x, y, rest = np.linalg.lstsq(left, (ring**2).sum(axis=1), rcond=None)[0]
        return float(max(math.hypot(x, y), abs(math.sqrt(rest + x * x + y * y) - radius)))
    assert joint.line is not None
    normal, offset = joint.line
    across = points @ normal - offset
    sides = [np.abs(across - side) for side in (-radius, radius)]
    return float(max(np.sort(each)[3] for each in sides)) if len(points) >= 4 else math.inf


def _off(why: str) -> BurmesterError:
    return BurmesterError(
        "E160",
        "what was written is not the linkage, so nothing was kept",
        why=why,
        help="this is a fault of burmester: report it, with the result file",
    )
