"""What is said of bodies that hardly turn: a sample of `python -m benchmarks.small_turns`."""

from dataclasses import replace

import numpy as np
from benchmarks.small_turns import judged

from burmester import Displacement, Task, synthesize
from burmester.dyads import local_minima
from burmester.numerics.arrays import take
from burmester.synthesis import motion_generation
from tests.oracles.small_turns import any_four_bar, driven, small_turn
from tests.samples import samples


def test_no_dyad_is_lost_in_silence():
    """Twenty-four planted four-bars, two dyads each."""
    words, carried = [], []
    every = samples(24, 10)
    for k in every:
        found, all_digits, *_ = judged(small_turn(np.random.default_rng([20, k])))
        words += found
        carried += found if all_digits else []
    assert "SILENT" not in words
    assert set(carried) <= {"listed", "as good"}
    assert words.count("listed") > len(every)  # most are found, not told


def nine_poses(sweep):
    rng = np.random.default_rng(1)
    while True:
        pins = any_four_bar(rng)
        made = pins and driven(rng, pins, sweep * np.linspace(0, 1, 9))
        if made:
            return Task(Displacement.from_poses(made[0]))


def test_a_list_with_lost_points_is_not_called_complete():
    synthesis = synthesize(nine_poses(0.05))
    assert "not accounted for" in synthesis.outcome.message
    assert "W207" in {warning.code for warning in synthesis.warnings}


def test_a_dyad_that_the_rank_promises_and_the_list_lacks_is_told(monkeypatch):
    """Without the starts of other fits, in a sweep where all critical points are found."""
    task = nine_poses(0.5)
    assert "W207" not in {warning.code for warning in synthesize(task).warnings}

    def without_the_best(*args):
        best = local_minima.best_dyads_of_tasks(*args)
        return replace(best, minima=take(best.minima, slice(1, None)))

    monkeypatch.setattr("burmester.synthesis.dyad_search.best_dyads_of_tasks", without_the_best)
    told = [each for each in motion_generation.synthesize(task).warnings if each.code == "W207"]
    assert len(told) == 1
    assert "2 independent quadrics hold the poses" in told[0].message
