"""Answers that were followed: what a follow returns, and where the next one goes on."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias, final

from burmester.dyads.selection import FoundDyad
from burmester.following.dyad_strands import DyadStrands
from burmester.following.linkage_strands import LinkageStrands
from burmester.linkages.evaluation import Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.tasks.motion_task import Task
from burmester.tasks.problem import SynthesisProblem
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.quality import Quality
from burmester.wording import count

ChangeKind: TypeAlias = Literal["appeared", "vanished", "works", "fails", "other defects"]


@final
@dataclass(frozen=True, slots=True)
class Change:
    """What became of one dyad or linkage since the answers before.

    id: of the dyad or linkage.  kind: whether it appeared, vanished, works now, fails now, or
    fails for other reasons.  message: the same in a sentence, with the reason.
    """

    id: str
    kind: ChangeKind
    message: str


@final
@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Followed:
    """The answers of a task, each continued from those of a task that differs a little.

    Attributes
    ----------
    problem : SynthesisProblem
        The new task, as `Synthesis` has it.
    dyads : tuple of FoundDyad
        In the order of their ids, each with the id of the one from which it continues.
    linkages : tuple of FoundLinkage
        The same; `rank` is that of the synthesis.  Errors, verdicts and violations are those of
        the new places.  Quality is told by `quality`; uncertainty and spread are not computed, and
        `determined` is as it was.
    changes : tuple of Change
        What vanished, appeared or crossed a verdict since the answers before.
    uncertain : tuple of str
        Why these answers may not be those of the whole road, one sentence each; empty where
        nothing speaks against them.
    complete : bool
        Whether a dyad that appears is looked for: without limits and exact poses, and of five
        poses.  Of six poses and more it is seen where it comes from a new critical point of the
        squared residual; nearly all do.
    dyad_strands, linkage_strands
        What goes on from task to task.
    last_numbers : (int, int)
        The greatest numbers of a dyad and of a linkage so far: no id is used twice.
    """

    problem: SynthesisProblem
    dyads: tuple[FoundDyad, ...]
    linkages: tuple[FoundLinkage, ...]
    changes: tuple[Change, ...]
    uncertain: tuple[str, ...]
    dyad_strands: DyadStrands
    linkage_strands: LinkageStrands
    last_numbers: tuple[int, int]

    @property
    def task(self) -> Task:
        """The task as it was given."""
        return self.problem.given

    @property
    def complete(self) -> bool:
        """Whether a dyad that appears is seen."""
        return self.dyad_strands.complete

    @property
    def usable(self) -> tuple[FoundLinkage, ...]:
        """The linkages that work."""
        return tuple(each for each in self.linkages if each.usable)

    def quality(self, id: str) -> Quality | None:
        """The quality of a linkage by its id; None where it cannot be assembled near every pose."""
        found = self[id]
        assert isinstance(found, FoundLinkage)
        if not math.isfinite(found.combined_error):
            return None
        evaluation = Evaluation(self.problem, target_of(self.problem))
        places = found.error.places[self.problem.pose_numbers]
        return evaluation.qualities([found.driver_first], places[None], [found.driven])[0]

    def __getitem__(self, id: str) -> FoundDyad | FoundLinkage:
        """A dyad or a linkage by its id; KeyError where it vanished, or never was."""
        every: dict[str, FoundDyad | FoundLinkage] = {each.id: each for each in self.dyads}
        return (every | {each.id: each for each in self.linkages})[id]

    def __repr__(self) -> str:
        lines = [
            f"{count(len(self.dyads), 'dyad')} and {count(len(self.linkages), 'linkage')}, "
            f"{len(self.usable)} of them usable",
            *(each.message for each in self.changes),
            *(f"uncertain: {each}" for each in self.uncertain),
        ]
        return "\n".join(lines)
