"""All common zeros of the four derivatives of F = vᵀ G v, for `critical`, by linear algebra.

In the isotropic coordinates z = (c, c*, m, m*), with c = c1 + i c2 and c* = c1 - i c2 taken for
independent unknowns, the seven numbers of `critical` become (up to a change of basis) the
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

from functools import cache
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

__all__ = ["CHARTS", "ZEROS", "ComplexArray", "eigen_points"]

ComplexArray = NDArray[np.complex128]
Exponents = tuple[int, int, int, int]  # of c, c*, m, m*

ZEROS = 25
CHARTS = 4  # pairs of linear forms to choose from

_ONE, _C, _CC, _M, _MM = ((0, 0, 0, 0), (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
_V: list[Exponents] = [_ONE, _C, _CC, _M, _MM, (0, 1, 1, 0), (1, 0, 0, 1)]

# Two generic linear forms in (1, c1, c2), one pair for each chart.
_FORMS = np.random.default_rng(11).normal(size=(CHARTS, 2, 3))


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
    c, cc, m, mm = (_ratio(values_at[low], values_at[high]) for low, high in t.times)
    zeros = np.stack([(c + cc) / 2, (c - cc) / 2j, (m + mm) / 2, (m - mm) / 2j], axis=-1)
    return zeros, float(np.abs(np.diag(r)).min())


def _ratio(low: ComplexArray, high: ComplexArray) -> ComplexArray:
    """The factor (25,) that takes columns of `low` to those of `high`, by least squares."""
    size = np.maximum((np.abs(low) ** 2).sum(axis=0), np.finfo(float).tiny)
    return np.asarray((low.conj() * high).sum(axis=0) / size)


def _add(e: Exponents, f: Exponents) -> Exponents:
    return (e[0] + f[0], e[1] + f[1], e[2] + f[2], e[3] + f[3])


@cache
def _template() -> _Template:
    """The sparsity pattern of the Macaulay matrix, with 125 independent rows picked."""
    columns = sorted({_add(_add(a, b), _add(c, d)) for a, b, c, d in product(_V, _V, _V, _V[:5])})
    at = {e: k for k, e in enumerate(columns)}
    n = len(columns)
    conjugate = np.array([at[b, a, d, c] for a, b, c, d in columns])

    # A monomial is a column for its real part and one for its imaginary part; of two that are
    # conjugates both use the same columns.
    real, imaginary = np.minimum(np.arange(n), conjugate), np.maximum(np.arange(n), conjugate)
    side = np.sign(conjugate - np.arange(n))
    weights = np.array([np.where(side == 0, 1, np.sqrt(0.5)), 1j * np.sqrt(0.5) * side])

    # The derivatives by c and by m times each monomial that keeps them within the columns; the
    # other two are their conjugates, so real and imaginary parts stand for both.
    basis = np.zeros((7, 7), dtype=complex)  # v of `critical` in the monomials V
    basis[0, 0] = 1
    for k in (1, 3):
        basis[k, [k, k + 1]], basis[k + 1, [k, k + 1]] = [0.5, 0.5], [-0.5j, 0.5j]
    basis[5, 5:], basis[6, 5:] = [0.5, 0.5], [0.5j, -0.5j]
    pattern = []
    for k in (0, 2):
        terms = [
            (_add(_lowered(_V[i], k), _V[j]), np.outer(basis[:, i], basis[:, j]).ravel())
            for i, j in product(range(7), range(7))
            if _V[i][k]
        ]
        low = min(e for e, _ in terms)
        for e in columns:
            shift = (e[0] - low[0], e[1] - low[1], e[2] - low[2], e[3] - low[3])
            if min(shift) < 0 or not all(_add(shift, f) in at for f, _ in terms):
                continue
            row = np.zeros((n, 49), dtype=complex)  # coefficients, linear in G
            for f, entries in terms:
                place = at[_add(shift, f)]
                row[real[place]] += weights[0, place] * entries
                row[imaginary[place]] += weights[1, place] * entries
            pattern += [row.real, row.imag]
    whole = np.array(pattern)

    a = np.random.default_rng(7).normal(size=(7, 7))
    kept = _independent_rows(whole @ (a @ a.T).ravel(), n - ZEROS)
    chosen = whole[kept].reshape(-1, 49)
    entry, source = np.nonzero(np.abs(chosen) > 1e-12)

    def shifted(*steps: Exponents) -> NDArray[np.int_]:
        fit = [e for e in columns if all(_add(e, step) in at for step in steps)]
        return np.array([[at[_add(e, step)] for e in fit] for step in (_ONE, *steps)])

    return _Template(
        entry,
        source,
        chosen[entry, source],
        (n - ZEROS, n),
        real,
        imaginary,
        weights[..., None],
        [shifted(step) for step in (_C, _CC, _M, _MM)],
        shifted(_C, _CC),
    )


def _lowered(e: Exponents, k: int) -> Exponents:
    """The exponents of the derivative by unknown k of a monomial linear in it."""
    return (e[0] - (k == 0), e[1] - (k == 1), e[2] - (k == 2), e[3] - (k == 3))


def _independent_rows(matrix: FloatArray, rank: int) -> NDArray[np.int_]:
    """The rows that Gram-Schmidt with pivoting takes first."""
    rest = matrix / np.linalg.norm(matrix, axis=1, keepdims=True)
    kept = []
    for _ in range(rank):
        kept.append(int(np.einsum("ij,ij->i", rest, rest).argmax()))
        axis = rest[kept[-1]] / np.linalg.norm(rest[kept[-1]])
        rest = rest - np.outer(rest @ axis, axis)
    return np.sort(np.array(kept))
