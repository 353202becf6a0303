"""A 3R chain: ground, two links and the body, with a joint A, C, E between each and the next.

With three degrees of freedom it reaches every pose in its reach, so that the poses of its middle
link are known as soon as A, E and both lengths are chosen.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, final

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.mechanisms.circles import meeting
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of

__all__ = ["ThreeRChain"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class ThreeRChain:
    """3R chains (*,): A in F (*, 2), the lengths of AC and CE (*,), E in M (*, 2)."""

    fixed_pivot: FloatArray
    first_length: FloatArray
    second_length: FloatArray
    body_joint: FloatArray

    def __getitem__(self, index: Any) -> ThreeRChain:
        """Pick along the leading axes (indices, slices, masks)."""
        return ThreeRChain(*(getattr(self, name)[index] for name in self.__match_args__))

    def elbows(self, poses: Displacement, side: FloatArray) -> ComplexArray:
        """Where C is at poses (*, N), to the left (+1) or right of AE: (*, N); nan out of reach.

        side: (*,), the same at all poses.
        """
        a, e = complex_of(self.fixed_pivot)[..., None], self._ends(poses)
        first, second = self.first_length[..., None], self.second_length[..., None]
        return meeting(a, first, e, second, side[..., None])

    def middle_link(self, poses: Displacement, elbow: ComplexArray) -> Displacement:
        """The poses (*, N) of the link CE, its origin C (`elbow`) and its x axis towards E."""
        origin = np.stack([elbow.real, elbow.imag], axis=-1)
        return Displacement(origin, np.angle(self._ends(poses) - elbow))

    def _ends(self, poses: Displacement) -> ComplexArray:
        return complex_of(poses.act(self.body_joint[..., None, :]))
