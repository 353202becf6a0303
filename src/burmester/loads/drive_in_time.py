"""How a driver goes from the first pose to the last in time."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import Drive

HALVINGS: Final = 52
SLACK: Final = 1e-9  # of the way: beyond its ends rounding is no way


class Course(NamedTuple):
    """At times (n,) in s: the share of the way, from 0 to 1, and its first two derivatives."""

    time: FloatArray
    share: FloatArray
    speed: FloatArray
    acceleration: FloatArray


def course_of(drive: Drive, count: int) -> Course:
    """So many times, evenly from beginning to end."""
    return _at(drive, np.linspace(0.0, 1.0, count))


def course_through(drive: Drive, shares: FloatArray) -> Course:
    """The times at which the driver is at shares (n,) of its way; nan beyond both ends."""
    below, above = np.zeros(shares.shape), np.ones(shares.shape)
    for _ in range(HALVINGS):
        middle = (below + above) / 2
        short = _at(drive, middle).share < shares
        below, above = np.where(short, middle, below), np.where(short, above, middle)
    t = np.where(shares <= 0, 0.0, np.where(shares >= 1, 1.0, (below + above) / 2))
    beyond = (shares < -SLACK) | (shares > 1 + SLACK)
    return _at(drive, np.where(beyond, np.nan, t))


def _at(drive: Drive, t: FloatArray) -> Course:
    """At parts t (n,) of the whole time.

    The polynomial 3-4-5 is 10 t³ - 15 t⁴ + 6 t⁵: at rest at both ends, without a jerk that is
    infinite.  A trapezoid accelerates for a third of the time and slows down for another.
    """
    if drive.profile == "constant":
        share, speed, push = t, 0 * t + 1, 0 * t
    elif drive.profile == "3-4-5":
        share = t**3 * (10 + t * (6 * t - 15))
        speed, push = 30 * t**2 * (1 - t) ** 2, 60 * t * (1 - t) * (1 - 2 * t)
    else:
        most = 1.5  # the speed between both thirds
        speed = most * np.minimum(np.minimum(3 * t, 1.0), 3 * (1 - t))
        # At the ends of these thirds itself, too: there is most to bear.
        push = 3 * most * ((t < 1 / 3 + SLACK).astype(float) - (t > 2 / 3 - SLACK))
        share = np.where(t < 1 / 3, 1.5 * most * t**2, most * (t - 1 / 6))
        share = np.where(t > 2 / 3, 1 - 1.5 * most * (1 - t) ** 2, share)
    whole = drive.duration_s
    return Course(whole * t, share, speed / whole, push / whole**2)
