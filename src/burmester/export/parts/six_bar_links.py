"""The links of a six-bar: plates with two or three holes; millimetres.

Layers: 0 is the ground, and the others lie on it in the lowest stack in which nothing meets.  Where
there is none, a second ground above holds the second crank.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import combinations, product
from typing import TYPE_CHECKING

import numpy as np

from burmester.export.parts.links import GROUND, Arrangement, Hinge, LinkPlaces, Links, Spacing
from burmester.export.six_bar_reference import SIX_BAR_PLATES
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.sixbar.watt import JOINTS

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["frames_of", "six_bar_links"]

MOTION_SAMPLES = 721  # places along the motion at which plates are compared
AXES = {"first-crank": "AC", "coupler": "CE", "second-crank": "BD", "floating-link": "GH"}
MOVING = tuple(name for name in SIX_BAR_PLATES if name != GROUND)


def six_bar_links(found: FoundSixBar) -> Links:
    """The links of a six-bar, millimetres."""
    motion = np.union1d(found.along(MOTION_SAMPLES), found.drive)
    own, origin = found.linkage, np.zeros(2)
    ends = np.stack([own.first_crank, own.coupler_arm, own.second_crank, own.floating_link])
    crank, arm, second, floating = np.column_stack([ends, np.zeros(4)])
    holes = {
        GROUND: {"A": own.fixed_first, "B": own.fixed_second},
        "first-crank": {"A": origin, "C": crank},
        "coupler": {"C": origin, "D": own.coupler_joint, "E": arm},
        "second-crank": {"B": origin, "D": second, "G": own.crank_joint},
        "floating-link": {"G": origin, "H": floating},
        "body-link": {"E": own.body_joint, "H": own.link_joint},
    }
    hinges = []
    for joint in JOINTS:
        one, two = (name for name, joints in SIX_BAR_PLATES.items() if joint in joints)
        on_ground = SIX_BAR_PLATES[GROUND].index(joint) if one == GROUND else None
        hinges.append(Hinge(one, holes[one][joint], (one, two), on_ground, joint))
    lengths = found.lengths
    spacings = [
        Spacing(f"joints {a} and {b}", f"joints {a} and {b} are at one point", lengths[a + b])
        for name in MOVING
        for a, b in combinations(SIX_BAR_PLATES[name], 2)
    ]
    return Links(
        {name: [each[None] for each in of.values()] for name, of in holes.items()},
        tuple(hinges),
        frames_of(found, found.drive),
        frames_of(found, motion),
        "body-link",
        {},
        tuple(lengths.values()),
        tuple(spacings),
        _arrangements(),
    )


def frames_of(found: FoundSixBar, drive: FloatArray) -> LinkPlaces:
    """The frames of the links where the driver is at angles (*,): M, and x from joint to joint."""
    at = found.joints(drive)
    frames = {GROUND: Displacement.identity(drive.shape), "body-link": found.body(drive)}
    for name, joints in AXES.items():
        start, end = tuple(joints)
        way = at[end] - at[start]
        frames[name] = Displacement(at[start], np.arctan2(way[..., 1], way[..., 0]))
    return LinkPlaces(frames)


@cache
def _arrangements() -> tuple[Arrangement, ...]:
    """One ground before two, then the fewest layers, then the shortest pins."""
    joined = [
        tuple(name for name, joints in SIX_BAR_PLATES.items() if joint in joints)
        for joint in JOINTS
    ]
    ranked = []
    for layers in _stacks(len(MOVING)):
        own = dict(zip(MOVING, layers, strict=True))
        for grounds in ((0, 0), (0, max(layers) + 1)):
            of_joint = dict(zip(SIX_BAR_PLATES[GROUND], grounds, strict=True))
            pins = sum(
                abs((of_joint[joint] if one == GROUND else own[one]) - own[two])
                for joint, (one, two) in zip(JOINTS, joined, strict=True)
            )
            rank = (grounds[1] > 0, max(layers), pins, layers)
            ranked.append((rank, Arrangement(own, grounds)))
    return tuple(each for _, each in sorted(ranked, key=lambda pair: pair[0]))


def _stacks(count: int) -> Iterator[tuple[int, ...]]:
    """All ways to put so many links into layers from 1 upwards, none of which is left empty."""
    for layers in product(range(1, count + 1), repeat=count):
        if set(layers) == set(range(1, max(layers) + 1)):
            yield layers
