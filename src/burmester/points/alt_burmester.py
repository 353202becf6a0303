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

from burmester.numerics.arrays import ComplexArray

UNKNOWNS: Final = 8  # u, ub, z, zb of two dyads


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
