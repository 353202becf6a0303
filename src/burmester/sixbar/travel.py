"""The way of a six-bar through its poses: whether on one branch and in order, and over what range.

A branch is a piece of the drive between two dead points (`dead_points`), or a whole turn where
there is none.  Poses on one such piece are reached without taking apart and without locking, which
is exact: every dead point is known in closed form.
"""

from __future__ import annotations

from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.mechanisms.contract import drive_of
from burmester.mechanisms.four_bar_loop import FourBarLoop
from burmester.mechanisms.pose_order import PoseOrder, along_interval, around_circuit, smallest_arc
from burmester.mechanisms.transmission import least_transmission_angle
from burmester.numerics.arrays import TURN, ComplexArray, FloatArray, take, where
from burmester.sixbar.watt import (
    WATT_I,
    Sides,
    WattLinkage,
    dead_points,
    joints_at,
    sides_of,
    turning_points,
)

CLOSE = 1e-9  # radians; a pose as near to a dead point is at it


@final
class Travel(NamedTuple):
    """How linkages (n,) go through their poses with one driver.

    one_branch: (n,), whether all poses are on one branch; in_order: (n,), whether the drive meets
    them in their order, forwards or back.
    drive: (n, N), the drive at the poses, without jumps; nan where not on one branch.  Where the
    poses are in order it goes one way only.
    room: (n, 2), how far the driver goes on below and above the range of the poses before it
    locks; infinite where it turns fully.
    """

    one_branch: NDArray[np.bool_]
    in_order: NDArray[np.bool_]
    drive: FloatArray
    room: FloatArray

    @property
    def works(self) -> NDArray[np.bool_]:
        """Whether linkages go through their poses on one branch and in order: (n,)."""
        return self.one_branch & self.in_order

    @property
    def turns_fully(self) -> NDArray[np.bool_]:
        """Whether their drivers do, and nothing locks: (n,)."""
        return np.asarray(np.isinf(self.room).all(axis=-1))


def travel(
    linkage: WattLinkage, joints: ComplexArray, driver: str, *, any_order: bool = False
) -> Travel:
    """How linkages (n,) go through poses at which their joints are (n, N, 7).

    any_order: whether every order counts as that of the poses.
    """
    at_poses = sides_of(joints, driver)
    sides = Sides(at_poses.first[:, 0], at_poses.second[:, 0])
    same = (at_poses.first == sides.first[:, None]).all(axis=-1)
    same &= (at_poses.second == sides.second[:, None]).all(axis=-1)
    same &= (sides.first != 0) & (sides.second != 0)
    dead = dead_points(linkage, sides, driver)
    return along(drive_of(WATT_I, joints, driver), dead, same, any_order=any_order)


def first_loop_works(
    joints: ComplexArray, driver: str, *, any_order: bool = False
) -> NDArray[np.bool_]:
    """Whether first loops go through poses at which joints A to E are (n, N, 5), as `travel`."""
    whole = np.concatenate([joints, joints[..., :2]], axis=-1)  # the second loop is not asked
    at_poses = sides_of(whole, driver)
    first = at_poses.first[:, 0]
    same = (at_poses.first == first[:, None]).all(axis=-1) & (first != 0)
    a, b, c, d = joints[:, 0, :4].T
    loop = FourBarLoop.of(a, b, abs(c - a), abs(d - c), abs(d - b))
    locked = loop.locked(first=driver == "A")
    return along(drive_of(WATT_I, whole, driver), locked, same, any_order=any_order).works


def least_transmission(
    linkage: WattLinkage, drive: FloatArray, driver: str, joints: ComplexArray
) -> FloatArray:
    """The least transmission angle of both loops over the range of the poses: (n,), radians.

    Exact: inside the range it is least where a diagonal of a loop turns back, and all these places
    are known in closed form.  drive: (n, N), joints: (n, N, 7), at the poses.
    """
    low, high = drive.min(axis=-1)[:, None], drive.max(axis=-1)[:, None]
    sides = Sides(*(each[:, 0] for each in sides_of(joints, driver)))
    turning = turning_points(linkage, sides, driver)
    with np.errstate(invalid="ignore"):
        turning = low + np.mod(turning - low, TURN)
        inside = turning < high
    turning = np.where(inside, turning, low)
    there = joints_at(linkage[:, None], turning, take(sides, (slice(None), None)), driver)
    least, at_poses = (least_transmission_angle(WATT_I, each, driver) for each in (there, joints))
    return np.asarray(np.minimum(np.fmin.reduce(least, axis=-1), at_poses.min(axis=-1)))


def along(
    drive: FloatArray, dead: FloatArray, same: NDArray[np.bool_], *, any_order: bool = False
) -> Travel:
    """The way through poses at drives (n, N) on branches whose dead points are (n, k).

    same: (n,), whether the loops are closed on the same sides at all poses.
    """
    start = drive[:, :1]
    with np.errstate(invalid="ignore"):
        ahead, behind = np.mod(dead - start, TURN), np.mod(start - dead, TURN)
    full = np.asarray(np.isnan(dead).all(axis=-1))
    up = np.fmin.reduce(ahead, axis=-1, initial=TURN)
    down = np.fmin.reduce(behind, axis=-1, initial=TURN)
    # Between two dead points: every pose as far from the first one as it is, up or down.
    forward = np.mod(drive - start, TURN)
    offset = np.where(forward < up[:, None], forward, forward - TURN)
    held = (offset > CLOSE - down[:, None]) & (offset < up[:, None] - CLOSE)
    room = np.stack([down + offset.min(axis=-1), up - offset.max(axis=-1)], axis=-1)
    one, none = same & (full | held.all(axis=-1)), np.zeros(len(drive))
    order = where(full, around_circuit(drive, none), along_interval(start + offset, none + 1, none))
    if any_order:
        shortest = np.where(full[:, None], smallest_arc(drive), order.along)
        order = PoseOrder(shortest, none, none)
    return Travel(
        one,
        ~order.is_another,
        np.where(one[:, None], order.along, np.nan),
        np.where(full[:, None], np.inf, room),
    )
