"""The paper's method: a pencil of quadrics fitted by SVD, Eqs. (14) to (18).

The rows of the design matrix are the monomials of Eq. (13) at the image points of the poses.
The right singular vectors of its two smallest singular values span the pencil

    p(theta) = cos(theta) v1 + sin(theta) v2,                                      (16)

and its dyads are where the two conditions of Eq. (17) are best fulfilled, the minima of

    E(theta) = g1(p)² + g2(p)².                                                    (18)

Both conditions are quadratic in p, so with psi = 2 theta the point g = g1 + i g2 runs once
around an ellipse, and sqrt(E) is its distance from zero: the stationary points of E are the
feet of the normals of an ellipse that pass through one point.  They are the roots of a
quartic, at most four, at most two of them minima, and `_normal_feet` gives them in closed
form, each by its role.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR, refitted_circles
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

MIN_POSES = 6  # of a fit; the quadrics through fewer are more than a pencil
BLOCK_ROWS = 1024  # reduced at a time; few enough that BLAS starts no threads for them
MAX_CORRECTION = 1e-3  # radians; a longer Newton step on a foot does not remove rounding


@final
@dataclass(frozen=True, slots=True, eq=False)
class Pencil:
    """A pencil fitted to poses, and all that the fit learnt.

    frames: where it was fitted; coefficients below are of manifolds in those frames.
    singular_values: (*, 8), ascending, as the paper prints them.
    vectors: (*, 8, 8), the right singular vectors in the same order: v1 is vectors[..., 0, :].
    theta: (*, 4), the stationary points of E: its least minimum, its other minimum, its other
        maximum, its greatest maximum, in radians modulo pi; the middle two are nan where E has
        one minimum only.
    error: (*, 4), E there.
    coefficients: (*, 2, 8), the manifolds at the two minima; nan where there is no second one.
    dyads: (*, 2), the two minima as RR dyads in the task's own frames, the radius refitted
        to the poses; nan where there is no second minimum.
    rms_error, max_error: (*, 2), the distance of the moving pivot from its circle over the
        poses, in the task's unit.
    """

    frames: CanonicalFrames
    singular_values: FloatArray
    vectors: FloatArray
    theta: FloatArray
    error: FloatArray
    coefficients: FloatArray
    dyads: RR
    rms_error: FloatArray
    max_error: FloatArray

    @property
    def noise(self) -> FloatArray:
        """The greater singular value of the pencil (*,): zero for an exact motion."""
        return self.singular_values[..., 1]

    @property
    def gap(self) -> FloatArray:
        """The least singular value outside the pencil (*,): zero where more quadrics fit."""
        return self.singular_values[..., 2]

    def at(self, theta: FloatArray) -> FloatArray:
        """The quadrics p(theta), Eq. (16): (*, k) angles to (*, k, 8) coefficients.

        Formula `pencil` of the theory.
        """
        t = np.asarray(theta, dtype=np.float64)[..., None]
        return np.cos(t) * self.vectors[..., None, 0, :] + np.sin(t) * self.vectors[..., None, 1, :]


def fit_pencil(
    poses: Displacement, weights: FloatArray | None = None, *, normalise: bool = True
) -> Pencil:
    """The pencil of quadrics through or near poses, and its two dyads: the paper's method.

    Leading axes are tasks: 100,000 are one call.

    Formula `pencil` of the theory.

    Parameters
    ----------
    poses : Displacement, (*, N)
        N >= 6 poses.
    weights : array, (*, N), optional
        A row of the design matrix counts by the root of its weight.
    normalise : bool, default True
        Fit in canonical frames (see `canonical_frames`), so that the dyads do not depend on the
        frames and the unit of the poses; False fits the numbers as they come, as the paper does.

    Returns
    -------
    Pencil
        The pencil, its stationary points and its dyads, with errors.

    Raises
    ------
    InputError
        E121 (fewer than 6 poses), E103 (a number that is not finite).

    Notes
    -----
    Eqs. (14) to (18) of Ge et al. 2012.

    Examples
    --------
    >>> t = np.linspace(0, 3, 7)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> fit = fit_pencil(poses)
    >>> float(fit.dyads.radius[0].round(6)), float(fit.rms_error[0].round(6))
    (1.0, 0.0)
    """
    count = poses.shape[-1] if poses.shape else 0
    if count < MIN_POSES:
        raise InputError(
            "E121",
            f"a pencil needs at least {MIN_POSES} poses, not {count}",
            why="the quadrics through five poses or fewer are more than a pencil",
            help="use the exact method for 3, 4 or 5 poses, or give more poses",
        )
    poses.require_finite()
    if normalise:
        frames, seen = CanonicalFrames.of(poses, weights)
        metric = constraint_manifold.INVARIANT
    else:
        frames, seen = CanonicalFrames.identity(poses.shape[:-1]), poses
        metric = np.ones(8)
    design = _design(seen, weights, metric)
    _, descending, v = np.linalg.svd(design, full_matrices=False)
    vectors = v[..., ::-1, :] * metric
    theta = stationary_angles(vectors[..., 0, :], vectors[..., 1, :])
    p = (
        np.cos(theta)[..., None] * vectors[..., None, 0, :]
        + np.sin(theta)[..., None] * vectors[..., None, 1, :]
    )
    error = (constraint_manifold.conditions(p) ** 2).sum(axis=-1)
    dyads, rms_error, max_error = refitted_circles(p[..., :2, :], seen, weights)
    return Pencil(
        frames,
        descending[..., ::-1],
        vectors,
        theta,
        error,
        p[..., :2, :],
        frames.circle_from_canonical(dyads),
        rms_error * frames.length[..., None],
        max_error * frames.length[..., None],
    )


def _design(poses: Displacement, weights: FloatArray | None, metric: FloatArray) -> FloatArray:
    """Eq. (14) with unit image points, or a triangle with the same singular values.

    Many poses are reduced block by block (QR), so that memory and time stay linear in N.
    """
    blocks: list[FloatArray] = []
    for start in range(0, poses.shape[-1], BLOCK_ROWS):
        rows = slice(start, start + BLOCK_ROWS)
        part = Displacement(poses.translation[..., rows, :], poses.angle[..., rows])
        block = constraint_manifold.monomials(part.as_image_point()) * metric
        if weights is not None:
            block *= np.sqrt(weights[..., rows, None])
        blocks.append(block)
        if block.shape[-2] == BLOCK_ROWS:
            blocks = [np.asarray(np.linalg.qr(np.concatenate(blocks, axis=-2), mode="r"))]
    if poses.shape[-1] < 8:  # rows of zeros, so that a thin SVD keeps the null space
        blocks.append(np.zeros((*poses.shape[:-1], 8 - poses.shape[-1], 8)))
    return np.concatenate(blocks, axis=-2)


def stationary_angles(v1: FloatArray, v2: FloatArray) -> FloatArray:
    """The stationary points theta (*, 4) of E on the pencil of v1, v2 (*, 8); see Pencil.

    With w = v1 - i v2, p(theta) = Re(w exp(i theta)), and so
    g = centre + plus exp(i psi) + minus exp(-i psi): an ellipse with the half axes
    |plus| + |minus| and |plus| - |minus|.

    Formulas `pencil-error`, `normal-feet` of the theory.
    """

    def conditions(p: NDArray[Any]) -> NDArray[Any]:
        g = constraint_manifold.conditions(p)
        return g[..., 0] + 1j * g[..., 1]

    w = v1 - 1j * v2
    plus, minus = conditions(w) / 4, conditions(w.conj()) / 4
    centre = (conditions(v1) + conditions(v2)) / 2
    a, b = np.abs(plus) + np.abs(minus), np.abs(plus) - np.abs(minus)
    tilt, start = (np.angle(plus) + np.angle(minus)) / 2, (np.angle(minus) - np.angle(plus)) / 2
    point = -centre * np.exp(-1j * tilt)
    psi = _normal_feet(a, b, point) + start[..., None]
    theta: FloatArray = (psi / 2 + np.pi / 2) % np.pi - np.pi / 2
    return theta


def _normal_feet(a: FloatArray, b: FloatArray, point: NDArray[np.complex128]) -> FloatArray:
    """The feet t (*, 4) of the normals from a point to the ellipse a cos t + i b sin t.

    First the nearest foot, then the other local minimum of the distance, the other local
    maximum, and the farthest foot; the middle two are nan where there are none, which is where
    the point lies outside the evolute.  Half axes a >= |b|, b of either sign.

    The feet fulfil F = k sin t cos t - P sin t + Q cos t = 0 with P = a Re(point),
    Q = b Im(point), k = a² - b²: they are where a hyperbola meets the unit circle.  Mirrored so
    that P, Q >= 0, the pencil of the two conics holds one pair of lines with a negative
    parameter -mu: one line through the nearest and the farthest foot, one through the other two.
    It is the one positive root of mu³ - (k² - P² - Q²) mu / 4 - k P Q / 4 = 0.
    """
    size = a * a + np.abs(a * point)
    size = np.where(size > 0, size, 1.0)
    k = (a * a - b * b) / size
    p, q = a * point.real / size, b * point.imag / size
    mirror_p, mirror_q = p < 0, q < 0
    p, q = np.abs(p), np.abs(q)

    third, half = (k * k - p * p - q * q) / 12, k * p * q / 8
    mu, ratio = _positive_root(third, half, k, p * q / 4)
    # Root-sum terms of the two lines' distances from the centre; ratio is mu / k.
    sp, sq = p + np.hypot(p, 2 * mu), q + np.hypot(q, 2 * mu)
    with np.errstate(divide="ignore", invalid="ignore"):
        through_other = np.hypot(sp, sq) / (2 * k)
        near = 2 * mu * ratio
        through_nearest = np.hypot(
            np.where(sp > 0, near / sp, ratio), np.where(sq > 0, near / sq, ratio)
        )
        other = np.arccos(through_other)  # nan beyond the evolute
    nearest = np.arccos(np.minimum(through_nearest, 1.0))
    to_nearest, to_other = np.arctan2(sp, -sq), np.arctan2(-sq, sp)
    feet = np.stack(
        [to_nearest - nearest, to_other - other, to_other + other, to_nearest + nearest], axis=-1
    )
    # One Newton step on F removes the rounding of the root.
    k, p, q = k[..., None], p[..., None], q[..., None]
    s, c = np.sin(feet), np.cos(feet)
    derivative, value = k * (c * c - s * s) - p * c - q * s, k * s * c - p * s + q * c
    step = np.divide(value, derivative, out=np.zeros_like(feet), where=derivative != 0)
    feet -= np.where(np.abs(step) < MAX_CORRECTION, step, 0.0)
    feet = np.where(mirror_q[..., None], -feet, feet)
    return np.where(mirror_p[..., None], np.pi - feet, feet)


def _positive_root(
    third: FloatArray, half: FloatArray, k: FloatArray, quarter: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The root mu > 0 of mu³ = 3 third mu + 2 half by Cardano's formula, and mu / k."""
    inside = half * half - third**3
    u = np.cbrt(half + np.sqrt(np.maximum(inside, 0.0)))
    with np.errstate(divide="ignore", invalid="ignore"):
        v = np.where(u > 0, third / u, 0.0)
        share = np.where(u > 0, 1 / (u * u - third + v * v), 0.0)
        root = np.sqrt(np.maximum(third, 0.0))
        cosine = np.where(root > 0, half / root**3, 1.0)
        mu3 = 2 * root * np.cos(np.arccos(np.clip(cosine, -1.0, 1.0)) / 3)
        three = inside < 0
        mu = np.where(three, mu3, 2 * half * share)
        ratio = np.where(three, mu3 / k, quarter * share)
    return mu, ratio
