"""URDF: a tree of links in metres, its loops open, for it has none.

With all joints at 0 the linkage stands at the chosen pose, and the frames `loop_a` and `loop_b` (of
a six-bar `loop_D_a` and `loop_D_b`, `loop_H_a` and `loop_H_b`) are at one place: a hinge belongs
there.  `body` is the frame M.  The
root `world` has z upwards, as the programs have it that read URDF; `ground` is the frame F.

E160 the file does not contain the linkage
E162 dimensions that cannot be made        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Final, Literal
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
from burmester.export.models.body_tree import Body, Link, Site, Tree, require_pose, tree_of
from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.options import PRECISION, Options, require_equal
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import ORIGIN
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.wording import listed

EFFORT = 1000.0  # N m or newton: limit of joints, required by the format
SPEED = 10.0  # radians, or spans of a slide, a second: limit of joints, required by the format
TILT = {  # roll, pitch, yaw by which the ground stands in a world with z upwards
    "x": (0.0, -math.pi / 2, 0.0),
    "y": (math.pi / 2, 0.0, 0.0),
    "z": (0.0, 0.0, 0.0),
    "-x": (0.0, math.pi / 2, 0.0),
    "-y": (-math.pi / 2, 0.0, 0.0),
    "-z": (math.pi, 0.0, 0.0),
}

KINDS: Final[Mapping[str, Literal["fixed", "hinge", "slide"]]] = {
    "fixed": "fixed",
    "revolute": "hinge",
    "prismatic": "slide",
}


def write(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the description; raises E162 and E163."""
    model = DynamicModel.of(chosen, options)
    tree = tree_of(model, options.pose - 1)
    head = [said(each, for_page) for each in description(chosen, options, "m")]
    tilt = " ".join(map(number, TILT[options.up]))
    lines = [
        '<?xml version="1.0"?>',
        f"<robot name={xml_attribute(chosen.id)}>",
        f"  <!-- {' '.join(map(xml_comment, head))} -->",
        f"  <!-- {_open_loops(tree, options)} -->",
        *(f"  <!-- {xml_comment(each)} -->" for each in [*model.notes(options), *_notes(options)]),
        '  <link name="world"/>',
        *_fixed("ground", "world", tilt=tilt),
        *_link(model, "ground"),
        *_frames(tree.ground, "ground"),
    ]
    for each in tree.bodies:
        lines += _body(model, each, "ground", ORIGIN, options)
    lines += ["</robot>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _open_loops(tree: Tree, options: Options) -> str:
    """How the loops are closed, for a comment."""
    pairs = listed([f"{each.name}_a and {each.name}_b" for each in tree.loops])
    one = len(tree.loops) == 1
    return (
        f"URDF has no closed loops, so {'that' if one else 'those'} of this linkage "
        f"{'is left open at one joint' if one else 'are left open at a joint each'}. With all "
        f"joints at 0, as they are at pose {options.pose}, the links {pairs} are at one place"
        f"{'' if one else ' each'}. Close the {'loop' if one else 'loops'} there by a hinge about "
        "z, the way your program has it: a point to point constraint between the two."
    )


def _body(
    model: DynamicModel, body: Body, parent: str, off: FloatArray, options: Options
) -> list[str]:
    """A link with its joint, its frames and all that is on it; off: the parent's axis."""
    turn = Displacement(ORIGIN, np.array(body.turn))
    lines = _joint(model, body, parent, body.at + turn.act(body.axis) - off, options)
    lines += _link(model, body.name, body.axis)
    lines += _frames(body.sites, body.name, body.axis)
    for each in body.children:
        lines += _body(model, each, body.name, body.axis, options)
    return lines


def _frames(sites: Iterable[Site], parent: str, off: FloatArray = ORIGIN) -> list[str]:
    """Links without mass at the points of a body that have names."""
    lines = []
    for each in sites:
        if each.name:
            lines += [*_fixed(each.name, parent, each.at - off), f'  <link name="{each.name}"/>']
    return lines


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


def _joint(
    model: DynamicModel, body: Body, parent: str, at: FloatArray, options: Options
) -> list[str]:
    """A hinge about z, or a slide along a line, at a point of the parent's frame."""
    index = model.names.index(body.name)
    start = model.joints.at_poses[options.pose - 1, index]
    kind, axis, speed = "revolute", "0 0 1", SPEED
    if body.slide is not None:
        kind, axis = "prismatic", f"{xy(body.slide)} 0"
        speed = SPEED * model.reference.span
    return [
        f'  <joint name="{body.name}" type="{kind}">',
        f'    <parent link="{parent}"/><child link="{body.name}"/>',
        f'    <origin xyz="{xy(at)} 0" rpy="0 0 {number(body.turn)}"/>',
        f'    <axis xyz="{axis}"/><limit lower="{number(model.low[index] - start)}" '
        f'upper="{number(model.high[index] - start)}" '
        f'effort="{number(EFFORT)}" velocity="{number(speed)}"/>',
        f'    <dynamics damping="{number(model.damping()[index])}" friction="0"/>',
        "  </joint>",
    ]


def _fixed(child: str, parent: str, at: FloatArray = ORIGIN, tilt: str = "0 0 0") -> list[str]:
    return [
        f'  <joint name="{child}" type="fixed">',
        f'    <parent link="{parent}"/><child link="{child}"/>',
        f'    <origin xyz="{xy(at)} 0" rpy="{tilt}"/>',
        "  </joint>",
    ]


def _link(model: DynamicModel, name: str, origin: FloatArray = ORIGIN) -> list[str]:
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
    solid_shapes, seen = model.shapes[name], model.outline if name == model.made.body else []
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


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the XML back, put its joints to every pose and compare; raises E160.

    The masses of the links and the limits of the joints are compared, too.
    """
    model = DynamicModel.of(chosen, options)
    root = ElementTree.parse(path).getroot()
    joints = {str(each.get("name")): each for each in root.findall("joint")}
    frames = dict(map(_frame, root.findall("joint")))
    begin = model.joints.at_poses[options.pose - 1]
    for k, row in enumerate(model.joints.at_poses - begin):
        require_pose(model, frames, dict(zip(model.names, row.tolist(), strict=True)), k)
    stands = joints["ground"].find("origin")
    assert stands is not None
    require_equal("what is up", numbers_in(stands, "rpy"), TILT[options.up], PRECISION)
    links = {str(each.get("name")): each for each in root.findall("link")}
    for index, joint in enumerate(model.names):
        limit = joints[joint].find("limit")
        assert limit is not None
        ends = numbers_in(limit, "lower") + numbers_in(limit, "upper")
        model.require_limits(index, ends[0], ends[1], float(begin[index]))
    for name in ("ground", *model.names):
        origin, mass, six = (
            links[name].find(f"inertial/{each}") for each in ("origin", "mass", "inertia")
        )
        assert origin is not None
        assert mass is not None
        assert six is not None
        i = {key: numbers_in(six, f"i{key}")[0] for key in ("xx", "xy", "xz", "yy", "yz", "zz")}
        inertia = [[i[min(a, b) + max(a, b)] for a in "xyz"] for b in "xyz"]
        axis = ORIGIN if name == "ground" else model.axes[model.names.index(name)]
        off = [*axis, 0.0]
        (kilograms,) = numbers_in(mass, "value")
        model.require_body(name, kilograms, numbers_in(origin, "xyz"), inertia, off)


def _frame(joint: ElementTree.Element) -> tuple[str, Link]:
    """The name of a joint, and the link that it carries."""
    origin, parent, axis = (joint.find(each) for each in ("origin", "parent", "axis"))
    assert origin is not None
    assert parent is not None
    x, y, _ = numbers_in(origin, "xyz")
    kind, along = KINDS[str(joint.get("type"))], 0j
    if kind == "slide" and axis is not None:
        along = complex(*numbers_in(axis, "xyz")[:2])
    turn = numbers_in(origin, "rpy")[2]
    return str(joint.get("name")), Link(str(parent.get("link")), complex(x, y), turn, kind, along)
