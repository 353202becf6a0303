"""Where a six-bar locks while a crank drives it, in closed form.

The first loop, A, C, D, B, is a four-bar and locks as one does.  The second, D, E, H, G, moves by
the angle at D between the coupler and the second crank, which is a function of the first loop
alone.  It locks where its diagonal EG is as long as the floating link and the body's EH together,
or as their difference: at two angles at D with two signs each, which the first loop has at two
drives each.  So there are at most eight dead points of the second loop beside at most two of the
first, and between two that follow each other nothing locks.
"""

from __future__ import annotations

from typing import NamedTuple, final

import numpy as np

from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.sixbar.motion import Sides, drive_of, sides_of
from burmester.sixbar.watt import Drive, WattLinkage

__all__ = ["FirstLoop", "dead_points", "turning_points"]


@final
class FirstLoop(NamedTuple):
    """The first loops of six-bars (*,): lengths, and the direction of AB.

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
    def of(cls, linkage: WattLinkage) -> FirstLoop:
        """Those of linkages (*,)."""
        a, b = complex_of(linkage.fixed_first), complex_of(linkage.fixed_second)
        coupler = np.abs(complex_of(linkage.coupler_joint))
        return cls.with_lengths(a, b, linkage.first_crank, coupler, linkage.second_crank)

    @classmethod
    def with_lengths(
        cls,
        a: ComplexArray,
        b: ComplexArray,
        crank: FloatArray,
        coupler: FloatArray,
        follower: FloatArray,
    ) -> FirstLoop:
        """Those with A and B, and the lengths AC, CD, BD: (*,)."""
        ground = np.abs(b - a)
        return cls(a, b, (b - a) / ground, ground, crank, coupler, follower)

    def locked(self, driver: Drive) -> FloatArray:
        """The drives at which the first loop locks: (*, 4), nan where there is none."""
        turning, held = (self.crank, self.follower)
        if driver == "second":
            turning, held = held, turning
        reach = np.stack([self.coupler + held, np.abs(self.coupler - held)], axis=-1)
        return self._drives_with(turning, reach, driver)

    def _drives_with(self, turning: FloatArray, reach: FloatArray, driver: Drive) -> FloatArray:
        """The drives (*, 2 k) that bring the driver's end `reach` (*, k) far from the other pivot.

        turning: (*,), the driver's length.
        """
        half = np.asarray(arccos_or_nan(self.ground, turning, reach))
        toward = np.angle(self.direction if driver == "first" else -self.direction)
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


def dead_points(linkage: WattLinkage, sides: Sides, driver: Drive) -> FloatArray:
    """The drives at which linkages (*,) lock on their branch: (*, 12), nan where there is none.

    Formula `second-loop` of the theory.
    sides: of the branch, which is that of the first loop; the second locks where its two sides
    meet.
    """
    loop = FirstLoop.of(linkage)
    e, g = _arms(linkage)
    body = np.abs(complex_of(linkage.link_joint) - complex_of(linkage.body_joint))
    link = linkage.floating_link
    reach = np.stack([body + link, np.abs(body - link)], axis=-1)
    between = arccos_or_nan(np.abs(e), np.abs(g), reach)
    offset = np.angle(e / g)[..., None]
    joints = loop.with_angle(np.concatenate([offset + between, offset - between], axis=-1))
    second = _drives_on_branch(joints, sides, driver)
    return np.concatenate([loop.locked(driver), second], axis=-1)


def turning_points(linkage: WattLinkage, sides: Sides, driver: Drive) -> FloatArray:
    """The drives at which a transmission angle of linkages (*,) may be least: (*, 10), or nan.

    Formula `second-loop-turns` of the theory.
    Those at which the driver is in line with the ground, so that the first loop's diagonal turns
    back; those at which the first crank is, so that the angle at D does; and those at which the
    angle in the second loop between DE and DG passes zero or half a turn.
    """
    loop = FirstLoop.of(linkage)
    e, g = _arms(linkage)
    way, offset = np.angle(loop.direction)[..., None], np.angle(e / g)[..., None]
    diagonal = loop.with_angle(np.concatenate([offset, offset + np.pi], axis=-1))
    joints = np.concatenate([loop.with_straight_crank(), diagonal], axis=-2)
    inside = _drives_on_branch(joints, sides, driver)
    return np.concatenate([way, way + np.pi, inside], axis=-1)


def arccos_or_nan(one: FloatArray, other: FloatArray, opposite: FloatArray) -> FloatArray:
    """The angle between sides one and other (*,) of triangles with `opposite` (*, k); or nan."""
    one, other = one[..., None], other[..., None]
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.arccos((one**2 + other**2 - opposite**2) / (2 * one * other)))


def _arms(linkage: WattLinkage) -> tuple[ComplexArray, ComplexArray]:
    """DE as DC sees it, and DG as DB sees it: (*,) each.

    Turned by the angle at D from DC to DB, the second is as DC sees it.
    """
    d, g = complex_of(linkage.coupler_joint), complex_of(linkage.crank_joint)
    return (d - linkage.coupler_arm) * np.abs(d) / d, linkage.second_crank - g


def _drives_on_branch(joints: ComplexArray, sides: Sides, driver: Drive) -> FloatArray:
    """The drives (*, k) of first loops (*, k, 4) that are closed on a branch's side; else nan."""
    whole = np.concatenate([joints, joints[..., :3]], axis=-1)  # the second loop is not asked
    with np.errstate(invalid="ignore"):
        same = sides_of(whole, driver).first == sides.first[..., None]
    return np.where(same, drive_of(whole, driver), np.nan)
