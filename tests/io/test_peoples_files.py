"""Files as people have them: read to the numbers written by hand in the key, or refused."""

from __future__ import annotations

import json
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burmester import cli
from burmester.errors import InputError
from burmester.io.reading.poses import read_task

CORPUS = Path(__file__).parent / "corpus" / "people"
KEY: dict[str, Any] = json.loads((CORPUS / "key.json").read_text(encoding="utf-8"))


def nearest(printed: str) -> float:
    numerator, denominator = Decimal(printed).as_integer_ratio()
    return numerator / denominator


def test_the_corpus_is_whole() -> None:
    files = {path.name for path in CORPUS.iterdir() if path.is_file()}
    assert files - {"key.json"} == set(KEY)
    assert len(KEY) >= 22


@pytest.mark.parametrize("name", [name for name, entry in KEY.items() if "poses" in entry])
def test_every_number_is_the_one_that_its_author_meant(name: str) -> None:
    entry = KEY[name]
    task = read_task(CORPUS / name)
    x, y, angle = (
        [nearest(number) for number in column] for column in zip(*entry["poses"], strict=True)
    )
    assert task.poses.translation.T.tolist() == [x, y]
    meant = np.radians(angle) if entry["unit"] == "deg" else np.array(angle)
    assert task.poses.angle.tolist() == meant.tolist()
    assert task.length_unit == entry.get("length_unit")
    assert list(task.names or []) == entry.get("names", [])
    weights = [] if task.weights is None else task.weights.tolist()
    assert weights == [nearest(number) for number in entry.get("weights", [])]


@pytest.mark.parametrize("name", [name for name, entry in KEY.items() if "poses" in entry])
def test_all_that_is_assumed_is_said(name: str) -> None:
    notes = read_task(CORPUS / name).notes
    said = KEY[name]["said"]
    assert len(notes) == len(said)
    for note, words in zip(notes, said, strict=True):
        assert note.code == "W213"
        assert words in note.message


@pytest.mark.parametrize("name", [name for name, entry in KEY.items() if "refused" in entry])
def test_what_is_not_beyond_doubt_is_refused_for_a_reason(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    entry = KEY[name]
    with pytest.raises(InputError) as caught:
        read_task(CORPUS / name)
    assert caught.value.code == entry["refused"]
    assert str(caught.value.where).splitlines()[0] == f"{CORPUS / name}{entry['where']}"
    assert entry["words"] in f"{caught.value.message}\n{caught.value.why}"
    assert caught.value.help
    with pytest.raises(SystemExit) as stopped:
        cli.main(["check", str(CORPUS / name)])
    assert stopped.value.code == 2
    assert f"error[{entry['refused']}]" in capsys.readouterr().err
