"""Paths to trace, and how near a linkage comes to them, by the witness's own kinematics."""

import numpy as np
from scipy.optimize import least_squares

from burmester.fourbar.dyad import RR
from tests.oracles.least import least
from tests.oracles.witness import places

# Eighteen points of J. A. Cabrera, A. Simon and M. Prado, Optimal synthesis of mechanisms with
# genetic algorithms, Mechanism and Machine Theory 37, 2002; the crank turns by 20 degrees from
# point to point.
CABRERA = np.array(
    [
        (0.5, 1.1), (0.4, 1.1), (0.3, 1.1), (0.2, 1.0), (0.1, 0.9), (0.05, 0.75),
        (0.02, 0.6), (0.0, 0.5), (0.0, 0.4), (0.03, 0.3), (0.1, 0.25), (0.15, 0.2),
        (0.2, 0.3), (0.3, 0.4), (0.4, 0.5), (0.5, 0.7), (0.6, 0.9), (0.6, 1.0),
    ]
)  # fmt: skip
CABRERA_TURNS = np.radians(20.0 * np.arange(18))


def dyads_of(z):
    """Crank and follower of nine numbers: pivots, lengths, and the coupler point, at M's origin."""
    g1x, g1y, g2x, g2y, a, b, r, cx, cy = z
    return RR([g1x, g1y], [-cx, -cy], a), RR([g2x, g2y], [b - cx, -cy], r)


def traced(dyads, side, t):
    """Points (n,) of the coupler curve at crank angles, as complex numbers."""
    return places(*dyads, np.asarray(t))[0][side]


def random_crank(rng):
    """Nine numbers of a linkage whose crank turns fully, by trying it; and an assembly."""
    while True:
        g, a, b, r = rng.uniform(0.2, 1.0, 4)
        c = rng.normal(size=2) * b + [b / 2, 0]
        z = np.array([0, 0, g, 0, a, b, r, *c])
        where = places(*dyads_of(z), np.linspace(0, 2 * np.pi, 361))[0]
        if np.isfinite(where[0]).all() and min(g, a) < 0.8 * min(b, r):
            return z, int(rng.integers(2))


def distances(dyads, points):
    """The distances (n,) of points from the curve that a crank going round traces, either side."""
    t = np.linspace(0, 2 * np.pi, 1441)
    both, p = places(*dyads, t)[0], points[:, 0] + 1j * points[:, 1]
    best = np.full(len(p), np.inf)
    for side in (0, 1):

        def gap(u, side=side):
            return np.nan_to_num(abs(traced(dyads, side, u) - p), nan=1e9)

        away = np.array([np.nan_to_num(abs(both[side] - each), nan=1e9) for each in p])
        near = t[away.argmin(axis=1)]
        _, fine = least(gap, near - 0.006, near + 0.006)
        best = np.min([best, away.min(axis=1), fine], axis=0)
    return best


def refined_from(z, side, t, points):
    """The least sum of squared distances that SciPy reaches from a linkage and crank angles."""
    wanted = points[:, 0] + 1j * points[:, 1]

    def residual(x):
        gap = np.nan_to_num(traced(dyads_of(x[:9]), side, x[9:]) - wanted, nan=1e3)
        return np.concatenate([gap.real, gap.imag])

    return 2 * least_squares(residual, np.concatenate([z, t]), max_nfev=60).cost
