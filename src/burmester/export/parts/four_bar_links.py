"""The links of a four-bar: holes and slots of ground, driver, coupler and follower; millimetres.

Layers: 0 is the ground, each further one lies on the one before.  A link hangs on its neighbours by
pins.  The last arrangement has a second ground above, so that pins are short and nothing meets.

E163 a linkage that plates cannot hold
"""

from __future__ import annotations

import numpy as np

from burmester.errors import InputError
from burmester.export.parts.distances import distance
from burmester.export.parts.links import GROUND, Arrangement, Hinge, LinkPlaces, Links, Spacing
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["FOUR_BAR_LINKS", "four_bar_links", "scaled"]

MOTION_SAMPLES = 721  # places along the motion at which plates are compared
SIDES = ("driver", "follower")
FOUR_BAR_LINKS = ("driver", "coupler", "follower")


def four_bar_links(linkage: Linkage, places: Displacement) -> Links:
    """The links of a four-bar whose coupler goes through places (N,); raises E163."""
    first, second = linkage.first, linkage.second
    assert not isinstance(first, PP)
    assert not isinstance(second, PP)
    motion = _places_of_motion(linkage, places)
    dyads = (first, second)
    reach = [_reach(each, motion) for each in dyads]
    ground = [_feature(each, end, PR) for each, end in zip(dyads, reach, strict=True)]
    coupler = [_feature(each, end, RP) for each, end in zip(dyads, reach, strict=True)]
    features: dict[str, list[FloatArray]] = {GROUND: ground}
    hinges = list[Hinge]()
    for k, (name, dyad) in enumerate(zip(SIDES, dyads, strict=True)):
        if isinstance(dyad, RR):
            features[name] = [np.zeros((1, 2)), np.array([[float(dyad.radius), 0.0]])]
            hinges.append(Hinge(GROUND, dyad.fixed_pivot, (GROUND, name), k))
            hinges.append(Hinge("coupler", dyad.moving_pivot, ("coupler", name)))
        elif isinstance(dyad, PR):
            hinges.append(Hinge("coupler", dyad.moving_pivot, (GROUND, "coupler"), k))
        else:
            hinges.append(Hinge(GROUND, dyad.fixed_pivot, (GROUND, "coupler"), k))
        if not k:
            features["coupler"] = coupler
    arms = {
        name: (dyad.fixed_pivot, dyad.moving_pivot)
        for name, dyad in zip(SIDES, dyads, strict=True)
        if isinstance(dyad, RR)
    }
    spacings = [
        Spacing(
            f"the {name}'s link's two holes",
            f"the {name}'s link has no length",
            float(dyad.radius),
        )
        for name, dyad in zip(SIDES, dyads, strict=True)
        if isinstance(dyad, RR)
    ]
    fault = "both joints of the coupler are at one point of it: a slot runs through them"
    near = distance(*coupler)
    spacings.append(Spacing("two joints of the coupler", fault, near))
    middles = [each.mean(axis=0) for each in ground]
    lengths = [float(each.radius) for each in dyads if isinstance(each, RR)]
    lengths += [near, float(np.linalg.norm(middles[1] - middles[0]))]
    lengths += [float(np.linalg.norm(each[1] - each[0])) for each in reach if each is not None]
    return Links(
        features,
        tuple(hinges),
        _frames(places, arms),
        _frames(motion, arms),
        "coupler",
        FOUR_BAR_LINKS,
        arms,
        tuple(lengths),
        tuple(spacings),
        _arrangements([isinstance(each, RR) for each in dyads]),
    )


def _frames(places: Displacement, arms: dict[str, tuple[FloatArray, FloatArray]]) -> LinkPlaces:
    """The frames of links at places (*,) of the coupler: a crank's x axis ends at the coupler."""
    frames = {GROUND: Displacement.identity(places.shape), "coupler": places}
    for name, (fixed, moving) in arms.items():
        arm = places.act(moving) - fixed
        pivot = np.broadcast_to(fixed, arm.shape)
        frames[name] = Displacement(pivot, np.arctan2(arm[..., 1], arm[..., 0]))
    return LinkPlaces(frames)


def _arrangements(links: list[bool]) -> list[Arrangement]:
    """The layers that are tried; links: whether each side has a link of its own."""
    if all(links):
        tries = [((1, 1), (0, 0)), ((1, 3), (0, 0)), ((1, 3), (0, 4))]
    elif links[0]:
        tries = [((1, 0), (0, 0)), ((1, 0), (0, 3))]
    elif links[1]:
        tries = [((0, 1), (0, 0)), ((0, 1), (3, 0))]
    else:
        tries = [((0, 0), (0, 0)), ((0, 0), (0, 2))]
    coupler = 2 if any(links) else 1
    return [
        Arrangement({**dict(zip(SIDES, layers, strict=True)), "coupler": coupler}, grounds)
        for layers, grounds in tries
    ]


def _feature(dyad: RR | PR | RP, reach: FloatArray | None, slotted: type) -> FloatArray:
    """A dyad's hole, centre (1, 2), or slot, ends (2, 2): on the ground if `slotted` is PR."""
    if isinstance(dyad, slotted):
        assert reach is not None
        return reach
    pivot = dyad.fixed_pivot if slotted is PR else dyad.moving_pivot  # type: ignore[union-attr]
    return pivot[None]


def _reach(dyad: RR | PR | RP, motion: Displacement) -> FloatArray | None:
    """Both ends (2, 2) of what a slider's pin travels along its line."""
    if isinstance(dyad, RR):
        return None
    if isinstance(dyad, PR):
        points = motion.act(dyad.moving_pivot)
    else:
        points = motion.inverse().act(dyad.fixed_pivot)
    n = np.array([np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)])
    along = np.array([-n[1], n[0]])
    s = points @ along
    return np.asarray(n * dyad.offset + np.stack([s.min(), s.max()])[:, None] * along)


def scaled(dyad: Dyad, scale: float) -> RR | PR | RP:
    """A dyad with its lengths multiplied by a scale; raises E163 for a PP."""
    if isinstance(dyad, RR):
        return RR(dyad.fixed_pivot * scale, dyad.moving_pivot * scale, dyad.radius * scale)
    if isinstance(dyad, PR):
        return PR(dyad.normal_angle, dyad.offset * scale, dyad.moving_pivot * scale)
    if isinstance(dyad, RP):
        return RP(dyad.fixed_pivot * scale, dyad.normal_angle, dyad.offset * scale)
    assert isinstance(dyad, PP)
    raise InputError(
        "E163",
        "this linkage cannot be made of plates with pins and slots",
        why="its body only translates, on two sliders of which one carries the other",
        help="choose another linkage, or a table of its places: --to csv",
    )


def _places_of_motion(
    linkage: Linkage, places: Displacement, looks: int = MOTION_SAMPLES
) -> Displacement:
    """Coupler places (n,) along each branch of a circuit from its first to its last of places (N,).

    The places themselves are among them, in their order along the way.  Whole turns are cut where
    the places leave the widest gap.
    """
    circuits = Circuits.of(linkage, as_given=True)
    here = circuit_of(linkage, places, as_given=True)
    rows: list[FloatArray] = []
    on = np.isfinite(here.parameter) & (here.circuit >= 0)
    for circuit, branch in sorted(set(zip(here.circuit[on], here.branch[on], strict=True))):
        own = circuits[int(circuit)]
        which = on & (here.circuit == circuit) & (here.branch == branch)
        s = here.parameter[which]
        if own.closed and own.branches == 1:
            order = np.sort(s % (2 * np.pi))
            gap = np.append(order[1:], order[0] + 2 * np.pi) - order
            cut = order[(int(gap.argmax()) + 1) % len(order)]
            s = cut + (s - cut) % (2 * np.pi)
        s = np.unique(np.concatenate([np.linspace(s.min(), s.max(), looks), s]))
        with np.errstate(invalid="ignore", divide="ignore"):
            along = own.couplers(s)
        rows.append(np.column_stack([along.translation, along.angle]))
    rows.append(np.column_stack([places.translation, places.angle]))
    table = np.concatenate(rows if len(rows) == 1 else rows[:-1])
    return Displacement.from_poses(table[np.isfinite(table).all(axis=1)])
