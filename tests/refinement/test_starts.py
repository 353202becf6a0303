"""Where linkages start: links within limits by brute force, near misses by driving, variety."""

import numpy as np
import pytest

from burmester import Limits
from burmester.fourbar.dyad import RR
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.pose_error import error_frames
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point, Polygon, Segment, box
from burmester.refinement.starts import (
    distinct,
    first_order_miss,
    links_of_pivot_map,
    projected,
    varied,
)
from tests.oracles.hard_tasks import noisy_task, rough_task
from tests.oracles.witness import misses

TRIANGLE = Polygon([(-2, -1), (1, -1), (0.5, 2)])


def own_error(rows, fixed, moving):
    """The rms distance of a moving pivot from its circle of the mean radius, and that radius."""
    cos, sin = np.cos(rows[:, 2]), np.sin(rows[:, 2])
    x = rows[:, 0] + cos * moving[0] - sin * moving[1] - fixed[0]
    y = rows[:, 1] + sin * moving[0] + cos * moving[1] - fixed[1]
    far = np.hypot(x, y)
    return far.std(), far.mean()


def seen_from(rows, length=0.3):
    """Poses in the frames of errors, and these frames."""
    poses = Displacement.from_poses(rows)
    frames = error_frames(poses, length)
    return frames.to_canonical(poses), frames


@pytest.mark.parametrize(
    ("limits", "inside"),
    [
        (Limits(fixed_pivot=Point([0.4, -0.7])), lambda c, m: np.hypot(*(c - [0.4, -0.7]))),
        (Limits(fixed_pivot=Line([0, 1], [1, 3])), lambda c, m: abs(2 * c[0] - c[1] + 1)),
        (
            Limits(moving_pivot=Segment([1, 0], [1, 2])),
            lambda c, m: max(abs(m[0] - 1), m[1] - 2, -m[1]),
        ),
        (
            Limits(fixed_pivot=TRIANGLE, moving_pivot=box([0, 0], [1, 0.5])),
            lambda c, m: max(
                *[-1 - c[1], 3 * c[0] + 0.5 * c[1] - 2.5, -3 * c[0] + 2.5 * c[1] - 3.5],
                *[-m[0], -m[1], m[0] - 1, m[1] - 0.5],
            ),
        ),
    ],
)
def test_links_lie_within_limits(limits, inside):
    rows, _ = rough_task(np.random.default_rng(3), 6)
    seen, frames = seen_from(rows)
    links = links_of_pivot_map(seen, None, limits, frames)
    assert links
    for link in links:
        own = frames.circle_from_canonical(link[None])[0]
        assert inside(own.fixed_pivot, own.moving_pivot) < 1e-9
        assert own.radius == pytest.approx(own_error(rows, own.fixed_pivot, own.moving_pivot)[1])


def test_links_within_a_box_and_bounds_of_their_length_are_the_best_there():
    """No link of the box with pivots on its grid is better than the first by more than the grid."""
    rows, _ = rough_task(np.random.default_rng(4), 6)
    seen, frames = seen_from(rows)
    limits = Limits(
        fixed_pivot=box([-1, -1], [1, 1]), moving_pivot=box([-1, 0], [0, 1]), length=(0.5, 2.0)
    )
    links = [
        frames.circle_from_canonical(link[None])[0]
        for link in links_of_pivot_map(seen, None, limits, frames)
    ]
    assert all(0.5 <= link.radius <= 2.0 for link in links)
    first = own_error(rows, links[0].fixed_pivot, links[0].moving_pivot)[0]
    side = np.linspace(0, 1, 13)
    every = [
        own_error(rows, (2 * a - 1, 2 * b - 1), (c - 1, d))[0]
        for a in side
        for b in side
        for c in side[::2]
        for d in side[::2]
    ]
    assert first == pytest.approx(min(every), rel=0.2)
    assert first < np.percentile(every, 1)


def test_limits_without_pins_have_no_links():
    seen, frames = seen_from(rough_task(np.random.default_rng(4), 6)[0])
    assert links_of_pivot_map(seen, None, Limits(kinds=frozenset({"PR"})), frames) == []


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_how_near_a_pair_comes_is_so_to_first_order(seed):
    """Held against the linkage driven joint by joint, for poses a thousandth away from it."""
    rows, (linkage, _) = noisy_task(np.random.default_rng(seed), 7, noise=1e-3)
    poses = Displacement.from_poses(rows)
    length = 0.8
    frames = error_frames(poses, length)
    seen, unit = frames.to_canonical(poses), float(frames.length)
    batch = LinkageBatch.of([linkage]).to_canonical(frames)
    found = first_order_miss(batch, seen, length / unit, None)[0]
    true = (misses(linkage, poses, length) ** 2).sum() / unit**2
    assert found == pytest.approx(true, rel=0.05)
    weights = np.array([1, 0, 0, 0, 0, 0, 0]) + 1e-9
    one = first_order_miss(batch, seen, length / unit, weights)[0] / 7
    assert one == pytest.approx(misses(linkage, poses, length)[0] ** 2 / unit**2, rel=0.05)


def test_poses_are_carried_straight_onto_their_linkage():
    rows, (linkage, _) = noisy_task(np.random.default_rng(5), 7, noise=0.02)
    seen, frames = seen_from(rows, 0.8)
    far = Linkage(linkage.first, RR([50, 50], linkage.second.moving_pivot, 0.1))
    batch = LinkageBatch.of([linkage, far]).to_canonical(frames)
    length = 0.8 / float(frames.length)
    wanted = rows_of(seen, length)
    there, sound = projected(batch, np.broadcast_to(wanted, (2, *wanted.shape)), length)
    assert sound.tolist() == [True, False]
    at = frames.from_canonical(Displacement(there[0, :, :2], there[0, :, 2] / length))
    for dyad in (linkage.first, linkage.second):
        arm = at.act(dyad.moving_pivot) - dyad.fixed_pivot
        assert np.hypot(*arm.T) == pytest.approx(np.full(7, dyad.radius))


def test_the_lowest_scores_are_taken_with_no_part_too_often():
    score = np.array([3.0, 1.0, 2.0, 4.0, np.inf, 0.5])
    parts = np.array([[0, 1], [0, 2], [0, 3], [4, 5], [6, 7], [0, 8]])
    assert varied(score, parts, most=9, each=9).tolist() == [5, 1, 2, 0, 3]
    assert varied(score, parts, most=9, each=2).tolist() == [5, 1, 3]
    assert varied(score, parts, most=2, each=9).tolist() == [5, 1]


def test_linkages_are_one_where_their_places_differ_by_a_share_of_their_error():
    rows = np.zeros((5, 4, 3))
    rows[1:, 0, 0] = 1.5e-4, 2.5e-3, 5e-3, 5.0005e-3
    cost = 4 * np.array([1e-4, 2e-4, 3e-4, np.nan, 4e-4]) ** 2
    assert distinct(rows, cost, 9).tolist() == [0, 1, 2, 4]
    assert distinct(rows, 100 * cost, 9).tolist() == [0, 2, 4]
    assert distinct(rows, cost, 2).tolist() == [0, 1]
    assert distinct(rows, cost, 9, rows[2:3]).tolist() == [0, 1, 4]
