"""Tasks of one or two poses with limited pivots: the same dyads in every frame and unit."""

import numpy as np
import pytest

from burmester import synthesize
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Line, Point
from burmester.tasks.limits import Limits, frames_of
from burmester.tasks.motion_task import Task, characteristic_length
from tests.oracles.witness import random_four_bar, random_poses
from tests.samples import samples


def turned(angle, v):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) @ v


def task_of(seed, count, scale, shift_f, shift_m):
    """A four-bar by five conditions a dyad, in another unit and other frames, and its dyads."""
    rng = np.random.default_rng([7, seed])
    dyads = random_four_bar(rng)
    limits, wanted = [], []
    for dyad in dyads:
        c = np.asarray(dyad.fixed_pivot) * scale + shift_f
        m = np.asarray(dyad.moving_pivot) * scale + shift_m
        along = rng.normal(size=2) * scale
        moving = Point(m) if count == 1 else Line(m - along, m + along)
        limits.append(Limits(Point(c), moving, kinds={"RR"}))
        wanted.append([*c, *m, float(dyad.radius) * scale])
    rows = random_poses(dyads, rng, count, ordered=True)
    rows = [[*(r[:2] * scale + shift_f - turned(r[2], shift_m)), r[2]] for r in rows]
    return Task(Displacement.from_poses(np.array(rows)), limits=tuple(limits)), np.array(wanted)


FAR = np.array([1e6, -4e5])
MOVES = [(scale, 0 * FAR, 0 * FAR) for scale in (1e-6, 1e-3, 1.0, 1e3, 1e6)]
MOVES += [(1.0, FAR, 0 * FAR), (1.0, 0 * FAR, FAR), (1.0, FAR, FAR), (1e6, 1e6 * FAR, 0 * FAR)]


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize(("scale", "shift_f", "shift_m"), MOVES)
def test_few_poses_have_the_same_dyads_in_every_frame_and_unit(count, scale, shift_f, shift_m):
    for seed in samples(4, 2):
        task, wanted = task_of(seed, count, scale, shift_f, shift_m)
        found = synthesize(task)
        for number, row in enumerate(wanted, start=1):
            dyads = [x.dyad for x in found.dyads if x.limits == number and isinstance(x.dyad, RR)]
            rows = [[*d.fixed_pivot, *d.moving_pivot, d.radius] for d in dyads]
            assert min(np.abs(row - np.array(other)).max() for other in rows) < 1e-6 * scale
        # Seen from far away errors are magnified, and further linkages (M) are looked for.
        told = {each.code for each in found.warnings if not each.message.startswith("M")}
        assert not {"W204", "W206", "W207"} & told
        at_home = characteristic_length(task_of(seed, count, 1.0, 0 * FAR, 0 * FAR)[0])
        assert np.isclose(found.length, scale * at_home, rtol=1e-8)


def test_one_pose_is_measured_by_its_pivots():
    """Of one pose, half of the link between two points; of two pairs, the rms about the middle."""
    pose = Displacement.from_poses(np.array([[3.0, -1.0, 0.7]]))
    c, m = np.array([1000.0, 200.0]), np.array([-5.0, 3400.0])
    origin = np.array([3.0, -1.0])
    in_f = turned(0.7, m) + origin
    frames, _ = frames_of(pose, None, (Limits(Point(c), Point(m)),))
    assert np.isclose(frames.length, np.hypot(*(in_f - c)) / 2, rtol=1e-12)
    assert np.allclose(frames.fixed_origin, (in_f + c) / 2, rtol=1e-12)
    pair = Limits(Point(c), Point(m)), Limits(Point([7.0, 8.0]), Line([0, 1], [1, 1]))
    frames, _ = frames_of(pose, None, pair)
    points = np.array([c, in_f, [7.0, 8.0]])
    middle = points.mean(axis=0)
    back = turned(-0.7, middle - origin)
    foot = turned(0.7, [back[0], 1.0]) + origin  # the line y = 1 of M
    gaps = np.linalg.norm(np.array([*points, foot]) - middle, axis=1)
    assert np.isclose(frames.length, np.sqrt((gaps**2).mean()), rtol=1e-12)


def test_a_link_of_three_metres_in_millimetres_is_not_called_endless():
    task = Task.from_rows(
        [(100, 50, 10)],
        angle_unit="deg",
        length_unit="mm",
        limits=(
            Limits(Point([0, 0]), Point([3600, 0]), kinds={"RR"}),
            Limits(Point([0, 500]), Point([3600, 700]), kinds={"RR"}),
        ),
    )
    found = synthesize(task)
    assert len(found.dyads) == 2
    assert "W204" not in {each.code for each in found.warnings}
