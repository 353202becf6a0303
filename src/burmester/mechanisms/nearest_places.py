"""The places of a mechanism that are nearest to poses, and what is least along a branch.

A circuit has one degree of freedom, so that the nearest place is a minimum in one number: places
along the whole circuit are looked at, once for all drivers, and the lowest of them are refined
between their neighbours.  The nearest on a branch is one of these, or an end of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.mechanisms.branches import Branch
from burmester.mechanisms.circuits import Circuits
from burmester.mechanisms.contract import Mechanism, body_of
from burmester.numerics.arrays import ComplexArray, FloatArray
from burmester.numerics.iteration import golden_section

PLACES = 720  # looked at on a piece of a circuit
REFINED = 4  # of the places that are nearer than both neighbours, so many on each piece are refined
AT_ONCE = 1_000_000  # places times poses looked at in one go; bounds the memory
ALONG = 721  # places along a range of a branch
END = 2e-5  # of a piece; nearer to a dead point its angle hardly tells a place
SAME_SHARE = 1e-9  # of a piece; places that are nearer to each other are one
SMOOTH = 22  # steps towards a minimum of which the value counts only


class BodyMeasure(Protocol):
    """How far places (*, N) of the body are from poses (N,); infinite where there is no place."""

    def __call__(self, places: Displacement) -> FloatArray: ...

    def at(self, index: NDArray[np.intp]) -> Self:
        """From some poses, by their numbers."""
        ...


@final
class Minima(NamedTuple):
    """Places (m,) of circuits that are nearer to a pose than those beside them.

    pose: its number; off: how near, in what was measured.
    """

    circuit: NDArray[np.intp]
    share: FloatArray
    pose: NDArray[np.intp]
    off: FloatArray


def minima_of(mechanism: Mechanism, circuits: Circuits, measure: BodyMeasure, poses: int) -> Minima:
    """Those of all circuits at as many poses."""
    rows = [
        _on_circuit(mechanism, circuits, number, measure, np.arange(poses)[start : start + at_once])
        for number, length in enumerate(circuits.length.tolist())
        for at_once in (max(1, AT_ONCE // (PLACES * length)),)
        for start in range(0, poses, at_once)
    ]
    return Minima(*(np.concatenate(column) for column in zip(*rows, strict=True)))


def _on_circuit(
    mechanism: Mechanism,
    circuits: Circuits,
    circuit: int,
    measure: BodyMeasure,
    numbers: NDArray[np.intp],
) -> Minima:
    """Those of one circuit at some poses, by their numbers."""
    length, closed = int(circuits.length[circuit]), bool(circuits.closed[circuit])
    shares = np.arange(length * PLACES + (not closed)) / PLACES
    there = body_of(mechanism, circuits.joints(mechanism, circuit, shares))
    off = measure.at(numbers)(there[:, None])
    before, after = np.roll(off, 1, axis=0), np.roll(off, -1, axis=0)
    if not closed:
        before[0] = after[-1] = np.inf
    low = np.where((off <= before) & (off <= after), off, np.inf)
    most = min(REFINED * length, len(low))
    best = np.argpartition(low, most - 1, axis=0)[:most]
    place, pose = best.ravel(), np.tile(numbers, most)
    good = np.isfinite(np.take_along_axis(low, best, axis=0)).ravel()
    place, pose = shares[place[good]], pose[good]
    beside = 1 / PLACES
    ends = place - beside, place + beside
    if not closed:
        ends = np.clip(ends[0], 0, length), np.clip(ends[1], 0, length)
    own = measure.at(pose)

    def off_at(share: FloatArray) -> FloatArray:
        return own(body_of(mechanism, circuits.joints(mechanism, circuit, share)))

    share, least = golden_section(off_at, *ends)
    return Minima(np.full(len(share), circuit), share, pose, least)


def nearest_shares(
    mechanism: Mechanism,
    branches: Sequence[Branch],
    minima: Minima,
    measure: BodyMeasure,
    poses: int,
    *,
    tie: float = 0.0,
) -> tuple[FloatArray, FloatArray]:
    """The shares (k, N) of branches (k,) at which the body is nearest to poses, and how near.

    A branch may hold the body at one place twice, with its other links elsewhere.  Of places whose
    distances differ by `tie` at most, those that come in the order of the poses are taken.
    """
    shares, least = np.empty((len(branches), poses)), np.empty((len(branches), poses))
    numbers = np.arange(poses)
    for row, branch in enumerate(branches):
        length = float(branch.circuits.length[branch.circuit])
        over = branch.low + np.mod(minima.share - branch.low, length)
        beside = 0.0 if branch.turns else END
        low, high = branch.low + beside, branch.high - beside
        own = (minima.circuit == branch.circuit) & (over > low) & (over < high)
        ends = np.repeat([low, high], poses)
        both = np.tile(numbers, 2)
        at_ends = measure.at(both)(body_of(mechanism, branch.at_share(mechanism, ends)))
        share = np.concatenate([over[own], ends])
        pose = np.concatenate([minima.pose[own], both])
        off = np.concatenate([minima.off[own], at_ends])
        order = np.lexsort((off, pose))
        first = order[np.searchsorted(pose[order], numbers)]
        near = order[off[order] <= off[first][pose[order]] + tie]
        if len(near) > poses:
            candidates = np.split(near, np.searchsorted(pose[near], numbers[1:]))
            chosen = _in_order([share[each] for each in candidates], branch, length)
            first = first if chosen is None else np.array([*map(np.take, candidates, chosen)])
        shares[row], least[row] = share[first], off[first]
    return shares, least


def _in_order(candidates: Sequence[FloatArray], branch: Branch, length: float) -> list[int] | None:
    """Which of the candidate shares of each pose come in order, over the shortest range.

    Either way along the branch; None if none do.  length: of the circuit.
    """
    best, shortest = None, np.inf
    for direction, end in ((1, branch.high), (-1, branch.low)):
        for number, start in enumerate(candidates[0]):
            share, travelled, chosen = start, 0.0, [number]
            for shares in candidates[1:]:
                steps = np.mod(direction * (shares - share) + SAME_SHARE, length) - SAME_SHARE
                chosen.append(int(steps.argmin()))
                share, travelled = shares[chosen[-1]], travelled + steps.min()
            room = length if branch.turns else direction * (end - start)
            if travelled < min(shortest, room):
                best, shortest = chosen, travelled
    return best


def least_along(
    mechanism: Mechanism,
    branch: Branch,
    low: float,
    high: float,
    value: Callable[[ComplexArray], FloatArray],
) -> float:
    """The least value of places of a branch from one share to another.

    value: from joints (*, j) to numbers (*,).
    """

    def at(share: FloatArray) -> FloatArray:
        return np.nan_to_num(value(branch.at_share(mechanism, share)), nan=np.inf)

    shares = np.linspace(low, high, ALONG)
    values = at(shares)
    walls = np.concatenate([[np.inf], values, [np.inf]])
    lowest = np.flatnonzero((values <= walls[:-2]) & (values <= walls[2:]))
    ends = shares[np.maximum(lowest - 1, 0)], shares[np.minimum(lowest + 1, ALONG - 1)]
    return float(min(values.min(), golden_section(at, *ends, SMOOTH)[1].min()))
