"""Frames of a motion, with the way of every moving part between two of them.

Between neighbouring frames neither link nor coupler turns back, as the places where they do are
frames themselves.  So the way of a moving pivot is the arc between its two places, and the turn of
the coupler the difference of its angles: no point of the coupler goes farther than both allow.
The places where one turns back are looked for among 721 places of the motion; what turns back
twice between two of these turns so little that it is left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Self, final

import numpy as np

from burmester.clearance.moving_parts import Ways
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven
from burmester.fourbar.dyad import PP, PR, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle

SAMPLES: Final = 721  # places among which a link or the coupler turns back
EVEN_FRAMES: Final = 65  # frames to begin with, poses and turning points not counted
ROUNDS, FINER = 5, 17  # a turning point is told to (2 / 16)^5 of a sample
REST: Final = 1e-10  # radians, or of the motion's size: what turns less does not turn back
MAX_TURNING_POINTS: Final = 40  # of one motion; links and coupler have a dozen at most
CURVED: Final = 1.1  # ways over chords, where both dyads are slots in the body; an estimate


@final
@dataclass(frozen=True, slots=True, eq=False)
class MotionFrames:
    """Frames (n,) of a linkage driven by its first dyad, from pose to pose.

    circuit: the one circuit, see `Circuits`.
    parameter: (n,), along it, rising.
    places: (n,), of the coupler.
    """

    linkage: Linkage
    circuit: Circuits
    parameter: FloatArray
    places: Displacement

    @classmethod
    def between_poses(cls, linkage: Linkage, driven: Driven) -> Self | None:
        """The frames between the poses that a driver reaches; None where it reaches none."""
        ends = driven.parameter[np.isfinite(driven.parameter)]
        if not len(ends) or driven.circuit < 0 or isinstance(linkage.first, PP):
            return None
        circuit = Circuits.of(linkage, as_given=True)[driven.circuit]
        low, high = float(ends.min()), float(ends.max())
        turning = _turning_points(linkage, circuit, low, high)
        even = np.linspace(low, high, EVEN_FRAMES)
        return cls._at(linkage, circuit, np.unique(np.concatenate([even, ends, turning])))

    @classmethod
    def _at(cls, linkage: Linkage, circuit: Circuits, parameter: FloatArray) -> Self:
        places = circuit.couplers(parameter)
        known = np.isfinite(places.angle) & np.isfinite(places.translation).all(axis=-1)
        return cls(linkage, circuit, parameter[known], places[known])

    def at(self, parameter: FloatArray) -> MotionFrames:
        """Frames at other parameters of the same circuit."""
        return self._at(self.linkage, self.circuit, parameter)

    def ways(self) -> Ways:
        """The ways between neighbouring frames, (n - 1,)."""
        turn = np.abs(wrapped_angle(np.diff(self.places.angle)))
        pivots, travel = [], []
        for dyad in (self.linkage.first, self.linkage.second):
            if isinstance(dyad, RR):
                swing = wrapped_angle(np.diff(_link_values(dyad, self.places)))
                pivots.append(dyad.moving_pivot)
                travel.append(dyad.radius * np.abs(swing))
            elif isinstance(dyad, PR):
                pivots.append(dyad.moving_pivot)
                travel.append(np.abs(np.diff(_link_values(dyad, self.places))))
        if not pivots:
            chords = np.linalg.norm(np.diff(self.places.translation, axis=0), axis=-1)
            return Ways(np.zeros((1, 2)), CURVED * chords[None], CURVED * turn)
        return Ways(np.stack(pivots), np.stack(travel), turn)


def _link_values(dyad: RR | PR, places: Displacement) -> FloatArray:
    """The angle of a link with two pins, or the coordinate of a slider on its line, (*,)."""
    if isinstance(dyad, PR):
        return dyad.along(places)
    arm = places.act(dyad.moving_pivot) - dyad.fixed_pivot
    return np.asarray(np.arctan2(arm[..., 1], arm[..., 0]))


def _turning_points(linkage: Linkage, circuit: Circuits, low: float, high: float) -> FloatArray:
    """The parameters (k,) within a range where a link or the coupler turns back."""
    if not high > low:
        return np.empty(0)
    dyads: Sequence[Dyad] = (linkage.first, linkage.second)
    links = [dyad for dyad in dyads if isinstance(dyad, RR | PR)]

    def values(parameter: FloatArray) -> FloatArray:
        """Of the coupler and of links, (values, *, n), without jumps along the last axis."""
        places = circuit.couplers(parameter.reshape(-1))
        rows = [places.angle, *(_link_values(dyad, places) for dyad in links)]
        angles = [True, *(isinstance(dyad, RR) for dyad in links)]
        return np.stack(
            [
                np.unwrap(row.reshape(parameter.shape)) if angle else row.reshape(parameter.shape)
                for row, angle in zip(rows, angles, strict=True)
            ]
        )

    s = np.linspace(low, high, SAMPLES)
    every = values(s)
    least = REST * np.maximum(np.ptp(np.nan_to_num(every), axis=1, keepdims=True), 1.0)
    step = np.diff(every, axis=1)
    sense = np.where(np.abs(step) > least, np.sign(step), 0.0)
    which, at = np.nonzero(sense[:, 1:] * sense[:, :-1] < 0)
    which, at = which[:MAX_TURNING_POINTS], at[:MAX_TURNING_POINTS]
    if not len(at):
        return np.empty(0)
    start, end, up = s[at], s[at + 2], sense[which, at]
    for _ in range(ROUNDS):
        finer = start[:, None] + (end - start)[:, None] * np.linspace(0, 1, FINER)
        there = values(finer)[which, np.arange(len(at))] * up[:, None]
        top = np.clip(np.nan_to_num(there, nan=-np.inf).argmax(axis=1), 1, FINER - 2)
        rows = np.arange(len(at))
        start, end = finer[rows, top - 1], finer[rows, top + 1]
    return np.asarray((start + end) / 2)
