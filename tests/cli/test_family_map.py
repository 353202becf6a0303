"""`burmester synthesize --map`, as a process of its own."""

import json
import subprocess
import sys

import pytest
from PIL import Image

from burmester import Task
from burmester.families.family_map import curve_map
from burmester.io.cases import load

ROWS = load("ge2012-exact")["poses"]


COMMAND = [sys.executable, "-m", "burmester", "synthesize", "-", "--columns", "x,y,angle_deg"]


def run(folder, count, *options):
    lines = "\n".join(",".join(map(str, row)) for row in ROWS[:count])
    return subprocess.run(
        [*COMMAND, *options],
        cwd=folder,
        input=lines,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


def test_the_map_of_four_poses_is_written_beside_the_answer(tmp_path):
    done = run(tmp_path, 4, "--map", "family.json", "--json")
    assert "wrote family.json" in done.stderr
    assert json.loads(done.stdout)["schema"] == "burmester.synthesis/1"
    data = json.loads((tmp_path / "family.json").read_text(encoding="utf-8"))
    assert data["schema"] == "burmester.family_map/1"
    poses = Task.from_rows(ROWS[:4], angle_unit="deg")
    assert len(data["class"]) == curve_map(poses).first.radius.size
    again = run(tmp_path, 4, "--map", "family.json")
    assert again.returncode == 2
    assert "E140" in again.stderr


def test_a_figure_of_the_map_is_a_picture(tmp_path):
    done = run(tmp_path, 4, "--map", "family.png")
    assert "wrote family.png" in done.stderr
    with Image.open(tmp_path / "family.png") as picture:
        assert picture.size == (1536, 864)
        assert len(picture.convert("RGB").getcolors(10**6)) > 100


@pytest.mark.parametrize(
    ("count", "options", "code", "helps"),
    [
        (4, ["--map", "family.txt"], "E161", "map.json"),
        (5, ["--map", "family.json"], "E121", "leave the map out"),
        (4, ["--map", "family.json", "--fixed-pivot", "line:0,0:1,0"], "E123", "regions"),
    ],
)
def test_a_map_that_cannot_be_is_refused(tmp_path, count, options, code, helps):
    done = run(tmp_path, count, *options)
    assert done.returncode == 2
    assert code in done.stderr
    assert helps in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_the_map_of_three_poses_has_the_dyad_that_is_recommended(tmp_path):
    done = run(tmp_path, 3, "--map", "family.json", "-o", "result.json")
    assert done.returncode == 0
    data, result = (
        json.loads((tmp_path / name).read_text(encoding="utf-8"))
        for name in ("family.json", "result.json")
    )
    assert data["kind"] == "plane"
    chosen, dyad = data["chosen"], result["linkages"][0]["dyads"][0]
    for name in ("kind", "fixed_pivot", "moving_pivot", "radius"):
        assert chosen[name] == dyad[name]
