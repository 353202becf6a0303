"""How a linkage traverses the poses: on which circuit and branch, in which order, how far.

The numbers on which the verdicts (`defects`) rest.  All of them come from the exact circuits (see
`circuits`), none from sampling.

The least transmission angle over a range is exact, too.  Between two neighbouring multiples of
pi/2 of the parameter (or on one side of 0, where the parameter is a length) f (see `loop_closure`)
is monotonic, and along f a transmission angle rises first and falls then.  So its minimum is at an
end of the range or at one of those multiples inside.
"""

from __future__ import annotations

from typing import Final, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits, Location
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.pose_order import (
    CERTAIN_STEP_BACK,
    FULL_TURN,
    REPEATED_POSE_STEP,
    BoolArray,
    OrderTolerance,
    PoseOrder,
    along_interval,
    around_circuit,
    smallest_arc,
    step_back,
    tolerated_step,
)
from burmester.mechanisms.transmission import DEAD_POINT_ANGLE
from burmester.numerics.arrays import FloatArray, complex_of, where, wrapped_angle

# Radians, and fractions of the greatest coordinate.  A place farther off the circuit than this is
# not on it; near a change point rounding reaches 2e-8.
OFF_CIRCUIT: Final = 1e-5
QUARTER_TURN: Final = np.pi / 2  # radians
MAX_QUARTER_TURNS: Final = 5  # number of multiples of a quarter turn inside one turn, at most


class DrivenView(NamedTuple):
    """Coupler places (k, N) in terms of the drivers: circuits (k, 2), and transmission angles."""

    places: Displacement
    circuits: Circuits
    location: Location
    transmission: FloatArray

    @classmethod
    def of(cls, linkage: Linkage | LinkageBatch, places: Displacement) -> Self:
        """The view of places (k, N) of linkages (k,), of one pair of kinds or a batch."""
        return cls.along(Circuits.of(linkage, as_given=True), places)

    @classmethod
    def along(cls, circuits: Circuits, places: Displacement) -> Self:
        """The view of places (k, N) of the linkages with circuits (k, 2), as given."""
        location = circuits.locate(places)
        transmission = circuits.loop[:, :1].transmission(places)
        # At a change point the coupler may move while the input cannot: it is not driven there.
        change = np.flatnonzero(
            circuits.near_change_point[:, 0] & (location.circuit >= 0).any(axis=1)
        )
        if len(change):
            off = _off_circuit(
                circuits[change],
                location.circuit[change],
                location.parameter[change],
                places[change],
            )
            transmission[change] = np.where(off, 0.0, transmission[change])
        return cls(places, circuits, location, transmission)


def _off_circuit(
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
    on = (np.abs(wrapped_angle(angle)) < OFF_CIRCUIT) & (away <= OFF_CIRCUIT * size)
    return np.asarray(~on & np.isfinite(places.angle))


class Traversal(NamedTuple):
    """The poses (k, N) along the one circuit of each linkage on which they are judged.

    on_circuit: the poses on that circuit; clear: those of them that are not beside a dead point.
    branch_key: (k, N), circuit and branch as one number.
    crosses_branches: (k,), whether clear poses are on more than one branch.
    circuit: (k,), its number or -1; circuits: (k,).
    all_round: (k,), whether the poses are judged round the whole circuit, not along a branch.
    step_unit: (k,), the length (or 1) by which steps along the circuit are measured.
    order_doubtful: (k,), whether a change point makes the order uncertain.
    """

    on_circuit: BoolArray
    clear: BoolArray
    branch_key: NDArray[np.int8]
    crosses_branches: BoolArray
    circuit: NDArray[np.int8]
    circuits: Circuits
    all_round: BoolArray
    order: PoseOrder
    step_unit: FloatArray
    order_doubtful: BoolArray


class PoseRange(NamedTuple):
    """The range of the circuit between the poses of each linkage (k,).

    inputs: (k, N), at the poses; input_range: (k, 2), the least and the greatest in the range.
    least_transmission: (k,), the least transmission angle in the range.
    along: (k, N + 5), the parameters of the poses, then those inside where f turns back; nan for
        those that are not in use.
    worst: (k,), the index of the least transmission angle among these.
    """

    inputs: FloatArray
    input_range: FloatArray
    least_transmission: FloatArray
    along: FloatArray
    worst: NDArray[np.intp]


def traversed(
    view: DrivenView, on: BoolArray, tolerance: OrderTolerance, any_order: bool
) -> tuple[Traversal, PoseRange]:
    """The traversal of linkages (k,), each with one driver, and the range between their poses.

    on: (k, N), the poses that are judged.  Where the order allows either way round a closed
    circuit, the way is taken that stays clear of dead points.
    """
    traversal = _traversal_of(view, on, tolerance, any_order)
    return _other_way_round(traversal, _pose_range(traversal, view), view, any_order)


def _traversal_of(
    view: DrivenView, on: BoolArray, tolerance: OrderTolerance, any_order: bool
) -> Traversal:
    """The traversal, in the sense and over the range that are shortest; see `traversed`."""
    location = view.location
    on_circuit = on & (location.circuit >= 0) & np.isfinite(location.parameter)
    clear = on_circuit & (view.transmission >= DEAD_POINT_ANGLE)
    key = (2 * location.circuit + location.branch).astype(np.int8)
    own = np.take_along_axis(key, first_where(clear, on_circuit)[:, None], axis=1)
    crosses = np.asarray((clear & (key != own)).any(axis=1))
    some = np.asarray(on_circuit.any(axis=1))
    circuit = np.where(some, own[:, 0] // 2, -1).astype(np.int8)
    circuits = view.circuits[np.arange(len(circuit)), np.maximum(circuit, 0)]

    # A pose off the circuit takes the parameter of the pose before it, or of the first one on it.
    last = np.maximum.accumulate(np.where(on_circuit, np.arange(on_circuit.shape[1]), -1), axis=1)
    last = np.where(last < 0, on_circuit.argmax(axis=1)[:, None], last)
    s = np.where(some[:, None], np.take_along_axis(location.parameter, last, axis=1), np.nan)
    all_round = np.asarray(circuits.closed & (crosses | (circuits.branches == 1)))
    middle = QUARTER_TURN + np.pi * (own % 2)
    one_branch = circuits.closed & ~all_round
    s = np.where(one_branch[:, None], middle + wrapped_angle(s - middle), s)
    unit = _step_unit(circuits, view.places, on_circuit, s)
    doubtful = np.zeros(len(s), dtype=bool)
    if any_order:
        none = np.zeros(len(s))
        order = PoseOrder(np.where(all_round[:, None], smallest_arc(s), s), none, none)
    else:
        slack = tolerated_step(view.places, on_circuit, s, tolerance)
        interval, circle = along_interval(s, unit, slack), around_circuit(s, slack)
        order = where(all_round, circle, interval)
        elsewhere = (np.isfinite(view.places.angle) & ~on).any(axis=1)
        doubtful = elsewhere | (circuits.closed & (circle.back <= CERTAIN_STEP_BACK))
        doubtful = doubtful & circuits.near_change_point
    return Traversal(
        on_circuit, clear, key, crosses, circuit, circuits, all_round, order, unit, doubtful
    )


def _pose_range(traversal: Traversal, view: DrivenView) -> PoseRange:
    """The range between the poses of each linkage, in their order."""
    on_circuit, along, circuits = traversal.on_circuit, traversal.order.along, traversal.circuits
    quarters, inside = quarters_inside(along, circuits)
    counts = np.concatenate([on_circuit, inside], axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        between = circuits.couplers(quarters)
        # nan occurs only where all links fold into one line.
        passed = np.nan_to_num(circuits.loop[:, None].transmission(between))
    every = np.where(counts, np.concatenate([view.transmission, passed], axis=1), np.inf)
    least = np.where(on_circuit.any(axis=1), every.min(axis=1), np.nan)
    # A pose beside a dead point is named before the dead point.
    count = on_circuit.shape[1]
    pose_first = every[:, :count].min(axis=1) < DEAD_POINT_ANGLE
    worst = np.where(pose_first, every[:, :count].argmin(axis=1), every.argmin(axis=1))
    both = np.concatenate([along, quarters], axis=1)
    places = Displacement(
        np.concatenate([view.places.translation, between.translation], axis=1),
        np.concatenate([view.places.angle, between.angle], axis=1),
    )
    inputs = np.where(counts, circuits.inputs(both, places), np.nan)
    input_range = np.stack([end.reduce(inputs, axis=1) for end in (np.fmin, np.fmax)], axis=-1)
    both = np.where(counts, both, np.nan)
    return PoseRange(inputs[:, :count], input_range, least, both, worst)


def _other_way_round(
    traversal: Traversal, ranged: PoseRange, view: DrivenView, any_order: bool
) -> tuple[Traversal, PoseRange]:
    """The traversals, round a closed circuit the other way where that avoids a dead point."""
    count = traversal.on_circuit.shape[1]
    close = traversal.all_round & ~traversal.crosses_branches
    close &= (ranged.least_transmission < DEAD_POINT_ANGLE) & (ranged.worst >= count)
    if not close.any():
        return traversal, ranged
    away = np.take_along_axis(ranged.along, ranged.worst[:, None], axis=1)
    along, back, slack = traversal.order
    other = away + np.mod(along - away, FULL_TURN)
    allowed = close
    if not any_order:
        steps = np.minimum(step_back(other), step_back(-other))
        allowed = close & (steps <= np.maximum(np.maximum(back, slack), REPEATED_POSE_STEP))
    other = np.where(allowed[:, None], other, along)
    there = _pose_range(traversal._replace(order=PoseOrder(other, back, slack)), view)
    better = ~(there.least_transmission < DEAD_POINT_ANGLE) & allowed
    along = np.where(better[:, None], other, along)
    ranged = where(better, there, ranged)
    return traversal._replace(order=PoseOrder(along, back, slack)), ranged


def first_where(better: BoolArray, good: BoolArray) -> NDArray[np.intp]:
    """The first index (k,) in rows (k, N) where `better` holds, or if nowhere where `good` does."""
    return np.asarray(np.where(better.any(axis=1), better.argmax(axis=1), good.argmax(axis=1)))


def _step_unit(
    circuits: Circuits, places: Displacement, on_circuit: BoolArray, s: FloatArray
) -> FloatArray:
    """The unit (k,) of steps along intervals: 1, or a length of the linkage for lengths."""
    slides = ~(circuits.turns | circuits.closed) & on_circuit.any(axis=1)
    if not slides.any():
        return np.ones(len(s))
    arm = np.where(on_circuit, circuits.loop[:, None].arm(places), 0.0).max(axis=1)
    return np.where(slides, arm + np.ptp(s, axis=1), 1.0)


def quarters_inside(along: FloatArray, circuits: Circuits) -> tuple[FloatArray, BoolArray]:
    """The parameters (k, 5) inside the range where f turns back, and which of them exist."""
    low, high = along.min(axis=1, keepdims=True), along.max(axis=1, keepdims=True)
    at = QUARTER_TURN * (np.floor(low / QUARTER_TURN) + np.arange(1, 1 + MAX_QUARTER_TURNS))
    angle = (circuits.closed | circuits.turns)[:, None]
    inside = np.where(angle, at < high, (low < 0) & (high > 0))
    return np.where(inside, np.where(angle, at, 0.0), low), inside
