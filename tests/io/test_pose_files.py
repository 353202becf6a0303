"""Poses from files: what is read is exact, what is refused says where, and the help helps."""

from __future__ import annotations

import functools
import io
import json
import math
import os
import re
import subprocess
import sys
import zipfile
from collections.abc import Callable
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burmester.errors import InputError
from burmester.io import cases
from burmester.io.reading.poses import read_task
from burmester.io.reading.tables import pose_rows
from burmester.tasks.motion_task import Task
from tests.oracles.refusals import refusal
from tests.samples import share

Read = Callable[..., Task]

TRIPLES = [(-0.8253, -1.0329, 91.91), (-1.6554, 0.0, 66.99), (1e-05, 0.292, 49.9)]
ROWS = "-0.8253,-1.0329,91.91\n-1.6554,0,66.99\n1e-05,0.292,49.9\n"
CSV = "x,y,angle_deg\n" + ROWS
JSON = '{"angle_unit": "deg", "poses": [[-0.8253, -1.0329, 91.91], [-1.6554, 0, 66.99], '
JSON += "[1e-05, 0.292, 49.9]]}"
TOML = 'angle_unit = "deg"\nposes = [[-0.8253, -1.0329, 91.91], [-1.6554, 0, 66.99], '
TOML += "[1e-05, 0.292, 49.9]]\n"


def refused(read: Read, content: str | bytes, suffix: str = ".csv", **options: Any) -> InputError:
    return refusal(lambda: read(content, suffix, **options))


def place(error: InputError) -> str:
    return str(error.where).splitlines()[0]


def triples(task: Task) -> list[tuple[float, float, float]]:
    """The poses in degrees as given: np.radians is undone by repeating it, not by inverting it."""
    x, y = task.poses.translation.T
    return list(zip(x.tolist(), y.tolist(), task.poses.angle.tolist(), strict=True))


def in_radians(rows: list[tuple[float, float, float]]) -> list[tuple[float, float, float]]:
    return [(x, y, float(np.radians(angle))) for x, y, angle in rows]


# What is read -------------------------------------------------------------------------------


def test_weights_and_names(read: Read) -> None:
    text = 'name,x,y,angle_rad,weight\n open ,1,2,3,1\n"left, ""top""",4,5,6,2.5\n,7,8,9,1e1\n'
    task = read(text)
    assert task.names == ("open", 'left, "top"', "")
    assert task.weights is not None
    assert task.weights.tolist() == [1.0, 2.5, 10.0]
    assert triples(task) == [(1, 2, 3), (4, 5, 6), (7, 8, 9)]


def test_names_in_quotes_and_with_an_inch_mark(read: Read) -> None:
    task = read('x,y,angle_rad,name\n1,2,3,"a"\n4,5,6,5" pin\n7,8,9, b \n')
    assert task.names == ("a", '5" pin', "b")


def test_a_row_that_is_commented_out_is_left_out(read: Read) -> None:
    task = read("name,x,y,angle_rad\na,1,2,3\n#b,4,5,6\nc,7,8,9\nd,1,2,3\n")
    assert task.names == ("a", "c", "d")
    assert triples(task)[1] == (7, 8, 9)


def test_weights_and_names_in_json(read: Read) -> None:
    listed: list[dict[str, Any]] = [{"x": i, "y": -i, "angle_rad": 0.5 * i} for i in range(4)]
    listed[1] |= {"weight": 2, "name": "mid"}
    listed[2] |= {"weight": None, "name": None}
    task = read(json.dumps({"poses": listed, "length_unit": "mm"}), ".json")
    assert task.names == ("", "mid", "", "")
    assert task.weights is not None
    assert task.weights.tolist() == [1.0, 2.0, 1.0, 1.0]
    assert task.length_unit == "mm"
    assert triples(task)[3] == (3.0, -3.0, 1.5)


def test_numbers_as_names_stay_text_on_the_fast_path(read: Read) -> None:
    task = read("x,y,angle_rad,name\n1,2,3,07\n4,5,6,1e3\n7,8,9,\n")
    assert task.names == ("07", "1e3", "")


def test_a_name_may_hold_a_line_separator_of_unicode(read: Read) -> None:
    error = refused(read, "x,y,angle_rad,name\n1,2,3,a\u2028b\n1,2,oh,c\n")
    assert place(error).endswith(":3:5")


RESOLUTIONS: list[tuple[str, str, float, float]] = [  # suffix, content, length, angle
    (".csv", "x,y,angle_deg\n1.25,2,91.9\n1,2.125,90\n0,9,0\n", 0.0005, 0),
    (".csv", "x,y,angle_rad\n1.50,2,0\n1,2,1\n0,40,0\n", 0.005, 0),
    (".csv", "x,y,angle_rad\n1.5e-3,2,1.25e2\n1,2,1e5\n0,0,1.5e1\n", 0.00005, 0),
    (".csv", "x;y;angle_rad\n1,5;2;0,0001\n1;2;1\n0;120;0\n", 0.05, 0.00005),
    (".csv", "x,y,angle_rad\n# by hand\n1.5,2,1\n1,2.25,1\n0,12,0.1250\n", 0.005, 0.00005),
    (".json", '{"angle_unit":"rad","poses":[[1.50,2,3],[1,2.5e-1,3.0],[1,12,3e4]]}', 0.005, 0),
    (".toml", 'angle_unit="deg"\nposes=[[1.50,2,3],[1,2.5e-2,3.00],[1,2,3e4]]', 0.0005, 0.005),
    # digits coarser than a two-thousandth of the motion are meant exactly, whole numbers or not
    (".csv", "x,y,angle_deg\n10,2,90\n1,-20,45\n0,1e2,0\n", 0, 0),
    (".csv", "x,y,angle_deg\n10.5,2,90.5\n1,-20,45\n0,20,0\n", 0, 0),
    (".csv", '"x",y,angle_deg\n10,2,90\n1,-20,45\n# by hand\n0,1.5e2,0\n', 0, 0),
    (".csv", "x,y,angle_deg,weight\n1,2,90,0.5\n1,2,45,0.25\n0,1,0,2\n", 0, 0),
    (".csv", "x,y,angle_rad\n1,2,1.5\n1,2.0,0.5\n0,1,0\n", 0, 0),
    (".json", '{"angle_unit":"deg","poses":[[1,2,90],[1,3e1,45],[0,1,0]]}', 0, 0),
    (".json", '{"angle_unit":"deg","poses":[[1,2,90.00],[1,3,45],[0,1,0]]}', 0, 0.005),
    (".toml", 'angle_unit="deg"\nposes=[[1,2,90],[1,3,45],[0,1,0]]', 0, 0),
    # and finer ones are not, be they whole numbers
    (".csv", "x,y,angle_deg\n1000,2,90\n1,-2000,45\n0,1,0\n", 0.5, 0),
    (".toml", 'angle_unit="deg"\nposes=[[1.5,2,90],[1,120,45],[0,1,0]]', 0.05, 0),
]


@pytest.mark.parametrize(("suffix", "text", "length", "angle"), RESOLUTIONS)
def test_resolution_is_half_of_the_last_printed_digit_unless_that_is_coarse(
    read: Read, suffix: str, text: str, length: float, angle: float
) -> None:
    angle = math.radians(angle) if suffix != ".csv" else angle
    assert read(text, suffix).resolution == pytest.approx((length, angle), rel=1e-12, abs=0)


def test_no_decimal_point_and_no_unit_decides_how_exact_numbers_are(read: Read) -> None:
    """Millimetres with two decimals, and the same poses in hundredths of a millimetre."""
    rng = np.random.default_rng(3)
    for extent in (3, 30, 700):
        points = rng.uniform(0, extent, (6, 2)).round(2)
        fine, whole = (
            read(
                "x,y,angle_deg\n"
                + "".join(
                    f"{x * 100**k:.{2 - 2 * k}f},{y * 100**k:.{2 - 2 * k}f},{9 * n}\n"
                    for n, (x, y) in enumerate(points.tolist())
                )
            )
            for k in (0, 1)
        )
        assert whole.resolution[0] == pytest.approx(100 * fine.resolution[0])
        size = float(np.hypot(*np.ptp(points, axis=0)))
        assert (fine.resolution[0] > 0) == (1e-3 * size >= 0.005)


def test_standard_input_is_bytes(monkeypatch: pytest.MonkeyPatch) -> None:
    def give(data: bytes) -> None:
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data), encoding="ascii"))

    give(CSV.encode("utf-16"))
    assert triples(read_task("-")) == in_radians(TRIPLES)
    give(b"\n  " + JSON.encode())
    assert triples(read_task("-")) == in_radians(TRIPLES)
    give(b"x,y,angle_deg\n1,2,nan\n")
    error = refusal(lambda: read_task("-"))
    assert error.where == "<stdin>:2:5\n   2 | 1,2,nan\n     |     ^^^ angle"


CASES = {
    "ge2012-approximate": (10, (-0.9822, -1.0389, 78.54)),
    "ge2012-exact": (10, (-0.8253, -1.0329, 91.91)),
    "motiongen-four-line": (4, (-7.35277, 1.83234, 42.4862)),
    "motiongen-mixed5": (5, (-7.9264, 1.2469, 11.07)),
    "motiongen-prpr": (10, (3.4099, -4.2601, -19.18)),
    "motiongen-rrpr": (10, (-0.2632, 5.2514, 65.14)),
    "motiongen-rrrp": (10, (4.2333, 0.4588, -74.56)),
    "motiongen-shoulder": (5, (-3.9696, -2.6338, 37.23)),
    "motiongen-three-pivots": (3, (-5.5262849783, 3.3309916872, 10.0)),
}


def test_names_of_the_cases() -> None:
    assert cases.names() == tuple(CASES)


@pytest.mark.parametrize(("name", "count", "first"), [(n, *v) for n, v in CASES.items()])
def test_every_case_is_read_by_its_name(
    name: str, count: int, first: tuple[float, float, float]
) -> None:
    task = read_task(f"case:{name}")
    assert task.poses.shape == (count,)
    assert triples(task)[0] == in_radians([first])[0]
    case = cases.load(name)
    assert case["name"] == name
    assert triples(task) == in_radians(case["poses"])


def test_the_corrected_pose_of_the_exact_case_is_used() -> None:
    assert triples(read_task("case:ge2012-exact"))[5][2] == np.radians(52.87)
    assert read_task("case:ge2012-exact").resolution == pytest.approx((5e-5, math.radians(0.005)))


# What is refused ----------------------------------------------------------------------------

H = "x,y,angle_deg\n"
OK = "1,2,3\n"
# suffix, content, code, what `where` ends its first line with, what the whole message holds
BAD: list[tuple[str, str | bytes, str, str, str]] = [
    (".csv", b"\xef\xbb\xbf", "E102", "poses.csv", "the file is empty"),
    (".json", " \n ", "E102", "poses.json", "the file is empty"),
    (
        ".csv",
        b"x,y,angle_deg\n1,2,\x813\n",
        "E101",
        "poses.csv",
        "byte 19, in line 2, is not UTF-8",
    ),
    (".csv", b"x,y,angle_deg\n1,2,\xe93\n", "E104", "poses.csv:2:5", "'é3'"),
    (".csv", CSV.encode("utf-32"), "E101", "poses.csv", "null characters"),
    (".csv", H + OK + "4,inf,5\n", "E103", "poses.csv:3:3", "4,inf,5"),
    (".csv", H + "4,5,-1e400\n", "E103", "poses.csv:2:5", "^^^^^^ angle"),
    (".csv", H + "4," + "9" * 400 + ",5\n", "E103", "poses.csv:2:3", "finite"),
    (".csv", "x;y;angle_deg\n0,5;2;1,5e999\n", "E103", "poses.csv:2:7", "1,5e999"),
    (".csv", H + OK + "\n#\n  1,abc,3\n", "E104", "poses.csv:5:5", "^^^ y"),
    (".csv", "x,y,angle_deg,weight\n1,2,3,\n", "E104", "poses.csv:2:7", "^ weight"),
    (".csv", H + "1,1e,3\n", "E104", "poses.csv:2:3", "'1e'"),
    (".csv", H + "1,1-2,3\n", "E104", "poses.csv:2:3", "'1-2'"),
    (".csv", H + "1,.,3\n", "E104", "poses.csv:2:3", "'.'"),
    (".csv", H + "1,1.2.3,3\n", "E104", "poses.csv:2:3", "'1.2.3'"),
    (".csv", H + '"1.234,5",2,3\n', "E104", "poses.csv:2:1", "'1.234,5'"),
    (".csv", "x;y;angle_deg\n1,234.5;0,5;3\n", "E104", "poses.csv:2:9", "two ways"),
    (".csv", "x;y;angle_deg\n1.234,5;2.5;3\n", "E104", "poses.csv:2:1", "two ways"),
    (".csv", "x;y;angle_deg\n1,234,567;2;3\n", "E104", "poses.csv:2:1", "'1,234,567'"),
    (".csv", "x;y;angle_deg\n7;1,234;3\n7;1;3\n", "E104", "poses.csv:2:3", "separates thousands"),
    (".csv", "x;y;angle_deg\n7;1,23;3\n7;1.5;3\n", "E104", "poses.csv:2:3", "two ways"),
    (".tsv", "x\ty\tangle_deg\n7\t8\t1.5\n7\t1,500\t3\n", "E104", "poses.csv:3:3", "two ways"),
    (".csv", "x,weight\n1,2\n", "E105", "poses.csv:1:1", "no column for y and angle"),
    (".csv", "x,y\n1,2\n3,\n", "E104", "poses.csv:3:3", "^ y"),
    (".csv", "x y wohin\n1 2 3\n", "E105", "poses.csv:1:1", "'wohin'"),
    (".csv", "x y winkel\n1 2 3\n", "E110", "poses.csv:1:5", "^^^^^^ angle"),
    (".csv", 'x,y,angle_deg,name\n1,2,3,"a\nb"\n', "E106", "poses.csv:3:3", "row 2 has 1 cell"),
    (".csv", "x,y,angle_rad,angle_deg\n1,2,3,4\n", "E108", "poses.csv:1:15", "angle_rad and"),
    (".csv", "x,y_in,angle_deg\n" + OK, "E108", "poses.csv:1:3", "x is in no unit, y in in"),
    (".json", '{"poses": [[1, 2, 3],\n [1, 2,, 3]]}', "E109", "poses.json:2:8", "^"),
    (".json", "[" * 100_000, "E109", "poses.json:1:1", "too many brackets"),
    (".json", "x,y,angle_deg\n", "E109", "poses.json:1:1", "not JSON"),
    ("", '["' + "a" * 500 + '", 2, oops]', "E109", "poses:1:509", "oops"),
    (".json", '{"poses": [[1, 2, NaN]]}', "E103", "poses.json:1:19", "^^^"),
    (".json", '{"a": "NaN",\n"b": [-Infinity]}', "E103", "poses.json:2:7", "^^^^^^^^^"),
    (".json", '{"angle_unit":"deg","poses":[[1,1e400,3]]}', "E103", "poses.json:1:33", "finite"),
    (
        ".json",
        '{"angle_unit":"deg","poses":[[1,1e%s,3]]}' % ("9" * 30),
        "E103",
        "poses.json:1:33",
        "y",
    ),
    (".json", "[[1, 2, %s]]" % ("9" * 5000), "E103", "poses.json:1:9", "finite"),
    (
        ".json",
        '{"poses": [[1,2,3], "abc"], "angle_unit":"deg"}',
        "E104",
        "poses.json:1:21",
        "'abc'",
    ),
    (".json", '{"poses": 5}', "E104", "poses.json:1:11", "5"),
    (".json", "5", "E104", "poses.json:1:1", "5"),
    (".json", "{}", "E105", "poses.json:1:1", "poses is missing"),
    (".json", '{"task": {"poses": [{"x": 1}]}}', "E105", "poses.json:1:21", "missing"),
    (".json", '{"poses": [{"x": 1, "y": 2}]}', "E105", "poses.json:1:12", "pose 1 has no angle"),
    (".json", '{"poses": [[1, 2, 3]]}', "E110", "poses.json:1:2", "both readings"),
    (
        ".json",
        '{"poses":[{"x":1,"y":2,"angle_rad":3}],"angle_unit":"deg"}',
        "E110",
        "poses.json:1:24",
        "different units",
    ),
    (".json", '{"poses": []}', "E120", "poses.json:1:2", "0 poses"),
    (".toml", "angle_unit = 'deg'\nposes = []", "E120", "poses.toml:2:1", "0 poses"),
    (".toml", "a = 1\nposes = [[1, @, 3]]", "E109", "poses.toml:2:14", "^"),
    (".toml", "poses = [[1, 2", "E109", "poses.toml:1:14", "not TOML"),
    (".toml", 'angle_unit="deg"\nposes=[[1,2,nan]]', "E103", "poses.toml:2:13", "finite"),
    (".toml", "poses=[{x=nan,y=2,angle_deg=3}]", "E103", "poses.toml:1:11", "finite"),
    (".toml", "poses = 0x" + "f" * 5000, "E104", "poses.toml:1:9", "0xfff"),
    (".toml", "poses = " + "9" * 5000, "E103", "poses.toml:1:9", "digits"),
    (".toml", "poses=[[1,2,3]]", "E110", "poses.toml:1:1", "both readings"),
]


@pytest.mark.parametrize("bad", BAD, ids=lambda bad: f"{bad[2]}-{bad[1][:40]!r}")
def test_what_cannot_be_read_exactly_is_refused_with_its_place(
    read: Read, bad: tuple[str, str | bytes, str, str, str]
) -> None:
    suffix, content, code, where, holds = bad
    error = refused(read, content, suffix)
    assert error.code == code
    assert place(error).endswith(where.replace("poses.csv", f"poses{suffix}"))
    assert holds in str(error)
    assert error.exit_code == 2


def test_the_message_of_the_catalogue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("poses.csv").write_text("x,y,angle_deg\n1,2,3\n1,2,3\n1,2,3\n-2.6392,0.2920,inf\n")
    assert str(refusal(lambda: read_task("poses.csv"))) == (
        "error[E103]: row 4 has a value that is not a finite number\n"
        "  --> poses.csv:5:16\n"
        "   5 | -2.6392,0.2920,inf\n"
        "     |                ^^^ angle\n"
        "  help: give a number in degrees, such as -12.5 or 3e-4, or delete the row"
    )


def test_the_caret_stands_under_the_cell_behind_tabs_and_control_characters(read: Read) -> None:
    error = refused(read, "name\tx\ty\tangle_deg\na\x1b[31mb\t 1\t  zwei \t3\n", ".tsv")
    place, shown, caret = error.where.splitlines()
    assert place.endswith(":2:14")
    assert "\x1b" not in shown
    start = caret.index("^")
    assert shown[start : start + 4] == "zwei"
    assert caret[start:] == "^^^^ y"


def test_a_long_line_is_cut_around_the_fault(read: Read) -> None:
    error = refused(read, "x,y,angle_deg,name\n1,2,oh," + "n" * 5000 + "\n")
    assert max(map(len, error.where.splitlines()[1:])) < 120
    error = refused(read, "name,x,y,angle_deg\n" + "n" * 5000 + ",oh,2,3\n")
    place, shown, caret = error.where.splitlines()
    assert place.endswith(":2:5002")
    assert shown[caret.index("^") :].startswith("oh,2,3")


def test_files_that_cannot_be_opened(tmp_path: Path) -> None:
    for source in (tmp_path / "none.csv", tmp_path, f"{tmp_path}/nul\0.csv"):
        error = refusal(functools.partial(read_task, source))
        assert error.code == "E101"
        assert error.where == os.fspath(source).replace("\0", r"\x00")
        assert error.why


@pytest.mark.skipif(
    os.name == "nt" or os.geteuid() == 0,
    reason="root may read every file, and Windows has other permissions",
)
def test_a_file_without_permission(tmp_path: Path) -> None:
    path = tmp_path / "poses.csv"
    path.write_text(CSV)
    path.chmod(0)
    with pytest.raises(InputError, match="cannot be read"):
        read_task(path)


@pytest.mark.parametrize("name", ["", "nobody", "../cases/ge2012-exact", "ge2012-exact.json"])
def test_an_unknown_case_lists_the_known_ones(name: str) -> None:
    for error in (refusal(lambda: cases.load(name)), refusal(lambda: read_task(f"case:{name}"))):
        assert error.code == "E101"
        assert all(f"case:{known}" in error.help for known in CASES)


def test_no_other_angle_unit_exists(read: Read) -> None:
    with pytest.raises(InputError) as caught:
        read(CSV, angle_unit="grad")
    assert caught.value.code == "E110"


# The help is followed to the letter -----------------------------------------------------------

TURN = "0.25,1,-0.5\n1,2,0.25\n2,2,0.5\n"


def test_e110_states_both_readings_and_every_way_out_works(read: Read) -> None:
    error = refused(read, "x,y,Angle\n" + TURN)
    assert error.code == "E110"
    assert error.message == "the angle unit is not stated and both readings are possible"
    assert error.why == (
        "all 3 angles lie within +-6.28. "
        "As degrees the body turns 1.0 deg in total, as radians 57.3 deg"
    )
    for edit in re.findall(r"`(\w+)`", error.help):
        turned = read(f"x,y,{edit}\n" + TURN).poses.angle[0]
        assert turned == {"angle_deg": np.radians(-0.5), "angle_rad": -0.5}[edit]
    options = re.findall(r"--angle-unit (\w+)", error.help)
    assert options == ["deg", "rad"]
    for unit in options:
        turned = read("x,y,angle\n" + TURN, angle_unit=unit).poses.angle[0]
        assert turned == {"deg": np.radians(-0.5), "rad": -0.5}[unit]


def test_e110_with_large_angles_does_not_claim_they_are_small(read: Read) -> None:
    error = refused(read, "x,y,phi\n" + ROWS)
    assert error.why == (
        "all 3 angles lie between 49.9 and 91.91. "
        "As degrees the body turns 42.0 deg in total, as radians 2407.0 deg"
    )


def test_e110_speaks_of_one_angle_as_one(read: Read) -> None:
    error = refused(read, "x,y,angle\n1,2,2.5\n")
    assert error.code == "E110"
    assert "the angle is 2.5: 2.5 deg as degrees, 143.239 deg as radians" in str(error)


ESCAPES = "\x1b[31m\x07\x9b\u202e"  # what a terminal would obey
STEALTH = [
    (".csv", f"x,y,angle_deg,n{ESCAPES}\n1,2,3,4\n", "E107"),
    (".csv", f"x,\x1fx,y,angle_deg\n1,2,3,4\n{ESCAPES}", "E108"),
    (".csv", f"x,y,angle_deg\n1,{ESCAPES}2,3\n", "E104"),
    (".csv", f"x,y,angle_deg\n1,\u2013{ESCAPES},3\n", "E104"),
    (".csv", f"x,y,angle_deg,#{ESCAPES}\n1,2,3\n", "E106"),
    (".csv", f"# x,y,angle_deg,#{ESCAPES}\n1,2,3\n2,3,4\n", "E105"),
    (".json", f"[[1, {ESCAPES}]]", "E109"),
    (".json", f"[[1, a{ESCAPES}]]", "E109"),
    (".json", json.dumps([{"x": 1, "y": 2, "angle": 3, ESCAPES: 4}]), "E107"),
    (".json", json.dumps([{"x": 1, "y": 2, "angle": 3, "\udc1b": 4}]), "E107"),
    (".json", json.dumps({ESCAPES: 1, "poses": [[1, 2, "\udc1b"]]}), "E104"),
    (".json", json.dumps({"poses": [], "requirements": {"types": [ESCAPES]}}), "E134"),
    (".json", json.dumps({"poses": [], "limits": {"kinds": [ESCAPES + "\udc1b"]}}), "E104"),
    (".toml", f"a = {ESCAPES}", "E109"),
    (".toml", "angle_unit = '\u202e'\nposes = [[1, 2, 3]]", "E110"),
]


@pytest.mark.parametrize(("suffix", "content", "code"), STEALTH)
def test_errors_hold_nothing_that_a_terminal_obeys(
    read: Read, suffix: str, content: str, code: str
) -> None:
    error = refusal(lambda: read(content, suffix))
    assert error.code == code
    for part in (error.message, error.where, error.why, error.help):
        assert (part or "").replace("\n", "").isprintable()


@pytest.mark.parametrize("column", ["angle", "theta", "phi", "rotation", "ANGLE"])
def test_seven_presets_without_a_unit_are_all_asked_about(read: Read, column: str) -> None:
    for name in CASES:
        for convert in (float, math.radians):
            rows = [f"{x},{y},{convert(a)!r}" for x, y, a in cases.load(name)["poses"]]
            assert refused(read, "\n".join([f"x,y,{column}", *rows])).code == "E110"


@pytest.mark.parametrize("suffix", [".json", ".toml"])
def test_e110_help_in_json_and_toml(read: Read, suffix: str) -> None:
    listed = f"[{','.join(f'[{row}]' for row in TURN.split())}]"
    text = f'{{"poses": {listed}}}' if suffix == ".json" else f"poses = {listed}"
    error = refused(read, text, suffix)
    assert error.code == "E110"
    assert '"deg"' in error.help
    if suffix == ".json":
        edited = text.replace("{", '{"angle_unit": "deg", ')
        assert error.help.startswith('write {"angle_unit": "deg", "poses": [[')
    else:
        edited = 'angle_unit = "deg"\n' + text
        assert error.help.startswith('write angle_unit = "deg" above poses')
    assert read(edited, suffix).poses.angle[0] == np.radians(-0.5)
    assert read(text, suffix, angle_unit="rad").poses.angle[0] == -0.5


@pytest.mark.parametrize("suffix", [".csv", ".json", ".toml", "case"])
def test_a_contradicted_unit_is_refused_and_leaving_the_option_out_works(
    read: Read, suffix: str
) -> None:
    def attempt(**options: Any) -> Task:
        if suffix == "case":
            return read_task("case:ge2012-exact", **options)
        return read({".csv": CSV, ".json": JSON, ".toml": TOML}[suffix], suffix, **options)

    error = refusal(lambda: attempt(angle_unit="rad"))
    assert error.code == "E110"
    assert "states degrees, --angle-unit states radians" in error.message
    assert error.help.startswith("leave --angle-unit out")
    assert triples(attempt()) == triples(attempt(angle_unit="deg"))


FOREIGN = {
    "a.mat": (b"MATLAB 5.0 MAT-file, Platform: GLNXA64" + bytes(90), "MATLAB"),
    "new.mat": (b"\x89HDF\r\n\x1a\n" + bytes(90), "HDF5"),
    "old.mat": (bytes(90), "MATLAB"),
    "a.npy": (b"\x93NUMPY" + bytes(90), "NumPy"),
    "a.png": (b"\x89PNG\r\n\x1a\n" + bytes(90), "a picture (PNG)"),
    "a.jpg": (b"\xff\xd8\xff\xe0" + bytes(90), "a picture (JPEG)"),
    "no suffix": (b"\xff\xd8\xff\xe0" + bytes(90), "a picture (JPEG)"),
    "damaged.jpeg": (bytes(90), "a picture (JPEG)"),
}


@pytest.mark.parametrize("name", FOREIGN)
def test_e101_says_what_a_file_is_that_holds_no_text(name: str) -> None:
    data, kind = FOREIGN[name]
    with pytest.raises(InputError) as caught:
        read_task(name, data=data)
    assert caught.value.code == "E101"
    assert kind in str(caught.value.why)
    assert re.search("CSV|savetxt", str(caught.value.help))
    read_task(name, data=b"MATLAB\nx,y,angle_deg\n0,0,0\n1,1,10\n2,1,25\n")  # contents count


@pytest.mark.parametrize(("inside", "kind"), [("word/document.xml", "Word"), ("content.xml", "Op")])
def test_e101_says_what_an_archive_is(inside: str, kind: str) -> None:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        archive.writestr(inside, "<a/>")
    with pytest.raises(InputError, match=kind):
        read_task("a.docx", data=data.getvalue())


@pytest.mark.parametrize(
    ("header", "row"),
    [
        ("a,b,c", "{},{},{}"),
        ("Zeit;a;b;c;d", "9;{};{};{};7"),
        ("name,a,b,c", "p,{},{},{}"),
        ("y,a,b", "{1},{0},{2}"),
    ],
)
def test_e105_offers_columns_first_and_they_work(read: Read, header: str, row: str) -> None:
    lines = [row.format(*map(float, values)) for values in ((0, 0, 0), (1, 3, 10), (2, 1, 25))]
    text = "\n".join([header, *lines, ""])
    error = refused(read, text)
    assert error.code == "E105"
    option = re.match(r'pass --columns "?([^ "]+)"? if that is their order, or name', error.help)
    assert option
    assert read(text, columns=option[1]).poses.translation.tolist() == [[0, 0], [1, 3], [2, 1]]


def test_e105_for_a_header_in_other_words(read: Read) -> None:
    error = refused(read, "hor ver rot\n" + ROWS.replace(",", " "))
    assert "name the columns x, y and angle_deg (or angle_rad), with commas" in error.help
    assert triples(read("x,y,angle_deg\n" + ROWS)) == in_radians(TRIPLES)


@pytest.mark.parametrize("bad", ["nan", "1e400", "", "1_0", "ten"])
def test_e103_and_e104_either_way_out_works(read: Read, bad: str) -> None:
    text = CSV.replace("0.292", bad)
    error = refused(read, text)
    number = re.findall(r"such as (\S+) or (\S+), or delete the row", error.help)[0]
    for value in number:
        assert triples(read(CSV.replace("0.292", value)))[2][1] == float(value)
    deleted = CSV.replace("1e-05,0.292,49.9\n", "") + "1,2,3\n"
    assert triples(read(deleted))[2] == (1, 2, np.radians(3))


def test_e106_help(read: Read) -> None:
    error = refused(read, CSV + "1,2\n")
    assert error.help == "give 3 cells (x, y, angle_deg), or delete the row"
    assert read(CSV + "1,2,3\n").poses.shape == (4,)


@pytest.mark.parametrize("place", [0, 3])
def test_e107_renames_the_column_so_that_it_is_ignored(read: Read, place: int) -> None:
    rows = [["Part No", "x", "y", "angle_deg"], *(["7", *row.split(",")] for row in ROWS.split())]
    if place:
        rows = [[*row[1:], row[0]] for row in rows]
    text = "\n".join(",".join(row) for row in rows)
    error = refused(read, text)
    assert error.code == "E107"
    name = re.findall(r"name it (\S.*\") \(with", error.help)[0]
    assert triples(read(text.replace("Part No", name))) == in_radians(TRIPLES)


def test_e104_for_commas_is_cured_by_points(read: Read) -> None:
    text = "x;y;angle_deg\n1,234;2;3\n2;2;4\n3;2;5\n"
    assert (
        refused(read, text).help == "write every number with a decimal point, and none with a comma"
    )
    assert triples(read(text.replace(",", ".")))[0][0] == 1.234


def test_one_comma_that_cannot_part_thousands_proves_the_others(read: Read) -> None:
    task = read("x;y;angle_rad\n1,234;0,5;3\n2;2;4\n3;2;5\n")
    assert triples(task)[0] == (1.234, 0.5, 3)
    assert task.resolution == pytest.approx((0.0005, 0), abs=0)


def test_commas_and_points_are_refused_wherever_they_meet(
    read: Read, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pose_rows, "BLOCK", 1)
    for rows in ("1,25;2.5;3", "1,25;2;3\n4;2.5;3", "4;2.5;3\n1,250;2;3"):
        error = refused(read, "x;y;angle_deg\n0,5;2;3\n" + rows)
        assert (error.code, error.message) == (
            "E104",
            "a comma in a number can be read in two ways",
        )


@pytest.mark.parametrize("suffix", [".json", ".toml"])
def test_the_example_in_the_help_can_be_read(read: Read, suffix: str) -> None:
    help = refused(read, '{"a": 1}' if suffix == ".json" else "a = 1", suffix).help
    example = help.removeprefix("write ").replace("...", "[1, 2, 3], [4, 5, 6]")
    assert triples(read(example.replace(" above ", "\n"), suffix))[0] == (0.5, 2, np.radians(30))


def test_e101_offers_the_case_that_was_meant(tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.chdir(tmp_path)
    help = refusal(lambda: read_task("ge2012-exact")).help
    assert help == "write case:ge2012-exact"
    assert len(read_task(help.removeprefix("write ")).poses.angle) == 10


# Laws ---------------------------------------------------------------------------------------


def as_csv(rows: list[tuple[float, float, float]], separator: str, mark: str) -> str:
    lines = [separator.join(map(repr, row)).replace(".", mark) for row in rows]
    return "\n".join([separator.join(["x", "y", "angle_rad"]), *lines])


@pytest.mark.parametrize("block", [1, 7, 40, 1 << 20])
@pytest.mark.parametrize("dialect", ["plain", "commas", "named", "commented"])
def test_blocks_and_both_paths_give_the_same_task(
    read: Read, monkeypatch: pytest.MonkeyPatch, block: int, dialect: str
) -> None:
    monkeypatch.setattr(pose_rows, "BLOCK", block)
    rng = np.random.default_rng(1)
    scaled = rng.normal(size=(50, 3)) * 10.0 ** rng.integers(-9, 9, size=(50, 1))
    rows = [(float(x), float(y), float(angle)) for x, y, angle in scaled]
    text = as_csv(rows, ";", "," if dialect == "commas" else ".")
    if dialect == "named":
        lines = text.split("\n")
        text = "\n".join([lines[0] + ";name", *(f"{ln};n, {i}." for i, ln in enumerate(lines[1:]))])
    if dialect == "commented":
        text = text.replace("\n", "\n\n# note;1\n")
    task = read(text)
    assert np.array(triples(task)).tobytes() == np.array(rows).tobytes()
    assert task.names == (tuple(f"n, {i}." for i in range(50)) if dialect == "named" else None)
    most = max(-int(Decimal(repr(v)).as_tuple().exponent) for row in rows for v in row[:2])
    assert task.resolution[0] == pytest.approx(0.5 * 10.0**-most)


@pytest.mark.parametrize("block", [1, 13, 1 << 20])
def test_a_fault_behind_many_blocks_has_the_right_line(
    read: Read, monkeypatch: pytest.MonkeyPatch, block: int
) -> None:
    monkeypatch.setattr(pose_rows, "BLOCK", block)
    error = refused(read, "# top\n" + CSV + "\n" + ROWS * 30 + "# end\n1,2,x\n")
    assert error.message == "row 94 has text where a number belongs"
    assert place(error).endswith("poses.csv:98:5")
    mixed = "x;y;angle_deg\n" + "1.5;2;3\n" * 30 + "1;2,5;3\n"
    error = refused(read, mixed)
    assert place(error).endswith("poses.csv:32:3")


def test_a_hundred_thousand_rows(read: Read) -> None:
    rows = np.random.default_rng(0).normal(size=(100_000, 3)).tolist()
    task = read("x,y,angle_rad\n" + "".join(f"{x!r},{y!r},{a!r}\n" for x, y, a in rows))
    assert np.array(triples(task)).tobytes() == np.array(rows).tobytes()


def task_or_input_error(read: Read, content: bytes, suffix: str) -> None:
    try:
        outcome: Task | InputError = read(content, suffix)
    except InputError as error:
        outcome = error
    if isinstance(outcome, InputError):
        assert re.fullmatch(r"E1\d\d", outcome.code)
        assert outcome.where
        assert outcome.help
        assert str(outcome).encode()  # can be printed
    else:
        assert outcome.poses.shape[0] >= 2
        assert np.isfinite(outcome.poses.translation).all()


SUFFIXES = st.sampled_from([".csv", ".tsv", ".json", ".toml", ""])


@given(content=st.binary(max_size=200) | st.text(max_size=200).map(str.encode), suffix=SUFFIXES)
@settings(max_examples=share(300), deadline=None)
def test_random_bytes_give_a_task_or_an_input_error(
    read: Read, content: bytes, suffix: str
) -> None:
    task_or_input_error(read, content, suffix)


trees = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["poses", "task", "x", "y", "angle", "angle_deg", "name", "weight"]),
            inner,
        )
    ),
    max_leaves=12,
)


@given(tree=trees)
@settings(max_examples=share(300), deadline=None)
def test_any_json_gives_a_task_or_an_input_error(read: Read, tree: Any) -> None:
    task_or_input_error(read, json.dumps(tree).encode(), ".json")
    task_or_input_error(read, json.dumps({"poses": [tree] * 3}).encode(), ".json")


def test_a_csv_file_is_read_without_what_draws(tmp_path: Path) -> None:
    path = tmp_path / "poses.csv"
    path.write_text(CSV)
    code = (
        "import sys; from burmester.io.reading.poses import read_task; read_task(sys.argv[1]);"
        "print([m for m in ('scipy', 'matplotlib', 'rich') if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"
