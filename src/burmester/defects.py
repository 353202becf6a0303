"""What keeps a linkage from leading its coupler through the poses: a verdict, and its reasons.

Chase and Mirth's defects (Circuits and branches of single-degree-of-freedom planar linkages,
Journal of Mechanical Design 115, 1993): it cannot be assembled at a pose; the poses are on
different circuits; between two poses a drive locks at a dead point; they are met in another
order.  Everything comes from the exact circuits (see `circuit`), nothing from sampling.

The least transmission angle over a stretch is exact, too.  Within half a turn of the parameter
between two multiples of pi/2 (or on one side of 0, where the parameter is a length) the drive's f
runs one way, and along f a transmission angle only rises, then only falls.  So it is least at an
end of the stretch or at one of those multiples inside.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final, Literal, NamedTuple, Self, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.circuit import Circuits, Location, locate
from burmester.course import Course
from burmester.dead_points import complex_of
from burmester.displacement import Displacement, FloatArray
from burmester.drive import facing
from burmester.dyad import PR, RP, RR
from burmester.linkage import Linkage
from burmester.motion import transmission_angle

__all__ = [
    "REPEATED",
    "STEP_BACK",
    "TOO_CLOSE",
    "Defect",
    "DefectKind",
    "Driven",
    "Verdict",
    "judge",
]

DefectKind = Literal["assembly", "circuit", "branch", "order"]

TOO_CLOSE: Final = 1e-3  # radians (0.06°): of a transmission angle, below which nothing is certain
STEP_BACK: Final = 1e-5  # along the circuit, in radians or shares of the linkage: the same of order
REPEATED: Final = 1e-7  # along the circuit, below which poses are the same twice
STRAY: Final = 1e-5  # radians and shares of the places; at a change point, twice 1e-8 is rounding
MOST: Final = 12  # poses, or ways between them, that a message lists
QUARTER: Final = np.pi / 2
TURN: Final = 2 * np.pi
QUARTERS: Final = 5  # multiples of a quarter turn inside a turn, at most

BoolArray: TypeAlias = NDArray[np.bool_]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Defect:
    """Why a linkage does not lead through the poses.

    poses: the numbers, from 0, of those that it is about: missed; on the lesser circuit; on both
    sides of a dead point; met out of turn.
    certain: False where it is too close to call.
    """

    kind: DefectKind
    message: str
    poses: tuple[int, ...]
    certain: bool = True


@final
@dataclass(frozen=True, slots=True, eq=False)
class Driven:
    """How a linkage does when one of its dyads drives, between the first and the last pose.

    defects: branch and order.
    circuit: the number, in `Circuits.of` of this drive and as given, of the circuit with the most
        poses (of two with as many, the one met first); -1 where nothing can be told.
    turns_fully: whether the drive turns round and round there, without dead points.
    transmission: (N,), at the poses, on whichever circuit; nan where there is no place.
    least_at_poses: the least of these.
    least_over_range: the least over the range between the poses of that circuit: exact, not
        sampled.
    parameter: (N,) along the circuit, see `Circuits`, unwrapped along the journey; nan for poses
        that are not on it.
    drive: (N,) the drive's coordinate (see `Drive`) along the journey, radians or a length.
    travel: (2,) the least and the greatest drive in that range.

    Where the poses are met in their order, the range runs through them in that order.  Else it is
    the smallest that holds them all.  Where it can be had in either sense, or in any order, another
    is taken instead of one that comes too close to locking.
    """

    defects: tuple[Defect, ...]
    circuit: int
    turns_fully: bool
    transmission: FloatArray
    least_at_poses: float
    least_over_range: float
    drive: FloatArray
    travel: FloatArray
    parameter: FloatArray


@final
@dataclass(frozen=True, slots=True, eq=False)
class Verdict:
    """The defects of one linkage.

    defects: assembly and circuit, whichever dyad drives.
    first, second: the rest, driven by the first and by the second dyad.
    """

    defects: tuple[Defect, ...]
    first: Driven
    second: Driven


def judge(
    linkage: Linkage,
    places: Displacement,
    *,
    missed: FloatArray,
    reach: float,
    length: float | None = None,
    names: Sequence[str] | None = None,
    any_order: bool = False,
) -> list[Verdict]:
    """The verdicts on linkages (k,) of one pair of kinds, RR, PR or RP, from either driver.

    places: (k, N), the coupler's places nearest to the poses, in their order; nan where there is
        none: such poses are left out of the other verdicts.
    missed: (k, N), how far each pose is from its place; by more than `reach` is an assembly
        defect.  Both in the unit in which distances between poses are taken.
    length: what a radian counts as in `missed`; None takes the poses as met, whatever they are
        missed by.
    names: what messages call the poses, instead of their numbers from 1.
    any_order: whether the poses may be met in any order.

    A branch defect is certain, but within TOO_CLOSE of a dead point: there, and wherever a
    linkage is within 1e-9 of a change point and passes it, it is called with certain=False.  Such
    a linkage is taken as given (see `Circuits.of`); its poses on one piece between change points
    make no defect.  Order is judged along the branch or, where a drive turns fully, in either
    sense within one turn; with a branch defect, along the circuit, as it would be with help over
    the dead point.  Poses that lie less than REPEATED apart have no order, nor do those that lie
    nearer to each other along the circuit than twice the greatest miss: met half way between, each
    would be missed along the circuit by no more than some pose is across it.  A step back of less
    than STEP_BACK is an order defect that is not certain.
    """
    sides = (linkage, Linkage(linkage.second, linkage.first))
    seen = [_Seen.of(side, places) for side in sides]
    change = seen[0].circuits.undecided[:, 0]
    found = np.isfinite(places.angle) & np.isfinite(places.translation).all(axis=-1)
    one, other = (side.location.circuit for side in seen)
    labels = np.where(one < 0, other, one)
    least = np.fmin(seen[0].transmission, seen[1].transmission)
    weak = change[:, None] & (least < TOO_CLOSE)
    clear = found & (labels >= 0) & ~weak
    count = np.stack([(clear & (labels == number)).sum(axis=1) for number in (0, 1)])
    first_met = np.take_along_axis(labels, _first(clear, found)[:, None], axis=1)[:, 0]
    main = np.where(count[0] == count[1], first_met, count[1] > count[0])
    on = found & ((labels == main[:, None]) | weak)

    called = _Names(names)
    common: list[list[Defect]] = [[] for _ in found]
    far = ~(missed <= reach) | ~found
    for k in np.flatnonzero(far.any(axis=1)):
        common[k] += _assembly(far[k], found[k], missed[k], called)
    for k in np.flatnonzero((count > 0).all(axis=0)):
        defect = _circuit(clear[k], labels[k], change[k], any_order, called)
        lesser = _numbers(clear[k] & (labels[k] != main[k]))
        common[k].append(Defect("circuit", defect, lesser, not change[k]))
    loose = np.zeros(len(found))
    if length is not None:
        loose = 2 * np.where(found, np.minimum(missed, reach), 0.0).max(axis=1)
    first, second = (
        _driven(side, each, on, (loose, length or 0.0), any_order, called)
        for side, each in zip(sides, seen, strict=True)
    )
    return [
        Verdict(tuple(defects), a, b) for defects, a, b in zip(common, first, second, strict=True)
    ]


class _Seen(NamedTuple):
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
    on = (np.abs(_within_half_a_turn(angle)) < STRAY) & (away <= STRAY * size)
    return np.asarray(~on & np.isfinite(places.angle))


class _Order(NamedTuple):
    """How poses (k, N) are met.

    along: their parameters, unwrapped.  back: (k,) by how much the journey steps back on its way,
    in radians or shares of the linkage, at the most.  slack: (k,), the same for steps that are
    within what the poses are missed by.
    """

    along: FloatArray
    back: FloatArray
    slack: FloatArray


class _Journey(NamedTuple):
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
    order: _Order
    size: FloatArray
    doubtful: BoolArray


class _Range(NamedTuple):
    """The stretch between the poses: (k, N) poses, then (k, 5) parameters where f turns back.

    drive: (k, N), travel: (k, 2), least: (k,), see `Driven`.
    along: (k, N + 5), nan for those that do not count.  worst: (k,), the number of the least.
    """

    drive: FloatArray
    travel: FloatArray
    least: FloatArray
    along: FloatArray
    worst: NDArray[np.intp]


def _driven(  # noqa: PLR0917
    linkage: Linkage,
    seen: _Seen,
    on: BoolArray,
    loose: tuple[FloatArray, float],
    any_order: bool,
    called: _Names,
) -> list[Driven]:
    """The verdicts on linkages (k,) with one driver, from the poses (k, N) on their circuit.

    loose: the distances (k,) within which poses have no order, and what a radian counts as there.
    """
    journey = _journey(linkage, seen, on, loose, any_order)
    journey, ranged = _detour(journey, _range(journey, seen), seen, any_order)
    told, along, circuits = journey.told, journey.order.along, journey.circuits
    parameter = np.where(told, along, np.nan)
    some = told.any(axis=1)
    turns = circuits.closed & (circuits.branches == 1) & some
    lowest = np.fmin.reduce(seen.transmission, axis=1)

    defects: list[list[Defect]] = [[] for _ in range(len(told))]
    close = some & (ranged.least < TOO_CLOSE)
    for k in np.flatnonzero(journey.crossing | close).tolist():
        if journey.crossing[k]:
            defects[k].append(_branch(journey, k, any_order, called))
        else:
            defects[k].append(_close(journey, ranged, k, called))
    for k in np.flatnonzero(
        some & (journey.order.back > np.maximum(REPEATED, journey.order.slack))
    ).tolist():
        defects[k].append(_order(journey, ranged, k, called))
    for k in np.flatnonzero(on.any(axis=1) & ~some).tolist():
        defects[k].append(_untold(on[k]))
    return [
        Driven(
            tuple(defects[k]),
            int(journey.circuit[k]),
            bool(turns[k]),
            seen.transmission[k],
            float(lowest[k]),
            float(ranged.least[k]),
            ranged.drive[k],
            ranged.travel[k],
            parameter[k],
        )
        for k in range(len(told))
    ]


def _journey(
    linkage: Linkage,
    seen: _Seen,
    on: BoolArray,
    loose: tuple[FloatArray, float],
    any_order: bool,
) -> _Journey:
    location = seen.location
    told = on & (location.circuit >= 0) & np.isfinite(location.parameter)
    clear = told & (seen.transmission >= TOO_CLOSE)
    key = (2 * location.circuit + location.branch).astype(np.int8)
    own = np.take_along_axis(key, _first(clear, told)[:, None], axis=1)
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
    s = np.where(one_branch[:, None], middle + _within_half_a_turn(s - middle), s)
    size = _size(linkage, circuits, seen.places, told, s)
    doubtful = np.zeros(len(s), dtype=bool)
    if any_order:
        none = np.zeros(len(s))
        order = _Order(np.where(all_round[:, None], _smallest_arc(s), s), none, none)
    else:
        slack = _slack(seen.places, told, s, *loose)
        straight, turned = _straight(s, size, slack), _turned(s, slack)
        order = _Order(
            *(
                np.where(all_round.reshape(-1, *[1] * (one.ndim - 1)), one, other)
                for one, other in zip(turned, straight, strict=True)
            )
        )
        elsewhere = (np.isfinite(seen.places.angle) & ~on).any(axis=1)
        doubtful = elsewhere | (circuits.closed & (turned.back <= STEP_BACK))
        doubtful = doubtful & circuits.undecided
    return _Journey(told, clear, key, crossing, circuit, circuits, all_round, order, size, doubtful)


def _range(journey: _Journey, seen: _Seen) -> _Range:
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
    drive = np.where(counts, _drives(circuits, seen.places, between, both), np.nan)
    travel = np.stack([end.reduce(drive, axis=1) for end in (np.fmin, np.fmax)], axis=-1)
    both = np.where(counts, both, np.nan)
    return _Range(drive[:, :count], travel, least, both, worst)


def _detour(
    journey: _Journey, ranged: _Range, seen: _Seen, any_order: bool
) -> tuple[_Journey, _Range]:
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
    there = _range(journey._replace(order=_Order(other, back, slack)), seen)
    better = ~(there.least < TOO_CLOSE) & allowed
    along = np.where(better[:, None], other, along)
    merged = (
        np.where(better.reshape(-1, *[1] * (new.ndim - 1)), new, old)
        for new, old in zip(there, ranged, strict=True)
    )
    return journey._replace(order=_Order(along, back, slack)), _Range(*merged)


def _transmission(seen: _Seen, places: Displacement) -> FloatArray:
    drive = seen.circuits.drive[:, 0]
    return transmission_angle(Linkage(drive.first, drive.second), places)


def _first(better: BoolArray, good: BoolArray) -> NDArray[np.intp]:
    """The first along rows (k, N) that is better or, where there is none, good."""
    return np.asarray(np.where(better.any(axis=1), better.argmax(axis=1), good.argmax(axis=1)))


def _within_half_a_turn(angle: FloatArray) -> FloatArray:
    return np.asarray((angle + np.pi) % TURN - np.pi)


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
    gap[..., 2] = length * _within_half_a_turn(gap[..., 2] / length)
    far = np.where(np.take_along_axis(told, order, 1)[:, 1:], np.linalg.norm(gap, axis=-1), 0.0)
    way, steps = np.nansum(far, axis=1), np.ptp(s, axis=1)
    return np.asarray(np.where(way > 0, loose * steps / np.where(way > 0, way, 1.0), 0.0))


def _straight(s: FloatArray, size: FloatArray, slack: FloatArray) -> _Order:
    """Poses along an interval, in either sense."""
    return _Order(s, np.minimum(_back(s), _back(-s)) / size, slack / size)


def _turned(s: FloatArray, slack: FloatArray) -> _Order:
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
    return _Order(along, np.where(use_up, back_up, back_down), slack)


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


def _drives(
    circuits: Circuits, poses: Displacement, between: Displacement, along: FloatArray
) -> FloatArray:
    """The drive's coordinates (k, n) at poses and places between them, with no jumps."""
    drive = facing(circuits.drive, 2)
    places = Displacement(
        np.concatenate([poses.translation, between.translation], axis=1),
        np.concatenate([poses.angle, between.angle], axis=1),
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        w = drive.reading(places)[0]
    if not drive.turns:
        return np.asarray(drive.centre + w.real)
    course = circuits.course[:, None]
    middle = np.where(course == Course.BELOW, np.pi, 0.0)  # others keep psi within half a turn
    swung = middle + _within_half_a_turn(np.angle(w) - middle)
    return np.asarray(drive.centre + np.where(course == Course.WHOLE, along, swung))


# Words --------------------------------------------------------------------------------------------


class _Names(NamedTuple):
    """What messages call poses."""

    given: Sequence[str] | None

    def one(self, pose: int) -> str:
        return str(pose + 1) if self.given is None else self.given[pose]

    def listed(self, poses: Sequence[int]) -> str:
        return _listed(_some([self.one(pose) for pose in poses]))

    def __call__(self, poses: Sequence[int]) -> str:
        return ("pose " if len(poses) == 1 else "poses ") + self.listed(poses)

    def between(self, pairs: Sequence[tuple[int, int]]) -> str:
        return _listed(_some([f"between {self(pair)}" for pair in pairs], "times"))


def _some(words: list[str], more: str = "others") -> list[str]:
    """The first of them, and how many more there are."""
    if len(words) <= MOST:
        return words
    return [*words[: MOST - 2], f"{len(words) - MOST + 2} {more}"]


def _listed(words: Sequence[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def _numbers(mask: BoolArray) -> tuple[int, ...]:
    return tuple(np.flatnonzero(mask).tolist())


UNSURE = ": too close to call"


def _assembly(far: BoolArray, found: BoolArray, missed: FloatArray, called: _Names) -> list[Defect]:
    nowhere, near = _numbers(~found), _numbers(far & found)
    defects = []
    if nowhere:
        text = f"it cannot be assembled near {called(nowhere)}"
        defects.append(Defect("assembly", text, nowhere))
    if near:
        worst = max(near, key=lambda pose: missed[pose])
        text = f"the coupler comes no nearer to pose {called.one(worst)} than {missed[worst]:.2g}"
        others = [pose for pose in near if pose != worst]
        if others:
            text += f", and misses {called(others)} by {min(missed[others]):.2g} or more"
        defects.append(Defect("assembly", text, near))
    return defects


def _changes(key: NDArray[np.int8], clear: BoolArray) -> list[tuple[int, int]]:
    """The poses, one after the other, between which the key changes."""
    return [(a, b) for a, b in pairwise(_numbers(clear)) if key[a] != key[b]]


def _parts(key: NDArray[np.int8], clear: BoolArray, called: _Names) -> tuple[str, str]:
    """The poses that are with the first, and the others."""
    same = clear & (key == key[clear.argmax()])
    return called(_numbers(same)), called.listed(_numbers(clear & ~same))


def _circuit(
    clear: BoolArray, labels: NDArray[np.int8], change: bool, any_order: bool, called: _Names
) -> str:
    one, other = _parts(labels, clear, called)
    verb = "is" if one.startswith("pose ") else "are"
    text = f"{one} {verb} on one assembly, {other} on the other"
    if change:
        return f"{text}, and both meet at a change point{UNSURE}"
    if any_order:
        return f"{text}: it must be taken apart between them"
    return f"{text}: it must be taken apart {called.between(_changes(labels, clear))}"


def _branch(journey: _Journey, k: int, any_order: bool, called: _Names) -> Defect:
    clear, key, change = journey.clear[k], journey.key[k], bool(journey.circuits.undecided[k])
    pairs = _changes(key, clear)
    poses = tuple(sorted({pose for pair in pairs for pose in pair}))
    if any_order:
        one, other = _parts(key, clear, called)
        verb, point = ("passes", "change") if change else ("locks at", "dead")
        text = f"{verb} a {point} point between {one} and {other}"
    elif change:
        text = f"passes a change point {called.between(pairs)}"
    else:
        points = "at a dead point" if len(pairs) == 1 else "at dead points"
        text = f"locks {called.between(pairs)}, {points}"
    return Defect("branch", text + UNSURE * change, poses, not change)


def _close(journey: _Journey, ranged: _Range, k: int, called: _Names) -> Defect:
    """A range that comes too near to where the drive may lock."""
    at, worst, count = ranged.along[k], ranged.worst[k], journey.told.shape[1]
    least = np.degrees(ranged.least[k])
    if worst < count:
        poses: tuple[int, ...] = (int(worst),)
        place = f"at {called(poses)}"
    else:
        along = at[:count]
        before = int(np.nanargmax(np.where(along <= at[worst], along, np.nan)))
        after = int(np.nanargmin(np.where(along >= at[worst], along, np.nan)))
        poses = tuple(sorted((before, after)))
        place = called.between([(poses[0], poses[1])])
    if journey.circuits.undecided[k]:
        text = f"{'is at' if worst < count else 'passes'} a change point {place}"
    else:
        within = f"within {least:.1g}° of" if least > 1e-4 else "to"
        text = f"comes {within} a dead point {place}"
    return Defect("branch", text + UNSURE, poses, certain=False)


def _order(journey: _Journey, ranged: _Range, k: int, called: _Names) -> Defect:
    told = journey.told[k]
    # Which way a change point leads is not known.
    passed = journey.circuits.undecided[k] and ranged.least[k] < TOO_CLOSE
    certain = journey.order.back[k] > STEP_BACK and not journey.doubtful[k] and not passed
    poses = np.flatnonzero(told)
    steps = np.round(journey.order.along[k][told] / (REPEATED * journey.size[k]))
    # Of both senses, the one with the lower number first.
    ways = []
    for sense in (1, -1):
        way = poses[np.lexsort((poses, sense * steps))].tolist()
        start = way.index(poses[0]) if journey.round[k] else 0
        ways.append(way[start:] + way[:start])
    met = min(ways)
    moved = tuple(a for a, b in zip(poses.tolist(), met, strict=True) if a != b)
    shown = [called.one(pose) for pose in met[:MOST]] + ["..."] * (len(met) > MOST)
    text = f"meets the poses in the order {'-'.join(shown)}"
    return Defect("order", text + UNSURE * (not certain), moved, bool(certain))


def _untold(on: BoolArray) -> Defect:
    text = "has parallel guides, or a link of no length, but for rounding: its motion is not known"
    return Defect("branch", text, _numbers(on), certain=False)
