"""A requirement that is made up is registered in one place, and found wherever any other is."""

import json
import subprocess
import sys

import pytest

POSES = [
    (-3.9696, -2.6338, 37.23),
    (-0.2223, -0.3211, 27.48),
    (3.3279, 3.9568, 8.17),
    (7.7225, 10.0149, -14.86),
    (5.7615, 18.8535, -25.64),
]
REGISTERED = """
import math, sys
from burmester.requirements import table
from burmester.requirements.requirement import Looser, Number, Requirement

def looser(bound, figures, share):
    if figures.shortest >= bound:
        return None
    new = math.floor(100 * (bound - share * (bound - figures.shortest))) / 100
    return Looser(new, f"a link of {new:g} instead of {bound:g}", math.log(bound / new))

LEAST = Requirement(
    name="least_length",
    kind="least length",
    excess=lambda figures, bound: figures.below(figures.shortest, bound),
    said=lambda figures, bound, unit: f"its shortest link is {figures.shortest:.4g} long; "
    f"at least {bound:g} is asked for",
    standard=STANDARD,
    scaled=True,
    short=lambda figures, length: f"is short, at {length(figures.shortest)}",
    form="number",
    default=0.0,
    option="--least-length",
    metavar="LENGTH",
    help="Length of the shortest link, at least.",
    subject="the least length is",
    such="least_length is one number, such as 5",
    checked=Number(
        "length", "the least length", "a least length of {:g} is impossible",
        why="lengths are not below zero", help="give a length, such as 5", least=0,
    ),
    looser=looser,
)
table.REQUIREMENTS += (LEAST,)
table.ASKED += (LEAST,)

from burmester.cli import main
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture
def run(tmp_path):
    """Runs a command with the requirement registered, in the folder of some poses."""
    rows = "".join(f"{x},{y},{angle}\n" for x, y, angle in POSES)
    (tmp_path / "poses.csv").write_text(f"x,y,angle_deg\n{rows}")
    code = REGISTERED

    def run(*arguments, standard="None"):
        words = [sys.executable, "-c", code.replace("STANDARD", standard), *map(str, arguments)]
        return subprocess.run(words, capture_output=True, text=True, cwd=tmp_path, check=False)

    run.folder = tmp_path
    return run


def shortest(linkage):
    return min(linkage["links"].values())


def test_option_key_verdict_and_cure(run):
    assert "--least-length LENGTH" in run("synthesize", "--help").stdout
    plain = json.loads(run("synthesize", "poses.csv", "--json").stdout)
    usable = [each for each in plain["linkages"] if each["usable"]]
    assert usable
    assert "requirements" not in plain["task"]
    asked = 3 * max(map(shortest, usable))
    done = run("synthesize", "poses.csv", "--least-length", f"{asked:.6g}", "--json")
    assert done.returncode == 1, done.stderr
    data = json.loads(done.stdout)
    assert data["task"]["requirements"] == {"least_length": float(f"{asked:.6g}")}
    unmet = [why for each in data["linkages"] for why in each["unmet"]]
    assert {why["kind"] for why in unmet} == {"least length"}
    assert all("is asked for" in why["message"] for why in unmet)
    # As a key of a file, it asks for the same.
    poses = f"poses = {json.dumps(POSES)}\nangle_unit = 'deg'\n"
    (run.folder / "poses.toml").write_text(f"{poses}[requirements]\nleast_length = {asked:.6g}\n")
    again = json.loads(run("synthesize", "poses.toml", "--json").stdout)
    assert again["outcome"] == data["outcome"]
    # What the outcome says helps does help.
    help = data["outcome"]["help"].split()
    looser = help[help.index("--least-length") + 1]
    cured = run("synthesize", "poses.csv", "--least-length", looser, "--json")
    assert cured.returncode == 0, cured.stderr
    twice = run("synthesize", "poses.toml", "--least-length", 1)
    assert "the least length is given twice" in twice.stderr
    wrong = run("synthesize", "poses.csv", "--least-length", -1)
    assert "error[E134]: a least length of -1 is impossible" in wrong.stderr


def test_the_schema_of_task_files_has_it(run):
    schema = json.loads(run("new", "--schema").stdout)
    asked = schema["properties"]["requirements"]["properties"]["least_length"]
    assert (asked["type"], asked["minimum"]) == ("number", 0)
    assert asked["description"] == "Length of the shortest link, at least."


def test_the_standard_asks_for_it_where_the_task_does_not(run):
    data = json.loads(run("synthesize", "poses.csv", "--json", standard="5.0").stdout)
    assert data["outcome"]["code"] == "R300"
    for each in data["linkages"]:
        assert any(words.startswith("is short, at ") for words in each["shortcomings"])
    asked = run("synthesize", "poses.csv", "--json", "--least-length", "0.01", standard="5.0")
    for each in json.loads(asked.stdout)["linkages"]:
        assert not any(words.startswith("is short") for words in each["shortcomings"])


def test_the_search_of_few_poses_keeps_it(run):
    (run.folder / "three.csv").write_text("x,y,angle_deg\n0,0,0\n30,10,20\n50,40,50\n")

    def least(*asked):
        data = json.loads(run("synthesize", "three.csv", "--json", *asked).stdout)
        return min(
            shortest(each) for each in data["linkages"] if each["usable"] and "links" in each
        )

    plain = least()
    assert least("--least-length", f"{3 * plain:.4g}") >= 3 * plain * (1 - 1e-3)
