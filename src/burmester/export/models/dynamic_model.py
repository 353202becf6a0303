"""A linkage as bodies that have masses: what the models for simulation share; metres, kilograms.

E162 dimensions that cannot be made        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.models.bodies import (
    INSET,
    METRES,
    BodyParts,
    JointMotion,
    Shape,
    heights_of,
    parts_of_bodies,
    rim,
    shapes,
)
from burmester.export.options import PRECISION, Options, Reference, require_equal
from burmester.export.parts.plate import SLOT_RUN_OUT, slot_outline
from burmester.export.parts.plates import Assembly, assembly_of
from burmester.geometry.outlines import outline_moments, rounded_hull
from burmester.loads.loaded_motion import LoadedBodies, LoadedLinkage, LoadedMotion
from burmester.loads.masses import Masses
from burmester.mechanisms.bodies import ORIGIN
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.tasks.loads import STANDARD_GRAVITY, Loads

HINGE_MARGIN: Final = math.radians(5)  # by which a hinge may leave the range used, at each end
DAMPING_RATE: Final = 0.1  # 1/s: a link alone on its joint loses its speed at this rate
MATERIALS: Final = {2700.0: "aluminium", 7850.0: "steel"}
LIGHTEST: Final = 1e-8  # of the heaviest body: what a body weighs to which loads give no mass
DIRECTIONS: Final[Mapping[str, FloatArray]] = {
    f"{sign}{axis}": (-1.0 if sign else 1.0) * np.eye(3)[number]
    for sign in ("", "-")
    for number, axis in enumerate("xyz")
}


LEAST_DENSITY, GREATEST_DENSITY = (
    10.0,
    25000.0,
)  # kg/m³: a foam, and more than osmium; others are slips of unit


@final
@dataclass(frozen=True, slots=True, eq=False)
class DynamicModel:
    """The bodies of a linkage, each in a frame of its own.

    masses, shapes: by body, the ground first.  outline: of what the body carries, only to be seen.
    joints: at the poses and in between.  low, high: (k,), the limits of the joints.
    up: (3,), in F.  weighed: whether the masses are those that the loads of the task state, not of
    plates and pins.
    """

    chosen: Candidate
    reference: Reference
    made: Assembly
    masses: Mapping[str, MassProperties]
    shapes: Mapping[str, list[Shape]]
    outline: list[Shape]
    joints: JointMotion
    low: FloatArray
    high: FloatArray
    up: FloatArray
    weighed: bool

    @classmethod
    def of(cls, chosen: Candidate, options: Options) -> Self:
        """The model of a linkage made of plates; raises E162 and E163."""
        reference = Reference.of(chosen, options, "m")
        joints = JointMotion.of(chosen, reference)
        up, density = require_up(options.up), require_density(options.density)
        made = assembly_of(chosen, options)
        parts = parts_of_bodies(made)
        run_out = SLOT_RUN_OUT * made.dimensions.hole * METRES
        body = chosen.task.body
        margin = np.where(joints.turning, HINGE_MARGIN, run_out)
        plain = {name: MassProperties.of(each, made, density) for name, each in parts.items()}
        stated = _stated_masses(plain, chosen, reference)
        return cls(
            chosen,
            reference,
            made,
            stated or plain,
            {name: shapes(each, made) for name, each in parts.items()},
            [] if body is None else rim(body.vertices * reference.scale, made),
            joints,
            joints.low - margin,
            joints.high + margin,
            up,
            stated is not None,
        )

    @property
    def names(self) -> tuple[str, ...]:
        """Of the bodies that move, and of their joints."""
        return tuple(limb.body for limb in self.reference.tree)

    @property
    def driver(self) -> str:
        """The body that drives."""
        return self.reference.driver

    @property
    def motor(self) -> int:
        """The number of the driver's joint."""
        return self.names.index(self.driver)

    @property
    def axes(self) -> FloatArray:
        """The hinges (k, 2) of the bodies in their frames."""
        tree = self.reference.tree
        return np.array([ORIGIN if each.slides else each.joint.hole(each.body) for each in tree])

    def damping(self) -> FloatArray:
        """Of the joints (k,): N m s, or N s/m of slides."""
        bodies = [self.masses[name] for name in self.names]
        about = [each.about_z(*axis) for each, axis in zip(bodies, self.axes.tolist(), strict=True)]
        carried = np.where(self.joints.turning, about, [each.mass for each in bodies])
        return np.asarray(DAMPING_RATE * carried)

    def notes(self, options: Options) -> list[str]:
        """Sentences for the head of a file: what was chosen for the model."""
        size, named = self.made.dimensions, MATERIALS.get(options.density)
        joints = self.joints
        weight = (
            "Each body has the mass, the centre of mass and the inertia of its plates and pins, "
            f"with holes and slots, of {options.density:g} kg/m³"
            + (f" ({named})" if named else "")
            + f": plates {size.thickness:g} mm thick and {size.width:g} mm wide, holes of "
            f"{size.hole:g} mm, pins of {size.pin:g} mm."
        )
        choice = "The options density, thickness, width, hole, pin and gap state others."
        if self.weighed:
            weight = (
                "The bodies have the masses that the loads of the task state, with their centres "
                "and inertias in the plane; one to which these give none is as light as can be."
            )
            choice = "The options thickness, width, hole, pin and gap state other shapes."
        if any(each.slides for each in self.reference.tree):
            weight += " The pin of a slider is a body of its own."
        sentences = [
            weight,
            choice,
            "The joints' limits are the range "
            + (
                "that they go through from the first pose to the last"
                if joints.one_motion
                else "of the poses alone, for no one motion goes through all of them"
            )
            + f", and at each end {math.degrees(HINGE_MARGIN):.3g} degrees of a hinge or half a "
            "hole of a slide more.",
        ]
        if joints.turns_fully:
            sentences.append("The driver can turn fully: take the limits away for that.")
        sentences += [
            "Collisions are of boxes along the sides of the plates and cylinders for their corners "
            f"and the pins, without holes, and {INSET:.0%} of a plate lower, so that plates that "
            "lie on each other do not touch. A plate of three corners or more is open inside.",
            f"Damping is a stand-in: {DAMPING_RATE:g} per second of the inertia, or on slides the "
            "mass, of the link that a joint carries. There is no dry friction in joints.",
        ]
        if self.outline:
            sentences.append(
                f"The outline of the body, bars on the {self.made.body}, is only to be seen: it "
                "weighs nothing and touches nothing."
            )
        return sentences

    def gravity(self) -> FloatArray:
        """The acceleration (3,) of a body that falls, in F."""
        loads = self.chosen.task.loads
        return -STANDARD_GRAVITY * self.up if loads is None else np.append(loads.gravity, 0.0)

    def at_poses(self) -> LoadedMotion:
        """It at the poses, under the loads of its task, or its own weight."""
        found, reference = self.chosen, self.reference
        loads = found.task.loads or Loads(gravity=self.gravity()[:2])
        own = [self.masses[name] for name in reference.moving]
        masses = Masses(
            np.array([each.mass for each in own]),
            np.array([each.centre[:2] for each in own]),
            np.array([each.inertia[2, 2] for each in own]),
        )
        drive, metre = self.joints.at_poses[:, self.motor], reference.scale
        there, looks = reference.at_poses, (drive, reference.at_poses)
        if any(each.kind == "torsion" for each in loads.springs):
            looks = LoadedLinkage.of(found).looks
        of = LoadedBodies(loads, metre, reference, masses, drive, looks)
        return LoadedMotion(of, drive, there)

    def require_body(
        self, name: str, mass: float, centre: ArrayLike, inertia: ArrayLike, origin: ArrayLike = 0.0
    ) -> None:
        """Raise E160 where a body read back is another; origin: of its frame in the model's."""
        own = self.masses[name]
        size = float(np.abs(own.inertia).max())
        require_equal(f"the mass of the {name}", mass, own.mass, PRECISION * own.mass)
        there = np.asarray(centre) + np.asarray(origin)
        near = PRECISION * self.reference.span
        require_equal(f"the centre of mass of the {name}", there, own.centre, near)
        require_equal(f"the inertia of the {name}", inertia, own.inertia, PRECISION * size)

    def require_limits(self, index: int, low: float, high: float, zero: float = 0.0) -> None:
        """Raise E160 where limits read back are others; index: of the joint; zero: its 0."""
        name = self.names[index]
        own = [self.low[index] - zero, self.high[index] - zero]
        size = 1.0 if self.joints.turning[index] else self.reference.span
        require_equal(f"the limits of the joint {name}", [low, high], own, PRECISION * size)


def _stated_masses(
    plain: Mapping[str, MassProperties], chosen: Candidate, reference: Reference
) -> dict[str, MassProperties] | None:
    """The masses that loads state, in the heights of the plates; None where they state none."""
    if chosen.task.loads is None:
        return None
    own = Masses.of(reference, chosen.task.loads, chosen.task.body, reference.scale)
    if not own.mass.any():
        return None
    out, least = dict(plain), LIGHTEST * float(own.mass.max())
    for name, mass, centre, inertia in zip(reference.moving, *own, strict=True):
        plate = plain[name]
        if mass < least:  # it weighs nothing, which no simulation can move
            share = least / plate.mass
            out[name] = MassProperties(least, plate.centre, share * plate.inertia)
            continue
        flat = inertia * np.diag([0.5, 0.5, 1.0])
        out[name] = MassProperties(float(mass), np.append(centre, plate.centre[2]), flat)
    return out


def require_up(up: str) -> FloatArray:
    """A direction (3,) of F by its name; raises E162."""
    if up in DIRECTIONS:
        return DIRECTIONS[up]
    raise InputError(
        "E162",
        f"there is no direction {up!r}",
        why=f"up is {', '.join(DIRECTIONS)}: an axis of the plane of the poses, or z, across it",
        help=Help.of("give {}", Cure("up", "y")),
    )


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
    if LEAST_DENSITY <= density <= GREATEST_DENSITY:
        return density
    raise InputError(
        "E162",
        f"there is no material of {density:g} kg/m³",
        why=f"densities from {LEAST_DENSITY:g} to {GREATEST_DENSITY:g} kg/m³ are taken: "
        "aluminium has 2700, steel 7850",
        help=Help.of("give {}, for aluminium; 1 g/cm³ is 1000 kg/m³", Cure("density", 2700)),
    )
