"""Poses by the million, and the peak memory of a process that fits them.

`python -m benchmarks.many_poses pencil 1000000` prints the peak in MB after the fit and
before it, when the poses were already there (getrusage, which counts in KiB on Linux).
`python -m benchmarks.many_poses synthesize 100000 forth` measures `burmester synthesize FILE`
on that many noisy poses of a sort of `tests.oracles.measured`: exit code, CPU seconds, MB at most.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from tests.oracles.measured import as_csv, measured

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


def command(count, sort):
    """The whole command on measured poses: exit code, CPU seconds, and MB at most."""
    from resource import RUSAGE_CHILDREN, getrusage  # noqa: PLC0415  (Unix only)

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "poses.csv")
        file.write_text(as_csv(measured(count, sort)), encoding="utf-8")
        done = subprocess.run(
            [sys.executable, "-m", "burmester", "synthesize", str(file)],
            capture_output=True,
            check=False,
        )
    used = getrusage(RUSAGE_CHILDREN)
    seconds = used.ru_utime + used.ru_stime
    print(done.returncode, f"{seconds:.1f} s", f"{used.ru_maxrss * 1024 / 1e6:.0f} MB")


def main(method, count, sort="forth"):
    """Fit once, and print the peaks."""
    from resource import RUSAGE_SELF, getrusage  # noqa: PLC0415  (Unix only)

    if method == "synthesize":
        return command(int(count), sort)
    poses = in_one_task(int(count))
    before = getrusage(RUSAGE_SELF).ru_maxrss
    if method == "pencil":
        fit_pencil(poses)
    else:
        np.linalg.svd(design(poses), full_matrices=method == "full")
    after = getrusage(RUSAGE_SELF).ru_maxrss
    return print(round(after * 1024 / 1e6), round(before * 1024 / 1e6))


if __name__ == "__main__":
    main(*sys.argv[1:])
