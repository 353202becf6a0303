"""Task files to start from: they read, they solve, and what their comments say is so."""

from __future__ import annotations

import functools
import math
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from burmester import synthesize
from burmester.cli.new import new
from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.io import templates
from burmester.io.reading.poses import read_task
from burmester.io.reading.specification import REQUIREMENTS
from burmester.requirements.loads import OF_LOADS
from burmester.tasks.length_per_radian import default_length_per_radian
from tests.oracles import witness
from tests.oracles.drawings import dxf, svg

TRADES = (
    "folding-table",
    "gripper",
    "landing-gear",
    "lid-hinge",
    "prosthetic-knee",
    "tailgate",
)
LOADED = ("bed-backrest", "bonnet", "cabinet-flap", "sprung-lid", "wall-bed")  # see tests/loads
FEW = (  # of few poses
    "chest-lid",
    "derailleur",
    "monitor-arm",
    "robot-intake",
    "tilting-window",
    *LOADED,
)
RAILS = ("drawer", "garage-door", "window-stay")  # of few poses, with a slider: see test_rails
FUNCTIONS = ("log-generator", "sine-generator")  # tasks of functions, see test_function_files
SIX_BARS = ("window-opener",)  # which no four-bar does: see tests/sixbar/test_template.py
PATHS = ("straight-line", "walking-beam", "walking-leg")  # curves to trace
NAMES = tuple(sorted((*TRADES, *FEW, *RAILS, *FUNCTIONS, *SIX_BARS, *PATHS)))
ALL = (*TRADES, "task")
BLOCK = re.compile(r"(?m)^(?:#[^ \n].*\n)+")
PAIR = r"\((-?\d+), (-?\d+)\)"


@functools.cache
def solved(name):
    """The task of a template, as its file is read, and what comes of it."""
    task = read(templates.text(name))
    return task, synthesize(task)


def read(text):
    """A task by way of a file: `read_task` takes no text."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "task.toml")
        path.write_text(text, encoding="utf-8")
        return read_task(path)


def flat(name):
    """The comments of a template in one line."""
    return re.sub(r"\n#? ?", " ", templates.text(name))


def said_linkage(name, poses):
    """The four-bar that the comments name, as long as its links are at the first pose."""
    found = re.search(
        f"fixed pivots {PAIR} and {PAIR} in F and moving pivots {PAIR} and {PAIR}", flat(name)
    )
    c1, c2, m1, m2 = np.array(found.groups(), dtype=float).reshape(4, 2)
    x, y, angle = *poses.translation[0], poses.angle[0]
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    links = [
        RR(fixed, moving, float(np.hypot(*(turn @ moving + (x, y) - fixed))))
        for fixed, moving in ((c1, m1), (c2, m2))
    ]
    return Linkage(*links)


def on_the_way(linkage, poses, count=400):
    """Body places (x + iy, angle) of the linkage, from the first pose's angle to the last one's.

    Two circles about the fixed pivots, moved by the moving ones, meet in the body's origin.
    """
    angle = np.linspace(poses.angle[0], poses.angle[-1], count)
    fixed, moving, radius = (
        [getattr(dyad, key) for dyad in (linkage.first, linkage.second)]
        for key in ("fixed_pivot", "moving_pivot", "radius")
    )
    centre = [
        complex(*c) - np.exp(1j * angle) * complex(*m) for c, m in zip(fixed, moving, strict=True)
    ]
    between = centre[1] - centre[0]
    far = abs(between)
    along = (far**2 + radius[0] ** 2 - radius[1] ** 2) / (2 * far)
    across = np.sqrt(radius[0] ** 2 - along**2)  # nan, with a warning, where they do not meet
    both = [centre[0] + between / far * (along + side * across) for side in (1j, -1j)]
    first = complex(*poses.translation[0])
    return min(both, key=lambda place: abs(place[0] - first)), angle


def least_transmission(linkage, poses):
    """For the second link driven by the first, and the other way round, in degrees."""
    place, angle = on_the_way(linkage, poses)
    pins = [
        place + np.exp(1j * angle) * complex(*d.moving_pivot)
        for d in (linkage.first, linkage.second)
    ]
    out = []
    for k, dyad in ((1, linkage.second), (0, linkage.first)):
        link, coupler = pins[k] - complex(*dyad.fixed_pivot), pins[k] - pins[1 - k]
        sine = (np.conj(link) * coupler).imag / abs(link) / abs(coupler)
        turned_over = np.ptp(np.sign(sine)) > 0
        out.append(0.0 if turned_over else math.degrees(np.arcsin(abs(sine)).min()))
    return out


def test_names():
    assert templates.names() == NAMES


def test_the_studio_takes_templates_of_poses():
    assert templates.of_poses() == tuple(sorted((*TRADES, *FEW, *RAILS, *SIX_BARS)))


@pytest.mark.parametrize("name", PATHS)
def test_what_is_recommended_traces_the_curve(name):
    """Its pivots keep the limits, and driven to each place it is there, within the tolerance."""
    task, found = solved(name)
    best = found.linkages[0]
    assert best.usable
    for dyad in best.dyads:
        assert task.limits[0].fixed_pivot.signed_distance(dyad.dyad.fixed_pivot) < 1e-6
    at = best.error.places
    assert (
        np.abs(at.translation - task.poses.translation) <= task.tolerances.position + 1e-9
    ).all()
    for (x, y), angle in zip(at.translation, at.angle, strict=True):
        assert witness.missed(best.driver_first, (x, y, angle)) < 1e-6
    assert math.degrees(best.driven.least_over_range) > task.requirements.transmission_deg


@pytest.mark.parametrize("name", [*ALL, *FEW, *RAILS])
def test_a_template_says_that_it_is_constructed(name):
    text = templates.text(name)
    assert "\n# Constructed for burmester; not taken from a product" in text
    assert max(map(len, text.splitlines())) <= 100
    assert text.isascii()
    for part in ("length_unit", "angle_unit", "The frame F", "x and y of its origin", "clockwise"):
        assert part in text or (name == "task" and part == "The frame F")


@pytest.mark.parametrize("name", ALL)
def test_the_linkage_that_its_numbers_come_from(name):
    """As the comments have it: driven by joints, it is as near as they say, and not exact."""
    task, _ = solved(name)
    moved, written = re.search(r"up to (0\.\d+) mm and written to (0\.\d+) mm", flat(name)).groups()
    linkage = said_linkage(name, task.poses)
    misses = witness.misses(linkage, task.poses, length=100.0)
    allowed = math.sqrt(2) * (float(moved) + float(written) / 2)
    assert misses.max() < allowed
    assert misses.max() > float(written) / 10
    assert task.length_unit == "mm"
    assert max(least_transmission(linkage, task.poses)) > 45


@pytest.mark.parametrize("name", ALL)
def test_the_first_line_and_the_poses(name):
    task, _ = solved(name)
    count = 5 if name == "folding-table" else range(6, 11)
    assert task.poses.shape[0] in ([count] if name == "folding-table" else count)
    degrees = np.degrees(task.poses.angle)
    steps = np.diff(degrees)
    assert (np.sign(steps) == np.sign(steps[0])).all()
    if name != "task":
        told = float(re.search(r"by (\d+) degrees", templates.summary(name))[1])
        assert abs(degrees[-1] - degrees[0]) == pytest.approx(told)
        assert ("angles are negative" in flat(name)) == (degrees[-1] < 0)
        assert (task.poses.translation[0] == 0).all()  # M lies on F at first
        assert degrees[0] == 0


@pytest.mark.parametrize("name", ALL)
def test_it_is_solved(name):
    """Exit code 0: a linkage that works, and an outside witness agrees on what it does."""
    task, synthesis = solved(name)
    assert synthesis.determined
    best = synthesis.usable[0]
    assert best.determined
    assert not [each for each in synthesis.warnings if each.code != "W209"]
    misses = witness.misses(best.linkage, task.poses, synthesis.length_per_radian)
    ours = np.hypot(best.error.position, synthesis.length_per_radian * best.error.angle)
    assert misses == pytest.approx(ours, abs=1e-5 * synthesis.length)
    assert misses.max() < 0.02 * synthesis.length
    driven = least_transmission(best.linkage, task.poses)
    assert driven[best.preferred_driver == "second"] > 40


@pytest.mark.parametrize("name", TRADES)
def test_it_is_as_its_file_asks(name):
    task, synthesis = solved(name)
    best, tree = synthesis.usable[0], tomllib.loads(templates.text(name))
    marked = [isinstance(pose, dict) and pose.get("exact", False) for pose in tree["poses"]]
    misses = witness.misses(best.linkage, task.poses, synthesis.length_per_radian)
    assert (misses[marked] < 1e-6 * synthesis.length).all()
    limits = tree.get("limits", {})
    tables = limits if isinstance(limits, list) else [limits, limits]
    dyads = best.linkage.first, best.linkage.second
    for dyad, table in zip(dyads, tables, strict=True):
        for key in ("fixed_pivot", "moving_pivot"):
            region, pivot = table.get(key, {}), getattr(dyad, key)
            if "box" in region:
                low, high = np.array(region["box"])
                assert (low - 1e-9 <= pivot).all()
                assert (pivot <= high + 1e-9).all()
            if "point" in region:
                assert pivot == pytest.approx(region["point"])
        assert not ("kinds" in table and type(dyad).__name__ not in table["kinds"])
    asked = tree["requirements"]
    pins = [dyad.fixed_pivot for dyad in dyads], [dyad.moving_pivot for dyad in dyads]
    links = [dyad.radius for dyad in dyads] + [np.hypot(*(a - b)) for a, b in pins]
    assert max(links) <= asked.get("link_ratio", math.inf) * min(links)
    assert asked.get("driver", best.preferred_driver) == best.preferred_driver


@pytest.mark.parametrize("name", TRADES)
def test_no_link_turns_needlessly_far(name):
    """A link that turns by half a turn or more needs room on all sides, and no strut follows it."""
    task, synthesis = solved(name)
    best = synthesis.usable[0].linkage
    place, angle = on_the_way(best, task.poses)
    turned = [
        np.degrees(np.ptp(np.unwrap(np.angle(pin - complex(*dyad.fixed_pivot)))))
        for dyad in (best.first, best.second)
        for pin in [place + np.exp(1j * angle) * complex(*dyad.moving_pivot)]
    ]
    assert max(turned) < 140, turned


def test_the_knee_turns_about_the_point_it_names():
    """The lines through its links meet there, above the joint and behind it."""
    task, synthesis = solved("prosthetic-knee")
    x, y = map(float, re.search(rf"about the point {PAIR}", flat("prosthetic-knee")).groups())
    for linkage in (said_linkage("prosthetic-knee", task.poses), synthesis.usable[0].linkage):
        normals, offsets = [], []
        for dyad in (linkage.first, linkage.second):
            way = dyad.moving_pivot - dyad.fixed_pivot
            normals.append((-way[1], way[0]))
            offsets.append(np.dot(normals[-1], dyad.fixed_pivot))
        assert np.linalg.solve(normals, offsets) == pytest.approx([x, y], abs=3)
    assert y > 40
    assert x < 0


@pytest.mark.parametrize(
    ("name", "room"),
    [
        ("lid-hinge", np.maximum),  # beside the rear wall, or above it
        ("tailgate", np.maximum),  # behind the roof, or above it
        ("folding-table", lambda x, y: -y),  # below the table top, which it touches at first
    ],
)
def test_the_body_passes_what_its_file_names(name, room):
    task, synthesis = solved(name)
    place, angle = on_the_way(synthesis.usable[0].linkage, task.poses)
    z = task.body.vertices @ [1, 1j]
    edges = np.concatenate([z + share * (np.roll(z, -1) - z) for share in np.linspace(0, 1, 40)])
    at = place[:, None] + np.exp(1j * angle)[:, None] * edges
    least = room(at.real, at.imag).min()
    assert least > -1e-6
    assert (least > 4) == (name != "folding-table")


def blocks():
    """What may be uncommented in the file with every key, by its first line."""
    return {found[0].split("\n")[0][1:]: found for found in BLOCK.finditer(templates.text())}


def uncommented(start):
    """The file with that block in use, in place of the poses where it has others."""
    text, found = templates.text(), blocks()[start]
    body = re.sub("(?m)^#", "", found[0])
    text = text[: found.start()] + body + text[found.end() :]
    others = "poses = [" in found[0]
    return re.sub(r"(?ms)^poses = \[ #.*?^\]\n", "", text) if others else text


def test_every_block_is_tried_below():
    starts = [
        "{ x = 55.20",
        "poses = [",
        "tolerance",
        "body = [[",
        "body = {",
        "pose_sigma",
        "[[keep_out]]",
    ]
    starts += [
        "[surroundings]",
        "[limits]",
        "[[limits]]",
        "[[limits]] #",
        "[requirements]",
        "[loads]",
    ]
    assert [start.startswith(each) for start, each in zip(blocks(), starts, strict=True)] == [
        True
    ] * 13
    keys = ("weight", "name", "exact", "tolerance", "free", "axes")
    keys += ("fixed_pivot", "moving_pivot", "length", "kinds", *REQUIREMENTS)
    keys += ("direction_deg", "tolerance_deg", "through", "travel")
    assert "#[limits.rail]\n" in templates.text()
    for key in keys:
        assert re.search(rf"\b{key} = ", templates.text()), key


def test_blocks_of_the_poses():
    base = read(templates.text())
    (named,) = (start for start in blocks() if "half open" in start)
    more = read(uncommented(named))
    assert more.poses.shape == (7,)
    assert more.names[3] == "half open"
    assert more.weights[3] == 2
    assert more.exact[3]
    kept = np.arange(7) != 3
    assert (more.poses.translation[kept] == base.poses.translation).all()
    points = read(uncommented("poses = ["))
    assert (points.poses.translation == base.poses.translation).all()
    assert points.poses.angle == pytest.approx(base.poses.angle, abs=math.radians(0.01))
    for pose in tomllib.loads(uncommented("poses = ["))["poses"]:
        assert math.dist(pose["p"], pose["q"]) == pytest.approx(60, abs=0.01)
    (body,) = (start for start in blocks() if start.startswith("body = [["))
    # A bar of 100 by 20 about (40, 0).
    gyration = math.sqrt((100**2 + 20**2) / 12 + 40**2)
    assert default_length_per_radian(read(uncommented(body))) == pytest.approx(gyration)
    (sigma,) = (start for start in blocks() if start.startswith("pose_sigma"))
    resolution = read(uncommented(sigma)).resolution
    assert resolution == pytest.approx((math.sqrt(3) * 0.01, math.sqrt(3) * math.radians(0.01)))


def test_blocks_of_outlines_and_surroundings(tmp_path):
    starts = ("body = {", "[[keep_out]]", "[surroundings]")
    (tmp_path / "lid.dxf").write_bytes(
        dxf(lambda _, space: space.add_circle((5, 5), 4, dxfattribs={"layer": "OUTLINE"}))
    )
    (tmp_path / "wall.svg").write_bytes(svg('<rect id="wall" y="90" width="9" height="9"/>'))
    texts = [uncommented(next(s for s in blocks() if s.startswith(start))) for start in starts]
    read_texts = []
    for text in texts:
        (tmp_path / "task.toml").write_text(text)
        read_texts.append(read_task(tmp_path / "task.toml"))
    drawn, kept, around = read_texts
    assert np.abs(drawn.body.vertices - 5).max() == pytest.approx(4, rel=1e-3)
    assert kept.surroundings.names == ("'bumper'", "region 2")
    given = around.surroundings
    assert (given.link_width, given.margin, given.body_in_plane) == (8, 2, False)


def test_the_block_of_tolerances():
    base = read(templates.text())
    (start,) = (start for start in blocks() if start.startswith("tolerance"))
    task = read(uncommented(start))
    degree, inf = math.radians(1), math.inf
    assert task.tolerances.bounds.tolist() == [
        [0.1, 0.5, degree],
        [0.3, 0.3, inf],
        [0.3, 0.3, degree],
        [0, 0, 0],
        [0.3, inf, degree],
        [0.3, 0.3, degree],
    ]
    assert task.tolerances.axes == ("body", *["fixed"] * 5)
    stated = np.array([True, True, True, True, False, True])
    assert (task.poses.translation[stated] == base.poses.translation[stated]).all()
    assert task.poses.translation[4, 1] == pytest.approx((25.93 + 35.57) / 2)


def test_blocks_of_limits_and_requirements():
    one, two = (read(uncommented(start)).limits for start in ("[limits]", "[[limits]]"))
    assert (len(one), len(two)) == (1, 2)
    assert (one[0].length, one[0].kinds) == ((20, 100), {"RR", "PR"})
    assert two[1].kinds == {"RR"}
    slider, link = read(uncommented("[[limits]] # the slider")).limits
    assert (slider.allowed, link.allowed) == ({"PR"}, {"RR"})
    assert (slider.rail.direction_deg, slider.rail.tolerance_deg) == (30, 30)
    asked = read(uncommented("[requirements]")).requirements
    assert math.degrees(asked.transmission) == pytest.approx(40)
    assert (asked.link_ratio, asked.within, asked.driver) == (5, 0.5, "any")
    assert "triple-rocker" in asked.types
    assert not asked.any_order


def test_the_block_of_loads():
    task = read(uncommented("[loads]"))
    assert task.loads.body.mass_kg == 4
    assert task.loads.links.density == 7850
    (spring,) = task.loads.springs
    assert (spring.kind, spring["free_length"]) == ("extension", 20)
    assert task.loads.drive.profile == "3-4-5"
    asked = task.requirements.bounds
    assert {each.name for each in asked} == {each.name for each in OF_LOADS}


def invoke(*arguments):
    return CliRunner().invoke(new, arguments, standalone_mode=False, catch_exceptions=False)


@pytest.mark.parametrize("name", [None, "lid-hinge"])
def test_the_command_writes_a_file(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    path, given = f"{name or 'task'}.toml", [name] if name else []
    told = invoke(*given)
    assert told.return_value == 0
    text = templates.text(name or "task")
    assert (tmp_path / path).read_bytes() == text.encode()
    assert told.stdout.splitlines() == [
        f"wrote {path}: {text.splitlines()[0][2:]}",
        f"next: burmester synthesize {path}",
    ]
    (tmp_path / path).write_text("mine")
    with pytest.raises(InputError) as caught:
        invoke(*given)
    assert caught.value.code == "E140"
    assert (tmp_path / path).read_text() == "mine"
    invoke(*given, "--force")
    assert (tmp_path / path).read_bytes() == text.encode()


def test_the_next_command_can_be_pasted(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = invoke("folding-table", "-o", "my table.toml").stdout.splitlines()[1]
    command = told.removeprefix("next: burmester ")
    ran = subprocess.run(
        f'"{sys.executable}" -m burmester {command}', shell=True, capture_output=True, check=False
    )
    assert ran.returncode == 0, ran.stderr


def test_the_command_prints(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert invoke("gripper", "-o", "-").stdout == templates.text("gripper")
    listed = invoke("--list").stdout
    assert " ".join(listed.split()) == " ".join(
        f"{each} {templates.summary(each)}" for each in NAMES
    )
    assert max(map(len, listed.splitlines())) <= 80
    assert not list(tmp_path.iterdir())


def test_an_unknown_template():
    for wrong, first in (("hinge", "lid-hinge"), ("Knee", "prosthetic-knee"), ("../cases/x", None)):
        with pytest.raises(InputError) as caught:
            invoke(wrong, "-o", "-")
        assert caught.value.code == "E100"
        named = caught.value.help.removeprefix("take one of these: ").split(", ")
        assert sorted(named) == list(NAMES)
        assert first in (None, named[0])


def test_templates_need_no_numpy():
    script = """
import sys
from burmester.io import files, templates
assert "gripper" in templates.names() and templates.text()
assert not {"numpy", "rich"} & set(sys.modules)
"""
    subprocess.run([sys.executable, "-c", script], check=True)
