"""What a user is told of linkages that work, in a case made for one rule."""

import pytest

from burmester import read_task
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.outcome import linkage_advice
from burmester.tasks.motion_task import characteristic_length
from burmester.tasks.options import SynthesisOptions


@pytest.fixture(scope="module")
def synthesis():
    task = read_task("case:ge2012-exact")
    options = SynthesisOptions(length_per_radian=characteristic_length(task))
    return synthesize(task, options)


def test_a_better_transmission_is_named_only_where_it_is_better(synthesis):
    """L1 falls to 25.7 degrees, L2 to 15.8, L3 to 23.1, L4 to 44.4 and L5 to 56.6."""
    best, worse, little_less, *others = synthesis.usable
    more = "ask for more with --min-transmission 40"

    def help_for(*linkages):
        (advice,) = linkage_advice(synthesis.task, linkages, "R300")
        assert advice.code == "W210"
        assert "its transmission angle falls to " in advice.message
        return advice.help

    assert help_for(best) == more
    assert help_for(best, worse, little_less) == more
    assert help_for(little_less, best) == more  # 25.7 is no fifth more than 23.1
    assert help_for(worse, best).startswith("take L1, which has 25.7° or more")
    assert help_for(best, worse, *others).startswith("take L5, which has 56.6° or more")
    assert help_for(best, worse, *others).endswith(f"; or {more}")
