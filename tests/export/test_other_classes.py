"""Six-bars of made-up classes in every face: whatever its links are called, and whichever is M."""

import csv
import json
from functools import cache
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest
from PIL import Image

from burmester import plot
from burmester.batch.answer_rows import solved_rows
from burmester.describe import six_bar_words
from burmester.export import Options, export
from burmester.export.parts.plates import assembly_of
from burmester.io import six_bar_file
from burmester.io.linkage_data import six_bar_data
from burmester.sixbar.six_bars import SixBarOptions
from burmester.synthesis.six_bars import synthesize_six_bars
from burmester.web.still import still
from tests.oracles.relabelled import renamed, seen_from_coupler
from tests.sixbar.tasks import TURNING, task

MAKERS = {"renamed": renamed, "three pivots": seen_from_coupler}
mujoco = pytest.importorskip("mujoco")
steered = pytest.importorskip("tests.oracles.simulation").steered


@cache
def made(name):
    given = task(TURNING, length_unit="mm")
    found = synthesize_six_bars(
        given, SixBarOptions(kind="Watt I", chains=400, most=1)
    ).six_bars.found[0]
    return MAKERS[name](found)


@pytest.fixture(params=MAKERS)
def chosen(request):
    return made(request.param)


def test_it_moves_as_the_six_bar_that_it_is(chosen):
    """The oracle itself: bars keep their lengths, ground and body their joints."""
    drive = np.append(chosen.along(9), chosen.drive)
    at, size = chosen.joints(drive), chosen.own.extent
    for bar, length in chosen.lengths.items():
        apart = np.linalg.norm(at[bar[1]] - at[bar[0]], axis=-1)
        assert apart == pytest.approx(np.full(len(apart), length), abs=1e-8 * size)
    arm = chosen.skeleton.arm(chosen.driver)
    way = (at[arm[1]] - at[arm[0]]) @ [1, 1j]
    assert np.abs(way / np.abs(way) - np.exp(1j * drive)).max() < 1e-8


def test_a_drawing_has_a_hole_at_each_joint(chosen, tmp_path):
    export(chosen, "dxf", tmp_path / "a.dxf", Options(pose=3))
    document = ezdxf.readfile(tmp_path / "a.dxf")
    at = {joint: places[2] for joint, places in chosen.joints(chosen.drive).items()}
    drawn = [
        (round(c.dxf.center.x, 6), round(c.dxf.center.y, 6))
        for c in document.blocks.get("ASSEMBLY").query("CIRCLE")
    ]
    wanted = [at[joint] for joints in chosen.skeleton.links.values() for joint in joints]
    assert np.array(sorted(drawn)) == pytest.approx(
        np.array(sorted(tuple(np.round(each, 6)) for each in wanted)), abs=1e-5
    )
    export(chosen, "svg", tmp_path / "a.svg", Options(pose=3))
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    style = next(each.text for each in root.iter() if each.tag.endswith("style"))
    assert all(f".{link} {{ stroke:" in style for link in assembly_of(chosen, Options()).moving)


def test_a_motor_takes_the_model_through_the_poses(chosen, tmp_path):
    export(chosen, "mjcf", tmp_path / "a.xml")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "a.xml"))
    assert (model.nv, model.neq) == (5, 2)
    steered(model, chosen.task.poses, chosen.own.extent / 1000, exact=1e-7, near=1e-4)


@pytest.mark.parametrize("name", ["urdf", "sdf", "openscad", "json", "pdf", "gif"])
def test_what_is_written_is_read_back_as_the_same(name, chosen, tmp_path):
    small = Options(seconds=0.4, frames_per_second=10, width_px=240)
    [path] = export(chosen, name, tmp_path / f"a.{name}", small)
    assert path.stat().st_size > 0


def test_the_table_of_its_motion(chosen, tmp_path):
    export(chosen, "csv", tmp_path / "a.csv")
    with open(tmp_path / "a.csv") as file:
        rows = list(csv.DictReader(file))
    at = chosen.joints(chosen.drive)
    for row in (each for each in rows if each["pose"]):
        pose = int(row["pose"]) - 1
        assert float(row["drive_deg"]) == pytest.approx(np.degrees(chosen.drive[pose]), abs=1e-6)
        for joint, places in at.items():
            there = [float(row[f"{joint}_{axis}"]) for axis in "xy"]
            assert there == pytest.approx(places[pose], abs=1e-6)


def test_its_file_makes_the_same_mechanism(chosen, monkeypatch):
    """A class makes a linkage of body and frames; what a person leaves out is as it was."""

    class Known:
        skeleton = chosen.skeleton

        @staticmethod
        def of(carries, frames):
            return carries, frames

    monkeypatch.setattr(six_bar_file, "KINDS", {"other": Known, chosen.type: Known})
    data = json.loads(json.dumps(six_bar_data(chosen)))
    assert six_bar_file.is_six_bar(data)
    carries, frames = six_bar_file.six_bar_of(data)
    assert carries == chosen.carries
    for link, joints in chosen.frames.items():
        for joint, at in joints.items():
            assert frames[link][joint] == pytest.approx(at, abs=1e-9)
    (row,) = solved_rows(
        {0: {"six_bars": {"found": [data]}, "outcome": {"code": "R370"}, "warnings": []}}
    ).to_pylist()
    (six_bar,) = row["six_bars"]
    told = {(each["link"], each["joint"]): (each["x"], each["y"]) for each in six_bar["joints"]}
    held = chosen.skeleton.held(chosen.carries)
    assert told == {
        (link, joint): pytest.approx(at)
        for link in held
        for joint, at in chosen.frames[link].items()
    }
    assert (dict(six_bar["lengths"]), six_bar["type"], six_bar["first_crank"]) == (
        pytest.approx(chosen.lengths),
        chosen.type,
        None,
    )


def test_its_words_build_it(chosen):
    rows = six_bar_words.dimension_rows(chosen)
    assert len(rows) == 6
    assert sum(text.count("(") for _, *own in rows for text in own) >= 6
    assert six_bar_words.driver_name(chosen) == chosen.skeleton.arm(chosen.driver)


def test_pictures_have_a_pin_at_each_joint(chosen, tmp_path):
    svg = ElementTree.fromstring(still(chosen, "one"))
    circles = [each for each in svg.iter() if each.tag.endswith("circle")]
    drawn = np.array([complex(float(c.get("cx")), -float(c.get("cy"))) for c in circles])
    joints = np.array([complex(*at[2]) for at in chosen.joints(chosen.drive).values()])
    scale = np.ptp(drawn.real) / np.ptp(joints.real)
    assert np.abs((drawn - drawn[0]) / scale - (joints - joints[0])).max() < 0.3 / scale
    figure = plot.linkage_figure(chosen, pose=1)
    figure.savefig(tmp_path / "a.png")
    with Image.open(tmp_path / "a.png") as image:
        assert min(image.size) > 100
    lines = (each for each in figure.axes[0].lines if each.get_marker() == "o")
    pins = {tuple(np.round(at, 6)) for each in lines for at in each.get_xydata()}
    at = [places[1] for places in chosen.joints(chosen.drive).values()]
    assert {tuple(np.round(each, 6)) for each in at} <= pins
