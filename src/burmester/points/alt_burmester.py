"""The equations of Alt-Burmester problems: poses and points of the body that a four-bar meets.

All in isotropic coordinates: a point (x, y) is x + iy and its conjugate x - iy, two independent
numbers on the way from one problem to another.  Frames: one of the task's positions, the base, has
its point at 0 and angle 0; there F and M agree.  With z the moving pivot of a dyad and u = G - z
the link from it to the fixed pivot G, both at the base, a place (P, T = e^(i angle)) is met if

    f = v w - v ub - w u = 0,   v = P + (T - 1) z,   w = Pb + (1/T - 1) zb

(v: the way of the moving pivot from the base; |v - u| = |u|).  A pose gives T; a point leaves it
open.  `path_kernel` solves these equations and differentiates them.

Sources: Tong, Myszka, Murray 2013 (the problem); Brake et al. 2016 (its classes and their counts);
Wampler, Morgan, Sommese 1992 (nine points).
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray

UNKNOWNS: Final = 8  # u, ub, z, zb of two dyads


CLASS: Final = 3  # cognates of one curve

SAME: Final = 1e-6  # relative; solutions whose keys differ by less are one
# Any numbers without a pattern: keys are ordered by their sum with these factors.
FACTORS: Final = np.exp(1j * np.arange(1, 9) ** 2)


class Positions(NamedTuple):
    """The positions of one problem beside its base, or of many (leading axes), and given pivots.

    P, Pb: (*, J), the points, first those of the poses.
    T: (*, M - 1), the turns of the poses.
    G, Gb: (*, k), fixed pivots that are given, of the first k dyads; k is 0, 1 or 2.
    """

    P: ComplexArray
    Pb: ComplexArray
    T: ComplexArray
    G: ComplexArray
    Gb: ComplexArray

    @property
    def further_poses(self) -> int:
        """How many positions beside the base are poses: M - 1."""
        return int(self.T.shape[-1])

    @property
    def points(self) -> int:
        """How many positions beside the base are points."""
        return int(self.P.shape[-1] - self.further_poses)

    @property
    def pivots(self) -> int:
        """How many fixed pivots are given."""
        return int(self.G.shape[-1])

    @property
    def has_cognates(self) -> bool:
        """Whether solutions come in classes of three: only points are asked for."""
        return not (self.further_poses or self.pivots)


def point_turns(x: ComplexArray, positions: Positions) -> ComplexArray:
    """The turns (n, J) at all positions for dyads x (n, 8) that meet them.

    Times T an equation is a quadratic in T - 1; the root that both dyads share follows linearly.
    """
    u, ub, z, zb = np.moveaxis(x.reshape(-1, 2, 4), -1, 0)[..., None]
    m = positions.further_poses
    P, Pb = positions.P[..., None, m:], positions.Pb[..., None, m:]
    zero = P * Pb - P * ub - Pb * u
    turn, back = z * (Pb - ub), zb * (P - u)
    one, two = zero + turn - back, turn - z * zb
    with np.errstate(all="ignore"):
        g = -(two[:, 1] * zero[:, 0] - two[:, 0] * zero[:, 1]) / (
            two[:, 1] * one[:, 0] - two[:, 0] * one[:, 1]
        )
    given = np.broadcast_to(positions.T, (len(x), m))
    return np.concatenate([given, 1 + g], axis=1)


def cognates(x: ComplexArray) -> ComplexArray:
    """The three linkages (*, 3, 8) that trace one curve, the given ones (*, 8) first.

    The tracing point is the origin of M, at 0 at the base.  Roberts: G1, G2 and the third pivot
    G3 = (G1 z2 - G2 z1) / (z2 - z1) are a triangle similar to the coupler's.  The cognate at G1
    and G3 has the link z1 and the moving pivot u1 beside G1, and is similar beside G3.
    """
    u1, ub1, z1, zb1, u2, ub2, z2, zb2 = np.moveaxis(x, -1, 0)
    with np.errstate(all="ignore"):
        one, one_b = z1 / (z1 - z2), zb1 / (zb1 - zb2)
        two, two_b = z2 / (z2 - z1), zb2 / (zb2 - zb1)
    at_first = (z1, zb1, u1, ub1, u2 * one, ub2 * one_b, u1 * two, ub1 * two_b)
    at_second = (z2, zb2, u2, ub2, u1 * two, ub1 * two_b, u2 * one, ub2 * one_b)
    return np.stack([x, np.stack(at_first, -1), np.stack(at_second, -1)], axis=-2)


def distinct(x: ComplexArray, positions: Positions) -> NDArray[np.intp]:
    """Indices of solutions x (n, 8), the first one of each class, in their order."""
    keys = _keys(x, positions)
    keys = keys / (1 + np.abs(keys))  # so that a difference is relative
    order_by = (keys * FACTORS[: keys.shape[1]]).real.sum(axis=1)
    order = np.argsort(order_by, kind="stable")
    first = np.ones(len(x), dtype=bool)
    width = SAME * keys.shape[1]
    place = order_by[order]
    for shift in range(1, len(x)):
        near = np.flatnonzero(place[shift:] - place[:-shift] < width)
        if not len(near):
            break
        one, two = order[near], order[near + shift]
        same = np.abs(keys[one] - keys[two]).max(axis=1) < SAME
        first[np.maximum(one, two)[same]] = False
    return np.flatnonzero(first & np.isfinite(order_by))


def _keys(x: ComplexArray, positions: Positions) -> ComplexArray:
    """What the members of a class have in common, (n, 3 or more)."""
    if positions.pivots:
        return x
    G, Gb = x[:, [0, 4]] + x[:, [2, 6]], x[:, [1, 5]] + x[:, [3, 7]]
    if positions.has_cognates:
        z, zb = x[:, [2, 6]], x[:, [3, 7]]
        with np.errstate(all="ignore"):
            third = (G[:, 0] * z[:, 1] - G[:, 1] * z[:, 0]) / (z[:, 1] - z[:, 0])
            third_b = (Gb[:, 0] * zb[:, 1] - Gb[:, 1] * zb[:, 0]) / (zb[:, 1] - zb[:, 0])
        G, Gb = np.column_stack([G, third]), np.column_stack([Gb, third_b])
        pairs = G[:, 0] * G[:, 1] + (G[:, 0] + G[:, 1]) * G[:, 2]
        return np.column_stack([G.sum(axis=1), Gb.sum(axis=1), pairs])
    both = x[:, :4] + x[:, 4:]
    return np.column_stack([both, (x[:, :4] * x[:, 4:])[:, [0, 2]]])
