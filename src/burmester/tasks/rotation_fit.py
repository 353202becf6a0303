"""Poses as a turn about one point and what that leaves, in complex numbers; with their errors."""

from __future__ import annotations

from typing import NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, ComplexArray, FloatArray, complex_of, pairs_of
from burmester.tasks.motion_task import COARSE
from burmester.tasks.repeated_poses import COORDINATE_ROUNDING
from burmester.tasks.scatter import MAX_RESIDUAL_ERRORS, max_residual_errors

LARGE_ROTATION = 0.1  # radians, rms; as large a one shows by itself whether it is about a point

Mask = NDArray[np.bool_]


@final
class RotationFit(NamedTuple):
    """Poses (*, N) as d = c + minus_m turn + residual, by least squares; bounds on their errors.

    constant_angle: (*,), whether all angles are the same within their errors; then m is zero.
    about_point: (*,), whether errors explain the residual.
    length: (*,), the rms of the residual, which is the unit of the canonical frames; where errors
        explain it, the spread of the poses; zero where they do not spread either.
    """

    d: ComplexArray
    turn: ComplexArray
    constant_angle: Mask
    about_point: Mask
    c: ComplexArray
    minus_m: ComplexArray
    residual: ComplexArray
    length: FloatArray
    position_error: FloatArray
    turn_error: FloatArray
    rounding: FloatArray
    turn_rounding: FloatArray

    @classmethod
    def of(cls, poses: Displacement, resolution: tuple[float, float]) -> Self:
        """That of distinct poses, and how exactly they are known."""
        d, turn = complex_of(poses.translation), np.exp(1j * poses.angle)
        middle, (position, angle) = d.mean(axis=-1), resolution
        centred = d - middle[..., None]
        spread = rms(centred)
        # The travel depends on the origin of M, so errors of a large rotation count as stated.
        large = rms(turn - turn.mean(axis=-1, keepdims=True)) >= LARGE_ROTATION
        near = (spread > 0) & ~large
        none = np.zeros(spread.shape, dtype=bool)
        still = cls(
            *(d, turn, none, none, middle, np.zeros_like(middle), centred, spread),
            np.where(near, np.minimum(position, COARSE * spread), position),
            np.where(large, angle, min(angle, COARSE)),
            COORDINATE_ROUNDING * np.abs(d).max(axis=-1),
            COORDINATE_ROUNDING * np.maximum(1.0, np.abs(poses.angle).max(axis=-1)),
        )
        arc = np.ptp(still.angle_offsets, axis=-1)
        constant = np.asarray(arc <= 2 * MAX_RESIDUAL_ERRORS * still.angle_error)
        residual, c, minus_m = residual_of_turn(d, turn)
        length, moving = rms(residual), still._replace(length=np.zeros_like(spread))
        about = (length <= ROUNDING * spread) | moving.explains(residual, np.abs(minus_m))
        return still._replace(
            constant_angle=constant,
            about_point=about & ~constant,
            c=np.where(constant, middle, c),
            minus_m=np.where(constant, 0.0, minus_m),
            residual=np.where(constant[..., None], centred, residual),
            length=np.where(constant | about, spread, length),
        )

    @property
    def angle_offsets(self) -> FloatArray:
        """The angles (*, N) from that of the first pose, in (-pi, pi]."""
        return np.asarray(np.angle(self.turn * self.turn[..., :1].conj()))

    @property
    def angle_error(self) -> FloatArray:
        """The error of an angle (*,)."""
        error = np.maximum(np.minimum(self.turn_error, COARSE), ROUNDING)
        return np.asarray(np.maximum(error, self.turn_rounding))

    @property
    def unit(self) -> FloatArray:
        """The length (*,), 1 where it is zero."""
        return np.where(self.length > 0, self.length, 1.0)

    @property
    def design(self) -> FloatArray:
        """The design matrices (*, N, 8) in canonical frames."""
        place = pairs_of(self.residual / self.unit[..., None])
        seen = Displacement(place, np.angle(self.turn))
        rows = constraint_manifold.monomials(seen.as_image_point())
        return np.asarray(rows * constraint_manifold.INVARIANT)

    def error(self, lever: FloatArray | float) -> FloatArray:
        """The errors (*,) of the places of points of M at distances `lever` from its origin."""
        printed = self.position_error + lever * self.turn_error
        rounding = self.rounding + lever * self.turn_rounding
        return np.asarray(np.maximum(np.maximum(printed, ROUNDING * self.length), rounding))

    def explains(self, miss: ComplexArray | FloatArray, lever: FloatArray | float) -> Mask:
        """Whether (*,) errors alone explain the residuals (*, N) of a model."""
        most = max_residual_errors(self.d.shape[-1]) * self.error(lever)
        return np.asarray(np.abs(miss).max(axis=-1) <= most)

    @property
    def two_angles(self) -> tuple[ComplexArray, Mask]:
        """The turn (*,) that is farthest from the first, and whether there are these two only."""
        offsets = self.angle_offsets
        at = np.abs(offsets).argmax(axis=-1)[..., None]
        second = np.take_along_axis(self.turn, at, axis=-1)
        other = np.angle(self.turn * second.conj())
        off = np.minimum(np.abs(offsets), np.abs(other)).max(axis=-1)
        only = np.asarray(off <= 2 * MAX_RESIDUAL_ERRORS * self.angle_error)
        return second[..., 0], only

    def tolerance(self, *, as_given: bool = False) -> FloatArray:
        """The most (*,) that errors of the poses make of a singular value of zero.

        as_given: where the numbers are taken as exact.
        """
        motion = self
        if as_given:
            none = np.zeros_like(self.position_error)
            motion = self._replace(position_error=none, turn_error=none)
        error = motion.error(np.abs(self.minus_m)) / self.unit + motion.angle_error
        return np.asarray(3 * np.minimum(error, COARSE) * np.sqrt(self.d.shape[-1] / 3))


def residual_of_turn(
    values: ComplexArray, turn: ComplexArray
) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """The residual (*, N) of values - (c + a turn) by least squares, with c and a (*,)."""
    mean, mean_turn = (each.mean(axis=-1, keepdims=True) for each in (values, turn))
    spread = turn - mean_turn
    power = (spread.real**2 + spread.imag**2).sum(axis=-1, keepdims=True)
    a = (spread.conj() * (values - mean)).sum(axis=-1, keepdims=True)
    a = a / np.where(power > 0, power, 1.0)
    return values - mean - a * spread, (mean - a * mean_turn)[..., 0], a[..., 0]


def rms(values: ComplexArray) -> FloatArray:
    """The root mean square (*,) of values (*, N)."""
    return np.asarray(np.sqrt((np.abs(values) ** 2).mean(axis=-1)))
