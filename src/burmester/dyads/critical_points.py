"""Every locally best RR dyad of a task, by linear algebra.

With the squared distance of the moving pivot from the fixed one as a function of both,

    f_i = |R_i m + d_i - c|² = |m|² + |c|² + |d_i|² - 2 c · d_i + 2 d_i · R_i m - 2 c · R_i m,

the circle residual is f_i minus its mean: the best r² for given pivots.  It is linear in the
seven numbers v = (1, c, m, c · m, c x m), so the sum of its squares is F = |T v|² with a
triangle T, 7 x 7, and the critical points of F are the common zeros of its four derivatives.  For
generic poses there are 25 of them.

All of them come from one eigenproblem (`macaulay`), with no start value; Newton's method on F
takes off the rounding.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.macaulay import CHARTS, ComplexArray, eigen_points
from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["COUNT", "CriticalDyads", "critical_dyads", "residual_rows"]

COUNT = 25  # finite critical points of generic poses (a Groebner basis over a finite field)
NEWTON_STEPS = 40  # more than 5 only towards points that lie close together
BALANCE = 0.4  # of pivots against products of them; tried, and not delicate
FAR = 1e3  # characteristic lengths; a point beyond that Newton's method cannot hold is at infinity
SINGULAR = 1e-14  # share of the Hessian's greatest singular value that rounding may be
NOTHING = 1e-28  # the square of what rounding leaves of a residual, as a share of its terms
SETTLED = 1e-8  # relative steps of Newton's method below this are rounding once they stop shrinking
SAME = 1e-6  # relative distance below which two critical points are one


@final
@dataclass(frozen=True, slots=True, eq=False)
class CriticalDyads:
    """All critical points of the squared circle residual of a task, real or not.

    frames: where they were found, (*,).
    points: (*, 25, 4), complex c1, c2, m1, m2 in those frames, real minima first, by rising
        residual, then the other real ones, then the rest; nan beyond `found`.  Of residuals that
        are rounding alone, the nearer points come first.
    found: (*,), how many were found that are finite and simple, each once; 25 are all.
    at_infinity: (*,), how many more have a pivot at infinity, or beyond telling: three for a
        slider that meets the poses exactly.  What is then missing of 25 is multiple, on a curve of
        critical points, or lost; the poses are special, or within rounding of such ones.
    charts: (*,), how many charts it took: 1 but for hard tasks.
    health: (*,), the least relative pivot of the eigenproblem's 125 rows; rounding is magnified
        by its inverse, and below some 1e-12 points are lost.
    real, minimum: (*, 25), which are real, and which of those are local minima.
    dyads: (*, 25), as RR dyads in the task's own frames; nan where not real.  r² is the mean of
        the squared distances, the best for these pivots and never negative.
    residual: (*, 25), rms of the circle residual |R m + d - c|² - r², in the task's unit squared.
    """

    frames: CanonicalFrames
    points: ComplexArray
    found: NDArray[np.int_]
    at_infinity: NDArray[np.int_]
    charts: NDArray[np.int_]
    health: FloatArray
    real: NDArray[np.bool_]
    minimum: NDArray[np.bool_]
    dyads: RR
    residual: FloatArray


def critical_dyads(poses: Displacement, weights: FloatArray | None = None) -> CriticalDyads:
    """Every critical point of the weighted sum of squared circle residuals over RR dyads.

    poses: (*, N), N >= 5; weights: (*, N) or None.  Leading axes are tasks.
    Raises InputError E121 (fewer than 5 poses) and E103 (a number that is not finite).
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
    triangle = _triangle(seen, weights)
    points = np.full((*lead, COUNT, 4), np.nan + 0j)
    found, far, charts = (np.zeros(lead, dtype=int) for _ in range(3))
    health, real = np.zeros(lead), np.zeros((*lead, COUNT), dtype=bool)
    minimum = np.zeros((*lead, COUNT), dtype=bool)
    # Matrices this small are slower with several BLAS threads, much so on a busy machine.
    with _blas().limit(limits=1, user_api="blas"):
        results = {task: _all_points(triangle[task]) for task in np.ndindex(lead)}
    for task, result in results.items():
        n = len(result.points)
        points[task][:n], found[task], charts[task] = result.points, n, result.charts
        far[task] = result.at_infinity
        health[task], real[task][:n], minimum[task][:n] = result.health, result.real, result.minimum
    x = np.where(real[..., None], points.real, np.nan)
    squared = (_features(x) @ np.swapaxes(triangle, -1, -2)) ** 2
    residual = np.sqrt(squared.sum(axis=-1)) * frames.length[..., None] ** 2
    centred = RR(x[..., :2], x[..., 2:], np.zeros(x.shape[:-1]))[..., None]
    with np.errstate(invalid="ignore"):
        distance = centred.residual(seen[..., None, :])
    radius = np.sqrt(_mean(distance**2, weights))
    dyads = frames.circle_back(RR(x[..., :2], x[..., 2:], radius))
    return CriticalDyads(frames, points, found, far, charts, health, real, minimum, dyads, residual)


@cache
def _blas() -> Any:
    """The hold on NumPy's BLAS; looked for once, when first needed."""
    from threadpoolctl import ThreadpoolController  # noqa: PLC0415

    return ThreadpoolController()


def _mean(values: FloatArray, weights: FloatArray | None) -> FloatArray:
    """The weighted mean of values (*, k, N) over the poses: (*, k)."""
    share = np.ones(values.shape[-1]) if weights is None else weights[..., None, :]
    return np.asarray((values * share).sum(axis=-1) / np.broadcast_to(share, values.shape).sum(-1))


def residual_rows(poses: Displacement) -> FloatArray:
    """The rows a (*, N, 7) with |R m + d - c|² - |m|² - |c|² = a · v."""
    d1, d2 = poses.translation[..., 0], poses.translation[..., 1]
    c, s = np.cos(poses.angle), np.sin(poses.angle)
    rows = [d1 * d1 + d2 * d2, -2 * d1, -2 * d2, 2 * (c * d1 + s * d2), 2 * (c * d2 - s * d1)]
    return np.stack([*rows, -2 * c, -2 * s], axis=-1)


def _triangle(poses: Displacement, weights: FloatArray | None) -> FloatArray:
    """T (*, 7, 7) with |T v|² the weighted mean of the squared circle residuals."""
    a = residual_rows(poses)
    share = np.ones(poses.shape) if weights is None else np.broadcast_to(weights, poses.shape)
    share = share / share.sum(axis=-1, keepdims=True)
    a = a - (share[..., None] * a).sum(axis=-2, keepdims=True)
    a = a * np.sqrt(share)[..., None]
    missing = max(0, 7 - a.shape[-2])
    a = np.concatenate([a, np.zeros((*a.shape[:-2], missing, 7))], axis=-2)
    return np.asarray(np.linalg.qr(a, mode="r"))


# --- F and its derivatives at points x = (c1, c2, m1, m2), (*, 4), real or complex


def _features(x: NDArray[Any]) -> NDArray[Any]:
    """The numbers v (*, 7) = 1, c, m, c · m and c2 m1 - c1 m2."""
    c1, c2, m1, m2 = np.moveaxis(x, -1, 0)
    return np.stack([np.ones_like(c1), c1, c2, m1, m2, c1 * m1 + c2 * m2, c2 * m1 - c1 * m2], -1)


def _feature_gradients(x: NDArray[Any]) -> NDArray[Any]:
    """The derivatives (*, 4, 7) of v by c1, c2, m1, m2."""
    c1, c2, m1, m2 = np.moveaxis(x, -1, 0)
    slope = np.zeros((*x.shape[:-1], 4, 7), dtype=x.dtype)
    slope[..., range(4), range(1, 5)] = 1
    slope[..., 5] = np.stack([m1, m2, c1, c2], axis=-1)
    slope[..., 6] = np.stack([-m2, m1, c2, -c1], axis=-1)
    return slope


# The second derivatives of v: only its last two numbers have any.
_CURVATURE = np.zeros((7, 4, 4))
for _at, _i, _j, _sign in ((5, 0, 2, 1), (5, 1, 3, 1), (6, 1, 2, 1), (6, 0, 3, -1)):
    _CURVATURE[_at, _i, _j] = _CURVATURE[_at, _j, _i] = _sign


def _derivatives(x: NDArray[Any], triangle: FloatArray) -> tuple[NDArray[Any], NDArray[Any]]:
    """Half the gradient (*, 4) and half the Hessian (*, 4, 4) of F = |T v|².

    By way of T v, which is small where the dyad is good; G = TᵀT would lose half the digits.
    """
    miss = _features(x) @ triangle.T
    slope = _feature_gradients(x) @ triangle.T
    bend = np.tensordot(miss @ triangle, _CURVATURE, axes=1)
    gradient = (slope @ miss[..., None])[..., 0]
    return gradient, np.asarray(slope @ np.swapaxes(slope, -1, -2) + bend)


class _Points(NamedTuple):
    points: ComplexArray
    real: NDArray[np.bool_]
    minimum: NDArray[np.bool_]
    at_infinity: int
    charts: int
    health: float


def _all_points(triangle: FloatArray) -> _Points:
    """All finite critical points (k, 4), k <= 25, in the order of `CriticalDyads`."""
    unit = _unit(triangle)
    scaled = triangle * [1.0, *[unit] * 4, unit**2, unit**2]
    size = np.linalg.norm(scaled)
    scaled = scaled / size if size > 0 else scaled
    gram = scaled.T @ scaled
    points = np.empty((0, 4), dtype=complex)
    health, charts, far = 0.0, 0, 0
    while len(points) + far < COUNT and charts < CHARTS:
        start, health = eigen_points(gram, charts)
        end, sound = _polish(start, scaled)
        points = _distinct(np.concatenate([points, end[sound]]))
        held = sound & (np.linalg.norm(end - start, axis=1) < 0.1 * np.linalg.norm(start, axis=1))
        far = int((~held & (unit * np.linalg.norm(start, axis=1) > FAR)).sum())
        charts += 1
        if len(points) + far < COUNT:
            end, sound = _polish(_company(points), scaled)
            points = _distinct(np.concatenate([points, end[sound]]))
    far = max(0, min(far, COUNT - len(points)))
    size = 1 + np.linalg.norm(points, axis=1)
    real = np.linalg.norm(points.imag, axis=1) < 1e-8 * size
    points[real] = points[real].real
    bend = np.linalg.eigvalsh(_derivatives(points.real, scaled)[1])[:, 0]
    minimum = real & (bend > 0)
    cost = (np.abs(_features(points) @ scaled.T) ** 2).sum(axis=1)
    cost[cost < NOTHING * size**4] = 0.0
    order = np.lexsort((size, cost, ~real, ~minimum))[:COUNT]
    found: ComplexArray = points[order] * complex(unit)
    return _Points(found, real[order], minimum[order], far, charts, health)


def _unit(triangle: FloatArray) -> float:
    """The length in which the pivots weigh as much in the residual as their products do.

    Where the body turns little that is long, as the pivots are then far away.
    """
    alone, products = np.linalg.norm(triangle[:, 1:5]), np.linalg.norm(triangle[:, 5:])
    return float(BALANCE * alone / products) if alone > 0 and products > 0 else 1.0


def _polish(points: ComplexArray, triangle: FloatArray) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """Newton's method from each point (k, 4), and whether it came to rest at a simple point."""
    x, last = points.copy(), np.full(len(points), np.inf)
    hessian = np.zeros((len(x), 4, 4), dtype=complex)
    moving = np.arange(len(x))
    for _ in range(NEWTON_STEPS):
        here, before = x[moving], last[moving]
        gradient, hessian[moving] = _derivatives(here, triangle)
        try:
            step = np.linalg.solve(hessian[moving], gradient[..., None])[..., 0]
        except np.linalg.LinAlgError:  # an exactly multiple point: the least step that helps
            step = (np.linalg.pinv(hessian[moving]) @ gradient[..., None])[..., 0]
        size = np.linalg.norm(step, axis=1) / (1 + np.linalg.norm(here, axis=1))
        astray = ~(size < 1 / SAME)
        x[moving] = here - np.where(astray[:, None], 0.0, step)
        last[moving] = np.where(astray, np.inf, size)
        settled = (size < 1e-13) | (size < SETTLED) & (size >= before)
        moving = moving[~(settled | astray)]
        if not len(moving):
            break
    # On a curve of critical points Newton's method comes to rest, too, wherever it likes: there
    # the Hessian is singular, as far as the rounding of the products in it lets it be told.
    terms = np.linalg.norm(_feature_gradients(x) @ triangle.T, axis=-1)
    terms = np.maximum(terms, np.finfo(float).tiny)
    spread = np.linalg.svd(hessian / terms[:, :, None] / terms[:, None], compute_uv=False)
    return x, (last < SETTLED) & (spread[:, -1] > SINGULAR * spread[:, 0])


def _company(points: ComplexArray) -> ComplexArray:
    """Where a point may hide among close ones: between neighbours, and beyond.

    Two exact dyads that nearly coincide have a third critical point in between.
    """
    if len(points) < 2:
        return points
    apart = np.linalg.norm(points[:, None] - points, axis=-1) + np.diag([np.inf] * len(points))
    other = points[apart.argmin(axis=1)]
    return np.concatenate([(points + other) / 2, 2 * points - other])


def _distinct(points: ComplexArray) -> ComplexArray:
    """Each point (k, 4) once."""
    size = 1 + np.linalg.norm(points, axis=1)
    apart = np.linalg.norm(points[:, None] - points[None], axis=-1)
    earlier = np.tril(apart < SAME * size, -1).any(axis=1)
    once: ComplexArray = points[~earlier]
    return once
