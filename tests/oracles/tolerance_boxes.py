"""How much of a pose's tolerances a linkage uses at least, by driving it finely (`witness`)."""

from __future__ import annotations

import numpy as np

from burmester.fourbar.dyad import RR
from tests.oracles.least import least
from tests.oracles.witness import places

SWEEP = 4001  # places of a crank
ALONG = 8001  # of a slider, more of them near its middle
CLOSE = 1e-6  # radians or lengths to either side of a minimum, looked through once more
NEAREST = 6  # samples around which the least share is looked for


def share(where, phi, pose, bounds, axes):
    """The greatest share of x, y and angle that places (x + iy, phi) use of poses' boxes."""
    x, y, angle = np.moveaxis(np.asarray(pose, float), -1, 0)
    gap = np.asarray(where) - (x + 1j * y)
    gap = gap * np.where(np.asarray(axes) == "body", np.exp(-1j * angle), 1.0)
    turn = np.angle(np.exp(1j * (np.asarray(phi) - angle)))
    parts = np.stack(np.broadcast_arrays(gap.real, gap.imag, turn), axis=-1)
    return (np.abs(parts) / np.asarray(bounds, float)).max(axis=-1)  # nothing of what is free


def least_shares(linkage, poses, bounds, axes, size):
    """The least share (N,) that the coupler can use at each pose (x, y, radians), on any circuit.

    bounds: (N, 3), above zero; inf is free.  size: of the motion, for sliders.
    """
    out = np.full(len(poses), np.inf)
    poses, bounds, axes = np.asarray(poses), np.asarray(bounds), np.asarray(axes)
    for dyads in ((linkage.first, linkage.second), (linkage.second, linkage.first)):
        sweep = np.linspace(-np.pi, np.pi, SWEEP)
        if not isinstance(dyads[0], RR):
            sweep = 50 * size * np.linspace(-1, 1, ALONG) ** 3
        found = places(*dyads, sweep)
        for side in (0, 1):
            pose, at, used = _lowest(found[0][side], found[1][side], poses, bounds, axes)
            np.minimum.at(out, pose, used)

            def along(drive, side=side, pose=pose):
                w, p = places(*dyads, drive)  # noqa: B023  it is used at once
                value = share(w[side], p[side], poses[pose], bounds[pose], axes[pose])
                return np.nan_to_num(value, nan=1e9, posinf=1e9)

            low, high = sweep[np.maximum(at - 1, 0)], sweep[np.minimum(at + 1, len(sweep) - 1)]
            where, fine = least(along, low, high)
            np.minimum.at(out, pose, fine)
            # What is left of the bounds may be more than a minimum that is a corner is wide.
            _, fine = least(along, where - CLOSE, where + CLOSE)
            np.minimum.at(out, pose, fine)
    return out


def _lowest(where, phi, poses, bounds, axes):
    """Poses and samples (n,) of the least shares on one assembly, and the shares."""
    every = []
    for k in range(len(poses)):
        used = share(where, phi, poses[k], bounds[k], axes[k])
        used = np.where(np.isfinite(used), used, np.inf)
        low = (used <= np.roll(used, 1)) & (used <= np.roll(used, -1)) & np.isfinite(used)
        lowest = np.flatnonzero(low)
        lowest = lowest[np.argsort(used[lowest])][:NEAREST]
        every += [(k, at, used[at]) for at in lowest]
    pose, at, used = np.array(every).reshape(-1, 3).T
    return pose.astype(int), at.astype(int), used
