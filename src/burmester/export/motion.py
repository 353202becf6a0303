"""The motion of a linkage through the poses: of a film, of a table, of models and collision checks.

It runs along one circuit, from the first pose that the driver reaches to the last, in the sense in
which the poses are met; with a driver that turns fully it may be a whole turn.

E163 a linkage without such a motion
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final, Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.errors import InputError
from burmester.export.reference import LinkPlaces, Reference
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.defects import Driven, judge
from burmester.fourbar.dyad import PP
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.tasks.motion_task import characteristic_length
from burmester.verdicts.found_linkage import FoundLinkage

TURN: Final = 2 * np.pi
ANGLE_SAMPLES: Final = 721  # places between which the coupler's angle is unwrapped
ALL_PLACES: Final = 721  # places along the motion at which plates are compared


@final
@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Places (n,) of the body from the first pose to the last.

    places: (n,), of a four-bar with angles without jumps.
    drive: (n,), of the driver, without jumps: an angle if `in_turns`, or a length.  That of a
    four-bar (`DrivenLoop`) begins within the first turn, from 0 to 2 pi.
    pose_shares: (N,), the share of the motion, 0 to 1, at which each pose is met; nan for poses
    that the driver does not reach.
    turns_fully: whether the driver can make full turns; full_turn: whether the motion is one, until
    all is as it was.
    """

    places: Displacement
    drive: FloatArray
    pose_shares: FloatArray
    in_turns: bool
    turns_fully: bool
    full_turn: bool

    @classmethod
    def of(cls, chosen: Candidate, count: int | ArrayLike, whole: bool = False) -> Self:
        """The motion of a linkage in its task's unit.

        count: the number of places, 2 or more, or their shares (n,) of the motion, from 0 to 1.
        whole: a whole turn that begins at the first pose, if the driver turns fully.
        Of a four-bar that is not usable, only the poses on the branch with the most poses count.
        Raises InputError E163 where these are fewer than two, and where the linkage cannot be
        driven.
        """
        share = np.linspace(0.0, 1.0, count) if isinstance(count, int) else np.asarray(count, float)
        if isinstance(chosen, FoundLinkage):
            return cls._of_four_bar(chosen, share, whole)
        start, end = chosen.along(2).tolist()
        full = whole and chosen.turns > 0
        if full:
            start = float(chosen.drive[0])
            end = start + math.copysign(2 * math.pi * chosen.turns, chosen.drive[-1] - start)
        drive = start + (end - start) * share
        met = (chosen.drive - start) / (end - start)
        return cls(chosen.body(drive), drive, met, True, chosen.turns > 0, full)

    @classmethod
    def _of_four_bar(cls, chosen: FoundLinkage, share: FloatArray, whole: bool) -> Self:
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
        parameter = start + sense * length * share
        places = own.couplers(parameter)
        angle = np.interp(share, steps, followed) + TURN * turns
        angle = places.angle + TURN * np.round((angle - places.angle) / TURN)
        return cls(
            Displacement(places.translation, angle),
            own.inputs(parameter, places) - TURN * _turns(own, start),
            sense * (s - start) / length,
            bool(own.loop.turns),
            driven.turns_fully,
            bool(whole and driven.turns_fully),
        )


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

    driven, locks = judged(places)
    if locks:
        here = circuit_of(chosen.driver_first, places, as_given=True)
        on = np.isfinite(driven.parameter)
        more = int((on & (here.branch == 1)).sum()) > int((on & (here.branch == 0)).sum())
        keep = on & (here.branch == int(more))
        driven, _ = judged(replace(places, angle=np.where(keep, places.angle, np.nan)))
    return driven


def _turns(own: Circuits, start: float) -> float:
    """The whole turns of the driver at a parameter."""
    if not own.loop.turns:
        return 0.0
    at = np.array([start])
    return float(np.floor(own.inputs(at, own.couplers(at))[0] / TURN))


def _poses(count: int) -> str:
    return ("no pose", "one pose")[count] if count < 2 else f"{count} poses"


def all_places(chosen: Candidate, reference: Reference) -> LinkPlaces:
    """Where the bodies of a linkage are along all branches that have poses; those among them."""
    if not isinstance(chosen, FoundLinkage):
        drive = np.union1d(chosen.along(ALL_PLACES), chosen.drive)
        return reference.bodies(drive, chosen.body(drive))
    assert reference.dyads is not None
    places = _on_branches(reference.dyads, reference.places, ALL_PLACES)
    return reference.bodies(places.angle, places)


def _on_branches(linkage: Linkage, places: Displacement, looks: int) -> Displacement:
    """Coupler places (n,) along each branch of a circuit from its first to its last of places (N,).

    The places themselves are among them, in their order along the way.  Whole turns are cut where
    the places leave the widest gap.
    """
    circuits = Circuits.of(linkage, as_given=True)
    here = circuit_of(linkage, places, as_given=True)
    rows: list[FloatArray] = []
    on = np.isfinite(here.parameter) & (here.circuit >= 0)
    for circuit, branch in sorted(set(zip(here.circuit[on], here.branch[on], strict=True))):
        own = circuits[int(circuit)]
        which = on & (here.circuit == circuit) & (here.branch == branch)
        s = here.parameter[which]
        if own.closed and own.branches == 1:
            order = np.sort(s % (2 * np.pi))
            gap = np.append(order[1:], order[0] + 2 * np.pi) - order
            cut = order[(int(gap.argmax()) + 1) % len(order)]
            s = cut + (s - cut) % (2 * np.pi)
        s = np.unique(np.concatenate([np.linspace(s.min(), s.max(), looks), s]))
        with np.errstate(invalid="ignore", divide="ignore"):
            along = own.couplers(s)
        rows.append(np.column_stack([along.translation, along.angle]))
    rows.append(np.column_stack([places.translation, places.angle]))
    table = np.concatenate(rows if len(rows) == 1 else rows[:-1])
    return Displacement.from_poses(table[np.isfinite(table).all(axis=1)])
