"""A file in every dialect and with every fault, and the key that says what must come of each."""

from __future__ import annotations

import json
import sys
from decimal import Decimal
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import mpmath
import numpy as np
import pytest

from burmester import cli
from burmester.errors import InputError
from burmester.io.reading.poses import read_task
from burmester.tasks.motion_task import Task

CORPUS = Path(__file__).parent / "corpus"
KEY: dict[str, Any] = json.loads((CORPUS / "key.json").read_text(encoding="utf-8"))
GOOD = {name: entry for name, entry in KEY.items() if "poses" in entry}
BAD = {name: entry for name, entry in KEY.items() if "refused" in entry}


def double(printed: str) -> float:
    """The nearest double, by integers alone: as a fraction that Python divides correctly."""
    numerator, denominator = Decimal(printed).as_integer_ratio()
    return numerator / denominator


def direction(row: list[str]) -> tuple[float, float]:
    """The angle from p to q to 50 digits, and how far doubles may be from it."""
    with mpmath.workdps(50):
        px, py, qx, qy = (mpmath.mpf(number) for number in row)
        size = max(map(abs, (px, py, qx, qy))) / mpmath.hypot(qx - px, qy - py)
        return float(mpmath.atan2(qy - py, qx - px)), float((1 + size) * 2.0**-51)


def require_as_in_the_key(task: Task, entry: dict[str, Any]) -> None:
    x, y = task.poses.translation.T
    given = entry["poses"]
    assert x.tolist() == [double(row[0]) for row in given]
    assert y.tolist() == [double(row[1]) for row in given]
    if len(given[0]) == 4:
        for angle, row in zip(task.poses.angle.tolist(), given, strict=True):
            right, off = direction(row)
            assert abs(angle - right) <= off
    else:
        angles = [double(row[2]) for row in given]
        right = np.radians(angles) if entry["unit"] == "deg" else np.array(angles)
        assert task.poses.angle.tolist() == right.tolist()
    assert task.length_unit == entry.get("length_unit")
    assert list(task.names or []) == entry.get("names", [])
    weights = [] if task.weights is None else task.weights.tolist()
    assert weights == [double(weight) for weight in entry.get("weights", [])]
    marks = [] if task.exact is None else (np.flatnonzero(task.exact) + 1).tolist()
    assert marks == entry.get("exact", [])
    if "notes" in entry:
        assert [note.code for note in task.notes] == entry["notes"]
    if "resolution" in entry:
        assert task.resolution == pytest.approx(entry["resolution"], rel=1e-12)


def test_the_key_and_the_corpus_are_whole() -> None:
    files = {path.name for path in CORPUS.iterdir() if path.is_file()}
    assert files - {"key.json"} == set(KEY)
    assert len(GOOD) >= 30
    assert len(BAD) >= 30


@pytest.mark.parametrize("name", GOOD)
def test_every_number_is_the_one_in_the_key(name: str) -> None:
    entry = GOOD[name]
    require_as_in_the_key(read_task(CORPUS / name, **entry.get("options", {})), entry)


# What comes on standard input is not taken for TOML.
@pytest.mark.parametrize("name", [name for name in GOOD if not name.endswith(".toml")])
def test_standard_input_gives_the_same(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    entry = GOOD[name]
    with open(CORPUS / name, "rb") as file:
        monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=file))
        require_as_in_the_key(read_task("-", **entry.get("options", {})), entry)


@pytest.mark.parametrize("name", BAD)
def test_what_cannot_be_read_exactly_is_refused(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(CORPUS)
    with pytest.raises(InputError) as caught:
        read_task(name, **BAD[name].get("options", {}))
    assert caught.value.code == BAD[name]["refused"]
    assert caught.value.where
    place = caught.value.where.splitlines()[0]
    assert place.startswith(name) or place == BAD[name]["where"]
    assert place == BAD[name].get("where", place)
    assert caught.value.help


@pytest.mark.parametrize("name", BAD)
def test_the_command_refuses_it_with_exit_code_2(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    options: list[str] = []
    for option, value in BAD[name].get("options", {}).items():
        values = value if isinstance(value, list) else [value]
        options += [word for v in values for word in (f"--{option.replace('_', '-')}", str(v))]
    with pytest.raises(SystemExit) as caught:
        cli.main(["synthesize", str(CORPUS / name), *options])
    assert caught.value.code == 2
    out, err = capsys.readouterr()
    assert f"error[{BAD[name]['refused']}]" in err
    assert "Traceback" not in err
    assert not out
