"""The JSON schema of task files: what is read passes it, and what is refused does not."""

from __future__ import annotations

import copy
import json
import tomllib
from pathlib import Path

import jsonschema
import pytest
from click.testing import CliRunner
from hypothesis import example, given
from hypothesis import strategies as st

from burmester.cli.new import new
from burmester.errors import InputError
from burmester.io import templates
from burmester.io.reading.functions.function_file import read_function
from burmester.io.reading.poses import read_task
from burmester.io.task_schema import task_schema
from burmester.requirements.table import ASKED
from burmester.tasks.option_table import LIMIT_OPTIONS, TOP_KEYS
from tests.samples import EVERY

ROOT = Path(__file__).parents[2]
SCHEMA = task_schema()
VALIDATOR = jsonschema.Draft7Validator(SCHEMA)
CASES = sorted((ROOT / "src" / "burmester" / "cases").glob("*.json"))
OTHERS = sorted(
    each
    for folder in ("docs", "examples", "tests/io/corpus")
    for each in (ROOT / folder).rglob("*")
    if each.suffix in (".toml", ".json")
)

CORNERS = [[3, 2], [40, 7], [9, 30]]
# Tasks that together have every key.
POSES = {
    "angle_unit": "deg",
    "length_unit": "mm",
    "poses": [
        [0, 0, 0],
        {"x": 1, "y": 2, "angle": 10, "weight": 2, "exact": True, "name": "b"},
        {"x": 2, "y": 3, "angle_deg": 20, "tolerance": {"x": 0.1, "y": "free", "angle_deg": 1}},
        {"y": 4, "angle": 30, "free": ["x"]},
    ],
    "tolerance": {"x": 0.5, "y": 0.5, "angle": 2, "axes": "body"},
    "pose_sigma": {"position": 0.01, "angle_deg": 0.1},
    "limits": [
        {
            "fixed_pivot": {"box": [[0, 0], [40, 30]]},
            "moving_pivot": {"segment": [[0, 0], [4, 3]]},
            "length": {"least": 1, "most": 90},
            "kinds": ["RR"],
        },
        {
            "rail": {
                "direction_deg": 0,
                "tolerance_deg": 2,
                "through": {"point": [20, 10]},
                "travel": {"polygon": CORNERS},
            }
        },
    ],
    "requirements": {
        "transmission_deg": 40,
        "types": ["slider-crank", "Double Slider"],
        "driver": "crank",
        "footprint": {"polygon": CORNERS},
        "link_ratio": 5,
        "within": 0.5,
        "within_deg": 2,
        "any_order": False,
    },
    "body": CORNERS,
    "keep_out": [{"name": "bumper", "box": [[560, -40], [600, 60]]}],
    "surroundings": {"link_width": 8, "margin": 2, "body_in_plane": True},
}
POINTS = {
    "poses": [
        {"px": 0, "py": 0, "qx": 1, "qy": 0},
        {"p": [1, 2], "q": [2, 2], "crank_rad": 0.5},
        {"p": [2, 3], "qx": 2, "qy": 4, "crank_rad": 1.5},
    ],
    "limits": {"slot": {"direction_deg": 0}, "fixed_pivot": {"line": [[2, 3], [9, 7]]}},
    "crank": {"absolute": True, "within_deg": 2},
}
LOADED = {
    "angle_unit": "deg",
    "length_unit": "mm",
    "poses": [[0, 0, 0], [10, 5, 20], [30, 20, 45]],
    "loads": {
        "gravity": "down",
        "body": {"mass_kg": 4, "center": [210, 9], "inertia_kgm2": 0.1},
        "links": {"plate": "steel 3", "width": 20},
        "force": {"at": [1, 2], "force_N": [0, -5], "frame": "M", "from_pose": 1, "to_pose": 2},
        "torque_Nm": 0.5,
        "hand": {"at": [420, 0]},
        "temperature_C": 20,
    },
    "springs": [
        {
            "kind": "gas",
            "ground_point": [20, -150],
            "body_point": [100, 0],
            "force_N": 100,
            "compressed_force_N": 130,
            "stroke": 100,
            "length": 245,
            "friction_N": 2,
            "count": 2,
        },
        {
            "kind": "torsion",
            "from": {"link": "ground", "point": [0, 0]},
            "to": {"link": "driver", "point": [0, 0]},
            "rate_Nm_per_deg": 0.1,
            "free_deg": -5,
        },
    ],
    "drive": {"duration_s": 2, "profile": "3-4-5"},
}
FREE = {"x": 0.5, "y": 0.5}
PATH = {
    "angle_unit": "deg",
    "poses": [{"x": k, "y": k * (20 - k), "free": ["angle"], "tolerance": FREE} for k in range(5)],
    "path": {"closed": True, "crank_deg": [30 * k for k in range(5)]},
}
TASKS = {"poses": POSES, "points": POINTS, "path": PATH, "loads": LOADED}
# Values of other kinds and sizes, put in the place of each that is there.
INSTEAD = (True, "word", "free", -1, 0, 0.5, 90, 1e5, [], [1], [[0, 0], [1, 1]], {}, {"x": 1})
# Codes of what belongs together or is missing, which only reading finds.
TOGETHER = {
    "E105", "E108", "E110", "E111", "E120", "E122", "E132", "E133", "E136", "E137", "E138", "E170",
    "E175", "E177", "E178", "E179", "E186",
}  # fmt: skip


def refused(tree):
    """The code with which a reader refuses a tree, or None."""
    try:
        read_task("task.json", data=json.dumps(tree).encode())
    except InputError as error:
        return error.code
    return None


def places(tree, path=()):
    """The paths of all values in a tree."""
    yield path
    if isinstance(tree, dict | list):
        for key in tree if isinstance(tree, dict) else range(len(tree)):
            yield from places(tree[key], (*path, key))


def changed(tree, path, value):
    """A copy with another value at a path."""
    if not path:
        return value
    out = copy.deepcopy(tree)
    at = out
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = value
    return out


def test_the_schema_is_one():
    jsonschema.Draft7Validator.check_schema(SCHEMA)
    assert set(TOP_KEYS) <= set(SCHEMA["properties"])
    asked = SCHEMA["properties"]["requirements"]["properties"]
    assert [*asked] == [each.name for each in ASKED]
    assert all(asked[each.name]["description"] == each.help for each in ASKED)
    for limits in SCHEMA["properties"]["limits"]["anyOf"]:
        keys = limits.get("properties") or limits["items"]["properties"]
        assert [*keys] == [each.name for each in LIMIT_OPTIONS]


def test_the_command_prints_it():
    assert json.loads(CliRunner().invoke(new, ["--schema"]).stdout) == SCHEMA


@pytest.mark.parametrize("name", ["task", *templates.names()])
def test_every_template_passes(name):
    VALIDATOR.validate(tomllib.loads(templates.text(name)))


@pytest.mark.parametrize("file", CASES, ids=lambda each: each.stem)
def test_every_case_passes(file):
    VALIDATOR.validate(json.loads(file.read_text("utf-8")))


def test_every_task_of_examples_passes():
    read = 0
    for file in OTHERS:
        try:
            read_task(file)
        except InputError:
            continue
        text = file.read_text("utf-8-sig")
        tree = tomllib.loads(text) if file.suffix == ".toml" else json.loads(text)
        VALIDATOR.validate(tree)
        read += 1
    assert read >= 8


@pytest.mark.parametrize("tree", TASKS.values(), ids=TASKS)
def test_what_is_refused_at_a_key_is_refused_by_the_schema(tree):
    assert refused(tree) is None
    VALIDATOR.validate(tree)
    wrong = []
    for number, path in enumerate(places(tree)):
        for value in INSTEAD if EVERY else INSTEAD[number % 3 :: 3]:
            other = changed(tree, path, value)
            code, passes = refused(other), VALIDATOR.is_valid(other)
            blank = code == "E135" and path[-1:] == ("tolerance",)
            if passes != (code is None) and code not in TOGETHER and not blank:
                wrong.append((path, value, code))
    assert wrong == []


@pytest.mark.parametrize("tree", TASKS.values(), ids=TASKS)
def test_keys_that_are_not_known_are_refused(tree):
    for path in places(tree):
        at = tree
        for key in path:
            at = at[key]
        if path and isinstance(at, dict):
            other = changed(tree, path, at | {"colour": 1})
            assert refused(other) == ("E186" if path in (("crank",), ("path",)) else "E107")
            assert not VALIDATOR.is_valid(other), path


@given(st.sampled_from(TOP_KEYS), st.integers(0, 20), st.sampled_from("aexs_"), st.integers(0, 2))
@example("limits", 0, "L", 1)
def test_keys_at_the_top_may_be_others_but_not_misspelt(key, at, letter, less):
    at %= len(key)
    misspelt = key[:at] + letter * (less < 2) + key[at + (less > 0) :]
    other = POSES | {misspelt: "x"}
    if misspelt in TOP_KEYS:
        return
    code = refused(other)
    assert code == "E107"
    assert not VALIDATOR.is_valid(other)
    for each in ("title", "author", "notes", "$schema"):
        VALIDATOR.validate(POSES | {each: "x"})


@pytest.mark.parametrize(
    ("tree", "path", "value"),
    [
        (POINTS, ("crank", "within_deg"), 0),
        (POSES, ("limits", 1, "rail", "tolerance_deg"), -1),
        (POSES, ("limits", 1, "rail", "tolerance_deg"), 90),
        (POSES, ("limits", 1, "rail", "through"), {"line": [[0, 0], [1, 0]]}),
        (POSES, ("limits", 1, "rail", "travel"), {"point": [0, 0]}),
        (POSES, ("keep_out", 0, "polygon"), CORNERS),
        (LOADED, ("loads", "gravity"), "up"),
        (LOADED, ("loads", "body", "mass_kg"), -1),
        (LOADED, ("loads", "links", "width"), 0),
        (LOADED, ("loads", "links", "plate"), "lead 3"),
        (LOADED, ("loads", "temperature_C"), -300),
        (LOADED, ("loads", "force", "frame"), "G"),
        (LOADED, ("springs", 0, "kind"), "leaf"),
        (LOADED, ("springs", 0, "friction_N"), -1),
        (LOADED, ("drive", "duration_s"), 0),
        (LOADED, ("drive", "profile"), "sine"),
    ],
    ids=str,
)
def test_ranges_under_codes_of_what_belongs_together(tree, path, value):
    other = changed(tree, path, value)
    assert refused(other) in TOGETHER
    assert not VALIDATOR.is_valid(other)


@pytest.mark.parametrize(
    "wrong",
    [
        {"colour": 1},
        {"input_deg": "60"},
        {"x": [1]},
        {"pairs": 2.5},
        {"spacing": "odd"},
        {"opposite": 1},
        {"link_ratio": 0.5},
        {"transmission_deg": 90},
        {"types": ["crank"]},
    ],
    ids=str,
)
def test_faults_of_a_function(wrong):
    function = {"expression": "log10(x)", "x": [1, 2], "input_deg": 60, "output_deg": 60}
    VALIDATOR.validate({"function": function})
    data = json.dumps({"function": function | wrong}).encode()
    with pytest.raises(InputError):
        read_function(data, "task.json")
    assert not VALIDATOR.is_valid({"function": function | wrong})


def test_keys_in_other_places_are_refused():
    for key in ("link_ratio", "fixed_pivot", "weight", "margin", "unit", "tol", "exact"):
        assert refused(POSES | {key: 1}) == "E107"
        assert not VALIDATOR.is_valid(POSES | {key: 1})
    assert refused(POSES | {"$schema": "task.schema.json"}) is None
