"""The body and its surroundings in drawings, read by ezdxf and svgelements."""

import io
import re
from dataclasses import replace
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest

from burmester import KeepOut, Polygon, Surroundings
from burmester.errors import BurmesterError
from burmester.export import Options, export
from burmester.export.drawings import dxf, svg
from burmester.export.drawings.sheet import hatch
from tests.oracles.bodies import BODY, HOSTILE, carried, same_ring
from tests.oracles.handed_over import NAMES, complex_places, saved, scale_of

HORSESHOE = np.array([(0, 0), (5, 0), (5, 4), (4, 4), (4, 1), (1, 1), (1, 4), (0, 4)])


def outlined(name, hostile=HOSTILE):
    """A linkage with a body and two regions, in sizes of its motion; and their corners in mm."""
    chosen = saved(name)
    at = chosen.task.poses.translation
    size = float(np.ptp(at, axis=0).max())
    body = size * np.array(BODY)
    shapes = [
        size * (HORSESHOE + 3) + at.max(axis=0),
        size * (np.array(BODY[:3]) - 5) + at.min(axis=0),
    ]
    kept = [
        KeepOut(Polygon(each), text) for each, text in zip(shapes, (hostile, None), strict=True)
    ]
    task = replace(chosen.task, body=Polygon(body), surroundings=Surroundings(tuple(kept)))
    scale = scale_of(chosen)
    d, turn = complex_places(chosen)
    bodies = scale * carried(body, d.real, d.imag, np.angle(turn))
    return replace(chosen, task=task), bodies, [scale * each for each in shapes], kept[0].name


def of_dxf(path):
    """Rings by layer, hatch lines, texts, and the layers of all that is cut."""
    document = ezdxf.readfile(path)
    assert not document.audit().errors
    space, unit = document.modelspace(), {4: 1.0, 1: 25.4}[document.header["$INSUNITS"]]

    def on(kind, layer):
        return [each for each in space.query(kind) if each.dxf.layer == layer]

    rings = {
        layer: [np.array(each.get_points("xyb")) for each in on("LWPOLYLINE", layer)]
        for layer in ("BODY", "KEEP_OUT")
    }
    assert all((each[:, 2] == 0).all() for rows in rings.values() for each in rows)
    lines = [
        (unit * complex(*each.dxf.start.vec2), unit * complex(*each.dxf.end.vec2))
        for each in on("LINE", "KEEP_OUT")
    ]
    texts = [each.dxf.text for each in on("TEXT", "KEEP_OUT")]
    assert not any(re.search(r"%%|\\[UM]\+|\^(?! )", each) for each in texts)  # no codes of DXF
    kept = [[unit * each[:, :2] for each in rings[layer]] for layer in ("BODY", "KEEP_OUT")]
    return *kept, lines, texts


def of_svg(path):
    elements = pytest.importorskip("svgelements")
    # Its millimetre has six digits: the drawing is read in units, of which each is a millimetre.
    read = elements.SVG.parse(io.StringIO(path.read_text().replace('mm"', '"')))
    box = read.viewbox

    def point(at):
        return at.x + box.x, -(at.y + box.y)

    def ring(each):
        corners = [point(part.end) for part in each if not isinstance(part, elements.Close)]
        assert corners[-1] == corners[0]
        return np.array(corners[:-1])

    groups = {each.id: each for each in read.elements() if getattr(each, "id", None)}
    found = [
        [
            ring(elements.Path(each))
            for each in groups[name].select(lambda e: isinstance(e, elements.Path))
        ]
        for name in ("body", "keep-out")
    ]
    lines = [
        (complex(*point(elements.Point(e.x1, e.y1))), complex(*point(elements.Point(e.x2, e.y2))))
        for e in groups["keep-out"].select(lambda e: isinstance(e, elements.SimpleLine))
    ]
    texts = [e.text for e in groups["keep-out"].select(lambda e: isinstance(e, elements.Text))]
    return *found, lines, texts


READ = {"dxf": of_dxf, "svg": of_svg}


@pytest.mark.parametrize("to", READ)
@pytest.mark.parametrize("name", NAMES)
def test_the_body_is_at_every_place_and_regions_are_hatched(name, to, tmp_path):
    chosen, bodies, regions, text = outlined(name)
    (path,) = export(chosen, to, tmp_path / f"out.{to}")
    body, kept, lines, texts = READ[to](path)
    near = 1e-6 * max(1.0, np.abs(bodies).max())
    assert len(body) == len(bodies)
    for ring, corners in zip(body, bodies, strict=True):
        assert same_ring(ring, corners) < near
    assert len(kept) == len(regions)
    for ring, corners in zip(kept, regions, strict=True):
        assert same_ring(ring, corners) < near
    middles = np.array([(start + end) / 2 for start, end in lines])
    inside = [np.abs(turns(corners, middles)) > 0.5 for corners in regions]
    assert len(lines) > 10
    assert np.logical_or(*inside).all()
    assert all(each.any() for each in inside)
    (shown,) = texts
    assert plain(shown) == plain(text)


def turns(corners, points):
    """How often a ring of corners goes round each of points (n,), complex."""
    z = corners @ [1, 1j] - np.asarray(points)[:, None]
    return np.angle(np.roll(z, -1, axis=1) / z).sum(axis=1) / (2 * np.pi)


def plain(text):
    """Without blanks: in DXF they break codes."""
    return text.replace(" ", "")


@pytest.mark.parametrize("to", READ)
def test_what_is_cut_and_the_assembly_stay_as_they_are(to, tmp_path):
    """With a body and without: the same plates, but for where they lie on the sheet."""
    chosen, *_ = outlined("crank-rocker, mm")
    counted = []
    for number, each in enumerate((chosen, saved("crank-rocker, mm"))):
        (path,) = export(each, to, tmp_path / f"{number}.{to}")
        text = path.read_text(encoding="utf-8")
        if to == "svg":
            counted.append([text.count(f'class="{kind}') for kind in ("outline", "hole", "pose")])
        else:
            space = ezdxf.readfile(path).modelspace()
            layers = ("GROUND", "DRIVER", "COUPLER", "FOLLOWER", "HOLES", "SLOTS", "POSES")
            counted.append([sum(e.dxf.layer == layer for e in space) for layer in layers])
    assert counted[0] == counted[1]


@pytest.mark.parametrize("to", READ)
@pytest.mark.parametrize("what", ["body", "region", "pose"])
def test_a_wrong_outline_is_told(what, to, tmp_path):
    """The file's own check has the task: a file for another one is refused."""
    chosen, *_ = outlined("crank-rocker, mm")
    path = tmp_path / f"out.{to}"
    export(chosen, to, path)
    corners = chosen.task.body.vertices * [1, 1.0001]
    around = chosen.task.surroundings
    moved = KeepOut(Polygon(around.keep_out[0].polygon.vertices + 1e-3))
    other = {
        "body": {"body": Polygon(corners)},
        "region": {"surroundings": Surroundings((moved, around.keep_out[1]))},
        "pose": {"body": None},
    }[what]
    wrong = replace(chosen, task=replace(chosen.task, **other))
    check = {"dxf": dxf.check, "svg": svg.check}[to]
    check(chosen, path, Options())
    with pytest.raises(BurmesterError) as refused:
        check(wrong, path, Options())
    assert refused.value.code == "E160"


def test_a_hatch_covers_a_region_and_nothing_else():
    lines = hatch(HORSESHOE.astype(float), 0.05)
    z = lines @ [1, 1j]
    assert np.angle(z[:, 1] - z[:, 0]) == pytest.approx(np.pi / 4)
    shares = np.linspace(1e-6, 1 - 1e-6, 50)
    inner = (z[:, :1] + shares * (z[:, 1:] - z[:, :1])).ravel()
    assert (np.abs(turns(HORSESHOE, inner)) > 0.5).all()
    level = (z[:, 0] * np.exp(-1j * np.pi / 4)).imag
    spacing = np.diff(np.unique(np.round(level, 9)))
    assert np.ptp(spacing) < 1e-6
    # Area by strips as wide as the lines are apart: 5 x 4 without 3 x 3.
    assert abs(z[:, 1] - z[:, 0]).sum() * spacing[0] == pytest.approx(11, rel=0.02)


def test_a_simulator_shows_the_body_and_lets_it_meet_nothing(tmp_path):
    mujoco = pytest.importorskip("mujoco")
    chosen, bodies, *_ = outlined("crank-rocker, mm")
    models = []
    for number, each in enumerate((chosen, saved("crank-rocker, mm"))):
        (path,) = export(each, "mjcf", tmp_path / f"{number}.xml")
        models.append(mujoco.MjModel.from_xml_path(str(path)))
    model, bare = models
    assert model.body_mass.tolist() == bare.body_mass.tolist()
    assert model.body_inertia.tolist() == bare.body_inertia.tolist()
    seen = np.flatnonzero((model.geom_contype == 0) & (model.geom_conaffinity == 0))
    assert len(seen) == model.ngeom - bare.ngeom == len(BODY)
    data = mujoco.MjData(model)
    for k, corners in enumerate(bodies / 1000):
        mujoco.mj_resetDataKeyframe(model, data, k)
        mujoco.mj_forward(model, data)
        middles = (corners + np.roll(corners, -1, axis=0)) / 2
        assert same_ring(data.geom_xpos[seen, :2], middles) < 1e-9
        along = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
        assert sorted(2 * model.geom_size[seen, 0]) == pytest.approx(sorted(along))


def test_a_robot_description_shows_the_body_without_a_collision_shape(tmp_path):
    chosen, *_ = outlined("crank-rocker, mm")
    (path,) = export(chosen, "urdf", tmp_path / "out.urdf")
    (link,) = ElementTree.parse(path).getroot().findall("link[@name='coupler']")
    solid = [ElementTree.tostring(each) for each in link.iter("collision")]
    seen = [
        each
        for each in link.iter("visual")
        if ElementTree.tostring(each).replace(b"visual", b"collision") not in solid
    ]
    assert len(seen) == len(BODY)
    lengths = [float(each.find("geometry/box").get("size").split()[0]) for each in seen]
    corners = chosen.task.body.vertices
    wanted = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1) / 1000
    assert sorted(lengths) == pytest.approx(sorted(wanted))
