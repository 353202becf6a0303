"""The order in which a linkage meets its poses, along an interval or round a closed circuit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle

# Radians, or fractions of the linkage's size.  A smaller step back along the circuit is an order
# defect that is not certain.
CERTAIN_STEP_BACK: Final = 1e-5
# The same unit.  Poses nearer to each other than this along the circuit are one pose, repeated.
REPEATED_POSE_STEP: Final = 1e-7
FULL_TURN: Final = 2 * np.pi  # radians

BoolArray: TypeAlias = NDArray[np.bool_]


class PoseOrder(NamedTuple):
    """The order of poses (k, N) along the circuits of linkages (k,).

    along: (k, N), their parameters, unwrapped.
    back: (k,), the longest step back, in radians or fractions of the linkage's size.
    slack: (k,), the same unit: a step back within it is explained by the poses' misses.
    """

    along: FloatArray
    back: FloatArray
    slack: FloatArray

    @property
    def is_another(self) -> BoolArray:
        """Whether it is another order than that of the poses, (k,)."""
        return np.asarray(self.back > np.maximum(REPEATED_POSE_STEP, self.slack))


@final
@dataclass(frozen=True, slots=True, eq=False)
class OrderTolerance:
    """Poses nearer to each other than `distance` (k,) have no order.

    length: the length that a radian counts as in a distance.
    """

    distance: FloatArray
    length: float


def step_back(x: FloatArray) -> FloatArray:
    """The greatest fall (k,) in rows (k, N) that should not fall."""
    return np.asarray((np.maximum.accumulate(x, axis=1) - x).max(axis=1))


def tolerated_step(
    places: Displacement, on_circuit: BoolArray, s: FloatArray, tolerance: OrderTolerance
) -> FloatArray:
    """The steps (k,) of the parameters s (k, N) that move the coupler by the tolerance's distance.

    At the mean speed between neighbours.
    """
    distance, length = tolerance.distance, tolerance.length
    if not distance.any():
        return np.zeros(len(s))
    rows = np.concatenate([places.translation, length * places.angle[..., None]], axis=-1)
    order = np.argsort(s, axis=1)
    rows, s = np.take_along_axis(rows, order[..., None], axis=1), np.take_along_axis(s, order, 1)
    gap = np.diff(rows, axis=1)
    gap[..., 2] = length * wrapped_angle(gap[..., 2] / length)
    counts = np.take_along_axis(on_circuit, order, 1)[:, 1:]
    path = np.nansum(np.where(counts, np.linalg.norm(gap, axis=-1), 0.0), axis=1)
    extent = np.ptp(s, axis=1)
    return np.asarray(np.where(path > 0, distance * extent / np.where(path > 0, path, 1.0), 0.0))


def along_interval(s: FloatArray, unit: FloatArray, slack: FloatArray) -> PoseOrder:
    """The order of parameters s (k, N) along an interval, in the better of both senses.

    unit: (k,), the length, or 1, by which steps are measured.
    """
    return PoseOrder(s, np.minimum(step_back(s), step_back(-s)) / unit, slack / unit)


def around_circuit(s: FloatArray, slack: FloatArray) -> PoseOrder:
    """The order of angles s (k, N) round a closed circuit, in a sense that takes one turn at most.

    If both senses do, the one with the smaller extent; if neither, the smallest arc.
    """
    tried, least = [], np.maximum(CERTAIN_STEP_BACK, slack)
    for sense in (1.0, -1.0):
        step = np.mod(sense * np.diff(s, axis=1), FULL_TURN)
        step = np.where(step > FULL_TURN - least[:, None], step - FULL_TURN, step)
        x = np.concatenate([np.zeros_like(s[:, :1]), np.cumsum(step, axis=1)], axis=1)
        extent = np.ptp(x, axis=1)
        tried.append((s[:, :1] + sense * x, np.maximum(step_back(x), extent - FULL_TURN), extent))
    (up, back_up, extent_up), (down, back_down, extent_down) = tried
    good_up, good_down = back_up <= least, back_down <= least
    use_up = good_up & ~(good_down & (extent_down < extent_up))
    along = np.where(use_up[:, None], up, down)
    along = np.where((good_up | good_down)[:, None], along, smallest_arc(s))
    return PoseOrder(along, np.where(use_up, back_up, back_down), slack)


def smallest_arc(s: FloatArray) -> FloatArray:
    """Angles s (k, N), changed by whole turns so that each row spans the smallest arc."""
    ordered = np.sort(np.mod(s, FULL_TURN), axis=1)
    gaps = np.diff(ordered, axis=1, append=ordered[:, :1] + FULL_TURN)
    after = (gaps.argmax(axis=1) + 1) % s.shape[1]
    start = np.take_along_axis(ordered, after[:, None], axis=1)
    beyond = np.mod(s - start + REPEATED_POSE_STEP, FULL_TURN)
    return np.asarray(start + beyond - REPEATED_POSE_STEP)
