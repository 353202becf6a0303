"""The real linkages among all that meet an Alt-Burmester problem, with cognates, as four-bars."""

from __future__ import annotations

from typing import Final, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.points.alt_burmester import Positions, point_turns
from burmester.points.classes import cognates
from burmester.points.complete_solve import AllLinkages, all_linkages
from burmester.points.path_tracking import polished

REAL: Final = 1e-6  # relative; a linkage that is its own conjugate up to this is real
MET: Final = 1e-7  # relative; a real linkage is kept if its Newton steps end below this
SIZE: Final = 1.2  # root mean square distance of positions from the base: that of solved problems
LEAST_LINK: Final = 1e-9  # of that size; a shorter link is none


@final
class PointLinkages(NamedTuple):
    """The four-bars (k,) that meet poses and points.

    batch: of pins, in the frames of the task; places: (k, N, 3), x, y and angle at all positions.
    classes, followed, found, lost: of the solve, complex linkages too; systems: of the solve.
    real: how many classes have a real linkage.
    family: whether infinitely many linkages, complex ones too, are left beside them.
    """

    batch: LinkageBatch
    places: FloatArray
    classes: int
    followed: int
    found: int
    real: int
    systems: int
    family: bool

    @property
    def lost(self) -> int:
        """How many were followed and not found: lost, or not there, in special positions."""
        return max(0, self.followed - self.found)


def linkages_through(
    poses: Displacement, is_point: NDArray[np.bool_], pivots: FloatArray | None = None
) -> PointLinkages:
    """All four-bars through positions (N,) of the body's origin, with the angle or without.

    is_point: (N,), where the angle is free; all of nine, or 2 (M - 1) + points = 8 for M poses.
    pivots: (k, 2), fixed pivots that are given; each is two conditions.  Points alone have no angle
    to begin with: at the first one it is 0.
    """
    base = int(np.argmin(is_point))  # the first pose, or the first point
    others = np.flatnonzero(np.arange(len(is_point)) != base)
    order = np.concatenate([others[~is_point[others]], others[is_point[others]]])
    d = complex_of(poses.translation)
    turn = 1.0 if is_point[base] else np.exp(1j * poses.angle[base])
    away = (d[order] - d[base]) / turn
    unit = float(np.sqrt((np.abs(away) ** 2).mean())) / SIZE or 1.0
    fixed = complex_of(np.reshape(() if pivots is None else pivots, (-1, 2)))
    P, G = away[None] / unit, (fixed - d[base])[None] / turn / unit
    posed = order[~is_point[order]]
    T = np.exp(1j * poses.angle[posed])[None] / turn
    positions = Positions(P, P.conj(), T, G, G.conj())
    every = all_linkages(positions)
    x, turns, real = _real(every, positions)
    u, z = x[:, [0, 4]], x[:, [2, 6]]
    G, z = d[base] + turn * unit * (u + z), unit * z
    rows = np.zeros((len(x), 2, DIMENSIONS))
    rows[..., 0], rows[..., 1], rows[..., 2], rows[..., 3] = G.real, G.imag, z.real, z.imag
    rows[..., 4] = unit * np.abs(u)
    places = np.empty((len(x), len(is_point), 3))
    places[..., :2] = poses.translation
    places[:, base, 2] = np.angle(turn)
    places[:, order, 2] = np.angle(turns * turn)
    places[..., 2] = np.where(is_point, places[..., 2], poses.angle)
    batch = LinkageBatch(np.zeros((len(x), 2), dtype=np.int8), rows)
    return PointLinkages(
        batch,
        places,
        every.classes,
        every.followed,
        len(every.x),
        real,
        every.systems,
        every.family,
    )


def _real(every: AllLinkages, positions: Positions) -> tuple[ComplexArray, ComplexArray, int]:
    """Real linkages (k, 8) with their turns, cognates too, and how many classes they are of."""
    with np.errstate(all="ignore"):
        x = cognates(every.x) if positions.has_cognates else every.x[:, None]
    own, _ = np.indices(x.shape[:2]).reshape(2, -1)
    x = x.reshape(-1, x.shape[-1])
    size = 1 + np.abs(x).max(axis=1)
    gap = np.abs(x[:, 1::2] - x[:, ::2].conj()).max(axis=1)
    index = np.flatnonzero(gap < REAL * size)
    x, own = x[index], own[index]
    x[:, ::2] = (x[:, ::2] + x[:, 1::2].conj()) / 2
    x[:, 1::2] = x[:, ::2].conj()
    x, turns, miss = polished(x, point_turns(x, positions), positions)
    links = np.abs(x[:, [0, 4]]).min(axis=1)
    coupler = np.abs(x[:, 2] - x[:, 6])
    unit = np.abs(np.abs(turns) - 1).max(axis=1) if turns.shape[1] else np.zeros(len(x))
    sound = (miss < MET) & (unit < REAL) & (np.minimum(links, coupler) > LEAST_LINK)
    return x[sound], turns[sound], len(np.unique(own[sound]))
