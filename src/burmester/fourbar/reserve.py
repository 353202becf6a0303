"""The reserve of the driver: how far it goes on beyond a range before the linkage locks."""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.fourbar.circuit_parameter import RangeType
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.pose_order import FULL_TURN
from burmester.numerics.arrays import FloatArray

__all__ = ["reserve"]

# Of f (see `loop_closure`): where a linkage at a change point has a bound this near to an end of
# the range of f, the change point is at that end.
CHANGE_POINT_BOUND: Final = 1e-6
AT_STOP: Final = (
    1e-3  # radians, or spans of the range; a range that ends this near to a stop is there
)


def reserve(circuits: Circuits, inputs: FloatArray) -> FloatArray:
    """How far drivers go on below and above a range (k, 2) of their input, (k, 2).

    Radians, or a length where the input slides.  To the next dead point on the branch or, of a
    linkage at a change point, to the next place where its branches cross; where a slot turns
    along a rail, to where the coupler would be at infinity.  Infinite where nothing stops the
    driver: where it turns fully, or slides without end.  0 where the range ends at a stop, nan
    where there is no circuit.

    circuits: (k,), as given (see `Circuits.of`).
    """
    least, greatest = np.moveaxis(circuits.input_range, -1, 0)
    free = circuits.range_type == RangeType.WHOLE
    low, high = np.where(free, -np.inf, least), np.where(free, np.inf, greatest)
    out = np.stack([inputs[:, 0] - low, high - inputs[:, 1]], axis=-1)
    for stop in _crossings(circuits):
        beyond = np.stack([inputs[:, 0] - stop, stop - inputs[:, 1]], axis=-1)
        turned = np.mod(beyond + AT_STOP, FULL_TURN) - AT_STOP
        behind = beyond < -AT_STOP * np.ptp(inputs, axis=1)[:, None]
        slid = np.where(behind, np.inf, beyond)
        beyond = np.where(circuits.turns[:, None], turned, slid)
        out = np.fmin(out, np.where(np.isnan(beyond), np.inf, beyond))
    return np.where(np.isnan(low)[:, None], np.nan, np.maximum(out, 0.0))


def _crossings(circuits: Circuits) -> list[FloatArray]:
    """Inputs (k,) at which linkages at a change point have all links in line; nan for others."""
    loop, change = circuits.loop, circuits.near_change_point & circuits.exists
    if not change.any():
        return []
    below = change & (np.abs(loop.low.down) <= CHANGE_POINT_BOUND * loop.low.scale)
    above = change & (np.abs(loop.high.up) <= CHANGE_POINT_BOUND * loop.high.scale) & loop.turns
    return [
        np.where(above & (loop.high.scale > 0), loop.centre, np.nan),
        np.where(below & (loop.low.scale > 0), loop.centre + np.pi * loop.turns, np.nan),
    ]
