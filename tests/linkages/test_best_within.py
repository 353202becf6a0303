"""The choice among linkages within a stated tolerance, each driven by `witness`."""

import math
from dataclasses import replace

import numpy as np
import pytest

from burmester import read_task
from burmester.describe.sentences import best_sentences
from burmester.synthesis.motion_generation import synthesize
from burmester.verdicts.quality import ENOUGH_TRANSMISSION, SAME_TRANSMISSION
from burmester.verdicts.ranking import closest_usable, ranked
from tests.oracles.witness import misses

WITHIN = 0.03


@pytest.fixture(scope="module")
def results():
    task = read_task("case:ge2012-approximate")
    asked = replace(task.requirements, within=WITHIN)
    return synthesize(task), synthesize(replace(task, requirements=asked))


def test_the_one_recommended_transmits_best_and_all_stay_within(results):
    closest, within = results
    poses, length = within.task.poses, within.length_per_radian
    for each in within.usable:
        assert misses(each.linkage, poses, length).max() <= math.sqrt(2) * WITHIN
        assert each.error.worst <= WITHIN
        assert float(each.error.angle.max()) * length <= WITHIN
    best, sound = within.usable[0], [each for each in within.usable if not each.shortcomings]
    angles = [float(each.quality.transmission) for each in sound]
    enough = min(max(angles), ENOUGH_TRANSMISSION) - SAME_TRANSMISSION
    near = [each for each in sound if each.quality.transmission > enough]
    product = [each.quality.extent * each.quality.sensitivity for each in near]
    assert best.quality.extent * best.quality.sensitivity == min(product)
    # There is more to choose from than what lies beside the closest one.
    old = closest_usable(closest.linkages)
    assert max(angles) > math.radians(36) > old.quality.transmission


def test_the_closest_one_is_listed_and_named(results):
    closest, within = results
    old, same = closest_usable(closest.linkages), closest_usable(within.linkages)
    assert np.isclose(old.combined_error, same.combined_error, rtol=1e-6)
    assert same.id != "L1"
    text = " ".join(best_sentences(within))
    assert f"Closest that works: {same.id}, which misses by" in text


def test_without_a_tolerance_the_closest_sound_one_stays_first(results):
    closest, within = results
    # The same linkages, ranked for the task without a tolerance.
    again = ranked(within.linkages, closest.problem)
    sound = [each for each in again if each.usable and not each.shortcomings]
    first = min(sound, key=lambda each: each.combined_error)
    assert again[0].combined_error <= first.combined_error * (1 + 1e-6)
    assert again[0] is not within.linkages[0]
