"""A sample of `benchmarks/search_witness.py`: tasks in which an independent search was nearer once.

What went wrong in them before: there were two starts within the limits (11), the closest linkage of
pairs of dyads was taken though others are closer (23), a descent ended at a corner of a box (30),
only one locally best dyad lies within the limits (50).
"""

import numpy as np
import pytest
from benchmarks.search_witness import WORSE, compared, ratio_of

from tests.oracles import multi_start

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("seed", [11, 23, 30, 50])
def test_an_independent_search_is_not_nearer(seed, monkeypatch):
    monkeypatch.setattr(multi_start, "FIRST", (30, 40))
    monkeypatch.setattr(multi_start, "SECOND", (6, 200))
    _, ours, theirs, _, wrong = compared(seed)
    assert not wrong
    assert np.isfinite(theirs)
    assert ratio_of(ours, theirs) < WORSE
