"""Two poses in each other's place, in cases made for one rule each."""

from itertools import combinations

import numpy as np
import pytest

from burmester import Displacement, Task
from burmester.diagnosis.checks import swapped_poses

PLACES = 10


def task_of(order):
    """Places along a line with a gentle bend, by their numbers in the order that is given."""
    x = np.array(order, dtype=float)
    return Task(Displacement.from_poses(np.column_stack([10 * x, 2 * np.sin(x / 3), 0.1 * x])))


def exchanged(*pairs):
    order = list(range(PLACES))
    for first, second in pairs:
        order[first], order[second] = order[second], order[first]
    return order


@pytest.mark.parametrize("pair", [(1, 8), (4, 6)])
def test_one_exchange_is_told(pair):
    found = swapped_poses(task_of(exchanged(pair)))
    assert (found.first, found.second) == pair


def test_of_two_exchanges_none_is_told():
    """Mended by one, the order would still be wrong: the second saves a third of what is left."""
    assert swapped_poses(task_of(exchanged((1, 8), (4, 6)))) is None


def test_of_two_exchanges_that_shorten_the_path_alike_none_is_told():
    """Either of them saves a third and more: which two poses stand wrong is not known."""
    points = np.array([(3, 0), (1, 3), (4, 3), (0, 3), (3, 3), (0, 2)], dtype=float)

    def path(points):
        return np.hypot(*np.diff(points, axis=0).T).sum()

    paths = []
    for first, second in combinations(range(6), 2):
        order = np.arange(6)
        order[[first, second]] = second, first
        paths.append(path(points[order]))
    one, other, third = sorted(paths)[:3]
    assert other < 0.65 * path(points)
    assert other < 1.05 * one < third
    assert swapped_poses(Task(Displacement(points, np.zeros(6)))) is None
    points[4] = 3, 4  # a little farther off, and one of them is clearly the better one
    found = swapped_poses(Task(Displacement(points, np.zeros(6))))
    assert (found.first, found.second) == (2, 5)
