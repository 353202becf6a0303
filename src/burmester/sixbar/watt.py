"""Watt's first six-bar: two cranks on the ground, a coupler between them, and the body beyond.

Seven joints and six links, of which two hold three joints each and meet at one of them, D:

    ground         A, B        first crank    A, C        coupler     C, D, E
    second crank   B, D, G     floating link  G, H        body        E, H

A to D are a four-bar.  Its coupler carries the body at E, its second crank holds it by the link
from G to H: D, E, H, G are a loop of four again (Soh and McCarthy 2008; the names of the joints
are ours).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Final, final

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.mechanisms.contract import Locked
from burmester.mechanisms.skeleton import Frames, Skeleton, distance, seen_along
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.sixbar.dead_points import OF_FIRST_LOOP, dead_places, dead_points, first_loop
from burmester.sixbar.motion import Drive, Sides, drive_of, joints_at

__all__ = ["BARS", "DRIVES", "FIGURES", "JOINTS", "LINKS", "WATT_I", "WattLinkage", "pairs_of"]

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
JOINTS: Final = WATT_I.joints
LINKS: Final = WATT_I.links
BARS: Final = WATT_I.bars
FIGURES: Final = 16  # numbers that make a linkage
DRIVES: Final[dict[str, Drive]] = {"A": "first", "B": "second"}  # by their pivots


@final
@dataclass(frozen=True, slots=True, eq=False)
class WattLinkage:
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

    def __getitem__(self, index: Any) -> WattLinkage:
        """Pick along the leading axes (indices, slices, masks)."""
        return WattLinkage(*(getattr(self, name)[index] for name in self.__match_args__))

    def beside(self, others: Sequence[Any]) -> WattLinkage:
        """These (n,), and others after them."""
        names = self.__match_args__
        return WattLinkage(
            *(np.concatenate([getattr(each, name) for each in (self, *others)]) for name in names)
        )

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
        """The distances between joints of one link, in the order of `BARS`: (*, 10)."""
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
        return joints_at(self, angle, Sides(sides[..., 0], sides[..., 1]), "first", closed=closed)

    def generator_angle(self, joints: ComplexArray) -> FloatArray:
        """The first crank's angle (*,) where the joints are (*, 7)."""
        return drive_of(joints, "first")

    def locked(self, sides: FloatArray) -> Locked:
        """Where one linkage locks for the first crank, on sides (2,)."""
        angle = dead_points(self, Sides(sides[0], sides[1]), "first")
        return Locked(angle, (np.arange(len(angle)) >= OF_FIRST_LOOP).astype(np.intp))

    def still(self, pivot: str) -> ComplexArray:
        """The joints (m, 7) of one linkage at all dead points of a driver."""
        return dead_places(self, DRIVES[pivot])

    @staticmethod
    def driver_name(pivot: str) -> str:
        """A driver as results name it."""
        return DRIVES[pivot]

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

    def link_ratio(self) -> FloatArray:
        """The greatest of these distances over the least: (*,)."""
        lengths = self.lengths()
        return np.asarray(lengths.max(axis=-1) / lengths.min(axis=-1))

    def through(self, poses: Displacement, joints: ComplexArray) -> FloatArray:
        """How far distances between joints are off at most where M is at poses (*, N): (*, N).

        joints: (*, N, 7), where a computation has the joints; those on the body are compared with
        the poses, those on the ground with A and B.
        """
        first, second = pairs_of(BARS)
        lengths = np.abs(joints[..., first] - joints[..., second])
        off = np.abs(lengths - self.lengths()[..., None, :])
        held = [
            joints[..., 0] - complex_of(self.fixed_first)[..., None],
            joints[..., 1] - complex_of(self.fixed_second)[..., None],
            joints[..., 4] - complex_of(poses.act(self.body_joint[..., None, :])),
            joints[..., 6] - complex_of(poses.act(self.link_joint[..., None, :])),
        ]
        every = np.concatenate([off, np.abs(np.stack(held, axis=-1))], axis=-1)
        return np.asarray(every.max(axis=-1))


def pairs_of(bars: tuple[str, ...]) -> tuple[list[int], list[int]]:
    """The numbers of the first and of the second joint of bars such as "AC"."""
    return [JOINTS.index(bar[0]) for bar in bars], [JOINTS.index(bar[1]) for bar in bars]
