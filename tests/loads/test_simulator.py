"""Loaded linkages in MuJoCo: the torque that holds them, and how they swing when let go."""

import numpy as np
import pytest

from burmester.loads.loaded_motion import LoadedLinkage
from burmester.loads.swing import swing
from burmester.tasks.loads import End, Loads, Mass, Spring
from tests.oracles.handed_over import rr
from tests.oracles.loaded_linkages import (
    KINDS,
    METRE,
    driven_at,
    loaded_linkage,
    masses_of,
    moved,
)

mujoco = pytest.importorskip("mujoco")


def linear_loads(rng, names, metre):
    """Weights, forces, and springs whose force is linear in their length all along."""
    links = ["ground", "body", *names]

    def ends():
        one, two = rng.choice(links, 2, replace=False)
        return tuple(End(str(each), tuple(rng.normal(size=2).tolist())) for each in (one, two))

    size = 10.0 / metre / 1000
    springs = [
        Spring("extension", ends(), {"rate_N_per_mm": size, "free_length": 0}, 2),
        Spring("gas", ends(), {"force_N": 8.0, "compressed_force_N": 12.0, "stroke": 7.0,
                               "length": 7.01}),
    ]  # fmt: skip
    return Loads(
        gravity=rng.normal(size=2) * 7,
        body=Mass(rng.uniform(0.1, 2), rng.normal(size=2), rng.uniform(0.1, 1) * metre**2),
        links={name: rng.uniform(0.1, 1) for name in names if rng.random() < 0.7},
        springs=tuple(springs),
        celsius=35.0,
    )


def xyz(at):
    return f"{at.real!r} {at.imag!r} 0".replace("np.float64(", "").replace(")", "")


def number(value):
    return repr(float(value))


def floating(model, loads, metre, turns):
    """Every body by itself in the plane; pins hold two holes together, rails keep a pin on them.

    turns: of the bodies, complex.  A pin in the slot of a link that moves slides on it.
    """
    weights, sites, tendons = masses_of(model, loads), {}, []
    for k, spring in enumerate(loads.springs):
        rate = 1000 * spring.count * spring["rate_N_per_mm"]
        free = spring["free_length"] * metre
        if spring.kind == "gas":
            hot = spring.count * (273.15 + loads.celsius) / 293.15
            way = spring["stroke"] * metre - 0.01
            rate = hot * (spring["compressed_force_N"] - spring["force_N"]) / way
            free = spring["length"] * metre - 0.005 + hot * spring["force_N"] / rate
        for n, end in enumerate(spring.ends):
            link = model.body if end.link == "body" else end.link
            at = xyz(complex(*end.point) * metre)
            sites.setdefault(link, []).append(f'<site name="s{k}{n}" pos="{at}"/>')
        tendons.append(
            f'<spatial stiffness="{number(rate)}" springlength="{number(free)}">'
            f'<site site="s{k}0"/><site site="s{k}1"/></spatial>'
        )
    rails = {pin: normal for link, pin, normal, _ in model.slots if link == "ground"}
    slots = {pin: (link, *way) for link, pin, *way in model.slots if link != "ground"}
    pins, bodies = [], dict.fromkeys(model.names, "")
    for one, other, hole, another, letter in model.pins:
        for link, at, side in ((one, hole, "a"), (other, another, "b")):
            sites.setdefault(link, []).append(
                f'<site name="{letter}{side}" pos="{xyz(at * metre)}"/>'
            )
        pins.append(f'<connect site1="{letter}a" site2="{letter}b"/>')
    for name in sorted(model.names, key=lambda name: name not in slots):  # what is on others first
        mass = sum(each[0] for each in weights[name])
        centre = sum(each[0] * each[1] for each in weights[name]) / mass if mass else 0j
        about = sum(m * abs(c - centre) ** 2 * metre**2 + i for m, c, i in weights[name])
        link, at, joints = None, "", (
            f'<joint type="slide" axis="{xyz(1j * rails[name])}" name="{name}"/>'
            if name in rails
            else '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>'
            f'<joint type="hinge" axis="0 0 1" name="{name}"/>'
        )  # fmt: skip
        if name in slots:
            link, normal, offset = slots[name]
            turn = turns[name] / turns[link]
            half = np.angle(turn) / 2
            at = f' pos="{xyz(offset * normal * metre)}" '
            at += f'quat="{number(np.cos(half))} 0 0 {number(np.sin(half))}"'
            joints = f'<joint type="slide" axis="{xyz(1j * normal / turn)}" name="{name}"/>'
        inertia = number(max(about, 1e-9 * metre**2))
        own = (
            f'<body name="{name}"{at}><inertial pos="{xyz(complex(centre) * metre)}" '
            f'mass="{number(max(mass, 1e-9))}" diaginertia="{inertia} {inertia} {inertia}"/>'
            f"{joints}{''.join(sites.get(name, ()))}{bodies[name]}</body>"
        )
        bodies[link or name] = own if link is None else bodies[link] + own
    bodies = [bodies[name] for name in model.names if name not in slots]
    gx, gy = map(float, loads.gravity)
    return mujoco.MjModel.from_xml_string(
        f"""<mujoco><compiler boundmass="0" boundinertia="0" balanceinertia="true"/>
        <option gravity="{gx!r} {gy!r} 0"><flag contact="disable"/></option>
        <worldbody>{"".join(sites.get("ground", ()))}{"".join(bodies)}</worldbody>
        <tendon>{"".join(tendons)}</tendon><equality>{"".join(pins)}</equality></mujoco>"""
    )


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("kind", KINDS)
def test_the_torque_that_holds_is_the_simulators(kind, seed):
    """Its weights and its springs are in balance with its pins and the motor."""
    model, linkage = loaded_linkage(kind, seed, linear_loads, unit="m")
    loaded = linkage.at(5)
    places = moved(model, loaded)(0.0)
    made = floating(model, linkage.loads, METRE["m"], {name: places[name][1][0] for name in places})
    data = mujoco.MjData(made)
    rails = {pin: (normal, offset) for link, pin, normal, offset in model.slots if link == "ground"}
    slots = {pin: (link, normal) for link, pin, normal, _ in model.slots if link != "ground"}
    for k in range(5):
        for name in model.names:
            at, turn = (each[k] for each in places[name])
            joint = made.joint(name)
            if name in rails:
                # The body hangs at the origin: it slides along, and the offset is its own.
                normal, offset = rails[name]
                foot = offset * normal
                made.body_pos[made.body(name).id][:2] = foot.real, foot.imag
                data.qpos[joint.qposadr[0]] = (np.conj(1j * normal) * at).real
            elif name in slots:
                link, normal = slots[name]
                on, turned = (each[k] for each in places[link])
                data.qpos[joint.qposadr[0]] = (np.conj(1j * normal * turned) * (at - on)).real
            else:
                last = joint.qposadr[0]
                data.qpos[last - 2 : last + 1] = at.real, at.imag, np.angle(turn)
        mujoco.mj_forward(made, data)
        assert np.abs(data.efc_pos[: data.nefc]).max() < 1e-9
        jacobian = data.efc_J.reshape(-1)[: data.nefc * made.nv].reshape(data.nefc, made.nv)
        motor = np.zeros(made.nv)
        turns = slots.get(model.motor[0], model.motor)[0]  # a pin in a slot turns with its link
        motor[made.joint(turns).dofadr[0]] = 1.0
        wanted = data.qfrc_bias - data.qfrc_passive
        solved, *_ = np.linalg.lstsq(np.vstack([motor, jacobian]).T, wanted, rcond=None)
        left = np.vstack([motor, jacobian]).T @ solved - wanted
        size = np.abs(wanted).max()
        assert np.abs(left).max() <= 1e-8 * size
        assert solved[0] == pytest.approx(loaded.effort[k], abs=1e-6 * size)


SWINGING = """
<mujoco><compiler angle="radian"/>
  <option timestep="{step}" gravity="0 -9.80665 0" integrator="RK4" solver="Newton"
    iterations="100" tolerance="0"><flag contact="disable"/></option>
  <default><equality solref="{stiff} 1" solimp="0.99999 0.99999 1e-3 0.5 2"/></default>
  <worldbody>
    <site name="g" pos="-0.05 0.2 0"/>
    <body name="driver"><joint name="driver" type="hinge" axis="0 0 1"/>
      <inertial pos="0.05 0 0" mass="0.5" diaginertia="1e-9 1e-9 1e-9"/>
      <body name="coupler" pos="0.1 0 0"><joint name="coupler" type="hinge" axis="0 0 1"/>
        <inertial pos="0.15 0.04 0" mass="2" diaginertia="0.03 0.03 0.03"/>
        <site name="m" pos="0.06 0.01 0"/><site name="c1" pos="0.28 0 0"/>
      </body>
    </body>
    <body name="follower" pos="0.3 0 0"><joint name="follower" type="hinge" axis="0 0 1"/>
      <inertial pos="0.1 0 0" mass="0.8" diaginertia="1e-9 1e-9 1e-9"/>
      <site name="c2" pos="0.2 0 0"/>
    </body>
  </worldbody>
  <tendon>
    <spatial stiffness="50" springlength="0"><site site="g"/><site site="m"/></spatial>
  </tendon>
  <equality><connect site1="c1" site2="c2"/></equality>
</mujoco>
"""


@pytest.mark.parametrize("start", [0.3, 0.6])
def test_a_swing_is_the_simulators(start):
    loads = Loads(
        body=Mass(2.0, [150, 40], 0.03),
        links={"driver": 0.5, "follower": 0.8},
        springs=(Spring("extension", (End("ground", (-50, 200)), End("body", (60, 10))),
                        {"rate_N_per_mm": 0.05, "free_length": 0}),),
    )  # fmt: skip
    dyads = rr([0, 0], [0, 0], 100), rr([300, 0], [280, 0], 200)
    linkage = LoadedLinkage.of(driven_at(dyads, np.radians([-150, -100, -60, 30]), loads))
    told = swing(linkage, start, 0.5, 51)
    assert len(told.time) > 25
    step = 2e-4
    model = mujoco.MjModel.from_xml_string(SWINGING.format(step=step, stiff=2 * step))
    data = mujoco.MjData(model)
    place = linkage.at_driver(told.share[:1]).places
    turns = [float(place[name].angle[0]) for name in ("driver", "coupler", "follower")]
    data.qpos[:] = turns[0], turns[1] - turns[0], turns[2]
    mujoco.mj_forward(model, data)
    assert np.abs(data.efc_pos[: data.nefc]).max() < 1e-12
    every = round(told.time[1] / step)
    seen = [turns[0]]
    for _ in told.time[1:]:
        mujoco.mj_step(model, data, every)
        seen.append(data.qpos[0])
    gap = np.angle(np.exp(1j * (np.array(seen) - told.drive)))
    assert np.abs(gap).max() < 1e-5
    assert np.abs(data.qvel[0] - told.speed[-1]) < 1e-3
