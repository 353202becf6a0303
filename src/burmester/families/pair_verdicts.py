"""The verdicts on many pairs of dyads that meet few poses exactly, all in one batch.

By the closed forms of circuits, branches, order and transmission; nothing along a motion is
sampled, but for a footprint.  A pair counts as driven from its better side: by the dyad with which
it comes nearer to working, and of two with which it works as well by the one with the greater
transmission angle.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Final, NamedTuple, Self, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PR, RP, RR, dimensions_of, shape_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.traversal import DrivenView, PoseRange, Traversal, traversed
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.mechanisms.pose_order import BoolArray, OrderTolerance
from burmester.mechanisms.transmission import DEAD_POINT_ANGLE
from burmester.numerics.arrays import FloatArray, concatenate, take
from burmester.requirements.footprint import FOOTPRINT
from burmester.requirements.requirement import Bounds
from burmester.requirements.table import keeps
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import span
from burmester.verdicts.assumptions import Assumptions
from burmester.verdicts.requirement_check import figures_of, outside, standard_of

PAIRS_PER_BLOCK = 8192  # judged at once; their arrays fit the processor's cache
FOOTPRINT_SAMPLES = 25  # places between the poses at which pivots are held against a footprint
MET = 1e-9  # relative, and radians: a bound that is missed by less is met


class PairClass(IntEnum):
    """What becomes of a pair of dyads, from the best to the worst.

    A pair with several faults has the class of the worst.
    """

    WORKS = 0
    FARTHER = 1
    OUTSIDE_BOUNDS = 2
    ORDER = 3
    BRANCH = 4
    CIRCUIT = 5
    NO_LINKAGE = 6


CLASS_WORDS: Final[Mapping[PairClass, str]] = {
    PairClass.WORKS: "works",
    PairClass.FARTHER: "works, but with pivots farther away than is assumed",
    PairClass.OUTSIDE_BOUNDS: "meets the poses, but is outside the limits or below the standard",
    PairClass.ORDER: "order defect: meets the poses in another order",
    PairClass.BRANCH: "branch defect: locks between two poses",
    PairClass.CIRCUIT: "circuit defect: has to be taken apart between two poses",
    PairClass.NO_LINKAGE: "no linkage: a dyad with itself, or one without a finite pivot",
}

Ground: TypeAlias = RR | PR | RP


@final
@dataclass(frozen=True, slots=True, eq=False)
class PairBounds:
    """What pairs are held to, beside what their task itself asks; lengths in the task's unit.

    asked: what the task asks, and the standard or what is assumed beside.
    fixed, moving: where pivots are assumed to lie that no limit of the task holds, in F and in M;
        None is anywhere.  A pair that works but for that has a class of its own.
    """

    asked: Bounds
    fixed: Polygon | None = None
    moving: Polygon | None = None

    @classmethod
    def of(cls, task: Task) -> Self:
        """The standard of `requirements.table`, and what the task asks."""
        return cls({**task.requirements.bounds, **standard_of(task)})

    @classmethod
    def assumed(cls, assumptions: Assumptions) -> Self:
        """What is assumed of the linkages of a family, and what the task asks."""
        return cls(assumptions.asked, assumptions.fixed, assumptions.moving)


class PairVerdicts(NamedTuple):
    """The verdicts on pairs of dyads (*,).

    classes: (*,), of `PairClass`.
    transmission: (*,), the least transmission angle over the range between the poses, radians; nan
        for pairs with defects.
    driver: (*,), 0 where the first dyad drives, 1 where the second does.
    """

    classes: NDArray[np.int8]
    transmission: FloatArray
    driver: NDArray[np.int8]


def judged_pairs(first: Ground, second: RR, task: Task, bounds: PairBounds) -> PairVerdicts:
    """The verdicts on pairs (k,) of dyads that meet all poses of a task exactly.

    The body and its surroundings are not looked at.
    """
    parts = []
    for start in range(0, len(second.radius), PAIRS_PER_BLOCK):
        span = slice(start, start + PAIRS_PER_BLOCK)
        parts.append(_judged(first[span], second[span], task, bounds))
    return concatenate(parts)


def _judged(first: Ground, second: RR, task: Task, bounds: PairBounds) -> PairVerdicts:
    """As `judged_pairs`, for as many pairs as fit the cache; circuits first, where most end."""
    count, poses = len(second.radius), task.poses
    classes = np.full((2, count), PairClass.NO_LINKAGE, dtype=np.int8)
    angle = np.full((2, count), np.nan)
    finite = np.flatnonzero(_is_finite(first) & _is_finite(second))
    first, second = first[finite], second[finite]
    places = Displacement(
        np.broadcast_to(poses.translation, (len(finite), *poses.translation.shape)),
        np.broadcast_to(poses.angle, (len(finite), *poses.shape)),
    )
    sides = Linkage(first, second), Linkage(second, first)
    views = [DrivenView.of(side, places) for side in sides]
    split, whole = _circuits(*views)
    classes[:, finite[split]] = PairClass.CIRCUIT
    one = np.flatnonzero(whole)
    on = np.ones((len(one), *poses.shape), dtype=bool)
    exact, any_order = OrderTolerance(np.zeros(len(one)), 0.0), task.requirements.any_order
    allowed = _within_limits(first[one], second[one], task)
    near = _within_limits(first[one], second[one], task, bounds.fixed, bounds.moving)
    for driver in (0, 1):
        side = Linkage(sides[driver].first[one], sides[driver].second[one])
        view = _rows(views[driver], one)
        traversal, ranged = traversed(view, on, exact, any_order)
        verdict = _motion_class(traversal, ranged)
        works = np.flatnonzero(verdict == PairClass.WORKS)
        good = allowed[driver] & _as_asked(side, traversal, ranged, bounds)
        angle[driver, finite[one[works]]] = ranged.least_transmission[works]
        verdict[works[~near[driver][works]]] = PairClass.FARTHER
        verdict[works[~good[works]]] = PairClass.OUTSIDE_BOUNDS
        classes[driver, finite[one]] = verdict
    rank = np.nan_to_num(angle)
    second_drives = (classes[1] < classes[0]) | ((classes[1] == classes[0]) & (rank[1] > rank[0]))
    pick = second_drives.astype(np.int8), np.arange(count)
    return PairVerdicts(classes[pick], angle[pick], pick[0])


def _is_finite(dyad: Ground) -> BoolArray:
    """Which dyads (k,) have finite dimensions."""
    parts = [value if value.ndim == 1 else value.sum(axis=-1) for value, *_ in dimensions_of(dyad)]
    return np.asarray(np.isfinite(np.sum(parts, axis=0)))


def _circuits(one: DrivenView, other: DrivenView) -> tuple[BoolArray, BoolArray]:
    """Which linkages (k,) have poses on two circuits, and which have all on one; see `judge`."""
    label = np.where(one.location.circuit < 0, other.location.circuit, one.location.circuit)
    least = np.fmin(one.transmission, other.transmission)
    weak = one.circuits.near_change_point[:, :1] & (least < DEAD_POINT_ANGLE)
    met = [((label == number) & ~weak).any(axis=1) for number in (0, 1)]
    return met[0] & met[1], (met[0] ^ met[1]) & ((label >= 0) | weak).all(axis=1)


def _rows(view: DrivenView, index: NDArray[np.intp]) -> DrivenView:
    """The view of some of its linkages."""
    return DrivenView(
        view.places[index],
        view.circuits[index],
        take(view.location, index),
        view.transmission[index],
    )


def _motion_class(traversal: Traversal, ranged: PoseRange) -> NDArray[np.int8]:
    """The class (k,) of motions on one circuit, before anything is asked of them; see `judge`."""
    out = np.full(len(traversal.circuit), PairClass.WORKS, dtype=np.int8)
    out[traversal.order.is_another] = PairClass.ORDER
    locks = traversal.crosses_branches | (ranged.least_transmission < DEAD_POINT_ANGLE)
    out[locks] = PairClass.BRANCH
    out[~traversal.on_circuit.any(axis=1)] = PairClass.NO_LINKAGE
    return out


def _as_asked(
    side: Linkage, traversal: Traversal, ranged: PoseRange, bounds: PairBounds
) -> BoolArray:
    """Which linkages (k,), driven by their first dyads, are as the task and the bounds ask."""
    turns = traversal.circuits.turns_fully
    good = keeps(bounds.asked, figures_of(side, ranged.least_transmission, turns))
    if (footprint := bounds.asked.get(FOOTPRINT)) is not None:
        some = np.flatnonzero(good)
        good[some] = _outside(side, traversal, some, footprint) <= FOOTPRINT.slack(footprint)
    return good


def _outside(
    side: Linkage, traversal: Traversal, some: NDArray[np.intp], footprint: Polygon
) -> FloatArray:
    """How far pivots of some linkages (n,) leave a footprint, at samples of their motions."""
    along = traversal.order.along[some]
    ends = np.stack([along.min(axis=1), along.max(axis=1)], axis=-1)
    places = traversal.circuits[some].between(ends, FOOTPRINT_SAMPLES)
    return outside(Linkage(side.first[some], side.second[some]), places, footprint)


def _within_limits(
    first: Ground,
    second: RR,
    task: Task,
    fixed: Polygon | None = None,
    moving: Polygon | None = None,
) -> tuple[BoolArray, BoolArray]:
    """Which pairs (k,) are within the limits in this order; fixed, moving: for free pivots."""
    one, other = (task.limits * 2)[:2] if task.limits else (Limits(), Limits())
    straight, crossed = (
        meets_limits(first, a, task, fixed, moving) & meets_limits(second, b, task, fixed, moving)
        for a, b in ((one, other), (other, one))
    )
    if task.requirements.driver == "first":
        return straight, crossed
    if task.requirements.driver == "second":
        return crossed, straight
    return straight | crossed, straight | crossed


def meets_limits(
    dyad: Ground,
    limits: Limits,
    task: Task,
    fixed: Polygon | None = None,
    moving: Polygon | None = None,
) -> BoolArray:
    """Whether dyads (*,) are within limits; rounding is allowed for, by the size of the task.

    fixed, moving: where pivots have to lie that the limits leave free.
    """
    slack = MET * max(span(task), float(np.abs(task.poses.translation).max()))
    good = np.full(shape_of(dyad), type(dyad).__name__ in limits.allowed)
    ground, body = limits.fixed_pivot or fixed, limits.moving_pivot or moving
    if isinstance(dyad, RR | RP) and ground is not None:
        good &= ground.distance(dyad.fixed_pivot) <= slack
    if isinstance(dyad, RR | PR) and body is not None:
        good &= body.distance(dyad.moving_pivot) <= slack
    if (line := limits.line) is not None and isinstance(dyad, PR | RP):
        off, equal = line.line_excess(dyad.normal_angle, dyad.offset)
        good &= (np.where(equal, np.abs(off), off) <= slack).all(axis=-1)
        good &= (line.travel_excess(dyad.pins(task.poses)) <= slack).all(axis=-1)
    if isinstance(dyad, RR):
        least, most = limits.length
        good &= (dyad.radius >= least * (1 - MET)) & (dyad.radius <= most * (1 + MET))
    return good
