"""Points and paths in a long table against the same tasks in a folder."""

import math

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from burmester.batch import run

MIXED = """0.973329,1.841643,51.84518
1.013217,2.219586,38.83281
0.643693,2.389129,
0.092623,2.243994,29.85902
-0.450987,1.760176,
-0.716342,1.141258,44.56691"""
CLOSED = [(3.1, 0.2), (0.9, 1.1), (-2.4, 0.6), (-2.5, -0.6), (0.9, -1.2), (3.1, 0.2)]
TASKS = {
    "a path": "\n".join(f"{x},{y}," for x, y in CLOSED),
    "mixed": MIXED,
    "one point": "1,2,",
    "poses": "-60,21,5\n-42,51,18\n-10,74,33\n26,82,47\n58,75,61",
    "standing still": "4,1,\n4,1,\n4,1,",
    "too many": f"{MIXED}\n5,5,9",
    "without x": "0,0,5\n,3,\n21,4,-13",
}


def rows_of(tasks, out, **how):
    run(tasks, out, workers=1, **how)
    rows = pq.read_table(out).to_pylist()
    for row in rows:
        row["task"] = row["task"].removesuffix(".csv")
        row["reason"] = row["reason"] and row["reason"].partition(" (")[0]  # where it stands
    return {row["task"]: row for row in rows}


def cells():
    return [(name, *row.split(",")) for name, text in TASKS.items() for row in text.splitlines()]


def as_csv(folder):
    path = folder / "tasks.csv"
    path.write_text("\n".join(["task,x,y,angle_deg", *map(",".join, cells()), ""]))
    return path


def as_parquet(folder):
    """Angles that are missing are nan in the first half of the table, and null in the other."""
    names, *columns = zip(*cells(), strict=True)
    x, y, angles = [[float(cell) if cell else None for cell in column] for column in columns]
    half = len(angles) // 2
    angles[:half] = [math.nan if angle is None else angle for angle in angles[:half]]
    path = folder / "tasks.parquet"
    table = {"task": names, "x": x, "y": y, "angle_deg": pa.array(angles, pa.float64())}
    pq.write_table(pa.table(table), path)
    return path


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The tasks as files of their own: a path has x and y alone."""
    folder = tmp_path_factory.mktemp("folder")
    for name, text in TASKS.items():
        (folder / f"{name}.csv").write_text(f"x,y,angle_deg\n{text}\n")
    points = "\n".join(f"{x},{y}" for x, y in CLOSED)
    (folder / "a path.csv").write_text(f"x,y\n{points}\n")
    return folder


@pytest.fixture(scope="module")
def alone(folder, tmp_path_factory):
    return rows_of(folder, tmp_path_factory.mktemp("out"))


@pytest.mark.parametrize("form", [as_csv, as_parquet])
def test_a_missing_angle_is_free_in_a_long_table_too(form, alone, tmp_path):
    told = rows_of(form(tmp_path), tmp_path / "out")
    lacking = told.pop("without x")
    assert (lacking["outcome"], lacking["code"]) == ("refused", "E103")
    assert told == {name: row for name, row in alone.items() if name != "without x"}
    assert {name: row["code"] for name, row in told.items() if row["outcome"] == "refused"} == {
        "one point": "E120",
    }
    assert "W226" in told["too many"]["warnings"]  # met as nearly as possible
    assert told["mixed"]["code"] == "R340"
    assert told["mixed"]["poses"] == 6
    assert sum(each["verdict"] == "usable" for each in told["mixed"]["linkages"]) == 2
    assert told["a path"]["warnings"] == ["W213", "W226"]  # closed, tolerances assumed
    assert told["a path"]["poses"] == len(CLOSED) - 1


def test_points_in_a_table_that_is_solved_in_stacks(folder, tmp_path):
    told = rows_of(as_csv(tmp_path), tmp_path / "table", depth="dyads")
    alone = rows_of(folder, tmp_path / "alone", depth="dyads")
    assert [dyad["kind"] for dyad in told["poses"]["dyads"]] == ["RR"] * len(
        alone["poses"]["dyads"]
    )
    assert told["poses"]["outcome"] == "solved"
    for name in ("a path", "mixed", "standing still"):
        assert told[name]["outcome"] == alone[name]["outcome"] == "not at this depth"
        assert told[name]["reason"] == alone[name]["reason"]
        assert told[name]["reason"] == "points are solved at the depth full"
    assert told["without x"]["code"] == "E103"


def test_a_table_of_x_and_y_alone_is_one_of_paths(alone, tmp_path):
    lines = [f"{name},{x},{y}" for name in ("a path", "again") for x, y in CLOSED]
    (tmp_path / "tasks.csv").write_text("\n".join(["task,x,y", *lines, ""]))
    told = rows_of(tmp_path / "tasks.csv", tmp_path / "out")
    for row in told.values():
        row["task"] = "a path"
        assert row == alone["a path"]


def test_a_column_of_angles_that_holds_nothing(alone, tmp_path):
    x, y = zip(*CLOSED, strict=True)
    table = {"task": ["a path"] * len(x), "x": x, "y": y, "angle_deg": pa.nulls(len(x))}
    pq.write_table(pa.table(table), tmp_path / "tasks.parquet")
    told = rows_of(tmp_path / "tasks.parquet", tmp_path / "out")
    assert told["a path"] == alone["a path"]


def test_messages_name_the_task(tmp_path):
    (tmp_path / "tasks.csv").write_text("task,x,y,angle_deg\n7,0,0,1\n7,,3,\n")
    run(tmp_path / "tasks.csv", tmp_path / "out", workers=1)
    (row,) = pq.read_table(tmp_path / "out").to_pylist()
    where = f"({tmp_path / 'tasks.csv'}, task 7)"
    assert row["reason"] == f"row 2 has a value that is not a finite number {where}"
