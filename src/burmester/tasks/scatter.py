"""What a model of a motion leaves over: stated errors, or scatter, noise from pose to pose.

What a linkage moves changes smoothly as the body turns; errors of measurement do not.  So where
poses differ from a special motion by scatter alone, they tell nothing of another linkage, however
large the scatter is.  Nothing here depends on where the origins of F and M are.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ROUNDING, ComplexArray, FloatArray
from burmester.tasks.motion_task import Task

MAX_RESIDUAL_ERRORS = 2.0  # pose errors; a model with a greater residual does not hold

# Powers of exp(i angle) in the model of a motion, then the next ones, by which linkages differ.
TURN = (0, 1), (-1, 2)
SLIDERS = (0, 1, -1), (2, -2)
LEFT_OVER = 2  # poses more than powers, at least
FEWEST = 6  # so many poses show that they scatter about a turn
# Poses that show scatter of any size; fewer show scatter of few steps of the last digit.
ENOUGH_POSES, MAX_STEPS = 8, 20.0
MAX_TURN = np.radians(32)  # between two poses in a row; beyond it a linkage's motion looks rough
# The sum of squared steps over that of squared deviations: 2 of white noise, 0.05 of 15 poses
# at equal angles.
MIN_ROUGHNESS, MAX_ANGLE_ROUGHNESS = 1.4, 0.1
# Of the part of white noise that the next powers leave over.  With these bounds 3 to 9 % of
# scattered turns are missed, and of 1500 motions of four-bars none is taken for a scattered turn
# (`python -m benchmarks.two_origins`).
MIN_SHARE_LEFT = 0.4
ODD_SHARE = 15 / 16  # of the sum of squares goes with the one odd pose
MAX_DECIMALS = 9


def max_residual_errors(count: int) -> float:
    """The greatest residual of `count` poses that errors alone explain, in pose errors.

    Errors spread evenly never exceed it.  Of measured ones, which are normal, one in so many poses
    may be greater: the bound is exceeded once in 20 tasks.
    """
    return max(MAX_RESIDUAL_ERRORS, float(np.sqrt(2 / 3 * np.log(20 * count))))


def is_scatter(
    residual: ComplexArray,
    turn: ComplexArray,
    powers: tuple[tuple[int, ...], tuple[int, ...]] = TURN,
) -> NDArray[np.bool_]:
    """Whether the residuals (*, N) of a model are scatter, at turn = exp(i angle), (*, N).

    powers: of `turn`, those of the model, which leaves `residual`, and the next ones.
    The poses are in the order of the motion.  The angles have to go on steadily while the
    residuals jump to and fro, and the next powers have to leave most of them unexplained.
    """
    model, following = powers
    count, every = turn.shape[-1], len(model) + len(following)
    if count < every + LEFT_OVER:
        return np.zeros(turn.shape[:-1], dtype=bool)
    q, _ = np.linalg.qr(np.stack([turn**power for power in model + following], axis=-1))
    left = residual - (q @ (q.conj().swapaxes(-1, -2) @ residual[..., None]))[..., 0]
    share = MIN_SHARE_LEFT * (count - every) / (count - len(model))
    unexplained = _power(left) > share * _power(residual)
    return np.asarray(is_steady(turn) & unexplained & (_roughness(residual) > MIN_ROUGHNESS))


def is_steady(turn: ComplexArray) -> NDArray[np.bool_]:
    """Whether angles go on steadily from pose to pose, by turn = exp(i angle), (*, N)."""
    steps = np.angle(turn[..., 1:] * turn[..., :-1].conj())
    angle = np.concatenate([np.zeros_like(steps[..., :1]), np.cumsum(steps, axis=-1)], axis=-1)
    rough = _roughness(angle - angle.mean(axis=-1, keepdims=True))
    one_way = (steps > 0).all(axis=-1) | (steps < 0).all(axis=-1)
    dense = np.abs(steps).max(axis=-1) <= MAX_TURN
    return np.asarray(dense & (one_way | (rough < MAX_ANGLE_ROUGHNESS)))


def odd_one(residual: ComplexArray, turn: ComplexArray) -> NDArray[np.int_]:
    """The pose (*,) without which residuals (*, N) of a turn are a quarter, rms; -1 for none."""
    around = turn - turn.mean(axis=-1, keepdims=True)
    power = np.maximum(_power(around), np.finfo(np.float64).tiny)[..., None]
    leverage = 1 / turn.shape[-1] + np.abs(around) ** 2 / power
    saved = np.abs(residual) ** 2 / np.maximum(1 - leverage, ROUNDING)
    odd = saved.max(axis=-1) > ODD_SHARE * _power(residual)
    return np.where(odd & (turn.shape[-1] > FEWEST), saved.argmax(axis=-1), -1)


def max_scatter(task: Task) -> float:
    """The greatest scatter, rms, that a task's poses can show to be scatter.

    None where a pose is meant exactly, or has tolerances.
    """
    if task.tolerances is not None or (task.exact is not None and task.exact.any()):
        return 0.0
    if task.poses.shape[0] >= ENOUGH_POSES:
        return np.inf
    return MAX_STEPS * last_digit(task.poses.translation)


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
