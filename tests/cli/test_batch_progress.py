"""How far a batch is: a bar on a terminal, lines elsewhere, nothing on standard output."""

import json
import os
import re
import subprocess
import sys

import pytest

from burmester.batch.job import BatchProgress
from burmester.cli import batch_progress
from burmester.cli.batch_progress import duration, outcomes_line, watching
from tests.oracles.batches import as_table, rows


@pytest.mark.parametrize(
    ("seconds", "told"),
    [(0.4, "0 s"), (59.4, "59 s"), (59.6, "1 min 0 s"), (3599, "59 min 59 s"), (7260, "2 h 1 min")],
)
def test_a_time_in_words(seconds, told):
    assert duration(seconds) == told


def test_outcomes_in_a_line():
    counted = {"refused": 2, "solved": 912, "failed": 1, "none usable": 80, "special motion": 5}
    assert outcomes_line(counted) == "912 solved, 80 none usable, 5 special motion, 3 others"
    assert outcomes_line({"solved": 3}) == "3 solved"


def test_time_left_is_that_of_the_tasks_left():
    progress = BatchProgress(tasks=100, before=400, total=1000, seconds=20, outcomes={})
    assert progress.rate == 5
    assert progress.seconds_left == 100
    assert BatchProgress(0, 400, 1000, 20, {}).seconds_left is None
    assert BatchProgress(10, 0, 0, 20, {}).seconds_left is None


def test_plain_lines_where_there_is_no_terminal(monkeypatch, capsys):
    monkeypatch.setattr(batch_progress, "PERIOD_S", 0.0)
    with watching() as say:
        say(BatchProgress(0, 0, 0, 0.1, {}))
        say(BatchProgress(100, 400, 1000, 20, {"solved": 450, "failed": 50}))
    out, err = capsys.readouterr()
    assert out == ""
    assert err.splitlines() == [
        "0 tasks",
        "500 tasks, 5 a second, 1 min 40 s left, 450 solved, 50 failed",
    ]


pty = pytest.importorskip("pty", reason="terminals as POSIX has them")


def test_a_bar_on_a_terminal_and_one_object_on_standard_output(tmp_path):
    (tmp_path / "tasks.csv").write_text(as_table(rows(60)))
    terminal, end = pty.openpty()
    line = [
        "batch",
        "tasks.csv",
        "-o",
        "out",
        "--depth",
        "pencil",
        "--part-tasks",
        "2",
        "--workers",
    ]
    line += ["1", "--json"]
    process = subprocess.Popen(
        [sys.executable, "-m", "burmester", *line],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=end,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "120"},
    )
    os.close(end)
    seen = b""
    while True:
        try:
            piece = os.read(terminal, 4096)
        except OSError:
            break
        if not piece:
            break
        seen += piece
    out, _ = process.communicate(timeout=60)
    os.close(terminal)
    assert process.returncode == 0
    assert json.loads(out)["tasks"] == 60
    assert out.count(b"\n") == 1
    text = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", seen.decode())
    assert "reading the tasks" in text
    assert re.search(r"\d+ tasks, [\d.]+/s, \d+ s left \(\d+ solved", text)
    assert "100%" in text
