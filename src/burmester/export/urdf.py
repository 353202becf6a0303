"""URDF: a tree of links in metres, the loop open, for it has no loops.

With all joints at 0 the linkage stands at the pose asked for, and the frames `loop_a` (on the
coupler's side) and `loop_b` are at one place: a hinge belongs there.  `body` is the frame M.

E160 what was written is not the linkage        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree

import numpy as np

from burmester.export.joints import along_slot, directions, ground_joint, require_bodies
from burmester.export.numbers import number, numbers_in, xy
from burmester.export.options import Options
from burmester.export.truth import PRECISION, Truth, about, agree
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = ["check", "write"]

THIN = 0.04  # of the span: the sides of the boxes
FORCE = 1000.0  # newton: the limit of slides, which the format wants
SPEED = 1.0  # spans a second, likewise
HEAD = """  URDF has no closed loops, so that of this linkage is left open at one joint.  With all
  joints at 0, as they are at pose {pose}, the links loop_a and loop_b are at one place.  Close the
  loop there by a hinge about z, the way your program has it: a point to point constraint between
  loop_a and loop_b.  Each link has 1 kg, as a stand-in."""


def write(chosen: SavedLinkage, path: Path, options: Options) -> None:
    """Write the description; raises E163."""
    truth = Truth.of(chosen, options, "m")
    require_bodies(chosen, truth)
    place = truth.places[options.pose - 1]
    told = " ".join(about(chosen, options, "m")).replace("--unit", "the option unit")
    lines = [
        '<?xml version="1.0"?>',
        f'<robot name="{chosen.id}">',
        f"  <!-- {told} -->",
        f"  <!--\n{HEAD.format(pose=options.pose)}\n  -->",
        '  <link name="ground"/>',
    ]
    on = _held(truth, 0, place)  # the coupler's own frame is where the driver holds it
    lines += _side(truth, 0, place)
    angle = float(place.angle)
    if truth.kinds[0] == "RR":
        relative = angle - float(ground_joint(truth, 0, place))
        lines += _joint(
            "coupler", "continuous", "driver", [truth.radius[0] or 0.0, 0.0], relative, "0 0 1"
        )
    elif truth.kinds[0] == "PR":
        lines += _joint("coupler", "continuous", "driver", [0.0, 0.0], angle, "0 0 1")
    else:
        line = truth.line[0]
        assert line is not None
        travel = -along_slot(truth, 0, truth.places) + along_slot(truth, 0, place)
        lines += _slide("coupler", "driver", [0.0, 0.0], -line[0], line[0], travel, truth)
    hold = _held(truth, 1, place)
    lines += _link("coupler", [np.zeros(2), -on, hold - on], truth, closed=True)
    lines += _fixed("body", "coupler", -on)
    if truth.kinds[1] == "RP":
        line, pivot = truth.line[1], truth.fixed[1]
        assert line is not None
        assert pivot is not None
        travel = along_slot(truth, 1, truth.places) - along_slot(truth, 1, place)
        lines += _slide("follower", "coupler", hold - on, 0.0, line[0], travel, truth)
        lines += _link("follower", [np.zeros(2)], truth)
        lines += _fixed("loop_a", "follower", np.zeros(2))
        lines += _fixed("loop_b", "ground", pivot)
    else:
        lines += _fixed("loop_a", "coupler", hold - on)
        lines += _side(truth, 1, place)
        lines += _fixed("loop_b", "follower", np.array([truth.radius[1] or 0.0, 0.0]))
    lines += ["</robot>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _held(truth: Truth, side: int, place: Displacement) -> FloatArray:
    """Where a side holds the coupler, in M: a moving pivot, or a point of the slot."""
    moving, fixed, line = truth.moving[side], truth.fixed[side], truth.line[side]
    if moving is not None:
        return moving
    assert fixed is not None
    assert line is not None
    n, along = directions(line[0])
    return np.asarray(line[1] * n + float(along_slot(truth, 1 if side else 0, place)) * along)


def _side(truth: Truth, side: Literal[0, 1], place: Displacement) -> list[str]:
    """The link that a side has on the ground."""
    name = ("driver", "follower")[side]
    start = float(ground_joint(truth, side, place))
    fixed, line, radius = truth.fixed[side], truth.line[side], truth.radius[side]
    if truth.kinds[side] == "PR":
        assert line is not None
        n, along = directions(line[0])
        travel = ground_joint(truth, side, truth.places) - start
        at = line[1] * n + start * along
        joint = _slide(name, "ground", at, 0.0, line[0], travel, truth)
    else:
        assert fixed is not None
        joint = _joint(name, "continuous", "ground", fixed, start, "0 0 1")
    ends = [np.zeros(2)] if radius is None else [np.zeros(2), np.array([radius, 0.0])]
    return [*joint, *_link(name, ends, truth)]


def _joint(  # noqa: PLR0917
    child: str,
    kind: str,
    parent: str,
    at: FloatArray | list[float],
    turn: float,
    axis: str,
    limit: str = "",
) -> list[str]:
    return [
        f'  <joint name="{child}" type="{kind}">',
        f'    <parent link="{parent}"/><child link="{child}"/>',
        f'    <origin xyz="{xy(at)} 0" rpy="0 0 {number(turn)}"/>',
        f'    <axis xyz="{axis}"/>{limit}',
        "  </joint>",
    ]


def _slide(  # noqa: PLR0917
    child: str,
    parent: str,
    at: FloatArray | list[float],
    turn: float,
    normal: float,
    travel: FloatArray,
    truth: Truth,
) -> list[str]:
    """A slide along a line with a normal at that angle, as the child's frame has it."""
    low, high = float(travel.min()), float(travel.max())
    limit = (
        f'<limit lower="{number(low)}" upper="{number(high)}" effort="{number(FORCE)}" '
        f'velocity="{number(SPEED * truth.span)}"/>'
    )
    axis = f"{xy(directions(normal)[1])} 0"
    return _joint(child, "prismatic", parent, at, turn, axis, limit)


def _fixed(child: str, parent: str, at: FloatArray) -> list[str]:
    return [
        f'  <link name="{child}"/>',
        f'  <joint name="{child}" type="fixed">',
        f'    <parent link="{parent}"/><child link="{child}"/>',
        f'    <origin xyz="{xy(at)} 0" rpy="0 0 0"/>',
        "  </joint>",
    ]


def _link(name: str, points: list[FloatArray], truth: Truth, closed: bool = False) -> list[str]:
    """A link with boxes from point to point, and a mass that stands in."""
    thin, inertia = THIN * truth.span, number(truth.span**2)
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
    truth = Truth.of(chosen, options, "m")
    tolerance = PRECISION * truth.span
    root = ElementTree.parse(path).getroot()
    joints = {str(each.get("name")): each for each in root.findall("joint")}
    start = truth.places[options.pose - 1]
    for k in range(truth.places.shape[0]):
        place = truth.places[k]
        q = {}
        for side, name in ((0, "driver"), (1, "follower")):
            if side == 1 and truth.kinds[1] == "RP":
                q[name] = float(along_slot(truth, 1, place) - along_slot(truth, 1, start))
            else:
                q[name] = float(
                    ground_joint(truth, 1 if side else 0, place)
                    - ground_joint(truth, 1 if side else 0, start)
                )
        if truth.kinds[0] == "RP":
            q["coupler"] = float(along_slot(truth, 0, start) - along_slot(truth, 0, place))
        else:
            q["coupler"] = float(place.angle - start.angle)
            q["coupler"] -= q["driver"] if truth.kinds[0] == "RR" else 0.0
        frames = {name: _frame(name, joints, q) for name in ("body", "loop_a", "loop_b")}
        name = f"at pose {k + 1}"
        at, turn = frames["body"]
        agree(f"the coupler {name}", [at.real, at.imag], place.translation, tolerance)
        gap = turn - complex(np.exp(1j * float(place.angle)))
        agree(f"the coupler's angle {name}", abs(gap), 0, PRECISION)
        agree(f"the loop {name}", abs(frames["loop_a"][0] - frames["loop_b"][0]), 0, tolerance)
        for joint, value in q.items():
            if (limit := joints[joint].find("limit")) is not None:
                low, high = float(limit.get("lower", "nan")), float(limit.get("upper", "nan"))
                agree(f"the limits of {joint}", min(max(value, low), high), value, tolerance)


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
