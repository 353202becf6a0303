"""Pivots to start from, beside the critical points: dyads of fits that need no start themselves.

Where the body turns little, the critical points of the squared residual are hard to tell apart in
doubles, and some are lost.  The exact dyads of such a task are also dyads of the pencil, and pass
through any five of its poses; with noise they are near.
"""

from __future__ import annotations

import numpy as np

from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.pencil import MIN_POSES, fit_pencil
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.tasks.repeated_poses import spanning

__all__ = ["pivots_of_fits"]

QUINTUPLES = 3  # of poses, at most; more found nothing new in a campaign


def pivots_of_fits(poses: Displacement, weights: FloatArray | None) -> FloatArray:
    """Pivots (k, 4), c and m, of the pencil's dyads and of those through five of the poses (N,).

    The first five poses are those that span the most, the next five span the most of the rest.
    """
    found = []
    if poses.shape[0] >= MIN_POSES:
        found.append(fit_pencil(poses, weights).dyads)
    _, seen = CanonicalFrames.of(poses, weights)
    design = constraint_manifold.monomials(seen.as_image_point()) * constraint_manifold.INVARIANT
    rest = np.arange(poses.shape[0])
    for _ in range(min(QUINTUPLES, len(rest) // 5)):
        five = spanning(design[rest], 5)
        found.append(dyads_of_five(poses[rest[five]]).dyads)
        rest = np.delete(rest, five)
    pivots = np.concatenate([_pivots(dyads) for dyads in found])
    return np.asarray(pivots[np.isfinite(pivots).all(axis=-1)])


def _pivots(dyads: RR) -> FloatArray:
    return np.concatenate([dyads.fixed_pivot, dyads.moving_pivot], axis=-1)
