"""Whether what a model of a motion leaves over is scatter: noise from pose to pose.

What a linkage moves changes smoothly as the body turns; errors of measurement do not.  So poses
that differ from a turn about one point by scatter alone know of no linkage, however large the
scatter is.  Nothing here depends on where the origins of F and M are.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ROUNDING, ComplexArray, FloatArray

__all__ = ["is_scatter", "last_digit"]

FEWEST_POSES = 6
# Poses that show scatter of any size.  Fewer show it up to `MAX_STEPS` steps of the last digit.
ENOUGH_POSES = 8
MAX_STEPS = 5.0
MAX_TURN = np.radians(32)  # between two poses in a row; beyond it a linkage's motion looks rough
# Of steps squared over deviations squared: 2 of white noise, 12 / (N (N + 1)) of a steady motion.
MIN_ROUGHNESS, MAX_ANGLE_ROUGHNESS = 1.6, 0.1
# Of the part of white noise that two more terms leave over.  By `benchmarks.pins_from_two_origins`
# 2 to 6 % of scattered turns are missed so.
MIN_SHARE_LEFT = 0.3
MAX_DECIMALS = 9


def is_scatter(residual: ComplexArray, turn: ComplexArray) -> NDArray[np.bool_]:
    """Whether residuals (*, N) of a turn about a point are scatter, at turn = exp(i angle) (*, N).

    residual: after c + a turn has been fitted.  The poses are in the order of the motion.
    Two things have to hold: the angles go on steadily while the residuals jump to and fro, and
    1 / turn and turn^2, the first terms by which a linkage differs from a turn, leave most of
    them unexplained.
    """
    count = turn.shape[-1]
    if count < FEWEST_POSES:
        return np.zeros(turn.shape[:-1], dtype=bool)
    steps = np.angle(turn[..., 1:] * turn[..., :-1].conj())
    angle = np.concatenate([np.zeros_like(steps[..., :1]), np.cumsum(steps, axis=-1)], axis=-1)
    one_way = (steps > 0).all(axis=-1) | (steps < 0).all(axis=-1)
    steady = one_way | (
        _roughness(angle - angle.mean(axis=-1, keepdims=True)) < MAX_ANGLE_ROUGHNESS
    )
    dense = np.abs(steps).max(axis=-1) <= MAX_TURN
    rough = _roughness(residual) > MIN_ROUGHNESS
    terms = np.stack([np.ones_like(turn), turn, turn.conj(), turn**2], axis=-1)
    q, _ = np.linalg.qr(terms)
    left = residual - (q @ (q.conj().swapaxes(-1, -2) @ residual[..., None]))[..., 0]
    share = MIN_SHARE_LEFT * (count - 4) / (count - 2)
    unexplained = _power(left) > share * _power(residual)
    return np.asarray(steady & dense & rough & unexplained)


def last_digit(values: FloatArray) -> float:
    """The step of the last decimal place in which numbers are given; 0 for more than nine."""
    for decimals in range(MAX_DECIMALS + 1):
        scaled = values * 10.0**decimals
        if np.abs(scaled - np.round(scaled)).max() <= ROUNDING * max(1.0, np.abs(scaled).max()):
            return float(10.0**-decimals)
    return 0.0


def _roughness(values: ComplexArray | FloatArray) -> FloatArray:
    """The sum of squared steps of centred values (*, N) over the sum of their squares."""
    power = _power(values)
    return np.asarray(_power(np.diff(values, axis=-1)) / np.where(power > 0, power, 1.0))


def _power(values: ComplexArray | FloatArray) -> FloatArray:
    return np.asarray((np.abs(values) ** 2).sum(axis=-1))
