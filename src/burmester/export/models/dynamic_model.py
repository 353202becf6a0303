"""A linkage as bodies that have masses: what the models for simulation share; metres, kilograms.

E162 dimensions that cannot be made        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.export.models.bodies import INSET, METRES, Shape, parts_of_bodies, rim, shapes
from burmester.export.models.driver_load import STANDARD_GRAVITY, require_up
from burmester.export.models.joints import JointMotion
from burmester.export.models.mass_properties import MassProperties, require_density
from burmester.export.options import Options
from burmester.export.parts.plate import SLOT_RUN_OUT
from burmester.export.parts.plates import Assembly, assembly_of
from burmester.export.reference import PRECISION, Reference, require_equal
from burmester.mechanisms.bodies import ORIGIN
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

HINGE_MARGIN: Final = math.radians(5)  # by which a hinge may leave the range used, at each end
DAMPING_RATE: Final = 0.1  # 1/s: a link alone on its joint loses its speed at this rate
MATERIALS: Final = {2700.0: "aluminium", 7850.0: "steel"}


@final
@dataclass(frozen=True, slots=True, eq=False)
class DynamicModel:
    """The bodies of a linkage, each in a frame of its own.

    masses, shapes: by body, the ground first.  outline: of what the body carries, only to be seen.
    joints: at the poses and in between.  low, high: (k,), the limits of the joints.
    up: (3,), in F.
    """

    reference: Reference
    made: Assembly
    masses: Mapping[str, MassProperties]
    shapes: Mapping[str, list[Shape]]
    outline: list[Shape]
    joints: JointMotion
    low: FloatArray
    high: FloatArray
    up: FloatArray

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
        return cls(
            reference,
            made,
            {name: MassProperties.of(each, made, density) for name, each in parts.items()},
            {name: shapes(each, made) for name, each in parts.items()},
            [] if body is None else rim(body.vertices * reference.scale, made),
            joints,
            joints.low - margin,
            joints.high + margin,
            up,
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
        sentences = [
            "Each body has the mass, the centre of mass and the inertia of its plates and pins, "
            f"with holes and slots, of {options.density:g} kg/m³"
            + (f" ({named})" if named else "")
            + f": plates {size.thickness:g} mm thick and {size.width:g} mm wide, holes of "
            f"{size.hole:g} mm, pins of {size.pin:g} mm."
            + (
                " The pin of a slider is a body of its own."
                if any(each.slides for each in self.reference.tree)
                else ""
            ),
            "The options density, thickness, width, hole, pin and gap state others.",
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
        return -STANDARD_GRAVITY * self.up

    def require_body(
        self, name: str, mass: float, centre: ArrayLike, inertia: ArrayLike, origin: ArrayLike = 0.0
    ) -> None:
        """Raise E160 where a body read back is another; origin: of its frame in the model's."""
        own = self.masses[name]
        size = float(np.abs(own.inertia).max())
        require_equal(f"the mass of the {name}", mass / own.mass, 1, PRECISION)
        there = np.asarray(centre) + np.asarray(origin)
        near = PRECISION * self.reference.span
        require_equal(f"the centre of mass of the {name}", there, own.centre, near)
        wanted = own.inertia / size
        require_equal(f"the inertia of the {name}", np.divide(inertia, size), wanted, PRECISION)

    def require_limits(self, index: int, low: float, high: float, zero: float = 0.0) -> None:
        """Raise E160 where limits read back are others; index: of the joint; zero: its 0."""
        name = self.names[index]
        own = [self.low[index] - zero, self.high[index] - zero]
        size = 1.0 if self.joints.turning[index] else self.reference.span
        require_equal(f"the limits of the joint {name}", [low, high], own, PRECISION * size)
