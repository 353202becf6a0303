"""Linkages as built, by brute force: driven crank angle by crank angle, circuit by circuit."""

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles.witness import places

SWEEP = 1440  # crank angles
ZOOMS, SAMPLES = 5, 9  # closer looks at the nearest crank angle, and samples of each


def numbers(dyad):
    """The five dimensions or fewer of a dyad, in the order of its fields."""
    return np.concatenate([np.ravel(getattr(dyad, name)) for name in type(dyad).__slots__])


def of_numbers(kind, z):
    if kind is RR:
        return RR(z[:2], z[2:4], z[4])
    return PR(z[0], z[1], z[2:]) if kind is PR else RP(z[:2], z[2], z[3])


def built(dyads, offs, tolerance):
    """A crank and another link, RR both, each number off by so many tolerances."""
    z = np.concatenate([numbers(each) for each in dyads]) + tolerance * np.asarray(offs)
    return [of_numbers(RR, z[:5]), of_numbers(RR, z[5:])]


def greatest_error(dyads, poses, length):
    """The greatest position error at poses, rows (N, 3), on the better circuit; inf without one.

    At the place nearest to each pose by the squares of distances and of length times angles.
    """
    sweep = np.linspace(-np.pi, np.pi, SWEEP, endpoint=False)
    _, phi = places(*dyads, sweep)
    there = np.isfinite(phi[0])
    if not there.any():
        return np.inf
    errors = []
    for sides, index in circuits(there):
        found = [nearest(dyads, poses, length, sweep[index], side) for side in sides]
        gaps, positions = (np.array([each[k] for each in found]) for k in (0, 1))
        best = gaps.argmin(axis=0)
        errors.append(positions[best, np.arange(len(poses))].max())
    return min(errors)


def circuits(there):
    """The sides and the crank angles of each circuit, from where the linkage closes (n,)."""
    if there.all():
        return [((side,), np.arange(len(there))) for side in (0, 1)]
    first = int(np.argmin(there))
    order = np.roll(np.arange(len(there)), -first)  # begins where the linkage is open
    edges = np.flatnonzero(np.diff(np.r_[False, there[order], False].astype(int)))
    return [((0, 1), order[a:b]) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def nearest(dyads, poses, length, drive, side):
    """The least combined gaps (N,), and the position errors there, along crank angles (n,)."""
    step = 2 * np.pi / SWEEP
    at = drive[None]  # the same for all poses, at first
    for _ in range(ZOOMS):
        where, phi = places(*dyads, at.ravel())
        w, p = where[side].reshape(at.shape), phi[side].reshape(at.shape)
        off = abs(w - (poses[:, :1] + 1j * poses[:, 1:2]))
        turn = np.angle(np.exp(1j * (p - poses[:, 2:])))
        gap = np.nan_to_num(np.hypot(off, length * turn), nan=np.inf)
        k = (np.arange(len(poses)), gap.argmin(axis=1))
        best = gap[k], np.where(np.isfinite(gap[k]), off[k], np.inf)
        at = np.broadcast_to(at, gap.shape)[k][:, None] + step * np.linspace(-1, 1, SAMPLES)
        step *= 2.5 / SAMPLES
    return best
