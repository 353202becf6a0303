"""SDF 1.7, the format of Gazebo: links as bodies in metres in a world, the loops closed by joints.

The model begins at the chosen pose, with all joints at 0.  Frames `loop_a` and `loop_b` are at the
pin that closes the loop, and `body` is the frame M.  The world's axes are those of F.  A torsion
spring belongs to the axis of a joint; for other springs and for forces the format has nothing, and
comments say so.

E160 the file does not contain the linkage
E162 dimensions that cannot be made        E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from burmester.cures import for_page, said
from burmester.export.description import description, number, xml_attribute, xml_comment, xy
from burmester.export.models.body_tree import Body, Link, Site, require_pose, tree_of
from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.options import PRECISION, Options, require_equal
from burmester.loads.masses import body_named
from burmester.mechanisms.bodies import GROUND, ORIGIN
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.tasks.loads import Spring
from burmester.wording import listed


class Stiffness(NamedTuple):
    """Of the axis of a joint: N m for a radian, and the radians at which it is slack."""

    rate: float
    reference: float


def write(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the world; raises E162 and E163."""
    model = DynamicModel.of(chosen, options)
    tree = tree_of(model, options.pose - 1)
    head = [said(each, for_page) for each in description(chosen, options, "m")]
    springs, left_out = _springs(model, options)
    lines = [
        '<?xml version="1.0"?>',
        f"<!-- {' '.join(map(xml_comment, head))} -->",
        *(f"<!-- {xml_comment(each)} -->" for each in _notes(model, options, left_out)),
        '<sdf version="1.7">',
        f"  <world name={xml_attribute(chosen.id)}>",
        f"    <gravity>{' '.join(map(number, model.gravity()))}</gravity>",
        f"    <model name={xml_attribute(chosen.id)}>",
    ]
    inside = [
        *_link(model, GROUND, None),
        '<joint name="ground_joint" type="fixed"><parent>world</parent><child>ground</child>'
        "</joint>",
        *_frames(tree.ground, GROUND),
        *(line for each in tree.bodies for line in _body(model, each, GROUND, options, springs)),
    ]
    for loop in tree.loops:
        pair = _name(loop.bodies[0]), _name(loop.bodies[1])
        frame, dynamics = f'relative_to="{loop.name}_b"', _dynamics(0.0, springs.get(pair))
        inside += _joint(f"{loop.name}_joint", pair, ORIGIN, dynamics, frame=frame)
    lines += [*(f"      {each}" for each in inside), "    </model>", "  </world>", "</sdf>", ""]
    path.write_text("\n".join(lines), encoding="utf-8", newline="\n")


def _name(body: str) -> str:
    return GROUND if body == "world" else body


def _notes(model: DynamicModel, options: Options, left_out: list[str]) -> list[str]:
    """What was chosen, a paragraph each, for comments."""
    gravity = f"Up is {options.up} of the ground's frame, whose axes are those of the world."
    if model.chosen.task.loads is not None:
        gravity = "Gravity and torsion springs are those of the task."
    if left_out:
        gravity += (
            " SDF has nothing that acts between two points or is a force by itself, so the model "
            f"lacks {listed(left_out)}: add them in a plugin of your simulator."
        )
    return [
        *model.notes(options),
        "Links of one model do not collide with each other, unless self_collide is set.",
        gravity,
        f"The loops are closed by joints between two links. All joints are at 0 at pose "
        f"{options.pose}. The joint {model.driver}_joint drives; the format has no motor. This "
        "file was read back and compared, and was not tried in a simulator.",
    ]


def _springs(
    model: DynamicModel, options: Options
) -> tuple[dict[tuple[str, str], Stiffness], list[str]]:
    """Torsion springs, summed at each joint; in words what SDF cannot hold."""
    out, left_out = dict[tuple[str, str], Stiffness](), list[str]()
    loads = model.chosen.task.loads
    if loads is None:
        return out, left_out
    tree = tree_of(model, options.pose - 1)
    hinges = [(limb.on, limb.body) for limb in model.reference.tree if not limb.slides]
    hinges += [(_name(one), _name(other)) for one, other in (each.bodies for each in tree.loops)]
    for count, course in enumerate(model.at_poses().springs, start=1):
        spring = course.spring
        one, other = (body_named(end.link, model.reference) for end in spring.ends)
        pair = next((each for each in hinges if {*each} == {one, other}), None)
        if spring.kind != "torsion" or pair is None:
            left_out.append(f"spring {count} ({spring.kind})")
            continue
        sense = 1.0 if pair == (one, other) else -1.0
        angle = float(course.length[options.pose - 1])
        new = _stiffness(spring, sense * (float(np.radians(spring["free_deg"])) - angle))
        old = out.get(pair, Stiffness(0.0, 0.0))
        rate = old.rate + new.rate
        slack = (old.rate * old.reference + new.rate * new.reference) / rate if rate else 0.0
        out[pair] = Stiffness(rate, slack)
    left_out += [f"force {count}" for count in range(1, len(loads.forces) + 1)]
    return out, left_out + (["the torque on the body"] if loads.torque else [])


def _stiffness(spring: Spring, reference: float) -> Stiffness:
    rate = spring.count * float(np.degrees(spring["rate_Nm_per_deg"]))
    return Stiffness(rate, reference)


def _body(
    model: DynamicModel,
    body: Body,
    parent: str,
    options: Options,
    springs: Mapping[tuple[str, str], Stiffness],
) -> list[str]:
    """A link with its joint, its frames and all that is on it."""
    index = model.names.index(body.name)
    start = model.joints.at_poses[options.pose - 1, index]
    low, high = model.low[index] - start, model.high[index] - start
    limit = f"<limit><lower>{number(low)}</lower><upper>{number(high)}</upper></limit>"
    dynamics = _dynamics(model.damping()[index], springs.get((parent, body.name)))
    lines = _link(model, body.name, body, parent)
    ends = parent, body.name
    lines += _joint(f"{body.name}_joint", ends, body.axis, limit + dynamics, slide=body.slide)
    lines += _frames(body.sites, body.name)
    for each in body.children:
        lines += _body(model, each, body.name, options, springs)
    return lines


def _dynamics(damping: float, spring: Stiffness | None) -> str:
    stiff = ""
    if spring is not None:
        stiff = f"<spring_reference>{number(spring.reference)}</spring_reference>"
        stiff += f"<spring_stiffness>{number(spring.rate)}</spring_stiffness>"
    return f"<dynamics><damping>{number(damping)}</damping>{stiff}</dynamics>"


def _joint(
    name: str,
    ends: tuple[str, str],
    at: FloatArray,
    more: str,
    *,
    frame: str = "",
    slide: FloatArray | None = None,
) -> list[str]:
    """A hinge about z, or a slide, at a point of the child's frame, or of a frame that is named."""
    parent, child = ends
    kind, along = ("revolute", "0 0") if slide is None else ("prismatic", xy(slide))
    return [
        f'<joint name="{name}" type="{kind}"><parent>{parent}</parent><child>{child}</child>',
        f"  <pose{' ' if frame else ''}{frame}>{xy(at)} 0 0 0 0</pose>",
        f"  <axis><xyz>{along} {'1' if slide is None else '0'}</xyz>{more}</axis>",
        "</joint>",
    ]


def _frames(sites: Iterable[Site], body: str) -> list[str]:
    return [
        f'<frame name="{each.name}" attached_to="{body}"><pose>{xy(each.at)} 0 0 0 0</pose></frame>'
        for each in sites
        if each.name
    ]


def _link(model: DynamicModel, name: str, body: Body | None, parent: str = "") -> list[str]:
    """A link with its mass and shapes, at its place on its parent where the model begins."""
    mass = model.masses[name]
    inertia = "".join(
        f"<i{'xyz'[a]}{'xyz'[b]}>{number(mass.inertia[a, b])}</i{'xyz'[a]}{'xyz'[b]}>"
        for a in range(3)
        for b in range(a, 3)
    )
    place = ""
    if body is not None:
        place = f'  <pose relative_to="{parent}">{xy(body.at)} 0 0 0 {number(body.turn)}</pose>'
    lines = [
        f'<link name="{name}">',
        *([place] if place else []),
        f"  <inertial><pose>{' '.join(map(number, mass.centre))} 0 0 0</pose>"
        f"<mass>{number(mass.mass)}</mass><inertia>{inertia}</inertia></inertial>",
    ]
    seen = model.outline if name == model.made.body else []
    uses = [(each, ("visual", "collision")) for each in model.shapes[name]]
    uses += [(each, ("visual",)) for each in seen]  # type: ignore[misc]
    for count, (shape, tags) in enumerate(uses, start=1):
        x, y, z = map(number, shape.centre)
        long, wide, height = map(number, shape.size)
        solid = f"<box><size>{long} {wide} {height}</size></box>"
        if shape.kind == "cylinder":
            radius = number(shape.size[0] / 2)
            solid = f"<cylinder><radius>{radius}</radius><length>{height}</length></cylinder>"
        lines += [
            f'  <{tag} name="{tag}_{count}"><pose>{x} {y} {z} 0 0 {number(shape.turn)}</pose>'
            f"<geometry>{solid}</geometry></{tag}>"
            for tag in tags
        ]
    return [*lines, "</link>"]


def check(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the XML back, put its joints to every pose and compare; raises E160.

    Gravity, the masses of the links, the limits of the joints, springs and loops are compared, too.
    """
    model = DynamicModel.of(chosen, options)
    root = ElementTree.parse(path).getroot()
    body = root.find("world/model")
    assert body is not None
    joints = {str(each.get("name")).removesuffix("_joint"): each for each in body.findall("joint")}
    links = {
        str(each.get("name")): _read_link(each, joints.get(str(each.get("name"))))
        for each in body.findall("link")
        if each.get("name") != GROUND
    }
    for each in body.findall("frame"):
        links[str(each.get("name"))] = Link(str(each.get("attached_to")), _at(each))
    begin = model.joints.at_poses[options.pose - 1]
    for k, row in enumerate(model.joints.at_poses - begin):
        require_pose(model, links, dict(zip(model.names, row.tolist(), strict=True)), k)
    require_equal("gravity", _numbers(root, "world/gravity"), model.gravity(), PRECISION)
    springs, _ = _springs(model, options)
    read = {}
    for each in joints.values():
        if stiff := each.findtext("axis/dynamics/spring_stiffness"):
            pair = str(each.findtext("parent")), str(each.findtext("child"))
            read[pair] = [float(stiff), *_numbers(each, "axis/dynamics/spring_reference")]
    require_equal("the joints with springs", read.keys() == springs.keys(), True, 0)
    for pair, spring in springs.items():
        require_equal("a torsion spring", read[pair], spring, PRECISION * (1 + spring.rate))
    for loop in tree_of(model, options.pose - 1).loops:
        joint = joints[loop.name]
        ends = [joint.findtext("parent"), joint.findtext("child")]
        require_equal("the loop", ends == [_name(each) for each in loop.bodies], True, 0)
        frame = joint.find("pose")
        assert frame is not None
        require_equal("its joint", frame.get("relative_to") == f"{loop.name}_b", True, 0)
        require_equal("its joint", abs(_at(joint)), 0, PRECISION * model.reference.span)
    for index, name in enumerate(model.names):
        limits = [_numbers(joints[name], f"axis/limit/{end}")[0] for end in ("lower", "upper")]
        model.require_limits(index, limits[0], limits[1], float(begin[index]))
    for name in (GROUND, *model.names):
        link = next(each for each in body.findall("link") if each.get("name") == name)
        i = [
            [_numbers(link, f"inertial/inertia/i{min(a, b)}{max(a, b)}")[0] for b in "xyz"]
            for a in "xyz"
        ]
        centre = _numbers(link, "inertial/pose")[:3]
        model.require_body(name, _numbers(link, "inertial/mass")[0], centre, i)


def _read_link(link: ElementTree.Element, joint: ElementTree.Element | None) -> Link:
    """A link on another one, with the joint between them."""
    place = link.find("pose")
    assert place is not None
    assert joint is not None
    turn, on = _numbers(link, "pose")[5], str(place.get("relative_to"))
    require_equal("a joint", [joint.findtext("parent"), joint.findtext("child")]
                  == [on, link.get("name")], True, 0)  # fmt: skip
    if joint.get("type") == "prismatic":
        along = complex(*_numbers(joint, "axis/xyz")[:2])
        return Link(on, _at(link), turn, "slide", along)
    return Link(on, _at(link), turn, "hinge", _at(joint))


def _numbers(element: ElementTree.Element, path: str) -> list[float]:
    return [float(each) for each in (element.findtext(path) or "").split()]


def _at(element: ElementTree.Element) -> complex:
    """Where the pose of an element is in its plane."""
    return complex(*_numbers(element, "pose")[:2])
