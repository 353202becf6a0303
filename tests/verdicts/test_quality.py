"""The quality of linkages, against linkages that are driven and built amiss."""

import math
from itertools import product

import numpy as np
import pytest

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.verdicts.quality import best_first, enough_transmission
from burmester.verdicts.tolerances import sensitivity, sensitivity_bound, spread
from tests.oracles.built_amiss import asked, built_amiss, driven, problem
from tests.oracles.ranges import KINDS as PAIRS
from tests.oracles.ranges import DrivenRange
from tests.oracles.refits import dyads_of, numbers_of

KINDS = pytest.mark.parametrize("second", [RR, PR, RP])
H = 1e-4  # the error of a dimension in difference quotients
CORNERS = np.array(list(product([1.0, -1.0], repeat=8 + 2)))


@KINDS
@pytest.mark.parametrize("off", [0.0, 0.03])
def test_sensitivity_is_the_worst_of_all_corners_of_linkages_built_amiss(second, off):
    dyads, rows, drive, found = problem(20, second, off)
    rows, drive, found = rows[:3], drive[:3], found[:3]
    told = sensitivity_bound(*asked(dyads, rows, found))[0]
    columns, _ = built_amiss(dyads, found)
    z, kinds = numbers_of(dyads), [RR, second]

    def moved(amiss):
        return driven(dyads_of(kinds, z + H * amiss), rows, drive)[:, :2]

    slope = np.array([moved(column) - moved(-column) for column in columns]) / (2 * H)
    corners = np.unique(CORNERS[:, : len(columns)], axis=0)
    errors = np.linalg.norm(np.einsum("sj,jnc->snc", corners, slope), axis=-1)
    assert np.allclose(told, errors.max(axis=0), rtol=1e-4)
    # And built in that worst corner, it comes out as bad.
    corner = corners[errors.max(axis=1).argmax()]
    worst = np.linalg.norm(moved(corner @ columns) - found[:, :2], axis=-1).max() / H
    assert np.isclose(worst, told.max(), rtol=0.05)


@pytest.mark.parametrize("kinds", PAIRS, ids=lambda k: "-".join(each.__name__ for each in k))
def test_the_bound_is_that_of_the_worst_corner(kinds):
    rng = np.random.default_rng(4)
    for _ in range(10):
        there = DrivenRange(kinds, rng)
        batch = LinkageBatch.of([Linkage(*there.dyads)])
        places, length = Displacement.from_poses(there.poses()[None]), 0.6
        # Poses that are met, and poses that are missed by so little that nothing changes.
        for off in (0.0, 1e-8):
            poses = Displacement(places.translation[0] + off, places.angle[0])
            slope = sensitivity(batch, poses, places, length)[0]
            corners = np.linalg.norm(np.einsum("sj,ncj->snc", CORNERS, slope), axis=-1)
            told = sensitivity_bound(batch, poses, places, length)[0]
            assert np.allclose(told, corners.max(axis=0), rtol=1e-6)


@KINDS
def test_sensitivity_is_the_bound_of_a_small_tolerance(second):
    dyads, rows, _, found = problem(30, second, 0.0)
    batch, poses, places, length = asked(dyads, rows, found)
    tolerance = 1e-6
    bound = spread(batch, poses, places, length, tolerance).bound[0]
    told = sensitivity_bound(batch, poses, places, length).max()
    assert np.isclose(bound / tolerance, told, rtol=1e-3)


def test_the_rule_takes_the_best_angle_and_of_those_half_a_degree_the_least_product():
    angle = np.radians([40.0, 60.0, 59.6, 59.4, 20.0, np.nan])
    extent, sensitivity = np.array([[1.0, 5.0, 3.0, 2.0, 1.0, 1.0], [2.0, 2, 3, 1, 1, 1]])
    assert best_first(angle, extent, sensitivity).tolist() == [2, 1, 3, 0, 4, 5]
    assert best_first(angle, extent, np.array([1.0, 1, 3, 1, 1, 1]))[0] == 1
    same = np.full(3, 1.0)
    assert best_first(same, same, np.array([3.0, 1.0, 2.0])).tolist() == [1, 2, 0]


def test_more_than_enough_transmission_counts_for_nothing():
    angle, size, same = np.radians([85.5, 67.0, 58.0]), np.array([6.0, 2.0, 1.0]), np.ones(3)
    assert best_first(angle, size, same).tolist() == [1, 0, 2]
    assert best_first(angle, size, same, enough=math.radians(50)).tolist() == [2, 1, 0]
    assert best_first(angle, size, same, enough=math.radians(80)).tolist() == [0, 1, 2]
    told = [math.degrees(enough_transmission(math.radians(asked))) for asked in (0, 20, 45, 70)]
    assert np.allclose(told, [60, 60, 60, 70])


def test_a_linkage_smaller_than_the_motion_gains_nothing_by_that():
    same = np.full(3, math.radians(60))
    tiny_first = np.array([0.02, 0.9, 1.2])
    assert best_first(same, tiny_first, np.array([3.6, 3.4, 3.3])).tolist() == [1, 0, 2]
