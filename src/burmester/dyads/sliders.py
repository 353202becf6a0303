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
from burmester.numerics.weights import weights_or_ones

__all__ = ["NearestSlider", "fixed_lines", "moving_lines", "nearest_slider"]


def fixed_lines(
    poses: Displacement, weights: FloatArray | None = None
) -> tuple[PR, FloatArray, FloatArray]:
    """The two stationary PR dyads of poses (*, N), the best first.

    The distance n · (R m + d) - h is linear in (n, u, v, h), with u and v the cosine and sine
    parts of n · R m; u, v and h are eliminated by least squares, and n is a right singular
    vector of the N x 2 matrix that is left: the one with the smaller value is the best line.

    Returns the dyads (*, 2), and their rms and greatest distances from the line, (*, 2) each, in
    the task's unit.

    Formula `slider` of the theory.
    """
    root = np.sqrt(weights_or_ones(weights, poses.shape))[..., None]
    middle = poses.translation.mean(axis=-2, keepdims=True)
    d = poses.translation - middle
    c, s = np.cos(poses.angle), np.sin(poses.angle)
    others = np.stack([c, s, -np.ones_like(c)], axis=-1)
    solve = np.linalg.pinv(others * root)
    rest = d * root - (others * root) @ (solve @ (d * root))
    _, _, v = np.linalg.svd(rest, full_matrices=False)
    n = v[..., ::-1, :]
    u, w, h = np.moveaxis(-solve @ (d * root) @ np.swapaxes(n, -1, -2), -2, 0)
    n1, n2 = n[..., 0], n[..., 1]
    moving_pivot = np.stack([n1 * u + n2 * w, n2 * u - n1 * w], axis=-1)
    h = h + (n * middle).sum(axis=-1)
    # A line has two normals; take the one in the upper half plane.
    flip = np.where((n2 < 0) | ((n2 == 0) & (n1 < 0)), -1.0, 1.0)
    lines = PR(np.arctan2(n2 * flip, n1 * flip), h * flip, moving_pivot)
    distance = lines[..., None].residual(poses[..., None, :])
    return lines, np.sqrt((distance**2).mean(axis=-1)), np.abs(distance).max(axis=-1)


def moving_lines(
    poses: Displacement, weights: FloatArray | None = None
) -> tuple[RP, FloatArray, FloatArray]:
    """The two stationary RP dyads of poses (*, N), the best first; see `fixed_lines`.

    The inverse motion exchanges F and M.
    Returns the dyads, and their rms and greatest distances, (*, 2) each.

    Formula `slot` of the theory.
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
