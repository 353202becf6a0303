"""The search for defect-free linkages, where the closest ones have defects.

From pairs of dyads, on each circuit, with each dyad driving and on each branch, all dimensions are
refined under constraints: the poses stay on that branch, clear of its dead points and in order,
and all requirements hold.  The results are local minima: that there is no better linkage is not
proved.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.foot_points import foot_points, rows_of
from burmester.fourbar.linkage_batch import LinkageBatch, Transmission
from burmester.fourbar.nearest_places import on_circuits
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, concatenate, replaced, take, wrapped_angle
from burmester.refinement.constraints import (
    CLEARANCE_ANGLE,
    SHORTEST_LINK,
    AllConstraints,
    BranchAndOrder,
    DrivenBranch,
    LeastLinks,
    LinkProportions,
    type_excess,
)
from burmester.refinement.least_error import Refined
from burmester.refinement.starts import first_order_miss, projected, varied
from burmester.refinement.target import Target
from burmester.refinement.under_constraints import Selection
from burmester.tasks.requirements import Requirements

# Linkages are refined under constraints on at most so many poses, evenly thinned, and by their last
# steps on so many.
FEW_POSES, MORE_POSES, MORE_STEPS = 14, 60, 20
MAX_CONTINUED = 8  # number of linkages whose last steps are on more poses
MAX_STARTS = 144  # number of starts at most
# Numbers of refinement steps, and after each the number of the best starts that go on.
SELECTION = (12, 32), (30, 16), (50, 8)
STEPS = 120  # number of refinement steps at most
# Linkages that transmit too little at the places nearest to the poses are refined again: how often,
# by how many steps, for how many times what they lack; and the lack that is none, radians.
FOOT_ROUNDS, FOOT_STEPS, FOOT_SHARE, FOOT_TOLERANCE = 2, 20, 1.2, 1e-7
WRONG_BRANCH_SCORE = 0.1  # squared lengths; start score: penalty per pose on the wrong branch
# Squared lengths; two weightings of branch violation and backtracking in the score; half of the
# starts come from each.
VIOLATION_WEIGHTS = 0.1, 1.0
PAIRS_ON_CIRCUITS = 64  # number of first pairs of which each circuit gives starts
USES_OF_A_DYAD = 8  # number of starts from the poses, of each weighting, that one dyad is in


class SearchResult(NamedTuple):
    """Linkages (k,) refined under constraints, the indices (k,) of their pairs, and drivers."""

    refined: Refined
    pair: NDArray[np.intp]
    driver: NDArray[np.intp]


class _Starts(NamedTuple):
    """Starts (k,) of the search: pair, dimensions, rows (k, N, 3) of places, branch."""

    pair: NDArray[np.intp]
    batch: LinkageBatch
    rows: FloatArray
    branch: DrivenBranch


def defect_free_linkages(
    batch: LinkageBatch, target: Target, dyads: NDArray[np.intp]
) -> SearchResult | None:
    """The best linkages under all constraints, from pairs (k,) of dyads; None if there are none.

    dyads: (k, 2), the numbers of the dyads in the pairs, for variety.  All starts get some steps,
    the best of them more (`SELECTION`).
    """
    starts = _best_starts(batch, target, dyads)
    if not len(starts.pair):
        return None
    found = target.refine(
        starts.batch,
        starts.rows,
        constraints=_all_constraints(starts, target),
        constrained_steps=STEPS,
        selection=SELECTION,
    )
    index = np.flatnonzero(found.met)
    if target.worst and len(index):
        starts = take(starts, index)._replace(batch=found.batch[index], rows=found.rows[index])
        found = target.refine(
            starts.batch,
            starts.rows,
            constraints=_all_constraints(starts, target),
            worst=True,
            constrained_steps=STEPS,
        )
    return SearchResult(_kept_at_feet(found, starts, target), starts.pair, starts.branch.driver)


def refined_on_branch(
    batch: LinkageBatch,
    rows: FloatArray,
    target: Target,
    driver: NDArray[np.intp],
    *,
    steps: int,
    transmission: FloatArray | None = None,
    metric: FloatArray | None = None,
    selection: Selection = (),
    most: float = inf,
) -> Refined:
    """Linkages (k,) refined under all constraints, on the branches of their places (k, N, 3).

    driver: (k,), the side that drives; transmission: (k,), a least angle for each, where more is
    asked of it than the target does; metric: (k, 1, 3, 3), and selection, as in `refine`; most: a
    combined error; what is beyond twice that does not go on.  Of many poses few are refined on,
    evenly thinned, and what is best then on more of them; the others do not meet the constraints.
    """
    few, index = target.thinned(FEW_POSES), target.thin_numbers(FEW_POSES)
    refined = _on_branch(
        batch,
        rows[:, index],
        few,
        driver,
        steps=steps,
        transmission=transmission,
        metric=metric,
        selection=selection,
        most=most,
    )
    if few is target:
        return refined
    going = np.flatnonzero(refined.met)
    going = going[np.argsort(refined.cost[going], kind="stable")][:MAX_CONTINUED]
    some, rows, met = on_more_poses(
        refined.batch[going], driver[going], target, *_at(going, transmission, metric)
    )
    every = np.full((len(batch), *rows.shape[1:]), nan)
    every[going] = rows
    cost, all_met = np.full(len(batch), inf), np.zeros(len(batch), dtype=bool)
    cost[going], all_met[going] = target.cost(rows) / 2, met & np.isfinite(rows).all(axis=(1, 2))
    there = replaced(refined.batch, going, some)
    return Refined(there, every, cost, refined.settled, all_met)


def on_more_poses(
    batch: LinkageBatch,
    driver: NDArray[np.intp],
    target: Target,
    transmission: FloatArray | None = None,
    metric: FloatArray | None = None,
) -> tuple[LinkageBatch, FloatArray, NDArray[np.bool_]]:
    """Linkages (k,) refined on few poses, refined on more under the same constraints.

    With their places (k, N, 3) at all poses of the target, and which (k,) keep to the constraints;
    the others stay as they were.
    """
    more = target.thinned(MORE_POSES)
    rows = more.places(batch)
    sound = np.flatnonzero(np.isfinite(rows).all(axis=(1, 2)))
    met = np.zeros(len(batch), dtype=bool)
    if len(sound):
        asked, counts = _at(sound, transmission, metric)
        refined = _on_branch(
            batch[sound],
            rows[sound],
            more,
            driver[sound],
            steps=MORE_STEPS,
            transmission=asked,
            metric=counts,
        )
        met[sound] = refined.met
        better = take((refined.batch, refined.rows), refined.met)
        batch, rows = replaced((batch, rows), met, better)
    return batch, rows if more is target else target.places(batch), met


def _at(index: NDArray[np.intp], *each: FloatArray | None) -> list[FloatArray | None]:
    """The rows of arrays at the indices; None stays None."""
    return [None if every is None else every[index] for every in each]


def _on_branch(
    batch: LinkageBatch,
    rows: FloatArray,
    target: Target,
    driver: NDArray[np.intp],
    *,
    steps: int,
    transmission: FloatArray | None,
    metric: FloatArray | None,
    selection: Selection = (),
    most: float = inf,
) -> Refined:
    """`refined_on_branch` on all poses of the target."""
    sine = Transmission.of(batch, rows, target.length, driver).sine
    middle = _middle_inputs(batch, target.places_of(rows[:, 0]), driver)
    branch = DrivenBranch(driver, np.where(np.nansum(sine, axis=1) < 0, -1.0, 1.0), middle)
    starts = _Starts(np.arange(len(batch)), batch, rows, branch)
    refined = target.refine(
        batch,
        rows,
        constraints=_all_constraints(starts, target, transmission),
        worst=target.worst,
        constrained_steps=steps,
        metric=metric,
        selection=selection,
    )
    near = refined.met & ~(target.combined_error(refined.rows) > 2 * most)
    return _kept_at_feet(replace(refined, met=near), starts, target, transmission, metric)


def _kept_at_feet(
    refined: Refined,
    starts: _Starts,
    target: Target,
    transmission: FloatArray | None = None,
    metric: FloatArray | None = None,
) -> Refined:
    """Refined linkages (k,) that keep the transmission angle nearest to the poses."""
    if target.boxes is not None or target.path is not None:
        return refined
    least = np.full(len(starts.pair), max(CLEARANCE_ANGLE, target.requirements.transmission))
    least = least if transmission is None else np.maximum(least, transmission)
    asked, (batch, rows) = least.copy(), (refined.batch, refined.rows)
    wanted = rows_of(target.poses, target.length)
    index = np.flatnonzero(refined.met)
    for _ in range(FOOT_ROUNDS):
        feet = foot_points(batch[index], rows[index], wanted, target.length)
        there = take(starts, index)._replace(batch=batch[index], rows=feet)
        kept = BranchAndOrder.of(*there[1:3], target.length, there.branch, target.requirements)
        short = np.nan_to_num(least[index] - kept.least_transmission(batch[index], feet))
        again = short > FOOT_TOLERANCE
        index, short = index[again], short[again]
        if not len(index):
            break
        asked[index] += FOOT_SHARE * short
        some = take(starts, index)._replace(batch=batch[index], rows=rows[index])
        more = target.refine(
            some.batch,
            some.rows,
            constraints=_all_constraints(some, target, asked[index]),
            worst=target.worst,
            constrained_steps=FOOT_STEPS,
            metric=None if metric is None else metric[index],
        )
        index, better = index[more.met], take((more.batch, more.rows, more.cost), more.met)
        batch, rows, cost = replaced((batch, rows, refined.cost), index, better)
        refined = replace(refined, batch=batch, rows=rows, cost=cost)
    return refined


def _best_starts(batch: LinkageBatch, target: Target, dyads: NDArray[np.intp]) -> _Starts:
    """The starts of pairs (k,) with the best scores, from the poses and from nearest places."""
    starts, score = _starts_at_poses(batch, target, dyads)
    there = _starts_on_circuits(batch[:PAIRS_ON_CIRCUITS], target)
    if len(there.pair):
        sine, _, _ = Transmission.of(there.batch, there.rows, target.length, there.branch.driver)
        wrong = (there.branch.sign[:, None] * sine < 0).sum(axis=1)
        score = np.concatenate([score, target.cost(there.rows) + WRONG_BRANCH_SCORE * wrong])
        starts = concatenate([starts, there])
    return take(starts, np.argsort(score, kind="stable")[:MAX_STARTS])


def _starts_at_poses(
    batch: LinkageBatch, target: Target, dyads: NDArray[np.intp]
) -> tuple[_Starts, FloatArray]:
    """Starts of pairs (k,) at the poses, and scores by distance, branch and order."""
    count, number = len(batch), target.poses.shape[0]
    wanted = rows_of(target.poses, target.length)
    rows = np.broadcast_to(wanted, (count, number, 3))
    miss = first_order_miss(batch, target.poses, target.length, target.weights)
    found = []
    for side in driving_sides(target.requirements):
        lead = np.full(count, side)
        sine, drive, turns = Transmission.of(batch, rows, target.length, lead)
        step = np.diff(drive, axis=1)
        step = np.where(turns[:, None], wrapped_angle(step), step)
        back = np.min([np.maximum(way * step, 0.0).sum(axis=1) for way in (1, -1)], axis=0)
        round_ = np.min([(way * step % (2 * np.pi)).sum(axis=1) for way in (1, -1)], axis=0)
        back = np.where(turns, np.minimum(back, np.maximum(round_ - 2 * np.pi, 0.0)), back)
        for sign in (1.0, -1.0):
            wrong = np.maximum(np.sin(CLEARANCE_ANGLE) - sign * sine, 0.0).sum(axis=1)
            wrong += 0.0 if target.requirements.any_order else back
            found.append(np.stack([np.arange(count), lead, np.full(count, sign), wrong]))
    pair, lead, sign, wrong = np.concatenate(found, axis=1)
    pair = pair.astype(np.intp)
    with np.errstate(invalid="ignore"):
        scores = miss[pair] + np.array(VIOLATION_WEIGHTS)[:, None] * wrong
    most = MAX_STARTS // len(VIOLATION_WEIGHTS)
    best = np.unique(
        np.concatenate([varied(score, dyads[pair], most, USES_OF_A_DYAD) for score in scores])
    )
    pair, driver = pair[best], lead[best].astype(np.intp)
    rows, sound = projected(batch[pair], rows[pair], target.length)
    pair, driver, best, rows = pair[sound], driver[sound], best[sound], rows[sound]
    middle = _middle_inputs(batch[pair], target.places_of(rows[:, 0]), driver)
    branch = DrivenBranch(driver, sign[best], middle)
    starts = _Starts(pair, batch[pair], rows, branch)
    return starts, scores[0, best]


def driving_sides(asked: Requirements) -> tuple[int, ...]:
    """The sides that are allowed to drive."""
    return {"first": (0,), "second": (1,)}.get(asked.driver, (0, 1))


def _starts_on_circuits(batch: LinkageBatch, target: Target) -> _Starts:
    """Starts of each pair on each circuit, with each driver, on each branch with a pose."""
    places = on_circuits(batch, target.poses, target.length)
    rows = rows_of(places, target.length)
    found = []
    for side in driving_sides(target.requirements):
        for circuit in (0, 1):
            some = np.flatnonzero(np.isfinite(rows[:, circuit]).all(axis=(1, 2)))
            leads = np.full(len(some), side)
            sine, _, _ = Transmission.of(batch[some], rows[some, circuit], target.length, leads)
            middle = middle_input(batch[some], places[some, circuit, 0], side)
            for sign in (1.0, -1.0):
                on = (sign * sine > 0).any(axis=1)
                whole = np.empty((5, int(on.sum())))
                whole[:] = np.array([[0.0], [circuit], [side], [sign], [0.0]])
                whole[0], whole[4] = some[on], middle[on]
                found.append(whole)
    table = np.concatenate(found, axis=1)
    pair, on_circuit, driver = table[:3].astype(np.intp)
    branch = DrivenBranch(driver, table[3], table[4])
    return _Starts(pair, batch[pair], rows[pair, on_circuit], branch)


def _middle_inputs(
    batch: LinkageBatch, places: Displacement, driver: NDArray[np.intp]
) -> FloatArray:
    """`middle_input` (k,) of linkages with drivers (k,)."""
    middle = np.full(len(batch), np.nan)
    for side in (0, 1):
        if (some := driver == side).any():
            middle[some] = middle_input(batch[some], places[some], side)
    return middle


def middle_input(batch: LinkageBatch, places: Displacement, side: int) -> FloatArray:
    """The input (k,) halfway between the dead points of the circuits on which places (k,) are.

    nan where there are none, and for sliding inputs.
    """
    circuits = Circuits.of(batch.exchanged() if side else batch, as_given=True)
    own = circuits.locate(places).circuit
    between = (circuits.branches == 2) & circuits.turns
    with np.errstate(invalid="ignore"):  # slides without end, from -inf to inf
        middle = np.where(between, circuits.input_range.mean(axis=-1), np.nan)
    return np.where(own < 0, np.nan, middle[np.arange(len(batch)), np.maximum(own, 0)])


def _all_constraints(
    starts: _Starts, target: Target, transmission: FloatArray | None = None
) -> AllConstraints:
    """All that the linkages are to keep to."""
    asked = target.requirements
    _, batch, rows, branch = starts
    branch_and_order = BranchAndOrder.of(batch, rows, target.length, branch, asked)
    if transmission is not None:
        branch_and_order = branch_and_order.transmitting(transmission)
    driver = branch.driver
    types = np.array([_nearest_type(batch, k, int(side), asked) for k, side in enumerate(driver)])
    proportions = LinkProportions(target.length, target.frames, asked, driver, types)
    short = () if target.least_links is None else (LeastLinks(target.least_links),)
    return AllConstraints((branch_and_order, proportions, *short, *target.kept))


def _nearest_type(batch: LinkageBatch, index: int, driver: int, asked: Requirements) -> str:
    """Of the 4R types allowed the one nearest to a linkage, "" where it is one of them."""
    if (batch.kinds[index] != 0).any():
        return ""
    four_bars = {*SHORTEST_LINK, "triple-rocker"}
    allowed = four_bars if asked.allowed_types is None else four_bars & asked.allowed_types
    if asked.driver == "crank":
        allowed = allowed & {"crank-rocker", "double-crank"}
    elif asked.types is None:
        return ""
    names = sorted(allowed)
    excess = type_excess(batch[[index] * len(names)], np.full(len(names), driver), names)
    return names[int(excess.max(axis=1).argmin())] if names else ""
