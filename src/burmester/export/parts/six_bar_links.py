"""The links of a six-bar: plates with two or three holes; millimetres.

Layers: 0 is the ground, and the others lie on it in the lowest stack in which nothing meets.  Where
there is none, a second ground above holds some of the cranks.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import combinations, product
from typing import TYPE_CHECKING

import numpy as np

from burmester.export.parts.links import Arrangement, Hinge, LinkPlaces, Links, Spacing
from burmester.export.six_bar_reference import plates_of
from burmester.numerics.arrays import FloatArray

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["six_bar_links"]

MOTION_SAMPLES = 721  # places along the motion at which plates are compared


def six_bar_links(found: FoundSixBar) -> Links:
    """The links of a six-bar, millimetres."""
    motion = np.union1d(found.along(MOTION_SAMPLES), found.drive)
    skeleton, frames, lengths = found.skeleton, found.frames, found.lengths
    plates, ground = plates_of(skeleton), skeleton.links[skeleton.ground]
    hinges, joined = [], []
    for joint in skeleton.joints:
        one, two = skeleton.links_of(joint)
        on_ground = ground.index(joint) if joint in ground else None
        names = plates[one], plates[two]
        hinges.append(Hinge(names[0], frames[one][joint], names, on_ground, joint))
        joined.append((names, on_ground))
    spacings = [
        Spacing(f"joints {a} and {b}", f"joints {a} and {b} are at one point", lengths[bar])
        for name in skeleton.moving
        for a, b in combinations(skeleton.links[name], 2)
        for bar in (a + b, b + a)
        if bar in lengths
    ]

    def places(drive: FloatArray) -> LinkPlaces:
        return LinkPlaces({plates[link]: at for link, at in found.links(drive).items()})

    return Links(
        {plates[link]: [at[None] for at in joints.values()] for link, joints in frames.items()},
        tuple(hinges),
        places(found.drive),
        places(motion),
        plates[found.carries],
        tuple(plates.values())[1:],
        {},
        tuple(lengths.values()),
        tuple(spacings),
        _arrangements(tuple(plates.values())[1:], len(ground), tuple(joined)),
    )


@cache
def _arrangements(
    moving: tuple[str, ...], pivots: int, joined: Sequence[tuple[tuple[str, str], int | None]]
) -> tuple[Arrangement, ...]:
    """One ground before two, then the fewest layers, then the shortest pins.

    joined: the two links of each joint, and its number among the pivots if one is the ground.
    """
    ranked = []
    for layers in _stacks(len(moving)):
        own = dict(zip(moving, layers, strict=True))
        for grounds in product((0,), *[(0, max(layers) + 1)] * (pivots - 1)):
            pins = sum(
                abs((own[one] if pivot is None else grounds[pivot]) - own[two])
                for (one, two), pivot in joined
            )
            rank = (max(grounds) > 0, max(layers), pins, layers)
            ranked.append((rank, Arrangement(own, grounds)))
    return tuple(each for _, each in sorted(ranked, key=lambda pair: pair[0]))


def _stacks(count: int) -> Iterator[tuple[int, ...]]:
    """All ways to put so many links into layers from 1 upwards, none of which is left empty."""
    for layers in product(range(1, count + 1), repeat=count):
        if set(layers) == set(range(1, max(layers) + 1)):
            yield layers
