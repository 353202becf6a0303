"""`burmester judge` of six-bars: files, options, exit codes, results read back; and in Python."""

import copy
import json
from functools import cache
from importlib import resources

import jsonschema
import numpy as np
import pytest

import burmester
from burmester.errors import InputError
from burmester.io.linkage_file import read_linkage
from burmester.io.saved import read_result
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.watt import WattLinkage
from tests.command import run
from tests.oracles.six_bars import dimensions
from tests.sixbar.tasks import TURNING, task

SCHEMA = json.loads(resources.files("burmester").joinpath("io/synthesis.schema.json").read_text())
# A six-bar to four decimals, its coupler and its second crank each in a frame of the drawing.
TYPED = """\
length_unit = "mm"
[ground]
A = {A}
B = {B}
[coupler]
C = {C}
D = {D}
E = {E}
[second_crank]
B = {P}
D = {Q}
G = {G}
[body]
E = {e}
H = {h}
[lengths]
AC = {AC}
GH = {GH}
"""


def table(rows):
    return "x_mm,y_mm,angle_deg\n" + "".join(f"{x},{y},{angle}\n" for x, y, angle in rows)


@cache
def made():
    """Six-bars of a search."""
    return burmester.synthesize_six_bars(
        TURNING, angle_unit="deg", length_unit="mm", kind="Watt I", chains=300, most=3
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("judged")
    (path / "task.csv").write_text(table(TURNING))
    (path / "swapped.csv").write_text(table([TURNING[k] for k in (0, 2, 1, 3, 4)]))
    made().save(path / "found.json")
    made().export(path / "exported.json", "S2")
    (path / "typed.toml").write_text(typed(made().best.linkage))
    return path


def typed(linkage, **changed):
    """A file of a six-bar, its links of three joints in frames of their own."""

    def pair(z):
        return [round(float(z.real), 4), round(float(z.imag), 4)]

    def seen(points, turn, shift):
        return [pair(turn * z + shift) for z in points]

    at_d, at_g = (complex(*each) for each in (linkage.coupler_joint, linkage.crank_joint))
    c, d, e = seen([0, at_d, float(linkage.coupler_arm)], np.exp(0.7j), 5 - 3j)
    p, q, g = seen([0, float(linkage.second_crank), at_g], np.exp(-2.1j), 1 + 8j)
    ends = {
        name: pair(complex(*at))
        for name, at in (
            ("A", linkage.fixed_first),
            ("B", linkage.fixed_second),
            ("e", linkage.body_joint),
            ("h", linkage.link_joint),
        )
    }
    lengths = {"AC": float(linkage.first_crank), "GH": float(linkage.floating_link)}
    values = {**ends, "C": c, "D": d, "E": e, "P": p, "Q": q, "G": g, **lengths}
    return TYPED.format(**{**values, **changed})


@pytest.mark.parametrize(
    ("file", "id"), [("found.json", "S2"), ("exported.json", None), ("found.json", None)]
)
def test_results_and_exports_are_judged_at_their_own_poses(folder, file, id):
    chosen = ["--id", id] if id else []
    words = ["judge", folder / "task.csv", "--linkage", folder / file, *chosen]
    code, out, _ = run(*words, "--json")
    data = json.loads(out)
    jsonschema.Draft202012Validator(SCHEMA).validate(data)
    own = made()[1 if id or file == "exported.json" else 0]
    (told,) = data["six_bars"]["found"]
    assert (code, data["outcome"]["code"], told["given"], told["usable"]) == (0, "R330", True, True)
    assert told["lengths"] == pytest.approx(own.lengths)
    assert told["driver"] == own.driver
    assert told["min_transmission_angle_deg"] == pytest.approx(np.degrees(own.transmission))
    assert told["position_error"]["max"] < 1e-9


def test_a_file_that_a_person_types(folder):
    words = "judge", folder / "task.csv", "--linkage", folder / "typed.toml"
    code, out, _ = run(*words)
    assert code == 0
    assert out.startswith("result[R330]: the linkage works\n")
    assert "At the poses" in out
    linkage = read_linkage(folder / "typed.toml")
    assert dimensions(linkage) == pytest.approx(dimensions(made().best.linkage), abs=2e-4)
    for name in ("coupler_joint", "crank_joint"):  # not their mirror images
        wanted = getattr(made().best.linkage, name)
        assert getattr(linkage, name) == pytest.approx(wanted, abs=1e-3)
    code, out, _ = run(*words, "--min-transmission", 80)
    assert code == 1
    assert out.startswith("result[R331]: the linkage does not work within the requirements")
    assert "with --min-transmission" in out
    assert run(*words, "--within", 1e-5)[0] == 1


@pytest.mark.parametrize("poses", ["task.csv", "swapped.csv"])
def test_what_is_saved_is_read_again(folder, poses):
    saved = folder / f"{poses}.json"
    words = "judge", folder / poses, "--linkage", folder / "typed.toml", "-o", saved
    code, _, _ = run(*words)
    assert code == (poses == "swapped.csv")
    result = read_result(saved)
    assert result.synthesis.outcome.code == ("R331" if code else "R330")
    chosen = result.choose("S1")
    judged = burmester.judge(
        task([TURNING[k] for k in (0, 2, 1, 3, 4)] if code else TURNING), chosen
    )
    assert chosen.usable is judged.best.usable is not bool(code)
    assert chosen.drive == pytest.approx(judged.best.drive, abs=1e-7)
    for name in ("csv", "json"):
        done = run("export", saved, "-o", f"{saved}.{name}")
        assert done[0] == 0
        assert ("not usable: `burmester judge`" in done[2]) == bool(code)
    again = json.loads((folder / f"{poses}.json.json").read_text())
    assert dimensions(read_linkage(f"{saved}.json")) == pytest.approx(dimensions(chosen.linkage))
    assert len(again["places"]) == 5
    for change in ("usable", "outcome"):
        tree = copy.deepcopy(json.loads(saved.read_text()))
        if change == "usable":
            tree["six_bars"]["found"][0]["usable"] = bool(code)
        tree["outcome"]["code"] = "R330" if code else "R331"
        read = read_result("-", json.dumps(tree).encode())
        (told,) = [each for each in read.synthesis.warnings if each.code == "W244"]
        assert read.choose("S1").usable is not bool(code)
        assert ("S1 is" in told.message) == (change == "usable")


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"AC": "0"}, "lengths.AC is 0"),
        ({"GH": '"long"'}, "lengths.GH is no finite number"),
        ({"A": "[1]"}, "ground.A is no point"),
        ({"E": "[0, 0]\nF = [1, 1]"}, "coupler.F is not known"),
        ({"GH": "3.1\nBD = 77"}, "lengths.BD contradicts the joints"),
        ({"GH": "3.1\nXY = 77"}, "lengths.XY is not known"),
        ({"P": "[1, 2]", "Q": "[1, 2]"}, "joints B and D of second_crank are at one place"),
        ({"h": "[0, 1]\n[lengths2]"}, "lengths of this six-bar cannot be used"),
    ],
)
def test_files_that_are_no_six_bar(tmp_path, changed, message):
    text = typed(made().best.linkage, **changed)
    file = tmp_path / "wrong.toml"
    file.write_text(text.replace("[lengths]\n", "") if "lengths2" in text else text)
    with pytest.raises(InputError) as refused:
        read_linkage(file)
    assert refused.value.code == "E156"
    assert message in refused.value.message
    assert refused.value.help


def test_what_a_file_of_a_six_bar_lacks(tmp_path, folder):
    file = tmp_path / "wrong.toml"
    text = (folder / "typed.toml").read_text()
    file.write_text("\n".join(line for line in text.splitlines() if not line.startswith("G =")))
    with pytest.raises(InputError, match=r"second_crank\.G is missing"):
        read_linkage(file)
    with pytest.raises(InputError, match="the linkage is in mm, and the poses are in m"):
        read_linkage(folder / "typed.toml", unit="m")


def test_options_of_four_bars_are_refused(folder):
    words = "judge", folder / "task.csv", "--linkage", folder / "typed.toml"
    for option in (["--improve"], ["--norm", "worst"], ["--tolerance", "0.1"]):
        code, _, err = run(*words, *option)
        assert code == 2
        assert "error[E197]" in err
        assert option[0] in err
    code, _, err = run(*words, "--type", "crank-rocker")
    assert (code, "error[E196]" in err) == (2, True)
    with pytest.raises(InputError) as refused:
        burmester.judge(task(TURNING), made().best, improve=True)
    assert refused.value.code == "E197"


def test_in_python_a_six_bar_of_lists(tmp_path):
    own = made().best.linkage
    plain = WattLinkage(*(np.asarray(getattr(own, name)).tolist() for name in own.__match_args__))
    judged = burmester.judge(task(TURNING, length_unit="mm"), plain)
    assert isinstance(judged.best, FoundSixBar)
    assert judged.outcome.code == "R330"
    assert "passes every pose exactly" in judged.report(tmp_path / "page.html").read_text()
    with pytest.raises(InputError) as refused:
        burmester.judge(task(TURNING), WattLinkage(*(["x"] * 10)))
    assert refused.value.code == "E153"
