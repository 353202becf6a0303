"""What the bodies of a linkage weigh: the body, its links as plates or by name; SI units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.geometry.outlines import convex_hull, outline_moments, rounded_hull
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


def require_links(loads: Loads, bodies: Bodies) -> None:
    """Refuse loads on links that a linkage does not have: E177, with the place in the file."""
    named = [*loads.links] if isinstance(loads.links, Mapping) else []
    for name in (*named, *(end.link for spring in loads.springs for end in spring.ends)):
        try:
            body_named(name, bodies)
        except InputError as error:
            error.where = loads.where.get(name)
            raise


def _moments(outline: FloatArray) -> tuple[float, FloatArray, float]:
    """Area, centroid (2,) and polar moment about it, of an outline (k, 3) with bulges."""
    origin = outline[:, :2].mean(axis=0)
    area, x, y, xx, _, yy = outline_moments(outline, origin)
    centre = np.array([x, y]) / area
    return abs(area), origin + centre, abs(xx + yy - area * float(centre @ centre))


def _of_body(body: Mass, outline: Polygon | None, metre: float) -> tuple[float, FloatArray, float]:
    centre, inertia = body.center, body.inertia_kgm2
    if outline is not None:
        area, middle, polar = _moments(np.pad(outline.vertices, ((0, 0), (0, 1))))
        if centre is None:
            centre = middle
        if inertia is None:
            inertia = body.mass_kg * polar / area * metre**2
    assert centre is not None  # else the task would not have been made
    return body.mass_kg, centre * metre, inertia or 0.0


def _plate(corners: FloatArray, plate: Plates, metre: float) -> tuple[float, FloatArray, float]:
    """A plate as far about its pins as half its width: the polygon of the pins with a round rim."""
    weight = plate.density * plate.thickness * metre
    area, centre, polar = _moments(rounded_hull(convex_hull(corners), plate.width * metre / 2))
    return weight * area, centre, weight * polar


def _joined(parts: list[tuple[float, FloatArray, float]]) -> tuple[float, FloatArray, float]:
    """Parts of one body as one (Steiner's theorem)."""
    mass = sum(each[0] for each in parts)
    if mass == 0:
        return 0.0, np.zeros(2), sum(each[2] for each in parts)
    centre = sum((each[0] * each[1] for each in parts), np.zeros(2)) / mass
    about = sum(each[2] + each[0] * float((each[1] - centre) @ (each[1] - centre))
                for each in parts)  # fmt: skip
    return mass, centre, about
