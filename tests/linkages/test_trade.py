"""Position against angle: what is found when one of them counts for more."""

import numpy as np
import pytest

from burmester import Displacement, Task, synthesize
from burmester.linkages.evaluation import Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.linkages.sound_linkages import trade_offs
from tests.oracles.hard_tasks import noisy_task


@pytest.mark.parametrize("seed", [3, 4])
def test_a_trade_halves_one_error_and_at_most_triples_the_other(seed):
    """The greatest distances and turns, by hand, of linkages that still work."""
    rows, *_ = noisy_task(np.random.default_rng(seed), 5)
    synthesis = synthesize(Task(Displacement.from_poses(rows)))
    best = synthesis.usable[0]
    target = target_of(synthesis.problem)
    found = trade_offs(best, Evaluation(synthesis.problem, target))
    assert found
    poses = synthesis.problem.task.poses
    for each in found:
        assert each.usable
        gains = []
        for of in (best, each):
            gap = np.linalg.norm(of.error.places.translation - poses.translation, axis=-1)
            turn = np.abs(np.angle(np.exp(1j * (of.error.places.angle - poses.angle))))
            gains.append((gap.max(), turn.max()))
        (before, turned), (after, turned_after) = gains
        assert after < 0.5 * before or turned_after < 0.5 * turned
        assert after <= 3 * before
        assert turned_after <= 3 * turned
