"""Which of many motions are plain: what they are asks for no closer look.

`classify_motion` tells what the motion of one task is.  Here the same is asked of all tasks at
once, where it can be ruled out with less: a plain motion is general, all its poses are distinct,
and no more quadrics hold them than poses so many always leave.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, take
from burmester.tasks.motion_class import MAX_COUNTED_POSES
from burmester.tasks.motion_task import CONDITIONS
from burmester.tasks.rotation_fit import RotationFit, residual_of_turn
from burmester.tasks.scatter import SLIDERS, is_scatter, is_steady, odd_one

# Times the tolerance of a singular value: with a third one above it no special model holds, as
# three quadrics hold the poses of each of these within their errors.
FAR_FROM_SPECIAL = 1e3

Mask = NDArray[np.bool_]


def plain_motions(
    poses: Displacement,
    resolution: tuple[float, float],
    singular_values: FloatArray | None = None,
) -> tuple[Mask, NDArray[np.intp]]:
    """Which of tasks with poses (T, N) are plain, and how many quadrics hold the poses of each.

    singular_values: (T, 8), ascending, of the design matrices without weights in canonical frames,
        where they are known already.
    """
    motions, count = RotationFit.of(poses, resolution), poses.shape[1]
    values, tolerance = singular_values, motions.tolerance()
    if values is None:
        missing = np.zeros((len(tolerance), max(0, 8 - count)))
        own = np.linalg.svd(motions.design, compute_uv=False)[:, ::-1]
        values = np.concatenate([missing, own], axis=1)
    nullity = (values <= tolerance[:, None]).sum(axis=1)
    plain = nullity <= max(2, CONDITIONS + 3 - count)  # quadrics
    plain &= ~motions.constant_angle & ~motions.about_point & _differ(motions)
    plain &= odd_one(motions.residual, motions.turn) < 0
    steady = is_steady(motions.turn)
    may = np.flatnonzero(plain & steady)
    plain[may] = ~is_scatter(motions.residual[may], motions.turn[may])
    special = (values[:, 2] <= FAR_FROM_SPECIAL * tolerance) | steady
    near = np.flatnonzero(plain & special)
    if len(near):
        some = take(motions, near)
        plain[near] = ~_two_sliders(some) & ~some.two_angles[1]
    return plain, nullity


def _differ(motions: RotationFit) -> Mask:
    """Which have no repeated pose, and as many as count that can be told apart."""
    offsets = motions.angle_offsets
    gaps = np.diff(np.sort(offsets, axis=1), axis=1).min(axis=1)
    around = 2 * np.pi - np.ptp(offsets, axis=1)
    differ = np.asarray(np.minimum(gaps, around) > 4 * motions.angle_error)
    rest = np.flatnonzero(~differ)
    if len(rest):
        differ[rest] = _told_apart(take(motions, rest))
    return differ


def _told_apart(motions: RotationFit) -> Mask:
    """The same where angles alone do not tell the poses apart."""
    d, turn, row = motions.d, motions.turn, np.arange(len(motions.d))
    repeats = np.ones(len(d), dtype=bool)
    for values, size in (
        (d.real, motions.rounding),
        (d.imag, motions.rounding),
        (turn.real, motions.turn_rounding),
        (turn.imag, motions.turn_rounding),
    ):
        repeats &= np.diff(np.sort(values, axis=1), axis=1).min(axis=1) <= size
    position = np.maximum(motions.error(0.0), np.finfo(np.float64).tiny)[:, None]
    last, nearest = np.zeros(len(d), dtype=np.intp), np.full(d.shape, np.inf)
    apart_all = np.ones(len(d), dtype=bool)
    for _ in range(min(MAX_COUNTED_POSES, d.shape[1]) - 1):
        apart = np.abs(d - d[row, last][:, None]) / position
        turned = np.abs(turn - turn[row, last][:, None]) / motions.angle_error[:, None]
        nearest = np.minimum(nearest, np.maximum(apart, turned))
        last = nearest.argmax(axis=1)
        apart_all &= nearest[row, last] > 2
    return np.asarray(~repeats & apart_all)


def _two_sliders(motions: RotationFit) -> Mask:
    """Which may be two-slider motions, or the inverse of one."""
    may = np.zeros(len(motions.d), dtype=bool)
    for inverse in (False, True):
        turn = motions.turn.conj() if inverse else motions.turn
        residual = -motions.residual * turn if inverse else motions.residual
        term, _, a = residual_of_turn(turn.conj(), turn)
        size = (np.abs(term) ** 2).sum(axis=1)
        b = (term.conj() * residual).sum(axis=1) / np.where(size > 0, size, 1.0)
        # More than the lever of the motion, which is the sum of no more than these.
        lever = np.abs(motions.minus_m)
        lever = lever + np.abs(b) * (2 + np.abs(a) + np.abs(motions.turn.mean(axis=1)))
        miss = residual - b[:, None] * term
        may |= motions.explains(miss, lever) | is_scatter(miss, turn, SLIDERS)
    return may
