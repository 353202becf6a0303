"""All common zeros of the four derivatives of F = vᵀ G v, for `critical_points`, by linear algebra.

In the isotropic coordinates z = (c, c*, m, m*), with c = c1 + i c2 and c* = c1 - i c2 taken for
independent unknowns, the seven numbers of `critical_points` become (up to a change of basis) the
monomials V = (1, c, c*, m, m*, c* m, c m*), and the derivatives are sums of a few monomials only.
Multiplied by further monomials, as long as all stays within the 150 products of three of V and
one of its first five, they give 148 polynomials, of which 125 are independent (for a generic
G; counted).  Their coefficients are the rows of a 125 x 150 matrix (Macaulay's).  Its null
space has dimension 25 and is spanned by the monomials of the zeros; the quotient of two linear
forms in (1, c1, c2) acts on it as a 25 x 25 matrix whose eigenvectors the zeros are.

The matrix is kept real: monomials that are each other's conjugates are replaced by their real and
imaginary parts, so complex zeros come in conjugate pairs.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray

Exponents = tuple[int, int, int, int]  # of c, c*, m, m*

NO_COEFFICIENT = 1e-12  # a coefficient of the polynomials below this is rounding
CHARTS = 4  # pairs of linear forms, of which another is tried where zeros are lost

_ONE, _C, _CC, _M, _MM = ((0, 0, 0, 0), (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
_V: list[Exponents] = [_ONE, _C, _CC, _M, _MM, (0, 1, 1, 0), (1, 0, 0, 1)]

# Two generic linear forms in (1, c1, c2), one pair for each chart: random numbers, written down
# because `numpy.random` takes long to load.
_FORMS = np.array(
    [
        [
            [0.03419276725318417, 1.3597475403099617, 1.2247210785859324],
            [-0.5103070767876675, -0.2979695111064471, -0.5273841930334252],
        ],
        [
            [0.5697263575719601, -0.056064439045617594, 0.7468856162565439],
            [-1.8473247989741095, 1.5665487746995206, -0.09643216015562055],
        ],
        [
            [0.6803784532741461, -0.13656633397682774, -0.3790985670748533],
            [0.46311015859758675, 0.824513527530113, -0.20252987069345152],
        ],
        [
            [-0.15278617857019708, 0.685698610809258, -0.8703406419471712],
            [-1.5143835037313955, 0.39498186274953, -0.6705658236878794],
        ],
    ]
)
# Of the 148 polynomials those that depend on the others, which Gram-Schmidt with pivoting takes
# first, for a generic G.
_DEPENDENT = frozenset(
    {
        *(2, 3, 10, 11, 17, 21, 28, 29, 30, 31, 34, 40),
        *(55, 65, 81, 82, 83, 97, 118, 119, 121, 135, 138),
    }
)


class _Template(NamedTuple):
    """Where the entries of G go in the Macaulay matrix, and what its columns mean; built once."""

    entry: NDArray[np.int_]  # place in the flattened 125 x 150 matrix
    source: NDArray[np.int_]  # place in the flattened 7 x 7 matrix
    factor: FloatArray
    shape: tuple[int, int]
    real: NDArray[np.int_]  # (150,): the columns with the real and imaginary parts of a monomial
    imaginary: NDArray[np.int_]
    weights: ComplexArray  # (2, 150, 1): by which they are counted
    times: list[NDArray[np.int_]]  # (2, k): monomials, and those times c, c*, m, m*
    shifts: NDArray[np.int_]  # (3, k): monomials, and those times c and c*


def eigen_points(gram: FloatArray, chart: int) -> tuple[ComplexArray, float]:
    """The 25 zeros (25, 4), (c1, c2, m1, m2), of the derivatives of vᵀ G v, and the health.

    gram: G (7, 7).  The health is the least relative pivot of the 125 rows; rounding is magnified
    by its inverse, and multiple zeros come out apart by a root of it.
    """
    t = _template()
    values = t.factor * gram.ravel()[t.source]
    matrix = np.bincount(t.entry, values, t.shape[0] * t.shape[1]).reshape(t.shape)
    size = np.linalg.norm(matrix, axis=1, keepdims=True)
    unit = np.divide(matrix, size, out=np.zeros_like(matrix), where=size > 0)
    q, r = np.linalg.qr(unit.T, mode="complete")
    null = q[:, t.shape[0] :]
    monomials = t.weights[0] * null[t.real] + t.weights[1] * null[t.imaginary]
    one, c, cc = monomials[t.shifts]
    first, second = (
        a * one + (b - 1j * d) / 2 * c + (b + 1j * d) / 2 * cc for a, b, d in _FORMS[chart]
    )
    u, upper = np.linalg.qr(np.concatenate([first.real, first.imag]))
    right = u.T @ np.concatenate([second.real, second.imag])
    _, vectors = np.linalg.eig(np.linalg.lstsq(upper, right, rcond=None)[0])
    values_at = monomials @ vectors
    c, cc, m, mm = (column_ratio(values_at[low], values_at[high]) for low, high in t.times)
    zeros = np.stack([(c + cc) / 2, (c - cc) / 2j, (m + mm) / 2, (m - mm) / 2j], axis=-1)
    return zeros, float(np.abs(np.diag(r)).min())


def column_ratio(low: ComplexArray, high: ComplexArray) -> ComplexArray:
    """The factors (*, k) that take columns of `low` to those of `high`, by least squares."""
    size = np.maximum((np.abs(low) ** 2).sum(axis=-2), np.finfo(float).tiny)
    return np.asarray((low.conj() * high).sum(axis=-2) / size)


def _add(e: Exponents, f: Exponents) -> Exponents:
    return (e[0] + f[0], e[1] + f[1], e[2] + f[2], e[3] + f[3])


@cache
def _template() -> _Template:
    """The sparsity pattern of the Macaulay matrix, with 125 independent rows picked."""
    products_of_two = {_add(a, b) for a, b in product(_V, _V)}
    products_of_three = {_add(a, b) for a, b in product(products_of_two, _V)}
    columns = sorted({_add(a, b) for a, b in product(products_of_three, _V[:5])})
    at = {e: k for k, e in enumerate(columns)}
    conjugates = _Conjugates.of(np.array([at[b, a, d, c] for a, b, c, d in columns]))
    found, number = [], 0
    for terms in (_derivative(0), _derivative(2)):
        shifts = list(_shifts(terms, columns))
        monomial = np.array([[at[_add(shift, e)] for e, _ in terms] for shift in shifts])
        term, of = np.nonzero([coefficients for _, coefficients in terms])
        value = np.array([coefficients for _, coefficients in terms])[term, of]
        column, value = conjugates.spread(monomial[:, term], value)
        row = np.arange(len(shifts))[:, None, None]
        place = (row * len(columns) + column) * 49 + of[:, None]
        place, same = np.unique(place.ravel(), return_inverse=True)
        for part, values in enumerate((value.real, value.imag)):
            coefficient = np.bincount(same.ravel(), values.ravel())
            some = np.abs(coefficient) > NO_COEFFICIENT
            row, entry = np.divmod(place[some], 49 * len(columns))
            found.append((number + 2 * row + part, entry, coefficient[some]))
        number += 2 * len(shifts)
    polynomial, entry, factor = (np.concatenate(each) for each in zip(*found, strict=True))
    independent = np.ones(number, dtype=bool)
    independent[list(_DEPENDENT)] = False
    kept = np.flatnonzero(independent[polynomial])
    kept = kept[np.argsort(polynomial[kept], kind="stable")]
    rank = np.cumsum(independent) - 1
    column, source = np.divmod(entry[kept], 49)

    def products(*factors: Exponents) -> NDArray[np.int_]:
        """The columns of monomials, and those of their products with each of some factors."""
        fit = [e for e in columns if all(_add(e, factor) in at for factor in factors)]
        return np.array([[at[_add(e, factor)] for e in fit] for factor in (_ONE, *factors)])

    return _Template(
        rank[polynomial[kept]] * len(columns) + column,
        source,
        factor[kept],
        (int(independent.sum()), len(columns)),
        conjugates.real,
        conjugates.imaginary,
        conjugates.weights[..., None],
        [products(factor) for factor in (_C, _CC, _M, _MM)],
        products(_C, _CC),
    )


class _Conjugates(NamedTuple):
    """Complex monomials (n,) by real columns: one for the real part, one for the imaginary one.

    Of two monomials that are conjugates, both use the same two columns.  A monomial is
    weights[0] times the column `real` plus weights[1] times the column `imaginary`.
    """

    real: NDArray[np.int_]
    imaginary: NDArray[np.int_]
    weights: ComplexArray

    @classmethod
    def of(cls, conjugate: NDArray[np.int_]) -> _Conjugates:
        """For monomials whose conjugates have the given numbers (n,)."""
        own = np.arange(len(conjugate))
        side = np.sign(conjugate - own)  # 0: the monomial is its own conjugate, and real
        weights = np.array([np.where(side == 0, 1, np.sqrt(0.5)), 1j * np.sqrt(0.5) * side])
        return cls(np.minimum(own, conjugate), np.maximum(own, conjugate), weights)

    def spread(
        self, monomial: NDArray[np.int_], coefficient: ComplexArray
    ) -> tuple[NDArray[np.int_], ComplexArray]:
        """The real columns (*, 2) of monomials (*,), and what coefficients (*,) give to each."""
        column = np.stack([self.real[monomial], self.imaginary[monomial]], axis=-1)
        weights = np.moveaxis(self.weights[:, monomial], 0, -1)
        return column, weights * coefficient[..., None]


def _features_by_monomials() -> ComplexArray:
    """The matrix (7, 7) that makes v = (1, c1, c2, m1, m2, c · m, c x m) of the monomials V."""
    matrix = np.zeros((7, 7), dtype=complex)
    matrix[0, 0] = 1
    for k in (1, 3):
        matrix[k, [k, k + 1]], matrix[k + 1, [k, k + 1]] = [0.5, 0.5], [-0.5j, 0.5j]
    matrix[5, 5:], matrix[6, 5:] = [0.5, 0.5], [0.5j, -0.5j]
    return matrix


def _derivative(unknown: int) -> list[tuple[Exponents, ComplexArray]]:
    """The derivative of F by c (0) or m (2): exponents of its terms, and what they have of G.

    A term's coefficient is the product of its (49,) numbers with the flattened G.  The derivatives
    by c* and m* are the conjugates of these two, so real and imaginary parts stand for both.
    """
    basis = _features_by_monomials()
    return [
        (_add(_lowered(_V[i], unknown), _V[j]), np.outer(basis[:, i], basis[:, j]).ravel())
        for i, j in product(range(7), range(7))
        if _V[i][unknown]
    ]


def _shifts(
    terms: list[tuple[Exponents, ComplexArray]], columns: list[Exponents]
) -> Iterator[Exponents]:
    """The monomials by which a polynomial is multiplied to have all terms among the columns."""
    among = set(columns)
    low = min(exponents for exponents, _ in terms)
    for e in columns:
        shift = (e[0] - low[0], e[1] - low[1], e[2] - low[2], e[3] - low[3])
        if min(shift) >= 0 and all(_add(shift, exponents) in among for exponents, _ in terms):
            yield shift


def _lowered(e: Exponents, k: int) -> Exponents:
    """The exponents of the derivative by unknown k of a monomial linear in it."""
    return (e[0] - (k == 0), e[1] - (k == 1), e[2] - (k == 2), e[3] - (k == 3))
