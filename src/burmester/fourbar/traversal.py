"""How a linkage comes through the poses: where on a circuit they are, in which order, how far.

What the verdicts (`defects`) rest on, in numbers.  Everything comes from the exact circuits (see
`circuit`), nothing from sampling.

The least transmission angle over a stretch is exact, too.  Within half a turn of the parameter
between two multiples of pi/2 (or on one side of 0, where the parameter is a length) the drive's f
runs one way, and along f a transmission angle only rises, then only falls.  So it is least at an
end of the stretch or at one of those multiples inside.
"""

from __future__ import annotations

from typing import Final, NamedTuple, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits, Location, locate
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.instantaneous import transmission_angle
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.loop_closure import facing
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, complex_of, wrapped_angle

__all__ = [
    "REPEATED",
    "STEP_BACK",
    "TOO_CLOSE",
    "BoolArray",
    "Passage",
    "Range",
    "Seen",
    "detour",
    "first_of",
    "passage",
    "range_of",
]

TOO_CLOSE: Final = 1e-3  # radians (0.06°): of a transmission angle, below which nothing is certain
STEP_BACK: Final = 1e-5  # along the circuit, in radians or shares of the linkage: the same of order
REPEATED: Final = 1e-7  # along the circuit, below which poses are the same twice
STRAY: Final = 1e-5  # radians and shares of the places; at a change point, twice 1e-8 is rounding
QUARTER: Final = np.pi / 2
TURN: Final = 2 * np.pi
QUARTERS: Final = 5  # multiples of a quarter turn inside a turn, at most

BoolArray: TypeAlias = NDArray[np.bool_]


class Seen(NamedTuple):
    """What one driver makes of the places (k, N)."""

    places: Displacement
    circuits: Circuits
    location: Location
    transmission: FloatArray

    @classmethod
    def of(cls, linkage: Linkage, places: Displacement) -> Self:
        circuits = Circuits.of(linkage, as_given=True)
        location = locate(circuits, places)
        transmission = transmission_angle(linkage, places)
        # At a change point the coupler may move while the drive cannot: it is not driven there.
        change = np.flatnonzero(circuits.undecided[:, 0] & (location.circuit >= 0).any(axis=1))
        if len(change):
            loose = _stray(
                circuits[change],
                location.circuit[change],
                location.parameter[change],
                places[change],
            )
            transmission[change] = np.where(loose, 0.0, transmission[change])
        return cls(places, circuits, location, transmission)


def _stray(
    circuits: Circuits, number: NDArray[np.int8], parameter: FloatArray, places: Displacement
) -> BoolArray:
    """Which places (k, N) are not where the circuits (k, 2) are at their parameters."""
    with np.errstate(invalid="ignore", divide="ignore"):
        back = circuits.couplers(parameter[:, None])
    pick = number[:, None].astype(np.intp)
    angle = np.take_along_axis(back.angle, pick, axis=1)[:, 0] - places.angle
    d = np.take_along_axis(complex_of(back.translation), pick, axis=1)[:, 0]
    away = np.abs(d - complex_of(places.translation))
    size = np.abs(places.translation)
    size = np.fmax.reduce(size.reshape(len(size), -1), axis=1)[:, None]
    on = (np.abs(wrapped_angle(angle)) < STRAY) & (away <= STRAY * size)
    return np.asarray(~on & np.isfinite(places.angle))


class Order(NamedTuple):
    """How poses (k, N) are met.

    along: their parameters, unwrapped.  back: (k,) by how much the journey steps back on its way,
    in radians or shares of the linkage, at the most.  slack: (k,), the same for steps that are
    within what the poses are missed by.
    """

    along: FloatArray
    back: FloatArray
    slack: FloatArray


class Passage(NamedTuple):
    """The poses (k, N) along the circuit of each linkage that they are judged on.

    told: those that are on it; clear: and not beside a dead point.  key: circuit and branch;
    crossing: (k,), whether there is more than one.  circuit: (k,), its number or -1.
    round: (k,), whether it is judged all round, not along a branch.
    size: (k,), what steps along it are measured by.
    doubtful: (k,), whether the order is uncertain for a change point.
    """

    told: BoolArray
    clear: BoolArray
    key: NDArray[np.int8]
    crossing: BoolArray
    circuit: NDArray[np.int8]
    circuits: Circuits
    round: BoolArray
    order: Order
    size: FloatArray
    doubtful: BoolArray


class Range(NamedTuple):
    """The stretch between the poses: (k, N) poses, then (k, 5) parameters where f turns back.

    drive: (k, N), travel: (k, 2), least: (k,), see `Driven`.
    along: (k, N + 5), nan for those that do not count.  worst: (k,), the number of the least.
    """

    drive: FloatArray
    travel: FloatArray
    least: FloatArray
    along: FloatArray
    worst: NDArray[np.intp]


def passage(
    linkage: Linkage,
    seen: Seen,
    on: BoolArray,
    loose: tuple[FloatArray, float],
    any_order: bool,
) -> Passage:
    location = seen.location
    told = on & (location.circuit >= 0) & np.isfinite(location.parameter)
    clear = told & (seen.transmission >= TOO_CLOSE)
    key = (2 * location.circuit + location.branch).astype(np.int8)
    own = np.take_along_axis(key, first_of(clear, told)[:, None], axis=1)
    crossing = np.asarray((clear & (key != own)).any(axis=1))
    some = np.asarray(told.any(axis=1))
    circuit = np.where(some, own[:, 0] // 2, -1).astype(np.int8)
    circuits = seen.circuits[np.arange(len(circuit)), np.maximum(circuit, 0)]

    # Poses that are left out stand where the one before does, or the first.
    last = np.maximum.accumulate(np.where(told, np.arange(told.shape[1]), -1), axis=1)
    last = np.where(last < 0, told.argmax(axis=1)[:, None], last)
    s = np.where(some[:, None], np.take_along_axis(location.parameter, last, axis=1), np.nan)
    all_round = np.asarray(circuits.closed & (crossing | (circuits.branches == 1)))
    middle = QUARTER + np.pi * (own % 2)
    one_branch = circuits.closed & ~all_round
    s = np.where(one_branch[:, None], middle + wrapped_angle(s - middle), s)
    size = _size(linkage, circuits, seen.places, told, s)
    doubtful = np.zeros(len(s), dtype=bool)
    if any_order:
        none = np.zeros(len(s))
        order = Order(np.where(all_round[:, None], _smallest_arc(s), s), none, none)
    else:
        slack = _slack(seen.places, told, s, *loose)
        straight, turned = _straight(s, size, slack), _turned(s, slack)
        order = Order(
            *(
                np.where(all_round.reshape(-1, *[1] * (one.ndim - 1)), one, other)
                for one, other in zip(turned, straight, strict=True)
            )
        )
        elsewhere = (np.isfinite(seen.places.angle) & ~on).any(axis=1)
        doubtful = elsewhere | (circuits.closed & (turned.back <= STEP_BACK))
        doubtful = doubtful & circuits.undecided
    return Passage(told, clear, key, crossing, circuit, circuits, all_round, order, size, doubtful)


def range_of(journey: Passage, seen: Seen) -> Range:
    told, along, circuits = journey.told, journey.order.along, journey.circuits
    quarters, inside = _quarters(along, circuits)
    counts = np.concatenate([told, inside], axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        between = circuits.couplers(quarters)
        # nan, if there is any, is where all links fold.
        passed = np.nan_to_num(_transmission(seen, between))
    every = np.where(counts, np.concatenate([seen.transmission, passed], axis=1), np.inf)
    least = np.where(told.any(axis=1), every.min(axis=1), np.nan)
    # A pose beside a dead point is named before the dead point.
    count = told.shape[1]
    first = every[:, :count].min(axis=1) < TOO_CLOSE
    worst = np.where(first, every[:, :count].argmin(axis=1), every.argmin(axis=1))
    both = np.concatenate([along, quarters], axis=1)
    places = Displacement(
        np.concatenate([seen.places.translation, between.translation], axis=1),
        np.concatenate([seen.places.angle, between.angle], axis=1),
    )
    drive = np.where(counts, circuits.drives(both, places), np.nan)
    travel = np.stack([end.reduce(drive, axis=1) for end in (np.fmin, np.fmax)], axis=-1)
    both = np.where(counts, both, np.nan)
    return Range(drive[:, :count], travel, least, both, worst)


def detour(journey: Passage, ranged: Range, seen: Seen, any_order: bool) -> tuple[Passage, Range]:
    """The other way round, where the order allows it and this one comes too close to locking."""
    count = journey.told.shape[1]
    close = journey.round & ~journey.crossing & (ranged.least < TOO_CLOSE) & (ranged.worst >= count)
    if not close.any():
        return journey, ranged
    away = np.take_along_axis(ranged.along, ranged.worst[:, None], axis=1)
    along, back, slack = journey.order
    other = away + np.mod(along - away, TURN)
    steps = np.minimum(_back(other), _back(-other))
    allowed = (
        close if any_order else close & (steps <= np.maximum(np.maximum(back, slack), REPEATED))
    )
    other = np.where(allowed[:, None], other, along)
    there = range_of(journey._replace(order=Order(other, back, slack)), seen)
    better = ~(there.least < TOO_CLOSE) & allowed
    along = np.where(better[:, None], other, along)
    merged = (
        np.where(better.reshape(-1, *[1] * (new.ndim - 1)), new, old)
        for new, old in zip(there, ranged, strict=True)
    )
    return journey._replace(order=Order(along, back, slack)), Range(*merged)


def _transmission(seen: Seen, places: Displacement) -> FloatArray:
    drive = seen.circuits.drive[:, 0]
    return transmission_angle(Linkage(drive.first, drive.second), places)


def first_of(better: BoolArray, good: BoolArray) -> NDArray[np.intp]:
    """The first along rows (k, N) that is better or, where there is none, good."""
    return np.asarray(np.where(better.any(axis=1), better.argmax(axis=1), good.argmax(axis=1)))


# Order --------------------------------------------------------------------------------------------


def _back(x: FloatArray) -> FloatArray:
    """How far rows (k, N) that should not fall do fall."""
    return np.asarray((np.maximum.accumulate(x, axis=1) - x).max(axis=1))


def _slack(
    places: Displacement, told: BoolArray, s: FloatArray, loose: FloatArray, length: float
) -> FloatArray:
    """The steps (k,) along circuits, parameters s (k, N), that take the coupler as far as `loose`.

    By the mean speed between neighbours.
    """
    if not loose.any():
        return np.zeros(len(s))
    rows = np.concatenate([places.translation, length * places.angle[..., None]], axis=-1)
    order = np.argsort(s, axis=1)
    rows, s = np.take_along_axis(rows, order[..., None], axis=1), np.take_along_axis(s, order, 1)
    gap = np.diff(rows, axis=1)
    gap[..., 2] = length * wrapped_angle(gap[..., 2] / length)
    far = np.where(np.take_along_axis(told, order, 1)[:, 1:], np.linalg.norm(gap, axis=-1), 0.0)
    way, steps = np.nansum(far, axis=1), np.ptp(s, axis=1)
    return np.asarray(np.where(way > 0, loose * steps / np.where(way > 0, way, 1.0), 0.0))


def _straight(s: FloatArray, size: FloatArray, slack: FloatArray) -> Order:
    """Poses along an interval, in either sense."""
    return Order(s, np.minimum(_back(s), _back(-s)) / size, slack / size)


def _turned(s: FloatArray, slack: FloatArray) -> Order:
    """Poses round a closed circuit: in the sense that meets them in order within one turn.

    If both do, in the one that turns less; if neither, along the smallest arc.
    """
    tries, least = [], np.maximum(STEP_BACK, slack)
    for sense in (1.0, -1.0):
        step = np.mod(sense * np.diff(s, axis=1), TURN)
        step = np.where(step > TURN - least[:, None], step - TURN, step)
        x = np.concatenate([np.zeros_like(s[:, :1]), np.cumsum(step, axis=1)], axis=1)
        extent = np.ptp(x, axis=1)
        tries.append((s[:, :1] + sense * x, np.maximum(_back(x), extent - TURN), extent))
    (up, back_up, wide_up), (down, back_down, wide_down) = tries
    good_up, good_down = back_up <= least, back_down <= least
    use_up = good_up & ~(good_down & (wide_down < wide_up))
    along = np.where(use_up[:, None], up, down)
    along = np.where((good_up | good_down)[:, None], along, _smallest_arc(s))
    return Order(along, np.where(use_up, back_up, back_down), slack)


def _smallest_arc(s: FloatArray) -> FloatArray:
    """Angles (k, N) by whole turns such that they span the least."""
    ordered = np.sort(np.mod(s, TURN), axis=1)
    gaps = np.diff(ordered, axis=1, append=ordered[:, :1] + TURN)
    after = (gaps.argmax(axis=1) + 1) % s.shape[1]
    start = np.take_along_axis(ordered, after[:, None], axis=1)
    return np.asarray(start + np.mod(s - start + REPEATED, TURN) - REPEATED)


def _size(
    linkage: Linkage, circuits: Circuits, places: Displacement, told: BoolArray, s: FloatArray
) -> FloatArray:
    """What steps back along intervals are measured by, (k,): a length where they are lengths."""
    one = np.ones(len(told))
    if circuits.drive.turns or circuits.closed.all():
        return one
    first, second = facing(linkage.first, 2), facing(linkage.second, 2)
    assert isinstance(first, PR)
    pin = complex_of(places.act(first.moving_pivot))
    if isinstance(second, RR | PR):
        other = complex_of(places.act(second.moving_pivot))
    else:
        assert isinstance(second, RP)
        other = complex_of(second.fixed_pivot)
    arm = np.where(told, np.abs(pin - other), 0.0).max(axis=1)
    return np.where(circuits.closed | ~told.any(axis=1), 1.0, arm + np.ptp(s, axis=1))


# The range ----------------------------------------------------------------------------------------


def _quarters(along: FloatArray, circuits: Circuits) -> tuple[FloatArray, BoolArray]:
    """The parameters (k, 5) inside the range where f turns back, and which of them there are."""
    low, high = along.min(axis=1, keepdims=True), along.max(axis=1, keepdims=True)
    at = QUARTER * (np.floor(low / QUARTER) + np.arange(1, 1 + QUARTERS))
    angle = circuits.closed[:, None] | circuits.drive.turns
    inside = np.where(angle, at < high, (low < 0) & (high > 0))
    return np.where(inside, np.where(angle, at, 0.0), low), inside
