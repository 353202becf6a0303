"""Six-bars by the command and in Python: answers, files, exit codes."""

import csv
import json

import numpy as np
import pytest
from PIL import Image

import burmester
from tests.command import run
from tests.oracles.six_bars import LIST, dimensions, driven
from tests.sixbar.tasks import TURNING

WATT = "--six-bar-kind", "Watt I"
HEAD = "x_mm,y_mm,angle_deg\n"


def table(rows):
    return HEAD + "".join(f"{x},{y},{angle}\n" for x, y, angle in rows)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("six")
    (path / "task.csv").write_text(table(TURNING))
    return path


@pytest.fixture(scope="module")
def result():
    return burmester.synthesize_six_bars(
        TURNING, angle_unit="deg", length_unit="mm", kind="Watt I", chains=1000, most=3
    )


def test_command_and_python_give_the_same_six_bars(folder, result):
    code, out, _ = run(
        "synthesize", folder / "task.csv", "--six-bars", *WATT, "--chains", 1000, "--json"
    )
    data = json.loads(out)
    assert code == 0
    found = data["six_bars"]["found"]
    for mine, theirs in zip(result, found, strict=False):
        assert mine.id == theirs["id"]
        assert mine.lengths == theirs["lengths"]
    assert data["linkages"] == []
    text = run("synthesize", folder / "task.csv", "--six-bars", *WATT, "--chains", 1000)[1]
    assert text.startswith("S1 is a Watt I six-bar, driven at ")
    for bar in ("AC", "GH"):
        assert f"{found[0]['lengths'][bar]:.7g}" in text
    for number in (*found[0]["ground"]["A"], *found[0]["body"]["H"]):
        assert f"{number:.7g}" in text


def test_none_is_an_answer_with_exit_code_1(folder):
    words = "synthesize", folder / "task.csv", "--six-bars", "--chains", 5
    code, out, _ = run(*words, "--min-transmission", 85)
    assert code == 1
    assert out.startswith("result[R371]: no six-bar that works")


def test_the_files_of_a_six_bar(folder, result):
    saved = result.save(folder / "result.json")
    best = result.best
    for name in ("motion.csv", "bar.json", "bar.svg", "bar.gif"):
        words = ["--seconds", "0.3", "--pixels", "200"] if name.endswith("gif") else []
        code, out, _ = run("export", saved, "-o", folder / name, *words)
        assert code == 0
        assert "S1, Watt I six-bar; read back and verified" in out
    with open(folder / "motion.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    bars = dimensions(best.linkage)
    at = {
        joint: np.array(
            [complex(float(row[f"{joint}_x"]), float(row[f"{joint}_y"])) for row in rows]
        )
        for joint in "ABCDEGH"
    }
    for bar in LIST:
        assert np.abs(np.abs(at[bar[0]] - at[bar[1]]) - bars[bar]).max() < 1e-9
    numbers = [[float(row[key]) for key in ("x", "y", "angle_deg")] for row in rows if row["pose"]]
    assert np.array(numbers) == pytest.approx(np.array(TURNING, dtype=float), abs=1e-7)
    drives = np.radians([float(row["drive_deg"]) for row in rows])
    pose = [*TURNING[0][:2], np.radians(TURNING[0][2])]
    places = driven(best.linkage, pose, best.driver, drives).places
    told = np.array([[float(row["x"]), float(row["y"])] for row in rows])
    assert np.abs(places[:, :2] - told).max() < 1e-8
    with Image.open(folder / "bar.gif") as film:
        assert film.n_frames > 2
    assert json.loads((folder / "bar.json").read_text())["id"] == "S1"


def test_a_task_that_no_four_bar_does_offers_six_bars(folder):
    (folder / "hard.csv").write_text(
        table([(0, 0, 0), (4, 9, 70), (9, 2, 95), (1, 6, 20), (7, 7, 150)])
    )
    code, out, _ = run("synthesize", folder / "hard.csv")
    assert code == 1
    assert "--six-bars" in out
    assert "--six-bars" not in run("synthesize", folder / "hard.csv", "--kinds", "PR")[1]
