"""Stephenson's six-bars of the three classes, as mechanisms: what `mechanisms` asks of a kind.

A class says which link of the chain is the ground, and what its joints are called.  The body may
be any moving link.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final, NamedTuple, final

import numpy as np

from burmester.mechanisms.contract import Locked
from burmester.mechanisms.skeleton import Frames, Skeleton, distance, seen_along
from burmester.numerics.arrays import ComplexArray, FloatArray, Indexed, complex_of, pairs_of
from burmester.stephenson.chain import EXCHANGED, JOINTS, TURNED_OVER, Chain, inserted
from burmester.stephenson.standstill import standstill

OF_LOOP: Final = 4  # dead points of the loop A, C, D, B; those of the other one follow them


@final
class StephensonClass(NamedTuple):
    """A class: its skeleton, and its names of the chain's joints A to G, in this order."""

    skeleton: Skeleton
    names: str

    def in_chain(self, joint: str) -> str:
        """A joint as the chain calls it."""
        return JOINTS[self.names.index(joint)]

    def of(self, carries: str, frames: Frames) -> StephensonLinkage:
        """The six-bar whose links have joints (*, 2) in their frames."""
        names, skeleton = dict(zip(JOINTS, self.names, strict=True)), self.skeleton
        bars = {frozenset(bar): bar for bar in skeleton.bars}

        def link(joints: str) -> str:
            return next(key for key, own in skeleton.links.items() if set(joints) <= set(own))

        def length(bar: str) -> FloatArray:
            own = bars[frozenset(names[joint] for joint in bar)]
            return distance(frames[link(own)], own)

        def seen(bar: str, joint: str) -> ComplexArray:
            own = "".join(names[each] for each in bar)
            return complex_of(seen_along(frames[link(own)], own, names[joint]))

        def ends(name: str) -> ComplexArray:
            two = [complex_of(frames[name][joint]) for joint in tuple(skeleton.links[name][:2])]
            return np.stack(two, axis=-1)

        chain = Chain(
            base=length("AB"),
            f=seen("AB", "F"),
            first=length("AC"),
            second=length("BD"),
            arm=length("CE"),
            d=seen("CE", "D"),
            upper=length("EG"),
            lower=length("FG"),
        )
        return StephensonLinkage(
            skeleton.name, carries, chain, ends(skeleton.ground), ends(carries)
        )


CLASSES: Final[Mapping[str, StephensonClass]] = {
    each.skeleton.name: each
    for each in (
        StephensonClass(
            Skeleton(
                "Stephenson III six-bar",
                "ABCDEFG",
                {
                    "ground": "ABF",
                    "first crank": "AC",
                    "second crank": "BD",
                    "coupler": "CDE",
                    "floating link": "EG",
                    "third crank": "FG",
                },
                drivers="ABF",
                along={"coupler": "CE"},
            ),
            "ABCDEFG",
        ),
        StephensonClass(
            Skeleton(
                "Stephenson I six-bar",
                "ACEFGKL",
                {
                    "ground": "AF",
                    "first crank": "ACL",
                    "second crank": "FGK",
                    "coupler": "KL",
                    "first floating link": "CE",
                    "second floating link": "EG",
                },
                drivers="AF",
            ),
            "ALFKGCE",
        ),
        StephensonClass(
            Skeleton(
                "Stephenson II six-bar",
                "ACEFGKL",
                {
                    "ground": "AF",
                    "first crank": "ACK",
                    "second crank": "FG",
                    "coupler": "EGL",
                    "first floating link": "CE",
                    "second floating link": "KL",
                },
                drivers="AF",
            ),
            "CKELGAF",
        ),
    )
}


@final
@dataclass(frozen=True, slots=True, eq=False)
class StephensonLinkage(Indexed):
    """Six-bars of Stephenson's chain, one or many: leading axes (*,) are theirs.

    Attributes
    ----------
    name : str
        Of their class.
    carries : str
        The link that is the body.
    chain : Chain
        The dimensions of the chain, (*,) each.
    ground, body : (*, 2) complex array
        The first two joints of the ground, in F, and of the body, in M.
    """

    loops: ClassVar[int] = 2

    name: str
    carries: str
    chain: Chain
    ground: ComplexArray
    body: ComplexArray

    @property
    def kind(self) -> StephensonClass:
        """Their class."""
        return CLASSES[self.name]

    @property
    def skeleton(self) -> Skeleton:
        """The joints and links of the class."""
        return self.kind.skeleton

    @property
    def generator(self) -> str:
        """The driver at the chain's joint A; none of the second class."""
        name = self.kind.names[0]
        return name if name in self.skeleton.drivers else ""

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading axes: () for one linkage."""
        return self.chain.base.shape

    @staticmethod
    def driver_name(pivot: str) -> str:
        """A driver as results name it: by its pivot."""
        return pivot

    def numbers(self) -> dict[str, FloatArray | ComplexArray]:
        """Its dimensions by name."""
        return {**self.chain._asdict(), "ground": self.ground, "body": self.body}

    def frames(self) -> Frames:
        """The joints (*, 2) of each link, in the frame of that link; of the ground in F."""
        placed = {self.skeleton.ground: self.ground, self.carries: self.body}
        out = {}
        for link, joints in self.skeleton.links.items():
            own = self._shape(joints)
            near, far = (own[joint] for joint in tuple(self.skeleton.axis(link)))
            if link in placed:
                near, far = (own[joint] for joint in tuple(joints[:2]))
                start, end = (placed[link][..., k] for k in (0, 1))
            else:
                start, end = 0j * near, np.abs(far - near) + 0j
            turn = (end - start) / (far - near)
            out[link] = {name: pairs_of(start + turn * (at - near)) for name, at in own.items()}
        return out

    def _shape(self, joints: str) -> dict[str, ComplexArray]:
        """The joints of a link in the chain's frame of it."""
        chain, names = self.chain, [self.kind.in_chain(joint) for joint in joints]
        zero = 0j * chain.f
        if set(names) <= set("ABF"):
            at = {"A": zero, "B": zero + chain.base, "F": chain.f}
        elif set(names) <= set("CDE"):
            at = {"C": zero, "D": chain.d, "E": zero + chain.arm}
        else:
            bars = {"AC": chain.first, "BD": chain.second, "EG": chain.upper, "FG": chain.lower}
            at = dict(zip(names, (zero, zero + bars["".join(sorted(names))]), strict=True))
        return {joint: at[name] for joint, name in zip(joints, names, strict=True)}

    def lengths(self) -> FloatArray:
        """The distances between joints of one link, in the order of the bars: (*, 10)."""
        out = []
        for bar in self.skeleton.bars:
            link = next(each for each in self.skeleton.links.values() if set(bar) <= set(each))
            own = self._shape(link)
            out.append(np.abs(own[bar[1]] - own[bar[0]]))
        return np.stack(out, axis=-1)

    def generated(
        self, angle: FloatArray, sides: FloatArray, *, closed: bool = False
    ) -> ComplexArray:
        """The joints (*, 7) at angles (*,) at the chain's joint A, on sides (*, 2)."""
        return self._in_f(self.chain.joints(angle, sides[..., 0], sides[..., 1], closed=closed))

    def _in_f(self, joints: ComplexArray) -> ComplexArray:
        """The joints (*, 7) of the chain in F, in the order of the skeleton."""
        there = joints[..., [self.kind.names.index(each) for each in self.skeleton.joints]]
        ends = tuple(self.skeleton.links[self.skeleton.ground][:2])
        near, far = (there[..., [self.skeleton.joints.index(end)]] for end in ends)
        start, end = self.ground[..., :1], self.ground[..., 1:]
        turn = (end - start) * (far - near).conj()
        with np.errstate(invalid="ignore"):  # where a loop is open
            return np.asarray(start + turn / np.abs(turn) * (there - near))

    def in_chain(self, joints: ComplexArray, driven: str = "A") -> ComplexArray:
        """Joints (*, 7) in the order of the chain, renamed so that `driven` is its A or its F."""
        there = joints[..., [self.skeleton.joints.index(each) for each in self.kind.names]]
        if driven in "CDE":
            there = there[..., [JOINTS.index(each) for each in TURNED_OVER]]
        if driven in "BD":
            there = there[..., [JOINTS.index(each) for each in EXCHANGED]]
        return there

    def renamed(self, driven: str) -> Chain:
        """The chain with names in which a joint is called A, or F if it is E."""
        chain = self.chain.turned_over() if driven in "CDE" else self.chain
        return chain.exchanged() if driven in "BD" else chain

    def generator_angle(self, joints: ComplexArray) -> FloatArray:
        """The angle (*,) at the chain's joint A where the joints are (*, 7)."""
        return Chain.angle(self.in_chain(joints))

    def locked(self, sides: FloatArray) -> Locked:
        """Where one linkage locks for its generator, on sides (2,)."""
        angle = dead_angles(self.chain, sides[0])
        return Locked(angle, (np.arange(len(angle)) >= OF_LOOP).astype(np.intp))

    def still(self, pivot: str) -> ComplexArray:
        """The joints (m, 7) of one linkage at all dead points of a driver."""
        driven = self.kind.in_chain(pivot)
        chain = self.renamed(driven)
        if driven in "EFG":
            joints = standstill(chain, "G" if driven == "G" else "F")
        else:
            angle = chain.loop().locked(first=True)
            zero, (c, turn) = np.zeros(()), chain.in_line()
            ends = [chain.joints(angle, zero, zero + last) for last in (1.0, -1.0)]
            joints = np.concatenate([*ends, chain.with_coupler(c, turn, zero)])
            joints = joints[np.isfinite(joints).all(axis=-1)]
        return self.as_named(joints, driven)

    def as_named(self, joints: ComplexArray, driven: str) -> ComplexArray:
        """Joints (*, 7) of the chain that is `renamed` in F, in the order of the skeleton."""
        if driven in "BD":
            joints = inserted(joints, EXCHANGED)
        if driven in "CDE":
            joints = inserted(joints, TURNED_OVER)
        return self._in_f(joints)

    def why_open(self) -> str:
        """Why one linkage that is open everywhere cannot be assembled, in words."""
        return (
            "wherever its loop of four links closes, the joints of the other two are too far "
            "apart or too near"
        )


def dead_angles(chain: Chain, side: FloatArray) -> FloatArray:
    """The angles at A at which chains (*,) lock while D is on a side (*,): (*, 16), nan if none."""
    c, turn = chain.in_line()
    d = c + turn * chain.d[..., None]
    with np.errstate(invalid="ignore"):
        own = ((d - c) * (chain.base[..., None] - c).conj()).imag * side[..., None] > 0
    angle = np.where(own, np.angle(c), np.nan)
    return np.concatenate([chain.loop().locked(first=True), angle], axis=-1)
