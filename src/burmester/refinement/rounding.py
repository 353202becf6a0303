"""The rounding of lengths and pivots to numbers that can be bought and drilled.

Rounding all dimensions at once would miss the poses by more than necessary.  Links from stock come
first, either neighbour, with the other dimensions refitted (`refinement.refine`).  A linear
estimate then gives the whole numbers of steps nearest to least squares, and the actual places of a
few hundred of these decide.  From the best, single dimensions and pairs move by one step as long
as that helps.  That no other rounding is better is not proved.

Limits, branch, order and requirements that hold before rounding hold afterwards if any candidate
meets them; a pivot on a line or at a point comes within half a step of it.  An exact pose has a
hundred times the largest weight.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import circuit_of
from burmester.fourbar.foot_points import foot_points, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch, Transmission
from burmester.fourbar.nearest_places import on_circuits
from burmester.numerics.arrays import (
    FloatArray,
    concatenate,
    take,
    weights_of_mean_one,
    weights_or_ones,
)
from burmester.numerics.differences import DifferenceQuotients
from burmester.numerics.integer_least_squares import closest_numbers, firmest_last
from burmester.refinement.constraints import (
    SHORTEST_LINK,
    AllConstraints,
    BranchAndOrder,
    Constraints,
    ConstraintSlopes,
    ConstraintValues,
    DrivenBranch,
    LinkProportions,
)
from burmester.refinement.defect_free_search import middle_input
from burmester.refinement.dimension_grid import Grid
from burmester.refinement.target import Target

SIZE = 2 * DIMENSIONS
QUOTIENTS = DifferenceQuotients(stride=1e-4, central=True)  # of places, by rounding steps
PULL_TO_START = 0.01  # weight of a step away from the start, relative to a dimension's rms effect
# Number of roundings that the breadth-first search keeps: at most, at least.
MAX_ROUNDINGS, MIN_ROUNDINGS = 256, 16
MAX_PLACES = 25600  # number of coupler places computed for them; with more poses fewer are kept
MOVED_ROUNDINGS = 3  # number of best roundings that single steps improve
MAX_MOVES = 20  # number of moves of one or two dimensions at most
MAX_POSES_OF_PAIRS = 100  # number of poses; with more, only single dimensions move
EXACT_WEIGHT = 100.0  # weight of an exact pose, relative to the largest other weight
OFF_LINKAGE = 1e-9  # residual, in lengths; a place with a greater one is lost
CONSTRAINT_ROUNDING = 1e-9  # lengths; a constraint violated by less is met
NEAR_LIMIT = 2.0  # steps; limits nearer than this are constraints of the refit
MIN_CLEARANCE_SINE = 0.01  # sine of the transmission angle that keeps clear of dead points
SAME_DISTANCE = 1e-12  # lengths; distances that differ by less are equal


def rounded(
    batch: LinkageBatch,
    rows: FloatArray,
    target: Target,
    *,
    step: float | None,
    stock: Sequence[float] = (),
    driver: NDArray[np.intp] | None = None,
) -> tuple[LinkageBatch, FloatArray]:
    """Linkages (k,) with rounded dimensions, in the task's own frames and unit.

    batch, and rows (k, N, 3) of places near the poses, in the frames of `target`; the rows returned
    are in these, too, and on the circuits where they were if any rounding tried leads there; nan
    where the linkage has no place.  The batch returned is in the task's own frames, for changing
    frames would cost its numbers their last digits.
    step: pivots, link lengths and sliders' offsets are multiples of it, each the nearest double;
        sliders' lines are at multiples of a decimal part of a degree (10, 1, 0.1, ...) that moves
        a point at the motion's size by half a step at most.  None: they are not rounded.
    stock: available lengths of RR dyads' links, instead of multiples; empty: any.  The coupler and
        the ground are as long as their pivots are apart.
    driver: (k,), the side that drives, by default the first: its branch and order stay.
    The rounding chosen has the least greatest (weighted) distance from the poses of all candidates.
    """
    stock = sorted({float(length) for length in stock})
    out, places = batch.from_canonical(target.frames).dimensions.copy(), rows.copy()
    for k in range(len(batch)):
        side = 0 if driver is None else int(driver[k])
        one = _Rounding.of(batch[k : k + 1], rows[k], target, step=step, stock=stock, driver=side)
        own, places[k] = one.best(out[k].reshape(SIZE))
        out[k] = own.reshape(2, DIMENSIONS)
    return LinkageBatch(batch.kinds, out), places


@final
@dataclass(frozen=True, slots=True, eq=False)
class _PreviouslyMet:
    """The constraints (m,) of one linkage that it met before rounding; the others count as met."""

    inner: Constraints
    before: NDArray[np.bool_]

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        value, equal = self.inner(batch, rows, np.zeros(len(which), dtype=np.intp))
        return np.where(self.before, value, np.where(equal, 0.0, -1.0)), equal

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """Also the derivatives; those that count as met have none."""
        value, slope, equal = self.inner.differentiated(
            batch, rows, np.zeros(len(which), dtype=np.intp), place_jacobian
        )
        value = np.where(self.before, value, np.where(equal, 0.0, -1.0))
        return value, np.where(self.before[:, None], slope, 0.0), equal


class _Candidates(NamedTuple):
    """Candidates (n,) for the rounding of one linkage.

    own: dimensions (n, 10), in the task's frames; rows: (n, N, 3), the places.
    violation: (n,), of the constraints, in lengths.
    worst: (n,), the greatest distance from a pose; infinite for lost places.
    """

    own: FloatArray
    rows: FloatArray
    violation: FloatArray
    worst: FloatArray

    def filled(self, count: int) -> _Candidates:
        """The first `count` of them, the first one repeated where there are fewer."""
        index = np.arange(count)
        return take(self, np.where(index < len(self.worst), index, 0))

    def order(self) -> NDArray[np.intp]:
        """The indices (n,) from the best to the worst; equals keep their order."""
        merit = np.round((self.worst + self.violation) / SAME_DISTANCE)
        return np.lexsort([merit, (self.violation > 0) | ~np.isfinite(self.worst)])

    def beats(self, other: _Candidates) -> bool:
        """Whether the first candidate is better than the other's first by more than rounding."""
        if not np.isfinite(self.worst[0]):
            return False
        if not np.isfinite(other.worst[0]):
            return True
        if (self.violation[0] > 0) != (other.violation[0] > 0):
            return bool(other.violation[0] > 0)
        gain = other.worst[0] + other.violation[0] - self.worst[0] - self.violation[0]
        return bool(gain > SAME_DISTANCE)


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Rounding:
    """The rounding of one linkage: its places, target, grid of values and constraints.

    near_limit: whether constraints matter while dimensions are refitted.
    slack: (m,), the violation of each constraint that rounding excuses, in lengths.
    """

    kinds: NDArray[np.int8]
    rows: FloatArray
    target: Target
    grid: Grid
    constraints: _PreviouslyMet
    near_limit: bool
    slack: FloatArray

    @classmethod
    def of(
        cls,
        batch: LinkageBatch,
        rows: FloatArray,
        target: Target,
        *,
        step: float | None,
        stock: Sequence[float],
        driver: int,
    ) -> _Rounding:
        """The rounding of a batch of one, with rows (N, 3) of its places."""
        unit = float(target.frames.length)
        if target.exact is not None:
            number = target.poses.shape[0]
            weights = weights_or_ones(target.weights, (number,))
            weights = np.where(target.exact, EXACT_WEIGHT * weights.max(), weights)
            target = replace(target, weights=weights, exact=None)
        lead, here = np.array([driver]), rows[None]
        with np.errstate(invalid="ignore"):
            positive = Transmission.of(batch, here, target.length, lead).sine > 0
        sine = np.where(positive.mean(axis=1) >= 0.5, 1.0, -1.0)  # that of most places
        middle = middle_input(batch, target.places_of(rows[None, 0]), driver)
        branch_and_order = BranchAndOrder.of(
            batch, here, target.length, DrivenBranch(lead, sine, middle), target.requirements
        )
        clear = np.array([max(MIN_CLEARANCE_SINE, np.sin(target.requirements.transmission))])
        branch_and_order = replace(branch_and_order, clear=clear)
        types = np.array([_required_type(batch, driver, target)])
        links = LinkProportions(target.length, target.frames, target.requirements, lead, types)
        inner = AllConstraints((branch_and_order, links, *target.kept))
        value, equal = inner(batch, here, np.zeros(1, dtype=np.intp))
        with np.errstate(invalid="ignore"):
            before = (np.where(equal, np.abs(value), value) < CONSTRAINT_ROUNDING)[0]
        # Without a step (stock lengths only) a tenth of the unit stands for it.
        reach = NEAR_LIMIT * (step if step is not None else 0.1 * unit) / unit
        near_limit = bool((before & (equal | (value[0] > -reach))).any())
        half = 0.0 if step is None else step / np.sqrt(2) / unit
        slack = np.where(equal, half + CONSTRAINT_ROUNDING, CONSTRAINT_ROUNDING)
        grid = Grid.of(batch.kinds[0], step, stock, unit)
        return cls(
            batch.kinds, rows, target, grid, _PreviouslyMet(inner, before), near_limit, slack
        )

    def best(self, own: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The best rounding (10,) of dimensions (10,), and the rows (N, 3) of its places."""
        naive = self._candidates(
            self.grid.values(self.grid.nearest(self.grid.number(own)), own)[None]
        )
        if not self.grid.rounded.any():
            return own, self.rows
        if not np.isfinite(self.rows).all():
            return self._on_nearer_circuit(naive)
        starts = self._with_stock_links(own)
        if self.grid.step is None:
            ends = starts
        else:
            near = [self._nearest_to_estimate(start) for start in starts]
            every = concatenate(near)
            number = [self.grid.number(start.own[0]) for start in starts]
            ends = [
                self._improved(take(every, slice(k, k + 1)), number[k // MOVED_ROUNDINGS])
                for k in every.order()[:MOVED_ROUNDINGS]
            ]
        pool = concatenate([naive, *ends])
        pool = pool._replace(violation=pool.violation + ~self._on_circuits(pool))
        first = take(pool, pool.order()[:1])
        if not np.isfinite(first.worst[0]):
            return self._on_nearer_circuit(naive)
        return first.own[0], first.rows[0]

    def _batch(self, own: FloatArray) -> LinkageBatch:
        """Dimensions (n, 10) in the task's frames, as those of `target` see them."""
        kinds = np.broadcast_to(self.kinds, (len(own), 2))
        return LinkageBatch(kinds, own.reshape(-1, 2, DIMENSIONS)).to_canonical(self.target.frames)

    def _candidates(self, own: FloatArray, rows: FloatArray | None = None) -> _Candidates:
        """Dimensions (n, 10), with the places that rows (N, 3) or (n, N, 3) lead to."""
        start = np.broadcast_to(self.rows if rows is None else rows, (len(own), *self.rows.shape))
        batch, wanted = self._batch(own), rows_of(self.target.poses, self.target.length)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            rows = foot_points(batch, start, wanted, self.target.length)
            # Two equal dyads leave no direction back to the linkage: places off it are lost.
            at = self.target.places_of(rows)
            rows[~(np.abs(batch.jacobians(at).residual) < OFF_LINKAGE).all(axis=(1, 2))] = np.nan
            away = np.sqrt(((rows - wanted) ** 2).sum(axis=-1))
            away = away * np.sqrt(weights_of_mean_one(self.target.weights, rows.shape[1:2]))
            value, equal = self.constraints(batch, rows, np.arange(len(own)))
            off = np.where(equal, np.abs(value), value) - self.slack
            violation = np.where(off > 0, off, 0.0).max(axis=1, initial=0.0)
        worst = np.nan_to_num(away.max(axis=-1), nan=np.inf)
        return _Candidates(own, rows, violation, worst)

    def _with_stock_links(self, own: FloatArray) -> list[_Candidates]:
        """The linkage (1,), or one for each choice of links from stock, the rest refitted."""
        if not (len(self.grid.stock) and self.grid.links.any()):
            return [self._candidates(own[None])]
        number, links = self.grid.number(own), self.grid.links
        made = np.tile(own, (4, 1))
        for k, choice in enumerate(choices := self.grid.beside(number)):
            made[k, links] = self.grid.stock[np.array(choice, dtype=int)]
        fitted = self._refitted(made[: len(choices)], links)
        return [take(fitted, slice(k, k + 1)) for k in range(len(fitted.worst))]

    def _nearest_to_estimate(self, start: _Candidates) -> _Candidates:
        """The roundings of a linkage (1,) nearest to its linear least-squares estimate, sorted.

        Among whole numbers n the least |r + J n|² is looked for breadth first: with J = Q R, one
        number after the other, the last columns first, the best few going on each time.  J is
        taken by differences of the nearest places.
        """
        own, rows, grid = start.own[0], start.rows[0], self.grid
        stride = grid.stride()
        some = np.flatnonzero(stride)
        if not (np.isfinite(rows).all() and len(some)):
            return self._candidates(grid.values(grid.nearest(grid.number(own)), own)[None]).filled(
                MOVED_ROUNDINGS
            )
        beside = QUOTIENTS.points(own, np.eye(SIZE)[some] * stride[some, None])
        root = np.sqrt(weights_or_ones(self.target.weights, rows.shape[:1]))[:, None]
        slope = root[..., None] * QUOTIENTS.jacobian(self._candidates(beside, rows).rows)
        slope = np.nan_to_num(slope.reshape(-1, len(some)))
        gap = (root * (rows - rows_of(self.target.poses, self.target.length))).ravel()
        # The estimate is good near the start only: dimensions with little effect stay near it.
        short = PULL_TO_START * np.sqrt((slope**2).sum(axis=0).mean()) + np.finfo(float).tiny
        slope = np.concatenate([slope, short * np.eye(len(some))])
        gap = np.concatenate([gap, np.zeros(len(some))])
        order = firmest_last(slope)
        some, number = some[order], grid.number(own)
        width = min(MAX_ROUNDINGS, max(MIN_ROUNDINGS, MAX_PLACES // len(rows)))
        whole = closest_numbers(
            slope[:, order], gap, number[some], positive=grid.links[some], width=width
        )
        number = np.tile(np.rint(number), (len(whole), 1))
        number[:, some] = whole
        number = number[grid.possible(number, grid.number(own))]
        nearest = grid.nearest(grid.number(own))[None]
        candidates = self._candidates(grid.values(np.concatenate([number, nearest]), own), rows)
        return take(candidates, candidates.order()).filled(MOVED_ROUNDINGS)

    def _refitted(self, own: FloatArray, fixed: NDArray[np.bool_]) -> _Candidates:
        """Dimensions (n, 10) with the free ones fitted again, (10,) being held."""
        before = self._candidates(own)
        slots = np.ones((2, DIMENSIONS), dtype=bool)
        slots[:, -1] = self.kinds[0] == 0
        free = slots.reshape(SIZE) & ~fixed
        sound = np.flatnonzero(np.isfinite(before.worst))
        if not len(sound):
            return before
        batch = self._batch(own[sound])
        refined = self.target.refine(
            batch,
            before.rows[sound],
            free=np.broadcast_to(free, (len(sound), SIZE)),
            constraints=self.constraints if self.near_limit else None,
            worst=self.target.worst,
        )
        new = refined.batch.from_canonical(self.target.frames).dimensions.reshape(-1, SIZE)
        new = np.where(fixed, own[sound], new)
        after = self._candidates(new, refined.rows)
        # Where the refit diverges, the candidates before it stay.
        fitted = np.flatnonzero(np.isfinite(after.worst))
        others = np.setdiff1d(np.arange(len(own)), sound[fitted])
        return concatenate([take(after, fitted), take(before, others)])

    def _improved(self, here: _Candidates, middle: FloatArray) -> _Candidates:
        """One rounding (1,) improved by moves of single dimensions and pairs, a step each."""
        moves = _moves(self.grid.rounded, pairs=len(self.rows) <= MAX_POSES_OF_PAIRS)
        for _ in range(MAX_MOVES):
            number = np.rint(self.grid.number(here.own[0])) + moves
            number = number[self.grid.possible(number, middle)]
            own = self.grid.values(number, here.own[0])
            lost = np.isnan(here.rows[0]).any()
            there = self._candidates(own, self.rows if lost else here.rows[0])
            there = take(there, there.order()[:1])
            if not there.beats(here):
                break
            here = there
        return here

    def _on_circuits(self, candidates: _Candidates) -> NDArray[np.bool_]:
        """Whether all places (n,) are on one circuit, if they were before."""

        def on_one(batch: LinkageBatch, rows: FloatArray) -> NDArray[np.bool_]:
            out = np.zeros(len(batch), dtype=bool)
            places = self.target.places_of(rows)
            for index, linkage in batch.alike():
                circuit = circuit_of(linkage, places[index], as_given=True).circuit
                out[index] = (circuit == circuit[:, :1]).all(axis=1)
            return out

        sound = np.isfinite(candidates.worst)
        out = np.ones(len(sound), dtype=bool)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            out[sound] = on_one(self._batch(candidates.own[sound]), candidates.rows[sound])
        return out

    def _on_nearer_circuit(self, candidates: _Candidates) -> tuple[FloatArray, FloatArray]:
        """A rounding whose places were lost, with those on its nearer circuit; nan if none."""
        target, batch = self.target, self._batch(candidates.own)
        found = on_circuits(batch, target.poses, target.length)
        rows = rows_of(found, target.length)[0]
        miss = batch.jacobians(found).residual[0]
        rows[~(np.abs(miss) < OFF_LINKAGE).all(axis=(0, 2))] = np.nan
        away = ((rows - rows_of(target.poses, target.length)) ** 2).sum(axis=-1).max(axis=-1)
        return candidates.own[0], rows[int(np.nan_to_num(away, nan=np.inf).argmin())]


def _moves(some: NDArray[np.bool_], pairs: bool) -> FloatArray:
    """Moves (n, 10) of one or two of some dimensions (10,), by a step either way."""
    single = [sign * row for row in np.eye(SIZE)[some] for sign in (1, -1)]
    both = [a + b for a, b in combinations(single, 2) if (a + b).any()] if pairs else []
    return np.array(single + both)


def _required_type(batch: LinkageBatch, driver: int, target: Target) -> str:
    """The type of a 4R linkage if something is asked of types, else ""."""
    asked = target.requirements
    if (batch.kinds != 0).any() or (asked.types is None and asked.driver != "crank"):
        return ""
    led = batch.exchanged() if driver else batch
    name = led.linkage(0).type
    return name if name in SHORTEST_LINK or name == "triple-rocker" else ""
