"""Models with the loads of a task: MuJoCo holds the linkage with the torque that is told of it."""

from xml.etree import ElementTree

import numpy as np
import pytest

import burmester
from burmester import Drive, End, Force, Loads, Mass, Plates, Spring

mujoco = pytest.importorskip("mujoco")

ROWS = {
    "four-bar": [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)],
    "six-bar": [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)],
}
GROUND, BODY = End("ground", (0.0, -80.0)), End("body", (60.0, 4.0))
SPRINGS = {
    "none": (),
    "extension": (Spring("extension", (GROUND, BODY), {"rate_N_per_mm": 0.5, "free_length": 60}),),
    "initial tension": (
        Spring(
            "extension",
            (GROUND, BODY),
            {"rate_N_per_mm": 0.1, "free_length": 20, "initial_N": 15},
            count=2,
        ),
    ),
    "no free length": (
        Spring("extension", (GROUND, BODY), {"rate_N_per_mm": 0.5, "free_length": 0}),
    ),
    "compression": (
        Spring("compression", (GROUND, BODY), {"rate_N_per_mm": 2, "free_length": 300}),
    ),
    "gas": (
        Spring(
            "gas",
            (GROUND, BODY),
            {"force_N": 50, "compressed_force_N": 70, "stroke": 240, "length": 300},
        ),
    ),
    "gas without a rate": (
        Spring(
            "gas",
            (GROUND, BODY),
            {"force_N": 50, "compressed_force_N": 50, "stroke": 240, "length": 300},
        ),
    ),
    "constant": (Spring("constant", (BODY, GROUND), {"force_N": 12}),),
    "torsion": (
        Spring("torsion", (End("ground", (0, 0)), End("body", (0, 0))), {"rate_Nm_per_deg": 0.02}),
        Spring(
            "torsion",
            (End("body", (0, 0)), End("ground", (0, 0))),
            {"rate_Nm_per_deg": 0.03, "free_deg": -200},
        ),
    ),
    "counterweight": (
        Spring("counterweight", (End("ground", (0, 0)), End("body", (-40, 0))), {"mass_kg": 2.5}),
    ),
}


def best_of(kind, springs, **more):
    loads = Loads(
        body=Mass(4.0, [30.0, 0.0], 0.01),
        links=Plates("steel", 3.0, 20.0),
        forces=(Force([50.0, 0.0], [3.0, -5.0]), Force([10.0, 9.0], [1.0, 2.0], "M")),
        torque=0.4,
        springs=springs,
        drive=Drive(2.0),
        **more,
    )
    task = burmester.Task.from_rows(ROWS[kind], angle_unit="deg", length_unit="mm", loads=loads)
    if kind == "four-bar":
        return burmester.synthesize(task).best
    return burmester.synthesize_six_bars(task, kind="Watt I", chains=500).best


def held_by_mujoco(model, pose):
    """The driver's effort by virtual work: MuJoCo's forces along its own constraints."""
    data = mujoco.MjData(model)
    model.actuator_gainprm[0] = model.actuator_biasprm[0] = 0.0  # the servo rests
    mujoco.mj_resetDataKeyframe(model, data, pose)
    mujoco.mj_forward(model, data)
    rows = np.zeros((data.nefc, model.nv))
    rows[:] = data.efc_J.reshape(data.nefc, model.nv)
    rows = rows[data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY]
    _, _, axes = np.linalg.svd(rows)
    freedom = axes[-1]  # the only way in which nothing is torn
    freedom = freedom / freedom[model.jnt_dofadr[model.actuator_trnid[0, 0]]]
    return float((data.qfrc_bias - data.qfrc_passive - data.qfrc_actuator) @ freedom)


@pytest.mark.parametrize("name", SPRINGS)
@pytest.mark.parametrize("kind", ROWS)
def test_mujoco_holds_with_the_torque_that_is_told(kind, name, tmp_path):
    best = best_of(kind, SPRINGS[name])
    path = best.export(tmp_path / "model.xml")
    curves = best.loaded(2)
    at_poses = np.array(
        [
            held_by_mujoco(mujoco.MjModel.from_xml_path(str(path)), k)
            for k in (0, len(ROWS[kind]) - 1)
        ]
    )
    size = max(abs(best.loads.effort.least), abs(best.loads.effort.greatest))
    assert at_poses == pytest.approx(curves.effort, abs=1e-6 * size)


@pytest.mark.parametrize("kind", ROWS)
def test_masses_and_gravity_are_those_of_the_task(kind, tmp_path):
    best = best_of(kind, (), gravity=[1.0, -2.0])
    model = mujoco.MjModel.from_xml_path(str(best.export(tmp_path / "model.xml")))
    assert model.opt.gravity.tolist() == [1.0, -2.0, 0.0]
    weights = sorted(model.body_mass.tolist())
    assert weights[-1] > 4.0
    assert all(0.001 < each < 1 for each in weights[1:-1])


def test_a_gas_spring_rubs_and_a_force_of_some_poses_is_left_out(tmp_path):
    gas = Spring(
        "gas",
        (GROUND, BODY),
        {"force_N": 50, "compressed_force_N": 70, "stroke": 240, "length": 300, "friction_N": 8},
        count=2,
    )
    loads = Loads(springs=(gas,), forces=(Force([0, 0], [0, -9], from_pose=1, to_pose=2),))
    task = burmester.Task.from_rows(
        ROWS["four-bar"], angle_unit="deg", length_unit="mm", loads=loads
    )
    best = burmester.synthesize(task).best
    text = best.export(tmp_path / "model.xml").read_text()
    (tendon,) = ElementTree.fromstring(text).findall("tendon/spatial")
    assert float(tendon.get("frictionloss")) == 16
    assert "Force 1 acts between some poses only" in text
    model = mujoco.MjModel.from_xml_string(text)
    assert model.nu == 1
    assert min(model.body_mass[1:]) > 1e-4  # no masses are stated: those of the plates
