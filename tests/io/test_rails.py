"""Rails and slots in TOML, JSON and options, in results and in the studio's documents."""

import json

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.regions import Segment
from burmester.io.reading.poses import read_task
from burmester.io.reading.specification_text import limits_from_options
from burmester.io.result import task_data
from burmester.live.document import document_of, task_file, task_of

POSES = "poses = [[0, 0, 0], [60, 8, 30], [130, 18, 60]]\nangle_unit = 'deg'\n"
RAIL = (
    "{ direction_deg = -30.5, tolerance_deg = 2, through = { segment = [[0, -20], [0, 20]] }, "
    "travel = { box = [[-20, -40], [400, 40]] } }"
)
OPTION = "travel:box:-20,-40:400,40 direction:-30.5±2 through:segment:0,-20:0,20"


def from_text(text, folder, name="task.toml"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return read_task(path)


def parts(rail):
    """What a rail says, as plain numbers."""
    given = (rail.through, rail.travel)
    regions = (None if each is None else each.corners().tolist() for each in given)
    return rail.direction_deg, rail.tolerance_deg, *regions


EXPECTED = (-30.5, 2.0, [[0, -20], [0, 20]], [[-20, -40], [400, -40], [400, 40], [-20, 40]])


@pytest.mark.parametrize("kind", ["rail", "slot"])
def test_a_rail_is_read_alike_from_toml_json_and_options(kind, tmp_path):
    toml = from_text(f"{POSES}[[limits]]\n{kind} = {RAIL}\n[[limits]]\nkinds = ['RR']\n", tmp_path)
    assert parts(getattr(toml.limits[0], kind)) == EXPECTED
    assert getattr(toml.limits[1], kind) is None
    tree = {"poses": [[0, 0, 0], [1, 2, 3]], "angle_unit": "deg"}
    tree["limits"] = task_data(toml)["limits"]
    again = from_text(json.dumps(tree), tmp_path, "task.json")
    assert parts(getattr(again.limits[0], kind)) == EXPECTED
    stated = limits_from_options(**{kind: [OPTION]}).limits()
    assert parts(getattr(stated[0], kind)) == EXPECTED
    second = limits_from_options(**{kind: ["any", OPTION]}).limits()[1]
    assert parts(getattr(second, kind)) == EXPECTED


def test_the_studio_s_document_keeps_it(tmp_path):
    task = from_text(f"{POSES}[limits]\nrail = {RAIL}\n", tmp_path)
    document = document_of(task)
    for again in (task_of(document), from_text(task_file(document), tmp_path, "again.toml")):
        assert parts(again.limits[0].rail) == EXPECTED


def test_what_a_dyad_with_a_rail_lacks_is_for_the_other():
    """Limits stated once, beside a rail or a slot stated once."""
    first, second = limits_from_options(
        fixed_pivot=["box:0,0:1,1"], moving_pivot=["2,3"], length=["1:5"], rail=["direction:0"]
    ).limits()
    assert first.allowed == {"PR"}
    assert first.fixed_pivot is None
    assert (first.moving_pivot.at == [2, 3]).all()
    assert second.rail is None
    assert second.moving_pivot is None  # a point is for one dyad
    assert second.length == (1, 5)
    assert second.fixed_pivot is not None
    first, second = limits_from_options(moving_pivot=["2,3"], slot=["direction:0"]).limits()
    assert first.moving_pivot is None
    assert (second.moving_pivot.at == [2, 3]).all()
    first, second = limits_from_options(rail=["direction:0"], slot=["direction:9"]).limits()
    assert (first.allowed, second.allowed) == ({"PR"}, {"RP"})
    first, second = limits_from_options(rail=["direction:0"], kinds=["RR"]).limits()
    assert (first.allowed, second.allowed) == ({"PR"}, {"RR"})


def test_a_travel_of_two_points_is_the_rail():
    (first, _) = limits_from_options(rail=["travel:segment:0,0:3,4"]).limits()
    assert isinstance(first.rail.travel, Segment)
    assert np.degrees(first.rail.heading[0]) == pytest.approx(53.130102)


@pytest.mark.parametrize(
    ("text", "code", "caret"),
    [
        ("direction:0 thru:1,1", "E131", "^^^^^^^^"),
        ("direction:0 direction:1", "E131", "^^^^^^^^^^^"),
        ("direction:0±x", "E131", "^"),
        ("direction:0 through:disc:0,0:1", "E131", "^^^^"),
        (" ", "E131", "^"),
        ("direction:0±95", "E137", "^"),
        ("through:line:0,0:1,1", "E137", "^"),
    ],
)
def test_what_does_not_fit_is_marked(text, code, caret):
    with pytest.raises(InputError) as caught:
        limits_from_options(rail=[text])
    assert caught.value.code == code
    assert caret in caught.value.where


@pytest.mark.parametrize(
    ("rail", "code"),
    [
        ("{ direction_deg = 'x' }", "E104"),
        ("{ direction = 0 }", "E107"),
        ("{ through = { point = [0] } }", "E106"),
        ("{ through = { line = [[0, 0], [1, 0]] } }", "E137"),
        ("{}", "E137"),
    ],
)
def test_what_does_not_fit_in_a_file(rail, code, tmp_path):
    with pytest.raises(InputError) as caught:
        from_text(f"{POSES}[limits]\nrail = {rail}\n", tmp_path)
    assert caught.value.code == code
    assert "task.toml:4" in caught.value.where
