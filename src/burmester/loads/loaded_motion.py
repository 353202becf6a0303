"""A linkage under its loads along its motion: efforts, reactions, energy; SI units throughout.

For a unit speed of the driver the bodies move by v.  So by virtual work the driver's effort is the
sum of (M a - W) v over the bodies, a torque where the driver turns and a force where it slides.
With q the driver's coordinate, I = sum m v² the reduced inertia and V the potential energy, that is
I q'' + I' q'² / 2 + dV/dq (Eksergian's equation).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.loads.drive_in_time import Timing
from burmester.loads.masses import Masses, body_named, require_links
from burmester.loads.spring_laws import SpringLaw
from burmester.mechanisms.bodies import GROUND, Bodies, Joint, LinkPlaces
from burmester.mechanisms.rates import Rates, rates
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.tasks.length_units import MILLIMETRES
from burmester.tasks.loads import SLACK, Drive, Loads, Spring
from burmester.verdicts.judged_linkage import LinkageAtPoses
from burmester.verdicts.motion import Motion, Way

STILL = 1e-9  # of the greatest speed of a hand; less is none
LOOKS = 361  # places along the motion at which a linkage is looked at


class SpringCourse(NamedTuple):
    """A spring along the motion: length and tension (n,), and the rate of its length (n,).

    At places (n,): metres, N, and metres for a unit of the driver.  Of torsion springs radians and
    N m.  off: where it is longer or shorter than it allows; slack: the length of a coil spring at
    which it begins to pull or to push.
    """

    spring: Spring
    length: FloatArray
    tension: FloatArray
    rate: FloatArray
    energy: FloatArray
    off: NDArray[np.bool_]
    slack: float = np.inf


@final
@dataclass(frozen=True, eq=False)
class LoadedLinkage:
    """A linkage of a task with loads.

    way: its motion in the task's unit, whose unit has so many metres.  bodies, masses: in metres
    and kg.  at_poses: (N,), the driver's coordinate at the poses, nan where it reaches none.
    """

    found: LinkageAtPoses
    loads: Loads
    way: Way
    metre: float
    bodies: Bodies
    masses: Masses
    pose_shares: FloatArray
    at_poses: FloatArray

    @classmethod
    def of(cls, found: LinkageAtPoses) -> Self:
        """Raises E163 where it does not move from one pose to another, and E177."""
        loads, way = found.task.loads, found.travel()
        assert loads is not None
        metre = MILLIMETRES[found.unit or ""] / 1000
        bodies = found.bodies.scaled(metre)
        require_links(loads, bodies)
        masses = Masses.of(bodies, loads, found.task.body, metre)
        shares = way(np.zeros(1)).pose_shares
        motion = way(np.nan_to_num(shares))
        at_poses = motion.drive * (1.0 if motion.in_turns else metre)
        at_poses = np.where(np.isfinite(shares), at_poses, np.nan)
        return cls(found, loads, way, metre, bodies, masses, shares, at_poses)

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
        return self._moved(Motion.of_driver(self.way, shares))

    @cached_property
    def looks(self) -> tuple[FloatArray, LinkPlaces]:
        """The driver's coordinate and the bodies' places along the motion, from end to end."""
        motion = self.way(np.linspace(0.0, 1.0, LOOKS))
        drive = motion.drive * (1.0 if motion.in_turns else self.metre)
        return drive, motion.links or self.found.bodies_at(motion.drive, motion.places)

    def _moved(self, motion: Motion) -> LoadedMotion:
        places = motion.links or self.found.bodies_at(motion.drive, motion.places)
        places = places.scaled(self.metre)
        return LoadedMotion(self, self.drives(motion), places, rates(self.bodies, places))

    def drives(self, motion: Motion) -> FloatArray:
        """The driver's coordinate (n,) along a motion, radians or metres."""
        return motion.drive * (1.0 if motion.in_turns else self.metre)


@final
@dataclass(frozen=True, eq=False)
class LoadedMotion:
    """A loaded linkage at places (n,): its driver's coordinate there, radians or metres."""

    of: LoadedLinkage
    drive: FloatArray
    places: LinkPlaces
    rates: Rates

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

    def _arm(self, name: str, point: FloatArray) -> FloatArray:
        """A point (2,) of a body from its origin, in F: (n, 2)."""
        return self.places[name].rotate(point)

    def _wrenches(self, name: str, force: FloatArray, arm: FloatArray) -> FloatArray:
        """A force (n, 2) at an arm (n, 2) of a body as loads of all bodies: (n, k, 3)."""
        out = np.zeros_like(self.rates.velocity)
        if name != GROUND:
            k = self.rates.bodies.index(name)
            out[:, k, :2] = force
            out[:, k, 2] = arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
        return out

    @cached_property
    def centres(self) -> FloatArray:
        """The centres of mass from the origins of the bodies, in F: (n, k, 2)."""
        pairs = zip(self.rates.bodies, self.masses.centre, strict=True)
        return np.stack([self._arm(name, centre) for name, centre in pairs], axis=1)

    @cached_property
    def springs(self) -> tuple[SpringCourse, ...]:
        """The springs along the motion, but for counterweights."""
        return tuple(
            self._torsion(each) if each.kind == "torsion" else self._straight(each)
            for each in self.loads.springs
            if each.kind != "counterweight"
        )

    def _ends(self, spring: Spring) -> list[tuple[str, FloatArray]]:
        names = [body_named(each.link, self.bodies) for each in spring.ends]
        points = [np.array(each.point) * self.of.metre for each in spring.ends]
        return [(name, self._arm(name, at)) for name, at in zip(names, points, strict=True)]

    def _straight(self, spring: Spring) -> SpringCourse:
        law = SpringLaw.of(spring, self.of.metre, self.loads.celsius)
        one, two = self._ends(spring)
        apart = self._point(*two) - self._point(*one)
        length = np.linalg.norm(apart, axis=-1)
        speed = self.rates.of_point(*two)[0] - self.rates.of_point(*one)[0]
        rate = (speed * _directions(apart, length)).sum(axis=-1)
        least, most = (each * self.of.metre for each in spring.span)
        off = law.off(length, (least, most))
        return SpringCourse(
            spring, length, law.tension(length), rate, law.energy(length), off, law.slack
        )

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
        rate = self.rates.of_body(names[1])[0][:, 2] - self.rates.of_body(names[0])[0][:, 2]
        moment = stiff * (angle - free)
        off = np.zeros(angle.shape, dtype=bool)
        return SpringCourse(spring, angle, moment, rate, moment**2 / (2 * stiff), off)

    def _point(self, name: str, arm: FloatArray) -> FloatArray:
        return self.places[name].translation + arm

    @cached_property
    def applied(self) -> FloatArray:
        """The loads W (n, k, 3) of the bodies: forces in F, moments about their origins."""
        loads, out = self.loads, np.zeros_like(self.rates.velocity)
        weights = self.masses.mass[:, None] * loads.gravity
        out[..., :2] += weights
        out[..., 2] += self.centres[..., 0] * weights[:, 1] - self.centres[..., 1] * weights[:, 0]
        body = self.bodies.body
        out[:, self.rates.bodies.index(body), 2] += loads.torque
        for force, acts in zip(loads.forces, self._acting, strict=True):
            own = np.broadcast_to(force.force, (len(out), 2))
            turned = self._arm(body, force.force) if force.frame == "M" else own
            arm = self._arm(body, force.at * self.of.metre)
            out += self._wrenches(body, turned * acts[:, None], arm)
        for course in self.springs:
            if course.spring.kind == "torsion":
                for end, sign in zip(course.spring.ends, (1.0, -1.0), strict=True):
                    name = body_named(end.link, self.bodies)
                    if name != GROUND:
                        out[:, self.rates.bodies.index(name), 2] += sign * course.tension
                continue
            one, two = self._ends(course.spring)
            apart = self._point(*two) - self._point(*one)
            pull = _directions(apart, course.length) * course.tension[:, None]
            out += self._wrenches(one[0], pull, one[1])
            out -= self._wrenches(two[0], pull, two[1])
        return out

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
        speed, push = speed[:, None], push[:, None]
        out = np.zeros_like(self.rates.velocity)
        for k, name in enumerate(self.rates.bodies):
            arm = self.centres[:, k]
            v, a = self.rates.of_point(name, arm)
            force = self.masses.mass[k] * (a * speed**2 + v * push)
            turned = self.rates.acceleration[:, k, 2:] * speed**2
            turned = (turned + self.rates.velocity[:, k, 2:] * push)[:, 0]
            out[:, k, :2] = force
            out[:, k, 2] = arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
            out[:, k, 2] += self.masses.inertia[k] * turned
        return out

    @cached_property
    def effort(self) -> FloatArray:
        """What the driver bears to hold the linkage (n,), N m or N, without friction."""
        return self.rates.effort(-self.applied)

    @cached_property
    def gross(self) -> FloatArray:
        """The efforts (n,) of all weights, forces and springs, none taken from another."""
        out = np.abs(self.loads.torque * self.rates.of_body(self.bodies.body)[0][:, 2])
        for k, name in enumerate(self.rates.bodies):
            moved = self.rates.of_point(name, self.centres[:, k])[0]
            out += np.abs(self.masses.mass[k] * moved @ self.loads.gravity)
        for force, acts in zip(self.loads.forces, self._acting, strict=True):
            moved = self.rates.of_point(
                self.bodies.body, self._arm(self.bodies.body, force.at * self.of.metre)
            )[0]
            out += acts * np.linalg.norm(force.force) * np.linalg.norm(moved, axis=-1)
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
        total, slope = np.zeros(self.drive.shape), np.zeros(self.drive.shape)
        for k, name in enumerate(self.rates.bodies):
            v, a = self.rates.of_point(name, self.centres[:, k])
            turn, bent = self.rates.velocity[:, k, 2], self.rates.acceleration[:, k, 2]
            total += self.masses.mass[k] * (v * v).sum(-1) + self.masses.inertia[k] * turn**2
            slope += 2 * self.masses.mass[k] * (v * a).sum(-1)
            slope += 2 * self.masses.inertia[k] * turn * bent
        return total, slope

    @cached_property
    def energy(self) -> FloatArray:
        """The potential energy (n,) in J of weights and springs, up to a constant."""
        at = np.stack([self.places[name].translation for name in self.rates.bodies], axis=1)
        weights = self.masses.mass[:, None] * self.loads.gravity
        height = -((at + self.centres) * weights).sum(axis=(1, 2))
        return sum((each.energy for each in self.springs), start=height)

    @cached_property
    def hand_path(self) -> FloatArray:
        """The rate (n, 2) at which the point of the hand moves, metres for a unit of the driver."""
        assert self.loads.hand is not None
        arm = self._arm(self.bodies.body, self.loads.hand * self.of.metre)
        return self.rates.of_point(self.bodies.body, arm)[0]

    def hand_force(self, effort: FloatArray) -> FloatArray:
        """The force (n,) of a hand that takes the driver's effort, positive along its way.

        nan where the point of the hand stands still: there none moves the linkage.
        """
        speed = np.linalg.norm(self.hand_path, axis=-1)
        moves = speed > STILL * np.nanmax(speed, initial=0.0)
        return np.asarray(self.sense * effort / np.where(moves, speed, np.nan))

    @cached_property
    def pins(self) -> dict[str, FloatArray]:
        """The forces (n, 2) in F of the pins while it is held still, by their letters."""
        return self.pin_forces(-self.applied)

    def pin_forces(self, resisted: FloatArray) -> dict[str, FloatArray]:
        """The forces (n, 2) in F of the pins, by their letters; resisted: (n, k, 3), M a - W."""
        forces = self.rates.pin_forces(resisted)
        named = {letter(joint): forces[:, j] for j, joint in enumerate(self.bodies.joints)}
        return dict(sorted(named.items()))


def _directions(apart: FloatArray, length: FloatArray) -> FloatArray:
    """Unit vectors (n, 2); zero where two points are one, and a spring pulls nowhere."""
    return apart / np.where(length > 0, length, 1.0)[:, None]


def letter(joint: Joint) -> str:
    """The letter of a joint: of a four-bar A and B of the driver, C and D of the follower."""
    if joint.name:
        return joint.name
    drives = "driver" in joint.holes or (joint.slot is not None and joint.slot.pin == "driver")
    grounded = GROUND in joint.holes
    return ("A" if grounded else "B") if drives else ("D" if grounded else "C")
