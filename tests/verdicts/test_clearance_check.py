"""Clearances of the linkages of an answer: against sweeps by the witness, in words and in JSON."""

from __future__ import annotations

import copy
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from burmester import KeepOut, Surroundings, Task, box, synthesize
from burmester.describe.sentences import clearance_note
from burmester.fourbar.dyad import RP
from burmester.io import linkage_data
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from burmester.synthesis.motion_generation import synthesize as whole_synthesis
from burmester.verdicts.limit_check import too_close
from tests.oracles.clearance_sweep import Moved, sweep

SCHEMA = Path(linkage_data.__file__).parent / "synthesis.schema.json"
# A four-bar driven by joints, its positions moved by up to 0.01 mm (template `task`).
ROWS = [
    (50.00, -11.00, 0),
    (47.80, 4.61, 15),
    (50.70, 14.71, 30),
    (60.70, 25.93, 48),
    (79.25, 34.44, 65),
    (99.63, 35.57, 80),
]
BODY = box([-10, -10], [90, 10])
BUMPER = box([160, -20], [200, 60])
WIDTH, MARGIN = 6.0, 2.0


@pytest.fixture(scope="module")
def found():
    regions = (KeepOut(BUMPER, "bumper"), box([-40, 80], [0, 130]))
    around = Surroundings(regions, link_width=WIDTH, margin=MARGIN)
    task = Task.from_rows(ROWS, angle_unit="deg", length_unit="mm", body=BODY, surroundings=around)
    return whole_synthesis(task)


def swept(found, regions):
    """The least distance between the poses of a linkage, driven by the witness."""
    led, inputs = found.driver_first, found.driven.inputs
    drive = np.linspace(inputs[0], inputs[-1], 8001)
    start = found.error.places[0]
    both = [Moved(led.first, led.second, drive, side) for side in (0, 1)]
    moved = min(both, key=lambda m: abs(m.d[0] - complex(*start.translation)))
    assert abs(moved.d[0] - complex(*start.translation)) < 1e-3
    return float(sweep(moved, BODY.vertices, [each.vertices for each in regions], WIDTH).min())


def test_the_clearance_of_each_linkage_is_that_of_a_sweep(found):
    regions = [each.polygon for each in found.task.surroundings.keep_out]
    told, close = 0, 0
    for each in found.linkages:
        if each.clearance is None:
            assert each.defects
            continue
        if isinstance(each.driver_first.first, RP):
            continue  # which the witness drives by another coordinate
        least = swept(each, regions)
        assert each.clearance.least == pytest.approx(least, abs=0.02)
        violated = [why for why in each.violations if why.kind == "clearance"]
        assert bool(violated) == (least < MARGIN)
        assert not (violated and each.usable)
        told += 1
        close += bool(violated)
    assert told >= 4
    assert 0 < close < told


def test_it_is_said_what_touches_what_between_which_poses(found):
    said = [why.message for each in found.linkages for why in each.violations]
    pattern = (
        r"the (driver|follower|coupler|body) touches ('bumper'|region 2) "
        r"between poses \d and \d, with the body at \(\S+, \S+\) and \S+°"
    )
    assert any(re.fullmatch(pattern, each) for each in said)
    best = found.usable[0]
    assert clearance_note(found, best).startswith("Clearance: ")
    assert best.clearance.part in clearance_note(found, best)


def test_a_margin_that_is_not_kept_is_told_with_both_lengths(found):
    best = found.usable[0]
    near = replace(best.clearance, least=1.2, poses=(2, 3), part="the driver")
    (violation,) = too_close(near, found.problem)
    assert violation.kind == "clearance"
    assert violation.message.startswith("the driver comes within 1.2 mm of")
    assert " between poses 3 and 4, with the body at (" in violation.message
    assert violation.message.endswith("; a margin of 2 mm is asked for")
    assert too_close(replace(near, least=MARGIN), found.problem) == ()
    assert too_close(None, found.problem) == ()


def read_back(data, folder):
    path = folder / "result.json"
    path.write_text(json.dumps(data))
    return read_result(path).synthesis


def test_it_is_in_the_json_and_read_back(found, tmp_path):
    data = synthesis_data(found)
    schema = json.loads(SCHEMA.read_text())
    Draft202012Validator(schema).validate(data)
    one = data["linkages"][0]["clearance"]
    best = found.linkages[0].clearance
    assert one["least"] == best.least
    assert one["poses"] == [pose + 1 for pose in best.poses]
    assert one["obstacle"] in ("'bumper'", "region 2")
    saved = read_back(data, tmp_path)
    assert saved.task.surroundings.names == found.task.surroundings.names
    assert saved.task.surroundings.link_width == WIDTH
    assert [each.usable for each in saved.linkages] == [each.usable for each in found.linkages]


@pytest.mark.parametrize(
    "change",
    [
        lambda data, one: one.update(least=one["least"] + 5, error=10.0),
        lambda data, one: one["place"].update(x=one["place"]["x"] + 3),
        lambda data, one: one.update(obstacle="'wall'", poses=[1, 7]),
        lambda data, one: data["linkages"][0].pop("clearance"),
    ],
)
def test_what_a_file_says_of_a_clearance_is_not_read(found, tmp_path, change):
    data = copy.deepcopy(synthesis_data(found))
    change(data, data["linkages"][0]["clearance"])
    read = synthesis_data(read_back(data, tmp_path))
    assert (
        read["linkages"] == synthesis_data(read_back(synthesis_data(found), tmp_path))["linkages"]
    )


def test_other_surroundings_are_another_task(found, tmp_path):
    data = copy.deepcopy(synthesis_data(found))
    data["task"]["surroundings"]["link_width"] *= 20
    read = read_back(data, tmp_path)
    assert not read.linkages[0].usable
    (told,) = [each for each in read.warnings if each.code == "W244"]
    assert "L1 is not usable (" in told.message


def test_python_has_it_too():
    around = Surroundings(KeepOut(BUMPER, "bumper"), link_width=WIDTH)
    task = Task.from_rows(ROWS, angle_unit="deg", body=BODY, surroundings=around)
    assert synthesize(task).best.clearance.obstacle == "'bumper'"
