"""A loop of four links in closed form: where it locks, and its joints where an angle is given."""

from __future__ import annotations

from typing import NamedTuple, final

import numpy as np

from burmester.mechanisms.circles import arccos_or_nan
from burmester.numerics.arrays import ComplexArray, FloatArray


@final
class FourBarLoop(NamedTuple):
    """Loops of four links (*,), A, C, D, B: lengths, and the direction of AB.

    ground, crank, coupler, follower: (*,), the lengths AB, AC, CD, BD; direction: (*,), a unit
    complex number; a, b: (*,), A and B.
    """

    a: ComplexArray
    b: ComplexArray
    direction: ComplexArray
    ground: FloatArray
    crank: FloatArray
    coupler: FloatArray
    follower: FloatArray

    @classmethod
    def of(
        cls,
        a: ComplexArray,
        b: ComplexArray,
        crank: FloatArray,
        coupler: FloatArray,
        follower: FloatArray,
    ) -> FourBarLoop:
        """Those with A and B, and the lengths AC, CD, BD: (*,)."""
        ground = np.abs(b - a)
        return cls(a, b, (b - a) / ground, ground, crank, coupler, follower)

    def locked(self, *, first: bool) -> FloatArray:
        """The angles of AC (first) or BD at which it locks: (*, 4), nan where there is none."""
        turning, held = (self.crank, self.follower)
        if not first:
            turning, held = held, turning
        reach = np.stack([self.coupler + held, np.abs(self.coupler - held)], axis=-1)
        return self._drives_with(turning, reach, first=first)

    def _drives_with(self, turning: FloatArray, reach: FloatArray, *, first: bool) -> FloatArray:
        """The angles (*, 2 k) that bring a crank's end `reach` (*, k) far from the other pivot.

        turning: (*,), the length of the crank.
        """
        half = np.asarray(arccos_or_nan(self.ground, turning, reach))
        toward = np.angle(self.direction if first else -self.direction)
        return np.concatenate([toward[..., None] + half, toward[..., None] - half], axis=-1)

    def with_angle(self, angle: FloatArray) -> ComplexArray:
        """The joints (*, 2 k, 4), A to D, where the angle at D from DC to DB is `angle` (*, k)."""
        ratio = (self.follower / self.coupler)[..., None] * np.exp(1j * angle)
        diagonal = self.coupler[..., None] * np.abs(1 - ratio)
        half = arccos_or_nan(self.ground, self.crank, diagonal)
        return self._joints(np.concatenate([half, -half], axis=-1), np.concatenate([angle] * 2, -1))

    def with_straight_crank(self) -> ComplexArray:
        """The joints (*, 4, 4), A to D, where A, B and C are in line."""
        far = np.stack([self.ground - self.crank, self.ground + self.crank], axis=-1)
        angle = arccos_or_nan(self.coupler, self.follower, far)
        half = np.broadcast_to([0, np.pi, 0, np.pi], (*angle.shape[:-1], 4))
        return self._joints(half, np.concatenate([angle, -angle], axis=-1))

    def _joints(self, half: FloatArray, angle: FloatArray) -> ComplexArray:
        """The joints (*, k, 4), of the angles (*, k) at A from AB to AC and at D from DC to DB."""
        a, b, way, _, crank, coupler, follower = (each[..., None] for each in self)
        c = a + crank * way * np.exp(1j * half)
        ratio = follower / coupler * np.exp(1j * angle)
        with np.errstate(divide="ignore", invalid="ignore"):
            d = (b - ratio * c) / (1 - ratio)
        return np.stack(np.broadcast_arrays(a, b, c, d), axis=-1)
