"""Linkages that work, looked for where the closest ones do not.

From pairs of dyads, on each circuit, with each dyad driving and on each branch, all dimensions are
refined under the conditions that the poses stay on that branch, clear of its dead points, and in
order, and under whatever else is asked.  What is found are local minima: that there is no better
linkage is not proved.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.accuracy import on_circuits, rows_of
from burmester.circuit import Circuits, circuit_of
from burmester.conditions import (
    SHORTEST,
    Conditions,
    Journey,
    Proportions,
    Together,
    lever_sine,
    type_excess,
)
from burmester.displacement import Displacement, FloatArray
from burmester.dyad import RR
from burmester.frames import CanonicalFrames
from burmester.pivot_map import fixed_pivot_map, grid
from burmester.refinement import Refined, refine
from burmester.requirements import Requirements
from burmester.stack import LinkageStack

__all__ = ["Aim", "Found", "linkages_that_work", "links_of_map"]

FIRST = 24  # steps for all starts; the best go on
STARTS, BEST = 96, 16  # at most, of the first and of the second
WRONG = 0.1  # lengths squared, that a pose on the wrong branch counts as, to choose starts by
MAP, WIDE, LINKS = 17, 3.0, 8  # fixed pivots each way, how far out, and links kept of a map


class Found(NamedTuple):
    """Linkages (k,) found under conditions, and the index (k,) of the pair each came from."""

    refined: Refined
    pair: NDArray[np.intp]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Aim:
    """What linkages are looked for: near poses (N,), in the frames of `accuracy.error_frames`.

    kept: the limits of the dyads.  The rest as in `refine`.
    """

    poses: Displacement
    length: float
    frames: CanonicalFrames
    requirements: Requirements
    kept: tuple[Conditions, ...] = ()
    weights: FloatArray | None = None
    exact: NDArray[np.bool_] | None = None
    worst: bool = False

    def refine(self, stack: LinkageStack, rows: FloatArray, **how: Any) -> Refined:
        """Linkages (k,) from where they are to the least error."""
        return refine(
            stack,
            Displacement(rows[..., :2], rows[..., 2] / self.length),
            self.poses,
            self.length,
            weights=self.weights,
            exact=self.exact,
            **how,
        )

    def thinned(self, most: int) -> Aim:
        """The same with so many poses at most, evenly chosen; exact ones all stay."""
        count = self.poses.shape[0]
        if count <= most:
            return self
        index = np.linspace(0, count - 1, most).round().astype(np.intp)
        if self.exact is not None:
            index = np.union1d(index, np.flatnonzero(self.exact))
        return replace(
            self,
            poses=self.poses[index],
            weights=None if self.weights is None else self.weights[index],
            exact=None if self.exact is None else self.exact[index],
        )

    def places(self, stack: LinkageStack) -> FloatArray:
        """Rows (k, N, 3) of the places nearest to the poses, on the circuit nearest to all."""
        rows = rows_of(on_circuits(stack, self.poses, self.length), self.length)
        cost = np.nan_to_num(self.cost(rows), nan=np.inf)
        return np.asarray(rows[np.arange(len(stack)), cost.argmin(axis=1)])

    def cost(self, rows: FloatArray) -> FloatArray:
        """The weighted sum of squared distances (*,) of rows (*, N, 3) from the poses."""
        gap = ((rows - rows_of(self.poses, self.length)) ** 2).sum(axis=-1)
        return np.asarray(gap.sum(axis=-1) if self.weights is None else gap @ self.weights)


class _Starts(NamedTuple):
    """Starts (k,): pair, dimensions, rows (k, N, 3) of places, who drives, the branch's sign.

    middle: (k,), the drive amid its dead points, nan where there are none or it slides.
    """

    pair: NDArray[np.intp]
    stack: LinkageStack
    rows: FloatArray
    driver: NDArray[np.intp]
    sign: FloatArray
    middle: FloatArray

    def some(self, index: NDArray[np.intp]) -> _Starts:
        """Those at the indices."""
        return _Starts(
            self.pair[index],
            self.stack[index],
            self.rows[index],
            self.driver[index],
            self.sign[index],
            self.middle[index],
        )


def linkages_that_work(stack: LinkageStack, aim: Aim) -> Found | None:
    """The best linkages under all conditions that pairs (k,) of dyads lead to.

    None where there is nothing to start from.
    """
    starts = _starts(stack, aim)
    sine = lever_sine(starts.stack, starts.rows, aim.length, starts.driver)
    wrong = (starts.sign[:, None] * sine < 0).sum(axis=1)
    starts = starts.some(np.argsort(aim.cost(starts.rows) + WRONG * wrong, kind="stable")[:STARTS])
    if not len(starts.pair):
        return None
    first = aim.refine(
        starts.stack, starts.rows, conditions=_conditions(starts, aim), held_steps=FIRST
    )
    order = np.argsort(np.where(first.met, 0.5, 1.0) * np.nan_to_num(first.cost, nan=np.inf))
    order = order[np.isfinite(first.cost[order])][:BEST]
    starts = starts.some(order)._replace(stack=first.stack[order], rows=first.rows[order])
    refined = aim.refine(
        starts.stack, starts.rows, conditions=_conditions(starts, aim), worst=aim.worst
    )
    return Found(refined, starts.pair)


def links_of_map(poses: Displacement, weights: FloatArray | None = None) -> list[RR]:
    """More links to start from: the low places of the map of fixed pivots.

    Poses in the frames of `accuracy.error_frames`.
    """
    frames, _ = CanonicalFrames.of(poses, weights)
    reach = WIDE * float(frames.length)
    at = grid(frames.fixed_origin - reach, frames.fixed_origin + reach, MAP, MAP)
    found = fixed_pivot_map(poses, at, weights)
    error = np.nan_to_num(found.rms_error, nan=np.inf)
    walls = np.pad(error, 1, constant_values=np.inf)
    around = [
        walls[1 + i : 1 + i + MAP, 1 + j : 1 + j + MAP] for i in (-1, 0, 1) for j in (-1, 0, 1)
    ]
    low = (error <= np.min(around, axis=0)) & (found.dyads.radius > 1e-3 * reach)
    row, column = np.nonzero(low & np.isfinite(error))
    best = np.argsort(error[row, column], kind="stable")[:LINKS]
    return [found.dyads[row[k], column[k]] for k in best]


def _starts(stack: LinkageStack, aim: Aim) -> _Starts:
    """Each pair on each circuit, with each driver, on each branch on which a pose is."""
    places = on_circuits(stack, aim.poses, aim.length)
    rows = rows_of(places, aim.length)
    sides = {"first": (0,), "second": (1,)}.get(aim.requirements.driver, (0, 1))
    found = []
    for side in sides:
        for circuit in (0, 1):
            some = np.flatnonzero(np.isfinite(rows[:, circuit]).all(axis=(1, 2)))
            leads = np.full(len(some), side)
            sine = lever_sine(stack[some], rows[some, circuit], aim.length, leads)
            middle = _middle(stack[some], places[some, circuit, 0], side)
            for sign in (1.0, -1.0):
                on = (sign * sine > 0).any(axis=1)
                whole = np.empty((5, int(on.sum())))
                whole[:] = np.array([[0.0], [circuit], [side], [sign], [0.0]])
                whole[0], whole[4] = some[on], middle[on]
                found.append(whole)
    table = np.concatenate(found, axis=1)
    pair, on_circuit, driver = table[:3].astype(np.intp)
    return _Starts(pair, stack[pair], rows[pair, on_circuit], driver, table[3], table[4])


def _middle(stack: LinkageStack, places: Displacement, side: int) -> FloatArray:
    """The drive (k,) amid the dead points of the circuits on which places (k,) are.

    nan where there are none, and for drives that slide.
    """
    out = np.full(len(stack), np.nan)
    for index, linkage in (stack.exchanged() if side else stack).alike():
        circuits = Circuits.of(linkage, as_given=True)
        own = circuit_of(linkage, places[index], as_given=True).circuit
        if not circuits.drive.turns:
            continue
        middle = np.where(circuits.branches == 2, circuits.limits.mean(axis=-1), np.nan)
        out[index] = np.where(own < 0, np.nan, middle[np.arange(len(index)), np.maximum(own, 0)])
    return out


def _conditions(starts: _Starts, aim: Aim) -> Together:
    """All that the linkages are to keep to."""
    asked = aim.requirements
    _, stack, rows, driver, sign, middle = starts
    journey = Journey.of(stack, rows, aim.length, driver, sign, middle, asked)
    types = np.array([_type_to_be(stack, k, int(side), asked) for k, side in enumerate(driver)])
    proportions = Proportions(aim.length, aim.frames, asked, driver, types)
    return Together((journey, proportions, *aim.kept))


def _type_to_be(stack: LinkageStack, index: int, driver: int, asked: Requirements) -> str:
    """Of the 4R types allowed the one nearest to a linkage, "" where it is one of them."""
    if (stack.kinds[index] != 0).any():
        return ""
    allowed = set(SHORTEST) | {"triple-rocker"} if asked.types is None else set(asked.types)
    if asked.driver == "crank":
        allowed &= {"crank-rocker", "double-crank"}
    elif asked.types is None:
        return ""
    names = sorted(allowed & (set(SHORTEST) | {"triple-rocker"}))
    excess = type_excess(stack[[index] * len(names)], np.full(len(names), driver), names)
    return names[int(excess.max(axis=1).argmin())] if names else ""
