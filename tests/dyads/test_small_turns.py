"""Bodies that hardly turn: the dyads of the linkage that led them are found."""

import numpy as np
import pytest

from burmester.dyads.critical_points import critical_dyads
from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.local_minima import best_dyads
from burmester.geometry.displacement import Displacement
from tests.oracles.small_turns import (
    SmallTurn,
    any_four_bar,
    distances,
    driven,
    moved_by_rounding,
    near_parallelogram,
    verdicts,
)

CARRIED = 1e-4  # a dyad that one unit in the last place moves by less is one that doubles carry


def task_of(rng, sweep, apart=0.0):
    """Nine poses with all digits."""
    while True:
        pins = near_parallelogram(rng, apart) if apart else any_four_bar(rng)
        made = pins and driven(rng, pins, sweep * np.linspace(0, 1, 9))
        if made:
            task = SmallTurn(made[0], 0.0, made[1], sweep, apart)
            if moved_by_rounding(task).max() < CARRIED:
                return task


def listed(best):
    dyads = best.dyads
    return np.column_stack([dyads.fixed_pivot, dyads.moving_pivot, dyads.radius, best.rms_error])


@pytest.mark.parametrize("sweep", [0.5, 0.2, 0.1, 0.05, 0.02])
def test_both_dyads_of_a_little_sweep_are_found(sweep):
    rng = np.random.default_rng(int(1000 * sweep))
    for _ in range(4):
        task = task_of(rng, sweep)
        assert verdicts(task, listed(best_dyads(Displacement.from_poses(task.rows)))) == [
            "listed",
            "listed",
        ]


@pytest.mark.parametrize("apart", [0.1, 0.01, 0.003])
def test_both_dyads_of_a_near_parallelogram_are_found(apart):
    rng = np.random.default_rng(int(1000 * apart))
    for _ in range(4):
        task = task_of(rng, 1.0, apart)
        assert verdicts(task, listed(best_dyads(Displacement.from_poses(task.rows)))) == [
            "listed",
            "listed",
        ]


def test_points_lost_in_a_little_sweep_are_not_called_infinite():
    """No slider meets these poses exactly, so no critical point is at infinity."""
    lost = 0
    for sweep in (0.1, 0.05, 0.02):
        rng = np.random.default_rng(int(1000 * sweep))
        for _ in range(4):
            found = critical_dyads(Displacement.from_poses(task_of(rng, sweep).rows))
            assert found.at_infinity == 0
            lost += found.found < 25
    assert lost > 6


def test_both_dyads_of_five_poses_close_together_keep_their_digits():
    rng = np.random.default_rng(8)
    for sweep in (0.1, 0.05):
        for _ in range(6):
            task = task_of(rng, sweep)
            five = dyads_of_five(Displacement.from_poses(task.rows[::2]))
            dyads, real = five.dyads, five.real
            rows = [dyads.fixed_pivot, dyads.moving_pivot, dyads.radius, five.max_error]
            found = np.column_stack([each[real] for each in rows])
            assert verdicts(task._replace(rows=task.rows[::2]), found) == ["listed", "listed"]
            for c, _, _ in task.dyads:
                nearest = np.abs(found[:, 0] + 1j * found[:, 1] - c).argmin()
                assert found[nearest, 5] < 1e-14


def test_a_stated_error_is_that_of_the_stated_dyad():
    """To rounding of the doubles that are stated, computed by no code of the package."""
    task = task_of(np.random.default_rng(3), 1.0, 0.003)
    best = best_dyads(Displacement.from_poses(task.rows))
    for row in listed(best)[:2]:
        error = np.sqrt((distances(row[:5], task.rows) ** 2).mean())
        assert abs(error - row[5]) < 1e-15
        assert error < 1e-15
