"""Measured motions: many noisy poses of a linkage that is known, driven by code of its own."""

from __future__ import annotations

import numpy as np

from burmester.fourbar.dyad import RR
from tests.oracles.witness import places

# A crank-rocker, its pivots in F and M; and the crank's way, from its first pose to its last.
CRANK = RR(np.array([0.0, 0.0]), np.array([-0.6, -0.9]), np.array(1.0))
ROCKER = RR(np.array([4.0, 0.0]), np.array([2.6, -0.9]), np.array(3.0))
START, WAY = 0.4, 3.4

SORTS = "forth", "back", "to and fro", "with rests", "strays", "free"


def measured(count, sort="forth", noise=0.003, seed=1):
    """Rows (count, 3) of x, y and degrees; noise: of the span, and in radians.

    "to and fro": the crank comes back; "with rests": it stands still at both ends for a sixth of
    the time each; "strays": one pose in a hundred is far off; "free": no linkage leads there.
    """
    random, t = np.random.default_rng(seed), np.linspace(0, 1, count)
    share = {"back": 1 - t, "to and fro": np.sin(np.pi * t), "with rests": 1.5 * t - 0.25}
    if sort == "free":
        at = 3 * np.cos(2.1 * t) + 1j * np.sin(3.3 * t + 0.5) + 0.5 * t**3 + 0.7j * np.sin(7 * t)
        phi = 1.2 * np.sin(2.5 * t) + 0.3 * np.cos(6 * t)
    else:
        every, turns = places(CRANK, ROCKER, START + WAY * share.get(sort, t).clip(0, 1))
        at, phi = every[0], np.unwrap(turns[0])
    span = np.hypot(np.ptp(at.real), np.ptp(at.imag))
    at = at + noise * span * (random.normal(size=count) + 1j * random.normal(size=count))
    if sort == "strays":
        some = random.choice(count, max(1, count // 100), replace=False)
        at[some] += 0.2 * span * np.exp(2j * np.pi * random.uniform(size=len(some)))
    phi = phi + noise * random.normal(size=count)
    return np.column_stack([at.real, at.imag, np.degrees(phi)])


def as_csv(rows):
    """Rows as a file."""
    return "x,y,angle_deg\n" + "".join("{:.5f},{:.5f},{:.5f}\n".format(*row) for row in rows)
