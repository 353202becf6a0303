"""Samples of the campaign of drags: `benchmarks/follow.py` runs more of them, with more steps."""

import pytest
from benchmarks import follow as campaign

pytestmark = pytest.mark.slow


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
        assert record.same_verdict == record.linkages
    assert record.at_rest >= 0.8 * record.least
