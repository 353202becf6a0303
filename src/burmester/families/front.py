"""The front: linkages of which none is worse in all figures, and a few of them far apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.numerics.arrays import FloatArray

__all__ = ["far_apart", "front"]


def front(figures: FloatArray) -> NDArray[np.intp]:
    """The indices of the rows (k, n) that no other row surpasses: less is better in each column."""
    order = np.lexsort(figures.T[::-1])
    rows = figures[order]
    kept = np.ones(len(rows), dtype=bool)
    for k in range(len(rows)):  # nothing after a row surpasses it
        if kept[k]:
            after = kept[k + 1 :]
            after &= (rows[k + 1 :] < rows[k]).any(axis=1)
    return np.asarray(order[kept])


def far_apart(points: FloatArray, first: list[int], most: int, least: float) -> list[int]:
    """At most `most` indices of points (k, n), those in `first` and others far from them.

    Each next point is the farthest from all before, by at least `least`.
    """
    chosen: list[int] = []
    away = np.full(len(points), np.inf)

    def take(k: int) -> None:
        chosen.append(k)
        np.minimum(away, np.linalg.norm(points - points[k], axis=1), out=away)

    for k in first:
        if away[k] >= least and len(chosen) < most:
            take(k)
    while len(chosen) < min(most, len(points)):
        k = int(away.argmax())
        if away[k] < least:
            break
        take(k)
    return chosen
