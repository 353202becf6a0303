"""The joint coordinates of a linkage at its poses and in between, for a model of bodies.

A hinge's is the angle between both bodies, a slide's how far the pin is along its slot.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Final, NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.export.reference import Reference
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import LinkPlaces
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.verdicts.motion import Motion

LOOKS: Final = 721  # places along the motion at which the joints' range is found
TURN: Final = 2 * np.pi


@final
class JointMotion(NamedTuple):
    """The joints of a linkage along the motion: radians, or metres of slides.

    They are those of the bodies of the reference's tree with what these are on.
    at_poses: (N, k).  low, high: (k,), the range that they go through.  turning: (k,), which are
    hinges.  one_motion: whether one motion goes through all poses; otherwise the range is that of
    the poses alone.  turns_fully: whether the driver can make full turns.
    """

    at_poses: FloatArray
    low: FloatArray
    high: FloatArray
    turning: NDArray[np.bool_]
    one_motion: bool
    turns_fully: bool

    @classmethod
    def of(cls, chosen: Candidate, reference: Reference) -> Self:
        """The joints of a linkage, without jumps from place to place."""
        turning = np.array([not limb.slides for limb in reference.tree])
        along, drive, poses, fully = reference.at_poses, None, None, False
        with suppress(InputError):
            first = Motion.of(chosen, 2)
            fully = first.turns_fully
            if np.isfinite(first.pose_shares).all():
                shares = np.unique(np.append(np.linspace(0, 1, LOOKS), first.pose_shares))
                motion = Motion.of(chosen, shares)
                poses, drive = np.searchsorted(shares, first.pose_shares), motion.drive
                places = motion.places.translation * reference.scale, motion.places.angle
                along = reference.own.bodies_at(drive, Displacement(*places))
        rows = _coordinates(reference, along)
        rows[:, turning] = np.unwrap(rows[:, turning], axis=0)
        exact = _coordinates(reference, reference.at_poses)
        if poses is None or drive is None:
            return cls(rows, rows.min(axis=0), rows.max(axis=0), turning, False, fully)
        motor = [limb.body for limb in reference.tree].index(reference.driver)
        if turning[motor]:  # as tables and films count it
            rows[:, motor] += TURN * np.round((drive[0] - rows[0, motor]) / TURN)
        turns = np.where(turning, TURN * np.round((rows[poses] - exact) / TURN), 0.0)
        values = exact + turns
        every = np.concatenate([rows, values])
        return cls(values, every.min(axis=0), every.max(axis=0), turning, True, fully)


def _coordinates(reference: Reference, places: LinkPlaces) -> FloatArray:
    """The joints (n, k) where the bodies are (n,); angles between links are within half a turn."""
    columns = []
    for limb in reference.tree:
        if limb.slides:
            assert limb.joint.slot is not None
            along = limb.joint.slot.along(places)
            columns.append(along if limb.body == limb.joint.slot.pin else -along)
            continue
        angle = places[limb.body].angle - places[limb.on].angle
        if limb.joint.slot is None:
            angle = angle - TURN * np.round(angle / TURN)
        columns.append(angle)
    return np.column_stack(columns)
