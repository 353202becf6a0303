"""How a driver goes from the first pose to the last in time.

Through a table of times goes a cubic spline that is at rest at both ends.  Where it would turn back
or swing beyond the table, its slopes are limited as Fritsch and Carlson do, and each piece is the
polynomial of degree five with the slopes and curvatures of its ends.  So the acceleration has no
jumps, and the driver stands still where the table does.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple, Self

import numpy as np

from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import Drive
from burmester.verdicts.motion import Way

HALVINGS: Final = 52
SLACK: Final = 1e-9  # of the way: beyond its ends rounding is no way
LOOKS: Final = 129  # at the speed between two rows of a table, closest at the rows
STEEPEST: Final = 2.0  # of the slope to the next row: a piece without curvature is monotone then
ENDS: Final = np.array([0.0, 1.0])


class Course(NamedTuple):
    """At times (n,) in s: the share of the way, from 0 to 1, and its first two derivatives."""

    time: FloatArray
    share: FloatArray
    speed: FloatArray
    acceleration: FloatArray


class Timing(NamedTuple):
    """A drive of a linkage: between parts (k,) of its time it goes from share (k,) to share.

    pieces: (k - 1, 6), of a table, ascending coefficients over the part of each piece.
    missed: why a linkage cannot follow, in words that follow "it"; None where it can.
    """

    drive: Drive
    parts: FloatArray = ENDS
    shares: FloatArray = ENDS
    pieces: FloatArray | None = None
    missed: str | None = None

    @classmethod
    def of(cls, drive: Drive, way: Way, names: tuple[str, ...] | None) -> Self:
        """Of a linkage that moves so, whose task has poses of these names."""
        if not drive.times:
            return cls(drive)
        met = way(np.zeros(1)).pose_shares
        motion = way(np.concatenate([ENDS, np.nan_to_num(met)]))
        first, last, *there = motion.drive.tolist()
        count, turned = len(there), math.degrees(abs(last - first))
        known = {str(k + 1): k for k in range(count)}
        known |= {name: k for k, name in enumerate(names or ()) if name}
        shares = []
        for _, place in drive.times:
            if not isinstance(place, str):
                if not motion.in_turns:
                    return cls(drive, missed="slides, and the table of times states degrees")
                share = place / turned
                missed = f"turns its driver by {turned:.4g}°, and the table of times has {place:g}°"
            elif place not in known:
                return cls(drive, missed=f"has no pose {place!r}, and the table of times does")
            else:
                k = known[place]
                share = (there[k] - first) / (last - first) if np.isfinite(met[k]) else math.nan
                missed = f"does not reach pose {place!r} of the table of times"
            if not -SLACK <= share <= 1 + SLACK:
                return cls(drive, missed=missed)
            shares.append(min(1.0, max(0.0, share)))
        parts = np.array([time for time, _ in drive.times]) / drive.duration_s
        return cls(drive, parts, np.array(shares), _pieces(parts, np.array(shares)))


def course_of(timing: Timing, count: int) -> Course:
    """So many times, evenly from beginning to end."""
    return course_at(timing, np.linspace(0.0, 1.0, count))


def course_through(timing: Timing, shares: FloatArray) -> Course:
    """The first times at which the driver is at shares (n,) of its way; nan where it never is."""
    first, last = timing.shares[:-1], timing.shares[1:]
    low, high = np.minimum(first, last) - SLACK, np.maximum(first, last) + SLACK
    within = (shares[:, None] >= low) & (shares[:, None] <= high)
    k = within.argmax(axis=1)
    below, above = timing.parts[k], timing.parts[k + 1]
    wanted = np.clip(shares, low[k] + SLACK, high[k] - SLACK)
    rises = np.where(last[k] >= first[k], 1.0, -1.0)
    for _ in range(HALVINGS):
        middle = (below + above) / 2
        short = rises * (course_at(timing, middle).share - wanted) < 0
        below, above = np.where(short, middle, below), np.where(short, above, middle)
    t = np.where(wanted == first[k], timing.parts[k], (below + above) / 2)
    t = np.where((wanted == last[k]) & (wanted != first[k]), timing.parts[k + 1], t)
    return course_at(timing, np.where(within.any(axis=1), t, np.nan))


def course_at(timing: Timing, t: FloatArray) -> Course:
    """At parts t (n,) of the whole time.

    The polynomial 3-4-5 is 10 t³ - 15 t⁴ + 6 t⁵: at rest at both ends, without a jerk that is
    infinite.  A trapezoid accelerates for a third of the time and slows down for another.
    """
    drive = timing.drive
    if timing.pieces is not None:
        k = np.clip(np.searchsorted(timing.parts, t, side="right") - 1, 0, len(timing.pieces) - 1)
        wide = np.diff(timing.parts)[k]
        values = _piecewise(timing.pieces[k], (t - timing.parts[k]) / wide)
        share, speed, push = values[0], values[1] / wide, values[2] / wide**2
    elif drive.profile == "constant":
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


def _piecewise(pieces: FloatArray, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Polynomials (*, 6) and their first two derivatives at u (*)."""
    n = np.arange(6)
    powers = u[..., None] ** n
    return (
        (pieces * powers).sum(axis=-1),
        (pieces[..., 1:] * n[1:] * powers[..., :-1]).sum(axis=-1),
        (pieces[..., 2:] * (n[2:] * n[1:-1]) * powers[..., :-2]).sum(axis=-1),
    )


def _pieces(t: FloatArray, p: FloatArray) -> FloatArray:
    """The polynomials (k - 1, 6) through values p (k,) at t (k,): monotone where these are."""
    h, rise = np.diff(t), np.diff(p)
    slope = rise / h
    matrix = np.eye(len(t))
    for k in range(1, len(t) - 1):
        matrix[k, k - 1 : k + 2] = 1 / h[k - 1], 2 / h[k - 1] + 2 / h[k], 1 / h[k]
    right = np.zeros(len(t))
    right[1:-1] = 3 * (slope[:-1] / h[:-1] + slope[1:] / h[1:])
    spline = np.linalg.solve(matrix, right)
    bent = np.zeros(len(t))
    bent[:-1] = (6 * slope - 4 * spline[:-1] - 2 * spline[1:]) / h
    bent[[0, -1]] = 0.0  # at rest at both ends
    one_way = np.zeros(len(t))
    one_way[1:-1] = np.where(slope[:-1] * slope[1:] > 0, np.sign(slope[1:]), 0.0)
    steep = np.zeros(len(t))
    steep[1:-1] = STEEPEST * np.minimum(np.abs(slope[:-1]), np.abs(slope[1:]))
    limited = one_way * np.clip(one_way * spline, 0.0, steep)
    way = np.sign(rise)
    u, level = np.linspace(0.0, 1.0, LOOKS), np.zeros(len(t), dtype=int)
    u = u * u * (3 - 2 * u)
    while True:
        d, s = np.where(level, limited, spline), np.where(level > 1, 0.0, bent)
        out = _quintic(p, h, d, s)
        speed = _piecewise(out[:, None], np.broadcast_to(u, (len(h), LOOKS)))[1]
        back = np.where(rise == 0, np.abs(speed).T, -way * speed.T).max(axis=0)
        worse = np.zeros(len(t), dtype=bool)
        worse[:-1] |= back > SLACK
        worse[1:] |= back > SLACK
        if not (worse & (level < 2)).any():  # where both ends are limited a piece is monotone
            return out
        level = np.where(worse, np.minimum(level + 1, 2), level)


def _quintic(p: FloatArray, h: FloatArray, d: FloatArray, s: FloatArray) -> FloatArray:
    """Polynomials (k - 1, 6) over u from 0 to 1 with values, slopes and curvatures (k,) at ends."""
    rise, one, two = np.diff(p), h * d[:-1], h * d[1:]
    first, second = h**2 * s[:-1], h**2 * s[1:]
    rows = [
        p[:-1],
        one,
        first / 2,
        10 * rise - 6 * one - 4 * two - (3 * first - second) / 2,
        -15 * rise + 8 * one + 7 * two + (3 * first - 2 * second) / 2,
        6 * rise - 3 * (one + two) - (first - second) / 2,
    ]
    return np.stack(rows, axis=-1)
