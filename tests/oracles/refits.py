"""Linkages fitted to poses by SciPy, driven joint by joint: no Jacobian of ours.

The unknowns are the numbers of both dyads and the driver's position at each pose.
"""

import numpy as np
from scipy.optimize import least_squares

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles.witness import places, random_four_bar, random_poses

LENGTH, STEP = 0.7, 1e-5
USED = {RR: 5, PR: 4, RP: 4}


def dyads_of(kinds, z):
    """Two dyads from their numbers one after the other, those in use only."""
    found, at = [], 0
    for kind in kinds:
        v = z[at : at + USED[kind]]
        at += USED[kind]
        if kind is RR:
            found.append(RR(v[:2], v[2:4], v[4]))
        else:
            found.append(PR(v[0], v[1], v[2:4]) if kind is PR else RP(v[:2], v[2], v[3]))
    return found


def numbers_of(dyads):
    return np.concatenate(
        [np.concatenate([np.ravel(getattr(d, n)) for n in d.__slots__]) for d in dyads]
    )


def case(seed, second=RR, count=8):
    """Dyads, exact poses on one assembly away from dead points, the assembly, driver angles."""
    rng = np.random.default_rng(seed)
    while True:
        dyads = random_four_bar(rng, second)
        rows = random_poses(dyads, rng, count, side=0)
        d, turn = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
        pin = d + complex(*dyads[0].moving_pivot) * turn - complex(*dyads[0].fixed_pivot)
        drive = np.angle(pin)
        nudged = [places(*dyads, drive + off) for off in (-0.03, 0, 0.03)]
        if all(np.isfinite(where[0]).all() for where, _ in nudged):
            turns = [np.exp(1j * phi[0]) for _, phi in nudged]
            if max(np.abs(turns[2] - turns[1]).max(), np.abs(turns[1] - turns[0]).max()) < 0.1:
                return dyads, rows, drive


def refitted(dyads, rows, drive, weights=None, free=None, *, counts=1):
    """The numbers of the linkage that is fitted to poses, moving within `free` (m, n) only.

    counts: (N, 3), 0 for components of poses that count for nothing.
    """
    one, two, three = np.broadcast_to(counts, rows.shape).T
    kinds, z0 = [type(d) for d in dyads], numbers_of(dyads)
    free = np.eye(len(z0)) if free is None else free
    root = np.sqrt(np.ones(len(rows)) if weights is None else weights)

    def miss(y):
        first, second = dyads_of(kinds, z0 + free @ y[: free.shape[1]])
        where, phi = places(first, second, y[free.shape[1] :])
        gap = where[0] - rows[:, 0] - 1j * rows[:, 1]
        turned = np.angle(np.exp(1j * (phi[0] - rows[:, 2])))
        away = one * gap.real, two * gap.imag, three * LENGTH * turned
        return np.concatenate([root * each for each in away])

    start = np.concatenate([np.zeros(free.shape[1]), drive])
    end = least_squares(miss, start, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return z0 + free @ end.x[: free.shape[1]]


def slopes(dyads, rows, drive, weights=None, free=None, *, counts=1):
    """How the numbers of the fit move with each number of each pose: (n, N, 3)."""
    columns = []
    for at in np.ndindex(rows.shape):
        off = np.zeros_like(rows)
        off[at] = STEP
        ends = [
            refitted(dyads, rows + sign * off, drive, weights, free, counts=counts)
            for sign in (1, -1)
        ]
        columns.append((ends[0] - ends[1]) / (2 * STEP))
    return np.array(columns).T.reshape(-1, *rows.shape)
