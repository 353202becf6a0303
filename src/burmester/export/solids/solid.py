"""Solid parts: STEP for CAD, STL for printing, in millimetres.

The plates are extruded with their holes and slots; pins turn in the holes.  In STEP, and in an STL
that is asked for assembled, the parts are in their places: one layer over the other with a gap
between, the first plate on z = 0.  Otherwise all parts lie flat beside each other on z = 0.

E160 the file does not contain the linkage
E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from importlib import import_module
from itertools import count
from pathlib import Path
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.export.description import step_text
from burmester.export.options import PRECISION, Options, fault
from burmester.export.parts.plates import (
    Assembly,
    assembly_of,
    axes_of,
    axis_deviation,
    pivots_of,
    rim_deviation,
)
from burmester.export.solids.solid_parts import area_of, collision, laid, parts_of, placed
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

FACET_ANGLE: Final = 0.1  # radians of an arc per facet of an STL: 0.13% of the radius off, at most
FACET_LENGTH: Final = (
    0.1  # of an edge's length: the tolerance as a length, large enough not to decide
)
VOLUME_TOLERANCE: Final = 1e-9  # relative: of a solid's volume to area times thickness
FACETED_VOLUME_TOLERANCE: Final = 0.01  # relative: the same with facets for arcs
FLOAT32_ERROR: Final = 1e-6  # of the size: error of a coordinate of 32 bits
FIXED_TIME: Final = (
    "2000-01-01T00:00:00"  # written into every STEP file, so that equal parts give equal files
)


NEXT_TO_NOTHING = 1e-12  # millimetres or a share of a unit vector; less is the rounding of a zero

# An entity, whose texts may hold any sign: "#12 = COLOUR_RGB('',0.5,0.5,0.5);"
_ENTITY = re.compile(r"#(\d+) = ((?:'(?:[^']|'')*'|[^';])*);\s*")
_PIECE = re.compile(r"'(?:[^']|'')*'|#(\d+)|(-?\d+\.\d*E-\d+)")
_COLOURS = "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION("
_USE = re.compile(r"(?<=^NEXT_ASSEMBLY_USAGE_OCCURRENCE\(')\d+")  # the number of a part's use
_DATA, _END = "DATA;\n", "ENDSEC;\nEND-ISO-10303-21;"


Triangles: TypeAlias = NDArray[np.float64]

SAME: Final = 1e-6  # of the greatest coordinate: distance below which two corners are one


def write_step(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the assembly at `options.pose` as STEP: named parts in colours, in their places."""
    cad, made = import_module("build123d"), assembly_of(chosen, options)
    parts = [placed(cad, part) for part in parts_of(cad, made)]
    whole = cad.Compound(label=step_text(f"{chosen.id} {chosen.type}"), children=parts)
    cad.export_step(whole, str(path), timestamp=FIXED_TIME)
    settle(path)


def write_stl(chosen: Candidate, path: Path, options: Options) -> None:
    """Write all parts as a binary STL: each a closed shell of its own, flat, or in its place."""
    cad, made = import_module("build123d"), assembly_of(chosen, options)
    parts = parts_of(cad, made)
    parts = parts if options.assembled else laid(parts, made)
    whole = cad.Compound(children=[placed(cad, part) for part in parts])
    if not cad.export_stl(whole, str(path), FACET_LENGTH, FACET_ANGLE):
        raise OSError(f"{path} cannot be written")


def write_flat(chosen: Candidate, path: Path, options: Options) -> None:
    """Write all parts beside each other on z = 0, as they are printed or cut, as a binary STL."""
    write_stl(chosen, path, replace(options, assembled=False))


def check_step(chosen: Candidate, path: Path, options: Options) -> None:
    """Read a STEP file back; raises E160 unless its holes are at this linkage's pivots.

    Axes to 1e-9 of the span, volumes to 1e-9 of themselves, and no part is inside another.
    """
    cad, made = import_module("build123d"), assembly_of(chosen, options)
    read = {each.label: each for each in cad.import_step(str(path)).children}
    expected = {part.name: part for part in parts_of(cad, made)}
    if read.keys() != expected.keys():
        raise fault(f"its parts are {', '.join(read)}, not {', '.join(expected)}")
    for name, part in expected.items():
        volume = part.area * part.height
        if not abs(read[name].volume - volume) <= VOLUME_TOLERANCE * volume:
            raise fault(f"the {name} has {read[name].volume:.9g} mm³, not {volume:.9g} mm³")
    radius = made.dimensions.hole / 2
    for joint in pivots_of(made):
        away = min(axis_deviation(joint, axes_of(read[each], radius)) for each in joint.plates)
        if not away <= PRECISION * made.reference.span:
            raise fault(f"a hole of the {joint.plates[0]} is {away:.3g} mm from its pivot")
    clash = collision(cad, read, made)
    if clash is not None:
        raise fault(f"the {clash[0]} and the {clash[1]} collide along the motion")


def check_stl(chosen: Candidate, path: Path, options: Options) -> None:
    """Read an STL back; raises E160 unless it is closed, with holes at this linkage's pivots."""
    if not options.assembled:
        check_flat(chosen, path, options)
        return
    made = assembly_of(chosen, options)
    shells, tolerance = _checked_shells(path, made)
    height = made.dimensions.thickness + made.dimensions.gap
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
        points = [each[..., :2].reshape(-1, 2) for each in own]
        rims[name] = np.concatenate([np.zeros((0, 2)), *points])
    _require_rims(made, rims, tolerance)


def check_flat(chosen: Candidate, path: Path, options: Options) -> None:
    """Read such an STL back; raises E160 unless its shells are closed and lie apart on z = 0.

    Each plate is put back to where the assembly has it, and its holes are compared as there.
    """
    cad, made = import_module("build123d"), assembly_of(chosen, options)
    shells, tolerance = _checked_shells(path, made)
    if any(abs(shell[..., 2].min()) > tolerance for shell in shells):
        raise fault("a part is not on z = 0")
    boxes = [(s[..., :2].min(axis=(0, 1)), s[..., :2].max(axis=(0, 1))) for s in shells]
    for k, (low, high) in enumerate(boxes):
        if any((low < there[1]).all() and (there[0] < high).all() for there in boxes[:k]):
            raise fault("two parts lie on each other")
    plates = {plate.name: plate for plate in made.plates}
    points = np.concatenate([shell.reshape(-1, 3) for shell in shells])[:, :2]
    rims = {
        part.name: (plates[part.name].at(made.drawn) @ part.place.inverse()).act(points)
        for part in laid(parts_of(cad, made), made)
        if part.name in plates
    }
    _require_rims(made, rims, 2 * tolerance)


def _require_rims(made: Assembly, rims: Mapping[str, FloatArray], tolerance: float) -> None:
    """Raise E160 where no hole is at a pivot, by points (n, 2) of each plate, rims among them."""
    radius = made.dimensions.hole / 2
    for joint in pivots_of(made):
        away = min(rim_deviation(joint, rims[each], radius) for each in joint.plates)
        if not away <= tolerance:
            raise fault(f"a hole of the {joint.plates[0]} is {away:.3g} mm from its pivot")


def _checked_shells(path: Path, made: Assembly) -> tuple[list[Triangles], float]:
    """The closed shells of an STL, one for each part with its volume, and how exact they are."""
    size = made.dimensions
    try:
        triangles = read_stl(path)
    except ValueError as error:
        raise fault(str(error)) from None
    shells = shells_of(triangles)
    if shells is None:
        raise fault("its surface is not closed")
    step = size.thickness + size.gap
    pin = math.pi * (size.pin / 2) ** 2
    expected = [area_of(plate) * size.thickness for plate in made.plates]
    expected += [pin * ((each.high - each.low) * step + size.thickness) for each in made.pins]
    found = sorted(volume_of(shell) for shell in shells)
    close = len(found) == len(expected) and np.allclose(
        found, sorted(expected), rtol=FACETED_VOLUME_TOLERANCE, atol=0
    )
    if not close:
        raise fault(f"its {len(found)} parts do not have the volumes of the plates and pins")
    reach = float(np.abs(triangles).max())
    return shells, FLOAT32_ERROR * reach


def settle(path: Path) -> None:
    """Write the file again: colours sorted by their solids, uses counted, an entity a line."""
    text = path.read_text(encoding="ascii")
    begin, end = text.index(_DATA) + len(_DATA), text.rindex(_END)
    entities = {
        found[1]: _PIECE.sub(_without_dust, " ".join(found[2].split()))
        for found in _ENTITY.finditer(text, begin, end)
    }
    numbers, uses = [*entities], count(1)
    for number, entity in entities.items():
        entities[number] = _USE.sub(lambda _: str(next(uses)), entity)
    roots = [number for number in numbers if entities[number].startswith(_COLOURS)]
    before = numbers.index(roots[0]) if roots else len(numbers)
    order = {number: k for k, number in enumerate(numbers[:before], start=1)}
    told = {number: f"#{number}" for number in order}

    def expanded(number: str) -> str:
        """An entity with those that it refers to in it, down to what comes before the colours."""
        if number not in told:
            told[number] = _PIECE.sub(
                lambda found: expanded(found[1]) if found[1] else found[0], entities[number]
            )
        return told[number]

    def visit(number: str) -> None:
        if number not in order:
            order[number] = len(order) + 1
            for found in _PIECE.finditer(entities[number]):
                if found[1]:
                    visit(found[1])

    for number in sorted(roots, key=expanded):
        visit(number)
    lines = (f"#{new} = {_renumbered(entities[old], order)};\n" for old, new in order.items())
    path.write_text(text[:begin] + "".join(lines) + text[end:], encoding="ascii", newline="\n")


def _renumbered(entity: str, order: dict[str, int]) -> str:
    return _PIECE.sub(lambda found: f"#{order[found[1]]}" if found[1] else found[0], entity)


def _without_dust(found: re.Match[str]) -> str:
    """A piece of an entity, a number next to nothing as zero."""
    return "0." if found[2] and abs(float(found[2])) < NEXT_TO_NOTHING else found[0]


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

    In a closed shell each edge is run through once in each sense.  Corners that are nearer than
    `SAME` are one: near zero, numbers of 32 bits have more digits than those they were made of.
    """
    corners = np.round(triangles.reshape(-1, 3) / (SAME * np.abs(triangles).max()))
    names = np.unique(corners, axis=0, return_inverse=True)[1].reshape(-1, 3)
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


def volume_of(shell: Triangles) -> float:
    """The volume within a closed shell, outward normals by the right hand."""
    shell = shell - shell.mean(axis=(0, 1))
    return float(np.einsum("ij,ij", np.cross(shell[:, 0], shell[:, 1]), shell[:, 2]) / 6)
