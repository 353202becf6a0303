"""What the bodies of a linkage weigh: the body, its links as plates or by name; SI units."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.geometry.regions import Polygon
from burmester.mechanisms.bodies import GROUND, Bodies
from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import BODY, Loads, Mass, Plates, malformed
from burmester.wording import listed


class Masses(NamedTuple):
    """Of k bodies: mass (k,), centre (k, 2) in the frame of each, inertia (k,) about the centre."""

    mass: FloatArray
    centre: FloatArray
    inertia: FloatArray

    @classmethod
    def of(cls, bodies: Bodies, loads: Loads, outline: Polygon | None, metre: float) -> Masses:
        """Those of bodies in metres; outline: of the body, in the task's unit; raises E177."""
        parts: dict[str, list[tuple[float, FloatArray, float]]] = {
            name: [] for name in bodies.moving
        }
        if loads.body is not None:
            parts[bodies.body].append(_of_body(loads.body, outline, metre))
        if isinstance(loads.links, Plates):
            for name, joints in bodies.links.items():
                corners = np.array([each.holes[name] for each in joints if name in each.holes])
                if name != GROUND and len(corners):
                    parts[name].append(_plate(corners, loads.links, metre))
        else:
            for given, mass in loads.links.items():
                name = body_named(given, bodies)
                joints = bodies.links.get(name, ())
                holes = [each.holes[name] for each in joints if name in each.holes]
                centre = np.mean(holes, axis=0) if holes else np.zeros(2)
                if name != GROUND:
                    parts[name].append((mass, centre, 0.0))
        for spring in loads.springs:
            if spring.kind == "counterweight":
                name = body_named(spring.ends[1].link, bodies)
                at = np.array(spring.ends[1].point) * metre
                if name != GROUND:
                    parts[name].append((spring.count * spring["mass_kg"], at, 0.0))
        return cls(*map(np.array, zip(*map(_joined, parts.values()), strict=True)))


def body_named(name: str, bodies: Bodies) -> str:
    """The body of a linkage that a task names; raises E177 for one that it does not have."""
    if name == BODY:
        return bodies.body
    if name == GROUND or name in bodies.moving:
        return name
    known = listed([GROUND, BODY, *bodies.moving])
    raise malformed(f"this linkage has no link {name!r}", f"it has {known}", f"name one of {known}")


def moments(corners: FloatArray) -> tuple[float, FloatArray, float]:
    """Area, centroid (2,) and polar moment about it, of a polygon (n, 2)."""
    one, two = corners - corners[0], np.roll(corners - corners[0], -1, axis=0)
    cross = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    area = cross.sum() / 2
    centre = ((one + two) * cross[:, None]).sum(axis=0) / (6 * area)
    about = (cross * ((one * one + one * two + two * two).sum(axis=1))).sum() / 12
    polar = about - area * float(centre @ centre)
    return abs(float(area)), centre + corners[0], abs(float(polar))


def _of_body(body: Mass, outline: Polygon | None, metre: float) -> tuple[float, FloatArray, float]:
    centre, inertia = body.center, body.inertia_kgm2
    if outline is not None:
        area, middle, polar = moments(outline.vertices)
        if centre is None:
            centre = middle
        if inertia is None:
            inertia = body.mass_kg * polar / area * metre**2
    assert centre is not None  # else the task would not have been made
    return body.mass_kg, centre * metre, inertia or 0.0


def _plate(corners: FloatArray, plate: Plates, metre: float) -> tuple[float, FloatArray, float]:
    """A plate as far about its pins as half its width: the polygon of the pins with a round rim."""
    rim, weight = plate.width * metre / 2, plate.density * plate.thickness * metre
    parts = list[tuple[float, FloatArray, float]]()
    if len(corners) > 2:
        corners = corners if _doubled_area(corners) > 0 else corners[::-1]
        parts.append(moments(corners))
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(*sides.T)
    for corner, side, length in zip(corners, sides, lengths, strict=True):
        if length > 0:
            area, out = length * rim, np.array([side[1], -side[0]]) / length
            middle = corner + side / 2 + out * rim / 2
            parts.append((area, middle, area * (length**2 + rim**2) / 12))
    headings = np.arctan2(sides[:, 1], sides[:, 0])
    before = np.roll(headings, 1)
    # At each corner the rim is a sector, from the normal of one side to that of the next one.
    wide = np.mod(headings - before, 2 * np.pi) if len(corners) > 1 else np.array([2 * np.pi])
    for corner, start, angle in zip(corners, before - np.pi / 2, wide, strict=True):
        area = rim**2 * angle / 2
        reach = 4 * rim * np.sin(angle / 2) / (3 * angle) if angle else 0.0
        way = np.array([np.cos(start + angle / 2), np.sin(start + angle / 2)])
        parts.append((area, corner + reach * way, area * (rim**2 / 2 - reach**2)))
    area, centre, polar = _joined(parts)
    return weight * area, centre, weight * polar


def _doubled_area(corners: FloatArray) -> float:
    x, y = (corners - corners[0]).T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())


def _joined(parts: list[tuple[float, FloatArray, float]]) -> tuple[float, FloatArray, float]:
    """Parts of one body as one (Steiner's theorem)."""
    mass = sum(each[0] for each in parts)
    if mass == 0:
        return 0.0, np.zeros(2), sum(each[2] for each in parts)
    centre = sum((each[0] * each[1] for each in parts), np.zeros(2)) / mass
    about = sum(each[2] + each[0] * float((each[1] - centre) @ (each[1] - centre))
                for each in parts)  # fmt: skip
    return mass, centre, about
