"""All four-bars through poses and points: how long it takes, what is lost, and what it lacks.

    .venv/bin/python -m benchmarks.points [--count 4] [--seed 0] [--starts 0] [--case 1-8]

With --starts Levenberg and Marquardt's method looks for linkages of each task from so many random
starts (`tests/oracles/points_by_descent`).  Those that the complete solve lacks are counted as new.
"""

import argparse
from time import process_time

import numpy as np
from tests.oracles.points_by_descent import lacking, pivots_from_random_starts

from burmester.geometry.displacement import Displacement
from burmester.points.real_linkages import linkages_through
from burmester.points.start_systems import CASES, Case

SAME = 1e-4  # relative; pivots that differ by less are one


def task(case, rng):
    """Random positions, and which are points."""
    count = case.positions + 1
    is_point = np.arange(count) >= case.poses
    is_point |= case.poses == 1
    return Displacement(rng.normal(size=(count, 2)), rng.uniform(-3, 3, count)), is_point


def main():
    """Print a line for each task."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=4)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--starts", type=int, default=0)
    parser.add_argument(
        "--case", nargs="*", default=[each.name for each in CASES if not each.pivots]
    )
    asked = parser.parse_args()
    for name in asked.case:
        case = Case(*map(int, name.split("-")))
        for number in range(asked.count):
            rng = np.random.default_rng([asked.seed, number])
            poses, is_point = task(case, rng)
            began = process_time()
            found = linkages_through(poses, is_point)
            seconds = process_time() - began
            known = found.batch.dimensions[:, :, :4]
            seen = pivots_from_random_starts(
                poses.translation @ [1, 1j], poses.angle, is_point, asked.starts, rng
            )
            new = len(lacking(known, seen, SAME))
            print(
                f"{name:6} {seconds:6.3f} s  found {found.found:5}  lost {found.lost:2}"
                f"  solved problems {found.systems}"
                f"  real {found.real:3}  linkages {len(found.batch):3}"
                f"  from random starts {len(seen):3}, of these new {new}",
                flush=True,
            )


if __name__ == "__main__":
    main()
