"""A sample of many poses: what stays in it, what it counts, and where it is dense."""

import numpy as np
import pytest

from burmester import Displacement, Task
from burmester.tasks.pose_sample import PoseSample
from burmester.tasks.pose_tolerances import PoseTolerances
from tests.oracles.measured import measured


def task(count, sort="forth", **more):
    return Task(Task.from_rows(measured(count, sort), angle_unit="deg").poses, **more)


@pytest.mark.parametrize("sort", ["forth", "back", "to and fro", "with rests", "free"])
def test_a_sample_keeps_both_ends_and_all_weight(sort):
    many = task(5000, sort)
    sample = PoseSample.of_task(many, 200)
    assert 150 <= len(sample.index) <= 200
    assert sample.index[0] == 0
    assert sample.index[-1] == 4999
    assert (np.diff(sample.index) > 0).all()
    assert sample.cells.sum() == 5000
    # Each pose counts for the sample next to it, so no cell is wider than its neighbours are far.
    assert (sample.cells <= np.diff(sample.index).max() + 1).all()


def test_weights_go_to_the_sample_next_to_them():
    weights = np.ones(3000)
    weights[1000:2000] = 5.0
    sample = PoseSample.of_task(task(3000, weights=weights), 100)
    assert sample.cells.sum() == pytest.approx(weights.sum())
    inside = (sample.index > 1040) & (sample.index < 1960)
    assert sample.cells[inside].mean() > 3 * sample.cells[sample.index < 960].mean()


def test_a_rest_does_not_take_the_places_of_the_motion():
    x = np.concatenate([np.zeros(9500), np.linspace(0, 10, 500)])
    sample = PoseSample.of(Displacement(np.column_stack([x, 0 * x]), x / 10), None, 100)
    moving = (sample.index >= 9500).sum()
    assert moving >= 50  # by number alone it were 5


def test_exact_poses_and_tight_ones_stay():
    exact = np.zeros(4000, dtype=bool)
    exact[[17, 1234]] = True
    sample = PoseSample.of_task(task(4000, exact=exact), 50)
    assert {17, 1234} <= set(sample.index.tolist())
    bounds = np.full((4000, 2), 0.5)
    bounds[77, 1] = 0.1
    tolerances = PoseTolerances(bounds, np.full(4000, 0.1))
    sample = PoseSample.of_task(task(4000, tolerances=tolerances), 50)
    assert 77 in sample.index
    assert len(sample.index) <= 51
