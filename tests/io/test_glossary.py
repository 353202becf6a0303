"""Every name of Python and every key of JSON that the glossary gives exists."""

import json
import re
from importlib import import_module
from pathlib import Path

import pytest
from click.testing import CliRunner

from burmester.cli import burmester

LINES = [
    line
    for line in (Path(__file__).parents[2] / "docs/glossary.md").read_text("utf-8").splitlines()
    if line.startswith("- ")
]
TIMED = "x,y,crank_deg\n0.5,1.1,0\n0.1,0.9,80\n0,0.4,160\n0.2,0.3,240\n0.5,0.7,300\n"
POSES = "x,y,angle_deg,crank_deg\n0,0,0,0\n2.3936,-1.449,-45,342.3\n3.7607,-1.1026,9.3,324.8\n"
POINTS = """x,y,angle_deg
0.973329,1.841643,51.84518
1.013217,2.219586,38.83281
0.643693,2.389129,
0.092623,2.243994,29.85902
-0.450987,1.760176,
-0.716342,1.141258,44.56691
"""
RAILS = {
    "poses": [{"x": 0, "y": 0, "angle_deg": 0}, {"x": 2, "y": 1, "angle_deg": 40}],
    "limits": [{"rail": {"direction_deg": 10}}, {"slot": {"direction_deg": 20}}],
}
TASK = {
    "poses": [
        {"x": -0.8253, "y": -1.0329, "angle_deg": 91.91, "weight": 2, "exact": True},
        {"x": -2.6392, "y": 0.2920, "angle_deg": 73.76},
        {"x": -2.8873, "y": 1.2886, "angle_deg": 52.67},
        {"x": -2.7383, "y": 1.4471, "angle_deg": 43.11},
        {"x": -2.9116, "y": 0.9103, "angle_deg": 44.55},
    ],
    "body": [[0, 0], [1, 0], [0, 1]],
    "keep_out": [{"box": [[500, 500], [510, 510]]}],
    "limits": {"kinds": ["RR", "PR", "RP"]},
    "requirements": {"footprint": {"box": [[-50, -50], [50, 50]]}, "any_order": True},
}


def names():
    return sorted({n for line in LINES for n in re.findall(r"`([a-z][\w.]*)`", line)})


def found(name):
    """The object of a dotted name below the package; a field of a class by its annotation."""
    parts = ["burmester", *name.split(".")]
    for end in range(len(parts), 0, -1):
        try:
            value = import_module(".".join(parts[:end]))
        except ModuleNotFoundError:
            continue
        for part in parts[end:]:
            if not hasattr(value, part):
                return value.__annotations__[part]
            value = getattr(value, part)
        return value
    raise AssertionError(name)


def keys(tree):
    """All keys of an object of JSON."""
    if isinstance(tree, dict):
        return set(tree).union(*map(keys, tree.values()))
    return set().union(*map(keys, tree)) if isinstance(tree, list) else set()


@pytest.mark.parametrize("name", names())
def test_a_name_of_python_exists(name):
    assert found(name) is not None


def test_every_key_is_printed(tmp_path):
    path = tmp_path / "task.json"
    path.write_text(json.dumps(TASK))
    given = {k for line in LINES for k in re.findall(r'`"(\w+)"`', line)}
    options = [["--certify"], ["--tolerance", "0.01", "--round", "0.1"], ["--method", "pencil"]]
    tasks = ["case:ge2012-exact", str(path), "case:ge2012-approximate"]
    printed = set()
    for task, more in zip(tasks, options, strict=True):
        done = CliRunner().invoke(burmester, ["synthesize", task, "--json", *more])
        printed |= keys(json.loads(done.stdout))
    function = "x**2 --x 1:2 --input 60 --output 60 --pairs 3 --json"
    phases = "--input-phase 50 --output-phase 60"
    done = CliRunner().invoke(burmester, ["function", *function.split(), *phases.split()])
    printed |= keys(json.loads(done.stdout))
    (tmp_path / "rails.json").write_text(json.dumps(RAILS))
    done = CliRunner().invoke(burmester, ["synthesize", str(tmp_path / "rails.json"), "--json"])
    printed |= keys(json.loads(done.stdout))
    for content, more in ((TIMED, []), (POINTS, []), (POSES, ["--absolute-crank"])):
        (tmp_path / "points.csv").write_text(content)
        asked = ["synthesize", str(tmp_path / "points.csv"), "--json", *more]
        done = CliRunner().invoke(burmester, asked)
        printed |= keys(json.loads(done.stdout))
    assert given - printed == set()


def test_a_line_is_a_term_and_its_meaning():
    terms = [re.fullmatch(r"- \*\*([^*]+)\*\*: .*\S", line) for line in LINES]
    assert all(terms)
    assert len({term[1] for term in terms}) == len(LINES)
