"""Linkages assessed in one batch: whether they work, and the three figures of their quality."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.clearance.many_linkages import shares_too_close
from burmester.clearance.moving_parts import bars_of
from burmester.families.open_task import Conditions, OpenTask, Trials
from burmester.families.rail_freedom import RailFreedom
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pivot_box import extent
from burmester.fourbar.traversal import DrivenView, PoseRange, Traversal, first_where, traversed
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.pose_order import REPEATED_POSE_STEP, OrderTolerance
from burmester.numerics.arrays import FloatArray, take
from burmester.requirements.figures import Figures
from burmester.requirements.footprint import FOOTPRINT
from burmester.requirements.table import excess
from burmester.verdicts.quality import proportions
from burmester.verdicts.requirement_check import MAX_SENSITIVITY, figures_of, outside
from burmester.verdicts.tolerances import sensitivity_bound

FRAMES: Final = 17  # number of places along the range at which pivots are held against a footprint
# Numbers of places along the range at which contact with the surroundings is looked for in a
# search, and among what is chosen from: there at more places where it is clear at fewer.
CLEARANCE_FRAMES: Final = (9,)
MORE_FRAMES: Final = (21, 81)
# Motion sizes; how much more clearance is asked at these, for what comes nearer between them.
CLEARANCE_SLACK: Final = 1e-3
NEARLY: Final = 0.5  # violation; clearances of linkages that violate more are not looked at
NONE: Final = 10.0  # violation of a linkage that has no motion at all
BAD: Final = 1e6  # what a violation of 1 counts as, beside any aim
TRAVEL_ROUNDING: Final = 1e-9  # lengths; a pin that is less beyond its travel keeps it
LOST: Final = 1.0  # violation of a linkage that leaves its branch, beside how far it does


class Assessment(NamedTuple):
    """What linkages (k,) are worth.

    violation: (k,), 0 where a linkage meets all conditions, else how far it is from that.
    transmission: (k,), the least transmission angle over the range, radians; below zero off the
        branch.
    extent, sensitivity: (k,), as in `verdicts.quality`.
    """

    violation: FloatArray
    transmission: FloatArray
    extent: FloatArray
    sensitivity: FloatArray

    @property
    def good(self) -> NDArray[np.bool_]:
        """Which linkages meet all conditions."""
        return np.asarray(self.violation == 0)


def assessed(trials: Trials, task: OpenTask, *, thorough: bool = False) -> Assessment:
    """The assessment of linkages (k,) that pass through the places at their offsets.

    thorough: whether contact with the surroundings is looked for at more places.
    """
    frames = MORE_FRAMES if thorough else CLEARANCE_FRAMES
    count = len(trials)
    out = Assessment(np.zeros(count), *(np.full(count, np.nan) for _ in range(3)))
    led = trials.batch.in_order(np.stack([trials.driver, 1 - trials.driver], axis=1))
    places = task.places(trials.offsets)
    by_side = [np.arange(len(led))]
    if any(side.rail is not None for side in task.sides):
        by_side = [np.flatnonzero(trials.driver == side) for side in (0, 1)]
    alike = ((own[index], each) for own in by_side for index, each in led[own].alike())
    for index, linkage in alike:
        rails = [task.sides[abs(side - trials.driver[index[0]])].rail for side in (0, 1)]
        part = _of_alike(linkage, places[index], task.conditions, frames, rails)
        for whole, values in zip(out, part, strict=True):
            whole[index] = values
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        bound = sensitivity_bound(led, places, places, task.length)
        out.sensitivity[:] = bound.max(axis=1)
        times = np.fmin(np.fmax(out.sensitivity / MAX_SENSITIVITY, 1.0), BAD)
        out.violation[:] += np.log(times)
    return out


def _of_alike(
    linkage: Linkage,
    places: Displacement,
    conditions: Conditions,
    frames: tuple[int, ...],
    rails: Sequence[RailFreedom | None],
) -> Assessment:
    """Linkages (k,) of one pair of kinds at places (k, N); frames: places tried for contact."""
    with np.errstate(invalid="ignore", divide="ignore"):
        view = DrivenView.of(linkage, places)
        every = np.ones(places.shape, dtype=bool)
        tolerance = OrderTolerance(np.zeros(len(every)), 0.0)
        traversal, ranged = traversed(view, every, tolerance, conditions.any_order)
        violation, transmission = _along_poses(traversal, ranged, view)
        along = traversal.order.along
        ends = np.stack([np.fmin.reduce(along, axis=1), np.fmax.reduce(along, axis=1)], axis=-1)
        size = extent(traversal.circuits, ends, ranged.input_range) / conditions.span
        figures = _figures(linkage, transmission, traversal)
        if (area := conditions.asked.get(FOOTPRINT)) is not None:
            figures = figures._replace(
                outside=outside(linkage, traversal.circuits.between(ends, FRAMES), area)
            )
        violation = violation + excess(conditions.asked, figures)
        if frozenset({type(linkage.first), type(linkage.second)}) not in conditions.kinds:
            violation = violation + LOST
        if any(each is not None and each.rail.travel is not None for each in rails):
            range_ = traversal.circuits.between(ends, FRAMES)
            violation = violation + _beyond(linkage, range_, rails) / conditions.span
        if conditions.around is not None:
            violation = violation + _too_close(
                linkage, traversal.circuits, ends, violation, conditions, counts=frames
            )
        return Assessment(np.nan_to_num(violation, nan=NONE), transmission, size, size)


def _along_poses(
    traversal: Traversal, ranged: PoseRange, view: DrivenView
) -> tuple[FloatArray, FloatArray]:
    """Violations (k,) of branch and order, and the least transmission angles (k,)."""
    on, clear = traversal.on_circuit, traversal.clear
    own = np.take_along_axis(traversal.branch_key, first_where(clear, on)[:, None], axis=1)
    elsewhere = np.where(clear & (traversal.branch_key != own), view.transmission, 0.0)
    least = np.where(
        traversal.crosses_branches, -elsewhere.max(axis=1), np.nan_to_num(ranged.least_transmission)
    )
    violation = np.where(on.all(axis=1), 0.0, NONE)
    violation += np.where(traversal.crosses_branches, LOST, 0.0)
    back = np.where(traversal.order.back > REPEATED_POSE_STEP, traversal.order.back, 0.0)
    return violation + np.minimum(back, NONE), least


def _beyond(
    linkage: Linkage, frames: Displacement, rails: Sequence[RailFreedom | None]
) -> FloatArray:
    """How far pins (k,) of sliders leave the travel of their rails."""
    out = np.zeros(frames.shape[0])
    for dyad, rail in zip((linkage.first, linkage.second), rails, strict=True):
        if rail is None or not isinstance(dyad, PR | RP):
            continue
        beyond = rail.rail.travel_excess(dyad.pins(frames)).max(axis=1)
        out += np.where(beyond > TRAVEL_ROUNDING, beyond, 0.0)
    return out


def _too_close(
    linkage: Linkage,
    circuits: Circuits,
    ends: FloatArray,
    violation: FloatArray,
    conditions: Conditions,
    *,
    counts: tuple[int, ...],
) -> FloatArray:
    """Violations (k,) of what must not be touched, of linkages that meet all else or nearly so."""
    out = np.zeros(len(violation))
    some = np.flatnonzero(violation < NEARLY)
    around, slack = conditions.around, CLEARANCE_SLACK * conditions.span
    for count in counts:
        if around is None or not len(some):
            break
        frames = circuits[some].between(ends[some], count)
        bars = bars_of(Linkage(linkage.first[some], linkage.second[some]), frames)
        out[some] = shares_too_close(frames, bars, conditions.body, around, slack)
        some = some[out[some] == 0]  # looked at more closely
    return out


def _figures(linkage: Linkage, least: FloatArray, traversal: Traversal) -> Figures:
    """The figures of linkages (k,); with sliders, distances between pivots count as links, too."""
    figures = figures_of(linkage, least, traversal.circuits.turns_fully)
    one, other = linkage.first, linkage.second
    links = [dyad.radius for dyad in (one, other) if isinstance(dyad, RR)]
    if isinstance(one, RR | RP) and isinstance(other, RR | RP):
        links.append(np.linalg.norm(one.fixed_pivot - other.fixed_pivot, axis=-1))
    if isinstance(one, RR | PR) and isinstance(other, RR | PR):
        links.append(np.linalg.norm(one.moving_pivot - other.moving_pivot, axis=-1))
    if linkage.links is not None or not links:
        return figures
    every = np.stack(links)
    return figures._replace(shortest=every.min(axis=0), longest=every.max(axis=0))


def _by_transmission(value: Assessment, enough: float) -> FloatArray:
    # The size of what makes the choice between linkages that transmit alike.
    other = 0.002 * np.minimum(np.log(proportions(value.extent, value.sensitivity)), 10.0)
    return np.asarray(other - np.minimum(value.transmission, enough))


def _by_all(value: Assessment, enough: float) -> FloatArray:
    sine = np.sin(np.clip(value.transmission, 1e-3, enough))
    return np.asarray(np.log(proportions(value.extent, value.sensitivity) / sine**2))


AIMS: Final[Sequence[Callable[[Assessment, float], FloatArray]]] = (
    _by_transmission,
    lambda value, _: np.asarray(np.log(value.extent)),
    lambda value, _: np.asarray(np.log(value.sensitivity)),
    _by_all,
)


def costs(value: Assessment, aims: NDArray[np.intp], enough: float) -> FloatArray:
    """What is made least (k,): the violation, or where there is none one of the AIMS (k,).

    enough: radians, more transmission counts as that much.
    """
    out = np.zeros(len(aims))
    for number, aim in enumerate(AIMS):
        own = aims == number
        out[own] = aim(take(value, own), enough)
    with np.errstate(invalid="ignore"):
        return np.where(value.good, out, BAD * (1 + value.violation))
