"""Is every locally best dyad found?  Random tasks, held against many random starts.

    python -m benchmarks.critical_points --tasks 500 --starts 100 --seed 0

A task is 5 to 30 poses, wild ones or those of a random four-bar with noise of up to a tenth of
its size, in random frames and units.  Each is solved by `critical_dyads` and by SciPy's
Levenberg and Marquardt from random starts.  Exit code 1 if a start ends lower than the best
dyad listed, or at a minimum that is not listed although 25 points were accounted for.
"""

import argparse
import sys

import numpy as np
from scipy.optimize import least_squares
from tests.test_critical import circle_residual
from tests.witness import random_four_bar, random_poses

from burmester import Displacement, critical_dyads


def random_task(rng):
    count = int(rng.integers(5, 31))
    if rng.random() < 0.5:
        rows = rng.normal(size=(count, 3)) * [1, 1, 10 ** rng.uniform(-1, 0.5)]
    else:
        rows = random_poses(random_four_bar(rng), rng, count)
        rows = rows + 10 ** rng.uniform(-6, -1) * rng.normal(size=rows.shape)
    unit, shift = 10 ** rng.uniform(-3, 3), rng.normal(scale=10, size=2)
    rows[:, :2] = (rows[:, :2] + shift) * unit
    return rows, unit, shift


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name, value in (("--tasks", 500), ("--starts", 100), ("--seed", 0)):
        parser.add_argument(name, type=int, default=value)
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    counts, charts, lower, unlisted, missed_by_starts = [], [], 0, 0, 0
    for _ in range(given.tasks):
        rows, unit, shift = random_task(rng)
        found = critical_dyads(Displacement.from_poses(rows))
        counts.append(int(found.found))
        charts.append(int(found.charts))
        # The other solver gets the task in a handy unit and place.
        handy = rows.copy()
        handy[:, :2] = rows[:, :2] / unit - shift
        listed = np.column_stack(
            [found.dyads.fixed_pivot / unit - shift, found.dyads.moving_pivot / unit]
        )[found.minimum]
        starts = rng.normal(scale=3, size=(given.starts, 4))
        fits = [least_squares(circle_residual, x, args=(handy,), method="lm") for x in starts]
        fits = [fit for fit in fits if fit.status > 0 and np.abs(fit.x).max() < 1e3]
        reached = np.zeros(len(listed), dtype=bool)
        for fit in fits:
            gap = np.abs(listed - fit.x).max(axis=1)
            reached[gap.argmin()] |= gap.min() < 1e-3 * (1 + np.abs(fit.x).max())
            unlisted += gap.min() > 1e-2 * (1 + np.abs(fit.x).max())
        best = np.sqrt(2 * min(fit.cost for fit in fits) / len(rows)) if fits else np.inf
        lower += best < found.residual[0] / unit**2 * (1 - 1e-6) - 1e-12
        missed_by_starts += not reached.all()
    counts = np.array(counts)
    print(f"{given.tasks} tasks, {given.starts} starts each, seed {given.seed}")
    print(f"all 25 critical points accounted for in {(counts == 25).sum()}; fewest {counts.min()}")
    print(f"more than one chart needed in {(np.array(charts) > 1).sum()}")
    print(f"a start ended lower than the best dyad listed in {lower}")
    print(f"starts that ended away from every minimum listed: {unlisted}")
    print(f"the starts missed a minimum that is listed in {missed_by_starts} tasks")
    return int(lower > 0 or (counts < 25).any())


if __name__ == "__main__":
    sys.exit(main())
