"""The Macaulay matrices of each shape: which rows and columns, and what goes where.

The rows are the equations of a shape (`bilinear_fit`), derivatives of a Lagrangian, multiplied by
monomials; the columns are monomials.  Which of them are enough depends on the shape alone:
`elimination_templates.npz` holds a small choice (`scripts/elimination_templates` makes it).

Both coordinates of a pivot that is free in the plane, c1 and c2, are replaced by the isotropic ones
c1 + i c2 and c1 - i c2, in which fewer monomials occur and less lies at infinity.  The matrices are
real all the same: their columns are the real and the imaginary parts of monomials.
"""

from __future__ import annotations

import os
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.polynomials.bilinear_fit import Shape

TEMPLATES = "elimination_templates.npz"
CHARTS = 4  # choices of random forms, of which another is tried where solutions are lost
SHIFT = 0.5  # of the origin, in units; so that no coefficient vanishes by symmetry
NOISE = 1e-15  # added to the entries, relative, so that no matrix is exactly singular
TINY = 1e-12  # coefficients of polynomials below this are rounding

Exponents = NDArray[np.int_]


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
