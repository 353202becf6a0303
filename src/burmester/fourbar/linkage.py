"""A linkage of two dyads: its links, its type, and the places of its coupler.

The coupler moves where both constraint manifolds meet.  At a given coupler angle each of
them is a circle (or a line) in the (Z1, Z2) plane, so the coupler's places are where two
circles meet: one formula for every pair of RR, PR and RP.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

PARALLEL = 1e-9  # relative; lines whose cross product is smaller are parallel within rounding
GRASHOF_TIE = 1e-9  # of all links together; a sum as small is zero but for rounding

# Two of the four links less the other two.  The signs of these sums tell Grashof's type: Murray and
# Larochelle, A classification scheme for planar 4R, spherical 4R and spatial RCCC linkages, 1998.
GRASHOF_SUMS = np.array(  # by ground, driver, coupler, follower
    [[1.0, -1.0, 1.0, -1.0], [1.0, -1.0, -1.0, 1.0], [-1.0, -1.0, 1.0, 1.0]]
)
TYPE_OF_SIGNS: Mapping[tuple[int, ...], str] = {
    (1, 1, 1): "crank-rocker",
    (1, -1, -1): "rocker-crank",
    (-1, -1, 1): "double-crank",
    (-1, 1, -1): "double-rocker",
    (-1, -1, -1): "triple-rocker",
    (-1, 1, 1): "triple-rocker",
    (1, -1, 1): "triple-rocker",
    (1, 1, -1): "triple-rocker",
}

_TYPES = {
    frozenset({RR, PR}): "slider-crank",
    frozenset({RR, RP}): "inverted slider-crank",
    frozenset({PR}): "double slider",
    frozenset({RP}): "Oldham linkage",
    frozenset({PR, RP}): "Rapson slide",
}
TRANSLATING, CHANGE_POINT = "translating linkage", "change-point"
# The names of all types, each once.
TYPES = tuple(dict.fromkeys([*TYPE_OF_SIGNS.values(), CHANGE_POINT, *_TYPES.values(), TRANSLATING]))


class Links(NamedTuple):
    """The four link lengths of a 4R linkage, (*,) each, in the task's unit."""

    ground: FloatArray
    driver: FloatArray
    coupler: FloatArray
    follower: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class Linkage:
    """A four-bar linkage: two dyads that join one coupler to the ground.

    Attributes
    ----------
    first, second : Dyad
        RR, PR, RP or PP, with the same leading axes; where one drives, the first.

    Examples
    --------
    >>> from burmester import RR
    >>> linkage = Linkage(RR([0, 0], [0, 0], 1), RR([4, 0], [3, 0], 3))
    >>> linkage.type
    'crank-rocker'
    >>> float(linkage.links.coupler)
    3.0
    """

    first: Dyad
    second: Dyad

    @property
    def links(self) -> Links | None:
        """The link lengths of a 4R linkage; None where a dyad is a slider."""
        a, b = self.first, self.second
        if not (isinstance(a, RR) and isinstance(b, RR)):
            return None
        ground = np.linalg.norm(b.fixed_pivot - a.fixed_pivot, axis=-1)
        coupler = np.linalg.norm(b.moving_pivot - a.moving_pivot, axis=-1)
        return Links(ground, a.radius, coupler, b.radius)

    @property
    def type(self) -> str:
        """The type in words: Grashof's for 4R, else the name of the slider linkage."""
        if (links := self.links) is not None:
            return grashof(links)
        pair = frozenset({type(self.first), type(self.second)})
        return _TYPES.get(pair, TRANSLATING)

    def couplers(self, angle: FloatArray) -> Displacement:
        """The two coupler places at each coupler angle.

        The two places exchange roles where they meet.  Not for PP dyads, nor for a coupler that
        only translates.

        Formula `coupler-places` of the theory.

        Parameters
        ----------
        angle : (*,) array of float
            In radians.

        Returns
        -------
        Displacement
            (*, 2); nan where the linkage cannot be assembled at that angle.
        """
        angle = np.asarray(angle, dtype=np.float64)
        s, c = np.sin(angle / 2), np.cos(angle / 2)
        p, q = self.first.coefficients(), self.second.coefficients()
        if abs(q[0]) > abs(p[0]):
            p, q = q, p
        (bp, ep), (bq, eq) = _slice(p, s, c), _slice(q, s, c)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            if p[0] == 0:  # two sliders: two lines
                cross = bp[0] * bq[1] - bp[1] * bq[0]
                least = PARALLEL * np.hypot(*bp) * np.hypot(*bq)
                cross = np.where(np.abs(cross) < least, np.nan, cross)
                z1 = (bp[1] * eq - bq[1] * ep) / cross
                z2 = (bq[0] * ep - bp[0] * eq) / cross
                z = np.stack([[z1, z2], np.full((2, *angle.shape), np.nan)], axis=-1)
            else:
                centre = -bp / (2 * p[0])
                squared = (centre * centre).sum(axis=0) - ep / p[0]
                normal = bq - q[0] / p[0] * bp  # of the line through both common points
                size = np.hypot(*normal)
                size = np.where(size < PARALLEL * np.hypot(*bq), np.nan, size)
                normal = normal / size
                away = (normal * centre).sum(axis=0) + (eq - q[0] / p[0] * ep) / size
                half = np.sqrt(squared - away * away)
                foot, along = centre - away * normal, np.stack([-normal[1], normal[0]])
                z = np.stack([foot - half * along, foot + half * along], axis=-1)
        z = np.where(np.isfinite(z).all(axis=0), z, np.nan)
        points = np.stack(np.broadcast_arrays(z[0], z[1], s[..., None], c[..., None]), axis=-1)
        return Displacement(Displacement.from_image_point(points).translation, angle[..., None])


def grashof(links: Links) -> str:
    """The type of one 4R linkage from its link lengths (Grashof's rule).

    By the signs of `GRASHOF_SUMS`; one of them is s + l - p - q but for its sign.  A sum within
    GRASHOF_TIE of zero is a change point.

    Formula `grashof` of the theory.
    """
    return TYPES[int(grashof_numbers(links))]


def grashof_numbers(links: Links) -> NDArray[np.int8]:
    """The same types of 4R linkages (*,), as numbers in `TYPES`."""
    lengths = np.stack(np.broadcast_arrays(*links), axis=-1)
    sums = (GRASHOF_SUMS * lengths[..., None, :]).sum(axis=-1)
    change = np.abs(sums).min(axis=-1) <= GRASHOF_TIE * lengths.sum(axis=-1)
    number = ((np.sign(sums) > 0) * np.array([4, 2, 1])).sum(axis=-1)
    return np.where(change, TYPES.index(CHANGE_POINT), _NUMBER_OF_SIGNS[number]).astype(np.int8)


# The type by the signs of the three sums, those above zero as the bits of a number.
_NUMBER_OF_SIGNS = np.array(
    [
        TYPES.index(TYPE_OF_SIGNS[tuple(1 if number & bit else -1 for bit in (4, 2, 1))])
        for number in range(8)
    ]
)


def _slice(p: FloatArray, s: FloatArray, c: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The circle p1 |z|² + b · z + e = 0 of a manifold p (8,) at a half angle: b (2, *), e (*,)."""
    b = np.stack([p[2] * s + p[4] * c, p[3] * s + p[5] * c])
    return b, p[1] * s * s + p[6] * s * c + p[7] * c * c
