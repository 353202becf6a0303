"""The bodies of a model for simulation: which plates and pins each has, and their simple shapes.

A body's frame is that of its plate; the pin of a slider is a body of its own, with the pin's axis
as the origin: `driver` or `follower`, as the side that the slider is on.  Heights are as in STEP:
the lowest plate lies on z = 0.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import replace
from typing import Final, Literal, NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.export.options import Reference
from burmester.export.parts.plate import Pin, Plate
from burmester.export.parts.plates import Assembly
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import GROUND, LinkPlaces
from burmester.numerics.arrays import TURN, FloatArray
from burmester.synthesis.result import Candidate
from burmester.verdicts.motion import Motion

METRES = 1e-3  # metres in a millimetre
INSET = 0.02  # of the thickness: each shape is lower by this, half at each end, than its part


LOOKS: Final = 721  # places along the motion at which the joints' range is found


@final
class BodyParts(NamedTuple):
    """The plates and pins of a body, millimetres; pins at (x, y) of the body's frame."""

    plates: list[Plate]
    pins: list[Pin]


@final
class Shape(NamedTuple):
    """A box or a cylinder that stands upright, metres.

    centre: (3,); turn: of the box about z, radians; size: length, width and height of a box, or
    diameter twice and height of a cylinder.
    """

    kind: Literal["box", "cylinder"]
    centre: FloatArray
    turn: float
    size: tuple[float, float, float]


def parts_of_bodies(made: Assembly) -> dict[str, BodyParts]:
    """The parts of the ground and of all bodies that move, among which are the pins of sliders."""
    names = (GROUND, *(limb.body for limb in made.reference.tree))
    bodies = {
        name: BodyParts([each for each in made.plates if each.owner == name], []) for name in names
    }
    for joint, pin in zip(made.reference.joints, made.pins, strict=True):
        if joint.slot is not None:
            bodies[joint.slot.pin].pins.append(replace(pin, x=0.0, y=0.0))
        else:
            bodies[joint.holder].pins.append(pin)
    return bodies


def heights_of(part: Plate | Pin, made: Assembly) -> tuple[float, float]:
    """The lowest and the highest z of a part, millimetres."""
    step = made.dimensions.thickness + made.dimensions.gap
    low, high = (part.layer, part.layer) if isinstance(part, Plate) else (part.low, part.high)
    return low * step, high * step + made.dimensions.thickness


def shapes(body: BodyParts, made: Assembly) -> list[Shape]:
    """Boxes along the sides of a body's plates, cylinders for their round corners and the pins.

    A link with two holes is filled by them exactly, but for its holes; a plate with three corners
    or more is left open inside.
    """
    found = list[Shape]()
    for plate in body.plates:
        low, high = _inset(plate, made)
        width = 2 * plate.radius * METRES
        found += [_bar(one, two, width, (low, high)) for one, two in _sides(plate)]
        for corner in plate.skeleton * METRES:
            size = (width, width, high - low)
            found.append(Shape("cylinder", np.append(corner, (low + high) / 2), 0.0, size))
    for pin in body.pins:
        low, high = _inset(pin, made)
        centre = np.array([pin.x * METRES, pin.y * METRES, (low + high) / 2])
        thick = pin.diameter * METRES
        found.append(Shape("cylinder", centre, 0.0, (thick, thick, high - low)))
    return found


def _sides(plate: Plate) -> list[tuple[FloatArray, FloatArray]]:
    """The sides of a plate's pieces, from corner to corner, metres."""
    sides = list[tuple[FloatArray, FloatArray]]()
    for piece in plate.pieces:
        corners = piece * METRES
        own = list(zip(corners, np.roll(corners, -1, axis=0), strict=True))
        sides += own if len(corners) > 2 else own[: len(corners) - 1]
    return sides


def rim(corners: FloatArray, made: Assembly) -> list[Shape]:
    """Flat bars along the edges of the body's outline (n, 2), metres, as high as its plate."""
    carrier = made.plate(made.body)
    assert carrier is not None
    heights, width = _inset(carrier, made), made.dimensions.thickness * METRES
    ends = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    return [_bar(one, two, width, heights) for one, two in ends]


def _bar(one: FloatArray, two: FloatArray, width: float, heights: tuple[float, float]) -> Shape:
    """A box between two points (2,)."""
    (low, high), way = heights, two - one
    centre = np.append((one + two) / 2, (low + high) / 2)
    size = (float(np.linalg.norm(way)), width, high - low)
    return Shape("box", centre, math.atan2(way[1], way[0]), size)


def _inset(part: Plate | Pin, made: Assembly) -> tuple[float, float]:
    """The heights of a part's shapes, metres: plates that lie on each other do not touch."""
    low, high = heights_of(part, made)
    off = INSET / 2 * made.dimensions.thickness
    return (low + off) * METRES, (high - off) * METRES


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
