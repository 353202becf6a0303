"""Random linkages as the tasks of a batch: what is told of them holds, however they are drawn."""

import json
import subprocess
import sys

import numpy as np
import pyarrow.parquet as pq
import pytest

from burmester import InputError
from burmester.batch import Sample, run

COUNT = 120


def sampled(folder, **options):
    """The rows of a sample."""
    given = {"depth": "pencil", "workers": 1, "part_tasks": 50} | options
    run(Sample.of(COUNT, seed=7, poses=6, noise=1e-3, curve=9), folder, **given)
    return pq.read_table(folder).to_pylist()


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sample")
    return folder, sampled(folder)


def numbers(poses):
    return np.array([[each["x"], each["y"], each["angle_deg"]] for each in poses])


def distance(dyad, poses):
    """How far a dyad is from poses, in lengths."""
    x, y, angle = numbers(poses).T
    turn = np.exp(1j * np.radians(angle))
    pin = x + 1j * y + (dyad["moving_x"] + 1j * dyad["moving_y"]) * turn
    if dyad["kind"] == "RR":
        return abs(pin - (dyad["fixed_x"] + 1j * dyad["fixed_y"])) - dyad["length"]
    normal = np.exp(1j * np.radians(dyad["normal_deg"]))
    return (pin * normal.conj()).real - dyad["offset"]


def transmission(first, second, poses):
    """The angle at the second dyad's pin between the coupler and what that dyad can bear."""
    x, y, angle = numbers(poses).T
    turn = np.exp(1j * np.radians(angle))
    one, two = (
        x + 1j * y + (each["moving_x"] + 1j * each["moving_y"]) * turn for each in (first, second)
    )
    if second["kind"] == "RR":
        bears = two - (second["fixed_x"] + 1j * second["fixed_y"])
    else:
        bears = np.exp(1j * np.radians(second["normal_deg"])) * np.ones(len(x))
    return np.degrees(np.arcsin(abs(((two - one) / bears).imag) / abs((two - one) / bears)))


def test_a_drawn_linkage_leads_through_its_poses(drawn):
    _, rows = drawn
    assert [row["task"] for row in rows] == list(range(COUNT))
    kinds = set()
    for row in rows:
        first, second = row["drawn_dyads"]
        kinds.add(row["drawn_type"])
        assert (second["kind"] == "PR") == (row["drawn_type"] == "slider-crank")
        for name in ("exact_poses", "curve"):
            for dyad in (first, second):
                assert abs(distance(dyad, row[name])).max() < 1e-9
        least = row["drawn_transmission_deg"]
        assert least > 30 - 1e-9
        assert transmission(first, second, row["exact_poses"]).min() > least - 1e-6
        assert len(row["exact_poses"]) == len(row["given"]) == len(row["inputs_deg"]) == 6
        assert len(row["curve"]) == 9
        centre, pin = (first[f"{name}_x"] + 1j * first[f"{name}_y"] for name in ("fixed", "moving"))
        x, y, angle = numbers(row["exact_poses"]).T
        crank = x + 1j * y + pin * np.exp(1j * np.radians(angle)) - centre
        steps = np.diff(np.unwrap(np.angle(crank)))
        assert np.degrees(steps) == pytest.approx(np.diff(row["inputs_deg"]), abs=1e-6)
    assert len(kinds) == 6


def test_the_noise_is_as_large_as_is_said(drawn):
    errors, turns = [], []
    for row in drawn[1]:
        exact, given = numbers(row["exact_poses"]), numbers(row["given"])
        span = np.hypot(*np.ptp(exact[:, :2], axis=0))
        errors += ((given - exact)[:, :2] / span).ravel().tolist()
        turns += np.radians((given - exact)[:, 2]).tolist()
    for values in (errors, turns):
        assert np.std(values) == pytest.approx(1e-3, rel=0.15)
        assert abs(np.mean(values)) < 2e-4


def test_the_answers_are_those_of_the_given_poses(drawn, tmp_path):
    _, rows = drawn
    lines = ["task,x,y,angle_deg"]
    for row in rows:
        lines += [f"{row['task']},{x!r},{y!r},{a!r}" for x, y, a in numbers(row["given"]).tolist()]
    (tmp_path / "tasks.csv").write_text("\n".join(lines))
    run(tmp_path / "tasks.csv", tmp_path / "out", depth="pencil", part_tasks=50, workers=1)
    for row, again in zip(rows, pq.read_table(tmp_path / "out").to_pylist(), strict=True):
        assert row["outcome"] == again["outcome"]
        for one, other in zip(row["dyads"], again["dyads"], strict=True):
            assert one["worst"] == pytest.approx(other["worst"], rel=1e-3, abs=1e-9)


def test_a_draw_is_the_same_in_parts_of_any_size(drawn, tmp_path):
    other = sampled(tmp_path / "out", part_tasks=7, workers=2)
    names = ("task", "given", "exact_poses", "drawn_type", "drawn_dyads", "inputs_deg", "curve")
    for row, again in zip(drawn[1], other, strict=True):
        assert all(row[name] == again[name] for name in names)


def test_the_folder_says_how_they_were_drawn(drawn):
    folder, _ = drawn
    sheet = " ".join((folder / "_datasheet.md").read_text().split())
    for told in (
        "# 120 random four-bar",
        "seed 7",
        "6 of each",
        "0.001 times the span",
        "30°",
        "`curve`",
    ):
        assert told in sheet
    draws = json.loads((folder / "_manifest.json").read_text())["identity"]["tasks"]["draws"]
    assert (draws["seed"], draws["count"], draws["noise"]) == (7, COUNT, 1e-3)


def test_the_command_draws_the_same(drawn, tmp_path):
    line = "batch --sample four-bars --count 60 --seed 7 --poses 6 --noise 1e-3 --depth pencil"
    more = ["--types", "crank-rocker", "-o", str(tmp_path / "out"), "--workers", "1"]
    command = [sys.executable, "-m", "burmester", *line.split(), *more]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    rows = pq.read_table(tmp_path / "out").to_pylist()
    assert len(rows) == 60
    assert {row["drawn_type"] for row in rows} == {"crank-rocker"}
    among_all = [row for row in drawn[1][:60] if row["drawn_type"] == "crank-rocker"]
    assert among_all
    for row in among_all:
        assert rows[row["task"]]["drawn_dyads"] == row["drawn_dyads"]
        assert rows[row["task"]]["given"] == row["given"]


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"count": 0}, "a sample of 0 linkages"),
        ({"count": 5, "poses": 1}, "number of poses"),
        ({"count": 5, "noise": -1.0}, "noise"),
        ({"count": 5, "types": ("crank",)}, "types"),
    ],
)
def test_a_sample_that_makes_no_sense_is_refused(options, told):
    with pytest.raises(InputError, match=told) as caught:
        Sample.of(**options)
    assert caught.value.code == "E134"
