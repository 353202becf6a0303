"""The command as its users meet it."""

import ast
import json
import re
import signal
import subprocess
import sys
import time
from importlib import import_module, resources
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import burmester
from burmester import cli
from burmester.io.cases import names
from tests.command import process, run
from tests.oracles.ten_poses import TEN as TABLE_2
from tests.samples import EVERY


@pytest.fixture
def poses(tmp_path):
    file = tmp_path / "poses.csv"
    file.write_text(TABLE_2)
    return file


def schema():
    text = resources.files("burmester").joinpath("io/synthesis.schema.json").read_text()
    return json.loads(text)


def valid(stdout):
    data = json.loads(stdout)
    jsonschema.Draft202012Validator(schema()).validate(data)
    return data


def test_main_job_prints_the_published_linkage(poses):
    done = process("synthesize", poses)
    assert done.returncode == 0
    assert done.stderr == ""
    assert re.match(r"L1, a crank-rocker driven by D1, passes every pose within ", done.stdout)
    assert re.search(r"(?m)^\d+ four-bars from 5 locally best dyads \(25 of 25", done.stdout)
    assert "(-2.200096," in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80


@pytest.mark.parametrize(
    "case",
    [
        "ge2012-exact",
        "ge2012-approximate",
        "motiongen-shoulder",
        "motiongen-mixed5",
        "motiongen-rrrp",
        "motiongen-rrpr",
        "motiongen-prpr",
        "motiongen-three-pivots",
        "motiongen-four-line",
    ],
)
def test_json_keeps_the_contract(case):
    done = run("synthesize", f"case:{case}", "--json")
    assert done.returncode == 0
    data = valid(done.stdout)
    assert data["outcome"]["code"] == "R300"
    carried = json.loads(resources.files("burmester").joinpath(f"cases/{case}.json").read_text())
    rows = [[p["x"], p["y"], p["angle_deg"]] for p in data["task"]["poses"]]
    assert np.allclose(rows, carried["poses"], rtol=0, atol=1e-12)
    for linkage in data["linkages"]:
        # The coupler's places printed are on the circles printed, to the last digit.
        for dyad in linkage["dyads"]:
            if dyad["kind"] == "RR":
                for place in linkage["coupler"]:
                    turn = np.exp(1j * np.radians(place["angle_deg"]))
                    pin = complex(*dyad["moving_pivot"]) * turn + place["x"] + 1j * place["y"]
                    radius = abs(pin - complex(*dyad["fixed_pivot"]))
                    assert np.isclose(radius, dyad["radius"], rtol=1e-9)


def test_json_of_one_run_is_the_input_of_the_next(poses):
    first = run("synthesize", poses, "--json")
    second = run("synthesize", "-", "--json", stdin=first.stdout)
    assert second.returncode == 0
    one, two = json.loads(first.stdout), json.loads(second.stdout)
    for a, b in zip(one["dyads"], two["dyads"], strict=True):
        for key in ("fixed_pivot", "moving_pivot"):
            assert (key in a) == (key in b)
            assert np.allclose(a.get(key, 0), b.get(key, 0), rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    "arguments",
    [
        ("synthesize",),
        ("synthesize", "x.csv", "--method", "magic"),
        ("fly",),
        ("synthesize", "--no"),
        ("batch", "--sample", "four-bars", "--noise", "1e-400"),
        ("export", "x.json", "-o", "x.dxf", "--hole", "1_0"),
        ("export", "x.json", "-o", "x.dxf", "--hole", "\uff11\uff12"),
        ("export", "x.json", "-o", "x.dxf", "--hole", "nan"),
    ],
)
def test_wrong_usage_is_one_message(arguments):
    done = run(*arguments)
    assert done.returncode == 2
    assert done.stderr.startswith("error[E100]")
    assert "--help" in done.stderr
    data = valid(run(*arguments, "--json").stdout)
    assert data["outcome"]["code"] == "E100"


def test_few_poses_get_the_best_of_infinitely_many(tmp_path):
    file = tmp_path / "four.csv"
    file.write_text("\n".join(TABLE_2.splitlines()[:5]))
    done = run("synthesize", file)
    assert done.returncode == 0
    assert "infinitely many" in done.stdout
    assert "--min-transmission" in done.stdout
    data = valid(run("synthesize", file, "--json").stdout)
    assert data["outcome"]["code"] == "R308"
    assert data["family"]["pairs"] > 10_000
    assert all(each["usable"] for each in data["linkages"])


def test_methods_by_number_of_poses(poses):
    assert run("synthesize", poses, "--method", "pencil").returncode == 0
    refused = run("synthesize", poses, "--method", "exact")
    assert refused.returncode == 2
    assert "E121" in refused.stderr
    raw = json.loads(run("synthesize", poses, "--raw", "--json").stdout)
    wanted = [5.69e-06, 1.22e-04, 0.0073, 0.1525, 0.1868, 1.2043, 1.6355, 10.4665]
    assert np.allclose(raw["singular_values"], wanted, rtol=0, atol=6e-5)


def test_complete_method_says_what_it_accounted_for(poses):
    data = valid(run("synthesize", poses, "--method", "complete", "--json").stdout)
    assert data["critical_points"] == {"found": 25, "expected": 25}
    assert data["linkages"][0]["position_error"]["max"] < 2e-4
    assert {dyad["kind"] for dyad in data["dyads"]} == {"RR", "PR", "RP"}


def test_a_certificate_says_what_is_proved(poses):
    pytest.importorskip("flint")
    done = run("synthesize", poses, "--certify")
    proved, computed = done.stdout.split("Proved, of all digits (--json), for the poses as given:")[
        1
    ].split("Computed, not")
    assert "there are no others" in proved
    assert "may have minima other than those reported" in " ".join(computed.split())
    data = valid(run("synthesize", poses, "--certify", "--json").stdout)
    assert data["certificate"]["complete"]
    assert [dyad["id"] for dyad in data["certificate"]["dyads"]] == [d["id"] for d in data["dyads"]]
    for dyad in data["certificate"]["dyads"]:
        assert dyad["proved"]
        assert dyad["radius"] < 1e-9
    for wrong in (("--method", "pencil"), ("--norm", "worst"), ("--kinds", "RR")):
        refused = run("synthesize", poses, "--certify", *wrong)
        assert refused.returncode == 2
        assert "E123" in refused.stderr


def test_a_missing_library_for_certificates_is_said(poses, tmp_path):
    (tmp_path / "flint.py").write_text("raise ImportError")
    done = process("synthesize", poses, "--certify", env={"PYTHONPATH": str(tmp_path)})
    assert done.returncode == 2
    assert "E130" in done.stderr
    assert "burmester[certify]" in done.stderr


FIXED = ("--fixed-pivot=1,-2", "--fixed-pivot=4,-1")


def test_poses_and_pivots_make_five_conditions(tmp_path):
    file = tmp_path / "three.csv"
    file.write_text("x,y,angle_deg\n0,0,0\n3,1,40\n4,3,70\n")
    done = run("synthesize", file, *FIXED, "--length", "1:20", "--json")
    data = valid(done.stdout)
    assert data["method"] == "exact"
    (linkage,) = data["linkages"]
    pivots = sorted(dyad["fixed_pivot"] for dyad in linkage["dyads"])
    assert np.allclose(pivots, [(1, -2), (4, -1)], rtol=0, atol=1e-12)
    for dyad in linkage["dyads"]:
        assert np.abs(circle_misses(dyad, data)).max() < 1e-9
    # What --json prints can be read again, limits and all.
    again = tmp_path / "again.json"
    again.write_text(done.stdout)
    read = valid(run("synthesize", again, "--json").stdout)
    assert read["linkages"] == data["linkages"]
    assert read["task"] == data["task"]
    assert read["task"]["limits"][0]["length"] == {"least": 1, "most": 20}
    one = run("synthesize", file, "--fixed-pivot=1,-2", "--json")
    assert one.returncode == 0
    open_ = valid(one.stdout)
    assert open_["outcome"]["code"] == "R308"
    for linkage in open_["linkages"]:
        assert np.allclose(linkage["dyads"][0]["fixed_pivot"], [1, -2], rtol=0, atol=1e-12)
        for dyad in linkage["dyads"]:
            assert dyad["kind"] != "RR" or np.abs(circle_misses(dyad, open_)).max() < 1e-9


def circle_misses(dyad, data):
    """How far a link's pin is from its circle at every pose, in plain complex numbers."""
    out = []
    for pose in data["task"]["poses"]:
        turn = np.exp(1j * np.radians(pose["angle_deg"]))
        pin = complex(*dyad["moving_pivot"]) * turn + pose["x"] + 1j * pose["y"]
        out.append(abs(pin - complex(*dyad["fixed_pivot"])) - dyad["radius"])
    return np.array(out)


def linkages(*arguments):
    done = run("synthesize", *arguments, "--json")
    assert done.returncode == 0, done.stderr
    data = valid(done.stdout)
    assert data["linkages"]
    return data, [linkage["dyads"] for linkage in data["linkages"]]


@pytest.mark.parametrize("arguments", [("--fixed-pivot", "-2,0.5"), ("--fixed-pivot=-2,0.5",)])
def test_a_point_on_the_command_line_is_the_pivot_of_one_dyad(poses, arguments):
    _, pairs = linkages(poses, *arguments)
    for pair in pairs:
        at = [dyad.get("fixed_pivot") for dyad in pair]
        assert sum(pivot is not None and np.allclose(pivot, [-2, 0.5]) for pivot in at) == 1


def test_limits_for_both_dyads_hold_for_both(poses):
    limits = ("--fixed-pivot", "box:-3,-1:3,0.3", "--length", "1:6", "--kinds", "RR")
    data, pairs = linkages(poses, *limits)
    for dyad in (dyad for pair in pairs for dyad in pair):
        x, y = dyad["fixed_pivot"]
        assert -3 - 1e-9 <= x <= 3 + 1e-9
        assert -1 - 1e-9 <= y <= 0.3 + 1e-9
        assert 1 - 1e-9 <= dyad["radius"] <= 6 + 1e-9
        assert np.abs(circle_misses(dyad, data)).max() == pytest.approx(dyad["max_error"])


def test_limits_for_each_dyad(poses):
    _, pairs = linkages(poses, "--kinds", "RR", "--kinds", "PR")
    assert {tuple(sorted(dyad["kind"] for dyad in pair)) for pair in pairs} == {("PR", "RR")}


def test_exact_poses_are_met_and_the_others_come_near(poses):
    data, pairs = linkages(poses, "--exact", "1,10", "--kinds", "RR")
    for dyad in (dyad for pair in pairs for dyad in pair):
        miss = np.abs(circle_misses(dyad, data))
        assert miss[[0, 9]].max() < 1e-10
        assert miss[1:9].max() > 1e-6


def test_the_smallest_worst_deviation_is_smaller_than_that_of_least_squares(poses):
    rms, worst = (linkages(poses, "--norm", norm)[0] for norm in ("rms", "worst"))
    for a, b in zip(rms["dyads"][:2], worst["dyads"][:2], strict=True):
        assert b["max_error"] < a["max_error"]
        assert b["rms_error"] > a["rms_error"]


def test_limits_in_a_file_are_those_of_the_command_line(tmp_path, poses):
    file = tmp_path / "poses.toml"
    rows = ", ".join(f"[{row}]" for row in TABLE_2.splitlines()[1:])
    file.write_text(
        f'angle_unit = "deg"\nposes = [{rows}]\n'
        '[limits]\nfixed_pivot = { line = [[0, 0], [1, 0]] }\nkinds = ["RR"]\n'
    )
    by_option = linkages(poses, "--fixed-pivot", "line:0,0:1,0", "--kinds", "RR")[1]
    assert linkages(file)[1] == by_option
    again = run("synthesize", file, "--kinds", "PR")
    assert again.returncode == 2
    assert again.stderr.startswith("error[E108]")


def test_help_tells_every_option_in_80_columns():
    done = run("synthesize", "--help")
    assert max(map(len, done.stdout.splitlines())) <= 80
    options = (
        "--fixed-pivot --moving-pivot --length --kinds --exact --min-transmission --type --driver "
        "--footprint --link-ratio --within --any-order --method --norm --pose-sigma "
        "--angle-weight --certify --raw --time-limit --tolerance --round --stock --all --dyads "
        "--require-determined --angle-unit --columns --points --plane --drop --every --from --to "
        "--json --output --force --help"
    )
    for option in options.split():
        assert f"{option} " in done.stdout
    for shape in ("line:", "segment:", "box:", "polygon:", "any"):
        assert f" {shape}" in done.stdout


def test_the_object_is_written_whole_and_never_over_a_file(poses, tmp_path):
    made = tmp_path / "result.json"
    done = run("synthesize", poses, "-o", made)
    assert done.returncode == 0
    assert "wrote" in done.stderr
    assert valid(made.read_text()) == valid(run("synthesize", poses, "--json").stdout)
    made.write_text("mine")
    again = run("synthesize", poses, "-o", made)
    assert again.returncode == 2
    assert "error[E140]" in again.stderr
    assert again.stdout == ""  # refused before anything was computed
    assert made.read_text() == "mine"
    assert run("synthesize", poses, "-o", made, "--force").returncode == 0
    assert valid(made.read_text())["linkages"]
    assert [each.name for each in tmp_path.iterdir() if each.name.startswith(".")] == []


def test_a_report_is_a_page_with_the_numbers_that_are_printed(poses, tmp_path):
    page = tmp_path / "page.html"
    done = run("report", poses, "-o", page, "--title", "Lid <1>")
    assert done.returncode == 0, done.stderr
    text = page.read_text("utf-8")
    assert "Lid &lt;1&gt;" in text
    printed = run("synthesize", poses).stdout
    length = re.search(r"length +([0-9.]+)", printed)[1]
    assert length in text
    assert not re.search(r"(src|href)=[\"']?http", text)
    assert run("report", poses, "-o", page).returncode == 2
    assert page.read_text("utf-8") == text


def test_a_linkage_is_exported_from_a_result(poses, tmp_path):
    result, made = tmp_path / "result.json", tmp_path / "coupler.csv"
    assert run("synthesize", poses, "-o", result).returncode == 0
    done = run("export", result, "-o", made, "--unit", "mm")
    assert done.returncode == 0, done.stderr
    header, *rows = made.read_text().splitlines()
    assert "x_mm" in header
    saved = json.loads(result.read_text())["linkages"][0]
    columns = header.split(",")
    at_poses = [
        [float(row.split(",")[columns.index(name)]) for name in ("x_mm", "y_mm", "angle_deg")]
        for row in rows
        if row.split(",")[columns.index("pose")]
    ]
    wanted = [[each["x"], each["y"], each["angle_deg"]] for each in saved["coupler"]]
    turned = (np.array(sorted(at_poses)) - sorted(wanted))[:, 2]
    assert np.abs((turned + 180) % 360 - 180).max() < 1e-8
    assert np.array(sorted(at_poses))[:, :2] == pytest.approx(np.array(sorted(wanted))[:, :2])
    piped = run("export", "-", "--to", "svg", "-o", tmp_path / "a", stdin=result.read_text())
    assert piped.returncode == 0, piped.stderr
    assert (tmp_path / "a").read_text().lstrip().startswith("<")


def test_a_bug_leaves_a_file_to_send(monkeypatch, capsys, tmp_path, poses):
    def broken(*_, **__):
        return [].pop()

    monkeypatch.setattr("burmester.synthesis.motion_generation.synthesize", broken)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "bugs"))
    (tmp_path / "bugs").mkdir()
    with pytest.raises(SystemExit) as stop:
        cli.main(["synthesize", str(poses)])
    assert stop.value.code == 3
    (left,) = (tmp_path / "bugs").iterdir()
    told = "".join(capsys.readouterr().err.split())
    assert "error[E900]" in told
    assert "".join(str(left).split()) in told
    assert "pop from empty list" in left.read_text()
    assert str(poses) in left.read_text()


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_output_goes_through_any_encoding(encoding, tmp_path):
    named = tmp_path / "poses.csv"
    named.write_text(
        "x,y,angle_deg,name\n0,0,0,\u4e00\n3,1,40,b\n4,3,70,\u00fc\n5,3,95,d\n6,2,110,e\n",
        encoding="utf-8",
    )
    done = process("synthesize", named, env={"PYTHONIOENCODING": encoding})
    assert done.returncode in (0, 1)
    assert "four-bar" in done.stdout
    as_json = process("synthesize", named, "--json", env={"PYTHONIOENCODING": encoding})
    names = [pose["name"] for pose in valid(as_json.stdout)["task"]["poses"]]
    assert names == ["\u4e00", "b", "\u00fc", "d", "e"]


def test_cases_are_listed_and_printed():
    listed = run("cases")
    assert listed.returncode == 0
    assert re.findall(r"(?m)^\S+", listed.stdout) == list(names())
    assert max(map(len, listed.stdout.splitlines())) <= 80
    case = json.loads(run("cases", "ge2012-exact").stdout)
    assert case["poses"][5] == [-4.1022, -1.0521, 52.87]
    assert run("cases", "nothing").returncode == 2


def test_reproduce_prints_every_table_and_its_verdicts():
    done = run("reproduce")
    assert done.returncode == 0
    for title in ("Table 3", "Table 4", "Table 6", "Table 7", "Table 8", "Eqs. (19) to (21)"):
        assert title in done.stdout
    assert "0 differs" in " ".join(done.stdout.split())
    if not EVERY:  # the rows are those of `tests/paper`
        return
    data = json.loads(run("reproduce", "--json").stdout)
    verdicts = [row["verdict"] for section in data["sections"] for row in section["rows"]]
    assert verdicts.count("differs") == 0
    assert verdicts.count("misprint") == 12


def imported(*arguments):
    """The modules that a run imports."""
    code = (
        "import sys; from burmester.cli import main\n"
        f"try: main({list(map(str, arguments))})\n"
        "except SystemExit: pass\n"
        "print('\\n'.join(sys.modules), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stderr.split())


@pytest.mark.parametrize("arguments", [("--help",), ("synthesize", "--help")])
def test_help_imports_next_to_nothing(arguments):
    loaded = imported(*arguments)
    assert "click" in loaded
    assert not loaded & {"numpy", "rich", "scipy"}


@pytest.mark.parametrize("source", ["a file", "case:ge2012-exact"])
def test_the_main_job_does_without_what_it_does_not_need(poses, source):
    loaded = imported("synthesize", poses if source == "a file" else source)
    assert {"numpy", "rich"} <= loaded
    assert not loaded & {"scipy", "matplotlib", "jsonschema", "shapely", "flint"}
    assert not loaded & {
        "numpy.ma",
        "numpy.random",
        "tomllib",
        "importlib.metadata",
        "importlib.resources",
    }
    assert "burmester.linkages" in loaded
    assert not loaded & {
        f"burmester.{room}" for room in ("families", "certificates", "loads", "plot")
    }
    assert not loaded & {
        "rich._emoji_codes",
        "burmester.dyads.minima_within_limits",
        "burmester.dyads.limited_block",
        "burmester.refinement.rounding",
        "burmester.tasks.function_task",
    }


def test_exported_names_are_those_that_a_type_checker_sees():
    tree = ast.parse(Path(burmester.__file__).read_text(encoding="utf-8"))
    block = next(node for node in tree.body if isinstance(node, ast.If))
    seen = {each.name: node.module for node in block.body for each in node.names}
    assert {*seen, "__version__"} > set(dir(burmester)) > set(burmester.__all__)
    for name, room in seen.items():
        assert getattr(burmester, name) is getattr(import_module(room), name)
    with pytest.raises(AttributeError):
        burmester.no_such_thing  # noqa: B018


def test_ctrl_c_leaves_quietly(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-m", "burmester", "synthesize", "-"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    time.sleep(1.0)  # it waits for standard input by then
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)
    assert process.returncode == 130
    assert out == ""
    assert "Traceback" not in err
    assert "interrupted" in err


def test_a_closed_pipe_is_not_an_error(poses):
    done = subprocess.run(
        f"{sys.executable} -m burmester explain | true; echo ${{PIPESTATUS[0]}}",
        shell=True,
        executable="/bin/bash",
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert "Traceback" not in done.stderr
    assert "error" not in done.stderr
