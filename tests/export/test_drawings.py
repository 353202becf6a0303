"""Dimension lines of DXF and SVG, by ezdxf and svgelements, against the dyads' lengths."""

import io
import itertools
import re
from collections import Counter
from xml.etree import ElementTree

import ezdxf
import ezdxf.math
import numpy as np
import pytest
from benchmarks import drawings as campaign

import burmester
from burmester import End, Loads, Mass, Spring, Task, synthesize
from burmester.errors import BurmesterError
from burmester.export import Options
from burmester.export.drawings import dxf, svg
from burmester.export.drawings.sheet import laid_lengthwise
from burmester.export.parts.plate import distances
from burmester.export.parts.plates import assembly_of
from burmester.geometry.regions import box
from tests.oracles.common_tasks import in_line
from tests.oracles.handed_over import NAMES, dxf_unit, joints, saved, scale_of, written


def hole_distances(chosen):
    """Every distance of two holes in one plate, in mm, from the dyads: {plate: length}."""
    at = {key: z * scale_of(chosen) for key, z in joints(chosen, 0).items()}
    pairs = {
        "driver": ("fixed1", "moving1"),
        "follower": ("fixed2", "moving2"),
        "ground": ("fixed1", "fixed2"),
        "coupler": ("moving1", "moving2"),
    }
    return {
        name: abs(at[one] - at[two])
        for name, (one, two) in pairs.items()
        if one in at and two in at
    }


def entities(path):
    return list(ezdxf.readfile(path).modelspace().query("DIMENSION"))


def shown(document, entity):
    """The number that a dimension shows, and how far it may be from the measurement."""
    (text,) = document.blocks.get(entity.dxf.geometry).query("MTEXT")
    number = re.match(r"(?:%%c)?(-?[\d.]+)", text.text)[1]
    return float(number), 0.5 * 10 ** -len(number.partition(".")[2]) * 1.001


@pytest.mark.parametrize("name", NAMES)
def test_dxf_measures_the_links(name, tmp_path):
    chosen, path = written(name, "dxf", tmp_path)
    document = ezdxf.readfile(path)
    found = entities(path)
    assert {each.dxf.layer for each in found} == {"DIMENSIONS"}
    _, unit = dxf_unit(chosen)
    straight = [unit * each.get_measurement() for each in found if each.dimtype == 0]
    round_ones = [unit * each.get_measurement() for each in found if each.dimtype == 3]
    made = assembly_of(chosen, Options())
    wanted = hole_distances(chosen)
    if made.plate("ground-2") is not None:  # its holes are in two plates
        wanted.pop("ground", None)
    for plate, length in wanted.items():
        assert min(abs(np.array(straight) - length)) <= 1e-6, plate
        whole = length + made.dimensions.width
        if plate in ("driver", "follower"):
            assert min(abs(np.array(straight) - whole)) <= 1e-6, plate
            assert min(abs(np.array(straight) - made.dimensions.width)) <= 1e-6, plate
    holes = sum(len(plate.holes) + len(plate.slots) for plate in made.plates)
    assert len(round_ones) == holes
    np.testing.assert_allclose(round_ones, made.dimensions.hole, atol=1e-6)
    # What is shown is what is measured, rounded; inches of the shop's list by their names, too.
    for entity in found:
        number, half = shown(document, entity)
        assert number == pytest.approx(entity.get_measurement(), abs=half)
        text = document.blocks.get(entity.dxf.geometry).query("MTEXT")[0].text
        if (named := re.search(r"\[(?:(\d+) )?(?:(\d+)/(\d+) )?in\]", text)) is not None:
            whole, part, of = (int(each or 0) for each in named.groups())
            assert whole + part / (of or 1) == pytest.approx(entity.get_measurement())
        assert unit == 25.4 or "[" not in text


@pytest.mark.parametrize("to", ["dxf", "svg"])
def test_without_dimensions_the_drawing_is_the_same_but_for_them(to, tmp_path):
    """What is cut does not depend on them, but for where it lies on the sheet."""
    cut = []
    for number, dimensions in enumerate((True, False)):
        folder = tmp_path / str(number)
        folder.mkdir()
        _, path = written("trammel, mm", to, folder, Options(dimensions=dimensions))
        if to == "dxf":
            space = ezdxf.readfile(path).modelspace()
            cut.append(
                Counter(
                    (each.dxftype(), each.dxf.layer, len(each) if "POLY" in each.dxftype() else 0)
                    for each in space
                    if each.dxf.layer != "DIMENSIONS"
                )
            )
            assert bool(space.query('DIMENSION[layer=="DIMENSIONS"]')) == dimensions
        else:
            text = path.read_text()
            assert ('id="dimensions"' in text) == dimensions
            plain = re.sub(r'<g id="dimensions".*?</g>\n</g>\n</g>', "", text, flags=re.S)
            cut.append(Counter(re.findall(r'class="(?:outline \w+|hole|slot|mark)"', plain)))
            assert ('class="dimension"' in plain) is False
    assert cut[0] == cut[1]


@pytest.mark.parametrize("name", NAMES)
def test_svg_tells_the_links(name, tmp_path):
    elements = pytest.importorskip("svgelements")
    chosen, path = written(name, "svg", tmp_path)
    drawing = elements.SVG.parse(io.StringIO(path.read_text().replace('mm"', '"')))
    groups = {each.id: each for each in drawing.select(lambda e: isinstance(e, elements.Group))}
    wanted = hole_distances(chosen)
    if "part-ground-2" in groups:
        wanted.pop("ground", None)
    for plate, length in wanted.items():
        own = groups[f"dimensions-{plate}"]
        lines = [
            [complex(each.x1, each.y1), complex(each.x2, each.y2)]
            for each in own.select(lambda e: isinstance(e, elements.SimpleLine))
        ]
        holes = [
            complex(each.cx, each.cy)
            for each in groups[f"part-{plate}"].select(lambda e: isinstance(e, elements.Circle))
        ]
        assert abs(holes[0] - holes[1]) == pytest.approx(length, rel=1e-9)
        # Extension lines begin at both holes, and the line between them is as long and told so.
        from_holes = [
            line for line in lines if min(abs(line[0] - z) for z in holes) < 1e-9 * length
        ]
        assert len(from_holes) >= 2
        numbers = [
            float(each.text.removeprefix("Ø").partition(" [")[0])
            for each in own.select(lambda e: isinstance(e, elements.Text))
        ]
        assert min(abs(np.array(numbers) - length)) <= 1e-3 * length


@pytest.mark.parametrize("name", NAMES)
def test_text_is_clear_of_the_plates_and_of_other_text(name):
    assembly = assembly_of(saved(name), Options())
    letters = 0.35 * assembly.dimensions.width
    for laid in laid_lengthwise(assembly, letters, 3, True):
        corners = laid.place.act(laid.plate.skeleton)
        for line in laid.lines:
            assert distances(line.box, corners) >= laid.plate.radius, (laid.label, line.text)
        for one, two in itertools.combinations(laid.lines, 2):
            assert distances(one.box, two.box) > 0.2 * letters, (one.text, two.text)
        # No text on a line, but where there is no room at all.
        crossed = [
            (one.text, two.text)
            for one, two in itertools.permutations(laid.lines, 2)
            if any(distances(one.box, each) == 0 for each in two.lines)
        ]
        assert len(crossed) <= 1, crossed


@pytest.mark.parametrize("what", ["measurement", "text", "end"])
def test_a_wrong_dimension_is_told(what, tmp_path):
    chosen, path = written("crank-rocker, mm", "dxf", tmp_path)
    document = ezdxf.readfile(path)
    entity = document.modelspace().query("DIMENSION")[0]
    block = document.blocks.get(entity.dxf.geometry)
    if what == "measurement":
        entity.dxf.defpoint2 = ezdxf.math.Vec3(0.01, 0, 0) + entity.dxf.defpoint2
    elif what == "text":
        text = block.query("MTEXT")[0]
        text.text = str(float(text.text) + 0.1)
    else:
        line = block.query("LINE")[1]
        line.dxf.end = ezdxf.math.Vec3(0.01, 0, 0) + line.dxf.end
    document.saveas(path)
    with pytest.raises(BurmesterError) as caught:
        dxf.check(chosen, path, Options())
    assert caught.value.code == "E160"


def test_a_wrong_number_in_an_svg_is_told(tmp_path):
    chosen, path = written("crank-rocker, mm", "svg", tmp_path)
    text = path.read_text()
    path.write_text(text.replace(">70.71<", ">70.17<"))
    with pytest.raises(BurmesterError, match="was deleted"):
        svg.check(chosen, path, Options())


def test_random_linkages_are_drawn():
    """A sample of `benchmarks/drawings.py`."""
    found = campaign.campaign(4, 7)
    assert found["linkages"] == 4
    assert found["dxf"] == found["svg"] == 4 - found["E163"] - found["E162"]
    assert not any("E160" in key for key in found)
    assert found["on a plate"] == found["on text"] == 0
    assert found["on a line"] <= 0.1 * found["texts"]


@pytest.mark.parametrize("to", ["dxf", "svg"])
@pytest.mark.parametrize(("digits", "start"), [(6, 10), (4, 10), (3, 0)])
def test_drawings_of_synthesized_sliders_pass_their_check(to, digits, start, tmp_path):
    """Corners of their plates are nearly on a line, by the printed digits, as far as the end."""
    rows = in_line(start + np.arange(7) * 45, digits)
    result = burmester.synthesize(rows, angle_unit="deg", length_unit="mm")
    for found in result.usable:
        path = found.export(tmp_path / f"{found.id}.{to}")
        assert path.stat().st_size > 0


@pytest.mark.parametrize("to", ["dxf", "svg"])
def test_what_is_off_by_a_few_of_its_digits_is_refused(to, tmp_path):
    """The bound follows from the digits that the format carries, not from a fixed length."""
    chosen, path = written("crank-rocker, mm", to, tmp_path)
    check = {"dxf": dxf.check, "svg": svg.check}[to]
    text = path.read_text()
    before, after = {"svg": (' r="', '"'), "dxf": ("\n 40\n", "\n")}[to]
    (hole,) = (
        set(re.findall(r'class="hole"[^>]* r="([\d.]+)"', text))
        if to == "svg"
        else {str(each.dxf.radius) for each in ezdxf.readfile(path).modelspace().query("CIRCLE")}
    )
    for off, refused in ((1e-8, True), (1e-14, False)):
        number = repr(float(hole) * (1 + off))
        changed = text.replace(f"{before}{hole}{after}", f"{before}{number}{after}")
        assert changed != text
        path.write_text(changed)
        if refused:
            with pytest.raises(BurmesterError) as caught:
                check(chosen, path, Options())
            assert caught.value.code == "E160"
        else:
            check(chosen, path, Options())


def test_a_drawing_of_a_task_in_inches_is_in_inches(tmp_path):
    _, path = written("double-rocker, in", "dxf", tmp_path)
    document = ezdxf.readfile(path)
    assert document.header["$INSUNITS"] == 1
    told = " ".join(each.dxf.text for each in document.modelspace().query("TEXT"))
    assert "Lengths are in inches." in told
    assert not re.search(r"\bin in\b|\bmm\b|e-1\d", told)
    low, high = document.header["$EXTMIN"], document.header["$EXTMAX"]
    x = [at[0] for each in document.modelspace().query("LWPOLYLINE") for at in each.get_points()]
    assert low[0] < min(x) < max(x) < high[0]


def test_springs_are_marked_where_they_are_attached(tmp_path):
    """On the ground, and on the body at the first pose; all are told in words."""
    ends = End("ground", (85.0, -40.5)), End("body", (30.0, 18.0))
    springs = (
        Spring("extension", ends, {"rate_N_per_mm": 0.5, "free_length": 5}, 2),
        Spring("torsion", (End("ground", (0, 0)), End("driver", (0, 0))), {"rate_Nm_per_deg": 0.1}),
    )
    rows = [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)]
    loads = Loads(body=Mass(4.0, [30.0, 0.0], 0.01), springs=springs)
    task = Task.from_rows(
        rows,
        angle_unit="deg",
        length_unit="mm",
        loads=loads,
        body=box((0, 0), (90, 30)),
    )
    path = synthesize(task).best.export(tmp_path / "a.svg")
    root = ElementTree.parse(path).getroot()
    poses = next(each for each in root.iter() if each.get("id") == "poses")
    lines = [[float(each.get(key)) for key in ("x1", "y1", "x2", "y2")]
             for each in poses if each.tag.endswith("line")]  # fmt: skip
    middles = [((x1 + x2) / 2, -(y1 + y2) / 2) for x1, y1, x2, y2 in lines]
    for wanted in ((85.0, -40.5), (30.0, 18.0)):
        near = [at for at in middles if np.hypot(*np.subtract(at, wanted)) < 1e-9]
        assert len(near) == 2  # a cross
    texts = [each.text for each in poses if each.tag.endswith("text")]
    assert texts.count("S1") == 2
    assert "S2" not in texts
    told = " ".join(root.itertext())
    assert "S1, extension spring (2 of them): (85.0" in told
    assert "S2, torsion spring between the ground and the driver." in told
