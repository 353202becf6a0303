"""Pairs beside those of the dyads: of links with low errors, and of such links with dyads.

The locally best dyads do not always make the best linkage, and within limits there may be two of
them only.  So linkages closer than theirs are looked for from further pairs, and the search for
linkages that work starts from them, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, pairwise, product
from typing import Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.selection import FoundDyad
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.judged_places import at_nearest
from burmester.numerics.arrays import FloatArray, concatenate
from burmester.refinement.constraints import AllConstraints
from burmester.refinement.starts import (
    best_sliders,
    distinct,
    first_order_miss,
    links_of_pivot_map,
    projected,
    varied,
)
from burmester.refinement.target import Target
from burmester.verdicts.found_linkage import FoundLinkage, Pair

MAX_POSES_SEARCHED = 60  # look for linkages on at most so many poses, evenly thinned
# Number of pairs refined a little, how often a dyad is among them, and number refined fully.
MAX_PAIRS, USES_OF_A_DYAD, MAX_REFINED = 32, 4, 8
# A linkage is refined fully below this many times the lowest cost known.
HOPEFUL_COST_RATIO = 4.0
STEPS = (8, 16), (52, 104)  # numbers of steps of both refinements, without and within limits


@final
@dataclass(frozen=True, slots=True, eq=False)
class FurtherPairs:
    """Pairs (k,) beside those of the dyads.

    links: of low errors, and the best sliders where they are no dyads; given: the dyads.
    parts: (k, 2), the numbers of both in the pairs, links first.  batch: (k,).  Links and batch in
        the frames of the target.
    """

    evaluation: Evaluation
    links: list[RR | PR | RP]
    given: list[FoundDyad]
    parts: NDArray[np.intp]
    batch: LinkageBatch

    @classmethod
    def of(cls, pairs: list[Pair], evaluation: Evaluation) -> Self:
        """Those beside pairs of dyads, each dyad within its own limits."""
        target, task = evaluation.target.thinned(MAX_POSES_SEARCHED), evaluation.problem.task
        sides: list[list[RR | PR | RP]] = [
            links_of_pivot_map(target.poses, target.weights, limits, target.frames)
            for limits in task.limits or (None,)
        ]
        if evaluation.problem.options.method == "exact" and not task.limits:
            # The dyads are those that meet five poses, and other sliders may make what works.
            sides[0] += best_sliders(target.poses, target.weights)
        own = [list({each.id: each for pair in pairs for each in pair}.values())]
        if len(sides) == 2:
            own = [list({pair[side].id: pair[side] for pair in pairs}.values()) for side in (0, 1)]
        links = [link for side in sides for link in side]
        given = [dyad for side in own for dyad in side]
        ends = np.cumsum([0, *map(len, sides), *map(len, own)])
        numbers = [range(*each) for each in pairwise(ends.tolist())]
        if len(sides) == 1:
            new, old = numbers
            every = [*combinations(new, 2), *product(old, new)]
        else:
            new, new2, old, old2 = numbers
            every = [*product(new, new2), *product(old, new2), *product(new, old2)]
        parts = np.array(every, dtype=np.intp).reshape(-1, 2)
        one = LinkageBatch.of([Linkage(each, each) for each in links])
        one = concatenate([one, evaluation.stacked([(each, each) for each in given])])
        batch = LinkageBatch(one.kinds[parts, 0], one.dimensions[parts, 0])
        return cls(evaluation, links, given, parts, batch)

    def origin(self, index: int) -> Pair:
        """The dyads of one of them."""
        first, second = (self._dyad(number) for number in self.parts[index].tolist())
        return first, second

    def _dyad(self, number: int) -> FoundDyad:
        if number >= len(self.links):
            return self.given[number - len(self.links)]
        frames, link = self.evaluation.target.frames, self.links[number]
        if isinstance(link, RR):
            own: Dyad = frames.circle_from_canonical(link[None])[0]
        else:
            own = frames.line_from_canonical(link)
        poses = self.evaluation.task.poses
        return FoundDyad.of(f"M{number + 1}", own, poses, minimum=False)

    def beside(
        self,
        start: LinkageBatch,
        pairs: list[Pair],
        found: list[FoundLinkage],
        evaluation: Evaluation,
    ) -> PairsToSearch:
        """All that a search starts from: pairs of dyads, `start`, and what was found to fall short.

        The latter are linkages that meet the poses and not what is asked.
        """
        near = [each.dyads for each in found if not each.usable or each.shortcomings]
        batches = [start, *([evaluation.stacked(near)] if near else []), self.batch]
        return PairsToSearch(concatenate(batches), [*pairs, *near], self)


@final
@dataclass(frozen=True, slots=True, eq=False)
class PairsToSearch:
    """Pairs (k,), in the frames of the target: `first` ones, and further ones after them."""

    batch: LinkageBatch
    first: list[Pair]
    further: FurtherPairs

    @property
    def parts(self) -> NDArray[np.intp]:
        """The numbers (k, 2) of their dyads; of the first ones each has numbers of its own."""
        alone = np.arange(-2 * len(self.first), 0).reshape(-1, 2)
        return np.concatenate([alone, self.further.parts])

    def origin(self, index: int) -> Pair:
        """The dyads of one of them."""
        count = len(self.first)
        return self.first[index] if index < count else self.further.origin(index - count)


def closer_linkages(
    further: FurtherPairs, evaluation: Evaluation, known: list[FoundLinkage]
) -> list[FoundLinkage]:
    """Linkages from further pairs that are closer than all known ones.

    Most of these pairs lead to known linkages as well; those are given up on the way.
    """
    target = evaluation.target.thinned(MAX_POSES_SEARCHED)
    miss = first_order_miss(further.batch, target.poses, target.length, target.weights)
    index = varied(miss, further.parts, MAX_PAIRS, USES_OF_A_DYAD)
    wanted = rows_of(target.poses, target.length)
    rows = np.broadcast_to(wanted, (len(index), *wanted.shape))
    rows, sound = projected(further.batch[index], rows, target.length)
    index, rows = index[sound], rows[sound]
    batch, kept = further.batch[index], AllConstraints(target.kept) if target.kept else None
    known_rows = _rows(known, evaluation, target)
    least = float(np.nan_to_num(target.cost(known_rows), nan=np.inf).min(initial=np.inf))
    for (steps, constrained), ratio in zip(STEPS, (HOPEFUL_COST_RATIO, 1.0), strict=True):
        if not len(index):
            return []
        refined = target.refine(
            batch,
            rows,
            constraints=kept,
            worst=target.worst and ratio == 1.0,
            steps=steps,
            constrained_steps=constrained,
        )
        cost = np.where(refined.met, target.cost(refined.rows), np.nan)
        cost[~(cost < ratio * least)] = np.nan
        best = distinct(refined.rows, cost, MAX_REFINED, known_rows)
        index, batch, rows = index[best], refined.batch[best], refined.rows[best]
    if not len(index):
        return []
    if target is not evaluation.target:
        rows = evaluation.target.places(batch)
    own = batch.from_canonical(evaluation.target.frames)
    batch = own.to_canonical(evaluation.target.frames)  # by the numbers that are told
    rows, both = at_nearest(batch, rows, evaluation.target)
    origins = [further.origin(k) for k in index.tolist()]
    return evaluation.evaluate(Candidates(batch, rows, origins, own=own, both=both))


def _rows(found: list[FoundLinkage], evaluation: Evaluation, target: Target) -> FloatArray:
    """The rows (k, N, 3) of the places of linkages, at the poses of a target perhaps thinned."""
    if not found:
        return np.empty((0, target.poses.shape[0], 3))
    if target is not evaluation.target:
        return target.places(evaluation.stacked([each.dyads for each in found]))
    return np.stack([target.rows_at(each.error.places) for each in found])
