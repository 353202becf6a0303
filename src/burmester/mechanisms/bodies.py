"""A linkage of any kind as bodies and joints: what forces, models and drawings are made of.

Links are bodies with frames of their own.  A joint is a pin through holes of both links that it
joins, or along a slot of one of them.  Of a four-bar the links are ground, driver, coupler and
follower; those of other kinds have the names of their skeleton.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple, final, overload

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.mechanisms.skeleton import Frames, Skeleton
from burmester.numerics.arrays import FloatArray

GROUND: Final = "ground"
ORIGIN: Final = np.zeros(2)


@final
class LinkPlaces:
    """Where the frames of links are in F, at places (*,) of the motion: by the name of a link."""

    def __init__(self, of: Mapping[str, Displacement]) -> None:
        self._of = of

    @property
    def shape(self) -> tuple[int, ...]:
        """The axes of the places."""
        return next(iter(self._of.values())).shape

    @overload
    def __getitem__(self, key: str) -> Displacement: ...
    @overload
    def __getitem__(self, key: Any) -> LinkPlaces: ...
    def __getitem__(self, key: Any) -> Displacement | LinkPlaces:
        """The places (*,) of a link by its name, or some places of all links by their indices."""
        if isinstance(key, str):
            return self._of[key]
        return LinkPlaces({name: each[key] for name, each in self._of.items()})

    def scaled(self, scale: float) -> LinkPlaces:
        """The same in another unit of length, `scale` of them for one."""
        return LinkPlaces(
            {
                name: Displacement(each.translation * scale, each.angle)
                for name, each in self._of.items()
            }
        )


@final
class Slot(NamedTuple):
    """A straight slot, on whose line a pin slides.

    link: that has it.  normal, offset: of the line, in the frame of that link.
    pin: the name of the pin as a body of its own; turn: of its frame in that of the link.
    """

    link: str
    normal: float
    offset: float
    pin: str
    turn: float = 0.0

    @property
    def directions(self) -> tuple[FloatArray, FloatArray]:
        """The normal of the line, and the direction along it."""
        c, s = np.cos(self.normal), np.sin(self.normal)
        return np.array([c, s]), np.array([-s, c])

    def along(self, places: LinkPlaces) -> FloatArray:
        """How far (*,) along the line the pin is."""
        pin = places[self.link].inverse().act(places[self.pin].translation)
        return np.asarray(pin @ self.directions[1])


@final
@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """A pin that joins two links.

    holes: the centre (2,) of the hole of each link in its frame, that of the link that holds the
    pin first.  slot: in place of the hole of the other link.  name: where the joint has one.
    """

    holes: Mapping[str, FloatArray]
    slot: Slot | None = None
    name: str = ""

    @property
    def holder(self) -> str:
        """The link that holds the pin."""
        return next(iter(self.holes))

    @property
    def links(self) -> tuple[str, ...]:
        """Both links; where one is the ground, it is the first."""
        every = (*self.holes, self.slot.link) if self.slot else tuple(self.holes)
        return tuple(sorted(every, key=lambda link: link != GROUND))

    def scaled(self, scale: float) -> Joint:
        """The same in another unit of length."""
        holes = {link: at * scale for link, at in self.holes.items()}
        slot = self.slot and self.slot._replace(offset=self.slot.offset * scale)
        return Joint(holes, slot, self.name)

    def hole(self, body: str) -> FloatArray:
        """The pin (2,) in the frame of a body that has a hole, or of the pin itself."""
        return self.holes.get(body, ORIGIN)


@final
class Limb(NamedTuple):
    """A body on another one that is nearer to the ground, and the joint between them.

    slides: whether it slides on the other one; otherwise it turns.
    """

    body: str
    on: str
    joint: Joint
    slides: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Bodies:
    """The bodies of a linkage with one degree of freedom.

    joints: each once.  links: the joints of each link by its name, the ground first, in the order
    of its holes.
    moving: the names of all bodies that move: links, and the pins of sliders of a four-bar.
    body: the link whose frame is M.  driver: the body that drives.
    tree: the moving bodies, each behind the one that it is on; closures: the joints that close the
    loops that it leaves open, with both bodies.
    """

    joints: tuple[Joint, ...]
    links: Mapping[str, tuple[Joint, ...]]
    moving: tuple[str, ...]
    body: str
    driver: str
    tree: tuple[Limb, ...]
    closures: tuple[tuple[Joint, str, str], ...]

    def scaled(self, scale: float) -> Bodies:
        """The same in another unit of length, `scale` of them for one."""
        new = {id(each): each.scaled(scale) for each in self.joints}
        return replace(
            self,
            joints=tuple(new.values()),
            links={name: tuple(new[id(each)] for each in own) for name, own in self.links.items()},
            tree=tuple(each._replace(joint=new[id(each.joint)]) for each in self.tree),
            closures=tuple((new[id(joint)], one, two) for joint, one, two in self.closures),
        )

    def pins(self, places: LinkPlaces) -> list[FloatArray]:
        """Where the pins of the joints are in F, (*, 2) each, with the bodies at places (*,)."""
        return [places[joint.holder].act(joint.holes[joint.holder]) for joint in self.joints]


def bodies_of_skeleton(skeleton: Skeleton, frames: Frames, carries: str, pivot: str) -> Bodies:
    """The bodies of a mechanism with joints in the frames of its links, driven about a pivot."""
    plates = plate_names(skeleton)
    joints = {
        name: Joint(
            {plates[link]: frames[link][name] for link in skeleton.links_of(name)}, name=name
        )
        for name in skeleton.joints
    }
    return Bodies(
        tuple(joints.values()),
        {plates[link]: tuple(joints[at] for at in own) for link, own in skeleton.links.items()},
        tuple(plates[link] for link in skeleton.moving),
        plates[carries],
        plates[skeleton.crank(pivot)],
        tuple(Limb(plates[link], plates[on], joints[at]) for link, on, at in skeleton.tree),
        tuple((joints[at], plates[one], plates[two]) for at, one, two in skeleton.closures),
    )


def plate_names(skeleton: Skeleton) -> dict[str, str]:
    """What the links of a skeleton are called as bodies.

    A plate "body" would be taken for the frame M, which has that name in models.
    """
    return {
        link: "body-link" if link == "body" else link.replace(" ", "-") for link in skeleton.links
    }
