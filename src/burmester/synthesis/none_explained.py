"""Why there is no linkage: the limit that stops them all, how little would do, and near misses.

Each limit of a task is loosened alone, the others as they are, by as little as lets a sound linkage
in.  What is told was tried: the task with the looser limit is solved as any other, and has a sound
linkage.  A search, not a proof: less may be enough.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final, Self, TypeAlias, final

import numpy as np

from burmester.cures import Help
from burmester.errors import InputError
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.regions import Polygon
from burmester.linkages.bearing_linkages import only_bears_too_much
from burmester.linkages.evaluation import Candidates, Evaluation, at_given_poses
from burmester.linkages.from_dyads import target_of
from burmester.numerics.arrays import FloatArray
from burmester.progress import time_for
from burmester.requirements.loads import KINDS_OF_LOADS, OF_LOADS
from burmester.requirements.table import excess
from burmester.requirements.table import without as looser
from burmester.synthesis.loosening import Loosening, loosened, loosened_all_around
from burmester.synthesis.result import Synthesis
from burmester.synthesis.wider_region import bars_clear
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import poses_in_words
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.stated_limits import StatedLimit, stated_limits, without
from burmester.verdicts.explanation import SPRING_HELP, bears_too_much
from burmester.verdicts.found_linkage import FoundLinkage

if TYPE_CHECKING:  # loaded for few poses only
    from burmester.families.open_task import OpenTask, Trials
    from burmester.verdicts.assumptions import Assumptions

Solve: TypeAlias = Callable[[Task, SynthesisOptions], Synthesis]

FEW: Final = ("R308", "R309")  # outcomes of few poses
MANY: Final = ("R301", "R302", "R306")
SHARES: Final = (1.0, 1.1, 1.3, 2.0)  # of the way to a near miss, until a search finds a linkage
BISECTIONS: Final = 3  # number of times that a way is halved where each is a search of its own
COMPARED: Final = 12  # number of sound linkages of which the nearest to a limit is looked for
ON_OFF: Final = ("kinds", "type", "driver")  # limits that are kept or not
DYADS: Final = frozenset({"fixed pivot", "moving pivot", "length", "kinds"})  # limits of dyads
NEED_SURROUNDINGS: Final = ("margin", "keep-out")


def explained(synthesis: Synthesis, solve: Solve) -> Synthesis:
    """The synthesis; where it has no sound linkage, with the limits that are to blame for that.

    solve: from a task to its linkages, without this explanation.
    """
    search = _search(synthesis, solve)
    if search is None:
        return synthesis
    if causes := sorted(search.loosened_alone(), key=lambda each: each.size):
        return _with_causes(synthesis, causes, alone=True)
    if causes := search.loosened_together():
        return _with_causes(synthesis, causes, alone=False)
    if synthesis.outcome.code != "R309" or not search.hopeless():
        return synthesis
    why = "without any of the limits no sound linkage was found either: the poses are to blame"
    help = "move a pose, or leave one out"
    return replace(synthesis, outcome=replace(synthesis.outcome, why=why, help=help))


def _search(synthesis: Synthesis, solve: Solve) -> _FewPoses | _ManyPoses | None:
    """The search for what is to blame; None where there is nothing to explain."""
    task, code = synthesis.task, synthesis.outcome.code
    if task.path is not None or not any(stated_limits(task)):
        return None
    given_up = synthesis.family is not None and synthesis.family.given_up
    if code in FEW and (not synthesis.works or given_up):
        return _FewPoses.of(synthesis.problem, solve)
    if code in MANY and task.tolerances is None:
        return _ManyPoses(synthesis.problem, solve)
    return None


@dataclass(frozen=True, slots=True, eq=False)
class _Search:
    """What both searches share.

    problem: of the task as stated.
    """

    problem: SynthesisProblem
    solve: Solve

    @property
    def task(self) -> Task:
        return self.problem.given

    @property
    def size(self) -> float:
        return self.problem.motion_size

    def judged(self, batch: LinkageBatch, rows: FloatArray) -> list[FoundLinkage]:
        """Linkages (k,) at their rows (k, N, 3), judged by the task as stated."""
        target = target_of(self.problem)
        own = batch.from_canonical(target.frames)
        candidates = Candidates.of_own_dyads(batch, rows, own, from_search=True)
        return Evaluation(self.problem, target).members(candidates)

    def sound(self, task: Task) -> list[FoundLinkage]:
        """The sound linkages that a task has; none where it contradicts itself."""
        try:
            answer = self.solve(task, self.problem.options)
        except InputError:
            return []
        return [each for each in answer.usable if not each.shortcomings]

    def hopeless(self) -> bool:
        """Whether no linkage was found without any limit either."""
        return False

    def near(self, limit: StatedLimit, task: Task) -> Loosening | None:
        """The least loosening for one of the sound linkages of a task."""
        found = self.sound(task)[:COMPARED]
        if not found:
            return None
        target = target_of(self.problem)
        numbers = self.problem.pose_numbers
        rows = np.stack([target.rows_at(each.error.places[numbers]) for each in found])
        batch = LinkageBatch.of([each.linkage for each in found]).to_canonical(target.frames)
        told = [
            loosened(self.task, limit, each, self.size)
            for each in at_given_poses(self.judged(batch, rows), self.problem)
        ]
        return min(filter(None, told), key=lambda each: each.size, default=None)

    def tried(self, limit: StatedLimit, found: FoundLinkage) -> Loosening | None:
        """The least loosening for a linkage with which the task has a sound one."""
        for share in SHARES:
            told = loosened(self.task, limit, found, self.size, share)
            if told is None or self.sound(told.task):
                return told
            if limit.kind in ON_OFF or not time_for("looking for what little would do"):
                break
        return None


@final
@dataclass(frozen=True, slots=True, eq=False)
class _FewPoses(_Search):
    """Poses that leave infinitely many linkages: those that evolve towards keeping the limit.

    assumed: where the task says nothing; far: the same, with pivots as far as is ever looked.
    stated: the task with all limits; drawn: linkages within those of the dyads.
    """

    assumed: Assumptions
    far: Assumptions
    stated: OpenTask
    drawn: Trials | None

    @classmethod
    def of(cls, problem: SynthesisProblem, solve: Solve) -> Self:
        """The search for a problem."""
        from burmester.families.least_excess import assumed_to_build, linkages_within_limits  # noqa: PLC0415  few tasks need it
        from burmester.families.open_task import OpenTask  # noqa: PLC0415  the same
        from burmester.verdicts.assumptions import FAR  # noqa: PLC0415  the same

        assumed = assumed_to_build(problem)
        stated = OpenTask.of(problem, target_of(problem), assumed)
        far = assumed_to_build(problem, FAR)
        return cls(problem, solve, assumed, far, stated, linkages_within_limits(stated))

    def loosened_alone(self) -> Iterator[Loosening]:
        """Each limit loosened alone, where that is enough."""
        limits = list(stated_limits(self.task))
        bearing = self._bearing(limits)
        if bearing:  # all but loads can be kept: no other limit is to blame
            limits = [each for each in limits if each.kind in KINDS_OF_LOADS]
        for limit in limits:
            if not time_for(f"looking without the limit on {limit.kind}"):
                continue
            for found in bearing or self._nearest([limit], self.assumed)[:1]:
                told = self.tried(limit, found)
                if told is not None:
                    told = self._least(limit, told)
                    yield replace(told, message=told.message + self._share(limit))

    def _bearing(self, limits: Sequence[StatedLimit]) -> list[FoundLinkage]:
        """The linkage that keeps all limits but those of loads, and these most nearly; or none."""
        of_loads = [each for each in limits if each.kind in KINDS_OF_LOADS]
        if not of_loads or not time_for("looking without the limits on loads"):
            return []
        found = filter(only_bears_too_much, self._nearest(of_loads, self.assumed))
        asked = {each: b for each, b in self.task.requirements.bounds.items() if each in OF_LOADS}
        return sorted(found, key=lambda each: float(excess(asked, each.figures)))[:1]

    def _least(self, limit: StatedLimit, most: Loosening) -> Loosening:
        """The least loosening found, by looking within half of one that is enough, all around."""
        best = most
        for _ in range(BISECTIONS):
            half = loosened_all_around(self.task, limit, best.size / 2 * self.size)
            if half is None or not time_for("looking for what little would do"):
                break
            near = self.near(limit, half)
            told = None if near is None else self.tried(limit, near.found)
            if told is None or told.size >= best.size:
                break
            best = told
        return best

    def hopeless(self) -> bool:
        """Whether no linkage was found without any limit either."""
        every = list(stated_limits(self.task))
        return time_for("looking without any limit") and not self._nearest(every, self.far)

    def _share(self, limit: StatedLimit) -> str:
        """How many of the dyads drawn within their limits clear a keep-out region, in words."""
        if limit.kind != "keep-out" or self.drawn is None:
            return ""
        batch = self.drawn.batch.from_canonical(target_of(self.problem).frames)
        z = batch.dimensions[batch.kinds == 0]
        clear = bars_clear(self.task, limit.number, np.unique(z, axis=0))
        few, count = int(clear.all(axis=1).sum()), len(clear)
        if not count or few == count:
            return ""
        lost = (~clear).sum(axis=0)
        pose = int(lost.argmax())
        which = "all" if lost[pose] == count else f"{lost[pose]:,}"
        at = poses_in_words(self.task, [pose])
        return f" ({few:,} of {count:,} links clear it at all poses, {which} touch it at {at})"

    def loosened_together(self) -> list[Loosening]:
        """Limits that have to be loosened together: of loads, of the dyads, or else all."""
        every = list(stated_limits(self.task))
        parts = [
            [each for each in every if each.kind in kinds] for kinds in (KINDS_OF_LOADS, DYADS)
        ]
        tries = [(each, self.assumed) for each in parts if len(each) < len(every)]
        for limits, assumed in (*tries, (every, self.assumed), (every, self.far)):
            if len(limits) < 2:
                continue
            if not time_for("looking without several limits"):
                break
            for found in self._nearest(limits, assumed)[:1]:
                for share in SHARES:
                    told, task = [], self.task
                    for limit in limits:
                        one = loosened(task, limit, found, self.size, share)
                        if one is not None and limit.kind != "driver":
                            told.append(one)
                            task = one.task
                    if told and self.sound(task):
                        return told
        return []

    def _nearest(self, limits: Sequence[StatedLimit], assumed: Assumptions) -> list[FoundLinkage]:
        """Linkages that keep all but some limits, those nearest to keeping them first.

        assumed: where pivots lie that have no limit then.
        """
        boxes: dict[str, Polygon] = {"fixed pivot": assumed.fixed, "moving pivot": assumed.moving}
        loosest = self.task
        for limit in sorted(
            limits, key=lambda each: -each.number
        ):  # regions are taken from the end
            if loosest.surroundings is not None or limit.kind not in NEED_SURROUNDINGS:
                loosest = without(loosest, limit, boxes.get)
        return self._evolved(loosest, {limit.kind for limit in limits})

    def _evolved(self, loosest: Task, kinds: Set[str]) -> list[FoundLinkage]:
        """Linkages of a task with some limits looser, those nearest to the limits as stated first.

        kinds: of these limits.
        """
        # Few tasks need these.
        from burmester.families.family import driver_first  # noqa: PLC0415
        from burmester.families.least_excess import (  # noqa: PLC0415
            assumed_to_build,
            least_excess,
        )
        from burmester.families.open_task import OpenTask  # noqa: PLC0415

        problem = SynthesisProblem.of(loosest, self.problem.motion, self.problem.options).merged()
        open_ = assumed_to_build(problem)
        open_ = replace(open_, asked=looser(open_.asked, kinds))
        loose = OpenTask.of(problem, target_of(problem), open_)
        wide = bool(kinds & DYADS)
        near = least_excess(self.stated, loose, self.drawn, wide=wide)
        if near is None:
            return []
        batch = driver_first(near.trials, loose)
        found = self.judged(batch, loose.rows(near.trials.offsets))
        return list(at_given_poses(found, self.problem))


@final
@dataclass(frozen=True, slots=True, eq=False)
class _ManyPoses(_Search):
    """Five poses and more: the linkages of the task without the limit, nearest to keeping it."""

    def loosened_alone(self) -> Iterator[Loosening]:
        """Each limit loosened alone, where that is enough."""
        for limit in stated_limits(self.task):
            if not time_for(f"looking without the limit on {limit.kind}"):
                break
            near = self.near(limit, without(self.task, limit, lambda _: None))
            told = None if near is None else self.tried(limit, near.found)
            if told is not None:
                yield told if limit.kind in ON_OFF else self._least(limit, told)

    def loosened_together(self) -> list[Loosening]:
        """Nothing: what lies beyond two limits is not looked for."""
        return []

    def _least(self, limit: StatedLimit, most: Loosening) -> Loosening:
        """The least loosening known to be enough, by halving the way to one that is."""
        low, high, best = 0.0, 1.0, most
        for _ in range(BISECTIONS):
            if not time_for("looking for what little would do"):
                break
            middle = (low + high) / 2
            told = loosened(self.task, limit, most.found, self.size, middle)
            near = None if told is None else self.near(limit, told.task)
            if told is None or near is None:
                low = middle
                continue
            high, best = middle, replace(told, found=near.found)
        return best


def _with_causes(synthesis: Synthesis, causes: Sequence[Loosening], *, alone: bool) -> Synthesis:
    """The synthesis with what is to blame, and the near misses."""
    words = [each.message for each in causes]
    if alone:
        why = f"a sound linkage needs {'; or '.join(words)}"
    else:
        why = f"no one limit alone is to blame: a sound linkage needs {' and '.join(words)}"
    why += "; found by a search, so less may be enough"
    if synthesis.outcome.code == "R301" and synthesis.outcome.why:
        why = f"{synthesis.outcome.why}; {why}"
    glue = "; or " if alone else " and "
    help = Help.of("use {}", Help.joined(glue, [each.option for each in causes]))
    if synthesis.outcome.code == "R301" and synthesis.outcome.help:  # what else would do
        help = Help.of("{}; or {}", synthesis.outcome.help, help)
    if any(bears_too_much(each.found) for each in causes):
        help = Help.joined("; or ", [help, SPRING_HELP])
    if synthesis.works:
        warnings = tuple(
            replace(each, why=why, help=help) if each.code == "W216" else each
            for each in synthesis.warnings
        )
        return replace(synthesis, warnings=warnings, causes=tuple(causes))
    before = () if synthesis.outcome.code in FEW else synthesis.linkages
    number = len(synthesis.dyads) if before else 0
    added = []
    for k, each in enumerate(causes if alone else causes[:1]):
        first, second = each.found.dyads
        pair = (
            replace(first, id=f"D{number + 2 * k + 1}"),
            replace(second, id=f"D{number + 2 * k + 2}"),
        )
        rank = len(before) + k + 1
        added.append(replace(each.found, id=f"L{rank}", rank=rank, dyads=pair))
    near = added if alone else added * len(causes)  # one that breaks all of these limits
    causes = [replace(each, found=found) for each, found in zip(causes, near, strict=True)]
    outcome = replace(synthesis.outcome, why=why, help=help)
    dyads = synthesis.dyads if before else tuple(d for each in added for d in each.dyads)
    return replace(
        synthesis,
        outcome=outcome,
        linkages=(*before, *added),
        dyads=dyads,
        causes=tuple(causes),
    )
