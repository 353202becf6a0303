"""Linkages built from what is printed do what is promised: rebuilt from the text, and moved."""

import io
import math
import re

import numpy as np
import pytest
from rich.console import Console

from burmester.api.linkage import ResultLinkage, as_type
from burmester.describe.decimals import decimals_of_dyad, decimals_of_linkage, figures_of
from burmester.export import Options, export
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.io import cases, templates
from burmester.io.reading.poses import read_task
from burmester.io.terminal import show_synthesis
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.web.data import report_data
from tests.oracles import printed, witness
from tests.samples import some_of

GROWTH = 1.1
ROUNDING = 1e-14  # relative; the last bits of an error that is none
ORACLE_ROUNDING = 8 * np.finfo(float).eps  # of coordinates and angles; no error is known better
SOURCES = [f"case:{name}" for name in cases.names()]
SOURCES += [f"template:{name}" for name in templates.of_poses()]


@pytest.fixture(scope="module", params=SOURCES)
def synthesis(request, tmp_path_factory):
    kind, name = request.param.split(":")
    if kind == "case":
        return synthesize(read_task(request.param))
    file = tmp_path_factory.mktemp("templates") / f"{name}.toml"
    file.write_text(templates.text(name), encoding="utf-8")
    return synthesize(read_task(file))


def on_terminal(synthesis, width=100):
    out = io.StringIO()
    show_synthesis(synthesis, Console(file=out, width=width, highlight=False))
    return out.getvalue()


def promised(worst, angle, notes):
    """Bounds on position and angle (radians) errors; where "exact" is said, a note has numbers."""
    if "exact" in (worst, angle):
        (note,) = re.findall(r"misses by (\S+)(?: \w+)? and (\S+)° at most", notes)
        worst, angle = (
            more if text == "exact" else text.strip("°")
            for text, more in zip((worst, angle), note, strict=True)
        )
    return printed.most(worst), math.radians(printed.most(angle.strip("°")))


def assert_kept(dyads, synthesis, bounds, start=None):
    poses = synthesis.task.poses
    length = synthesis.problem.length_per_radian
    errors = printed.errors_at(dyads, poses, length, start)
    sizes = (max(length, np.abs(poses.translation).max()), max(1.0, np.abs(poses.angle).max()))
    for found, bound, size in zip(errors, bounds, sizes, strict=True):
        assert found.max() <= GROWTH * bound + ORACLE_ROUNDING * size


def test_the_best_linkage_as_a_terminal_prints_it(synthesis):
    text = on_terminal(synthesis)
    if not synthesis.usable:
        assert "in full" not in text
        return
    dyads = printed.dyads_of(printed.in_full(text))
    one_line = " ".join(text.split())
    head = re.search(r"passes every pose (?:within (\S+)(?: \w+)? and (\S+),|exactly)", one_line)
    worst, angle = head.groups(default="exact")
    assert_kept(dyads, synthesis, promised(worst, angle, one_line))


def test_all_linkages_as_the_page_prints_them(synthesis):
    for each in report_data(synthesis)["linkages"]:
        said = each["said"]
        places = [[row["x"], row["y"], row["angle_deg"]] for row in each["pose_errors"]]
        if any(value is None for row in places for value in row):
            continue
        rows = [(row["dyad"], row["what"], row["value"]) for row in said["dimensions"]]
        bounds = promised(said["worst"], said["angle"], " ".join(said["notes"]))
        start = np.array(places) * [1, 1, np.pi / 180]
        assert_kept(printed.dyads_of(rows), synthesis, bounds, start)


def in_another_unit(task, factor, shift):
    """The task with other lengths, and with its origin elsewhere."""
    poses = Displacement(factor * task.poses.translation + shift, task.poses.angle)
    known = (factor * task.resolution[0], task.resolution[1])
    return Task(poses, resolution=known)


@pytest.mark.parametrize("name", ["ge2012-approximate", "motiongen-rrpr", "motiongen-rrrp"])
@pytest.mark.parametrize(
    ("factor", "shift"), some_of([(1e-9, 0.0), (1e-3, 0.0), (1e5, -1e8), (1.0, 1e6)], 2)
)
def test_in_any_unit_and_far_from_the_origin(name, factor, shift):
    synthesis = synthesize(in_another_unit(read_task(f"case:{name}"), factor, shift))
    assert synthesis.usable
    test_all_linkages_as_the_page_prints_them(synthesis)
    test_the_best_linkage_as_a_terminal_prints_it(synthesis)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("second", [RR, PR, RP])
def test_no_fewer_decimals_would_do(seed, second):
    """Driven linkages whose poses are moved: one decimal less breaks what is said of them."""
    rng = np.random.default_rng(seed)
    dyads = witness.random_four_bar(rng, second)
    if seed % 2 and second is RR:  # a link of a hundred times the motion
        far = np.array([70.0, -70.0]) * rng.uniform(1, 2)
        dyads[1] = RR(dyads[1].fixed_pivot + far, dyads[1].moving_pivot, np.hypot(*far))
    rows = witness.random_poses(dyads, rng, 8)
    rows[:, :2] += 10.0 ** rng.uniform(-6, -2) * rng.normal(size=(8, 2))
    poses = Displacement.from_poses(rows)
    linkage = Linkage(*dyads)
    error = PoseError.of(linkage, poses, 1.0)
    decimals = decimals_of_linkage(linkage, poses, error, 1.0, 1.0)
    bounds, middles = (error.worst, error.angle.max()), decimals.middles

    def kept(places, degrees):
        read = [rounded(a, places, degrees, b) for a, b in zip(dyads, middles, strict=True)]
        errors = printed.errors_at(read, poses, 1.0)
        return all(e.max() <= GROWTH * b for e, b in zip(errors, bounds, strict=True))

    assert kept(decimals.lengths, decimals.degrees)
    shown = 10.0**-decimals.lengths
    assert shown < 3.01 * error.worst
    if 10 * shown < error.worst / 3:
        assert not kept(decimals.lengths - 1, decimals.degrees - 1)


def test_of_many_poses_none_is_missed_by_more():
    """The printed linkage is moved to those of most error only; it is right at all of them."""
    rng = np.random.default_rng(1)
    dyads = witness.random_four_bar(rng)
    rows = witness.random_poses(dyads, rng, 3000)
    rows[:, :2] += 1e-3 * rng.normal(size=(3000, 2))
    poses, linkage = Displacement.from_poses(rows), Linkage(*dyads)
    error = PoseError.of(linkage, poses, 1.0)
    decimals = decimals_of_linkage(linkage, poses, error, 1.0, 1.0)
    one = [rounded(each, decimals.lengths, decimals.degrees, None) for each in dyads]
    position, angle = printed.errors_at(one, poses, 1.0)
    assert position.max() <= GROWTH * error.worst
    assert angle.max() <= GROWTH * error.angle.max()


def rounded(dyad, places, degrees, middle):
    """A dyad as read from its printed numbers; middle: of the line, if it has one."""

    def text(value, decimals):
        return np.array([float(f"{each:.{decimals}f}") for each in np.ravel(value)])

    if isinstance(dyad, RR):
        return RR(
            *(text(getattr(dyad, name), places) for name in dyad.__slots__[:2]),
            text(dyad.radius, places)[0],
        )
    normal = np.radians(text(np.degrees(dyad.normal_angle) - 90, degrees)[0] + 90)
    line = {
        "normal_angle": normal,
        "offset": text(middle, places) @ [np.cos(normal), np.sin(normal)],
    }
    side = "moving_pivot" if isinstance(dyad, PR) else "fixed_pivot"
    return type(dyad)(**line, **{side: text(getattr(dyad, side), places)})


@pytest.mark.parametrize("kind", ["svg", "dxf"])
def test_drawings_have_the_same_dimensions(synthesis, kind, tmp_path):
    if not synthesis.usable:
        return
    best = as_type(ResultLinkage, synthesis.usable[0])
    (path,) = export(best, kind, tmp_path / f"drawing.{kind}", Options(unit="mm"))
    text = path.read_text(encoding="utf-8")
    dyads = printed.dyads_of(printed.in_drawing(text))
    assert len(dyads) == 2
    unit = {"cm": 10.0, "m": 1e3, "in": 25.4}.get(synthesis.task.length_unit, 1.0)
    error, length = best.error, synthesis.problem.length_per_radian
    poses = Displacement(unit * synthesis.task.poses.translation, synthesis.task.poses.angle)
    away, turned = re.search(r"digits, it comes within (\S+) mm and (\S+)° of", text).groups()
    exact = error.worst < 1e-9 * length
    bounds = (
        max(unit * error.worst, printed.most(away) if exact else 0.0),
        max(float(error.angle.max()), math.radians(printed.most(turned)) if exact else 0.0),
    )
    scales = unit * length, 1.0
    found = printed.errors_at(dyads, poses, unit * length)
    for errors, bound, scale in zip(found, bounds, scales, strict=True):
        assert errors.max() <= GROWTH * bound + ROUNDING * scale


def test_a_notebook_shows_the_same_dimensions(synthesis):
    for each in synthesis.usable:
        page = as_type(ResultLinkage, each)._repr_html_()
        cells = re.findall(r"<td[^>]*>(.*?)</td>", page)
        dyads = printed.dyads_of(list(zip(cells[::3], cells[1::3], cells[2::3], strict=True)))
        bounds = [
            max(float(error.max()), 1e-6 * scale)
            for error, scale in ((each.error.position, synthesis.length), (each.error.angle, 1.0))
        ]
        assert_kept(dyads, synthesis, bounds)


def test_a_dyad_alone_keeps_its_errors(synthesis):
    poses = synthesis.task.poses
    for found in synthesis.dyads:
        decimals = decimals_of_dyad(found.dyad, poses, synthesis.length)
        one = rounded(found.dyad, decimals.lengths, decimals.degrees, decimals.middles[0])
        value = residual_of(one, poses)
        least = 1e-6 * synthesis.length if found.max_error < 1e-11 * synthesis.length else 0.0
        assert np.abs(value).max() <= GROWTH * max(found.max_error, least)
        assert np.sqrt((value**2).mean()) <= GROWTH * max(found.rms_error, least)


def residual_of(dyad, poses):
    """How far poses are from what a dyad allows, in complex numbers."""
    d, turn = poses.translation @ [1, 1j], np.exp(1j * poses.angle)
    if isinstance(dyad, RR):
        pin = d + turn * (dyad.moving_pivot @ [1, 1j])
        return abs(pin - dyad.fixed_pivot @ [1, 1j]) - dyad.radius
    normal = np.exp(1j * dyad.normal_angle)
    if isinstance(dyad, PR):
        point = d + turn * (dyad.moving_pivot @ [1, 1j])
    else:
        point = (dyad.fixed_pivot @ [1, 1j] - d) / turn
    return (np.conj(normal) * point).real - dyad.offset


@pytest.mark.parametrize(
    ("size", "decimals"),
    [
        (0.03, 2),
        (0.029, 3),
        (0.02, 3),
        (0.011, 3),
        (0.099, 2),
        (0.4, 1),
        (0.25, 2),
        (4, 0),
        (70, 0),
    ],
)
def test_a_size_shows_a_digit_or_two_where_the_first_is_1_or_2(size, decimals):
    assert figures_of(size) == decimals
