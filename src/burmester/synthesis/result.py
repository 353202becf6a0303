"""What came of a task."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from burmester.certificates.certificate import Certificate
from burmester.dyads.selection import (
    Fit,
    FoundDyad,
)
from burmester.errors import Advice
from burmester.linkages.evaluation import SynthesisOptions
from burmester.linkages.found_linkage import FoundLinkage
from burmester.synthesis.method import Method
from burmester.tasks.motion_class import MotionClass
from burmester.tasks.motion_task import Task

__all__ = ["Outcome", "Synthesis"]


@final
@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a task: a stable code, a sentence, and what to do where nothing came.

    R300 usable linkages; R301 none of them usable; R302 too few dyads for one; R303 infinitely
    many; R305 usable ones, but no pivots determined; R306 none within the limits; R307 approximate
    ones, for want of two real dyads; R310 and above: see `motion_kind`.  why: with numbers.
    """

    code: str
    message: str
    help: str | None = None
    why: str | None = None


@final
@dataclass(frozen=True, slots=True, eq=False)
class Synthesis:
    """All that came of a task, nothing thrown away.

    motion: what the poses are, known before any fit; None for one or two of them.
    length: the characteristic length of the task (see `frames`), in its unit; it weighs
        angles against positions in `FoundLinkage.error`.
    dyads: every dyad found, by rising rms error (shorter links first among exact ones).
    linkages: every pair of them, refined as a whole; those that work first, then by rising worst
        position error.  Where the closest one does not work, linkages looked for under the
        conditions that they do.
    fits: what the method learnt (singular values, all roots); two where the task has two limits.
    certificate: what of it is proved, where that was asked for.
    """

    task: Task
    method: Method
    outcome: Outcome
    motion: MotionClass | None
    length: float
    dyads: tuple[FoundDyad, ...] = ()
    linkages: tuple[FoundLinkage, ...] = ()
    warnings: tuple[Advice, ...] = ()
    fits: tuple[Fit, ...] = ()
    certificate: Certificate | None = None
    options: SynthesisOptions | None = None

    @property
    def usable(self) -> tuple[FoundLinkage, ...]:
        """The linkages that work."""
        return tuple(each for each in self.linkages if each.usable)

    @property
    def determined(self) -> bool:
        """Whether a linkage works whose pivots the poses determine."""
        return any(each.determined for each in self.usable)
