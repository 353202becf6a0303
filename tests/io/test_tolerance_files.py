"""Tolerances of poses in files and options: columns, keys, blanks that mean free, round trips."""

import json
import math
import re

import numpy as np
import pytest
from click.testing import CliRunner

from burmester.cli.check import check
from burmester.errors import InputError
from burmester.io.reading.poses import read_task
from burmester.io.reading.specification_text import pose_tolerance
from burmester.io.result import task_data
from burmester.tasks.motion_task import Task
from burmester.tasks.pose_tolerances import PoseTolerances

INF = math.inf
HEAD = "x,y,angle_deg"


def read(tmp_path, text, name="poses.csv", **how):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return read_task(path, **how)


def refused(tmp_path, text, name="poses.csv", **how):
    with pytest.raises(InputError) as caught:
        read(tmp_path, text, name, **how)
    return caught.value


def told(task):
    """Position, angle in degrees and tolerances of a task, as lists."""
    bounds = task.tolerances.bounds * [1, 1, 180 / math.pi]
    angles = np.degrees(task.poses.angle)
    return task.poses.translation.tolist(), angles.tolist(), bounds.round(9).tolist()


def test_columns_of_tolerances(tmp_path):
    task = read(
        tmp_path,
        "x_mm;y_mm;Winkel °;tol_x;Toleranz y [mm];tol_angle_rad;tol_axes\n"
        "0;0;0;0,5;1;0,01;body\n4;;30;1;;0,02;\n8;3;;0;free;;F\n9;5;70;1,5;1;0;M\n",
    )
    assert task.tolerances.axes == ("body", "fixed", "fixed", "body")
    positions, angles, _ = told(task)
    assert positions == [[0, 0], [4, 1.5], [8, 3], [9, 5]]
    assert angles == pytest.approx([0, 30, 50, 70])
    expected = [[0.5, 1, 0.01], [1, INF, 0.02], [0, INF, INF], [1.5, 1, 0]]
    assert task.tolerances.bounds.tolist() == expected


def test_the_column_free_names_components(tmp_path):
    rows = ["0,0,0,", '1,,,"y, angle"', "2,2,20,angle", "3,3,40,x y"]
    task = read(tmp_path, "\n".join([f"{HEAD},free", *rows]), tolerance=pose_tolerance("1,2,3"))
    positions, angles, bounds = told(task)
    assert positions == [[0, 0], [1, 1], [2, 2], [3, 3]]
    assert angles == pytest.approx([0, 10, 20, 40])
    assert bounds == [[1, 2, 3], [1, INF, INF], [1, 2, INF], [INF, INF, 3]]


TOML = """
angle_unit = "deg"
tolerance = { x = 0.1, y = 0.2, angle = 1 }
poses = [
  { x = 0, y = 0, angle = 0, exact = true },
  { x = 3, y = 1, free = ["angle"] },
  { x = 4, y = 3, angle = 70, tolerance = { x = 0.5, axes = "body" } },
  { y = 3, angle = 90, tolerance = { x = "free", angle_rad = 0.5 } },
  [5, 5, 100],
]
"""


def test_keys_of_tolerances(tmp_path):
    task = read(tmp_path, TOML, "poses.toml")
    assert told(task)[2] == [
        [0, 0, 0],
        [0.1, 0.2, INF],
        [0.5, 0.2, 1],
        [INF, 0.2, round(math.degrees(0.5), 9)],
        [0.1, 0.2, 1],
    ]
    assert task.tolerances.axes == ("fixed", "fixed", "body", "fixed", "fixed")
    assert told(task)[0][3] == [4.5, 3]


@pytest.mark.parametrize("seed", range(6))
def test_a_task_is_read_back_as_it_was_written(tmp_path, seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(3, 8))
    bounds = rng.choice([1.0, 0.3, 0.017, 45.58, INF], size=(count, 3))
    bounds[rng.integers(count)] = 0
    bounds[np.isinf(bounds).all(axis=1), 0] = 0.5
    axes = np.where(np.isinf(bounds[:, 2]), "fixed", rng.choice(["fixed", "body"], size=count))
    tolerances = PoseTolerances(bounds[:, :2], np.radians(bounds[:, 2]), tuple(axes.tolist()))
    rows = rng.normal(size=(count, 3)) * [1, 1, 30]
    task = Task.from_rows(rows, angle_unit="deg", tolerances=tolerances)
    again = read(tmp_path, json.dumps(task_data(task)), "poses.json")
    assert again.tolerances.bounds.tolist() == task.tolerances.bounds.tolist()
    assert again.tolerances.axes == task.tolerances.axes
    assert again.poses.translation.tolist() == task.poses.translation.tolist()


REFUSED = {  # a file, its name, the code, and what is said
    "blank, and nothing allows it": (f"{HEAD}\n0,0,0\n1,,4", "a.csv", "E104", "empty cell"),
    "blank, and free names another": (
        f"{HEAD},free\n0,0,0,\n1,,4,x\n",
        "a.csv",
        "E104",
        "row 2 has no y, and its cell of free does not name it",
    ),
    "a blank tolerance": (
        f"{HEAD},tol_x\n0,0,0,1\n1,1,4,\n",
        "a.csv",
        "E135",
        "pose 2: the tolerance of x is blank",
    ),
    "free, and a tolerance": (
        f"{HEAD},tol_x,free\n0,0,0,1,\n1,1,4,2,x\n",
        "a.csv",
        "E136",
        "row 2 has x among its free components, and a tolerance of 2",
    ),
    "no number, and a tolerance": (
        f"{HEAD},tol_x\n0,0,0,1\n,1,4,2\n",
        "a.csv",
        "E136",
        "row 2 has no x, and a tolerance of 2",
    ),
    "no component": (f"{HEAD},free\n0,0,0,z\n", "a.csv", "E104", "'z' where free components"),
    "no axes": (f"{HEAD},tol_x,tol_axes\n0,0,0,1,k\n", "a.csv", "E104", "'k' where the axes"),
    "no tolerance": (f"{HEAD},tol_x\n0,0,0,wide\n", "a.csv", "E104", "text where a number"),
    "a unit in the cell": (f"{HEAD},tol_x\n0,0,0,1 cm\n", "a.csv", "E104", "text where a number"),
    "another unit": ("x_mm,y_mm,angle_deg,tol_x_cm\n0,0,0,1\n", "a.csv", "E108", "tol_x in cm"),
    "below zero": (
        f"{HEAD},tol_x,tol_y,tol_angle_deg\n0,0,0,1,1,1\n1,1,9,1,-1,1\n2,2,9,1,1,1",
        "a.csv",
        "E135",
        "pose 2: a tolerance of -1 for y",
    ),
    "free in all": (
        f"{HEAD},free\n0,0,0,\n1,1,4,x y angle\n5,5,5,\n",
        "a.csv",
        "E136",
        "pose 2 is free in x, y and angle",
    ),
    "exact, and a tolerance": (
        TOML.replace("exact = true", "exact = true, tolerance = { y = 0.3 }"),
        "a.toml",
        "E136",
        "pose 1 is marked exact, and its y has a tolerance",
    ),
    "free names what has one": (
        TOML.replace('free = ["angle"]', 'free = ["angle"], tolerance = { angle_deg = 3 }'),
        "a.toml",
        "E136",
        "poses[1].tolerance: a tolerance of 3 for angle, which free names",
    ),
    "two angles": (
        TOML.replace("angle = 1", "angle = 1, angle_rad = 0.1"),
        "a.toml",
        "E108",
        "tolerance has angle and angle_rad",
    ),
    "an unknown key": (TOML.replace("axes =", "axis ="), "a.toml", "E107", "tolerance.axis is not"),
    "an unknown word": (TOML.replace('"body"', "'link'"), "a.toml", "E104", "'link'"),
    "a text": (TOML.replace("x = 0.5", 'x = "0.5"'), "a.toml", "E104", "neither a number nor free"),
    "no list": (TOML.replace('["angle"]', '"angle"'), "a.toml", "E104", "free does not fit"),
    "a component that is not": (TOML.replace('["angle"]', '["phi"]'), "a.toml", "E104", "'phi'"),
    "missing": (TOML.replace("{ x = 3, ", "{ "), "a.toml", "E105", "poses[1].x is missing"),
    "beside the poses": ('free = ["x"]\n' + TOML, "a.toml", "E107", "free stands beside"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_tolerances_that_are_refused(tmp_path, name):
    text, file, code, said = REFUSED[name]
    error = refused(tmp_path, text, file)
    assert error.code == code
    assert said in error.message
    assert error.help
    assert re.search(rf"{file}(:\d+|$)", error.where)


def test_a_blank_cell_says_how_a_component_is_left_free(tmp_path):
    error = refused(tmp_path, f"{HEAD}\n0,0,0\n1,,4\n2,2,9\n")
    assert "add the column free" in error.help
    fixed = f"{HEAD},free\n0,0,0,\n1,,4,y\n2,2,9,\n"
    assert read(tmp_path, fixed).tolerances.free.tolist()[1] == [False, True, False]


@pytest.mark.parametrize("cell", ["0.5", "free"])
def test_points_with_tolerances_have_no_angle(tmp_path, cell):
    """Also where a cell is no number, so that rows are read cell by cell."""
    task = read(tmp_path, f"x,y,tol_x\n0,0,0.5\n1,0,{cell}\n3,1,1\n")
    assert task.tolerances.free[:, 2].all()
    assert task.tolerances.position[0].tolist() == [0.5, 0]


def test_the_tolerance_of_all_poses_as_an_option():
    given = pose_tolerance("0.1, free,0.5,body")
    assert given.bounds == (0.1, INF, 0.5)
    assert (given.axes, given.angle_unit) == ("body", "deg")
    for text in ("1,2", "1,2,3,4", "1,2,wide", "1,-2,3"):
        with pytest.raises(InputError) as caught:
            pose_tolerance(text)
        assert caught.value.code == "E135"
        assert caught.value.where.startswith("--pose-tolerance")


def test_check_shows_tolerances_and_what_is_free(tmp_path):
    path = tmp_path / "poses.csv"
    path.write_text(f"{HEAD},tol_x,tol_axes\n0,0,0,1,\n,1,4,,body\n2,2,9,3,\n3,4,20,1,\n")
    done = CliRunner().invoke(check, [str(path), "--pose-tolerance", "9,2,0.5"])
    line = next(line for line in done.output.splitlines() if re.match(" *2 ", line))
    assert line.split() == ["2", "free", "1", "4", "free", "2", "0.5", "the", "body"]
    shown = CliRunner().invoke(check, [str(path), "--pose-tolerance", "9,2,1", "--json"])
    pose = json.loads(shown.output)["task"]["poses"][1]
    assert pose["tolerance"] == {"y": 2, "angle_deg": 1, "axes": "body"}
    assert pose["free"] == ["x"]


# Many tables, by a reader of the test's own ----------------------------------------------------

CELLS = ("", "0", "0.5", "2", "free", "inf", "-1", "1e-3", "wide")


def bound(part, cells, usual):
    """The tolerance of one component of a row, or None if it is to be refused."""
    tolerance, named = cells.get(f"tol_{part}", ""), cells.get("free", "").split()
    value = cells["angle_deg" if part == "angle" else part]
    says_free = part in named or tolerance in ("free", "inf")
    unsaid = value == "" and "free" in cells and not says_free
    free = says_free or value == ""
    if unsaid or (free and tolerance not in ("", "free", "inf")):
        return None
    if free:
        return INF
    if tolerance == "":
        return usual if usual is not None or f"tol_{part}" in cells else 0.0
    return None if tolerance == "wide" or float(tolerance) < 0 else float(tolerance)


def expected(rows, columns, default):
    """The bounds of each row, or None for a table to be refused: the rules, written again."""
    tables = [dict(zip(columns, row, strict=True)) for row in rows]
    usual = dict(zip(("x", "y", "angle"), default or (None,) * 3, strict=True))
    out = [[bound(part, cells, usual[part]) for part in usual] for cells in tables]
    named = {word for cells in tables for word in cells.get("free", "").split()}
    lost = any(None in row or all(map(math.isinf, row)) for row in out if None not in row)
    return None if lost or any(None in row for row in out) or "z" in named else out


@pytest.mark.parametrize("seed", range(4))
def test_many_columns_of_tolerances(tmp_path, seed):
    rng = np.random.default_rng(seed)
    taken = 0
    for _ in range(120):
        columns = ["x", "y", "angle_deg"]
        columns += [
            name for name in ("tol_x", "tol_y", "tol_angle", "free") if rng.random() < 0.6
        ] or ["free"]
        likely = [0.2, 0.2, 0.25, 0.15, 0.1, 0.07, 0.005, 0.02, 0.005]
        rows = []
        for k in range(3):
            row = ["" if rng.random() < 0.12 else str(k + 1) for _ in range(3)]
            for name in columns[3:]:
                words = ["", "", "x", "angle", "x y", "z"]
                cell = rng.choice(CELLS, p=likely)
                row.append(str(rng.choice(words) if name == "free" else cell))
            rows.append(row)
        default = (0.25, 0.5, 1.0) if rng.random() < 0.7 else None
        text = "\n".join(map(",".join, [columns, *rows]))
        how = {} if default is None else {"tolerance": pose_tolerance("0.25,0.5,1")}
        given = expected(rows, columns, default)
        if given is None:
            error = refused(tmp_path, text, **how)
            assert error.code in {"E104", "E135", "E136"}, text
            assert error.where, text
            continue
        task = read(tmp_path, text, **how)
        assert told(task)[2] == pytest.approx(np.array(given)), text
        taken += 1
    assert 20 < taken < 100
