"""A linkage as links with holes and slots, before their widths are chosen; millimetres.

Layers: 0 is the ground, each further one lies on the one before, in the lowest stack in which
nothing meets.  Where there is none, a second ground above holds some of the pivots.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product
from typing import Final, NamedTuple, Self

import numpy as np

from burmester.export.options import Reference
from burmester.geometry.shapes import distances
from burmester.mechanisms.bodies import GROUND, LinkPlaces
from burmester.numerics.arrays import FloatArray

ALL_PLACES: Final = 721  # places along the motion at which plates are compared


class Spacing(NamedTuple):
    """How far two holes or slots of one moving link are apart, and what they are called."""

    holes: str
    apart: float


class Arrangement(NamedTuple):
    """The layer of each moving link, and of the ground under each hole or slot of the ground."""

    layers: Mapping[str, int]
    grounds: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Links:
    """What plates and pins have to hold.

    motion: where the links are along the stretch of the motion (n,) that holds the poses.
    features: of each link, the ground first: centres (1, 2) of holes, ends (2, 2) of slots, in its
    frame.
    """

    reference: Reference
    motion: LinkPlaces
    features: Mapping[str, Sequence[FloatArray]]

    @classmethod
    def of(cls, reference: Reference) -> Self:
        """The links of a linkage; slots reach as far as their pins travel."""
        motion = reference.own.all_places(ALL_PLACES)
        features = dict[str, list[FloatArray]]()
        for link, joints in reference.links.items():
            features[link] = []
            for slot, holes in ((each.slot, each.holes) for each in joints):
                if slot is None or link in holes:
                    features[link].append(holes[link][None])
                    continue
                normal, direction = slot.directions
                along = slot.along(motion)
                ends = np.stack([along.min(), along.max()])[:, None] * direction
                features[link].append(normal * slot.offset + ends)
        return cls(reference, motion, features)

    @cached_property
    def spacings(self) -> tuple[Spacing, ...]:
        """Of every two holes or slots of each moving link."""
        found = []
        for link, own in self.features.items():
            if link != GROUND:
                names = [each.name for each in self.reference.links[link]]
                for (one, a), (two, b) in combinations(zip(names, own, strict=True), 2):
                    holes = f"joints {one} and {two}" if one else f"two joints of the {link}"
                    found.append(Spacing(holes, float(distances(a, b))))
        return tuple(found)

    @property
    def size(self) -> float:
        """The median of all lengths."""
        lengths = [each.apart for each in self.spacings]
        middles = [each.mean(axis=0) for each in self.features[GROUND]]
        lengths += [float(np.linalg.norm(b - a)) for a, b in combinations(middles, 2)]
        ends = [each for own in self.features.values() for each in own if len(each) == 2]
        lengths += [float(np.linalg.norm(b - a)) for a, b in ends]
        return float(np.median([each for each in lengths if each > 0] or [1.0]))

    @property
    def arrangements(self) -> tuple[Arrangement, ...]:
        """One ground before two, then the fewest layers, then the shortest pins.

        In a linkage of one loop the driver is lowest, and links that are joined are neighbours: so
        even one that goes round both its pivots has nothing in its way.
        """
        body, pivots = self.reference.body, self.reference.links[GROUND]
        moving = [each for each in self.features if each not in (GROUND, body)] + [body]
        joined = [
            (each.links, pivots.index(each) if GROUND in each.links else None)
            for each in self.reference.joints
        ]
        ranked = []
        for layers in _stacks(len(moving)):
            own = dict(zip(moving, layers, strict=True))
            if len(self.reference.closures) == 1 and (
                own.get(self.reference.driver, 1) != 1
                or any(abs(own[one] - own[two]) != 1 for (one, two), at in joined if at is None)
            ):
                continue
            for grounds in product((0,), *[(0, max(layers) + 1)] * (len(pivots) - 1)):
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
