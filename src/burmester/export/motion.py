"""The motion of a linkage through the poses: of a film, of a table, of models and collision checks.

E163 a linkage without such a motion
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final, Self, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.export.coupler_motion import CouplerMotion, places_on_branches
from burmester.export.link_places import LinkPlaces
from burmester.export.reference import Reference
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.verdicts.found_linkage import FoundLinkage

ALL_PLACES: Final = 721  # places along the motion at which plates are compared


@final
@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Places (n,) of the body from the first pose to the last.

    drive: (n,), of the driver, without jumps: an angle if `in_turns`, or a length.
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
        """The motion of a linkage in its task's unit; raises E163.

        count: the number of places, 2 or more, or their shares (n,) of the motion, from 0 to 1.
        whole: a whole turn that begins at the first pose, if the driver turns fully.
        """
        if isinstance(chosen, FoundLinkage):
            own = CouplerMotion.of(chosen, count, whole)
            drive, in_turns = own.driver_coordinate, bool(own.circuit.loop.turns)
            ends = own.turns_fully, own.full_turn
            return cls(own.places, drive, own.pose_shares, in_turns, *ends)
        share = np.linspace(0.0, 1.0, count) if isinstance(count, int) else np.asarray(count, float)
        start, end = chosen.along(2).tolist()
        full = whole and chosen.turns > 0
        if full:
            start = float(chosen.drive[0])
            end = start + math.copysign(2 * math.pi * chosen.turns, chosen.drive[-1] - start)
        drive = start + (end - start) * share
        met = (chosen.drive - start) / (end - start)
        return cls(chosen.body(drive), drive, met, True, chosen.turns > 0, full)


def all_places(chosen: Candidate, reference: Reference) -> LinkPlaces:
    """Where the bodies of a linkage are along all branches that have poses; those among them."""
    if not isinstance(chosen, FoundLinkage):
        drive = np.union1d(chosen.along(ALL_PLACES), chosen.drive)
        return reference.bodies(drive, chosen.body(drive))
    assert reference.dyads is not None
    places = places_on_branches(reference.dyads, reference.places, ALL_PLACES)
    return reference.bodies(places.angle, places)
