"""Nearest whole numbers in a metric, against every one of them and against rounding by hand."""

from itertools import permutations, product

import numpy as np
import pytest

from burmester.numerics.integer_least_squares import closest_numbers, firmest_last


def test_whole_numbers_are_the_closest_of_all():
    rng = np.random.default_rng(1)
    grid = np.array(list(product(range(-5, 6), repeat=4)), dtype=float)
    for _ in range(20):
        slope = rng.normal(size=(7, 4)) + 0.5 * rng.normal(size=(7, 1))
        at, gap = rng.uniform(-1, 1, 4), rng.normal(size=7)
        cost = ((gap + (grid - at) @ slope.T) ** 2).sum(axis=1)
        best = grid[cost.argmin()]
        if np.abs(best).max() < 4:
            told = closest_numbers(slope, gap, at, positive=np.zeros(4, dtype=bool), width=64)
            assert told[0].tolist() == best.tolist()
        told = closest_numbers(slope, gap, at, positive=np.arange(4) == 1, width=64)
        assert (told[:, 1] >= 1).all()


@pytest.mark.parametrize("columns", list(permutations(range(3))))
def test_one_way_is_enough_if_the_firmest_number_is_fixed_first(columns):
    """The lattice of all points with whole coordinates, by a skew basis.

    The nearest point is known: each coordinate rounded.  A search that keeps one way alone, and
    fixes a loose number first, goes astray.
    """
    basis = np.array([[1.0, 3.0, 2.0], [0.0, 1.0, 4.0], [0.0, 0.0, 1.0]])
    columns = list(columns)
    slope = basis[:, columns]
    order = firmest_last(slope)
    astray = 0
    for gap in product((-1.7, -0.3, 0.4, 2.2), repeat=3):
        nearest = np.rint(-np.array(gap))
        told, loose = (
            closest_numbers(
                slope[:, way],
                np.array(gap),
                np.zeros(3),
                positive=np.zeros(3, dtype=bool),
                width=1,
            )
            for way in (order, order[::-1])
        )
        assert (slope[:, order] @ told[0]).tolist() == nearest.tolist()
        astray += (slope[:, order[::-1]] @ loose[0]).tolist() != nearest.tolist()
    assert astray > 20
