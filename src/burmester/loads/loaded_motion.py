"""A linkage under its loads along its motion: efforts, reactions, energy; SI units throughout.

For a unit speed of the driver the bodies move by v.  So by virtual work the driver's effort is the
sum of (M a - W) v over the bodies, a torque where the driver turns and a force where it slides.
With q the driver's coordinate, I = sum m v² the reduced inertia and V the potential energy, that is
I q'' + I' q'² / 2 + dV/dq (Eksergian's equation).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.loads.drive_in_time import Timing
from burmester.loads.masses import Masses, body_named, require_links
from burmester.loads.spring_laws import SpringLaw
from burmester.mechanisms.bodies import GROUND, Bodies, Joint, LinkPlaces
from burmester.mechanisms.rates import Rates, cross, rates, triples
from burmester.numerics.arrays import (
    ComplexArray,
    FloatArray,
    complex_of,
    dot,
    pairs_of,
    wrapped_angle,
)
from burmester.tasks.length_units import MILLIMETRES
from burmester.tasks.loads import BODY, SLACK, Drive, Loads, Spring
from burmester.verdicts.judged_linkage import LinkageAtPoses
from burmester.verdicts.motion import Motion, Way, by_driver

STILL = 1e-9  # of the greatest speed of a hand; less is none
LOOKS = 361  # places along the motion at which a linkage is looked at
SAME_SHARE = 1e-9  # of the motion; a place that is nearer to a pose is the pose


class _Point(NamedTuple):
    """A point of a body: the body's number, and in F the arm and the velocity (n,) of the point."""

    body: int
    arm: ComplexArray
    speed: ComplexArray


class SpringCourse(NamedTuple):
    """A spring along the motion: length and tension (n,), and the rate of its length (n,).

    At places (n,): metres, N, and metres for a unit of the driver.  Of torsion springs radians and
    N m.  ends: of a straight one both points, and the ways (n,) to which they are pulled.
    """

    spring: Spring
    length: FloatArray
    tension: FloatArray
    rate: FloatArray
    law: SpringLaw
    ends: tuple[tuple[_Point, ComplexArray], ...] = ()

    @property
    def energy(self) -> FloatArray:
        """What it stores (n,), J, up to a constant."""
        return self.law.energy(self.length)

    @property
    def slack(self) -> float:
        """The length of a coil spring at which it begins to pull or to push."""
        return self.law.slack

    def off(self, length: FloatArray, metre: float) -> NDArray[np.bool_]:
        """Whether lengths (n,) are beyond what it allows, which those of torsion never are."""
        if self.spring.kind == "torsion":
            return np.zeros(length.shape, dtype=bool)
        least, most = (each * metre for each in self.spring.span)
        return self.law.off(length, (least, most))


class UnderLoads(Protocol):
    """A linkage under loads, as its places need to know it.

    bodies, masses: in metres and kg; a unit of the task has so many metres.
    at_poses: (N,), the driver's coordinate at the poses, nan where it reaches none.
    looks: the driver's coordinate (n,) and the places of the bodies along the whole motion, by
    which the turns of torsion springs count.
    """

    @property
    def loads(self) -> Loads: ...
    @property
    def metre(self) -> float: ...
    @property
    def bodies(self) -> Bodies: ...
    @property
    def masses(self) -> Masses: ...
    @property
    def at_poses(self) -> FloatArray: ...
    @property
    def looks(self) -> tuple[FloatArray, LinkPlaces]: ...


class LoadedBodies(NamedTuple):
    """Bodies under loads that are known at some places only; see `UnderLoads`."""

    loads: Loads
    metre: float
    bodies: Bodies
    masses: Masses
    at_poses: FloatArray
    looks: tuple[FloatArray, LinkPlaces]


@final
@dataclass(frozen=True, eq=False)
class LoadedLinkage:
    """A linkage of a task with loads; see `UnderLoads`.

    way: its motion in the task's unit.
    """

    found: LinkageAtPoses
    loads: Loads
    way: Way
    metre: float
    bodies: Bodies

    @classmethod
    def of(cls, found: LinkageAtPoses) -> Self:
        """Raises E163 where it does not move from one pose to another, and E177."""
        loads, way = found.task.loads, found.travel()
        assert loads is not None
        metre = MILLIMETRES[found.unit or ""] / 1000
        bodies = found.bodies.scaled(metre)
        require_links(loads, bodies)
        return cls(found, loads, way, metre, bodies)

    @cached_property
    def masses(self) -> Masses:
        """What the bodies weigh."""
        return Masses.of(self.bodies, self.loads, self.found.task.body, self.metre)

    @cached_property
    def pose_shares(self) -> FloatArray:
        """The shares (N,) of the motion at which poses are met; nan of those that are not."""
        return self.way(np.zeros(1)).pose_shares

    @cached_property
    def at_poses(self) -> FloatArray:
        """The driver's coordinate (N,) at the poses."""
        shares, (even, motion) = self.pose_shares, self._looks
        met = np.isfinite(shares)
        out = np.full(shares.shape, np.nan)
        out[met] = self.drives(motion)[np.searchsorted(even, shares[met])]
        return out

    @cached_property
    def _looks(self) -> tuple[FloatArray, Motion]:
        """The shares (n,), even ones and those of poses, and the motion there."""
        met = self.pose_shares[np.isfinite(self.pose_shares)]
        even = np.linspace(0.0, 1.0, LOOKS)
        apart = np.abs(even[:, None] - met).min(axis=1, initial=1.0)
        even = np.unique(np.concatenate([even[apart > SAME_SHARE], met]))
        return even, self.way(even)

    @cached_property
    def looks(self) -> tuple[FloatArray, LinkPlaces]:
        """The driver's coordinate and the bodies' places along the motion, from end to end."""
        looked = self.looked[1]
        return looked.drive, looked.places

    @cached_property
    def looked(self) -> tuple[FloatArray, LoadedMotion]:
        """It at even shares (n,) of its motion and at its poses, and these shares."""
        shares, motion = self._looks
        return shares, self._moved(motion)

    def at(self, shares: FloatArray | int = LOOKS) -> LoadedMotion:
        """It at shares (n,) of its motion, or so many of them."""
        if isinstance(shares, int):
            shares = np.linspace(0.0, 1.0, shares)
        return self._moved(self.way(shares))

    def timing(self, drive: Drive) -> Timing:
        """How its driver moves in time."""
        return Timing.of(drive, self.way, self.found.task.names)

    def at_driver(self, shares: FloatArray) -> LoadedMotion:
        """It at shares (n,) of what the driver goes."""
        return self._moved(self._by_driver(shares))

    @cached_property
    def _by_driver(self) -> Way:
        return by_driver(self.way)

    def _moved(self, motion: Motion) -> LoadedMotion:
        places = motion.links or self.found.bodies_at(motion.drive, motion.places)
        return LoadedMotion(self, self.drives(motion), places.scaled(self.metre))

    def drives(self, motion: Motion) -> FloatArray:
        """The driver's coordinate (n,) along a motion, radians or metres."""
        return motion.drive * (1.0 if motion.in_turns else self.metre)


@final
@dataclass(frozen=True, eq=False)
class LoadedMotion:
    """A loaded linkage at places (n,): its driver's coordinate there, radians or metres."""

    of: UnderLoads
    drive: FloatArray
    places: LinkPlaces

    @cached_property
    def rates(self) -> Rates:
        """How its bodies move for a unit of the driver."""
        return rates(self.bodies, self.places)

    @property
    def loads(self) -> Loads:
        """What loads it."""
        return self.of.loads

    @property
    def bodies(self) -> Bodies:
        """Its bodies, in metres."""
        return self.of.bodies

    @property
    def masses(self) -> Masses:
        """What they weigh."""
        return self.of.masses

    @property
    def sense(self) -> float:
        """1 where the driver's coordinate grows from the first pose to the last, else -1."""
        reached = self.of.at_poses[np.isfinite(self.of.at_poses)]
        return -1.0 if reached[-1] < reached[0] else 1.0

    @cached_property
    def centres(self) -> ComplexArray:
        """The centres of mass from the origins of the bodies, in F: (k, n)."""
        return self.rates.turn[:-1] * complex_of(self.masses.centre)[:, None]

    @cached_property
    def _moved(self) -> ComplexArray:
        """The velocities (k, n) of the centres of mass."""
        return self.rates.speeds[:-1] + 1j * self.rates.spins[:-1] * self.centres

    @cached_property
    def _weights(self) -> ComplexArray:
        """The weights (k, 1) of the bodies."""
        return np.asarray(self.masses.mass[:, None] * complex(*self.loads.gravity))

    def _point(self, link: str, at: tuple[float, float] | FloatArray) -> _Point:
        """A point (2,) of a link that a task names, in the task's unit."""
        name = body_named(link, self.bodies)
        k = self.rates.number(name)
        arm = self.rates.turn[k] * (complex(*at) * self.of.metre)
        return _Point(k, arm, self.rates.speeds[k] + 1j * self.rates.spins[k] * arm)

    @cached_property
    def springs(self) -> tuple[SpringCourse, ...]:
        """The springs along the motion, but for counterweights."""
        return tuple(
            self._torsion(each) if each.kind == "torsion" else self._straight(each)
            for each in self.loads.springs
            if each.kind != "counterweight"
        )

    def _straight(self, spring: Spring) -> SpringCourse:
        law = SpringLaw.of(spring, self.of.metre, self.loads.celsius)
        one, two = (self._point(each.link, each.point) for each in spring.ends)
        origins = self.rates.at[two.body] - self.rates.at[one.body]
        apart = origins * self.rates.tree.size + two.arm - one.arm
        length = np.abs(apart)
        # Where two points are one, a spring pulls nowhere.
        way = apart / np.where(length > 0, length, 1.0)
        rate = dot(two.speed - one.speed, way)
        tension = law.tension(length)
        return SpringCourse(spring, length, tension, rate, law, ((one, way), (two, -way)))

    def _torsion(self, spring: Spring) -> SpringCourse:
        names = [body_named(each.link, self.bodies) for each in spring.ends]
        free, (drives, looks) = np.radians(spring["free_deg"]), self.of.looks
        # Turns count along the whole motion, wherever on it the places are.
        table = np.unwrap(looks[names[1]].angle - looks[names[0]].angle)
        table -= 2 * np.pi * np.round((table[0] - free) / (2 * np.pi))
        near = np.interp(self.sense * self.drive, self.sense * drives, table)
        there = self.places[names[1]].angle - self.places[names[0]].angle
        angle = near + wrapped_angle(there - near)
        stiff = spring.count * np.degrees(spring["rate_Nm_per_deg"])
        one, two = (self.rates.number(name) for name in names)
        rate = self.rates.spins[two] - self.rates.spins[one]
        law = SpringLaw(0.0, float(stiff), float(free))
        return SpringCourse(spring, angle, law.tension(angle), rate, law)

    @cached_property
    def applied(self) -> FloatArray:
        """The loads W (n, k, 3) of the bodies: forces in F, moments about their origins."""
        loads, body = self.loads, self.rates.number(self.bodies.body)
        force = np.zeros(self.rates.at.shape, dtype=complex)
        moment = np.zeros(force.shape)
        force[:-1] += self._weights
        moment[:-1] += cross(self.centres, self._weights)
        moment[body] += loads.torque

        def exert(point: _Point, pull: ComplexArray) -> None:
            force[point.body] += pull
            moment[point.body] += cross(point.arm, pull)

        for each, acts in zip(loads.forces, self._acting, strict=True):
            turned = self.rates.turn[body if each.frame == "M" else -1]
            exert(self._point(BODY, each.at), turned * (complex(*each.force) * acts))
        for course in self.springs:
            if course.spring.kind == "torsion":
                for end, sign in zip(course.spring.ends, (1.0, -1.0), strict=True):
                    k = self.rates.number(body_named(end.link, self.bodies))
                    moment[k] += sign * course.tension
            for point, way in course.ends:
                exert(point, way * course.tension)
        return triples(force[:-1], moment[:-1])

    @cached_property
    def _acting(self) -> list[FloatArray]:
        """How much of each force acts at the places: 1 or 0, (n,)."""
        gone, met = self.sense * self.drive, self.sense * self.of.at_poses
        slack = SLACK * float(np.ptp(met[np.isfinite(met)]))
        out = []
        for force in self.loads.forces:
            low, high = (
                end if pose is None else met[pose - 1]
                for pose, end in ((force.from_pose, -np.inf), (force.to_pose, np.inf))
            )
            acts = (gone >= min(low, high) - slack) & (gone <= max(low, high) + slack)
            out.append(acts.astype(float))
        return out

    def carried(self, speed: FloatArray, push: FloatArray) -> FloatArray:
        """M a (n, k, 3) where the driver has speeds (n,) and accelerations (n,)."""
        turning = self.rates.spins[:-1] * push + self.rates.bends[1][:-1] * speed**2
        force = self.masses.mass[:, None] * (self._bent * speed**2 + self._moved * push)
        moment = cross(self.centres, force) + self.masses.inertia[:, None] * turning
        return triples(force, moment)

    @cached_property
    def _bent(self) -> ComplexArray:
        """The accelerations (k, n) of the centres of mass."""
        origins, spins = self.rates.bends
        return origins[:-1] + (1j * spins[:-1] - self.rates.spins[:-1] ** 2) * self.centres

    @cached_property
    def effort(self) -> FloatArray:
        """What the driver bears to hold the linkage (n,), N m or N, without friction."""
        return self.rates.effort(-self.applied)

    @cached_property
    def gross(self) -> FloatArray:
        """The efforts (n,) of all weights, forces and springs, none taken from another."""
        k = self.rates.number(self.bodies.body)
        out = np.abs(self.loads.torque * self.rates.spins[k])
        out += np.abs(dot(self._moved, self._weights)).sum(axis=0)
        for force, acts in zip(self.loads.forces, self._acting, strict=True):
            moved = self._point(BODY, force.at).speed
            out += acts * np.linalg.norm(force.force) * np.abs(moved)
        for course in self.springs:
            out += np.abs(course.tension * course.rate)
        return np.asarray(out)

    @cached_property
    def friction(self) -> FloatArray:
        """How much the friction of gas springs adds to or takes from the effort, (n,)."""
        return sum(
            (
                each.spring.count * each.spring["friction_N"] * np.abs(each.rate)
                for each in self.springs
                if each.spring.kind == "gas"
            ),
            start=np.zeros(self.drive.shape),
        )

    @cached_property
    def inertia(self) -> tuple[FloatArray, FloatArray]:
        """The reduced inertia I (n,) and its derivative by the driver's coordinate."""
        mass, inertia = self.masses.mass, self.masses.inertia
        turn, bent = self.rates.spins[:-1], self.rates.bends[1][:-1]
        total = mass @ np.abs(self._moved) ** 2 + inertia @ turn**2
        return total, 2 * (mass @ dot(self._moved, self._bent) + inertia @ (turn * bent))

    @cached_property
    def energy(self) -> FloatArray:
        """The potential energy (n,) in J of weights and springs, up to a constant."""
        centres = self.rates.at[:-1] * self.rates.tree.size + self.centres
        height = -dot(centres, self._weights).sum(axis=0)
        return sum((each.energy for each in self.springs), start=height)

    @cached_property
    def hand_path(self) -> FloatArray:
        """The rate (n, 2) at which the point of the hand moves, metres for a unit of the driver."""
        assert self.loads.hand is not None
        return pairs_of(self._point(BODY, self.loads.hand).speed)

    def hand_force(self, effort: FloatArray) -> FloatArray:
        """The force (n,) of a hand that takes the driver's effort, positive along its way.

        nan where the point of the hand stands still: there none moves the linkage.
        """
        speed = self.hand_speed
        moves = speed > STILL * np.nanmax(speed, initial=0.0)
        return np.asarray(self.sense * effort / np.where(moves, speed, np.nan))

    @cached_property
    def hand_speed(self) -> FloatArray:
        """How far (n,) the point of the hand moves for a unit of the driver, metres."""
        return np.asarray(np.hypot(*self.hand_path.T))

    @cached_property
    def pins(self) -> dict[str, FloatArray]:
        """The forces (n, 2) in F of the pins while it is held still, by their letters."""
        return self.pin_forces(-self.applied)

    def pin_forces(self, resisted: FloatArray) -> dict[str, FloatArray]:
        """The forces (n, 2) in F of the pins, by their letters; resisted: (n, k, 3), M a - W."""
        forces = self.rates.pin_forces(resisted)
        named = {letter(joint): forces[:, j] for j, joint in enumerate(self.bodies.joints)}
        return dict(sorted(named.items()))


def letter(joint: Joint) -> str:
    """The letter of a joint: of a four-bar A and B of the driver, C and D of the follower."""
    if joint.name:
        return joint.name
    drives = "driver" in joint.holes or (joint.slot is not None and joint.slot.pin == "driver")
    grounded = GROUND in joint.holes
    return ("A" if grounded else "B") if drives else ("D" if grounded else "C")
