"""All solutions of many systems of one shape at once, by linear algebra.

The equations of a shape are multiplied by monomials: rows of a Macaulay matrix, whose columns are
monomials (`template`).  The values of these monomials at the solutions span its null
space, and what multiplication by a linear form does there has the solutions as its eigenvectors.
"""

from __future__ import annotations

import os
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray, take
from burmester.polynomials.bilinear_fit import Parameters, Shape
from burmester.polynomials.macaulay import column_ratio

BALANCE = 0.4  # target ratio of linear to bilinear terms; the result is not sensitive to it
ENTRIES_AT_ONCE = 2_000_000  # of matrices; bounds the memory


TEMPLATES = "elimination_templates.npz"
CHARTS = 4  # choices of random forms, of which another is tried where solutions are lost
SHIFT = 0.5  # of the origin, in units; so that no coefficient vanishes by symmetry
NOISE = 1e-15  # added to the entries, relative, so that no matrix is exactly singular
TINY = 1e-12  # coefficients of polynomials below this are rounding

Exponents = NDArray[np.int_]


def eigen_points(
    shape: Shape, p: Parameters, number: int
) -> tuple[ComplexArray, NDArray[np.bool_]]:
    """Approximate solutions x (T, k, n), without multipliers, of systems (T,) of one shape.

    number: of the chart.  Also returns which of them (T, k) are conjugates of those before them.
    """
    at_once = max(1, ENTRIES_AT_ONCE // template(shape).columns ** 2)
    starts = range(0, len(p.square), at_once)
    parts = [_eigen_points(shape, take(p, slice(k, k + at_once)), number) for k in starts]
    points, lower = zip(*parts, strict=True)
    return np.concatenate(points), np.concatenate(lower)


def _eigen_points(
    shape: Shape, p: Parameters, number: int
) -> tuple[ComplexArray, NDArray[np.bool_]]:
    t, c = template(shape), chart(shape, number)
    unit, values = in_chart(shape, p, c)
    terms = np.concatenate([values.real, values.imag], axis=-1)[:, t.source] * t.factor
    matrix = np.zeros((len(terms), t.columns, t.columns))
    matrix.reshape(len(terms), -1)[:, t.place] = np.add.reduceat(terms, t.start, axis=1)
    rows = matrix[:, : t.rows]
    rows /= np.maximum(np.linalg.norm(rows, axis=-1, keepdims=True), np.finfo(float).tiny)
    rows += c.noise
    matrix[:, t.rows :] = c.border
    null = np.linalg.solve(matrix, np.broadcast_to(c.right, (len(terms), *c.right.shape)))
    basis = np.linalg.qr(null[:, : t.trusted])[0]
    values, vectors = np.linalg.eig(np.linalg.solve(c.first @ basis, c.second @ basis))
    at = (t.monomials @ basis) @ vectors
    z = np.stack([column_ratio(at[:, low], at[:, high]) for low, high in t.times], axis=-1)
    x = (z @ isotropic(shape).unknowns.T) @ c.turn.T + c.shift
    return x * unit[:, None], values.imag < 0


def in_chart(shape: Shape, p: Parameters, c: Chart) -> tuple[FloatArray, ComplexArray]:
    """Units (T, n), and the parameters (T, m) of the Lagrangian in these and in a chart.

    The units are such that the pivots weigh as much as their products do; where the body turns
    little they are long, as the pivots are then far away.
    """
    circle = bool(shape.constant.any())
    pivots = np.full(shape.unknowns, True) if circle else shape.squares == 0  # not the normal
    bilinear, alone = shape.second.any(axis=(1, 2)), shape.linear @ np.ones(shape.unknowns) > 0
    degree = (1 if circle else 0) * alone + (2 if circle else 1) * bilinear
    unit = np.ones(len(p.square))
    if bilinear.any():
        squares = np.diagonal(p.gram, axis1=1, axis2=2) + (p.rows**2).sum(axis=1)
        linear, products = (squares[:, of].sum(axis=1) for of in (alone, bilinear))
        fit = (linear > 0) & (products > 0)
        unit[fit] = BALANCE * np.sqrt(linear[fit] / products[fit])
    by = unit[:, None] ** degree
    gram, rows = p.gram * by[:, :, None] * by[:, None], p.rows * by[:, None]
    size, lengths = np.linalg.norm(gram, axis=(1, 2)), np.linalg.norm(rows, axis=-1)
    size[size == 0], lengths[lengths == 0] = 1.0, 1.0
    square = unit**2 if circle else np.ones(len(unit))
    # The squares of x = turn y + shift are those of y, and linear terms.
    linear = (p.linear * by / square[:, None]) @ c.features
    linear = linear + 2 * (shape.squares * c.shift) @ c.turn @ shape.linear.T @ c.isotropic
    rest = p.square / square - (shape.squares * c.shift**2).sum()
    parts = [
        (c.features.T @ (gram / size[:, None, None]) @ c.features).reshape(len(unit), -1),
        (rows / lengths[..., None] @ c.features).reshape(len(unit), -1),
        linear,
        np.stack([rest, np.ones(len(unit)), size / square**2], axis=-1),
    ]
    return np.where(pivots, unit[:, None], 1.0), np.concatenate(parts, axis=-1)


class Template(NamedTuple):
    """Where the parameters go in the Macaulay matrix, and what its columns mean.

    rows, columns: of the matrix; trusted: how many columns, the first ones, hold the solutions and
    nothing else; solutions: how many of them there are, at infinity included.
    place, start: the entries by their flattened places, and where their terms begin in source
    (number of a parameter, real parts first, then imaginary ones) and factor.
    monomials: (trusted, trusted), the monomials by their real and imaginary parts.
    times: for each unknown (2, k), monomials, and those times the unknown.
    multiplied: (1 + j, k), monomials, and those times each of j unknowns, of which forms are made;
    by_unknowns: (n, j), the factors of these in the coordinates.
    """

    rows: int
    columns: int
    trusted: int
    solutions: int
    place: NDArray[np.int_]
    start: NDArray[np.int_]
    source: NDArray[np.int_]
    factor: FloatArray
    monomials: ComplexArray
    times: list[NDArray[np.int_]]
    multiplied: NDArray[np.int_]
    by_unknowns: ComplexArray


class Chart(NamedTuple):
    """Random choices: rows that complete the matrix, their right side, two forms, and noise.

    turn (n, n), shift (n,): coordinates y, with x = turn y + shift in units of a system, in which
    nothing is special.  features: (f, f), those at x by monomials of the isotropic ones of y;
    isotropic: those at y.
    """

    border: FloatArray
    right: FloatArray
    first: FloatArray
    second: FloatArray
    noise: FloatArray
    turn: FloatArray
    shift: FloatArray
    features: ComplexArray
    isotropic: ComplexArray


class Isotropic(NamedTuple):
    """Unknowns and features by isotropic coordinates z: x = unknowns z, w = features z^exponents.

    squares: (k, n) and (k,), the exponents and factors of the quadratic condition.
    conjugate: (n,), which coordinate is the conjugate of which.
    """

    unknowns: ComplexArray
    exponents: Exponents
    features: ComplexArray
    squares: tuple[Exponents, ComplexArray]
    conjugate: NDArray[np.int_]


def finite_count(shape: Shape) -> int:
    """How many finite solutions systems of a shape have for generic poses; 0 without a template."""
    stored = _stored(_kept(shape))
    return int(stored[-1][0]) if stored else 0


@cache
def template(shape: Shape) -> Template:
    """The template of a shape."""
    columns, rows, forms, (_, solutions, trusted) = _choice(shape)
    row, column, source, factor = matrix_terms(shape, columns, rows[:, 1:], rows[:, 0] > 0)
    place = row * len(columns) + column
    order = np.argsort(place, kind="stable")
    place, start = np.unique(place[order], return_index=True)
    at = {tuple(e): k for k, e in enumerate(columns[:trusted].tolist())}

    def products(unknowns: NDArray[np.int_]) -> NDArray[np.int_]:
        """The numbers of monomials, and of their products with each of some unknowns."""
        one = np.eye(shape.size, dtype=int)[unknowns]
        found = [[at.get(tuple(f)) for f in (e + one).tolist()] for e in columns[:trusted]]
        complete = [[k, *more] for k, more in enumerate(found) if None not in more]
        return np.array(complete, dtype=int).T

    return Template(
        len(rows),
        len(columns),
        int(trusted),
        int(solutions),
        place,
        start,
        source[order],
        factor[order],
        monomials_by_parts(shape, columns[:trusted]),
        [products(np.array([i])) for i in range(shape.unknowns)],
        products(forms),
        isotropic(shape).unknowns[:, forms],
    )


@cache
def chart(shape: Shape, number: int) -> Chart:
    """Random choices for a shape, the same in every run."""
    t = template(shape)
    rng = np.random.default_rng([number, t.columns])
    missing = t.columns - t.rows
    first, second = (
        np.tensordot([constant, *(linear @ t.by_unknowns)], t.monomials[t.multiplied], axes=1)
        for constant, *linear in rng.normal(size=(2, 1 + shape.unknowns))
    )
    turn, shift = np.eye(shape.unknowns), SHIFT * rng.normal(size=shape.unknowns)
    for k in shape.planes:
        turn[k : k + 2, k : k + 2] = np.linalg.qr(rng.normal(size=(2, 2)))[0]
    if not shape.constant.any():  # normals keep their length
        shift[:2] = 0.0
    y = rng.normal(size=(4 * len(shape.constant), shape.unknowns))
    moved = np.linalg.lstsq(shape.features(y), shape.features(y @ turn.T + shift))[0]
    some = np.linalg.qr(rng.normal(size=(2 * len(first), t.solutions)))[0].T
    right = np.zeros((t.columns, t.solutions))
    right[t.rows :] = np.linalg.qr(rng.normal(size=(missing, t.solutions)))[0]
    return Chart(
        rng.normal(size=(missing, t.columns)) / np.sqrt(t.columns),
        right,
        some @ np.concatenate([first.real, first.imag]),
        some @ np.concatenate([second.real, second.imag]),
        NOISE * rng.normal(size=(t.rows, t.columns)),
        turn,
        shift,
        moved.T @ isotropic(shape).features,
        isotropic(shape).features,
    )


def matrix_terms(
    shape: Shape, columns: Exponents, rows: NDArray[np.int_], imaginary: NDArray[np.bool_]
) -> tuple[NDArray[np.int_], NDArray[np.int_], NDArray[np.int_], FloatArray]:
    """Row, column, source and factor of each term of a real Macaulay matrix.

    columns: exponents (c, size).  rows: (r, 1 + size), the number of the unknown by which the
    Lagrangian is derived, and the exponents of the monomial by which that is multiplied;
    imaginary: (r,), whether the row is the imaginary part of this.
    """
    exponents, source, factor, parameters = lagrangian(shape)
    code = (int(columns.max()) + 2) ** np.arange(shape.size)  # a number for each monomial
    order = np.argsort(columns @ code)
    codes = (columns @ code)[order]
    weights = monomials_by_parts(shape, columns)
    conjugate = _conjugates(shape, columns)
    low, high = np.minimum(*conjugate), np.maximum(*conjugate)
    parts: list[tuple[NDArray[Any], ...]] = []
    for i in range(shape.size):
        row, term = np.flatnonzero(rows[:, 0] == i)[:, None], np.flatnonzero(exponents[:, i])
        shifted = (rows[row[:, 0], 1:] @ code)[:, None] + exponents[term] @ code - code[i]
        monomial = order[np.searchsorted(codes, shifted)]
        # The imaginary part of a number is the real part of it times -i.
        value = factor[term] * exponents[term, i] * np.where(imaginary[row], -1j, 1.0)
        for column in (low, high):
            by_part = value * weights[monomial, column[monomial]]
            by_part[(column is high) & (low == high)[monomial]] = 0.0
            for real, first in ((by_part.real, 0), (-by_part.imag, parameters)):
                kept = np.abs(real) > TINY
                place = (np.broadcast_to(each, real.shape)[kept] for each in (row, source[term]))
                at_row, at_source = place
                parts.append((at_row, column[monomial][kept], at_source + first, real[kept]))
    row, column, source, value = (np.concatenate(part) for part in zip(*parts, strict=True))
    return row, column, source, value


def monomials_by_parts(shape: Shape, columns: Exponents) -> ComplexArray:
    """The matrix (k, k) that makes monomials of their real and imaginary parts.

    Of two monomials that are conjugates, both use the same two parts, scaled to keep lengths.
    """
    own, conjugate = _conjugates(shape, columns)
    weights, paired = np.zeros((len(own), len(own)), dtype=complex), own != conjugate
    weights[own, np.minimum(own, conjugate)] = np.where(paired, np.sqrt(0.5), 1.0)
    sign = np.sign(conjugate - own)[paired]
    weights[own[paired], np.maximum(own, conjugate)[paired]] = 1j * np.sqrt(0.5) * sign
    return weights


def _conjugates(shape: Shape, columns: Exponents) -> tuple[NDArray[np.int_], NDArray[np.int_]]:
    """The numbers of monomials, and those of their conjugates."""
    order = np.concatenate([isotropic(shape).conjugate, np.arange(shape.unknowns, shape.size)])
    at = {tuple(e): k for k, e in enumerate(columns.tolist())}
    return np.arange(len(columns)), np.array([at[tuple(e)] for e in columns[:, order].tolist()])


@cache
def isotropic(shape: Shape) -> Isotropic:
    """A shape by isotropic coordinates."""
    n = shape.unknowns
    unknowns, conjugate, one = np.eye(n, dtype=complex), np.arange(n), np.eye(n, dtype=int)
    for k in shape.planes:
        unknowns[k : k + 2, k : k + 2] = [[0.5, 0.5], [-0.5j, 0.5j]]
        conjugate[[k, k + 1]] = [k + 1, k]
    i, j = np.triu_indices(n)

    def by_products(second: FloatArray) -> ComplexArray:
        """The coefficients of xᵀ second x / 2."""
        whole = unknowns.T @ second @ unknowns
        return np.asarray(whole[..., i, j] / np.where(i == j, 2, 1))

    linear = [shape.constant[:, None], shape.linear @ unknowns, by_products(shape.second)]
    features = np.concatenate(linear, axis=1)
    exponents = np.concatenate([np.zeros((1, n), dtype=int), one, one[i] + one[j]])
    used = np.abs(features).max(axis=0) > TINY
    squares = by_products(2 * np.diag(shape.squares))
    square = np.abs(squares) > TINY
    return Isotropic(
        unknowns,
        exponents[used],
        features[:, used],
        ((one[i] + one[j])[square], squares[square]),
        conjugate,
    )


def lagrangian(shape: Shape) -> tuple[Exponents, NDArray[np.int_], ComplexArray, int]:
    """The terms of wᵀ G w / 2 + λ · A w + t (squares + l · w - R) - κ t² / 2, by isotropic ones.

    Returns exponents (m, size), numbers of parameters (m,), factors (m,), and how many parameters
    there are: G, A, l, R, 1 and κ, flattened in this order.
    """
    iso, one = isotropic(shape), np.eye(shape.size, dtype=int)
    f, n, t = len(iso.exponents), shape.unknowns, one[-1]
    w, (squares, square_factors) = (
        np.pad(iso.exponents, ((0, 0), (0, shape.size - n))),
        iso.squares,
    )
    multipliers = one[n : n + shape.conditions]
    exponents = [(w[:, None] + w).reshape(-1, shape.size)]
    exponents.append((multipliers[:, None] + w).reshape(-1, shape.size))
    factors = [np.full(f * f, 0.5), np.ones(shape.conditions * f)]
    source = [np.arange((f + shape.conditions) * f)]
    at = (f + shape.conditions) * f
    if shape.quadratic != "none":
        if shape.constant.any():  # a line has no linear features besides |n|²
            exponents.append(w + t)
            factors.append(np.ones(f))
            source.append(at + np.arange(f))
        exponents += [np.pad(squares, ((0, 0), (0, shape.size - n))) + t, t[None]]
        factors += [square_factors, -np.ones(1)]
        source += [np.full(len(squares), at + f + 1), np.array([at + f])]
    if shape.quadratic == "soft":
        exponents.append(2 * t[None])
        factors.append(-0.5 * np.ones(1))
        source.append(np.array([at + f + 2]))
    factor = np.concatenate(factors).astype(complex)
    return np.concatenate(exponents), np.concatenate(source), factor, at + f + 3


def _choice(shape: Shape) -> list[NDArray[np.int_]]:
    """Columns, rows, forms and numbers of a shape, the pivots exchanged where that is kept."""
    name, n = _kept(shape), shape.unknowns
    columns, rows, forms, numbers = _stored(name)
    order = np.arange(shape.size)
    if name != shape.name:
        moving = int(name[7])
        order[:n] = np.concatenate([np.arange(moving, n), np.arange(moving)])
    place = np.argsort(order)
    rows = np.concatenate([rows[:, :1], place[rows[:, 1:2]], rows[:, 2:][:, order]], axis=1)
    return [columns[:, order], rows, place[forms], numbers]


def _kept(shape: Shape) -> str:
    """The name under which a shape is stored, or that with the pivots exchanged."""
    name = shape.name
    if name.startswith("circle") and name[7] < name[8]:
        return f"circle-{name[8]}{name[7]}{name[9:]}"
    return name


@cache
def _stored(name: str) -> list[NDArray[np.int_]]:
    """Columns, rows, forms and numbers of a stored shape; nothing of others."""
    parts = [f"{name}/{part}" for part in ("columns", "rows", "forms", "numbers")]
    with np.load(os.path.join(os.path.dirname(__file__), TEMPLATES), allow_pickle=False) as table:
        return [table[each].astype(int) for each in parts if each in table]
