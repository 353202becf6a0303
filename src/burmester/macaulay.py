"""The common zeros of two polynomials of degree (1, 2) and two of degree (2, 1), for `optimal`.

The derivatives of F = vᵀ G v have these degrees in (c, m).  Times all monomials up to degree
(4, 4) they are the rows of a 240 x 225 matrix (Macaulay's) of rank 192: its null space is spanned
by the monomials of the 33 zeros, those at infinity included, and the quotient of two linear forms
in c acts on it as a 33 x 33 matrix whose eigenvectors the zeros are.
"""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.displacement import FloatArray

__all__ = ["CHARTS", "ComplexArray", "eigen_points"]

ComplexArray = NDArray[np.complex128]
Exponents = tuple[int, ...]  # of c1, c2, m1, m2

RANK, DEGREE = 192, 4
CHARTS = 4  # pairs of linear forms to choose from


def _monomials(degree_c: int, degree_m: int) -> list[Exponents]:
    """All exponents of degree up to degree_c in c and up to degree_m in m."""
    in_c = [(i, j) for i in range(degree_c + 1) for j in range(degree_c + 1 - i)]
    in_m = [(i, j) for i in range(degree_m + 1) for j in range(degree_m + 1 - i)]
    return [(*c, *m) for c, m in product(in_c, in_m)]


class _Template(NamedTuple):
    """Where the entries of G go in the Macaulay matrix; built once."""

    entry: NDArray[np.int_]  # place in the flattened 192 x 225 matrix
    source: NDArray[np.int_]  # place in the flattened 7 x 7 matrix
    factor: FloatArray
    columns: int
    times: NDArray[np.int_]  # (3, 150): monomials of degree (3, 4) times 1, c1, c2
    grid: NDArray[np.int_]  # (15, 15): columns by their part in c and their part in m
    triples: NDArray[np.int_]  # (10, 3): rows (or columns) of the grid that are e, e c1, e c2


@cache
def _template() -> _Template:
    """The sparsity pattern of the Macaulay matrix, with 192 independent rows picked."""
    columns = _monomials(DEGREE, DEGREE)
    at = {e: k for k, e in enumerate(columns)}

    def add(e: Exponents, f: Exponents) -> Exponents:
        return tuple(a + b for a, b in zip(e, f, strict=True))

    # v and its derivatives as polynomials {exponents: coefficient}.
    zero, unit = (0, 0, 0, 0), [tuple(int(i == k) for i in range(4)) for k in range(4)]
    v: list[dict[Exponents, int]] = [{zero: 1}, *({u: 1} for u in unit)]
    v.append({add(unit[0], unit[2]): 1, add(unit[1], unit[3]): 1})
    v.append({add(unit[1], unit[2]): 1, add(unit[0], unit[3]): -1})

    def derivative(poly: dict[Exponents, int], k: int) -> dict[Exponents, int]:
        return {
            tuple(n - (i == k) for i, n in enumerate(e)): f * e[k] for e, f in poly.items() if e[k]
        }

    entries: list[tuple[int, int, int, int]] = []
    row = 0
    for k in range(4):
        terms = [
            (add(e, g), 7 * i + j, f * h)
            for i, j in product(range(7), range(7))
            for e, f in derivative(v[i], k).items()
            for g, h in v[j].items()
        ]
        for shift in _monomials(3, 2) if k < 2 else _monomials(2, 3):
            entries += [(row, at[add(e, shift)], source, f) for e, source, f in terms]
            row += 1
    rows, cols, source, factor = np.array(entries).T
    size = len(columns)

    # The rows obey 48 relations (Koszul's), the same for all G: drop what a generic G drops.
    a = np.random.default_rng(7).normal(size=(7, 7))
    values = factor * (a @ a.T).ravel()[source]
    matrix = np.bincount(rows * size + cols, weights=values, minlength=row * size).reshape(
        row, size
    )
    kept = _independent_rows(matrix, RANK)
    number = np.full(row, -1)
    number[kept] = np.arange(RANK)
    chosen = number[rows] >= 0
    steps = [zero, unit[0], unit[1]]
    pairs = [(i, j) for i in range(DEGREE + 1) for j in range(DEGREE + 1 - i)]
    place = {pair: k for k, pair in enumerate(pairs)}
    return _Template(
        entry=(number[rows] * size + cols)[chosen],
        source=source[chosen],
        factor=factor[chosen].astype(float),
        columns=size,
        times=np.array([[at[add(e, step)] for e in _monomials(3, DEGREE)] for step in steps]),
        grid=np.array([[at[(*c, *m)] for m in pairs] for c in pairs]),
        triples=np.array(
            [[place[(i + p, j + q)] for p, q, *_ in steps] for i, j in pairs if i + j < DEGREE]
        ),
    )


def _independent_rows(matrix: NDArray[Any], rank: int) -> NDArray[np.int_]:
    """The rows that Gram-Schmidt with pivoting takes first."""
    rest = matrix / np.linalg.norm(matrix, axis=1, keepdims=True)
    kept = []
    for _ in range(rank):
        kept.append(int(np.einsum("ij,ij->i", rest, rest).argmax()))
        axis = rest[kept[-1]] / np.linalg.norm(rest[kept[-1]])
        rest = rest - np.outer(rest @ axis, axis)
    return np.sort(np.array(kept))


# Two generic linear forms in (1, c1, c2); one pair for each chart.
_FORMS = np.random.default_rng(11).normal(size=(CHARTS, 2, 3))


def eigen_points(gram: FloatArray, chart: int) -> tuple[ComplexArray, float]:
    """The zeros (k, 4), k <= 33, of the derivatives of vᵀ G v, and the health of the matrix.

    gram: G (7, 7).  Rounding is magnified by the inverse of the health, the least relative pivot.

    Those at infinity are left out as far as rounding lets them be told.
    """
    t = _template()
    values = t.factor * gram.ravel()[t.source]
    m: NDArray[Any] = np.bincount(t.entry, values, RANK * t.columns).reshape(RANK, t.columns)
    unit = m / np.linalg.norm(m, axis=1, keepdims=True)
    q, r = np.linalg.qr(unit.T, mode="complete")
    null = q[:, RANK:]
    times = null[t.times]
    first, second = np.tensordot(_FORMS[chart], times, axes=1)
    u, upper = np.linalg.qr(first)
    _, vectors = np.linalg.eig(np.linalg.lstsq(upper, u.T @ second, rcond=None)[0])
    # The monomials of a point, as a product of those in c and those in m.
    outer = (null @ vectors).T[:, t.grid]
    c = _ratios(outer)
    moving = _ratios(np.swapaxes(outer, -1, -2))
    finite = (np.abs(c[:, 0]) > 1e-9) & (np.abs(moving[:, 0]) > 1e-9)
    points = np.concatenate(
        [c[finite, 1:] / c[finite, :1], moving[finite, 1:] / moving[finite, :1]], 1
    )
    return points, float(np.abs(np.diag(r)).min())


def _ratios(outer: ComplexArray) -> ComplexArray:
    """(1, x, y) up to a factor, of unit norm, from monomials (k, 15, 15) with rows in x, y."""
    triples = outer[:, _template().triples, :]  # (k, 10, 3, 15)
    size = np.abs(triples).sum(axis=2)
    best = size.reshape(len(outer), -1).argmax(axis=1)
    row, column = np.unravel_index(best, size.shape[1:])
    ratio = triples[np.arange(len(outer)), row, :, column]
    return np.asarray(ratio / np.linalg.norm(ratio, axis=1, keepdims=True))
