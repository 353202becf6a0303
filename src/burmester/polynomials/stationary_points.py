"""All stationary points of fits under conditions: by linear algebra, by paths where that fails.

For generic poses the number of finite solutions of a shape is known.  Where so many different ones
come out of the eigenproblem (`elimination`) and Newton's method confirms them, they are all.  Of
special poses some lie at infinity, or coincide: such systems are solved by paths
(`parameter_homotopy`) as well, and the ends of these are counted.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray, take
from burmester.numerics.linear_algebra import matvec, one_thread, solve_or_shortest
from burmester.polynomials.bilinear_fit import Parameters, Shape, equations, jacobian, newton_step
from burmester.polynomials.elimination import CHARTS, eigen_points, finite_count
from burmester.polynomials.parameter_homotopy import ARRIVED, AWAY, LOST, tracked_points

MAX_NEWTON_STEPS = 12  # from an eigenvector; two are usual
SETTLED_STEP = 1e-9  # relative; after a shorter one of Newton's method nothing is left to do
SINGULAR = 1e-14  # inverse condition, relative; a point with a lower one is no isolated point
MAX_SIZE = 1e7  # of unknowns; what is farther is taken to be at infinity
MAX_MULTIPLIER = 1e5  # relative to the forces that conditions hold; greater ones are infinite
REAL_TOLERANCE = 1e-7  # relative imaginary part that rounding leaves
SAME_POINT = 1e-6  # relative; points nearer than this are one


class StationaryPoints(NamedTuple):
    """The real stationary points of one system, and how its paths ended.

    points: (k, n); minimum: (k,), which are local minima under the conditions.
    complex_parts: (l, n), the real parts of the complex ones, of each conjugate pair once.
    finite: the number of different finite points, complex ones included.
    away, lost: of paths to infinity, and of paths that ended nowhere, so that a point may be
    missing; none where no paths were needed.
    """

    points: FloatArray
    minimum: NDArray[np.bool_]
    complex_parts: FloatArray
    finite: int
    away: int
    lost: int


class _Points(NamedTuple):
    """Solutions x (T, k, size) of each system, and which (T, k) of them count: each once."""

    x: ComplexArray
    counts: NDArray[np.bool_]

    @property
    def finite(self) -> NDArray[np.int_]:
        """How many there are, (T,)."""
        return np.asarray(self.counts.sum(axis=1))

    def joined(self, shape: Shape, rows: NDArray[np.intp], more: _Points) -> _Points:
        """The points of all systems, and more of some rows of them."""
        tasks, width = self.counts.shape[0], more.counts.shape[1]
        x = np.zeros((tasks, width, shape.size), dtype=complex)
        counts = np.zeros((tasks, width), dtype=bool)
        x[rows], counts[rows] = more
        x, counts = np.concatenate([self.x, x], axis=1), np.concatenate([self.counts, counts], 1)
        x = shape.one_of_twins(x)
        return _Points(x, _first_of_each(x, counts))


def stationary_points(shape: Shape, target: Parameters) -> list[StationaryPoints]:
    """The real stationary points of systems of one shape, parameters with one leading axis (T,).

    Formula `lagrangian` of the theory.
    """
    tasks = len(target.square)
    points = _Points(np.empty((tasks, 0, shape.size), dtype=complex), np.empty((tasks, 0), bool))
    away, lost = np.zeros(tasks, dtype=int), np.zeros(tasks, dtype=int)
    wanted = finite_count(shape)
    rest = np.arange(tasks)
    with one_thread():
        for chart in range(CHARTS if wanted else 0):
            if len(rest):
                found = _by_elimination(shape, take(target, rest), chart)
                points = points.joined(shape, rest, found)
                rest = np.flatnonzero(points.finite < wanted)
        if len(rest):
            ends, state = tracked_points(shape, take(target, rest))
            away[rest], lost[rest] = (state == AWAY).sum(axis=1), (state == LOST).sum(axis=1)
            points = points.joined(shape, rest, _Points(ends, state == ARRIVED))
        return _summaries(shape, points, target, away, lost)


def _by_elimination(shape: Shape, p: Parameters, chart: int) -> _Points:
    """The solutions of systems (T,) that an eigenproblem has and Newton's method confirms."""
    x, lower = eigen_points(shape, p, chart)
    task, number = np.nonzero(~lower)
    ends, sound = _confirmed(shape, x[task, number], take(p, task))
    whole, counts = np.zeros((*x.shape[:2], shape.size), dtype=complex), np.zeros(x.shape[:2], bool)
    whole[task, number], counts[task, number] = ends, sound
    # The conjugate of each comes right after it.
    task, number = np.nonzero(lower)
    whole[task, number] = whole[task, number - 1].conj()
    counts[task, number] = counts[task, number - 1]
    return _Points(whole, counts)


def _confirmed(
    shape: Shape, x: ComplexArray, p: Parameters
) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """Where Newton's method leads from (k, n): (k, size), and whether to an isolated point."""
    run = np.flatnonzero(np.abs(x).max(axis=1) < MAX_SIZE)
    points, sound = np.zeros((len(x), shape.size), dtype=complex), np.zeros(len(x), dtype=bool)
    p = take(p, run)
    points[run] = _with_multipliers(shape, x[run], p)
    for _ in range(MAX_NEWTON_STEPS):
        here = points[run]
        matrix = jacobian(shape, here, p)
        step = solve_or_shortest(matrix, equations(shape, here, p))
        points[run] = here - step
        size = (np.abs(step) / shape.sizes(here)).max(axis=1)
        near = _at_hand(shape, points[run], p)
        settled = near & (size < SETTLED_STEP)
        sound[run[settled]] = _regular(shape, here[settled], matrix[settled])
        on = near & ~settled & (size < MAX_SIZE)
        run, p = run[on], take(p, on)
        if not len(run):
            break
    return points, sound


def _at_hand(shape: Shape, x: ComplexArray, p: Parameters) -> NDArray[np.bool_]:
    """Whether points (k, size) are finite, multipliers included: no two solutions together."""
    n = shape.unknowns
    near = np.abs(x[:, :n]).max(axis=1) < MAX_SIZE
    if shape.quadratic != "soft" and not shape.is_settled:
        force = np.linalg.norm(p.gram, axis=(1, 2)) * np.linalg.norm(
            shape.features(x[:, :n]), axis=1
        )
        near &= np.abs(x[:, n:]).max(axis=1, initial=0) <= MAX_MULTIPLIER * force
    return np.asarray(near)


def _with_multipliers(shape: Shape, x: ComplexArray, p: Parameters) -> ComplexArray:
    """Unknowns (k, n) with the multipliers that fit best, (k, size)."""
    n = shape.unknowns
    points = np.zeros((len(x), shape.size), dtype=complex)
    points[:, :n] = x
    if shape.size > n:
        border = jacobian(shape, points, p)[:, :n, n:]
        adjoint = np.swapaxes(border.conj(), -1, -2)
        gradient = equations(shape, points, p)[:, :n]
        points[:, n:] = -solve_or_shortest(adjoint @ border, matvec(adjoint, gradient))
    return points


def _regular(shape: Shape, x: ComplexArray, matrix: ComplexArray) -> NDArray[np.bool_]:
    """Whether solutions (k, size) with Jacobians (k, size, size) are isolated, rounding apart."""
    size = shape.sizes(x)
    scaled = matrix * size[:, None]
    rows = np.abs(scaled).max(axis=2, keepdims=True)
    values = np.linalg.svd(
        np.divide(scaled, rows, out=np.zeros_like(scaled), where=rows > 0), compute_uv=False
    )
    return np.asarray(values[:, -1] > SINGULAR * values[:, 0])


def _first_of_each(x: NDArray[Any], counts: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which of points (T, k, size) count and repeat none before them."""
    size = 1 + np.abs(x).max(axis=2)
    apart = np.abs(x[:, :, None] - x[:, None]).max(axis=3)
    same = (apart < SAME_POINT * size[:, :, None]) & counts[:, None]
    earlier = np.tril(np.ones(same.shape[1:], dtype=bool), -1)
    return np.asarray(counts & ~(same & earlier).any(axis=2))


def _summaries(
    shape: Shape,
    points: _Points,
    target: Parameters,
    away: NDArray[np.int_],
    lost: NDArray[np.int_],
) -> list[StationaryPoints]:
    """The real ones among points, which are minima, and the real parts of the others."""
    n = shape.unknowns
    small = np.abs(points.x.imag) < REAL_TOLERANCE * shape.sizes(points.x)
    real = small.all(axis=2) & points.counts
    task, _ = np.nonzero(real)
    x, p = points.x[real].real, take(target, task)
    x = x - newton_step(shape, x, p)
    # Where the reduced Hessian is positive, each condition brings one negative eigenvalue.
    negative = (np.linalg.eigvalsh(jacobian(shape, x, p)) < 0).sum(axis=-1)
    minimum = negative == shape.size - n
    parts = points.x[..., :n].real
    pairs = _first_of_each(parts, points.counts & ~real)
    ends = np.cumsum(real.sum(axis=1))
    return [
        StationaryPoints(x[end - k : end, :n], minimum[end - k : end], part[pair], *numbers)
        for end, k, part, pair, *numbers in zip(
            ends.tolist(),
            real.sum(axis=1).tolist(),
            parts,
            pairs,
            points.finite.tolist(),
            away.tolist(),
            lost.tolist(),
            strict=True,
        )
    ]
