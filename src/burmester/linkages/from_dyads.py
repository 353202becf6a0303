"""Dyads joined in pairs: every linkage refined, judged, and ranked by whether it works.

A linkage works where its coupler meets all poses on one circuit, on one branch of a drive, in
their order, and keeps to what is asked of it.  Where the closest linkage does not, the search goes
on under these conditions (`search`), so that the answer is not only what fails, and why.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, product

import numpy as np

from burmester.fourbar.dyad import PP
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import STACKED, LinkageBatch
from burmester.fourbar.nearest_places import nearest, on_circuits, on_own_circuits
from burmester.fourbar.pose_error import error_frames
from burmester.geometry.displacement import Displacement
from burmester.linkages.constraints import AllConstraints, Constraints, DyadLimitsConstraint
from burmester.linkages.defect_free_search import defect_free_linkages, links_of_pivot_map
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.found_linkage import FoundLinkage, Pair
from burmester.linkages.target import Target
from burmester.numerics.arrays import ROUNDING
from burmester.tasks.problem import SynthesisProblem

__all__ = ["linkages_from_dyads"]

TWICE = 2.0  # times the least greatest distance; one circuit may miss by so much for being one
ROUGH, FINE = 8, 52  # steps of refining, for all linkages and for those that come near
GOOD, NEAR = 4, 100.0  # those: so many, and all whose sum of squares is no more times the least
MANY, ENOUGH = 1000, 60  # poses; of more so many are refined for, or looked for linkages with
FEW = 5  # linkages found under conditions are kept, at most


def linkages_from_dyads(
    problem: SynthesisProblem, pairs: Sequence[Pair], *, refine: bool = True
) -> tuple[FoundLinkage, ...]:
    """The linkages of pairs of dyads, those that work first, then by rising worst position error.

    refine: False leaves the dimensions as the dyads have them, whatever the options say.  Pairs
    with a PP dyad are passed over: no single joint drives them.
    """
    options, refine = problem.options, refine and problem.options.refines
    pairs = [pair for pair in pairs if not any(isinstance(each.dyad, PP) for each in pair)]
    if not pairs:
        return ()
    if len(problem.task.limits) < 2:  # pairs of the same kinds are looked at together
        kind = {each.id: STACKED.index(type(each.dyad)) for pair in pairs for each in pair}
        pairs = [(b, a) if kind[b.id] < kind[a.id] else (a, b) for a, b in pairs]
    judging = Evaluation(problem, _aim(problem))
    start = judging.stacked(pairs)
    found = judging.told(_of_pairs(start, pairs, judging.aim, refine))
    closest = min(found, key=lambda each: each.error.worst, default=None)
    if refine and closest is not None and not closest.usable:
        found = judging.ranked(found + _sought(start, pairs, judging, found))
    if options.rounds:
        found = judging.rounded(found)
    return tuple(
        replace(each, id=f"L{rank}", rank=rank) for rank, each in enumerate(found, start=1)
    )


def _aim(problem: SynthesisProblem) -> Target:
    task, length = problem.task, problem.length_per_radian
    frames = error_frames(task.poses, length)
    kept: tuple[Constraints, ...] = ()
    if task.limits:
        kept = tuple(
            DyadLimitsConstraint(side, task.limits[min(side, len(task.limits) - 1)], frames)
            for side in (0, 1)
        )
    return Target(
        frames.see(task.poses),
        length / float(frames.length),
        frames,
        task.requirements,
        kept,
        task.weights,
        task.exact,
        problem.options.norm == "worst",
    )


def _of_pairs(start: LinkageBatch, pairs: list[Pair], aim: Target, refine: bool) -> Candidates:
    """The pairs with their places, on one circuit where that is nearly as near as any."""
    every = np.arange(len(start))
    rows = rows_of(on_circuits(start, aim.poses, aim.length), aim.length)
    one = rows[every, np.nan_to_num(aim.cost(rows), nan=np.inf).argmin(axis=1)]
    places = nearest(Displacement(rows[..., :2], rows[..., 2] / aim.length), aim.poses, aim.length)
    best = rows_of(places, aim.length)
    wanted = rows_of(aim.poses, aim.length)
    away, least = (
        np.sqrt(np.nan_to_num(((each - wanted) ** 2).sum(axis=-1), nan=np.inf)).max(axis=1)
        for each in (one, best)
    )
    apart = away > np.maximum(TWICE * least, ROUNDING)
    both = apart & np.isfinite(away) & np.isfinite(least) & refine
    index = np.concatenate([every, np.flatnonzero(both)])
    rows = np.concatenate([np.where(apart[:, None, None], best, one), one[both]])
    none = np.zeros(len(index), dtype=bool)
    made = Candidates(start[index], rows, [pairs[k] for k in index], none)
    if refine:
        made = _refined(made, aim)
        if len(made.rows[0]) <= MANY:  # refining leaves some in a valley that is not the nearest
            rows = on_own_circuits(made.stack, made.rows, aim.poses, aim.length)
            made = made._replace(rows=rows)
    # What was not touched keeps its digits.
    own = LinkageBatch.of([Linkage(a.dyad, b.dyad) for a, b in made.pairs]).dimensions
    touched = (made.stack.dimensions != start.dimensions[index]).any(axis=(1, 2), keepdims=True)
    own = np.where(touched, made.stack.back(aim.frames).dimensions, own)
    return made._replace(own=LinkageBatch(made.stack.kinds, own))


def _refined(made: Candidates, aim: Target) -> Candidates:
    """The linkages refined, but for those that meet the poses up to rounding already.

    All of them by some steps, and those that come near by as many as it takes.
    """
    cost = aim.cost(made.rows)
    some = np.flatnonzero(cost > ROUNDING**2 * made.rows.shape[1])
    if not len(some):
        return made
    if (thin := aim.thinned(MANY)) is not aim:
        stack = _refined(made._replace(rows=thin.places(made.stack)), thin).stack
        return made._replace(stack=stack, rows=aim.places(stack))
    kept = AllConstraints(aim.kept) if aim.kept else None
    dimensions, rows = made.stack.dimensions.copy(), made.rows.copy()
    plain = not aim.worst and kept is None and aim.exact is None
    for steps in (ROUGH, FINE) if plain else (FINE,):
        stack = LinkageBatch(made.stack.kinds[some], dimensions[some])
        refined = aim.refine(stack, rows[some], conditions=kept, worst=aim.worst, steps=steps)
        with np.errstate(invalid="ignore"):
            better = refined.met & (aim.worst | (aim.cost(refined.rows) <= cost[some]))
        dimensions[some[better]] = refined.stack.dimensions[better]
        rows[some[better]] = refined.rows[better]
        cost = aim.cost(rows)
        near = np.sort(np.nan_to_num(cost, nan=np.inf))[: min(GOOD, len(cost))]
        some = some[~refined.settled]
        some = some[cost[some] <= max(NEAR * near[0], near[-1])]
        if not len(some):
            break
    return made._replace(stack=LinkageBatch(made.stack.kinds, dimensions), rows=rows)


def _sought(
    start: LinkageBatch, pairs: list[Pair], judging: Evaluation, plain: list[FoundLinkage]
) -> list[FoundLinkage]:
    """Linkages that work and come nearer to the poses than the plain ones that do."""
    best = min((each.error.worst for each in plain if each.usable), default=np.inf)
    aim = judging.aim.thinned(ENOUGH)
    stack, origin = _more(start, pairs, judging)
    found = defect_free_linkages(stack, aim)
    if found is None:
        return []
    index = np.flatnonzero(found.refined.met)
    stack, rows = found.refined.stack[index], found.refined.rows[index]
    if aim is not judging.aim:
        rows = judging.aim.places(stack)
    came = [origin[k] for k in found.pair[index]]
    told = judging.told(Candidates(stack, rows, came, np.ones(len(index), dtype=bool)))
    return [each for each in told if each.usable and each.error.worst < best][:FEW]


def _more(
    start: LinkageBatch, pairs: list[Pair], judging: Evaluation
) -> tuple[LinkageBatch, list[Pair]]:
    """Where the search starts from: the pairs, and links that are low in the pivot maps."""
    if judging.problem.task.limits:
        return start, pairs
    links = links_of_pivot_map(judging.aim.poses, judging.problem.task.weights)
    own = {each.id: each for pair in pairs for each in pair}
    map_ = [
        judging.dyad(f"M{number}", judging.aim.frames.circle_back(link[None])[0])
        for number, link in enumerate(links, start=1)
    ]
    every = [*pairs, *combinations(map_, 2), *product(own.values(), map_)]
    return judging.stacked(every), every
