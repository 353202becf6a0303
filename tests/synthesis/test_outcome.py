"""What a user is told of linkages that work, in a case made for one rule."""

import re
from dataclasses import replace

import numpy as np
import pytest
from benchmarks.advice import advice_task, promises

from burmester import read_task
from burmester.geometry.regions import box
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.outcome import linkage_advice
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task, characteristic_length
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.requirements import Requirements
from tests.oracles.hard_tasks import comes_by
from tests.samples import samples


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

    # Nothing that is known has 40 degrees, so nothing says that asking for them has an answer.
    assert help_for(best) == "move a pose, or leave one out"
    assert help_for(best, worse, little_less) == "move a pose, or leave one out"
    assert help_for(little_less, best) == help_for(best)  # 25.7 is no fifth more than 23.1
    assert help_for(worse, best).startswith("take L1, which has 25.7° or more")
    assert more not in help_for(worse, best)
    assert help_for(best, worse, *others).startswith("take L5, which has 56.6° or more")
    assert help_for(best, worse, *others).endswith(f"; or {more}")


# A gripper over a wall, turned by 90 degrees: no linkage on this ground comes within a tenth of it.
OVER_A_WALL = [
    (0, 0, 0), (0, 20, 0), (5, 45, 2), (25, 75, 8), (60, 100, 18), (100, 112, 32), (140, 112, 48),
    (175, 98, 62), (198, 75, 76), (210, 48, 86), (214, 22, 90), (214, 0, 90),
]  # fmt: skip


def test_the_nearest_linkage_that_keeps_all_else_is_named_with_the_options_that_allow_it():
    """A crank-rocker within 23.3 mm and 20.9 degrees is known; an Oldham linkage is 57 off."""
    ground = (Limits(fixed_pivot=box((-50, -150), (300, -20))),)
    task = Task.from_rows(OVER_A_WALL, angle_unit="deg", length_unit="mm")
    task = replace(task, limits=ground, requirements=Requirements(transmission_deg=35))
    result = synthesize(task)
    assert result.outcome.code == "R301"
    told = re.match(r"with --within ([\d.]+) L1 would do", result.outcome.help)
    within = float(told[1])
    assert within < 25
    assert "Oldham" not in result.linkages[0].type
    assert "57" not in result.outcome.help
    asked = replace(task.requirements, within=within)
    best = synthesize(replace(task, requirements=asked)).linkages[0]
    assert best.usable
    assert best.error.worst <= within
    assert np.degrees(best.error.angle.max()) < 26  # what that many millimetres count as
    assert comes_by(best, np.radians(35) - 1e-6)


@pytest.mark.parametrize("number", samples(150, 4))
def test_advice_that_names_options_keeps_what_it_promises(number):
    """A sample of `python -m benchmarks.advice`."""
    _, task = advice_task(0, number)
    assert [each for each in promises(task) if each[2] != "kept"] == []
