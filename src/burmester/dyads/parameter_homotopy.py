"""All stationary points of a fit under conditions, by paths from a generic fit that is solved.

A dyad is fitted by a sum of squares wᵀ G w whose features w are bilinear in the unknowns (the
coordinates of two pivots, or a line's normal and a pivot).  Exact poses are linear conditions
A w = 0 on the same features; a link of given length, or the unit length of a normal, is one
quadratic condition.  With multipliers that is a square polynomial system which depends on
(G, A, l, R) linearly.  How many solutions it has for generic complex parameters depends on its
shape alone; `start_points.npz` holds them all for one set of parameters (found by monodromy, see
`scripts/start_points`), and when the parameters are carried over to those of a task, every
isolated solution of the task is reached with probability one.

The ends are counted: paths that end far away belong to solutions at infinity.
"""

from __future__ import annotations

from functools import cache
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.bundles import take
from burmester.numerics.linear_algebra import matvec, solve_or_shortest
from burmester.numerics.unique_rows import unique_rows

__all__ = [
    "SAME_POINT",
    "Parameters",
    "Shape",
    "StationaryPoints",
    "circle_shape",
    "equations",
    "follow",
    "generic_solutions",
    "jacobian",
    "line_shape",
    "stationary_points",
]

Condition: TypeAlias = Literal["none", "soft", "hard"]

PREDICTION_TOLERANCE = 1e-3  # relative; a step whose prediction is farther off is tried shorter
CORRECTION_TOLERANCE = 1e-10  # relative; Newton's last step on a point of a path
NEWTON_STEPS = 3  # that correct a prediction
POLISHING_STEPS = 2  # of Newton's method at real ends
FIRST_STEP = 0.05  # of the way from one set of parameters to the other
STEP_GROWTH, STEP_CUT = 1.7, 3.0  # the factor after a good step; the divisor after a bad one
MIN_STEP = 1e-10  # of the way; a path that needs shorter ones has met a singular point
MAX_STEPS = 2000  # of a path, good or bad
MAX_SIZE = 1e7  # of a path's unknowns; a longer one is given up
# A path to infinity grows as a power of the way left; the power lies between these two.
MIN_INFINITY_RATE, MAX_INFINITY_RATE = 0.1, 5.0
REAL_TOLERANCE = 1e-7  # relative imaginary part that rounding leaves
SAME_POINT = 1e-6  # relative; ends nearer than this are one
MAX_DETOURS = 2  # other ways tried where paths were lost
RUNNING, LOST, ARRIVED, AWAY = -1, 0, 1, 2  # states of a path


class Shape(NamedTuple):
    """The sort of a polynomial system in unknowns x (n,).

    Its features are w = constant + linear x + x second x / 2.
    name: of its solutions in `start_points.npz`.
    squares: (n,), of the quadratic condition  squares · x² + l · w = R, plus its own multiplier t
    where it is soft (then t² joins the sum of squares, and t is the mean of the residual);
    conditions: the number of rows of A.
    """

    name: str
    constant: FloatArray
    linear: FloatArray
    second: FloatArray
    squares: FloatArray
    conditions: int
    quadratic: Condition

    @property
    def unknowns(self) -> int:
        """How many unknowns there are, multipliers apart."""
        return len(self.squares)

    @property
    def size(self) -> int:
        """How many unknowns there are, multipliers included."""
        return self.unknowns + self.conditions + (self.quadratic != "none")

    @property
    def is_settled(self) -> bool:
        """Whether the conditions alone leave finitely many points."""
        return self.unknowns == self.conditions + (self.quadratic == "hard")

    def features(self, x: NDArray[Any]) -> NDArray[Any]:
        """The features w (*, f) at x (*, n)."""
        quadratic = np.einsum("...i,fij,...j->...f", x, self.second, x) / 2
        return np.asarray(self.constant + x @ self.linear.T + quadratic)

    def gradients(self, x: NDArray[Any]) -> NDArray[Any]:
        """The derivatives (*, n, f) of the features by x (*, n)."""
        return np.asarray(self.linear.T + np.einsum("fij,...j->...if", self.second, x))

    def sizes(self, x: NDArray[Any]) -> FloatArray:
        """The scales (*, size) of x (*, size): one of the unknowns, one of the multipliers."""
        size = np.empty(x.shape)
        for group in (slice(0, self.unknowns), slice(self.unknowns, None)):
            size[..., group] = 1 + np.abs(x[..., group]).max(axis=-1, keepdims=True, initial=0)
        return size


class Parameters(NamedTuple):
    """The parameters in which a system is linear: G (*, f, f), A (*, k, f), l (*, f), R (*,)."""

    gram: NDArray[Any]
    rows: NDArray[Any]
    linear: NDArray[Any]
    square: NDArray[Any]


class StationaryPoints(NamedTuple):
    """The real stationary points of one system, and how its paths ended.

    points: (k, n); minimum: (k,), which are local minima under the conditions.
    complex_parts: (l, n), the real parts of the complex ones, of each conjugate pair once.
    finite: the number of different finite ends, complex ones included; away: of paths to infinity;
    lost: of paths that ended nowhere, so that a point may be missing.
    """

    points: FloatArray
    minimum: NDArray[np.bool_]
    complex_parts: FloatArray
    finite: int
    away: int
    lost: int


@cache
def circle_shape(fixed: int, moving: int, conditions: int, quadratic: Condition) -> Shape:
    """Both pivots of an RR dyad, free in `fixed` and `moving` dimensions (0 to 2 each).

    Features: 1, u, v and their products; if both are free, only u · v and u x v.
    """
    n = fixed + moving
    linear = np.concatenate([np.zeros((1, n)), np.eye(n)])
    if (fixed, moving) == (2, 2):
        second = _products(n, [{(0, 2): 1, (1, 3): 1}, {(1, 2): 1, (0, 3): -1}])
    else:
        pairs = [(i, fixed + j) for i in range(fixed) for j in range(moving)]
        second = _products(n, [{pair: 1} for pair in pairs])
    name = f"circle-{fixed}{moving}-{conditions}-{quadratic}"
    return Shape(name, *_stacked_features(linear, second), np.ones(n), conditions, quadratic)


@cache
def line_shape(moving: int, conditions: int) -> Shape:
    """The normal of a line (2) and a pivot v free in `moving` dimensions: a PR dyad.

    Features: n and its products with v; if v is free, only n · v and n x v.  |n| = 1.
    """
    size = 2 + moving
    linear = np.eye(size)[:2]
    if moving == 2:
        second = _products(size, [{(0, 2): 1, (1, 3): 1}, {(1, 2): 1, (0, 3): -1}])
    else:
        second = _products(size, [{(i, 2): 1} for i in range(2 * moving)])
    constant, linear, second = _stacked_features(linear, second)
    squares, name = np.array([1.0, 1.0, 0.0, 0.0])[:size], f"line-{moving}-{conditions}"
    return Shape(name, np.zeros_like(constant), linear, second, squares, conditions, "hard")


def _products(n: int, products: list[dict[tuple[int, int], int]]) -> FloatArray:
    """The second derivatives (k, n, n) of sums of signed products of two unknowns each."""
    second = np.zeros((len(products), n, n))
    for matrix, product in zip(second, products, strict=True):
        for (i, j), sign in product.items():
            matrix[i, j] = matrix[j, i] = sign
    return second


def _stacked_features(
    linear: FloatArray, second: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Linear features (a, n) and then bilinear ones (b, n, n): constants, first, second parts.

    The first of all features is the constant 1.
    """
    n, count = linear.shape[1], len(linear) + len(second)
    return (
        np.eye(count)[0],
        np.concatenate([linear, np.zeros((len(second), n))]),
        np.concatenate([np.zeros((len(linear), n, n)), second]),
    )


def stationary_points(shape: Shape, target: Parameters) -> list[StationaryPoints]:
    """The real stationary points of systems of one shape, parameters with one leading axis (T,)."""
    start, points = generic_solutions(shape.name)
    ends, state = _carried(shape, points, start, target)
    rng = np.random.default_rng(0)
    for _ in range(MAX_DETOURS):
        again = np.flatnonzero((state == LOST).any(axis=1))
        if not len(again):
            break
        # A path that came too near to infinity goes elsewhere if it begins elsewhere.
        phases = np.exp(2j * np.pi * rng.random(len(start)))
        other_start = Parameters(*(a * phase for a, phase in zip(start, phases, strict=True)))
        other_points, there = _carried(shape, points, start, _one(other_start))
        if (there != ARRIVED).any():
            continue
        other_ends, other_state = _carried(shape, other_points[0], other_start, take(target, again))
        fewer = (other_state == LOST).sum(axis=1) < (state[again] == LOST).sum(axis=1)
        ends[again[fewer]], state[again[fewer]] = other_ends[fewer], other_state[fewer]
    return [_summary(shape, ends[k], state[k], take(target, k)) for k in range(len(state))]


def _one(parameters: Parameters) -> Parameters:
    """One set of parameters with a leading axis."""
    return Parameters(*(a[None] for a in parameters))


def _carried(
    shape: Shape, points: ComplexArray, start: Parameters, target: Parameters
) -> tuple[ComplexArray, NDArray[np.int_]]:
    """The points (k, size), carried over to each of the targets (T,).

    Returns the ends (T, k, size) and their states (T, k).
    """
    tasks, count = len(target.square), len(points)
    each = np.repeat(np.arange(tasks), count)
    ends, state = follow(shape, np.tile(points, (tasks, 1)), _one(start), take(target, each))
    return ends.reshape(tasks, count, -1), state.reshape(tasks, count)


def _summary(
    shape: Shape, ends: ComplexArray, state: NDArray[np.int_], p: Parameters
) -> StationaryPoints:
    """The real points among the ends (k, size) of paths, polished, and the count of all ends."""
    arrived = unique_rows(ends[state == ARRIVED], SAME_POINT, "maximum")
    real = (np.abs(arrived.imag) < REAL_TOLERANCE * shape.sizes(arrived)).all(axis=1)
    x = arrived[real].real
    for _ in range(POLISHING_STEPS):
        x = x - _newton_step(shape, x, p)
    # Where the reduced Hessian is positive, each condition brings one negative eigenvalue.
    negative = (np.linalg.eigvalsh(jacobian(shape, x, p)) < 0).sum(axis=-1)
    minimum = negative == shape.size - shape.unknowns
    away, lost = int((state == AWAY).sum()), int((state == LOST).sum())
    unknowns = slice(0, shape.unknowns)
    pairs = unique_rows(arrived[~real, unknowns].real, SAME_POINT, "maximum")
    return StationaryPoints(x[:, unknowns], minimum, pairs, len(arrived), away, lost)


@cache
def generic_solutions(name: str) -> tuple[Parameters, ComplexArray]:
    """The generic parameters of a shape, and all solutions (k, size) there."""
    from importlib import resources  # noqa: PLC0415  tasks without limits do without it

    with (
        resources.files("burmester.dyads").joinpath("start_points.npz").open("rb") as file,
        np.load(file, allow_pickle=False) as table,
    ):
        *parameters, points = (table[f"{name}/{part}"] for part in (*Parameters._fields, "points"))
    return Parameters(*parameters), points


# --- the system, its derivatives, and the way from one set of parameters to another


def equations(
    shape: Shape, x: NDArray[Any], p: Parameters, parameter_free: float = 1.0
) -> NDArray[Any]:
    """The equations (*, size) at x (*, size).

    parameter_free: the factor of the terms that no parameter multiplies; with 0 the equations are
    linear in the parameters.
    """
    n, k = shape.unknowns, shape.conditions
    at, multipliers = x[..., :n], x[..., n : n + k]
    w, gradients = shape.features(at), shape.gradients(at)
    by_feature = matvec(p.gram, w) + matvec(np.swapaxes(p.rows, -1, -2), multipliers)
    parts = [matvec(p.rows, w)]
    if shape.quadratic != "none":
        t = x[..., -1:]
        by_feature = by_feature + t * p.linear
        squares = parameter_free * (shape.squares * at * at).sum(axis=-1)
        gap = squares + (p.linear * w).sum(axis=-1) - p.square
        if shape.quadratic == "soft":
            gap = gap - parameter_free * t[..., 0]
        parts.append(gap[..., None])
    gradient = matvec(gradients, by_feature)
    if shape.quadratic != "none":
        gradient = gradient + 2 * parameter_free * t * shape.squares * at
    return np.concatenate([gradient, *parts], axis=-1)


def jacobian(shape: Shape, x: NDArray[Any], p: Parameters) -> NDArray[Any]:
    """The derivatives (*, size, size) of the equations by x: a symmetric matrix."""
    n, k = shape.unknowns, shape.conditions
    at, multipliers = x[..., :n], x[..., n : n + k]
    w, gradients = shape.features(at), shape.gradients(at)
    by_feature = matvec(p.gram, w) + matvec(np.swapaxes(p.rows, -1, -2), multipliers)
    matrix = np.zeros((*x.shape, x.shape[-1]), dtype=np.result_type(x, p.gram))
    border = gradients @ np.swapaxes(p.rows, -1, -2)
    matrix[..., :n, n : n + k] = border
    matrix[..., n : n + k, :n] = np.swapaxes(border, -1, -2)
    if shape.quadratic != "none":
        t = x[..., -1:]
        by_feature = by_feature + t * p.linear
        column = matvec(gradients, p.linear) + 2 * shape.squares * at
        matrix[..., :n, -1] = matrix[..., -1, :n] = column
        matrix[..., -1, -1] = -1.0 if shape.quadratic == "soft" else 0.0
        matrix[..., range(n), range(n)] += 2 * t * shape.squares
    curvature = np.tensordot(by_feature, shape.second, axes=1)
    matrix[..., :n, :n] += gradients @ p.gram @ np.swapaxes(gradients, -1, -2) + curvature
    return matrix


def _newton_step(shape: Shape, x: NDArray[Any], p: Parameters) -> NDArray[Any]:
    """Newton's step at x (*, size), to be subtracted."""
    return solve_or_shortest(jacobian(shape, x, p), equations(shape, x, p))


class _Way(NamedTuple):
    """Straight ways (P,) through the parameters: start + s change, s from 0 to 1."""

    start: Parameters
    change: Parameters

    def at(self, s: FloatArray) -> Parameters:
        """The parameters at s (P,)."""

        def moved(start: NDArray[Any], change: NDArray[Any]) -> NDArray[Any]:
            return np.asarray(start + s.reshape(-1, *(1,) * (start.ndim - 1)) * change)

        return Parameters(*map(moved, self.start, self.change))

    def velocity(self, shape: Shape, y: ComplexArray, s: FloatArray) -> ComplexArray:
        """How solutions y (P, size) at s (P,) move with s (Davidenko's equation)."""
        by_s = equations(shape, y, self.change, parameter_free=0.0)
        return -solve_or_shortest(jacobian(shape, y, self.at(s)), by_s)


def follow(
    shape: Shape, points: ComplexArray, start: Parameters, end: Parameters
) -> tuple[ComplexArray, NDArray[np.int_]]:
    """Solutions (P, size) of the systems `start`, carried over to those of `end` (P or 1 each).

    A straight way in the parameters; Runge and Kutta's prediction, Newton's correction, steps that
    adapt.
    Returns the ends and their states (P,): ARRIVED, AWAY (to infinity) or LOST; which of the last
    two is decided by how fast a path runs when it is given up, a heuristic.
    """
    x = points.copy()
    count = len(x)
    start, end = (
        Parameters(*(np.broadcast_to(a, (count, *a.shape[1:])) for a in p)) for p in (start, end)
    )
    ways = _Way(start, Parameters(*(b - a for a, b in zip(start, end, strict=True))))
    # Multipliers grow at a singular point of the conditions; where these leave no freedom, that
    # means nothing but two solutions close together.
    watched = shape.unknowns if shape.size == 2 * shape.unknowns else shape.size
    done, step, state = np.zeros(count), np.full(count, FIRST_STEP), np.full(count, RUNNING)
    for _ in range(MAX_STEPS):
        run = np.flatnonzero(state == RUNNING)
        if not len(run):
            break
        way, s, y = take(ways, run), done[run], x[run]
        h = np.minimum(step[run], 1 - s)
        with np.errstate(all="ignore"):
            guess, first_velocity = _predicted(shape, way, y, s, h)
            corrected, p = guess, way.at(s + h)
            for _ in range(NEWTON_STEPS):
                last = _newton_step(shape, corrected, p)
                corrected = corrected - last
            size = shape.sizes(corrected)
            settled = np.abs(last) < CORRECTION_TOLERANCE * size
            near = np.abs(corrected - guess) < PREDICTION_TOLERANCE * size
            good = (settled & near).all(axis=1)
        advanced = run[good]
        x[advanced], done[advanced] = corrected[good], (s + h)[good]
        step[run] = np.where(good, STEP_GROWTH * h, h / STEP_CUT)
        # A point at infinity of the end comes as a power of the way left, so at a steady rate; one
        # that is passed on the way comes much faster, and a singular point stands still.
        growth = np.abs(first_velocity) * (1 - s)[:, None] / shape.sizes(y)
        rate = growth[:, :watched].max(axis=1)
        to_infinity = (rate > MIN_INFINITY_RATE) & (rate < MAX_INFINITY_RATE)
        stop = (step[run] < MIN_STEP) | (shape.sizes(x[run])[:, 0] > MAX_SIZE)
        state[run[stop]] = np.where(to_infinity, AWAY, LOST)[stop]
        state[advanced[done[advanced] >= 1]] = ARRIVED
    state[state == RUNNING] = LOST
    return x, state


def _predicted(
    shape: Shape, way: _Way, y: ComplexArray, s: FloatArray, h: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """Runge and Kutta's prediction (P, size) at s + h, and the velocity at s."""
    half = h[:, None] / 2
    k1 = way.velocity(shape, y, s)
    k2 = way.velocity(shape, y + half * k1, s + h / 2)
    k3 = way.velocity(shape, y + half * k2, s + h / 2)
    k4 = way.velocity(shape, y + 2 * half * k3, s + h)
    return y + half / 3 * (k1 + 2 * k2 + 2 * k3 + k4), k1
