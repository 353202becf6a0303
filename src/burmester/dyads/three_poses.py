"""Three poses: the dyad of a given pivot."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from burmester.dyads.five_poses import _require
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement

__all__ = ["dyad_with_fixed_pivot", "dyad_with_moving_pivot"]


def dyad_with_moving_pivot(poses: Displacement, moving_pivot: ArrayLike) -> RR:
    """Three poses (3,): the one RR dyad with each moving pivot (*, 2) of M.

    The fixed pivot is the centre of the circle through the three places of the moving pivot;
    it is infinite where they lie on a line, and the dyad a slider.
    Raises InputError E121 (another number of poses) and E103.
    """
    _require(poses, 3)
    m = np.asarray(moving_pivot, dtype=np.float64)
    a, b, c = (poses[i].act(m) for i in range(3))
    u, v = b - a, c - a
    cross = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    uu, vv = (u * u).sum(axis=-1), (v * v).sum(axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        x = (uu * v[..., 1] - vv * u[..., 1]) / (2 * cross)
        y = (vv * u[..., 0] - uu * v[..., 0]) / (2 * cross)
    return RR(a + np.stack([x, y], axis=-1), m, np.hypot(x, y))


def dyad_with_fixed_pivot(poses: Displacement, fixed_pivot: ArrayLike) -> RR:
    """Three poses (3,): the one RR dyad with each fixed pivot (*, 2) of F.

    The inverse motion exchanges fixed and moving pivots.
    Raises InputError E121 (another number of poses) and E103.
    """
    dyad = dyad_with_moving_pivot(poses.inverse(), fixed_pivot)
    return RR(dyad.moving_pivot, dyad.fixed_pivot, dyad.radius)
