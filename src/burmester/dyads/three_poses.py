"""Three poses: the dyad of a given pivot."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from burmester.dyads.five_poses import require_count
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement


def dyad_with_moving_pivot(poses: Displacement, moving_pivot: ArrayLike) -> RR:
    """The one RR dyad of three poses with each moving pivot.

    The fixed pivot is the centre of the circle through the three places of the moving pivot;
    it is infinite where they lie on a line, and the dyad a slider.

    Formula `three-poses` of the theory.

    Parameters
    ----------
    poses : Displacement, (3,)
        Three poses.
    moving_pivot : array_like, (*, 2)
        Points of M.

    Returns
    -------
    RR
        The dyads (*,).

    Raises
    ------
    InputError
        E121 (another number of poses), E103 (a number that is not finite).

    Examples
    --------
    >>> poses = Displacement.from_poses([[1, 0, 0], [0, 1, 0.3], [-1, 0, 0.9]])
    >>> dyad = dyad_with_moving_pivot(poses, [0, 0])  # on the unit circle
    >>> dyad.fixed_pivot, float(dyad.radius)
    (array([0., 0.]), 1.0)
    """
    require_count(poses, 3)
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
    """The one RR dyad of three poses with each fixed pivot.

    The inverse motion exchanges fixed and moving pivots: all else is as of
    `dyad_with_moving_pivot`, with points of F for those of M.

    Formula `three-poses` of the theory.

    Examples
    --------
    >>> poses = Displacement.from_poses([[1, 0, 0], [0, 1, 0.3], [-1, 0, 0.9]])
    >>> dyad = dyad_with_fixed_pivot(poses, [0, 0])
    >>> bool(np.abs(dyad.moving_pivot).max() < 1e-12), float(dyad.radius.round(6))
    (True, 1.0)
    """
    dyad = dyad_with_moving_pivot(poses.inverse(), fixed_pivot)
    return RR(dyad.moving_pivot, dyad.fixed_pivot, dyad.radius)
