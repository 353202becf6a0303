"""What is said of the best linkage and of the closest one, in a case made for one rule."""

from dataclasses import replace

import numpy as np
import pytest

from burmester import PoseError, Task
from burmester.describe.sentences import best_sentences
from burmester.numerics.arrays import ROUNDING
from burmester.synthesis.motion_generation import synthesize
from tests.oracles.five_poses import ROWS


@pytest.mark.parametrize(("miss", "said"), [(0.6, 1), (1.3, 1), (1e6, 2)])
def test_a_linkage_that_fails_is_closest_only_if_it_is_nearer_than_by_rounding(miss, said):
    """Of five poses that all linkages meet, one that fails is nearer by a part of rounding."""
    synthesis = synthesize(Task.from_rows(ROWS, angle_unit="deg"))
    rounding = ROUNDING * synthesis.length
    linkages = []
    for each in synthesis.linkages:
        off = rounding * np.full(5, miss if each.usable else 0.4)
        error = PoseError(each.error.places, off, np.zeros(5))
        linkages.append(replace(each, error=error, combined_error=off[0]))
    failing = next(each for each in linkages if not each.usable)
    sentences = list(best_sentences(replace(synthesis, linkages=tuple(linkages))))
    assert len(sentences) == said
    assert sentences[0].startswith("L1, a crank-rocker")
    assert all(f"the closest one, {failing.id}, " in text for text in sentences[1:])
