"""The crank angles of timed poses as constraints while all dimensions are refined."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import LinkageBatch, Transmission
from burmester.fourbar.loop_closure import DrivenLoop
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.refinement.constraints import ConstraintSlopes, ConstraintValues
from burmester.tasks.crank_timing import CrankTiming

PHASES = 9  # angles, by which all stated ones are shifted, that are tried at once
ROUNDS = 8  # of such trials, each over a quarter of the range of the one before


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
        return None if timing is None else replace(self, timing=timing)

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

    def timed_places(self, batch: LinkageBatch, rows: FloatArray, wanted: FloatArray) -> FloatArray:
        """Rows (k, N, 3) like those of places, at timed poses where the driver is at its angle.

        Of all angles by which those may be shifted the one nearest to rows wanted (N, 3).  Where
        the linkage does not get to all its angles, what its driver lacks is a turn of the body.
        """
        index, out = self.timing.timed, rows.copy()
        loop = DrivenLoop.of(batch.exchanged() if self.side else batch)
        side = np.full(len(batch), self.side)
        gap = Transmission.of(batch, rows, self.length, side).drive[:, index] - self.timing.turns
        phase, reach = np.zeros(len(batch)), np.zeros(len(batch))
        if not self.timing.absolute:
            away = wrapped_angle(gap - gap[:, :1])
            phase = gap[:, 0] + away.mean(axis=1)
            reach = np.abs(away - away.mean(axis=1, keepdims=True)).max(axis=1)
        start, every, tried = phase, np.arange(len(batch)), np.linspace(-1, 1, PHASES)
        for _ in range(1 if self.timing.absolute else ROUNDS):
            phases = phase[:, None] + reach[:, None] * tried  # (k, p)
            there = loop.closed_at(phases[..., None] + self.timing.turns)
            turned = wrapped_angle(there.angle - wanted[index, None, 2] / self.length)
            own = np.concatenate(
                [there.translation, self.length * turned[..., None]], axis=-1
            )  # (k, p, T, 2, 3), angles seen from those wanted
            own[..., 2] += wanted[index, None, 2]
            # One closure for all poses, or at change points the nearer one at each.
            apart = ((own - rows[:, None, index, None]) ** 2).sum(axis=-1)
            near = np.nan_to_num(apart, nan=np.inf).argmin(axis=-1)
            own = np.take_along_axis(own, near[..., None, None], axis=3)[..., 0, :]
            cost = ((own - wanted[index]) ** 2).sum(axis=(2, 3))
            best = np.nan_to_num(cost, nan=np.inf).argmin(axis=1)
            phase, reach = phases[every, best], reach * 2 / (PHASES - 1)
            own = own[every, best]
        whole = np.isfinite(own).all(axis=(1, 2))
        out[np.ix_(np.flatnonzero(whole), index)] = own[whole]
        lacking = np.abs(wrapped_angle(gap - start[:, None])) * self.length
        out[np.ix_(np.flatnonzero(~whole), index, np.array([2]))] += lacking[~whole][..., None]
        return out

    def _missed(self, drive: FloatArray) -> ConstraintValues:
        gap = drive[:, self.timing.timed] - self.timing.turns
        if not self.timing.absolute:
            gap = gap[:, 1:] - gap[:, :1]
        return self.length * wrapped_angle(gap), np.ones(gap.shape[1], dtype=bool)
