"""Starts of ways down: of rough poses, to minima that only one kind of start leads to."""

import numpy as np
import pytest

from burmester.dyads.local_minima import best_dyads
from burmester.geometry.displacement import Displacement
from tests.oracles.random_starts import distance, local_fits


@pytest.mark.parametrize("seed", [0, 41, 83, 99, 205, 206])
def test_what_random_starts_find_is_found(seed):
    """Beside complex critical points, on either side, and along lines, on either side."""
    rng = np.random.default_rng([5, seed])
    poses = Displacement(rng.normal(size=(8, 2)), rng.uniform(-1.5, 1.5, 8))
    best = best_dyads(poses)
    d, t = poses.translation @ [1, 1j], np.exp(1j * poses.angle)
    starts = np.random.default_rng(0).normal(size=(600, 4)) * 10 ** rng.uniform(0, 1.5, (600, 1))
    _, rms = local_fits(distance, starts, d, t)
    assert len(rms) > 100
    known = best.rms_error
    assert all(np.abs(known / each - 1).min() < 1e-6 for each in rms)
    found = [np.abs(rms / each - 1).min() < 1e-6 for each in known]
    assert all(found)
