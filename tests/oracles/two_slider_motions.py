"""Two-slider motions, planted, and what pairs of their sliders can transmit, by brute force.

In complex numbers, without the package: the centre of a circle of M runs backwards on an equal
circle of F as M turns.  Each point of that circle of M then stays on a diameter of F.
"""

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles.witness import places, random_four_bar

DRIVES, FEWEST_DRIVES = 2001, 50  # around a drive; between the first and the last pose


def elsewhere(rng, d, phi, spread=3.0):
    """The same motion in random frames of F and M, as rows x, y, angle."""
    origin, turn, body, tilt = (
        complex(*rng.normal(0, spread, 2)),
        rng.uniform(-3, 3),
        complex(*rng.normal(0, spread, 2)),
        rng.uniform(-3, 3),
    )
    z = origin + np.exp(1j * turn) * d
    z = z + np.exp(1j * (phi + turn)) * body
    return np.column_stack([z.real, z.imag, phi + turn + tilt])


def angles_over(rng, count, turn):
    """So many angles from 0 to `turn`, both among them, in order."""
    return np.sort(np.append(rng.uniform(0, turn, count - 2), [0.0, turn]))


def planted(rng, count, turn, inverted):
    """Rows of a two-slider motion over `turn` radians, its circle's radius 0.5 to 3."""
    phi = angles_over(rng, count, turn) + rng.uniform(-np.pi, np.pi)
    d = rng.uniform(0.5, 3.0) * np.exp(1j * (rng.uniform(-np.pi, np.pi) - phi))
    return elsewhere(rng, -d * np.exp(-1j * phi), -phi) if inverted else elsewhere(rng, d, phi)


def general(rng, count, turn):
    """Rows of a random four-bar whose coupler turns by `turn` radians between two drives."""
    while True:
        dyads = random_four_bar(rng, [RR, RR, PR, RP][rng.integers(4)])
        drive = rng.uniform(-3, 3) + np.linspace(0, 2 * np.pi, DRIVES)
        z, phi = (each[rng.integers(2)] for each in places(*dyads, drive))
        whole = np.isfinite(z)
        end = len(z) if whole.all() else int(whole.argmin())
        if end < FEWEST_DRIVES:
            continue
        phi = np.unwrap(phi[:end])
        covered = np.maximum.accumulate(phi) - np.minimum.accumulate(phi)
        last = int(np.searchsorted(covered, turn))
        if FEWEST_DRIVES < last < end:
            between = rng.choice(np.arange(1, last), count - 2, replace=False)
            at = np.sort(np.append(between, [0, last]))
            return elsewhere(rng, z[at], phi[at])


def printed(rows, decimals):
    """Rows to so many decimals, and half a unit of the last one for lengths and radians."""
    return rows.round(decimals), (0.5 * 10.0**-decimals,) * 2


def best_pair(turn, steps=48, samples=241):
    """The best least transmission angle (radians) of two points of a Cardan circle on their lines.

    Over all pairs of points at `steps` places and `samples` angles over `turn`.  A driver that
    comes to rest, or turns back, between these angles is at a dead point: such a pair counts 0.
    """
    phi = np.linspace(-turn / 2, turn / 2, samples)
    place = np.exp(2j * np.pi * np.arange(steps) / steps)
    at = np.exp(-1j * phi) + place[:, None] * np.exp(1j * phi)  # the points in F, (steps, samples)
    line = np.exp(0.5j * np.angle(place))[:, None]  # the direction of each line
    along = (at * line.conj()).real
    moves = np.diff(along, axis=1)
    sound = (moves > 0).all(axis=1) | (moves < 0).all(axis=1)
    best = 0.0
    for driver in np.flatnonzero(sound):
        for follower in range(steps):
            if follower != driver:
                bar = at[follower] - at[driver]
                square = bar * (1j * line[follower]).conj()  # against the normal of its line
                angle = np.arctan2(np.abs(square.imag), np.abs(square.real)).min()
                best = max(best, float(angle))
    return best
