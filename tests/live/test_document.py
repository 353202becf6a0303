"""A task as the page holds it is the task of the file, and goes back into a file that is read."""

import json
import math

import numpy as np
import pytest

from burmester import InputError, read_task
from burmester.io import cases, templates
from burmester.io.reading.functions.function_file import read_function
from burmester.io.result import task_data
from burmester.live.document import (
    TaskReader,
    document_of,
    function_of,
    options_of,
    read_document,
    task_file,
    task_of,
)

FUNCTIONS = [name for name in templates.names() if "\n[function]" in templates.text(name)]
PLACES = [f"{name}.toml" for name in templates.names() if name not in FUNCTIONS]
NAMES = [*PLACES, *(f"case:{name}" for name in cases.names())]


def given(name):
    data = templates.text(name.removesuffix(".toml")).encode() if name.endswith("toml") else None
    return read_task(name, data=data)


def same(one, other):
    """Whether two tasks say the same, to the last digit but that of a standard deviation."""
    a, b = task_data(one), task_data(other)
    sigmas = a.pop("pose_sigma"), b.pop("pose_sigma")
    assert a == b
    for key in ("position", "angle_deg"):
        assert math.isclose(sigmas[0][key], sigmas[1][key], rel_tol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_a_document_is_the_task(name, tmp_path):
    task = given(name)
    document = document_of(task)
    assert document["angle_unit"] == "deg"
    assert all({"x", "y"} <= set(pose) for pose in document["poses"])
    again = json.loads(json.dumps(document))
    same(task, task_of(again))
    assert document_of(task_of(again)) == document
    file = tmp_path / "task.toml"
    file.write_text(task_file(document), encoding="utf-8")
    same(task, read_task(file))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_document_is_the_function(name):
    data = templates.text(name).encode()
    document, _ = read_document(f"{name}.toml", data)
    task = read_function(data, f"{name}.toml")
    text = json.loads(json.dumps(document))
    if x := text["function"].get("x"):
        text["function"]["x"] = f"{x[0]}:3*{x[1]}/3"
    for again in (function_of(text), read_function(task_file(document).encode(), "a.toml")):
        assert again.inputs == pytest.approx(task.inputs, abs=1e-12)
        assert again.outputs == pytest.approx(task.outputs, abs=1e-12)
        assert (again.ground, again.minimax) == (task.ground, task.minimax)


STATED = """{"length_unit": "mm", "angle_unit": "rad", "note": "not kept",
 "poses": [{"x": 1.50, "y": 2, "angle": 0, "name": "a \\" \\\\ b", "weight": 2},
           {"x": 10, "y": 20.25, "angle": 0.5, "exact": true},
           {"x": 30, "y": 5, "angle": 1.25}],
 "limits": {"fixed_pivot": {"point": [1, 2]}, "length": {"least": 3}},
 "keep_out": [{"name": "wall", "box": [[100, 100], [120, 130]]}],
 "surroundings": {"margin": 0.5},
 "body": [[0, 0], [10, 0], [10, 5]],
 "requirements": {"footprint": {"box": [[-100, -100], [100, 100]]}, "types": ["grashof"]}}"""
FREE = """{"angle_unit": "deg", "tolerance": {"x": 0.1, "y": 0.2, "angle_deg": 1},
 "poses": [{"x": 0, "y": 0, "angle": 10}, {"x": 1, "angle": 20, "free": ["y"]},
           {"x": 2, "y": 2, "angle": 50, "exact": true},
           {"x": 3, "y": 2, "angle": 80, "tolerance": {"x": 0, "y": "free", "axes": "body"}}]}"""
TRACKED = """{"angle_unit": "deg", "poses": [{"p": [0, 0], "q": [10, 0]}, {"p": [1, 1.25],
 "q": [9.5, 6.25]}, {"p": [3, 2], "q": [3, 12]}]}"""


@pytest.mark.parametrize("text", [STATED, FREE, TRACKED], ids=["stated", "free", "tracked"])
def test_every_key_of_a_task_comes_back(text, tmp_path):
    task = read_task("task.json", data=text.encode())
    document = document_of(task)
    same(task, task_of(document))
    file = tmp_path / "task.toml"
    file.write_text(task_file(document), encoding="utf-8")
    same(task, read_task(file))


def test_angles_are_degrees_and_numbers_are_plain():
    document = document_of(read_task("task.json", data=STATED.encode()))
    first, second, third = document["poses"]
    assert first == {"x": 1.5, "y": 2, "angle": 0, "name": 'a " \\ b', "weight": 2}
    assert second["angle"] == pytest.approx(28.6478897565412, abs=1e-12)
    assert second["exact"] is True
    assert third["angle"] == pytest.approx(71.6197243913529, abs=1e-12)
    assert document["keep_out"] == [{"name": "wall", "box": [[100, 100], [120, 130]]}]
    assert document["limits"][0]["fixed_pivot"] == {"point": [1, 2]}
    assert document["requirements"]["footprint"] == {"box": [[-100, -100], [100, 100]]}


def test_digits_that_numbers_cannot_keep_are_kept_as_what_they_mean():
    """120.00 is known to half a hundredth; 120 is not."""
    rows = b"x,y,angle_deg\n120.00,30.00,5.0\n130.00,310.00,9.0\n140.00,360.00,15.0\n"
    task = read_task("poses.csv", data=rows)
    document = document_of(task)
    assert document["pose_sigma"]["position"] == pytest.approx(0.005 / math.sqrt(3))
    assert np.allclose(task_of(document).resolution, task.resolution, rtol=1e-12)


@pytest.mark.parametrize(
    "more",
    [
        {"body": "lid.svg"},
        {"body": {"file": "/drawings/lid.dxf"}},
        {"keep_out": [{"file": "../wall.svg", "id": "wall"}]},
    ],
)
def test_a_document_names_no_file_of_this_machine(more, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lid.svg").write_text('<svg><path d="M0 0h10v10z"/></svg>', encoding="utf-8")
    poses = [{"x": 0, "y": 0, "angle": 0}, {"x": 1, "y": 2, "angle": 30}]
    with pytest.raises(InputError) as refused:
        task_of({"length_unit": "mm", "angle_unit": "deg", "poses": poses, **more})
    assert refused.value.code == "E170"
    assert "names no files of this machine" in refused.value.why
    assert "<page>" not in refused.value.where


def test_a_message_shows_the_line_that_it_is_about():
    poses = [{"x": 0, "y": 0, "angle": 0}, {"x": "1,5", "y": 2, "angle": 30}]
    with pytest.raises(InputError) as refused:
        task_of({"angle_unit": "deg", "poses": poses})
    assert refused.value.message == "poses[1].x is '1,5', not a number"
    assert '"x": "1,5"' in refused.value.where


@pytest.mark.parametrize("name", ["chest-lid.toml", "lid-hinge.toml", "sprung-lid.toml"])
def test_a_document_of_which_the_poses_move_is_read_as_any_other(name):
    reader, document = TaskReader(), document_of(given(name))
    for step in range(3):
        document["poses"][1]["x"] += 0.1234 * step
        same(reader.task_of(document), task_of(document))
    document["requirements"] = {"transmission_deg": 12.5}
    same(reader.task_of(document), task_of(document))
    document["poses"][1]["x"] = "a"
    with pytest.raises(InputError) as quick:
        reader.task_of(document)
    with pytest.raises(InputError) as slow:
        task_of(document)
    assert str(quick.value) == str(slow.value)


def test_options_are_those_of_the_command():
    options = options_of({"method": "complete", "norm": "worst", "angle-weight": 12.5})
    assert (options.method, options.norm, options.length_per_radian) == ("complete", "worst", 12.5)
    given = {"raw": True, "certify": True, "stock": "40,60.5", "round": 0.5}
    options = options_of(given)
    assert (options.normalise, options.certify) == (False, True)
    assert (options.stock_lengths, options.rounding_step) == ((40, 60.5), 0.5)
    wrong = [{"certify": 1}, {"stock": "1,a"}, {"angle-weight": "x"}, [1], {"norm": []}]
    for each in ({"method": "best"}, *wrong):
        with pytest.raises(InputError):
            options_of(each)
