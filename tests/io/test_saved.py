"""Results that were written and are read back: the same linkages, the driver first."""

import json

import numpy as np
import pytest

from burmester import synthesize
from burmester.api.linkage import ReadLinkage
from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.io import templates
from burmester.io.reading.poses import read_task
from burmester.io.result import synthesis_data
from burmester.io.saved import read_result
from burmester.tasks.motion_task import Task
from tests.oracles.witness import places


def written(task, folder):
    """A synthesis, and the file that it is written to."""
    found = synthesize(task)
    path = folder / "result.json"
    path.write_text(json.dumps(synthesis_data(found)))
    return found, path


def numbers(dyad):
    return [np.asarray(getattr(dyad, name)) for name in type(dyad).__slots__]


@pytest.mark.parametrize("name", ["ge2012-exact", "motiongen-shoulder", "motiongen-rrpr"])
def test_every_linkage_comes_back(name, tmp_path):
    found, path = written(read_task(f"case:{name}"), tmp_path)
    result = read_result(path)
    assert [each.id for each in result.linkages] == [each.id for each in found.linkages]
    for mine, saved in zip(found.linkages, result.linkages, strict=True):
        assert (saved.usable, saved.type) == (mine.usable, mine.type)
        assert saved.other_types == mine.other_types
        led = mine.driver_first if mine.usable else mine.linkage
        for one, other in ((led.first, saved.linkage.first), (led.second, saved.linkage.second)):
            assert type(one) is type(other)
            for a, b in zip(numbers(one), numbers(other), strict=True):
                assert b == pytest.approx(a, abs=1e-14, rel=1e-14)
        if np.isfinite(mine.error.worst):
            assert saved.error.worst == pytest.approx(mine.error.worst, abs=1e-12)


def test_other_types_come_back_and_an_older_file_has_none(tmp_path):
    dyads = RR([0, 0], [0, 0], 1.0), RR([3.0, 0], [2.3, 0], 1.699)
    z, phi = (each[0] for each in places(*dyads, np.linspace(0.4, 2.2, 9)))
    rows = np.column_stack([z.real, z.imag, phi]).round(3)
    task = Task(Displacement.from_poses(rows), resolution=(5e-4, 5e-4))
    _found, path = written(task, tmp_path)
    saved = read_result(path).choose()
    assert {saved.type, *saved.other_types} == {"triple-rocker", "crank-rocker"}
    assert f"{saved.type} (or {saved.other_types[0]} within ±) of" in repr(ReadLinkage.of(saved))
    older = json.loads(path.read_text())
    for each in older["linkages"]:
        del each["possible_types"]
    path.write_text(json.dumps(older))
    assert read_result(path).choose().other_types == ()


def test_the_driver_is_first_also_where_limits_order_the_dyads(tmp_path):
    (tmp_path / "gear.toml").write_text(templates.text("landing-gear"))
    found, path = written(read_task(tmp_path / "gear.toml"), tmp_path)
    best = found.usable[0]
    assert best.driver == "second"
    saved = read_result(path).choose()
    assert saved.driver == "second"
    assert saved.ids == (best.dyads[1].id, best.dyads[0].id)
    # The strut that drives is the longer one; the witness, driven by it, comes to the poses.
    assert float(saved.linkage.first.radius) == float(best.linkage.second.radius) > 400
    at, angle = places(
        saved.linkage.first, saved.linkage.second, np.linspace(-np.pi, np.pi, 100_001)
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


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda data: data.update(schema="burmester.synthesis/2"), "E150"),
        (lambda data: data.update(task=None), "E150"),
        (lambda data: data["linkages"][0]["dyads"][0].update(kind="XX"), "E150"),
        (lambda data: data["linkages"][0]["dyads"][0].pop("radius"), "E150"),
        (lambda data: data["linkages"][0]["dyads"][0].update(fixed_pivot=[1e400, 0]), "E103"),
        (lambda data: data["linkages"][0]["dyads"][1].update(radius=4.6639), "E152"),
        (lambda data: data["linkages"][0]["position_error"].update(max=0.1), "E152"),
        (lambda data: data["task"]["poses"][2].update(x=0), "E152"),
    ],
)
def test_a_result_that_was_changed_is_refused(change, code, tmp_path):
    _, path = written(read_task("case:ge2012-exact"), tmp_path)
    data = json.loads(path.read_text())
    change(data)
    path.write_text(json.dumps(data))
    with pytest.raises(InputError) as caught:
        read_result(path)
    assert caught.value.code == code
    assert caught.value.where.startswith(str(path))
    assert caught.value.help
