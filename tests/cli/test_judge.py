"""`burmester judge`: typed dyads, files, exit codes, and what the other commands take of it."""

import json
from importlib import resources
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import burmester
from burmester import Task
from burmester.io.result import task_data
from burmester.io.saved import read_result
from tests.command import run
from tests.oracles import witness
from tests.samples import samples

LID = str(Path(burmester.__file__).parent / "templates" / "lid-hinge.toml")
HEAD = "x,y,angle_deg\n"
TYPED = ("--dyad", "100,-68:53,-47", "--dyad", "12,-17:80,-17")
TWISTED = ("--dyad", "90,-68:53,-47", "--dyad", "12,-27:80,-17")


@pytest.fixture
def free(tmp_path):
    """The poses of the lid, without its limits and requirements."""
    file = tmp_path / "free.json"
    file.write_text(json.dumps(task_data(Task(burmester.read_task(LID).poses))))
    return file


def validated(text):
    data = json.loads(text)
    schema = resources.files("burmester").joinpath("io/synthesis.schema.json").read_text()
    jsonschema.Draft202012Validator(json.loads(schema)).validate(data)
    return data


def test_the_typed_lid_works():
    code, out, err = run("judge", LID, *TYPED)
    assert (code, err) == (0, "")
    assert out.startswith("result[R330]: the linkage works within the requirements\n")
    assert "L1 in full, in mm\n" in out
    assert "length        51.478" in " ".join(out.split("\n")).replace("  ± 0.29", "")
    code, out, err = run("judge", LID, *TYPED, "--json")
    assert (code, err) == (0, "")
    (linkage,) = validated(out)["linkages"]
    assert (linkage["usable"], linkage["given"]) == (True, True)
    assert linkage["position_error"]["max"] < 0.012


def test_the_verdict_is_the_exit_code():
    code, out, err = run("judge", LID, *TWISTED)
    assert (code, err) == (1, "")
    assert "result[R331]: the linkage does not work within the requirements" in out
    assert "the transmission angle falls to 39.6° between the poses" in " ".join(out.split())
    assert "± " not in out.partition("L1 in full")[2].partition("\n\n")[0]


def test_how_far_pivots_move_is_told():
    code, out, _err = run("judge", LID, *TWISTED, "--improve", "--json")
    given, *near = validated(out)["linkages"]
    assert (code, given["usable"], given["given"]) == (1, False, True)
    assert near
    assert all(each["usable"] and not each["given"] for each in near)
    task = burmester.read_task(LID)
    before = {each["id"]: each for each in given["dyads"]}
    for linkage in near:
        moved, greatest = linkage["moved"], 0.0
        for move in moved["dyads"]:
            (dyad,) = (each for each in linkage["dyads"] if each["id"] == move["dyad"])
            old = before[move["dyad"]]
            for key in ("fixed_pivot", "moving_pivot"):
                away = float(np.hypot(*np.subtract(dyad[key], old[key])))
                assert move[key] == pytest.approx(away, abs=1e-9)
                greatest = max(greatest, away)
            assert move["length"] == pytest.approx(dyad["radius"] - old["radius"], abs=1e-9)
            greatest = max(greatest, abs(move["length"]))
        assert moved["greatest"] == pytest.approx(greatest, abs=1e-9)
        assert moved["message"].startswith(f"{linkage['id']} changes nothing by more than ")
        dyads = [
            burmester.RR(each["fixed_pivot"], each["moving_pivot"], each["radius"])
            for each in linkage["dyads"]
        ]
        nearest = witness.misses(burmester.Linkage(*dyads), task.poses, 24.0)
        turned = np.radians(linkage["angle_error_deg"]["max"])
        assert nearest.max() <= np.hypot(linkage["position_error"]["max"], 24 * turned) + 1e-6
        assert nearest[0] < 1e-3  # the closed pose is exact
        x, y = np.array([each["fixed_pivot"] for each in linkage["dyads"]]).T
        assert ((x > 5 - 1e-6) & (x < 150 + 1e-6) & (y > -100 - 1e-6) & (y < -10 + 1e-6)).all()
    out = run("judge", LID, *TWISTED, "--improve")[1]
    assert near[0]["moved"]["message"] in " ".join(out.split())


@pytest.mark.parametrize("improve", [(), ("--improve",)])
def test_a_judgement_is_read_exported_and_judged_again(tmp_path, improve):
    file, again = tmp_path / "judged.json", tmp_path / "again.json"
    assert run("judge", LID, *TYPED, *improve, "-o", file)[0] == 0
    assert read_result(file).choose().id == "L1"
    for name in ("lid.dxf", "lid.json"):
        code, out, _err = run("export", file, "-o", tmp_path / name)
        assert (code, "read back and verified" in out) == (0, True)
    code, out, _err = run("judge", LID, "--linkage", tmp_path / "lid.json", "--json")
    linkage = validated(out)["linkages"][0]
    assert (code, linkage["usable"]) == (0, True)
    assert run("judge", LID, "--linkage", file, "-o", again)[0] == 0
    one, other = (json.loads(each.read_text())["linkages"][0] for each in (file, again))
    assert other["combined_error"] == pytest.approx(one["combined_error"], rel=1e-6)
    if not improve:  # the page of the task in the file
        assert run("report", file, "-o", tmp_path / "lid.html")[0] == 0


def test_a_judgement_that_was_changed_is_told(free, tmp_path):
    file = tmp_path / "judged.json"
    run("judge", LID, *TWISTED, "-o", file)
    data = json.loads(file.read_text())
    data["outcome"]["code"] = "R330"
    file.write_text(json.dumps(data))
    code, out, _err = run("export", file, "-o", tmp_path / "lid.dxf")
    assert (code, out.startswith("warning[W244]")) == (0, True)
    room = ("--fixed-pivot", "box:5,-100:90,-10")
    assert run("judge", free, *TYPED, *room, "-o", file, "--force")[0] == 1
    data = json.loads(file.read_text())
    assert [each["kind"] for each in data["linkages"][0]["unmet"]] == ["limit"]
    data["linkages"][0] |= {"usable": True, "driver": "first", "unmet": []}
    data["outcome"]["code"] = "R330"
    file.write_text(json.dumps(data))
    code, out, err = run("export", file, "-o", tmp_path / "lid.csv")
    assert (code, out.startswith("warning[W244]: judged anew, L1 is not usable (")) == (0, True)
    assert "L1 is not usable: `burmester synthesize` says why" in err


def test_limits_and_requirements_are_options_too(free):
    code, out, _err = run("judge", free, *TYPED, "--min-transmission", 50, "--length", "10:60")
    assert code == 1
    text = " ".join(out.split())
    assert "at least 50° is asked for" in text
    assert "a link is 68 long; at most 60 is allowed" in text
    code, out, _err = run("judge", LID, *TYPED, "--length", "51.478", "--length", "any")
    assert (code, "length        51.478" in out) == (0, True)
    code, out, _err = run("judge", LID, *TYPED, "--tolerance", "0.05")
    assert "Built to ±0.05 mm" in out


SLIDERS = ("--dyad", "line@30,1,2:3,4", "--dyad", "-1,2:line@-20,0.5,3")


def test_sliders_are_typed_by_a_line(tmp_path):
    rng = np.random.default_rng(3)
    turn = np.radians([30, -20])
    normal = turn + np.pi / 2
    offset = np.array([[1, 2], [0.5, 3]] * np.stack([np.cos(normal), np.sin(normal)], -1)).sum(-1)
    dyads = (
        burmester.PR(normal[0], offset[0], (3, 4)),
        burmester.RP((-1, 2), normal[1], offset[1]),
    )
    where, phi = witness.places(*dyads, np.sort(rng.uniform(12, 20, 6)))
    rows = np.column_stack([where[0].real, where[0].imag, np.degrees(phi[0])])
    file = tmp_path / "poses.csv"
    file.write_text(
        "x,y,angle_deg\n" + "\n".join(",".join(map(repr, row)) for row in rows.tolist())
    )
    code, out, _err = run("judge", file, *SLIDERS, "--json")
    (linkage,) = validated(out)["linkages"]
    assert linkage["position_error"]["max"] < 1e-9
    assert (code, linkage["type"]) == (0, "Rapson slide")
    (tmp_path / "slide.toml").write_text(
        "[[dyads]]\nline = {point = [1, 2], direction_deg = 30}\nmoving_pivot = [3, 4]\n"
        "[[dyads]]\nfixed_pivot = [-1, 2]\nline = {point = [0.5, 3], direction_deg = -20}\n"
    )
    same = run("judge", file, "--linkage", tmp_path / "slide.toml", "--json")[1]
    assert json.loads(same)["linkages"] == json.loads(out)["linkages"]


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ((), "E153"),
        (TYPED[:2], "E153"),
        ((*TYPED, "--dyad", "1,2:3,4"), "E153"),
        ((*TYPED[:2], "--dyad", "1,2,3"), "E153"),
        ((*TYPED[:2], "--dyad", "1,2:3"), "E153"),
        ((*TYPED[:2], "--dyad", "1,2:3,nan"), "E153"),
        ((*TYPED[:2], "--dyad", "1,2:3,inf"), "E153"),
        ((*TYPED[:2], "--dyad", "1;2:3;4"), "E153"),
        ((*TYPED[:2], "--dyad", "line@1,2,3:line@1,2,3"), "E153"),
        ((*TYPED[:2], "--dyad", "line@1,2:3,4"), "E153"),
        ((*TYPED[:2], "--dyad", "line@999,1,2:3,4"), "E153"),
        ((*TYPED, "--length", "51"), "E153"),
        ((*TYPED, "--length", "51", "--length", "-3"), "E153"),
        ((*TYPED, "--length", "51", "--length", "x"), "E153"),
        ((*TYPED, "--length", "51", "--length", "1:60"), "E153"),
        ((*TYPED, "--linkage", LID), "E153"),
        ((*TYPED, "--id", "L1"), "E153"),
        (("--linkage", LID, "--length", "51"), "E153"),
        ((*TYPED[:2], "--dyad", "100,-68:1,2"), "E154"),
        ((*TYPED[:2], "--dyad", "1,2:53,-47"), "E154"),
        ((*TYPED, "--length", "1", "--length", "2"), "E155"),
        (("--linkage", LID), "E156"),
        (("--linkage", __file__), "E156"),
        (("--linkage", "no-such-file.json"), "E101"),
        ((*TYPED[:2], "--dyad", "1e70,2:3,4"), "E112"),
    ],
)
def test_bad_input_is_refused(arguments, code):
    exit, out, err = run("judge", LID, *arguments)
    assert (exit, out) == (2, "")
    assert err.startswith(f"error[{code}]: ")
    assert "\n  help: " in err


def test_poses_and_linkage_cannot_share_standard_input():
    assert run("judge", "-", "--linkage", "-")[2].startswith("error[E153]")


def typed(rng):
    """A dyad as somebody may type it, mostly well-formed."""
    numbers = [0, 1, -3.5, 12, 100, 1e-9, 1e9, 1e30, 1e59, "", "x", "1,5", "nan", "-", "1e400"]

    def number():
        if rng.uniform() < 0.9:
            return f"{rng.normal(scale=60):.{int(rng.integers(0, 4))}f}"
        return str(numbers[rng.integers(len(numbers))])

    def part():
        count = 2 if rng.uniform() < 0.97 else int(rng.integers(0, 4))
        point = ",".join(number() for _ in range(count))
        return f"line@{number()},{point}" if rng.uniform() < 0.3 else point

    return ":".join(part() for _ in range(2 if rng.uniform() < 0.98 else 3))


def test_no_typed_dyad_breaks_the_command(tmp_path):
    rng, ends = np.random.default_rng(42), []
    few = tmp_path / "few.csv"
    few.write_text(HEAD + "0,0,0\n30,-20,40\n50,-60,90\n")
    far = tmp_path / "far.csv"
    far.write_text(HEAD + "".join(f"{1e7 + x},{x * x},{40 * x}\n" for x in range(7)))
    tries = samples(150, 30)
    for k in tries:
        task = (LID, few, far)[k % 3]
        arguments = ["--dyad", typed(rng), "--dyad", typed(rng)]
        if k % 4 == 0:
            length = f"{rng.normal(loc=60, scale=40):.2f}"
            arguments += ["--length", length, "--length", "any"]
        code, out, err = run("judge", task, *arguments, "--json")
        assert code in (0, 1, 2), (arguments, err)
        data = json.loads(out)
        expected = {0: ("R330",), 1: ("R331",)}.get(code, ("E112", "E153", "E154", "E155"))
        assert data["outcome"]["code"] in expected, (arguments, err)
        ends.append(code)
        if code < 2 and k % 5 == 0:
            file = tmp_path / f"{k}.json"
            file.write_text(out)
            read_result(file)  # which judges it again
            assert run("judge", task, *arguments)[0] == code
    assert ends.count(1) > 0.2 * len(tries)
    assert ends.count(2) > 0.1 * len(tries)
