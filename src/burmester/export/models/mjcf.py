"""MJCF, MuJoCo's own format: links as bodies in metres, a motor on the driver, the loop closed.

The model begins at the chosen pose.  The joints' coordinates are angles in F (of the coupler:
from the driver), so that each key frame `pose1`, `pose2`, ... is readable.  Masses and shapes are
those of the plates and pins; the motor holds each key frame against gravity.

E160 the file does not contain the linkage
E162 dimensions that cannot be made        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree

import numpy as np

from burmester.export.description import description
from burmester.export.escaping import xml_attribute, xml_comment
from burmester.export.models.bodies import Shape
from burmester.export.models.driver_load import STANDARD_GRAVITY
from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.models.joints import directions
from burmester.export.models.mjcf_kinematics import frames_at
from burmester.export.models.servo import ARMATURE, Servo
from burmester.export.numbers import number, numbers_in, xy
from burmester.export.options import Options
from burmester.export.reference import PRECISION, Reference, as_rows, require_equal
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = ["check", "write"]

LEAST = 1e-14  # kg and kg m²: smaller ones of a body are raised to it, for MuJoCo needs 1e-15
SITE_SIZE = 0.02  # of the span: marks of pivots
COLOURS = {
    "driver": ".76 .15 .18 1",
    "coupler": "0 .34 .72 1",
    "follower": ".11 .5 .25 1",
    "ground": ".4 .4 .4 1",
    "body": "0 .47 .35 1",
}
SEEN_ONLY = ' contype="0" conaffinity="0" group="1"'
JOINED = (("world", "driver"), ("driver", "coupler"), ("coupler", "follower"))


def write(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write the model; raises E162 and E163."""
    model = DynamicModel.of(chosen, options)
    reference = model.reference
    start = model.joints.at_poses[options.pose - 1]
    servo = Servo.of(model, chosen)
    middle = reference.places.translation.mean(axis=0)
    gravity = " ".join(number(each) for each in model.gravity())
    stiff = f"{number(2 * servo.time_step)} 1"
    bound = f' boundmass="{LEAST}" boundinertia="{LEAST}"' if _small(model) else ""
    head = [each.replace("--unit", "the option unit") for each in description(chosen, options, "m")]
    lines = [
        f"<mujoco model={xml_attribute(chosen.id)}>",
        f"  <!-- {' '.join(map(xml_comment, head))} -->",
        *(f"  <!-- {xml_comment(each)} -->" for each in _notes(model, options, servo)),
        f'  <compiler angle="radian" autolimits="true"{bound}/>',
        f'  <option timestep="{number(servo.time_step)}" gravity="{gravity}" '
        'integrator="implicitfast" solver="Newton" iterations="100" tolerance="0"/>',
        f'  <statistic center="{_xyz(middle)}" extent="{number(1.5 * reference.span)}"/>',
        "  <default>",  # limits, contacts and the loop as stiff as the time step lets them be
        f'    <joint solreflimit="{stiff}"/><geom solref="{stiff}"/>',
        f'    <site size="{number(SITE_SIZE * reference.span)}" rgba="0 0 0 1"/>',
        f'    <equality solref="{stiff}" solimp="0.9999 0.9999 0.001 0.5 2"/>',
        "  </default>",
        "  <worldbody>",
        f'    <light pos="{_xyz(middle, 3 * reference.span)}" dir="0 0 -1"/>',
        *_ground(model),
        *_driver(model, reference.places[options.pose - 1], start, servo),
    ]
    if reference.kinds[1] != "RP":
        lines += _follower(model, start)
    motor = "hinge, radians" if model.joints.turning[0] else "slide, metres"
    lines += [
        "  </worldbody>",
        "  <contact>",
        *(f'    <exclude body1="{one}" body2="{two}"/>' for one, two in JOINED),
        '    <exclude body1="follower" body2="world"/>',
        "  </contact>",
        '  <equality><connect name="loop" site1="loop_a" site2="loop_b"/></equality>',
        f"  <actuator><!-- {motor} -->",
        f'    <position name="motor" joint="driver" kp="{number(servo.stiffness)}" '
        f'kv="{number(servo.damping)}" '
        f'ctrlrange="{number(model.low[0])} {number(model.high[0])}"/>',
        "  </actuator>",
        "  <keyframe>",
    ]
    for k, row in enumerate(model.joints.at_poses):
        at = " ".join(map(number, row))
        lines.append(
            f'    <key name="pose{k + 1}" qpos="{at}" ctrl="{number(servo.controls[k])}"/>'
        )
    lines += ["  </keyframe>", "</mujoco>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _notes(model: DynamicModel, options: Options, servo: Servo) -> list[str]:
    """What was chosen, a paragraph each, for comments."""
    unit = "kg m²" if model.joints.turning[0] else "kg"
    return [
        *model.notes(options),
        "Bodies that are joined do not collide.",
        f"Up is {options.up} of the ground's frame; gravity is {STANDARD_GRAVITY} m/s². The option "
        "up states another direction: z, where the linkage lies flat.",
        "Set the motor's ctrl to the driver's place: radians, or metres of a slide. The ctrl of a "
        "key frame is a little off it, for there the motor holds the linkage against gravity.",
        f"The motor is a stand-in: a servo of {servo.frequency:.0f} radians a second, critically "
        f"damped, whose own inertia, the armature, is {servo.armature:.3g} {unit} ({ARMATURE:.0%} "
        "of what it moves).",
        f"The time step is {servo.time_step:g} s: 1 ms, or a hundredth of the time of a fall of "
        "what is smaller than 10 cm. Limits, contacts and the loop give way within two steps.",
        *(
            [
                f"MuJoCo takes no mass or inertia below 1e-15 kg or kg m²: those of {small} are "
                f"raised to {LEAST:g}, which makes them slower than they are."
            ]
            if (small := ", ".join(_small(model)))
            else []
        ),
    ]


def _small(model: DynamicModel) -> list[str]:
    """The moving bodies whose mass or inertia is less than MuJoCo takes."""
    return [
        name
        for name, body in model.masses.items()
        if name != "ground" and min(body.mass, *np.linalg.eigvalsh(body.inertia)) < LEAST
    ]


def _ground(model: DynamicModel) -> list[str]:
    """The ground's plates and pins, and marks of its pivots."""
    reference = model.reference
    lines = [f"    {each}" for each in _geoms(model.shapes["ground"], "ground")]
    for side, fixed in enumerate(reference.fixed):
        if fixed is not None:
            name = ' name="loop_b"' if side and reference.kinds[1] == "RP" else ""
            lines.append(f'    <site{name} pos="{_xyz(fixed)}"/>')
    return lines


def _driver(model: DynamicModel, place: Displacement, start: FloatArray, servo: Servo) -> list[str]:
    """The driver with the coupler on it."""
    reference = model.reference
    moving, line = reference.moving[0], reference.line[0]
    at, turn, joint = _on_ground(reference, 0, start)
    if moving is None:
        assert line is not None
        relative = -line[0]
        body = np.array([-line[1], float(start[1])])
        inner = f'type="slide" axis="{_xyz(directions(line[0])[1])}"'
    else:
        relative = float(start[1]) if line is None else float(place.angle)
        body = np.array([reference.radius[0] or 0.0, 0.0]) - _turned(moving, relative)
        inner = f'type="hinge" axis="0 0 1" pos="{_xyz(moving)}"'
    own = f' armature="{number(servo.armature)}"'
    lines = [
        f'    <body name="driver" pos="{_xyz(at)}" euler="0 0 {number(turn)}">',
        f"      {_joint(model, 0, joint, start, own)}",
        *(f"      {each}" for each in _solid(model, "driver")),
        f'      <body name="coupler" pos="{_xyz(body)}" euler="0 0 {number(relative)}">',
        f"        {_joint(model, 1, inner, start)}",
        *(f"        {each}" for each in _solid(model, "coupler")),
        '        <site name="body" pos="0 0 0"/>',
    ]
    if reference.kinds[1] == "RP":
        slot = reference.line[1]
        assert slot is not None
        n, along = directions(slot[0])
        slide = f'type="slide" axis="{_xyz(along)}"'
        lines += [
            f'        <body name="follower" pos="{_xyz(slot[1] * n + float(start[2]) * along)}">',
            f"          {_joint(model, 2, slide, start)}",
            *(f"          {each}" for each in _solid(model, "follower")),
            '          <site name="loop_a" pos="0 0 0"/>',
            "        </body>",
        ]
    else:
        hand = reference.moving[1]
        assert hand is not None
        lines.append(f'        <site name="loop_a" pos="{_xyz(hand)}"/>')
    return [*lines, "      </body>", "    </body>"]


def _follower(model: DynamicModel, start: FloatArray) -> list[str]:
    """A follower on the ground."""
    at, turn, joint = _on_ground(model.reference, 1, start)
    tip = np.array([model.reference.radius[1] or 0.0, 0.0])
    return [
        f'    <body name="follower" pos="{_xyz(at)}" euler="0 0 {number(turn)}">',
        f"      {_joint(model, 2, joint, start)}",
        *(f"      {each}" for each in _solid(model, "follower")),
        f'      <site name="loop_b" pos="{_xyz(tip)}"/>',
        "    </body>",
    ]


def _on_ground(
    reference: Reference, side: Literal[0, 1], start: FloatArray
) -> tuple[FloatArray, float, str]:
    """Where a side's body begins, its angle, and its joint with the ground."""
    fixed, line, value = reference.fixed[side], reference.line[side], float(start[2 * side])
    if fixed is not None:
        return fixed, value, 'type="hinge" axis="0 0 1"'
    assert line is not None
    n, along = directions(line[0])
    return line[1] * n + value * along, 0.0, f'type="slide" axis="{_xyz(along)}"'


def _joint(model: DynamicModel, index: int, joint: str, start: FloatArray, more: str = "") -> str:
    """The joint of a body; index: 0 driver, 1 coupler, 2 follower."""
    name = ("driver", "coupler", "follower")[index]
    return (
        f'<joint name="{name}" {joint} ref="{number(start[index])}" '
        f'range="{number(model.low[index])} {number(model.high[index])}" '
        f'damping="{number(model.damping()[index])}"{more}/>'
    )


def _solid(model: DynamicModel, name: str) -> list[str]:
    """The inertia of a body, and its shapes."""
    mass = model.masses[name]
    centre = " ".join(map(number, mass.centre))
    order = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    inertia = " ".join(number(mass.inertia[each]) for each in order)
    return [
        f'<inertial pos="{centre}" mass="{number(mass.mass)}" fullinertia="{inertia}"/>',
        *_geoms(model.shapes[name], name),
        *(_geoms(model.outline, "body", SEEN_ONLY) if name == "coupler" else []),
    ]


def _geoms(shapes: list[Shape], owner: str, more: str = "") -> list[str]:
    lines = []
    for shape in shapes:
        half = [number(each / 2) for each in shape.size]
        size = " ".join(half if shape.kind == "box" else half[1:])
        turn = f' euler="0 0 {number(shape.turn)}"' if shape.turn else ""
        x, y, z = map(number, shape.centre)
        lines.append(
            f'<geom type="{shape.kind}" pos="{x} {y} {z}"{turn} size="{size}" '
            f'rgba="{COLOURS[owner]}"{more}/>'
        )
    return lines


def _turned(point: FloatArray, angle: float) -> FloatArray:
    return np.asarray(Displacement(np.zeros(2), np.array(angle)).act(point))


def _xyz(point: FloatArray, z: float = 0.0) -> str:
    return f"{xy(point)} {number(z)}"


def check(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Read the model's XML back, put its joints to every key frame and compare; raises E160.

    The bodies' masses, the joints' limits and the motor's lead are compared, too.
    """
    model = DynamicModel.of(chosen, options)
    reference = model.reference
    tolerance = PRECISION * reference.span
    root = ElementTree.parse(path).getroot()
    world = root.find("worldbody")
    assert world is not None
    keys = root.findall("keyframe/key")
    require_equal("the number of key frames", len(keys), len(reference.places.angle), 0)
    servo = Servo.of(model, chosen)
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
        lead = numbers_in(key, "ctrl")[0] - q["driver"]
        own = servo.controls[k] - model.joints.at_poses[k, 0]
        require_equal(f"the motor {name}", lead, own, PRECISION * (1 + abs(q["driver"])))
    hold = as_rows(reference.places[options.pose - 1])
    sites, angles = frames_at(world, {})
    body, turn = sites["body"], angles["coupler"]
    require_equal("where it begins", [body.real, body.imag], hold[:2], tolerance)
    require_equal("how it begins", [math.cos(turn), math.sin(turn)], hold[2:], PRECISION)
    motor, option = root.find("actuator/position"), root.find("option")
    assert motor is not None
    assert option is not None
    require_equal("gravity", numbers_in(option, "gravity"), model.gravity(), PRECISION)
    require_equal(
        "the motor's stiffness", numbers_in(motor, "kp")[0] / servo.stiffness, 1, PRECISION
    )
    for index, name in enumerate(("driver", "coupler", "follower")):
        link = next(each for each in world.iter("body") if each.get("name") == name)
        joint, mass = link.find("joint"), link.find("inertial")
        assert joint is not None
        assert mass is not None
        model.require_limits(index, *numbers_in(joint, "range"))
        if name == "driver":
            own = numbers_in(joint, "armature")[0] / servo.armature
            require_equal("the motor's inertia", own, 1, PRECISION)
        xx, yy, zz, xy_, xz, yz = numbers_in(mass, "fullinertia")
        inertia = [[xx, xy_, xz], [xy_, yy, yz], [xz, yz, zz]]
        model.require_body(name, numbers_in(mass, "mass")[0], numbers_in(mass, "pos"), inertia)
