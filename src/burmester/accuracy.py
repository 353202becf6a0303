"""How near an assembled linkage comes to the poses: the error that a user will see."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.displacement import Displacement, FloatArray
from burmester.linkage import Linkage

__all__ = ["PoseError"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class PoseError:
    """How far the coupler stays from the poses at its nearest places (`Linkage.nearest`).

    Position in the task's length unit, angle in radians.
    """

    places: Displacement
    position: FloatArray
    angle: FloatArray

    @classmethod
    def of(cls, linkage: Linkage, poses: Displacement, length: float) -> PoseError:
        """The pose error of a linkage; `length` trades angle against position."""
        places = linkage.nearest(poses, length)
        gap = places.translation - poses.translation
        return cls(places, np.hypot(gap[:, 0], gap[:, 1]), np.abs(places.angle - poses.angle))

    @property
    def worst(self) -> float:
        """The greatest position error, infinite where some pose has no place near it."""
        return float(np.nan_to_num(self.position, nan=np.inf).max())
