"""How far a body is from the poses of a task: what the nearest places make least."""

from __future__ import annotations

from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.refinement.tolerance_boxes import EXACT_ROUNDING
from burmester.tasks.pose_tolerances import PoseTolerances

__all__ = ["PoseMeasure"]


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

    def at(self, index: NDArray[np.intp]) -> PoseMeasure:
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
