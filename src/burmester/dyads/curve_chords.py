"""Chords of Burmester's curve: the planes through two of its points, and what they meet.

In the projective three-space of manifolds through four poses the dyads are the curve in which
the two conditions of Eq. (17) meet.  Two points X and Y of it are a chord.  A plane through the
chord, spanned with g(u), u = (cos psi, sin psi), meets the curve in two more points
a X + b Y + g(u), where for both conditions

    alpha a b + beta(u) a + gamma(u) b + delta(u) = 0.

So a and b are roots of quadratic equations, with one discriminant D, a form of degree four in
u.  D has at most four real zeros, and between them the planes meet the curve in real points:
over each such interval the two roots make one closed loop.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Self, final

import numpy as np

from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.linear_algebra import unit_vectors

RANK_TOLERANCE = 1e-12  # share of the first singular value; one below it is zero
DOUBLE_ZERO = 1e-6  # radians of 2 psi; zeros of D nearer than this are one double zero
SAME_PLACE = 1e-7  # sizes of the motion; places nearer than this are the same


@final
@dataclass(frozen=True, slots=True, eq=False)
class Loop:
    """The planes and roots of one closed loop, as functions of s in [0, 2 pi].

    psi = middle - half cos s + rate s; the sign of the root is `side`, or where that is zero
    the sign of sin s.
    """

    middle: float
    half: float
    rate: float
    side: float

    def at(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The angle psi of the plane and the sign of the root, at parameters (n,)."""
        psi = self.middle - self.half * np.cos(s) + self.rate * s
        return psi, np.sign(np.sin(s)) if self.side == 0 else np.full_like(s, self.side)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Chord:
    """Two points of the curve, and the pencil of planes through them.

    rows: (4, 8), the manifolds X, Y, g(1, 0) and g(0, 1); conditions: (2, 4, 4), the quadratic
    forms of Eq. (17) in terms of them; zeros: those of D, as z = exp(2 i psi); simple, double:
    the real ones, psi ascending within a half turn; rest: D without its double zeros, a
    polynomial in z; soundness: how far every plane is from holding a whole piece of the curve.
    """

    rows: FloatArray
    conditions: FloatArray
    zeros: ComplexArray
    simple: FloatArray
    double: FloatArray
    rest: ComplexArray
    soundness: float

    @classmethod
    def of(cls, ends: FloatArray, quadrics: FloatArray, basis: FloatArray) -> Self | None:
        """The chord of two points (2, 4) of the null space, if it meets the curve only there."""
        rows = np.concatenate([ends, np.linalg.svd(ends)[2][2:]])
        conditions = rows @ quadrics @ rows.T
        # D has the frequencies 0, 2 and 4, so five values give it as z⁻² times a polynomial.
        psi = np.arange(5.0) * float(np.pi / 5)
        k0, k1, k2 = np.moveaxis(_quadratics(conditions, psi)[0], -1, 0)
        rest = np.exp(2j * np.outer(np.arange(-2, 3), psi)) @ (k1 * k1 - 4 * k0 * k2) / 5
        alpha = float(np.linalg.norm(conditions[:, 0, 1]))
        if min(alpha, np.abs(rest).max()) < SAME_PLACE:
            return None
        rest[np.abs(rest) < RANK_TOLERANCE * np.abs(rest).max()] = 0
        zeros = np.roots(rest).astype(complex)
        # Where a plane holds a piece of the curve a quadratic vanishes, and so D does twice.
        least = np.linalg.norm(
            _quadratics(conditions, np.asarray(np.angle(zeros) / 2, dtype=np.float64)), axis=-1
        )
        soundness = float(least.min(initial=alpha))
        simple, double = _real_zeros(zeros)
        for zero in np.exp(2j * double):  # 4 sin² = -(z - zero)² / (z zero)
            rest = -np.polydiv(rest, [1, -2 * zero, zero**2])[0] * zero
        return cls(rows @ basis, conditions, zeros, simple, double, rest, soundness)

    def loops(self) -> list[Loop]:
        """The closed loops; each point of the curve is on one of them, once."""
        starts = self.simple if self.simple.size else np.zeros(1)
        loops = []
        for start, end in zip(starts, np.append(starts[1:], starts[0] + np.pi), strict=True):
            if self.rest_at(np.linspace(start, end, 9)).sum() <= 0:
                continue
            if self.simple.size:
                loops.append(Loop((start + end) / 2, (end - start) / 2, 0.0, 0.0))
            elif self.double.size % 2:  # after half a turn the two roots have changed places
                loops.append(Loop(0.0, 0.0, 1.0, 1.0))
            else:
                loops += [Loop(0.0, 0.0, 0.5, side) for side in (1.0, -1.0)]
        return loops

    def rest_at(self, psi: FloatArray) -> FloatArray:
        """D without its double zeros, in planes (n,)."""
        z = np.exp(2j * psi)
        value: FloatArray = (np.polyval(self.rest, z) * z ** -(self.rest.size // 2)).real
        return value

    def manifolds(self, loop: Loop, s: FloatArray) -> FloatArray:
        """The unit manifolds (n, 8) at parameters (n,) of a loop."""
        psi, sign = loop.at(s)
        # At a double zero the curve crosses itself: there the root of D goes through zero.
        root = sign * np.sqrt(np.maximum(self.rest_at(psi), 0))
        root = root * (2 * np.sin(psi - self.double[:, None])).prod(axis=0)
        by_b, by_a = _quadratics(self.conditions, psi)
        (a0, a1), (b0, b1) = _solution(by_a, -root), _solution(by_b, root)
        u = np.stack([np.cos(psi), np.sin(psi)])
        return unit_vectors(np.stack([a0 * b1, b0 * a1, *(a1 * b1 * u)], axis=-1) @ self.rows)


def _quadratics(conditions: FloatArray, psi: FloatArray) -> FloatArray:
    """The quadratics (2, n, 3) for b and for a in planes (n,), the constant first."""
    u = np.stack([np.cos(psi), np.sin(psi)])
    alpha = 2 * conditions[:, 0, 1, None] * np.ones_like(psi)
    beta, gamma = 2 * conditions[:, 0, 2:] @ u, 2 * conditions[:, 1, 2:] @ u
    delta = np.einsum("kij,in,jn->kn", conditions[:, 2:, 2:], u, u)
    table = np.stack([alpha, beta, gamma, delta])
    ab, ac, ad, bc, bd, cd = (x[0] * y[1] - x[1] * y[0] for x, y in combinations(table, 2))
    return np.stack([np.stack([bd, ad + bc, ac], -1), np.stack([cd, ad - bc, ab], -1)])


def _solution(quadratic: FloatArray, root: FloatArray) -> FloatArray:
    """The homogeneous solution (2, n) of quadratics (n, 3) for a root of D."""
    k0, k1, k2 = np.moveaxis(quadratic, -1, 0)
    forms = np.stack([[root - k1, 2 * k2], [2 * k0, -root - k1]])
    size = np.linalg.norm(forms, axis=1)
    solution: FloatArray = np.where(size[0] > size[1], forms[0], forms[1]) / size.max(axis=0)
    return solution


def _real_zeros(zeros: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Of zeros exp(2 i psi) the real ones, simple and double: psi within a half turn."""
    angles = np.sort(np.angle(zeros[np.abs(np.abs(zeros) - 1) < DOUBLE_ZERO]))
    if angles.size:  # cut the circle where it cuts no pair
        angles = np.roll(angles, -int(((angles - np.roll(angles, 1)) % (2 * np.pi)).argmax()))
        angles = np.unwrap(angles)
    simple: list[float] = []
    double: list[float] = []
    while angles.size:
        multiplicity = 2 if angles.size > 1 and angles[1] - angles[0] < DOUBLE_ZERO else 1
        (double if multiplicity == 2 else simple).append(angles[:multiplicity].mean() / 2)
        angles = angles[multiplicity:]
    return np.array(simple), np.array(double)
