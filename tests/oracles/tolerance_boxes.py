"""How much of a pose's tolerances a linkage uses at least, by driving it finely (`witness`)."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import minimize_scalar

from burmester.fourbar.dyad import RR
from tests.oracles.witness import places

SWEEP = 4001  # places of a crank
ALONG = 8001  # of a slider, more of them near its middle
CLOSE = 1e-6  # radians or lengths to either side of a minimum, looked through once more
NEAREST = 6  # samples around which the least share is looked for


def share(where, phi, pose, bounds, axes):
    """The greatest share of x, y and angle that places (x + iy, phi) use of one pose's box."""
    gap = np.asarray(where) - complex(pose[0], pose[1])
    if axes == "body":
        gap = gap * np.exp(-1j * pose[2])
    turn = np.angle(np.exp(1j * (np.asarray(phi) - pose[2])))
    parts = [gap.real, gap.imag, turn]
    used = [
        abs(part) / bound for part, bound in zip(parts, bounds, strict=True) if math.isfinite(bound)
    ]
    return np.max(used, axis=0)


def least_shares(linkage, poses, bounds, axes, size):
    """The least share (N,) that the coupler can use at each pose (x, y, radians), on any circuit.

    bounds: (N, 3), above zero; inf is free.  size: of the motion, for sliders.
    """
    out = np.full(len(poses), np.inf)
    for first, second in (
        (linkage.first, linkage.second),
        (linkage.second, linkage.first),
    ):
        turns = isinstance(first, RR)
        sweep = np.linspace(-np.pi, np.pi, SWEEP)
        if not turns:
            sweep = 50 * size * np.linspace(-1, 1, ALONG) ** 3
        found = places(first, second, sweep)
        for k, pose in enumerate(poses):
            for side in (0, 1):
                box = pose, bounds[k], axes[k]
                out[k] = min(out[k], _least((first, second), sweep, side, found, box))
    return out


def _least(dyads, sweep, side, found, box):
    """The least share on one assembly, from the best samples of a sweep."""
    used = share(found[0][side], found[1][side], *box)
    used = np.where(np.isfinite(used), used, np.inf)
    best = float(used.min())

    def along(drive):
        w, p = places(*dyads, np.array([drive]))
        value = share(w[side], p[side], *box)[0]
        return float(value) if np.isfinite(value) else 1e9

    lowest = np.flatnonzero((used <= np.roll(used, 1)) & (used <= np.roll(used, -1)))
    for at in lowest[np.argsort(used[lowest])][:NEAREST]:
        if not np.isfinite(used[at]):
            continue
        ends = sweep[max(at - 1, 0)], sweep[min(at + 1, len(sweep) - 1)]
        found = minimize_scalar(along, bounds=ends, method="bounded", options={"xatol": 1e-12})
        # It stops at the root of rounding, relative to where it is: once more, from there.
        near = minimize_scalar(
            lambda away, middle=found.x: along(middle + away),
            bounds=(-CLOSE, CLOSE),
            method="bounded",
            options={"xatol": 1e-15},
        )
        best = min(best, float(found.fun), float(near.fun))
    return best
