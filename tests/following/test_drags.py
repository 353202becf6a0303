"""Samples of the campaign of drags: `benchmarks/follow.py` runs more of them, with more steps."""

import numpy as np
import pytest
from benchmarks import follow as campaign

from burmester import follow, synthesize
from burmester.fourbar.dyad import RR
from burmester.synthesis.dyad_search import search_dyads


@pytest.mark.parametrize("sort", ["five", "ten"])
def test_the_whole_road_confirms_drags(sort, monkeypatch):
    """Every dyad followed is one of the road's, or the follow said that it is not sure."""
    monkeypatch.setattr(campaign, "STEPS", 40)
    record = campaign.Record()
    for number in range(2):
        campaign.dragged(sort, number, 3, record)
    assert record.drags == 2
    assert record.confirmed == record.complete == 2
    assert not record.untold
    if sort == "five":  # where a linkage that passes the poses has no other place at them
        assert record.same_use == record.linkages
    assert record.at_rest >= 0.8 * record.least


@pytest.mark.parametrize("number", [5, 78])
def test_a_minimum_that_appears_far_from_the_others_is_met(number):
    """The distance gets one more minimum, where the squared residual has no critical point."""
    rng = np.random.default_rng([100, campaign.SORTS.index("ten"), number])
    task = campaign.task_of("ten", rng, number)
    way = campaign.drag_of(task, rng, number)
    here = synthesize(way(0.85))
    before = here.dyads
    for u in np.linspace(0.85, 1, 31)[1:]:
        here = follow(here, way(u))
    road = search_dyads(here.problem).dyads
    assert _links(here.dyads) == _links(road)
    assert len(_links(road)) > len(_links(before))


def _links(dyads):
    """The dimensions of the links, to six digits."""
    rows = (campaign.numbers_of(each.dyad) for each in dyads if isinstance(each.dyad, RR))
    return sorted(tuple(f"{number:.6g}" for number in row) for row in rows)
