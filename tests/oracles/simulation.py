"""A witness that nobody here wrote: linkages as models of the simulator MuJoCo, driven by a motor.

The model is made of the dimensions of the dyads only: bodies with mass, hinges and slides.  The
driver carries the coupler; the follower is held to it by a constraint that the simulator solves.
A motor of limited force turns (or pushes) the driver from pose to pose.  No closing equation, no
dead point and no circuit is known here: where a linkage locks, the motor stalls.
"""

from dataclasses import dataclass

import mujoco
import numpy as np

from burmester.fourbar.dyad import PR, RP, RR

STEP = 1e-3  # seconds
SPEED = 1.5  # radians or lengths a second; the lengths are divided by the span of the poses
SETTLED = 1e-9  # speeds below which everything stands still
PATIENCE = 6000  # steps that it may take to come to rest
FORCE = 300.0  # of the motor
FRICTION = 5.0  # in every joint, of its speed: what stalls comes to rest
STALLED = 1e-3  # from where the motor was sent
MET = 1e-6  # from a pose

_HEAD = f"""
<mujoco>
  <compiler angle="radian"/>
  <option timestep="{STEP}" gravity="0 0 0" integrator="implicitfast" solver="Newton"
    iterations="100" tolerance="0"><flag contact="disable"/></option>
  <default>
    <joint damping="{FRICTION}"/>
    <equality solref="{2 * STEP} 1" solimp="0.9999 0.9999 1e-3 0.5 2"/>
  </default>
"""
_MASS = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """What came of driving a linkage through N poses, in spans of the poses and radians.

    missed: (N,), how far M was from each pose, with the motor where that pose has the driver;
        infinite after the motor has stalled.
    drive: (N,), where the motor came to stand; stalled: whether that is not where it was sent.
    torn: the worst gap in the loop during the whole run.
    path: (n, 3), where M was all the way, a few steps apart.
    """

    missed: np.ndarray
    drive: np.ndarray
    stalled: bool
    torn: float
    path: np.ndarray

    @property
    def meets(self):
        """Whether the coupler came to all poses."""
        return bool((self.missed < MET).all())


def _unit(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def _turn(vector):
    return np.array([-vector[1], vector[0]])


def _xyz(vector):
    return " ".join(repr(float(v)) for v in (*vector, 0.0))


def _spin(angle):
    return f"{float(np.cos(angle / 2))!r} 0 0 {float(np.sin(angle / 2))!r}"


def _ground_body(dyad, name, inside):
    """The body of a dyad that a joint holds to the ground, `inside` in it."""
    if isinstance(dyad, PR):
        n = _unit(dyad.normal_angle)
        at, joint = dyad.offset * n, f'type="slide" axis="{_xyz(_turn(n))}"'
    else:
        at, joint = dyad.fixed_pivot, 'type="hinge" axis="0 0 1"'
    return (
        f'<body name="{name}" pos="{_xyz(at)}"><joint name="{name}" {joint}/>{_MASS}{inside}</body>'
    )


def _carried_body(dyad, name, inside):
    """The body M as the ground body of a dyad carries it, by a hinge or by its slot."""
    if isinstance(dyad, RP):
        # The ground body's x axis is the normal of the slot.
        n = _unit(dyad.normal_angle)
        place = f'pos="{_xyz([-dyad.offset, 0])}" quat="{_spin(-dyad.normal_angle)}"'
        joint = f'type="slide" axis="{_xyz(_turn(n))}"'
    else:
        end = np.array([dyad.radius if isinstance(dyad, RR) else 0.0, 0.0])
        place = f'pos="{_xyz(end - dyad.moving_pivot)}"'
        joint = f'type="hinge" axis="0 0 1" pos="{_xyz(dyad.moving_pivot)}"'
    return f'<body name="{name}" {place}><joint name="{name}" {joint}/>{_MASS}{inside}</body>'


def model_of(linkage):
    """The model of a linkage driven by its first dyad."""
    first, second = linkage.first, linkage.second
    if isinstance(second, RP):
        # M once more, in the follower's slot, and welded to M.
        hold, at = "weld", np.zeros(2)
        held = _carried_body(second, "twin", '<site name="b"/>')
    else:
        hold, at = "connect", second.moving_pivot
        end = [second.radius if isinstance(second, RR) else 0.0, 0.0]
        held = f'<site name="b" pos="{_xyz(end)}"/>'
    coupler = _carried_body(first, "coupler", f'<site name="a" pos="{_xyz(at)}"/>')
    return mujoco.MjModel.from_xml_string(
        f"""{_HEAD}<worldbody>
        {_ground_body(first, "driver", coupler)}
        {_ground_body(second, "follower", held)}
        </worldbody>
        <equality><{hold} site1="a" site2="b"/></equality>
        <actuator><position joint="driver" kp="20000" kv="1500" forcerange="-{FORCE} {FORCE}"/>
        </actuator></mujoco>"""
    )


def coordinates(dyad, row):
    """The joints of a dyad, at the ground and at M, where M is at a row (x, y, angle)."""
    d, turn, angle = row[:2], np.exp(1j * row[2]), row[2]
    if isinstance(dyad, RP):
        inside = complex(*(dyad.fixed_pivot - d)) / turn
        along = (inside * np.exp(-1j * dyad.normal_angle)).imag
        return angle + dyad.normal_angle, -along
    pin = complex(*d) + complex(*dyad.moving_pivot) * turn
    if isinstance(dyad, RR):
        link = np.angle(pin - complex(*dyad.fixed_pivot))
        return link, angle - link
    return (pin * np.exp(-1j * dyad.normal_angle)).imag, angle


def drives(dyad, rows, sense):
    """Where the driver has to be at rows (N, 3), one after the other; a hinge turns in a sense."""
    at = np.array([coordinates(dyad, row)[0] for row in rows])
    if isinstance(dyad, PR):
        return at
    return at[0] + np.concatenate([[0], np.cumsum(sense * (sense * np.diff(at) % (2 * np.pi)))])


def driven_either_way(linkage, rows):
    """A `Run` through rows (N, 3), the motor turning one way or the other."""
    ways = [drives(linkage.first, rows, sense) for sense in (1, -1)]
    ways.sort(key=lambda way: np.abs(np.diff(way)).sum())
    run = driven(linkage, rows, ways[0])
    return run if run.meets or isinstance(linkage.first, PR) else driven(linkage, rows, ways[1])


def driven(linkage, rows, targets):
    """Drive a linkage, assembled at the first of rows (N, 3): a `Run`.

    targets: (N,), where to send the motor for each row, in the rows' unit of length.
    """
    unit = float(np.hypot(*np.ptp(rows[:, :2], axis=0)))
    rows, targets = rows / [unit, unit, 1], np.array(targets, dtype=float)
    first, second = _scaled(linkage.first, unit), _scaled(linkage.second, unit)
    if isinstance(first, PR):
        targets /= unit
    model = model_of(type(linkage)(first, second))
    data = mujoco.MjData(model)
    for names, dyad in ((("driver", "coupler"), first), (("follower", "twin"), second)):
        for name, value in zip(names, coordinates(dyad, rows[0]), strict=True):
            if (joint := mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)) >= 0:
                data.qpos[model.jnt_qposadr[joint]] = value
    mujoco.mj_forward(model, data)
    motor = model.joint("driver").qposadr[0]
    sent, stalled, torn, path = data.qpos[motor], False, 0.0, [_place(model, data)]
    missed, drive = np.full(len(rows), np.inf), np.full(len(rows), np.nan)
    for k, target in enumerate(targets):
        for to, steps in _ways(data, sent, target):
            data.ctrl[0] = to
            mujoco.mj_step(model, data, steps)
            torn = max(torn, float(np.abs(data.efc_pos[: data.nefc]).max()))
            path.append(_place(model, data))
        sent = target
        mujoco.mj_forward(model, data)
        away = _place(model, data) - rows[k]
        away[2] = np.angle(np.exp(1j * away[2]))
        missed[k], drive[k] = np.linalg.norm(away), data.qpos[motor]
        stalled = abs(drive[k] - target) > STALLED
        if stalled:
            break
    if isinstance(first, PR):
        drive *= unit
    return Run(missed, drive, stalled, torn, np.array(path) * [unit, unit, 1])


def _ways(data, start, end):
    """Where to send the motor, and for how many steps: a smooth way, then until all is at rest."""
    pieces = int(np.ceil(abs(end - start) / SPEED / STEP / 5)) + 40
    for share in (1 - np.cos(np.pi * np.arange(1, pieces + 1) / pieces)) / 2:
        yield start + share * (end - start), 5
    for _ in range(PATIENCE // 20):
        yield end, 20
        if np.abs(data.qvel).max() < SETTLED:
            return


def _place(model, data):
    """Where M is: x, y, angle."""
    body = model.body("coupler").id
    w, _, _, z = data.xquat[body]
    return np.array([*data.xpos[body][:2], 2 * np.arctan2(z, w)])


def _scaled(dyad, unit):
    values = ((name, getattr(dyad, name)) for name in type(dyad).__slots__)
    lengths = ("fixed_pivot", "moving_pivot", "radius", "offset")
    return type(dyad)(*(value / unit if name in lengths else value for name, value in values))


def steered(model, poses, size, exact, near):
    """A model with keyframes at poses, in mm: it is there in each, and its motor comes to the next.

    size: metres that its misses are shares of; exact: of a keyframe; near: where the motor rests.
    """
    data = mujoco.MjData(model)

    def missed(pose):
        body = data.site("body")
        away = np.abs(body.xpos[:2] - poses.translation[pose] / 1000).max() / size
        turn = body.xmat.reshape(3, 3)[:2, 0] @ [1, 1j]
        return max(away, abs(turn - np.exp(1j * poses.angle[pose])))

    count = len(poses.angle)
    for pose in range(count):
        mujoco.mj_resetDataKeyframe(model, data, pose)
        mujoco.mj_forward(model, data)
        assert missed(pose) < exact
        assert np.abs(data.efc_pos[: 3 * model.neq]).max() < exact * size
    mujoco.mj_resetDataKeyframe(model, data, 0)
    for pose in range(1, count):
        start, end = model.key_ctrl[pose - 1 : pose + 1, 0]
        for share in (1 - np.cos(np.pi * np.arange(1, 201) / 200)) / 2:
            data.ctrl[0] = start + share * (end - start)
            mujoco.mj_step(model, data)
            assert not data.ncon
        mujoco.mj_step(model, data, 1000)
        mujoco.mj_forward(model, data)
        assert missed(pose) < near
