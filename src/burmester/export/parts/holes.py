"""Where a linkage wants the holes and slots of its plates, and where solids read back have them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Final

import numpy as np

from burmester.export.parts.plates import Assembly
from burmester.numerics.arrays import FloatArray

RING_SHARE: Final = 0.2  # of a hole's radius: band in which its facets are searched


@dataclass(frozen=True, slots=True)
class Pivot:
    """Where two plates are joined, on the plate of one of them.

    plates: the names of those of which one has it.  point: (2,) in F, the axis of a hole; or None,
    where line holds a slot: a normal (2,) and an offset in F, with both ends' axes on it.
    """

    plates: tuple[str, ...]
    point: FloatArray | None
    line: tuple[FloatArray, float] | None = None


def pivots_of(made: Assembly) -> list[Pivot]:
    """Where the linkage itself wants holes and slots of plates in the assembly; millimetres."""
    plates: dict[str, tuple[str, ...]] = {}
    for plate in made.plates:
        plates[plate.owner] = (*plates.get(plate.owner, ()), plate.name)
    found = list[Pivot]()
    for joint in made.reference.joints:
        point = made.drawn[joint.holder].act(joint.holes[joint.holder])
        found += [Pivot(plates[link], point) for link in joint.holes]
        if joint.slot is not None:
            place = made.drawn[joint.slot.link]
            normal = place.rotate(joint.slot.directions[0])
            offset = joint.slot.offset + float(normal @ place.translation)
            found.append(Pivot(plates[joint.slot.link], None, (normal, offset)))
    return found


def axes_of(part: Any, radius: float) -> FloatArray:
    """Where the axes (n, 2) of a part's hollow cylinders of a radius go through z = 0."""
    gp, adaptor = import_module("OCP.GeomAbs"), import_module("OCP.BRepAdaptor")
    centres = []
    for face in part.faces():
        surface = adaptor.BRepAdaptor_Surface(face.wrapped)
        if surface.GetType() != gp.GeomAbs_SurfaceType.GeomAbs_Cylinder:
            continue
        cylinder = surface.Cylinder()
        if abs(cylinder.Radius() - radius) > 1e-6 * radius:
            continue
        at, along = cylinder.Axis().Location(), cylinder.Axis().Direction()
        share = at.Z() / along.Z()
        centres.append((at.X() - share * along.X(), at.Y() - share * along.Y()))
    return np.reshape(np.array(centres), (-1, 2))


def axis_deviation(joint: Pivot, axes: FloatArray) -> float:
    """How far a joint's axis is from the nearest one centres; both of a slot from their line."""
    if joint.point is not None:
        away = np.linalg.norm(axes - joint.point, axis=1)
        return float(away.min()) if len(away) else math.inf
    assert joint.line is not None
    normal, offset = joint.line
    away = np.sort(np.abs(axes @ normal - offset))
    return float(away[1]) if len(away) > 1 else math.inf


def rim_deviation(joint: Pivot, points: FloatArray, radius: float) -> float:
    """How far the middle of a hole's rim, of points (n, 2) by least squares, is from its pivot.

    Of a slot, how far the sides that run along its line are from the radius, on both sides.
    """
    if joint.point is not None:
        from_pivot = points - joint.point
        near = np.abs(np.linalg.norm(from_pivot, axis=1) - radius) <= RING_SHARE * radius
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
