"""The error of a linkage at the poses, and the frames in which errors are computed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import nearest, on_circuits
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle


@final
@dataclass(frozen=True, slots=True, eq=False)
class PoseError:
    """The error of one linkage at poses (N,): what its coupler misses them by.

    Attributes
    ----------
    places : Displacement
        (N,), of the coupler, nearest to the poses; nan where there is none.
    position : (N,) array of float
        The distances of the origin of M from the poses, in the task's length unit.
    angle : (N,) array of float
        The absolute differences of the angle, in radians.

    Examples
    --------
    >>> from burmester import RR, Displacement, Linkage
    >>> linkage = Linkage(RR([0, 0], [0, 0], 1), RR([4, 0], [3, 0], 3))
    >>> poses = Displacement.from_poses([(0, 1, 0.4), (-1, 0, 0.9)])
    >>> error = PoseError.of(linkage, poses, length=1)
    >>> round(error.worst, 3), round(error.rms, 3)
    (0.065, 0.049)
    """

    places: Displacement
    position: FloatArray
    angle: FloatArray

    @classmethod
    def at(cls, places: Displacement, poses: Displacement) -> PoseError:
        """The error of the coupler at given places (N,), whose angles count to whole turns."""
        gap = places.translation - poses.translation
        turn = wrapped_angle(places.angle - poses.angle)
        near = Displacement(places.translation, poses.angle + turn)
        return cls(near, np.hypot(gap[..., 0], gap[..., 1]), np.abs(turn))

    @classmethod
    def of(cls, linkage: Linkage, poses: Displacement, length: float) -> PoseError:
        """The error of a linkage at its places nearest to the poses, on either circuit.

        length: the length that a radian counts as, in the poses' unit.
        """
        frames = error_frames(poses, length)
        seen, unit = frames.to_canonical(poses), length / float(frames.length)
        batch = LinkageBatch.of([linkage]).to_canonical(frames)
        found = nearest(on_circuits(batch, seen, unit), seen, unit)
        return cls.at(frames.from_canonical(found)[0], poses)

    def scaled(self, scale: float) -> PoseError:
        """The same in another unit of length, `scale` of them for one."""
        places = Displacement(self.places.translation * scale, self.places.angle)
        return PoseError(places, self.position * scale, self.angle)

    def combined(self, length: float) -> FloatArray:
        """Both errors in one, (N,): the position error, and the angle's as if `length` a radian.

        This is what a refinement makes least.  Infinite where there is no place near the pose.

        Formula `pose-error` of the theory.
        """
        return np.nan_to_num(np.hypot(self.position, length * self.angle), nan=np.inf)

    @property
    def worst(self) -> float:
        """The greatest position error; infinite where there is no place near some pose."""
        return float(np.nan_to_num(self.position, nan=np.inf).max())

    @property
    def rms(self) -> float:
        """The root mean square of the position errors; infinite like `worst`."""
        return float(np.sqrt((np.nan_to_num(self.position, nan=np.inf) ** 2).mean()))


def error_frames(poses: Displacement, length: float) -> CanonicalFrames:
    """The frames in which errors are computed, where lengths are about 1.

    The origin of F is the mean of the poses' origins, and the unit is the size of the motion (at
    least `length`).  M stays, as position errors are those of its origin.
    """
    middle = poses.translation.mean(axis=-2)
    spread = np.sqrt(((poses.translation - middle) ** 2).sum(axis=-1).mean())
    return CanonicalFrames(middle, np.zeros(2), np.maximum(spread, length))
