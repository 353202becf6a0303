"""Constraint manifolds: a dyad as a quadric of the image space, Eqs. (6) to (17).

With unit image points the quadratic form of an RR dyad is a quarter of its circle equation,

    Zᵀ C Z = ((X - Xc)² + (Y - Yc)² - r²) / 4,

so the algebraic distance of an image point from the manifold is the circle residual.  The
eight coefficients `p` multiply the monomials of Eq. (13):

    p1 (Z1² + Z2²) + p2 Z3² + p3 Z1 Z3 + p4 Z2 Z3 + p5 Z1 Z4 + p6 Z2 Z4 + p7 Z3 Z4 + p8 Z4².

`p` is homogeneous: any multiple is the same manifold.  Where p1 = 0 the circle has become a
straight line (a prismatic dyad).
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burmester.numerics.arrays import FloatArray

# With the seventh monomial counted by sqrt(2), a rotation of F or M turns the eight of them by an
# orthogonal matrix; coefficients divided by the same numbers go along with it.
INVARIANT: Final = np.array([1, 1, 1, 1, 1, 1, np.sqrt(2), 1])


def monomials(points: ArrayLike) -> FloatArray:
    """The eight monomials of Eq. (13) at image points (*, 4), shape (*, 8).

    A row of Eq. (14), with the homogeneous point in place of the chart Z4 = 1.

    Formula `monomials` of the theory.
    """
    z = np.asarray(points, dtype=np.float64)
    z1, z2, z3, z4 = np.moveaxis(z, -1, 0)
    rows = np.empty((*z.shape[:-1], 8))
    rows[..., 0] = z1 * z1 + z2 * z2
    rows[..., 1] = z3 * z3
    rows[..., 2] = z1 * z3
    rows[..., 3] = z2 * z3
    rows[..., 4] = z1 * z4
    rows[..., 5] = z2 * z4
    rows[..., 6] = z3 * z4
    rows[..., 7] = z4 * z4
    return rows


def matrix(coefficients: ArrayLike) -> FloatArray:
    """The symmetric matrices (*, 4, 4) of Eq. (9): Zᵀ C Z = p · monomials(Z).

    Formula `constraint-manifold` of the theory.
    """
    p = np.asarray(coefficients, dtype=np.float64)
    c = np.zeros((*p.shape[:-1], 4, 4))
    c[..., 0, 0] = c[..., 1, 1] = p[..., 0]
    c[..., 2, 2], c[..., 3, 3] = p[..., 1], p[..., 7]
    for (i, j), k in {(0, 2): 2, (1, 2): 3, (0, 3): 4, (1, 3): 5, (2, 3): 6}.items():
        c[..., i, j] = c[..., j, i] = p[..., k] / 2
    return c


def conditions(coefficients: NDArray[Any]) -> NDArray[Any]:
    """The two relations of Eq. (17), zero where p is a dyad: (*, 8) to (*, 2).

    Real or complex coefficients.  Both are quadratic forms in p.

    Formula `conditions` of the theory.
    """
    p1, p2, p3, p4, p5, p6, p7, p8 = np.moveaxis(coefficients, -1, 0)
    return np.stack(
        [
            p1 * p7 - (p3 * p5 + p4 * p6) / 2,
            p1 * (p2 - p8) - (p3**2 + p4**2 - p5**2 - p6**2) / 4,
        ],
        axis=-1,
    )


def condition_gradients(coefficients: NDArray[Any]) -> NDArray[Any]:
    """The gradients (*, 2, 8) of the two relations of Eq. (17)."""
    p1, p2, p3, p4, p5, p6, p7, p8 = np.moveaxis(coefficients, -1, 0)
    zero = np.zeros_like(p1)
    first = [p7, zero, -p5 / 2, -p6 / 2, -p3 / 2, -p4 / 2, p1, zero]
    second = [p2 - p8, p1, -p3 / 2, -p4 / 2, p5 / 2, p6 / 2, zero, -p1]
    return np.stack([np.stack(first, axis=-1), np.stack(second, axis=-1)], axis=-2)


def coefficients_of_circle(
    fixed_pivot: ArrayLike, moving_pivot: ArrayLike, radius: ArrayLike
) -> FloatArray:
    """RR: the moving pivot (*, 2) of M stays on a circle of F; Eqs. (6) and (7), p1 = 1.

    Formula `constraint-manifold` of the theory.
    """
    fixed, moving = np.asarray(fixed_pivot, np.float64), np.asarray(moving_pivot, np.float64)
    xc, yc, x, y = fixed[..., 0], fixed[..., 1], moving[..., 0], moving[..., 1]
    s1, s2 = -(x + xc) / 2, -(y + yc) / 2
    t1, t2 = -(y - yc) / 2, (x - xc) / 2
    c = np.asarray(radius, dtype=np.float64) ** 2 / 4
    p2 = s1**2 + s2**2 - c
    p = np.empty((*p2.shape, 8))
    p[..., 0], p[..., 1] = 1.0, p2
    p[..., 2], p[..., 3] = 2 * s1, 2 * s2
    p[..., 4], p[..., 5] = 2 * t1, 2 * t2
    p[..., 6], p[..., 7] = 2 * (s1 * t1 + s2 * t2), t1**2 + t2**2 - c
    return p


def circle(coefficients: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Fixed pivot (*, 2), moving pivot (*, 2) and the two squared radii (*, 2) of p.

    The squared radius comes from p2 and again from p8; the two agree only where p fulfils
    Eq. (17).  The paper takes the mean of the two radii (its Table 8).  Where p1 = 0 the
    result is infinite or nan.

    Formula `pivots-of-manifold` of the theory.
    """
    p = np.asarray(coefficients, dtype=np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):
        _, p2, p3, p4, p5, p6, _, p8 = np.moveaxis(p / p[..., :1], -1, 0)
        s1, s2, t1, t2 = p3 / 2, p4 / 2, p5 / 2, p6 / 2
        fixed_pivot = np.stack([-s1 - t2, t1 - s2], axis=-1)
        moving_pivot = np.stack([t2 - s1, -s2 - t1], axis=-1)
        squared = np.stack([4 * (s1**2 + s2**2 - p2), 4 * (t1**2 + t2**2 - p8)], axis=-1)
    return fixed_pivot, moving_pivot, squared


def coefficients_of_fixed_line(
    normal_angle: ArrayLike, offset: ArrayLike, moving_pivot: ArrayLike
) -> FloatArray:
    """PR: the moving pivot (*, 2) of M stays on the line n · X = offset of F.

    With unit image points Zᵀ C Z is the signed distance n · X - offset; p1 = 0.

    Formula `slider` of the theory.
    """
    angle = np.asarray(normal_angle, dtype=np.float64)
    h = np.asarray(offset, dtype=np.float64)
    x, y = np.moveaxis(np.asarray(moving_pivot, dtype=np.float64), -1, 0)
    n1, n2 = np.cos(angle), np.sin(angle)
    along, across = n1 * x + n2 * y, n2 * x - n1 * y  # n · (R m) = along cos + across sin
    p = [
        np.zeros_like(along + h),
        -along - h,
        2 * n1,
        2 * n2,
        -2 * n2,
        2 * n1,
        2 * across,
        along - h,
    ]
    return np.stack(np.broadcast_arrays(*p), axis=-1)


def coefficients_of_moving_line(
    fixed_pivot: ArrayLike, normal_angle: ArrayLike, offset: ArrayLike
) -> FloatArray:
    """RP: the fixed pivot (*, 2) of F stays on the line n · x = offset of M.

    With unit image points Zᵀ C Z is the signed distance n · x - offset; p1 = 0.

    Formula `slot` of the theory.
    """
    p = coefficients_of_fixed_line(normal_angle, offset, fixed_pivot)
    # The inverse displacement has the image point (-Z1, -Z2, -Z3, Z4).
    p[..., 4:7] *= -1
    return p


def coefficients_of_rotation(angle: ArrayLike) -> FloatArray:
    """PP: the rotation stays `angle`; the doubled plane (Z3 cos - Z4 sin)² = 0, half angle.

    Formula `no-turning` of the theory.
    """
    half = np.asarray(angle, dtype=np.float64) / 2
    s, c = np.sin(half), np.cos(half)
    zero = np.zeros_like(half)
    return np.stack([zero, c * c, zero, zero, zero, zero, -2 * s * c, s * s], axis=-1)


def prismatic_parts(coefficients: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """The parts (*, 2), (*, 2) of p that belong to a line fixed in F, and fixed in M.

    Where p1 = 0, the conditions (17) leave one of the two zero: PR has the second zero and
    its line's normal along the first; RP the other way round; PP has both zero.  They are
    the pivots too, up to a factor, in a basis in which pivots are linear: moving by
    (second) and fixed by (first) (Ge, Purwar, Zhao and Deshpande 2017).
    """
    p = np.asarray(coefficients, dtype=np.float64)
    p3, p4, p5, p6 = np.moveaxis(p[..., 2:6], -1, 0)
    fixed = np.stack([p3 + p6, p4 - p5], axis=-1) / 4
    moving = np.stack([p3 - p6, p4 + p5], axis=-1) / 4
    return fixed, moving


def size(coefficients: ArrayLike) -> FloatArray:
    """The norm (*,) of p (*, 8) that rotations of F and M leave as it is.

    Formula `invariant-size` of the theory.
    """
    return np.asarray(np.linalg.norm(np.asarray(coefficients) / INVARIANT, axis=-1))
