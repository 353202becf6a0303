"""A linkage found, and all that is known of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from burmester.dyads.selection import FoundDyad
from burmester.fourbar.defects import Defect, Driven, Verdict
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.linkages.requirement_check import Violation
from burmester.linkages.tolerances import Spread
from burmester.linkages.uncertainty import DyadUncertainty

__all__ = ["FoundLinkage", "Pair", "Side", "with_driver_first"]

Pair: TypeAlias = tuple[FoundDyad, FoundDyad]
Side: TypeAlias = Literal["first", "second"]


def with_driver_first(linkage: Linkage, driver: Side) -> Linkage:
    """With the dyad that drives first."""
    return Linkage(linkage.second, linkage.first) if driver == "second" else linkage


@dataclass(frozen=True, slots=True, eq=False)
class FoundLinkage:
    """A linkage made of two of the dyads found, refined as a whole, and what is to be said of it.

    dyads: with their dimensions in this linkage, the better driver first unless the task has two
        limits, whose order they keep; ids say from which of the dyads found they come.
    error: at the places where the coupler is for the poses, all on one circuit unless there is
        a circuit defect.
    verdict: circuit, branch and order for either driver.
    preferred_driver: which dyad is the better driver, or the only one allowed.
    usable: whether it leads through all poses, driven by that dyad, and is as asked.
    violations: what is asked of it and not so, driven by that dyad.
    from_search: whether it was looked for under conditions, the closest ones not being usable.
    uncertainty: what errors of the poses leave open of both dyads; determined: whether that is
        little against the motion; tie: whether it leaves open which of Grashof's types it is.
    spread: of the error, where links and pivots are built within a tolerance.
    error_before_rounding: None where no rounding was asked for.
    """

    id: str
    rank: int
    dyads: Pair
    linkage: Linkage
    error: PoseError
    verdict: Verdict
    preferred_driver: Side
    usable: bool
    violations: tuple[Violation, ...] = ()
    from_search: bool = False
    uncertainty: tuple[DyadUncertainty, DyadUncertainty] | None = None
    determined: bool = True
    tie: bool = False
    spread: Spread | None = None
    error_before_rounding: PoseError | None = None

    @property
    def type(self) -> str:
        """The type, the better driver taken for the driver; a change point within what is known."""
        return "change-point" if self.tie else self.driver_first.type

    @property
    def driver(self) -> Side | None:
        """Which dyad drives; None where the linkage is not usable."""
        return self.preferred_driver if self.usable else None

    @property
    def driven(self) -> Driven:
        """How it does with the better driver."""
        return self.verdict.first if self.preferred_driver == "first" else self.verdict.second

    @property
    def defects(self) -> tuple[Defect, ...]:
        """Why it is not usable: of the linkage, and of its better driver."""
        return self.verdict.defects + self.driven.defects

    @property
    def dyads_driver_first(self) -> Pair:
        """The dyads as `driver_first` has them, the better driver first."""
        return self.dyads if self.preferred_driver == "first" else (self.dyads[1], self.dyads[0])

    @property
    def driver_first(self) -> Linkage:
        """The linkage with the better driver first."""
        return with_driver_first(self.linkage, self.preferred_driver)
