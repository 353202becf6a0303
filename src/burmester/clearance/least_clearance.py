"""The least clearance of one linkage along its motion, exact within a tolerance.

Between two frames no point goes farther than `MotionFrames.ways` tells, so from the distances at
both the distance between them has a bound from below: half of their sum, less half of the way.
Where that bound is below the least distance so far, a frame is put in the middle, until no bound
is (conservative advancement: Zhang, Lee and Kim, Interactive continuous collision detection for
non-convex polyhedra, The Visual Computer 22, 2006, has it for one interval at a time).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, final

import numpy as np
import shapely

from burmester.clearance.motion_frames import MotionFrames
from burmester.clearance.moving_parts import Pair, pairs_of
from burmester.fourbar.defects import Driven
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.tasks.surroundings import Surroundings

TOLERANCE: Final = 2e-5  # of the size of what moves; the least clearance is known to so much
FINE: Final = 1e-8  # the same where the coarser one leaves open whether the margin is kept
MAX_FRAMES: Final = 8000  # of one motion; beyond it the bound that is reached is told
CONTACT_HALVINGS: Final = 24  # of the way on which a contact begins
AT_POSE: Final = 1e-9  # of the motion; a place so near to a pose is at it


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
    ones, others = chosen.shapes(there.places)
    points = shapely.get_coordinates(shapely.shortest_line(ones, others))
    return Clearance(
        best,
        error,
        chosen.part,
        chosen.obstacle,
        _poses_about(driven.parameter, float(parameter[0])),
        float(frames.circuit.inputs(parameter, there.places)[0]),
        there.places[0],
        points,
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
