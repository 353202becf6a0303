"""Stephenson's chain by brute force: real assemblies counted by grids, dead points by scans.

Nothing here knows an instant centre, a polynomial or a circuit: bars are lengths, loops are closed
by the law of cosines, and what is held is looked for along the angle of a link.
"""

from typing import NamedTuple

import numpy as np

NAMES = "ABCDEFG"


class Dimensions(NamedTuple):
    """A at (0, 0), B at (b, 0), F; AC, CE, D as C and E see it, BD, EG, FG."""

    b: float
    f: complex
    ac: float
    ce: float
    d: complex
    bd: float
    eg: float
    fg: float


def drawn(random):
    """Random dimensions of like sizes."""

    def length():
        return float(random.uniform(0.3, 2.0))

    def point():
        return complex(*random.normal(0, 1, 2))

    return Dimensions(1.0, point(), length(), length(), point(), length(), length(), length())


def corner(p, to_p, q, to_q, side):
    """The corner of triangles over p q, to the left of it (side 1) or right (-1); nan if none."""
    far = np.abs(q - p)
    with np.errstate(invalid="ignore", divide="ignore"):
        angle = np.arccos((to_p**2 + far**2 - to_q**2) / (2 * to_p * far))
    return p + to_p * np.exp(1j * (np.angle(q - p) + side * angle))


def held_at_f(own, drive, steps=20_000):
    """All real assemblies while FG stands at an angle: (m, 7) joints A to G.

    E turns about G; D and C close the rest, each on two sides; what is left is one equation in the
    angle of E, and its roots are changes of sign, made sharp by bisection.
    """
    g = own.f + own.fg * np.exp(1j * drive)
    even = 2 * np.pi * np.arange(steps + 1) / steps
    found = []
    for side in (1, -1):
        angle = even
        open_ = np.isnan(_gap(own, g, angle, side)[0])
        for k in np.flatnonzero(open_[:-1] != open_[1:]):  # and where the loop of E and C opens
            closed, other = (even[k + 1], even[k]) if open_[k] else (even[k], even[k + 1])
            for _ in range(60):
                middle = (closed + other) / 2
                there = np.isnan(_gap(own, g, np.array([middle]), side)[0][0])
                closed, other = (closed, middle) if there else (middle, other)
            angle = np.sort(np.append(angle, closed))
        gap, _ = _gap(own, g, angle, side)
        change = np.flatnonzero(gap[:-1] * gap[1:] < 0)
        for k in change:
            if abs(gap[k] - gap[k + 1]) > 0.5:  # a jump beside an open loop
                continue
            low, high = angle[k], angle[k + 1]
            for _ in range(60):
                middle = (low + high) / 2
                there, _ = _gap(own, g, np.array([middle]), side)
                low, high = (low, middle) if there[0] * gap[k] < 0 else (middle, high)
            value, joints = _gap(own, g, np.array([low]), side)
            if abs(value[0]) < 1e-6:
                found.append(joints[0])
    return np.array(found).reshape(-1, 7)


def _gap(own, g, angle, side):
    """The length of BD less what it should be, with E at angles about G, C on one side of AE."""
    e = g + own.eg * np.exp(1j * angle)
    c = corner(0j * e, own.ac, e, own.ce, side)
    d = c + (e - c) / own.ce * own.d
    rest = np.broadcast_arrays(0j * e, own.b + 0j * e, c, d, e, own.f + 0j * e, g + 0j * e)
    return np.abs(d - own.b) - own.bd, np.stack(rest, axis=-1)


def bars_off(own, joints):
    """How far bars of joints (*, 7) are off, at most: (*,)."""
    a, b, c, d, e, f, g = np.moveaxis(joints, -1, 0)
    offs = [
        np.abs(a - b) - own.b,
        np.abs(f - a) - abs(own.f),
        np.abs(f - b) - abs(own.f - own.b),
        np.abs(c - a) - own.ac,
        np.abs(d - b) - own.bd,
        np.abs(e - c) - own.ce,
        np.abs(d - c) - abs(own.d),
        np.abs(e - d) - abs(own.ce - own.d),
        np.abs(g - e) - own.eg,
        np.abs(g - f) - own.fg,
    ]
    return np.abs(offs).max(axis=0)
