"""Poses timed by the crank in files: columns and keys, and back again."""

import json
from dataclasses import replace

import numpy as np
import pytest

from burmester import CrankTiming, InputError, read_result, read_task, synthesize
from burmester.io.result import task_data
from burmester.live.document import document_of

ROWS = "0,0,0,0\n2.4,-1.4,-45,342.3\n3.8,-1.1,9.3,{}\n"


def read(tmp_path, text, name="poses.csv", **options):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return read_task(path, **options)


def degrees(task):
    return np.degrees(task.timing.angles).round(9).tolist()


@pytest.mark.parametrize(
    "name",
    ["crank_deg", "drive_deg", "input_deg", "Kurbelwinkel [°]", "crank angle (deg)", "曲柄角 [度]"],
)
def test_a_column_has_the_angle_of_the_driver(tmp_path, name):
    task = read(tmp_path, f"x,y,angle_deg,{name}\n{ROWS.format(324.8)}")
    assert degrees(task) == [0, 342.3, 324.8]
    assert task.path is None
    assert not task.timing.absolute


def test_a_blank_cell_is_a_pose_that_is_not_timed(tmp_path):
    task = read(tmp_path, f"x,y,angle_deg,crank_deg\n{ROWS.format('')}")
    assert task.timing.timed.tolist() == [0, 1]
    tabs = read(tmp_path, "x\ty\tangle_deg\tcrank_rad\n0\t0\t0\t0\n1\t1\t9\t-0.5\n", "poses.tsv")
    np.testing.assert_allclose(tabs.timing.angles, [0, -0.5])


def test_options_say_how_angles_are_meant(tmp_path):
    text = f"x,y,angle_deg,crank_deg\n{ROWS.format(324.8)}"
    task = read(tmp_path, text, absolute_crank=True, within_crank_deg=0.5)
    assert task.timing.absolute
    assert np.degrees(task.timing.within) == pytest.approx(0.5)
    turned = read(tmp_path, text, convention="clockwise")
    assert degrees(turned) == [0, -342.3, -324.8]
    few = read(tmp_path, text, drop=["2"])
    assert degrees(few) == [0, 324.8]


def test_json_and_toml_have_the_angle_in_the_pose(tmp_path):
    text = """crank = { absolute = true, within_deg = 0.5 }
    poses = [ { x = 0, y = 0, angle_deg = 0, crank_deg = 10 },
              { x = 2.4, y = -1.4, angle_deg = -45 },
              { x = 3.8, y = -1.1, angle_deg = 9.3, crank_deg = 30.25 } ]"""
    task = read(tmp_path, text, "poses.toml")
    assert degrees(task)[::2] == [10, 30.25]
    assert np.isnan(task.timing.angles[1])
    assert task.timing.absolute
    for tree in (task_data(task), document_of(task)):
        again = read(tmp_path, json.dumps(tree), "again.json")
        np.testing.assert_array_equal(again.timing.angles, task.timing.angles)
        assert again.timing.absolute
        assert again.timing.within == task.timing.within


def test_a_result_keeps_its_timing_and_is_judged_again_by_it(tmp_path):
    rows = [(0, 0, 0), (2.393562138, -1.449021839, -45), (3.760708125, -1.10255857, 9.3)]
    result = synthesize(rows, angle_unit="deg", crank=[0, 342.3, 324.8])
    assert "1 driving link turns by these crank angles, and no other" in result.outcome.message
    path = result.save(tmp_path / "result.json")
    data = json.loads(path.read_text())
    assert [pose["crank_deg"] for pose in data["task"]["poses"]] == [0, 342.3, 324.8]
    assert max(map(abs, data["linkages"][0]["timing_error_deg"])) < 1e-6
    again = read_result(path)
    np.testing.assert_allclose(again.linkages[0].timing_error, 0, atol=1e-8)
    assert again.linkages[0].usable


def test_points_with_their_angles_are_a_timed_path(tmp_path):
    rows = "".join(f"{k},{k * k},{10 * k}\n" for k in range(6))
    task = read(tmp_path, f"x,y,drive_deg\n{rows}")
    assert task.timing is None
    np.testing.assert_allclose(np.degrees(task.path.crank_angles), range(0, 60, 10))
    poses = [{"x": k, "y": k * k, "free": ["angle"], "crank_deg": 10 * k} for k in range(6)]
    task = read(
        tmp_path, json.dumps({"tolerance": {"x": 0, "y": 0}, "poses": poses}), "points.json"
    )
    np.testing.assert_allclose(np.degrees(task.path.crank_angles), range(0, 60, 10))


@pytest.mark.parametrize(
    ("text", "name", "code"),
    [
        ("x,y,angle_deg,crank_deg\n0,0,0,0\n1,1,9,a\n", "p.csv", "E104"),
        ("x,y,angle_deg,crank_deg\n0,0,0,\n1,1,9,4\n", "p.csv", "E186"),
        ("x,y,angle_deg,crank_deg\n0,0,0,4\n1,1,9,4\n", "p.csv", "E186"),
        ("x,y,px,py,qx,qy,crank\n0,0,0,0,0,0,4\n", "p.csv", "E108"),
        ("px,py,qx,qy,crank\n0,0,1,0,4\n1,0,2,0,9\n", "p.csv", "E186"),
        ('{"poses": [{"x": 0, "y": 0, "angle_deg": 0, "crank_deg": "a"}]}', "p.json", "E104"),
        ('{"crank": {"absolut": true}, "poses": [[0, 0, 0], [1, 1, 1]]}', "p.json", "E186"),
        ('{"crank": {"within_deg": -1}, "poses": [[0, 0, 0], [1, 1, 1]]}', "p.json", "E186"),
        (
            '{"crank": {"absolute": true}, "angle_unit": "deg", "poses": [[0, 0, 0], [1, 1, 1]]}',
            "p.json",
            "E186",
        ),
        (
            '{"poses": [{"x": 0, "y": 0, "angle_deg": 0, "crank_deg": 1}, '
            '{"x": 1, "y": 0, "angle_deg": 3, "crank_rad": 1}]}',
            "p.json",
            "E108",
        ),
    ],
)
def test_what_is_wrong_is_said(tmp_path, text, name, code):
    with pytest.raises(InputError) as caught:
        read(tmp_path, text, name)
    assert caught.value.code == code
    assert str(tmp_path) in caught.value.where or name in caught.value.where


def test_arguments_of_python():
    rows = [(0, 0, 0), (1, 2, 0.5), (3, 1, 1)]
    with pytest.raises(InputError, match="crank angles of 2 poses"):
        synthesize(rows, angle_unit="rad", crank=[0, 1])
    task = replace(read_task("case:ge2012-exact"), timing=CrankTiming(np.arange(10.0)))
    with pytest.raises(InputError, match="crank angles already"):
        synthesize(task, crank=np.arange(10.0))
