"""Where a six-bar is while a crank drives it: two loops of four links, each in closed form.

A joint that two links hold is where two circles meet, on one side of the line between their centres
or on the other.  The two sides, +1 or -1, say on which branch of the drive a linkage is.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.sixbar.watt import Drive, WattLinkage

__all__ = ["Sides", "drive_of", "joints_at", "meeting", "poses_of", "sides_of", "transmission"]


class Sides(NamedTuple):
    """On which side both loops are closed, +1 or -1 each: (*,).

    first: of the joint of the first loop that the driver does not carry (D from C, where the first
    crank drives; C from D, where the second does); second: of H, seen from G to E.
    """

    first: FloatArray
    second: FloatArray

    def at(self, index: Any) -> Sides:
        """Those of some linkages (indices, slices, masks)."""
        return Sides(self.first[index], self.second[index])


def joints_at(linkage: WattLinkage, drive: FloatArray, sides: Sides, driver: Drive) -> ComplexArray:
    """The joints (*, 7) of linkages (*,) whose driver stands at an angle (*,), in radians, in F.

    In the order of `JOINTS`; nan where a loop cannot be closed.
    """
    a, b = complex_of(linkage.fixed_first), complex_of(linkage.fixed_second)
    at_d, at_g = complex_of(linkage.coupler_joint), complex_of(linkage.crank_joint)
    if driver == "first":
        c = a + linkage.first_crank * np.exp(1j * drive)
        d = meeting(c, np.abs(at_d), b, linkage.second_crank, sides.first)
    else:
        d = b + linkage.second_crank * np.exp(1j * drive)
        c = meeting(d, np.abs(at_d), a, linkage.first_crank, sides.first)
    e = c + (d - c) / at_d * linkage.coupler_arm
    g = b + (d - b) / linkage.second_crank * at_g
    body = np.abs(complex_of(linkage.link_joint) - complex_of(linkage.body_joint))
    h = meeting(g, linkage.floating_link, e, body, sides.second)
    return np.stack(np.broadcast_arrays(a, b, c, d, e, g, h), axis=-1)


def meeting(
    centre: ComplexArray,
    radius: FloatArray,
    other: ComplexArray,
    other_radius: FloatArray,
    side: FloatArray,
) -> ComplexArray:
    """Where two circles meet, to the left (+1) or right (-1) of the line from one centre to other.

    All (*,); nan where they do not meet.
    """
    way = other - centre
    squared = np.abs(way) ** 2
    with np.errstate(invalid="ignore", divide="ignore"):
        along = (squared + radius**2 - other_radius**2) / (2 * squared)
        across = np.sqrt(radius**2 / squared - along**2)
        return np.asarray(centre + way * (along + 1j * side * across))


def poses_of(linkage: WattLinkage, joints: ComplexArray) -> Displacement:
    """The poses (*,) of the body where the joints are (*, 7); angles within half a turn."""
    e, h = complex_of(linkage.body_joint), complex_of(linkage.link_joint)
    turn = (joints[..., 6] - joints[..., 4]) / (h - e)
    turn = turn / np.abs(turn)
    origin = joints[..., 4] - turn * e
    return Displacement(np.stack([origin.real, origin.imag], axis=-1), np.angle(turn))


def drive_of(joints: ComplexArray, driver: Drive) -> FloatArray:
    """The angle (*,) of the driver where the joints are (*, 7), in F, within half a turn."""
    pivot, end = (0, 2) if driver == "first" else (1, 3)
    return np.asarray(np.angle(joints[..., end] - joints[..., pivot]))


def sides_of(joints: ComplexArray, driver: Drive) -> Sides:
    """On which side the loops are closed where the joints are (*, 7)."""
    a, b, c, d, e, g, h = np.moveaxis(joints, -1, 0)
    if driver == "first":
        first = ((d - c) * (b - c).conj()).imag
    else:
        first = ((c - d) * (a - d).conj()).imag
    return Sides(np.sign(first), np.sign(((h - g) * (e - g).conj()).imag))


def transmission(joints: ComplexArray, driver: Drive) -> FloatArray:
    """The lesser of both loops' transmission angles where the joints are (*, 7), in radians.

    The first loop's is between the coupler and the crank that does not drive; the second's, at H,
    between the floating link and the body.
    """
    a, b, c, d, e, g, h = np.moveaxis(joints, -1, 0)
    first = _acute(c - d, b - d) if driver == "first" else _acute(d - c, a - c)
    return np.minimum(first, _acute(g - h, e - h))


def _acute(one: ComplexArray, other: ComplexArray) -> FloatArray:
    """The angle (*,) between two lines, from zero to a quarter turn."""
    product = one * other.conj()
    return np.asarray(np.arctan2(np.abs(product.imag), np.abs(product.real)))
