"""Two poses in each other's place, in cases made for one rule each."""

import numpy as np
import pytest

from burmester import Displacement, Task
from burmester.diagnosis.swapped_poses import swapped_poses

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
