"""The joint coordinates of a linkage at its poses, for a model of bodies.

A driver's joint: the angle of an RR's link or of the normal of an RP's line, or how far a PR's pin
is along its line.

E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from burmester.errors import InputError
from burmester.export.coupler_motion import CouplerMotion
from burmester.export.reference import Reference
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = [
    "along_slot",
    "directions",
    "driver_coordinates",
    "ground_joint",
    "hinged",
    "require_bodies",
]


def require_bodies(chosen: SavedLinkage, reference: Reference) -> None:
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


def hinged(reference: Reference, side: Literal[0, 1]) -> bool:
    """Whether the side's joint with the ground turns."""
    return reference.kinds[side] != "PR"


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


def driver_coordinates(chosen: SavedLinkage, reference: Reference) -> FloatArray:
    """The driver's coordinate (N,) at the poses, without jumps from each to the next.

    It is that of the motion through the poses, if there is one; otherwise each coordinate is the
    one nearest to the last.
    """
    values = ground_joint(reference, 0, reference.places)
    if not hinged(reference, 0):
        return values
    smooth = np.unwrap(values)
    try:
        motion = CouplerMotion.of(chosen, 2)
    except InputError:
        return smooth
    reached = motion.reached
    if len(reached) < len(values):
        return smooth
    whole = CouplerMotion.of(chosen, motion.pose_shares).driver_coordinate
    return np.asarray(values + 2 * np.pi * np.round((whole - values) / (2 * np.pi)))
