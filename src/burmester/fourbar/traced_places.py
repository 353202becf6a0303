"""The places at which a linkage traces points, in their order: how the body turns does not count.

On each circuit the points are laid along the curve of the body's origin, forwards or backwards, at
most once around, so that the sum of squared distances is least (a shortest path over samples).
Each then goes down to the nearest place of its own stretch of the curve, and on to one inside its
tolerance where that is beside it.  Noise may exchange neighbours that lie closer than it: these
share a place where it is inside the tolerance of each.  A way that keeps clear of one driver's dead
points is taken where it is nearly as near as the nearest of all.  That no other way is nearer is
not proved.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.box_places import Boxes
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.linkage_batch import LinkageBatch, Transmission
from burmester.fourbar.nearest_places import Bracket, bracketed_least, places_at, sampled
from burmester.numerics.arrays import (
    ComplexArray,
    FloatArray,
    complex_of,
    even_numbers,
    take,
    weights_or_ones,
)

SAMPLES: Final = 160  # of each circuit, at least
MOST_LAID: Final = 60  # points that are laid by the shortest path; others go between these
ANCHORS: Final = 4  # places on a closed circuit at which the first point may be
CLEAR_RATIO: Final = 2.0  # a way clear of dead points may miss the points by so much more
ROUNDING: Final = 1e-9  # lengths, root mean square; ways that miss by less miss by nothing
ROUNDS, TRIED = 19, 9  # of narrowing brackets: to a quarter in each round, and so to rounding
BESIDE: Final = 2.0  # distances of a point from the curve; a place in its box is looked for so far
WAYS_AT_ONCE, POINTS_AT_ONCE = 128, 2000  # bound the memory
MOST_WEIGHED: Final = 400  # points by which the ways are compared; the others go along the best
# Of a smooth measure: rounds before its parabola is followed, in so many steps; the reach of each
# is this share of that before; a parabola may promise too much by so much, relative.
FIRST_ROUNDS, PARABOLAS, CLOSER, PROMISED = 1, 4, 1 / 30, 1e-9


class _Samples(NamedTuple):
    """Samples (n, s) of circuits (n,), each of the linkage `row` (n,).

    share: fractions of the circuit; curve: the body's origin there; sine: (2, n, s), of the
    transmission angle by either driver.
    """

    circuits: Circuits
    row: NDArray[np.intp]
    closed: NDArray[np.bool_]
    share: FloatArray
    curve: ComplexArray
    sine: FloatArray

    def share_at(self, circuit: int, position: NDArray[np.intp]) -> FloatArray:
        """The fractions at positions, numbers of samples that go on beyond whole turns."""
        turns, sample = np.divmod(position, self.share.shape[1])
        return np.asarray(self.share[circuit, sample] + turns)

    def gaps(self, circuits: NDArray[np.intp], points: ComplexArray) -> FloatArray:
        """Squared distances (c, s, m) of points (m,) from the curve beside each sample."""
        every = np.arange(self.share.shape[1])[:, None]
        return np.stack([self.gaps_beside(each, every, points) for each in circuits.tolist()])

    def gaps_beside(
        self, circuit: int, sample: NDArray[np.intp], points: ComplexArray
    ) -> FloatArray:
        """Squared distances of points (m,) from the curve of a circuit beside samples (*, m).

        That is the chord to half way to the next sample and to the one before: between samples a
        curve may pass a point that it meets at none.  Infinite where a sample does not assemble.
        """
        curve, closed = self.curve[circuit], self.closed[circuit]
        to = points - curve[sample]
        best = np.full(to.shape, np.inf)
        for step, end in ((-1, -1), (1, 0)):
            chord = np.nan_to_num(np.roll(curve, step) - curve)
            if not closed:
                chord[end] = 0.0
            size = np.maximum(np.abs(chord) ** 2, np.finfo(float).tiny)
            own = chord[sample]
            along = (own.conj() * to).real / size[sample]
            rest = to - np.clip(along, 0.0, 0.5) * own
            best = np.fmin(best, rest.real**2 + rest.imag**2)
        return best


class _Stretch(NamedTuple):
    """A stretch of a circuit: `size` samples from number `first`; all of a closed one goes round.

    clear: whether one of the drivers passes no dead point on it.
    """

    circuit: int
    first: int
    size: int
    around: bool
    clear: bool


class _Way(NamedTuple):
    """Points (N,) laid along a stretch: the positions of samples near which each is."""

    stretch: _Stretch
    positions: NDArray[np.intp]


def places_along(
    batch: LinkageBatch,
    points: FloatArray,
    length: float,
    *,
    weights: FloatArray | None = None,
    boxes: Boxes | None = None,
    any_order: bool = False,
) -> FloatArray:
    """Rows (k, N, 3) of the places of linkages (k,) that trace points (N, 2); nan where none does.

    In frames where lengths are about 1; rows are x, y, length x angle, and the angle goes on from
    place to place by less than half a turn.  boxes: the tolerances (N,).  any_order: each point
    where it is nearest.
    """
    wanted, share = complex_of(points), weights_or_ones(weights, points.shape[:1])
    out = np.full((len(batch), len(points), 3), np.nan)
    samples = _sampled(batch, length)
    if not len(samples.row):
        return out
    ways = _free_ways(samples, wanted, share, any_order)
    ways += _clear_ways(samples, ways, wanted, share, any_order)
    some = even_numbers(len(wanted), MOST_WEIGHED)
    few = [way._replace(positions=way.positions[some]) for way in ways]
    near = None if boxes is None else take(boxes, some)
    rows = _at_feet(samples, few, wanted[some], length, near, any_order=any_order)
    misses = np.sqrt(_squares(rows, wanted[some]) @ share[some] / share[some].sum())
    linkage = samples.row[[each.stretch.circuit for each in ways]]
    best = _best_ways(linkage, misses, _clear(batch[linkage], rows, length))
    rows = rows[best]
    if len(some) < len(wanted):
        one = [ways[index] for index in best]
        rows = _at_feet(samples, one, wanted, length, boxes, any_order=any_order)
    out[linkage[best]] = rows
    out[..., 2] = np.unwrap(out[..., 2], period=2 * math.pi * length, axis=-1)
    return out


def _best_ways(
    linkage: NDArray[np.intp], misses: FloatArray, clear: NDArray[np.bool_]
) -> list[int]:
    """The number of the way (w,) of each linkage; misses: rms distances; clear: of dead points."""
    out = []
    for k in np.unique(linkage):
        own = np.flatnonzero(linkage == k)
        best = own[misses[own].argmin()]
        if len(sound := own[clear[own]]):
            other = sound[misses[sound].argmin()]
            if misses[other] <= max(CLEAR_RATIO * misses[best], ROUNDING):
                best = other
        out.append(int(best))
    return out


def _clear(batch: LinkageBatch, rows: FloatArray, length: float) -> NDArray[np.bool_]:
    """Whether one of the drivers of linkages (w,) passes no dead point between rows (w, N, 3)."""
    clear = np.zeros(len(batch), dtype=bool)
    for driver in (0, 1):
        sine = Transmission.of(batch, rows, length, np.full(len(batch), driver)).sine
        clear |= (sine > 0).all(axis=1) | (sine < 0).all(axis=1)
    return clear


def _squares(rows: FloatArray, wanted: ComplexArray) -> FloatArray:
    """The squared distances (*, N) of rows (*, N, 3) from points (N,); infinite for nan."""
    gap = np.abs(complex_of(rows[..., :2]) - wanted)
    return np.asarray(np.nan_to_num(gap, nan=np.inf) ** 2)


def _sampled(batch: LinkageBatch, length: float) -> _Samples:
    circuits = Circuits.of(batch, as_given=True)
    row, side = np.nonzero(circuits.exists)
    own = circuits[row, side]
    share, rows = sampled(own, length, SAMPLES)
    sine = np.array(
        [
            Transmission.of(batch[row], rows, length, np.full(len(row), driver)).sine
            for driver in (0, 1)
        ]
    )
    return _Samples(own, row, own.closed, share, complex_of(rows[..., :2]), sine)


def _free_ways(
    samples: _Samples, wanted: ComplexArray, share: FloatArray, any_order: bool
) -> list[_Way]:
    """The nearest way along each whole circuit."""
    count = samples.share.shape[1]
    whole = [
        _Stretch(circuit, 0, count, bool(samples.closed[circuit]), False)
        for circuit in range(len(samples.row))
    ]
    ways = _laid(samples, whole, wanted, share, any_order)
    return [_marked(samples, way) for way in ways]


def _marked(samples: _Samples, way: _Way) -> _Way:
    """The way, clear where all its samples are on one side of a driver's dead points."""
    stretch, number = way.stretch, samples.share.shape[1]
    sine = samples.sine[:, stretch.circuit, way.positions % number]
    clear = bool(((sine > 0).all(axis=1) | (sine < 0).all(axis=1)).any())
    return way._replace(stretch=stretch._replace(clear=clear))


def _clear_ways(
    samples: _Samples, free: list[_Way], wanted: ComplexArray, share: FloatArray, any_order: bool
) -> list[_Way]:
    """The nearest ways between dead points, on circuits whose nearest way passes some."""
    arcs: list[_Stretch] = []
    for way in free:
        if not way.stretch.clear:
            for sine in samples.sine[:, way.stretch.circuit]:
                arcs += _arcs(way.stretch, sine > 0)
    return _laid(samples, arcs, wanted, share, any_order) if arcs else []


def _arcs(whole: _Stretch, positive: NDArray[np.bool_]) -> list[_Stretch]:
    """The stretches of a circuit whose samples (s,) have one sign."""
    count = len(positive)
    change = np.flatnonzero(positive != np.roll(positive, 1))
    if not whole.around:
        change = np.union1d(change, [0])
    if not len(change):
        return []
    counts = np.diff(np.append(change, change[0] + count))
    pairs = zip(change.tolist(), counts.tolist(), strict=True)
    return [_Stretch(whole.circuit, first, size, False, True) for first, size in pairs]


def _laid(
    samples: _Samples,
    stretches: list[_Stretch],
    wanted: ComplexArray,
    share: FloatArray,
    any_order: bool,
) -> list[_Way]:
    """The nearest way along each stretch."""
    some = even_numbers(len(wanted), len(wanted) if any_order else MOST_LAID)
    near, weight = wanted[some], share[some]
    number = samples.share.shape[1]
    which, lists, anchored = [], [], []
    for index, each in enumerate(stretches):
        begins = [each.first]
        if each.around and not any_order:
            begins = _anchors(np.abs(samples.curve[each.circuit] - near[0]))
        for begin in begins:
            for sense in (1, -1):
                steps = np.minimum(np.arange(number + 1), each.size - (0 if each.around else 1))
                start = begin if each.around or sense > 0 else each.first + each.size - 1
                which.append(index)
                lists.append(start + sense * steps)
                anchored.append(each.around and not any_order)
    order = np.array(which)
    positions, fixed = np.array(lists), np.array(anchored)
    circuit = np.array([stretches[index].circuit for index in which])
    costs, chosen = np.empty(len(order)), np.empty((len(order), len(some)), dtype=np.intp)
    for at in range(0, len(order), WAYS_AT_ONCE):
        rows = slice(at, at + WAYS_AT_ONCE)
        own, of = np.unique(circuit[rows], return_inverse=True)
        gap = samples.gaps(own, near)[of[:, None], positions[rows] % number] * weight
        if any_order:
            chosen[rows], costs[rows] = gap.argmin(axis=1), gap.min(axis=1).sum(axis=-1)
        else:
            chosen[rows], costs[rows] = _in_order(gap, fixed[rows])
    ways = []
    for index, each in enumerate(stretches):
        own = np.flatnonzero(order == index)
        best = own[costs[own].argmin()]
        every = np.interp(np.arange(len(wanted)), some, chosen[best]).round().astype(np.intp)
        ways.append(_Way(each, positions[best, every]))
    return ways


def _anchors(away: FloatArray) -> list[int]:
    """The numbers of the samples (s,) of a closed circuit where the first point may be."""
    away = np.nan_to_num(away, nan=np.inf)
    low = np.flatnonzero((away <= np.roll(away, 1)) & (away <= np.roll(away, -1)))
    return [int(each) for each in low[np.argsort(away[low], kind="stable")][:ANCHORS]]


def _in_order(cost: FloatArray, anchored: NDArray[np.bool_]) -> tuple[NDArray[np.intp], FloatArray]:
    """Numbers (q, m) of samples, never falling, of least summed costs (q, s, m); anchored: (q,)."""
    number, every = cost.shape[2], np.arange(cost.shape[1])
    total = np.where(anchored[:, None] & (every > 0), np.inf, cost[..., 0])
    back = np.zeros((number, *total.shape), dtype=np.intp)
    for j in range(1, number):
        least = np.minimum.accumulate(total, axis=1)
        back[j] = np.maximum.accumulate(np.where(total <= least, every, 0), axis=1)
        total = least + cost[..., j]
    out = np.empty((len(cost), number), dtype=np.intp)
    out[:, -1] = total.argmin(axis=1)
    rows = np.arange(len(cost))
    for j in range(number - 1, 0, -1):
        out[:, j - 1] = back[j, rows, out[:, j]]
    return out, total.min(axis=1)


def _at_feet(
    samples: _Samples,
    ways: list[_Way],
    wanted: ComplexArray,
    length: float,
    boxes: Boxes | None,
    *,
    any_order: bool,
) -> FloatArray:
    """Rows (w, N, 3) of the places nearest to the points, each down from where it is laid."""
    parts = []
    for at in range(0, len(wanted), POINTS_AT_ONCE):
        some = slice(at, at + POINTS_AT_ONCE)
        few = [way._replace(positions=way.positions[some]) for way in ways]
        own = None if boxes is None else take(boxes, some)
        parts.append(_block_at_feet(samples, few, wanted[some], length, own))
    feet, middles, speeds = (np.concatenate(each, axis=1) for each in zip(*parts, strict=True))
    if boxes is None or any_order:
        return feet
    circuits = samples.circuits[[each.stretch.circuit for each in ways]]
    shared = np.array(
        [
            _in_sequence(samples, way, at, np.square(pace))
            for way, at, pace in zip(ways, middles, speeds, strict=True)
        ]
    )
    moved = np.flatnonzero((shared != middles).any(axis=1))
    if len(moved):
        there = places_at(circuits[moved], shared[moved], length)
        sound = (boxes.share(there) <= 1).all(axis=1)
        feet[moved[sound]] = there[sound]
    return feet


def _block_at_feet(
    samples: _Samples,
    ways: list[_Way],
    wanted: ComplexArray,
    length: float,
    boxes: Boxes | None,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The same of some points in any order, with the fractions (w, N) and the speeds (w, N)."""
    circuits = samples.circuits[[each.stretch.circuit for each in ways]]
    middle, reach, speed = np.empty((3, len(ways), len(wanted)))
    low, high = np.empty((2, len(ways), 1))
    number = samples.share.shape[1]
    for row, way in enumerate(ways):
        stretch, curve = way.stretch, samples.curve[way.stretch.circuit]
        at = _downhill(samples, way, wanted)
        middle[row] = samples.share_at(stretch.circuit, at)
        before, after = (samples.share_at(stretch.circuit, at + step) for step in (-1, 1))
        reach[row] = np.maximum(middle[row] - before, after - middle[row])
        along = np.abs(curve[(at + 1) % number] - curve[(at - 1) % number])
        speed[row] = along / (after - before)
        ends = np.array([stretch.first, stretch.first + stretch.size - 1])
        low[row], high[row] = samples.share_at(stretch.circuit, ends)
        if stretch.size == number:  # a whole circuit goes on beyond the last samples
            low[row], high[row] = (-np.inf, np.inf) if stretch.around else (0.0, 1.0)

    bracket = Bracket(middle, reach, low, high)
    middle, rows = _nearest(circuits, bracket, wanted, length)
    if boxes is None:
        return rows, middle, speed
    away = np.sqrt(_squares(rows, wanted))
    out = boxes.share(rows) > 1
    own = np.flatnonzero(out.any(axis=0))
    if len(own):
        reach = np.minimum(BESIDE * away / np.maximum(speed, 1e-9), 1 / 4)
        bracket = Bracket(middle, np.where(out, reach, 0.0), low, high).at(own)
        few, out = take(boxes, own), out[:, own]
        (beside, *_), inside = bracketed_least(
            circuits, bracket, few.share, length, rounds=ROUNDS, count=TRIED
        )
        out &= few.share(inside) <= 1
        middle[:, own] = np.where(out, beside, middle[:, own])
        rows[:, own] = np.where(out[..., None], inside, rows[:, own])
    return rows, middle, speed


def _in_sequence(samples: _Samples, way: _Way, at: FloatArray, weight: FloatArray) -> FloatArray:
    """Fractions (N,) of a circuit that never go back along a way, nearest to those of the feet.

    By sums of squares with weights (N,): neighbours in the wrong order share one (the pooling of
    adjacent violators).  Feet that are in order stay as they are, to the last bit.
    """
    laid, around = samples.share_at(way.stretch.circuit, way.positions), way.stretch.around
    along = at + np.round(laid - at) if around else at.copy()
    sense = -1.0 if laid[-1] < laid[0] else 1.0
    along *= sense
    begin = 0
    if around:  # cut where the way from point to point is longest
        begin = (int(np.diff(along, append=along[0] + 1).argmax()) + 1) % len(along)
        along[:begin] += 1.0
    along, own = np.roll(along, -begin), np.roll(weight, -begin)
    if (np.diff(along) >= 0).all():
        return at
    out = np.roll(_pooled(along, own), begin)
    out[:begin] -= float(around)
    return np.asarray(sense * out)


def _pooled(x: FloatArray, weight: FloatArray) -> FloatArray:
    """The numbers (n,) that never fall with the least weighted sum of squares from x (n,)."""
    blocks: list[tuple[float, float, int]] = []  # mean, weight, length
    for value, own in zip(x.tolist(), weight.tolist(), strict=True):
        mean, heavy, length = value, max(own, 1e-300), 1
        while blocks and blocks[-1][0] > mean:
            before, more, count = blocks.pop()
            mean = (before * more + mean * heavy) / (more + heavy)
            heavy, length = more + heavy, length + count
        blocks.append((mean, heavy, length))
    return np.repeat([each[0] for each in blocks], [each[2] for each in blocks])


def _nearest(
    circuits: Circuits, bracket: Bracket, wanted: ComplexArray, length: float
) -> tuple[FloatArray, FloatArray]:
    """The places in brackets nearest to points (N,): fractions (w, N), rows (w, N, 3)."""

    def away(rows: FloatArray) -> FloatArray:
        return _squares(rows, wanted)

    down = partial(bracketed_least, circuits, measure=away, length=length, count=TRIED)
    middle = down(bracket, rounds=FIRST_ROUNDS)[0].middle
    reach = bracket.reach * (2.0 / (TRIED - 1)) ** FIRST_ROUNDS
    inside = (middle - reach >= bracket.low) & (middle + reach <= bracket.high)
    side, least = np.array([-1.0, 0.0, 1.0])[:, None], np.full(middle.shape, np.inf)
    for _ in range(PARABOLAS):
        tried = middle[:, None] + reach[:, None] * side
        rows = places_at(circuits, tried.reshape(len(middle), -1), length)
        before, here, after = np.moveaxis(away(rows.reshape(*tried.shape, 3)), 1, 0)
        with np.errstate(invalid="ignore", divide="ignore"):
            step = (before - after) / (before - 2 * here + after) / 2
        inside &= (np.abs(step) <= 1) & (before + after > 2 * here)
        least = np.minimum(least, here)
        middle = np.where(inside, middle + reach * step, middle)
        reach = reach * CLOSER
    rows = places_at(circuits, middle, length)
    inside &= away(rows) <= least * (1 + PROMISED) + ROUNDING**2
    if len(rest := np.flatnonzero(~inside.all(axis=0))):
        wanted = wanted[rest]
        narrow, there = down(bracket.at(rest), rounds=ROUNDS)
        middle[:, rest] = np.where(inside[:, rest], middle[:, rest], narrow.middle)
        rows[:, rest] = np.where(inside[:, rest, None], rows[:, rest], there)
    return middle, rows


def _downhill(samples: _Samples, way: _Way, wanted: ComplexArray) -> NDArray[np.intp]:
    """The positions (N,) to which points go down from sample to sample, within their stretch."""
    stretch, number = way.stretch, samples.share.shape[1]
    at = (way.positions - stretch.first) % stretch.size
    beside = np.array([[-1], [0], [1]])
    moving = np.arange(len(at))
    for _ in range(stretch.size):
        tried = at[moving] + beside
        if stretch.around:
            tried %= stretch.size
        inside = (tried >= 0) & (tried < stretch.size)
        sample = (stretch.first + tried) % number
        away = samples.gaps_beside(stretch.circuit, sample, wanted[moving])
        away = np.where(inside, away, np.inf)
        away[1] = np.nextafter(away[1], -np.inf)  # it stays where its neighbours are as near
        best = away.argmin(axis=0)
        at[moving] = np.take_along_axis(tried, best[None], axis=0)[0]
        moving = moving[best != 1]
        if not len(moving):
            break
    return np.asarray(stretch.first + at)
