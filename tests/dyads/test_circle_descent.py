"""The way down a valley that is narrow, long and bent."""

import numpy as np
import pytest

from burmester.dyads import circle_descent
from burmester.geometry.displacement import Displacement
from tests.oracles.small_turns import driven, near_parallelogram


@pytest.mark.parametrize("seed", range(6))
def test_a_bent_valley_is_followed_in_few_steps(monkeypatch, seed):
    """From between the two dyads of a near-parallelogram to one of them; straight steps take 20."""
    monkeypatch.setattr(circle_descent, "MAX_VALLEY_STEPS", 18)
    rng = np.random.default_rng(seed)
    rows, dyads = driven(rng, near_parallelogram(rng, 0.1), np.linspace(0, 1, 12))
    c, m, r = ((a + 3 * b) / 4 for a, b in zip(*dyads, strict=True))
    start = np.array([[c.real, c.imag, m.real, m.imag, r]])
    share, poses = np.full((1, 12), 1 / 12), Displacement.from_poses(rows[None])
    found = circle_descent.circle_minima(start, np.zeros(1, dtype=int), poses, share, narrow=True)
    assert len(found.z) == 1
    ends = [np.array([c.real, c.imag, m.real, m.imag, r]) for c, m, r in dyads]
    assert min(np.abs(found.z[0] - end).max() for end in ends) < 1e-6
