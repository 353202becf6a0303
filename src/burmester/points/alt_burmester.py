"""The equations of Alt-Burmester problems: poses and points of the body that a four-bar meets.

All in isotropic coordinates: a point (x, y) is x + iy and its conjugate x - iy, two independent
numbers on the way from one problem to another.  Frames: one of the task's positions, the base, has
its point at 0 and angle 0; there F and M agree.  With z the moving pivot of a dyad and u = G - z
the link from it to the fixed pivot G, both at the base, a place (P, T = e^(i angle)) is met if

    f = v w - v ub - w u = 0,   v = P + (T - 1) z,   w = Pb + (1/T - 1) zb

(v: the way of the moving pivot from the base; |v - u| = |u|).  A pose gives T; a point leaves it
open, and T is eliminated from each step: a pose is two equations, one a dyad, a point is one.

Sources: Tong, Myszka, Murray 2013 (the problem); Brake et al. 2016 (its classes and their counts);
Wampler, Morgan, Sommese 1992 (nine points).
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from burmester.numerics.arrays import ComplexArray

__all__ = ["UNKNOWNS", "Jet", "Positions", "System", "jet", "point_turns", "reduced", "system"]

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


class Jet(NamedTuple):
    """The equations of both dyads (axis 1) at all positions (axis 2), and parts of derivatives.

    f: (n, 2, J); v, w: (n, 2, J); fv, fw: (n, 2, J), the derivatives by v and w; g = T - 1 and
    c = 1/T - 1: (n, 1, J).
    """

    f: ComplexArray
    v: ComplexArray
    w: ComplexArray
    fv: ComplexArray
    fw: ComplexArray
    g: ComplexArray
    c: ComplexArray


class System(NamedTuple):
    """The linear system of a step.

    matrix: (n, 8, 8); rows: (n, 2, J, 4), the derivatives of the equations by the unknowns of their
    own dyad; by_turn: (n, 2, J), those by the turn.
    """

    matrix: ComplexArray
    rows: ComplexArray
    by_turn: ComplexArray


def jet(x: ComplexArray, turns: ComplexArray, positions: Positions) -> Jet:
    """The equations of dyads x (n, 8) at positions (n or 1 each) with turns (n, J) of all."""
    u, ub, z, zb = np.moveaxis(x.reshape(-1, 2, 4), -1, 0)[..., None]
    g = (turns - 1)[:, None]
    c = -g / turns[:, None]
    v = positions.P[:, None] + g * z
    w = positions.Pb[:, None] + c * zb
    fv, fw = w - ub, v - u
    return Jet(v * fv - w * u, v, w, fv, fw, g, c)


def system(x: ComplexArray, turns: ComplexArray, here: Jet, positions: Positions) -> System:
    """The system of a step of x; a point is one row, from which its turn is eliminated."""
    n, m = len(x), positions.further_poses
    z, zb = x[:, [2, 6]][..., None], x[:, [3, 7]][..., None]
    inverse = 1 / turns[:, None]
    by_turn = z * here.fv - zb * inverse * inverse * here.fw
    rows = np.stack([-here.w, -here.v, here.g * here.fv, here.c * here.fw], axis=-1)
    k, free = positions.pivots, positions.points
    matrix = np.zeros((n, UNKNOWNS, UNKNOWNS), dtype=complex)
    matrix[:, :m, :4] = rows[:, 0, :m]
    matrix[:, m : 2 * m, 4:] = rows[:, 1, :m]
    matrix[:, 2 * m : 2 * m + free, :4] = by_turn[:, 1, m:, None] * rows[:, 0, m:]
    matrix[:, 2 * m : 2 * m + free, 4:] = -by_turn[:, 0, m:, None] * rows[:, 1, m:]
    for dyad in range(k):  # u + z = G, and conjugates
        for conjugate in range(2):
            row = 2 * m + free + 2 * dyad + conjugate
            matrix[:, row, 4 * dyad + conjugate] = matrix[:, row, 4 * dyad + 2 + conjugate] = 1
    return System(matrix, rows, by_turn)


def reduced(right: ComplexArray, by_turn: ComplexArray, positions: Positions) -> ComplexArray:
    """Right sides (n, 2, J) of both dyads as those of the matrix, (n, 2 (M - 1) + N)."""
    m = positions.further_poses
    points = by_turn[:, 1, m:] * right[:, 0, m:] - by_turn[:, 0, m:] * right[:, 1, m:]
    return np.concatenate([right[:, 0, :m], right[:, 1, :m], points], axis=1)


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
