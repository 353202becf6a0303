"""Which layer each plate lies in, so that none is in the way of another along the motion.

Layers: 0 is the ground, each further one lies on the one before.  A link hangs on its neighbours
by pins.  Where two links would meet in one layer, or a pin would be in a link's way, the next
arrangement is taken; the last of them has a second ground above, so that pins are short.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from burmester.export.parts.dimensions import WALL, Dimensions
from burmester.export.parts.distances import distance, distances
from burmester.export.parts.features import Features
from burmester.export.parts.plate import Owner, Pin, Plate, plate_of
from burmester.fourbar.dyad import PR, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["arranged"]

CLEARANCE = 0.05  # of the width: least distance between plates of one layer


def arranged(features: Features, made: Dimensions) -> tuple[tuple[Plate, ...], tuple[Pin, ...]]:
    """The plates in the first arrangement in which nothing meets."""
    links = [isinstance(dyad, RR) for dyad in features.dyads]
    apart = distance(*features.of_link("ground")) >= made.hole * (1 + WALL)
    coupler = 2 if any(links) else 1
    # (layer of the first link, of the second, of the ground that each hangs on)
    tries: list[tuple[int, int, int, int]] = []
    if all(links):
        tries = [(1, 1, 0, 0), (1, 3, 0, 0), (1, 3, 0, 4)]
    elif links[0]:
        tries = [(1, 0, 0, 0), (1, 0, 0, 3)]
    elif links[1]:
        tries = [(0, 1, 0, 0), (0, 1, 3, 0)]
    else:
        tries = [(0, 0, 0, 0), (0, 0, 0, 2)]
    for number, (one, two, under, over) in enumerate(tries):
        plates, pins = _built(features, made, coupler, (one, two), (under, over))
        one_ground = under == over
        if number == len(tries) - 1:
            break
        if one_ground and not apart:
            continue
        if not _meet(plates, pins, features.motion, made):
            break
    return plates, pins


def _built(
    features: Features,
    made: Dimensions,
    coupler_layer: int,
    links: tuple[int, int],
    grounds: tuple[int, int],
) -> tuple[tuple[Plate, ...], tuple[Pin, ...]]:
    """The plates and pins with these layers of the links, and of the grounds they hang on."""
    radius, hole = made.width / 2, made.hole
    on_ground, on_coupler = features.of_link("ground"), features.of_link("coupler")
    plates: list[Plate] = []
    pins: list[Pin] = []
    names = {layer: "ground" if layer == 0 else "ground-2" for layer in grounds}
    for layer in sorted(names):
        own = [each for each, of in zip(on_ground, grounds, strict=True) if of == layer]
        plates.append(
            plate_of(own, name=names[layer], owner="ground", layer=layer, radius=radius, hole=hole)
        )
    for k, (dyad, layer) in enumerate(zip(features.dyads, links, strict=True)):
        name: Owner = "follower" if k else "driver"
        ground = names[grounds[k]]
        if isinstance(dyad, RR):
            far = np.array([[float(dyad.radius), 0.0]])
            plates.append(
                plate_of(
                    [np.zeros((1, 2)), far],
                    name=name,
                    owner=name,
                    layer=layer,
                    radius=radius,
                    hole=hole,
                    fixed=dyad.fixed_pivot,
                    moving=dyad.moving_pivot,
                )
            )
            x, y = dyad.fixed_pivot.tolist()
            span = sorted((grounds[k], layer))
            pins.append(Pin(ground, x, y, made.pin, span[0], span[1], (ground, name)))
            x, y = dyad.moving_pivot.tolist()
            span = sorted((coupler_layer, layer))
            pins.append(Pin("coupler", x, y, made.pin, span[0], span[1], ("coupler", name)))
        else:
            span = sorted((grounds[k], coupler_layer))
            on = "coupler" if isinstance(dyad, PR) else ground
            x, y = (dyad.moving_pivot if isinstance(dyad, PR) else dyad.fixed_pivot).tolist()
            pins.append(Pin(on, x, y, made.pin, span[0], span[1], (ground, "coupler")))
    body = plate_of(
        on_coupler,
        name="coupler",
        owner="coupler",
        layer=coupler_layer,
        radius=radius,
        hole=hole,
        mark=True,
    )
    plates.append(body)
    order = ["ground", "ground-2", "driver", "coupler", "follower"]
    return tuple(sorted(plates, key=lambda each: order.index(each.name))), tuple(pins)


def _meet(
    plates: Sequence[Plate], pins: Sequence[Pin], motion: Displacement, made: Dimensions
) -> bool:
    """Whether two plates of one layer, or a pin and a plate that it does not join, ever meet."""
    bodies = {each.name: each.at(motion) for each in plates}
    clear = CLEARANCE * made.width
    for k, one in enumerate(plates):
        for two in plates[k + 1 :]:
            if one.layer == two.layer:
                gap = distances(
                    _placed(one.skeleton, bodies[one.name]), _placed(two.skeleton, bodies[two.name])
                )
                if (gap < one.radius + two.radius + clear).any():
                    return True
    for pin in pins:
        at = _placed(np.array([[pin.x, pin.y]]), bodies[pin.plate])
        for plate in plates:
            if plate.name not in pin.joins and pin.low < plate.layer < pin.high:
                gap = distances(at, _placed(plate.skeleton, bodies[plate.name]))
                if (gap < pin.diameter / 2 + plate.radius + clear).any():
                    return True
    return False


def _placed(points: FloatArray, places: Displacement) -> FloatArray:
    """Points (k, 2) at places (n,): (n, k, 2)."""
    return places[:, None].act(points[None])
