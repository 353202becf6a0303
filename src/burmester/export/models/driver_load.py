"""What a driver bears: the force that holds the linkage against gravity, and the reduced inertia.

By virtual work: for a unit speed of the driver's joint, the rate of the potential energy is the
generalized force that holds the linkage, and twice the kinetic energy its reduced inertia.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple, final

import numpy as np

from burmester.errors import InputError
from burmester.export.models.mass_properties import MassProperties
from burmester.export.six_bar_reference import plates_of
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.fourbar.instantaneous import velocity
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["DIRECTIONS", "STANDARD_GRAVITY", "DriverLoad", "require_up"]

STANDARD_GRAVITY: Final = 9.80665  # m/s²
LOCKED: Final = 1e14  # condition of the equations of motion from which on a linkage is locked
DIRECTIONS: Final[Mapping[str, FloatArray]] = {
    f"{sign}{axis}": (-1.0 if sign else 1.0) * np.eye(3)[number]
    for sign in ("", "-")
    for number, axis in enumerate("xyz")
}


@final
class DriverLoad(NamedTuple):
    """At coupler places (n,): newtons and kilograms, or N m and kg m² of a driver that turns.

    holding: (n,), by which the motor holds the linkage still, positive the way the joint counts.
    inertia: (n,), of all bodies, reduced to the driver's joint.  Not finite at dead points.
    """

    holding: FloatArray
    inertia: FloatArray

    @classmethod
    def of(
        cls,
        linkage: Linkage,
        places: Displacement,
        bodies: Mapping[str, MassProperties],
        up: FloatArray,
    ) -> DriverLoad:
        """The load of a linkage (metres); up: (3,), a direction of F."""
        rates = velocity(linkage, places)
        v, omega = complex_of(rates[..., :2]), rates[..., 2]
        moving = [("coupler", v, omega, places.rotate(bodies["coupler"].centre[:2]))]
        for name, dyad in (("driver", linkage.first), ("follower", linkage.second)):
            speed, turning, angle = _side(dyad, places, v, omega)
            arm = Displacement(np.zeros(2), angle).rotate(bodies[name].centre[:2])
            moving.append((name, speed, turning, arm))
        return cls._of(moving, bodies, up)

    @classmethod
    def of_six_bar(
        cls, found: FoundSixBar, bodies: Mapping[str, MassProperties], up: FloatArray
    ) -> DriverLoad:
        """The load of a six-bar (metres) at its poses; up: (3,), a direction of F."""
        skeleton, frames = found.skeleton, found.links(found.drive)
        at = {name: complex_of(there) for name, there in found.joints(found.drive).items()}
        plates, numbers = (
            plates_of(skeleton),
            {link: k for k, (link, *_) in enumerate(skeleton.tree)},
        )
        pins = {link: joint for link, _, joint in skeleton.tree}
        # The velocity of a link's pin, a row for how fast each of the links turns: (n, 5).
        rows = {skeleton.ground: np.zeros((len(found.drive), len(numbers)), dtype=complex)}

        def velocity_of(link: str, point: ComplexArray) -> ComplexArray:
            out = rows[link].copy()
            if link != skeleton.ground:
                out[:, numbers[link]] += 1j * (point - at[pins[link]])
            return out

        for link, on, joint in skeleton.tree:
            rows[link] = velocity_of(on, at[joint])
        driver = np.eye(len(numbers))[numbers[skeleton.crank(found.driver_pivot)]]
        equations = [np.broadcast_to(driver, (len(found.drive), 1, len(numbers)))]
        for joint, one, other in skeleton.closures:
            apart = velocity_of(one, at[joint]) - velocity_of(other, at[joint])
            equations.append(np.stack([apart.real, apart.imag], axis=1))
        matrix = np.concatenate(equations, axis=1)
        matrix[np.linalg.cond(matrix) > LOCKED] = np.nan
        turning = np.linalg.solve(matrix, np.eye(len(numbers))[:, :1])[..., 0]
        moving = []
        for link, number in numbers.items():
            rate = velocity_of(link, complex_of(frames[link].translation))
            speed = (rate * turning).sum(axis=-1)
            centre = frames[link].rotate(bodies[plates[link]].centre[:2])
            moving.append((plates[link], speed, turning[:, number], centre))
        return cls._of(moving, bodies, up)

    @classmethod
    def _of(
        cls,
        moving: Sequence[tuple[str, ComplexArray, FloatArray, FloatArray]],
        bodies: Mapping[str, MassProperties],
        up: FloatArray,
    ) -> DriverLoad:
        """The load where bodies move: the velocity of each one's origin, its turning, its centre.

        The centres of mass (n, 2) are from the origins, in F.
        """
        holding, inertia = (np.zeros(moving[0][2].shape) for _ in range(2))
        for name, speed, turning, arm in moving:
            body = bodies[name]
            with np.errstate(invalid="ignore", over="ignore"):
                centre = speed + 1j * turning * complex_of(arm)
                rise = centre.real * up[0] + centre.imag * up[1]
                holding = holding + body.mass * STANDARD_GRAVITY * rise
                inertia = inertia + body.mass * np.abs(centre) ** 2
                inertia = inertia + body.inertia[2, 2] * turning**2
        return cls(holding, inertia)


def _side(
    dyad: Dyad, places: Displacement, v: ComplexArray, omega: FloatArray
) -> tuple[ComplexArray, FloatArray, FloatArray]:
    """The velocity of the origin of a side's body, its angular velocity, and its angle."""
    assert isinstance(dyad, RR | PR | RP)
    if isinstance(dyad, RP):  # its pin turns with the slot
        return np.zeros_like(v), omega, np.asarray(places.angle + dyad.normal_angle)
    with np.errstate(invalid="ignore"):
        pin = v + 1j * omega * complex_of(places.rotate(dyad.moving_pivot))
        if isinstance(dyad, PR):
            return pin, 0 * places.angle, 0 * places.angle
        arm = complex_of(places.act(dyad.moving_pivot) - dyad.fixed_pivot)
        return np.zeros_like(v), (pin / arm).imag, np.angle(arm)


def require_up(up: str) -> FloatArray:
    """A direction (3,) of F by its name; raises E162."""
    if up in DIRECTIONS:
        return DIRECTIONS[up]
    raise InputError(
        "E162",
        f"there is no direction {up!r}",
        why=f"up is {', '.join(DIRECTIONS)}: an axis of the plane of the poses, or z, across it",
        help="give --up y",
    )
