"""The dyads of a fit in their order, in a case made for one rule."""

import numpy as np

from burmester import Task, dyads_of_five
from burmester.dyads.selection import found_dyads

ROWS = [
    (-3.9696, -2.6338, 37.23),
    (-0.2223, -0.3211, 27.48),
    (3.3279, 3.9568, 8.17),
    (7.7225, 10.0149, -14.86),
    (5.7615, 18.8535, -25.64),
]


def test_dyads_that_are_all_exact_come_by_the_lengths_of_their_links():
    """Their errors are rounding, and say nothing; in whatever order the poses come."""
    rng = np.random.default_rng(0)
    for _ in range(6):
        task = Task.from_rows(rng.permutation(ROWS), angle_unit="deg")
        found, left_out = found_dyads(dyads_of_five(task.poses), task)
        assert [each.id for each in found] == ["D1", "D2", "D3", "D4"]
        assert left_out == 0
        assert max(each.rms_error for each in found) < 1e-10
        lengths = [float(each.dyad.radius) for each in found]
        assert lengths == sorted(lengths)
