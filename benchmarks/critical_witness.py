"""Are the critical points the right ones?  Random tasks, held against path tracking.

    python -m benchmarks.critical_witness --tasks 200 --seed 0

`tests/oracles/homotopy.py` shares no code with the package.  All 25 points are compared, complex
ones too, each with its nearest; a gap counts in the greater of the motion's size and the point's
distance. Exit code 1 if a task has other points, or other real ones, than the package says.
"""

import argparse
import sys
import time

import numpy as np
from tests.oracles.critical_paths import against_the_paths
from tests.oracles.homotopy import LostError

from benchmarks.critical_points import random_task

LIMIT = 1e-6


def main():
    """Compare, and say how many tasks agree."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--tasks", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    rng, start = np.random.default_rng(given.seed), time.perf_counter()
    gaps, same_real, incomplete, lost = [], 0, 0, 0
    for _ in range(given.tasks):
        rows = random_task(rng)[0]
        try:
            found, gap, same = against_the_paths(rows)
        except LostError:
            lost += 1
            continue
        if found < 25:
            incomplete += 1
            continue
        gaps.append(gap)
        same_real += same
    seconds, agree = time.perf_counter() - start, int((np.array(gaps) < LIMIT).sum())
    print(f"{given.tasks} tasks, seed {given.seed}, {seconds:.0f} s")
    print(f"all 25 points the same within {LIMIT:g}: {agree}; real ones the same: {same_real}")
    print(f"gaps: median {np.median(gaps):.1e}, worst {max(gaps):.1e}")
    print(f"said by the package to be incomplete: {incomplete}; paths lost: {lost}")
    return int(agree < len(gaps) or same_real < len(gaps))


if __name__ == "__main__":
    sys.exit(main())
