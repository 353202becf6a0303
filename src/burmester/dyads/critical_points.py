"""Every locally best RR dyad of a task, by linear algebra.

With the squared distance of the moving pivot from the fixed one as a function of both,

    f_i = |R_i m + d_i - c|² = |m|² + |c|² + |d_i|² - 2 c · d_i + 2 d_i · R_i m - 2 c · R_i m,

the circle residual is f_i minus its mean: the best r² for given pivots.  It is linear in the
seven numbers v = (1, c, m, c · m, c x m), so the sum of its squares is F = |T v|² with a
triangle T, 7 x 7, and the critical points of F are the common zeros of its four derivatives.  For
generic poses there are 25 of them.

All of them come from one eigenproblem, with no start value (`critical_search`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_descent import reach
from burmester.dyads.critical_search import (
    COUNT,
    REAL_TOLERANCE,
    SAME_POINT,
    SETTLED_STEP,
    balanced,
    critical_points,
    derivatives,
    features,
    health,
)
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, shares, weights_or_ones
from burmester.numerics.linear_algebra import solve_or_shortest

__all__ = [
    "COUNT",
    "LITTLE_TURN",
    "CriticalDyads",
    "continued_points",
    "critical_dyads",
    "points_at_infinity",
    "residual_rows",
    "residual_triangle",
]

POINTS_OF_SLIDER = 3  # at infinity, for each slider that meets the poses exactly
SLIDER_ROUNDING = 64.0  # units in the last place; a slider that misses poses by less is exact
LITTLE_TURN = 400.0  # inverse mean squared turn; from it on ways are narrow and points may be lost
CONTINUING_STEPS = 6  # of Newton's method from the critical points of poses nearby
CONTINUED_SHARE = 0.4  # of the way to its nearest neighbour; a point that moves farther is lost,
PREDICTED_SHARE = 0.3  # if it moves so much of its way otherwise than the first step says


@final
@dataclass(frozen=True, slots=True, eq=False)
class CriticalDyads:
    """All critical points of the squared circle residual of a task, real or not.

    frames: where they were found, (*,).
    points: (*, 25, 4), complex c1, c2, m1, m2 in those frames, real minima first, by rising
        residual, then the other real ones, then the rest; nan beyond `found`.  Of residuals that
        are rounding alone, the nearer points come first.
    found: (*,), how many were found that are finite and simple, each once; 25 are all.
    at_infinity: (*,), how many more have a pivot at infinity: three for each slider that meets the
        poses to rounding, and nothing else.  What is then missing of 25 is not accounted for: far
        away, multiple, on a curve of critical points, or lost; the poses are special, turn little,
        or are within rounding of such ones.
    charts: (*,), how many charts it took: 1 but for hard tasks.
    real, minimum: (*, 25), which are real, and which of those are local minima.
    dyads: (*, 25), as RR dyads in the task's own frames; nan where not real.  r² is the mean of
        the squared distances, the best for these pivots and never negative.
    residual: (*, 25), rms of the circle residual |R m + d - c|² - r², in the task's unit squared.
    triangle: (*, 7, 7), T above, in those frames.
    """

    frames: CanonicalFrames
    points: ComplexArray
    found: NDArray[np.int_]
    at_infinity: NDArray[np.int_]
    charts: NDArray[np.int_]
    real: NDArray[np.bool_]
    minimum: NDArray[np.bool_]
    dyads: RR
    residual: FloatArray
    triangle: FloatArray

    @property
    def health(self) -> FloatArray:
        """The least relative pivot (*,) of the eigenproblem's 125 rows (`macaulay`).

        Rounding is magnified by its inverse, and below some 1e-12 points are lost.
        """
        lead = self.triangle.shape[:-2]
        own = [health(each) for each in self.triangle.reshape(-1, 7, 7)]
        return np.reshape(own, lead)


def critical_dyads(poses: Displacement, weights: FloatArray | None = None) -> CriticalDyads:
    """Every critical point of the weighted sum of squared circle residuals over RR dyads.

    All of them come from one eigenproblem for each task, with no start value; leading axes are
    tasks.

    Formula `squared-residual` of the theory.

    Parameters
    ----------
    poses : Displacement, (*, N)
        N >= 5 poses.
    weights : array, (*, N), optional
        Of the squared residuals.

    Returns
    -------
    CriticalDyads
        The critical points, real and complex, which are minima, and how many are accounted for.

    Raises
    ------
    InputError
        E121 (fewer than 5 poses), E103 (a number that is not finite).

    Examples
    --------
    >>> t = np.linspace(0, 3, 7)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> critical = critical_dyads(poses)
    >>> int(critical.found), int(critical.minimum.sum())
    (25, 2)
    >>> float(critical.dyads.radius[0].round(6))
    1.0
    """
    count = poses.shape[-1] if poses.shape else 0
    if count < 5:
        raise InputError(
            "E121",
            f"at least 5 poses are needed to look for best dyads, not {count}",
            why="four poses or fewer are met exactly by infinitely many dyads",
            help="give more poses; dyad_curve takes 4 of them, dyad_with_moving_pivot 3",
        )
    poses.require_finite()
    frames, seen = CanonicalFrames.of(poses, weights)
    lead = poses.shape[:-1]
    triangle = residual_triangle(seen, weights)
    far = points_at_infinity(poses, frames, seen, weights)
    turning = reach(seen, shares(weights, poses.shape)) <= LITTLE_TURN
    every = critical_points(triangle.reshape(-1, 7, 7), far.ravel(), turning.ravel())
    points, found, charts, real, minimum = (
        each.reshape((*lead, *each.shape[1:])) for each in every
    )
    far = np.minimum(far, COUNT - found)
    x = np.where(real[..., None], points.real, np.nan)
    squared = (features(x) @ np.swapaxes(triangle, -1, -2)) ** 2
    residual = np.sqrt(squared.sum(axis=-1)) * frames.length[..., None] ** 2
    centred = RR(x[..., :2], x[..., 2:], np.zeros(x.shape[:-1]))[..., None]
    with np.errstate(invalid="ignore"):
        distance = centred.residual(seen[..., None, :])
        share = weights_or_ones(None if weights is None else weights[..., None, :], distance.shape)
        radius = np.sqrt((distance**2 * share).sum(axis=-1) / share.sum(axis=-1))
    dyads = frames.circle_from_canonical(RR(x[..., :2], x[..., 2:], radius))
    return CriticalDyads(
        frames, points, found, far, charts, real, minimum, dyads, residual, triangle
    )


def residual_rows(poses: Displacement) -> FloatArray:
    """The rows a (*, N, 7) with |R m + d - c|² - |m|² - |c|² = a · v.

    Formula `residual-rows` of the theory.
    """
    d1, d2 = poses.translation[..., 0], poses.translation[..., 1]
    c, s = np.cos(poses.angle), np.sin(poses.angle)
    rows = [d1 * d1 + d2 * d2, -2 * d1, -2 * d2, 2 * (c * d1 + s * d2), 2 * (c * d2 - s * d1)]
    return np.stack([*rows, -2 * c, -2 * s], axis=-1)


def residual_triangle(poses: Displacement, weights: FloatArray | None) -> FloatArray:
    """T (*, 7, 7) with |T v|² the weighted mean of the squared circle residuals."""
    a = residual_rows(poses)
    share = shares(weights, poses.shape)
    a = a - (share[..., None] * a).sum(axis=-2, keepdims=True)
    a = a * np.sqrt(share)[..., None]
    missing = max(0, 7 - a.shape[-2])
    a = np.concatenate([a, np.zeros((*a.shape[:-2], missing, 7))], axis=-2)
    return np.asarray(np.linalg.qr(a, mode="r"))


def points_at_infinity(
    poses: Displacement,
    frames: CanonicalFrames,
    seen: Displacement,
    weights: FloatArray | None,
) -> NDArray[np.int_]:
    """How many critical points have a pivot at infinity, (*,), of poses (*, N).

    By the sliders that meet the poses to rounding; seen: the poses in their frames.
    """
    count = np.zeros(poses.shape[:-1], dtype=int)
    origins = [
        np.linalg.norm(each, axis=-1) for each in (frames.fixed_origin, frames.moving_origin)
    ]
    size = np.linalg.norm(poses.translation, axis=-1).max(axis=-1) + origins[0] + origins[1]
    turns = np.maximum(np.abs(poses.angle).max(axis=-1), 1.0)
    for lines, pivot in ((fixed_lines, "moving_pivot"), (moving_lines, "fixed_pivot")):
        line, _, worst = lines(seen, weights)
        arm = 1 + np.linalg.norm(getattr(line, pivot), axis=-1)
        ulp = np.finfo(np.float64).eps * (
            (size / frames.length)[..., None] + arm * turns[..., None]
        )
        count = count + (worst < SLIDER_ROUNDING * ulp).sum(axis=-1)
    return np.asarray(POINTS_OF_SLIDER * count)


def continued_points(
    points: ComplexArray, poses: Displacement, weights: FloatArray | None = None
) -> ComplexArray | None:
    """The critical points (k, 4) of poses (N,) from those of poses that differ a little.

    By Newton's method, real and complex ones alike, all in one frame.  None where one does not come
    to rest nearer to itself than to the others, so that two may have met, or has become real: then
    `critical_dyads` says what there is.
    """
    scaled, unit = balanced(residual_triangle(poses, weights))
    start = x = points / unit
    first = None
    for _ in range(CONTINUING_STEPS):
        gradient, hessian, _ = derivatives(x.T, scaled[..., None])
        step = solve_or_shortest(hessian, gradient)
        x = x - step
        first = x if first is None else first
        if (np.abs(step).max(axis=1) < SETTLED_STEP * (1 + np.abs(x).max(axis=1))).all():
            break
    else:
        return None
    moved, off = np.linalg.norm(x - start, axis=1), np.linalg.norm(x - first, axis=1)
    astray = (moved > CONTINUED_SHARE * _to_nearest(start)) & (off > PREDICTED_SHARE * moved)
    met = _to_nearest(x) < SAME_POINT * (1 + np.linalg.norm(x, axis=1))
    was, is_ = ((each.imag != 0).any(axis=1) for each in (start, x))
    real = np.linalg.norm(x.imag, axis=1) < REAL_TOLERANCE * (1 + np.linalg.norm(x, axis=1))
    if (astray | met | (real & was) | (is_ & ~was)).any():
        return None
    return np.asarray(x * unit)


def _to_nearest(points: ComplexArray) -> FloatArray:
    """How far (k,) points (k, 4) are from the nearest other one."""
    gap = points[:, None] - points
    apart = np.sqrt((gap.real**2 + gap.imag**2).sum(axis=-1))
    np.fill_diagonal(apart, np.inf)
    return np.asarray(apart.min(axis=1, initial=np.inf))
