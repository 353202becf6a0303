"""The branches of a linkage as plain data: frames along each of them, and the poses among these.

A way is a branch of a circuit, or the stretch of it in the scene: all that the driver reaches
without the linkage being taken apart and without passing a dead point.  Its frames lie along the
circuit's own parameter, so that nothing jumps at a dead point; the drive rises along them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.circuit_parameter import RangeType
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.instantaneous import transmission_angle
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.pose_order import around_circuit
from burmester.numerics.arrays import FloatArray
from burmester.verdicts.found_linkage import FoundLinkage

REACH = 1.2  # scenes from the middle of the poses: how far an endless way is followed
REACH_WITHOUT_POSES = 3.0  # the same for a way on which no pose is
SAMPLES = 2001  # along an endless way, to find where it leaves the scene
WIDEST_ANGLE = 0.999  # quarter turns: the last sample of a way that runs to infinity
EDGE = 1e-3  # radians left out at either end of a way that runs to infinity at its ends
DIGITS = 12  # significant digits of a place, counted from the size of the scene


@dataclass(frozen=True)
class Branches:
    """The ways of a linkage, each as plain data; at: for each pose its pair (way, frame) or None.

    A frame is counted from 0 and may be a fraction.
    """

    ways: list[dict[str, Any]]
    at: list[tuple[int, float] | None]


class _Branch(NamedTuple):
    circuit: int
    number: int  # on its circuit: 0 or 1
    ends: tuple[float, float]  # of the circuit's parameter
    round: bool  # it closes: the end is the start
    dead: tuple[bool, bool]  # whether its ends are dead points


def branches_of(found: FoundLinkage, poses: Displacement, scene: float, frames: int) -> Branches:
    """The ways of a linkage moved by its better driver; frames: the number of them on each way.

    poses: (N,); scene: the size of the drawing, in the task's unit.
    No ways where the linkage cannot be driven, or its circuits cannot be determined.
    """
    none: list[tuple[int, float] | None] = [None] * poses.shape[0]
    linkage, places = found.driver_first, found.error.places
    try:
        circuits = Circuits.of(linkage, as_given=True)
    except InputError:
        return Branches([], none)
    here = circuits.locate(places)
    middle = poses.translation.mean(axis=0)
    ways: list[dict[str, Any]] = []
    at = list(none)
    for branch in _branches(circuits, here.circuit, here.parameter):
        own = circuits[branch.circuit]
        on = (here.circuit == branch.circuit) & (here.branch == branch.number)
        on &= np.isfinite(here.parameter)
        ends = branch.ends
        endless = own.range_type == RangeType.HALF or not all(map(math.isfinite, ends))
        if endless:
            reach = (REACH if on.any() else REACH_WITHOUT_POSES) * scene
            within = _within(own, ends, middle, reach, here.parameter[on])
            if within is None:
                continue
            ends = within
        s = _evenly(own, ends, frames, scene) if endless else np.linspace(*ends, frames)
        with np.errstate(invalid="ignore", divide="ignore"):
            way, falls = _way(linkage, own, s, scene)
        if way is None:
            continue
        for pose in np.flatnonzero(on).tolist():
            along = float(here.parameter[pose])
            if branch.round:
                along = ends[0] + (along - ends[0]) % (2 * np.pi)
            place = float(np.interp(along, s, np.arange(frames)))
            at[pose] = (len(ways), round(frames - 1 - place if falls else place, 9))
        first = next((at[pose] for pose in np.flatnonzero(on).tolist()), None)
        if own.loop.turns and first is not None:  # there the drive is between ±180°
            turns = round(float(np.interp(first[1], np.arange(frames), way["drive"])) / 360)
            way["drive"] = [round(each - 360 * turns, 9) for each in way["drive"]]
        dead = branch.dead[::-1] if falls else branch.dead
        ways.append(
            {
                "circuit": branch.circuit + 1,
                "branch": branch.number + 1,
                "branches": int(own.branches),
                "round": branch.round,
                "dead": list(dead),
                "poses": [pose + 1 for pose in np.flatnonzero(on).tolist()],
                **way,
            }
        )
    return Branches(ways, at)


def _branches(circuits: Circuits, circuit: np.ndarray, parameter: FloatArray) -> list[_Branch]:
    """Every branch of both circuits, with its ends along the parameter."""
    found = []
    for number in np.flatnonzero(circuits.exists).tolist():
        own = circuits[number]
        if own.turns_fully:
            start = _cut(parameter[(circuit == number) & np.isfinite(parameter)])
            found.append(_Branch(number, 0, (start, start + 2 * np.pi), True, (False, False)))
        elif own.branches == 1:
            ends = (0.0, np.pi) if own.loop.turns else (-np.inf, np.inf)
            found.append(_Branch(number, 0, ends, False, (False, False)))
        elif own.closed:
            found.append(_Branch(number, 0, (0.0, np.pi), False, (True, True)))
            found.append(_Branch(number, 1, (np.pi, 2 * np.pi), False, (True, True)))
        else:
            found.append(_Branch(number, 0, (0.0, np.inf), False, (True, False)))
            found.append(_Branch(number, 1, (-np.inf, 0.0), False, (False, True)))
    return found


def _cut(parameter: FloatArray) -> float:
    """The parameter at which a whole turn is cut open, for poses (n,) in their order.

    Between the last pose and the first, where the driver meets them in order; else in the widest
    gap between two poses.
    """
    if not len(parameter):
        return 0.0
    along = around_circuit(parameter[None], np.zeros(1)).along
    return float(along.min() + along.max()) / 2 - np.pi


def _within(
    own: Circuits, ends: tuple[float, float], middle: FloatArray, reach: float, poses: FloatArray
) -> tuple[float, float] | None:
    """The part of an endless way that stays in the scene, around the poses if there are any."""
    if own.loop.turns:
        s = np.linspace(ends[0] + EDGE, ends[1] - EDGE, SAMPLES)
    else:
        share = np.linspace(-WIDEST_ANGLE, WIDEST_ANGLE, SAMPLES) * np.pi / 2
        s = reach * np.tan(share)
        s = np.unique(np.clip(s, *ends))
    if len(poses):
        s = np.unique(np.concatenate([s, poses]))
    with np.errstate(invalid="ignore", divide="ignore"):
        away = np.linalg.norm(own.couplers(s).translation - middle, axis=-1)
    inside = np.nan_to_num(away, nan=np.inf) <= reach
    if len(poses):
        first, last = (int(np.searchsorted(s, end)) for end in (poses.min(), poses.max()))
        inside[first : last + 1] = True
    else:
        first = last = int(np.nanargmin(np.where(np.isnan(away), np.inf, away)))
    if not inside[first]:
        return None
    while first > 0 and inside[first - 1]:
        first -= 1
    while last < len(s) - 1 and inside[last + 1]:
        last += 1
    return (float(s[first]), float(s[last])) if last > first else None


def _evenly(own: Circuits, ends: tuple[float, float], frames: int, scene: float) -> FloatArray:
    """Parameters between two ends, at places about equally far from each other."""
    s = np.linspace(*ends, SAMPLES)
    for _ in range(2):  # where places run fast, the first parameters are far apart
        with np.errstate(invalid="ignore", divide="ignore"):
            places = own.couplers(s)
        rows = np.column_stack([places.translation, scene * np.unwrap(places.angle)])
        length = np.cumsum(np.linalg.norm(np.diff(rows, axis=0, prepend=rows[:1]), axis=1))
        s = np.interp(np.linspace(0, length[-1], SAMPLES), length, s)
    return np.asarray(s[np.linspace(0, SAMPLES - 1, frames).round().astype(int)])


def _way(
    linkage: Linkage, own: Circuits, s: FloatArray, scene: float
) -> tuple[dict[str, Any] | None, bool]:
    """Frames at parameters s; the flag: reversed, for the drive to rise along them."""
    places = own.couplers(s)
    angle = np.unwrap(places.angle)
    places = Displacement(places.translation, angle)
    if not (np.isfinite(places.translation).all() and np.isfinite(angle).all()):
        return None, False
    drive = own.inputs(s, places)
    turns = own.loop.turns
    if turns:
        middle = (drive[0] + drive[-1]) / 2
        drive = drive - 2 * np.pi * np.round(middle / (2 * np.pi))
    falls = bool(drive[-1] < drive[0])
    if falls:
        drive, places = drive[::-1], Displacement(places.translation[::-1], angle[::-1])
    passed = np.degrees(transmission_angle(linkage, places))
    digits = DIGITS - math.floor(math.log10(scene))
    x, y = places.translation.T
    return {
        "drive": np.round(np.degrees(drive) if turns else drive, 9 if turns else digits).tolist(),
        "x": np.round(x, digits).tolist(),
        "y": np.round(y, digits).tolist(),
        "angle": np.round(places.angle, 13).tolist(),
        "transmission": [None if math.isnan(each) else round(each, 4) for each in passed.tolist()],
    }, falls
