"""Results that were written and are read back: the same linkages, the driver first."""

import json

import numpy as np
import pytest

from burmester import synthesize
from burmester.api import saved as api
from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.io import templates
from burmester.io.reading.poses import read_task
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from burmester.tasks.motion_task import Task
from tests.oracles.common_tasks import in_line
from tests.oracles.witness import places


def written(task, folder):
    """A synthesis, and the file that it is written to."""
    found = synthesize(task)
    path = folder / "result.json"
    path.write_text(json.dumps(synthesis_data(found)))
    return found, path


def test_other_types_come_back(tmp_path):
    dyads = RR([0, 0], [0, 0], 1.0), RR([3.0, 0], [2.3, 0], 1.699)
    z, phi = (each[0] for each in places(*dyads, np.linspace(0.4, 2.2, 9)))
    rows = np.column_stack([z.real, z.imag, phi]).round(3)
    task = Task(Displacement.from_poses(rows), resolution=(5e-4, 5e-4))
    _found, path = written(task, tmp_path)
    saved = read_result(path).choose()
    assert {saved.type, *saved.other_types} == {"triple-rocker", "crank-rocker"}
    assert f"{saved.type} (or {saved.other_types[0]} within ±) of" in repr(
        api.read_result(path).best
    )


def test_the_driver_is_first_also_where_limits_order_the_dyads(tmp_path):
    (tmp_path / "gear.toml").write_text(templates.text("landing-gear"))
    found, path = written(read_task(tmp_path / "gear.toml"), tmp_path)
    best = found.usable[0]
    assert best.driver == "second"
    saved = read_result(path).choose()
    assert saved.driver == "second"
    assert saved.ids == (best.dyads[1].id, best.dyads[0].id)
    # The strut that drives is the longer one; the witness, driven by it, comes to the poses.
    assert float(saved.driver_first.first.radius) == float(best.linkage.second.radius) > 400
    at, angle = places(
        saved.driver_first.first, saved.driver_first.second, np.linspace(-np.pi, np.pi, 100_001)
    )
    for wanted, turned in zip(saved.task.poses.translation, saved.task.poses.angle, strict=True):
        turn = np.abs(np.exp(1j * angle) - np.exp(1j * turned))
        away = np.hypot(np.abs(at - complex(*wanted)), 500 * turn)
        assert np.nanmin(away) < 0.05


def test_a_linkage_is_chosen_by_its_name_and_the_first_one_by_default(tmp_path):
    _, path = written(read_task("case:ge2012-exact"), tmp_path)
    result = read_result(path)
    assert result.choose().id == "L1"
    assert result.choose("l3").id == "L3"
    with pytest.raises(InputError, match="no linkage L99"):
        result.choose("L99")


def changed(change, folder):
    """What is read where the tree of a result was changed, and the file."""
    _, path = written(read_task("case:ge2012-exact"), folder)
    data = json.loads(path.read_text())
    change(data)
    path.write_text(json.dumps(data))
    return read_result(path)


@pytest.mark.parametrize(
    "change",
    [
        lambda data: data.update(schema="burmester.synthesis/2"),
        lambda data: data.update(task=None),
        lambda data: data.update(outcome=None),
        lambda data: data.update(linkages={}),
        lambda data: data.update(options={"norm": "least"}),
        lambda data: data["dyads"][0].update(fixed_pivot="x"),
        lambda data: data["linkages"][2].update(id="L1"),
        lambda data: data["linkages"].append(3),
        lambda data: [each.pop("dyads") for each in data["linkages"]],
    ],
)
def test_a_result_that_cannot_be_used_is_refused(change, tmp_path):
    with pytest.raises(InputError) as caught:
        changed(change, tmp_path)
    assert caught.value.code == "E150"
    assert caught.value.where.startswith(str(tmp_path))
    assert caught.value.help


@pytest.mark.parametrize(
    ("change", "words"),
    [
        # Other dimensions are another linkage, another pose another task.
        (lambda data: data["linkages"][0]["dyads"][1].update(radius=4.6639), "L1 misses a pose by"),
        (lambda data: data["linkages"][0]["dyads"][1].update(radius=9.0), "L1 is not usable ("),
        (lambda data: data["task"]["poses"][2].update(x=-0.9), "L1 "),
        (lambda data: data["linkages"][10]["dyads"][0].update(fixed_pivot=[3, 1]), "of L11 misses"),
        (lambda data: data["linkages"][0].update(usable=False), "L1 is usable, and the file says"),
        (lambda data: data["linkages"][0]["position_error"].update(max=0.1), "L1 misses a pose by"),
        (lambda data: data["outcome"].update(code="R301"), "R301"),
    ],
)
def test_what_a_file_says_otherwise_is_told(change, words, tmp_path):
    read = changed(change, tmp_path)
    (told,) = [each for each in read.synthesis.warnings if each.code == "W244"]
    assert words in told.message
    assert len(read.synthesis.linkages) == 11
    path = tmp_path / "again.json"  # and not a second time
    path.write_text(json.dumps(synthesis_data(read.synthesis)))
    codes = [each.code for each in read_result(path).synthesis.warnings]
    assert ("W244" in codes) == (read.synthesis.works is (words == "R301"))


@pytest.mark.parametrize(
    "change",
    [
        lambda one: one.pop("dyads"),
        lambda one: one["dyads"][0].pop("radius"),
        lambda one: one["dyads"][0].update(kind="XX"),
        lambda one: one["dyads"][0].update(fixed_pivot=[1e308, 0]),
        lambda one: one["dyads"][0].update(fixed_pivot=[None, 0]),
        lambda one: one["dyads"].pop(),
        lambda one: one.update(dyads=[one["dyads"][0]] * 2),
    ],
)
def test_one_bad_linkage_does_not_keep_the_others_from_being_read(change, tmp_path):
    read = changed(lambda data: change(data["linkages"][1]), tmp_path)
    ids = [each.id for each in read.synthesis.linkages]
    assert ids == ["L1", *(f"L{k}" for k in range(3, 12))]
    assert read.choose("L3").id == "L3"
    with pytest.raises(InputError) as caught:
        read.choose("l2")
    assert caught.value.code == "E150"
    assert "$.linkages[1].dyads" in caught.value.message
    (told,) = [each for each in read.synthesis.warnings if each.code == "W244"]
    assert told.message == "judged anew, L2 cannot be used"


SYMMETRIC = [
    (56.7967, 78.6343, 49.2614),
    (53.0696, 84.4326, 29.1841),
    (46.4046, 87.8916, 14.0395),
    (29.6605, 87.8916, -14.0395),
    (22.9955, 84.4326, -29.1841),
    (19.2684, 78.6343, -49.2614),
]


@pytest.mark.parametrize(
    "rows", [in_line(np.arange(0, 360, 60), 6), in_line(np.arange(0, 360, 60), 2), SYMMETRIC]
)
def test_own_results_beside_a_dead_point_are_read(rows, tmp_path):
    """Where one linkage that is of no use depends on rounding in its fifth digit."""
    file = tmp_path / "poses.csv"
    lines = [",".join(map(str, row)) for row in rows]
    file.write_text("\n".join(["x_mm,y_mm,angle_deg", *lines]))
    found, path = written(read_task(file), tmp_path)
    read = read_result(path).synthesis
    assert [each.usable for each in read.linkages] == [each.usable for each in found.linkages]
    assert "W244" not in {each.code for each in read.warnings}
