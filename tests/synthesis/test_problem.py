"""What travels from a task to its linkages: constructed cases for every rule of `problem`."""

import numpy as np
import pytest

from burmester import Limits, Point, Task, box, read_task, synthesize
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.tasks.motion_kinds import Undetermined
from tests.oracles.five_poses import ROWS as FIVE
from tests.oracles.witness import places


def test_a_heavier_radian_buys_smaller_angle_errors_with_greater_position_errors():
    task = read_task("case:ge2012-approximate")
    light, heavy = (
        min(
            synthesize(task, length_per_radian=length).linkages,
            key=lambda each: (
                (each.error.position**2).sum() + length**2 * (each.error.angle**2).sum()
            ),
        ).error
        for length in (0.2, 20.0)
    )
    assert heavy.angle.max() < 0.7 * light.angle.max()
    assert heavy.position.max() > 1.2 * light.position.max()


def test_defects_name_poses_by_their_numbers_in_the_task_where_some_are_repeated():
    plain = synthesize(FIVE, angle_unit="deg")
    again = synthesize([FIVE[0], FIVE[0], *FIVE[1:]], angle_unit="deg")
    compared = 0
    for one, other in zip(plain, again, strict=True):
        for a, b in zip(one.defects, other.defects, strict=True):
            assert [pose + 1 if pose else 0 for pose in a.poses] == list(b.poses)
            compared += len(a.poses)
    assert compared
    assert (
        "poses 1, 3 and 4 are on one assembly, 5 and 6 on the other"
        in again["L4"].defects[0].message
    )


def test_links_come_from_stock_without_a_step_as_well():
    stock = (5.0, 8.0, 11.0, 16.0)
    result = synthesize(FIVE, angle_unit="deg", stock_lengths=stock)
    for found in result[:3]:
        assert found.error_before_rounding is not None
        for dyad in (found.linkage.first, found.linkage.second):
            assert float(dyad.radius) in stock


def test_five_poses_that_no_dyad_meets_within_a_box_are_met_as_nearly_as_can_be():
    """The exact dyads have their fixed pivots elsewhere: see the first lines."""
    task = Task.from_rows(FIVE, angle_unit="deg")
    room = box((0.0, -4.0), (4.0, 0.0))
    for dyad in synthesize(task).dyads:
        x, y = dyad.dyad.fixed_pivot
        assert not (0 <= x <= 4 and -4 <= y <= 0)
    within = synthesize(
        Task(task.poses, limits=(Limits(fixed_pivot=room, kinds=frozenset({"RR"})),))
    )
    assert within.method == "complete"
    assert within.dyads
    for found in within.dyads:
        x, y = found.dyad.fixed_pivot
        assert -1e-9 <= x <= 4 + 1e-9
        assert -4 - 1e-9 <= y <= 1e-9
        # Its error by hand: pivot distances at the poses, beside its length.
        seen = [pose.act(found.dyad.moving_pivot) for pose in map(task.poses.__getitem__, range(5))]
        off = np.hypot(*(np.array(seen) - found.dyad.fixed_pivot).T) - found.dyad.radius
        assert np.sqrt((off**2).mean()) == pytest.approx(found.rms_error, rel=1e-6)
        assert found.rms_error > 1e-3


def small_motion():
    """Six poses of a four-bar that hardly turns, in hundredths: they determine no pivots."""
    first = RR(np.array([0.0, 0.0]), np.array([-2.0, 0.5]), np.array(3.0))
    second = RR(np.array([8.0, 1.0]), np.array([3.0, 0.0]), np.array(5.0))
    at, angle = places(first, second, np.linspace(1.0, 1.02, 6))
    k = int(np.isfinite(at).all(axis=1).argmax())
    rows = np.column_stack([at[k].real, at[k].imag, angle[k]]).round(2)
    return Displacement(rows[:, :2], rows[:, 2]), first


def test_a_pivot_at_a_point_settles_what_a_small_motion_leaves_open():
    poses, first = small_motion()
    resolution = (0.005, 0.005)
    free = synthesize(Task(poses, resolution=resolution))
    assert isinstance(free.motion.kind, Undetermined)
    for each in free.usable:  # what comes of it is within the digits, and said to be open
        assert each.error.worst <= resolution[0] * np.sqrt(2)
        assert not each.determined
    pinned = Limits(fixed_pivot=Point(first.fixed_pivot), moving_pivot=Point(first.moving_pivot))
    settled = synthesize(Task(poses, resolution=resolution, limits=(pinned, Limits())))
    (link,) = (each.dyad for each in settled.dyads if each.limits == 1)
    assert float(link.radius) == pytest.approx(3.0, abs=0.02)


def test_a_dyad_that_obeys_both_of_two_limits_is_no_warning():
    task = Task(read_task("case:ge2012-exact").poses, limits=(Limits(), Limits()))
    result = synthesize(task)
    kinds = [type(each.dyad).__name__ for each in result.dyads]
    half = len(kinds) // 2
    assert kinds[:half] == kinds[half:]  # each was found for either limit
    assert not [each for each in result.warnings if each.code == "W205"]
    for found in result:
        assert {each.limits for each in found.dyads} == {1, 2}
