"""Where the joints of a linkage stand at its poses, and what a model of bodies needs besides.

A driver's joint: the angle of an RR's link or of the normal of an RP's line, or how far a PR's pin
is along its line.

E163 a linkage that a model of bodies cannot hold
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from burmester.errors import InputError
from burmester.export.travel import Travel
from burmester.export.truth import Truth
from burmester.geometry.displacement import Displacement
from burmester.io.saved import SavedLinkage
from burmester.numerics.arrays import FloatArray

__all__ = ["along_slot", "directions", "driven", "ground_joint", "hinged", "require_bodies"]


def require_bodies(chosen: SavedLinkage, truth: Truth) -> None:
    """Raise E163 for a body that only translates."""
    if truth.only_translates:
        raise InputError(
            "E163",
            f"linkage {chosen.id} cannot be a model of links with hinges and slides",
            why="its body only translates, on two sliders of which one carries the other",
            help="choose another linkage, or write this one as JSON: --to json",
        )


def directions(normal: float) -> tuple[FloatArray, FloatArray]:
    """The normal of a line, and the way along it."""
    return np.array([np.cos(normal), np.sin(normal)]), np.array([-np.sin(normal), np.cos(normal)])


def hinged(truth: Truth, side: Literal[0, 1]) -> bool:
    """Whether the side's joint with the ground turns."""
    return truth.kinds[side] != "PR"


def ground_joint(truth: Truth, side: Literal[0, 1], places: Displacement) -> FloatArray:
    """The coordinate (*,) of a side's joint with the ground at coupler places (*,)."""
    fixed, moving, line = truth.fixed[side], truth.moving[side], truth.line[side]
    if moving is None:
        assert line is not None
        return np.asarray(places.angle + line[0])
    pin = places.act(moving)
    if line is not None:
        return np.asarray(pin @ directions(line[0])[1])
    assert fixed is not None
    arm = pin - fixed
    return np.asarray(np.arctan2(arm[..., 1], arm[..., 0]))


def along_slot(truth: Truth, side: Literal[0, 1], places: Displacement) -> FloatArray:
    """How far (*,) along an RP's line, in M, the fixed pivot is at coupler places (*,)."""
    fixed, line = truth.fixed[side], truth.line[side]
    assert fixed is not None
    assert line is not None
    return np.asarray(places.inverse().act(fixed) @ directions(line[0])[1])


def driven(chosen: SavedLinkage, truth: Truth) -> FloatArray:
    """The driver's coordinate (N,) at the poses, without jumps from each to the next.

    As the way through the poses has it where there is one; each nearest to the last otherwise.
    """
    values = ground_joint(truth, 0, truth.places)
    if not hinged(truth, 0):
        return values
    smooth = np.unwrap(values)
    try:
        way = Travel.of(chosen, 2)
    except InputError:
        return smooth
    reached = way.reached
    if len(reached) < len(values):
        return smooth
    whole = Travel.of(chosen, way.at).drive
    return np.asarray(values + 2 * np.pi * np.round((whole - values) / (2 * np.pi)))
