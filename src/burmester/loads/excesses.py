"""How far a linkage is from what is asked of its loads, as numbers that change smoothly.

A greatest force that two places share has a kink, and a search stops there.  So each part of the
motion has a number of its own.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.loads.load_figures import in_time
from burmester.loads.loaded_motion import LoadedLinkage, LoadedMotion
from burmester.numerics.arrays import FloatArray
from burmester.requirements.loads import (
    BODY_ACCELERATION,
    BODY_SPEED,
    CLOSES_FROM,
    DRIVER_TORQUE,
    HAND_FORCE,
    PIN_FORCE,
    STAYS_AT,
)
from burmester.verdicts.judged_linkage import LinkageAtPoses

PARTS: Final = 8  # of the motion
PLACES: Final = 72  # along the motion, as many in each part
MARGIN: Final = 2e-3  # relative; a force is greater between places by less
LEAST: Final = 1e-3  # of a bound; less is as good


def excesses(found: LinkageAtPoses) -> FloatArray:
    """Numbers (m,), of which none is above 0 where the bounds are kept; m depends on the task.

    Logarithms of forces to their bounds, lengths of springs to their strokes, and efforts that are
    too much to stay or to close as shares of the greatest.  Raises E163 and E177.
    """
    linkage = LoadedLinkage.of(found)
    loaded, asked = linkage.at(PLACES), found.task.requirements.bounds
    out = [np.full(1, -1.0)]
    if HAND_FORCE in asked:
        pushed, bound = loaded.hand_force(loaded.effort), asked[HAND_FORCE]
        rubbed = np.abs(loaded.hand_force(loaded.friction))
        if isinstance(bound, tuple):
            onwards = np.nan_to_num(pushed + rubbed, nan=sum(bound) / 2)
            out += _outside(onwards.reshape(PARTS, -1), *bound)
        else:
            out.append(_beyond(np.abs(pushed) + rubbed, bound))
    timed = {DRIVER_TORQUE, BODY_SPEED, BODY_ACCELERATION} & {*asked}
    drive = in_time(linkage) if timed else None
    if timed and drive is None and loaded.loads.drive is not None:  # it cannot keep the times
        out += [np.full(1, 1.0) for each in (BODY_SPEED, BODY_ACCELERATION) if each in asked]
    if DRIVER_TORQUE in asked and loaded.rates.turns:
        effort = loaded.effort if drive is None else np.full(PLACES, drive.effort.magnitude)
        out.append(_beyond(effort, asked[DRIVER_TORQUE]))
    if drive is not None:
        for each, value in ((BODY_SPEED, drive.speed), (BODY_ACCELERATION, drive.acceleration)):
            if each in asked:
                out.append(_beyond(np.full(PLACES, value), asked[each])[:1])
    if PIN_FORCE in asked:
        forces = loaded.pin_forces(-loaded.applied).values()
        out += [_beyond(np.hypot(*force.T), asked[PIN_FORCE]) for force in forces]
    out += [*_rests(linkage, loaded), _strokes(loaded)]
    return np.concatenate(out)


def _beyond(values: FloatArray, bound: float) -> FloatArray:
    """Of each part of the motion how far the greatest of values (n,) is above a bound."""
    most = np.nan_to_num(np.abs(values)).reshape(PARTS, -1).max(axis=1)
    return np.asarray(np.log(np.maximum(most / bound, LEAST)) + MARGIN)


def _outside(values: FloatArray, low: float, high: float) -> list[FloatArray]:
    """Of each part of the motion how far values (parts, n) are below and above a corridor."""
    size = max(abs(low), abs(high))
    sides = low - values.min(axis=1), values.max(axis=1) - high
    return [np.asarray(each / size + MARGIN) for each in sides]


def _rests(linkage: LoadedLinkage, loaded: LoadedMotion) -> list[FloatArray]:
    """How much too great the efforts are at the poses where it stays, or too small to close."""
    found = linkage.found
    asked, scale = found.task.requirements.bounds, float(np.nanmax(loaded.gross, initial=0.0))
    out, scale = [], scale or 1.0
    names = found.task.names or ("",) * len(linkage.pose_shares)
    stays = [
        {str(k + 1), name} & asked.get(STAYS_AT, frozenset()) != set()
        for k, name in enumerate(names)
    ]
    if any(stays):
        shares = np.nan_to_num(linkage.pose_shares[np.array(stays)])
        there = linkage.at(shares)
        out.append((np.abs(there.effort) - there.friction) / scale + MARGIN)
    if CLOSES_FROM in asked:
        angle = loaded.places[loaded.bodies.body].angle
        near = np.abs(angle - angle[0]) <= np.radians(asked[CLOSES_FROM])
        opens = (loaded.friction - loaded.sense * loaded.effort) / scale + MARGIN
        out.append(np.max(opens[near], keepdims=True))
    return out


def _strokes(loaded: LoadedMotion) -> FloatArray:
    """How far springs are longer or shorter than they may be."""
    out = list[float]()
    for course in loaded.springs:
        if course.spring.kind == "torsion":
            continue
        least, most = (each * loaded.of.metre for each in course.spring.span)
        if least > 0:
            out.append(float(np.log(least / course.length.min())))
        if np.isfinite(most):
            out.append(float(np.log(course.length.max() / most)))
    return np.array(out)
