"""What is handed over, read by programs that are not ours, against geometry computed here."""

import csv
import io
import itertools
import json
import math
import re
import runpy
import subprocess
import sys
from contextlib import suppress
from dataclasses import replace

import ezdxf
import numpy as np
import pytest

from burmester import export as exported
from burmester.errors import BurmesterError, InputError
from burmester.export import FORMATS, Options, export, format_of
from burmester.export.description import decimals_within, rounded
from burmester.export.models import mjcf
from burmester.export.parts.plate import outline_points
from burmester.export.parts.plates import assembly_of
from burmester.fourbar.dyad import PP
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.outlines import convex_hull
from burmester.io import templates
from burmester.io.saved import read_result
from tests.oracles.handed_over import (
    GIVEN,
    NAMES,
    complex_places,
    dxf_unit,
    joints,
    rp,
    saved,
    scale_of,
    span_of,
    written,
)
from tests.samples import some_of

SPANS = 1e-9
MERE = "visual|collision|geom|site size|statistic|light|text|svg|desc|style|position|polygon"
FLAT = ("dxf", "svg", "csv", "json", "mjcf", "urdf", "sdf", "openscad", "pylinkage")


def nearest(points, point):
    return min(abs(complex(*each[:2]) - point) for each in points)


# Plates ------------------------------------------------------------------------------------------


def carried(points, body):
    """Points (k, 2) at one place: computed here."""
    z = (points @ [1, 1j]) * np.exp(1j * float(body.angle)) + complex(*body.translation)
    return np.column_stack([z.real, z.imag])


def from_polygon(point, polygon):
    """The distance of a point from a polygon's sides, and whether it is inside."""
    z, corner = complex(*point), polygon @ [1, 1j]
    side = np.roll(corner, -1) - corner
    share = np.clip(((z - corner) * side.conj()).real / np.abs(side) ** 2, 0, 1)
    turns = np.angle((np.roll(corner, -1) - z) / (corner - z)).sum() / (2 * np.pi)
    return float(np.abs(z - corner - share * side).min()), abs(turns) > 0.5


@pytest.mark.parametrize("name", NAMES)
def test_holes_and_slots_have_metal_around_them(name):
    made = assembly_of(saved(name), Options())
    hole = made.dimensions.hole
    for plate in made.plates:
        polygon = outline_points(plate, 1e-4 * hole)
        cut = [(np.array([[x, y]]), d) for x, y, d in plate.holes]
        cut += [(np.linspace(s[:2], s[2:4], 50), s[4]) for s in plate.slots]
        for points, d in cut:
            for point in points:
                away, inside = from_polygon(point, polygon)
                assert inside
                assert away >= d / 2 + 0.1 * hole
        for (one, d1), (two, d2) in itertools.combinations(cut, 2):
            gap = np.abs((one @ [1, 1j])[:, None] - (two @ [1, 1j])).min()
            assert gap >= (d1 + d2) / 2 + 0.05 * hole


@pytest.mark.parametrize("name", NAMES)
def test_holes_meet_all_along_the_motion(name):
    chosen = saved(name)
    made = assembly_of(chosen, Options())
    near = SPANS * span_of(chosen, made.reference.scale)
    for k in range(0, made.motion.shape[0], 40):
        place = made.motion[k]
        for pin in made.pins:
            at = carried(np.array([[pin.x, pin.y]]), made.plate(pin.plate).at(place)) @ [1, 1j]
            for joined in pin.joins:
                plate = made.plate(joined)
                body = plate.at(place)
                gaps = [np.inf]
                if len(plate.holes):
                    gaps.append(np.abs(carried(plate.holes[:, :2], body) @ [1, 1j] - at).min())
                for slot in plate.slots:
                    low, high = carried(slot[:4].reshape(2, 2), body) @ [1, 1j]
                    along = (at[0] - low) / (high - low)
                    if 0 < along.real < 1:
                        gaps.append(abs(along.imag * abs(high - low)))
                assert min(gaps) <= near, (pin, joined)
    # The places of the result are on that motion.
    for k in range(6):
        d, turn = complex_places(chosen, made.reference.scale)
        motion = made.motion["coupler"]
        away = np.abs(motion.translation @ [1, 1j] - d[k])
        away += made.reference.scale * np.abs(np.exp(1j * motion.angle) - turn[k])
        assert away.min() <= 100 * near


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_in_the_way_of_anything(name):
    made = assembly_of(saved(name), Options())
    shapes = {each.name: outline_points(each, 0.01 * made.dimensions.width) for each in made.plates}
    dense = {
        key: np.concatenate(
            [np.linspace(a, b, 12) for a, b in zip(p, np.roll(p, -1, axis=0), strict=True)]
        )
        for key, p in shapes.items()
    }
    circle = np.exp(2j * np.pi * np.arange(16) / 16)
    for k in np.linspace(0, made.motion.shape[0] - 1, 25).astype(int):
        place = made.motion[int(k)]
        for one, two in itertools.permutations(made.plates, 2):
            if one.layer == two.layer:
                points = carried(dense[one.name], one.at(place))
                body = two.at(place)
                inside = inside_of(points, carried(shapes[two.name], body))
                assert not inside.any(), (one.name, two.name)
        for pin in made.pins:
            at = carried(np.array([[pin.x, pin.y]]), made.plate(pin.plate).at(place)) @ [1, 1j]
            ring = at + circle * pin.diameter / 2
            for plate in made.plates:
                if pin.low < plate.layer < pin.high and plate.name not in pin.joins:
                    points = np.column_stack([ring.real, ring.imag])
                    polygon = carried(shapes[plate.name], plate.at(place))
                    assert not inside_of(points, polygon).any(), (pin, plate.name)


def inside_of(points, polygon):
    """Whether points are inside a polygon: how often a ray crosses its sides."""
    (x, y), (x1, y1) = points.T[:, :, None], polygon.T[:, None]
    x2, y2 = np.roll(polygon, -1, axis=0).T[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        hit = ((y1 > y) != (y2 > y)) & (x < (x2 - x1) * (y - y1) / (y2 - y1) + x1)
    return hit.sum(axis=1) % 2 == 1


def test_arrangements():
    layers = {
        name: {p.name: p.layer for p in assembly_of(saved(name), Options()).plates}
        for name in NAMES
    }
    assert layers["crank-rocker, mm"] == {"ground": 0, "driver": 1, "coupler": 2, "follower": 1}
    # A drag-link turns around both fixed pivots: the follower hangs on a ground above.
    assert layers["double-crank, cm"]["ground-2"] == 4
    # Two rails that cross cannot be in one plate.
    trammel = saved("", given=(*GIVEN["trammel, mm"][:3], (0.03, 3.0)))
    made = assembly_of(trammel, Options())
    assert {p.name: p.layer for p in made.plates} == {"ground": 0, "ground-2": 2, "coupler": 1}
    assert layers["Rapson slide, mm"] == {"ground": 0, "coupler": 1}


def test_two_slots_that_cross_cannot_be_cut(tmp_path):
    chosen = saved("", given=(rp([0, 0], 90, 0), rp([50, 0], 0, -30), "mm", (-0.3, 2.9)))
    with pytest.raises(InputError) as caught:
        export(chosen, "svg", tmp_path / "a.svg")
    assert caught.value.code == "E163"
    assert "joints of the coupler" in caught.value.why
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "given",
    [
        {"hole": 30.0},
        {"hole": 4.0, "width": 4.0},
        {"hole": 19.9},
        {"width": 3, "hole": 9},
        {"hole": 2.0, "pin": 2.5},
    ],
)
def test_what_cannot_be_made_is_refused_with_help_that_works(given):
    chosen = saved("crank-rocker, mm")
    for _ in range(3):
        with pytest.raises(InputError) as caught:
            assembly_of(chosen, Options(**given))
        assert caught.value.code == "E162"
        said = re.search(r"--(\w+) ([\d.e+-]+)", caught.value.help)
        given = given | {said[1]: float(said[2])}
        try:
            made = assembly_of(chosen, Options(**given))
            break
        except InputError:
            continue
    assert made.dimensions.hole < made.dimensions.width
    assert made.dimensions.hole < 20


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"pose": 7}, "no pose 7"),
        ({"unit": "parsec"}, "no unit"),
        ({"unit": "in"}, "are in mm, not in in"),
        ({"thickness": -1.0}, "thickness of -1"),
        ({"gap": math.nan}, "gap of nan"),
        ({"pin": 0.0}, "pin of 0 mm"),
    ],
)
def test_wrong_options(given, words):
    with pytest.raises(InputError, match=words) as caught:
        assembly_of(saved("crank-rocker, mm"), Options(**given))
    assert caught.value.code == "E162"


def test_dimensions_are_in_the_unit_of_the_task():
    made = assembly_of(saved("double-rocker, in"), Options(hole=0.25, width=0.6, pose=3))
    assert made.dimensions.hole == pytest.approx(6.35, abs=1e-12)
    assert made.plate("driver").holes[1, 0] == pytest.approx(4 * 25.4, abs=1e-10)
    assert made.pose == 2
    free = assembly_of(saved("slider-crank, no unit"), Options(unit="cm"))
    assert free.plate("driver").holes[1, 0] == pytest.approx(10, abs=1e-12)
    assert not free.assumed
    assert assembly_of(saved("slider-crank, no unit"), Options()).assumed


def test_lengths_in_px_need_a_unit_where_they_are_made():
    drawn = saved("slider-crank, no unit")
    drawn = replace(drawn, task=replace(drawn.task, length_unit="px"))
    with pytest.raises(InputError, match="how long one px is") as caught:
        assembly_of(drawn, Options())
    assert caught.value.help.endswith("--length-unit mm")
    made = assembly_of(drawn, Options(unit="cm"))
    assert made.plate("driver").holes[1, 0] == pytest.approx(10, abs=1e-12)


def test_arcs_are_those_of_circles():
    made = assembly_of(saved("crank-rocker, mm"), Options())
    r = made.dimensions.width / 2
    for plate in made.plates:
        points = outline_points(plate, 1e-7)
        away = [from_polygon(p, plate.skeleton)[0] for p in points]
        if len(plate.skeleton) > 2:
            assert np.abs(np.array(away) - r).max() <= 1e-9
    driver = made.plate("driver")
    area = 20 * 2 * r + np.pi * r * r
    x, y = outline_points(driver, 1e-7).T
    assert abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2 == pytest.approx(area, rel=1e-6)


# Drawings ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_dxf(name, tmp_path):
    options = Options(pose=3)
    chosen, path = written(name, "dxf", tmp_path, options)
    document = ezdxf.readfile(path)
    auditor = document.audit()
    assert not auditor.errors
    assert not auditor.fixes
    assert document.dxfversion == "AC1024"
    code, unit = dxf_unit(chosen)
    assert document.units == document.header["$INSUNITS"] == code
    assert document.header["$MEASUREMENT"] == int(unit == 1)
    scale = scale_of(chosen) / unit
    at = joints(chosen, 2, scale)
    block = document.blocks.get("ASSEMBLY")
    holes = [tuple(each.dxf.center) for each in block.query("CIRCLE")]
    for key, point in at.items():
        assert nearest(holes, point) <= 1e-6, key
    assert all(min(abs(complex(*each[:2]) - z) for z in at.values()) <= 1e-6 for each in holes)
    space = document.modelspace()
    lines = space.query("LWPOLYLINE")
    assert all(each.closed for each in lines)
    layers = {each.dxf.layer for each in space}
    assert {"GROUND", "COUPLER", "TEXT", "POSES", "ASSEMBLY"} <= layers
    # Link lengths, from the holes within the outlines laid out.
    for k, layer in ((1, "DRIVER"), (2, "FOLLOWER")):
        dyad = chosen.linkage.first if k == 1 else chosen.linkage.second
        own = space.query(f'LWPOLYLINE[layer=="{layer}"]')
        assert len(own) == hasattr(dyad, "radius")
        for outline in own:
            x, y = np.array([p[:2] for p in outline.get_points()]).T
            inside = [
                complex(*tuple(each.dxf.center)[:2])
                for each in space.query('CIRCLE[layer=="HOLES"]')
                if x.min() - 1e-9 <= each.dxf.center.x <= x.max() + 1e-9
                and y.min() < each.dxf.center.y < y.max()
            ]
            assert len(inside) == 2
            assert abs(inside[0] - inside[1]) == pytest.approx(float(dyad.radius) * scale, abs=1e-6)
    starts = [complex(*tuple(e.dxf.start)[:2]) for e in space.query('LINE[layer=="POSES"]')]
    wanted = chosen.task.poses.translation @ [1, 1j] * scale
    assert np.abs(np.array(starts[::2]) - wanted).max() <= 1e-6
    told = " ".join(each.dxf.text for each in space.query("TEXT"))
    assert ("names no unit" in told) == (chosen.unit is None)


@pytest.mark.parametrize("to", FLAT)
def test_the_same_linkage_gives_the_same_bytes(to, tmp_path):
    one, two = (
        export(saved("crank-rocker, mm"), to, tmp_path / f"{k}{FORMATS[to].suffix}")[0]
        for k in (1, 2)
    )
    assert one.read_bytes() == two.read_bytes()
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("name", NAMES)
def test_svg_is_one_to_one(name, tmp_path):
    elements = pytest.importorskip("svgelements")
    chosen, path = written(name, "svg", tmp_path, Options(pose=2))
    # Its millimetre has six digits: the drawing is read in units, of which each is a millimetre.
    text = path.read_text()
    width, height, *box = re.search(
        r'width="(\S+)mm" height="(\S+)mm" viewBox="(\S+) (\S+) (\S+) (\S+)"', text
    ).groups()
    assert [width, height] == box[2:]
    drawing = elements.SVG.parse(io.StringIO(text.replace('mm"', '"')))
    box = drawing.viewbox
    scale = scale_of(chosen)
    at = joints(chosen, 1, scale)
    near = SPANS * span_of(chosen, scale)
    groups = {each.id: each for each in drawing.select(lambda e: isinstance(e, elements.Group))}
    circles = [
        complex(each.cx + box.x, -(each.cy + box.y))
        for each in groups["assembly"].select(lambda e: isinstance(e, elements.Circle))
    ]
    for key, point in at.items():
        assert min(abs(each - point) for each in circles) <= near + 1e-12, key
    assert all(min(abs(each - z) for z in at.values()) <= near + 1e-12 for each in circles)
    for group, dyad in (
        ("part-driver", chosen.linkage.first),
        ("part-follower", chosen.linkage.second),
    ):
        assert (group in groups) == hasattr(dyad, "radius")
        if group in groups:
            one, two = groups[group].select(lambda e: isinstance(e, elements.Circle))
            length = math.hypot(one.cx - two.cx, one.cy - two.cy)
            assert length == pytest.approx(float(dyad.radius) * scale, abs=near)
            (outline,) = groups[group].select(lambda e: isinstance(e, elements.Path))
            x0, y0, x1, y1 = outline.bbox()
            made = assembly_of(chosen, Options())
            assert x1 - x0 == pytest.approx(length + made.dimensions.width, rel=1e-9)
            assert y1 - y0 == pytest.approx(made.dimensions.width, rel=1e-9)
    assert "transform" not in text


# Tables ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_csv(name, tmp_path):
    chosen, path = written(name, "csv", tmp_path)
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    unit = f"_{chosen.unit}" if chosen.unit else ""
    drive, *_ = rows[0]
    assert list(rows[0])[1:] == [f"x{unit}", f"y{unit}", "angle_deg", "pose"]
    d = np.array([complex(float(r[f"x{unit}"]), float(r[f"y{unit}"])) for r in rows])
    angle = np.radians([float(r["angle_deg"]) for r in rows])
    turn = np.exp(1j * angle)
    span = span_of(chosen)
    for dyad in (chosen.linkage.first, chosen.linkage.second):
        assert np.abs(off(dyad, d, turn)).max() <= SPANS * span
    marked = {int(r["pose"]): k for k, r in enumerate(rows) if r["pose"]}
    assert sorted(marked) == list(range(1, 7))
    places = complex_places(chosen)
    for number, k in marked.items():
        assert abs(d[k] - places[0][number - 1]) <= 1e-7 * span
        assert abs(turn[k] - places[1][number - 1]) <= 1e-7
    # Nothing jumps, the driver goes one way, and the ends are the first and the last pose.
    steps = np.diff([float(r[drive]) for r in rows])
    assert (steps > 0).all() or (steps < 0).all()
    assert np.abs(np.diff(d)).max() < 0.1 * span
    assert np.abs(np.diff(angle)).max() < 0.2
    assert {0, len(rows) - 1} == {marked[1], marked[6]}


@pytest.mark.parametrize("name", NAMES)
def test_a_table_has_no_rounding_dust(name, tmp_path):
    """No digits that carry nothing: at most as many as the tolerance and two digits more."""
    chosen, path = written(name, "csv", tmp_path)
    decimals = math.ceil(-math.log10(SPANS * span_of(chosen))) + 2
    _, *rows = path.read_text().splitlines()
    for cells in (row.split(",") for row in rows):
        for cell, most in zip(cells[:4], (None, decimals, decimals, 10), strict=True):
            assert re.fullmatch(r"-?\d+(\.\d*[1-9])?", cell), cell
            assert cell != "-0"
            assert most is None or len(cell.partition(".")[2]) <= most, cell


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (0.1 + 0.2, 1e-11, "0.3"),
        (1e-17, 1e-11, "0"),
        (-1e-17, 1e-11, "0"),
        (-2.50, 1e-11, "-2.5"),
        (1 / 3, 1e-4, "0.3333"),
        (20.0, 1e-11, "20"),
        (1234.5678, 30.0, "1235"),
        (1e6 + 0.3, 1e-11, "1000000.3"),
        (1.25e-9, 1e-14, "0.00000000125"),
    ],
)
def test_a_number_is_written_to_the_digits_that_carry(value, error, text):
    assert rounded(value, decimals_within(error)) == text
    assert abs(float(text) - value) <= error


def off(dyad, d, turn):
    """How far places are from what a dyad allows."""
    if hasattr(dyad, "radius"):
        pin = d + complex(*dyad.moving_pivot) * turn
        return np.abs(pin - complex(*dyad.fixed_pivot)) - dyad.radius
    n = np.exp(-1j * dyad.normal_angle)
    if hasattr(dyad, "moving_pivot"):
        return ((d + complex(*dyad.moving_pivot) * turn) * n).real - dyad.offset
    return ((complex(*dyad.fixed_pivot) - d) / turn * n).real - dyad.offset


@pytest.mark.parametrize("name", NAMES)
def test_json(name, tmp_path):
    chosen, path = written(name, "json", tmp_path)
    data = json.loads(path.read_text())
    assert data["schema"] == "burmester.linkage/1"
    assert data["length_unit"] == chosen.unit
    for told, dyad in zip(
        data["dyads"], (chosen.linkage.first, chosen.linkage.second), strict=True
    ):
        for key in ("fixed_pivot", "moving_pivot"):
            assert told.get(key) == (getattr(dyad, key).tolist() if hasattr(dyad, key) else None)
        assert told.get("radius") == (float(dyad.radius) if hasattr(dyad, "radius") else None)
        if "line" in told:
            assert np.radians(told["line"]["normal_deg"]) == pytest.approx(float(dyad.normal_angle))
    d = np.array([complex(row["x"], row["y"]) for row in data["coupler"]])
    turn = np.exp(1j * np.radians([row["angle_deg"] for row in data["coupler"]]))
    for dyad in (chosen.linkage.first, chosen.linkage.second):
        assert np.abs(off(dyad, d, turn)).max() <= SPANS * span_of(chosen)


# Programs ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("pose", [1, 4])
@pytest.mark.parametrize("name", [n for n in NAMES if "slot" not in n and "Rapson" not in n])
def test_pylinkage_runs_through_the_poses(name, pose, tmp_path):
    pytest.importorskip("pylinkage")
    if "inverted" in name:
        with pytest.raises(InputError) as caught:
            written(name, "pylinkage", tmp_path)
        assert caught.value.code == "E163"
        return
    chosen, path = written(name, "pylinkage", tmp_path, Options(pose=pose))
    script = runpy.run_path(str(path))
    span, seen = span_of(chosen), list(script["poses"]())
    assert len(seen) == 6
    for k, positions in enumerate(seen):
        d, turn = (values[k] for values in complex_places(chosen))
        body, body_x = complex(*positions["body"]), complex(*positions["body_x"])
        assert abs(body - d) <= 1e-7 * span
        assert abs((body_x - body) / abs(body_x - body) - turn) <= 1e-7
        at = joints(chosen, k)
        assert abs(complex(*positions["driver"]) - at["moving1"]) <= 1e-7 * span
        assert abs(complex(*positions["follower"]) - at["moving2"]) <= 1e-7 * span


@pytest.mark.parametrize("name", NAMES)
def test_openscad_numbers_and_joints(name, tmp_path):
    """There is no OpenSCAD among the tests' libraries: its numbers are read, and its brackets."""
    chosen, path = written(name, "openscad", tmp_path)
    text = re.sub(r"//.*", "", path.read_text())
    assert all(text.count(a) == text.count(b) for a, b in ("()", "[]", "{}"))
    scale = scale_of(chosen)
    near = SPANS * span_of(chosen, scale)
    at = {}
    for key, value in re.findall(r"^(\w+) = (\[.*?\]|[-\d.e]+);", text, re.M | re.S):
        at[key] = json.loads(value)
    turns = np.exp(1j * np.radians([row[2] for row in at["poses"]]))
    for side, dyad in (("driver", chosen.linkage.first), ("follower", chosen.linkage.second)):
        if not hasattr(dyad, "radius"):
            continue
        assert at[f"{side}_length"] == pytest.approx(float(dyad.radius) * scale, abs=near)
        for row, turn in zip(at["poses"], turns, strict=True):
            pin = complex(*row[:2]) + complex(*at[f"{side}_moving"]) * turn
            gap = abs(pin - complex(*at[f"{side}_fixed"])) - at[f"{side}_length"]
            assert abs(gap) <= near


# The registry ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["crank-rocker, mm", "slider-crank, no unit", "slot drives, um"])
@pytest.mark.parametrize("to", FLAT)
def test_a_file_that_is_not_the_linkage_is_told(name, to, tmp_path):
    """One length or pivot of the linkage, a little off, in what was written: E160."""
    if to == "pylinkage" and "slot" in name:
        return
    chosen, path = written(name, to, tmp_path)
    module = __import__(f"burmester.export.{FORMATS[to].module}", fromlist=["check"])
    check = getattr(module, f"check_{to}", None) or module.check
    check(chosen, path, Options())
    text = path.read_text()
    # Numbers with many digits; not of what only decorates: bodies that are seen, text, and how
    # a dimension is drawn.
    drawn = [
        each.span() for each in re.finditer(r"\nBLOCK\n(?:.*\n){,20}\*D\d+\n(?s:.*?)\nENDBLK", text)
    ]
    found = [
        number
        for line in re.finditer(r".+", text)
        if not any(start < line.start() < end for start, end in drawn)
        and not re.search(rf"<({MERE})", line[0])
        for number in re.compile(r'(?<![\w.])(?<!damping=")-?\d+\.\d{9,}(?:e-\d+)?').finditer(
            text, *line.span()
        )
    ]
    wrong, codes = 0, set()
    picked = some_of(found, 25)
    for number in picked:
        value = float(number[0])
        changed = value + max(abs(value), 0.01 * span_of(chosen, 1.0)) * 1e-4
        path.write_text(text[: number.start()] + repr(changed) + text[number.end() :])
        with suppress(ValueError):  # an outline that is not closed any more
            try:
                check(chosen, path, Options())
                continue
            except BurmesterError as error:
                codes.add(error.code)
        wrong += 1
    assert codes == {"E160"}
    # What only decorates (text, frames, colours) may be off.
    assert wrong >= TOLD[to] * len(picked), (wrong, len(picked))


TOLD = {
    "dxf": 0.55,
    "svg": 0.6,
    "csv": 1.0,
    "json": 0.95,
    "mjcf": 0.95,
    "urdf": 0.8,
    "sdf": 0.8,
    "openscad": 0.95,
    "pylinkage": 1.0,
}


def test_what_fails_its_check_never_comes_to_be(tmp_path, monkeypatch):
    monkeypatch.setattr(mjcf, "number", lambda value: f"{value:.6g}")
    with pytest.raises(BurmesterError) as caught:
        written("crank-rocker, mm", "mjcf", tmp_path)
    assert caught.value.code == "E160"
    assert "at pose 1" in caught.value.why
    assert not list(tmp_path.iterdir())


def test_formats_and_files(tmp_path, monkeypatch):
    chosen = saved("crank-rocker, mm")
    with pytest.raises(InputError, match="no format 'dwg'") as caught:
        export(chosen, "dwg", tmp_path / "a.dwg")
    assert caught.value.code == "E161"
    (path,) = export(chosen, "JSON", tmp_path / "a.json")
    before = path.read_bytes()
    with pytest.raises(InputError) as caught:
        export(chosen, "csv", path)
    assert caught.value.code == "E140"
    assert path.read_bytes() == before
    export(chosen, "csv", path, force=True)
    assert path.read_bytes() != before
    for to, module, package, extra in (
        ("dxf", "ezdxf", "ezdxf", "export"),
        ("gif", "PIL", "pillow", "export"),
        ("mp4", "imageio_ffmpeg", "imageio-ffmpeg", "export"),
        ("step", "build123d", "build123d", "solid"),
    ):
        monkeypatch.setitem(sys.modules, module, None)
        with pytest.raises(InputError, match=f"{to} needs {package}, which") as caught:
            export(chosen, to, tmp_path / f"a.{to}")
        assert (caught.value.code, caught.value.help) == (
            "E130",
            f'pip install "burmester[{extra}]"',
        )
    assert [each.name for each in tmp_path.iterdir()] == ["a.json"]
    assert format_of("some/where.SCAD") == "openscad"
    assert format_of("none") is None
    assert set(exported.FORMATS) >= set(FLAT)


def test_from_poses_to_files(tmp_path):
    """From a template by the command to every file; the pivots are those that the command told."""
    task = tmp_path / "gripper.toml"
    task.write_text(templates.text("gripper"))
    command = [sys.executable, "-m", "burmester", "synthesize", str(task), "--json"]
    told = subprocess.run(command, capture_output=True, check=True).stdout
    result = tmp_path / "result.json"
    result.write_bytes(told)
    kinds = set()
    for data in json.loads(told)["linkages"]:
        if (kind := frozenset(each["kind"] for each in data["dyads"])) in kinds:
            continue
        kinds.add(kind)
        chosen = read_result(result).choose(data["id"])
        for to in FLAT:
            if to == "pylinkage" and any(each["kind"] == "RP" for each in data["dyads"]):
                continue
            export(chosen, to, tmp_path / f"{data['id']}{FORMATS[to].suffix}")
        block = ezdxf.readfile(tmp_path / f"{data['id']}.dxf").blocks.get("ASSEMBLY")
        holes = [tuple(each.dxf.center) for each in block.query("CIRCLE")]
        at = data["coupler"][0]
        for dyad in data["dyads"]:
            if "fixed_pivot" in dyad:
                assert nearest(holes, complex(*dyad["fixed_pivot"])) <= 1e-6
            if "moving_pivot" in dyad:
                turn = np.exp(1j * np.radians(at["angle_deg"]))
                pin = complex(at["x"], at["y"]) + complex(*dyad["moving_pivot"]) * turn
                assert nearest(holes, pin) <= 1e-6
    assert kinds == {frozenset(each) for each in (["RR"], ["RP", "RR"], ["PR", "RR"], ["PR", "RP"])}


def test_a_body_that_only_translates(tmp_path):
    chosen = saved("trammel, mm")
    flat = np.zeros(6)
    places = Displacement(chosen.error.places.translation, flat)
    still = replace(
        chosen,
        linkage=Linkage(chosen.linkage.first, PP(np.array(0.0))),
        error=replace(chosen.error, places=places),
    )
    for to in ("dxf", "svg", "csv", "mjcf", "urdf", "sdf", "openscad", "pylinkage"):
        with pytest.raises(InputError) as caught:
            export(still, to, tmp_path / "a.out")
        assert caught.value.code == "E163", to
    export(still, "json", tmp_path / "a.json")


def test_a_hull_has_the_corners_of_points_on_both_sides_of_the_origin_once():
    square = np.array([[1.0, 1], [-1, -1], [1, -1], [-1, 1]])
    points = np.concatenate([square, square, 0.3 * square, [[0, 1], [0, 0]]])
    hull = convex_hull(points)
    assert sorted(hull.tolist()) == sorted(square.tolist())
    (ax, ay), (bx, by) = hull[1] - hull[0], hull[2] - hull[1]
    assert ax * by - ay * bx > 0  # counter-clockwise


@pytest.mark.parametrize("to", [*FLAT, "pdf", "step"])
def test_a_linkage_without_a_place_for_a_pose_is_refused(to, tmp_path):
    chosen = saved("crank-rocker, mm")
    for first, which in ((4, np.arange(6) == 3), (1, np.arange(6) >= 0)):
        angle = np.where(which, np.nan, chosen.error.places.angle)
        missed = replace(chosen.error, places=replace(chosen.error.places, angle=angle))
        with pytest.raises(InputError) as caught:
            export(replace(chosen, error=missed), to, tmp_path / f"out{FORMATS[to].suffix}")
        assert caught.value.code == "E163"
        assert f"pose {first}" in caught.value.message or to == "csv"
    assert not list(tmp_path.iterdir())
