"""Where a six-bar of Watt's first kind can be, by brute force over the angle of a crank.

Every angle of a fine grid is tried, and at each every way to close both loops, by the law of
cosines.  A branch is a run of angles at which one way to close them goes on.  Nothing is known here
of dead points, of minima or of circuits.
"""

from typing import NamedTuple

import numpy as np

STEPS = 12_000  # over one turn of the crank


class Run(NamedTuple):
    """A branch: the crank that drives, its angles (m,), the body's origin and direction there."""

    driver: str
    angles: np.ndarray
    origin: np.ndarray
    turn: np.ndarray
    full: bool


def _c(pair):
    return complex(*np.asarray(pair, dtype=float))


def _third(p, q, to_p, to_q, side):
    """The corner of triangles over p q with sides to_p and to_q, on one side of p q."""
    way = q - p
    far = np.abs(way)
    with np.errstate(invalid="ignore"):
        angle = np.arccos((to_p**2 + far**2 - to_q**2) / (2 * to_p * far))
    return p + to_p * np.exp(1j * (np.angle(way) + side * angle))


def places(linkage, driver, angles, sides):
    """Origin and direction (unit complex numbers) of the body at angles of a crank; nan if open."""
    a, b = _c(linkage.fixed_first), _c(linkage.fixed_second)
    at_d, at_g = _c(linkage.coupler_joint), _c(linkage.crank_joint)
    ac, bd = float(linkage.first_crank), float(linkage.second_crank)
    if driver == "first":
        c = a + ac * np.exp(1j * angles)
        d = _third(b, c, bd, abs(at_d), sides[0])
    else:
        d = b + bd * np.exp(1j * angles)
        c = _third(a, d, ac, abs(at_d), sides[0])
    e = c + np.exp(1j * (np.angle(d - c) - np.angle(at_d))) * float(linkage.coupler_arm)
    g = b + np.exp(1j * np.angle(d - b)) * at_g
    e0, h0 = _c(linkage.body_joint), _c(linkage.link_joint)
    h = _third(e, g, abs(h0 - e0), float(linkage.floating_link), sides[1])
    turn = np.exp(1j * (np.angle(h - e) - np.angle(h0 - e0)))
    return e - turn * e0, turn


def runs(linkage, steps=STEPS):
    """All branches of both drivers, with their places."""
    out = []
    grid = 2 * np.pi * np.arange(steps) / steps
    for driver in ("first", "second"):
        for sides in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            origin, turn = places(linkage, driver, grid, sides)
            closed = np.isfinite(origin)
            if closed.all():
                out.append(Run(driver, grid, origin, turn, True))
                continue
            start = int(np.argmin(closed))  # an angle at which it is open
            order = (start + np.arange(steps)) % steps
            part = np.split(order, np.flatnonzero(np.diff(closed[order].astype(int))) + 1)
            for index in part:
                if closed[index[0]]:
                    out.append(Run(driver, grid[index], origin[index], turn[index], False))
    return out


def nearest(run, poses, length):
    """The least errors (N,) at poses (N, 3) on a branch, radians as `length`, and their indices."""
    gap = np.abs(run.origin[:, None] - poses[:, :2] @ [1, 1j])
    angle = np.angle(run.turn[:, None] * np.exp(-1j * poses[:, 2]))
    error = np.hypot(gap, length * angle)
    index = error.argmin(axis=0)
    return error[index, np.arange(len(poses))], index, gap[index, np.arange(len(poses))]


def in_order(run, index):
    """Whether places are met in their order, up or down, within one turn."""
    steps = np.diff(index)
    if not run.full:
        return bool((steps > 0).all() or (steps < 0).all())
    total = len(run.angles)
    return any(((way * steps) % total).sum() < total for way in (1, -1))
