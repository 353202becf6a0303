"""Every locally best RR dyad of a task, by linear algebra.

With the squared distance of the moving pivot from the fixed one as a function of both,

    f_i = |R_i m + d_i - c|² = |m|² + |c|² + |d_i|² - 2 c · d_i + 2 d_i · R_i m - 2 c · R_i m,

the circle residual is f_i minus its mean: the best r² for given pivots.  It is linear in the
seven numbers (1, c, m, c · m, c x m), so the sum of its squares is F = vᵀ G v with a 7 x 7
matrix G, and the critical points of F are the common zeros of its four derivatives, which have
degrees (1, 2), (1, 2), (2, 1), (2, 1) in (c, m).  For generic poses there are 25 of them, and
8 more at infinity.

All of them come from one eigenproblem (`macaulay`), with no start value; Newton's method on F
takes off the rounding.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.displacement import Displacement, FloatArray
from burmester.dyad import RR
from burmester.errors import InputError
from burmester.frames import CanonicalFrames
from burmester.macaulay import CHARTS, ComplexArray, eigen_points

__all__ = ["COUNT", "CriticalDyads", "critical_dyads"]

COUNT = 25  # finite critical points of generic poses (a Groebner basis over a finite field)
NEWTON_STEPS = 10
SAME = 1e-6  # relative distance below which two critical points are one


@final
@dataclass(frozen=True, slots=True, eq=False)
class CriticalDyads:
    """All critical points of the squared circle residual of a task, real or not.

    frames: where they were found, (*,).
    points: (*, 25, 4), complex c1, c2, m1, m2 in those frames, real minima first, by rising
        residual, then the other real ones, then the rest; nan beyond `found`.
    found: (*,), how many finite ones were found, each once; 25 accounts for all of them.
        Fewer: some are multiple, at infinity or lost (the poses are special, or nearly so).
    charts: (*,), how many charts it took: 1 but for hard tasks.
    health: (*,), the least relative pivot of the 192 rows; rounding is magnified by its inverse.
    real, minimum: (*, 25), which are real, and which of those are local minima.
    dyads: (*, 25), as RR dyads in the task's own frames, r² the mean of the squared distances;
        nan where not real.
    residual: (*, 25), rms of the circle residual |R m + d - c|² - r², in the task's unit squared.
    """

    frames: CanonicalFrames
    points: ComplexArray
    found: NDArray[np.int_]
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
            help="give more poses, or see the exact methods for 3 and 4",
        )
    poses.require_finite()
    frames, seen = CanonicalFrames.of(poses, weights)
    lead = poses.shape[:-1]
    triangle = _triangle(seen, weights)
    points = np.full((*lead, COUNT, 4), np.nan + 0j)
    found, charts = np.zeros(lead, dtype=int), np.zeros(lead, dtype=int)
    health, real = np.zeros(lead), np.zeros((*lead, COUNT), dtype=bool)
    minimum = np.zeros((*lead, COUNT), dtype=bool)
    # Matrices this small are slower with several BLAS threads, much so on a busy machine.
    with _blas().limit(limits=1, user_api="blas"):
        results = {task: _all_points(triangle[task]) for task in np.ndindex(lead)}
    for task, result in results.items():
        n = len(result.points)
        points[task][:n], found[task], charts[task] = result.points, n, result.charts
        health[task], real[task][:n], minimum[task][:n] = result.health, result.real, result.minimum
    x = np.where(real[..., None], points.real, np.nan)
    squared = (_features(x) @ np.swapaxes(triangle, -1, -2)) ** 2
    residual = np.sqrt(squared.sum(axis=-1)) * frames.length[..., None] ** 2
    centred = RR(x[..., :2], x[..., 2:], np.zeros(x.shape[:-1]))[..., None]
    with np.errstate(invalid="ignore"):
        distance = centred.residual(seen[..., None, :])
    radius = np.sqrt(_mean(distance**2, weights))
    dyads = frames.circle_back(RR(x[..., :2], x[..., 2:], radius))
    return CriticalDyads(frames, points, found, charts, health, real, minimum, dyads, residual)


@cache
def _blas() -> Any:
    """The hold on NumPy's BLAS; looked for once, when first needed."""
    from threadpoolctl import ThreadpoolController  # noqa: PLC0415

    return ThreadpoolController()


def _mean(values: FloatArray, weights: FloatArray | None) -> FloatArray:
    """The weighted mean of values (*, k, N) over the poses: (*, k)."""
    share = np.ones(values.shape[-1]) if weights is None else weights[..., None, :]
    return np.asarray((values * share).sum(axis=-1) / np.broadcast_to(share, values.shape).sum(-1))


def _triangle(poses: Displacement, weights: FloatArray | None) -> FloatArray:
    """T (*, 7, 7) with |T v|² the weighted mean of the squared circle residuals."""
    d1, d2 = poses.translation[..., 0], poses.translation[..., 1]
    c, s = np.cos(poses.angle), np.sin(poses.angle)
    rows = [d1 * d1 + d2 * d2, -2 * d1, -2 * d2, 2 * (c * d1 + s * d2), 2 * (c * d2 - s * d1)]
    a = np.stack([*rows, -2 * c, -2 * s], axis=-1)
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


def _gradient(x: NDArray[Any], gram: FloatArray) -> NDArray[Any]:
    """Half the gradient (*, 4) of F = vᵀ G v."""
    return np.asarray((_feature_gradients(x) @ (_features(x) @ gram)[..., None])[..., 0])


def _hessian(x: NDArray[Any], gram: FloatArray) -> NDArray[Any]:
    """Half the Hessian (*, 4, 4) of F."""
    slope = _feature_gradients(x)
    bend = np.tensordot(_features(x) @ gram, _CURVATURE, axes=1)
    return np.asarray(slope @ gram @ np.swapaxes(slope, -1, -2) + bend)


class _Points(NamedTuple):
    points: ComplexArray
    real: NDArray[np.bool_]
    minimum: NDArray[np.bool_]
    charts: int
    health: float


def _all_points(triangle: FloatArray) -> _Points:
    """All finite critical points (k, 4), k <= 25, in the order of `CriticalDyads`."""
    gram = triangle.T @ triangle
    size = np.trace(gram)
    gram = gram / size if size > 0 else gram
    points = np.empty((0, 4), dtype=complex)
    health, charts = 0.0, 0
    while len(points) < COUNT and charts < CHARTS:
        more, health = eigen_points(gram, charts)
        points = _distinct(np.concatenate([points, _polish(more, gram)]))
        charts += 1
    size = np.linalg.norm(points, axis=1)
    real = np.linalg.norm(points.imag, axis=1) < 1e-8 * (1 + size)
    points[real] = points[real].real
    bend = np.linalg.eigvalsh(_hessian(points.real, gram))[:, 0] if len(points) else np.empty(0)
    minimum = real & (bend > 0)
    cost = (np.abs(_features(points) @ triangle.T) ** 2).sum(axis=1)
    order = np.lexsort((cost, ~real, ~minimum))[:COUNT]
    return _Points(points[order], real[order], minimum[order], charts, health)


def _polish(points: ComplexArray, gram: FloatArray) -> ComplexArray:
    """Newton's method from each point (k, 4); those that run away are dropped."""
    x = points
    for _ in range(NEWTON_STEPS):
        hessian, gradient = _hessian(x, gram), _gradient(x, gram)
        try:
            step = np.linalg.solve(hessian, gradient[..., None])[..., 0]
        except np.linalg.LinAlgError:  # an exactly multiple point: the least step that helps
            step = (np.linalg.pinv(hessian) @ gradient[..., None])[..., 0]
        x = x - step
        size = 1 + np.linalg.norm(x, axis=1)
        last = np.linalg.norm(step, axis=1) / size
        gone = ~(np.linalg.norm(x - points, axis=1) < 0.1 * size)
        if ((last < 1e-13) | gone).all():
            break
    found: ComplexArray = x[(last < 1e-8) & ~gone]
    return found


def _distinct(points: ComplexArray) -> ComplexArray:
    """Each point (k, 4) once."""
    size = 1 + np.linalg.norm(points, axis=1)
    apart = np.linalg.norm(points[:, None] - points[None], axis=-1)
    earlier = np.tril(apart < SAME * size, -1).any(axis=1)
    once: ComplexArray = points[~earlier]
    return once
