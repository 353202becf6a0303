"""Masses and inertias of plates and pins, against a grid of points, closed forms and OCC's solids.

And what a simulator makes of them: the force that holds, the speed of a fall, ends of travel.
"""

import math
from xml.etree import ElementTree

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.export import Options, export
from burmester.export.parts.plates import assembly_of
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles.handed_over import (
    GIVEN,
    NAMES,
    complex_places,
    joints,
    rp,
    rr,
    saved,
    scale_of,
    span_of,
    written,
)
from tests.oracles.heavy_links import Weights, weighed

mujoco = pytest.importorskip("mujoco")

LINKS = ("driver", "coupler", "follower")
GRAINS = 3e-3  # relative: what a grid of points misses
SIZES = Options(hole=4, width=9, thickness=3, gap=0.5)


def loaded(path):
    model = mujoco.MjModel.from_xml_path(str(path))
    return model, mujoco.MjData(model)


def in_frame(body):
    """The centre and the inertia of a body, in its own frame, as the simulator has them."""
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, body.iquat)
    turn = turn.reshape(3, 3)
    return body.ipos, turn @ np.diag(body.inertia) @ turn.T


@pytest.mark.parametrize("name", NAMES)
def test_bodies_weigh_what_a_grid_of_points_weighs(name, tmp_path):
    chosen, path = written(name, "mjcf", tmp_path)
    model, _ = loaded(path)
    weights = weighed(chosen, assembly_of(chosen, Options()))
    tiny = "boundinertia" in path.read_text()
    for link in LINKS:
        own, body = weights[link], model.body(link)
        assert body.mass[0] == pytest.approx(own.mass, rel=GRAINS)
        centre, inertia = in_frame(body)
        size = math.sqrt(np.abs(own.inertia).max() / own.mass)
        assert np.abs(centre - own.centre).max() <= GRAINS * size
        if not tiny:
            assert np.abs(inertia - own.inertia).max() <= GRAINS * np.abs(own.inertia).max()


def test_a_link_with_two_holes_has_its_closed_form(tmp_path):
    chosen = saved("crank-rocker, mm")
    (path,) = export(chosen, "mjcf", tmp_path / "a.xml", SIZES)
    body = loaded(path)[0].body("follower")
    length, width, hole, thick = 0.050, 0.009, 0.004, 0.003
    surface = 2700 * thick
    bar, disc, hollow = length * width, math.pi * width**2 / 4, math.pi * hole**2 / 4
    assert body.mass[0] == pytest.approx(surface * (bar + disc - 2 * hollow), rel=1e-12)
    r = width / 2
    # Two half discs, whose centres of mass are 4 r / 3 pi beyond the ends of the bar.
    off = 4 * r / (3 * math.pi)
    about_z = bar * (length**2 + width**2) / 12
    about_z += disc * (r**2 / 2 - off**2 + (length / 2 + off) ** 2)
    about_z -= 2 * hollow * (hole**2 / 8 + length**2 / 4)
    centre, inertia = in_frame(body)
    assert inertia[2, 2] == pytest.approx(surface * about_z, rel=1e-10)
    # It lies in the layer above the ground's.
    assert centre == pytest.approx([length / 2, 0, 0.0035 + 0.0015], abs=1e-12)


SOLID = ["crank-rocker, mm", "inverted slider-crank, ft", "slider drives, m"]


@pytest.mark.parametrize("name", SOLID)
def test_bodies_are_those_of_the_solids(name, tmp_path):
    """The parts that STEP has, as OCC weighs them, at the same pose in F."""
    cad = pytest.importorskip("build123d", reason="solids need build123d", exc_type=ImportError)
    options = Options(pose=3, density=7850)
    chosen, path = written(name, "step", tmp_path, options)
    solids = {each.label: each for each in cad.import_step(str(path)).children}
    at = joints(chosen, 2, scale_of(chosen))
    owners = {}
    for k, (link, dyad) in enumerate(
        zip(("driver", "follower"), (chosen.linkage.first, chosen.linkage.second), strict=True), 1
    ):
        if not isinstance(dyad, PR):
            owners[at[f"fixed{k}"]] = "ground" if isinstance(dyad, RR) else link
        if not isinstance(dyad, RP):
            owners[at[f"moving{k}"]] = "coupler" if isinstance(dyad, RR) else link
    parts = {link: [] for link in LINKS}
    for label, solid in solids.items():
        middle = solid.center(cad.CenterOf.MASS)
        owner = label
        if label.startswith("pin"):
            owner = owners[min(owners, key=lambda z: abs(z - complex(middle.X, middle.Y)))]
        if owner in parts:
            parts[owner].append((solid, np.array([*middle]) / 1000))
    model, data = loaded(written(name, "mjcf", tmp_path, options)[1])
    mujoco.mj_forward(model, data)
    for link, every in parts.items():
        masses = np.array([7850e-9 * solid.volume for solid, _ in every])
        centres = np.array([middle for _, middle in every])
        centre = masses @ centres / masses.sum()
        inertia = np.zeros((3, 3))
        for mass, (solid, middle) in zip(masses, every, strict=True):
            off = middle - centre
            inertia += 7850e-15 * np.array(solid.matrix_of_inertia)
            inertia += mass * (off @ off * np.eye(3) - np.outer(off, off))
        body = data.body(link)
        assert model.body(link).mass[0] == pytest.approx(masses.sum(), rel=1e-6)
        span = span_of(chosen, scale_of(chosen)) / 1000
        assert np.abs(body.xipos - centre).max() <= 1e-6 * span
        axes = body.ximat.reshape(3, 3)
        own = axes @ np.diag(model.body(link).inertia) @ axes.T
        assert np.abs(own - inertia).max() <= 1e-5 * np.abs(inertia).max()


@pytest.mark.parametrize("name", NAMES)
def test_urdf_is_possible_and_weighs_what_mjcf_weighs(name, tmp_path):
    _, path = written(name, "urdf", tmp_path, Options(pose=2))
    root = ElementTree.parse(path).getroot()
    links = {each.get("name"): each for each in root.findall("link")}
    children = [each.find("child").get("link") for each in root.findall("joint")]
    assert sorted(children) == sorted(set(links) - {"world"})  # a tree
    model, data = loaded(written(name, "mjcf", tmp_path, Options(pose=2))[1])
    mujoco.mj_forward(model, data)
    tiny = 'boundinertia="1e-14"'
    keep = f'<mujoco><compiler fusestatic="false" {tiny}/></mujoco></robot>'
    other = mujoco.MjModel.from_xml_string(path.read_text().replace("</robot>", keep))
    there = mujoco.MjData(other)
    mujoco.mj_forward(other, there)
    stands = there.body("ground").xmat.reshape(3, 3)
    heavy = [link for link, each in links.items() if each.find("inertial") is not None]
    assert sorted(heavy) == sorted(["ground", *LINKS])
    for link in heavy:
        inertial = links[link].find("inertial")
        mass = float(inertial.find("mass").get("value"))
        six = {key: float(value) for key, value in inertial.find("inertia").attrib.items()}
        matrix = np.array([[six["i" + min(a, b) + max(a, b)] for a in "xyz"] for b in "xyz"])
        small, middle, large = np.linalg.eigvalsh(matrix)
        assert mass > 0
        assert small > 0
        assert small + middle >= large * (1 - 1e-12)
        if link in LINKS:
            assert mass == pytest.approx(model.body(link).mass[0], rel=1e-12)
            one, two = data.body(link), there.body(link)
            assert stands.T @ two.xipos == pytest.approx(one.xipos, abs=1e-9 * model.stat.extent)
            here, own = (
                turn @ np.diag(each.body(link).inertia) @ turn.T
                for turn, each in (
                    (one.ximat.reshape(3, 3), model),
                    (stands.T @ two.ximat.reshape(3, 3), other),
                )
            )
            assert np.abs(own - here).max() <= 1e-6 * np.abs(here).max() + 1e-14
    for joint in root.findall("joint"):
        limit = joint.find("limit")
        if joint.get("type") != "fixed":
            assert float(limit.get("lower")) < 0 < float(limit.get("upper"))
            assert float(limit.get("effort")) > 0
            assert float(limit.get("velocity")) > 0


def test_density_and_unit(tmp_path):
    def mass(options, name="slider-crank, no unit"):
        (path,) = export(saved(name), "mjcf", tmp_path / "a.xml", options, force=True)
        return loaded(path)[0].body("coupler").mass[0], path.read_text()

    light, text = mass(Options())
    assert "2700 kg/m³ (aluminium)" in text
    assert "one of its units is taken for 1 mm" in text
    heavy, text = mass(Options(density=7850))
    assert heavy == pytest.approx(light * 7850 / 2700, rel=1e-9)
    assert "7850 kg/m³ (steel)" in text
    # A thousand times the volume, but for the sizes of plates, which are chosen to two digits.
    large, text = mass(Options(unit="cm", hole=0.1, width=0.26, thickness=0.1, gap=0.01))
    small, _ = mass(Options(unit="mm", hole=0.1, width=0.26, thickness=0.1, gap=0.01))
    assert large == pytest.approx(1000 * small, rel=1e-9)
    for wrong in (2.7, 0, -1, math.nan, math.inf, 1e300):
        with pytest.raises(InputError, match="no material") as caught:
            mass(Options(density=wrong))
        assert caught.value.code == "E162"
        assert "--density 2700" in caught.value.help


UP = {"x": 1, "y": 1j, "-x": -1, "-y": -1j, "z": 0}


@pytest.mark.parametrize("up", [*UP, "-z"])
def test_what_is_up(up, tmp_path):
    chosen, path = written("crank-rocker, mm", "mjcf", tmp_path, Options(up=up))
    model, _ = loaded(path)
    sign = -1 if up.startswith("-") else 1
    wanted = -9.80665 * sign * np.eye(3)["xyz".index(up[-1])]
    assert model.opt.gravity == pytest.approx(wanted, abs=1e-12)
    _, path = written("crank-rocker, mm", "urdf", tmp_path, Options(up=up))
    root = ElementTree.parse(path).getroot()
    (stands,) = (each for each in root.findall("joint") if each.get("name") == "ground")
    roll, pitch, yaw = map(float, stands.find("origin").get("rpy").split())
    assert yaw == 0
    c, s, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    turn = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]) @ [[1, 0, 0], [0, c, -s], [0, s, c]]
    assert turn @ (-wanted) == pytest.approx([0, 0, 9.80665], abs=1e-12)
    with pytest.raises(InputError, match="no direction") as caught:
        export(chosen, "urdf", tmp_path / "no.urdf", Options(up=up + "y"))
    assert caught.value.code == "E162"


@pytest.mark.parametrize(
    ("name", "up"), [*((each, "y") for each in NAMES), ("double-crank, cm", "-x")]
)
def test_the_motor_holds_what_virtual_work_tells(name, up, tmp_path):
    """Its force at rest is the slope of the potential energy over the driver's coordinate."""
    chosen, path = written(name, "mjcf", tmp_path, Options(up=up))
    model, data = loaded(path)
    bodies = weighed(chosen, assembly_of(chosen, Options()))
    weights = Weights(chosen, bodies, scale_of(chosen) / 1000, UP[up])
    loads = [weights.along(weights.drive_at(k), (weights.d[k], weights.turn[k])) for k in range(6)]
    inertia = np.median([each for _, each in loads])
    assert model.joint("driver").armature[0] == pytest.approx(0.01 * inertia, rel=2 * GRAINS)
    forces, wanted = [], []
    for k in (0, 2, 5):
        mujoco.mj_resetDataKeyframe(model, data, k)
        mujoco.mj_step(model, data, 1000)
        assert np.abs(data.qvel).max() < 1e-6
        forces.append(data.actuator_force[0])
        wanted.append(loads[k][0])
    forces, wanted = np.array(forces), np.array(wanted)
    assert np.abs(forces - wanted).max() <= GRAINS * np.abs(wanted).max()


FALLING = [n for n in NAMES if "um" not in n and "no unit" not in n]


@pytest.mark.parametrize("name", FALLING)
def test_a_fall_has_the_speed_that_energy_gives(name, tmp_path):
    """From rest, without motor, damping and limits: half the reduced inertia times speed²."""
    chosen, path = written(name, "mjcf", tmp_path)
    model, data = loaded(path)
    model.dof_damping[:] = 0
    model.dof_armature[:] = 0
    model.jnt_limited[:] = 0
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    bodies = weighed(chosen, assembly_of(chosen, Options()))
    weights = Weights(chosen, bodies, scale_of(chosen) / 1000)
    mujoco.mj_resetDataKeyframe(model, data, 2)
    mujoco.mj_forward(model, data)
    total, joint = data.energy.sum(), data.joint("driver")
    near = weights.d[2], weights.turn[2]
    start = weights.energy(near)
    lost, seen = [], 0
    low, high = model.joint("driver").range
    for _ in range(40):
        mujoco.mj_step(model, data, 5)
        mujoco.mj_forward(model, data)
        if not low < joint.qpos[0] < high:
            break
        lost.append(abs(data.energy.sum() - total))
        near = weights.place(joint.qpos[0], near)
        _, inertia = weights.along(joint.qpos[0], near)
        fallen = start - weights.energy(near)
        own = inertia * joint.qvel[0] ** 2 / 2
        seen = max(seen, fallen)
        assert own == pytest.approx(fallen, abs=2 * GRAINS * seen + 1e-9 * abs(start))
    assert len(lost) >= 10
    assert max(lost) <= GRAINS * seen


@pytest.mark.parametrize("name", NAMES)
def test_limits_are_the_range_used(name, tmp_path):
    """The joints between the first pose and the last, followed in small steps by differences."""
    chosen, path = written(name, "mjcf", tmp_path)
    model, _ = loaded(path)
    made = assembly_of(chosen, Options())
    parameter = np.linspace(*GIVEN[name][3], 2001)
    places = Circuits.of(chosen.linkage)[0].couplers(parameter)
    turn = np.exp(1j * places.angle)
    d = places.translation @ [1, 1j]
    q, relative = {}, turn
    for link, dyad in zip(
        ("driver", "follower"), (chosen.linkage.first, chosen.linkage.second), strict=True
    ):
        if isinstance(dyad, RR):
            arm = d + turn * complex(*dyad.moving_pivot) - complex(*dyad.fixed_pivot)
            q[link] = np.unwrap(np.angle(arm))
            relative = turn * arm.conj() if link == "driver" else relative
        elif isinstance(dyad, PR):
            pin = d + turn * complex(*dyad.moving_pivot)
            q[link] = (pin * np.exp(-1j * dyad.normal_angle)).imag
        else:
            slot = (complex(*dyad.fixed_pivot) - d) / turn * np.exp(-1j * dyad.normal_angle)
            if link == "driver":
                q["driver"], q["coupler"] = np.unwrap(places.angle + dyad.normal_angle), -slot.imag
            else:
                q[link] = slot.imag
    q.setdefault("coupler", np.unwrap(np.angle(relative)))
    for link, values in q.items():
        joint, low, high = model.joint(link), values.min(), values.max()
        if joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE:
            low, high = (each * scale_of(chosen) / 1000 for each in (low, high))
            more = made.dimensions.hole / 2000
            near = 1e-4 * more
        else:
            more, near = math.radians(5), 1e-5
        told = joint.range
        assert told[1] - told[0] == pytest.approx(high - low + 2 * more, abs=near)
        gap = told[0] - (low - more)
        turns = 0 if joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE else 2 * math.pi
        gap -= turns and turns * round(gap / turns)
        assert abs(gap) <= near
        for key in model.key_qpos:
            assert told[0] < key[joint.qposadr[0]] < told[1]


def test_a_joint_stops_at_its_limit(tmp_path):
    _, path = written("crank-rocker, mm", "mjcf", tmp_path)
    model, data = loaded(path)
    mujoco.mj_resetDataKeyframe(model, data, 5)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    data.qfrc_applied[0] = 5 * abs(model.body("coupler").mass[0] * 9.81 * 0.02)
    mujoco.mj_step(model, data, 3000)
    beyond = np.maximum(data.qpos - model.jnt_range[:, 1], model.jnt_range[:, 0] - data.qpos)
    assert abs(beyond.max()) <= math.radians(0.2)  # of the one that comes to its end first


@pytest.mark.parametrize("name", NAMES)
def test_plates_on_each_other_without_a_gap_do_not_collide(name, tmp_path):
    _, path = written(name, "mjcf", tmp_path, Options(gap=0.0))
    model, data = loaded(path)
    for k in range(6):
        mujoco.mj_resetDataKeyframe(model, data, k)
        mujoco.mj_forward(model, data)
        assert data.ncon == 0


def test_links_that_meet_collide(tmp_path):
    _, path = written("crank-rocker, mm", "mjcf", tmp_path)
    model, data = loaded(path)
    # The crank laid over the rocker: both lie in the layer above the ground.
    data.joint("driver").qpos[0] = 0.1
    data.joint("follower").qpos[0] = 0.1 + math.pi
    mujoco.mj_forward(model, data)
    met = {
        frozenset(model.body(int(model.geom_bodyid[g])).name for g in data.contact[k].geom)
        for k in range(data.ncon)
    }
    assert frozenset({"driver", "follower"}) in met


@pytest.mark.parametrize("to", ["mjcf", "urdf", "sdf"])
def test_what_plates_cannot_hold_has_no_model(to, tmp_path):
    """Two slots that cross where the pins meet: there is no plate to weigh."""
    chosen = saved("", given=(rp([0, 0], 90, 0), rp([50, 0], 0, -30), "mm", (-0.3, 2.9)))
    with pytest.raises(InputError, match="plates with pins") as caught:
        export(chosen, to, tmp_path / "a.file")
    assert caught.value.code == "E163"
    assert not list(tmp_path.iterdir())


def test_poses_that_no_motion_joins(tmp_path):
    """Poses on two circuits: a model all the same, whose limits hold every key frame."""
    dyads = (rr([0, 0], [5, -8], 20), rr([70, 10], [65, 10], 50))
    chosen = saved("", given=(*dyads, "mm", (0.4, 3.2)))
    other = saved("", given=(*dyads, "mm", (0.4, 3.2)))
    circuits = Circuits.of(chosen.linkage)
    places = circuits[1].couplers(np.linspace(0.5, 2, 3))
    for array, values in (
        (other.error.places.translation, places.translation),
        (other.error.places.angle, places.angle),
    ):
        array.flags.writeable = True
        array[3:] = values
    (path,) = export(other, "mjcf", tmp_path / "a.xml")
    model, _ = loaded(path)
    assert "no one motion goes through all of them" in path.read_text()
    for k in range(6):
        for joint in range(3):
            low, high = model.jnt_range[joint]
            assert low < model.key_qpos[k, joint] < high
    d, _ = complex_places(other, 1e-3)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 5)
    mujoco.mj_forward(model, data)
    assert abs(complex(*data.site("body").xpos[:2]) - d[5]) < 1e-9
