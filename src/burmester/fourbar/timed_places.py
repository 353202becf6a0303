"""The places of a linkage at given turns of its crank, but for one phase.

The phase is the one with the least sum of squared distances from points, by either dyad as the
crank and on either assembly; the assembly is the same at all points.  Samples of the phase give
starts, and brackets around them are narrowed.  That no other phase is better is not proved.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.loop_closure import DrivenLoop
from burmester.numerics.arrays import (
    ComplexArray,
    FloatArray,
    complex_of,
    even_numbers,
    weights_or_ones,
)

PHASES: Final = 360  # samples of the phase
MOST_SAMPLED: Final = 60  # points by which phases are sampled; the last search takes all
STARTS: Final = 3  # phases from which the search goes on
ROUNDS, TRIED = 10, 17  # of narrowing brackets: to an eighth in each round


def places_at_turns(
    batch: LinkageBatch,
    points: FloatArray,
    turns: FloatArray,
    length: float,
    *,
    weights: FloatArray | None = None,
) -> tuple[FloatArray, NDArray[np.intp]]:
    """Rows (k, N, 3) of the places of linkages (k,) near points (N, 2) at turns (N,) in radians.

    Also which side (k,) is the crank.  Rows are x, y, length x angle; nan where no dyad turns, or
    where none gets to all places.
    """
    wanted, share = complex_of(points), weights_or_ones(weights, points.shape[:1])
    some = even_numbers(len(points), MOST_SAMPLED)
    every = [DrivenLoop.of(each) for each in (batch, batch.exchanged())]
    rows, sides = np.full((len(batch), len(points), 3), np.nan), np.zeros(len(batch), dtype=np.intp)
    for k in range(len(batch)):
        best = math.inf
        for side, loops in enumerate(every):
            loop = loops[k]
            if not loop.turns:
                continue
            for closure, phase in _starts(loop, wanted[some], turns[some], share[some]):
                found, cost = _narrowed(loop, closure, phase, (wanted, turns, share))
                if cost < best:
                    best, sides[k] = cost, side
                    places = loop.closed_at(found + turns)
                    rows[k, :, :2] = places.translation[:, closure]
                    rows[k, :, 2] = np.unwrap(places.angle[:, closure]) * length
    return rows, sides


def _costs(
    loop: DrivenLoop, phases: FloatArray, wanted: ComplexArray, turns: FloatArray, share: FloatArray
) -> FloatArray:
    """The sums of squared distances (p, 2) at phases (p,), of both closures."""
    at = loop.closed_at(phases[:, None] + turns).translation
    gap = np.abs(complex_of(at) - wanted[:, None])
    return np.asarray((np.nan_to_num(gap, nan=np.inf) ** 2 * share[:, None]).sum(axis=1))


def _starts(
    loop: DrivenLoop, wanted: ComplexArray, turns: FloatArray, share: FloatArray
) -> list[tuple[int, float]]:
    """The closures and phases that are nearest to the points, and nearer than those beside them."""
    phases = np.linspace(0.0, 2 * math.pi, PHASES, endpoint=False)
    cost = _costs(loop, phases, wanted, turns, share)
    low = (cost <= np.roll(cost, 1, axis=0)) & (cost <= np.roll(cost, -1, axis=0))
    at, closure = np.nonzero(low & np.isfinite(cost))
    best = np.argsort(cost[at, closure], kind="stable")[:STARTS]
    return [(int(closure[k]), float(phases[at[k]])) for k in best]


def _narrowed(
    loop: DrivenLoop,
    closure: int,
    phase: float,
    path: tuple[ComplexArray, FloatArray, FloatArray],
) -> tuple[float, float]:
    """The best phase beside one, and its cost."""
    reach, cost = 2 * math.pi / PHASES, math.inf
    for _ in range(ROUNDS):
        phases = phase + reach * np.linspace(-1, 1, TRIED)
        costs = _costs(loop, phases, *path)[:, closure]
        best = int(costs.argmin())
        phase, cost, reach = float(phases[best]), float(costs[best]), reach * 2 / (TRIED - 1)
    return phase, cost
