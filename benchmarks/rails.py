"""Planted tasks with a rail or a slot: is a linkage found that keeps it?

    python -m benchmarks.rails --count 60 --seed 0

Random linkages of a slider on the ground with a link, a link with a slot in the body, and a slider
with a slot are driven by code of the tests' own (`tests/oracles/rail_tasks.py`).  Three to eight
places of each are a task; its rail or slot (direction exact or with a tolerance, a point or segment
that it passes through, the travel of the pin) and the boxes of its pivots are kept by the linkage
that was planted.  Reported are tasks without a usable linkage, and tasks whose nearest usable
linkage misses the poses by more than a thousandth of their span.
"""

import argparse
import time

import numpy as np
from tests.oracles.rail_tasks import planted

from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.notation import span


def main():
    """Run the campaign and print what failed."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    none, far, spent = [], [], []
    for number in range(given.count):
        task, dyads = planted(np.random.default_rng([given.seed, number]))
        begin = time.process_time()
        found = synthesize(task)
        spent.append(time.process_time() - begin)
        usable = [each for each in found.linkages if each.usable]
        kinds = "+".join(type(each).__name__ for each in dyads)
        rail = next(each.line for each in task.limits if each.line)
        what = f"{number}: {task.poses.shape[0]} poses, {kinds}, {rail}: {found.outcome.code}"
        if not usable:
            none.append(what)
            print("none", what, flush=True)
        elif (miss := min(each.combined_error for each in usable)) > 1e-3 * span(task):
            far.append(what)
            print(f"off by {miss / span(task):.2g} spans", what, flush=True)
    print(f"{given.count} tasks: {len(none)} without a usable linkage, {len(far)} not met closely")
    print(f"{np.mean(spent):.2f} s of processor time a task, at most {max(spent):.1f} s")
    return int(bool(none))


if __name__ == "__main__":
    raise SystemExit(main())
