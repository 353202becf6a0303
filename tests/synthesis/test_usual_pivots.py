"""Pivots beside the motion come first where they cost little; tasks made by far ones keep them."""

import numpy as np
import pytest
from benchmarks.planted_limits import planted
from benchmarks.speed import by_hand

from burmester.fourbar.dyad import PR, RP, RR
from burmester.io.reading.poses import read_task
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from tests.oracles.hard_tasks import comes_by
from tests.oracles.witness import places

# A tipper, whose nearest sound linkage has a link of 3.2 m for a motion of 0.6 m.
TIPPER = [
    (0, 0, 0), (-120, 90, 0), (-230, 170, 2), (-320, 230, 8), (-400, 260, 20), (-460, 262, 35),
    (-500, 240, 50),
]  # fmt: skip


def far_away(found, rows):
    """How many spans beside the body's places, and from its origin, pivots of a linkage lie."""
    at, out = rows[:, :2], []
    span = float(np.linalg.norm(np.ptp(at, axis=0)))
    for dyad in (found.linkage.first, found.linkage.second):
        if not isinstance(dyad, PR):
            low, high = at.min(axis=0) - dyad.fixed_pivot, dyad.fixed_pivot - at.max(axis=0)
            out.append(np.maximum(low, high).max() / span)
        if not isinstance(dyad, RP):
            out.append(np.abs(dyad.moving_pivot).max() / span)
    return max(out, default=0.0)


def test_a_tipper_gets_pivots_beside_its_motion_and_is_told_so():
    rows = np.array(TIPPER, dtype=float)
    result = synthesize(Task.from_rows(rows, angle_unit="deg", length_unit="mm"))
    first = result.linkages[0]
    assert [far_away(each, rows) < 1.0 + 1e-9 for each in result.linkages[:2]] == [True, False]
    assert first.usable
    assert not first.shortcomings
    assert comes_by(first, np.radians(30) - 1e-6)
    farther = result.linkages[1]
    assert farther.combined_error <= first.combined_error <= 1.5 * farther.combined_error
    assert max(dyad.dyad.radius for dyad in farther.dyads if isinstance(dyad.dyad, RR)) > 3000
    (told,) = (each for each in result.warnings if each.code == "W215")
    assert "fixed pivots within 564 mm" in told.message
    assert "take L2" in told.help


def test_a_linkage_with_far_pivots_comes_first_where_the_poses_are_its_own():
    """Ten poses of a four-bar whose pivots lie spans away from its motion, to seven decimals."""
    pivots = ((90.0, 40.0), (-4.0, -3.0)), ((-30.0, 95.0), (5.0, 2.0))
    made = [RR(c, m, float(np.hypot(*np.subtract(m, c)))) for c, m in pivots]
    start = np.angle(complex(*np.subtract(made[0].moving_pivot, made[0].fixed_pivot)))
    at, angle = places(*made, start + np.linspace(0, 0.05, 10))
    side = int(np.abs(at[:, 0]).argmin())
    rows = np.column_stack([at[side].real, at[side].imag, angle[side]])
    assert abs(at[side][0]) < 1e-9
    result = synthesize(Task.from_rows(np.round(rows, 7), angle_unit="rad"))
    first = result.linkages[0]
    assert far_away(first, rows) > 3
    own = sorted(float(dyad.radius) for dyad in made)
    found = sorted(float(dyad.radius) for dyad in (first.linkage.first, first.linkage.second))
    assert found == pytest.approx(own, rel=1e-2)
    assert not any(each.code == "W215" for each in result.warnings)


@pytest.mark.parametrize("count", [210, 400])
def test_a_long_recording_by_hand_has_an_answer_whatever_joins_the_sample(count, tmp_path):
    """Linkages of the whole recording start the search by a sample; 400 poses hid 8 odd ones."""
    file = tmp_path / "recording.csv"
    file.write_text(by_hand(count))
    task = read_task(file)
    first = synthesize(task).linkages[0]
    assert first.error.places.shape == (count,)
    gap = np.linalg.norm(first.error.places.translation - task.poses.translation, axis=1)
    assert 1 < gap.max() < 60


def test_a_footprint_away_from_the_motion_holds_the_pivots_itself():
    task, _ = planted(0, 233)
    assert task.requirements.footprint is not None
    assert synthesize(task).usable
