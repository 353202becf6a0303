"""What stands out among the poses of a task, before and after a linkage is looked for."""

import json
import math

import numpy as np
import pytest

from burmester import cli, synthesize
from burmester.diagnosis.checks import diagnose, disagreement
from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.io.reading.poses import read_task
from burmester.tasks.motion_task import Task
from tests.oracles.ten_poses import TEN as GOOD


@pytest.fixture
def task(tmp_path):
    """The task in a text."""

    def task(text, **options):
        (tmp_path / "poses.csv").write_text(text)
        return read_task(tmp_path / "poses.csv", **options)

    return task


@pytest.fixture
def check(tmp_path, capsys, monkeypatch):
    """Run `burmester check` on a text."""

    def check(text, *arguments):
        monkeypatch.chdir(tmp_path)
        monkeypatch.setenv("COLUMNS", "80")
        (tmp_path / "poses.csv").write_text(text)
        with pytest.raises(SystemExit) as stop:
            cli.main(["check", "poses.csv", *arguments])
        return stop.value.code, capsys.readouterr().out

    return check


def codes(advice):
    return [each.code for each in advice]


def test_nothing_stands_out_of_sound_poses(task, check):
    found = diagnose(task(GOOD))
    assert found.sound
    assert disagreement(found.task, found.motion) is None
    code, out = check(GOOD)
    assert code == 0
    assert "Nothing stands out. Next: burmester synthesize poses.csv" in out
    assert "3.301 by 2.65" in out
    assert "57.31°" in out  # 101.25 - 43.94
    assert "positions to ±5e-05, angles to ±0.005°" in out
    assert "one linkage at most passes all poses exactly" in out


def test_the_wrong_angle_of_the_print_is_named_before_and_after_solving(task, check):
    wrong = GOOD.replace("52.87", "52.67")
    code, out = check(wrong)
    assert code == 1
    for words in ("warning[W201]: pose 6", "52.67°: 52.87° would agree", "--drop 6"):
        assert words in out
    assert codes(synthesize(task(wrong)).warnings)[0] == "W201"
    assert "W201" not in codes(synthesize(task(wrong, drop=["6"])).warnings)


def test_repeats_are_counted_and_paired(task, check):
    lines = GOOD.splitlines()
    text = "\n".join([*lines, lines[3], lines[1], lines[3]])
    (found,) = diagnose(task(text)).findings
    assert found.code == "W208"
    assert found.message.startswith("only 10 of the 13 poses are different")
    assert found.why == "pose 11 repeats 3, 12 repeats 1 and 13 repeats 3"
    assert check(text)[0] == 1


def test_a_repeat_is_paired_with_the_pose_that_it_repeats(task):
    lines = GOOD.splitlines()
    text = "\n".join([*lines[:3], lines[1], *lines[3:5], lines[4], *lines[5:]])
    (found,) = diagnose(task(text)).findings
    assert found.why == "pose 3 repeats 1 and 6 repeats 5"


def test_exchanged_rows_are_named(task):
    lines = GOOD.splitlines()
    lines[3], lines[7] = lines[7], lines[3]
    found = diagnose(task("\n".join(lines))).findings
    assert codes(found) == ["W202"]
    assert "poses 3 and 7" in found[0].message
    assert "rows 3 and 7" in found[0].help


@pytest.mark.parametrize("far", [1e6, 1e7])
def test_poses_within_reach_of_their_digits_are_sound(task, far):
    rows = [list(map(float, line.split(","))) for line in GOOD.splitlines()[1:]]
    text = "\n".join(["x,y,angle_deg", *(f"{x + far:.6f},{y},{a}" for x, y, a in rows)])
    assert diagnose(task(text)).findings == ()


def test_digits_lost_far_from_the_origin_are_counted(task):
    rows = [list(map(float, line.split(","))) for line in GOOD.splitlines()[1:]]
    text = "\n".join(["x,y,angle_deg", *(f"{x + 4.23e9:.6f},{y},{a}" for x, y, a in rows)])
    (found,) = diagnose(task(text)).findings
    assert found.code == "W211"
    assert "1e9 times their own size" in found.message  # the span is 4.23
    assert found.why.startswith("9 of a double's 16 digits go into that distance")
    # Neighbouring doubles there are 4.8e-7 apart.
    told = float(found.why.split()[-1])
    assert 4.8e-7 < told < 20 * 4.8e-7


def test_special_motions_are_told_with_what_to_do(check):
    code, out = check("x,y,angle_deg\n0,0,30\n1,2,30\n3,1,30\n4,6,30\n")
    assert code == 1
    assert "translation along a curve" in out
    assert "result[R314]" in out
    assert "help:" in out


def test_the_object_holds_the_poses_as_they_are_read(check):
    code, out = check(GOOD, "--json")
    data = json.loads(out)
    assert code == 0
    assert data["schema"] == "burmester.check/1"
    wanted = [list(map(float, line.split(","))) for line in GOOD.splitlines()[1:]]
    assert [list(pose.values()) for pose in data["task"]["poses"]] == wanted
    assert data["motion"]["nullity"] == 2
    values = data["singular_values"]
    assert values == sorted(values)
    assert values[1] < 1e-3 < values[2]
    assert data["warnings"] == []


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ((1e61, 0, 0), "the lengths of pose 2 are too large"),
        ((0, -1e61, 0), "the lengths of pose 2 are too large"),
        ((0, 0, 1e12), "the angle of pose 2 is too large"),
    ],
)
def test_numbers_that_cannot_be_computed_with_are_refused(row, words):
    with pytest.raises(InputError, match=words) as caught:
        Task.from_rows([(0, 0, 0), row, (1, 1, 50)], angle_unit="deg")
    assert caught.value.code == "E112"


def test_a_pose_that_is_lost_beside_another_is_refused():
    poses = Displacement(np.array([[0.0, 0.0], [1, 0], [1, 1]]), np.array([0.0, 0.5, 1]))
    assert Task(poses, weights=np.array([1e-6, 1, 9e5])).weights is not None
    with pytest.raises(InputError, match="too far apart") as caught:
        Task(poses, weights=np.array([1e-6, 1, 1e7]))
    assert caught.value.code == "E112"
    assert "the greatest is 1e+07, the least 1e-06" in caught.value.why


def test_lengths_that_vanish_are_refused():
    with pytest.raises(InputError, match="too small"):
        Task.from_rows([(0, 0, 0), (1e-61, 0, 20), (0, 2e-61, 50)], angle_unit="deg")
    at_one_place = Task.from_rows([(0, 0, 0), (0, 0, 20), (0, 0, 50)], angle_unit="deg")
    assert synthesize(at_one_place).outcome.code == "R315"


@pytest.mark.parametrize("size", [1e-55, 1e55])
def test_the_answer_at_the_edges_of_what_is_taken_is_the_same(size):
    rows = np.array([list(map(float, line.split(","))) for line in GOOD.splitlines()[1:]])
    usual = synthesize(Task.from_rows(rows, angle_unit="deg"))
    scaled = synthesize(Task.from_rows(rows * [size, size, 1], angle_unit="deg"))
    assert scaled.outcome.message == usual.outcome.message
    ratio = scaled.linkages[0].error.worst / usual.linkages[0].error.worst
    assert math.isclose(ratio, size, rel_tol=1e-3)


def test_names_cannot_command_the_terminal(check):
    text = "x,y,angle_deg,name\n0,0,0,\x1b[31mred\n1,2,20,b\n3,1,70,c\n0,4,80,d\n2,2,5,e\n"
    _, out = check(text)
    assert "red" in out
    assert "\x1b" not in out
