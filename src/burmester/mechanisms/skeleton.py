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
from burmester.numerics.arrays import FloatArray, complex_of, pairs_of

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

    def held(self, carries: str) -> tuple[str, ...]:
        """The names of links that have more than a length: ground, body, those of three joints."""
        plain = (self.ground, carries)
        return tuple(name for name, own in self.links.items() if name in plain or len(own) > 2)

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

    @property
    def tree(self) -> tuple[tuple[str, str, str], ...]:
        """Each moving link, the link that it turns on, and the joint: as near the ground as can be.

        A link stands before those that turn on it; these, and theirs, before the next one.
        """
        found = [(self.ground, "", "")]
        for on, _, _ in found:
            for joint in self.links[on]:
                known = [name for name, _, _ in found]
                found += [(each, on, joint) for each in self.links_of(joint) if each not in known]

        def above(link: str) -> tuple[tuple[str, str, str], ...]:
            return tuple(each for row in found if row[1] == link for each in (row, *above(row[0])))

        return above(self.ground)

    @property
    def closures(self) -> tuple[tuple[str, str, str], ...]:
        """The joints that close the loops which `tree` leaves open, with both their links."""
        order = [link for link, _, _ in self.tree]
        held = [{joint: {link, on}} for link, on, joint in self.tree]
        out = []
        for joint in self.joints:
            links = set(self.links_of(joint))
            if {joint: links} not in held:
                one, other = sorted(links, key=order.index)
                out.append((joint, one, other))
        return tuple(out)

    def legs(self, pivot: str) -> tuple[tuple[str, ...], ...]:
        """Where a driver's motion is passed on: the groups of links beyond it, each by its legs.

        A leg is two joints of a link, the first of which the driver and the groups before have put
        in its place.  Two legs meet in a joint; three carry a link.
        """
        known = {*self.links[self.ground], *self.links[self.crank(pivot)]}
        free = [each for each in self.moving if each != self.crank(pivot)]
        groups = list[tuple[str, ...]]()

        def leg(link: str, joint: str) -> str:
            return next((at + joint for at in self.links[link] if at in known), "")

        while free:
            for joint in (each for each in self.joints if each not in known):
                legs = tuple(leg(each, joint) for each in self.links_of(joint))
                if all(legs):
                    groups.append(legs)
                    taken = self.links_of(joint)
                    break
            else:
                held = [each for each in free if known & set(self.links[each])]
                ends = [next(at for at in self.links[each] if at in known) for each in held]
                if len(held) == 2:  # two links turn, and two others join them
                    bars = ["".join(self.links[each]) for each in free if each not in held]
                    turned = [bar if bar[0] in self.links[held[0]] else bar[::-1] for bar in bars]
                    groups.append((*turned, ends[0] + ends[1]))
                else:
                    groups.append(
                        tuple(
                            end + self.links[each].replace(end, "")[0]
                            for each, end in zip(held, ends, strict=True)
                        )
                    )
                taken = tuple(free)
            known |= {at for each in taken for at in self.links[each]}
            free = [each for each in free if each not in taken]
        return tuple(groups)

    def corners(self, frames: Frames, body: str) -> dict[str, str]:
        """The outline of each moving link as it is drawn: its joints, and M, the origin of M.

        body: the link that carries the body, to whose outline M belongs unless it is inside.
        """
        out = {link: self.links[link] for link in self.moving}
        own = {joint: complex(*frames[body][joint]) for joint in self.links[body]}
        if len(own) == 2:
            return {**out, body: self.links[body] + "M"}
        points = [*own.values()]
        turns = [
            ((two - one) * -one.conjugate()).imag
            for one, two in zip(points, points[1:] + points[:1], strict=True)
        ]
        if not (all(turn > 0 for turn in turns) or all(turn < 0 for turn in turns)):
            own["M"] = 0j
            middle = sum(own.values()) / len(own)
            out[body] = "".join(sorted(own, key=lambda each: np.angle(own[each] - middle)))
        return out

    def places(self, frames: Frames, joints: Joints) -> dict[str, Displacement]:
        """Where the frames of the links are, (*,) each, where the joints are (*, 2).

        frames: of one mechanism.  Angles are within half a turn; nan where there is no joint.
        """
        axes = [(link, *self.axis(link)) for link in self.links]
        here, there = (complex_of(np.array([joints[each[end]] for each in axes])) for end in (1, 2))
        near, far = (
            np.array([complex(*frames[each[0]][each[end]]) for each in axes]) for end in (1, 2)
        )
        over = (slice(None), *[None] * (here.ndim - 1))
        turn = (there - here) / (far - near)[over]
        turn = turn / np.abs(turn)
        origin, angle = pairs_of(here - turn * near[over]), np.angle(turn)
        return {each[0]: Displacement(origin[k], angle[k]) for k, each in enumerate(axes)}

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
