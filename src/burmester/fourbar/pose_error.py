"""How far the coupler is from the poses, and the frames in which that is measured."""

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

__all__ = ["PoseError", "error_frames"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class PoseError:
    """How far the coupler stays from the poses, at places (N,) of one linkage.

    Position in the task's length unit, angle in radians.
    """

    places: Displacement
    position: FloatArray
    angle: FloatArray

    @classmethod
    def at(cls, places: Displacement, poses: Displacement) -> PoseError:
        """The error of the places where the coupler is for the poses, whole turns apart."""
        gap = places.translation - poses.translation
        turn = wrapped_angle(places.angle - poses.angle)
        near = Displacement(places.translation, poses.angle + turn)
        return cls(near, np.hypot(gap[..., 0], gap[..., 1]), np.abs(turn))

    @classmethod
    def of(cls, linkage: Linkage, poses: Displacement, length: float) -> PoseError:
        """The error of the nearest places of a linkage (`nearest`), whatever their circuits."""
        frames = error_frames(poses, length)
        seen, unit = frames.see(poses), length / float(frames.length)
        stack = LinkageBatch.of([linkage]).seen(frames)
        found = nearest(on_circuits(stack, seen, unit), seen, unit)
        return cls.at(frames.unseen(found)[0], poses)

    @property
    def worst(self) -> float:
        """The greatest position error, infinite where some pose has no place near it."""
        return float(np.nan_to_num(self.position, nan=np.inf).max())

    @property
    def rms(self) -> float:
        """The root mean square of the position errors, infinite where there is none."""
        return float(np.sqrt((np.nan_to_num(self.position, nan=np.inf) ** 2).mean()))


def error_frames(poses: Displacement, length: float) -> CanonicalFrames:
    """Where errors are looked at: M as it is, for position errors are those of its origin.

    F has its origin amid the poses, and lengths are measured in the motion's size (at least
    `length`).
    """
    middle = poses.translation.mean(axis=-2)
    spread = np.sqrt(((poses.translation - middle) ** 2).sum(axis=-1).mean())
    return CanonicalFrames(middle, np.zeros(2), np.maximum(spread, length))
