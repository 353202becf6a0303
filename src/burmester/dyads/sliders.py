"""Prismatic dyads in closed form: a line fixed in F, or a line fixed in M.

A circle with an ever larger radius becomes a straight line.  A fit that ends at p1 ~ 0 has
found a slider, and this module finds that slider itself instead of a radius of thousands.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, weights_or_ones
from burmester.tasks.repeated_poses import orientation_arcs

DEPENDENT = 1e-15  # of the size of rows; what is left of one that depends on others is no more


SENSIBLE_SWING = 0.1  # radians; a link that swings more is a link; arcs bend by 1 % of their chords
OUT_OF_SIGHT = 10.0  # sizes of the picture; no picture shows both ends of a longer link


def fixed_lines(
    poses: Displacement, weights: FloatArray | None = None
) -> tuple[PR, FloatArray, FloatArray]:
    """The two stationary PR dyads of poses (*, N), the best first.

    The distance n · (R m + d) - h is linear in (n, u, w, h), with u and w the cosine and sine
    parts of n · R m; u, w and h are eliminated by least squares, and n is a right singular
    vector of the N x 2 matrix that is left: the one with the smaller value is the best line.
    Where the poses leave u, w and h open, they are the shortest ones.

    Returns the dyads (*, 2), and their rms and greatest distances from the line, (*, 2) each, in
    the task's unit.

    Formula `slider` of the theory.
    """
    root = np.sqrt(weights_or_ones(weights, poses.shape))
    d1, d2 = poses.translation[..., 0], poses.translation[..., 1]
    middle1, middle2 = d1.mean(axis=-1, keepdims=True), d2.mean(axis=-1, keepdims=True)
    x, y = (d1 - middle1) * root, (d2 - middle2) * root
    turns = _Turns.of(poses.angle, root)
    (k_x, x), (k_y, y) = (turns.eliminated(each) for each in (x, y))
    # One rotation makes the two columns orthogonal; n along the longer one is the worst normal.
    steep = np.arctan2(2 * _dot(x, y), _dot(x, x) - _dot(y, y)) / 2
    n1 = np.stack([-np.sin(steep), np.cos(steep)], axis=-1)
    n2 = np.stack([np.cos(steep), np.sin(steep)], axis=-1)
    u, w, h = turns.solved(k_x[..., None] * n1 + k_y[..., None] * n2)
    moving_pivot = np.stack([n1 * u + n2 * w, n2 * u - n1 * w], axis=-1)
    h += n1 * middle1 + n2 * middle2
    # A line has two normals; take the one in the upper half plane.
    flip = np.where((n2 < 0) | ((n2 == 0) & (n1 < 0)), -1.0, 1.0)
    lines = PR(np.arctan2(n2 * flip, n1 * flip), h * flip, moving_pivot)
    distance = lines[..., None].residual(poses[..., None, :])
    return lines, np.sqrt((distance**2).mean(axis=-1)), np.abs(distance).max(axis=-1)


class _Turns(NamedTuple):
    """The rows 1, sin a, 1 - cos a over poses (*, N), times roots of weights, as Q R.

    a: the turns from the first pose, so that small turns lose no digits.  A row that depends on
    those before it counts as none: zero in Q.

    first: (*,), the angle there; q: three rows (*, N); r: the triangle (*,), row by row.
    """

    first: FloatArray
    q: tuple[FloatArray, FloatArray, FloatArray]
    r: tuple[FloatArray, ...]

    @classmethod
    def of(cls, angle: FloatArray, root: FloatArray) -> _Turns:
        """Those of angles (*, N), by Gram and Schmidt, twice."""
        first = angle[..., 0]
        turn = angle - first[..., None]
        r00 = np.sqrt(_dot(root, root))
        q0 = root / r00[..., None]
        (r01,), q1, r11 = _orthogonal(root * np.sin(turn), (q0,), r00)
        (r02, r12), q2, r22 = _orthogonal(2 * root * np.sin(turn / 2) ** 2, (q0, q1), r00)
        return cls(first, (q0, q1, q2), (r00, r01, r02, r11, r12, r22))

    def eliminated(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The parts (3, *) of values (*, N) along Q, and what is left of them."""
        parts, left = _left(values, self.q)
        again, left = _left(left, self.q)
        return np.stack(parts) + np.stack(again), left

    def solved(self, parts: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """u, w and h (*, k), for which u cos + w sin - h has the opposite parts (3, *, k)."""
        r00, r01, r02, r11, r12, r22 = (each[..., None] for each in self.r)
        turned, bent = r11 > 0, r22 > 0
        r11, r22 = np.where(turned, r11, 1.0), np.where(bent, r22, 1.0)
        t2 = parts[2] / r22
        t1 = (parts[1] - r12 * t2) / r11
        t0 = (parts[0] - r01 * t1 - r02 * t2) / r00
        along, across, h = t2, -t1, t0 + t2
        if not bent.all():
            # What a row that depends on others leaves open is the shortest.
            z1, free = -r12 / r11, turned & ~bent
            z = np.ones_like(z1), -z1, 1 - (r02 + r01 * z1) / r00
            much = (along * z[0] + across * z[1] + h * z[2]) / (z[0] ** 2 + z[1] ** 2 + z[2] ** 2)
            along, across, h = (
                each - np.where(free, much * part, 0.0)
                for each, part in zip((along, across, h), z, strict=True)
            )
            along, h = np.where(turned | bent, [along, h], [-t0 / 2, t0 / 2])
        c, s = np.cos(self.first)[..., None], np.sin(self.first)[..., None]
        return along * c - across * s, along * s + across * c, h


def _orthogonal(
    row: FloatArray, others: tuple[FloatArray, ...], size: FloatArray
) -> tuple[list[FloatArray], FloatArray, FloatArray]:
    """The parts of a row (*, N) along others, the unit vector of the rest, its length."""
    parts, left = _left(row, others)
    again, left = _left(left, others)
    length = np.sqrt(_dot(left, left))
    length = np.where(length > DEPENDENT * size, length, 0.0)
    scale = np.divide(1.0, length, out=np.zeros_like(length), where=length > 0)
    summed = [one + other for one, other in zip(parts, again, strict=True)]
    return summed, left * scale[..., None], length


def _left(row: FloatArray, others: tuple[FloatArray, ...]) -> tuple[list[FloatArray], FloatArray]:
    """The parts of a row (*, N) along orthogonal unit vectors, and what is left of it."""
    parts = []
    for other in others:
        parts.append(_dot(row, other))
        row = row - parts[-1][..., None] * other
    return parts, row


def _dot(one: FloatArray, other: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("...n,...n->...", one, other))


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
