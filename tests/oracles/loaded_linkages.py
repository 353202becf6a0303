"""Linkages of every kind under random loads, and what forces and energies they must have.

Four-bars are placed by the witness, joint by joint in complex numbers; the joints of six-bars are
their own.  Links are bodies as files name them: turns and origins, pins with a hole in each of two
bodies, slots with a normal.  Forces come from one dense system of all free bodies, rates from
differences of places.  No loop equation is differentiated here.
"""

from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.loads.loaded_motion import LoadedLinkage
from burmester.mechanisms.branches import branches_of
from burmester.mechanisms.circuits import circuits_of
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.watt import WattLinkage
from burmester.tasks.loads import End, Force, Loads, Mass, Spring
from burmester.tasks.motion_task import Task
from tests.oracles import witness
from tests.oracles.handed_over import found
from tests.oracles.random_dyads import PAIRS, random_dyad
from tests.oracles.stephenson import drawn
from tests.stephenson.made import FIRST, SECOND, THIRD
from tests.stephenson.made import linkage as stephenson

METRE = {"um": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
STEP = 2e-3  # of the driver's way, of differences
WATT = "Watt I six-bar"
SIX_BARS = [WATT, FIRST, SECOND, THIRD]
KINDS = [f"{a.__name__}-{b.__name__}" for a, b in PAIRS] + SIX_BARS


def turned_by(angle):
    return np.exp(1j * np.asarray(angle))


# --- linkages


def sound_run(values):
    """The longest run of finite values (n,): where it begins, and where it ends."""
    good = np.concatenate([[False], np.isfinite(values), [False]])
    edges = np.flatnonzero(good[1:] != good[:-1])
    runs = edges.reshape(-1, 2)
    first, end = max(runs, key=lambda run: run[1] - run[0], default=(0, 0))
    return int(first), int(end)


def dyad_places(dyads, drive):
    """Places (2, n) of the coupler: x + iy and angle, at what the first dyad's body has moved."""
    first, second = dyads
    if isinstance(first, RP):
        phi = drive - float(first.normal_angle)
        where = witness.turned(first, second, phi)
        return where, np.broadcast_to(phi, where.shape)
    return witness.places(first, second, drive)


def four_bar(pair, rng, poses=5, unit="mm", loads=None):
    """A linkage that goes through poses far from its dead points, or None: try again."""
    dyads = [random_dyad(kind, rng) for kind in pair]
    whole = 3.0 if isinstance(dyads[0], PR) else np.pi
    sweep = np.linspace(-whole, whole, 721) + rng.uniform(-1, 1)
    where, phi = dyad_places(dyads, sweep)
    side = int(rng.integers(2))
    turn = np.unwrap(phi[side]) if np.isfinite(phi[side]).all() else phi[side]
    rate = np.hypot(np.abs(np.gradient(where[side], sweep)), np.gradient(turn, sweep))
    first, end = sound_run(np.where(rate < 4.0, rate, np.nan))
    if end - first < 60:
        return None
    low, high = np.sort(rng.uniform(sweep[first], sweep[end - 1], 2))
    if high - low < 0.3:
        return None
    drives = np.linspace(low, high, poses)[:: int(rng.choice([1, -1]))]
    where, phi = dyad_places(dyads, drives)
    rows = np.column_stack([where[side].real, where[side].imag, np.unwrap(phi[side])])
    if abs(rows[:, :2]).max() > 20:
        return None
    task = Task(Displacement.from_poses(rows), length_unit=unit, loads=loads)
    return found(Linkage(*dyads), task, PoseError.at(task.poses, task.poses))


def random_watt(rng):
    def at():
        return rng.normal(size=2)

    def length():
        return np.float64(rng.uniform(0.4, 2.0))

    return WattLinkage(
        fixed_first=at(),
        fixed_second=at(),
        first_crank=length(),
        second_crank=length(),
        coupler_arm=length(),
        coupler_joint=at(),
        crank_joint=at(),
        floating_link=length(),
        body_joint=at(),
        link_joint=at(),
    )


def six_bar(name, rng, poses=5, unit="mm", loads=None):
    """A six-bar of a class on one branch of one driver, or None: try again."""
    made = random_watt(rng) if name == WATT else stephenson(drawn(rng), name)
    circuits = circuits_of(made)
    if not len(circuits.first):
        return None
    every = [each for pivot in made.skeleton.drivers
             for each in branches_of(made, circuits, pivot)]  # fmt: skip
    if not every:
        return None
    branch = every[int(rng.integers(len(every)))]
    low, high = float(branch.drives.min()), float(branch.drives.max())
    margin = 0.2 * (high - low)
    low, high = np.sort(rng.uniform(low + margin, high - margin, 2))
    if not 0.2 < high - low < 6:
        return None
    drives = np.linspace(low, high, poses)[:: int(rng.choice([1, -1]))]
    room = np.array([drives.min() - branch.drives.min(), branch.drives.max() - drives.max()])
    places = Displacement(np.zeros((poses, 2)), np.arange(poses) + 0.0)
    shell = FoundSixBar(
        id="S1", task=Task(places), error=PoseError.at(places, places), linkage=made, branch=branch,
        drive=drives, room=room, transmission=1.0, extent=1.0, chain=0,
    )  # fmt: skip
    body = shell.body(np.linspace(drives[0], drives[-1], 60))
    if not np.isfinite(body.angle).all():
        return None
    speed = np.hypot(*np.gradient(body.translation, axis=0).T) + np.abs(
        np.gradient(np.unwrap(body.angle))
    )
    if speed.max() * 59 / (high - low) > 6 or abs(body.translation).max() > 20:
        return None
    there = shell.body(drives)
    there = Displacement(there.translation, np.unwrap(there.angle))
    task = Task(there, length_unit=unit, loads=loads)
    return replace(shell, task=task, error=PoseError.at(there, there))


def linkage_of(kind, rng, loads, unit="mm"):
    """A linkage of a kind under loads (a function of the generator and the names of links)."""
    made = None
    while made is None:
        bare = (
            six_bar(kind, rng, unit=unit)
            if kind in SIX_BARS
            else four_bar(PAIRS[KINDS.index(kind)], rng, unit=unit)
        )
        if bare is not None:
            drawn_loads = loads(rng, Model.of(bare).names, METRE[unit])
            with suppress(InputError):  # E179: a spring does not fit at the first pose
                made = replace(bare, task=replace(bare.task, loads=drawn_loads))
    return made


# --- bodies


@dataclass(frozen=True)
class Model:
    """A linkage as free bodies, in the task's unit.

    pins: of two bodies each, with holes in both.  slots: of a link with a normal and an offset, on
    whose line a body stands that is a pin, turned by an angle against the link.
    motor: the body that drives, and the link on whose slot it slides, or None.
    """

    chosen: object
    body: str
    names: tuple
    pins: tuple
    slots: tuple
    motor: tuple
    middles: dict  # of the holes of each body

    @classmethod
    def of(cls, chosen):
        return _six_bar_model(chosen) if hasattr(chosen, "skeleton") else _four_bar_model(chosen)

    def at(self, drive, near=None):
        """Origins and turns of the bodies at drives (n,): {name: (complex, complex)}.

        near: origins and turns of M (2, n), between whose ways to close the nearer one counts.
        """
        if hasattr(self.chosen, "skeleton"):
            out = {"ground": (0j * drive, 0j * drive + 1)}
            for link, place in self.chosen.links(drive).items():
                if (name := _plate(link)) != "ground":
                    out[name] = place.translation @ [1, 1j], turned_by(place.angle)
            return out
        dyads = self.chosen.linkage.first, self.chosen.linkage.second
        where, phi = dyad_places(dyads, drive)
        gap = np.abs(where - near[0]) + np.abs(turned_by(phi) - near[1])
        side = np.nanargmin(gap, axis=0)
        d, phi = np.take_along_axis(where, side[None], 0)[0], np.take_along_axis(phi, side[None], 0)
        turn = turned_by(phi[0])
        return {"ground": (0j * d, 0j * d + 1), "coupler": (d, turn)} | {
            name: _on_dyad(dyad, d, turn, name)
            for name, dyad in zip(("driver", "follower"), dyads, strict=True)
        }


def _plate(link):
    return "body-link" if link == "body" else link.replace(" ", "-")


def _on_dyad(dyad, d, turn, name):
    if isinstance(dyad, RP):
        own = turned_by(float(dyad.normal_angle)) if name == "driver" else 1
        return complex(*dyad.fixed_pivot) + 0 * d, turn * own
    at = d + turn * complex(*dyad.moving_pivot)
    if isinstance(dyad, PR):
        return at, 1 + 0 * turn
    arm = at - complex(*dyad.fixed_pivot)
    return complex(*dyad.fixed_pivot) + 0 * d, arm / abs(arm)


def _four_bar_model(chosen):
    pins, slots, middles, motor = [], [], {"coupler": []}, None
    for name, dyad in zip(
        ("driver", "follower"), (chosen.linkage.first, chosen.linkage.second), strict=True
    ):
        slide = None
        if isinstance(dyad, RR):
            tip, m = float(dyad.radius), complex(*dyad.moving_pivot)
            pins += [
                ("ground", name, complex(*dyad.fixed_pivot), 0j, "AD"[name != "driver"]),
                ("coupler", name, m, tip + 0j, "BC"[name != "driver"]),
            ]
            middles[name] = [0j, tip + 0j]
            middles["coupler"].append(m)
        else:
            normal, offset = turned_by(float(dyad.normal_angle)), float(dyad.offset)
            middles[name] = [0j]
            if isinstance(dyad, PR):
                m = complex(*dyad.moving_pivot)
                pins.append(("coupler", name, m, 0j, "BC"[name != "driver"]))
                slots.append(("ground", name, normal, offset))
                middles["coupler"].append(m)
                slide = ("ground", normal)
            else:
                pins.append(
                    ("ground", name, complex(*dyad.fixed_pivot), 0j, "AD"[name != "driver"])
                )
                slots.append(("coupler", name, normal, offset))
        if name == "driver":
            motor = (name, slide)
    means = {name: np.mean(holes) if holes else 0j for name, holes in middles.items()}
    names = ("driver", "coupler", "follower")
    return Model(chosen, "coupler", names, tuple(pins), tuple(slots), motor, means)


def _six_bar_model(chosen):
    skeleton, frames = chosen.skeleton, chosen.frames
    pins = []
    for joint in skeleton.joints:
        one, other = skeleton.links_of(joint)
        holes = (complex(*frames[link][joint]) for link in (one, other))
        pins.append((_plate(one), _plate(other), *holes, joint))
    means = {
        _plate(link): np.mean([complex(*at) for at in frames[link].values()])
        for link in skeleton.moving
    }
    driver = next(link for link in skeleton.moving if chosen.driver_pivot in skeleton.links[link])
    names = tuple(map(_plate, skeleton.moving))
    return Model(
        chosen, _plate(chosen.carries), names, tuple(pins), (), (_plate(driver), None), means
    )


# --- loads


def random_loads(rng, names, metre):
    """Some of everything; lengths of a linkage are near one of the task's units."""
    links = ["ground", "body", *names]

    def end():
        return End(str(rng.choice(links)), tuple(rng.normal(size=2).tolist()))

    def ends():
        one, two = end(), end()
        return (one, two) if one.link != two.link else ends()

    size = 10.0 / metre / 1000  # N/mm, so that about 10 N pull where something is a unit long
    springs = []
    for kind in rng.permutation(["extension", "zero", "compression", "gas", "constant", "torsion",
                                 "counterweight"])[: rng.integers(0, 5)]:  # fmt: skip
        count = int(rng.integers(1, 4))
        numbers = {
            "zero": {"rate_N_per_mm": size, "free_length": 0},
            "extension": {"rate_N_per_mm": size, "free_length": rng.uniform(0.1, 2),
                          "initial_N": rng.uniform(0, 3)},
            "compression": {"rate_N_per_mm": size, "free_length": rng.uniform(0.5, 4)},
            "gas": {"force_N": rng.uniform(5, 10), "compressed_force_N": rng.uniform(8, 20),
                    "stroke": 6.0, "length": 6.05, "friction_N": 1.0},
            "constant": {"force_N": rng.uniform(1, 10)},
            "torsion": {"rate_Nm_per_deg": 0.1 * metre, "free_deg": rng.uniform(-200, 200)},
            "counterweight": {"mass_kg": rng.uniform(0, 2)},
        }[kind]  # fmt: skip
        named = "extension" if kind == "zero" else str(kind)
        springs.append(Spring(named, ends(), numbers, count))
    forces = tuple(
        Force(rng.normal(size=2), rng.normal(size=2) * 10, str(rng.choice(["F", "M"])))
        for _ in range(rng.integers(0, 3))
    )
    heavy = [name for name in names if rng.random() < 0.6]
    return Loads(
        gravity=rng.normal(size=2) * 7,
        body=Mass(rng.uniform(0.1, 2), rng.normal(size=2), rng.uniform(0, 1) * metre**2),
        links={name: rng.uniform(0.1, 1) for name in heavy},
        forces=forces,
        torque=float(rng.normal()) * metre,
        springs=tuple(springs),
        celsius=float(rng.uniform(-20, 60)),
    )


def masses_of(model, loads):
    """(mass, centre in the body's frame, inertia about it) in kg and the task's unit; a list."""
    out = {name: [] for name in model.names}
    if loads.body is not None:
        out[model.body].append((loads.body.mass_kg, complex(*loads.body.center),
                                loads.body.inertia_kgm2 or 0.0))  # fmt: skip
    for name, mass in loads.links.items():
        out[model.body if name == "body" else name].append((mass, model.middles[name], 0.0))
    for spring in loads.springs:
        if spring.kind == "counterweight":
            link = model.body if spring.ends[1].link == "body" else spring.ends[1].link
            if link != "ground":
                at = complex(*spring.ends[1].point)
                out[link].append((spring.count * spring["mass_kg"], at, 0.0))
    return out


def pull_of(spring, length, metre, celsius):
    """The pull of a straight spring at a length in metres, and its energy."""
    many = spring.count
    if spring.kind == "constant":
        return many * spring["force_N"] + 0 * length, many * spring["force_N"] * length
    if spring.kind == "gas":
        hot = many * (273.15 + celsius) / 293.15
        first, last = hot * spring["force_N"], hot * spring["compressed_force_N"]
        way = max(spring["stroke"] * metre - 0.01, spring["stroke"] * metre / 10)
        pushed_in = spring["length"] * metre - 0.005 - length
        push = first + (last - first) * pushed_in / way
        return -push, first * pushed_in + (last - first) * pushed_in**2 / way / 2
    rate, free = 1000 * many * spring["rate_N_per_mm"], spring["free_length"] * metre
    longer = length - free
    if spring.kind == "compression":
        longer = np.minimum(longer, 0)
        return rate * longer, rate * longer**2 / 2
    initial = many * spring["initial_N"]
    if spring["free_length"] > 0:
        longer = np.maximum(longer, -initial / rate)
    return initial + rate * longer, initial * longer + rate * longer**2 / 2


def around(angle, free):
    """An angle (n,) without jumps, whose first value is within half a turn of another one."""
    angle = np.unwrap(angle)
    return angle - 2 * np.pi * np.round((angle[0] - free) / (2 * np.pi))


def wrenches(model, places, loads, metre):
    """What acts on each body: (force, point, moment) in N, m and N m; places in metres."""
    out = {name: [] for name in ("ground", *model.names)}
    g = complex(*loads.gravity)
    for name, parts in masses_of(model, loads).items():
        at, turn = places[name]
        for mass, centre, _ in parts:
            out[name].append((mass * g, at + turn * centre * metre, 0.0))
    at, turn = places[model.body]
    for force in loads.forces:
        own = complex(*force.force) * (turn if force.frame == "M" else 1)
        out[model.body].append((own, at + turn * complex(*force.at) * metre, 0.0))
    out[model.body].append((0.0, at, loads.torque))
    for spring in loads.springs:
        links = [model.body if end.link == "body" else end.link for end in spring.ends]
        if spring.kind == "counterweight":
            continue
        if spring.kind == "torsion":
            free = np.radians(spring["free_deg"])
            angle = around(np.angle(places[links[1]][1] / places[links[0]][1]), free)
            moment = spring.count * spring["rate_Nm_per_deg"] * np.degrees(angle - free)
            for link, sign in zip(links, (1, -1), strict=True):
                out[link].append((0.0, places[link][0], sign * moment))
            continue
        ends = [places[link][0] + places[link][1] * complex(*end.point) * metre
                for link, end in zip(links, spring.ends, strict=True)]  # fmt: skip
        pull, _ = pull_of(spring, abs(ends[1] - ends[0]), metre, loads.celsius)
        way = (ends[1] - ends[0]) / abs(ends[1] - ends[0])
        out[links[0]].append((pull * way, ends[0], 0.0))
        out[links[1]].append((-pull * way, ends[1], 0.0))
    return out


def potential(model, places, loads, metre):
    """Of weights, forces whose direction stays, the torque and springs; places in metres."""
    total = 0.0
    for name, acting in wrenches(model, places, replace(loads, springs=(), torque=0.0),
                                 metre).items():  # fmt: skip
        del name
        for force, at, _ in acting:
            total = total - (np.conj(force) * at).real
    total = total - loads.torque * np.unwrap(np.angle(places[model.body][1]))
    for spring in loads.springs:
        links = [model.body if end.link == "body" else end.link for end in spring.ends]
        if spring.kind == "counterweight":
            if links[1] != "ground":
                at, turn = places[links[1]]
                at = at + turn * complex(*spring.ends[1].point) * metre
                weight = spring.count * spring["mass_kg"] * complex(*loads.gravity)
                total = total - (np.conj(weight) * at).real
        elif spring.kind == "torsion":
            free = np.radians(spring["free_deg"])
            angle = around(np.angle(places[links[1]][1] / places[links[0]][1]), free)
            stiff = spring.count * np.degrees(spring["rate_Nm_per_deg"])
            total = total + stiff * (angle - free) ** 2 / 2
        else:
            ends = [places[link][0] + places[link][1] * complex(*end.point) * metre
                    for link, end in zip(links, spring.ends, strict=True)]  # fmt: skip
            total = total + pull_of(spring, abs(ends[1] - ends[0]), metre, loads.celsius)[1]
    return total


def in_metres(places, metre):
    return {name: (at * metre, turn) for name, (at, turn) in places.items()}


# --- forces


def balanced(model, places, acting, metre):
    """Effort (n,), and the force (n,) of each pin on its first body by its letter.

    Unknown are two forces of each pin, the force and the moment of each slot, and the motor's.
    acting: as of `wrenches`, with what masses resist as further forces.
    """
    (count,) = np.shape(places[model.body][0])
    rows = {name: 3 * k for k, name in enumerate(model.names)}
    size = 3 * len(model.names)
    assert size == 2 * len(model.pins) + 2 * len(model.slots) + 1
    matrix, right = np.zeros((count, size, size)), np.zeros((count, size))

    def exert(column, body, force, at, moment=0.0):
        if body == "ground":
            return
        k = rows[body]
        matrix[:, k, column] += np.real(force)
        matrix[:, k + 1, column] += np.imag(force)
        matrix[:, k + 2, column] += (np.conj(at) * force).imag + moment

    column = 0
    for one, other, hole, _, _ in model.pins:
        at = places[one][0] + places[one][1] * hole * metre
        for unit in (1, 1j):
            exert(column, one, unit, at)
            exert(column, other, -unit, at)
            column += 1
    for link, pin, normal, _ in model.slots:
        way, at = places[link][1] * normal, places[pin][0]
        exert(column, link, way, at)
        exert(column, pin, -way, at)
        exert(column + 1, link, 0.0, at, 1.0)
        exert(column + 1, pin, 0.0, at, -1.0)
        column += 2
    body, slide = model.motor
    if slide is None:
        exert(column, body, 0.0, places[body][0], 1.0)
    else:
        exert(column, body, 1j * slide[1], places[body][0])
    for name, own in acting.items():
        if name == "ground":
            continue
        k = rows[name]
        for force, at, moment in own:
            right[:, k] -= np.real(force)
            right[:, k + 1] -= np.imag(force)
            right[:, k + 2] -= (np.conj(at) * force).imag + moment
    solved = np.linalg.solve(matrix, right[..., None])[..., 0]
    pins = {
        model.pins[k][4]: solved[:, 2 * k] + 1j * solved[:, 2 * k + 1]
        for k in range(len(model.pins))
    }
    return solved[:, -1], pins


def differences(function, h):
    """First and second derivatives at 0 of a function of small steps, to the sixth order."""
    values = {k: function(k * h) for k in range(-3, 4)}
    first = sum(
        weight * (values[k] - values[-k]) for k, weight in ((1, 3 / 4), (2, -3 / 20), (3, 1 / 60))
    )
    second = sum(
        weight * (values[k] + values[-k] - 2 * values[0])
        for k, weight in ((1, 3 / 2), (2, -3 / 20), (3, 1 / 90))
    )
    return first / h, second / h**2


def moved(model, loaded):
    """Places as a function of steps away from those of a loaded motion, in the driver's unit."""
    metre = loaded.of.metre
    unit = 1.0 if loaded.rates.turns else metre
    place = loaded.places[model.body]
    near = place.translation @ [1, 1j] / metre, turned_by(place.angle)
    return lambda step: in_metres(model.at((loaded.drive + step) / unit, near), metre)


def loaded_linkage(kind, seed, loads=random_loads, unit=None):
    """A model and the loaded linkage of the package."""
    rng = np.random.default_rng([KINDS.index(kind), seed])
    unit = unit or str(rng.choice(list(METRE)))
    chosen = linkage_of(kind, rng, loads, unit)
    return Model.of(chosen), LoadedLinkage.of(chosen)


def driven_at(dyads, drives, loads, unit="mm", side=0, **more):
    """A linkage under loads that goes through poses at given drives, with one way to close."""
    where, phi = dyad_places(dyads, np.asarray(drives, float))
    rows = np.column_stack([where[side].real, where[side].imag, np.unwrap(phi[side])])
    task = Task(Displacement.from_poses(rows), length_unit=unit, loads=loads, **more)
    return found(Linkage(*dyads), task, PoseError.at(task.poses, task.poses))
