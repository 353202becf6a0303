"""All solutions of many systems of one shape at once, by linear algebra.

The equations of a shape are multiplied by monomials: rows of a Macaulay matrix, whose columns are
monomials (`elimination_template`).  The values of these monomials at the solutions span its null
space, and what multiplication by a linear form does there has the solutions as its eigenvectors.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.bilinear_fit import Parameters, Shape
from burmester.dyads.elimination_template import chart, isotropic, template
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.bundles import take

__all__ = ["eigen_points", "in_units"]

BALANCE = 0.4  # target ratio of linear to bilinear terms; the result is not sensitive to it
ENTRIES_AT_ONCE = 2_000_000  # of matrices; bounds the memory


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
    unit, values = in_units(shape, p)
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
    z = np.stack([_ratio(at[:, low], at[:, high]) for low, high in t.times], axis=-1)
    return (z @ isotropic(shape).unknowns.T) * unit[:, None], values.imag < 0


def _ratio(low: ComplexArray, high: ComplexArray) -> ComplexArray:
    """The factors (T, k) that take columns of `low` to those of `high`, by least squares."""
    size = np.maximum((np.abs(low) ** 2).sum(axis=1), np.finfo(float).tiny)
    return np.asarray((low.conj() * high).sum(axis=1) / size)


def in_units(shape: Shape, p: Parameters) -> tuple[FloatArray, ComplexArray]:
    """Units (T, n) of the unknowns, and the parameters (T, m) of the Lagrangian in these.

    In them the pivots weigh as much as their products do; where the body turns little they are
    long, as the pivots are then far away.
    """
    circle = bool(shape.constant.any())
    pivots = np.full(shape.unknowns, True) if circle else shape.squares == 0  # not the normal
    degree = np.maximum(
        np.abs(shape.linear) @ pivots, np.abs(shape.second).max(axis=2, initial=0) @ pivots
    )
    unit = np.ones(len(p.square))
    if shape.second.any():
        squares = np.diagonal(p.gram, axis1=1, axis2=2) + (p.rows**2).sum(axis=1)
        highest = degree.max()
        alone = squares[:, degree == highest - 1].sum(axis=1)
        products = squares[:, degree == highest].sum(axis=1)
        fit = (alone > 0) & (products > 0)
        unit[fit] = BALANCE * np.sqrt(alone[fit] / products[fit])
    by = unit[:, None] ** degree
    gram, rows = p.gram * by[:, :, None] * by[:, None], p.rows * by[:, None]
    size, lengths = np.linalg.norm(gram, axis=(1, 2)), np.linalg.norm(rows, axis=-1)
    size[size == 0], lengths[lengths == 0] = 1.0, 1.0
    square = unit**2 if circle else np.ones(len(unit))
    features = isotropic(shape).features
    gram = features.T @ (gram / size[:, None, None]) @ features
    parts = [
        gram.reshape(len(unit), -1),
        (rows / lengths[..., None] @ features).reshape(len(unit), -1),
        (p.linear * by / square[:, None]) @ features,
        np.stack([p.square / square, np.ones(len(unit)), size / square**2], axis=-1),
    ]
    return np.where(pivots, unit[:, None], 1.0), np.concatenate(parts, axis=-1)
