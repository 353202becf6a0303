"""Are the best dyads within limits found?  Random tasks, held against many starts of SciPy's SLSQP.

    python -m benchmarks.limits_campaign --tasks 150 --starts 40 --seed 1
    python -m benchmarks.limits_campaign --pairs --tasks 210 --starts 20 --seed 5

The tasks and the comparison are those of `tests/oracles/limits_problems.py`: poses of a
random four-bar with noise of 0.1 to 5 % of their span, pivots in points, on lines and segments, in
boxes and concave polygons, links of limited length, up to as many exact poses as a dyad can meet,
weights.  With --pairs each pair of sorts of regions comes in turn (none, point, line, segment, box,
concave polygon: 35 pairs), with 5 to 12 poses, noise of 0.1 to 15 %, and weights on half of the
tasks.  Exit code 1 if SciPy found a better dyad that ours should have led to, or a dyad breaks its
limits.
"""

import argparse
import sys
import time
from collections import Counter

import numpy as np
from tests.oracles.limits_problems import (
    PAIRS,
    breaches,
    kinds_of,
    random_problem,
    random_problem_of,
    solved,
    verdict,
)


def main():
    """Run the campaign and print what came of it."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--tasks", type=int, default=150)
    parser.add_argument("--starts", type=int, default=40, help="for each piece of the regions")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pairs", action="store_true", help="every pair of sorts of regions")
    given = parser.parse_args()
    counts, lost, unsettled, worst, took = Counter(), 0, 0, 0.0, []
    for task in range(given.tasks):
        rng = np.random.default_rng([given.seed, task])
        pair = PAIRS[task % len(PAIRS)]
        problem = random_problem_of(rng, pair) if given.pairs else random_problem(rng)
        begun = time.process_time()
        found = solved(problem)
        took.append(time.process_time() - begun)
        lost += found.lost > 0
        unsettled += found.unsettled > 0
        for kind in kinds_of(problem):
            breach = breaches(problem, found, kind)
            worst = max(worst, breach)
            what, best, least, z = verdict(problem, found, kind, rng, given.starts)
            counts[kind.__name__, what] += 1
            if what not in ("same", "ours") or breach > 1e-8:
                print(
                    f"task {task} {kind.__name__}: {what}, {best:.8g} against {least:.8g} at {z}; "
                    f"breach {breach:.1g}; exact {int(problem.exact.sum())}, lost {found.lost}, "
                    f"unsettled {found.unsettled}; {problem.limits}",
                    flush=True,
                )
    print(f"{given.tasks} tasks, {given.starts} starts a piece, seed {given.seed}")
    for (kind, what), count in sorted(counts.items()):
        print(f"{kind} {what}: {count}")
    print(f"greatest breach of a limit or an exact pose: {worst:.2g} spans")
    print(f"tasks with lost paths: {lost}; with ways down given up: {unsettled}")
    took = np.array(took)
    print(f"time of a task: median {np.median(took):.2f} s, worst {took.max():.2f} s")
    bad = sum(count for (_, what), count in counts.items() if what == "bug")
    return int(bad > 0 or worst > 1e-8)


if __name__ == "__main__":
    sys.exit(main())
