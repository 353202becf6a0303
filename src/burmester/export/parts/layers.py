"""Which layer each plate lies in, so that none is in the way of another along the motion.

Of the arrangements that a linkage has the first is taken in which no two links meet in one layer,
no pin is in a link's way, and the ground has room for its holes.  Where there is none, one link of
three corners is made an angle, so that pins have room between its arms.

E163 a linkage that plates cannot hold
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.parts.dimensions import WALL, Dimensions
from burmester.export.parts.links import Arrangement, Links
from burmester.export.parts.outlines import distances
from burmester.export.parts.plate import Pin, Plate, plate_of
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import GROUND, LinkPlaces
from burmester.numerics.arrays import FloatArray

CLEARANCE = 0.05  # of the width: least distance between plates of one layer


def arranged(links: Links, made: Dimensions) -> tuple[tuple[Plate, ...], tuple[Pin, ...]]:
    """The plates in the first arrangement in which nothing meets; raises E163."""
    ground, least = links.features[GROUND], made.hole * (1 + WALL)
    workshop = _Workshop(links, made)
    meetings = _Meetings(links.motion, made)
    near = [
        (one, two)
        for one, two in combinations(range(len(ground)), 2)
        if distances(ground[one], ground[two]) < least
    ]
    arrangements = [
        each
        for each in links.arrangements
        if all(each.grounds[one] != each.grounds[two] for one, two in near)
    ]
    for bent in workshop.bends():
        for each in arrangements:
            plates, pins = workshop.plates(each, bent), workshop.pins(each)
            if not meetings.any(plates, pins):
                return plates, pins
    raise InputError(
        "E163",
        "this linkage cannot be made of flat plates in layers",
        why="in whatever layers they lie, two links, or a link and a pin, meet along the motion",
        help=Help.of(
            "choose another linkage with {}, or narrower links with {}",
            Cure("linkage"),
            Cure("width"),
        ),
    )


class Bend(NamedTuple):
    """A link that is an angle, and the number of its corner."""

    link: str
    corner: int


class _Workshop:
    """Makes the plates and pins of arrangements; a plate that is made only changes its layer."""

    def __init__(self, links: Links, made: Dimensions) -> None:
        self._links = links
        self._made = made
        self._plates: dict[tuple[str, tuple[int, ...], int | None], Plate] = {}

    def bends(self) -> Iterator[Bend | None]:
        """Which link is an angle, and at which corner: none at first."""
        yield None
        for name, features in self._links.features.items():
            if name != GROUND:
                for corner in range(3):
                    bend = Bend(name, corner)
                    plate = self._plate(name, name, tuple(range(len(features))), 0, bend)
                    if plate.corner is not None:
                        yield bend

    def plates(self, arrangement: Arrangement, bent: Bend | None) -> tuple[Plate, ...]:
        """The plates, those of the ground first."""
        plates = []
        for name, features in self._links.features.items():
            if name != GROUND:
                held = tuple(range(len(features)))
                plates.append(self._plate(name, name, held, arrangement.layers[name], bent))
                continue
            for layer, plate in _grounds(arrangement).items():
                held = tuple(k for k, own in enumerate(arrangement.grounds) if own == layer)
                plates.append(self._plate(plate, name, held, layer, bent))
        return tuple(plates)

    def _plate(
        self, name: str, owner: str, held: tuple[int, ...], layer: int, bent: Bend | None
    ) -> Plate:
        links, made = self._links, self._made
        corner = bent.corner if bent is not None and bent.link == name else None
        if (name, held, corner) not in self._plates:
            fixed, moving = _arm(links, owner)
            self._plates[name, held, corner] = plate_of(
                [links.features[owner][k] for k in held],
                name=name,
                owner=owner,
                layer=layer,
                radius=made.width / 2,
                hole=made.hole,
                mark=owner == links.reference.body,
                fixed=fixed,
                moving=moving,
                corner=corner,
            )
        return replace(self._plates[name, held, corner], layer=layer)

    def pins(self, arrangement: Arrangement) -> tuple[Pin, ...]:
        """The pins, as long as the layers ask for."""
        pins, pivots = [], self._links.reference.links[GROUND]
        for joint in self._links.reference.joints:
            layers = dict(arrangement.layers)
            names = {each: each for each in self._links.features}
            if joint in pivots:
                layers[GROUND] = arrangement.grounds[pivots.index(joint)]
                names[GROUND] = _grounds(arrangement)[layers[GROUND]]
            low, high = sorted(layers[each] for each in joint.links)
            x, y = joint.holes[joint.holder].tolist()
            one, two = (names[each] for each in joint.links)
            pin = Pin(names[joint.holder], x, y, self._made.pin, low, high, (one, two), joint.name)
            pins.append(pin)
        return tuple(pins)


def _arm(links: Links, link: str) -> tuple[FloatArray | None, FloatArray | None]:
    """Both pivots, in F and in M, of a link that only joins the ground and the body."""
    body, joints = links.reference.body, links.reference.links[link]
    if link in (GROUND, body) or len(joints) != 2:
        return None, None
    near, far = joints
    if GROUND not in near.holes or body not in far.holes:
        return None, None
    return near.holes[GROUND], far.holes[body]


def _grounds(arrangement: Arrangement) -> dict[int, str]:
    """The names of the ground's plates by their layers."""
    low = min(arrangement.grounds)
    return {
        layer: GROUND if layer == low else f"{GROUND}-2"
        for layer in sorted(set(arrangement.grounds))
    }


class _Meetings:
    """Which plates of one layer, and which pins and plates that they do not join, ever meet.

    What was asked once is kept: links do not change from arrangement to arrangement.
    """

    def __init__(self, motion: LinkPlaces, made: Dimensions) -> None:
        self._motion = motion
        self._clear = CLEARANCE * made.width
        self._known: dict[tuple[object, ...], bool] = {}

    def any(self, plates: Sequence[Plate], pins: Sequence[Pin]) -> bool:
        """Whether anything meets."""
        return any(
            one.layer == two.layer and self._plates(one, two)
            for k, one in enumerate(plates)
            for two in plates[k + 1 :]
        ) or any(
            pin.low < plate.layer < pin.high
            and plate.name not in pin.joins
            and self._pin(pin, plate, plates)
            for pin in pins
            for plate in plates
        )

    def _plates(self, one: Plate, two: Plate) -> bool:
        key = (*_key(one), *_key(two))
        if key not in self._known:
            least = one.radius + two.radius + self._clear
            self._known[key] = self._near(one, one.pieces, two, least)
        return self._known[key]

    def _pin(self, pin: Pin, plate: Plate, plates: Sequence[Plate]) -> bool:
        key = (pin.x, pin.y, pin.plate, *_key(plate))
        if key not in self._known:
            holder = next(each for each in plates if each.name == pin.plate)
            least = pin.diameter / 2 + plate.radius + self._clear
            at = (np.array([[pin.x, pin.y]]),)
            self._known[key] = self._near(holder, at, plate, least)
        return self._known[key]

    def _near(self, one: Plate, shapes: Sequence[FloatArray], two: Plate, least: float) -> bool:
        """Whether shapes of one plate ever come nearer to the pieces of another than that."""
        here, there = one.at(self._motion), two.at(self._motion)
        return any(
            bool((distances(_placed(a, here), _placed(b, there)) < least).any())
            for a in shapes
            for b in two.pieces
        )


def _placed(points: FloatArray, places: Displacement) -> FloatArray:
    """Points (k, 2) at places (n,): (n, k, 2)."""
    return places[:, None].act(points[None])


def _key(plate: Plate) -> tuple[object, ...]:
    """What tells plates apart: the ground may be one plate or two, a link an angle."""
    return plate.name, len(plate.skeleton), plate.corner
