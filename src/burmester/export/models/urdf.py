"""URDF: a tree of links in metres, the loop open, for it has no loops.

With all joints at 0 the linkage stands at the chosen pose, and the frames `loop_a` (on the
coupler's side) and `loop_b` are at one place: a hinge belongs there.  `body` is the frame M.  The
root `world` has z upwards, as the programs have it that read URDF; `ground` is the frame F.

E160 the file does not contain the linkage
E162 dimensions that cannot be made        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal, NamedTuple
from xml.etree import ElementTree

import numpy as np

from burmester.export.description import description
from burmester.export.escaping import xml_attribute, xml_comment
from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.models.joints import along_slot, directions, ground_joint
from burmester.export.numbers import number, numbers_in, xy
from burmester.export.options import Options
from burmester.export.reference import PRECISION, Reference, require_equal
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = ["check", "write"]

EFFORT = 1000.0  # N m or newton: limit of joints, required by the format
SPEED = 10.0  # radians, or spans of a slide, a second: limit of joints, required by the format
ORIGIN = [0.0, 0.0]
NAMES = ("driver", "coupler", "follower")
HEAD = """  URDF has no closed loops, so that of this linkage is left open at one joint.  With all
  joints at 0, as they are at pose {pose}, the links loop_a and loop_b are at one place.  Close the
  loop there by a hinge about z, the way your program has it: a point to point constraint between
  loop_a and loop_b."""
TILT = {  # roll, pitch, yaw by which the ground stands in a world with z upwards
    "x": (0.0, -math.pi / 2, 0.0),
    "y": (math.pi / 2, 0.0, 0.0),
    "z": (0.0, 0.0, 0.0),
    "-x": (0.0, math.pi / 2, 0.0),
    "-y": (-math.pi / 2, 0.0, 0.0),
    "-z": (math.pi, 0.0, 0.0),
}


def write(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write the description; raises E162 and E163."""
    model = DynamicModel.of(chosen, options)
    reference = model.four_bar
    place = reference.places[options.pose - 1]
    head = [each.replace("--unit", "the option unit") for each in description(chosen, options, "m")]
    tilt = " ".join(map(number, TILT[options.up]))
    lines = [
        '<?xml version="1.0"?>',
        f"<robot name={xml_attribute(chosen.id)}>",
        f"  <!-- {' '.join(map(xml_comment, head))} -->",
        f"  <!--\n{HEAD.format(pose=options.pose)}\n  -->",
        *(f"  <!-- {xml_comment(each)} -->" for each in [*model.notes(options), *_notes(options)]),
        '  <link name="world"/>',
        *_fixed("ground", "world", tilt=tilt),
        *_link(model, "ground"),
    ]
    on = _coupler_joint(reference, 0, place)  # the coupler's own frame is where the driver holds it
    lines += _side(model, 0, place, options)
    angle = float(place.angle)
    if reference.kinds[0] == "RR":
        relative = angle - float(ground_joint(reference, 0, place))
        origin = _Origin("driver", [reference.radius[0] or 0.0, 0.0], relative)
    elif reference.kinds[0] == "PR":
        origin = _Origin("driver", [0.0, 0.0], angle)
    else:
        line = reference.line[0]
        assert line is not None
        origin = _Origin("driver", [0.0, 0.0], -line[0])
    lines += _joint(model, 1, origin, options)
    hold = _coupler_joint(reference, 1, place)
    lines += _link(model, "coupler", on)
    lines += [*_fixed("body", "coupler", -on), *_frame_link("body")]
    if reference.kinds[1] == "RP":
        pivot = reference.fixed[1]
        assert pivot is not None
        lines += _joint(model, 2, _Origin("coupler", hold - on, 0.0), options)
        lines += _link(model, "follower")
        lines += [*_fixed("loop_a", "follower", np.zeros(2)), *_frame_link("loop_a")]
        lines += [*_fixed("loop_b", "ground", pivot), *_frame_link("loop_b")]
    else:
        lines += [*_fixed("loop_a", "coupler", hold - on), *_frame_link("loop_a")]
        lines += _side(model, 1, place, options)
        tip = np.array([reference.radius[1] or 0.0, 0.0])
        lines += [*_fixed("loop_b", "follower", tip), *_frame_link("loop_b")]
    lines += ["</robot>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _notes(options: Options) -> list[str]:
    """What was chosen beside the model that MJCF has, too."""
    return [
        f"Up is {options.up} of the ground's frame, and z of the root world, against which most "
        "programs take gravity. The option up states another direction: z, where the linkage lies "
        "flat.",
        f"Effort ({EFFORT:g}) and velocity ({SPEED:g} radians or spans of the linkage a second) of "
        "the limits are stand-ins that the format requires.",
        "Take collisions off links that a joint joins, and off the two that the hinge of the loop "
        "joins: their pins are in their holes. Links without inertia are frames.",
    ]


def _coupler_joint(reference: Reference, side: int, place: Displacement) -> FloatArray:
    """Where a side holds the coupler, in M: a moving pivot, or a point of the slot."""
    moving, fixed, line = reference.moving[side], reference.fixed[side], reference.line[side]
    if moving is not None:
        return moving
    assert fixed is not None
    assert line is not None
    n, along = directions(line[0])
    return np.asarray(line[1] * n + float(along_slot(reference, 1 if side else 0, place)) * along)


def _side(
    model: DynamicModel, side: Literal[0, 1], place: Displacement, options: Options
) -> list[str]:
    """The link that a side has on the ground."""
    reference, name = model.four_bar, ("driver", "follower")[side]
    start = float(ground_joint(reference, side, place))
    fixed, line = reference.fixed[side], reference.line[side]
    if reference.kinds[side] == "PR":
        assert line is not None
        n, along = directions(line[0])
        origin = _Origin("ground", line[1] * n + start * along, 0.0)
    else:
        assert fixed is not None
        origin = _Origin("ground", fixed, start)
    return [*_joint(model, 2 * side, origin, options), *_link(model, name)]


class _Origin(NamedTuple):
    """The frame of a joint in its parent link: a point and an angle (radians)."""

    parent: str
    at: FloatArray | list[float]
    angle: float


def _joint(model: DynamicModel, index: int, origin: _Origin, options: Options) -> list[str]:
    """A hinge about z, or a slide along a line; index: 0 driver, 1 coupler, 2 follower."""
    name, line = NAMES[index], model.four_bar.line[0 if index < 2 else 1]
    start, turning = model.joints.at_poses[options.pose - 1, index], model.joints.turning[index]
    kind, axis, speed = "revolute", "0 0 1", SPEED
    if not turning:
        assert line is not None
        kind, axis = "prismatic", f"{xy(directions(line[0])[1])} 0"
        speed = SPEED * model.four_bar.span
    return [
        f'  <joint name="{name}" type="{kind}">',
        f'    <parent link="{origin.parent}"/><child link="{name}"/>',
        f'    <origin xyz="{xy(origin.at)} 0" rpy="0 0 {number(origin.angle)}"/>',
        f'    <axis xyz="{axis}"/><limit lower="{number(model.low[index] - start)}" '
        f'upper="{number(model.high[index] - start)}" '
        f'effort="{number(EFFORT)}" velocity="{number(speed)}"/>',
        f'    <dynamics damping="{number(model.damping()[index])}" friction="0"/>',
        "  </joint>",
    ]


def _fixed(
    child: str, parent: str, at: FloatArray | list[float] = ORIGIN, tilt: str = "0 0 0"
) -> list[str]:
    return [
        f'  <joint name="{child}" type="fixed">',
        f'    <parent link="{parent}"/><child link="{child}"/>',
        f'    <origin xyz="{xy(at)} 0" rpy="{tilt}"/>',
        "  </joint>",
    ]


def _frame_link(name: str) -> list[str]:
    return [f'  <link name="{name}"/>']


def _link(model: DynamicModel, name: str, origin: FloatArray | list[float] = ORIGIN) -> list[str]:
    """A link with its mass and shapes; origin: (2,), of its frame in that of the model's body."""
    mass, off = model.masses[name], np.array([*origin, 0.0])
    x, y, z = map(number, mass.centre - off)
    i = [[number(each) for each in row] for row in mass.inertia]
    lines = [
        f'  <link name="{name}">',
        f'    <inertial><origin xyz="{x} {y} {z}" rpy="0 0 0"/><mass value="{number(mass.mass)}"/>',
        f'      <inertia ixx="{i[0][0]}" ixy="{i[0][1]}" ixz="{i[0][2]}" iyy="{i[1][1]}" '
        f'iyz="{i[1][2]}" izz="{i[2][2]}"/>',
        "    </inertial>",
    ]
    solid_shapes, seen = model.shapes[name], model.outline if name == "coupler" else []
    both = ("visual", "collision")
    for shape, uses in [(each, both) for each in solid_shapes] + [
        (each, both[:1]) for each in seen
    ]:
        x, y, z = map(number, shape.centre - off)
        long, wide, height = map(number, shape.size)
        solid = f'<box size="{long} {wide} {height}"/>'
        if shape.kind == "cylinder":
            solid = f'<cylinder radius="{number(shape.size[0] / 2)}" length="{height}"/>'
        place = f'<origin xyz="{x} {y} {z}" rpy="0 0 {number(shape.turn)}"/>'
        lines += [f"    <{what}>{place}<geometry>{solid}</geometry></{what}>" for what in uses]
    return [*lines, "  </link>"]


def check(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Read the XML back, put its joints to every pose and compare; raises E160.

    The masses of the links and the limits of the joints are compared, too.
    """
    model = DynamicModel.of(chosen, options)
    reference = model.four_bar
    tolerance = PRECISION * reference.span
    root = ElementTree.parse(path).getroot()
    joints = {str(each.get("name")): each for each in root.findall("joint")}
    start = reference.places[options.pose - 1]
    for k in range(reference.places.shape[0]):
        place = reference.places[k]
        q = {}
        for side, name in ((0, "driver"), (1, "follower")):
            if side == 1 and reference.kinds[1] == "RP":
                q[name] = float(along_slot(reference, 1, place) - along_slot(reference, 1, start))
            else:
                q[name] = float(
                    ground_joint(reference, 1 if side else 0, place)
                    - ground_joint(reference, 1 if side else 0, start)
                )
        if reference.kinds[0] == "RP":
            q["coupler"] = float(along_slot(reference, 0, start) - along_slot(reference, 0, place))
        else:
            q["coupler"] = float(place.angle - start.angle)
            q["coupler"] -= q["driver"] if reference.kinds[0] == "RR" else 0.0
        frames = {name: _frame(name, joints, q) for name in ("body", "loop_a", "loop_b")}
        name = f"at pose {k + 1}"
        at, turn = frames["body"]
        require_equal(f"the coupler {name}", [at.real, at.imag], place.translation, tolerance)
        gap = turn - complex(np.exp(1j * float(place.angle)))
        require_equal(f"the coupler's angle {name}", abs(gap), 0, PRECISION)
        require_equal(
            f"the loop {name}", abs(frames["loop_a"][0] - frames["loop_b"][0]), 0, tolerance
        )
    stands = joints["ground"].find("origin")
    assert stands is not None
    require_equal("what is up", numbers_in(stands, "rpy"), TILT[options.up], PRECISION)
    begin = model.joints.at_poses[options.pose - 1]
    links = {str(each.get("name")): each for each in root.findall("link")}
    on = _coupler_joint(reference, 0, start)
    for index, joint in enumerate(NAMES):
        limit = joints[joint].find("limit")
        assert limit is not None
        ends = numbers_in(limit, "lower") + numbers_in(limit, "upper")
        model.require_limits(index, ends[0], ends[1], float(begin[index]))
    for name in ("ground", *NAMES):
        origin, mass, six = (
            links[name].find(f"inertial/{each}") for each in ("origin", "mass", "inertia")
        )
        assert origin is not None
        assert mass is not None
        assert six is not None
        i = {key: numbers_in(six, f"i{key}")[0] for key in ("xx", "xy", "xz", "yy", "yz", "zz")}
        inertia = [[i[min(a, b) + max(a, b)] for a in "xyz"] for b in "xyz"]
        off = [*on, 0.0] if name == "coupler" else [0.0, 0.0, 0.0]
        (kilograms,) = numbers_in(mass, "value")
        model.require_body(name, kilograms, numbers_in(origin, "xyz"), inertia, off)


def _frame(
    link: str, joints: dict[str, ElementTree.Element], q: dict[str, float]
) -> tuple[complex, complex]:
    """The origin of a link's frame in the ground's, and its turn."""
    at, turn = 0j, 1 + 0j
    while link != "ground":
        joint = joints[link]
        origin, parent = joint.find("origin"), joint.find("parent")
        assert origin is not None
        assert parent is not None
        x, y, _ = numbers_in(origin, "xyz")
        spin = numbers_in(origin, "rpy")[2]
        own, by, value = 0j, complex(math.cos(spin), math.sin(spin)), q.get(link, 0.0)
        if joint.get("type") == "revolute":
            own, inner = 0j, complex(math.cos(value), math.sin(value))
        elif joint.get("type") == "prismatic":
            axis = joint.find("axis")
            assert axis is not None
            ax, ay, _ = numbers_in(axis, "xyz")
            own, inner = value * complex(ax, ay), 1 + 0j
        else:
            inner = 1 + 0j
        at = complex(x, y) + by * (own + inner * at)
        turn = by * inner * turn
        link = str(parent.get("link"))
    return at, turn
