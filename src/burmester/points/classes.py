"""Which solutions of an Alt-Burmester problem are the same linkages, and which are cognates.

The two dyads of a linkage have no order, unless a pivot is given.  Through points alone (and no
pivots) linkages come in classes of three, Roberts' cognates, which trace one curve: one of each
class is followed.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray
from burmester.points.alt_burmester import Positions

CLASS: Final = 3  # cognates of one curve

SAME: Final = 1e-6  # relative; solutions whose keys differ by less are one
# Any numbers without a pattern: keys are ordered by their sum with these factors.
FACTORS: Final = np.exp(1j * np.arange(1, 9) ** 2)


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
