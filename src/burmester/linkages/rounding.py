"""Lengths and pivots as they can be bought and drilled: rounded, the rest fitted again.

All dimensions rounded at once miss the poses by more than need be.  Here links from stock come
first, either neighbour, all else fitted again (`refinement.refine`).  Which whole numbers of steps
are nearest to least squares is then asked of the linear estimate (`_Rounding._near`), and a few
hundred of the best are judged by the places where the coupler is.  From the best of these, single
dimensions and pairs are moved by a step as long as that helps.  That no other rounding is better
is not proved.

A limit, the branch and the order of the poses, and what is asked of the links hold after rounding
where some rounding tried keeps them; a pivot on a line or at a point comes within half a step of
it.  An exact pose is one that counts a hundred times.
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
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.fourbar.nearest_places import on_circuits
from burmester.geometry.displacement import Displacement
from burmester.linkages.constraints import (
    SHORTEST,
    AllConstraints,
    BranchAndOrder,
    Constraints,
    ConstraintValues,
    LinkProportions,
    signed_transmission_sine,
)
from burmester.linkages.defect_free_search import middle_of
from burmester.linkages.dimension_grid import Grid
from burmester.linkages.target import Target
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import concatenate, take
from burmester.numerics.differences import DifferenceQuotients
from burmester.numerics.integer_least_squares import closest_numbers, firmest_last
from burmester.numerics.weights import weights_of_mean_one, weights_or_ones

__all__ = ["rounded"]

SIZE = 2 * DIMENSIONS
QUOTIENTS = DifferenceQuotients(stride=1e-4, central=True)  # of places, by rounding steps
NEAR = 0.01  # of a dimension's usual effect, what a step away from the start counts as
MOST, LEAST = 256, 16  # roundings that go on from number to number
PLACES = 25600  # of their couplers, that are looked at
BEST = 3  # roundings from which single dimensions are moved
MOVES = 20  # at most, of single dimensions and pairs
MANY = 100  # poses; for more only single dimensions are moved
EXACT = 100.0  # weights; what an exact pose counts as
OFF = 1e-9  # lengths; a place farther off its linkage is lost
KEPT = 1e-9  # lengths; what is left by less is kept
TOUCHED = 2.0  # steps; limits nearer than this are minded while the rest is fitted again
CLEAR = 0.01  # of dead points, the sine of the transmission angle
ALIKE = 1e-12  # lengths; distances that differ by less are the same


def rounded(  # noqa: PLR0917
    stack: LinkageBatch,
    rows: FloatArray,
    aim: Target,
    step: float | None,
    stock: Sequence[float],
    driver: NDArray[np.intp] | None = None,
) -> tuple[LinkageBatch, FloatArray]:
    """Linkages (k,) with rounded dimensions, in the task's own frames and unit.

    stack, and rows (k, N, 3) of places near the poses, in the frames of `aim`; the rows returned
    are in these, too, and on the circuits where they were if any rounding tried leads there; nan
    where the linkage has no place.  The stack returned is in the task's own frames, for changing
    frames would cost its numbers their last digits.
    step: pivots, link lengths and sliders' offsets are multiples of it, each the nearest double;
        sliders' lines are at multiples of a decimal part of a degree (10, 1, 0.1, ...) that moves
        a point at the motion's size by half a step at most.  None leaves them as they are fitted.
    stock: lengths that the links of RR dyads come in, instead of multiples; none for any.  The
        coupler and the ground are as long as their pivots are apart.
    driver: (k,), the side that drives, by default the first: its branch and order are kept.
    Of all roundings tried the one with the least greatest (weighted) distance from the poses.
    """
    stock = sorted({float(length) for length in stock})
    out, places = stack.back(aim.frames).dimensions.copy(), rows.copy()
    for k in range(len(stack)):
        side = 0 if driver is None else int(driver[k])
        one = _Rounding.of(stack[k : k + 1], rows[k], aim, step, stock, side)
        own, places[k] = one.best(out[k].reshape(SIZE))
        out[k] = own.reshape(2, DIMENSIONS)
    return LinkageBatch(stack.kinds, out), places


@final
@dataclass(frozen=True, slots=True, eq=False)
class _AsBefore:
    """Conditions of one linkage, of those only that it kept to before, (m,)."""

    inner: Constraints
    before: NDArray[np.bool_]

    def __call__(
        self, stack: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        value, equal = self.inner(stack, rows, np.zeros(len(which), dtype=np.intp))
        return np.where(self.before, value, np.where(equal, 0.0, -1.0)), equal


class _Tried(NamedTuple):
    """Roundings (n,) of one linkage: dimensions (n, 10) in the task's frames, places, and merit.

    broken: by how much something is not kept, in lengths.  worst: the greatest distance, infinite
        where lost.
    """

    own: FloatArray
    rows: FloatArray
    broken: FloatArray
    worst: FloatArray

    def filled(self, count: int) -> _Tried:
        """The first `count` of them, the first one repeated where there are fewer."""
        index = np.arange(count)
        return take(self, np.where(index < len(self.worst), index, 0))

    def order(self) -> NDArray[np.intp]:
        """The best first; of equals that which was tried first."""
        merit = np.round((self.worst + self.broken) / ALIKE)
        return np.lexsort([merit, (self.broken > 0) | ~np.isfinite(self.worst)])

    def beats(self, other: _Tried) -> bool:
        """Whether its first is better than the other's by more than rounding."""
        if not np.isfinite(self.worst[0]):
            return False
        if not np.isfinite(other.worst[0]):
            return True
        if (self.broken[0] > 0) != (other.broken[0] > 0):
            return bool(other.broken[0] > 0)
        gain = other.worst[0] + other.broken[0] - self.worst[0] - self.broken[0]
        return bool(gain > ALIKE)


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Rounding:
    """One linkage that is rounded: where it is to be near, what it keeps to, and the values."""

    kinds: NDArray[np.int8]
    rows: FloatArray
    aim: Target
    grid: Grid
    keep: _AsBefore
    touched: bool
    slack: FloatArray

    @classmethod
    def of(  # noqa: PLR0917
        cls,
        stack: LinkageBatch,
        rows: FloatArray,
        aim: Target,
        step: float | None,
        stock: Sequence[float],
        driver: int,
    ) -> _Rounding:
        """Of a stack of one, with rows (N, 3) of its places."""
        unit = float(aim.frames.length)
        if aim.exact is not None:
            number = aim.poses.shape[0]
            weights = np.ones(number) if aim.weights is None else aim.weights
            weights = np.where(aim.exact, EXACT * weights.max(), weights)
            aim = replace(aim, weights=weights, exact=None)
        lead, here = np.array([driver]), rows[None]
        sine = _sign(stack, here, aim.length, lead)
        middle = middle_of(stack, aim.places_of(rows[None, 0]), driver)
        journey = BranchAndOrder.of(stack, here, aim.length, lead, sine, middle, aim.requirements)
        clear = max(CLEAR, float(np.sin(aim.requirements.transmission)))
        journey = replace(journey, clear=clear)
        types = np.array([_type_kept(stack, driver, aim)])
        links = LinkProportions(aim.length, aim.frames, aim.requirements, lead, types)
        inner = AllConstraints((journey, links, *aim.kept))
        value, equal = inner(stack, here, np.zeros(1, dtype=np.intp))
        with np.errstate(invalid="ignore"):
            before = (np.where(equal, np.abs(value), value) < KEPT)[0]
        # The step of stock, too: what its lengths may press against is minded all the same.
        reach = TOUCHED * (step if step is not None else 0.1 * unit) / unit
        touched = bool((before & (equal | (value[0] > -reach))).any())
        half = 0.0 if step is None else step / np.sqrt(2) / unit
        slack = np.where(equal, half + KEPT, KEPT)
        grid = Grid.of(stack.kinds[0], step, stock, unit)
        return cls(stack.kinds, rows, aim, grid, _AsBefore(inner, before), touched, slack)

    def best(self, own: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The best rounding (10,) found of dimensions (10,), and the rows (N, 3) of its places."""
        naive = self._tried(self.grid.values(self.grid.nearest(self.grid.number(own)), own)[None])
        if not self.grid.rounded.any():
            return own, self.rows
        if not np.isfinite(self.rows).all():
            return self._somewhere(naive)
        starts = self._with_links(own)
        if self.grid.step is None:
            ends = starts
        else:
            near = [self._near(start) for start in starts]
            every = concatenate(near)
            number = [self.grid.number(start.own[0]) for start in starts]
            ends = [
                self._moved(take(every, slice(k, k + 1)), number[k // BEST])
                for k in every.order()[:BEST]
            ]
        pool = concatenate([naive, *ends])
        pool = pool._replace(broken=pool.broken + ~self._on_circuits(pool))
        first = take(pool, pool.order()[:1])
        if not np.isfinite(first.worst[0]):
            return self._somewhere(naive)
        return first.own[0], first.rows[0]

    def _stack(self, own: FloatArray) -> LinkageBatch:
        """Dimensions (n, 10) in the task's frames, as those of `aim` see them."""
        kinds = np.broadcast_to(self.kinds, (len(own), 2))
        return LinkageBatch(kinds, own.reshape(-1, 2, DIMENSIONS)).seen(self.aim.frames)

    def _tried(self, own: FloatArray, rows: FloatArray | None = None) -> _Tried:
        """Dimensions (n, 10), with the places that rows (N, 3) or (n, N, 3) lead to."""
        start = np.broadcast_to(self.rows if rows is None else rows, (len(own), *self.rows.shape))
        stack, wanted = self._stack(own), rows_of(self.aim.poses, self.aim.length)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            rows = foot_points(stack, start, wanted, self.aim.length)
            # Two equal dyads leave no direction to go back to the linkage: off is lost.
            at = Displacement(rows[..., :2], rows[..., 2] / self.aim.length)
            rows[~(np.abs(stack.bearing(at).miss) < OFF).all(axis=(1, 2))] = np.nan
            away = np.sqrt(((rows - wanted) ** 2).sum(axis=-1))
            away = away * np.sqrt(weights_of_mean_one(self.aim.weights, rows.shape[1:2]))
            value, equal = self.keep(stack, rows, np.arange(len(own)))
            off = np.where(equal, np.abs(value), value) - self.slack
            broken = np.where(off > 0, off, 0.0).max(axis=1, initial=0.0)
        worst = np.nan_to_num(away.max(axis=-1), nan=np.inf)
        return _Tried(own, rows, broken, worst)

    def _with_links(self, own: FloatArray) -> list[_Tried]:
        """The linkage (1,), or one for each choice of links from stock, the rest fitted again."""
        if not (len(self.grid.stock) and self.grid.links.any()):
            return [self._tried(own[None])]
        number, links = self.grid.number(own), self.grid.links
        made = np.tile(own, (4, 1))
        for k, choice in enumerate(choices := self.grid.beside(number)):
            made[k, links] = self.grid.stock[np.array(choice, dtype=int)]
        fitted = self._fitted(made[: len(choices)], links)
        return [take(fitted, slice(k, k + 1)) for k in range(len(fitted.worst))]

    def _near(self, start: _Tried) -> _Tried:
        """The best roundings of a linkage (1,), in place order: those near by a linear estimate.

        Among whole numbers n the least |r + J n|² is looked for breadth first: with J = Q R, one
        number after the other, the last columns first, the best few going on each time.  J is
        taken by differences of the nearest places.
        """
        own, rows, grid = start.own[0], start.rows[0], self.grid
        stride = grid.stride()
        some = np.flatnonzero(stride)
        if not (np.isfinite(rows).all() and len(some)):
            return self._tried(grid.values(grid.nearest(grid.number(own)), own)[None]).filled(BEST)
        beside = QUOTIENTS.points(own, np.eye(SIZE)[some] * stride[some, None])
        root = np.sqrt(weights_or_ones(self.aim.weights, rows.shape[:1]))[:, None]
        slope = root[..., None] * QUOTIENTS.jacobian(self._tried(beside, rows).rows)
        slope = np.nan_to_num(slope.reshape(-1, len(some)))
        gap = (root * (rows - rows_of(self.aim.poses, self.aim.length))).ravel()
        # Far from where the estimate was made it is worth less: what is loose stays near.
        short = NEAR * np.sqrt((slope**2).sum(axis=0).mean()) + np.finfo(float).tiny
        slope = np.concatenate([slope, short * np.eye(len(some))])
        gap = np.concatenate([gap, np.zeros(len(some))])
        order = firmest_last(slope)
        some, number = some[order], grid.number(own)
        width = min(MOST, max(LEAST, PLACES // len(rows)))
        whole = closest_numbers(slope[:, order], gap, number[some], grid.links[some], width)
        number = np.tile(np.rint(number), (len(whole), 1))
        number[:, some] = whole
        number = number[grid.possible(number, grid.number(own))]
        nearest = grid.nearest(grid.number(own))[None]
        tried = self._tried(grid.values(np.concatenate([number, nearest]), own), rows)
        return take(tried, tried.order()).filled(BEST)

    def _fitted(self, own: FloatArray, held: NDArray[np.bool_]) -> _Tried:
        """Dimensions (n, 10) with the free ones fitted again, (10,) being held."""
        before = self._tried(own)
        slots = np.ones((2, DIMENSIONS), dtype=bool)
        slots[:, -1] = self.kinds[0] == 0
        free = slots.reshape(SIZE) & ~held
        sound = np.flatnonzero(np.isfinite(before.worst))
        if not len(sound):
            return before
        stack = self._stack(own[sound])
        refined = self.aim.refine(
            stack,
            before.rows[sound],
            free=np.broadcast_to(free, (len(sound), SIZE)),
            conditions=self.keep if self.touched else None,
            worst=self.aim.worst,
        )
        new = refined.stack.back(self.aim.frames).dimensions.reshape(-1, SIZE)
        new = np.where(held, own[sound], new)
        after = self._tried(new, refined.rows)
        # Fitting may lose its way; then what was there before is kept.
        fitted = np.flatnonzero(np.isfinite(after.worst))
        others = np.setdiff1d(np.arange(len(own)), sound[fitted])
        return concatenate([take(after, fitted), take(before, others)])

    def _moved(self, here: _Tried, middle: FloatArray) -> _Tried:
        """One rounding (1,) improved by moves of single dimensions and pairs, a step each."""
        moves = _moves(self.grid.rounded, pairs=len(self.rows) <= MANY)
        for _ in range(MOVES):
            number = np.rint(self.grid.number(here.own[0])) + moves
            number = number[self.grid.possible(number, middle)]
            own = self.grid.values(number, here.own[0])
            lost = np.isnan(here.rows[0]).any()
            there = self._tried(own, self.rows if lost else here.rows[0])
            there = take(there, there.order()[:1])
            if not there.beats(here):
                break
            here = there
        return here

    def _on_circuits(self, tried: _Tried) -> NDArray[np.bool_]:
        """Whether all places (n,) are on one circuit, if they were before."""

        def on_one(stack: LinkageBatch, rows: FloatArray) -> NDArray[np.bool_]:
            out = np.zeros(len(stack), dtype=bool)
            places = Displacement(rows[..., :2], rows[..., 2] / self.aim.length)
            for index, linkage in stack.alike():
                circuit = circuit_of(linkage, places[index], as_given=True).circuit
                out[index] = (circuit == circuit[:, :1]).all(axis=1)
            return out

        sound = np.isfinite(tried.worst)
        out = np.ones(len(sound), dtype=bool)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            out[sound] = on_one(self._stack(tried.own[sound]), tried.rows[sound])
        return out

    def _somewhere(self, tried: _Tried) -> tuple[FloatArray, FloatArray]:
        """A rounding whose places were lost, with those on its nearer circuit; nan if none."""
        aim, stack = self.aim, self._stack(tried.own)
        found = on_circuits(stack, aim.poses, aim.length)
        rows = rows_of(found, aim.length)[0]
        miss = stack.bearing(found).miss[0]
        rows[~(np.abs(miss) < OFF).all(axis=(0, 2))] = np.nan
        away = ((rows - rows_of(aim.poses, aim.length)) ** 2).sum(axis=-1).max(axis=-1)
        return tried.own[0], rows[int(np.nan_to_num(away, nan=np.inf).argmin())]


def _moves(some: NDArray[np.bool_], pairs: bool) -> FloatArray:
    """Moves (n, 10) of one or two of some dimensions (10,), by a step either way."""
    single = [sign * row for row in np.eye(SIZE)[some] for sign in (1, -1)]
    both = [a + b for a, b in combinations(single, 2) if (a + b).any()] if pairs else []
    return np.array(single + both)


def _sign(
    stack: LinkageBatch, rows: FloatArray, length: float, driver: NDArray[np.intp]
) -> FloatArray:
    """The sign (k,) of the transmission angle at most of the places (k, N, 3)."""
    with np.errstate(invalid="ignore"):
        positive = (signed_transmission_sine(stack, rows, length, driver) > 0).mean(axis=1)
    return np.where(positive >= 0.5, 1.0, -1.0)


def _type_kept(stack: LinkageBatch, driver: int, aim: Target) -> str:
    """The type of a 4R linkage if something is asked of types, else ""."""
    asked = aim.requirements
    if (stack.kinds != 0).any() or (asked.types is None and asked.driver != "crank"):
        return ""
    led = stack.exchanged() if driver else stack
    name = led.linkage(0).type
    return name if name in SHORTEST or name == "triple-rocker" else ""
