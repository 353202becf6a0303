"""Canonical frames: where a fit is done, so that its answer does not depend on F, M or units.

The paper's fit changes with the unit of length and with the origins of F and M.  Here both
origins are moved to the pair of points (c in F, m in M) that stay closest together over the
poses, the minimum of the sum of |R m + d - c|², and lengths are measured in the root mean
square of what remains.  The pair goes along with F and M wherever they are put, and
exchanging F and M exchanges its points.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self, final

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, pairs_of, shares

# Mean squared deviation of e^(i angle).  A smaller one is rounding: M only translates.
ROTATION_ROUNDING = 1e-28
# Sizes of the motion.  With an origin of M farther off than this, long doubles save digits.
FAR_ORIGIN = 30.0
# Fraction of the motion's size.  If less of it remains, all poses share a pole.
SHARED_POLE = 1e-10


@final
@dataclass(frozen=True, slots=True, eq=False)
class CanonicalFrames:
    """New origins of F and M, and the length that becomes 1.

    fixed_origin: (*, 2) in F; moving_origin: (*, 2) in M; length: (*,) in the task's unit.
    """

    fixed_origin: FloatArray
    moving_origin: FloatArray
    length: FloatArray

    @classmethod
    def identity(cls, shape: tuple[int, ...] = ()) -> Self:
        """The task's own frames and unit: nothing changes."""
        return cls(np.zeros((*shape, 2)), np.zeros((*shape, 2)), np.ones(shape))

    @classmethod
    def of(
        cls, poses: Displacement, weights: FloatArray | None = None
    ) -> tuple[Self, Displacement]:
        """The canonical frames of poses (*, N), and the poses seen in them.

        Formula `canonical-frames` of the theory.
        """
        share = shares(weights, poses.shape)
        d = poses.translation[..., 0] + 1j * poses.translation[..., 1]
        turn = np.exp(1j * poses.angle)
        mean_d = (share * d).sum(axis=-1, keepdims=True)
        mean_turn = (share * turn).sum(axis=-1, keepdims=True)
        d0, turn0 = d - mean_d, turn - mean_turn
        spread = (share * (turn0.real**2 + turn0.imag**2)).sum(axis=-1, keepdims=True)
        moment = -(share * turn0.conj() * d0).sum(axis=-1, keepdims=True)
        m = np.divide(moment, spread, out=np.zeros_like(moment), where=spread > ROTATION_ROUNDING)
        c = mean_d + mean_turn * m
        rest = d0 + turn0 * m
        before, length = _rms(share, d0), np.array(_rms(share, rest))
        if (far := np.abs(m[..., 0]) > FAR_ORIGIN * length).any():
            rest[far] = _less_rounding(poses[far], c[far], m[far])
            length[far] = _rms(share[far], rest[far])
        # Poses with a common pole leave nothing to measure by but the motion itself.
        length = np.where(length > SHARED_POLE * before, length, before)
        length = np.where(length > 0, length, 1.0)
        frames = cls(pairs_of(c[..., 0]), pairs_of(m[..., 0]), length)
        return frames, Displacement(pairs_of(rest / length[..., None]), poses.angle)

    def to_canonical(self, poses: Displacement) -> Displacement:
        """Poses (*, N) as these frames (*,) see them."""
        moved = poses.act(self.moving_origin[..., None, :]) - self.fixed_origin[..., None, :]
        return Displacement(moved / self.length[..., None, None], poses.angle)

    def from_canonical(self, places: Displacement) -> Displacement:
        """Places (*,) found in these frames, of one task, as its own see them."""
        own = self.length * places.translation + self.fixed_origin
        return Displacement(own - places.rotate(self.moving_origin), places.angle)

    def circle_from_canonical(self, circle: RR) -> RR:
        """RR dyads (*, k) found in these frames (*,), as the task's own frames see them."""
        length = self.length[..., None]
        return RR(
            circle.fixed_pivot * length[..., None] + self.fixed_origin[..., None, :],
            circle.moving_pivot * length[..., None] + self.moving_origin[..., None, :],
            circle.radius * length,
        )

    def line_from_canonical(self, line: PR | RP) -> PR | RP:
        """PR or RP dyads (*,) found in these frames (*,), as the task's own frames see them."""
        normal = np.stack([np.cos(line.normal_angle), np.sin(line.normal_angle)], axis=-1)
        unit = self.length[..., None]
        if isinstance(line, PR):
            offset = line.offset * self.length + (normal * self.fixed_origin).sum(axis=-1)
            pivot = line.moving_pivot * unit + self.moving_origin
            return PR(line.normal_angle, offset, pivot)
        offset = line.offset * self.length + (normal * self.moving_origin).sum(axis=-1)
        pivot = line.fixed_pivot * unit + self.fixed_origin
        return RP(pivot, line.normal_angle, offset)


def _less_rounding(poses: Displacement, c: np.ndarray, m: np.ndarray) -> np.ndarray:
    """R m + d - c over poses (*, N), computed in the machine's longest floating point."""
    d = poses.translation.astype(np.longdouble)
    angle = poses.angle.astype(np.longdouble)
    turn = np.cos(angle) + 1j * np.sin(angle)
    rest: np.ndarray = (turn * m + (d[..., 0] + 1j * d[..., 1]) - c).astype(np.complex128)
    return rest


def _rms(share: FloatArray, values: np.ndarray) -> FloatArray:
    squares: FloatArray = (share * (values.real**2 + values.imag**2)).sum(axis=-1)
    return np.sqrt(squares)
