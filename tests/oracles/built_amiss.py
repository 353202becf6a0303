"""Linkages built amiss, and where they come: driven joint by joint, near poses.

The independent place (`driven`) is the driver's angle of least distance, by SciPy, on linkages that
`witness` drives.
"""

import numpy as np
from scipy.optimize import minimize_scalar

from burmester.fourbar.dyad import PR, RP
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from tests.oracles.refits import LENGTH, case, numbers_of
from tests.oracles.witness import places

OFF = 0.03  # of the poses from the linkage: their gaps bend the way to the nearest place


def driven(dyads, rows, drive):
    """The nearest places (N, 3) on one assembly, the driver within a fifth of a radian of drive."""
    out = []
    for row, angle in zip(rows, drive, strict=True):

        def at(t, row=row):
            where, phi = places(*dyads, np.array([t]))
            turned = np.angle(np.exp(1j * (phi[0, 0] - row[2])))
            return np.array([where[0, 0].real, where[0, 0].imag, row[2] + turned])

        def far(t, row=row):
            gap = at(t) - row
            return np.nan_to_num(gap[0] ** 2 + gap[1] ** 2 + (LENGTH * gap[2]) ** 2, nan=1e9)

        bounds = angle - 0.2, angle + 0.2
        end = minimize_scalar(far, bounds=bounds, method="bounded", options={"xatol": 1e-12}).x
        # The square of a distance is flat at its least: its slope is zero more exactly.
        for _ in range(3):
            h = 1e-4
            ends = [far(end - h), far(end), far(end + h)]
            end -= h * (ends[2] - ends[0]) / (2 * (ends[2] - 2 * ends[1] + ends[0]))
        out.append(at(end))
    return np.array(out)


def problem(seed, second, off=OFF):
    """Dyads, poses near them, driver angles, and the nearest places."""
    dyads, rows, drive = case(seed, second, 6)
    rows = rows + off * np.random.default_rng(seed).normal(size=rows.shape)
    return dyads, rows, drive, driven(dyads, rows, drive)


def asked(dyads, rows, found):
    batch = LinkageBatch.of([Linkage(*dyads)])
    return batch, Displacement.from_poses(rows), Displacement.from_poses(found[None]), LENGTH


def built_amiss(dyads, found):
    """The numbers of dyads for small errors of what is built, and the slots of the ten."""
    z, columns, slots = numbers_of(dyads), [], []
    at = 0
    for side, dyad in enumerate(dyads):
        for j in range(len(numbers_of([dyad]))):
            column = np.zeros(len(z))
            column[at + j] = 1.0
            line = {PR: 0, RP: 2}.get(type(dyad))
            if line == j:
                # Turned about the middle of its travel: n(angle + a) . X = offset there, still.
                poses = Displacement.from_poses(found)
                if line == 0:
                    point = poses.act(dyad.moving_pivot)
                else:
                    point = poses.inverse().act(dyad.fixed_pivot)
                angle = float(dyad.normal_angle)
                way = np.array([-np.sin(angle), np.cos(angle)])
                middle = (point @ way).min() / 2 + (point @ way).max() / 2
                column[at + j] = 1 / LENGTH
                column[at + j + 1] = middle / LENGTH
            columns.append(column)
            slots.append(5 * side + j)
        at += len(numbers_of([dyad]))
    return np.array(columns), slots
