"""Velocities and accelerations of the bodies of a linkage, and the forces in its joints.

Each body has one coordinate against that on which it is in the tree: its angle in F, or how far it
slides.  Their derivatives u by the driver's carry all bodies, v = C u.  The joints that close the
loops are two equations each between them, K u = 0; differentiated once more, K u' = -b, where b are
the accelerations without u'.  Of a four-bar these are 2 x 2 systems, of a six-bar 4 x 4.

By virtual work the transpose of K carries the forces f of these joints: K^T f = C^T (M a - W).  W
are the loads, and M a what masses resist.  All other joints bear what is beyond them in the tree.

K, without the driver, is singular exactly at the dead points of the driver: there all is nan.
"""

from __future__ import annotations

from typing import Final, NamedTuple, final

import numpy as np

from burmester.mechanisms.bodies import GROUND, Bodies, LinkPlaces
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of, pairs_of

LOCKED: Final = 1e12  # condition number of K from which on the driver moves nothing


class _Tree(NamedTuple):
    """Of k bodies, the ground behind them, at places (n,); lengths in units of a size.

    bodies, on: the numbers of those of the limbs.  carried: C, (k + 1, k, n), velocities of the
    origins for a unit of each coordinate; turned: (k + 1, k), of the angles.
    closed: (c, k, n), K; ends: the numbers of the bodies that each closure joins.
    pins: of each joint the number of its limb, or of its closure from k on, and whether the holder
    of the pin is the body of that limb, or the first one of that closure.
    """

    bodies: tuple[int, ...]
    on: tuple[int, ...]
    carried: ComplexArray
    turned: FloatArray
    closed: ComplexArray
    ends: tuple[tuple[int, int], ...]
    pins: tuple[tuple[int, bool], ...]
    driver: int

    @property
    def others(self) -> list[int]:
        """All coordinates but the driver's."""
        return [k for k in range(len(self.bodies)) if k != self.driver]


@final
class Rates(NamedTuple):
    """At places (n,) of k bodies: the derivatives of their coordinates by the driver's.

    bodies: their names.  velocity, acceleration: (n, k, 3), first and second derivatives of x, y
    and the angle.  turns: whether the driver turns; else its coordinate is a length.
    tree, size: how the bodies carry each other.  inverse: (n, k - 1, k - 1), of K.
    closeness: (n,), the determinant of K; the driver is at a dead point where it is zero.
    """

    bodies: tuple[str, ...]
    velocity: FloatArray
    acceleration: FloatArray
    turns: bool
    tree: _Tree
    size: float
    inverse: FloatArray
    closeness: FloatArray

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
        tree, others = self.tree, self.tree.others
        force = complex_of(resisted).T
        work = (force.conj()[:, None] * tree.carried[:-1, others]).real.sum(axis=0)
        work += tree.turned[:-1, others].T @ (resisted[..., 2].T / self.size)
        both = (work.T[:, None] @ self.inverse)[:, 0].T
        closing = both[0::2] + 1j * both[1::2]
        left = np.concatenate([force, np.zeros_like(force[:1])])
        for (one, other), each in zip(tree.ends, closing, strict=True):
            left[one] -= each
            left[other] += each
        borne = [*np.zeros_like(force), *closing]
        for k in reversed(range(len(tree.bodies))):
            borne[k] = left[tree.bodies[k]]
            left[tree.on[k]] += borne[k]
        held = [borne[k] if first else -borne[k] for k, first in tree.pins]
        return pairs_of(np.stack(held, axis=-1))


def rates(bodies: Bodies, places: LinkPlaces) -> Rates:
    """The rates of a linkage with its bodies at places (n,), in the unit of its lengths."""
    size = float(np.nanmax(np.ptp(np.concatenate(bodies.pins(places)), axis=0)))
    number = {name: k for k, name in enumerate((*bodies.moving, GROUND))}
    at = [complex_of(places[name].translation) / size for name in number]
    turn = [np.exp(1j * places[name].angle) for name in number]
    count, n = len(bodies.moving), len(at[0])

    def arm(name: str, hole: FloatArray) -> ComplexArray:
        return np.asarray(turn[number[name]] * (complex(*hole) / size))

    # Of each limb: its body and that it is on; the arms of their joint, or how far they are apart.
    limbs = list[tuple[int, int, ComplexArray, ComplexArray, bool]]()
    carried = np.zeros((count + 1, count, n), dtype=complex)
    turned = np.zeros((count + 1, count))
    for k, (name, on, joint, slides) in enumerate(bodies.tree):
        body, base = number[name], number[on]
        if slides:
            assert joint.slot is not None
            one = at[body] - at[base]
            along = complex(*joint.slot.directions[1]) * (-1 if name == joint.slot.link else 1)
            two = -turn[number[joint.slot.link]] * along
            turned[body] = turned[base]
        else:
            one, two = arm(on, joint.hole(on)), arm(name, joint.hole(name))
            turned[body, k] = 1.0
        carried[body] = carried[base] + 1j * turned[base][:, None] * one
        carried[body, k] -= two if slides else 1j * two
        limbs.append((body, base, one, two, slides))
    closures = [
        (number[one], number[other], arm(one, joint.hole(one)), arm(other, joint.hole(other)))
        for joint, one, other in bodies.closures
    ]
    closed = np.stack(
        [
            carried[one] - carried[other]
            + 1j * (turned[one][:, None] * first - turned[other][:, None] * second)
            for one, other, first, second in closures
        ]
    )  # fmt: skip
    driver = next(k for k, limb in enumerate(bodies.tree) if limb.body == bodies.driver)
    tree = _Tree(
        tuple(each[0] for each in limbs),
        tuple(each[1] for each in limbs),
        carried,
        turned,
        closed,
        tuple(each[:2] for each in closures),
        _pins(bodies),
        driver,
    )
    matrix = np.stack([closed.real, closed.imag], axis=1).reshape(-1, count, n).transpose(2, 0, 1)
    inverse = _inverse(matrix[:, :, tree.others])

    def solved(right: FloatArray, own: float) -> FloatArray:
        """The coordinates (k, n) where the equations have a right side (n, k - 1)."""
        out = own + 0 * np.repeat(inverse[:, :1, 0].T, count, axis=0)
        out[tree.others] = (inverse @ right[..., None])[..., 0].T
        return np.asarray(out)

    first = solved(-matrix[:, :, driver], 1.0)
    spin = turned @ first
    bent = np.zeros((count + 1, n), dtype=complex)
    for k, (body, base, one, two, slides) in enumerate(limbs):
        bent[body] = bent[base] - spin[base] ** 2 * one
        bent[body] += -2j * spin[base] * first[k] * two if slides else spin[body] ** 2 * two
    off = [
        bent[one] - bent[other] - spin[one] ** 2 * at_one + spin[other] ** 2 * at_other
        for one, other, at_one, at_other in closures
    ]
    second = solved(-np.stack([part for each in off for part in (each.real, each.imag)], -1), 0.0)

    def told(speed: ComplexArray, turning: FloatArray, unit: float) -> FloatArray:
        parts = speed.real * (size / unit), speed.imag * (size / unit), turning / unit
        return np.stack([each[:-1].T for each in parts], axis=-1)

    turns = not limbs[driver][-1]
    unit = 1.0 if turns else size
    velocity = told((carried * first).sum(axis=1), spin, unit)
    acceleration = told((carried * second).sum(axis=1) + bent, turned @ second, unit**2)
    closeness = np.linalg.det(matrix[:, :, tree.others])
    return Rates(bodies.moving, velocity, acceleration, turns, tree, size, inverse, closeness)


def _pins(bodies: Bodies) -> tuple[tuple[int, bool], ...]:
    """Where the pin of each joint is in the tree; see `_Tree`."""
    of = {
        id(limb.joint): (k, limb.body == limb.joint.holder)
        for k, limb in enumerate(bodies.tree)
        if not limb.slides
    }
    for k, (joint, one, _) in enumerate(bodies.closures, start=len(bodies.tree)):
        of[id(joint)] = k, one == joint.holder
    return tuple(of[id(joint)] for joint in bodies.joints)


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
