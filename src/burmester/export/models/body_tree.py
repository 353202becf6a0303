"""The bodies of a model as a tree, with the points at which its loops are open; metres."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from burmester.export.models.dynamic_model import DynamicModel
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
