"""The joint coordinates of a linkage at its poses and in between, for a model of bodies.

A driver's or follower's joint with the ground: the angle of an RR's link or of the normal of an
RP's line, or how far a PR's pin is along its line.  The coupler's joint with the driver: the angle
from an RR's link, the angle in F on a PR's pin, or how far an RP's slot has gone over its pin.
The joint of an RP that follows is with the coupler: how far its pin is along the slot.

E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Final, Literal, NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.export.coupler_motion import CouplerMotion
from burmester.export.reference import Reference
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.verdicts.found_linkage import FoundLinkage

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = [
    "JointMotion",
    "along_slot",
    "directions",
    "ground_joint",
    "require_bodies",
]

LOOKS: Final = 721  # places along the motion at which the joints' range is found
TURN: Final = 2 * np.pi


def require_bodies(chosen: FoundLinkage, reference: Reference) -> None:
    """Raise E163 for a body that only translates."""
    if reference.only_translates:
        raise InputError(
            "E163",
            f"linkage {chosen.id} cannot be a model of links with hinges and slides",
            why="its body only translates, on two sliders of which one carries the other",
            help="choose another linkage, or write this one as JSON: --to json",
        )


def directions(normal: float) -> tuple[FloatArray, FloatArray]:
    """The normal of a line, and the direction along it."""
    return np.array([np.cos(normal), np.sin(normal)]), np.array([-np.sin(normal), np.cos(normal)])


def ground_joint(reference: Reference, side: Literal[0, 1], places: Displacement) -> FloatArray:
    """The coordinate (*,) of a side's joint with the ground at coupler places (*,)."""
    fixed, moving, line = reference.fixed[side], reference.moving[side], reference.line[side]
    if moving is None:
        assert line is not None
        return np.asarray(places.angle + line[0])
    pin = places.act(moving)
    if line is not None:
        return np.asarray(pin @ directions(line[0])[1])
    assert fixed is not None
    arm = pin - fixed
    return np.asarray(np.arctan2(arm[..., 1], arm[..., 0]))


def along_slot(reference: Reference, side: Literal[0, 1], places: Displacement) -> FloatArray:
    """How far (*,) along an RP's line, in M, the fixed pivot is at coupler places (*,)."""
    fixed, line = reference.fixed[side], reference.line[side]
    assert fixed is not None
    assert line is not None
    return np.asarray(places.inverse().act(fixed) @ directions(line[0])[1])


@final
class JointMotion(NamedTuple):
    """The joints of a linkage along the motion: radians, or metres of slides.

    Those of a four-bar are driver, coupler and follower, those of a six-bar its moving links.
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
    def of(cls, chosen: FoundLinkage, reference: Reference) -> Self:
        """The joints of a linkage, without jumps from place to place."""
        kinds = reference.kinds
        turning = np.array([kinds[0] != "PR", kinds[0] != "RP", kinds[1] == "RR"])
        along, driver, poses, fully = reference.places, None, None, False
        with suppress(InputError):
            first = CouplerMotion.of(chosen, 2)
            fully = first.turns_fully
            if len(first.reached) == reference.places.shape[0]:
                shares = np.unique(np.append(np.linspace(0, 1, LOOKS), first.pose_shares))
                motion = CouplerMotion.of(chosen, shares)
                poses = np.searchsorted(shares, first.pose_shares)
                driver = motion.driver_coordinate
                along = Displacement(
                    motion.places.translation * reference.scale, motion.places.angle
                )
        rows = _coordinates(reference, along)
        rows[:, turning] = np.unwrap(rows[:, turning], axis=0)
        exact = _coordinates(reference, reference.places)
        if poses is None or driver is None:
            return cls(rows, rows.min(axis=0), rows.max(axis=0), turning, False, fully)
        if turning[0]:  # as tables and films count it
            rows[:, 0] += TURN * np.round((driver[0] - rows[0, 0]) / TURN)
        turns = np.where(turning, TURN * np.round((rows[poses] - exact) / TURN), 0.0)
        values = exact + turns
        every = np.concatenate([rows, values])
        return cls(values, every.min(axis=0), every.max(axis=0), turning, True, fully)

    @classmethod
    def of_six_bar(cls, found: FoundSixBar) -> Self:
        """The joints of a six-bar's links with those that they turn on, without jumps."""
        drive = np.union1d(np.linspace(*found.drive_range, LOOKS), found.drive)
        places, tree = found.links(drive), found.skeleton.tree
        turned = [places[link].angle - places[on].angle for link, on, _ in tree]
        rows = np.unwrap(np.column_stack(turned), axis=0)
        driver = [link for link, _, _ in tree].index(found.skeleton.crank(found.driver_pivot))
        rows[:, driver] += TURN * np.round((drive[0] - rows[0, driver]) / TURN)
        turning = np.full(len(tree), fill_value=True)
        poses = np.searchsorted(drive, found.drive)
        low, high = rows.min(axis=0), rows.max(axis=0)
        return cls(rows[poses], low, high, turning, True, found.turns_fully)


def _coordinates(reference: Reference, places: Displacement) -> FloatArray:
    """The joints (n, 3) at coupler places (n,), angles within one turn."""
    drive = ground_joint(reference, 0, places)
    if reference.kinds[0] == "RR":
        coupler = places.angle - drive
        coupler = np.arctan2(np.sin(coupler), np.cos(coupler))
    elif reference.kinds[0] == "PR":
        coupler = places.angle
    else:
        coupler = -along_slot(reference, 0, places)
    follower = (
        along_slot(reference, 1, places)
        if reference.kinds[1] == "RP"
        else ground_joint(reference, 1, places)
    )
    return np.column_stack([drive, coupler, follower])
