"""Rows pasted from CAD panels: each form gives the numbers as they stand, or is refused."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.io.reading.poses import read_task
from burmester.tasks.motion_task import Task
from tests.oracles.refusals import outcome, refusal

Read = Callable[..., Task]

FORMS = {
    "brackets": "({x}, {y})  {a}°",
    "brackets, no blanks": "({x},{y}) {a}°",
    "brackets and z": "({x}, {y}, 0.0)\t{a} deg",
    "angle brackets": "<{x} mm, {y} mm, 0 mm>, {a} degrees",
    "square brackets": "P{k}: [{x}; {y}] angle = {a}°",
    "labels": "X = {x} mm  Y = {y} mm  Angle = {a} deg",
    "labels, commas": "x: {x}, y: {y}, angle: {a} deg",
    "labels and z": "X={x}in Y={y}in Z=2.5in Rotation={a}°",
    "lines": "X: {x} mm\nY: {y} mm\nAngle: {a}°\n",
    "German": "X = {x} mm; Y = {y} mm; Winkel = {a} Grad",
}


@pytest.fixture
def read(tmp_path: Path) -> Read:
    """Read a text as if it were a file."""

    def read(text: str, **options: Any) -> Task:
        path = tmp_path / "poses.txt"
        path.write_text(text)
        return read_task(path, **options)

    return read


def rows(seed: int) -> list[tuple[str, str, str]]:
    rng = np.random.default_rng(seed)
    digits = int(rng.integers(1, 7))
    return [
        (f"{x:.{digits}f}", f"{y:.{digits}f}", f"{a:.3f}")
        for x, y, a in rng.normal(scale=[300, 20, 60], size=(8, 3))
    ]


def pasted(form: str, given: list[tuple[str, str, str]], comma: bool = False) -> str:
    mark = str.maketrans(".", ",") if comma else {}
    lines = (
        FORMS[form].format(k=k, x=x.translate(mark), y=y.translate(mark), a=a.translate(mark))
        for k, (x, y, a) in enumerate(given, start=1)
    )
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("form", FORMS)
def test_every_form_is_read_as_it_stands(read: Read, form: str) -> None:
    for seed in range(10):
        given = rows(seed)
        task = read(pasted(form, given))
        assert task.poses.translation.tolist() == [[float(x), float(y)] for x, y, _ in given]
        assert task.poses.angle.tolist() == np.radians([float(a) for *_, a in given]).tolist()
        unit = re.search(r"\b(mm|in)\b|(?<=\d)(mm|in)", FORMS[form].replace("}", "} "))
        assert task.length_unit == (unit[0] if unit else None)
        assert [note.code for note in task.notes] == ["W213"] * (
            "z" in form or "0 mm" in FORMS[form]
        )


@pytest.mark.parametrize("form", FORMS)
def test_decimal_commas_are_read_right_or_refused(read: Read, form: str) -> None:
    read_at_all = 0
    for seed in range(20):
        given = rows(seed)
        came = outcome(lambda given=given: read(pasted(form, given, comma=True)))
        if isinstance(came, InputError):
            assert came.code in ("E104", "E106"), came
        else:
            assert came.poses.translation.tolist() == [[float(x), float(y)] for x, y, _ in given]
            read_at_all += 1
    # a comma is read where it can be nothing else, and not beside a point
    clear = form == "labels, commas" or not re.search(r"[,.]", FORMS[form])
    assert (read_at_all > 10) == clear


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("(1, 2) 30°\n(1, 2, 0) 40°\n", "E106"),
        ("(1, 2) 30°\n3, 4, 50\n", "E106"),
        ("(1, 2) 30°\n(3; 4) 0.5 rad\n", "E106"),
        ("(1) 30°\n(2) 40°\n", "E104"),
        ("(1, 2, 3, 4) 30°\n", "E104"),
        ("(1, two) 30°\n", "E104"),
        ("X = 1  Y = 2\n", "E120"),
        ("X = 1  Y = 2  Angle = 30 deg  Speed = 7\n", "E107"),
        ("X = 1  X = 2  Y = 3  Angle = 30 deg\n", "E105"),
        ("X = 1  Y = 2  Angle = 30 deg\nX = 1  Angle = 30 deg  Y = 2\n", "E106"),
        ("X = 1 mm  Y = 2 cm  Angle = 30 deg\n", "E108"),
        ("X = 1  Y = 2  Angle = 30\n" * 3, "E110"),
        ("X = 1,234  Y = 2  Angle = 30 deg\n", "E104"),
        ("X = 1.5  Y = 2,5  Angle = 30 deg\n", "E104"),
        ("X = 1  Y = 2  Angle = 30 deg and more\n", "E104"),
        ("\u2206X = 1  \u2206Y = 2  Angle = 30 deg\n", "E107"),
        ("\u0394X = 1  \u0394Y = 2  Angle = 30 deg\n", "E107"),
        (f"(1, 2) 30°\n({'1' * 600}, 2) 30°\n", "E106"),
    ],
)
def test_what_is_not_alike_or_not_clear_is_refused(read: Read, text: str, code: str) -> None:
    assert refusal(lambda: read(text)).code == code


def test_a_unit_of_angles_can_be_stated(read: Read) -> None:
    text = "(1.5, 2) 30\n(2.5, 3) 40\n(3.5, 5) 45\n"
    assert read(text, angle_unit="deg").poses.angle[1] == np.radians(40.0)
    assert read(text.replace("\n", " rad\n")).poses.angle[1] == 40
