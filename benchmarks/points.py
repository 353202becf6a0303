"""All four-bars through poses and points: how long it takes, what is lost, and what it lacks.

    .venv/bin/python -m benchmarks.points [--count 4] [--seed 0] [--starts 0] [--case 1-8]

With --starts SciPy looks for linkages of each task by least squares from so many random starts.
Each one found is compared with those of the complete solve; one that it lacks is printed.
"""

import argparse
from time import process_time

import numpy as np
from scipy.optimize import least_squares

from burmester.geometry.displacement import Displacement
from burmester.points.real_linkages import linkages_through
from burmester.points.start_systems import CASES, Case

MET, SAME = 1e-9, 1e-5
FARTHEST = 50.0  # sizes of the task; random starts run off to links without end


def task(case, rng):
    """Random positions, and which are points."""
    count = case.positions + 1
    is_point = np.arange(count) >= case.poses
    is_point |= case.poses == 1
    return Displacement(rng.normal(size=(count, 2)), rng.uniform(-3, 3, count)), is_point


def by_least_squares(poses, is_point, rng):
    """The pivots (8,) of one linkage from a random start, x and y of each pair; None if none."""
    d, angle = poses.translation @ [1, 1j], poses.angle
    free = np.flatnonzero(is_point)
    if is_point.all():
        free = free[1:]  # the first angle is that of the frame

    def gaps(unknowns):
        fixed, moving = unknowns[:8].reshape(2, 2, 2) @ [1, 1j]
        turn = np.where(is_point, 0.0, angle)
        turn[free] = unknowns[8:]
        pins = d[:, None] + np.exp(1j * turn)[:, None] * moving
        square = np.abs(pins - fixed) ** 2
        return (square[1:] - square[0]).ravel()

    start = np.concatenate([2 * rng.normal(size=8), rng.uniform(-3, 3, len(free))])
    found = least_squares(gaps, start, xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=300)
    pivots = found.x[:8]
    fixed, moving = pivots.reshape(2, 2, 2) @ [1, 1j]
    apart = min(abs(fixed[1] - fixed[0]), abs(moving[1] - moving[0]))
    sound = np.abs(found.fun).max() < MET and apart > 1e-3 and np.abs(pivots).max() < FARTHEST
    return pivots if sound else None


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
            known = np.concatenate([known, known[:, ::-1]])
            seen, lacking = 0, 0
            for _ in range(asked.starts):
                pivots = by_least_squares(poses, is_point, rng)
                if pivots is None:
                    continue
                seen += 1
                other = np.concatenate([pivots[:4].reshape(2, 2), pivots[4:].reshape(2, 2)], axis=1)
                gap = np.abs(known - other).max(axis=(1, 2), initial=0)
                lacking += not (gap < SAME * (1 + np.abs(other).max())).any()
            print(
                f"{name:6} {seconds:6.2f} s  found {found.found:5}  lost {found.lost:2}"
                f"  real {found.real:3}  linkages {len(found.batch):3}"
                f"  by least squares {seen:3}, of these lacking {lacking}",
                flush=True,
            )


if __name__ == "__main__":
    main()
