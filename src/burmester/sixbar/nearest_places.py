"""The places of a six-bar nearest to poses, on each of its branches.

A branch has one degree of freedom, the drive, so that the nearest place is a minimum in one number:
places along the whole branch are looked at, and the lowest of them are refined between their
neighbours.
"""

from __future__ import annotations

import math
from typing import NamedTuple, final

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.refinement.tolerance_boxes import EXACT_ROUNDING
from burmester.sixbar.branches import Branches
from burmester.sixbar.motion import joints_at, poses_of
from burmester.sixbar.watt import Drive, WattLinkage
from burmester.tasks.pose_tolerances import PoseTolerances

__all__ = ["PoseMeasure", "nearest_drives"]

PLACES = 721  # along a branch
REFINED = 3  # of the places that are nearer than both neighbours, so many are refined
STEPS = 45  # of the golden section: 1e-9 of the way between two places is left
GOLDEN = (math.sqrt(5) - 1) / 2
END = 2e-5  # of a branch; nearer to a dead point rounding decides whether a loop is closed
AT_ONCE = 1_000_000  # places times poses looked at in one go; bounds the memory


@final
class PoseMeasure(NamedTuple):
    """What is made least at poses (N,).

    The position error, and the angle's as if `length` a radian; components that tolerances leave
    free count as none.  Where these give room, the greatest share of a tolerance that is used.
    size: of the motion, by which the rounding of exact components is measured.
    """

    poses: Displacement
    tolerances: PoseTolerances | None
    length: float
    size: float

    def at(self, index: slice) -> PoseMeasure:
        """That of some poses."""
        some = None if self.tolerances is None else self.tolerances.at(index)
        return self._replace(poses=self.poses[index], tolerances=some)

    def __call__(self, places: Displacement) -> FloatArray:
        """Of places (*, N), or (*, 1) for all poses: (*, N); infinite where there is no place."""
        if self.tolerances is None:
            gap = places.translation - self.poses.translation
            turn = wrapped_angle(places.angle - self.poses.angle)
            off = np.hypot(np.hypot(gap[..., 0], gap[..., 1]), self.length * turn)
        elif self.tolerances.gives_room:
            rounding = EXACT_ROUNDING * np.array([self.size, self.size, 1.0])
            off = self.tolerances.share(places, self.poses, rounding).max(axis=-1)
        else:
            away = self.tolerances.deviations(places, self.poses)
            away = np.where(self.tolerances.free, 0.0, away)
            off = np.linalg.norm(away * [1.0, 1.0, self.length], axis=-1)
        off = np.where(np.isfinite(places.angle), off, np.inf)
        return np.asarray(np.nan_to_num(off, nan=np.inf))


def nearest_drives(
    linkage: WattLinkage, branches: Branches, driver: Drive, measure: PoseMeasure
) -> tuple[FloatArray, FloatArray]:
    """The drives (k, N) on branches (k,) at which the body is nearest to poses, and the measure."""
    count, number = len(branches.low), measure.poses.shape[0]
    drives, least = np.empty((count, number)), np.empty((count, number))
    steps = np.linspace(END, 1 - END, PLACES)
    along = _Along(linkage, branches, driver)
    shown = along.places(np.broadcast_to(steps, (count, PLACES)))[..., None]
    at_once = max(1, AT_ONCE // (PLACES * max(1, count)))
    for start in range(0, number, at_once):
        some = slice(start, min(start + at_once, number))
        part = measure.at(some)
        off = part(shown)
        walls = np.full((count, 1, off.shape[-1]), np.inf)
        lower = np.concatenate([walls, off[:, :-1]], axis=1)
        upper = np.concatenate([off[:, 1:], walls], axis=1)
        low = np.where((off <= lower) & (off <= upper), off, np.inf)
        best = np.argpartition(low, REFINED, axis=1)[:, :REFINED]
        ends = steps[np.maximum(best - 1, 0)], steps[np.minimum(best + 1, PLACES - 1)]
        share, there = _golden(along, part, *ends)
        pick = there.argmin(axis=1)[:, None]
        share = np.take_along_axis(share, pick, axis=1)
        drives[:, some] = along.drives(share)[:, 0]
        least[:, some] = np.take_along_axis(there, pick, axis=1)[:, 0]
    return drives, least


class _Along(NamedTuple):
    """The branches (k,) of a linkage by a share of the way along each, from 0 to 1.

    Towards a dead point steps of the drive become small, as the body moves there by the root of
    what is left; towards none they are even.
    """

    linkage: WattLinkage
    branches: Branches
    driver: Drive

    def drives(self, share: FloatArray) -> FloatArray:
        """At shares (k, ...)."""
        low, high, full = (_beside(each, share) for each in self.branches[1:4])
        return np.asarray(
            low + (high - low) * np.where(full, share, (1 - np.cos(np.pi * share)) / 2)
        )

    def places(self, share: FloatArray) -> Displacement:
        """The body there, (k, ...)."""
        sides = type(self.branches.sides)(*(_beside(e, share) for e in self.branches.sides))
        with np.errstate(invalid="ignore"):
            joints = joints_at(self.linkage, self.drives(share), sides, self.driver)
            return poses_of(self.linkage, joints)


def _golden(
    along: _Along, measure: PoseMeasure, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The shares (k, m, N) between low and high at which the measure is least, and the measure."""
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = measure(along.places(left)), measure(along.places(right))
    for _ in range(STEPS):
        down = at_left < at_right
        low, high = np.where(down, low, left), np.where(down, right, high)
        new = np.where(down, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        there = measure(along.places(new))
        left, right = np.where(down, new, right), np.where(down, left, new)
        at_left, at_right = np.where(down, there, at_right), np.where(down, at_left, there)
    better = at_left <= at_right
    return np.where(better, left, right), np.where(better, at_left, at_right)


def _beside(values: np.ndarray, share: FloatArray) -> np.ndarray:
    """Values (k,) with as many axes as shares (k, ...) have."""
    return values.reshape(-1, *[1] * (share.ndim - 1))
