"""Paths in tables and drawings, and what comes back of a result."""

import json

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.io.reading.poses import read_task
from burmester.io.result import json_line, synthesis_data, task_data
from burmester.io.saved import read_result
from burmester.synthesis.motion_generation import synthesize
from tests.oracles.coupler_curves import CABRERA, CABRERA_TURNS, distances, dyads_of
from tests.oracles.drawings import svg

ROWS = "".join(f"{x},{y},{20 * k}\n" for k, (x, y) in enumerate(CABRERA.tolist()))
TIMED = f"x_mm,y_mm,crank_deg\n{ROWS}"


def read(text, name="-", **how):
    return read_task(name, data=text if isinstance(text, bytes) else text.encode(), **how)


def test_timed_points():
    task = read(TIMED)
    assert np.allclose(task.poses.translation, CABRERA)
    assert np.allclose(task.path.crank_angles, CABRERA_TURNS)
    assert (task.path.closed, task.length_unit) == (False, "mm")
    assert task.tolerances.free[:, 2].all()
    assert np.allclose(read(TIMED.replace("_deg", "_rad")).path.crank_angles, 20 * np.arange(18))
    some = read(TIMED, every=3)
    assert np.allclose(some.path.crank_angles, CABRERA_TURNS[::3])


def test_a_first_point_again_closes_the_path():
    points = [*CABRERA.tolist(), CABRERA[0].tolist()]
    text = "x;y\n" + "".join(f"{x};{y}\n".replace(".", ",") for x, y in points)
    task = read(text)
    assert len(task.poses.angle) == 18
    assert task.path.closed
    assert [each.code for each in task.notes] == ["W213"]
    blank = "x;y;angle_deg\n" + text.partition("\n")[2].replace("\n", ";\n")
    assert read(blank).path.closed
    assert np.array_equal(read(blank).poses.translation, task.poses.translation)
    one = blank.removesuffix("\n") + "30\n"
    assert read(one).path is None
    assert read(one).free_angles.tolist() == 18 * [True] + [False]
    stated = read("x,y\n" + "".join(f"{x},{y}\n" for x, y in CABRERA.tolist()), closed=True)
    assert stated.path.closed


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (TIMED.replace("0.5,1.1,0\n", "0.5,1.1,\n"), "E186"),
        (TIMED.replace("0.5,1.1,0\n", "0.5,a,0\n"), "E104"),
        (TIMED.replace("0.5,1.1,0\n", "0.5,1.1,0,7\n"), "E106"),
        ("x,y,crank_deg\n0,0,0\n1,1,9\n", "E186"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(text, code):
    with pytest.raises(InputError) as caught:
        read(text)
    assert caught.value.code == code
    assert caught.value.where


def test_a_point_without_its_crank_angle_is_shown_by_its_row_in_the_file():
    lines = TIMED.splitlines(keepends=True)
    lines[3] = lines[3].rpartition(",")[0] + ",\n"
    with pytest.raises(InputError, match="row 3 has no crank angle") as caught:
        read("".join(lines), drop=["1"])
    assert caught.value.where.partition("\n")[0].endswith(":4:1")


def test_drawn_curves():
    circle = svg('<circle cx="50" cy="40" r="30"/>')
    task = read(circle, "round.svg")
    points = task.poses.translation
    assert task.path.closed
    assert task.length_unit == "mm"
    middle = points.mean(axis=0)
    radius = np.hypot(*(points - middle).T)
    assert np.allclose(radius, 30, atol=0.05)
    step = np.hypot(*np.diff(points, axis=0, append=points[:1]).T)
    assert np.allclose(step, step.mean(), rtol=0.01)
    line = read(svg('<path d="M 0 0 L 90 0"/>'), "line.svg")
    assert not line.path.closed
    assert np.allclose(np.ptp(line.poses.translation, axis=0), (90, 0), atol=1e-9)


def test_a_result_keeps_its_path_and_its_cognates():
    task = read(TIMED.replace("x_mm,y_mm", "x,y"))
    found = synthesize(task)
    line = json_line(synthesis_data(found))
    saved = read_result("-", data=line.encode()).synthesis  # everything is judged again
    assert np.allclose(saved.task.path.crank_angles, CABRERA_TURNS)
    assert task_data(saved.task)["path"] == {"closed": False, "crank_deg": [*range(0, 360, 20)]}
    best = json.loads(line)["linkages"][0]
    assert len(best["cognates"]) == 2
    z = [*best["dyads"][0]["fixed_pivot"], *best["dyads"][1]["fixed_pivot"]]
    first, second = (each["dyads"] for each in best["cognates"])
    assert first[0]["fixed_pivot"] == pytest.approx(z[:2])
    assert second[0]["fixed_pivot"] == pytest.approx(z[2:])
    # The cognate with a crank traces the points as near as the linkage itself does.
    crank, rocker = second[1], second[0]
    m1, m2 = (np.array(each["moving_pivot"]) for each in (crank, rocker))
    arm = complex(*(m2 - m1))
    c = -complex(*m1) / arm * abs(arm)
    numbers = [*crank["fixed_pivot"], *rocker["fixed_pivot"], crank["radius"], abs(arm)]
    own = distances(dyads_of([*numbers, rocker["radius"], c.real, c.imag]), CABRERA)
    linkage = found.linkages[0].driver_first
    assert own == pytest.approx(distances((linkage.first, linkage.second), CABRERA), abs=1e-6)


def test_more_points_than_a_linkage_meets_are_a_path():
    data = {"angle_unit": "deg", "tolerance": {"x": 0, "y": 0, "angle": "free"}}
    task = read(json.dumps(data | {"poses": [[x, y, 0] for x, y in CABRERA.tolist()]}))
    assert task.path is not None
    assert not task.path.closed
    assert task.path.crank_angles is None
    few = read(json.dumps(data | {"poses": [[x, y, 0] for x, y in CABRERA[:7].tolist()]}))
    assert few.path is None


TWICE = "".join(f"{x},{y}\n" * 2 for x, y in CABRERA.tolist())


@pytest.mark.parametrize(("text", "code"), [("0,0\n" * 11, "R351"), (TWICE, "R350")])
def test_points_that_repeat(text, code):
    found = synthesize(read(f"x,y\n{text}", closed=True))
    assert found.outcome.code == code
    if code == "R350":
        read_result("-", data=json_line(synthesis_data(found)).encode())
