"""Outlines from drawings: what is read, in which unit, how truly, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from burmester import InputError, read_task
from burmester.io.reading.outline_options import OutlineOptions
from burmester.io.reading.outlines.outline_file import OutlineFile, outline_named, read_outline
from tests.oracles.drawings import dxf, svg

TASK = """angle_unit = "deg"
length_unit = "mm"
poses = [[0, 0, 0], [60, 20, 30], [90, 60, 60]]
"""


@pytest.fixture
def read(tmp_path):
    """Read the outline in a drawing of these bytes: a Shapely polygon, and how it was read."""

    def read(data, name, part=None, unit="mm"):
        (tmp_path / name).write_bytes(data)
        outline, note = read_outline(OutlineFile(name, part), str(tmp_path), unit)
        return shapely.Polygon(outline.vertices), note

    return read


def square(document, space, layer="0", size=10.0, at=(0.0, 0.0)):
    x, y = at
    corners = [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]
    space.add_lwpolyline(corners, close=True, dxfattribs={"layer": layer})


def test_arcs_and_splines_become_chords_within_what_is_told(read):
    def slot(document, space):
        space.add_line((0, 0), (40, 0))
        space.add_arc((40, 10), 10, -90, 90)
        space.add_line((0, 20), (40, 20.0004))  # ends meet but for a rounding
        space.add_arc((0, 10), 10, 90, 270)

    outline, note = read(dxf(slot), "slot.dxf")
    true = shapely.LineString([(0, 10), (40, 10)]).buffer(10, quad_segs=2000)
    assert shapely.hausdorff_distance(outline, true) < 0.02
    assert outline.area == pytest.approx(800 + 100 * np.pi, rel=2e-3)
    assert "4 curves are joined" in note.why
    assert "chords within 0.013 mm" in note.why
    assert note.code == "W218"


@pytest.mark.parametrize(("units", "factor"), [(4, 1.0), (5, 10.0), (1, 25.4), (6, 1000.0)])
def test_the_unit_of_a_dxf_is_honoured(read, units, factor):
    outline, _ = read(dxf(square, units), "a.dxf")
    assert outline.bounds == pytest.approx((0, 0, 10 * factor, 10 * factor))
    inches, _ = read(dxf(square, units), "a.dxf", unit="in")
    assert inches.bounds[2] == pytest.approx(10 * factor / 25.4)


def test_a_dxf_without_a_unit_has_that_of_the_poses(read):
    outline, note = read(dxf(square, 0), "a.dxf", unit=None)
    assert outline.area == pytest.approx(100)
    assert "states no unit" in note.why


@pytest.mark.parametrize(
    ("size", "scale"),
    [
        ('width="100mm" height="80mm" viewBox="0 0 100 80"', 1.0),
        ('width="20cm" height="16cm" viewBox="0 0 100 80"', 2.0),
        ('width="4in" viewBox="0 0 100 80"', 1.016),
        ('width="400" height="320" viewBox="0 0 100 80"', 4 * 25.4 / 96),
        ('viewBox="0 0 100 80"', 25.4 / 96),
        ("", 25.4 / 96),
        ('width="100%" height="100%" viewBox="0 0 100 80"', 25.4 / 96),
    ],
)
def test_the_size_of_an_svg_is_honoured_and_y_points_up(read, size, scale):
    outline, note = read(svg('<rect id="lid" x="10" y="20" width="30" height="5"/>', size), "a.svg")
    assert outline.bounds == pytest.approx(np.array([10, -25, 40, -20]) * scale, rel=1e-6)
    assert "y points down in SVG" in note.why
    assert ("1/96 inch" in note.why) == (scale not in (1.0, 2.0, 1.016))


def bezier(t, points, binomials):
    last = len(points) - 1
    parts = zip(binomials, points, strict=True)
    return sum(c * t**k * (1 - t) ** (last - k) * p for k, (c, p) in enumerate(parts))


def test_curves_of_svg_are_followed(read):
    path = '<path d="M0 0 H20 A10 10 0 0 1 20 20 C 10 25 5 25 0 20 Q -5 10 0 0 z"/>'
    outline, note = read(svg(path), "a.svg")
    t = np.linspace(0, 1, 4001)[:, None]
    arc = [(20 + 10 * np.sin(a), 10 - 10 * np.cos(a)) for a in np.linspace(0, np.pi, 4001)]
    ends = np.array([(20, 20), (10, 25), (5, 25), (0, 20)])
    cubic = bezier(t, ends, (1, 3, 3, 1))
    quadratic = bezier(t, np.array([(0, 20), (-5, 10), (0, 0)]), (1, 2, 1))
    true = shapely.Polygon(np.concatenate([[(0, 0)], arc, cubic, quadratic]) * [1, -1])
    assert shapely.hausdorff_distance(outline, true) < 0.01
    assert "chords" in note.why


def test_a_layer_of_blocks_and_an_id_of_groups(read):
    def drawn(document, space):
        block = document.blocks.new("B")
        square(document, block)
        space.add_blockref("B", (5, 5), dxfattribs={"rotation": 90, "xscale": 2, "layer": "LID"})
        square(document, space, "HOLES", 3)

    outline, _ = read(dxf(drawn), "a.dxf", "lid")
    assert outline.bounds == pytest.approx((-5, 5, 5, 25))
    turned = '<g id="g" transform="rotate(90)"><rect id="a" width="4" height="2"/></g>'
    inside = turned + '<circle r="9"/>'
    for part in ("g", "a"):
        outline, _ = read(svg(inside), "a.svg", part)
        assert outline.bounds == pytest.approx((-2, -4, 0, 0))
    label = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" viewBox="0 0 9 9"'
    layer = '<g inkscape:label="Lid plate"><rect width="4" height="2"/></g><circle r="9"/>'
    assert read(svg(layer, label), "a.svg", "Lid plate")[0].area > 0


def test_outlines_of_thousands_of_corners_have_fewer(read):
    angle = np.linspace(0, 2 * np.pi, 6001)[:-1]
    corners = np.stack([50 * np.cos(angle), 30 * np.sin(angle)], axis=-1)

    def drawn(document, space):
        space.add_lwpolyline(corners, close=True)

    outline, note = read(dxf(drawn), "a.dxf")
    assert len(outline.exterior.coords) < 2000
    assert shapely.hausdorff_distance(outline, shapely.Polygon(corners)) < 0.05
    assert "within 0.047 mm" in note.why


def two_squares(document, space):
    square(document, space, "A", 10)
    square(document, space, "B", 4, (20, 0))


def gap(document, space):
    for one, other in (((0, 0), (9, 0)), ((9, 0.2), (9, 9)), ((9, 9), (0, 0))):
        space.add_line(one, other)


def tee(document, space):
    for one, other in (((0, 0), (9, 0)), ((9, 0), (9, 9)), ((9, 9), (0, 0)), ((9, 9), (20, 20))):
        space.add_line(one, other)


def bow_tie(document, space):
    space.add_lwpolyline([(0, 0), (10, 0), (0, 10), (10, 10)], close=True)


def block_bomb(document, space):
    document.blocks.new("B0").add_line((0, 0), (1, 0))
    for k in range(1, 12):
        block = document.blocks.new(f"B{k}")
        for j in range(10):
            block.add_blockref(f"B{k - 1}", (j, 0))
    space.add_blockref("B11", (0, 0))


USES = "".join(f'<g id="x{k}">' + f'<use href="#x{k - 1}"/>' * 10 + "</g>" for k in range(1, 10))
RECT = '<rect width="4" height="2"/>'


def bent(document, space):
    space.add_lwpolyline([(k, k % 7, 1) for k in range(21_000)], format="xyb", close=True)


REFUSED = {  # drawings are made when they are read
    "two closed curves": (lambda: dxf(two_squares), "a.dxf", "E172", "layer 'A'"),
    "no such layer": (lambda: dxf(two_squares), "a.dxf:C", "E173", "'A' and 'B'"),
    "a gap": (lambda: dxf(gap), "a.dxf", "E171", "ends 0.2 apart are at (9, 0"),
    "a branch": (lambda: dxf(tee), "a.dxf", "E171", "none closes"),
    "text alone": (lambda: dxf(lambda d, s: s.add_text("hi")), "a.dxf", "E171", "no curves"),
    "a bow tie": (lambda: dxf(bow_tie), "a.dxf", "E131", "near (5, 5)"),
    "millimetres for no unit": (lambda: dxf(square), "a.dxf", "E174", "states no unit"),
    "an unknown unit": (lambda: dxf(square), "a.dxf", "E174", "parsec"),
    "a bomb of blocks": (lambda: dxf(block_bomb), "a.dxf", "E170", "20000 curves"),
    "a DWG file": (b"AC1032" + bytes(50), "a.dxf", "E170", "DWG"),
    "half a file": (lambda: dxf(square)[:9000], "a.dxf", "E170", "cut off"),
    "damaged DXF": (
        b"  0\nSECTION\n  2\nENTITIES\nx\nLINE\n  0\nEOF\n",
        "a.dxf",
        "E170",
        "damaged",
    ),
    "an empty file": (b"", "a.dxf", "E170", "empty"),
    "9 MB": (bytes(9_000_000), "a.dxf", "E170", "8 MB"),
    "another kind": (b"x", "a.step", "E170", "'.step'"),
    "no XML": (b"hello", "a.svg", "E170", "not XML"),
    "a page": (b"<html/>", "a.svg", "E170", "no svg element"),
    "entities": (b'<!DOCTYPE svg [<!ENTITY a "a">]>' + svg(RECT), "a.svg", "E170", "entities"),
    "groups in groups": (svg("<g>" * 900 + "</g>" * 900), "a.svg", "E170", "200 deep"),
    "a bomb of uses": (svg(f'<g id="x0">{RECT}</g>{USES}'), "a.svg", "E170", "200000 straight"),
    "many arcs": (
        svg(f'<path d="M0 0{"a1 1 0 0 1 1 1a1 1 0 0 1-1-1" * 60_000}z"/>'),
        "a.svg",
        "E170",
        "200000 straight",
    ),
    "many corners": (
        svg(f'<polygon points="{"0,0 1,1 " * 250_000}"/>'),
        "a.svg",
        "E170",
        "200000 straight",
    ),
    "many circles": (svg('<circle r="1"/>' * 10_000), "a.svg", "E170", "200000 straight"),
    "a path that is closed again and again": (
        svg(f'<path d="M0 0h1{"z" * 100_000}"/>'),
        "a.svg",
        "E170",
        "200000 straight",
    ),
    "a transform without an end": (
        svg(f'<path transform="{"rotate(" * 50_000}" d="M0 0h1v1z"/>'),
        "a.svg",
        "E170",
        "transform",
    ),
    "a long style sheet": (svg(f"<style>{'a{b:c}' * 50_000}</style>"), "a.svg", "E170", "sheets"),
    "many entries": (
        b"  0\nSECTION\n  2\nENTITIES\n" + b"  0\nARC\n  8\n0\n" * 60_000 + b"  0\nEOF\n",
        "a.dxf",
        "E170",
        "60000 entries",
    ),
    "many arcs of a polyline": (lambda: dxf(bent), "a.dxf", "E170", "20000 curves"),
    "uses itself": (svg('<g id="x"><use href="#x"/></g>'), "a.svg", "E170", "uses itself"),
    "not finite": (svg('<path d="M 0 0 L 1e400 5 5 5z"/>'), "a.svg", "E170", "not finite"),
    "an open path": (svg('<path d="M 0 0 L 9 0 L 9 9"/>'), "a.svg", "E171", "none closes"),
    "no such id": (svg(f'<g id="b">{RECT}</g>'), "a.svg:lid", "E173", "'b'"),
    "no id at all": (svg(RECT), "a.svg:lid", "E173", "it has no id"),
    "an unknown encoding": (b'<?xml version="1.0" encoding="ebc"?><svg/>', "a.svg", "E170", "XML"),
    "no model space": (lambda: dxf(square).replace(b"Model", b"Modle"), "a.dxf", "E170", "damaged"),
    "far away": (lambda: dxf(lambda d, s: square(d, s, size=1e70)), "a.dxf", "E170", "too large"),
    "two shapes": (svg(RECT + '<circle r="3" id="c"/>'), "a.svg", "E172", "circle (id 'c') 6 by 6"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_outline_is_refused(tmp_path, name):
    data, named, code, said = REFUSED[name]
    file = outline_named(named)
    (tmp_path / file.path).write_bytes(data() if callable(data) else data)
    unit = {"millimetres for no unit": None, "an unknown unit": "parsec"}.get(name, "mm")
    with pytest.raises(InputError) as caught:
        read_outline(file, str(tmp_path), unit)
    error = caught.value
    assert error.code == code
    assert error.message.startswith(f"{file.path}: ")
    assert said in f"{error.message} {error.why} {error.help}"
    assert error.help


def test_files_that_are_not_there(tmp_path):
    for path in ("missing.dxf", ".dxf", "a\0b.svg"):
        with pytest.raises(InputError) as caught:
            read_outline(OutlineFile(path), str(tmp_path), "mm")
        assert caught.value.code == "E170"


def test_a_task_names_drawings_beside_it(tmp_path):
    (tmp_path / "lid.dxf").write_bytes(dxf(two_squares))
    (tmp_path / "car.svg").write_bytes(svg('<rect id="bumper" x="70" width="5" height="9"/>'))
    task = tmp_path / "task.toml"
    task.write_text(
        TASK
        + """body = { file = "lid.dxf", layer = "B" }
[[keep_out]]
file = "car.svg"
id = "bumper"
name = "the bumper"
[[keep_out]]
box = [[200, 0], [210, 10]]
[surroundings]
link_width = 8
margin = 1.5
body_in_plane = true
"""
    )
    read = read_task(task)
    assert read.body is not None
    assert read.body.vertices.tolist() == [[20, 0], [24, 0], [24, 4], [20, 4]]
    around = read.surroundings
    assert around is not None
    assert around.names == ("'the bumper'", "region 2")
    np.testing.assert_allclose(
        around.keep_out[0].polygon.vertices, [[70, -9], [75, -9], [75, 0], [70, 0]], atol=1e-6
    )
    assert (around.link_width, around.margin, around.body_in_plane) == (8, 1.5, True)
    assert [note.code for note in read.notes] == ["W218", "W218"]


def test_a_fault_in_a_drawing_is_told_where_the_task_names_it(tmp_path):
    (tmp_path / "lid.dxf").write_bytes(dxf(two_squares))
    task = tmp_path / "task.toml"
    task.write_text(TASK + 'body = "lid.dxf"\n')
    with pytest.raises(InputError) as caught:
        read_task(task)
    assert caught.value.code == "E172"
    assert f'{task}:4:8\n   4 | body = "lid.dxf"' in caught.value.where


def test_options_beside_the_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lid.dxf").write_bytes(dxf(two_squares))
    (tmp_path / "wall.svg").write_bytes(svg('<rect x="70" width="5" height="9"/>'))
    (tmp_path / "task.toml").write_text(TASK + "keep_out = [{ box = [[200, 0], [210, 10]] }]\n")
    options = OutlineOptions("lid.dxf:A", ["wall.svg"], "7.5")
    task = read_task("task.toml", outlines=options)
    assert task.body is not None
    assert task.body.vertices.max() == 10
    assert task.surroundings is not None
    assert task.surroundings.names == ("region 1", "'wall'")
    assert task.surroundings.link_width == 7.5
    (tmp_path / "task.toml").write_text(
        TASK + "body = [[0, 0], [1, 0], [0, 1]]\nsurroundings = { link_width = 3 }\n"
    )
    for option, code, where in (
        (OutlineOptions(body="lid.dxf:A"), "E108", "task.toml"),
        (OutlineOptions(link_width="3"), "E108", "task.toml"),
        (OutlineOptions(link_width="-3"), "E108", "task.toml"),
        (OutlineOptions(keep_out=["lid.dxf"]), "E172", "--keep-out lid.dxf"),
    ):
        with pytest.raises(InputError) as caught:
            read_task("task.toml", outlines=option)
        assert (caught.value.code, caught.value.where) == (code, where)
    (tmp_path / "task.toml").write_text(TASK)
    for text in ("-3", "wide"):
        with pytest.raises(InputError) as caught:
            read_task("task.toml", outlines=OutlineOptions(link_width=text))
        assert caught.value.code == "E176"
        assert "--link-width:1:1" in caught.value.where


def test_a_region_over_the_body_at_a_pose_is_refused(tmp_path):
    task = tmp_path / "task.toml"
    body = "body = [[-5, -5], [5, -5], [5, 5], [-5, 5]]\n"
    task.write_text(
        TASK.replace("30]", "30], { x = 75, y = 40, angle = 45, name = 'open' }").replace(
            "], {", "], {"
        )
        + body
        + '[[keep_out]]\nname = "bumper"\nbox = [[74, 30], [80, 45]]\n'
    )
    with pytest.raises(InputError) as caught:
        read_task(task)
    assert caught.value.code == "E175"
    assert caught.value.message == "the body touches keep-out 'bumper' at pose 3 (open)"
    assert "keep_out" in caught.value.where
