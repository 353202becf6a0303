"""What a driver bears: the force that holds the linkage against gravity, and the reduced inertia.

By virtual work: for a unit speed of the driver's joint, the rate of the potential energy is the
generalized force that holds the linkage, and twice the kinetic energy its reduced inertia.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple, Self, final

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.models.mass_properties import MassProperties
from burmester.export.reference import Reference
from burmester.mechanisms.bodies import GROUND
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of

STANDARD_GRAVITY: Final = 9.80665  # m/s²
LOCKED: Final = 1e14  # condition of the equations of motion from which on a linkage is locked
DIRECTIONS: Final[Mapping[str, FloatArray]] = {
    f"{sign}{axis}": (-1.0 if sign else 1.0) * np.eye(3)[number]
    for sign in ("", "-")
    for number, axis in enumerate("xyz")
}


@final
class DriverLoad(NamedTuple):
    """At the poses (N,): newtons and kilograms, or N m and kg m² of a driver that turns.

    holding: (N,), by which the motor holds the linkage still, positive the way the joint counts.
    inertia: (N,), of all bodies, reduced to the driver's joint.  Not finite at dead points.
    """

    holding: FloatArray
    inertia: FloatArray

    @classmethod
    def of(cls, reference: Reference, bodies: Mapping[str, MassProperties], up: FloatArray) -> Self:
        """The load of a linkage (metres) at its poses; up: (3,), a direction of F."""
        tree, places = reference.tree, reference.at_poses
        numbers = {limb.body: k for k, limb in enumerate(tree)}
        ones = np.eye(len(tree))
        limbs = {limb.body: limb for limb in tree}

        def turning_of(body: str) -> FloatArray:
            """How fast a body turns, a row for the speed of each joint: (k,)."""
            if body == GROUND:
                return np.zeros(len(tree))
            limb = limbs[body]
            own = (0.0 if limb.slides else 1.0) * ones[numbers[body]]
            return np.asarray(turning_of(limb.on) + own)

        def velocity_of(body: str, point: ComplexArray) -> ComplexArray:
            """The velocity of a point (N,) of a body, a row for the speed of each joint: (N, k)."""
            if body == GROUND:
                return np.zeros((len(point), len(tree)), dtype=complex)
            limb = limbs[body]
            if limb.slides:
                slot = limb.joint.slot
                assert slot is not None
                ahead = complex_of(places[slot.link].rotate(slot.directions[1]))
                own = ahead[:, None] * ones[numbers[body]]
                return np.asarray(velocity_of(limb.on, point) + own)
            pivot = complex_of(places[limb.on].act(limb.joint.hole(limb.on)))
            arm = (point - pivot)[:, None] * turning_of(body)
            return velocity_of(limb.on, pivot) + 1j * arm

        equations = [
            np.broadcast_to(ones[numbers[reference.driver]], (*places.shape, 1, len(tree)))
        ]
        for joint, one, two in reference.closures:
            at = complex_of(places[one].act(joint.hole(one)))
            apart = velocity_of(one, at) - velocity_of(two, at)
            equations.append(np.stack([apart.real, apart.imag], axis=1))
        matrix = np.concatenate(equations, axis=1)
        matrix[np.linalg.cond(matrix) > LOCKED] = np.nan
        speeds = np.linalg.solve(matrix, ones[:, :1])[..., 0]
        holding, inertia = np.zeros(places.shape), np.zeros(places.shape)
        for name in numbers:
            body = bodies[name]
            centre = complex_of(places[name].act(body.centre[:2]))
            speed = (velocity_of(name, centre) * speeds).sum(axis=-1)
            rise = speed.real * up[0] + speed.imag * up[1]
            holding = holding + body.mass * STANDARD_GRAVITY * rise
            turning = speeds @ turning_of(name)
            inertia = inertia + body.mass * np.abs(speed) ** 2 + body.inertia[2, 2] * turning**2
        return cls(holding, inertia)


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
