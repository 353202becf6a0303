"""Watt's first six-bar: two cranks on the ground, a coupler between them, and the body beyond.

Seven joints and six links, of which two hold three joints each and meet at one of them, D:

    ground         A, B        first crank    A, C        coupler     C, D, E
    second crank   B, D, G     floating link  G, H        body        E, H

A to D are a four-bar.  Its coupler carries the body at E, its second crank holds it by the link
from G to H: D, E, H, G are a loop of four again (Soh and McCarthy 2008; the names of the joints
are ours).

The first loop locks as a four-bar does.  The second moves by the angle at D between the coupler and
the second crank, which is a function of the first loop alone.  It locks where EG is as long as the
floating link and the body's EH together, or as their difference: at two angles at D with two signs
each, which the first loop has at two drives each.  So there are at most eight dead points of the
second loop beside at most two of the first, and between two that follow each other nothing locks.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Final, NamedTuple, final

import numpy as np

from burmester.mechanisms.circles import arccos_or_nan, meeting, side_of
from burmester.mechanisms.contract import Locked, drive_of
from burmester.mechanisms.four_bar_loop import FourBarLoop
from burmester.mechanisms.skeleton import Frames, Skeleton, distance, seen_along
from burmester.numerics.arrays import ComplexArray, FloatArray, Indexed, complex_of


class Sides(NamedTuple):
    """On which side both loops are closed, +1 or -1 each: (*,).

    first: of the joint of the first loop that the driver does not carry (D from C, where the first
    crank drives; C from D, where the second does); second: of H, seen from G to E.
    """

    first: FloatArray
    second: FloatArray


def joints_at(
    linkage: WattLinkage, drive: FloatArray, sides: Sides, driver: str, *, closed: bool = False
) -> ComplexArray:
    """The joints (*, 7) of linkages (*,) whose driver stands at an angle (*,), in radians, in F.

    In the order of the skeleton; nan where a loop cannot be closed.
    closed: whether all are known to close, but for rounding.
    """
    a, b = complex_of(linkage.fixed_first), complex_of(linkage.fixed_second)
    at_d, at_g = complex_of(linkage.coupler_joint), complex_of(linkage.crank_joint)
    if driver == "A":
        c = a + linkage.first_crank * np.exp(1j * drive)
        d = meeting(c, np.abs(at_d), b, linkage.second_crank, sides.first, closed=closed)
    else:
        d = b + linkage.second_crank * np.exp(1j * drive)
        c = meeting(d, np.abs(at_d), a, linkage.first_crank, sides.first, closed=closed)
    e = c + (d - c) / at_d * linkage.coupler_arm
    g = b + (d - b) / linkage.second_crank * at_g
    body = np.abs(complex_of(linkage.link_joint) - complex_of(linkage.body_joint))
    h = meeting(g, linkage.floating_link, e, body, sides.second, closed=closed)
    return np.stack(np.broadcast_arrays(a, b, c, d, e, g, h), axis=-1)


def sides_of(joints: ComplexArray, driver: str) -> Sides:
    """On which side the loops are closed where the joints are (*, 7)."""
    a, b, c, d, e, g, h = np.moveaxis(joints, -1, 0)
    first = side_of(d, c, b) if driver == "A" else side_of(c, d, a)
    return Sides(first, side_of(h, g, e))


OF_FIRST_LOOP = 4  # dead points of the first loop; those of the second follow them


def dead_points(linkage: WattLinkage, sides: Sides, driver: str) -> FloatArray:
    """The drives at which linkages (*,) lock on their branch: (*, 12), nan where there is none.

    Formula `second-loop` of the theory.
    sides: of the branch, which is that of the first loop; the second locks where its two sides
    meet.
    """
    loop = first_loop(linkage)
    e, g = _arms(linkage)
    body = np.abs(complex_of(linkage.link_joint) - complex_of(linkage.body_joint))
    link = linkage.floating_link
    reach = np.stack([body + link, np.abs(body - link)], axis=-1)
    between = arccos_or_nan(np.abs(e), np.abs(g), reach)
    offset = np.angle(e / g)[..., None]
    joints = loop.with_angle(np.concatenate([offset + between, offset - between], axis=-1))
    second = _drives_on_branch(joints, sides, driver)
    return np.concatenate([loop.locked(first=driver == "A"), second], axis=-1)


def dead_places(linkage: WattLinkage, driver: str) -> ComplexArray:
    """The joints (m, 7) at all dead points of one linkage."""
    out = []
    for first in (1.0, -1.0):
        sides = Sides(np.array(first), np.ones(()))
        drives = dead_points(linkage, sides, driver)
        own, other = drives[:OF_FIRST_LOOP], drives[OF_FIRST_LOOP:]
        if first > 0:  # both sides of the first loop meet there
            out += [
                joints_at(linkage, own, Sides(np.zeros(()), np.array(k)), driver) for k in (1, -1)
            ]
        out.append(joints_at(linkage, other, Sides(sides.first, np.zeros(())), driver))
    joints = np.concatenate(out)
    return joints[np.isfinite(joints).all(axis=-1)]


def first_loop(linkage: WattLinkage) -> FourBarLoop:
    """The loop A, C, D, B of linkages (*,)."""
    a, b = complex_of(linkage.fixed_first), complex_of(linkage.fixed_second)
    coupler = np.abs(complex_of(linkage.coupler_joint))
    return FourBarLoop.of(a, b, linkage.first_crank, coupler, linkage.second_crank)


def turning_points(linkage: WattLinkage, sides: Sides, driver: str) -> FloatArray:
    """The drives at which a transmission angle of linkages (*,) may be least: (*, 10), or nan.

    Formula `second-loop-turns` of the theory.
    Those at which the driver is in line with the ground, so that the first loop's diagonal turns
    back; those at which the first crank is, so that the angle at D does; and those at which the
    angle in the second loop between DE and DG passes zero or half a turn.
    """
    loop = first_loop(linkage)
    e, g = _arms(linkage)
    way, offset = np.angle(loop.direction)[..., None], np.angle(e / g)[..., None]
    diagonal = loop.with_angle(np.concatenate([offset, offset + np.pi], axis=-1))
    joints = np.concatenate([loop.with_straight_crank(), diagonal], axis=-2)
    inside = _drives_on_branch(joints, sides, driver)
    return np.concatenate([way, way + np.pi, inside], axis=-1)


def _arms(linkage: WattLinkage) -> tuple[ComplexArray, ComplexArray]:
    """DE as DC sees it, and DG as DB sees it: (*,) each.

    Turned by the angle at D from DC to DB, the second is as DC sees it.
    """
    d, g = complex_of(linkage.coupler_joint), complex_of(linkage.crank_joint)
    return (d - linkage.coupler_arm) * np.abs(d) / d, linkage.second_crank - g


def _drives_on_branch(joints: ComplexArray, sides: Sides, driver: str) -> FloatArray:
    """The drives (*, k) of first loops (*, k, 4) that are closed on a branch's side; else nan."""
    whole = np.concatenate([joints, joints[..., :3]], axis=-1)  # the second loop is not asked
    with np.errstate(invalid="ignore"):
        same = sides_of(whole, driver).first == sides.first[..., None]
    return np.where(same, drive_of(WATT_I, whole, driver), np.nan)


WATT_I: Final = Skeleton(
    "Watt I six-bar",
    "ABCDEGH",
    {
        "ground": "AB",
        "first crank": "AC",
        "coupler": "CDE",
        "second crank": "BDG",
        "floating link": "GH",
        "body": "EH",
    },
    drivers="AB",
    along={"coupler": "CE"},
)


@final
@dataclass(frozen=True, slots=True, eq=False)
class WattLinkage(Indexed):
    """Six-bars of Watt's first kind, one or many: leading axes are theirs.

    Attributes
    ----------
    fixed_first, fixed_second : (*, 2) array
        A and B, in F.
    first_crank : (*,) array
        The distance from A to C.
    coupler_arm : (*,) array
        The distance from C to E; the coupler's frame has its origin at C, and E on its x axis.
    coupler_joint : (*, 2) array
        D, in the coupler's frame.
    second_crank : (*,) array
        The distance from B to D; the second crank's frame has its origin at B, and D on its x axis.
    crank_joint : (*, 2) array
        G, in the second crank's frame.
    floating_link : (*,) array
        The distance from G to H.
    body_joint, link_joint : (*, 2) array
        E and H, in M.

    Lengths are in the task's unit.
    """

    skeleton: ClassVar[Skeleton] = WATT_I
    carries: ClassVar[str] = "body"
    loops: ClassVar[int] = 2
    generator: ClassVar[str] = "A"

    fixed_first: FloatArray
    fixed_second: FloatArray
    first_crank: FloatArray
    coupler_arm: FloatArray
    coupler_joint: FloatArray
    second_crank: FloatArray
    crank_joint: FloatArray
    floating_link: FloatArray
    body_joint: FloatArray
    link_joint: FloatArray

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes: () for one linkage."""
        return self.first_crank.shape

    def frames(self) -> Frames:
        """The joints (*, 2) of each link, in the frame of that link: {"coupler": {"C": ...}}."""
        origin = np.zeros((*self.shape, 2))
        ends = (self.first_crank, self.coupler_arm, self.second_crank, self.floating_link)
        to_c, to_e, to_d, to_h = (np.stack([x, np.zeros_like(x)], axis=-1) for x in ends)
        return {
            "ground": {"A": self.fixed_first, "B": self.fixed_second},
            "first crank": {"A": origin, "C": to_c},
            "coupler": {"C": origin, "D": self.coupler_joint, "E": to_e},
            "second crank": {"B": origin, "D": to_d, "G": self.crank_joint},
            "floating link": {"G": origin, "H": to_h},
            "body": {"E": self.body_joint, "H": self.link_joint},
        }

    @classmethod
    def of(cls, carries: str, frames: Frames) -> WattLinkage:
        """The six-bar whose links have joints (*, 2) in their frames, those of no body in any."""
        coupler, crank, body = (frames[name] for name in ("coupler", "second crank", carries))
        return cls(
            fixed_first=frames["ground"]["A"],
            fixed_second=frames["ground"]["B"],
            first_crank=distance(frames["first crank"], "AC"),
            coupler_arm=distance(coupler, "CE"),
            coupler_joint=seen_along(coupler, "CE", "D"),
            second_crank=distance(crank, "BD"),
            crank_joint=seen_along(crank, "BD", "G"),
            floating_link=distance(frames["floating link"], "GH"),
            body_joint=body["E"],
            link_joint=body["H"],
        )

    def lengths(self) -> FloatArray:
        """The distances between joints of one link, in the order of its bars: (*, 10)."""
        a, b = complex_of(self.fixed_first), complex_of(self.fixed_second)
        d, g = complex_of(self.coupler_joint), complex_of(self.crank_joint)
        body = complex_of(self.link_joint) - complex_of(self.body_joint)
        arm, crank = self.coupler_arm, self.second_crank
        bars = abs(b - a), self.first_crank, abs(d), abs(arm - d), arm, crank, abs(g - crank)
        return np.stack([*bars, abs(g), self.floating_link, abs(body)], axis=-1)

    def generated(
        self, angle: FloatArray, sides: FloatArray, *, closed: bool = False
    ) -> ComplexArray:
        """The joints (*, 7) at angles (*,) of the first crank, on sides (*, 2)."""
        return joints_at(self, angle, Sides(sides[..., 0], sides[..., 1]), "A", closed=closed)

    def generator_angle(self, joints: ComplexArray) -> FloatArray:
        """The first crank's angle (*,) where the joints are (*, 7)."""
        return drive_of(WATT_I, joints, "A")

    def locked(self, sides: FloatArray) -> Locked:
        """Where one linkage locks for the first crank, on sides (2,)."""
        angle = dead_points(self, Sides(sides[0], sides[1]), "A")
        return Locked(angle, (np.arange(len(angle)) >= OF_FIRST_LOOP).astype(np.intp))

    def still(self, pivot: str) -> ComplexArray:
        """The joints (m, 7) of one linkage at all dead points of a driver."""
        return dead_places(self, pivot)

    @staticmethod
    def driver_name(pivot: str) -> str:
        """A driver as results name it."""
        return "first" if pivot == "A" else "second"

    def why_open(self) -> str:
        """Why one linkage that is open everywhere cannot be assembled, in words."""
        loop = first_loop(self)
        bars = {"AB": loop.ground, "AC": loop.crank, "CD": loop.coupler, "BD": loop.follower}
        lengths = {name: float(length) for name, length in bars.items()}
        longest = max(lengths, key=lambda name: lengths[name])
        rest = sum(lengths.values()) - lengths[longest]
        if lengths[longest] > rest:
            others = ", ".join(name for name in lengths if name != longest)
            return f"{longest} is {lengths[longest]:.4g} long, and {others} together {rest:.4g}"
        return "wherever its first loop (A, C, D, B) closes, E and G are too far apart or too near"

    def numbers(self) -> dict[str, FloatArray]:
        """Its dimensions by name."""
        return {name: getattr(self, name) for name in self.__match_args__}
