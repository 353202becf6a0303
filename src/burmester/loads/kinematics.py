"""Positions, velocities and accelerations of a linkage whose driver moves in time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.loads.drive_in_time import Timing, course_of
from burmester.mechanisms.rates import rates
from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import Drive, malformed
from burmester.verdicts.judged_linkage import LinkageAtPoses
from burmester.verdicts.motion import by_driver


class PointMotion(NamedTuple):
    """A point of the body in F at times (n,): (n, 2) each, by the task's unit and seconds."""

    place: FloatArray
    velocity: FloatArray
    acceleration: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class Kinematics:
    """The motion from the first pose to the last in time; lengths are in the task's unit.

    Attributes
    ----------
    drive : Drive
        How the driver moves.
    time : (n,) array
        In s, from 0.
    driver : (n,) array
        The driver's angle in degrees, or its length along its line where it slides.
    driver_speed, driver_acceleration : (n,) array
        Its derivatives by time: degrees/s and degrees/s², or lengths.
    body : Displacement
        (n,), the places of the body; angles in radians.
    velocity, acceleration : (n, 2) array
        Of the body's origin in F.  Not a number where the linkage is at a dead point.
    turning, turning_acceleration : (n,) array
        Of the body's angle: rad/s and rad/s².
    """

    drive: Drive
    time: FloatArray
    driver: FloatArray
    driver_speed: FloatArray
    driver_acceleration: FloatArray
    body: Displacement
    velocity: FloatArray
    acceleration: FloatArray
    turning: FloatArray
    turning_acceleration: FloatArray

    def point(self, at: FloatArray) -> PointMotion:
        """The motion of a point (2,) of the body, stated in its frame M."""
        arm = self.body.rotate(at)
        across = np.stack([-arm[:, 1], arm[:, 0]], axis=-1)
        turning, more = self.turning[:, None], self.turning_acceleration[:, None]
        return PointMotion(
            self.body.translation + arm,
            self.velocity + turning * across,
            self.acceleration + more * across - turning**2 * arm,
        )


def kinematics(found: LinkageAtPoses, drive: Drive, count: int) -> Kinematics:
    """The motion of a linkage at so many times; raises E163 where it has no motion, E177 where
    it cannot keep the times.
    """
    travel = found.travel()
    timing = Timing.of(drive, travel, found.task.names)
    if timing.missed is not None:
        raise malformed(f"{found.id} {timing.missed}", help="give times that its driver can keep")
    course = course_of(timing, count)
    motion = by_driver(travel)(course.share)
    bodies = found.bodies
    places = motion.links or found.bodies_at(motion.drive, motion.places)
    by_drive = rates(bodies, places)
    first, last = travel(np.array([0.0, 1.0])).drive.tolist()
    way = last - first
    speed, push = course.speed * way, course.acceleration * way
    number = by_drive.bodies.index(bodies.body)
    velocity, acceleration = (each[:, number] for each in by_drive.in_time(speed, push))
    counts = np.degrees if by_drive.turns else np.asarray
    return Kinematics(
        drive,
        course.time,
        counts(motion.drive),
        counts(speed),
        counts(push),
        motion.places,
        velocity[:, :2],
        acceleration[:, :2],
        velocity[:, 2],
        acceleration[:, 2],
    )
