"""The bodies of an MJCF model as a tree, with the sites at which loops are closed; metres."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from burmester.export.models.dynamic_model import DynamicModel
from burmester.export.models.joints import directions
from burmester.export.numbers import number, xy
from burmester.export.reference import Reference
from burmester.export.six_bar_reference import SixBarReference
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["Body", "Loop", "Site", "Tree", "tree_of", "xyz"]


class Site(NamedTuple):
    """A point (2,) of a body; name: empty where it is only to be seen."""

    name: str
    at: FloatArray


class Body(NamedTuple):
    """A body on another one, or on the ground.

    name: its own, that of its joint, too.  at, turn: of its frame where the model begins, radians.
    joint: the attributes of its joint.  sites: its points.
    """

    name: str
    at: FloatArray
    turn: float | None
    joint: str
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


HINGE = 'type="hinge" axis="0 0 1"'


def tree_of(model: DynamicModel, pose: int) -> Tree:
    """The bodies of a model that begins at a pose, a number from 0."""
    start = model.joints.at_poses[pose]
    reference = model.reference
    if isinstance(reference, SixBarReference):
        return _six_bar(reference, dict(zip(model.names, start.tolist(), strict=True)))
    return _four_bar(reference, reference.places[pose], start)


def _six_bar(reference: SixBarReference, start: dict[str, float]) -> Tree:
    """Two cranks on the ground, with coupler and body on the first, open at D and H."""
    own = reference.found.linkage
    turn = start["body-link"]
    body = Body(
        "body-link",
        np.array([float(own.coupler_arm), 0.0]) - _turned(own.body_joint, turn),
        turn,
        f'{HINGE} pos="{xyz(own.body_joint)}"',
        (Site("body", np.zeros(2)), Site("loop_H_a", own.link_joint)),
    )
    end = np.array([float(own.first_crank), 0.0])
    site = Site("loop_D_a", own.coupler_joint)
    coupler = Body("coupler", end, start["coupler"], HINGE, (site,), (body,))
    end = np.array([float(own.floating_link), 0.0])
    site, turn = Site("loop_H_b", end), start["floating-link"]
    floating = Body("floating-link", own.crank_joint, turn, HINGE, (site,))
    end = np.array([float(own.second_crank), 0.0])
    site, turn = Site("loop_D_b", end), start["second-crank"]
    return Tree(
        (Site("", own.fixed_first), Site("", own.fixed_second)),
        (
            Body("first-crank", own.fixed_first, start["first-crank"], HINGE, (), (coupler,)),
            Body("second-crank", own.fixed_second, turn, HINGE, (site,), (floating,)),
        ),
        (
            Loop("loop_D", ("coupler", "second-crank")),
            Loop("loop_H", ("body-link", "floating-link")),
        ),
    )


def _four_bar(reference: Reference, place: Displacement, start: FloatArray) -> Tree:
    """The driver with the coupler on it, and the follower on the ground, or on the coupler."""
    moving, line = reference.moving[0], reference.line[0]
    if moving is None:
        assert line is not None
        relative = -line[0]
        at = np.array([-line[1], float(start[1])])
        inner = f'type="slide" axis="{xyz(directions(line[0])[1])}"'
    else:
        relative = float(start[1]) if line is None else float(place.angle)
        at = np.array([reference.radius[0] or 0.0, 0.0]) - _turned(moving, relative)
        inner = f'{HINGE} pos="{xyz(moving)}"'
    mark = Site("body", np.zeros(2))
    follows = reference.kinds[1] == "RP"
    if follows:
        slot = reference.line[1]
        assert slot is not None
        n, along = directions(slot[0])
        slide = f'type="slide" axis="{xyz(along)}"'
        where = slot[1] * n + float(start[2]) * along
        pin = Body("follower", where, None, slide, (Site("loop_a", np.zeros(2)),))
        coupler = Body("coupler", at, relative, inner, (mark,), (pin,))
    else:
        hand = reference.moving[1]
        assert hand is not None
        coupler = Body("coupler", at, relative, inner, (mark, Site("loop_a", hand)))
    bodies = [Body("driver", *_on_ground(reference, 0, start), (), (coupler,))]
    if not follows:
        tip = np.array([reference.radius[1] or 0.0, 0.0])
        bodies.append(Body("follower", *_on_ground(reference, 1, start), (Site("loop_b", tip),)))
    ground = [
        Site("loop_b" if side and follows else "", fixed)
        for side, fixed in enumerate(reference.fixed)
        if fixed is not None
    ]
    joined = ("follower", "world") if follows else ("coupler", "follower")
    return Tree(tuple(ground), tuple(bodies), (Loop("loop", joined),))


def _on_ground(
    reference: Reference, side: Literal[0, 1], start: FloatArray
) -> tuple[FloatArray, float, str]:
    """Where a side's body begins, its angle, and its joint with the ground."""
    fixed, line, value = reference.fixed[side], reference.line[side], float(start[2 * side])
    if fixed is not None:
        return fixed, value, HINGE
    assert line is not None
    n, along = directions(line[0])
    return line[1] * n + value * along, 0.0, f'type="slide" axis="{xyz(along)}"'


def _turned(point: FloatArray, angle: float) -> FloatArray:
    return np.asarray(Displacement(np.zeros(2), np.array(angle)).act(point))


def xyz(point: FloatArray, z: float = 0.0) -> str:
    """A point (2,) as three numbers."""
    return f"{xy(point)} {number(z)}"
