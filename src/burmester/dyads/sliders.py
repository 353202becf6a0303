"""Prismatic dyads in closed form: a line fixed in F, or a line fixed in M.

A circle with an ever larger radius becomes a straight line.  A fit that ends at p1 ~ 0 has
found a slider, and this module finds that slider itself instead of a radius of thousands.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.fourbar.dyad import PR, RP
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.weights import shares

__all__ = ["NearestSlider", "fixed_lines", "moving_lines", "nearest_slider"]

FLAT_TURN = 1e-13  # relative; the cosines and sines of poses that differ by less do not differ


def fixed_lines(
    poses: Displacement, weights: FloatArray | None = None
) -> tuple[PR, FloatArray, FloatArray]:
    """The two stationary PR dyads of poses (*, N), the best first.

    The distance n · (R m + d) - h is linear in (n, u, v, h), with u and v the cosine and sine
    parts of n · R m; u, v and h are eliminated by least squares: h by means, u and v by a triangle
    (QR) of all columns.  n is a right singular vector of the 2 x 2 triangle that is left: the one
    with the smaller value is the best line.

    Returns the dyads (*, 2), and their rms and greatest distances from the line, (*, 2) each, in
    the task's unit.
    """
    share = shares(weights, poses.shape)[..., None]
    middle = poses.translation.mean(axis=-2, keepdims=True)
    turn = np.stack([np.cos(poses.angle), np.sin(poses.angle)], axis=-1)
    columns = np.concatenate([turn, poses.translation - middle], axis=-1)
    mean = (share * columns).sum(axis=-2, keepdims=True)
    rows = (columns - mean) * np.sqrt(share)
    missing = np.zeros((*poses.shape[:-1], max(0, 4 - poses.shape[-1]), 4))
    triangle = np.asarray(np.linalg.qr(np.concatenate([rows, missing], axis=-2), mode="r"))
    turning, moving = _eliminated(triangle)
    # Both right singular vectors, the smaller value first.
    one, two = moving[..., 0], moving[..., 1]
    apart, mixed = (one * one - two * two).sum(axis=-1), 2 * (one * two).sum(axis=-1)
    along = np.arctan2(mixed, apart) / 2
    angle = np.stack([along + np.pi / 2, along], axis=-1)
    n1, n2 = np.cos(angle), np.sin(angle)
    u, w = (turning[..., k, None, 0] * n1 + turning[..., k, None, 1] * n2 for k in (0, 1))
    moving_pivot = np.stack([n1 * u + n2 * w, n2 * u - n1 * w], axis=-1)
    x, y = (middle[..., k] + mean[..., 2 + k] for k in (0, 1))
    h = n1 * x + n2 * y + u * mean[..., 0] + w * mean[..., 1]
    # A line has two normals; take the one in the upper half plane.
    flip = np.where((n2 < 0) | ((n2 == 0) & (n1 < 0)), -1.0, 1.0)
    lines = PR(np.arctan2(n2 * flip, n1 * flip), h * flip, moving_pivot)
    distance = lines[..., None].residual(poses[..., None, :])
    return lines, np.sqrt((distance**2).mean(axis=-1)), np.abs(distance).max(axis=-1)


def _eliminated(triangle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """From a triangle (*, 4, 4) of rows (c, s, d): how (u, v) follow from n, and what n leaves.

    Matrices (*, 2, 2) both.  Where c and s do not differ the shortest u and v are taken.
    """
    a, b, c = triangle[..., 0, 0], triangle[..., 0, 1], triangle[..., 1, 1]
    right, rest = triangle[..., :2, 2:], triangle[..., 2:, 2:]
    flat = np.abs(a * c) <= FLAT_TURN * (a * a + b * b + c * c)
    safe_a, safe_c = np.where(flat, 1.0, a)[..., None], np.where(flat, 1.0, c)[..., None]
    second = -right[..., 1, :] / safe_c
    first = (-right[..., 0, :] - b[..., None] * second) / safe_a
    turning = np.stack([first, second], axis=-2)
    if not flat.any():
        return turning, rest
    solve = np.linalg.pinv(triangle[flat][..., :2, :2])
    turning[flat] = -solve @ right[flat]
    rest = np.concatenate([np.zeros_like(rest), rest], axis=-2)
    rest[flat, :2] = right[flat] + triangle[flat][..., :2, :2] @ turning[flat]
    return turning, rest


def moving_lines(
    poses: Displacement, weights: FloatArray | None = None
) -> tuple[RP, FloatArray, FloatArray]:
    """The two stationary RP dyads of poses (*, N), the best first; see `fixed_lines`.

    The inverse motion exchanges F and M.
    Returns the dyads, and their rms and greatest distances, (*, 2) each.
    """
    lines, rms, worst = fixed_lines(poses.inverse(), weights)
    return RP(lines.moving_pivot, lines.normal_angle, lines.offset), rms, worst


class NearestSlider(NamedTuple):
    """The slider nearest to a manifold.

    rms_error, max_error: of its distances, in the unit of the poses; angle_sine: of the angle
    between the two manifolds as vectors.
    """

    dyad: PR | RP
    rms_error: float
    max_error: float
    angle_sine: float


def nearest_slider(
    coefficients: FloatArray, poses: Displacement, weights: FloatArray | None = None
) -> NearestSlider:
    """The slider nearest to a manifold p (8,) with p1 ~ 0.

    Of the stationary sliders of the poses (N,), the one whose line points as that of p does.
    """
    fixed, moving = constraint_manifold.prismatic_parts(coefficients)
    on_ground = np.linalg.norm(fixed) >= np.linalg.norm(moving)
    part = fixed if on_ground else moving
    lines, rms, worst = fixed_lines(poses, weights) if on_ground else moving_lines(poses, weights)
    along = np.cos(lines.normal_angle) * part[0] + np.sin(lines.normal_angle) * part[1]
    nearest = int(np.abs(along).argmax())
    line = lines[nearest]
    p, q = (
        v / constraint_manifold.INVARIANT / constraint_manifold.size(v)
        for v in (coefficients, line.coefficients())
    )
    apart = np.linalg.norm(p - (p @ q) * q)  # not from the cosine, which cannot tell below 1e-8
    return NearestSlider(line, float(rms[nearest]), float(worst[nearest]), float(apart))
