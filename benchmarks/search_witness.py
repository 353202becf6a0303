"""Does the search find the best linkage?  Practical tasks, held against an independent multi-start.

    python -m benchmarks.search_witness --count 200 --seed 0

The tasks are those of `tests/oracles/common_tasks.py`: lids, folds, landing gear, tailgates,
hinges, lifts, pick and place, grippers and random boxes, in turns, five to nine poses, all with a
transmission angle of 35 degrees.  The witness is `tests/oracles/multi_start.py`, which shares no
code with the package: a sweep of 2,000 random linkages within the limits, and SciPy's SLSQP from
the sixty best (forty steps) and the fifteen best of these (two hundred).  What is compared is the
combined error, the root of the mean of |position error|² + (length x angle error)² over the poses;
a radian counts as a quarter of the travel per radian, given to both.  Of both sides only linkages
count that the package's judge calls usable, and that `comes_by` drives through the poses.

Exit code 1 if a linkage called usable does not come by.
"""

import argparse
import sys
import time
from collections import Counter

import numpy as np
from tests.oracles.common_tasks import TRANSMISSION, common_task
from tests.oracles.hard_tasks import comes_by
from tests.oracles.multi_start import MultiStart

from burmester.fourbar.dyad import RR
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import box
from burmester.linkages.evaluation import Candidates, Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.requirements import Requirements
from burmester.verdicts.found_linkage import numbered_pair

WORSE = 1.05  # times the other's error
NEGLIGIBLE = 1e-5  # motion sizes; what is added to both errors, so that none counts below it


def task_of(given):
    """A task as the package takes it."""
    limits = tuple(
        Limits(fixed_pivot=box(*fixed), moving_pivot=box(*moving), kinds=frozenset({"RR"}))
        for fixed, moving in given.boxes
    )
    asked = Requirements(
        transmission_deg=float(np.degrees(TRANSMISSION)), link_ratio=float(given.ratio)
    )
    return Task(Displacement.from_poses(given.rows), limits=limits, requirements=asked)


def combined(found, length):
    """The combined error of a linkage."""
    error = found.error
    return float(np.sqrt((error.position**2 + (length * error.angle) ** 2).mean()))


def judged(result, z, rows):
    """A linkage z (10,) with its places (N, 3), judged by the package."""
    target = target_of(result.problem)
    evaluation = Evaluation(result.problem, target)
    linkage = Linkage(*(RR(z[k : k + 2], z[k + 2 : k + 4], z[k + 4]) for k in (0, 5)))
    batch = LinkageBatch.of([linkage]).to_canonical(target.frames)
    places = target.frames.to_canonical(Displacement.from_poses(rows))
    pair = numbered_pair(linkage, 1)
    found = evaluation.evaluate(
        Candidates(batch, rows_of(places, target.length)[None], [pair], np.ones(1, dtype=bool))
    )
    return found[0] if found else None


def compared(seed, witness=True):
    """One task: its family, both errors in motion sizes, both times, and what does not come by."""
    given = common_task(seed)
    start = time.process_time()
    result = synthesize(task_of(given), SynthesisOptions(length_per_radian=given.length))
    took = time.process_time() - start
    wrong = [found.id for found in result.usable if not comes_by(found, TRANSMISSION)]
    ours = min((combined(found, given.length) for found in result.usable), default=np.inf)
    start, theirs = time.process_time(), np.inf
    search = MultiStart(given.rows, given.length, given.boxes, given.ratio, TRANSMISSION)
    if witness:
        for _, z, rows in search.best(np.random.default_rng([14, seed])):
            found = judged(result, z, rows)
            if found is not None and found.usable and comes_by(found, TRANSMISSION):
                theirs = combined(found, given.length)
                break
    unit = search.unit
    return given, ours / unit, theirs / unit, (took, time.process_time() - start), wrong


def ratio_of(ours, theirs):
    """How many times as great our error is; 1 where neither has a linkage."""
    if not np.isfinite(ours) and not np.isfinite(theirs):
        return 1.0
    return (ours + NEGLIGIBLE) / (theirs + NEGLIGIBLE)


def main():
    """Run the campaign, and say how often which of the two is nearer."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    ratios, times, counts, bad = [], [], Counter(), []
    for seed in range(asked.seed, asked.seed + asked.count):
        given, ours, theirs, took, wrong = compared(seed)
        ratios.append(ratio_of(ours, theirs))
        times.append(took)
        what = "worse" if ratios[-1] > WORSE else "nearer" if ratios[-1] < 1 / WORSE else "alike"
        counts[given.family, what] += 1
        bad += [(seed, name) for name in wrong]
        print(
            f"{seed:4d} {given.family:15s} {len(given.rows)} poses: {ours:.5f} and {theirs:.5f}, "
            f"{ratios[-1]:.3f} {what}; {took[0]:.2f} and {took[1]:.2f} s",
            flush=True,
        )
    families = sorted({family for family, _ in counts})
    print("\nfamily: ours worse by more than 5 %, alike, nearer")
    for family in families:
        print(
            f"{family}: {', '.join(str(counts[family, k]) for k in ('worse', 'alike', 'nearer'))}"
        )
    ratios, (own, other) = np.array(ratios), np.array(times).T
    print(
        f"{asked.count} tasks, seed {asked.seed}: {(ratios > WORSE).sum()} worse by more than 5 %, "
        f"{(ratios < 1 / WORSE).sum()} nearer by more than 5 %; worst {ratios.max():.3f}"
    )
    print(f"time: {np.median(own):.2f} s median, {own.sum():.0f} s; witness {other.sum():.0f} s")
    print(f"{len(bad)} usable linkages do not come by the poses as they say", *bad)
    return int(bool(bad))


if __name__ == "__main__":
    sys.exit(main())
