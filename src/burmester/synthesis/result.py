"""What came of a task."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar, cast

from burmester.cures import Cure, Help
from burmester.dyads.selection import Fit, FoundDyad
from burmester.errors import Advice, InputError
from burmester.progress import Watch
from burmester.tasks.motion_class import MotionClass
from burmester.tasks.motion_task import Task
from burmester.tasks.option_table import Method
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.judged_linkage import JudgedLinkage
from burmester.wording import listed

if TYPE_CHECKING:  # few tasks have any of these, and their rooms take long to load
    from burmester.certificates.certificate import Certificate
    from burmester.families.family import Family
    from burmester.points.real_linkages import PointLinkages
    from burmester.sixbar.found import FoundSixBar
    from burmester.sixbar.six_bars import SixBars
    from burmester.synthesis.loosening import Loosening

# What is proposed in place of a limit that was too short: so many times it, seconds at least.
LONGER, LEAST_PROPOSED = 10.0, 10.0

Candidate: TypeAlias = "FoundLinkage | FoundSixBar"  # what files and pictures are made of

# What came of a task: R300 usable linkages; R301 linkages, none of them usable; R302 too few
# dyads for a linkage; R303 infinitely many linkages; R305 usable linkages, but no pivots
# determined; R306 no dyad within the limits; R307 approximate linkages, as two real dyads do not
# exist; R308 the best of infinitely many linkages; R309 none of them works; R310 and above: a
# special motion, see `motion_kinds` and `special_motions`; R330 a given linkage works, R331 it
# does not; R340 usable linkages through poses and points, R341 none usable, R342 none real, R343
# points of a line or a circle; R370 six-bars that work, R371 none of them.
Outcome: TypeAlias = Advice
JUDGED = ("R330", "R331")  # the outcomes of a linkage that was given


Kind = TypeVar("Kind", bound=JudgedLinkage)


class Answer(Generic[Kind]):
    """What came of a task of any kind: linkages by rank, an outcome, and warnings."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def outcome(self) -> Outcome: ...

        @property
        def warnings(self) -> tuple[Advice, ...]: ...

        @property
        def candidates(self) -> tuple[Kind, ...]: ...

    @property
    def usable(self) -> tuple[Kind, ...]:
        """The linkages that work, the best one first."""
        return tuple(each for each in self.candidates if each.usable)

    @property
    def works(self) -> bool:
        """Whether any linkage works."""
        return any(each.usable for each in self.candidates)

    def exported(self, found: Any) -> Candidate:
        """A linkage of it as pictures and files for other programs take it."""
        return cast("Candidate", found)


@dataclass(frozen=True, slots=True, eq=False)
class Synthesis(Answer[Any]):
    """All that came of a task of poses, nothing thrown away.

    problem: the task, the class of its motion, its characteristic length, and the options, with
        the method that was chosen.
    dyads: every dyad found, by rising rms error (shorter links first among exact ones).
    linkages: every pair of them, refined as a whole, in the order of `ranking`.  Where the closest
        one is not usable, or none near it is sound, with linkages that a search has found.
    fits: what the method learnt (singular values, all roots); two where the task has two limits.
    certificate: what of it is proved, if the options ask for a certificate.
    family: how linkages were chosen where the poses leave infinitely many.
    six_bars: what a search for six-bars has found, where one was asked for; or the one six-bar that
        was given.
    points: the solutions that were counted where poses and points determine finitely many.
    causes: where no linkage is sound, the limits that are to blame, each with the least loosening
        that was found to be enough, the least first.
    search: of a result that was read from its file: what that says of the search, as plain data.
        `fits`, `points` and `causes` are empty then, as nothing was searched.
    """

    problem: SynthesisProblem
    outcome: Outcome
    dyads: tuple[FoundDyad, ...] = ()
    linkages: tuple[FoundLinkage, ...] = ()
    warnings: tuple[Advice, ...] = ()
    fits: tuple[Fit, ...] = ()
    certificate: Certificate | None = None
    family: Family | None = None
    six_bars: SixBars | None = None
    points: PointLinkages | None = None
    causes: tuple[Loosening, ...] = ()
    search: Mapping[str, Any] = field(default_factory=dict)

    @property
    def task(self) -> Task:
        """The task as it was given."""
        return self.problem.given

    @property
    def motion(self) -> MotionClass | None:
        """What the poses are, known before any fit; None for one of them."""
        return self.problem.motion

    @property
    def length(self) -> float:
        """The characteristic length of the task, in its unit (`CanonicalFrames`)."""
        return self.problem.length

    @property
    def length_per_radian(self) -> float:
        """What a radian of angle error counts as, in the task's unit."""
        return self.problem.length_per_radian

    @property
    def options(self) -> SynthesisOptions:
        """How the task was solved."""
        return self.problem.options

    @property
    def method(self) -> Method:
        """The method that was used."""
        return self.problem.options.method

    @property
    def usable(self) -> tuple[FoundLinkage, ...]:
        """The linkages that work."""
        return tuple(each for each in self.linkages if each.usable)

    @property
    def candidates(self) -> tuple[Candidate, ...]:
        """All linkages, four-bars or six-bars, by rank."""
        return self.linkages if self.six_bars is None else self.six_bars.found

    @property
    def determined(self) -> bool:
        """Whether a linkage works whose pivots the poses determine."""
        return any(each.usable and each.determined for each in self.linkages)


def chosen(
    every: Sequence[Kind],
    which: int | str | None,
    outcome: Outcome,
    cure: str = "choose one of them, such as",
) -> Kind:
    """The one of an id, or at a place by rank, the first for None; raises E151.

    cure: how one is chosen, before its id.
    """
    known = [each.id for each in every]
    if isinstance(which, str):
        if which.upper() in known:
            return every[known.index(which.upper())]
    elif -len(every) <= (which or 0) < len(every):
        return every[which or 0]
    raise InputError(
        "E151",
        f"there is no linkage {'' if which is None else f'{which} '}in this result",
        why=f"it has {', '.join(known)}" if known else outcome.message,
        help=f"{cure} {known[0]}" if known else outcome.help or "give other poses",
    )


def with_time_limit(synthesis: Synthesis, watch: Watch) -> Synthesis:
    """A synthesis with a warning W221 that says what was not finished, if there is such."""
    limit, parts = synthesis.options.time_limit, []
    if limit is None or not (watch.cut or watch.left_out):
        return synthesis
    for texts, fate in ((watch.cut, "ended early"), (watch.left_out, "left out")):
        if texts:
            parts.append(f"{listed(texts)} {'was' if len(texts) == 1 else 'were'} {fate}")
    longer = max(LONGER * limit, LEAST_PROPOSED)
    advice = Advice(
        "W221",
        f"the time limit of {limit:g} s came before the end: {'; '.join(parts)}",
        Help.of("give more time, such as {}, or leave it out", Cure("time_limit", longer)),
        "what was found until then is the answer, and may not be the best",
    )
    return replace(synthesis, warnings=(*synthesis.warnings, advice))
