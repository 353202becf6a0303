"""Integer least squares: the whole numbers nearest in a metric, best first."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray


def firmest_last(jacobian: FloatArray) -> NDArray[np.intp]:
    """The order of columns (m, n) in which the last are best determined, all others being free."""
    left = list(range(jacobian.shape[1]))
    order: list[int] = []
    while left:
        rows = np.linalg.pinv(jacobian[:, left])
        firmness = 1 / np.linalg.norm(rows, axis=1)
        order.insert(0, left.pop(int(firmness.argmax())))
    return np.array(order)


def closest_numbers(
    jacobian: FloatArray,
    residual: FloatArray,
    at: FloatArray,
    *,
    positive: NDArray[np.bool_],
    width: int,
) -> FloatArray:
    """Whole numbers (w, n) with about the least |residual + jacobian (numbers - at)|², best first.

    A breadth-first (K-best) search from the last number to the first.
    positive: (n,), which are at least 1; width: how many partial solutions are kept.
    """
    basis, upper = np.linalg.qr(jacobian)
    right, last = -(basis.T @ residual), len(at)
    x, cost = np.zeros((1, last)), np.zeros(1)
    for j in range(last - 1, -1, -1):
        centre = (right[j] - x[:, j + 1 :] @ upper[j, j + 1 :]) / upper[j, j]
        whole = np.floor(at[j] + centre)[:, None] + np.arange(-1.0, 3.0)
        if positive[j]:
            whole = np.maximum(whole[:, :1], 1.0) + np.arange(4.0)
        step = whole - at[j]
        total = cost[:, None] + (upper[j, j] * (step - centre[:, None])) ** 2
        best = np.argsort(total, axis=None, kind="stable")[:width]
        x = x[best // 4]
        x[:, j], cost = step.ravel()[best], total.ravel()[best]
    return np.rint(x + at)
