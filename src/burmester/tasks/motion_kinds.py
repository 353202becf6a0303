"""The kinds of motion, from the poses alone: the special ones by name, with what to do.

Each kind holds its numbers, says them in a sentence (`message`) with a way on (`help`), and
offers the dyads that it has for certain (`dyads`).  Some motions leave the pivots of a
four-bar open; for them a fit would invent dyads, so the kind is the whole answer.

| code | kind |
|---|---|
| R310 | `Rest`: all poses are the same |
| R311 | `FewPoses`: too few poses differ, or differ by more than their digits |
| R312 | `StraightTranslation` |
| R313 | `CircularTranslation`: the coupler of a parallelogram |
| R314 | `FreeTranslation`: along any other curve |
| R315 | `Rotation`: a turn about one point |
| R316 | `TwoSliders`: two points on lines of F (Cardan), or two points of F on lines of M |
| R318 | `Undetermined`: too little motion for the digits given, or too special |
| R320 | `TwoOrientations`: a general motion with two angles only |
| R321 | `General` |
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias, final

from burmester.tasks.special_motions import (
    CircularTranslation,
    FreeTranslation,
    MotionKindBase,
    Rotation,
    StraightTranslation,
    TwoSliders,
    in_degrees,
    rounded_length,
)
from burmester.wording import listed


@final
@dataclass(frozen=True, slots=True, eq=False)
class Rest(MotionKindBase):
    """All poses (count of them) are the same."""

    code: ClassVar[str] = "R310"
    name: ClassVar[str] = "rest"
    count: int

    @property
    def message(self) -> str:
        return f"all {self.count} poses are the same: the body does not move"

    @property
    def help(self) -> str:
        return "give 2 different poses or more, or fix the body to the ground"


@final
@dataclass(frozen=True, slots=True, eq=False)
class FewPoses(MotionKindBase):
    """Of `count` poses only those at the indices `representatives` can be told apart.

    repeats: whether the others repeat them exactly, or within their digits only.
    """

    code: ClassVar[str] = "R311"
    name: ClassVar[str] = "too few different poses"
    count: int
    representatives: tuple[int, ...]
    repeats: bool

    @property
    def message(self) -> str:
        differ = "are different" if self.repeats else "can be told apart with the digits given"
        some = f"only {len(self.representatives)} of the {self.count} poses"
        return f"{some} {differ}; the others repeat them"

    @property
    def help(self) -> str:
        poses = listed([str(i + 1) for i in self.representatives])
        then = {
            2: "a three-parameter family of dyads passes through them",
            3: "a two-parameter family of dyads passes through them",
            4: "a one-parameter family of dyads passes through them",
        }.get(len(self.representatives), "they are met exactly by at most four dyads")
        return f"keep poses {poses} only: {then}"


@final
@dataclass(frozen=True, slots=True, eq=False)
class Undetermined(MotionKindBase):
    """More quadrics hold the poses, within their digits, than leave a finite number of dyads.

    rotation: the range of the angles, radians; size: of the motion, a length.
    as_given: the nullity of the numbers taken as exact.  Three or less: a fit has an answer, but
        others far from it meet the poses as well, within their digits.
    """

    code: ClassVar[str] = "R318"
    name: ClassVar[str] = "not determined"
    nullity: int
    as_given: int
    count: int
    rotation: float
    size: float
    unit: str | None = None

    @property
    def message(self) -> str:
        within = "within the digits given, " if self.as_given < self.nullity else ""
        return (
            f"the poses do not determine the dyads: {within}{self.nullity} independent quadrics "
            f"hold all {self.count} of them (a four-bar needs 2); the rotation covers "
            f"{in_degrees(self.rotation)}, and pivots are uncertain by more than the motion's own "
            f"size, {rounded_length(self.size, self.size, self.unit, 2)}"
        )

    @property
    def help(self) -> str:
        if self.as_given < self.nullity:
            return "give poses with more rotation between them, or the same poses with more digits"
        return (
            "give more poses off the one turn or translation that most of them share, or fewer "
            "of those that share it"
        )


@final
@dataclass(frozen=True, slots=True, eq=False)
class TwoOrientations(MotionKindBase):
    """A general motion, but with two angles only (radians): one quadric tells just that."""

    code: ClassVar[str] = "R320"
    name: ClassVar[str] = "two orientations"
    angles: tuple[float, float]
    nullity: int

    @property
    def message(self) -> str:
        return (
            f"the body has two orientations only, {in_degrees(self.angles[0])} and "
            f"{in_degrees(self.angles[1])}: one quadric that holds all poses says just this, "
            "and is no dyad"
        )

    @property
    def help(self) -> str:
        return "give poses with other angles if few dyads are found, or none"


@final
@dataclass(frozen=True, slots=True, eq=False)
class General(MotionKindBase):
    """A motion with at most a few dyads: a fit finds them.

    nullity: how many independent quadrics hold the poses.  Two, with six poses or more, is an
    exact four-bar; three, a special one (a kite, an antiparallelogram) or five poses.
    """

    code: ClassVar[str] = "R321"
    name: ClassVar[str] = "general"
    nullity: int

    @property
    def message(self) -> str:
        return {
            0: "a general motion: no dyad meets all poses, and those found are approximate",
            1: "a general motion: one dyad at most meets all poses exactly",
            2: "a general motion: two dyads at most, one four-bar, meet all poses exactly",
            3: "a general motion: at most four dyads meet all poses exactly",
            4: "four poses: a one-parameter family of dyads meets them",
            5: "three poses: a two-parameter family of dyads meets them",
        }.get(self.nullity, "two poses: a three-parameter family of dyads meets them")

    @property
    def help(self) -> str:
        return "look for the dyads"


MotionKind: TypeAlias = (
    Rest
    | FewPoses
    | StraightTranslation
    | CircularTranslation
    | FreeTranslation
    | Rotation
    | TwoSliders
    | Undetermined
    | TwoOrientations
    | General
)
