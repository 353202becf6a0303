"""Velocities and accelerations of the bodies of a linkage, and the forces in its joints.

Each body has one coordinate against that on which it is in the tree: its angle in F, or how far it
slides.  Their derivatives u by the driver's carry all bodies.  The joints that close the loops are
two equations each between them, K u = 0; differentiated once more, K u' = -b, where b are the
accelerations without u'.  Of a four-bar these are 2 x 2 systems, of a six-bar 4 x 4.

By virtual work the transpose of K carries the forces f of these joints: K^T f = C^T (M a - W), with
the velocities C of the bodies for a unit of each coordinate.  W are the loads, and M a what masses
resist.  All other joints bear what is beyond them in the tree.

K, without the driver, is singular exactly at the dead points of the driver: there all is nan.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final, NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.mechanisms.bodies import GROUND, Bodies, LinkPlaces
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of, pairs_of

LOCKED: Final = 1e12  # condition number of K from which on the driver moves nothing
# Of a pair (i, j) the other two of four numbers, so that all four are an even permutation.
THIRD: Final = np.array([[0, 2, 3, 1], [3, 0, 0, 2], [1, 3, 0, 0], [2, 0, 1, 0]])
FOURTH: Final = np.array([[0, 3, 1, 2], [2, 0, 3, 0], [3, 0, 0, 1], [1, 2, 0, 0]])


class _Tree(NamedTuple):
    """How k bodies carry each other: what does not change along the motion.

    bodies, on: (k,), the numbers of those of each limb; the ground's is k.
    base: (k,), the joint of each limb in the frame of the body that it is on; own: in that of body
    `frames` (k,), or the direction of a slide, turned by a quarter.  slides: (k,).
    ends: (2, c), the bodies that each closure joins; holes: (2, c), in their frames.
    path: (k + 1, k), 1 where a limb carries a body; turned: (k + 1, k), 1 where a coordinate is the
    angle of a body.
    equations: (c k, 2 k + 2 c), K by the vectors of limbs and closures, turned by a quarter.
    pins: (p, k + c), the force on the holder of each pin by what is beyond limbs, and closures.
    """

    names: tuple[str, ...]
    driver: int
    size: float
    bodies: NDArray[np.intp]
    on: NDArray[np.intp]
    frames: NDArray[np.intp]
    base: ComplexArray
    own: ComplexArray
    slides: NDArray[np.bool_]
    ends: NDArray[np.intp]
    holes: ComplexArray
    path: FloatArray
    turned: FloatArray
    equations: FloatArray
    pins: FloatArray

    @classmethod
    def of(cls, bodies: Bodies) -> Self:
        """That of bodies, in the unit of their lengths."""
        number = {name: k for k, name in enumerate((*bodies.moving, GROUND))}
        k, c = len(bodies.tree), len(bodies.closures)
        path, turned = np.zeros((k + 1, k)), np.zeros((k + 1, k))
        frames, base, own, slides = [], [], [], []
        for m, (name, on, joint, slide) in enumerate(bodies.tree):
            body, slot = number[name], joint.slot
            path[body] = path[number[on]]
            path[body, m] = 1.0
            if slide:
                assert slot is not None
                turned[body] = turned[number[on]]
                along = complex(*slot.directions[1]) * (-1 if name == slot.link else 1)
            else:
                turned[body, m] = 1.0
            frames.append(number[slot.link if slide and slot is not None else name])
            base.append(0j if slide else complex(*joint.hole(on)))
            own.append(1j * along if slide else complex(*joint.hole(name)))
            slides.append(slide)
        firsts = [(joint, one) for joint, one, _ in bodies.closures]
        seconds = [(joint, other) for joint, _, other in bodies.closures]
        ends = np.array([[number[name] for _, name in each] for each in (firsts, seconds)])
        holes = [[complex(*joint.hole(name)) for joint, name in each] for each in (firsts, seconds)]
        on_bodies = np.array([number[each.on] for each in bodies.tree])
        apart, eye = path[ends[0]] - path[ends[1]], np.eye(c)
        equations = [
            apart[:, None, :] * turned[on_bodies].T,
            -apart[:, :, None] * np.eye(k),
            turned[ends[0]][:, :, None] * eye[:, None],
            -turned[ends[1]][:, :, None] * eye[:, None],
        ]
        beyond = np.concatenate([np.eye(k), -apart.T], axis=1)  # of limbs by all that moves
        every = np.concatenate([beyond, np.eye(c, k + c, k)])
        pins = [sign * every[m] for m, sign in _pins(bodies)]
        lengths = [abs(complex(*at)) for joint in bodies.joints for at in joint.holes.values()]
        return cls(
            bodies.moving,
            next(m for m, limb in enumerate(bodies.tree) if limb.body == bodies.driver),
            max(lengths, default=0.0) or 1.0,
            np.array([number[each.body] for each in bodies.tree]),
            on_bodies,
            np.array(frames),
            np.array(base),
            np.array(own),
            np.array(slides),
            ends,
            np.array(holes),
            path,
            turned,
            np.concatenate(equations, axis=2).reshape(c * k, -1),
            np.array(pins),
        )

    @property
    def others(self) -> list[int]:
        """All coordinates but the driver's."""
        return [k for k in range(len(self.bodies)) if k != self.driver]


_tree = lru_cache(maxsize=32)(_Tree.of)  # a linkage is looked at again and again


@final
@dataclass(frozen=True, eq=False)
class Rates:
    """At places (n,) of k bodies: the derivatives of their coordinates by the driver's.

    turns: whether the driver turns; else its coordinate is a length.  at, turn: (k + 1, n), the
    origins of the bodies and the ground, in units of a size, and their directions.
    limbs: (2, k, n), the vectors from the origin of each limb's base to its joint, and of its body;
    arms: (2, c, n), of the closures.  inverse: (k - 1, k - 1, n), of K; first: (k, n), u.
    closeness: (n,), the determinant of K; the driver is at a dead point where it is zero.
    """

    tree: _Tree
    turns: bool
    at: ComplexArray
    turn: ComplexArray
    limbs: tuple[ComplexArray, ComplexArray]
    arms: ComplexArray
    inverse: FloatArray
    first: FloatArray
    closeness: FloatArray

    @property
    def bodies(self) -> tuple[str, ...]:
        """The names of the bodies."""
        return self.tree.names

    @property
    def _unit(self) -> float:
        return 1.0 if self.turns else self.tree.size

    @cached_property
    def _spins(self) -> FloatArray:
        """How fast the bodies (k + 1, n) turn for a unit of the driver, of lengths in sizes."""
        return self.tree.turned @ self.first

    @cached_property
    def spins(self) -> FloatArray:
        """How fast bodies and the ground turn: (k + 1, n)."""
        return self._spins / self._unit

    @cached_property
    def speeds(self) -> ComplexArray:
        """The velocities of the origins of the bodies and the ground: (k + 1, n)."""
        return self._carried(self._spins, self.first) * (1j * self.tree.size / self._unit)

    def _carried(self, spins: FloatArray, u: FloatArray) -> ComplexArray:
        one, two = self.limbs
        return _summed(self.tree.path, spins[self.tree.on] * one - u * two)

    @cached_property
    def bends(self) -> tuple[ComplexArray, FloatArray]:
        """The accelerations of origins (k + 1, n) and of angles (k + 1, n), the ground behind."""
        tree, spins, (one, two) = self.tree, self._spins, self.limbs
        on = spins[tree.on]
        turning = np.where(tree.slides[:, None], 2 * on, self.first) * self.first
        bent = _summed(tree.path, turning * two - on**2 * one)
        ends = bent[tree.ends] - spins[tree.ends] ** 2 * self.arms
        off = ends[0] - ends[1]
        right = np.stack([off.real, off.imag], axis=1).reshape(-1, off.shape[-1])
        second = 0 * self.first
        second[tree.others] -= (self.inverse * right).sum(axis=1)
        turned = tree.turned @ second
        origins = 1j * self._carried(turned, second) + bent
        return origins * (tree.size / self._unit**2), turned / self._unit**2

    @cached_property
    def velocity(self) -> FloatArray:
        """Derivatives of x, y and the angle of the bodies: (n, k, 3)."""
        return triples(self.speeds[:-1], self.spins[:-1])

    @cached_property
    def acceleration(self) -> FloatArray:
        """Second derivatives of x, y and the angle of the bodies: (n, k, 3)."""
        speeds, spins = self.bends
        return triples(speeds[:-1], spins[:-1])

    def of_body(self, name: str) -> tuple[FloatArray, FloatArray]:
        """Velocity and acceleration (n, 3) of a body; those of the ground are zero."""
        if name == GROUND:
            still = np.zeros((self.at.shape[-1], 3))
            return still, still
        k = self.bodies.index(name)
        return self.velocity[:, k], self.acceleration[:, k]

    def of_point(self, name: str, arm: FloatArray) -> FloatArray:
        """The velocity (n, 2) of a point of a body; arm: (n, 2), from its origin, in F."""
        k = self.number(name)
        return pairs_of(self.speeds[k] + 1j * self.spins[k] * complex_of(arm))

    def number(self, name: str) -> int:
        """The number of a body, or of the ground behind all."""
        return (*self.bodies, GROUND).index(name)

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
        tree = self.tree
        beyond = _summed(tree.path[:-1].T, complex_of(resisted).T)
        one, two = (cross(each, beyond) for each in self.limbs)
        work = tree.turned[tree.on].T @ one - two
        work += tree.turned[:-1].T @ (resisted[..., 2].T / tree.size)
        both = (work[tree.others][:, None] * self.inverse).sum(axis=0)
        closing = both[0::2] + 1j * both[1::2]
        return np.moveaxis(pairs_of(_summed(tree.pins, np.concatenate([beyond, closing]))), 0, 1)


def rates(bodies: Bodies, places: LinkPlaces) -> Rates:
    """The rates of a linkage with its bodies at places (n,), in the unit of its lengths."""
    tree = _tree(bodies)
    there = [places[name] for name in (*tree.names, GROUND)]
    at = complex_of(np.array([each.translation for each in there])) / tree.size
    turn = np.exp(1j * np.array([each.angle for each in there]))
    one = turn[tree.on] * (tree.base / tree.size)[:, None]
    own = np.where(tree.slides, tree.own, tree.own / tree.size)
    two = turn[tree.frames] * own[:, None]
    if tree.slides.any():
        one[tree.slides] = (at[tree.bodies] - at[tree.on])[tree.slides]
    arms = turn[tree.ends] * (tree.holes / tree.size)[..., None]
    (count, n), c = one.shape, arms.shape[1]
    each = _summed(tree.equations, np.concatenate([one, two, *arms])).reshape(c, count, n)
    matrix = np.stack([-each.imag, each.real], axis=1).reshape(2 * c, count, n)
    inverse, determinant = _inverse(matrix[:, tree.others])
    first = np.empty((count, n))
    first[tree.driver] = 1 + 0 * inverse[0, 0]  # nan where the others are
    first[tree.others] = -(inverse * matrix[:, tree.driver]).sum(axis=1)
    turns = not tree.slides[tree.driver]
    return Rates(tree, turns, at, turn, (one, two), arms, inverse, first, determinant)


def _summed(weights: FloatArray, vectors: ComplexArray) -> ComplexArray:
    """Sums (m, n) of vectors (k, n) by real weights (m, k)."""
    return (weights @ np.ascontiguousarray(vectors).view(np.float64)).view(np.complex128)


def cross(one: ComplexArray, other: ComplexArray) -> FloatArray:
    """The moments (*,) of vectors at arms (*,)."""
    return one.real * other.imag - one.imag * other.real


def triples(vectors: ComplexArray, turning: FloatArray) -> FloatArray:
    """Vectors and turning (k, n) as (n, k, 3)."""
    return np.stack([vectors.real.T, vectors.imag.T, turning.T], axis=-1)


def _pins(bodies: Bodies) -> list[tuple[int, float]]:
    """Of each joint its limb, or its closure behind all limbs; 1 if its first body holds the pin.

    Otherwise -1.
    """
    of = {
        id(limb.joint): (k, 1.0 if limb.body == limb.joint.holder else -1.0)
        for k, limb in enumerate(bodies.tree)
        if not limb.slides
    }
    for k, (joint, one, _) in enumerate(bodies.closures, start=len(bodies.tree)):
        of[id(joint)] = k, 1.0 if one == joint.holder else -1.0
    return [of[id(joint)] for joint in bodies.joints]


def _inverse(matrix: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The inverses of matrices (m, m, n), m = 2 or 4, and their determinants (n,).

    By minors, which takes a fifth of the time of LAPACK's; nan where they are nearly singular.
    """
    if len(matrix) == 2:
        (a, b), (c, d) = matrix
        adjugate = np.array([[d, -b], [-c, a]])
    else:
        lower, upper = (_complementary(*matrix[half]) for half in (slice(2, 4), slice(2)))
        sides = [(lower, 1), (lower, 0), (upper, 3), (upper, 2)]
        columns = [(minors * matrix[row]).sum(axis=1) for minors, row in sides]
        adjugate = np.stack([columns[0], -columns[1], columns[2], -columns[3]], axis=1)
    determinant = (matrix[0] * adjugate[:, 0]).sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = adjugate / determinant
        condition = np.prod([np.abs(e).sum(axis=1).max(axis=0) for e in (matrix, inverse)], axis=0)
    inverse[:, :, ~(condition < LOCKED)] = np.nan
    return inverse, determinant


def _complementary(one: FloatArray, other: FloatArray) -> FloatArray:
    """Of two rows (4, n) the minors (4, 4, n) of the columns that are not i and j."""
    minors = one[:, None] * other - other[:, None] * one
    return np.asarray(minors[THIRD, FOURTH])
