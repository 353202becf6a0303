"""The systems on faces of limits: how often paths are needed, and what a system of a shape takes.

    python -m benchmarks.face_systems --count 36 --seed 1

First, tasks of several sorts of motions, with regions of all sorts on both pivots, some links of
limited or given length, some poses exact: which share of their systems the eigenproblems leave to
paths.  Then random systems of each shape: ms of CPU for one of ten, by eigenproblems, and with
--paths by paths.
"""

import argparse
import time

import numpy as np
from tests.oracles.bilinear_systems import SHAPES, of_poses, stacked
from tests.oracles.limits_problems import SORTS, random_region
from tests.oracles.witness import random_four_bar, random_poses

from burmester.dyads.minima_within_limits import limited_dyads
from burmester.geometry.displacement import Displacement
from burmester.polynomials import stationary_points as module
from burmester.polynomials.parameter_homotopy import tracked_points
from burmester.polynomials.stationary_points import stationary_points
from burmester.tasks.limits import Limits

LENGTHS = [(0.0, np.inf), (0.5, 2.0), (1.0, 1.0)]


def motions(rng):
    """Poses x, y, angle of every sort of motion."""
    count = int(rng.integers(6, 12))
    t, a = np.linspace(-1, 1, count)[:, None], rng.normal(size=5)
    met = random_poses(random_four_bar(rng), rng, count)
    return {
        "noise of 1 %": met + rng.normal(scale=0.01, size=met.shape),
        "met by two dyads": met,
        "five poses": met[:5],
        "mirror image of itself": np.hstack(
            [a[0] * t + a[1] * t**3, a[2] * t**2 + a[3] * t**4, (1 + a[4] / 5) * t]
        ),
        "turn of 0.6°": np.hstack(
            [rng.normal(size=(count, 2)), 0.01 * rng.normal(size=(count, 1))]
        ),
    }


def shares(count, seed):
    """Print the share of systems that paths solve, by sort of motion."""
    systems, by_paths, lost = {}, {}, {}
    for task in range(count):
        rng = np.random.default_rng([seed, task])
        for sort, rows in motions(rng).items():
            exact = np.arange(len(rows)) < (task % 5 if task % 2 else 0)
            regions = [random_region(rng, SORTS[k % 6], 1.0)[0] for k in (task, task // 6)]
            limits = Limits(*regions, LENGTHS[task % 3])
            followed = []

            def counted(shape, target, followed=followed):
                followed.append(len(target.square))
                return tracked_points(shape, target)

            module.tracked_points = counted
            found = limited_dyads(Displacement.from_poses(rows), None, exact, limits)
            systems[sort] = systems.get(sort, 0) + found.systems
            by_paths[sort] = by_paths.get(sort, 0) + sum(followed)
            lost[sort] = lost.get(sort, 0) + found.lost
    module.tracked_points = tracked_points
    for sort, number in systems.items():
        share = 100 * by_paths[sort] / number
        print(f"{sort:24} {number:6} systems, by paths {share:5.2f} %, lost paths {lost[sort]}")


def times(seed, *, paths):
    """Print what a system of each shape takes."""
    for shape in SHAPES:
        systems = stacked([of_poses(shape, np.random.default_rng([seed, k])) for k in range(10)])
        stationary_points(shape, systems)
        took = []
        for solve in [stationary_points] * 3 + [tracked_points] * paths:
            begun = time.process_time()
            solve(shape, systems)
            took.append(100 * (time.process_time() - begun))
        print(f"{shape.name:18} {min(took[:3]):8.3f} ms", *(f"{ms:8.1f} ms" for ms in took[3:]))


def main():
    """Run both."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=36)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--paths", action="store_true", help="the time of paths as well")
    given = parser.parse_args()
    shares(given.count, given.seed)
    times(given.seed, paths=given.paths)


if __name__ == "__main__":
    main()
