"""Least-squares fits of bilinear features under conditions, as polynomial systems.

A dyad is fitted by a sum of squares wᵀ G w whose features w are bilinear in the unknowns (the
coordinates of two pivots, or a line's normal and a pivot).  Exact poses are linear conditions
A w = 0 on the same features; a link of given length, or the unit length of a normal, is one
quadratic condition.  With multipliers that is a square polynomial system which depends on
(G, A, l, R) linearly.  How many solutions it has for generic parameters depends on its shape alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, Literal, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray
from burmester.numerics.linear_algebra import matvec, solve_or_shortest

Condition: TypeAlias = Literal["none", "soft", "hard"]

_UPWARDS = np.array([np.cos(1.5), np.sin(1.5)])  # of a line's two normals the one nearer to this


@final
@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """The sort of a polynomial system in unknowns x (n,).

    Its features are w = constant + linear x + x second x / 2.
    name: under which its solutions and its template are stored.
    squares: (n,), of the quadratic condition  squares · x² + l · w = R, plus its own multiplier t
    where it is soft (then t² joins the sum of squares, and t is the mean of the residual);
    conditions: the number of rows of A.
    planes: the first of each two unknowns that are coordinates in the plane.
    """

    name: str
    constant: FloatArray
    linear: FloatArray
    second: FloatArray
    squares: FloatArray
    conditions: int
    quadratic: Condition
    planes: tuple[int, ...]

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

    def one_of_twins(self, x: NDArray[Any]) -> NDArray[Any]:
        """Solutions x (*, size), of a line's two normals always the same one.

        With the normal the multipliers of A change their signs.
        """
        if self.constant.any():
            return x
        sign = np.ones((*x.shape[:-1], 1))
        sign[(x[..., :2].real @ _UPWARDS) < 0] = -1.0
        signs = np.ones(x.shape)
        signs[..., :2] = signs[..., self.unknowns : self.unknowns + self.conditions] = sign
        return np.asarray(x * signs)

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
    planes = tuple(at for at, free in ((0, fixed), (fixed, moving)) if free == 2)
    features = _stacked_features(linear, second)
    return Shape(name, *features, np.ones(n), conditions, quadratic, planes)


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
    constant, planes = np.zeros_like(constant), (0, 2) if moving == 2 else (0,)
    return Shape(name, constant, linear, second, squares, conditions, "hard", planes)


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
    """Linear (a, n), then bilinear features (b, n, n), the first the constant 1."""
    n, count = linear.shape[1], len(linear) + len(second)
    return (
        np.eye(count)[0],
        np.concatenate([linear, np.zeros((len(second), n))]),
        np.concatenate([np.zeros((len(linear), n, n)), second]),
    )


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


def newton_step(shape: Shape, x: NDArray[Any], p: Parameters) -> NDArray[Any]:
    """Newton's step at x (*, size), to be subtracted."""
    return solve_or_shortest(jacobian(shape, x, p), equations(shape, x, p))
