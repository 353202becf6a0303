"""All stationary points of a fit under conditions, followed from a generic one that is solved.

A dyad is fitted by a sum of squares wᵀ G w whose features w are bilinear in what is sought (the
coordinates of two pivots, or a line's normal and a pivot).  Exact poses are linear conditions
A w = 0 on the same features; a link of given length, or the unit length of a normal, is one
quadratic condition.  With multipliers that is a square polynomial system which depends on
(G, A, l, R) linearly.  How many solutions it has for generic complex parameters depends on its
shape alone; `start_points.npz` holds them all for one set of parameters (found by monodromy, see
`scripts/start_points`), and when the parameters are carried over to those of a task, every
isolated solution of the task is reached with probability one.

What is reached is counted: paths that end far away belong to solutions at infinity.
"""

from __future__ import annotations

from functools import cache
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

__all__ = [
    "Parameters",
    "Shape",
    "Stationary",
    "circle_shape",
    "follow",
    "line_shape",
    "stationary",
]

ComplexArray = NDArray[np.complex128]
Condition: TypeAlias = Literal["none", "soft", "hard"]

LOOSE, TIGHT = 1e-3, 1e-10  # relative: how far a prediction may be off; how well it is corrected
FAR = 1e7  # where a path is given up
SLOW, FAST = 0.1, 5.0  # how fast one grows, as a power of the way left, that ends at infinity
SHORT = 1e-10  # a step this short has met a singular point
STEPS = 2000
REAL = 1e-7  # relative imaginary part that rounding leaves
SAME = 1e-6
DETOURS = 2  # other ways tried where paths were lost
RUNNING, LOST, ARRIVED, AWAY = -1, 0, 1, 2  # states of a path


class Shape(NamedTuple):
    """What sort of system it is, in unknowns x (n,).

    Its features are w = constant + linear x + x bend x / 2.
    name: of its solutions in `start_points.npz`.
    squares: (n,), of the quadratic condition  squares · x² + l · w = R, plus its own multiplier t
    where it is soft (then t² joins the sum of squares, and t is the mean of the residual);
    conditions: the number of rows of A.
    """

    name: str
    constant: FloatArray
    linear: FloatArray
    bend: FloatArray
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

    def features(self, x: NDArray[Any]) -> NDArray[Any]:
        """The features w (*, f) at x (*, n)."""
        bent = np.einsum("...i,fij,...j->...f", x, self.bend, x) / 2
        return np.asarray(self.constant + x @ self.linear.T + bent)


class Parameters(NamedTuple):
    """What a system depends on, linearly: G (*, f, f), A (*, k, f), l (*, f), R (*,)."""

    gram: NDArray[Any]
    rows: NDArray[Any]
    linear: NDArray[Any]
    square: NDArray[Any]


class Stationary(NamedTuple):
    """The real stationary points of one system, and how its paths ended.

    points: (k, n); minimum: (k,), which are least where the conditions hold, locally.
    found: different finite ends, complex ones included; away: paths to infinity; lost: paths that
    ended nowhere, so that a point may be missing.
    """

    points: FloatArray
    minimum: NDArray[np.bool_]
    found: int
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
        bend = _bends(n, [{(0, 2): 1, (1, 3): 1}, {(1, 2): 1, (0, 3): -1}])
    else:
        pairs = [(i, fixed + j) for i in range(fixed) for j in range(moving)]
        bend = _bends(n, [{pair: 1} for pair in pairs])
    name = f"circle-{fixed}{moving}-{conditions}-{quadratic}"
    return _shape(name, linear, bend, np.ones(n), conditions, quadratic)


@cache
def line_shape(moving: int, conditions: int) -> Shape:
    """The normal of a line (2) and a pivot v free in `moving` dimensions: a PR dyad.

    Features: n and its products with v; if v is free, only n · v and n x v.  |n| = 1.
    """
    size = 2 + moving
    linear = np.eye(size)[:2]
    if moving == 2:
        bend = _bends(size, [{(0, 2): 1, (1, 3): 1}, {(1, 2): 1, (0, 3): -1}])
    else:
        bend = _bends(size, [{(i, 2): 1} for i in range(2 * moving)])
    squares = np.array([1.0, 1.0, 0.0, 0.0])[:size]
    shape = _shape(f"line-{moving}-{conditions}", linear, bend, squares, conditions, "hard")
    return shape._replace(constant=np.zeros_like(shape.constant))


def _bends(n: int, products: list[dict[tuple[int, int], int]]) -> FloatArray:
    bend = np.zeros((len(products), n, n))
    for one, product in zip(bend, products, strict=True):
        for (i, j), sign in product.items():
            one[i, j] = one[j, i] = sign
    return bend


def _shape(  # noqa: PLR0917
    name: str,
    linear: FloatArray,
    bend: FloatArray,
    squares: FloatArray,
    conditions: int,
    quadratic: Condition,
) -> Shape:
    flat, n = len(linear), len(squares)
    linear = np.concatenate([linear, np.zeros((len(bend), n))])
    bend = np.concatenate([np.zeros((flat, n, n)), bend])
    return Shape(name, np.eye(len(linear))[0], linear, bend, squares, conditions, quadratic)


def stationary(shape: Shape, target: Parameters) -> list[Stationary]:
    """The real stationary points of systems of one shape, parameters with one leading axis (T,)."""
    start, points = _start(shape.name)
    ends, state = _carried(shape, points, start, target)
    rng = np.random.default_rng(0)
    for _ in range(DETOURS):
        again = np.flatnonzero((state == LOST).any(axis=1))
        if not len(again):
            break
        # A path that came too near to infinity goes elsewhere if it begins elsewhere.
        turns = np.exp(2j * np.pi * rng.random(len(start)))
        turned = Parameters(*(a * turn for a, turn in zip(start, turns, strict=True)))
        begin, came = _carried(shape, points, start, Parameters(*(a[None] for a in turned)))
        if (came != ARRIVED).any():
            continue
        some = Parameters(*(a[again] for a in target))
        other_ends, other_state = _carried(shape, begin[0], turned, some)
        fewer = (other_state == LOST).sum(axis=1) < (state[again] == LOST).sum(axis=1)
        ends[again[fewer]], state[again[fewer]] = other_ends[fewer], other_state[fewer]
    return [
        _sorted_out(shape, ends[k], state[k], Parameters(*(a[k] for a in target)))
        for k in range(len(state))
    ]


def _carried(
    shape: Shape, points: ComplexArray, start: Parameters, target: Parameters
) -> tuple[ComplexArray, NDArray[np.int_]]:
    """The points (k, size), carried over to each of the targets (T,), and their state (T, k)."""
    tasks = len(target.square)
    ends, state = follow(
        shape,
        np.tile(points, (tasks, 1)),
        Parameters(*(a[None] for a in start)),
        Parameters(*(np.repeat(a, len(points), axis=0) for a in target)),
    )
    return ends.reshape(tasks, len(points), -1), state.reshape(tasks, len(points))


def _sorted_out(
    shape: Shape, ends: ComplexArray, state: NDArray[np.int_], p: Parameters
) -> Stationary:
    arrived = distinct(ends[state == ARRIVED])
    real = (np.abs(arrived.imag) < REAL * _sizes(shape, arrived)).all(axis=1)
    x = arrived[real].real
    for _ in range(2):
        x = x - _newton(shape, x, p)
    # Where the reduced Hessian is positive, each condition brings one negative eigenvalue.
    negative = (np.linalg.eigvalsh(jacobian(shape, x, p)) < 0).sum(axis=-1)
    minimum = negative == shape.size - shape.unknowns
    away, lost = int((state == AWAY).sum()), int((state == LOST).sum())
    return Stationary(x[:, : shape.unknowns], minimum, len(arrived), away, lost)


def distinct(points: ComplexArray) -> ComplexArray:
    """Each point (k, n) once."""
    size = 1 + np.abs(points).max(axis=1, initial=0)
    apart = np.abs(points[:, None] - points[None]).max(axis=-1, initial=0)
    once: ComplexArray = points[~np.tril(apart < SAME * size, -1).any(axis=1)]
    return once


@cache
def _start(name: str) -> tuple[Parameters, ComplexArray]:
    """The generic parameters of a shape, and all solutions (k, size) there."""
    from importlib import resources  # noqa: PLC0415  tasks without limits do without it

    with (
        resources.files("burmester.dyads").joinpath("start_points.npz").open("rb") as file,
        np.load(file, allow_pickle=False) as table,
    ):
        *parameters, points = (table[f"{name}/{part}"] for part in (*Parameters._fields, "points"))
    return Parameters(*parameters), points


# --- the system, its derivatives, and the way from one set of parameters to another


def equations(shape: Shape, x: NDArray[Any], p: Parameters, own: float = 1.0) -> NDArray[Any]:
    """The equations (*, size) at x (*, size); own: 0 leaves out what no parameter multiplies."""
    n, k = shape.unknowns, shape.conditions
    at, multipliers = x[..., :n], x[..., n : n + k]
    w, slope = shape.features(at), _slope(shape, at)
    pull = _times(p.gram, w) + _times(np.swapaxes(p.rows, -1, -2), multipliers)
    parts = [_times(p.rows, w)]
    if shape.quadratic != "none":
        t = x[..., -1:]
        pull = pull + t * p.linear
        gap = own * (shape.squares * at * at).sum(axis=-1) + (p.linear * w).sum(axis=-1) - p.square
        if shape.quadratic == "soft":
            gap = gap - own * t[..., 0]
        parts.append(gap[..., None])
    gradient = _times(slope, pull)
    if shape.quadratic != "none":
        gradient = gradient + 2 * own * t * shape.squares * at
    return np.concatenate([gradient, *parts], axis=-1)


def jacobian(shape: Shape, x: NDArray[Any], p: Parameters) -> NDArray[Any]:
    """The derivatives (*, size, size) of the equations by x: a symmetric matrix."""
    n, k = shape.unknowns, shape.conditions
    at, multipliers = x[..., :n], x[..., n : n + k]
    w, slope = shape.features(at), _slope(shape, at)
    pull = _times(p.gram, w) + _times(np.swapaxes(p.rows, -1, -2), multipliers)
    matrix = np.zeros((*x.shape, x.shape[-1]), dtype=np.result_type(x, p.gram))
    border = slope @ np.swapaxes(p.rows, -1, -2)
    matrix[..., :n, n : n + k] = border
    matrix[..., n : n + k, :n] = np.swapaxes(border, -1, -2)
    if shape.quadratic != "none":
        t = x[..., -1:]
        pull = pull + t * p.linear
        column = _times(slope, p.linear) + 2 * shape.squares * at
        matrix[..., :n, -1] = matrix[..., -1, :n] = column
        matrix[..., -1, -1] = -1.0 if shape.quadratic == "soft" else 0.0
        matrix[..., range(n), range(n)] += 2 * t * shape.squares
    curved = np.tensordot(pull, shape.bend, axes=1)
    matrix[..., :n, :n] += slope @ p.gram @ np.swapaxes(slope, -1, -2) + curved
    return matrix


def _slope(shape: Shape, x: NDArray[Any]) -> NDArray[Any]:
    """The derivatives (*, n, f) of the features."""
    return np.asarray(shape.linear.T + np.einsum("fij,...j->...if", shape.bend, x))


def _times(matrix: NDArray[Any], vector: NDArray[Any]) -> NDArray[Any]:
    return np.asarray((matrix @ vector[..., None])[..., 0])


def _newton(shape: Shape, x: NDArray[Any], p: Parameters) -> NDArray[Any]:
    """Newton's step at x, or nan where there is none."""
    return _solve(jacobian(shape, x, p), equations(shape, x, p))


def _solve(matrix: NDArray[Any], right: NDArray[Any]) -> NDArray[Any]:
    try:
        return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])
    except np.linalg.LinAlgError:  # one of them is exactly singular
        return np.asarray((np.linalg.pinv(matrix) @ right[..., None])[..., 0])


def follow(
    shape: Shape, points: ComplexArray, start: Parameters, end: Parameters
) -> tuple[ComplexArray, NDArray[np.int_]]:
    """Solutions (P, size) of the systems `start`, carried over to those of `end` (P or 1 each).

    A straight way in the parameters; Runge and Kutta's prediction, Newton's correction, steps that
    adapt.  With the ends their state (P,): ARRIVED, AWAY (to infinity) or LOST; which of the
    last two is told by how fast a path runs when it is given up, a heuristic.
    """
    x = points.copy()
    count = len(x)
    start, end = (
        Parameters(*(np.broadcast_to(a, (count, *a.shape[1:])) for a in p)) for p in (start, end)
    )
    change = Parameters(*(b - a for a, b in zip(start, end, strict=True)))
    # Multipliers grow at a singular point of the conditions; where these leave no freedom, that
    # means nothing but two solutions close together.
    watched = shape.unknowns if shape.size == 2 * shape.unknowns else shape.size
    done, step, state = np.zeros(count), np.full(count, 0.05), np.full(count, RUNNING)
    for _ in range(STEPS):
        run = np.flatnonzero(state == RUNNING)
        if not len(run):
            break
        s, h, y = done[run], np.minimum(step[run], 1 - done[run]), x[run]
        change_run, start_run = (Parameters(*(a[run] for a in p)) for p in (change, start))

        def there(s: FloatArray, a: Parameters = start_run, b: Parameters = change_run) -> Any:
            return Parameters(
                *(u + s.reshape(-1, *(1,) * (u.ndim - 1)) * v for u, v in zip(a, b, strict=True))
            )

        def flow(y: Any, s: FloatArray, b: Parameters = change_run, at: Any = there) -> Any:
            return -_solve(jacobian(shape, y, at(s)), equations(shape, y, b, own=0.0))

        with np.errstate(all="ignore"):
            half = h[:, None] / 2
            k1 = flow(y, s)
            k2 = flow(y + half * k1, s + h / 2)
            k3 = flow(y + half * k2, s + h / 2)
            k4 = flow(y + 2 * half * k3, s + h)
            guess = y + half / 3 * (k1 + 2 * k2 + 2 * k3 + k4)
            better, p = guess, there(s + h)
            for _ in range(3):
                last = _newton(shape, better, p)
                better = better - last
            size = _sizes(shape, better)
            good = ((np.abs(last) < TIGHT * size) & (np.abs(better - guess) < LOOSE * size)).all(
                axis=1
            )
        went = run[good]
        x[went], done[went] = better[good], (s + h)[good]
        step[run] = np.where(good, 1.7 * h, h / 3)
        # A point at infinity of the end comes as a power of the way left, so at a steady rate; one
        # that is passed on the way comes much faster, and a singular point stands still.
        rate = (np.abs(k1) * (1 - s)[:, None] / _sizes(shape, y))[:, :watched].max(axis=1)
        stop = (step[run] < SHORT) | (_sizes(shape, x[run])[:, 0] > FAR)
        state[run[stop]] = np.where((rate > SLOW) & (rate < FAST), AWAY, LOST)[stop]
        state[went[done[went] >= 1]] = ARRIVED
    state[state == RUNNING] = LOST
    return x, state


def _sizes(shape: Shape, x: NDArray[Any]) -> FloatArray:
    """How great each of x (*, size) may be said to be: multipliers have a size of their own."""
    size = np.empty(x.shape)
    for group in (slice(0, shape.unknowns), slice(shape.unknowns, None)):
        size[..., group] = 1 + np.abs(x[..., group]).max(axis=-1, keepdims=True, initial=0)
    return size
