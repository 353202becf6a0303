"""Five, four and three poses: Burmester's problem by the null space of the design matrix.

Every quadric through N < 6 image points lies in the null space of their N x 8 design matrix;
its dyads are the points there that fulfil the two conditions of Eq. (17).

Five poses: two conics in a projective plane, four intersections: all dyads, at most four
real ones.  Four poses: a curve of dyads (`burmester_curve`).  Three poses: every
moving pivot has one fixed pivot.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR, refitted_circles
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.linear_algebra import matvec, solve_where_regular

REAL_TOLERANCE = 1e-7  # of a unit vector; a polished root with less imaginary part is real
NEWTON_STEPS = 12  # on the poses' own equations, at most; roots that are close together take more
LAST_STEP = 1e-10  # of a unit vector; the error after a step as short as this is its square
MAX_NEWTON_STEP = 0.1  # of a unit vector; a longer step has lost its root
SHARPENING_STEPS = 20  # in the longest floating point, at most
LAST_SHARPENING = 1e-12  # of a dyad's size; after a step as short as this nothing is left to gain
MAX_SHARPENING = 1e-3  # of a dyad's size; a longer step does not remove rounding
SLIDER_LENGTH = 1e6  # characteristic lengths; a longer link is a slider up to rounding
ISOLATED_TOLERANCE = 1e-10  # singular value of two unit conics; below, they share a curve

# Monomials of degree 2 and 3 in three unknowns, and where a product of them lands.
_QUADRATIC = list(combinations_with_replacement(range(3), 2))
_CUBIC = list(combinations_with_replacement(range(3), 3))
_CUBIC_AT: dict[tuple[int, ...], int] = {cubic: at for at, cubic in enumerate(_CUBIC)}
_TIMES = np.array([[_CUBIC_AT[tuple(sorted((*q, k)))] for q in _QUADRATIC] for k in range(3)])
# A generic chart of the plane: no intersection of two conics of a task lies on its line at
# infinity but by bad luck.
_CHART = np.array([[0.46, 0.61, 0.65], [0.83, -0.52, -0.19], [0.28, 0.55, -0.78]])


@final
@dataclass(frozen=True, slots=True, eq=False)
class FivePoseDyads:
    """The four dyads of five poses, real or not.

    frames: where they were found; coefficients are of manifolds in those frames.
    singular_values: (*, 5) of the design matrix, ascending; the first is zero where the five
        poses are not five different ones, and then there are more dyads than these.
    roots: (*, 4, 8), complex coefficients of unit norm, the largest of each real and positive.
    real: (*, 4), which are real; complex ones come in conjugate pairs.
    coefficients: (*, 4, 8), the real ones; nan where not real.
    residual: (*, 4), of the linear equations and the two conditions at unit coefficients.
    separation: (*, 4), distance to the nearest other root as points of the projective space;
        zero is a double root.
    determined: (*,), False where the two conics share a curve and so the dyads are
        infinitely many; then the four are some of them at best.
    dyads: (*, 4), as RR dyads in the task's own frames; nan where not real, and with a radius
        beyond all measure where the dyad is a slider (p1 = 0).
    rms_error, max_error: (*, 4), the distance of the moving pivot from its circle over the
        poses, in the task's unit: rounding, where the dyad is not a slider.
    """

    frames: CanonicalFrames
    singular_values: FloatArray
    roots: ComplexArray
    real: NDArray[np.bool_]
    coefficients: FloatArray
    residual: FloatArray
    separation: FloatArray
    determined: NDArray[np.bool_]
    dyads: RR
    rms_error: FloatArray
    max_error: FloatArray

    @property
    def noise(self) -> FloatArray:
        """Zero (*,): five poses are met exactly."""
        return np.zeros(self.determined.shape)

    @property
    def gap(self) -> FloatArray:
        """The least singular value (*,); zero where the dyads are infinitely many."""
        return np.where(self.determined, self.singular_values[..., 0], 0.0)


def dyads_of_five(poses: Displacement) -> FivePoseDyads:
    """All dyads that pass through five poses exactly: at most four are real.

    Formula `five-poses` of the theory.

    Parameters
    ----------
    poses : Displacement, (*, 5)
        Leading axes are tasks.

    Returns
    -------
    FivePoseDyads
        The four dyads of each task, real or complex, with what is known of their accuracy.

    Raises
    ------
    InputError
        E121 (another number of poses), E103 (a number that is not finite).

    Notes
    -----
    The null space of the design matrix and Eq. (17) of Ge et al. 2012; the intersection of the two
    conics is read off the null space of their degree-3 Macaulay matrix by one 4 x 4 eigenproblem,
    with no start values.

    Examples
    --------
    >>> t = np.linspace(0, 2, 5)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> four = dyads_of_five(poses)
    >>> int(four.real.sum())
    2
    >>> sorted(four.dyads.radius[four.real].round(4).tolist())
    [1.0, 1.8693]
    """
    require_count(poses, 5)
    frames, seen = CanonicalFrames.of(poses)
    design = constraint_manifold.monomials(seen.as_image_point())
    q, triangle = np.linalg.qr(np.swapaxes(design, -1, -2), mode="complete")
    singular_values = np.linalg.svd(triangle[..., :5, :], compute_uv=False)
    basis = np.swapaxes(q[..., 5:], -1, -2)
    points, determined = conic_intersections(_conics(basis))
    p = points @ basis
    p = _polish(p / np.linalg.norm(p, axis=-1, keepdims=True), design)
    largest = np.take_along_axis(p, np.abs(p).argmax(axis=-1)[..., None], axis=-1)
    p *= largest.conj() / np.abs(largest)
    real = np.linalg.norm(p.imag, axis=-1) < REAL_TOLERANCE
    p = np.where(real[..., None], p.real, p)
    residual = np.linalg.norm(_equations(p, design), axis=-1)
    overlap = np.abs(p.conj() @ np.swapaxes(p, -1, -2)) * (1 - np.eye(4))
    separation = np.sqrt(np.maximum(1 - overlap.max(axis=-1) ** 2, 0))
    coefficients = np.where(real[..., None], p.real, np.nan)
    circles, rms_error, max_error = refitted_circles(coefficients, seen)
    length = frames.length[..., None]
    dyads = _sharpened(frames.circle_from_canonical(circles), poses, length)
    with np.errstate(invalid="ignore", over="ignore"):
        distance = np.abs(dyads[..., None].residual(poses[..., None, :]))
    rms_error = np.minimum(rms_error * length, np.sqrt((distance**2).mean(axis=-1)))
    max_error = np.minimum(max_error * length, distance.max(axis=-1))
    return FivePoseDyads(
        frames,
        singular_values[..., ::-1],
        p,
        real,
        coefficients,
        residual,
        separation,
        determined,
        dyads,
        rms_error,
        max_error,
    )


def require_count(poses: Displacement, count: int) -> None:
    """Refuse poses (*, N) with another N (InputError E121) or not finite (E103)."""
    got = poses.shape[-1] if poses.shape else 0
    if got != count:
        raise InputError(
            "E121",
            f"{count} poses are needed here, not {got}",
            help=f"give {count} poses; fit_pencil takes 6 or more",
        )
    poses.require_finite()


def _conics(basis: FloatArray) -> FloatArray:
    """The two conditions on the plane of a basis (*, 3, 8): conics (*, 2, 6), by polarisation."""
    square = constraint_manifold.conditions(basis)
    columns = [
        square[..., i, :]
        if i == j
        else constraint_manifold.conditions(basis[..., i, :] + basis[..., j, :])
        - square[..., i, :]
        - square[..., j, :]
        for i, j in _QUADRATIC
    ]
    conics = np.stack(columns, axis=-1)
    unit: FloatArray = conics / np.linalg.norm(conics, axis=-1, keepdims=True)
    return unit


def conic_intersections(conics: FloatArray) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """The four common points (*, 4, 3) of two conics (*, 2, 6), and whether they are isolated.

    Each conic times each unknown is a row of a 6 x 10 matrix on the cubic monomials; its null
    space is spanned by the cubic monomials of the four points.  The quotient of two linear
    forms acts on it as a 4 x 4 matrix whose eigenvectors are the points.
    """
    macaulay = np.zeros((*conics.shape[:-2], 3, 2, 10))
    for k in range(3):
        macaulay[..., k, :, _TIMES[k]] = np.moveaxis(conics, -1, 0)
    macaulay = macaulay.reshape(*conics.shape[:-2], 6, 10)
    q, triangle = np.linalg.qr(np.swapaxes(macaulay, -1, -2), mode="complete")
    null = q[..., 6:]
    times = np.stack([null[..., _TIMES[k], :] for k in range(3)])
    first, second = (np.tensordot(_CHART[i], times, axes=1) for i in range(2))
    _, eigenvectors = np.linalg.eig(np.linalg.pinv(first) @ second)
    # First form times quadratic monomials of each point: a symmetric matrix x xᵀ.
    rows = np.swapaxes(first.astype(complex) @ eigenvectors, -1, -2)
    outer = np.empty((*rows.shape[:-1], 3, 3), dtype=complex)
    for at, (i, j) in enumerate(_QUADRATIC):
        outer[..., i, j] = outer[..., j, i] = rows[..., at]
    best = np.abs(np.diagonal(outer, axis1=-2, axis2=-1)).argmax(axis=-1)
    points = np.take_along_axis(outer, best[..., None, None], axis=-1)[..., 0]
    unit = points / np.linalg.norm(points, axis=-1, keepdims=True)
    return unit, _isolated(triangle[..., :6, :])


def _isolated(triangle: FloatArray) -> NDArray[np.bool_]:
    """Whether the least singular values of triangles (*, 6, 6) are no rounding.

    Their columns are unit vectors, so that the squares of the six add up to 6, and the product of
    the other five is (6/5)^(5/2) at most.  Six make up the determinant: few need be computed.
    """
    bound = (5 / 6) ** (5 / 2) * np.abs(np.diagonal(triangle, axis1=-2, axis2=-1).prod(axis=-1))
    isolated = np.asarray(bound > 2 * ISOLATED_TOLERANCE)
    if not isolated.all():
        least = np.linalg.svd(triangle[~isolated], compute_uv=False)[..., 5]
        isolated[~isolated] = least > ISOLATED_TOLERANCE
    return isolated


def _equations(p: ComplexArray, design: FloatArray) -> ComplexArray:
    """The five linear equations and the two conditions at p (*, 4, 8): (*, 4, 7)."""
    linear = p @ np.swapaxes(design, -1, -2)
    return np.concatenate([linear, constraint_manifold.conditions(p)], axis=-1)


def _polish(p: ComplexArray, design: FloatArray) -> ComplexArray:
    """Newton's method on the poses' own equations, at p (*, 4, 8), the norm of p being kept."""
    lead, p = p.shape[:-2], p.reshape(-1, *p.shape[-2:]).copy()
    design = design.reshape(-1, *design.shape[-2:])
    run = np.arange(len(p))  # the tasks that still gain
    for _ in range(NEWTON_STEPS):
        here = p[run]
        jacobian, values = np.empty((*here.shape, 8), dtype=complex), np.zeros_like(here)
        jacobian[..., :5, :] = design[run, None]
        jacobian[..., 5:7, :] = constraint_manifold.condition_gradients(here)
        jacobian[..., 7, :] = here.conj()
        values[..., :7] = _equations(here, design[run])
        step, regular = solve_where_regular(jacobian, values)
        if len(at := np.flatnonzero(~regular.all(axis=-1))):  # an exact double root has no step
            step[at] = matvec(np.linalg.pinv(jacobian[at]), values[at])
        short = np.linalg.norm(step, axis=-1) < MAX_NEWTON_STEP
        sound = np.isfinite(step).all(axis=-1) & short
        here = here - np.where(sound[..., None], step, 0.0)
        p[run] = here / np.linalg.norm(here, axis=-1, keepdims=True)
        run = run[(sound & (np.linalg.norm(step, axis=-1) > LAST_STEP)).any(axis=-1)]
        if not len(run):
            break
    return p.reshape(*lead, *p.shape[-2:])


def _sharpened(dyads: RR, poses: Displacement, length: FloatArray) -> RR:
    """Dyads (*, 4) with those digits restored that rounding took in the fit, where possible.

    Newton steps on the circle equations of the poses (*, 5) as they were given, with
    residuals in the machine's longest floating point (80 bits on x86, else 64: no loss).
    Left as they are: sliders (`length` is (*, 1), see `canonical_frames`), and double roots, which
    have no more digits to gain.
    """
    long, lead = np.longdouble, dyads.radius.shape
    given = np.concatenate([dyads.fixed_pivot, dyads.moving_pivot], axis=-1)
    # Rows: the dyads that are looked at, each with its poses (k, 5).
    size = np.where(dyads.radius < SLIDER_LENGTH * length, np.abs(given).max(axis=-1) + length, 0.0)
    best, radius, size = given.reshape(-1, 4).copy(), dyads.radius.ravel().copy(), size.ravel()
    run = np.flatnonzero(size > 0)
    task = run // 4
    d1, d2 = (poses.translation[..., k].reshape(-1, 5)[task].astype(long) for k in (0, 1))
    angle = poses.angle.astype(long).reshape(-1, 5)
    c, s = np.cos(angle)[task], np.sin(angle)[task]
    x, least = best[run].astype(long), np.full(len(run), np.inf)
    ends = failed = np.zeros(len(run), dtype=bool)
    for _ in range(SHARPENING_STEPS):
        c1, c2, m1, m2 = x.T[..., None]
        a1, a2 = c * m1 - s * m2 + (d1 - c1), s * m1 + c * m2 + (d2 - c2)
        squared = a1 * a1 + a2 * a2
        mean = squared.mean(axis=-1)
        residual = np.asarray(squared - mean[:, None], dtype=np.float64)
        worst = np.abs(residual).max(axis=-1)
        gains = worst < least
        best[run[gains]], radius[run[gains]] = x[gains], np.sqrt(mean[gains])
        # Near a double root the square of a step may be more than the residual was; the next step
        # puts that right.
        on = np.flatnonzero((gains | ~failed) & ~ends)
        x1, x2, cos, sin = (np.asarray(each[on], dtype=np.float64) for each in (a1, a2, c, s))
        jacobian = np.full((len(on), 5, 5), -1.0)
        jacobian[..., 0], jacobian[..., 1] = -2 * x1, -2 * x2
        jacobian[..., 2], jacobian[..., 3] = 2 * (cos * x1 + sin * x2), 2 * (cos * x2 - sin * x1)
        step, regular = solve_where_regular(jacobian, residual[on])
        on = on[regular]
        if not len(on):
            break
        step = step[regular, :4]
        run, d1, d2, c, s = run[on], d1[on], d2[on], c[on], s[on]
        least, failed = np.minimum(worst, least)[on], ~gains[on]
        length = np.abs(step).max(axis=-1) / size[run]
        small, ends = length < MAX_SHARPENING, length < LAST_SHARPENING
        x = x[on] - np.where(small[:, None], step, 0.0)
    pivots = best.reshape(*lead, 4)
    return RR(pivots[..., :2], pivots[..., 2:], radius.reshape(lead))
