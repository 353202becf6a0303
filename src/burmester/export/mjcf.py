"""MJCF, MuJoCo's own format: links as bodies in metres, a motor on the driver, the loop closed.

The model begins at the chosen pose.  The joints' coordinates are angles in F (of the coupler:
from the driver), so that each key frame `pose1`, `pose2`, ... is readable.  Masses and
friction stand in for real ones: 1 kg a body.

E160 the file does not contain the linkage        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from burmester.export.joints import (
    along_slot,
    directions,
    driver_coordinates,
    ground_joint,
    hinged,
    require_bodies,
)
from burmester.export.mjcf_kinematics import frames_at
from burmester.export.numbers import number, numbers_in, xy
from burmester.export.options import Options
from burmester.export.reference import PRECISION, Reference, as_rows, description, require_equal
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = ["check", "write"]

TIME_STEP = 1e-3  # seconds
CAPSULE_RADIUS = 0.02  # of the span
SERVO_FREQUENCY = 100.0  # radians a second: natural frequency of the motor's position control
JOINT_DAMPING = 20.0  # of a body's inertia, per second
MOVING_BODIES = 4.0  # bodies whose inertia the motor moves
COLOURS = {
    "driver": ".76 .15 .18 1",
    "coupler": "0 .34 .72 1",
    "follower": ".11 .5 .25 1",
    "ground": ".4 .4 .4 1",
}


def write(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write the model; raises E163."""
    reference = Reference.of(chosen, options, "m")
    require_bodies(chosen, reference)
    place = reference.places[options.pose - 1]
    q = _coordinates(chosen, reference)
    start = q[options.pose - 1]
    thin = CAPSULE_RADIUS * reference.span
    gain = MOVING_BODIES * SERVO_FREQUENCY * (reference.span**2 if hinged(reference, 0) else 1.0)
    middle = reference.places.translation.mean(axis=0)
    low, high = q[:, 0].min(), q[:, 0].max()
    head = description(chosen, options, "m")
    lines = [
        f'<mujoco model="{chosen.id}">',
        f"  <!-- {' '.join(head)} -->".replace("--unit", "the option unit"),
        "  <!-- Masses (1 kg a body) and friction are stand-ins. Set the motor's ctrl to the "
        "driver's place: radians, or metres of a slide. -->",
        '  <compiler angle="radian" autolimits="true"/>',
        f'  <option timestep="{TIME_STEP}" gravity="0 0 0" integrator="implicitfast" '
        'solver="Newton"'
        ' iterations="100" tolerance="0"><flag contact="disable"/></option>',
        f'  <statistic center="{_xyz(middle)}" extent="{number(1.5 * reference.span)}"/>',
        "  <default>",
        f'    <geom type="capsule" size="{number(thin)}" contype="0" conaffinity="0" group="1"/>',
        f'    <site size="{number(1.2 * thin)}" rgba="0 0 0 1"/>',
        f'    <equality solref="{2 * TIME_STEP} 1" solimp="0.9999 0.9999 0.001 0.5 2"/>',
        "  </default>",
        "  <worldbody>",
        f'    <light pos="{_xyz(middle, 3 * reference.span)}" dir="0 0 -1"/>',
    ]
    lines += _ground(reference)
    lines += _driver(reference, place, start, thin)
    if reference.kinds[1] != "RP":
        lines += _follower(reference, start, thin)
    reach = f' ctrlrange="{number(low)} {number(high)}"' if high > low else ""
    motor = "hinge, radians" if hinged(reference, 0) else "slide, metres"
    lines += [
        "  </worldbody>",
        '  <equality><connect name="loop" site1="loop_a" site2="loop_b"/></equality>',
        f"  <actuator><!-- {motor} -->",
        f'    <position name="motor" joint="driver" kp="{number(gain * SERVO_FREQUENCY)}" '
        f'kv="{number(2 * gain)}"{reach}/>',
        "  </actuator>",
        "  <keyframe>",
    ]
    for k, row in enumerate(q):
        at = " ".join(map(number, row))
        lines.append(f'    <key name="pose{k + 1}" qpos="{at}" ctrl="{number(row[0])}"/>')
    lines += ["  </keyframe>", "</mujoco>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _coordinates(chosen: SavedLinkage, reference: Reference) -> FloatArray:
    """The joints driver, coupler and follower (N, 3) at the poses."""
    places = reference.places
    drive = driver_coordinates(chosen, reference)
    if reference.kinds[0] == "RR":
        coupler = _wrapped(places.angle - drive)
    elif reference.kinds[0] == "PR":
        coupler = places.angle
    else:
        coupler = -along_slot(reference, 0, places)
    follower = (
        along_slot(reference, 1, places)
        if reference.kinds[1] == "RP"
        else ground_joint(reference, 1, places)
    )
    return np.column_stack([drive, coupler, follower])


def _wrapped(angle: FloatArray) -> FloatArray:
    return np.asarray(np.arctan2(np.sin(angle), np.cos(angle)))


def _ground(reference: Reference) -> list[str]:
    """What is seen of the ground: rails and pivots."""
    lines = []
    for side in (0, 1):
        fixed, line = reference.fixed[side], reference.line[side]
        if fixed is not None:
            name = ' name="loop_b"' if side and reference.kinds[1] == "RP" else ""
            lines.append(f'    <site{name} pos="{_xyz(fixed)}"/>')
        elif line is not None:
            n, along = directions(line[0])
            s = ground_joint(reference, 1 if side else 0, reference.places)
            ends = [line[1] * n + each * along for each in (s.min(), s.max())]
            lines.append(
                f"    {_bar(ends[0], ends[1], 'ground', 0.3 * CAPSULE_RADIUS * reference.span)}"
            )
    return lines


def _driver(reference: Reference, place: Displacement, start: FloatArray, thin: float) -> list[str]:
    """The driver with the coupler on it."""
    fixed, moving, line, radius = (
        reference.fixed[0],
        reference.moving[0],
        reference.line[0],
        reference.radius[0],
    )
    angle = float(place.angle)
    if reference.kinds[0] == "RR":
        assert fixed is not None
        assert moving is not None
        at, turn = fixed, float(start[0])
        joint = 'type="hinge" axis="0 0 1"'
        seen = _bar(np.zeros(2), np.array([radius, 0.0]), "driver", thin)
        relative = float(start[1])
        body = np.array([radius, 0.0]) - _turned(moving, relative)
        inner = f'type="hinge" axis="0 0 1" pos="{_xyz(moving)}"'
    elif reference.kinds[0] == "PR":
        assert line is not None
        assert moving is not None
        n, along = directions(line[0])
        at, turn = line[1] * n + float(start[0]) * along, 0.0
        joint = f'type="slide" axis="{_xyz(along)}"'
        seen = _block("driver", thin)
        relative = angle
        body = -_turned(moving, relative)
        inner = f'type="hinge" axis="0 0 1" pos="{_xyz(moving)}"'
    else:
        assert fixed is not None
        assert line is not None
        at, turn = fixed, float(start[0])
        joint = 'type="hinge" axis="0 0 1"'
        seen = _block("driver", thin)
        relative = -line[0]
        body = np.array([-line[1], float(start[1])])
        inner = f'type="slide" axis="{_xyz(directions(line[0])[1])}"'
    lines = [
        f'    <body name="driver" pos="{_xyz(at)}" euler="0 0 {number(turn)}">',
        f'      <joint name="driver" {joint}{_rub(reference, joint)} ref="{number(start[0])}"/>',
        f"      {_mass(reference)}",
        f"      {seen}",
        f'      <body name="coupler" pos="{_xyz(body)}" euler="0 0 {number(relative)}">',
        f'        <joint name="coupler" {inner}{_rub(reference, inner)} ref="{number(start[1])}"/>',
        f"        {_mass(reference)}",
    ]
    seen_points = [_on_coupler(reference, 0, place), np.zeros(2), _on_coupler(reference, 1, place)]
    for k in range(3):
        one, two = seen_points[k], seen_points[(k + 1) % 3]
        if np.linalg.norm(two - one) > 1e-3 * thin:
            lines.append(f"        {_bar(one, two, 'coupler', thin)}")
    lines.append('        <site name="body" pos="0 0 0"/>')
    if reference.kinds[1] == "RP":
        slot = reference.line[1]
        assert slot is not None
        n, along = directions(slot[0])
        lines += [
            f'        <body name="follower" pos="{_xyz(slot[1] * n + float(start[2]) * along)}">',
            f'          <joint name="follower" type="slide" axis="{_xyz(along)}"'
            f'{_rub(reference, "slide")} ref="{number(start[2])}"/>',
            f"          {_mass(reference)}",
            f"          {_block('follower', thin)}",
            '          <site name="loop_a" pos="0 0 0"/>',
            "        </body>",
        ]
    else:
        hand = reference.moving[1]
        assert hand is not None
        lines.append(f'        <site name="loop_a" pos="{_xyz(hand)}"/>')
    return [*lines, "      </body>", "    </body>"]


def _follower(reference: Reference, start: FloatArray, thin: float) -> list[str]:
    """A follower on the ground."""
    fixed, line, radius = reference.fixed[1], reference.line[1], reference.radius[1]
    if reference.kinds[1] == "RR":
        assert fixed is not None
        at, turn, tip = fixed, float(start[2]), np.array([radius, 0.0])
        joint, seen = (
            'type="hinge" axis="0 0 1"',
            _bar(np.zeros(2), tip, "follower", thin),
        )
    else:
        assert line is not None
        n, along = directions(line[0])
        at, turn, tip = line[1] * n + float(start[2]) * along, 0.0, np.zeros(2)
        joint, seen = f'type="slide" axis="{_xyz(along)}"', _block("follower", thin)
    return [
        f'    <body name="follower" pos="{_xyz(at)}" euler="0 0 {number(turn)}">',
        f'      <joint name="follower" {joint}{_rub(reference, joint)} ref="{number(start[2])}"/>',
        f"      {_mass(reference)}",
        f"      {seen}",
        f'      <site name="loop_b" pos="{_xyz(tip)}"/>',
        "    </body>",
    ]


def _on_coupler(reference: Reference, side: int, place: Displacement) -> FloatArray:
    """Where a side holds the coupler, in M."""
    moving, fixed = reference.moving[side], reference.fixed[side]
    if moving is not None:
        return moving
    assert fixed is not None
    return np.asarray(place.inverse().act(fixed))


def _mass(reference: Reference) -> str:
    inertia = number(reference.span**2)
    return f'<inertial pos="0 0 0" mass="1" diaginertia="{inertia} {inertia} {inertia}"/>'


def _rub(reference: Reference, joint: str) -> str:
    """Friction of a joint, by its speed, so that a motor does not throw links over dead points."""
    return f' damping="{number(JOINT_DAMPING * (1.0 if "slide" in joint else reference.span**2))}"'


def _bar(one: FloatArray, two: FloatArray, owner: str, size: float) -> str:
    if not np.linalg.norm(two - one) > 0:
        return _block(owner, size)
    ends = f"{_xyz(one)} {_xyz(two)}"
    return f'<geom fromto="{ends}" size="{number(size)}" rgba="{COLOURS[owner]}"/>'


def _block(owner: str, size: float) -> str:
    half = number(1.5 * size)
    return f'<geom type="box" size="{half} {half} {half}" rgba="{COLOURS[owner]}"/>'


def _turned(point: FloatArray, angle: float) -> FloatArray:
    return np.asarray(Displacement(np.zeros(2), np.array(angle)).act(point))


def _xyz(point: FloatArray, z: float = 0.0) -> str:
    return f"{xy(point)} {number(z)}"


def check(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Read the model's XML back, put its joints to every key frame and compare; raises E160."""
    reference = Reference.of(chosen, options, "m")
    tolerance = PRECISION * reference.span
    root = ElementTree.parse(path).getroot()
    world = root.find("worldbody")
    assert world is not None
    keys = root.findall("keyframe/key")
    require_equal("the number of key frames", len(keys), len(reference.places.angle), 0)
    for k, key in enumerate(keys):
        q = dict(zip(("driver", "coupler", "follower"), numbers_in(key, "qpos"), strict=True))
        sites, angles = frames_at(world, q)
        place = reference.places[k]
        name = f"at pose {k + 1}"
        body = sites["body"]
        require_equal(f"the coupler {name}", [body.real, body.imag], place.translation, tolerance)
        gap = np.exp(1j * (angles["coupler"] - float(place.angle))) - 1
        require_equal(f"the coupler's angle {name}", abs(gap), 0, PRECISION)
        require_equal(f"the loop {name}", abs(sites["loop_a"] - sites["loop_b"]), 0, tolerance)
        require_equal(f"the motor {name}", numbers_in(key, "ctrl")[0], q["driver"], 0)
    hold = as_rows(reference.places[options.pose - 1])
    sites, angles = frames_at(world, {})
    body, turn = sites["body"], angles["coupler"]
    require_equal("where it begins", [body.real, body.imag], hold[:2], tolerance)
    require_equal("how it begins", [math.cos(turn), math.sin(turn)], hold[2:], PRECISION)
