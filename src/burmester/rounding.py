"""Lengths and pivots as they can be bought and drilled: rounded, the rest fitted again.

All dimensions rounded at once miss the poses by more than need be.  Here some are rounded after
the others, links first, either way to their neighbours; what is not yet rounded is fitted again
each time (`refinement.refine`), and the best few go on.  Then single dimensions, and pairs of
them, are moved by a step each as long as that helps, judged by the places where the coupler is.
That no other rounding is better is not proved.

A limit, the branch and the order of the poses, and what is asked of the links hold after rounding
where some rounding tried keeps them; a pivot on a line or at a point comes within half a step of
it.  An exact pose is one that counts a hundred times.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, product
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.accuracy import on_circuits, rows_of, settled
from burmester.circuit import circuit_of
from burmester.conditions import (
    SHORTEST,
    Conditions,
    Held,
    Journey,
    Proportions,
    Together,
    lever_sine,
)
from burmester.displacement import Displacement, FloatArray
from burmester.search import Aim
from burmester.stack import DIMENSIONS, LinkageStack

__all__ = ["multiple", "rounded"]

SIZE = 2 * DIMENSIONS
FEW = 4  # roundings of some dimensions that go on
ROUNDS = 4  # of multipliers, while the rest is fitted again
MOVES = 100  # at most, of single dimensions and pairs
MANY = 100  # poses; for more only single dimensions are moved
EXACT = 100.0  # weights; what an exact pose counts as
KEPT = 1e-9  # lengths; what is left by less is kept
TOUCHED = 2.0  # steps; limits nearer than this are minded while the rest is fitted again
CLEAR = 0.01  # of dead points, the sine of the transmission angle
ALIKE = 1e-12  # lengths; distances that differ by less are the same
WHOLE = 2.0**53  # from here on not every whole number is a double


def rounded(
    stack: LinkageStack,
    rows: FloatArray,
    aim: Aim,
    step: float | None,
    stock: Sequence[float],
    driver: NDArray[np.intp] | None = None,
) -> tuple[LinkageStack, FloatArray]:
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
    return LinkageStack(stack.kinds, out), places


def multiple(count: FloatArray, step: float) -> FloatArray:
    """Multiples (*,) of a step as its decimal digits say, each the nearest double."""
    exact = Fraction(repr(float(step)))
    over, under = exact.numerator, exact.denominator
    top = np.abs(count).max(initial=0.0)
    if top * over < WHOLE and under < 1e22 and int(float(under)) == under:
        return np.asarray(count * float(over) / float(under))  # of exact numbers: rounded once
    values = [float(int(each) * exact) for each in np.ravel(count)]
    return np.array(values).reshape(np.shape(count))


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Grid:
    """The values that the ten dimensions of one linkage may have, numbered by whole numbers.

    links, lines, lengths: (10,), which are links' lengths, normal angles, and other lengths.
    """

    step: float | None
    turn: float | None
    stock: FloatArray
    links: NDArray[np.bool_]
    lines: NDArray[np.bool_]
    lengths: NDArray[np.bool_]

    @classmethod
    def of(
        cls, kinds: NDArray[np.int8], step: float | None, stock: Sequence[float], size: float
    ) -> _Grid:
        """Of a linkage with dyads of kinds (2,), and a motion of this size."""
        links, lines = np.zeros((2, DIMENSIONS), dtype=bool), np.zeros((2, DIMENSIONS), dtype=bool)
        links[:, 4] = kinds == 0
        lines[:, 0], lines[:, 2] = kinds == 1, kinds == 2
        lengths = ~links & ~lines
        lengths[:, 4] = False
        turn = None
        if step is not None:
            turn = min(10.0, 10.0 ** np.floor(np.log10(np.degrees(step / size))))
            turn = float(f"{turn:.0e}")  # 10 ** -3.0 is not always 0.001
        parts = (each.reshape(SIZE) for each in (links, lines, lengths))
        return cls(step, turn, np.array(stock, dtype=float), *parts)

    @property
    def rounded(self) -> NDArray[np.bool_]:
        """Which dimensions are rounded at all."""
        links = self.links & (len(self.stock) > 0 or self.step is not None)
        return np.asarray(links | ((self.lines | self.lengths) & (self.step is not None)))

    def groups(self) -> list[list[int]]:
        """The dimensions in the order in which they are rounded, some at a time.

        Links and lines first: offsets count from lines whose angles stay.
        """
        first = np.flatnonzero((self.links | self.lines) & self.rounded)
        out = [first.tolist()]
        for half in (slice(0, 2), slice(2, 4)):
            for side in (0, DIMENSIONS):
                slots = np.arange(side, side + DIMENSIONS)[half]
                out.append([int(j) for j in slots if self.lengths[j] and self.rounded[j]])
        return [group for group in out if group]

    def number(self, dimensions: FloatArray) -> FloatArray:
        """Where dimensions (*, 10) are among the values: whole numbers, and what is between."""
        out = np.zeros(dimensions.shape)
        if self.step is not None:
            out = dimensions / self.step
            out[..., self.lines] = np.degrees(dimensions[..., self.lines]) / self.turn
        if len(self.stock):
            at = np.interp(dimensions[..., self.links], self.stock, np.arange(len(self.stock)))
            out[..., self.links] = at
        return out

    def possible(self, number: FloatArray) -> NDArray[np.bool_]:
        """Whether there are links of these lengths, of numbers (*, 10)."""
        least, most = (0, len(self.stock) - 1) if len(self.stock) else (1, np.inf)
        links = number[..., self.links]
        return np.asarray(((links >= least) & (links <= most)).all(axis=-1))

    def nearest(self, number: FloatArray) -> FloatArray:
        """The whole numbers nearest to numbers (*, 10), of links that are possible."""
        out = np.rint(number)
        if len(self.stock):
            return out
        out[..., self.links] = np.maximum(out[..., self.links], 1.0)
        return out

    def beside(self, number: FloatArray, group: list[int]) -> list[tuple[float, ...]]:
        """Whole numbers on either side of those (10,) in a group, the nearest ones first."""
        sides = []
        for j in group:
            low, high = np.floor(number[j]), np.ceil(number[j])
            if self.links[j] and not len(self.stock):
                low, high = max(low, 1.0), max(high, 1.0)
            sides.append([float(low)] if low == high else [float(low), float(high)])
        at = number[group]
        return sorted(product(*sides), key=lambda each: float(((np.array(each) - at) ** 2).sum()))

    def values(self, number: FloatArray, dimensions: FloatArray) -> FloatArray:
        """Dimensions (*, 10) with those that are rounded at their whole numbers."""
        out = np.array(dimensions)
        if self.step is not None and self.turn is not None:
            some = self.lengths | self.links
            out[..., some] = multiple(number[..., some], self.step)
            out[..., self.lines] = np.radians(multiple(number[..., self.lines], self.turn))
        if len(self.stock):
            out[..., self.links] = self.stock[number[..., self.links].astype(int)]
        return out


@final
@dataclass(frozen=True, slots=True, eq=False)
class _AsBefore:
    """Conditions of one linkage, of those only that it kept to before, (m,)."""

    inner: Conditions
    before: NDArray[np.bool_]

    def __call__(self, stack: LinkageStack, rows: FloatArray, which: NDArray[np.intp]) -> Held:
        value, equal = self.inner(stack, rows, np.zeros(len(which), dtype=np.intp))
        return np.where(self.before, value, np.where(equal, 0.0, -1.0)), equal


class _Tried(NamedTuple):
    """Roundings (n,) of one linkage: dimensions (n, 10) in the task's frames, places, and merit.

    broken: whether something is not kept; worst: the greatest distance, infinite where lost.
    """

    own: FloatArray
    rows: FloatArray
    broken: NDArray[np.bool_]
    worst: FloatArray

    def some(self, index: NDArray[np.intp]) -> _Tried:
        """Those at the indices."""
        return _Tried(*(part[index] for part in self))

    def order(self) -> NDArray[np.intp]:
        """The best first; of equals that which was tried first."""
        merit = np.round(self.worst / ALIKE)
        return np.lexsort([merit, self.broken | ~np.isfinite(self.worst)])

    def beats(self, other: _Tried) -> bool:
        """Whether its first is better than the other's by more than rounding."""
        if self.broken[0] != other.broken[0] and np.isfinite(self.worst[0]):
            return bool(other.broken[0])
        return bool(self.worst[0] < other.worst[0] - ALIKE)


@final
@dataclass(frozen=True, slots=True, eq=False)
class _Rounding:
    """One linkage that is rounded: where it is to be near, what it keeps to, and the values."""

    kinds: NDArray[np.int8]
    rows: FloatArray
    aim: Aim
    grid: _Grid
    keep: _AsBefore
    touched: bool
    equal: FloatArray

    @classmethod
    def of(  # noqa: PLR0917
        cls,
        stack: LinkageStack,
        rows: FloatArray,
        aim: Aim,
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
        journey = Journey.of(stack, here, aim.length, lead, sine, aim.requirements)
        clear = max(CLEAR, float(np.sin(aim.requirements.transmission)))
        journey = replace(journey, clear=clear)
        types = np.array([_type_kept(stack, driver, aim)])
        links = Proportions(aim.length, aim.frames, aim.requirements, lead, types)
        inner = Together((journey, links, *aim.kept))
        value, equal = inner(stack, here, np.zeros(1, dtype=np.intp))
        with np.errstate(invalid="ignore"):
            before = (np.where(equal, np.abs(value), value) < KEPT)[0]
        # The step of stock, too: what its lengths may press against is minded all the same.
        reach = TOUCHED * (step if step is not None else 0.1 * unit) / unit
        touched = bool((before & (equal | (value[0] > -reach))).any())
        half = 0.0 if step is None else step / np.sqrt(2) / unit
        slack = np.where(equal, half + KEPT, KEPT)
        grid = _Grid.of(stack.kinds[0], step, stock, unit)
        return cls(stack.kinds, rows, aim, grid, _AsBefore(inner, before), touched, slack)

    def best(self, own: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The best rounding (10,) found of dimensions (10,), and the rows (N, 3) of its places."""
        naive = self._tried(self.grid.values(self.grid.nearest(self.grid.number(own)), own)[None])
        if not self.grid.rounded.any():
            return own, self.rows
        if not np.isfinite(self.rows).all():
            return self._somewhere(naive)
        found = self._one_by_one(own)
        if self.grid.step is None:
            ends = [found, naive]
        else:
            ends = [self._moved(start) for start in (found, naive) if np.isfinite(start.worst[0])]
        pool = _Tried(*(np.concatenate(parts) for parts in zip(naive, *ends, strict=True)))
        pool = pool._replace(broken=pool.broken | ~self._on_circuits(pool))
        first = pool.some(pool.order()[:1])
        if not np.isfinite(first.worst[0]):
            return self._somewhere(naive)
        return first.own[0], first.rows[0]

    def _stack(self, own: FloatArray) -> LinkageStack:
        """Dimensions (n, 10) in the task's frames, as those of `aim` see them."""
        kinds = np.broadcast_to(self.kinds, (len(own), 2))
        return LinkageStack(kinds, own.reshape(-1, 2, DIMENSIONS)).seen(self.aim.frames)

    def _tried(self, own: FloatArray, rows: FloatArray | None = None) -> _Tried:
        """Dimensions (n, 10), with the places that rows (N, 3) or (n, N, 3) lead to."""
        start = np.broadcast_to(self.rows if rows is None else rows, (len(own), *self.rows.shape))
        stack, wanted = self._stack(own), rows_of(self.aim.poses, self.aim.length)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            rows = settled(stack, start, wanted, self.aim.length)
            away = np.sqrt(((rows - wanted) ** 2).sum(axis=-1))
            if self.aim.weights is not None:
                away = away * np.sqrt(self.aim.weights / self.aim.weights.mean())
            value, equal = self.keep(stack, rows, np.arange(len(own)))
            kept = np.where(equal, np.abs(value), value) <= self.equal
        worst = np.nan_to_num(away.max(axis=-1), nan=np.inf)
        return _Tried(own, rows, ~kept.all(axis=1), worst)

    def _one_by_one(self, own: FloatArray) -> _Tried:
        """Some dimensions rounded after the others, the rest fitted again."""
        held = ~self.grid.rounded & False
        best = self._tried(own[None])
        for group in self.grid.groups():
            held = held.copy()
            held[group] = True
            made, rows = [], []
            for each, places in zip(best.own, best.rows, strict=True):
                number = self.grid.number(each)
                for choice in self.grid.beside(number, group):
                    new = np.rint(number)
                    new[group] = choice
                    made.append(np.where(held, self.grid.values(new, each), each))
                    rows.append(places)
            best = self._fitted(np.array(made), np.array(rows), held)
            best = best.some(best.order()[:FEW])
        return best.some(best.order()[:1])

    def _fitted(self, own: FloatArray, rows: FloatArray, held: NDArray[np.bool_]) -> _Tried:
        """Dimensions (n, 10) with the free ones fitted again, (10,) being held."""
        before = self._tried(own, rows)
        slots = np.ones((2, DIMENSIONS), dtype=bool)
        slots[:, -1] = self.kinds[0] == 0
        free = slots.reshape(SIZE) & ~held
        if not free.any():
            return before
        sound = np.flatnonzero(np.isfinite(before.worst))
        if not len(sound):
            return before
        stack = self._stack(own[sound])
        refined = self.aim.refine(
            stack,
            before.rows[sound],
            free=np.broadcast_to(free, (len(sound), SIZE)),
            conditions=self.keep if self.touched else None,
            rounds=ROUNDS,
        )
        new = refined.stack.back(self.aim.frames).dimensions.reshape(-1, SIZE)
        new = np.where(held, own[sound], new)
        after = self._tried(new, refined.rows)
        # Fitting is for squares, and may lose its way: what was there before is kept beside.
        return _Tried(*(np.concatenate(parts) for parts in zip(after, before, strict=True)))

    def _moved(self, here: _Tried) -> _Tried:
        """One rounding (1,) improved by moves of single dimensions and pairs, a step each."""
        moves = _moves(self.grid.rounded, pairs=len(self.rows) <= MANY)
        for _ in range(MOVES):
            number = np.rint(self.grid.number(here.own[0])) + moves
            number = number[self.grid.possible(number)]
            own = self.grid.values(number, here.own[0])
            there = self._tried(own, here.rows[0])
            there = there.some(there.order()[:1])
            if not there.beats(here):
                break
            here = there
        return here

    def _on_circuits(self, tried: _Tried) -> NDArray[np.bool_]:
        """Whether all places (n,) are on one circuit, if they were before."""

        def on_one(stack: LinkageStack, rows: FloatArray) -> NDArray[np.bool_]:
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
        aim = self.aim
        found = on_circuits(self._stack(tried.own), aim.poses, aim.length)
        rows = rows_of(found, aim.length)[0]
        away = ((rows - rows_of(aim.poses, aim.length)) ** 2).sum(axis=-1).max(axis=-1)
        return tried.own[0], rows[int(np.nan_to_num(away, nan=np.inf).argmin())]


def _moves(some: NDArray[np.bool_], pairs: bool) -> FloatArray:
    """Moves (n, 10) of one or two of some dimensions (10,), by a step either way."""
    single = [sign * row for row in np.eye(SIZE)[some] for sign in (1, -1)]
    both = [a + b for a, b in combinations(single, 2) if (a + b).any()] if pairs else []
    return np.array(single + both)


def _sign(
    stack: LinkageStack, rows: FloatArray, length: float, driver: NDArray[np.intp]
) -> FloatArray:
    """The sign (k,) of the transmission angle at most of the places (k, N, 3)."""
    with np.errstate(invalid="ignore"):
        positive = (lever_sine(stack, rows, length, driver) > 0).mean(axis=1)
    return np.where(positive >= 0.5, 1.0, -1.0)


def _type_kept(stack: LinkageStack, driver: int, aim: Aim) -> str:
    """The type of a 4R linkage if something is asked of types, else ""."""
    asked = aim.requirements
    if (stack.kinds != 0).any() or (asked.types is None and asked.driver != "crank"):
        return ""
    led = stack.exchanged() if driver else stack
    name = led.linkage(0).type
    return name if name in SHORTEST or name == "triple-rocker" else ""
