"""Which layer each plate lies in, so that none is in the way of another along the motion.

Of the arrangements that a linkage has the first is taken in which no two links meet in one layer,
no pin is in a link's way, and the ground has room for its holes.

E163 a linkage that plates cannot hold
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from burmester.errors import InputError
from burmester.export.parts.dimensions import WALL, Dimensions
from burmester.export.parts.distances import distance, distances
from burmester.export.parts.links import GROUND, Arrangement, LinkPlaces, Links
from burmester.export.parts.plate import Pin, Plate, plate_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["arranged"]

CLEARANCE = 0.05  # of the width: least distance between plates of one layer


def arranged(links: Links, made: Dimensions) -> tuple[tuple[Plate, ...], tuple[Pin, ...]]:
    """The plates in the first arrangement in which nothing meets; raises E163."""
    apart = distance(*links.features[GROUND]) >= made.hole * (1 + WALL)
    workshop = _Workshop(links, made)
    meetings = _Meetings(links.motion, made)
    for each in links.arrangements:
        if len(set(each.grounds)) == 1 and not apart:
            continue
        plates, pins = workshop.plates(each), workshop.pins(each)
        if not meetings.any(plates, pins):
            return plates, pins
    raise InputError(
        "E163",
        "this linkage cannot be made of flat plates in layers",
        why="in whatever layers they lie, two links, or a link and a pin, meet along the motion",
        help="choose another linkage with --linkage, or narrower links with --width",
    )


class _Workshop:
    """Makes the plates and pins of arrangements; a plate that is made only changes its layer."""

    def __init__(self, links: Links, made: Dimensions) -> None:
        self._links = links
        self._made = made
        self._plates: dict[tuple[str, tuple[int, ...]], Plate] = {}

    def plates(self, arrangement: Arrangement) -> tuple[Plate, ...]:
        """The plates, those of the ground first."""
        plates = []
        for name, features in self._links.features.items():
            if name != GROUND:
                held = tuple(range(len(features)))
                plates.append(self._plate(name, name, held, arrangement.layers[name]))
                continue
            for layer, plate in _grounds(arrangement).items():
                held = tuple(k for k, own in enumerate(arrangement.grounds) if own == layer)
                plates.append(self._plate(plate, name, held, layer))
        return tuple(plates)

    def _plate(self, name: str, owner: str, held: tuple[int, ...], layer: int) -> Plate:
        links, made = self._links, self._made
        if (name, held) not in self._plates:
            fixed, moving = links.arms.get(owner, (None, None))
            self._plates[name, held] = plate_of(
                [links.features[owner][k] for k in held],
                name=name,
                owner=owner,
                layer=layer,
                radius=made.width / 2,
                hole=made.hole,
                mark=owner == links.body,
                fixed=fixed,
                moving=moving,
            )
        return replace(self._plates[name, held], layer=layer)

    def pins(self, arrangement: Arrangement) -> tuple[Pin, ...]:
        """The pins, as long as the layers ask for."""
        pins = []
        for holder, at, joins, on_ground, name in self._links.hinges:
            layers = dict(arrangement.layers)
            names = {each: each for each in self._links.features}
            if on_ground is not None:
                layers[GROUND] = arrangement.grounds[on_ground]
                names[GROUND] = _grounds(arrangement)[layers[GROUND]]
            low, high = sorted(layers[each] for each in joins)
            x, y = at.tolist()
            joined = (names[joins[0]], names[joins[1]])
            pins.append(Pin(names[holder], x, y, self._made.pin, low, high, joined, name))
        return tuple(pins)


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
            first, second = self._placed(one.skeleton, one), self._placed(two.skeleton, two)
            gap = distances(first, second)
            self._known[key] = bool((gap < one.radius + two.radius + self._clear).any())
        return self._known[key]

    def _pin(self, pin: Pin, plate: Plate, plates: Sequence[Plate]) -> bool:
        key = (pin.x, pin.y, pin.plate, *_key(plate))
        if key not in self._known:
            holder = next(each for each in plates if each.name == pin.plate)
            at = self._placed(np.array([[pin.x, pin.y]]), holder)
            gap = distances(at, self._placed(plate.skeleton, plate))
            least = pin.diameter / 2 + plate.radius + self._clear
            self._known[key] = bool((gap < least).any())
        return self._known[key]

    def _placed(self, points: FloatArray, plate: Plate) -> FloatArray:
        """Points (k, 2) of a plate along the motion (n,): (n, k, 2)."""
        places: Displacement = plate.at(self._motion)
        return places[:, None].act(points[None])


def _key(plate: Plate) -> tuple[str, int]:
    """What tells plates apart: the ground may be one plate or two."""
    return plate.name, len(plate.skeleton)
