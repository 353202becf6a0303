"""Worlds for Gazebo, read by code of their own into MuJoCo: places, and what holds the linkage."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

import burmester
from burmester import End, Force, Loads, Mass, Spring
from burmester.export.models.bodies import JointMotion
from burmester.export.options import Options, Reference
from burmester.loads.loaded_motion import LoadedLinkage

mujoco = pytest.importorskip("mujoco")

ROWS = {
    "four-bar": [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)],
    "six-bar": [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)],
}
ORIGIN = (0.0, 0.0)


def torsion(one, other, free):
    ends = End(one, ORIGIN), End(other, ORIGIN)
    return Spring("torsion", ends, {"rate_Nm_per_deg": 0.02, "free_deg": free})


SPRINGS = {
    "four-bar": (
        torsion("ground", "driver", 30),
        torsion("body", "driver", -70),
        torsion("body", "follower", 10),  # where the loop is closed
        torsion("follower", "ground", 0),
        torsion("driver", "ground", 15),  # the same axis as the first
    ),
    "six-bar": (torsion("body", "ground", 30),),  # no joint of theirs: told, and left out
}


@pytest.fixture(scope="module", params=ROWS)
def best(request):
    loads = Loads(
        gravity=[1.0, -9.0],
        body=Mass(4.0, [30.0, 0.0], 0.01),
        forces=(Force([50.0, 0.0], [3.0, -5.0]),),
        torque=0.4,
        springs=SPRINGS[request.param],
    )
    rows = ROWS[request.param]
    task = burmester.Task.from_rows(rows, angle_unit="deg", length_unit="mm", loads=loads)
    if request.param == "four-bar":
        return burmester.synthesize(task).best
    return burmester.synthesize_six_bars(task, kind="Watt I", chains=500).best


def numbers(element, path):
    return [float(each) for each in element.findtext(path).split()]


def in_mujoco(path):
    """The model of a file as MuJoCo's, by what the format says; and springs of its loop."""
    world = ElementTree.parse(path).getroot().find("world")
    model = world.find("model")
    links = {each.get("name"): each for each in model.findall("link")}
    joints = {each.findtext("child"): each for each in model.findall("joint")
              if not each.get("name").startswith("loop")}  # fmt: skip
    frames = {each.get("name"): each for each in model.findall("frame")}

    def sites(name):
        return "".join(
            f'<site name="{key}" pos="{" ".join(each.findtext("pose").split()[:3])}"/>'
            for key, each in frames.items()
            if each.get("attached_to") == name
        )

    def body(name):
        link, joint = links[name], joints[name]
        i = {key: numbers(link, f"inertial/inertia/i{key}")[0]
             for key in ("xx", "yy", "zz", "xy", "xz", "yz")}  # fmt: skip
        centre = " ".join(map(repr, numbers(link, "inertial/pose")[:3]))
        inertial = f'<inertial pos="{centre}" mass="{numbers(link, "inertial/mass")[0]!r}" '
        inertial += f'fullinertia="{" ".join(repr(each) for each in i.values())}"/>'
        pose = numbers(link, "pose") if link.find("pose") is not None else [0.0] * 6
        moves = ""
        if joint.get("type") != "fixed":
            kind = {"revolute": "hinge", "prismatic": "slide"}[joint.get("type")]
            at = " ".join(map(repr, numbers(joint, "pose")[:3]))
            axis = joint.findtext("axis/xyz")
            spring = ""
            if (stiff := joint.findtext("axis/dynamics/spring_stiffness")) is not None:
                slack = joint.findtext("axis/dynamics/spring_reference")
                spring = f' stiffness="{stiff}" springref="{slack}"'
            moves = f'<joint name="{name}" type="{kind}" pos="{at}" axis="{axis}"{spring}/>'
        inside = "".join(
            body(other)
            for other, own in links.items()
            if own.find("pose") is not None and own.find("pose").get("relative_to") == name
        )
        return (
            f'<body name="{name}" pos="{" ".join(map(repr, pose[:3]))}" euler="0 0 {pose[5]!r}">'
            f"{inertial}{moves}{sites(name)}{inside}</body>"
        )

    loops = "".join(
        f'<connect site1="{each.find("pose").get("relative_to")[:-1]}a" '
        f'site2="{each.find("pose").get("relative_to")}"/>'
        for each in model.findall("joint")
        if each.get("name").startswith("loop")
    )
    text = (
        f'<mujoco><compiler angle="radian" boundmass="1e-14" boundinertia="1e-14"/>'
        f'<option gravity="{world.findtext("gravity")}"/><worldbody>{body("ground")}</worldbody>'
        f"<equality>{loops}</equality></mujoco>"
    )
    loop_springs = [
        (each.findtext("parent"), each.findtext("child"),
         numbers(each, "axis/dynamics/spring_stiffness")[0],
         numbers(each, "axis/dynamics/spring_reference")[0])
        for each in model.findall("joint")
        if each.get("name").startswith("loop")
        and each.find("axis/dynamics/spring_stiffness") is not None
    ]  # fmt: skip
    return mujoco.MjModel.from_xml_string(text), loop_springs


def turn_of(data, name):
    matrix = data.body(name).xmat.reshape(3, 3)
    return np.arctan2(matrix[1, 0], matrix[0, 0])


@pytest.mark.parametrize("pose", [1, 3])
def test_it_meets_the_poses_and_is_held_by_the_torque_that_is_told(best, pose, tmp_path):
    (path,) = [best.export(tmp_path / "a.sdf", pose=pose)]
    model, loop_springs = in_mujoco(path)
    data = mujoco.MjData(model)
    # What the format holds: all but forces, the torque, and springs without a joint of their own.
    kept = tuple(best.task.loads.springs if best.task.loads.springs == SPRINGS["four-bar"] else ())
    loads = replace(best.task.loads, forces=(), torque=0.0, springs=kept)
    linkage = LoadedLinkage.of(replace(best, task=replace(best.task, loads=loads)))
    told = linkage.at(linkage.pose_shares)
    reference = Reference.of(best, Options(), "m")
    rows = JointMotion.of(best, reference).at_poses
    names = [limb.body for limb in reference.tree]
    begin = dict(zip(names, rows[pose - 1], strict=True))
    mujoco.mj_forward(model, data)
    first = {name: turn_of(data, name) for name in (*names, "ground")}
    for k, row in enumerate(rows):
        for name, value in zip(names, row, strict=True):
            data.joint(name).qpos[0] = value - begin[name]
        mujoco.mj_forward(model, data)
        body = data.site("body").xpos
        wanted = best.error.places[k]
        assert body[:2] == pytest.approx(wanted.translation / 1000, abs=1e-9)
        assert np.abs(data.efc_pos[: data.nefc]).max() < 1e-9
        jacobian = data.efc_J.reshape(-1)[: data.nefc * model.nv].reshape(data.nefc, model.nv)
        motor = np.zeros(model.nv)
        motor[model.joint(reference.driver).dofadr[0]] = 1.0
        force = data.qfrc_bias - data.qfrc_passive
        for parent, child, rate, slack in loop_springs:
            turned = turn_of(data, child) - turn_of(data, parent)
            turned -= first[child] - first[parent]
            turned -= 2 * np.pi * np.round(turned / (2 * np.pi))
            moment = rate * (turned - slack)  # back on the child, and on its parent
            for name, sign in ((child, 1.0), (parent, -1.0)):
                rates = np.zeros((3, model.nv))
                mujoco.mj_jacBody(model, data, None, rates, model.body(name).id)
                force += sign * moment * rates[2]
        solved, *_ = np.linalg.lstsq(np.vstack([motor, jacobian]).T, force, rcond=None)
        size = max(np.abs(force).max(), float(told.gross[k]))
        assert solved[0] == pytest.approx(told.effort[k], abs=1e-6 * size)
    assert len(loop_springs) == (len(kept) > 0)
    text = path.read_text()
    assert "force 1" in text
    assert "the torque on the body" in text
    assert ("spring 1 (torsion)" in text) == (not kept)
