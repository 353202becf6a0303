"""Mass, centre of mass and inertia of plates and pins, from their outlines with holes and slots."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Self, final

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.models.bodies import METRES, BodyParts, heights_of
from burmester.export.parts.outlines import slot_outline
from burmester.export.parts.plates import Assembly
from burmester.geometry.outlines import outline_moments, rounded_hull
from burmester.numerics.arrays import FloatArray

LIGHTEST, HEAVIEST = 10.0, 25000.0  # kg/m³: a foam, and more than osmium; others are slips of unit


@final
@dataclass(frozen=True, slots=True, eq=False)
class MassProperties:
    """The mass properties of a body, in a frame of its own.

    mass: kilograms.  centre: (3,) of mass, metres.  inertia: (3, 3) about the centre, kg m², with
    the negative products off the diagonal.
    """

    mass: float
    centre: FloatArray
    inertia: FloatArray

    @classmethod
    def of(cls, body: BodyParts, made: Assembly, density: float) -> Self:
        """Those of a body's plates and pins, all of one density (kg/m³)."""
        parts = list[Self]()
        for plate in body.plates:
            cuts = [rounded_hull(each[None, :2], each[2] / 2) for each in plate.holes]
            cuts += [slot_outline(each) for each in plate.slots]
            parts.append(cls._prism(plate.outline, cuts, heights_of(plate, made), density))
        for pin in body.pins:
            outline = rounded_hull(np.array([[pin.x, pin.y]]), pin.diameter / 2)
            parts.append(cls._prism(outline, [], heights_of(pin, made), density))
        return cls._joined(parts)

    @classmethod
    def _prism(
        cls,
        outline: FloatArray,
        cuts: Iterable[FloatArray],
        heights: tuple[float, float],
        density: float,
    ) -> Self:
        """An outline less its cuts, extruded from one height to another; millimetres."""
        origin = outline[:, :2].mean(axis=0)  # near, so that few digits are lost
        area, x, y, xx, xy, yy = outline_moments(outline, origin) - sum(
            outline_moments(each, origin) for each in cuts
        )
        x, y = x / area, y / area
        height = heights[1] - heights[0]
        mass = density * area * height * METRES**3
        about_x, about_y = yy / area - y * y, xx / area - x * x
        thick, product = height**2 / 12, x * y - xy / area
        inertia = [
            [about_x + thick, product, 0.0],
            [product, about_y + thick, 0.0],
            [0.0, 0.0, about_x + about_y],
        ]
        centre = np.append(origin + np.array([x, y]), sum(heights) / 2)
        return cls(float(mass), centre * METRES, mass * np.array(inertia) * METRES**2)

    @classmethod
    def _joined(cls, parts: Sequence[Self]) -> Self:
        """Parts in one frame as one body (Steiner's theorem)."""
        mass = sum(each.mass for each in parts)
        centre = sum((each.mass * each.centre for each in parts), np.zeros(3)) / mass
        inertia = np.zeros((3, 3))
        for each in parts:
            off = each.centre - centre
            inertia += each.inertia + each.mass * (off @ off * np.eye(3) - np.outer(off, off))
        return cls(mass, centre, inertia)

    def about_z(self, x: float = 0.0, y: float = 0.0) -> float:
        """The moment of inertia about an axis along z through (x, y), kg m²."""
        away = math.hypot(self.centre[0] - x, self.centre[1] - y)
        return float(self.inertia[2, 2] + self.mass * away**2)


def require_density(density: float) -> float:
    """A density in kg/m³; raises E162 for one that no material has."""
    if LIGHTEST <= density <= HEAVIEST:
        return density
    raise InputError(
        "E162",
        f"there is no material of {density:g} kg/m³",
        why=f"densities from {LIGHTEST:g} to {HEAVIEST:g} kg/m³ are taken: aluminium has 2700, "
        "steel 7850",
        help=Help.of("give {}, for aluminium; 1 g/cm³ is 1000 kg/m³", Cure("density", 2700)),
    )
