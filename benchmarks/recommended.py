"""What comes first in tasks of practice: a count of what nobody would build.

    python -m benchmarks.recommended --count 40

Of each practical task the first linkage is looked at: its transmission angle, its links beside the
span of the motion, its errors, and whether another usable linkage in the list, as sound in its
transmission angle, is better in both.
"""

from __future__ import annotations

import argparse
import statistics

import numpy as np

from benchmarks.practical_tasks import FAMILIES, practical_tasks
from burmester.synthesis.motion_generation import synthesize


def main() -> None:
    """Print the counts of each family."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=7)
    given = parser.parse_args()
    heads = "tasks", "usable", "< 10°", "< 25°", "< 30°", "change point", "tiny link", "off > 5°"
    rows: dict[str, list[list[float]]] = {name: [] for name in FAMILIES}
    for name, task in practical_tasks(given.count, given.seed):
        usable = synthesize(task).usable
        if not usable:
            rows[name].append([1] + [0] * 10)
            continue
        best = usable[0]
        span = float(np.linalg.norm(np.ptp(task.poses.translation, axis=0)))
        least = np.degrees(best.driven.least_over_range)
        links = sorted(float(link) for link in best.linkage.links or ())
        turned = float(np.degrees(best.error.angle.max()))
        beaten = any(
            each.driven.least_over_range >= min(np.radians(30), best.driven.least_over_range)
            and each.error.worst < 0.99 * best.error.worst
            and each.error.angle.max() < 0.99 * best.error.angle.max()
            for each in usable
        )
        at_change = bool(links) and (
            abs(links[0] + links[3] - links[1] - links[2]) < 1e-3 * sum(links)
        )
        tiny = bool(links) and links[0] < 0.05 * span
        low = [least < bound for bound in (10, 25, 30)]
        rows[name].append(
            [1, 1, *low, at_change, tiny, turned > 5, beaten, best.error.worst, turned]
        )
    print(f"{given.count} tasks, seed {given.seed}\n")
    print(" | ".join(("family", *heads, "beaten in both", "median miss", "median angle")))
    for name, each in rows.items():
        counts = [f"{sum(column):.0f}" for column in zip(*each, strict=True)][:9]
        some = [row for row in each if row[1]]
        medians = (
            [f"{statistics.median(row[k] for row in some):.2g}" for k in (9, 10)] if some else []
        )
        print(" | ".join((name, *counts, *medians)))


if __name__ == "__main__":
    main()
