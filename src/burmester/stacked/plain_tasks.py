"""Which tasks of a stack are plain: what they are asks for no closer look.

`classify_motion` tells what the motion of one task is.  Here the same thresholds are asked of all
tasks at once, each of them on the safe side: a plain task is of a general motion, all its poses
are distinct, and no more quadrics hold them than poses so many always leave.  All other tasks take
the road of one task.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, ComplexArray, FloatArray, complex_of
from burmester.numerics.bundles import take
from burmester.stacked.task_stack import TaskStack
from burmester.tasks.motion_class import LARGE_ROTATION, MAX_COUNTED_POSES
from burmester.tasks.motion_task import COARSE, CONDITIONS, MOST, MOST_RATIO, MOST_TURN
from burmester.tasks.repeated_poses import COORDINATE_ROUNDING
from burmester.tasks.scatter import (
    MAX_RESIDUAL_ERRORS,
    SLIDERS,
    is_scatter,
    is_steady,
    max_residual_errors,
    odd_one,
)

__all__ = ["computable", "plain_tasks"]

# Safe sides: thresholds are multiplied by it, so that no rounding makes a task plain that is not.
SAFE = 1.001
# Times the tolerance of a singular value: with a third one above it no special model holds, as
# three quadrics hold the poses of each of these within their errors.
FAR_FROM_SPECIAL = 1e3

Mask = NDArray[np.bool_]


def plain_tasks(
    stack: TaskStack, singular_values: FloatArray | None = None
) -> tuple[Mask, NDArray[np.intp]]:
    """Which of computable tasks (T,) are plain, and how many quadrics hold the poses of each (T,).

    singular_values: (T, 8), ascending, of the design matrices without weights in canonical frames,
        where they are known already.
    """
    count = stack.poses.shape[1]
    motions = _Motions.of(stack)
    values = motions.singular_values() if singular_values is None else singular_values
    tolerance = SAFE * motions.tolerance
    nullity = (values <= tolerance[:, None]).sum(axis=1)
    most = max(2, CONDITIONS + 3 - count)  # quadrics
    plain = nullity <= most
    plain &= ~motions.constant_angle & ~motions.about_point & motions.differ()
    plain &= odd_one(motions.residual, motions.turn) < 0
    steady = is_steady(motions.turn)
    may = np.flatnonzero(plain & steady)
    plain[may] = ~is_scatter(motions.residual[may], motions.turn[may])
    special = (values[:, 2] <= FAR_FROM_SPECIAL * tolerance) | steady
    near = np.flatnonzero(plain & special)
    if len(near):
        some = motions.take(near)
        plain[near] = ~some.two_sliders() & ~some.two_angles()
    return plain, nullity


def computable(stack: TaskStack) -> Mask:
    """Which tasks (T,) `Task` accepts, no number near the border of that, and no pose exact."""
    reach = np.abs(stack.poses[..., :2]).max(axis=(1, 2))
    turn = np.abs(stack.poses[..., 2]).max(axis=1)
    sound = (reach <= MOST / SAFE) & (reach >= SAFE / MOST) & (turn <= MOST_TURN / SAFE)
    if stack.weights is not None:
        least, most = stack.weights.min(axis=1), stack.weights.max(axis=1)
        sound &= (least > 0) & (most * SAFE <= MOST_RATIO * least)
    if stack.exact is not None:
        sound &= ~stack.exact.any(axis=1)
    return np.asarray(sound)


class _Motions(NamedTuple):
    """The poses of tasks (T, N) in complex numbers, as `motion_class` fits them to a rotation."""

    d: ComplexArray
    turn: ComplexArray
    angle: FloatArray
    offsets: FloatArray
    residual: ComplexArray
    lever: FloatArray
    length: FloatArray
    position_error: FloatArray
    turn_error: FloatArray
    rounding: FloatArray
    turn_rounding: FloatArray
    constant_angle: Mask
    about_point: Mask

    @classmethod
    def of(cls, stack: TaskStack) -> _Motions:
        d, angle = complex_of(stack.poses[..., :2]), stack.poses[..., 2]
        turn = np.exp(1j * angle)
        centred = d - d.mean(axis=1, keepdims=True)
        spread = _rms(centred)
        position, turned = stack.resolution
        turn_rounding = COORDINATE_ROUNDING * np.maximum(1.0, np.abs(angle).max(axis=1))
        offsets = np.angle(turn * turn[:, :1].conj())
        error = np.maximum(max(min(turned, COARSE), ROUNDING), turn_rounding)
        constant = np.ptp(offsets, axis=1) <= SAFE * 2 * MAX_RESIDUAL_ERRORS * error
        around = turn - turn.mean(axis=1, keepdims=True)
        power = (around.real**2 + around.imag**2).sum(axis=1)
        share = (around.conj() * centred).sum(axis=1) / np.where(power > 0, power, 1.0)
        residual = centred - share[:, None] * around
        large = _rms(around) >= LARGE_ROTATION / SAFE
        motions = cls(
            *(d, turn, angle, offsets, residual, np.abs(share), _rms(residual)),
            np.where((spread > 0) & ~large, np.minimum(position, COARSE * spread), position),
            np.where(large, turned, min(turned, COARSE)),
            COORDINATE_ROUNDING * np.abs(d).max(axis=1),
            *(turn_rounding, constant, constant),
        )
        about = (motions.length <= SAFE * ROUNDING * spread) | motions.explains(
            residual, motions.lever
        )
        return motions._replace(about_point=about)

    def take(self, index: NDArray[np.intp]) -> _Motions:
        """Those at the indices."""
        return take(self, index)

    @property
    def angle_error(self) -> FloatArray:
        error = np.maximum(np.minimum(self.turn_error, COARSE), ROUNDING)
        return np.asarray(np.maximum(error, self.turn_rounding))

    def error(self, lever: FloatArray) -> FloatArray:
        """The errors (T,) of the places of points of M at distances (T,) from its origin."""
        printed = self.position_error + lever * self.turn_error
        rounding = self.rounding + lever * self.turn_rounding
        return np.asarray(np.maximum(printed, np.maximum(ROUNDING * self.length, rounding)))

    def explains(self, miss: ComplexArray, lever: FloatArray) -> Mask:
        """Whether errors alone may explain the residuals (T, N) of a model."""
        most = SAFE * max_residual_errors(self.d.shape[1]) * self.error(lever)
        return np.asarray(np.abs(miss).max(axis=1) <= most)

    def singular_values(self) -> FloatArray:
        """Those of the design matrices in canonical frames, ascending: (T, 8)."""
        place = self.residual / np.where(self.length > 0, self.length, 1.0)[:, None]
        seen = Displacement(np.stack([place.real, place.imag], axis=-1), self.angle)
        design = constraint_manifold.monomials(seen.as_image_point())
        values = np.linalg.svd(design * constraint_manifold.INVARIANT, compute_uv=False)
        missing = np.zeros((len(values), 8 - values.shape[1]))
        return np.concatenate([missing, values[:, ::-1]], axis=1)

    @property
    def tolerance(self) -> FloatArray:
        """The most that errors of the poses make of a singular value of zero, (T,)."""
        length = np.where(self.length > 0, self.length, 1.0)
        error = self.error(self.lever) / length + self.angle_error
        return np.asarray(3 * np.minimum(error, COARSE) * np.sqrt(self.d.shape[1] / 3))

    def differ(self) -> Mask:
        """Which have no repeated pose, and as many as count that can be told apart."""
        gaps = np.diff(np.sort(self.offsets, axis=1), axis=1).min(axis=1)
        around = 2 * np.pi - np.ptp(self.offsets, axis=1)
        differ = np.asarray(np.minimum(gaps, around) > 4 * self.angle_error)
        rest = np.flatnonzero(~differ)
        if len(rest):
            differ[rest] = self.take(rest)._told_apart()
        return differ

    def _told_apart(self) -> Mask:
        """The same where angles alone do not tell the poses apart."""
        repeats = np.ones(len(self.d), dtype=bool)
        reach = SAFE * self.rounding
        for values, size in (
            (self.d.real, reach),
            (self.d.imag, reach),
            (self.turn.real, SAFE * self.turn_rounding),
            (self.turn.imag, SAFE * self.turn_rounding),
        ):
            gaps = np.diff(np.sort(values, axis=1), axis=1).min(axis=1)
            repeats &= gaps <= size
        position = np.maximum(self.error(np.zeros(len(self.d))), np.finfo(np.float64).tiny)
        last, nearest = np.zeros(len(self.d), dtype=np.intp), np.full(self.d.shape, np.inf)
        apart_all = np.ones(len(self.d), dtype=bool)
        row = np.arange(len(self.d))
        for _ in range(min(MAX_COUNTED_POSES, self.d.shape[1]) - 1):
            apart = np.abs(self.d - self.d[row, last][:, None]) / position[:, None]
            turned = np.abs(self.turn - self.turn[row, last][:, None]) / self.angle_error[:, None]
            nearest = np.minimum(nearest, np.maximum(apart, turned))
            last = nearest.argmax(axis=1)
            apart_all &= nearest[row, last] > 2 * SAFE
        return np.asarray(~repeats & apart_all)

    def two_sliders(self) -> Mask:
        """Which may be two-slider motions, or the inverse of one."""
        may = np.zeros(len(self.d), dtype=bool)
        for inverse in (False, True):
            turn = self.turn.conj() if inverse else self.turn
            residual = -self.residual * turn if inverse else self.residual
            around, back = (each - each.mean(axis=1, keepdims=True) for each in (turn, turn.conj()))
            power = (np.abs(around) ** 2).sum(axis=1)
            a = (around.conj() * back).sum(axis=1) / np.where(power > 0, power, 1.0)
            term = back - a[:, None] * around
            size = (np.abs(term) ** 2).sum(axis=1)
            b = (term.conj() * residual).sum(axis=1) / np.where(size > 0, size, 1.0)
            # More than the lever of the motion, which is the sum of no more than these.
            lever = self.lever + np.abs(b) * (2 + np.abs(a) + np.abs(self.turn.mean(axis=1)))
            miss = residual - b[:, None] * term
            may |= self.explains(miss, lever) | is_scatter(miss, turn, SLIDERS)
        return may

    def two_angles(self) -> Mask:
        """Which may have two angles only."""
        row = np.arange(len(self.d))
        second = self.turn[row, np.abs(self.offsets).argmax(axis=1)]
        other = np.angle(self.turn * second[:, None].conj())
        off = np.minimum(np.abs(self.offsets), np.abs(other)).max(axis=1)
        return np.asarray(off <= SAFE * 2 * MAX_RESIDUAL_ERRORS * self.angle_error)


def _rms(values: ComplexArray) -> FloatArray:
    return np.asarray(np.sqrt((values.real**2 + values.imag**2).mean(axis=1)))
