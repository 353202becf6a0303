"""All critical points of the squared circle residuals of many tasks: see `critical_points`.

They come from eigenproblems: of many tasks at once by the template of circles without limits
(`elimination`), and of few, or where that does not find all of a task, which is special or turns
little, from a greater matrix (`macaulay`), task by task.  Newton's method on F removes rounding.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray, unique_index, unique_rows
from burmester.numerics.linear_algebra import matvec, one_thread, solve_where_regular
from burmester.polynomials import elimination, macaulay
from burmester.polynomials.bilinear_fit import Parameters, circle_shape
from burmester.polynomials.elimination import BALANCE, CHARTS

COUNT = 25  # finite critical points of generic poses (a Groebner basis over a finite field)
# Number of steps of Newton's method; three are usual, more than 5 are taken only towards points
# that lie close together.
FEW_STEPS, MOST_STEPS = 10, 40
REAL_TOLERANCE = 1e-8  # relative; a smaller imaginary part is rounding
SINGULAR_SHARE = 1e-14  # of the Hessian's greatest singular value; a smaller one is rounding
# Share of the fourth power of its size; the determinant of a Hessian that is greater is not zero,
# and no singular value below this share of the greatest.
LEAST_DETERMINANT = 1e-11
RESIDUAL_ROUNDING = 1e-28  # of its terms, squared; a smaller sum of squares is zero
SETTLED_STEP = 1e-8  # relative; shorter steps are rounding once they no longer shrink
LAST_STEP = 1e-13  # relative; a step as short as this is the last one in any case
SAME_POINT = 1e-6  # relative; critical points nearer than this are one
TASKS_AT_ONCE = 400  # bounds the memory
FEW_TASKS = 4  # solved by the greater matrix before the template is loaded

_CIRCLE = circle_shape(2, 2, 0, "none")


class CriticalPoints(NamedTuple):
    """The critical points of tasks (T,), as `CriticalDyads` has them."""

    points: ComplexArray
    found: NDArray[np.int_]
    charts: NDArray[np.int_]
    real: NDArray[np.bool_]
    minimum: NDArray[np.bool_]


def critical_points(
    triangle: FloatArray, far: NDArray[np.int_], turning: NDArray[np.bool_]
) -> CriticalPoints:
    """The finite critical points of F = |T v|² with triangles T (T, 7, 7) of tasks.

    far: (T,), how many of the 25 of each are at infinity (`points_at_infinity`); turning: (T,),
    whether the body turns so much that the template may find the others.
    """
    scaled, unit = balanced(triangle)
    points = np.full((len(far), COUNT, 4), np.nan, dtype=complex)
    charts, easy = np.zeros(len(far), dtype=np.int_), np.flatnonzero(turning)
    easy = easy if len(far) > FEW_TASKS else easy[:0]
    with one_thread():
        for first in range(0, len(easy), TASKS_AT_ONCE):
            index = easy[first : first + TASKS_AT_ONCE]
            points[index], charts[index] = _generic_points(scaled[index], far[index])
        for task in np.flatnonzero(charts == 0).tolist():
            some, charts[task] = _all_points(scaled[task], int(far[task]))
            points[task, : len(some)] = some[:COUNT]
    size = 1 + np.linalg.norm(points, axis=-1)
    real = np.linalg.norm(points.imag, axis=-1) < REAL_TOLERANCE * size
    points[real] = points[real].real
    minimum, at = np.zeros_like(real), np.nonzero(real)
    hessian = derivatives(points[at].real.T, np.moveaxis(scaled[at[0]], 0, -1))[1]
    minimum[at] = np.linalg.eigvalsh(hessian)[:, 0] > 0
    residual = features(points) @ np.swapaxes(scaled, -1, -2)
    cost = (residual.real**2 + residual.imag**2).sum(axis=-1)
    cost[cost < RESIDUAL_ROUNDING * size**4] = 0.0
    order = np.lexsort((size, cost, ~real, ~minimum))
    points = np.take_along_axis(points, order[..., None], axis=1) * unit[:, None, None]
    real, minimum = (np.take_along_axis(each, order, axis=1) for each in (real, minimum))
    return CriticalPoints(points, np.isfinite(size).sum(axis=-1), charts, real, minimum)


def balanced(triangle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Triangles (*, 7, 7) of size 1 in lengths (*,), and these.

    In such lengths pivots weigh as much in the residual as their products do; where the body turns
    little they are long, as the pivots are then far away.  Powers of two, by which nothing is
    rounded.
    """
    alone = np.linalg.norm(triangle[..., 1:5], axis=(-2, -1))
    products = np.linalg.norm(triangle[..., 5:], axis=(-2, -1))
    some = (alone > 0) & (products > 0)
    ratio = np.where(some, BALANCE * alone / np.where(some, products, 1.0), 1.0)
    unit = 2.0 ** np.round(np.log2(ratio))
    scaled = triangle * unit[..., None, None] ** np.array([0, 1, 1, 1, 1, 2, 2])
    size = np.linalg.norm(scaled, axis=(-2, -1), keepdims=True)
    return scaled / np.where(size > 0, size, 1.0), np.asarray(unit)


def features(x: NDArray[Any]) -> NDArray[Any]:
    """The numbers v (*, 7) = 1, c, m, c · m and c2 m1 - c1 m2 at x = (c1, c2, m1, m2), (*, 4)."""
    c1, c2, m1, m2 = np.moveaxis(x, -1, 0)
    return np.stack([np.ones_like(c1), c1, c2, m1, m2, c1 * m1 + c2 * m2, c2 * m1 - c1 * m2], -1)


def derivatives(
    x: NDArray[Any], triangle: FloatArray
) -> tuple[NDArray[Any], NDArray[Any], FloatArray]:
    """Half the gradients (k, 4) and Hessians (k, 4, 4) of F = |T v|² at x (4, k), T (7, 7, k).

    By way of T v, which is small where the dyad is good; TᵀT would lose half the digits.  Also
    returns the sizes (k, 4) of the derivatives of T v.
    """
    c1, c2, m1, m2 = x
    bilinear = c1 * m1 + c2 * m2, c2 * m1 - c1 * m2
    residual = triangle[:, 0] + (triangle[:, 1:5] * x).sum(axis=1)
    residual = residual + triangle[:, 5] * bilinear[0] + triangle[:, 6] * bilinear[1]
    by = np.empty((4, *residual.shape), dtype=x.dtype)
    for i, (dot, cross) in enumerate(((m1, -m2), (m2, m1), (c1, c2), (c2, -c1))):
        by[i] = triangle[:, 1 + i] + triangle[:, 5] * dot + triangle[:, 6] * cross
    hessian = np.empty((x.shape[1], 4, 4), dtype=x.dtype)
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


def _generic_points(
    scaled: FloatArray, far: NDArray[np.int_]
) -> tuple[ComplexArray, NDArray[np.int_]]:
    """The points (T, 25, 4) and charts of tasks of which the template finds all 25; else nan."""
    points = np.full((len(far), COUNT, 4), np.nan, dtype=complex)
    charts = np.zeros(len(far), dtype=np.int_)
    rest, known = np.arange(len(far)), np.empty((len(far), 0, 4), dtype=complex)
    for chart in range(CHARTS):
        if not len(rest):
            break
        known = np.concatenate([known, _sound_points(scaled[rest], chart)], axis=1)
        once = np.isfinite(known).all(axis=2) & unique_index(known, SAME_POINT, "euclidean")
        every = once.sum(axis=1) == COUNT - far[rest]
        task, number = np.nonzero(once & every[:, None])
        column = (np.cumsum(once, axis=1) - 1)[task, number]
        points[rest[task], column] = known[task, number]
        charts[rest[every]] = chart + 1
        rest, known = rest[~every], np.where(once[~every, :, None], known[~every], np.nan)
    return points, charts


def _sound_points(scaled: FloatArray, chart: int) -> ComplexArray:
    """The points (T, 25, 4) that an eigenproblem has for triangles (T, 7, 7); nan if not sound."""
    tasks = len(scaled)
    none = np.zeros((tasks, 0, 7)), np.zeros((tasks, 7)), np.zeros(tasks)
    gram = np.swapaxes(scaled, -1, -2) @ scaled
    points, lower = elimination.eigen_points(_CIRCLE, Parameters(gram, *none), chart)
    task, number = np.nonzero(~lower)
    ends, sound = _at_rest(points[task, number], task, scaled, FEW_STEPS)
    points[task, number] = np.where(sound[:, None], ends, np.nan)
    task, number = np.nonzero(lower)  # each comes right after its conjugate
    points[task, number] = points[task, number - 1].conj()
    return points


def health(triangle: FloatArray) -> float:
    """The least relative pivot of the 125 rows of the greater matrix, for a triangle (7, 7)."""
    scaled, _ = balanced(triangle)
    return macaulay.eigen_points(scaled.T @ scaled, 0)[1]


def _all_points(scaled: FloatArray, far: int) -> tuple[ComplexArray, int]:
    """All points (k, 4) of one task that can be found, and the charts it took."""
    points, one = np.empty((0, 4), dtype=complex), scaled[None]
    gram, charts, finite = scaled.T @ scaled, 0, COUNT - far

    def joined(start: ComplexArray) -> ComplexArray:
        ends, sound = _at_rest(start, np.zeros(len(start), dtype=np.intp), one, MOST_STEPS)
        return unique_rows(np.concatenate([points, ends[sound]]), SAME_POINT, "euclidean")

    while len(points) < finite and charts < macaulay.CHARTS:
        points = joined(macaulay.eigen_points(gram, charts)[0])
        charts += 1
        if len(points) < finite:
            points = joined(_beside_neighbours(points))
    return points, charts


def _beside_neighbours(points: ComplexArray) -> ComplexArray:
    """Starts between points (k, 4) and their nearest neighbours, and as far beyond them."""
    if len(points) < 2:
        return points
    apart = np.linalg.norm(points[:, None] - points, axis=-1) + np.diag([np.inf] * len(points))
    other = points[apart.argmin(axis=1)]
    return np.concatenate([(points + other) / 2, 2 * points - other])


def _at_rest(
    points: ComplexArray, task: NDArray[np.intp], triangles: FloatArray, steps: int
) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """Newton's method from points (k, 4) of tasks (k,) with triangles (T, 7, 7).

    Returns where it leads, and whether it came to rest there, at a point that is simple for sure:
    on a curve of critical points it comes to rest wherever it likes, and there the Hessian is
    singular, as far as the rounding of the products in it shows.
    """
    x, table = np.array(points.T), np.ascontiguousarray(np.moveaxis(triangles, 0, -1))
    sound, run = np.zeros(len(task), dtype=bool), np.arange(len(task))
    last = np.full(len(task), np.inf)
    for _ in range(steps):
        here = x[:, run]
        gradient, hessian, terms = derivatives(here, table[..., task[run]])
        step, regular = solve_where_regular(hessian, gradient)
        if not regular.all():  # the shortest step, where there is no other
            at = np.flatnonzero(~regular & np.isfinite(hessian).all(axis=(1, 2)))
            step[at] = matvec(np.linalg.pinv(hessian[at]), gradient[at])
            regular[at] = True
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
