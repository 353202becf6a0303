"""The map of a family as a file: what it holds is what was judged, in the form of its schema."""

import json
from importlib import resources

import jsonschema
import numpy as np
import pytest

from burmester import PR, Linkage, Task
from burmester.dyads.three_poses import dyad_with_fixed_pivot
from burmester.families.family_map import curve_map, plane_map
from burmester.io.cases import load
from burmester.io.family_map_data import family_map_data
from burmester.io.result import json_line

SCHEMA = json.loads(
    resources.files("burmester").joinpath("io/family_map.schema.json").read_text(encoding="utf-8")
)


def task(count, **more):
    return Task.from_rows(load("ge2012-exact")["poses"][:count], angle_unit="deg", **more)


def written(found, recommended=None):
    """The file as another program reads it."""
    data = json.loads(json_line(family_map_data(found, recommended)))
    jsonschema.Draft202012Validator(SCHEMA).validate(data)
    return data


def same(listed, values):
    assert np.array_equal(np.array(listed, dtype=float), values, equal_nan=True)


def test_the_curve_of_four_poses_is_written_whole():
    found = curve_map(task(4, length_unit="mm"), samples=50)
    data = written(found, Linkage(found.first[7], found.first[31]))
    assert data["kind"] == "curve"
    assert data["recommended"] == [7, 31]
    assert data["length_unit"] == "mm"
    same(data["curve"]["fixed_pivot"], found.first.fixed_pivot)
    same(data["curve"]["moving_pivot"], found.first.moving_pivot)
    same(data["curve"]["position"], found.position)
    same(data["class"], found.verdicts.classes)
    same(data["driver"], found.verdicts.driver)
    same(data["transmission_deg"], np.degrees(found.verdicts.transmission))
    starts = [word.partition(" ")[0].strip(",") for word in data["class_words"]]
    assert starts == ["works", "works", "meets", "order", "branch", "circuit", "no"]
    # What is written is enough to meet the poses.
    rows = np.array([[p["x"], p["y"], np.radians(p["angle_deg"])] for p in data["poses"]])
    d, turn = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
    c, m = (np.array(data["curve"][name]) @ [1, 1j] for name in ("fixed_pivot", "moving_pivot"))
    arms = np.abs(d + turn * m[:, None] - c[:, None])
    assert arms == pytest.approx(np.repeat(np.array(data["curve"]["radius"])[:, None], 4, axis=1))


def test_a_linkage_that_is_not_on_the_curve_has_no_place():
    found = curve_map(task(4), samples=50)
    slider = PR(0.3, 0.0, [0.0, 0.0])
    assert written(found)["recommended"] is None
    assert written(found, Linkage(found.first[3], slider))["recommended"] is None


@pytest.mark.parametrize("kind", ["RR", "PR"])
def test_the_plane_of_three_poses_is_written_with_the_dyad_that_was_chosen(kind):
    own = task(3)
    chosen = dyad_with_fixed_pivot(own.poses, [-2.0, 1.0])
    if kind == "PR":
        chosen = PR(0.4, 0.2, [1.0, -0.3])  # what it says of the poses is not asked here
    found = plane_map(own, chosen, [-4, -3], [2, 3], columns=12, rows=9)
    data = written(found)
    assert data["kind"] == "plane"
    assert data["chosen"]["kind"] == kind
    if kind == "RR":
        assert data["chosen"]["fixed_pivot"] == pytest.approx([-2.0, 1.0])
    else:
        assert data["chosen"]["line"] == {
            "normal_deg": pytest.approx(np.degrees(0.4)),
            "offset": 0.2,
        }
    same(data["plane"]["fixed_pivot"], found.second.fixed_pivot)
    assert data["plane"]["fixed_pivot"][0][0] == [-4, -3]
    assert data["plane"]["fixed_pivot"][8][11] == [2, 3]
    same(data["class"], found.verdicts.classes)
    same(data["transmission_deg"], np.degrees(found.verdicts.transmission))
