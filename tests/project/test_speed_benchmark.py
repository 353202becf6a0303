"""The benchmark of speed measures what it says: its tasks, its turns, its lines."""

import math
import sys

import numpy as np
import pytest
from benchmarks import where_time_goes
from benchmarks.speed import CORNERS, Measured, Row, by_turns, line, notes, rows_in

from burmester.io.reading.poses import read_task


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    return {row.name: row for row in rows_in(tmp_path_factory.mktemp("speed"))}


def poses_of(row):
    return {len(read_task(task).poses.angle) for task in row.tasks}


def test_the_tasks_are_what_their_rows_say(rows):
    assert poses_of(rows["folding-table, five poses"]) == {5}
    assert poses_of(rows["hard tasks"]) == {5, 8}
    assert len(rows["hard tasks"].tasks) == 20
    for number, name in ((2, "two"), (3, "three"), (4, "four")):
        assert poses_of(rows[f"{name} poses with boxes"]) == {number}
    for number in (60, 1000):
        assert poses_of(rows[f"{number:,} poses measured"]) == {number}
        assert poses_of(rows[f"{number:,} poses measured, by hand"]) == {number}
    (task,) = map(read_task, rows["two polygons of 16 corners"].tasks)
    (limits,) = task.limits
    for region in (limits.fixed_pivot, limits.moving_pivot):
        assert len(region.vertices) == CORNERS
    (task,) = map(read_task, rows["exact poses and limits"].tasks)
    assert np.flatnonzero(task.exact).tolist() == [0, 7]
    assert len(task.limits) == 1
    assert [row.name for row in rows.values() if row.alone] == [
        "100,000 poses measured",
        "100,000 poses measured, by hand",
    ]


def test_both_sides_are_measured_by_turns(rows):
    row = rows["folding-table, five poses"]
    before, after = by_turns(row, [sys.executable, sys.executable], 2, 60.0)
    assert before.rounds == after.rounds == 2
    assert 0 < before.seconds < 60
    assert 0.05 < after.seconds / before.seconds < 20
    assert before.last[0]["usable"] == after.last[0]["usable"] == 3
    assert 1 <= before.last[0]["calls"] <= 9
    assert notes(row, [before, after]) == "3 of 6 usable"


def test_a_line_of_the_table():
    assert line("ten poses", 0.03, [0.08, 0.02], "5 usable") == (
        "| ten poses | 30 ms | 80 ms | 20 ms | 0.25 | 5 usable |"
    )
    assert line("many", None, ["E126", 12.5], "") == "| many |  | E126 | 12.5 s |  |  |"
    assert line("alone", 15.0, [12.5], "") == "| alone | 15 s |  | 12.5 s |  |  |"


def test_hard_tasks_tell_what_got_worse():
    row = Row("hard tasks", ("a", "b", "c"), nearer=True)

    def side(*least):
        return [
            {"seconds": 1.0, "usable": math.isfinite(each), "linkages": 2, "least": each}
            for each in least
        ]

    before, after = (Measured(1.0, side(*s), 3) for s in ((1.0, 2.0, math.inf), (1.1, 1.0, 3.0)))
    told = notes(row, [before, after])
    assert "2 and 3 of 3 have one" in told
    assert "squares at worst 1.21 times, at best 0.25" in told
    late = Measured(math.nan, [{"error": "not in 600 s"}], 1)
    assert notes(row, [late, after]) == "3 of 3 have one, slowest 1 s"
    assert notes(row, [before, late]) == ""


def test_recorded_calls_are_stacked_by_shape(monkeypatch):
    """Together they solve the same systems as one by one."""
    rng = np.random.default_rng(0)
    solve, svd = np.linalg.solve, np.linalg.svd
    calls = [
        where_time_goes.Call(
            "solve", solve, [rng.normal(size=shape), rng.normal(size=right)], (), {}
        )
        for shape, right in [((4, 3, 3), (4, 3, 1)), ((3, 3), (3,)), ((2, 5, 3, 3), (5, 3, 1))]
    ]
    calls.append(where_time_goes.Call("svd", svd, [rng.normal(size=(7, 2))], (), {}))
    monkeypatch.setattr(where_time_goes, "recorded", calls)
    few = {call.name: call for call in where_time_goes.stacked()}
    assert few.keys() == {"solve", "svd"}
    assert few["solve"].arrays[0].shape == (4 + 1 + 10, 3, 3)
    alone = [solve(*call.arrays).reshape(-1, 3) for call in calls[:3]]
    assert np.array_equal(solve(*few["solve"].arrays)[..., 0], np.concatenate(alone))
    where_time_goes.again(few.values())
