"""Instantaneous kinematics: velocity, instant centre, centrodes, transmission of force at a place.

Each dyad lets the coupler move only so that it does no work against one force, which acts along a
line: an RR's link, the normal of a PR's line through its moving pivot, the normal of an RP's line
through its fixed pivot.  The instant centre is where the two lines cross.  Only the speeds and the
transmission angle depend on the driver.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dyad import PP, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.loop_closure import DrivenLoop, with_trailing_axes
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, complex_of


class Centrodes(NamedTuple):
    """The instant centres of places (*,) in F and in M: points (*, 2).

    Along a circuit the curves of these points roll on each other without slipping.  Not finite
    where the coupler only translates at that instant.
    """

    fixed: FloatArray
    moving: FloatArray


def twist(linkage: Linkage, places: Displacement) -> FloatArray:
    """The direction (*, 3) in which the coupler can move at places (*,), of any size.

    (v1, v2, omega): the velocity in F of the origin of M, and the angular velocity.  The axes of
    the linkages are the first of the places.  Zero at a change point, where both constraints are
    the same to first order and the coupler can move in two ways.

    Formula `twist` of the theory.
    """
    first, second = (
        with_trailing_axes(dyad, len(places.shape)).gradient(places)
        for dyad in (linkage.first, linkage.second)
    )
    return np.cross(first, second)


def velocity(linkage: Linkage, places: Displacement) -> FloatArray:
    """The coupler's velocity (*, 3) at places (*,) for a unit speed of the first dyad's input.

    (v1, v2, omega) as in `twist`; not finite at dead points of that input.
    Raises InputError E401 where the first dyad is PP, which has no single input.
    """
    motion = twist(linkage, places)
    speed = _input_speed(linkage.first, places, motion)
    with np.errstate(divide="ignore", invalid="ignore"):
        return motion / speed[..., None]


def mechanical_advantage(linkage: Linkage, places: Displacement) -> FloatArray:
    """The force (*,) at the origin of the body that a unit effort of the first dyad balances.

    The force acts along the path of that origin at places (*,), and nothing else loads the
    linkage, which has neither friction nor weight.  So by virtual work it is the driver's speed
    over the origin's: a force per torque, 1 / length, where the input turns; a plain number, force
    per force, where it slides.  0 at a dead point, where no effort moves the body; infinite where
    the origin is at rest while the driver moves, as in a toggle; nan at a change point.
    Raises InputError E401 as `velocity` does.
    """
    motion = twist(linkage, places)
    speed = np.abs(_input_speed(linkage.first, places, motion))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(speed / np.hypot(motion[..., 0], motion[..., 1]))


def _input_speed(first: Dyad, places: Displacement, motion: FloatArray) -> FloatArray:
    """The speed (*,) of the input of first dyads as couplers at places (*,) move (*, 3)."""
    driver = with_trailing_axes(first, len(places.shape))
    v, omega = complex_of(motion[..., :2]), motion[..., 2]
    if isinstance(driver, RP):
        return omega
    if isinstance(driver, PP):
        raise InputError(
            "E401",
            "this linkage cannot be driven by its first dyad",
            why="a PP dyad has no one joint to drive",
            help="drive it by the other dyad, if that is RR or PR: exchange the two",
        )
    arm = complex_of(places.rotate(driver.moving_pivot))
    v_pin = v + 1j * omega * arm
    if isinstance(driver, RR):
        arm = arm + complex_of(places.translation - driver.fixed_pivot)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray((v_pin / arm).imag)
    return np.asarray((v_pin * np.exp(-1j * driver.normal_angle)).imag)


def instant_centre(linkage: Linkage, places: Displacement) -> FloatArray:
    """The point (*, 2) of F about which the coupler turns at places (*,); see `Centrodes`.

    Formula `instant-centre` of the theory.
    """
    motion = twist(linkage, places)
    with np.errstate(divide="ignore", invalid="ignore"):
        arm = np.stack([-motion[..., 1], motion[..., 0]], axis=-1) / motion[..., 2:]
    return places.translation + arm


def centrodes(linkage: Linkage, places: Displacement) -> Centrodes:
    """The instant centres of places (*,) in F and in M."""
    fixed = instant_centre(linkage, places)
    with np.errstate(invalid="ignore"):
        return Centrodes(fixed, places.inverse().act(fixed))


def transmission_angle(linkage: Linkage, places: Displacement) -> FloatArray:
    """The angle (*,) in [0, pi/2] between the force on the second dyad and its lever, radians.

    The first dyad drives.  The angle is 0 at its dead points and best at pi/2.  It is the
    complement of the pressure angle, between the force and the way that its point can go: for a
    slider between the force and its line.

    An RR or PR that follows an RR or PR: between the coupler, from pin to pin, and the follower
    (for PR the normal of its line).  The same after an RP: between the normal of the driving slot,
    the force's only direction, and the follower.  An RP that follows: between the normal of its
    slot and the line from the driving pin to the fixed pivot.  An RP after an RP: between both
    slots.  These pass a couple on at any angle, but hold the body against a force only as they
    cross, and are at a change point where they are parallel.  nan for PP.

    In every case a unit force on the body at the second dyad's pin, in the worst direction, loads
    that dyad by 1 / sin of the angle.

    Formula `transmission-angle` of the theory.
    """
    if isinstance(linkage.first, PP) or isinstance(linkage.second, PP):
        return np.full(places.shape, np.nan)
    return with_trailing_axes(DrivenLoop.of(linkage), len(places.shape)).transmission(places)


def crossing_angle(one: FloatArray, other: FloatArray, apart: FloatArray) -> FloatArray:
    """The angle in [0, pi/2] at which two links cross at their common pin, radians.

    one, other: their lengths; apart: how far their other ends are apart; nan where they do not
    reach each other.  Of coupler and follower, with the distance of the crank's pin from the fixed
    pivot, it is the transmission angle of four pins, least where the crank is in line with the
    ground.
    """
    with np.errstate(invalid="ignore"):
        return np.asarray(np.arccos(np.abs((one**2 + other**2 - apart**2) / (2 * one * other))))
