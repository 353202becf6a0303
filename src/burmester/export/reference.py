"""The reference that every file is compared with: a linkage's links and joints in a unit.

Links are bodies with frames of their own; a joint is a pin through holes of both links that it
joins, or along a slot of one of them.  Of a four-bar the links are ground, driver, coupler and
follower; those of other classes have the names of their skeleton.

E160 the file does not contain the linkage        E163 a linkage that does not reach the poses
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, NamedTuple, Self, final, overload

import numpy as np
from numpy.typing import ArrayLike

from burmester.errors import BurmesterError, InputError
from burmester.export.options import MILLIMETRES, Options, unit_of
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.refinement.tolerance_boxes import poses_counted
from burmester.synthesis.result import Candidate
from burmester.verdicts.found_linkage import FoundLinkage

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

PRECISION = 1e-9  # of the span: the largest deviation of a file from the linkage
SIDES = ("driver", "follower")
GROUND: Final = "ground"
ORIGIN = np.zeros(2)


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


@final
@dataclass(frozen=True, slots=True, eq=False)
class Reference:
    """A linkage in a unit of length.

    dyads, found: its dimensions in that unit: of a four-bar, the driver first, or of another class.
    joints: each once.  links: the joints of each link by its name, the ground first, in the order
    of its holes.
    moving: the names of all bodies that move: links, and the pins of sliders of a four-bar.
    body: the link whose frame is M.  driver: the body that drives.
    tree: the moving bodies, each behind the one that it is on; closures: the joints that close the
    loops that it leaves open, with both bodies.
    at_poses: where the bodies are for the poses (N,); poses: (N,) of the task.
    span: diagonal of the box around all joints; scale: of this unit per unit of the task.
    """

    dyads: Linkage | None
    found: FoundSixBar | None
    joints: tuple[Joint, ...]
    links: Mapping[str, tuple[Joint, ...]]
    moving: tuple[str, ...]
    body: str
    driver: str
    tree: tuple[Limb, ...]
    closures: tuple[tuple[Joint, str, str], ...]
    at_poses: LinkPlaces
    poses: Displacement
    span: float
    scale: float

    @classmethod
    def of(cls, chosen: Candidate, options: Options, unit: str | None = "mm") -> Self:
        """The linkage in a unit, None for the task's own; raises E162, and E163 without places."""
        scale = 1.0
        if unit is not None:
            scale = MILLIMETRES[unit_of(chosen, options)] / MILLIMETRES[unit]
        if isinstance(chosen, FoundLinkage):
            return cls._of_dyads(chosen, scale)
        return cls._of_skeleton(chosen, scale)

    @classmethod
    def _of_dyads(cls, chosen: FoundLinkage, scale: float) -> Self:
        require_places(chosen)
        places, poses = (
            Displacement(each.translation * scale, each.angle)
            for each in (chosen.error.places, poses_counted(chosen.error.places, chosen.task))
        )
        dyads = [scaled(each, scale) for each in _dyads(chosen)]
        joints, tree = list[Joint](), list[Limb]()
        closures = list[tuple[Joint, str, str]]()
        for name, dyad in zip(SIDES, dyads, strict=True):
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
        linkage = Linkage(*dyads)
        at_poses = _bodies_at(linkage, places)
        points = [places.translation]
        for dyad in dyads:
            points += [] if isinstance(dyad, PR) else [dyad.fixed_pivot[None]]
            points += [] if isinstance(dyad, RP) else [places.act(dyad.moving_pivot)]
        return cls(
            linkage,
            None,
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
            at_poses,
            poses,
            _diagonal(points),
            scale,
        )

    @classmethod
    def _of_skeleton(cls, chosen: FoundSixBar, scale: float) -> Self:
        found, poses = chosen.scaled(scale), chosen.task.poses
        skeleton, frames = found.skeleton, found.frames
        # A plate "body" would be taken for the frame M, which has that name in models.
        plates = {
            link: "body-link" if link == "body" else link.replace(" ", "-")
            for link in skeleton.links
        }
        joints = {
            name: Joint(
                {plates[link]: frames[link][name] for link in skeleton.links_of(name)}, name=name
            )
            for name in skeleton.joints
        }
        at = found.joints(found.drive)
        at_poses = LinkPlaces(
            {plates[link]: each for link, each in skeleton.places(frames, at).items()}
        )
        return cls(
            None,
            found,
            tuple(joints.values()),
            {
                plates[link]: tuple(joints[name] for name in own)
                for link, own in skeleton.links.items()
            },
            tuple(plates[link] for link in skeleton.moving),
            plates[found.carries],
            plates[skeleton.crank(found.driver_pivot)],
            tuple(Limb(plates[link], plates[on], joints[at]) for link, on, at in skeleton.tree),
            tuple((joints[at], plates[one], plates[two]) for at, one, two in skeleton.closures),
            at_poses,
            Displacement(poses.translation * scale, poses.angle),
            _diagonal([found.body(found.drive).translation, *at.values()]),
            scale,
        )

    @property
    def places(self) -> Displacement:
        """Where the body is for the poses (N,)."""
        return self.at_poses[self.body]

    def bodies(self, drive: FloatArray, places: Displacement) -> LinkPlaces:
        """Where the bodies are when the driver is at (*,) and M at places (*,)."""
        if self.found is None:
            assert self.dyads is not None
            return _bodies_at(self.dyads, places)
        there = self.found.links(drive)
        return LinkPlaces(dict(zip(self.links, there.values(), strict=True)))

    def closure_error(self, places: LinkPlaces) -> float:
        """The largest misfit of a joint where the bodies are, in the unit of lengths."""
        worst = 0.0
        for joint in self.joints:
            pin = places[joint.holder].act(joint.holes[joint.holder])
            if joint.slot is not None:
                pin = places[joint.slot.link].inverse().act(pin)
                off = np.abs(pin @ joint.slot.directions[0] - joint.slot.offset)
            else:
                other = joint.links[1] if joint.links[0] == joint.holder else joint.links[0]
                off = np.linalg.norm(places[other].act(joint.holes[other]) - pin, axis=-1)
            worst = max(worst, float(off.max()))
        return worst


def _dyads(chosen: FoundLinkage) -> tuple[Dyad, Dyad]:
    return chosen.driver_first.first, chosen.driver_first.second


def _bodies_at(linkage: Linkage, places: Displacement) -> LinkPlaces:
    """The bodies of a four-bar at places (*,) of its coupler: a crank's x axis ends at the coupler.

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


def _diagonal(points: list[FloatArray]) -> float:
    return math.hypot(*np.ptp(np.concatenate(points), axis=0).tolist())


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
        help="choose another linkage, or write this one as JSON: --to json",
    )


def require_places(chosen: FoundLinkage) -> None:
    """Raise E163 where the linkage cannot be put together near some pose."""
    places = chosen.error.places
    missing = ~(np.isfinite(places.angle) & np.isfinite(places.translation).all(axis=-1))
    if missing.any():
        raise InputError(
            "E163",
            f"linkage {chosen.id} has no place for pose {missing.argmax() + 1}",
            why="its links cannot be put together near that pose",
            help="choose another linkage, one that is usable, with --linkage",
        )


def require_equal(what: str, got: ArrayLike, expected: ArrayLike, tolerance: float) -> None:
    """Raise E160 where numbers read from a file are not those of the linkage."""
    one, two = np.asarray(got, dtype=np.float64), np.asarray(expected, dtype=np.float64)
    if one.shape != two.shape:
        off: float | str = f"{one.shape} numbers where {two.shape} belong"
    else:
        gap = float(np.abs(one - two).max()) if one.size else 0.0
        if gap <= tolerance:
            return
        off = f"off by {gap:.3g}, more than {tolerance:.3g}"
    raise fault(f"{what}: {off}")


def fault(
    why: str, message: str = "the written file does not contain the linkage, so it was deleted"
) -> BurmesterError:
    """The error E160 of a file that is not what was to be written."""
    help = "this is a fault of burmester: report it, with the result file"
    return BurmesterError("E160", message, why=why, help=help)


def as_rows(places: Displacement) -> FloatArray:
    """Places (*,) as rows (*, 4): x, y, and the cosine and sine of their angles."""
    return np.concatenate(
        [places.translation, np.cos(places.angle)[..., None], np.sin(places.angle)[..., None]],
        axis=-1,
    )
