"""URDF: a tree of links in metres, the loop open, for it has no loops.

With all joints at 0 the linkage stands at the chosen pose, and the frames `loop_a` (on the
coupler's side) and `loop_b` are at one place: a hinge belongs there.  `body` is the frame M.

E160 the file does not contain the linkage        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal, NamedTuple
from xml.etree import ElementTree

import numpy as np

from burmester.export.joints import along_slot, directions, ground_joint, require_bodies
from burmester.export.numbers import number, numbers_in, xy
from burmester.export.options import Options
from burmester.export.reference import PRECISION, Reference, description, require_equal
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = ["check", "write"]

BOX_SIDE = 0.04  # of the span: sides of the boxes
SLIDE_EFFORT = 1000.0  # newton: limit of slides, required by the format
SLIDE_SPEED = 1.0  # spans a second: limit of slides, required by the format
HEAD = """  URDF has no closed loops, so that of this linkage is left open at one joint.  With all
  joints at 0, as they are at pose {pose}, the links loop_a and loop_b are at one place.  Close the
  loop there by a hinge about z, the way your program has it: a point to point constraint between
  loop_a and loop_b.  Each link has 1 kg, as a stand-in."""


def write(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write the description; raises E163."""
    reference = Reference.of(chosen, options, "m")
    require_bodies(chosen, reference)
    place = reference.places[options.pose - 1]
    head = " ".join(description(chosen, options, "m")).replace("--unit", "the option unit")
    lines = [
        '<?xml version="1.0"?>',
        f'<robot name="{chosen.id}">',
        f"  <!-- {head} -->",
        f"  <!--\n{HEAD.format(pose=options.pose)}\n  -->",
        '  <link name="ground"/>',
    ]
    on = _coupler_joint(reference, 0, place)  # the coupler's own frame is where the driver holds it
    lines += _side(reference, 0, place)
    angle = float(place.angle)
    if reference.kinds[0] == "RR":
        relative = angle - float(ground_joint(reference, 0, place))
        tip = [reference.radius[0] or 0.0, 0.0]
        lines += _hinge("coupler", _Origin("driver", tip, relative))
    elif reference.kinds[0] == "PR":
        lines += _hinge("coupler", _Origin("driver", [0.0, 0.0], angle))
    else:
        line = reference.line[0]
        assert line is not None
        travel = -along_slot(reference, 0, reference.places) + along_slot(reference, 0, place)
        origin = _Origin("driver", [0.0, 0.0], -line[0])
        lines += _slide("coupler", origin, line[0], travel, reference.span)
    hold = _coupler_joint(reference, 1, place)
    lines += _link("coupler", [np.zeros(2), -on, hold - on], reference, closed=True)
    lines += _fixed("body", "coupler", -on)
    if reference.kinds[1] == "RP":
        line, pivot = reference.line[1], reference.fixed[1]
        assert line is not None
        assert pivot is not None
        travel = along_slot(reference, 1, reference.places) - along_slot(reference, 1, place)
        origin = _Origin("coupler", hold - on, 0.0)
        lines += _slide("follower", origin, line[0], travel, reference.span)
        lines += _link("follower", [np.zeros(2)], reference)
        lines += _fixed("loop_a", "follower", np.zeros(2))
        lines += _fixed("loop_b", "ground", pivot)
    else:
        lines += _fixed("loop_a", "coupler", hold - on)
        lines += _side(reference, 1, place)
        lines += _fixed("loop_b", "follower", np.array([reference.radius[1] or 0.0, 0.0]))
    lines += ["</robot>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _coupler_joint(reference: Reference, side: int, place: Displacement) -> FloatArray:
    """Where a side holds the coupler, in M: a moving pivot, or a point of the slot."""
    moving, fixed, line = reference.moving[side], reference.fixed[side], reference.line[side]
    if moving is not None:
        return moving
    assert fixed is not None
    assert line is not None
    n, along = directions(line[0])
    return np.asarray(line[1] * n + float(along_slot(reference, 1 if side else 0, place)) * along)


def _side(reference: Reference, side: Literal[0, 1], place: Displacement) -> list[str]:
    """The link that a side has on the ground."""
    name = ("driver", "follower")[side]
    start = float(ground_joint(reference, side, place))
    fixed, line, radius = reference.fixed[side], reference.line[side], reference.radius[side]
    if reference.kinds[side] == "PR":
        assert line is not None
        n, along = directions(line[0])
        travel = ground_joint(reference, side, reference.places) - start
        at = line[1] * n + start * along
        joint = _slide(name, _Origin("ground", at, 0.0), line[0], travel, reference.span)
    else:
        assert fixed is not None
        joint = _hinge(name, _Origin("ground", fixed, start))
    ends = [np.zeros(2)] if radius is None else [np.zeros(2), np.array([radius, 0.0])]
    return [*joint, *_link(name, ends, reference)]


class _Origin(NamedTuple):
    """The frame of a joint in its parent link: a point and an angle (radians)."""

    parent: str
    at: FloatArray | list[float]
    angle: float


def _joint(child: str, kind: str, origin: _Origin, axis: str, limit: str = "") -> list[str]:
    return [
        f'  <joint name="{child}" type="{kind}">',
        f'    <parent link="{origin.parent}"/><child link="{child}"/>',
        f'    <origin xyz="{xy(origin.at)} 0" rpy="0 0 {number(origin.angle)}"/>',
        f'    <axis xyz="{axis}"/>{limit}',
        "  </joint>",
    ]


def _hinge(child: str, origin: _Origin) -> list[str]:
    return _joint(child, "continuous", origin, "0 0 1")


def _slide(
    child: str, origin: _Origin, normal: float, travel: FloatArray, span: float
) -> list[str]:
    """A slide along a line; normal: the angle of the line's normal in the child's frame."""
    low, high = float(travel.min()), float(travel.max())
    limit = (
        f'<limit lower="{number(low)}" upper="{number(high)}" effort="{number(SLIDE_EFFORT)}" '
        f'velocity="{number(SLIDE_SPEED * span)}"/>'
    )
    axis = f"{xy(directions(normal)[1])} 0"
    return _joint(child, "prismatic", origin, axis, limit)


def _fixed(child: str, parent: str, at: FloatArray) -> list[str]:
    return [
        f'  <link name="{child}"/>',
        f'  <joint name="{child}" type="fixed">',
        f'    <parent link="{parent}"/><child link="{child}"/>',
        f'    <origin xyz="{xy(at)} 0" rpy="0 0 0"/>',
        "  </joint>",
    ]


def _link(
    name: str, points: list[FloatArray], reference: Reference, closed: bool = False
) -> list[str]:
    """A link with boxes from point to point, and a mass that stands in."""
    thin, inertia = BOX_SIDE * reference.span, number(reference.span**2)
    sides = f"{number(thin)} {number(thin)}"
    lines = [
        f'  <link name="{name}">',
        '    <inertial><origin xyz="0 0 0" rpy="0 0 0"/><mass value="1"/>',
        f'      <inertia ixx="{inertia}" ixy="0" ixz="0" iyy="{inertia}" iyz="0" izz="{inertia}"/>',
        "    </inertial>",
    ]
    ends = list(zip(points, points[1:] + points[:1] * closed, strict=False))
    for one, two in ends if len(points) > 1 else [(points[0], points[0])]:
        way, middle = two - one, (one + two) / 2
        size = float(np.linalg.norm(way)) + thin
        turn = math.atan2(way[1], way[0])
        lines.append(
            f'    <visual><origin xyz="{xy(middle)} 0" rpy="0 0 {number(turn)}"/>'
            f'<geometry><box size="{number(size)} {sides}"/></geometry></visual>'
        )
    return [*lines, "  </link>"]


def check(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Read the XML back, put its joints to every pose and compare; raises E160."""
    reference = Reference.of(chosen, options, "m")
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
        for joint, value in q.items():
            if (limit := joints[joint].find("limit")) is not None:
                low, high = float(limit.get("lower", "nan")), float(limit.get("upper", "nan"))
                require_equal(
                    f"the limits of {joint}", min(max(value, low), high), value, tolerance
                )


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
        if joint.get("type") == "continuous":
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
