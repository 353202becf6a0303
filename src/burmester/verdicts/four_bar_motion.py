"""The motion of a four-bar through its poses.

E163 a linkage without such a motion
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.defects import Driven, judge
from burmester.fourbar.dyad import PP
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.pose_order import smallest_arc
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.tasks.motion_task import characteristic_length
from burmester.verdicts.motion import Motion, Way

if TYPE_CHECKING:
    from burmester.verdicts.found_linkage import FoundLinkage

TURN: Final = 2 * np.pi
SAME_PLACE: Final = 1e-9  # characteristic lengths; places that differ by less are one
ANGLE_SAMPLES: Final = 721  # places between which the coupler's angle is unwrapped


def way_of_four_bar(chosen: FoundLinkage, whole: bool) -> Way:
    """The motion of a four-bar; see `Motion.of`."""
    driven = _driven(chosen)
    reached = np.flatnonzero(np.isfinite(driven.parameter))
    if len(reached) < 2 or driven.circuit < 0:
        name = f"linkage {chosen.id}"
        raise InputError(
            "E163",
            f"{name} does not move from one pose to another",
            why=f"its driver reaches {_poses(len(reached))} of {len(driven.parameter)} "
            "without being taken apart or passing a dead point",
            help="choose a linkage that `burmester synthesize` calls usable",
        )
    s = driven.parameter
    first, last = s[reached[0]], s[reached[-1]]
    sense = -1.0 if last < first else 1.0
    start = sense * np.nanmin(sense * s)
    length = TURN if whole and driven.turns_fully else float(np.ptp(s[reached]))
    if length <= 0:
        raise InputError(
            "E163",
            f"linkage {chosen.id} does not move from one pose to another",
            why="all poses that its driver reaches are the same place",
            help="give poses that differ",
        )
    own = Circuits.of(chosen.driver_first, as_given=True)[driven.circuit]
    # Angles are followed in small steps, and come by whole turns as the first pose has its own.
    steps = np.linspace(0.0, 1.0, ANGLE_SAMPLES)
    followed = np.unwrap(own.couplers(start + sense * length * steps).angle)
    there = np.interp(sense * (first - start) / length, steps, followed)
    turns = np.round((chosen.error.places.angle[reached[0]] - there) / TURN)
    before = TURN * _turns(own, start)

    def at(share: FloatArray) -> Motion:
        parameter = start + sense * length * share
        places = own.couplers(parameter)
        angle = np.interp(share, steps, followed) + TURN * turns
        angle = places.angle + TURN * np.round((angle - places.angle) / TURN)
        return Motion(
            Displacement(places.translation, angle),
            own.inputs(parameter, places) - before,
            sense * (s - start) / length,
            bool(own.loop.turns),
            driven.turns_fully,
            bool(whole and driven.turns_fully),
        )

    return at


def _driven(chosen: FoundLinkage) -> Driven:
    """The linkage with its driver, judged by the poses that lie together on one branch."""
    first, second = chosen.driver_first.first, chosen.driver_first.second
    if isinstance(first, PP) or isinstance(second, PP):
        raise InputError(
            "E163",
            f"linkage {chosen.id} has no motion with one driver",
            why="a body that only translates has a PP dyad, which has no single joint to drive",
            help="choose a linkage of RR, PR and RP dyads",
        )
    places, task = chosen.error.places, chosen.task
    length = characteristic_length(task)
    missed = np.hypot(chosen.error.position, length * chosen.error.angle)

    def judged(places: Displacement) -> tuple[Driven, bool]:
        (verdict,) = judge(
            Linkage(first[None], second[None]),
            places[None],
            missed=missed[None],
            reach=np.inf,
            length=length,
            any_order=task.requirements.any_order,
        )
        locks = any(each.kind == "branch" and each.certain for each in verdict.first.defects)
        return verdict.first, locks

    if _is_of(chosen.driven, chosen.driver_first, places, length):
        return chosen.driven
    driven, locks = judged(places)
    if locks:
        here = circuit_of(chosen.driver_first, places, as_given=True)
        on = np.isfinite(driven.parameter)
        more = int((on & (here.branch == 1)).sum()) > int((on & (here.branch == 0)).sum())
        keep = on & (here.branch == int(more))
        driven, _ = judged(replace(places, angle=np.where(keep, places.angle, np.nan)))
    return driven


def _is_of(driven: Driven, linkage: Linkage, places: Displacement, length: float) -> bool:
    """Whether a linkage was judged at just these places, and takes them all on one branch."""
    if driven.circuit < 0 or any(each.kind == "branch" for each in driven.defects):
        return False
    own = Circuits.of(linkage, as_given=True)[driven.circuit]
    there = own.couplers(driven.parameter)
    away = np.hypot(*(there.translation - places.translation).T)
    turned = length * np.abs(wrapped_angle(there.angle - places.angle))
    return bool(((away + turned) <= SAME_PLACE * length).all())


def places_on_branches(linkage: Linkage, places: Displacement, count: int) -> Displacement:
    """Coupler places (n,) along each branch of a circuit from its first to its last of places (N,).

    The places themselves are among them, in their order along the way.
    """
    circuits = Circuits.of(linkage, as_given=True)
    here = circuits.locate(places)
    rows: list[FloatArray] = []
    on = np.isfinite(here.parameter) & (here.circuit >= 0)
    for circuit, branch in sorted(set(zip(here.circuit[on], here.branch[on], strict=True))):
        own = circuits[int(circuit)]
        s = here.parameter[on & (here.circuit == circuit) & (here.branch == branch)]
        if own.turns_fully:
            s = smallest_arc(s[None])[0]
        s = np.unique(np.concatenate([np.linspace(s.min(), s.max(), count), s]))
        with np.errstate(invalid="ignore", divide="ignore"):
            along = own.couplers(s)
        rows.append(np.column_stack([along.translation, along.angle]))
    table = np.concatenate(rows or [np.column_stack([places.translation, places.angle])])
    return Displacement.from_poses(table[np.isfinite(table).all(axis=1)])


def _turns(own: Circuits, start: float) -> float:
    """The whole turns of the driver at a parameter."""
    if not own.loop.turns:
        return 0.0
    at = np.array([start])
    return float(np.floor(own.inputs(at, own.couplers(at))[0] / TURN))


def _poses(count: int) -> str:
    return ("no pose", "one pose")[count] if count < 2 else f"{count} poses"
