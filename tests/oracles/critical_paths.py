"""Critical points of a task beside the ends of paths that another witness follows."""

import numpy as np

from burmester.dyads.critical_points import critical_dyads
from burmester.geometry.displacement import Displacement
from tests.oracles.homotopy import critical_points


def against_the_paths(rows):
    """How many points were found, how far the paths' ends are from them, and if the same are real.

    The gap is relative, and infinite where two paths end nearest to one point.
    """
    ends, real = critical_points(rows)
    found = critical_dyads(Displacement.from_poses(rows))
    length, frames = found.frames.length, found.frames
    origin = np.concatenate([frames.fixed_origin, frames.moving_origin])
    c1, c2, m1, m2 = (found.points[: found.found] * length + origin).T
    points = np.column_stack([c1 + 1j * c2, c1 - 1j * c2, m1 + 1j * m2, m1 - 1j * m2])
    distance = np.linalg.norm(ends[:, None] - points, axis=2)
    middle = origin[[0, 0, 2, 2]] + 1j * origin[[1, 1, 3, 3]] * [1, -1, 1, -1]
    size = np.maximum(length, np.linalg.norm(ends - middle, axis=1))
    nearest = distance.argmin(axis=1)
    gap = np.max(distance.min(axis=1) / size)
    each_once = len(set(nearest)) == len(points)
    same = bool((found.real[nearest] == real).all())
    return int(found.found), float(gap) if each_once else np.inf, same
