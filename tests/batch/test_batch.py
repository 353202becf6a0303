"""A batch against the command for one task: its rows, from every kind of input, at every depth."""

import json
import os
import subprocess
import sys
from pathlib import Path

import duckdb
import numpy as np
import pandas
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

import burmester
from burmester import InputError
from burmester.batch import long_tables, read_summary, run
from tests.oracles.batches import PARTS, as_file, as_table, files_of, rows

TEN = rows(5)
FIVE = rows(3, poses=5, seed=1)
FOUR = rows(1, poses=4, seed=2)


def burmester_says(*arguments):
    """The JSON that a command prints."""
    command = [sys.executable, "-m", "burmester", *map(str, arguments), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    return json.loads(done.stdout)


def one_by_one(poses, folder, *options):
    """What `burmester synthesize` says of a task."""
    file = folder / "one.csv"
    file.write_text(as_file(poses))
    return burmester_says("synthesize", file, *options)


@pytest.fixture(scope="module")
def mixed(tmp_path_factory):
    """A table of tasks of ten, five and four poses in turn, and their batch at the depth full."""
    folder = tmp_path_factory.mktemp("mixed")
    tasks = [TEN[0], FIVE[0], FOUR[0], TEN[1], FIVE[1]]
    (folder / "tasks.csv").write_text(as_table(tasks, [3, 1, 4, 15, 9]))
    summary = run(folder / "tasks.csv", folder / "out", part_tasks=2, workers=2)
    return folder, tasks, summary


def plain(row):
    """A row of a table without what it does not have."""
    return {key: value for key, value in row.items() if value is not None}


def dyad_columns(data):
    """A dyad of the JSON contract by the columns of a batch."""
    line = data.get("line", {})
    out = {"kind": data["kind"], "rms": data["rms_error"], "worst": data["max_error"]}
    for name in ("fixed", "moving"):
        if f"{name}_pivot" in data:
            out |= dict(zip((f"{name}_x", f"{name}_y"), data[f"{name}_pivot"], strict=True))
    if line:
        out |= dict(zip(("point_x", "point_y"), line["point"], strict=True))
        out |= {name: line[name] for name in ("direction_deg", "normal_deg", "offset")}
    if "radius" in data:
        out["length"] = data["radius"]
    return out


def without_status(dyads):
    return [{key: value for key, value in plain(each).items() if key != "status"} for each in dyads]


def test_a_row_of_the_depth_full_is_what_synthesize_says(mixed, tmp_path):
    folder, tasks, summary = mixed
    assert (summary.complete, summary.tasks, summary.parts) == (True, 5, 3)
    table = pq.read_table(folder / "out")
    assert table.column("task").to_pylist() == [3, 1, 4, 15, 9]
    assert table.column("poses").to_pylist() == [10, 5, 4, 10, 5]
    for poses, row in zip(tasks, table.to_pylist(), strict=True):
        said = one_by_one(poses, tmp_path)
        assert row["code"] == said["outcome"]["code"]
        assert (row["outcome"] == "solved") == any(each["usable"] for each in said["linkages"])
        assert without_status(row["dyads"]) == list(map(dyad_columns, said["dyads"]))
        assert row["warnings"] == [each["code"] for each in said["warnings"]]
        assert len(row["linkages"]) == len(said["linkages"]) > 0
        for linkage, data in zip(row["linkages"], said["linkages"], strict=True):
            own = data["dyads"][:: -1 if data["driver"] == "second" else 1]
            assert without_status(linkage["dyads"]) == list(map(dyad_columns, own))
            assert linkage["type"] == data["type"]
            assert linkage["worst"] == data["position_error"]["max"]
            assert linkage["angle_rms_deg"] == data["angle_error_deg"]["rms"]
            assert (linkage["verdict"] == "usable") == data["usable"]
            if data["usable"]:
                assert linkage["transmission_deg"] == data["quality"]["transmission_deg"]
                ids = [said["dyads"][linkage[name]]["id"] for name in ("first", "second")]
                assert ids == [each["id"] for each in own]
            elif data["defects"]:
                assert linkage["verdict"] == data["defects"][0]["kind"]


def test_other_programs_read_the_parts(mixed):
    folder, _, summary = mixed
    out = folder / "out"
    table = pq.read_table(out)
    query = f"""select outcome, count(*), sum(len(dyads))
                from '{out}/{PARTS}' group by outcome order by outcome"""
    told = {name: (n, dyads) for name, n, dyads in duckdb.sql(query).fetchall()}
    frame = pandas.read_parquet(out)
    assert frame["task"].tolist() == table.column("task").to_pylist()
    for name, group in frame.groupby("outcome"):
        assert told[name] == (len(group), sum(map(len, group["dyads"])))
    assert {name: n for name, (n, _) in told.items()} == summary.outcomes
    least = f"select min(d.rms) from '{out}/{PARTS}', unnest(dyads) as each(d)"
    ((best,),) = duckdb.sql(least).fetchall()
    assert best == min(d["rms"] for row in table.to_pylist() for d in row["dyads"])
    metadata = pq.read_schema(out / "part-000001.parquet").metadata[b"burmester"]
    assert json.loads(metadata)["schema"] == summary.identity["schema"] == "burmester.batch/1"


def test_the_documented_columns_are_those_of_the_parts(mixed):
    page = (Path(burmester.__file__).parents[2] / "docs" / "batch.md").read_text(encoding="utf-8")
    kinds = pq.read_schema(mixed[0] / "out" / "part-000000.parquet")

    def names(fields):
        for field in fields:
            yield field.name
            kind = field.type.value_type if pa.types.is_list(field.type) else field.type
            if pa.types.is_struct(kind):
                yield from names(kind)

    missing = {name for name in names(kinds) if f"`{name}`" not in page}
    assert missing == set()


def test_dyads_of_stacks_are_those_of_one_task(tmp_path):
    tasks = [TEN[2], FIVE[2], TEN[3]]
    file = tmp_path / "tasks.csv"
    file.write_text(as_table(tasks, ["one", "two", "three"]))
    run(file, tmp_path / "out", depth="dyads", workers=1)
    table = pq.read_table(tmp_path / "out")
    assert table.column("task").to_pylist() == ["one", "two", "three"]
    for poses, row in zip(tasks, table.to_pylist(), strict=True):
        said = one_by_one(poses, tmp_path)
        assert len(row["dyads"]) == len(said["dyads"])
        scale = np.ptp(poses[:, :2])
        for dyad, data in zip(row["dyads"], said["dyads"], strict=True):
            other = dyad_columns(data)
            assert dyad["kind"] == other["kind"]
            for name in ("fixed_x", "moving_y", "point_x", "worst"):
                assert dyad[name] == pytest.approx(other.get(name), abs=1e-7 * scale)
        assert {each["status"] for each in row["dyads"]} <= {"exact", "locally best"}


def test_weights_and_marks_count(tmp_path):
    poses = rows(1, poses=7, seed=8, noise=0.02)[0]
    lines = [f"{x:.6f},{y:.6f},{a:.6f}" for x, y, a in poses]
    more = [f"{1 + 3 * (k == 2)},{'yes' if k in (0, 5) else ''}" for k in range(7)]
    body = [f"{line},{each}" for line, each in zip(lines, more, strict=True)]
    head = "x,y,angle_deg,weight,exact"
    (tmp_path / "one.csv").write_text("\n".join([head, *body, ""]))
    table = [f"task,{head}", *(f"a,{line}" for line in body), *(f"b,{line},1," for line in lines)]
    (tmp_path / "tasks.csv").write_text("\n".join([*table, ""]))
    said = burmester_says("synthesize", tmp_path / "one.csv")
    for depth, within in (("full", 1e-12), ("dyads", 1e-6)):
        run(tmp_path / "tasks.csv", tmp_path / depth, depth=depth, workers=1)
        marked, plainly = pq.read_table(tmp_path / depth).to_pylist()
        assert len(marked["dyads"]) == len(said["dyads"]) > 1
        for dyad, data in zip(marked["dyads"], said["dyads"], strict=True):
            for name, value in dyad_columns(data).items():
                if name != "kind":
                    assert dyad[name] == pytest.approx(value, rel=within, abs=1e-6), name
        assert plainly["dyads"][0]["rms"] != pytest.approx(marked["dyads"][0]["rms"], rel=1e-3)


def as_parquet(folder, tasks):
    """The same table, its columns stored otherwise: names as texts in a dictionary, in radians."""
    table = pyarrow.csv.read_csv(folder / "tasks.csv")
    names = table.column("task").cast(pa.string()).dictionary_encode()
    radians = np.radians(table.column("angle_deg").to_numpy())
    columns = {"y": table.column("y"), "angle_rad": radians, "x": table.column("x"), "task": names}
    path = folder / "tasks.parquet"
    pq.write_table(pa.table(columns), path, row_group_size=7)
    return path


def as_lines(folder, tasks):
    path = folder / "tasks.jsonl"
    lines = [json.dumps({"angle_unit": "deg", "poses": each.round(6).tolist()}) for each in tasks]
    path.write_text("\n\n".join(lines))
    return path


def as_folder(folder, tasks):
    path = folder / "tasks"
    path.mkdir()
    for number, each in enumerate(tasks):
        (path / f"{number}.csv").write_text(as_file(each))
    (path / ".hidden.csv").write_text("no poses")
    (path / "notes.md").write_text("no task")
    return path


@pytest.fixture(scope="module")
def pencils(tmp_path_factory):
    """The pencils of some tasks in a table of CSV."""
    folder = tmp_path_factory.mktemp("pencils")
    (folder / "tasks.csv").write_text(as_table([*TEN[:3], FIVE[0]]))
    run(folder / "tasks.csv", folder / "out", depth="pencil", workers=1)
    return pq.read_table(folder / "out")


@pytest.mark.parametrize("form", [as_parquet, as_lines, as_folder])
def test_every_form_of_input_says_the_same(form, pencils, tmp_path):
    tasks = [*TEN[:3], FIVE[0]]
    (tmp_path / "tasks.csv").write_text(as_table(tasks))
    run(form(tmp_path, tasks), tmp_path / "out", depth="pencil", workers=1, part_tasks=3)
    first, second = pencils, pq.read_table(tmp_path / "out")
    assert first.column("outcome") == second.column("outcome")
    for one, other in zip(first.to_pylist(), second.to_pylist(), strict=True):
        for dyad, same in zip(one["dyads"], other["dyads"], strict=True):
            for name, value in plain(dyad).items():
                if isinstance(value, float):
                    assert same[name] == pytest.approx(value, rel=1e-6, abs=1e-9)
                else:
                    assert same[name] == value
    names = second.column("task").to_pylist()
    wanted = {
        as_parquet: ["0", "1", "2", "3"],
        as_lines: ["1", "3", "5", "7"],
        as_folder: ["0.csv", "1.csv", "2.csv", "3.csv"],
    }
    assert names == wanted[form]


def test_any_number_of_workers_writes_the_same_bytes(tmp_path):
    file = tmp_path / "tasks.csv"
    file.write_text(as_table(rows(12, seed=5)))
    for workers in (1, 2):
        run(file, tmp_path / str(workers), depth="pencil", part_tasks=2, workers=workers)
    first, second = (files_of(tmp_path / name) for name in ("1", "2"))
    assert len(first) == 6 + 3
    assert first == second


def test_tasks_that_cannot_be_computed_with_are_refused_alone(tmp_path):
    lines = [
        {"angle_unit": "deg", "poses": TEN[0].tolist()},
        {"angle_unit": "deg", "poses": [[0, 0, 0], [1, 1, "x"]]},
        {"poses": FIVE[0].tolist(), "angle_unit": "deg", "limits": {"length": {"most": 3}}},
        {"poses": FIVE[0].tolist(), "angle_unit": "rad", "tolerance": {"x": 1}},
    ]
    file = tmp_path / "tasks.jsonl"
    file.write_text("".join(json.dumps(each) + "\n" for each in lines) + "{nonsense\n")
    summary = run(file, tmp_path / "out", depth="pencil", workers=1)
    table = pq.read_table(tmp_path / "out").to_pylist()
    assert [each["outcome"] for each in table] == [
        "solved",
        "refused",
        "not at this depth",
        "not at this depth",
        "refused",
    ]
    assert [each["code"] for each in table] == [None, "E104", None, None, "E109"]
    assert table[2]["reason"] == "limits of a task count at the depth full only"
    assert table[3]["reason"] == "tolerances of a task count at the depth full only"
    assert "line 2" in table[1]["reason"]
    assert all(each["dyads"] == [] for each in table[1:])
    assert summary.outcomes == {"not at this depth": 2, "refused": 2, "solved": 1}


def test_a_number_that_is_missing_refuses_its_task_alone(tmp_path):
    file = tmp_path / "tasks.csv"
    text = as_table(rows(3))
    damaged = text.splitlines()
    damaged[14] = "1,,2.5,30"
    damaged[25] = "2,nan,2.5,30"
    file.write_text("\n".join(damaged) + "\n")
    for depth in ("pencil", "full"):
        run(file, tmp_path / depth, depth=depth, workers=1)
        table = pq.read_table(tmp_path / depth).to_pylist()
        assert [each["outcome"] for each in table] == ["solved", "refused", "refused"], depth
        assert {each["code"] for each in table[1:]} == {"E103"}


def test_options_hold_for_every_task(tmp_path):
    file, options = tmp_path / "tasks.csv", tmp_path / "options.toml"
    file.write_text(as_table(TEN[:1]))
    options.write_text(
        'norm = "worst"\nlength_per_radian = 2.5\nlength_unit = "mm"\n'
        "[limits]\nlength = { most = 4 }\n[requirements]\ntransmission_deg = 20\n"
    )
    run(file, tmp_path / "out", options=options, workers=1)
    (row,) = pq.read_table(tmp_path / "out").to_pylist()
    command = ("--norm", "worst", "--angle-weight", "2.5", "--length", ":4")
    said = one_by_one(TEN[0], tmp_path, *command, "--min-transmission", "20")
    plainly = one_by_one(TEN[0], tmp_path)
    assert without_status(row["dyads"]) == list(map(dyad_columns, said["dyads"]))
    assert [each["worst"] for each in row["linkages"]] == [
        each["position_error"]["max"] for each in said["linkages"]
    ]
    assert said["linkages"] != plainly["linkages"]


@pytest.mark.parametrize(
    ("text", "code", "told"),
    [
        ("norn = 'worst'", "E107", "write norm in its place"),
        ("angle-weight = 2", "E107", "write length_per_radian in its place"),
        ("requirement = { within = 1 }", "E107", "write requirements in its place"),
        ("time_limit = 2", "E107", "delete it; --part-limit ends what never does"),
        ("poses = [[0, 0, 0]]", "E107", "delete them: the tasks have their own"),
        ("norm = 'least'", "E134", "choose 'rms' or 'worst'"),
        ("norm = ", "E109", "write lines such as"),
    ],
)
def test_options_that_make_no_sense_are_refused_at_once(text, code, told, tmp_path):
    (tmp_path / "tasks.csv").write_text(as_table(TEN[:1]))
    (tmp_path / "options.toml").write_text(text)
    with pytest.raises(InputError) as caught:
        run(tmp_path / "tasks.csv", tmp_path / "out", options=tmp_path / "options.toml")
    assert caught.value.code == code
    assert told in caught.value.help
    assert "options.toml" in caught.value.where
    assert not (tmp_path / "out" / "_manifest.json").exists()


def test_options_that_a_depth_takes_no_account_of_are_refused(tmp_path):
    (tmp_path / "tasks.csv").write_text(as_table(TEN[:1]))
    (tmp_path / "options.toml").write_text("pose_sigma = { position = 1, angle_deg = 1 }\n")
    run(tmp_path / "tasks.csv", tmp_path / "a", options=tmp_path / "options.toml", depth="pencil")
    (tmp_path / "options.toml").write_text('prefer = "size"\n')
    with pytest.raises(InputError, match="prefer has no effect at the depth dyads") as caught:
        run(
            tmp_path / "tasks.csv", tmp_path / "b", options=tmp_path / "options.toml", depth="dyads"
        )
    assert caught.value.code == "E108"


def test_points_of_a_table_are_solved_as_files_of_their_own(tmp_path):
    turns = [0, 40, 85, 150, 230]
    paths = [[(0, 0), (3, 1), (4, 4), (1, 6), (-2, 3)], [(1, 0), (3, 1), (4, 5), (1, 6), (-1, 2)]]
    lines = ["task,x,y,crank_deg"]
    for task, points in enumerate(paths):
        lines += [f"{task},{x},{y},{t}" for (x, y), t in zip(points, turns, strict=True)]
    (tmp_path / "tasks.csv").write_text("\n".join([*lines, ""]))
    run(tmp_path / "tasks.csv", tmp_path / "out", workers=1)
    for task, row in enumerate(pq.read_table(tmp_path / "out").to_pylist()):
        own = [line.partition(",")[2] for line in lines if line[0] in f"t{task}"]
        (tmp_path / "one.csv").write_text("\n".join([*own, ""]))
        said = burmester.synthesize(burmester.read_task(tmp_path / "one.csv"))
        assert row["code"] == said.outcome.code
        found = [[plain(d)["length"] for d in each["dyads"]] for each in row["linkages"]]
        assert found
        assert found == [[float(d.dyad.radius) for d in e.dyads] for e in said.linkages]
    run(tmp_path / "tasks.csv", tmp_path / "dyads", workers=1, depth="dyads")
    told = pq.read_table(tmp_path / "dyads").to_pylist()
    assert {each["outcome"] for each in told} == {"not at this depth"}


TABLES = {
    "a misspelt column": ("task,x,y,angle_deg,weigth\n1,0,0,0,1\n", "E107", "write weight"),
    "no task": ("x,y,angle_deg\n0,0,0\n", "E105", "burmester synthesize"),
    "no x": ("task,y,angle_deg\n1,0,0\n", "E105", "angle_deg"),
    "angles and cranks": ("task,x,y,angle_deg,crank_deg\n1,0,0,0,0\n", "E107", "leave one"),
    "two angles": ("task,x,y,angle_deg,angle_rad\n1,0,0,0,0\n", "E108", "leave one"),
    "apart": ("task,x,y,angle_deg\n1,0,0,0\n2,0,0,0\n1,3,0,0\n", "E108", "sort the table"),
    "no number": ("task,x,y,angle_deg\n1,zero,0,0\n", "E101", "write a table"),
    "a number that would become 0": ("task,x,y,angle_deg\n1,0,0,0\n1,3,1e-400,0\n", "E103", "0"),
    "no mark": ("task,x,y,angle_deg,exact\n1,0,0,0,perhaps\n", "E104", "write yes"),
    "no rows": ("task,x,y,angle_deg\n", "E102", ""),
    "nothing": ("", "E102", "line 1"),
}


@pytest.mark.parametrize("name", TABLES)
def test_a_table_that_cannot_be_read_is_refused(name, tmp_path):
    text, code, told = TABLES[name]
    (tmp_path / "tasks.csv").write_text(text)
    with pytest.raises(InputError) as caught:
        run(tmp_path / "tasks.csv", tmp_path / "out", workers=1)
    assert caught.value.code == code
    assert told in (caught.value.help or "")
    assert "tasks.csv" in caught.value.where


def test_the_command_prints_one_object_or_a_table(mixed):
    folder, _, summary = mixed
    told = burmester_says("batch", "--show", folder / "out")
    assert told["outcomes"] == summary.outcomes
    assert (told["complete"], told["tasks"]) == (True, 5)
    command = [sys.executable, "-m", "burmester", "batch", "--show", str(folder / "out")]
    shown = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout
    assert "5 tasks in 3 parts, complete." in shown
    for name, number in summary.outcomes.items():
        assert [*name.split(), str(number), f"{number / 5:.1%}"] in map(
            str.split, shown.splitlines()
        )
    assert read_summary(folder / "out").data == {**summary.data, "notes": []}


def test_pieces_of_a_table_come_together(tmp_path, monkeypatch):
    """A table is read piece by piece; a task may lie in two of them, and in many."""
    tasks = [*rows(7, poses=6), *rows(1, poses=40), *rows(4, poses=5)]
    (tmp_path / "tasks.csv").write_text(as_table(tasks))
    table = pyarrow.csv.read_csv(tmp_path / "tasks.csv")
    pq.write_table(table, tmp_path / "tasks.parquet")
    monkeypatch.setattr(long_tables, "PIECE_ROWS", 5)
    monkeypatch.setattr(long_tables, "PIECE_BYTES", 300)
    for name in ("tasks.csv", "tasks.parquet"):
        for size in (1, 3, 5, 100):
            parts = list(long_tables.table_parts(os.fspath(tmp_path / name), size))
            assert [part.number for part in parts] == list(range(len(parts)))
            assert [len(part.tasks) for part in parts[:-1]] == [size] * (len(parts) - 1)
            names = [each for part in parts for each in part.tasks.names]
            assert names == list(range(12))
            lengths = [n for part in parts for n in part.tasks.counts.tolist()]
            assert lengths == list(map(len, tasks))
            found = np.concatenate([part.tasks.poses for part in parts])
            assert found == pytest.approx(np.concatenate(tasks), abs=1e-6)
            shares = [part.share for part in parts]
            assert shares == sorted(shares)
            assert shares[-1] == 1.0
