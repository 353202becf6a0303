"""The least clearance of one linkage along its motion, exact within a tolerance.

Between two frames no point goes farther than `MotionFrames.ways` tells, so from the distances at
both the distance between them has a bound from below: half of their sum, less half of the way.
Where that bound is below the least distance so far, a frame is put in the middle, until no bound
is (conservative advancement: Zhang, Lee and Kim, Interactive continuous collision detection for
non-convex polyhedra, The Visual Computer 22, 2006, has it for one interval at a time).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Self, final

import numpy as np

from burmester.clearance.moving_parts import Pair, Ways, pairs_of
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven
from burmester.fourbar.dyad import PP, PR, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.geometry.shapes import nearest_points
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.tasks.surroundings import Surroundings

TOLERANCE: Final = 2e-5  # of the size of what moves; the least clearance is known to so much
FINE: Final = 1e-8  # the same where the coarser one leaves open whether the margin is kept
MAX_FRAMES: Final = 8000  # of one motion; beyond it the bound that is reached is told
CONTACT_HALVINGS: Final = 24  # of the way on which a contact begins
AT_POSE: Final = 1e-9  # of the motion; a place so near to a pose is at it


SAMPLES: Final = 721  # places among which a link or the coupler turns back
EVEN_FRAMES: Final = 65  # frames to begin with, poses and turning points not counted
ROUNDS, FINER = 5, 17  # a turning point is told to (2 / 16)^5 of a sample
REST: Final = 1e-10  # radians, or of the motion's size: what turns less does not turn back
MAX_TURNING_POINTS: Final = 40  # of one motion; links and coupler have a dozen at most
CURVED: Final = 1.1  # ways over chords, where both dyads are slots in the body; an estimate


@final
@dataclass(frozen=True, slots=True, eq=False)
class Clearance:
    """The least clearance of a linkage between its poses, and where it is.

    Attributes
    ----------
    least : float
        A length in the task's unit, attained; 0 where parts touch or overlap.
    error : float
        By how much the true one may be less, at most.
    part, obstacle : str
        What comes nearest, "the body", "the driver", "the follower" or "the coupler", and to
        what: the name of a region in quotes, or "region 1"; "the body" where that is checked
        against links in its plane.
    poses : (int, int)
        The indices of the poses between which it is; twice the same at a pose.
    input : float
        Of the driver there, radians or a length.
    place : Displacement
        Of the body there.
    points : (2, 2) array
        The nearest points in F, on the part (of a link on its middle line) and on the obstacle.

    Where parts touch, place and poses are those where a contact begins, as far as the motion
    was looked at.
    """

    least: float
    error: float
    part: str
    obstacle: str
    poses: tuple[int, int]
    input: float
    place: Displacement
    points: FloatArray

    @property
    def touches(self) -> bool:
        """Whether something touches."""
        return self.least <= 0


def clearance_between_poses(
    linkage: Linkage, driven: Driven, body: Polygon | None, around: Surroundings
) -> Clearance | None:
    """The least clearance of one linkage, driven by its first dyad, between its poses.

    None where the driver reaches no pose, and where there is nothing to stay clear of.
    """
    pairs = pairs_of(linkage, body, around)
    frames = MotionFrames.between_poses(linkage, driven) if pairs else None
    if frames is None or not len(frames.parameter):
        return None
    size = _size(frames, body)
    apart = np.stack([pair.distances(frames.places) for pair in pairs])
    known = driven.parameter[np.isfinite(driven.parameter)]
    backwards = bool(known[-1] < known[0])  # the poses come in the sense of a falling parameter
    while True:
        pair, index = _least(apart, backwards)
        best = float(apart[pair, index])
        if len(frames.parameter) == 1 or best <= 0:
            error = 0.0
            break
        ways = frames.ways()
        bounds = (apart[:, 1:] + apart[:, :-1] - [each.way(ways) for each in pairs]) / 2
        error = max(0.0, best - float(bounds.min()))
        divisible = np.diff(frames.parameter) > 4 * np.spacing(np.abs(frames.parameter[1:]))
        open_ = best - TOLERANCE * size <= around.margin <= best
        low = (bounds < best - (FINE if open_ else TOLERANCE) * size) & divisible
        wanted, near = low.any(axis=0), np.asarray(low.any(axis=1))
        if not wanted.any() or len(frames.parameter) > MAX_FRAMES:
            break
        near[pair] = True
        pairs, apart = [pairs[k] for k in np.flatnonzero(near)], apart[near]
        middle = (frames.parameter[1:] + frames.parameter[:-1])[wanted] / 2
        more = frames.at(middle)
        new = np.stack([each.distances(more.places) for each in pairs])
        parameter = np.concatenate([frames.parameter, more.parameter])
        order = np.argsort(parameter, kind="stable")
        apart = np.concatenate([apart, new], axis=1)[:, order]
        frames = frames.at(parameter[order])
    parameter, chosen = frames.parameter[index : index + 1], pairs[pair]
    if best <= 0:
        parameter = _first_contact(frames, apart[pair], index, chosen, backwards)
    there = frames.at(parameter)
    return Clearance(
        best,
        error,
        chosen.part,
        chosen.obstacle,
        _poses_about(driven.parameter, float(parameter[0])),
        float(frames.circuit.inputs(parameter, there.places)[0]),
        there.places[0],
        nearest_points(*chosen.shapes(there.places))[0],
    )


def _size(frames: MotionFrames, body: Polygon | None) -> float:
    """The diagonal of the box that holds pivots and body at the frames."""
    points = [frames.places.translation]
    for dyad in (frames.linkage.first, frames.linkage.second):
        for name in ("fixed_pivot", "moving_pivot"):
            if hasattr(dyad, name):
                at = getattr(dyad, name)[None]
                points.append(frames.places.act(at) if name == "moving_pivot" else at)
    if body is not None:
        points.append(frames.places[:, None].act(body.vertices).reshape(-1, 2))
    return float(np.linalg.norm(np.ptp(np.concatenate(points), axis=0)))


def _least(apart: FloatArray, backwards: bool) -> tuple[int, int]:
    """The pair and the frame (pairs, n) of the least distance, the first that the motion meets."""
    frame = apart.min(axis=0)
    index = len(frame) - 1 - int(frame[::-1].argmin()) if backwards else int(frame.argmin())
    return int(apart[:, index].argmin()), index


def _first_contact(
    frames: MotionFrames, apart: FloatArray, index: int, pair: Pair, backwards: bool
) -> FloatArray:
    """The parameter (1,) where the contact at a frame begins."""
    before = index + 1 if backwards else index - 1
    touching = frames.parameter[index]
    if not 0 <= before < len(apart):
        return np.array([touching])
    clear = frames.parameter[before]
    for _ in range(CONTACT_HALVINGS):
        middle = (clear + touching) / 2
        if pair.distances(frames.at(np.array([middle])).places)[0] > 0:
            clear = middle
        else:
            touching = middle
    return np.array([touching])


def _poses_about(parameter: FloatArray, at: float) -> tuple[int, int]:
    """The indices of the poses before and behind a parameter, twice the same at a pose."""
    known = np.flatnonzero(np.isfinite(parameter))
    s = parameter[known]
    near = np.abs(s - at)
    if near.min() <= AT_POSE * max(float(np.ptp(s)), 1e-300):
        return (int(known[near.argmin()]),) * 2
    order = np.argsort(s, kind="stable")
    k = int(np.clip(np.searchsorted(s[order], at), 1, len(s) - 1))
    one, two = sorted((int(known[order[k - 1]]), int(known[order[k]])))
    return one, two


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
