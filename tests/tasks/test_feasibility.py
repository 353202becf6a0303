"""How far apart two regions are at a pose, against points sampled in both; what is refused."""

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.tasks.feasibility import require_feasible, spans
from burmester.tasks.limits import Limits

ARROW = Polygon(np.array([(0, 0), (4, 2), (0, 4), (1.5, 2)], float))
REGIONS = {
    "point": Point([0.5, -1]),
    "segment": Segment([-1, 0], [2, 1.5]),
    "box": box([-1, -2], [3, -1]),
    "arrow": ARROW,
    "line": Line([0, 1], [3, 2]),
}


def sampled(region):
    """Points of a region, close together; of a line only a long piece."""
    if isinstance(region, Point):
        return region.at[None]
    if isinstance(region, Segment | Line):
        share = np.linspace(-8, 9, 1000) if isinstance(region, Line) else np.linspace(0, 1, 300)
        return region.start + share[:, None] * (region.end - region.start)
    v = region.vertices
    low, high = v.min(axis=0), v.max(axis=0)
    grid = np.stack(np.meshgrid(*(np.linspace(a, b, 25) for a, b in zip(low, high, strict=True))))
    grid = grid.reshape(2, -1).T
    share = np.linspace(0, 1, 61)[:, None]
    edges = [a + share * (b - a) for a, b in zip(v, np.roll(v, -1, axis=0), strict=True)]
    return np.concatenate([grid[region.distance(grid) == 0], *edges])


@pytest.mark.parametrize("in_f", REGIONS)
@pytest.mark.parametrize("in_m", REGIONS)
def test_span_is_that_of_the_nearest_and_farthest_points(in_f, in_m):
    rng = np.random.default_rng(3)
    poses = Displacement(rng.normal(scale=3, size=(6, 2)), rng.uniform(-4, 4, 6))
    got = spans(poses, REGIONS[in_f], REGIONS[in_m])
    fixed, moving = sampled(REGIONS[in_f]), sampled(REGIONS[in_m])
    for k in range(6):
        angle = poses.angle[k]
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        placed = moving @ turn.T + poses.translation[k]
        apart = np.hypot(*np.moveaxis(fixed[:, None] - placed, -1, 0))
        assert got[k, 0] <= apart.min() + 1e-9
        assert got[k, 0] >= apart.min() - 0.2  # the spacing of the points
        if "line" in (in_f, in_m):
            assert got[k, 1] == np.inf
        else:
            assert got[k, 1] == pytest.approx(apart.max(), abs=1e-9)


def test_regions_that_cross_without_a_corner_inside_are_0_apart():
    tall, wide = box([-1, -5], [1, 5]), box([-5, -1], [5, 1])
    assert spans(Displacement(np.zeros((1, 2)), np.zeros(1)), tall, wide)[0, 0] == 0
    quarter = Displacement(np.array([[0.5, 0.2]]), np.array([np.pi / 2]))
    assert spans(quarter, tall, tall)[0, 0] == 0
    assert spans(quarter, tall, wide)[0, 0] == 0


def poses_at(*places):
    """Poses that carry the origin of M there, turned by any angle."""
    places = np.array(places, float)
    return Displacement(places, np.linspace(0, 2, len(places)))


FAR = poses_at((12, 0), (0, 13), (-15, 0))
ORIGIN = Point([0, 0])


def refusal(poses, *limits, exact=None):
    with pytest.raises(InputError) as caught:
        require_feasible(poses, limits, None if exact is None else np.array(exact))
    assert caught.value.code == "E132"
    assert caught.value.help
    return str(caught.value)


def test_a_link_too_short_for_every_pose_is_refused_and_the_limits_quoted():
    text = refusal(FAR, Limits(fixed_pivot=ORIGIN, moving_pivot=ORIGIN, length=(0, 3)))
    assert "fixed pivot at (0, 0) and moving pivot at (0, 0) are between 12 and 15 apart" in text
    assert "at most 3 long" in text
    assert "pose 1, where they are 12 apart" in text
    assert "allow a longer link" in text


def test_a_link_too_long_for_every_pose_is_refused():
    moving = box([-1, -1], [1, 1])
    text = refusal(FAR, Limits(fixed_pivot=ORIGIN, moving_pivot=moving, length=(20, np.inf)))
    assert "at least 20 long" in text
    assert "in the box from (-1, -1) to (1, 1)" in text
    assert "pose 3" in text
    assert "allow a shorter link" in text


def test_a_hinge_on_a_wall_that_the_link_does_not_reach():
    wall = Line([-10, 20], [10, 20])
    limits = Limits(fixed_pivot=wall, moving_pivot=ORIGIN, length=(0, 5))
    text = refusal(FAR, limits)
    assert "are at least 7 apart" in text
    assert "on the line through (-10, 20) and (10, 20)" in text
    require_feasible(FAR, (Limits(fixed_pivot=wall, moving_pivot=ORIGIN, length=(0, 8)),))


def test_one_pose_within_reach_is_enough():
    limits = Limits(fixed_pivot=ORIGIN, moving_pivot=ORIGIN, length=(12, 12))
    require_feasible(FAR, (limits,))
    require_feasible(FAR, (Limits(fixed_pivot=ORIGIN, length=(0, 1)),))
    require_feasible(FAR, (Limits(moving_pivot=box([0, 0], [1, 1]), length=(0, 1)), Limits()))


def test_a_range_between_the_poses_names_the_nearest():
    text = refusal(FAR, Limits(fixed_pivot=ORIGIN, moving_pivot=ORIGIN, length=(13.2, 14)))
    assert "between 13.2 and 14 long" in text
    assert "nearest to that is pose 2, where they are 13 apart" in text


def test_an_exact_pose_out_of_reach_is_refused_though_others_are_not():
    limits = Limits(fixed_pivot=ORIGIN, moving_pivot=ORIGIN, length=(0, 13.5))
    require_feasible(FAR, (limits,), np.array([True, False, False]))
    text = refusal(FAR, limits, exact=[False, False, True])
    assert "15 apart at pose 3" in text
    assert "at most 13.5 long" in text
    limits = Limits(fixed_pivot=ORIGIN, moving_pivot=ORIGIN, length=(13.5, 99))
    assert "12 apart at pose 1" in refusal(FAR, limits, exact=[True, False, False])


def test_exact_poses_that_ask_for_different_lengths_are_refused():
    limits = Limits(fixed_pivot=box([-0.1, -0.1], [0.1, 0.1]), moving_pivot=ORIGIN)
    require_feasible(FAR, (limits,))
    text = refusal(FAR, limits, exact=[True, False, True])
    assert "at pose 3" in text
    assert "at pose 1" in text
    assert "one length" in text
    wide = Limits(fixed_pivot=box([-2, -2], [2, 2]), moving_pivot=ORIGIN)
    require_feasible(FAR, (wide,), np.array([True, True, True]))


def test_a_true_linkage_is_never_refused():
    """Poses driven by a link, regions around its pivots, a range around its length."""
    rng = np.random.default_rng(8)
    for _ in range(200):
        fixed, moving, radius = rng.normal(size=2), rng.normal(size=2), rng.uniform(0.1, 3)
        angle, swing = rng.uniform(-3, 3, (2, 7))
        pin = fixed + radius * np.stack([np.cos(swing), np.sin(swing)], axis=-1)
        held = Displacement(np.zeros((7, 2)), angle).act(moving)
        poses = Displacement(pin - held, angle)
        size = rng.uniform(1e-9, 1, (2, 2, 2))
        regions = [box(at - a, at + b) for at, (a, b) in zip((fixed, moving), size, strict=True)]
        limits = Limits(*regions, length=(radius, radius))
        require_feasible(poses, (limits, limits), np.ones(7, dtype=bool))
        points = Limits(Point(fixed), Point(moving), length=(radius, radius))
        require_feasible(poses, (points,), np.ones(7, dtype=bool))


@pytest.mark.parametrize("name", ["fixed_pivot", "moving_pivot"])
def test_two_dyads_cannot_share_a_point(name):
    one, same, other = (Limits(**{name: Point(at)}) for at in ([1, 2], [1, 2], [1, 3]))
    text = refusal(FAR, one, same)
    assert f"both dyads have the {name.replace('_', ' ')} at (1, 2)" in text
    require_feasible(FAR, (one, other))
    require_feasible(FAR, (one, Limits()))


def test_rounding_is_no_contradiction():
    limits = Limits(fixed_pivot=ORIGIN, moving_pivot=ORIGIN, length=(0, 12 * (1 - 1e-8)))
    require_feasible(FAR, (limits,))
    require_feasible(poses_at((12, 0), (0, 12 + 1e-9), (9, 9)), (limits,), np.array([1, 1, 0]))
