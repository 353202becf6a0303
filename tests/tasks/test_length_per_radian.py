"""What a radian counts as, against moments of boxes and distances that are known."""

import numpy as np
import pytest

from burmester import Displacement, Polygon, Task, box, synthesize
from burmester.tasks.length_per_radian import default_length_per_radian


def task(rows, **given):
    return Task(Displacement.from_poses(rows), **given)


def hinge(radius, turn, count=7, at=(0.0, 0.0)):
    angle = np.linspace(0, turn, count)
    x, y = at[0] + radius * np.cos(angle), at[1] + radius * np.sin(angle)
    return np.column_stack([x, y, angle])


@pytest.mark.parametrize("turn", [0.7, 1.5, 3.0])
def test_of_a_pure_turn_it_is_a_third_of_the_radius(turn):
    assert default_length_per_radian(task(hinge(210.0, turn))) == pytest.approx(70.0)


def test_it_is_bounded_by_the_span_where_the_body_hardly_turns():
    rows = hinge(1.0e6, 1e-4)
    span = np.linalg.norm(np.ptp(rows[:, :2], axis=0))
    assert default_length_per_radian(task(rows)) == pytest.approx(span)
    still = np.column_stack([rows[:, :2], np.zeros(len(rows))])
    assert default_length_per_radian(task(still)) == pytest.approx(span)


def test_it_scales_with_the_unit_and_does_not_see_the_ground_frame_or_the_order():
    rng = np.random.default_rng(3)
    rows = rng.normal(size=(8, 3))
    length = default_length_per_radian(task(rows))
    turn = np.exp(0.8j)
    d = turn * (rows[:, 0] + 1j * rows[:, 1]) * 25.4 + (300 - 50j)
    moved = np.column_stack([d.real, d.imag, rows[:, 2] + 0.8 + 2 * np.pi])[rng.permutation(8)]
    assert default_length_per_radian(task(moved)) == pytest.approx(25.4 * length)


def test_a_weight_of_two_is_a_pose_given_twice():
    rows = np.random.default_rng(4).normal(size=(7, 3))
    twice = np.vstack([rows, rows[2]])
    weights = np.where(np.arange(7) == 2, 2.0, 1.0)
    weighted = default_length_per_radian(task(rows, weights=weights))
    assert weighted == pytest.approx(default_length_per_radian(task(twice)))


def test_with_an_outline_it_is_the_radius_of_gyration_about_the_origin_of_the_body():
    rows = hinge(100.0, 1.0)
    plate = box((20, -5), (80, 5))  # of 60 by 10 about (50, 0)
    square = (60**2 + 10**2) / 12 + 50**2
    assert default_length_per_radian(task(rows, body=plate)) == pytest.approx(np.sqrt(square))
    # An L: two boxes, of 40 by 10 about (20, 5) and of 10 by 20 about (5, 20).
    corner = Polygon([(0, 0), (40, 0), (40, 10), (10, 10), (10, 30), (0, 30)])
    moment = 400 * ((40**2 + 10**2) / 12 + 20**2 + 5**2)
    moment += 200 * ((10**2 + 20**2) / 12 + 5**2 + 20**2)
    wanted = np.sqrt(moment / 600)
    assert default_length_per_radian(task(rows, body=corner)) == pytest.approx(wanted)
    backwards = Polygon(corner.vertices[::-1])
    assert default_length_per_radian(task(rows, body=backwards)) == pytest.approx(wanted)


def test_a_larger_body_holds_the_angle_truer():
    """A lid that no four-bar makes exactly: what is known of the body decides the compromise."""
    rows = [(0, 0, 0), (-8, 31, 12), (-25, 58, 31), (-52, 79, 50), (-84, 91, 74), (-120, 95, 95)]
    small, large = (
        synthesize(Task.from_rows(rows, angle_unit="deg", body=box((-r, -r), (r, r)))).linkages
        for r in (4.0, 400.0)
    )

    def nearest(linkages):
        best = min(linkages, key=lambda found: found.combined_error)
        return best.error.rms, np.sqrt((best.error.angle**2).mean())

    (far, turned), (far2, turned2) = nearest(small), nearest(large)
    assert far < far2
    assert turned2 < turned / 2
