"""Results as a person holds them, beside the command's files and linkages driven joint by joint."""

import io
import json
import re
import subprocess
import sys
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image, ImageSequence

import burmester
from burmester import InputError
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.tasks.motion_task import Task
from tests.oracles.bodies import BODY, REGIONS, bodied, carried, same_ring
from tests.oracles.five_poses import ROWS
from tests.oracles.same_result import differences
from tests.oracles.witness import places

CASES = ("ge2012-approximate", "motiongen-mixed5", "motiongen-prpr", "motiongen-rrpr")


@pytest.fixture(scope="module")
def five():
    return burmester.synthesize(ROWS, angle_unit="deg", length_unit="mm")


@pytest.fixture(scope="module")
def results(five):
    return [five, *(burmester.synthesize(burmester.read_task(f"case:{name}")) for name in CASES)]


# What comes in -----------------------------------------------------------------------------------


def test_rows_radians_a_displacement_and_a_task_are_one_motion(five):
    rows = np.array(ROWS)
    turned = np.column_stack([rows[:, :2], np.radians(rows[:, 2])])
    ways = (
        burmester.synthesize(turned, angle_unit="rad", length_unit="mm"),
        burmester.synthesize(Displacement.from_poses(turned), length_unit="mm"),
        burmester.synthesize(Task(Displacement.from_poses(turned), length_unit="mm")),
    )
    for way in ways:
        assert way.to_json() == five.to_json()


@pytest.mark.parametrize(
    ("given", "code", "words"),
    [
        ({}, "E110", "not stated"),
        ({"angle_unit": "grad"}, "E110", "'grad'"),
        ({"angle_unit": "deg", "poses": Displacement.identity((5,))}, "E110", "are radians"),
        ({"angle_unit": "deg", "poses": "poses.csv"}, "E125", "(N, 3)"),
        ({"angle_unit": "deg", "poses": np.ones((5, 2))}, "E125", "(5, 2)"),
        ({"angle_unit": "deg", "poses": np.ones((2, 5, 3))}, "E125", "(2, 5, 3)"),
        ({"angle_unit": "deg", "poses": [(0, 0, 1j)] * 5}, "E125", "complex"),
        ({"angle_unit": "deg", "poses": np.ma.masked_equal(ROWS, 8.17)}, "E125", "masked"),
        ({"angle_unit": "deg", "poses": [(0, 0), *ROWS]}, "E125", "lengths"),
        ({"angle_unit": "deg", "poses": [(np.nan, 0, 0), *ROWS]}, "E103", "nan"),
        ({"angle_unit": "deg", "poses": ROWS[:1]}, "E120", "1 pose"),
        ({"angle_unit": "deg", "poses": [(1e80, 0, 0), *ROWS]}, "E112", "too large"),
        ({"angle_unit": "deg", "length_unit": 25.4}, "E125", "length unit"),
        ({"angle_unit": "deg", "method": "best"}, "E134", "'best'"),
        ({"angle_unit": "deg", "norm": 2}, "E134", "norm 2"),
        ({"angle_unit": "deg", "certify": "yes"}, "E134", "'yes'"),
        ({"angle_unit": "deg", "rounding_step": -0.5}, "E134", "-0.5"),
        ({"angle_unit": "deg", "rounding_step": True}, "E134", "True"),
        ({"angle_unit": "deg", "time_limit": "2"}, "E134", "'2'"),
        ({"angle_unit": "deg", "progress": "line"}, "E134", "'line'"),
        ({"angle_unit": "deg", "manufacturing_tolerance": np.nan}, "E134", "nan"),
        ({"angle_unit": "deg", "length_per_radian": np.inf}, "E134", "inf"),
        ({"angle_unit": "deg", "length_per_radian": "80"}, "E134", "'80'"),
        ({"angle_unit": "deg", "stock_lengths": [20, 0]}, "E134", "is 0,"),
    ],
)
def test_what_makes_no_sense_is_refused_in_words(given, code, words):
    with pytest.raises(InputError) as refused:
        burmester.synthesize(given.pop("poses", ROWS), **given)
    assert refused.value.code == code
    assert words in str(refused.value)
    assert refused.value.help


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (np.array([[1 + 2j, 3.0]] * 5), "np.column_stack([z.real, z.imag, angle])"),
        (np.ones(5) * 1j, "np.column_stack([z.real, z.imag, angle])"),
        (np.ones((5, 2)), "np.column_stack([x, y, angle])"),
        (np.ones((5, 4)), "np.column_stack([x, y, np.arctan2(sin, cos)])"),
    ],
)
def test_other_shapes_are_refused_with_the_columns_to_give(given, words):
    with pytest.raises(InputError) as refused:
        burmester.synthesize(given, angle_unit="rad")
    assert refused.value.code == "E125"
    assert words in refused.value.help


def test_matrices_are_poses(five):
    x, y, angle = np.array(ROWS).T
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    zero, one = np.zeros(5), np.ones(5)
    matrices = np.array([[c, -s, x], [s, c, y], [zero, zero, one]]).transpose(2, 0, 1)
    result = burmester.synthesize(matrices, length_unit="mm")
    for mine, other in zip(five, result, strict=True):
        assert mine.usable == other.usable
        assert mine.linkage.first.fixed_pivot == pytest.approx(other.linkage.first.fixed_pivot)
    assert burmester.judge(matrices.tolist(), result.best, length_unit="mm").best is not None
    for wrong in (2 * matrices, matrices[:, ::-1], np.swapaxes(matrices, 1, 2)):
        with pytest.raises(InputError) as refused:
            burmester.synthesize(wrong)
        assert refused.value.code == "E125"
        assert "matrix 1 is no displacement" in refused.value.message
    with pytest.raises(InputError) as refused:
        burmester.synthesize(matrices, angle_unit="deg")
    assert refused.value.code == "E110"


def test_a_task_keeps_its_own_numbers():
    rows, weights, exact = np.array(ROWS), np.ones(5), np.zeros(5, dtype=bool)
    poses = Displacement(rows[:, :2], np.radians(rows[:, 2]))
    task = Task(poses, weights=weights, exact=exact)
    rows += 1.0
    weights *= 2.0
    exact[:] = True
    assert task.poses.translation.tolist() == [[x, y] for x, y, _ in ROWS]
    assert task.weights.tolist() == [1.0] * 5
    assert not task.exact.any()
    for own in (task.poses.translation, task.poses.angle, task.weights, task.exact):
        with pytest.raises(ValueError, match="read-only"):
            own[0] = 0


@pytest.mark.parametrize(
    "wrong",
    [
        {"weights": [1, 1, 1, 1]},
        {"weights": [1, 1, 1, 1, -1]},
        {"weights": [1, 1, 1, 1, "a"]},
        {"exact": [0, 1, 0, 0, 0]},
        {"exact": "yes"},
        {"names": "shut"},
        {"names": (1, 2, 3, 4, 5)},
        {"resolution": (-1, 0)},
        {"resolution": 0.1},
        {"limits": (None,)},
        {"limits": (burmester.Limits(),) * 3},
        {"requirements": {"transmission": 1}},
    ],
)
def test_a_task_of_wrong_parts_is_refused(wrong):
    poses = Task.from_rows(ROWS, angle_unit="deg").poses
    with pytest.raises(InputError) as refused:
        Task(poses, **wrong)
    assert refused.value.code in ("E122", "E125")
    assert refused.value.help


# What comes out ----------------------------------------------------------------------------------


def test_a_repr_is_short_and_says_what_the_json_says(results):
    few = burmester.synthesize(ROWS[:4], angle_unit="deg")
    for result in [*results, few]:
        lines = repr(result).splitlines()
        assert len(lines) <= 12
        data = json.loads(result.to_json())
        assert data["outcome"]["message"] in lines
        usable = any(each["usable"] for each in data["linkages"])
        assert lines[0].startswith("L1, " if usable else data["outcome"]["message"])
        shown = [line for line in lines if re.match(r"L\d+ ", line)]
        for line, linkage in zip(shown, data["linkages"], strict=False):
            assert line.startswith(f"{linkage['id']} ")
            assert linkage["type"] in line
            assert line.endswith("not usable") == (not linkage["usable"])
            least = linkage["min_transmission_angle_deg"]["range"]
            if linkage["usable"]:
                assert float(re.search(r"([\d.]+)°  +[\d.]+  +[\d.]+$", line)[1]) == pytest.approx(
                    least, abs=0.1
                )
            worst = linkage["position_error"]["max"]
            if worst is not None and worst > 1e-6:
                number = re.search(r"  ([\d.e-]+)(?: mm)?  ", line)[1]
                assert float(number) == pytest.approx(worst, rel=0.06)
        more = re.search(r"^and (\d+) more$", lines[-1])
        assert len(shown) + (int(more[1]) if more else 0) == len(data["linkages"])


def test_linkages_by_rank_by_id_and_in_turn(results):
    for result in results:
        assert [each.id for each in result] == [f"L{k + 1}" for k in range(len(result))]
        assert result[0] is result["L1"] is next(iter(result)) is result["l1"]
        assert result[-1] is result[np.int64(len(result) - 1)] is result.linkages[-1]
        assert result[1:] == result.linkages[1:]
        assert result.best is (result.usable[0] if result.usable else None)
        assert all(each.usable for each in result.usable)
        with pytest.raises(InputError, match="L99") as refused:
            result["L99"]
        assert refused.value.code == "E151"


def test_every_usable_linkage_comes_to_its_poses_when_driven(results):
    for result in results:
        for found in result.usable:
            first, second = found.driver_first.first, found.driver_first.second
            if not isinstance(first, RR):
                continue
            at, angle = places(first, second, np.linspace(-np.pi, np.pi, 40_001))
            for k in range(len(result.task.poses.angle)):
                pose = result.task.poses[k]
                turn = np.abs(np.exp(1j * angle) - np.exp(1j * pose.angle))
                away = np.hypot(np.abs(at - complex(*pose.translation)), result.length * turn)
                near = np.hypot(found.error.position[k], result.length * found.error.angle[k])
                assert np.nanmin(away) < 1.01 * near + 3e-3 * result.length


def numbers_of(path):
    """Every number of a text file."""
    return list(map(float, re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", path.read_text())))


def test_what_is_saved_is_read_back_and_handed_over(results, tmp_path):
    for k, result in enumerate(results):
        path = result.save(tmp_path / f"{k}.json")
        assert path.read_text() == result.to_json()
        read = burmester.read_result(path)
        assert [each.id for each in read.usable] == [each.id for each in result.usable]
        assert read.outcome.message == result.outcome.message
        assert [repr(each) for each in read] == [repr(each) for each in result]
        result.export(tmp_path / f"{k}.svg")
        read.export(tmp_path / f"{k}-read.svg")
        one, other = (numbers_of(tmp_path / f"{k}{end}.svg") for end in ("", "-read"))
        assert one == pytest.approx(other, rel=1e-9, abs=1e-9)
        with pytest.raises(InputError, match="exists") as refused:
            result.save(path)
        assert refused.value.code == "E140"
        result.save(path, force=True)


def all_kinds(results, folder):
    """Results of every kind: of many poses and few, rounded, proved, six-bars, functions, paths."""
    rows = [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)]
    shoulder = burmester.read_task("case:motiongen-shoulder")
    yield from results
    yield burmester.synthesize(rows[:3], angle_unit="deg")
    yield burmester.synthesize(shoulder, rounding_step=0.5, manufacturing_tolerance=0.05)
    yield burmester.synthesize(shoulder, certify=True, length_per_radian=30.0)
    (folder / "path.csv").write_text(
        "\n".join(["x,y,crank_deg", *(f"{x},{y},{9 * t}" for x, y, t in rows)])
    )
    yield burmester.synthesize(burmester.read_task(folder / "path.csv"))
    yield burmester.synthesize_six_bars(rows, angle_unit="deg", kind="Watt I", chains=300)
    settings = {"input_deg": 60, "output_deg": 60}
    yield burmester.synthesize_function("log10(x)", (1, 2), pairs=5, **settings)


def test_what_is_read_has_every_attribute_of_what_was_saved(results, tmp_path):
    for result in all_kinds(results, tmp_path):
        path = result.save(tmp_path / "result.json", force=True)
        read = burmester.read_result(path)
        assert type(read) is type(result)
        assert dir(read) == dir(result)
        assert differences(result, read, getattr(result, "length", 1.0)) == []
        assert repr(read) == repr(result)
        again = burmester.read_result(read.save(tmp_path / "again.json"))
        (tmp_path / "again.json").unlink()
        assert differences(result, again, getattr(result, "length", 1.0)) == []
        if hasattr(result, "report"):
            assert read.report(tmp_path / "page.html", force=True).stat().st_size > 10_000


def test_the_command_writes_the_same_result(tmp_path):
    task = burmester.read_task("case:motiongen-shoulder")
    command = [sys.executable, "-m", "burmester", "synthesize", "case:motiongen-shoulder", "--json"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert burmester.synthesize(task).to_json() == printed


def test_a_report_and_exports_by_the_ending_of_a_name(five, tmp_path):
    page = five.report(tmp_path / "lid.html").read_text()
    assert "<title>lid</title>" in page
    assert five.outcome.message in page
    exported = five.export(tmp_path / "lid.json", "L2")
    assert json.loads(exported.read_text())["id"] == "L2"
    assert five["L2"].export(tmp_path / "again.json").read_text() == exported.read_text()
    for wrong, code in (
        ({"path": tmp_path / "lid.foo"}, "E161"),
        ({"path": tmp_path / "lid.svg", "to": "foo"}, "E161"),
        ({"path": tmp_path / "lid.svg", "bore": 3}, "E162"),
        ({"path": tmp_path / "lid.svg", "linkage": "L7"}, "E151"),
        ({"path": tmp_path / "lid.html"}, "E161"),
    ):
        with pytest.raises(InputError) as refused:
            five.export(**wrong)
        assert refused.value.code == code


# What is drawn -----------------------------------------------------------------------------------


def points_of(svg, stroke, shape="polyline"):
    """The corners of all shapes of one colour, y upwards."""
    found = re.findall(rf'<{shape} points="([^"]*)"[^>]*stroke="{stroke}"', svg)
    rows = [[list(map(float, p.split(","))) for p in each.split()] for each in found]
    return [np.array(each) * [1, -1] for each in rows]


def test_the_still_drawing_has_the_poses_and_links_in_their_proportions(results):
    for result in results:
        found = result[0]
        svg = found._repr_html_()
        frames = points_of(svg, "#d0493c")
        poses = result.task.poses
        assert len(frames) == len(poses.angle)
        origins = np.array([each[1] for each in frames])
        wanted = poses.translation
        scale = np.linalg.norm(origins - origins.mean(0)) / np.linalg.norm(wanted - wanted.mean(0))
        shift = origins.mean(0) - scale * wanted.mean(0)
        assert np.abs(scale * wanted + shift - origins).max() < 0.2  # of a pixel
        for frame, angle in zip(frames, poses.angle, strict=True):
            x = frame[0] - frame[1]
            if np.hypot(*x) > 10:
                assert np.cos(np.arctan2(*x[::-1]) - angle) > 0.99
        links = [
            float(dyad.radius)
            for dyad in (found.driver_first.first, found.driver_first.second)
            if isinstance(dyad, RR)
        ]
        drawn = [np.hypot(*(each[1] - each[0])) / scale for each in points_of(svg, "#5d6b7a")]
        for length in links:
            assert min(abs(each - length) for each in drawn) < 0.5 / scale
        # The dashed curve is the way of the body's origin: it passes its place at every pose.
        curve = np.concatenate(points_of(svg, "#8796a8"))
        for place in scale * found.error.places.translation + shift:
            assert np.hypot(*(curve - place).T).min() < 8


def test_the_still_drawing_has_the_body_and_its_surroundings():
    result = burmester.synthesize(bodied())
    svg = result.best._repr_html_()
    poses = result.task.poses
    origins = np.array([each[1] for each in points_of(svg, "#d0493c")])
    wanted = poses.translation
    scale = np.linalg.norm(origins - origins.mean(0)) / np.linalg.norm(wanted - wanted.mean(0))
    shift = origins.mean(0) - scale * wanted.mean(0)
    rings = points_of(svg, "#2f9583", "polygon")
    for corners in carried(BODY, *wanted.T, poses.angle):
        assert min(same_ring(ring, scale * corners + shift) for ring in rings) < 0.3
    rings = points_of(svg, "#8a8f98", "polygon")
    for ring, (corners, _) in zip(rings, REGIONS, strict=True):
        assert same_ring(ring, scale * np.array(corners) + shift) < 0.3
    width, height = map(int, re.search(r'viewBox="0 0 (\d+) (\d+)"', svg).groups())
    for ring in (*rings, *points_of(svg, "#2f9583", "polygon")):
        assert (ring[:, 0] >= 0).all()
        assert (ring[:, 0] <= width).all()
        assert (-ring[:, 1] >= 0).all()
        assert (-ring[:, 1] <= height).all()


def test_a_result_without_linkages_is_shown_in_words():
    turn = [(0, 0, angle) for angle in (0, 20, 50, 90)]
    few = burmester.synthesize(turn, angle_unit="deg")
    assert few.best is None
    assert few
    assert "turns about" in few._repr_html_()
    assert "<svg" not in few._repr_html_()
    assert set(few._repr_mimebundle_()) == {"text/plain", "text/html"}
    with pytest.raises(InputError, match="no linkage") as refused:
        few.plot()
    assert "turns about" in refused.value.why


def test_names_from_files_do_no_harm_in_a_notebook():
    task = Task.from_rows(ROWS, angle_unit="deg", length_unit="<b>mm</b>")
    assert "<b>" not in burmester.synthesize(task)._repr_html_()


def test_a_notebook_gets_text_html_and_a_drawing_that_need_no_script(five, tmp_path):
    formatters = pytest.importorskip("IPython.core.formatters")
    read = burmester.read_result(five.save(tmp_path / "five.json"))
    for shown in (five, five.best, read, read["L2"]):
        data, _ = formatters.DisplayFormatter().format(shown)
        assert data["text/plain"] == repr(shown)
        assert "<table>" in data["text/html"]
        assert "<script" not in data["text/html"]
        drawing = ElementTree.fromstring(data["image/svg+xml"])  # a file of its own
        assert drawing.tag == "{http://www.w3.org/2000/svg}svg"
        assert data["image/svg+xml"] in data["text/html"]


def test_a_figure_is_shown_by_a_notebook_that_never_imported_pyplot(five):
    formatters = pytest.importorskip("IPython.core.formatters")
    shown = five.plot()
    data, details = formatters.DisplayFormatter().format(shown)
    picture = Image.open(io.BytesIO(data["image/png"]))
    at = details["image/png"]
    assert picture.size == (2 * at["width"], 2 * at["height"])
    dark = np.asarray(picture.convert("L")) < 128
    assert dark.any(axis=1).mean() > 0.4  # lines on most rows
    plain, _ = formatters.DisplayFormatter().format(Figure())
    assert "image/png" not in plain  # else there were no need for it


def test_the_figure_shows_the_way_of_the_origin_through_the_poses(five):
    (ax,) = five.plot("L2").axes
    curve = next(
        line for line in ax.lines if line.get_label() == "circuit 1" or line.get_lw() == 1.6
    )
    for origin in five["L2"].error.places.translation:
        assert np.hypot(*(curve.get_xydata() - origin).T).min() < 0.2
    own = five.plot()
    assert five.plot(ax=own.axes[0]) is own


@pytest.mark.parametrize("verb", ["plot", "animate"])
def test_a_missing_library_is_named_with_what_brings_it(verb):
    program = f"""
import sys
sys.modules["matplotlib"] = None
import burmester
result = burmester.synthesize({ROWS}, angle_unit="deg")
assert "<svg" in result._repr_html_()
try:
    result.{verb}()
except burmester.InputError as error:
    print(error.code, error.help)
"""
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert re.match(r'E130 pip install "burmester\[(plot|export)\]"', done.stdout)


def test_a_moving_picture_moves(five, tmp_path):
    picture = five.animate("L2", seconds=0.5, width_px=200)
    with Image.open(io.BytesIO(picture.gif)) as gif:
        frames = [np.asarray(each.convert("L"), float) for each in ImageSequence.Iterator(gif)]
        assert gif.width == 200
    assert len(frames) > 5
    assert all(np.abs(a - b).max() > 50 for a, b in pairwise(frames))
    assert picture.save(tmp_path / "lid.gif").read_bytes() == picture.gif
    assert len(repr(picture)) < 100
    assert "data:image/gif;base64," in picture._repr_html_()


# Names -------------------------------------------------------------------------------------------


def test_drawing_and_export_come_with_the_package_but_are_not_loaded_by_it():
    program = """
import sys
import burmester
assert "numpy" not in sys.modules
assert burmester.export.FORMATS and burmester.report.page
assert "matplotlib" not in sys.modules
assert burmester.plot.figure
for name in burmester.__all__:
    getattr(burmester, name)
"""
    subprocess.run([sys.executable, "-c", program], check=True)


def test_a_linkage_that_exists_is_judged(tmp_path):
    task = burmester.read_task("case:motiongen-shoulder")
    result = burmester.synthesize(task)
    second, file = result["L2"], result.save(tmp_path / "result.json")
    dyads = second.linkage.first, second.linkage.second
    pivots = [(dyad.fixed_pivot.tolist(), dyad.moving_pivot) for dyad in dyads]
    saved = burmester.read_result(file)["L2"]
    for linkage in (second, second.linkage, dyads, pivots, saved):
        judged = burmester.judge(task, linkage)
        assert (judged.outcome.code, judged.best.id) == ("R330", "L1")
        assert judged.best.type == second.type
        assert judged.best.error.worst < 1e-9
        assert judged.best.driven.least_over_range == pytest.approx(second.driven.least_over_range)
    assert burmester.judge(task, file, id="L2").best.type == second.type
    better = burmester.judge(task.poses, second, improve=True)
    assert better.outcome.message.startswith("the linkage works; ")
    for wrong in (3, None, dyads[:1], (1, 2), [pivots[0], "x"], [((1, 2), (3, np.nan))] * 2):
        with pytest.raises(InputError) as caught:
            burmester.judge(task, wrong)
        assert caught.value.code == "E153"
        assert "--" not in caught.value.help
