"""Where a six-bar is while a crank drives it: two loops of four links, each in closed form.

A joint that two links hold is where two circles meet, on one side of the line between their centres
or on the other.  The two sides, +1 or -1, say on which branch of the drive a linkage is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np

from burmester.mechanisms.circles import acute_angle, meeting, side_of
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of

if TYPE_CHECKING:
    from burmester.sixbar.watt import WattLinkage

__all__ = ["Drive", "Sides", "drive_of", "joints_at", "sides_of", "transmission"]

Drive: TypeAlias = Literal["first", "second"]


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


def joints_at(
    linkage: WattLinkage, drive: FloatArray, sides: Sides, driver: Drive, *, closed: bool = False
) -> ComplexArray:
    """The joints (*, 7) of linkages (*,) whose driver stands at an angle (*,), in radians, in F.

    In the order of `JOINTS`; nan where a loop cannot be closed.
    closed: whether all are known to close, but for rounding.
    """
    a, b = complex_of(linkage.fixed_first), complex_of(linkage.fixed_second)
    at_d, at_g = complex_of(linkage.coupler_joint), complex_of(linkage.crank_joint)
    if driver == "first":
        c = a + linkage.first_crank * np.exp(1j * drive)
        d = meeting(c, np.abs(at_d), b, linkage.second_crank, sides.first, closed=closed)
    else:
        d = b + linkage.second_crank * np.exp(1j * drive)
        c = meeting(d, np.abs(at_d), a, linkage.first_crank, sides.first, closed=closed)
    e = c + (d - c) / at_d * linkage.coupler_arm
    g = b + (d - b) / linkage.second_crank * at_g
    body = np.abs(complex_of(linkage.link_joint) - complex_of(linkage.body_joint))
    h = meeting(g, linkage.floating_link, e, body, sides.second, closed=closed)
    return np.stack(np.broadcast_arrays(a, b, c, d, e, g, h), axis=-1)


def drive_of(joints: ComplexArray, driver: Drive) -> FloatArray:
    """The angle (*,) of the driver where the joints are (*, 7), in F, within half a turn."""
    pivot, end = (0, 2) if driver == "first" else (1, 3)
    return np.asarray(np.angle(joints[..., end] - joints[..., pivot]))


def sides_of(joints: ComplexArray, driver: Drive) -> Sides:
    """On which side the loops are closed where the joints are (*, 7)."""
    a, b, c, d, e, g, h = np.moveaxis(joints, -1, 0)
    first = side_of(d, c, b) if driver == "first" else side_of(c, d, a)
    return Sides(first, side_of(h, g, e))


def transmission(joints: ComplexArray, driver: Drive) -> FloatArray:
    """The lesser of both loops' transmission angles where the joints are (*, 7), in radians.

    The first loop's is between the coupler and the crank that does not drive; the second's, at H,
    between the floating link and the body.
    """
    a, b, c, d, e, g, h = np.moveaxis(joints, -1, 0)
    first = acute_angle(c - d, b - d) if driver == "first" else acute_angle(d - c, a - c)
    return np.minimum(first, acute_angle(g - h, e - h))
