"""All critical points of many tasks at once, where they are generic: see `critical_points`.

The eigenproblems come from the template of circles without limits (`elimination`), which has a
smaller matrix and no measure of its health.  So only tasks are vouched for of which all 25 points
are found, apart from each other, each at rest and simple.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.critical_points import (
    COUNT,
    LAST_STEP,
    REAL_TOLERANCE,
    SAME_POINT,
    SETTLED_STEP,
    SINGULAR_SHARE,
    balancing_length,
    residual_triangle,
)
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.linear_algebra import one_thread, solve_where_regular
from burmester.numerics.unique_rows import unique_index
from burmester.polynomials.bilinear_fit import Parameters, circle_shape
from burmester.polynomials.elimination import eigen_points
from burmester.polynomials.elimination_template import CHARTS

__all__ = ["many_critical_points"]

MOST_STEPS = 10  # of Newton's method; three are usual
# Share of the fourth power of its size; the determinant of a Hessian that is greater is not zero,
# and no singular value below this share of the greatest.
LEAST_DETERMINANT = 1e-11

_CIRCLE = circle_shape(2, 2, 0, "none")


TASKS_AT_ONCE = 400  # bounds the memory


def many_critical_points(
    seen: Displacement, weights: FloatArray | None, far: NDArray[np.int_]
) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """The critical points (T, 25, 4) of poses (T, N) in their canonical frames, and of which all.

    far: (T,), how many of the points are at infinity (`points_at_infinity`); in their places, and
    for tasks of which not all the others are found, is nan.
    """
    if not len(far):
        return np.empty((0, COUNT, 4), dtype=complex), np.empty(0, dtype=bool)
    starts = range(0, len(far), TASKS_AT_ONCE)
    parts = [slice(start, start + TASKS_AT_ONCE) for start in starts]
    found = [
        _critical_points(seen[part], None if weights is None else weights[part], far[part])
        for part in parts
    ]
    points, every = zip(*found, strict=True)
    return np.concatenate(points), np.concatenate(every)


def _critical_points(
    seen: Displacement, weights: FloatArray | None, far: NDArray[np.int_]
) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """The same of tasks that are computed together."""
    triangle = residual_triangle(seen, weights)
    unit = balancing_length(triangle)
    scaled = triangle * unit[:, None, None] ** np.array([0, 1, 1, 1, 1, 2, 2])
    size = np.linalg.norm(scaled, axis=(1, 2), keepdims=True)
    scaled = scaled / np.where(size > 0, size, 1.0)
    points = np.full((len(unit), COUNT, 4), np.nan, dtype=complex)
    found = np.zeros(len(unit), dtype=bool)
    rest, known = np.arange(len(unit)), np.empty((len(unit), 0, 4), dtype=complex)
    with one_thread():
        for chart in range(CHARTS):
            known = np.concatenate([known, _sound_points(scaled[rest], chart)], axis=1)
            once = np.isfinite(known).all(axis=2) & unique_index(known, SAME_POINT, "euclidean")
            every = once.sum(axis=1) == COUNT - far[rest]
            task, number = np.nonzero(once & every[:, None])
            column = (np.cumsum(once, axis=1) - 1)[task, number]
            points[rest[task], column] = known[task, number]
            found[rest[every]] = True
            rest, known = rest[~every], np.where(once[~every, :, None], known[~every], np.nan)
            if not len(rest):
                break
    size = 1 + np.linalg.norm(points, axis=2)
    real = np.linalg.norm(points.imag, axis=2) < REAL_TOLERANCE * size
    points[real] = points[real].real
    return np.asarray(points * unit[:, None, None]), found


def _sound_points(scaled: FloatArray, chart: int) -> ComplexArray:
    """The points (T, 25, 4) that an eigenproblem has for triangles (T, 7, 7); nan if not sound."""
    tasks = len(scaled)
    none = np.zeros((tasks, 0, 7)), np.zeros((tasks, 7)), np.zeros(tasks)
    gram = np.swapaxes(scaled, -1, -2) @ scaled
    points, lower = eigen_points(_CIRCLE, Parameters(gram, *none), chart)
    task, number = np.nonzero(~lower)
    ends, sound = _at_rest(points[task, number], task, scaled)
    points[task, number] = np.where(sound[:, None], ends, np.nan)
    task, number = np.nonzero(lower)  # each comes right after its conjugate
    points[task, number] = points[task, number - 1].conj()
    return points


def _at_rest(
    points: ComplexArray, task: NDArray[np.intp], triangles: FloatArray
) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """Newton's method from points (k, 4) of tasks (k,) with triangles (T, 7, 7).

    Returns where it leads, and whether it came to rest there, at a point that is simple for sure.
    """
    x, table = np.array(points.T), np.ascontiguousarray(np.moveaxis(triangles, 0, -1))
    sound, run = np.zeros(len(task), dtype=bool), np.arange(len(task))
    last = np.full(len(task), np.inf)
    for _ in range(MOST_STEPS):
        here = x[:, run]
        gradient, hessian, terms = _derivatives(here, table[..., task[run]])
        step, regular = solve_where_regular(hessian, gradient)
        size = np.linalg.norm(step, axis=1) / (1 + np.linalg.norm(here, axis=0))
        near = regular & (size < 1 / SAME_POINT)
        x[:, run] = np.where(near, here - step.T, here)
        settled = near & ((size < LAST_STEP) | ((size < SETTLED_STEP) & (size >= last[run])))
        last[run] = size
        # In units in which no entry of the Hessian is greater than 1 but for its curvature.
        at = np.flatnonzero(settled)
        scaled = hessian[at] / terms[at, :, None] / terms[at, None]
        greatest = np.sqrt((np.abs(scaled) ** 2).sum(axis=(1, 2)))
        simple = np.abs(np.linalg.det(scaled)) > LEAST_DETERMINANT * greatest**4
        if not simple.all():
            values = np.linalg.svd(scaled[~simple], compute_uv=False)
            simple[~simple] = values[:, -1] > SINGULAR_SHARE * values[:, 0]
        sound[run[at]] = simple
        run = run[near & ~settled]
        if not len(run):
            break
    return x.T, sound


def _derivatives(
    x: ComplexArray, triangle: FloatArray
) -> tuple[ComplexArray, ComplexArray, FloatArray]:
    """Half the gradients (k, 4) and Hessians (k, 4, 4) of F = |T v|² at x (4, k), T (7, 7, k).

    By way of T v, which is small where the dyad is good.  Also returns the sizes (k, 4) of the
    derivatives of T v.
    """
    c1, c2, m1, m2 = x
    bilinear = c1 * m1 + c2 * m2, c2 * m1 - c1 * m2
    residual = triangle[:, 0] + (triangle[:, 1:5] * x).sum(axis=1)
    residual = residual + triangle[:, 5] * bilinear[0] + triangle[:, 6] * bilinear[1]
    by = np.empty((4, *residual.shape), dtype=complex)
    for i, (dot, cross) in enumerate(((m1, -m2), (m2, m1), (c1, c2), (c2, -c1))):
        by[i] = triangle[:, 1 + i] + triangle[:, 5] * dot + triangle[:, 6] * cross
    hessian = np.empty((x.shape[1], 4, 4), dtype=complex)
    for i in range(4):
        for j in range(i + 1):
            hessian[:, i, j] = hessian[:, j, i] = (by[i] * by[j]).sum(axis=0)
    dot, cross = ((triangle[:, k] * residual).sum(axis=0) for k in (5, 6))
    for i, j, bend in ((0, 2, dot), (1, 3, dot), (1, 2, cross), (0, 3, -cross)):
        hessian[:, i, j] += bend
        hessian[:, j, i] += bend
    gradient = (by * residual).sum(axis=1).T
    terms = np.sqrt((by.real**2 + by.imag**2).sum(axis=1)).T
    return gradient, hessian, np.maximum(terms, np.finfo(float).tiny)
