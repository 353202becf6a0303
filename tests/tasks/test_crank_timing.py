"""Angles of the driver at poses: what they say, and what no crank can have."""

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.tasks.crank_timing import CrankTiming
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances

POSES = Displacement(np.array([[0.0, 0], [1, 0], [2, 1]]), np.array([0.0, 0.4, 1]))


def timing(*degrees, **how):
    return CrankTiming(np.radians(degrees), **how)


def refused(build):
    with pytest.raises(InputError) as caught:
        build()
    assert caught.value.code == "E186"
    return str(caught.value)


def test_angles_are_missed_but_for_one_shift_and_whole_turns():
    missed = timing(0, 350, 340).missed(np.radians([77, 66, 57 + 720]))
    np.testing.assert_allclose(np.degrees(missed), [0, -1, 0], atol=1e-9)
    missed = timing(10, np.nan, 30, absolute=True).missed(np.radians([11, 5, 389]))
    np.testing.assert_allclose(np.degrees(missed)[[0, 2]], [1, -1], atol=1e-9)
    assert np.isnan(missed[1])


def test_a_sense_is_stated_by_negative_angles_and_by_more_than_a_turn():
    assert [timing(*each).sense for each in ([0, -20, -50], [0, 200, 390], [90, 60, 30])] == [
        -1,
        1,
        -1,
    ]
    assert [timing(*each).sense for each in ([0, 342, 325], [0, 20, 50], [0, -20, 30])] == [0] * 3
    # A crank that comes to the same place the other way round is off by a turn.
    assert np.abs(timing(0, -20).missed(np.radians([0, 340]))).max() == pytest.approx(np.pi)
    assert np.abs(timing(0, 340).missed(np.radians([0, -20]))).max() < 1e-12


def test_a_bound_is_stated_or_a_twentieth_of_the_range():
    assert np.degrees(timing(0, 350, 330).bound) == pytest.approx(1.5)
    assert timing(0, 90, within=0.01).bound == 0.01


def test_repeated_and_chosen_poses_keep_their_angles():
    some = timing(0, 10, np.nan, 30).merged(np.array([0, 1, 0, 2]))
    np.testing.assert_allclose(np.degrees(some.angles), [0, 10, 30])
    assert timing(0, np.nan, 30).at(np.array([0, 1])) is None
    assert timing(0, np.nan, 30).merged(np.array([0, 1, 0])) is None


@pytest.mark.parametrize(
    ("angles", "words"),
    [
        ([0, 20], "crank angles of 2 poses, and 3 poses"),
        ([0, 20, 20], "same angle at pose 2 and pose 3"),
        ([0, 360, np.nan], "same angle at pose 1 and pose 2"),
    ],
)
def test_angles_that_no_crank_has_are_refused(angles, words):
    assert words in refused(lambda: Task(POSES, timing=timing(*angles)))


def test_a_body_that_came_back_has_its_crank_where_it_was():
    again = Displacement(POSES.translation[[0, 1, 0]], POSES.angle[[0, 1, 0]])
    assert "pose 1 and pose 3 are the same" in refused(lambda: Task(again, timing=timing(0, 5, 9)))
    Task(again, timing=timing(0, 5, 360))


def test_malformed_timings_are_refused():
    within = PoseTolerances.uniform(3, 1, 1, 1)
    for build in (
        lambda: timing(0, np.inf),
        lambda: timing(3, np.nan),
        lambda: timing(np.nan, absolute=True),
        lambda: timing(0, 3, within=-1),
        lambda: Task(POSES, timing=timing(0, 20, 40), tolerances=within),
    ):
        refused(build)
