"""MJCF and URDF, in MuJoCo: does the motor take the body through the poses?"""

import re

import numpy as np
import pytest

from burmester.export import Options
from burmester.export.models.bodies import JointMotion
from burmester.export.options import Reference
from burmester.fourbar.dyad import PR
from tests.oracles.handed_over import NAMES, complex_places, joints, scale_of, span_of, written

mujoco = pytest.importorskip("mujoco")

STEPS = 150  # of the simulator, from pose to pose
PATIENCE = 200  # times 50 more of them, to come to rest
STILL = 1e-9  # a speed, in spans or radians a second
# Of the span, and radians: from the linkage's places, after a motor took it there.  The simulator
# closes the loop by a stiff spring, which gives way where there is weight to hold.
DRIVEN = {"weightless": 1e-8, "heavy": 5e-6}


def placed(model, data, name="body"):
    """A site: where it is, and e^(i angle)."""
    at = data.site(name).xpos
    turn = data.site(name).xmat.reshape(3, 3)
    assert abs(at[2]) < 1e-12
    return complex(*at[:2]), complex(turn[0, 0], turn[1, 0])


@pytest.mark.parametrize("name", NAMES)
def test_every_key_frame_is_a_pose(name, tmp_path):
    chosen, path = written(name, "mjcf", tmp_path, Options(pose=2))
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    scale = scale_of(chosen) / 1000
    span = span_of(chosen, scale)
    d, turn = complex_places(chosen, scale)
    mujoco.mj_forward(model, data)
    at, angle = placed(model, data)
    assert abs(at - d[1]) <= 1e-9 * span  # as it is loaded
    assert abs(angle - turn[1]) <= 1e-9
    assert model.nkey == 6
    for k in range(6):
        mujoco.mj_resetDataKeyframe(model, data, k)
        mujoco.mj_forward(model, data)
        at, angle = placed(model, data)
        assert abs(at - d[k]) <= 1e-9 * span
        assert abs(angle - turn[k]) <= 1e-9
        assert abs(placed(model, data, "loop_a")[0] - placed(model, data, "loop_b")[0]) <= (
            1e-9 * span
        )
        low, high = model.actuator_ctrlrange[0]
        assert low <= data.ctrl[0] <= high


@pytest.mark.parametrize("weight", DRIVEN)
@pytest.mark.parametrize("name", NAMES)
def test_the_motor_takes_the_body_through_the_poses(name, weight, tmp_path):
    """With the weight that the model has, the ctrl of a key frame holds the linkage at its pose."""
    chosen, path = written(name, "mjcf", tmp_path)
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    scale = scale_of(chosen) / 1000
    span = span_of(chosen, scale)
    d, turn = complex_places(chosen, scale)
    wanted = chosen.task.poses.translation @ [1, 1j] * scale
    near, controls = DRIVEN[weight], model.key_ctrl[:, 0]
    if weight == "weightless":
        model.opt.gravity[:] = 0
        controls = model.key_qpos[:, model.joint("driver").qposadr[0]]
    mujoco.mj_resetDataKeyframe(model, data, 0)
    sent = controls[0]
    for k in range(1, 6):
        target = controls[k]
        for share in (1 - np.cos(np.pi * np.arange(1, STEPS + 1) / STEPS)) / 2:
            data.ctrl[0] = sent + share * (target - sent)
            mujoco.mj_step(model, data)
            assert not data.ncon  # no plate is in the way of another
        sent = target
        for _ in range(PATIENCE):
            mujoco.mj_step(model, data, 50)
            if np.abs(data.qvel).max() < STILL * min(span, 1):
                break
        mujoco.mj_forward(model, data)
        at, angle = placed(model, data)
        assert abs(at - d[k]) <= near * span, k
        assert abs(angle - turn[k]) <= near, k
        assert abs(at - wanted[k]) <= chosen.error.position[k] * scale + near * span
        loop = placed(model, data, "loop_a")[0] - placed(model, data, "loop_b")[0]
        assert abs(loop) <= near * span


@pytest.mark.parametrize("name", NAMES)
def test_urdf_is_the_linkage_with_its_loop_open(name, tmp_path):
    chosen, path = written(name, "urdf", tmp_path, Options(pose=3))
    text = path.read_text()
    # Frames without mass are kept, as the frames of other programs are.
    keep = '<mujoco><compiler fusestatic="false" boundinertia="1e-14"/></mujoco></robot>'
    model = mujoco.MjModel.from_xml_string(text.replace("</robot>", keep))
    data = mujoco.MjData(model)
    scale = scale_of(chosen) / 1000
    span = span_of(chosen, scale)
    d, turn = complex_places(chosen, scale)
    for moved in (False, True):
        k = 5 if moved else 2
        if moved:
            q = JointMotion.of(chosen, Reference.of(chosen, Options(), "m")).at_poses
            for column, joint in ((0, "driver"), (2, "follower")):
                data.joint(joint).qpos[0] = q[5, column] - q[2, column]
            carried = moved_by(chosen, scale)
            for joint, value in carried.items():
                data.joint(joint).qpos[0] = value
        mujoco.mj_forward(model, data)
        body, ground = data.body("body"), data.body("ground")
        stands = ground.xmat.reshape(3, 3)
        at = stands.T @ (body.xpos - ground.xpos)
        assert abs(complex(*at[:2]) - d[k]) <= 1e-9 * span
        matrix = stands.T @ body.xmat.reshape(3, 3)
        assert abs(complex(matrix[0, 0], matrix[1, 0]) - turn[k]) <= 1e-9
        one, two = data.body("loop_a").xpos, data.body("loop_b").xpos
        assert np.abs(one - two).max() <= 1e-9 * span
        at = joints(chosen, k, scale)
        one = stands.T @ one
        assert abs(complex(*one[:2]) - at.get("moving2", at.get("fixed2"))) <= 1e-9 * span
    assert re.search(r"<!--.*loop.*-->", text, re.S)


def moved_by(chosen, scale):
    """What the joints on the coupler, and slots, have moved by from pose 3 to pose 6."""
    d, turn = complex_places(chosen, scale)
    found = {}
    first, second = chosen.linkage.first, chosen.linkage.second

    def seen(dyad, k):
        return (
            (complex(*dyad.fixed_pivot) * scale - d[k]) / turn[k] * np.exp(-1j * dyad.normal_angle)
        )

    if hasattr(first, "radius"):
        arm = d + complex(*first.moving_pivot) * scale * turn - complex(*first.fixed_pivot) * scale
        q = np.angle(turn / (arm / abs(arm)))
        found["coupler"] = q[5] - q[2]
    elif isinstance(first, PR):
        found["coupler"] = np.angle(turn[5] / turn[2])
    else:
        found["driver"] = np.angle(turn[5] / turn[2])
        found["coupler"] = seen(first, 2).imag - seen(first, 5).imag
    if not hasattr(second, "moving_pivot"):
        found["follower"] = seen(second, 5).imag - seen(second, 2).imag
    return found
