"""Solid parts: STEP for CAD, STL for printing, in millimetres.

The plates are extruded with their holes and slots; pins turn in the holes.  In STEP, and in an STL
that is asked for assembled, the parts are in their places: one layer over the other with a gap
between, the first plate on z = 0.  Otherwise all parts lie flat beside each other on z = 0.

E160 the file does not contain the linkage
E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Final

import numpy as np

from burmester.export.escaping import step_text
from burmester.export.options import Options
from burmester.export.parts.collisions import collision
from burmester.export.parts.holes import axes_of, axis_deviation, pivots_of, rim_deviation
from burmester.export.parts.plates import Assembly, assembly_of
from burmester.export.reference import PRECISION, fault
from burmester.export.solids.solid_parts import area_of, laid, parts_of, placed
from burmester.export.solids.step_order import settle
from burmester.export.solids.stl import Triangles, read_stl, shells_of, volume_of
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
