"""Tasks with points: every four-bar through them, judged at its own angles."""

import json
from dataclasses import replace

import numpy as np
import pytest

from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Point, box
from burmester.io.result import synthesis_data
from burmester.points.point_sets import line_or_circle, point_set
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.point_conditions import point_conditions
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import PoseTolerances
from burmester.tasks.repeated_poses import repeats_in_sequence
from tests.oracles.witness import missed

GROUNDED = (Point((0.0, 0.0)), Point((2.8, 0.0)))  # the fixed pivots of the linkage below

CRANK, COUPLER, FOLLOWER, GROUND, POINT = 1.0, 2.6, 2.4, 2.8, 1.2 + 0.9j


def of_crank_rocker(degrees, is_point):
    """A task that a known crank-rocker meets, driven here by its closed form."""
    a = CRANK * np.exp(1j * np.radians(degrees))
    to = GROUND - a
    open_ = np.arccos((COUPLER**2 + abs(to) ** 2 - FOLLOWER**2) / (2 * COUPLER * abs(to)))
    turn = to / abs(to) * np.exp(1j * open_)
    p = a + turn * POINT
    free = np.where(is_point, np.inf, 0.0)
    return Task(
        Displacement(np.column_stack([p.real, p.imag]), np.where(is_point, 0, np.angle(turn))),
        tolerances=PoseTolerances(np.zeros((len(p), 2)), free),
    )


def test_the_linkage_that_made_the_points_is_found_and_works():
    is_point = np.array([0, 0, 1, 0, 1, 0], dtype=bool)
    task = of_crank_rocker(np.array([20, 50, 85, 120, 160, 200]), is_point)
    synthesis = synthesize(task)
    assert synthesis.outcome.code == "R340"
    best = synthesis.linkages[0]
    assert best.usable
    assert sorted(best.linkage.links) == pytest.approx([1.0, 2.4, 2.6, 2.8], abs=1e-6)
    for each in synthesis.linkages:
        rows = np.column_stack([each.error.places.translation, each.error.places.angle])
        assert max(missed(each.linkage, row) for row in rows) < 1e-6
        assert np.abs(rows[:, :2] - task.poses.translation).max() < 1e-6
        assert each.error.angle.max() < 1e-6
    (search,) = synthesis_data(synthesis)["search"]
    assert (search["classes"], search["found"], search["lost"]) == (30, 30, 0)
    assert search["real"] == len(synthesis.linkages)
    json.dumps(search)


@pytest.mark.parametrize(
    ("poses", "first", "second", "classes"),
    [
        (0, GROUNDED[0], GROUNDED[1], 36),
        (2, GROUNDED[1], GROUNDED[0], 6),
        (3, GROUNDED[0], None, 12),
        (2, None, GROUNDED[1], 94),
    ],
)
def test_pivots_at_points_are_conditions_as_poses_and_points_are(poses, first, second, classes):
    """The linkage that made the points is found, with its dyads as the limits name them."""
    given = (first is not None) + (second is not None)
    points = 8 - 2 * given - 2 * (poses - 1) if poses else 9 - 2 * given
    is_point = np.arange(poses + points) >= poses
    task = of_crank_rocker(np.linspace(20, 200, poses + points), is_point)
    limits = (Limits(fixed_pivot=first), Limits(fixed_pivot=second))
    task = replace(task, limits=limits)
    assert f"{classes} four-bars" in point_conditions(task).in_words()
    synthesis = synthesize(task)
    (search,) = synthesis_data(synthesis)["search"]
    assert (search["classes"], search["found"], search["lost"]) == (classes, classes, 0)
    for each in synthesis.linkages:
        assert not each.violations
        rows = np.column_stack([each.error.places.translation, each.error.places.angle])
        assert max(missed(each.linkage, row) for row in rows) < 1e-6
        for limit, dyad in zip(limits, each.dyads, strict=True):
            if limit.fixed_pivot is not None:
                assert dyad.dyad.fixed_pivot == pytest.approx(limit.fixed_pivot.at, abs=1e-9)
    made = [1.0, 2.4, 2.6, 2.8]
    usable = [sorted(each.linkage.links) for each in synthesis.usable]
    assert any(each == pytest.approx(made, abs=1e-5) for each in usable)


def test_of_two_regions_each_dyad_keeps_its_own():
    """Where the first limit names the pivot of the follower, the follower comes first."""
    task = of_crank_rocker(
        np.array([20, 50, 85, 120, 160, 200]), np.array([0, 0, 1, 0, 1, 0], dtype=bool)
    )
    boxes = [box(each.at - 0.1, each.at + 0.1) for each in reversed(GROUNDED)]
    found = synthesize(replace(task, limits=tuple(Limits(fixed_pivot=each) for each in boxes)))
    best = found.linkages[0]
    assert best.usable
    assert best.dyads[0].dyad.fixed_pivot == pytest.approx([2.8, 0], abs=1e-6)


def test_more_points_than_pivots_leave_room_for_are_a_path():
    is_point = np.ones(8, dtype=bool)
    task = of_crank_rocker(np.linspace(20, 200, 8), is_point)
    assert task.path is None
    given = (Limits(fixed_pivot=GROUNDED[0]), Limits())
    assert replace(task, limits=given).path is not None
    is_point[:2] = False
    many = replace(of_crank_rocker(np.linspace(20, 200, 8), is_point), limits=given)
    assert "more than a four-bar can meet" in point_conditions(many).in_words()


def test_a_time_limit_ends_the_following():
    """What was found until then is the answer; that a real one may be missing is told."""
    task = of_crank_rocker(np.linspace(20, 200, 9), np.ones(9, dtype=bool))
    synthesis = synthesize(task, SynthesisOptions(time_limit=0.05))
    assert synthesis.points.found < synthesis.points.followed + 1 <= 1442
    assert [each.code for each in synthesis.warnings][-1] == "W221"
    assert "W223" not in [each.code for each in synthesis.warnings]


def test_nine_points_on_a_circle_are_told():
    angle = np.linspace(0, 3, 9)
    points = 2 + 5 * np.column_stack([np.cos(angle), np.sin(angle)])
    free = PoseTolerances(np.zeros((9, 2)), np.full(9, np.inf))
    synthesis = synthesize(Task(Displacement(points, np.zeros(9)), tolerances=free))
    assert synthesis.outcome.code == "R343"
    assert "(2, 2) with the length 5" in synthesis.outcome.why


def test_curves_that_points_lie_on_are_recognised():
    t = np.array([0.1, 0.4, 0.9, 1.7, 2.2, 3.1, 4.0])
    ellipse = np.column_stack([3 * np.cos(t) + 7, np.sin(t) + np.cos(t)])
    assert point_set(ellipse).kind == "conic"
    assert point_set(ellipse + 1e-3 * np.column_stack([t**3, t**2])) is None
    assert point_set(np.column_stack([t, 2 * t - 1])).kind == "line"
    assert point_set(np.column_stack([np.cos(t), np.sin(t)])).kind == "circle"


def test_eight_of_nine_points_on_an_ellipse_are_told_as_linkages_of_theirs_are_at_infinity():
    t = np.array([0.1, 0.4, 0.9, 1.7, 2.2, 3.1, 4.0, 4.9, 5.6])
    points = np.column_stack([3 * np.cos(t) + 7, np.sin(t) + np.cos(t)])
    points[4] += [0.3, -0.2]
    found = point_set(points)
    assert found.kind == "conic"
    assert np.flatnonzero(~found.on).tolist() == [4]
    assert point_set(np.round(points, 4)) is None
    rounded = point_set(np.round(points, 4), 5e-5)
    assert np.flatnonzero(~rounded.on).tolist() == [4]
    free = PoseTolerances(np.zeros((9, 2)), np.full(9, np.inf))
    synthesis = synthesize(Task(Displacement(points, np.zeros(9)), tolerances=free))
    assert next(each.message for each in synthesis.warnings).startswith("8 of the 9 points lie")
    assert synthesis.points.found < synthesis.points.classes
    points[6] += [0.1, 0.3]
    assert point_set(points) is None


@pytest.mark.parametrize(("poses", "points", "code"), [(3, 2, "R308"), (0, 6, "R350")])
def test_fewer_rows_leave_infinitely_many_and_pivots_open(poses, points, code):
    """What is listed is driven through all rows; no pose says how certain its pivots are."""
    is_point = np.arange(poses + points) % 2 == 1 if poses else np.ones(points, dtype=bool)
    task = of_crank_rocker(np.linspace(20, 200, poses + points), is_point)
    synthesis = synthesize(task)
    assert synthesis.outcome.code == code
    assert "infinitely many" in synthesis.outcome.message
    assert not {"W203", "W206", "W207", "W226"} & {each.code for each in synthesis.warnings}
    assert len(synthesis.usable) > 1
    for each in synthesis.usable:
        places = each.error.places
        rows = np.column_stack([places.translation, places.angle])
        assert max(missed(each.linkage, row) for row in rows) < 1e-6
        assert np.abs(places.translation - task.poses.translation).max() < 1e-6
        assert each.uncertainty is None
    assert np.degrees(synthesis.usable[0].driven.least_over_range) > 30


@pytest.mark.parametrize(("at", "why"), [(2, "row 4 repeats 3"), (5, "row 6 repeats 7")])
def test_a_row_that_repeats_the_one_beside_it_is_taken_out(at, why):
    """A point that is there twice, and a point before the pose that has its place."""
    is_point = np.array([0, 0, 1, 0, 1, 0], dtype=bool)
    task = of_crank_rocker(np.array([20, 50, 85, 120, 160, 200]), is_point)
    once = synthesize(task)
    more = task.at(np.array([0, 1, 2, 3, 4, 5])[np.sort([0, 1, 2, 3, 4, 5, at])])
    if not is_point[at]:
        free = task.tolerances.at(np.sort([0, 1, 2, 3, 4, 5, at]))
        angle = free.angle.copy()
        angle[at] = np.inf
        more = replace(more, tolerances=PoseTolerances(free.position, angle))
    twice = synthesize(more)
    assert (twice.warnings[0].code, twice.warnings[0].why) == ("W208", why)
    links = [sorted(each.linkage.links) for each in once.linkages]
    assert np.array([sorted(each.linkage.links) for each in twice.linkages]) == pytest.approx(
        np.array(links)
    )


def test_a_path_of_ten_rows_with_a_repeat_is_nine_points():
    task = of_crank_rocker(np.linspace(20, 200, 9), np.ones(9, dtype=bool))
    rows = task.poses.translation[[0, 1, 2, 3, 3, 4, 5, 6, 7, 8]]
    free = PoseTolerances(np.zeros((10, 2)), np.full(10, np.inf))
    synthesis = synthesize(Task(Displacement(rows, np.zeros(10)), tolerances=free))
    assert (synthesis.outcome.code, synthesis.points.classes) == ("R340", 1442)
    made = [1.0, 2.4, 2.6, 2.8]
    assert any(
        sorted(each.linkage.links) == pytest.approx(made, abs=1e-5) for each in synthesis.usable
    )


def test_a_point_that_the_curve_passes_twice_stays():
    points = Displacement(np.array([[0.0, 0], [1, 1], [2, 0], [1, 1], [0, 2]]), np.zeros(5))
    first, group = repeats_in_sequence(points, np.ones(5, dtype=bool))
    assert first.tolist() == group.tolist() == [0, 1, 2, 3, 4]


def of_points(points, decimals=None):
    """A task of points, known to so many decimals."""
    if decimals is not None:
        points = np.round(points, decimals)
    return Task(
        Displacement(points, np.zeros(len(points))),
        tolerances=PoseTolerances(np.zeros((len(points), 2)), np.full(len(points), np.inf)),
        resolution=(0.0 if decimals is None else 0.5 * 10.0**-decimals, 0.0),
    )


ON_CIRCLE = np.column_stack([np.cos(np.linspace(0, 5, 9)), np.sin(np.linspace(0, 5, 9))])


@pytest.mark.parametrize("count", [8, 9, 12])
def test_a_circle_is_known_by_the_digits_of_its_points(count):
    angle = np.linspace(0, 5, count)
    circle = 40 * np.column_stack([np.cos(angle), np.sin(angle)]) + [7, -3]
    synthesis = synthesize(of_points(circle, 3))
    assert (synthesis.outcome.code, synthesis.linkages) == ("R343", ())
    assert "(7, -3) with the length 40" in synthesis.outcome.why


def test_eight_of_nine_points_on_a_line_are_missed_by_the_nearest():
    """No coupler curve meets a line in more than six points; what is listed traces them nearly."""
    points = np.column_stack([np.arange(9.0), np.zeros(9)])
    points[-1] = 8, 1
    synthesis = synthesize(of_points(points, 6))
    assert synthesis.outcome.code == "R350"
    assert "8 of the 9 points lie on a line" in synthesis.warnings[0].message
    for each in synthesis.usable:
        rows = np.column_stack([each.error.places.translation, each.error.places.angle])
        assert max(missed(each.linkage, row) for row in rows) < 1e-6
        assert 0 < np.abs(rows[:, :2] - points).max() < 1e-2


@pytest.mark.parametrize(
    ("beside", "kind"), [((), "circle"), ((4,), "circle"), ((1, 6), "circle"), ((1, 3, 6), None)]
)
def test_lines_and_circles_with_some_points_beside_them(beside, kind):
    points = ON_CIRCLE.copy()
    points[list(beside)] *= 1.1
    found = line_or_circle(points)
    assert (None if found is None else found.kind) == kind
    if kind:
        assert np.flatnonzero(~found.on).tolist() == list(beside)
        assert found.centre == pytest.approx([0, 0], abs=1e-12)
    rounded = line_or_circle(np.round(points, 4), 5e-5)
    assert (None if rounded is None else rounded.kind) == kind
    assert line_or_circle(np.round(points, 4)) is None


def test_positions_on_a_line_with_angles_at_some_have_no_linkage():
    points = np.column_stack([np.arange(8.0), np.zeros(8)])
    angle = np.where(np.isin(np.arange(8), [0, 7]), 0.0, np.inf)
    tolerances = PoseTolerances(np.zeros((8, 2)), angle)
    poses = Displacement(points, np.linspace(0, 0.5, 8))
    synthesis = synthesize(Task(poses, tolerances=tolerances))
    assert (synthesis.outcome.code, synthesis.points) == ("R342", None)
    assert "all 8 positions lie on a line" in synthesis.outcome.message
