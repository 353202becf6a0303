"""Long links: how far they swing, and which of them are nearly sliders.

A link whose far pivot is fixed in F swings little in F; one whose far pivot is in M swings little
against M.  In the limit the other pivot is on a line: a slider.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.tasks.repeated_poses import orientation_arcs

SENSIBLE_SWING = 0.1  # radians; a link that swings more is a link; arcs bend by 1 % of their chords
OUT_OF_SIGHT = 10.0  # sizes of the picture; no picture shows both ends of a longer link


def swing(dyad: RR, poses: Displacement) -> float:
    """The angle, radians, by which one RR dyad's link turns over poses (N,).

    Against F or against M, where it turns less.  An endless link does not turn.
    """
    return float(swings(dyad, poses))


def swings(dyads: RR, poses: Displacement) -> FloatArray:
    """The same of RR dyads (*,), each with its poses (*, N)."""
    with np.errstate(invalid="ignore"):
        arm = poses.act(dyads.moving_pivot[..., None, :]) - dyads.fixed_pivot[..., None, :]
        direction = np.arctan2(arm[..., 1], arm[..., 0])
        _, in_f = orientation_arcs(direction)
        _, in_m = orientation_arcs(direction - poses.angle)
    return np.where(np.isfinite(dyads.radius), np.minimum(in_f, in_m), 0.0)


def nearly_sliders(dyads: RR, poses: Displacement, size: float | FloatArray) -> NDArray[np.bool_]:
    """Which links (*,) are out of sight and hardly swing; size: (*,), what a picture shows."""
    return (dyads.radius > OUT_OF_SIGHT * size) & (swings(dyads, poses) < SENSIBLE_SWING)
