"""MJCF, MuJoCo's own format: links as bodies in metres, a motor on the driver, the loop closed.

The model begins at the chosen pose.  The joints' coordinates are angles in F (of the coupler:
from the driver), so that each key frame `pose1`, `pose2`, ... is readable.  Masses and shapes are
those of the plates and pins; the motor holds each key frame against gravity.

E160 the file does not contain the linkage
E162 dimensions that cannot be made        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path
from typing import Final, Literal, NamedTuple, final
from xml.etree import ElementTree

import numpy as np

from burmester.cures import for_page, said
from burmester.export.description import (
    description,
    number,
    numbers_in,
    xml_attribute,
    xml_comment,
    xy,
)
from burmester.export.models.applied_loads import AppliedLoads
from burmester.export.models.bodies import Shape
from burmester.export.models.body_tree import Body, Link, Site, Tree, require_pose, tree_of
from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.options import PRECISION, Options, require_equal
from burmester.mechanisms.bodies import GROUND
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.tasks.loads import STANDARD_GRAVITY

LEAST = 1e-14  # kg and kg m²: smaller ones of a body are raised to it, for MuJoCo needs 1e-15
SITE_SIZE = 0.02  # of the span: marks of pivots
GROUND_COLOUR, OUTLINE_COLOUR = ".4 .4 .4 1", "0 .47 .35 1"
COLOURS = (".76 .15 .18 1", "0 .34 .72 1", ".11 .5 .25 1", ".75 .42 0 1", ".45 .25 .65 1")
SEEN_ONLY = ' contype="0" conaffinity="0" group="1"'


LONGEST_STEP: Final = 1e-3  # seconds: time step, shorter for linkages below 10 cm
STEP_SHARE: Final = 0.01  # of sqrt(span / g), the time of a fall: longest time step
FREQUENCY: Final = 0.3  # radians a time step: natural frequency
ARMATURE: Final = 0.01  # of the reduced inertia: that of the motor itself
# The same where there are more loops: the driver is often so light beside all that it moves that
# the damping of the servo, which a step of MuJoCo weighs against the driver alone, would shake
# them.
LOOPS_ARMATURE: Final = 0.3


def write(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the model; raises E162 and E163."""
    model = DynamicModel.of(chosen, options)
    reference = model.reference
    start = model.joints.at_poses[options.pose - 1]
    servo, tree = Servo.of(model), tree_of(model, options.pose - 1)
    loads = AppliedLoads.of(model)
    middle = reference.places.translation.mean(axis=0)
    gravity = " ".join(number(each) for each in model.gravity())
    stiff = f"{number(2 * servo.time_step)} 1"
    bound = f' boundmass="{LEAST}" boundinertia="{LEAST}"' if _small(model) else ""
    head = [said(each, for_page) for each in description(chosen, options, "m")]
    lines = [
        f"<mujoco model={xml_attribute(chosen.id)}>",
        f"  <!-- {' '.join(map(xml_comment, head))} -->",
        *(f"  <!-- {xml_comment(each)} -->" for each in _notes(model, options, servo, loads)),
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
        *(f"    {each}" for each in _geoms(model.shapes[GROUND], GROUND_COLOUR)),
        *(f"    {_site(each)}" for each in tree.ground),
        *(f"    {each}" for each in loads.sites.get(GROUND, ())),
        *(
            f"    {line}"
            for each in tree.bodies
            for line in _body(model, each, start, servo, loads)
        ),
    ]
    turning = model.joints.turning[model.motor]
    motor = "hinge, radians" if turning else "slide, metres"
    low, high = model.low[model.motor], model.high[model.motor]
    lines += [
        "  </worldbody>",
        "  <contact>",
        *(f'    <exclude body1="{one}" body2="{two}"/>' for one, two in _joined(tree)),
        "  </contact>",
        "  <equality>"
        + "".join(
            f'<connect name="{each.name}" site1="{each.name}_a" site2="{each.name}_b"/>'
            for each in tree.loops
        )
        + "</equality>",
        *(
            ["  <tendon>", *(f"    {each}" for each in loads.tendons), "  </tendon>"]
            if loads.tendons
            else []
        ),
        f"  <actuator><!-- {motor} -->",
        f'    <position name="motor" joint="{model.driver}" kp="{number(servo.stiffness)}" '
        f'kv="{number(servo.damping)}" '
        f'ctrlrange="{number(low)} {number(high)}"/>',
        *(f"    {each}" for each in loads.actuators),
        "  </actuator>",
        "  <keyframe>",
    ]
    for k, row in enumerate(model.joints.at_poses):
        at = " ".join(map(number, row))
        control = " ".join([number(servo.controls[k]), *("0" for _ in loads.actuators)])
        lines.append(f'    <key name="pose{k + 1}" qpos="{at}" ctrl="{control}"/>')
    lines += ["  </keyframe>", "</mujoco>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _notes(model: DynamicModel, options: Options, servo: Servo, loads: AppliedLoads) -> list[str]:
    """What was chosen, a paragraph each, for comments."""
    unit = "kg m²" if model.joints.turning[model.motor] else "kg"
    gravity = (
        f"Up is {options.up} of the ground's frame; gravity is {STANDARD_GRAVITY} m/s². The option "
        "up states another direction: z, where the linkage lies flat."
    )
    if model.chosen.task.loads is not None:
        gravity = (
            "Gravity, springs and forces are those of the task. What has no command is named "
            "spring_1, force_1, ...; friction of gas springs is that of their tendons."
        )
        for each in loads.left_out:
            gravity += f" Force {each} acts between some poses only, and is left out."
    return [
        *model.notes(options),
        "Bodies that are joined do not collide.",
        gravity,
        "Set the motor's ctrl to the driver's place: radians, or metres of a slide. The ctrl of a "
        "key frame is a little off it, for there the motor holds the linkage against gravity.",
        f"The motor is a stand-in: a servo of {servo.frequency:.0f} radians a second, critically "
        f"damped, whose own inertia, the armature, is {servo.armature:.3g} {unit} "
        f"({servo.share:.0%} of what it moves).",
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


def _joined(tree: Tree) -> list[tuple[str, str]]:
    """The bodies that a joint or a loop joins."""

    def below(name: str, body: Body) -> list[tuple[str, str]]:
        return [(name, body.name)] + [
            pair for each in body.children for pair in below(body.name, each)
        ]

    on_joints = [pair for each in tree.bodies for pair in below("world", each)]
    return on_joints + [each.bodies for each in tree.loops]


def _small(model: DynamicModel) -> list[str]:
    """The moving bodies whose mass or inertia is less than MuJoCo takes."""
    return [
        name
        for name, body in model.masses.items()
        if name != "ground" and min(body.mass, *np.linalg.eigvalsh(body.inertia)) < LEAST
    ]


def _body(
    model: DynamicModel, body: Body, start: FloatArray, servo: Servo, loads: AppliedLoads
) -> list[str]:
    """A body with all that is on it."""
    inside = [
        _joint(model, body, start, servo),
        *_solid(model, body.name),
        *map(_site, body.sites),
        *loads.sites.get(body.name, ()),
        *(line for each in body.children for line in _body(model, each, start, servo, loads)),
    ]
    return [
        f'<body name="{body.name}" pos="{_xyz(body.at)}" euler="0 0 {number(body.turn)}">',
        *(f"  {each}" for each in inside),
        "</body>",
    ]


def _site(site: Site) -> str:
    name = f' name="{site.name}"' if site.name else ""
    return f'<site{name} pos="{_xyz(site.at)}"/>'


def _joint(model: DynamicModel, body: Body, start: FloatArray, servo: Servo) -> str:
    """The joint of a body."""
    index = model.names.index(body.name)
    joint = f'type="hinge" axis="0 0 1" pos="{_xyz(body.axis)}"'
    if body.slide is not None:
        joint = f'type="slide" axis="{_xyz(body.slide)}"'
    more = f' armature="{number(servo.armature)}"' if body.name == model.driver else ""
    return (
        f'<joint name="{body.name}" {joint} ref="{number(start[index])}" '
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
        *_geoms(model.shapes[name], COLOURS[model.made.moving.index(name)]),
        *(_geoms(model.outline, OUTLINE_COLOUR, SEEN_ONLY) if name == model.made.body else []),
    ]


def _geoms(shapes: list[Shape], colour: str, more: str = "") -> list[str]:
    lines = []
    for shape in shapes:
        half = [number(each / 2) for each in shape.size]
        size = " ".join(half if shape.kind == "box" else half[1:])
        turn = f' euler="0 0 {number(shape.turn)}"' if shape.turn else ""
        x, y, z = map(number, shape.centre)
        lines.append(
            f'<geom type="{shape.kind}" pos="{x} {y} {z}"{turn} size="{size}" '
            f'rgba="{colour}"{more}/>'
        )
    return lines


def _xyz(point: FloatArray, z: float = 0.0) -> str:
    return f"{xy(point)} {number(z)}"


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the model's XML back, put its joints to every key frame and compare; raises E160.

    The bodies' masses, the joints' limits and the motor's lead are compared, too.
    """
    model = DynamicModel.of(chosen, options)
    root = ElementTree.parse(path).getroot()
    world = root.find("worldbody")
    assert world is not None
    links = dict(_links(world, GROUND))
    keys = root.findall("keyframe/key")
    require_equal("the number of key frames", len(keys), len(model.joints.at_poses), 0)
    loops = [(each.get("site1"), each.get("site2")) for each in root.findall("equality/connect")]
    own_loops = [(f"{each.name}_a", f"{each.name}_b") for each in tree_of(model, 0).loops]
    require_equal("the loops", loops == own_loops, True, 0)
    servo, loads = Servo.of(model), AppliedLoads.of(model)
    applied = [
        each.attrib for each in (*root.findall("tendon/*"), *root.findall("actuator/general"))
    ]
    own_loads = [ElementTree.fromstring(each).attrib for each in (*loads.tendons, *loads.actuators)]
    require_equal("the springs", applied == own_loads, True, 0)
    for k, key in enumerate(keys):
        q = dict(zip(model.names, numbers_in(key, "qpos"), strict=True))
        require_pose(model, links, q, k)
        drive = q[model.driver]
        lead = numbers_in(key, "ctrl")[0] - drive
        own = servo.controls[k] - model.joints.at_poses[k, model.motor]
        require_equal(f"the motor at pose {k + 1}", lead, own, PRECISION * (1 + abs(drive)))
    require_pose(model, links, {}, options.pose - 1)  # where it begins
    motor, option = root.find("actuator/position"), root.find("option")
    assert motor is not None
    assert option is not None
    require_equal("gravity", numbers_in(option, "gravity"), model.gravity(), PRECISION)
    require_equal(
        "the motor's stiffness", numbers_in(motor, "kp")[0] / servo.stiffness, 1, PRECISION
    )
    for index, name in enumerate(model.names):
        link = next(each for each in world.iter("body") if each.get("name") == name)
        joint, mass = link.find("joint"), link.find("inertial")
        assert joint is not None
        assert mass is not None
        model.require_limits(index, *numbers_in(joint, "range"))
        if name == model.driver:
            own = numbers_in(joint, "armature")[0] / servo.armature
            require_equal("the motor's inertia", own, 1, PRECISION)
        xx, yy, zz, xy_, xz, yz = numbers_in(mass, "fullinertia")
        inertia = [[xx, xy_, xz], [xy_, yy, yz], [xz, yz, zz]]
        model.require_body(name, numbers_in(mass, "mass")[0], numbers_in(mass, "pos"), inertia)


def _links(element: ElementTree.Element, on: str) -> Iterable[tuple[str, Link]]:
    """The bodies and sites that an element holds whose own name is `on`, by their names."""
    for each in element:
        name = each.get("name")
        if each.tag not in ("site", "body") or name is None:
            continue
        x, y, _ = numbers_in(each, "pos")
        if each.tag == "site":
            yield name, Link(on, complex(x, y))
            continue
        joint = each.find("joint")
        assert joint is not None
        kind: Literal["slide", "hinge"] = "slide" if joint.get("type") == "slide" else "hinge"
        along = complex(*numbers_in(joint, "axis" if kind == "slide" else "pos")[:2])
        turn, zero = numbers_in(each, "euler")[2], numbers_in(joint, "ref")[0]
        yield name, Link(on, complex(x, y), turn, kind, along, zero)
        yield from _links(each, name)


@final
class Servo(NamedTuple):
    """A servo, and the time step (seconds) that suits it.

    frequency: natural, radians a second.
    stiffness, damping, armature: newtons, metres and kilograms, or N m, radians and kg m².
    share: of what the driver moves, the armature.
    controls: (N,), the commands at the poses, within the joint's limits; at a dead point, where no
    motor holds, they do not lead.
    """

    time_step: float
    frequency: float
    stiffness: float
    damping: float
    armature: float
    share: float
    controls: FloatArray

    @classmethod
    def of(cls, model: DynamicModel) -> Servo:
        """A servo with critical damping for the median of the inertia at the poses."""
        step = min(LONGEST_STEP, STEP_SHARE * math.sqrt(model.reference.span / STANDARD_GRAVITY))
        step = float(f"{step:.1e}")
        load = model.at_poses()
        moved_by_driver = load.inertia[0]
        finite = moved_by_driver[np.isfinite(moved_by_driver)]
        inertia = float(np.median(finite)) if len(finite) else model.masses[model.driver].about_z()
        share = ARMATURE if len(model.reference.closures) == 1 else LOOPS_ARMATURE
        frequency, moved = FREQUENCY / step, (1 + share) * inertia
        stiffness = moved * frequency**2
        lead = np.nan_to_num(load.effort / stiffness, nan=0.0, posinf=0.0, neginf=0.0)
        motor = model.motor
        at = model.joints.at_poses[:, motor] + lead
        controls = np.clip(at, model.low[motor], model.high[motor])
        damping = 2 * moved * frequency
        return cls(step, frequency, stiffness, damping, share * inertia, share, controls)
