"""Many poses: linkages are looked for on a sample, and refined and judged by all."""

import numpy as np
import pytest

from burmester import Linkage, PoseError, Task, synthesize
from burmester.diagnosis.odd_pose import odd_pose
from burmester.linkages import from_dyads
from tests.oracles.measured import CRANK, ROCKER, measured

NOISE = 0.003


def many(rows, **more):
    task = Task.from_rows(rows.tolist(), angle_unit="deg")
    span = np.hypot(*np.ptp(rows[:, :2], axis=0))
    resolution = np.sqrt(3) * NOISE * span, np.sqrt(3) * NOISE
    return Task(task.poses, resolution=resolution, **more)


def squares(error, length):
    return float((error.combined(length) ** 2).sum())


@pytest.fixture(scope="module")
def found():
    return synthesize(many(measured(1500, noise=NOISE)))


def test_the_true_linkage_is_found_again_within_its_uncertainty(found):
    best = min(found.usable, key=lambda each: each.combined_error)
    pairs = zip((best.linkage.first, best.linkage.second), best.uncertainty, strict=True)
    for (dyad, region), true in zip(pairs, (CRANK, ROCKER), strict=True):
        off = np.hypot(*(dyad.fixed_pivot - true.fixed_pivot))
        assert off < 2 * region.fixed.half_width
        assert abs(dyad.radius - true.radius) < 2 * region.length


def test_the_closest_is_refined_by_all_poses(found):
    """The least squares of all poses lie below those of the truth; of a sample's they do not."""
    length, task = found.length_per_radian, found.task
    best = min(found.usable, key=lambda each: each.combined_error)
    true = PoseError.of(Linkage(CRANK, ROCKER), task.poses, length)
    assert squares(best.error, length) < squares(true, length)
    assert squares(true, length) < 1.01 * squares(best.error, length)


def test_the_errors_are_those_of_all_poses(found):
    for each in found.linkages:
        again = PoseError.of(each.linkage, found.task.poses, found.length_per_radian)
        assert each.error.position.shape == (1500,)
        if each.usable and not each.from_search:
            assert each.error.rms == pytest.approx(again.rms, rel=1e-6)


def test_the_answer_says_on_how_many_poses_it_rests(found):
    (said,) = [each for each in found.warnings if each.code == "W220"]
    assert said.message.endswith("of the 1500 poses, and judged at all")
    few = synthesize(Task.from_rows(measured(150).round(5).tolist(), angle_unit="deg"))
    assert "W220" not in [each.code for each in few.warnings]


def test_a_pose_outside_the_sample_is_judged():
    rows = measured(1500, noise=NOISE)
    rows[700, :2] += 2.0
    found = synthesize(many(rows))
    assert not found.usable
    assert all(700 in each.verdict.defects[0].poses for each in found.linkages[:1])
    assert "W201" in [each.code for each in found.warnings]


def test_the_odd_one_of_many_is_named():
    rows = measured(600)
    assert odd_pose(Task.from_rows(rows.tolist(), angle_unit="deg")) is None
    rows[123, 0] += 0.3
    assert odd_pose(Task.from_rows(rows.tolist(), angle_unit="deg")).pose == 123


def test_the_worst_poses_join_the_sample(monkeypatch):
    """The least worst error of all poses is found by a sample; that of the sample is no bound."""
    task = Task.from_rows(measured(120, seed=2).tolist(), angle_unit="deg")

    def least(most, exchanges):
        monkeypatch.setattr(from_dyads, "MAX_POSES_REFINED", most)
        monkeypatch.setattr(from_dyads, "MAX_EXCHANGES", exchanges)
        found = synthesize(task, norm="worst").linkages
        return min(each.combined_error for each in found)

    by_all = least(120, 0)
    assert least(30, 5) < 1.002 * by_all
    assert least(30, 0) > 1.1 * by_all
