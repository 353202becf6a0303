"""The bodies of a model as a tree, with the points at which its loops are open; metres."""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from typing import Literal, NamedTuple

import numpy as np

from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.options import PRECISION, require_equal
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import GROUND, ORIGIN, Limb
from burmester.numerics.arrays import FloatArray


class Site(NamedTuple):
    """A point (2,) of a body; name: empty where it is only to be seen."""

    name: str
    at: FloatArray


class Body(NamedTuple):
    """A body on another one, or on the ground.

    name: its own, that of its joint, too.  at, turn: of its frame in that of what it is on, where
    the model begins; radians.
    axis: (2,) of its hinge, in its frame.  slide: (2,), the direction of a slide, or None.
    """

    name: str
    at: FloatArray
    turn: float
    axis: FloatArray
    slide: FloatArray | None
    sites: tuple[Site, ...]
    children: tuple[Body, ...] = ()


class Loop(NamedTuple):
    """A pin that joins two bodies: its name, and theirs."""

    name: str
    bodies: tuple[str, str]


class Tree(NamedTuple):
    """All bodies on the ground, the marks of the ground, and the loops."""

    ground: tuple[Site, ...]
    bodies: tuple[Body, ...]
    loops: tuple[Loop, ...]


def tree_of(model: DynamicModel, pose: int) -> Tree:
    """The bodies of a model that begins at a pose, a number from 0."""
    reference = model.reference
    start = dict(zip(model.names, model.joints.at_poses[pose].tolist(), strict=True))
    marks: dict[str, list[Site]] = {name: [] for name in (GROUND, *model.names)}
    marks[reference.body].append(Site("body", ORIGIN))
    loops, closing = [], {}
    for joint, *pair in reference.closures:
        name = f"loop_{joint.name}" if joint.name else "loop"
        for body, end in zip(pair, "ab", strict=True):
            closing[body, joint] = f"{name}_{end}"
            if body != GROUND:
                marks[body].append(Site(f"{name}_{end}", joint.hole(body)))
        one, two = (each if each != GROUND else "world" for each in pair)
        loops.append(Loop(name, (one, two)))
    for joint in reference.links[GROUND]:
        if GROUND in joint.holes:
            marks[GROUND].append(Site(closing.get((GROUND, joint), ""), joint.holes[GROUND]))

    def on(parent: str) -> tuple[Body, ...]:
        return tuple(
            Body(
                limb.body,
                *_placed(limb, start[limb.body]),
                tuple(marks[limb.body]),
                on(limb.body),
            )
            for limb in reference.tree
            if limb.on == parent
        )

    return Tree(tuple(marks[GROUND]), on(GROUND), tuple(loops))


def _placed(limb: Limb, value: float) -> tuple[FloatArray, float, FloatArray, FloatArray | None]:
    """Where a body is on another one, its angle, its hinge and its slide; value: of its joint."""
    joint, slot = limb.joint, limb.joint.slot
    if not limb.slides:
        hinge = joint.hole(limb.body)
        turned = Displacement(ORIGIN, np.array(value)).act(hinge)
        return joint.hole(limb.on) - turned, value, hinge, None
    assert slot is not None
    normal, along = slot.directions
    if limb.body == slot.pin:
        return slot.offset * normal + value * along, slot.turn, ORIGIN, along
    back = Displacement(ORIGIN, np.array(-slot.turn))
    return back.act(value * along - slot.offset * normal), -slot.turn, ORIGIN, along


class Link(NamedTuple):
    """A link or a site as a file has it, and the joint of its name by which it is on another one.

    at, turn: its frame in that of the other one where the joint is at `zero`.  along: the place of
    a hinge in its frame, or the direction of a slide.
    """

    on: str
    at: complex
    turn: float = 0.0
    kind: Literal["fixed", "hinge", "slide"] = "fixed"
    along: complex = 0j
    zero: float = 0.0


def place_of(
    links: Mapping[str, Link], name: str, joints: Mapping[str, float]
) -> tuple[complex, complex]:
    """The origin of a link's frame in the ground's, and its turn as a complex number.

    joints: by name, radians or metres; one that is missing is as the model begins.
    """
    if name == GROUND:
        return 0j, 1 + 0j
    on, own, angle, kind, along, zero = links[name]
    at, turn = place_of(links, on, joints)
    by = joints.get(name, zero) - zero
    spin = cmath.rect(1.0, angle)
    if kind == "slide":
        own += spin * by * along
    elif kind == "hinge":
        own += spin * along * (1 - cmath.rect(1.0, by))
        spin *= cmath.rect(1.0, by)
    return at + turn * own, turn * spin


def require_pose(
    model: DynamicModel, links: Mapping[str, Link], joints: Mapping[str, float], pose: int
) -> None:
    """Raise E160 unless joints bring the body to a pose, a number from 0, with closed loops."""
    where, wanted = f"at pose {pose + 1}", model.reference.places[pose]
    tolerance = PRECISION * model.reference.span
    at, turn = place_of(links, "body", joints)
    require_equal(f"the body {where}", [at.real, at.imag], wanted.translation, tolerance)
    gap = abs(turn - cmath.rect(1.0, float(wanted.angle)))
    require_equal(f"the body's angle {where}", gap, 0, PRECISION)
    for loop in tree_of(model, pose).loops:
        one, two = (place_of(links, f"{loop.name}_{end}", joints)[0] for end in "ab")
        require_equal(f"the loop {where}", abs(one - two), 0, tolerance)
