"""Velocities and accelerations of the bodies of a linkage, and the forces in its joints.

The bodies have three coordinates each: x and y of their origins in F, and their angles.  A pin
gives two equations between them, a slot two, and the driver one: J v = e, where v are the
derivatives of all coordinates by the driver's.  Differentiated once more, J a = -J' v.  By virtual
work the transpose of J carries forces: J^T f = (M a - W), where W are the loads, M a what masses
resist, and f what the joints and the motor exert.

J is singular exactly at the dead points of the driver: there all is nan.
"""

from __future__ import annotations

from typing import Final, NamedTuple, TypeAlias, final

import numpy as np

from burmester.mechanisms.bodies import GROUND, ORIGIN, Bodies, LinkPlaces
from burmester.numerics.arrays import FloatArray

LOCKED: Final = 1e12  # condition number of J from which on the driver moves nothing


class _Places:
    """Bodies at places (n,) in units of a size, and where their columns in J begin."""

    def __init__(self, bodies: Bodies, places: LinkPlaces, size: float) -> None:
        self.first = {name: 3 * k for k, name in enumerate(bodies.moving)}
        self._places, self.size = places, size

    def arm(self, name: str, hole: FloatArray) -> FloatArray:
        """A point of a body from its origin, in F: (n, 2)."""
        return self._places[name].rotate(hole) / self.size

    def apart(self, one: str, other: str) -> FloatArray:
        """The origin of a body from that of another: (n, 2)."""
        return (self._places[one].translation - self._places[other].translation) / self.size

    def speed(self, name: str, motion: FloatArray) -> FloatArray:
        """The velocity (n, 3) of a body, of those (n, k, 3) of all."""
        if name == GROUND:
            return np.zeros((len(motion), 3))
        return np.asarray(motion[:, self.first[name] // 3])


class Pin(NamedTuple):
    """Two bodies have their holes (2,) at one point; its force is that on the first."""

    bodies: tuple[str, str]
    holes: tuple[FloatArray, FloatArray]

    def write(self, rows: FloatArray, at: _Places) -> None:
        """Write its two rows (n, 2, 3k) of J."""
        for name, hole, sign in zip(self.bodies, self.holes, (1.0, -1.0), strict=True):
            if name != GROUND:
                arm, k = at.arm(name, hole), at.first[name]
                rows[:, 0, k] = rows[:, 1, k + 1] = sign
                rows[:, 0, k + 2], rows[:, 1, k + 2] = -sign * arm[:, 1], sign * arm[:, 0]

    def curving(self, motion: FloatArray, at: _Places) -> FloatArray:
        """-J' v of its rows: (n, 2), where the bodies move by (n, k, 3)."""
        one, other = (
            at.speed(name, motion)[:, 2:] ** 2 * at.arm(name, hole)
            for name, hole in zip(self.bodies, self.holes, strict=True)
        )
        return one - other


class Line(NamedTuple):
    """A pin keeps its distance from a line of a link, with this normal (2,), and its angle."""

    link: str
    pin: str
    normal: FloatArray

    def write(self, rows: FloatArray, at: _Places) -> None:
        """Write its rows of J: one of lengths, one of angles."""
        normal, k = at.arm(self.link, self.normal * at.size), at.first[self.pin]
        rows[:, 0, k : k + 2], rows[:, 1, k + 2] = normal, 1.0
        if self.link != GROUND:
            k, apart = at.first[self.link], at.apart(self.pin, self.link)
            rows[:, 0, k : k + 2], rows[:, 1, k + 2] = -normal, -1.0
            rows[:, 0, k + 2] = normal[:, 0] * apart[:, 1] - normal[:, 1] * apart[:, 0]

    def curving(self, motion: FloatArray, at: _Places) -> FloatArray:
        """-J' v of its rows: (n, 2)."""
        normal, apart = at.arm(self.link, self.normal * at.size), at.apart(self.pin, self.link)
        on, pin = at.speed(self.link, motion), at.speed(self.pin, motion)
        past, turning = pin[:, :2] - on[:, :2], on[:, 2]
        across = normal[:, 0] * past[:, 1] - normal[:, 1] * past[:, 0]
        inward = turning**2 * (normal * apart).sum(axis=-1) - 2 * turning * across
        return np.stack([inward, np.zeros_like(inward)], axis=-1)


Pair: TypeAlias = Pin | Line


def pairs_of_bodies(bodies: Bodies) -> tuple[Pair, ...]:
    """What holds the bodies together: of each joint its pin, and its line if it has a slot."""
    out = list[Pair]()
    for joint in bodies.joints:
        holder, slot = joint.holder, joint.slot
        if slot is None:
            other = next(name for name in joint.holes if name != holder)
            out.append(Pin((holder, other), (joint.holes[holder], joint.holes[other])))
        else:
            out.append(Pin((holder, slot.pin), (joint.holes[holder], ORIGIN)))
            out.append(Line(slot.link, slot.pin, slot.directions[0]))
    return tuple(out)


@final
class Rates(NamedTuple):
    """At places (n,) of k bodies: the derivatives of their coordinates by the driver's.

    bodies: their names.  velocity, acceleration: (n, k, 3), first and second derivatives of x, y
    and the angle.  turns: whether the driver turns; else its coordinate is a length.
    pairs: in the order of their equations.  inverse: (n, 3k, 3k), of J with lengths in units of
    `size`.
    """

    bodies: tuple[str, ...]
    velocity: FloatArray
    acceleration: FloatArray
    turns: bool
    pairs: tuple[Pair, ...]
    inverse: FloatArray
    size: float

    def of_body(self, name: str) -> tuple[FloatArray, FloatArray]:
        """Velocity and acceleration (n, 3) of a body; those of the ground are zero."""
        if name == GROUND:
            still = np.zeros((len(self.velocity), 3))
            return still, still
        k = self.bodies.index(name)
        return self.velocity[:, k], self.acceleration[:, k]

    def of_point(self, name: str, arm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Velocity and acceleration (n, 2) of a point of a body; arm: (n, 2), from its origin."""
        v, a = self.of_body(name)
        across = np.stack([-arm[..., 1], arm[..., 0]], axis=-1)
        turning = v[:, 2:]
        return v[:, :2] + turning * across, a[:, :2] + a[:, 2:] * across - turning**2 * arm

    def in_time(self, speed: FloatArray, push: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Velocities and accelerations (n, k, 3) by time; speed, push: (n,), of the driver."""
        speed, push = speed[:, None, None], push[:, None, None]
        return self.velocity * speed, self.acceleration * speed**2 + self.velocity * push

    def effort(self, resisted: FloatArray) -> FloatArray:
        """The driver's effort (n,) by virtual work, positive the way its coordinate grows.

        resisted: (n, k, 3), M a - W of the bodies: forces in F, moments about their origins.
        """
        return np.asarray((resisted * self.velocity).sum(axis=(1, 2)))

    def pin_forces(self, resisted: FloatArray) -> FloatArray:
        """The forces (n, p, 2) in F of the pins on the first of both bodies; p: in their order.

        resisted: as in `effort`.
        """
        in_size = (resisted * [self.size, self.size, 1.0]).reshape(len(resisted), -1)
        forces = np.einsum("nij,ni->nj", self.inverse, in_size) / self.size
        pins = [2 * k for k, pair in enumerate(self.pairs) if isinstance(pair, Pin)]
        return np.stack([forces[:, [row, row + 1]] for row in pins], axis=1)


def rates(bodies: Bodies, places: LinkPlaces) -> Rates:
    """The rates of a linkage with its bodies at places (n,), in the unit of its lengths."""
    pairs = pairs_of_bodies(bodies)
    size = float(np.nanmax(np.ptp(np.concatenate(bodies.pins(places)), axis=0)))
    at = _Places(bodies, places, size)
    matrix = np.zeros((*places.shape, 3 * len(bodies.moving), 3 * len(bodies.moving)))
    for row, pair in enumerate(pairs):
        pair.write(matrix[:, 2 * row : 2 * row + 2], at)
    turns = _write_driver(matrix[:, -1], bodies, at)
    inverse = _inverse(matrix)
    motion = inverse[..., -1].reshape(len(matrix), -1, 3)
    curving = np.zeros(matrix.shape[:-1])
    for row, pair in enumerate(pairs):
        curving[:, 2 * row : 2 * row + 2] = pair.curving(motion, at)
    bent = np.einsum("nij,nj->ni", inverse, curving).reshape(motion.shape)
    lengths, unit = np.array([size, size, 1.0]), 1.0 if turns else size
    velocity, acceleration = motion * (lengths / unit), bent * (lengths / unit**2)
    return Rates(bodies.moving, velocity, acceleration, turns, pairs, inverse, size)


def _write_driver(row: FloatArray, bodies: Bodies, at: _Places) -> bool:
    """Write the row (n, 3k) of the driver's coordinate; whether that is an angle."""
    k = at.first[bodies.driver]
    (limb,) = (each for each in bodies.tree if each.body == bodies.driver)
    if not limb.slides:
        row[:, k + 2] = 1.0
        return True
    assert limb.joint.slot is not None
    row[:, k : k + 2] = limb.joint.slot.directions[1]
    return False


def _inverse(matrix: FloatArray) -> FloatArray:
    """The inverses of matrices (n, m, m); nan where they are singular, or nearly so."""
    try:
        inverse, singular = np.linalg.inv(matrix), np.zeros(len(matrix), dtype=bool)
    except np.linalg.LinAlgError:  # one of them is exactly singular
        singular = np.linalg.slogdet(matrix).sign == 0
        matrix = np.where(singular[:, None, None], np.eye(matrix.shape[-1]), matrix)
        inverse = np.linalg.inv(matrix)
    most = (np.abs(each).sum(axis=-1).max(axis=-1) for each in (matrix, inverse))
    inverse[singular | ~(next(most) * next(most) < LOCKED)] = np.nan
    return np.asarray(inverse)
