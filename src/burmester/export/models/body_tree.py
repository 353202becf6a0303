"""The bodies of a model as a tree, with the points at which its loops are open; metres."""

from __future__ import annotations

from typing import Final, Literal, NamedTuple

import numpy as np

from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.models.joints import directions
from burmester.export.reference import Reference
from burmester.export.six_bar_reference import SixBarReference, plates_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["ORIGIN", "Body", "Loop", "Site", "Tree", "tree_of"]


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


ORIGIN: Final = np.zeros(2)


def tree_of(model: DynamicModel, pose: int) -> Tree:
    """The bodies of a model that begins at a pose, a number from 0."""
    start = model.joints.at_poses[pose]
    reference = model.reference
    if isinstance(reference, SixBarReference):
        return _six_bar(reference, dict(zip(model.names, start.tolist(), strict=True)))
    return _four_bar(reference, reference.places[pose], start)


def _six_bar(reference: SixBarReference, start: dict[str, float]) -> Tree:
    """The links on those nearer to the ground, open at the joints that close its loops."""
    found, plates = reference.found, plates_of(reference.found.skeleton)
    skeleton, frames = found.skeleton, found.frames
    marks: dict[str, list[Site]] = {plates[link]: [] for link in skeleton.links}
    marks[plates[found.carries]].append(Site("body", ORIGIN))
    loops = []
    for joint, *pair in skeleton.closures:
        name = f"loop_{joint}"
        for link, end in zip(pair, "ab", strict=True):
            marks[plates[link]].append(Site(f"{name}_{end}", frames[link][joint]))
        loops.append(Loop(name, (plates[pair[0]], plates[pair[1]])))

    def on(parent: str) -> tuple[Body, ...]:
        return tuple(
            Body(
                plates[link],
                frames[parent][joint] - _turned(frames[link][joint], start[plates[link]]),
                start[plates[link]],
                frames[link][joint],
                None,
                tuple(marks[plates[link]]),
                on(link),
            )
            for link, under, joint in skeleton.tree
            if under == parent
        )

    ground = frames[skeleton.ground].values()
    return Tree(tuple(Site("", at) for at in ground), on(skeleton.ground), tuple(loops))


def _four_bar(reference: Reference, place: Displacement, start: FloatArray) -> Tree:
    """The driver with the coupler on it, and the follower on the ground, or on the coupler."""
    moving, line = reference.moving[0], reference.line[0]
    axis, direction = ORIGIN, None
    if moving is None:
        assert line is not None
        relative = -line[0]
        at = np.array([-line[1], float(start[1])])
        direction = directions(line[0])[1]
    else:
        relative = float(start[1]) if line is None else float(place.angle)
        at = np.array([reference.radius[0] or 0.0, 0.0]) - _turned(moving, relative)
        axis = moving
    mark = Site("body", ORIGIN)
    follows = reference.kinds[1] == "RP"
    if follows:
        slot = reference.line[1]
        assert slot is not None
        n, along = directions(slot[0])
        where = slot[1] * n + float(start[2]) * along
        pin = Body("follower", where, 0.0, ORIGIN, along, (Site("loop_a", ORIGIN),))
        coupler = Body("coupler", at, relative, axis, direction, (mark,), (pin,))
    else:
        hand = reference.moving[1]
        assert hand is not None
        open_at = Site("loop_a", hand)
        coupler = Body("coupler", at, relative, axis, direction, (mark, open_at))
    where, turn, slide = _on_ground(reference, 0, start)
    bodies = [Body("driver", where, turn, ORIGIN, slide, (), (coupler,))]
    if not follows:
        tip = np.array([reference.radius[1] or 0.0, 0.0])
        where, turn, slide = _on_ground(reference, 1, start)
        bodies.append(Body("follower", where, turn, ORIGIN, slide, (Site("loop_b", tip),)))
    ground = [
        Site("loop_b" if side and follows else "", fixed)
        for side, fixed in enumerate(reference.fixed)
        if fixed is not None
    ]
    joined = ("follower", "world") if follows else ("coupler", "follower")
    return Tree(tuple(ground), tuple(bodies), (Loop("loop", joined),))


def _on_ground(
    reference: Reference, side: Literal[0, 1], start: FloatArray
) -> tuple[FloatArray, float, FloatArray | None]:
    """Where a side's body begins, its angle, and the direction of its slide, if it has one."""
    fixed, line, value = reference.fixed[side], reference.line[side], float(start[2 * side])
    if fixed is not None:
        return fixed, value, None
    assert line is not None
    n, along = directions(line[0])
    return line[1] * n + value * along, 0.0, along


def _turned(point: FloatArray, angle: float) -> FloatArray:
    return np.asarray(Displacement(np.zeros(2), np.array(angle)).act(point))
