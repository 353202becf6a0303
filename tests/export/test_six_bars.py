"""Six-bars handed over: what is read back, against joints found by Newton's method."""

import itertools
import json
import re
import subprocess
from functools import cache
from xml.etree import ElementTree

import ezdxf
import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image
from shapely import LineString, MultiPoint, Point, Polygon

from burmester.errors import InputError
from burmester.export import SIX_BAR_FORMATS, Options, export
from burmester.export.parts.plate import outline_points
from burmester.export.parts.plates import assembly_of
from burmester.sixbar.six_bars import SixBarOptions
from burmester.synthesis.six_bars import synthesize_six_bars
from tests.oracles.six_bars import dimensions, driven
from tests.sixbar.tasks import TURNING, task, wandering

mujoco = pytest.importorskip("mujoco")
steered = pytest.importorskip("tests.oracles.simulation").steered

HOLES = {
    "ground": "AB",
    "first-crank": "AC",
    "coupler": "CDE",
    "second-crank": "BDG",
    "floating-link": "GH",
    "body-link": "EH",
}
# One with plates of one layer beside each other, one with a second ground, one that turns fully,
# one whose coupler is an angle.
NAMES = ("turning", "second ground", "full turn", "angle")


@cache
def six_bar(name):
    given, number = {
        "turning": (task(TURNING, length_unit="mm"), 0),
        "second ground": (wandering(5), 2),
        "full turn": (wandering(6), 1),
        "angle": (wandering(4), 0),
    }[name]
    found = synthesize_six_bars(
        given, SixBarOptions(kind="Watt I", chains=400, most=3)
    ).six_bars.found
    return found[number]


def joints_at(chosen, drives):
    """Where the joints are (n,), complex, at drives that begin at the first pose's."""
    rows = np.column_stack([chosen.task.poses.translation, chosen.task.poses.angle])
    own = chosen.linkage
    run = driven(own, rows[0], chosen.driver, drives)
    at = {joint: run.joints[:, k] for k, joint in enumerate("CDEGH")}
    for joint, pivot in (("A", own.fixed_first), ("B", own.fixed_second)):
        at[joint] = np.full(len(drives), complex(*pivot))
    return at


def joints_at_poses(chosen):
    """The same at the poses, between which the oracle goes in small steps."""
    drive = chosen.drive
    ways = [np.linspace(p, q, 60)[:-1] for p, q in itertools.pairwise(drive)]
    at = joints_at(chosen, np.concatenate([*ways, drive[-1:]]))
    return {joint: values[::59] for joint, values in at.items()}


@pytest.mark.parametrize("name", NAMES)
def test_plates_are_the_links_and_never_meet(name):
    chosen = six_bar(name)
    made = assembly_of(chosen, Options())
    assert (made.plate("ground-2") is not None) == (name == "second ground")
    assert (made.plate("coupler").corner is not None) == (name == "angle")
    at = joints_at(chosen, np.linspace(chosen.drive[0], chosen.drive[-1], 400))
    size, radius = max(dimensions(chosen.linkage).values()), made.dimensions.width / 2
    held = {
        plate.name: [pin.name for pin in made.pins if plate.name in pin.joins]
        for plate in made.plates
    }
    for plate in made.plates:
        assert set(held[plate.name]) <= set(HOLES[plate.owner])
        points = np.concatenate([plate.holes[:, :2], plate.marks])
        core = MultiPoint(points).convex_hull
        if plate.corner is not None:  # two arms
            at_corner = np.linalg.norm(points - plate.skeleton[plate.corner], axis=1).argmin()
            ends = np.delete(points, at_corner, axis=0)
            core = LineString([ends[0], points[at_corner], ends[1]])
        outline = Polygon(outline_points(plate, 1e-3 * radius))
        assert outline.is_valid
        away = outline.symmetric_difference(core.buffer(radius, quad_segs=64, join_style="round"))
        assert away.area < 1e-2 * radius**2
    assert sum(map(len, held.values())) == 14
    for k in range(0, 400, 21):
        shapes = {}
        for plate in made.plates:
            holes = plate.holes[:, :2] @ [1, 1j]
            wanted = np.array([at[joint][k] for joint in held[plate.name]])
            turn, shift = 1, 0
            if plate.owner != "ground":
                turn = (wanted[1] - wanted[0]) / (holes[1] - holes[0])
                shift = wanted[0] - turn * holes[0]
            assert abs(turn * holes + shift - wanted).max() < 1e-8 * size
            corners = turn * (outline_points(plate, 1e-3 * radius) @ [1, 1j]) + shift
            shapes[plate.name] = Polygon(np.column_stack([corners.real, corners.imag]))
        for one, two in itertools.combinations(made.plates, 2):
            if one.layer == two.layer:
                assert shapes[one.name].disjoint(shapes[two.name])
        for pin in made.pins:
            disc = Point(at[pin.name][k].real, at[pin.name][k].imag).buffer(pin.diameter / 2)
            assert {plate.layer for plate in made.plates if plate.name in pin.joins} == {
                pin.low,
                pin.high,
            }
            for plate in made.plates:
                if pin.low < plate.layer < pin.high:
                    assert shapes[plate.name].disjoint(disc)


def test_the_drawing_in_dxf(tmp_path):
    chosen = six_bar("turning")
    export(chosen, "dxf", tmp_path / "a.dxf", Options(pose=4))
    document = ezdxf.readfile(tmp_path / "a.dxf")
    assert not document.audit().errors
    drawn = sorted(
        (round(c.dxf.center.x, 6), round(c.dxf.center.y, 6))
        for c in document.blocks.get("ASSEMBLY").query("CIRCLE")
    )
    at = {joint: values[3] for joint, values in joints_at_poses(chosen).items()}
    wanted = [at[joint] for joints in HOLES.values() for joint in joints]
    assert np.array(drawn) == pytest.approx(
        np.array(sorted((round(z.real, 6), round(z.imag, 6)) for z in wanted)), abs=1e-5
    )
    texts = {each.dxf.text: each.dxf.insert for each in document.modelspace().query("TEXT")}
    for joint, place in at.items():
        assert abs(complex(texts[joint].x, texts[joint].y) - place) < 2
    circles = [
        Point(each.dxf.center.x, each.dxf.center.y)
        for each in document.modelspace().query("CIRCLE")
    ]
    bars = dimensions(chosen.linkage)
    for link, joints in HOLES.items():
        layer = link.upper().replace("-", "_")
        (outline,) = document.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')
        inside = Polygon([each[:2] for each in outline.get_points()]).buffer(1e-9)
        own = [each for each in circles if inside.contains(each)]
        assert len(own) == len(joints)
        apart = sorted(one.distance(two) for one, two in itertools.combinations(own, 2))
        told = sorted(
            bars.get(one + two, abs(at[one] - at[two]))
            for one, two in itertools.combinations(joints, 2)
        )
        assert apart == pytest.approx(told, abs=1e-6)


def test_the_drawing_in_svg(tmp_path):
    chosen = six_bar("second ground")
    export(chosen, "svg", tmp_path / "a.svg", Options(pose=2))
    groups = {each.get("id"): each for each in ElementTree.parse(tmp_path / "a.svg").iter()}
    at = {joint: values[1] for joint, values in joints_at_poses(chosen).items()}
    for link, joints in (HOLES | {"ground": "A", "ground-2": "B"}).items():
        drawn = [
            complex(float(each.get("cx")), -float(each.get("cy")))
            for each in groups[f"placed-{link}"]
            if each.get("class") == "hole"
        ]
        assert drawn == pytest.approx([at[joint] for joint in joints], abs=1e-7)


def test_the_model_in_openscad(tmp_path):
    chosen = six_bar("full turn")
    export(chosen, "openscad", tmp_path / "a.scad")
    text = (tmp_path / "a.scad").read_text()
    values = {
        name: np.array(json.loads(value))
        for name, value in re.findall(r"^(\w+) = (\[[^;]*\]);", text, re.MULTILINE)
    }
    at = joints_at_poses(chosen)
    for link, joints in HOLES.items():
        if link == "ground":
            continue
        name = link.replace("-", "_")
        places = values["poses" if link == "body-link" else f"{name}_poses"]
        turn = np.exp(1j * np.radians(places[:, 2]))
        for joint, hole in zip(joints, values[f"{name}_holes"] @ [1, 1j], strict=True):
            there = places[:, :2] @ [1, 1j] + turn * hole
            assert abs(there - at[joint]).max() < 1e-7


def weights(made):
    """What moving links weigh in aluminium, by the areas of polygons: kg."""
    step, found = made.dimensions.thickness + made.dimensions.gap, {}
    for plate in made.plates:
        area = Polygon(outline_points(plate, 1e-5 * plate.radius)).area
        area -= np.pi / 4 * (plate.holes[:, 2] ** 2).sum()
        found[plate.name] = area * made.dimensions.thickness
    for pin in made.pins:
        height = (pin.high - pin.low) * step + made.dimensions.thickness
        found[pin.plate] += np.pi / 4 * pin.diameter**2 * height
    return {link: 2700e-9 * found[link] for link in HOLES if link != "ground"}


@pytest.mark.parametrize("name", ["turning", "angle"])
def test_a_motor_takes_the_model_through_the_poses(name, tmp_path):
    chosen = six_bar(name)
    export(chosen, "mjcf", tmp_path / "a.xml")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "a.xml"))
    assert model.neq == 2
    for link, mass in weights(assembly_of(chosen, Options())).items():
        assert model.body(link).mass[0] == pytest.approx(mass, rel=1e-4)
    # Under its weight, from pose to pose.
    steered(model, chosen.task.poses, chosen.extent / 1000, exact=1e-9, near=2e-5)


def test_urdf_has_its_loops_open(tmp_path):
    """MuJoCo reads it; its joints at a pose's angles, the body is there and the loops close."""
    chosen = six_bar("second ground")
    export(chosen, "urdf", tmp_path / "a.urdf", Options(pose=3, up="z"))
    text = (tmp_path / "a.urdf").read_text()
    keep = '<mujoco><compiler fusestatic="false" boundinertia="1e-14"/></mujoco></robot>'
    model = mujoco.MjModel.from_xml_string(text.replace("</robot>", keep))
    data, at = mujoco.MjData(model), joints_at_poses(chosen)
    on = {"coupler": "first-crank", "floating-link": "second-crank", "body-link": "coupler"}
    bars = {
        "first-crank": at["C"] - at["A"],
        "coupler": at["E"] - at["C"],
        "second-crank": at["D"] - at["B"],
        "floating-link": at["H"] - at["G"],
        "body-link": at["H"] - at["E"],
    }
    for pose in range(5):
        for name, way in bars.items():
            turn = way / way[2]
            if name in on:
                turn = turn / (bars[on[name]] / bars[on[name]][2])
            data.joint(name).qpos = np.angle(turn[pose])
        mujoco.mj_forward(model, data)
        place, size = chosen.task.poses[pose], chosen.extent / 1000
        body = data.body("body")
        assert np.abs(body.xpos[:2] - place.translation / 1000).max() < 1e-8 * size
        turn = body.xmat.reshape(3, 3)[:2, 0] @ [1, 1j]
        assert abs(turn - np.exp(1j * place.angle)) < 1e-8
        for joint in "DH":
            for end in "ab":
                there = data.body(f"loop_{joint}_{end}").xpos[:2] @ [1, 1j]
                assert abs(there - at[joint][pose] / 1000) < 1e-8 * size


def marks(pictures):
    """The middle of the yellow mark in each picture: column and row upwards, complex."""
    found = []
    for picture in pictures:
        off = np.abs(picture.astype(int) - [240, 228, 66]).max(axis=-1)
        rows, columns = np.nonzero(off < 12)
        found.append(complex(np.median(columns), -np.median(rows)))
    return np.array(found)


@pytest.mark.parametrize(("name", "suffix"), [("turning", "mp4"), ("full turn", "gif")])
def test_films_show_the_driver_going_its_way(name, suffix, tmp_path):
    chosen = six_bar(name)
    path = tmp_path / "film"  # whose name tells no format
    export(chosen, suffix, path, Options(seconds=1.2, frames_per_second=10, width_px=240))
    if suffix == "mp4":
        program = imageio_ffmpeg.get_ffmpeg_exe()
        raw = subprocess.run(
            [program, "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
            check=True,
            capture_output=True,
        ).stdout
        shown = np.frombuffer(raw, np.uint8).reshape(12, -1, 240, 3)
    else:
        with Image.open(path) as film:
            shown = []
            for number in range(film.n_frames):
                film.seek(number)
                shown.append(np.asarray(film.convert("RGB")))
    assert len(shown) == 12
    found, seen = chosen, marks(shown)
    drive, share = found.drive, np.arange(12) / 12
    if name == "full turn":
        drives = drive[0] + np.sign(drive[-1] - drive[0]) * 2 * np.pi * share
        pivot = found.joints(drives)["C" if found.driver == "first" else "D"] @ [1, 1j]
    else:  # there and back again
        assert abs(seen[1:] - seen[:0:-1]).max() < 2
        ends = found.joints(drive[[0, -1]])["C" if found.driver == "first" else "D"] @ [1, 1j]
        seen, pivot = seen[[0, 6]], ends
    # One scale, no turn: pixels are a shift and a multiple of millimetres.
    scale = ((seen - seen.mean()) * (pivot - pivot.mean()).conj()).sum() / (
        abs(pivot - pivot.mean()) ** 2
    ).sum()
    assert abs(scale.imag) < 0.02 * scale.real
    assert abs(seen - seen.mean() - scale.real * (pivot - pivot.mean())).max() < 2


def test_what_six_bars_cannot_be(tmp_path):
    chosen = six_bar("turning")
    with pytest.raises(InputError) as refused:
        export(chosen, "pylinkage", tmp_path / "a.py")
    assert refused.value.code == "E198"
    assert "mjcf" in refused.value.why
    wide = Options(width=4 * chosen.extent, hole=0.1)
    with pytest.raises(InputError) as refused:
        export(chosen, "svg", tmp_path / "a.svg", wide)
    assert refused.value.code == "E163"
    assert list(tmp_path.iterdir()) == []


def test_every_format_of_six_bars_is_read_back(tmp_path):
    pytest.importorskip("build123d")
    small = Options(seconds=0.3, width_px=200)
    for name in SIX_BAR_FORMATS:
        [path] = export(six_bar("turning"), name, tmp_path / name, small)
        assert path.stat().st_size > 0
