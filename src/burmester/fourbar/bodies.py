"""A four-bar as bodies and joints."""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import GROUND, ORIGIN, Bodies, Joint, Limb, LinkPlaces, Slot

SIDES: Final = ("driver", "follower")


def bodies_of_four_bar(linkage: Linkage) -> Bodies:
    """The bodies of one linkage whose first dyad drives; not of PP dyads.

    A crank's x axis ends at the coupler.  The pin of a slider is a body of its own.
    """
    joints, tree = list[Joint](), list[Limb]()
    closures = list[tuple[Joint, str, str]]()
    for name, dyad in zip(SIDES, (linkage.first, linkage.second), strict=True):
        assert not isinstance(dyad, PP)
        drives, carries = name == "driver", isinstance(dyad, RP)
        if isinstance(dyad, RR):
            tip = np.array([float(dyad.radius), 0.0])
            pins = [Joint({GROUND: dyad.fixed_pivot, name: ORIGIN})]
            pins.append(Joint({"coupler": dyad.moving_pivot, name: tip}))
            tree.append(Limb(name, GROUND, pins[0]))
        else:
            normal, offset = float(dyad.normal_angle), float(dyad.offset)
            if isinstance(dyad, RP):
                slot = Slot("coupler", normal, offset, name, normal if drives else 0.0)
                pins = [Joint({GROUND: dyad.fixed_pivot}, slot)]
            else:
                slot = Slot(GROUND, normal, offset, name)
                pins = [Joint({"coupler": dyad.moving_pivot}, slot)]
            slides = not (carries and drives)
            tree.append(Limb(name, slot.link if slides else GROUND, pins[0], slides))
        joints += pins
        if drives:
            tree.append(Limb("coupler", name, pins[-1], carries))
        else:
            ends = (name, GROUND) if carries else ("coupler", name)
            closures.append((pins[-1], *ends))
    return Bodies(
        tuple(joints),
        {
            link: tuple(own)
            for link in (GROUND, "driver", "coupler", "follower")
            if (own := [each for each in joints if link in each.links])
        },
        ("driver", "coupler", "follower"),
        "coupler",
        "driver",
        tuple(tree),
        tuple(closures),
    )


def places_of_bodies(linkage: Linkage, places: Displacement) -> LinkPlaces:
    """Where the bodies of a four-bar are at places (*,) of its coupler.

    The pin of a slider has the angle of the ground, or of the slot of the coupler; where such a
    slot drives, of the normal of its line.
    """
    bodies = {GROUND: Displacement.identity(places.shape), "coupler": places}
    for name, dyad in zip(SIDES, (linkage.first, linkage.second), strict=True):
        if isinstance(dyad, RP):
            turn = dyad.normal_angle if name == "driver" else 0.0
            at, angle = dyad.fixed_pivot, places.angle + turn
        elif isinstance(dyad, PR):
            at, angle = places.act(dyad.moving_pivot), np.zeros(places.shape)
        else:
            assert isinstance(dyad, RR)
            arm = places.act(dyad.moving_pivot) - dyad.fixed_pivot
            at, angle = dyad.fixed_pivot, np.arctan2(arm[..., 1], arm[..., 0])
        bodies[name] = Displacement(np.broadcast_to(at, places.translation.shape), angle)
    return LinkPlaces(bodies)


def scaled_linkage(linkage: Linkage, scale: float) -> Linkage:
    """A linkage in another unit of length, `scale` of them for one; raises E163 for PP dyads."""
    return Linkage(scaled(linkage.first, scale), scaled(linkage.second, scale))


def scaled(dyad: Dyad, scale: float) -> RR | PR | RP:
    """A dyad in another unit of length, `scale` of them for one; raises E163 for a PP."""
    if isinstance(dyad, RR):
        return RR(dyad.fixed_pivot * scale, dyad.moving_pivot * scale, dyad.radius * scale)
    if isinstance(dyad, PR):
        return PR(dyad.normal_angle, dyad.offset * scale, dyad.moving_pivot * scale)
    if isinstance(dyad, RP):
        return RP(dyad.fixed_pivot * scale, dyad.normal_angle, dyad.offset * scale)
    assert isinstance(dyad, PP)
    raise InputError(
        "E163",
        "this linkage cannot be made of links with pins and slots",
        why="its body only translates, on two sliders of which one carries the other",
        help=Help.of("choose another linkage, or write this one as JSON: {}", Cure("to", "json")),
    )
