"""A linkage found, and all that is known of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias, final

from burmester.dyads.selection import FoundDyad
from burmester.fourbar.defects import Defect, Driven, Verdict
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.linkages.requirement_check import Unmet
from burmester.linkages.tolerances import Spread
from burmester.linkages.uncertainty import DyadUncertainty

__all__ = ["FoundLinkage", "Pair", "Side", "led"]

Pair: TypeAlias = tuple[FoundDyad, FoundDyad]
Side: TypeAlias = Literal["first", "second"]


def led(linkage: Linkage, driver: Side) -> Linkage:
    """With the dyad that drives first."""
    return Linkage(linkage.second, linkage.first) if driver == "second" else linkage


@final
@dataclass(frozen=True, slots=True, eq=False)
class FoundLinkage:
    """A linkage made of two of the dyads found, refined as a whole, and what is to be said of it.

    dyads: with their dimensions in this linkage, the better driver first unless the task has two
        limits, whose order they keep; ids say from which of the dyads found they come.
    error: at the places where the coupler is for the poses, all on one circuit unless there is
        a circuit defect.
    verdict: circuit, branch and order for either driver.
    better: which dyad is the better driver, or the only one allowed.
    usable: whether it leads through all poses, driven by that dyad, and is as asked.
    unmet: what is asked of it and not so, driven by that dyad.
    sought: whether it was looked for under conditions, the closest ones not being usable.
    uncertainty: what errors of the poses leave open of both dyads; determined: whether that is
        little against the motion; tie: whether it leaves open which of Grashof's types it is.
    spread: of the error, where links and pivots are built within a tolerance.
    exact_error: that of the linkage before its dimensions were rounded, where that was asked.
    """

    id: str
    rank: int
    dyads: Pair
    linkage: Linkage
    error: PoseError
    verdict: Verdict
    better: Side
    usable: bool
    unmet: tuple[Unmet, ...] = ()
    sought: bool = False
    uncertainty: tuple[DyadUncertainty, DyadUncertainty] | None = None
    determined: bool = True
    tie: bool = False
    spread: Spread | None = None
    exact_error: PoseError | None = None

    @property
    def type(self) -> str:
        """The type, the better driver taken for the driver; a change point within what is known."""
        return "change-point" if self.tie else self.led.type

    @property
    def driver(self) -> Side | None:
        """Which dyad drives; None where the linkage is not usable."""
        return self.better if self.usable else None

    @property
    def driven(self) -> Driven:
        """How it does with the better driver."""
        return self.verdict.first if self.better == "first" else self.verdict.second

    @property
    def defects(self) -> tuple[Defect, ...]:
        """Why it is not usable: of the linkage, and of its better driver."""
        return self.verdict.defects + self.driven.defects

    @property
    def in_order(self) -> Pair:
        """The dyads as `led` has them, the better driver first."""
        return self.dyads if self.better == "first" else (self.dyads[1], self.dyads[0])

    @property
    def led(self) -> Linkage:
        """The linkage with the better driver first."""
        return led(self.linkage, self.better)
