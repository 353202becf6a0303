"""Four-bar linkages driven by a crank, in closed form: the coupler point and its derivatives.

In complex numbers, with the crank at the angle t and s = +-1 for the assembly:
A = G1 + a e^{it} is the crank's pin, D = G2 - A,
T = D/|D| (cos w + i s sin w), cos w = (b² + |D|² - r²) / (2 b |D|), turns the coupler as it is,
B = A + b T is the follower's pin, and p = A + c T the coupler point.  Where the dimensions and t
change, |B - G2| = r keeps its derivative, with the unit vector e = (B - G2)/r:
dp = dA + T dc - k (e . (dA + T db - dG2) - dr),  k = i T c / (b e . iT).
The assembly is one number of the linkage, so that no point of its path is on another branch.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.local_minima import best_dyads
from burmester.fourbar.cognates import cognates
from burmester.fourbar.dyad import RR
from burmester.fourbar.instantaneous import crossing_angle
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, Indexed, complex_of, dot, pairs_of

SIZE = 9  # dimensions of a crank-driven linkage and its coupler point
G1, G2 = slice(0, 2), slice(2, 4)  # the fixed pivots, the crank's first
A, B, R = 4, 5, 6  # the lengths of crank, coupler (between its pins) and follower
C = slice(
    7, 9
)  # the coupler point, seen from the crank's pin, the coupler's other pin on the x axis


MAX_DYADS = 12  # the best of the poses of more points; each pair of them is two start values
LONGEST = 50.0  # radii of gyration; dyads with longer links are none to start from


class CrankPlaces(NamedTuple):
    """Coupler places of linkages (k,) at crank angles (k, n); nan where they do not assemble.

    point: p, in F; turn: T, the coupler's direction as a unit number; velocity: dp/dt.
    """

    point: ComplexArray
    turn: ComplexArray
    velocity: ComplexArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class CrankLinkages(Indexed):
    """Linkages (k,) of two RR dyads, the first a crank, with their coupler points.

    dimensions: (k, 9), the fixed pivots G1 and G2, the lengths a, b, r, and the coupler point c.
    assembly: (k,), 1 or -1: the side of the line from the crank's pin to G2 on which B is.
    """

    dimensions: FloatArray
    assembly: FloatArray

    @classmethod
    def of(cls, batch: LinkageBatch, rows: FloatArray) -> tuple[Self, FloatArray]:
        """Pairs of RR dyads (k,), the crank first, and their crank angles (k, n), unwrapped.

        The coupler point is the origin of M.  rows: (k, n, 3), places of the body (x, y, angle), of
        which most say the assembly.
        """
        z, pins = batch.dimensions, complex_of(batch.dimensions[:, :, 2:4])
        arm = pins[:, 1] - pins[:, 0]
        length = np.abs(arm)
        point = -pins[:, 0] * np.conj(arm) / length
        parts = [z[:, 0, :2], z[:, 1, :2], z[:, 0, 4:], length[:, None], z[:, 1, 4:]]
        turn = np.exp(1j * rows[..., 2]) * (arm / length)[:, None]
        pin = complex_of(rows[..., :2]) - point[:, None] * turn
        across = (np.conj(complex_of(z[:, 1, :2])[:, None] - pin) * turn).imag
        sides = np.where(np.sign(across).sum(axis=-1) < 0, -1.0, 1.0)
        t = np.unwrap(np.angle(pin - complex_of(z[:, 0, :2])[:, None]), axis=-1)
        return cls(np.concatenate([*parts, pairs_of(point)], axis=1), sides), t

    def __len__(self) -> int:
        return len(self.assembly)

    def at(self, t: FloatArray) -> CrankPlaces:
        """The places at crank angles t (k, n), in radians."""
        g1, g2, a, b, r, c = self._parts()
        with np.errstate(all="ignore"):
            crank = np.exp(1j * t)
            pin = g1 + a * crank
            to = g2 - pin
            squared = to.real**2 + to.imag**2
            size = np.sqrt(squared)
            cosine = (b * b + squared - r * r) / (2 * b * size)
            sine = self.assembly[:, None] * np.sqrt(1 - cosine * cosine)
            turn = to * (cosine + 1j * sine) / size
            pull = (b * turn - to) / r
            gain = 1j * turn * (c / (b * dot(pull, 1j * turn)))
            velocity = 1j * a * crank
            velocity = velocity - gain * dot(pull, velocity)
        return CrankPlaces(pin + c * turn, turn, velocity)

    def moved(self, factor: ComplexArray, shift: ComplexArray) -> CrankLinkages:
        """Turned and stretched by numbers (k,), then shifted by numbers (k,), all in F."""
        out, size = self.dimensions * np.abs(factor)[:, None], factor
        for at in (G1, G2):
            out[:, at] = pairs_of(complex_of(self.dimensions[:, at]) * size + shift)
        return CrankLinkages(out, self.assembly)

    def mirrored(self) -> CrankLinkages:
        """The mirror images at the x axis; their cranks are at the negative angles."""
        signs = np.array([1, -1, 1, -1, 1, 1, 1, 1, -1.0])
        return CrankLinkages(self.dimensions * signs, -self.assembly)

    def turns_fully(self, margin: float = 0.0) -> NDArray[np.bool_]:
        """Which cranks (k,) go all the way round, by a margin of that much of all lengths."""
        return np.asarray(self.fullness().min(axis=-1) >= margin)

    def fullness(self) -> FloatArray:
        """Three sums of the lengths (k, 3) over their total; above 0 where the crank goes round.

        The pin of the crank is from |g - a| to g + a away from G2, and coupler and follower reach
        from |b - r| to b + r.
        """
        g, a, b, r = self.lengths()
        near = np.abs(g - a)
        sums = np.stack([b + r - g - a, near - b + r, near + b - r], axis=-1)
        return np.asarray(sums / (g + a + b + r)[:, None])

    def least_transmission(self, t: FloatArray | None = None) -> FloatArray:
        """The least transmission angles (k,) at crank angles t (k, n), or over a whole turn.

        Between coupler and follower, in radians, at most a right angle; nan where it does not come.
        """
        g, a, b, r = self.lengths()
        if t is None:
            away = np.stack([g - a, g + a], axis=-1)
        else:
            pin = complex_of(self.dimensions[:, G1])[:, None] + a[:, None] * np.exp(1j * t)
            away = np.abs(complex_of(self.dimensions[:, G2])[:, None] - pin)
        return np.asarray(crossing_angle(b[:, None], r[:, None], away).min(axis=-1))

    def lengths(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Ground, crank, coupler and follower (k,) each."""
        g = np.linalg.norm(self.dimensions[:, G2] - self.dimensions[:, G1], axis=-1)
        return g, *(self.dimensions[:, at] for at in (A, B, R))

    def batch(self) -> LinkageBatch:
        """As pairs of dyads, the crank first; the body frame M has its origin at the coupler point.

        Its angle is the direction of the coupler from the crank's pin to the other.
        """
        z = np.zeros((len(self), 2, 5))
        z[:, 0, :2], z[:, 1, :2] = self.dimensions[:, G1], self.dimensions[:, G2]
        z[:, :, 2:4] = -self.dimensions[:, None, C]
        z[:, 1, 2] += self.dimensions[:, B]
        z[:, 0, 4], z[:, 1, 4] = self.dimensions[:, A], self.dimensions[:, R]
        return LinkageBatch(np.zeros((len(self), 2), dtype=np.int8), z)

    def rows(self, t: FloatArray) -> FloatArray:
        """The places (k, n, 3) of that body at crank angles t (k, n): x, y, angle.

        Angles go on from place to place by less than half a turn.
        """
        places = self.at(t)
        angle = np.unwrap(np.angle(places.turn), axis=-1)
        return np.concatenate([pairs_of(places.point), angle[..., None]], axis=-1)

    def _parts(self) -> tuple[Any, ...]:
        z = self.dimensions[:, :, None]
        lengths = (z[:, at] for at in (A, B, R))
        return z[:, 0] + 1j * z[:, 1], z[:, 2] + 1j * z[:, 3], *lengths, z[:, 7] + 1j * z[:, 8]


def linkages_of_five_points(
    points: FloatArray, crank_angles: FloatArray
) -> tuple[LinkageBatch, FloatArray]:
    """All linkages (k,) that trace five points (5, 2) at five crank angles (5,), in radians.

    Their first dyad is the crank, and it turns from point to point as the angles do; the coupler
    point is the origin of M.  Returns them with their places (k, 5, 3): x, y, angle.  They may need
    another branch, or meet the points in another order: nothing here judges them.

    Raises
    ------
    InputError
        E121 (other than five points), E103 (a number that is not finite).
    """
    places = Displacement(np.asarray(points, dtype=np.float64), np.asarray(crank_angles))
    found = dyads_of_five(places)
    return _with_cranks(found.dyads, places)


def timed_starts(points: ComplexArray, timing: FloatArray) -> tuple[CrankLinkages, FloatArray]:
    """Linkages (k,) near five or more timed points (n,) about 1 in size; crank angles (k, n)."""
    places = Displacement(pairs_of(points), timing)
    circles = best_dyads(places).dyads
    near = np.flatnonzero(circles.radius < LONGEST)[:MAX_DYADS]
    batch, rows = _with_cranks(circles[near], places)
    return CrankLinkages.of(batch, rows)


def _with_cranks(dyads: RR, poses: Displacement) -> tuple[LinkageBatch, FloatArray]:
    """The cognates of all pairs of dyads (k,) that have a crank at the first one's fixed pivot."""
    number = len(dyads.radius)
    one, two = np.nonzero(~np.eye(number, dtype=bool))
    (found, *_) = cognates(Linkage(dyads[one], dyads[two]))
    batch = LinkageBatch.of_pins(found)
    # The body of a cognate turns as the link of the dyad, and its angle is that link's direction.
    link = complex_of(poses.act(dyads[one].moving_pivot[:, None, :]))
    angle = np.unwrap(np.angle(link - complex_of(dyads[one].fixed_pivot)[:, None]), axis=-1)
    origin = np.broadcast_to(poses.translation, (*angle.shape, 2))
    rows = np.concatenate([origin, angle[..., None]], axis=-1)
    z = batch.dimensions
    sound = np.isfinite(z).all(axis=(1, 2)) & (z[:, :, 4] > 0).all(axis=1)
    return batch[sound], rows[sound]
