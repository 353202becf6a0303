"""The skeleton of a mechanism: which links there are, and which joints hold them together.

With the link that carries the body and all joints in the frames of their links it determines a
mechanism of any class: its files, drawings and models need no more.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from types import MappingProxyType
from typing import NamedTuple, TypeAlias, final

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, complex_of

__all__ = ["Frames", "Joints", "Skeleton", "distance", "seen_along"]

# Joints (*, 2) by their letters; and those of each link, in the frame of that link.
Joints: TypeAlias = Mapping[str, FloatArray]
Frames: TypeAlias = Mapping[str, Joints]


@final
class Skeleton(NamedTuple):
    """The joints and links of a class of mechanisms.

    name: of the class, such as "Watt I six-bar".  joints: a letter each.  links: the joints of each
    link by its name, the ground first.  drivers: the pivots on the ground at which a motor may be.
    along: the two joints on the x axis of a link's frame, the first at its origin, where they are
    not its first two; the ground has its joints in F, and the link that carries the body in M.
    """

    name: str
    joints: str
    links: Mapping[str, str]
    drivers: str
    along: Mapping[str, str] = MappingProxyType({})

    @property
    def ground(self) -> str:
        """The name of the ground."""
        return next(iter(self.links))

    @property
    def moving(self) -> tuple[str, ...]:
        """The names of all other links."""
        return tuple(self.links)[1:]

    @property
    def bars(self) -> tuple[str, ...]:
        """Every pair of joints of one link: the sides of a link of three in their order."""
        return tuple(
            one + two
            for joints in self.links.values()
            for (_, one), (_, two) in sorted(
                combinations(enumerate(joints), 2), key=lambda pair: pair[1][0] - pair[0][0]
            )
        )

    def links_of(self, joint: str) -> tuple[str, ...]:
        """The names of the links that a joint holds together."""
        return tuple(name for name, joints in self.links.items() if joint in joints)

    def crank(self, pivot: str) -> str:
        """The name of the link that turns about a pivot on the ground."""
        return next(name for name in self.links_of(pivot) if name != self.ground)

    def arm(self, pivot: str) -> str:
        """The joints by which a driver's angle counts: its pivot, and the next one of the crank."""
        return pivot + next(each for each in self.links[self.crank(pivot)] if each != pivot)

    def axis(self, link: str) -> str:
        """The joint at the origin of a link's frame, and that on its x axis."""
        return self.along.get(link, self.links[link][:2])

    def places(self, frames: Frames, joints: Joints) -> dict[str, Displacement]:
        """Where the frames of the links are, (*,) each, where the joints are (*, 2).

        frames: of one mechanism.  Angles are within half a turn; nan where there is no joint.
        """
        out = {}
        for link in self.links:
            ends = tuple(self.axis(link))
            there, here = (complex_of(joints[end]) for end in reversed(ends))
            far, near = (complex_of(frames[link][end]) for end in reversed(ends))
            turn = (there - here) / (far - near)
            turn = turn / np.abs(turn)
            origin = here - turn * near
            out[link] = Displacement(np.stack([origin.real, origin.imag], -1), np.angle(turn))
        return out

    def lengths(self, frames: Frames) -> dict[str, float]:
        """The distances between joints of one link: {"AB": 30.0, ...}."""
        return {
            bar: float(distance(frames[link], bar))
            for bar in self.bars
            for link in self.links_of(bar[0])
            if bar[1] in self.links[link]
        }


def distance(joints: Joints, bar: str) -> FloatArray:
    """The distance (*,) between two joints of a link."""
    return np.asarray(np.abs(complex_of(joints[bar[1]]) - complex_of(joints[bar[0]])))


def seen_along(joints: Joints, bar: str, joint: str) -> FloatArray:
    """A joint (*, 2) in the frame with its origin at one joint, and another one on its x axis."""
    origin = complex_of(joints[bar[0]])
    way = complex_of(joints[bar[1]]) - origin
    at = (complex_of(joints[joint]) - origin) * (np.abs(way) / way)
    return np.stack([at.real, at.imag], axis=-1)
