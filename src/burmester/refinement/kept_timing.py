"""The crank angles of timed poses as constraints while all dimensions are refined."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.transmission import Transmission
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.refinement.constraints import ConstraintSlopes, ConstraintValues
from burmester.tasks.crank_timing import CrankTiming

__all__ = ["TimingConstraint"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class TimingConstraint:
    """The constraint that the dyad on one side is at the stated angles, at the places of N poses.

    Between timed poses it has turned as stated or, of absolute angles, it has them.  length: what
    a radian counts as in rows, and in these values.
    """

    side: int
    timing: CrankTiming
    length: float
    uses_places: ClassVar[bool] = True

    def at(self, index: NDArray[np.intp]) -> Self | None:
        """The constraint at some poses; None where it says nothing of them."""
        timing = self.timing.at(index)
        return None if timing is None or not timing.conditions else replace(self, timing=timing)

    def __call__(
        self, batch: LinkageBatch, rows: FloatArray, which: NDArray[np.intp]
    ) -> ConstraintValues:
        side = np.full(len(batch), self.side)
        return self._missed(Transmission.of(batch, rows, self.length, side).drive)

    def differentiated(
        self,
        batch: LinkageBatch,
        rows: FloatArray,
        which: NDArray[np.intp],
        place_jacobian: FloatArray,
    ) -> ConstraintSlopes:
        """Also the derivatives."""
        there, _, by_drive = Transmission.differentiated(
            batch, rows, self.length, np.full(len(batch), self.side), place_jacobian
        )
        value, equal = self._missed(there.drive)
        slope = by_drive[:, self.timing.timed]
        if not self.timing.absolute:
            slope = slope[:, 1:] - slope[:, :1]
        return value, self.length * slope, equal

    def _missed(self, drive: FloatArray) -> ConstraintValues:
        gap = drive[:, self.timing.timed] - self.timing.turns
        if not self.timing.absolute:
            gap = gap[:, 1:] - gap[:, :1]
        return self.length * wrapped_angle(gap), np.ones(gap.shape[1], dtype=bool)
