"""Integer least squares: the whole numbers nearest in a metric, best first."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

__all__ = ["ALIKE", "closest_numbers", "firmest_last"]

ALIKE = 1e-12  # lengths; distances that differ by less are the same


def firmest_last(slope: FloatArray) -> NDArray[np.intp]:
    """Columns (m, n) in the order in which the last are fixed best when all others are free."""
    left = list(range(slope.shape[1]))
    order: list[int] = []
    while left:
        rows = np.linalg.pinv(slope[:, left])
        firm = 1 / np.linalg.norm(rows, axis=1)
        order.insert(0, left.pop(int(firm.argmax())))
    return np.array(order)


def closest_numbers(
    slope: FloatArray, gap: FloatArray, at: FloatArray, positive: NDArray[np.bool_], width: int
) -> FloatArray:
    """Whole numbers (w, n) with about the least |gap + slope (numbers - at)|², the least first.

    positive: (n,), which are at least 1.  width: how many go on from number to number.
    """
    basis, upper = np.linalg.qr(slope)
    right, last = -(basis.T @ gap), len(at)
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
