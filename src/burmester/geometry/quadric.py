"""General quadrics of the image space: what kind one is, and the one nearest to points.

A quadric has ten coefficients, Eq. (11),

    q1 Z1² + q2 Z2² + q3 Z3² + q4 Z1 Z2 + q5 Z1 Z3 + q6 Z2 Z3 + q7 Z1 Z4 + q8 Z2 Z4
    + q9 Z3 Z4 + q10 Z4² = 0;

with q1 = q2 and q4 = 0, Eq. (12), they are the eight of `constraint_manifold`.  Its kind is
the one seen in the chart Z4 = 1, where the plane at infinity holds the half turns.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burmester.errors import InputError
from burmester.numerics.arrays import FloatArray

TOLERANCE = 1e-10  # what counts as zero next to 1: rounding, with room for a few lost digits

# The monomial q_k is Z_i Z_j, in the order of Eq. (11).
_I = np.array([0, 1, 2, 0, 0, 1, 0, 1, 2, 3])
_J = np.array([0, 1, 2, 1, 2, 2, 3, 3, 3, 3])


class QuadricKind(enum.StrEnum):
    """Every real quadric of an affine space, in words."""

    ELLIPSOID = "ellipsoid"
    IMAGINARY_ELLIPSOID = "imaginary ellipsoid"
    ONE_SHEET = "hyperboloid of one sheet"
    TWO_SHEETS = "hyperboloid of two sheets"
    CONE = "cone"
    IMAGINARY_CONE = "imaginary cone (a point)"
    ELLIPTIC_PARABOLOID = "elliptic paraboloid"
    HYPERBOLIC_PARABOLOID = "hyperbolic paraboloid"
    ELLIPTIC_CYLINDER = "elliptic cylinder"
    IMAGINARY_CYLINDER = "imaginary elliptic cylinder"
    HYPERBOLIC_CYLINDER = "hyperbolic cylinder"
    PARABOLIC_CYLINDER = "parabolic cylinder"
    INTERSECTING_PLANES = "two intersecting planes"
    IMAGINARY_INTERSECTING_PLANES = "imaginary intersecting planes (a line)"
    PARALLEL_PLANES = "two parallel planes"
    IMAGINARY_PARALLEL_PLANES = "imaginary parallel planes"
    DOUBLED_PLANE = "one doubled plane"
    ONE_PLANE = "one plane (and the plane at infinity)"
    DOUBLED_INFINITY = "the plane at infinity doubled"
    WHOLE_SPACE = "the whole space"


_K = QuadricKind
# Numbers of positive and negative eigenvalues, up to a common sign: first of the upper left
# 3 x 3 block, which is the section with the plane at infinity, then of the whole matrix.
# By Cauchy's interlacing the whole has at most one more of each, so no case is missing.
_OF_INERTIA = {
    (3, 0): {(4, 0): _K.IMAGINARY_ELLIPSOID, (3, 1): _K.ELLIPSOID, (3, 0): _K.IMAGINARY_CONE},
    (2, 1): {(3, 1): _K.TWO_SHEETS, (2, 2): _K.ONE_SHEET, (2, 1): _K.CONE},
    (2, 0): {
        (3, 1): _K.ELLIPTIC_PARABOLOID,
        (3, 0): _K.IMAGINARY_CYLINDER,
        (2, 1): _K.ELLIPTIC_CYLINDER,
        (2, 0): _K.IMAGINARY_INTERSECTING_PLANES,
    },
    (1, 1): {
        (2, 2): _K.HYPERBOLIC_PARABOLOID,
        (2, 1): _K.HYPERBOLIC_CYLINDER,
        (1, 1): _K.INTERSECTING_PLANES,
    },
    (1, 0): {
        (2, 1): _K.PARABOLIC_CYLINDER,
        (2, 0): _K.IMAGINARY_PARALLEL_PLANES,
        (1, 1): _K.PARALLEL_PLANES,
        (1, 0): _K.DOUBLED_PLANE,
    },
    (0, 0): {(1, 1): _K.ONE_PLANE, (1, 0): _K.DOUBLED_INFINITY, (0, 0): _K.WHOLE_SPACE},
}


def _kinds() -> NDArray[np.str_]:
    """The table with both signs, as an array to index by the four numbers."""
    kinds = np.full((4, 4, 5, 5), "", dtype=f"<U{max(map(len, QuadricKind))}")
    for (p, n), row in _OF_INERTIA.items():
        for (whole_p, whole_n), kind in row.items():
            kinds[p, n, whole_p, whole_n] = kinds[n, p, whole_n, whole_p] = kind.value
    return kinds


_KINDS = _kinds()


def monomials(points: ArrayLike) -> FloatArray:
    """The ten monomials of Eq. (11) at image points (*, 4), shape (*, 10)."""
    z = np.asarray(points, dtype=np.float64)
    return np.asarray(z[..., _I] * z[..., _J])


def matrix(coefficients: ArrayLike) -> FloatArray:
    """The symmetric matrices (*, 4, 4) of q (*, 10): Zᵀ C Z = q · monomials(Z)."""
    q = np.asarray(coefficients, dtype=np.float64)
    c = np.empty((*q.shape[:-1], 4, 4))
    c[..., _I, _J] = c[..., _J, _I] = q * np.where(_I == _J, 1.0, 0.5)
    return c


def classify(
    matrix: ArrayLike, *, length: ArrayLike | None = None, tolerance: float = TOLERANCE
) -> NDArray[np.str_]:
    """The kind of each quadric Zᵀ C Z = 0 in the chart Z4 = 1: (*, 4, 4) to (*,).

    The strings are the values of `QuadricKind` and compare equal to its members.
    length: (*,) or None, the length that is measured as 1, best the size of the data; None
        takes the one that makes the coefficients of lengths squared and of lengths to the
        power of zero equally large, so that the answer does not depend on the unit.
    tolerance: eigenvalues below this share of the largest count as zero.  A heuristic: each
        degenerate kind is a border between others, and only the data's precision can say how
        near to a border is on it.  For noisy data give their relative noise.
    Raises InputError E103 (a number that is not finite).
    Source: Sylvester's law of inertia for the matrix and its upper left 3 x 3 block.
    """
    c = np.asarray(matrix, dtype=np.float64)
    if c.shape[-2:] != (4, 4):
        raise ValueError(f"quadrics need shape (*, 4, 4), not {c.shape}")
    _require_finite(c, c.shape[:-2], "matrix")
    c = c / _above_zero(np.abs(c).max(axis=(-2, -1), keepdims=True))
    c = (c + np.swapaxes(c, -1, -2)) / 2  # all that a quadratic form sees
    # A unit of length is the one freedom of the image space; angles bring their own.  It is
    # a congruence by diag(s, s, 1, 1): it keeps the inertia, but not what is small.
    s = _own_length(c) if length is None else np.asarray(length, dtype=np.float64)
    scale = np.stack([s, s, np.ones_like(s), np.ones_like(s)], axis=-1)
    c = c * scale[..., :, None] * scale[..., None, :]
    whole, block = np.linalg.eigvalsh(c), np.linalg.eigvalsh(c[..., :3, :3])
    # One threshold for both: counts above it interlace as inertias do.
    zero = tolerance * np.abs(whole).max(axis=-1, keepdims=True)
    p, n = (block > zero).sum(axis=-1), (block < -zero).sum(axis=-1)
    whole_p, whole_n = (whole > zero).sum(axis=-1), (whole < -zero).sum(axis=-1)
    # The clip only acts where rounding has parted two equal eigenvalues at the threshold.
    kinds = _KINDS[p, n, np.clip(whole_p, p, p + 1), np.clip(whole_n, n, n + 1)]
    return np.asarray(kinds, dtype=_KINDS.dtype)


@final
@dataclass(frozen=True, slots=True, eq=False)
class QuadricFit:
    """The quadric nearest to image points, and all that the fit learnt.

    singular_values: (*, 10), ascending, as the paper prints them; those near zero count the
        independent quadrics through all the points.
    vectors: (*, 10, 10), the right singular vectors in the same order, as rows.
    rms: (*,), the root mean square of the algebraic residual Zᵀ C Z of the first of them.
    length: (*,), the size of the points: the root mean square of (Z1, Z2) over (Z3, Z4).
    """

    singular_values: FloatArray
    vectors: FloatArray
    rms: FloatArray
    length: FloatArray

    @property
    def coefficients(self) -> FloatArray:
        """The fitted q (*, 10) of unit norm: the vector of the least singular value."""
        return self.vectors[..., 0, :]

    def matrix(self) -> FloatArray:
        """The fitted quadric's matrix (*, 4, 4)."""
        return matrix(self.coefficients)

    def kind(self, *, tolerance: float = TOLERANCE) -> NDArray[np.str_]:
        """The fitted quadric's kind (*,), lengths measured by the size of the points."""
        return classify(self.matrix(), length=self.length, tolerance=tolerance)


def fit_quadric(points: ArrayLike) -> QuadricFit:
    """The quadric |q| = 1 with the least sum of squared residuals at image points.

    Meant for unit image points: a point of another scale has another weight.  Nine points in
    general position determine a quadric.  Fewer, or points on a curve, leave a null space of
    higher dimension; then the coefficients are any one of it, and fewer than ten points have
    their singular values padded with zeros.  |q| = 1 weighs lengths against angles: for an
    answer that does not depend on the unit, give points in canonical frames.

    Parameters
    ----------
    points : array_like, (*, N, 4)
        N >= 1 image points; leading axes are fits of their own.

    Returns
    -------
    QuadricFit
        The quadric and all singular values.

    Raises
    ------
    InputError
        E121 (no point), E103 (a number that is not finite).

    Notes
    -----
    Eq. (11) of Ge et al. 2012 fitted as in its Sec. 5.1; with ten coefficients, its reference [21].

    Examples
    --------
    >>> t = np.linspace(0, 3, 12)  # the body moves along a line and does not rotate
    >>> fit = fit_quadric(np.stack([t / 2, -t, 0 * t, 1 + 0 * t], axis=-1))
    >>> int((fit.singular_values < 1e-12).sum()), bool(fit.rms < 1e-12)
    (7, True)
    """
    z = np.asarray(points, dtype=np.float64)
    if z.ndim < 2 or z.shape[-1] != 4:
        raise ValueError(f"image points need shape (*, N, 4), not {z.shape}")
    count = z.shape[-2]
    if count < 1:
        raise InputError(
            "E121",
            "a quadric needs at least one image point, not 0",
            why="nine points in general position determine a quadric",
            help="give nine points or more, or fewer to learn the quadrics that they leave open",
        )
    with np.errstate(over="ignore", invalid="ignore"):
        design = monomials(z)
    _require_finite(design, z.shape[:-1], "image point")
    squares = design[..., [0, 1, 2, 9]].sum(axis=-2)
    away, here = squares[..., :2].sum(axis=-1), squares[..., 2:].sum(axis=-1)
    # A triangle with the same singular values: no factor with N rows is ever formed.
    triangle = np.linalg.qr(design, mode="r") if count > 10 else design
    _, descending, vectors = np.linalg.svd(triangle, full_matrices=True)
    singular_values = np.zeros((*z.shape[:-2], 10))
    singular_values[..., 10 - descending.shape[-1] :] = descending[..., ::-1]
    return QuadricFit(
        singular_values,
        vectors[..., ::-1, :],
        singular_values[..., 0] / np.sqrt(count),
        _above_zero(np.sqrt(away / _above_zero(here))),
    )


def _own_length(c: FloatArray) -> FloatArray:
    """The length s (*,) in which diag(s, s, 1, 1) balances c (*, 4, 4); 1 where none does.

    The coefficients of lengths to the power of 2, 1 and 0 are three blocks; s is the slope of
    the straight line nearest to the logarithms of the norms of those that are not zero.
    """
    second, first, zeroth = (
        np.linalg.norm(block, axis=(-2, -1))
        for block in (c[..., :2, :2], c[..., :2, 2:], c[..., 2:, 2:])
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        s = np.sqrt(zeroth) / np.sqrt(second)
        s = np.where(second == 0, zeroth / first, np.where(zeroth == 0, first / second, s))
    return np.where(np.isfinite(s) & (s > 0), s, 1.0)


def _above_zero(values: FloatArray) -> FloatArray:
    """The values, with 1 for 0: sizes to divide by."""
    return np.where(values > 0, values, 1.0)


def _require_finite(values: FloatArray, shape: tuple[int, ...], name: str) -> None:
    """Refuse numbers that are not finite, which hang some SVD codes; raises InputError E103."""
    good = np.isfinite(values).all(axis=tuple(range(len(shape), values.ndim)))
    if not good.all():
        item = f"{name} {', '.join(str(i + 1) for i in np.argwhere(~good)[0])}".rstrip()
        raise InputError(
            "E103",
            f"{item} has a value that is not a finite number, or too large to be squared",
            help="give finite numbers, or leave it out",
        )
