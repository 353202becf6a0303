"""All solutions of many systems of one shape at once, by linear algebra.

The equations of a shape are multiplied by monomials: rows of a Macaulay matrix, whose columns are
monomials (`elimination_template`).  The values of these monomials at the solutions span its null
space, and what multiplication by a linear form does there has the solutions as its eigenvectors.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import ComplexArray, FloatArray, take
from burmester.polynomials.bilinear_fit import Parameters, Shape
from burmester.polynomials.elimination_template import Chart, chart, isotropic, template
from burmester.polynomials.macaulay import column_ratio

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
