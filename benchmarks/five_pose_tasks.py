"""Random four-bars, five poses cut from each: are its two dyads among the answers?

`python -m benchmarks.five_pose_tasks --tasks 1000 --seed 0`, from the root of the repository.

An answer is compared in all of Xc, Yc, x, y and r; the worst counts, in spans (the diagonal of
the box around the five positions).  First with the linkage that made the poses.  Rounding the
poses to doubles moves their exact dyads a little, or much where the poses say little about
them; so where the first error exceeds the limit, the exact dyad of those very doubles is
computed in 50 digits, from the generating one, and compared as well.
"""

import argparse
import sys

import numpy as np
from tests.oracles.conics import as_rows, in_fifty_digits
from tests.oracles.witness import random_four_bar, random_poses, span

from burmester import Displacement, dyads_of_five

LIMIT = 1e-9


def error(found, wanted, size):
    """The distance of the nearest answer from a wanted dyad, in spans."""
    return np.abs(found - wanted).max(axis=1).min(initial=np.inf) / size


def errors_of_task(rng):
    """Two errors in spans, the worse dyad each: as generated, and as the doubles have it."""
    dyads = random_four_bar(rng)
    rows = random_poses(dyads, rng, 5)
    found, size = as_rows(dyads_of_five(Displacement.from_poses(rows)).dyads), span(rows)
    generated, exact = [], []
    for dyad in dyads:
        truth = np.array([*dyad.fixed_pivot, *dyad.moving_pivot, dyad.radius])
        generated.append(error(found, truth, size))
        exact.append(0.0)
        if generated[-1] > LIMIT:
            try:
                exact[-1] = error(found, in_fifty_digits(truth, rows), size)
            except (ValueError, ZeroDivisionError):  # Newton did not get there
                exact[-1] = np.inf
    return max(generated), max(exact)


def main():
    """Run the campaign; exit code 1 if a task fails both comparisons."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--tasks", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    generated, exact = np.array([errors_of_task(rng) for _ in range(given.tasks)]).T
    far = generated > LIMIT
    failed = np.flatnonzero(far & (exact > LIMIT))
    print(f"{given.tasks} tasks, seed {given.seed}; errors in spans, limit {LIMIT:g}")
    print(
        f"from the generating linkage: {(~far).sum()} within, {far.sum()} beyond; "
        f"median {np.median(generated):.1e}, worst {generated.max():.1e}"
    )
    if far.any():
        print(
            f"those {far.sum()} from the 50-digit dyads of the same doubles: "
            f"{far.sum() - len(failed)} within, {len(failed)} beyond; "
            f"median {np.median(exact[far]):.1e}, worst {exact[far].max():.1e}"
        )
    print(f"{given.tasks - len(failed)} of {given.tasks} tasks solved")
    if len(failed):
        print("failed tasks:", *failed)
    sys.exit(1 if len(failed) else 0)


if __name__ == "__main__":
    main()
