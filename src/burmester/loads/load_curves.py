"""What a linkage bears at each place of its motion: arrays for Python, tables and pages."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np

from burmester.loads.drive_in_time import Course, course_of, course_through
from burmester.loads.loaded_motion import LoadedLinkage, LoadedMotion
from burmester.loads.swing import swing
from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import Drive, Spring


class SpringCurve(NamedTuple):
    """A spring along the motion, (n,) each: length in the task's unit, force in N where it pulls.

    A torsion spring has degrees and N m.
    """

    spring: Spring
    length: FloatArray
    force: FloatArray


class MovingCurves(NamedTuple):
    """The same places while the driver moves in time, (n,) each.

    time: s.  driver_speed: degrees/s, or the task's unit/s.  body_speed: of the body's origin, the
    task's unit/s.  effort, hand, pins: as in `LoadCurves`, with what accelerates the masses.
    """

    time: FloatArray
    driver_speed: FloatArray
    body_speed: FloatArray
    effort: FloatArray
    hand: FloatArray | None
    pins: dict[str, FloatArray]


@final
@dataclass(frozen=True, slots=True, eq=False)
class LoadCurves:
    """A linkage under its loads from the first pose to the last, held still at each place.

    Attributes
    ----------
    turns : bool
        Whether the driver turns; else it slides.
    shares : (n,) array
        Of the motion, from 0 to 1.
    driver : (n,) array
        Its angle in degrees, or its length along its line in the task's unit.
    effort : (n,) array
        The driver's torque in N m, or force in N, that holds the linkage, positive the way its
        coordinate grows.
    friction : (n,) array
        By how much the friction of gas springs adds to it or takes from it.
    hand : (n,) array, optional
        The force in N of a hand in place of the driver, positive along its way to the last pose.
    pins : dict of (n, 2) arrays
        The force of each pin in N, in F, on the link that holds the pin.
    energy : (n,) array
        The potential energy of weights and springs in J, zero at its least.
    inertia : (n,) array
        Reduced to the driver: kg m², or kg.
    springs : tuple of SpringCurve
        But for counterweights.
    moving : MovingCurves, optional
        The same in time, where there is a drive.
    """

    turns: bool
    shares: FloatArray
    driver: FloatArray
    effort: FloatArray
    friction: FloatArray
    hand: FloatArray | None
    pins: dict[str, FloatArray]
    energy: FloatArray
    inertia: FloatArray
    springs: tuple[SpringCurve, ...]
    moving: MovingCurves | None


class SwingCurves(NamedTuple):
    """A linkage that is let go, at times (n,) in s, without friction.

    driver: degrees, or the task's unit.  driver_speed: the same a second.  energy: of motion and
    place in J, a constant but for rounding.  ended: whether it came to an end of the motion, where
    the times end.
    """

    time: FloatArray
    driver: FloatArray
    driver_speed: FloatArray
    energy: FloatArray
    ended: bool


def load_curves(linkage: LoadedLinkage, shares: FloatArray) -> LoadCurves:
    """A linkage at shares (n,) of its motion."""
    at, drive = linkage.at(shares), linkage.loads.drive
    energy = at.energy - np.nanmin(at.energy)
    moving = None
    if drive is not None and (timing := linkage.timing(drive)).missed is None:
        first, last = linkage.at(2).drive.tolist()
        moving = _moving(linkage, at, course_through(timing, (at.drive - first) / (last - first)))
    return LoadCurves(
        at.rates.turns,
        shares,
        _counted(at, at.drive),
        at.effort,
        at.friction,
        _hand(at, at.effort),
        at.pin_forces(-at.applied),
        energy,
        at.inertia[0],
        _springs(at),
        moving,
    )


def curves_in_time(
    linkage: LoadedLinkage, drive: Drive, count: int
) -> tuple[FloatArray, MovingCurves]:
    """The driver (n,), and the linkage, at so many times, evenly from beginning to end."""
    course = course_of(linkage.timing(drive), count)
    at = linkage.at_driver(course.share)
    return _counted(at, at.drive), _moving(linkage, at, course)


def swing_from(linkage: LoadedLinkage, pose: int, seconds: float) -> SwingCurves:
    """A linkage that is let go at a pose, a number from 0."""
    ends = linkage.at(2)
    start = (linkage.at_poses[pose] - ends.drive[0]) / (ends.drive[1] - ends.drive[0])
    swung = swing(linkage, min(1.0, max(0.0, float(start))), seconds)
    driver, speed = (_counted(ends, each) for each in (swung.drive, swung.speed))
    return SwingCurves(swung.time, driver, speed, swung.energy, swung.ended)


def _counted(at: LoadedMotion, driver: FloatArray) -> FloatArray:
    """A driver's radians or metres as degrees or in the task's unit."""
    return np.degrees(driver) if at.rates.turns else driver / at.of.metre


def _hand(at: LoadedMotion, effort: FloatArray) -> FloatArray | None:
    return None if at.loads.hand is None else at.hand_force(effort)


def _springs(at: LoadedMotion) -> tuple[SpringCurve, ...]:
    turned = [each.spring.kind == "torsion" for each in at.springs]
    return tuple(
        SpringCurve(
            each.spring,
            np.degrees(each.length) if turns else each.length / at.of.metre,
            each.tension,
        )
        for each, turns in zip(at.springs, turned, strict=True)
    )


def _moving(linkage: LoadedLinkage, at: LoadedMotion, course: Course) -> MovingCurves:
    """Places (n,) of a course in time."""
    first, last = linkage.at(2).drive.tolist()
    way = last - first
    speed, push = course.speed * way, course.acceleration * way
    resisted = at.carried(speed, push) - at.applied
    effort = at.rates.effort(resisted)
    velocity = at.rates.of_body(at.bodies.body)[0][:, :2] * speed[:, None]
    return MovingCurves(
        course.time,
        _counted(at, speed),
        np.hypot(*velocity.T) / at.of.metre,
        effort,
        _hand(at, effort),
        at.pin_forces(resisted),
    )
