"""Poses by the million, and the peak memory of a process that fits them.

`python -m benchmarks.many_poses pencil 1000000` prints the peak in MB after the fit and
before it, when the poses were already there (getrusage, which counts in KiB on Linux).
"""

import sys

import numpy as np

from burmester import Displacement, fit_pencil
from burmester.geometry import constraint_manifold
from burmester.io.reading.poses import read_task

TABLE_5 = read_task("case:ge2012-approximate")


def near_table_5(tasks):
    """Poses (tasks, 10): those of Table 5 with noise of 0.01, the same in every run."""
    rows = np.column_stack([TABLE_5.poses.translation, TABLE_5.poses.angle])
    noise = np.random.default_rng(5).normal(scale=0.01, size=(tasks, *rows.shape))
    return Displacement.from_poses(rows + noise)


def in_one_task(count):
    """As many of them, (count,)."""
    many = near_table_5(count // 10)
    return Displacement(many.translation.reshape(-1, 2), many.angle.reshape(-1))


def design(poses):
    """The whole design matrix (*, N, 8) of Eq. (14)."""
    return constraint_manifold.monomials(poses.as_image_point())


def main(method, count):
    """Fit once, and print the peaks."""
    from resource import RUSAGE_SELF, getrusage  # noqa: PLC0415  (Unix only)

    poses = in_one_task(int(count))
    before = getrusage(RUSAGE_SELF).ru_maxrss
    if method == "pencil":
        fit_pencil(poses)
    else:
        np.linalg.svd(design(poses), full_matrices=method == "full")
    after = getrusage(RUSAGE_SELF).ru_maxrss
    print(round(after * 1024 / 1e6), round(before * 1024 / 1e6))


if __name__ == "__main__":
    main(*sys.argv[1:])
