"""Whole files in another convention: told, and the reading gives the planted linkage."""

import numpy as np
import pytest
from benchmarks.conventions import CLEAN, CONVENTIONS, counted_clean, counted_wrong

from burmester import Task, read_task
from burmester.diagnosis.conventions import other_convention
from burmester.dyads.local_minima import best_dyads
from burmester.tasks.motion_class import classify_motion
from tests.oracles.conventions import GROUND, crank_rocker, table, written
from tests.samples import samples

RIGHT = np.array(crank_rocker())


def found(rows, **further):
    task = Task.from_rows(rows, angle_unit="deg", **further)
    return other_convention(task, classify_motion(task))


def fixed_pivots(task):
    """Those of the two best dyads, that nearer to the origin first."""
    best = best_dyads(task.poses).dyads[:2]
    return sorted(best.fixed_pivot.tolist(), key=lambda pivot: np.hypot(*pivot))


@pytest.mark.parametrize(
    ("how", "unit"),
    [("clockwise", ()), ("y-down", ()), ("swap-xy", ()), ("swap-xy", ("radians",))],
)
def test_told_and_each_reading_that_is_offered_gives_the_linkage_or_its_mirror_image(
    how, unit, tmp_path
):
    rows = written(crank_rocker(), how, *unit)
    said = found(rows)
    assert said.names == ("clockwise", *unit)
    assert said.error < said.error_as_read / 100
    file = tmp_path / "poses.csv"
    file.write_text(table(rows))
    for name in ("clockwise", "y-down", "swap-xy"):
        option = ",".join((name, *unit))
        assert f"--convention {option}" in said.help
        task = read_task(file, convention=option)
        near, far = fixed_pivots(task)
        assert np.allclose(near, 0, atol=0.02)
        assert np.hypot(*far) == pytest.approx(abs(GROUND), abs=0.02)
        assert other_convention(task, classify_motion(task)) is None
        if name == how:
            assert np.allclose(far, [GROUND.real, GROUND.imag], atol=0.02)


def test_radians_under_a_name_for_degrees(tmp_path):
    said = found(written(crank_rocker(), "radians"))
    assert said.names == ("radians",)
    file = tmp_path / "poses.csv"
    file.write_text(table(written(crank_rocker(), "radians")))
    assert np.allclose(fixed_pivots(read_task(file, convention="radians"))[1], [100, 20], atol=0.02)


def test_degrees_under_a_name_for_radians():
    said = found(written(crank_rocker(), "degrees"))
    assert said.names == ("degrees",)


@pytest.mark.parametrize("how", [(), ("clockwise", "y-down"), ("clockwise", "swap-xy")])
def test_nothing_is_told_of_a_right_file_or_of_its_mirror_image(how):
    assert found(written(crank_rocker(), *how)) is None


def test_a_motion_that_fits_in_both_readings_is_passed_over():
    """A body on a crank that counts backwards is one of an ellipse's trammel."""
    turn = np.arange(10) * 0.3
    rows = np.column_stack([50 * np.cos(turn), 50 * np.sin(turn), -np.degrees(turn)])
    assert found(rows) is None


def test_few_poses_determine_nothing():
    rows = written(crank_rocker(), "clockwise")
    assert found(rows[:6]) is None
    assert found(rows[:9]) is not None


def test_what_the_digits_explain_is_no_convention():
    """Told of exact numbers, and not if they are known to a millimetre only."""
    rows = np.array(written(crank_rocker(), "clockwise")) * [1, 1, np.pi / 180]
    task = Task.from_rows(rows, angle_unit="rad")
    assert other_convention(task, classify_motion(task)) is not None
    coarse = Task(task.poses, resolution=(1.0, np.radians(1.0)))
    assert other_convention(coarse, classify_motion(coarse)) is None


def test_repeats_and_weights():
    """Repeats count once, with all their weight."""
    rows = np.array(written(crank_rocker(), "clockwise"))
    again = np.concatenate([rows, rows[:3]])
    task = Task.from_rows(again, angle_unit="deg")
    task = Task(task.poses, weights=np.linspace(1, 2, len(again)))
    assert other_convention(task, classify_motion(task)).names == ("clockwise",)
    few = Task(task.poses[np.array([0, 1, 2, 3, 4, 5, 0, 1, 2])])
    assert other_convention(few, classify_motion(few)) is None


def test_a_sample_of_the_campaign():
    number = len(samples(222, 1)) * len(CLEAN)
    every, wrongly = counted_clean(number, 3)
    assert every.total() == number
    assert wrongly.total() <= 0.005 * number
    number = len(samples(66, 1)) * len(CONVENTIONS)
    every, right, others = counted_wrong(number, 3)
    assert right.total() >= 0.95 * every.total() - 1
    assert others.total() == 0
