"""A linkage as plates with holes and slots, in layers on each other: what the formats draw and cut.

Everything here is in millimetres.

E162 dimensions that cannot be made        E163 a linkage that plates cannot hold
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from itertools import combinations
from typing import Any, Final, NamedTuple, final

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.options import Options, Reference, unit_of
from burmester.export.parts.dimensions import WALL, Dimensions, dimensions_of
from burmester.export.parts.links import Arrangement, Links
from burmester.export.parts.plate import Pin, Plate, plate_of
from burmester.export.parts.stock import stock_for
from burmester.geometry.displacement import Displacement
from burmester.geometry.shapes import distances
from burmester.mechanisms.bodies import GROUND, LinkPlaces
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate

CLEARANCE = 0.05  # of the width: least distance between plates of one layer


RING_SHARE: Final = 0.2  # of a hole's radius: band in which its facets are searched


@final
@dataclass(frozen=True, slots=True, eq=False)
class Assembly:
    """A linkage as plates and pins.

    reference: the linkage in millimetres; motion: where its links are along the stretch of the
    motion (n,) that holds the poses.  pins: in the order of its joints.
    unit: of the task's lengths; assumed: whether the task names none, nor the options, so that mm
    was taken.  pose: index of the place at which the assembly is drawn.
    """

    reference: Reference
    motion: LinkPlaces
    plates: tuple[Plate, ...]
    pins: tuple[Pin, ...]
    dimensions: Dimensions
    unit: str
    assumed: bool
    pose: int

    @property
    def body(self) -> str:
        """The link whose frame is M."""
        return self.reference.body

    @property
    def moving(self) -> tuple[str, ...]:
        """All bodies that move."""
        return self.reference.moving

    def plate(self, name: str) -> Plate | None:
        """The plate of a name, where there is one."""
        return next((each for each in self.plates if each.name == name), None)

    @property
    def drawn(self) -> LinkPlaces:
        """Where the links are in the drawing of the assembly."""
        return self.reference.at_poses[self.pose]


def assembly_of(chosen: Candidate, options: Options) -> Assembly:
    """The plates and pins of a linkage; raises E162 and E163."""
    unit, reference = unit_of(chosen, options), Reference.of(chosen, options)
    number = reference.places.shape[0]
    if not 1 <= options.pose <= number:
        raise InputError(
            "E162",
            f"there is no pose {options.pose} to draw",
            why=f"the task has {number} poses",
            help=Help.of(f"give {{}}, or another up to {number}", Cure("pose", 1)),
        )
    links = Links.of(reference)
    assumed = chosen.unit is None and options.unit is None
    stock = None if assumed else stock_for(unit)
    made = dimensions_of(links, options, reference.scale, unit, stock)
    plates, pins = arranged(links, made)
    return Assembly(reference, links.motion, plates, pins, made, unit, assumed, options.pose - 1)


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


@dataclass(frozen=True, slots=True)
class Pivot:
    """Where two plates are joined, on the plate of one of them.

    plates: the names of those of which one has it.  point: (2,) in F, the axis of a hole; or None,
    where line holds a slot: a normal (2,) and an offset in F, with both ends' axes on it.
    """

    plates: tuple[str, ...]
    point: FloatArray | None
    line: tuple[FloatArray, float] | None = None


def pivots_of(made: Assembly) -> list[Pivot]:
    """Where the linkage itself wants holes and slots of plates in the assembly; millimetres."""
    plates: dict[str, tuple[str, ...]] = {}
    for plate in made.plates:
        plates[plate.owner] = (*plates.get(plate.owner, ()), plate.name)
    found = list[Pivot]()
    for joint in made.reference.joints:
        point = made.drawn[joint.holder].act(joint.holes[joint.holder])
        found += [Pivot(plates[link], point) for link in joint.holes]
        if joint.slot is not None:
            place = made.drawn[joint.slot.link]
            normal = place.rotate(joint.slot.directions[0])
            offset = joint.slot.offset + float(normal @ place.translation)
            found.append(Pivot(plates[joint.slot.link], None, (normal, offset)))
    return found


def axes_of(part: Any, radius: float) -> FloatArray:
    """Where the axes (n, 2) of a part's hollow cylinders of a radius go through z = 0."""
    gp, adaptor = import_module("OCP.GeomAbs"), import_module("OCP.BRepAdaptor")
    centres = []
    for face in part.faces():
        surface = adaptor.BRepAdaptor_Surface(face.wrapped)
        if surface.GetType() != gp.GeomAbs_SurfaceType.GeomAbs_Cylinder:
            continue
        cylinder = surface.Cylinder()
        if abs(cylinder.Radius() - radius) > 1e-6 * radius:
            continue
        at, along = cylinder.Axis().Location(), cylinder.Axis().Direction()
        share = at.Z() / along.Z()
        centres.append((at.X() - share * along.X(), at.Y() - share * along.Y()))
    return np.reshape(np.array(centres), (-1, 2))


def axis_deviation(joint: Pivot, axes: FloatArray) -> float:
    """How far a joint's axis is from the nearest one centres; both of a slot from their line."""
    if joint.point is not None:
        away = np.linalg.norm(axes - joint.point, axis=1)
        return float(away.min()) if len(away) else math.inf
    assert joint.line is not None
    normal, offset = joint.line
    away = np.sort(np.abs(axes @ normal - offset))
    return float(away[1]) if len(away) > 1 else math.inf


def rim_deviation(joint: Pivot, points: FloatArray, radius: float) -> float:
    """How far the middle of a hole's rim, of points (n, 2) by least squares, is from its pivot.

    Of a slot, how far the sides that run along its line are from the radius, on both sides.
    """
    if joint.point is not None:
        from_pivot = points - joint.point
        near = np.abs(np.linalg.norm(from_pivot, axis=1) - radius) <= RING_SHARE * radius
        ring = np.unique(from_pivot[near], axis=0)
        if len(ring) < 8:
            return math.inf
        left = np.column_stack([2 * ring, np.ones(len(ring))])
        x, y, rest = np.linalg.lstsq(left, (ring**2).sum(axis=1), rcond=None)[0]
        return float(max(math.hypot(x, y), abs(math.sqrt(rest + x * x + y * y) - radius)))
    assert joint.line is not None
    normal, offset = joint.line
    across = points @ normal - offset
    sides = [np.abs(across - side) for side in (-radius, radius)]
    return float(max(np.sort(each)[3] for each in sides)) if len(points) >= 4 else math.inf
