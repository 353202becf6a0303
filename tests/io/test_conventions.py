"""Files in another convention, and columns of cosine and sine: every number by hand."""

import json

import numpy as np
import pytest

from burmester import diagnose, read_task
from burmester.dyads.local_minima import best_dyads
from burmester.errors import InputError
from tests.oracles.conventions import crank_rocker, table, written

ROWS = "x,y,angle_deg\n1,2,30\n-3,5,-40\n4,4,100\n"
# test-mfb of four-bar-rs: x, y, and the cosine and the sine of the body's angle.
MFB = """18.8,12.1,0.62161,-0.78333
13.3,18.1,1.00000,0.00000
6.3,19.8,0.76484,0.64422
-0.4,17.1,0.07074,0.99750
-2.7,10.3,-0.94222,0.33499
-1.1,6.0,-0.66628,-0.74571
0.2,1.7,-0.41615,-0.90930
3.4,-2.2,-0.32329,-0.94630
7.8,-4.9,-0.50485,-0.86321
"""


def read(text, name="poses.csv", **further):
    return read_task(name, data=text.encode(), **further)


def refused(text, **further):
    with pytest.raises(InputError) as error:
        read(text, **further)
    return error.value


@pytest.mark.parametrize(
    ("convention", "first"),
    [
        ("clockwise", (1, 2, -30)),
        ("y-down", (1, -2, 30)),
        ("swap-xy", (2, 1, 30)),
        ("radians", (1, 2, np.degrees(30))),
        ("degrees", (1, 2, 30)),
        ("y-down, clockwise", (1, -2, -30)),
        ("swap-xy,y-down", (-2, 1, 30)),
    ],
)
def test_each_convention_changes_what_it_says(convention, first):
    """swap-xy comes last: the x that is exchanged for y down is -y."""
    poses = read(ROWS, convention=convention).poses
    assert np.allclose([*poses.translation[0], np.degrees(poses.angle[0])], first)


def test_of_json_as_well():
    text = json.dumps({"angle_unit": "deg", "poses": [[1, 2, 30], [0, 1, 5]]})
    poses = read(text, "poses.json", convention="clockwise").poses
    assert np.allclose(np.degrees(poses.angle), [-30, -5])


def test_the_task_says_how_it_was_read():
    assert read(ROWS, convention="clockwise").read_as.endswith("; angles negated")


def test_radians_are_known_by_their_digits():
    """Half of the last digit is as many radians."""
    text = "x,y,angle_deg\n1.00000,2.00000,0.30000\n3,4,0.5\n"
    assert read(text, convention="radians").resolution[1] == pytest.approx(5e-6)
    assert read(text).resolution[1] == pytest.approx(np.radians(5e-6))


@pytest.mark.parametrize("name", ["ydown", "", "clockwise,clockwise", "radians,degrees"])
def test_a_convention_that_is_none(name):
    assert refused(ROWS, convention=name or ",").code == "E115"


def test_points_alone_have_no_convention():
    assert refused("px,py,qx,qy\n0,0,5,0\n3,1,7,4\n4,3,7,7\n", convention="y-down").code == "E115"


def test_cosine_and_sine_are_read_as_the_angle():
    task = read("x,y,cos,sin\n" + MFB)
    right = [-51.5662, 0, 40.10705, 85.94367, 160.42818, -131.78029, -114.59156, -108.86198]
    assert np.allclose(np.degrees(task.poses.angle)[:8], right, atol=1e-3)
    # Five decimals of both are known to half of the last one, in radians.
    assert task.resolution == (0.0, pytest.approx(5e-6))
    # The published links are 9.832 and 6.972 long; these were found without this package.
    best = best_dyads(task.poses).dyads
    assert np.allclose(best.fixed_pivot[:2], [[6.31, 7.08], [1.16, 11.42]], atol=0.05)
    assert np.allclose(best.radius[:2], [9.96, 7.14], atol=0.05)


def test_two_decimals_of_a_direction_are_enough():
    rows = "x,y,cos,sin\n0,0,0.71,0.71\n3,1,0.87,0.5\n4,3,0,1\n"
    assert np.allclose(np.degrees(read(rows).poses.angle), [45, 30, 90], atol=0.2)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("x,y,cos,sin\n0,0,1,0\n3,1,0.7,0.2\n4,3,0,1\n", "E116"),
        ("x,y,cos,sin\n0,0,0,0\n3,1,1,0\n4,3,0,1\n", "E116"),
        ("x,y,cos\n0,0,1\n3,1,0.8\n4,3,0\n", "E105"),
        ("x,y,cos,sin,angle_deg\n0,0,1,0,0\n3,1,0,1,90\n", "E108"),
    ],
)
def test_directions_that_are_none(text, code):
    error = refused(text)
    assert error.code == code
    if code == "E116":
        assert ":2:" in error.where or ":3:" in error.where


def test_a_text_without_a_header_is_not_guessed_at():
    """Columns that may be cosine and sine are named; of others is said what is needed."""
    said = refused(MFB)
    assert (said.code, "`x,y,cos,sin`" in said.help) == ("E105", True)
    assert "columns 3 and 4" in said.why
    other = refused(MFB.replace("0.62161", "0.22161"))
    assert "`x,y" not in other.help
    assert refused("1,2,30\n3,4,50\n").help.startswith("if the columns are")
    wide = refused(MFB.replace("\n", ",7\n"))
    assert "`x,y,cos,sin,#5`" in wide.help


@pytest.mark.parametrize(("header", "told"), [("#sin", True), ("frame", True)])
def test_an_angle_that_is_a_cosine_is_told(header, told):
    """Only beside a column that completes it: other numbers up to 1 are angles."""
    text = f"x,y,angle_deg,{header}\n" + MFB
    diagnosis = diagnose(read(text))
    assert ("W243" in [note.code for note in diagnosis.task.notes]) == told
    assert diagnosis.sound != told
    apart = text.replace("-0.78333", "-0.58333")
    assert "W243" not in [note.code for note in read(apart).notes]


def test_directions_in_a_table_of_parquet(tmp_path):
    pa, parquet = map(pytest.importorskip, ("pyarrow", "pyarrow.parquet"))
    rows = written(crank_rocker(), "directions")
    columns = dict(zip(("x", "y", "cos", "sin"), map(list, zip(*rows, strict=True)), strict=True))
    file = tmp_path / "poses.parquet"
    parquet.write_table(pa.table(columns), file)
    text = table(rows, "x,y,cos,sin")
    assert np.allclose(read_task(file).poses.angle, read(text).poses.angle)
    assert read_task(file).resolution == read(text).resolution
    columns["sin"][3] = 0.1
    parquet.write_table(pa.table(columns), file)
    with pytest.raises(InputError, match="row 4"):
        read_task(file)
