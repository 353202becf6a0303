"""What an angle error should count as: a campaign over lengths per radian and bodies.

    python -m benchmarks.angle_weight --count 40

Practical tasks (`practical_tasks`) are solved with each of several lengths per radian: shares of
the travel per radian, and the characteristic length that was the default once.  A body with a
radius of gyration between a tenth and six tenths of the travel per radian then says what each
recommended linkage costs: the root mean square by which the points of the body are off, over the
least of all answers.  The table shows the mean (geometric) and the ninth decile of that ratio.
"""

from __future__ import annotations

import argparse
import math

import numpy as np

from benchmarks.practical_tasks import practical_tasks
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.length_per_radian import TRAVEL_SHARE, default_length_per_radian
from burmester.tasks.motion_task import Task, characteristic_length
from burmester.tasks.options import SynthesisOptions

SHARES = 0.1, 0.17, 0.25, 1 / 3, 0.5, 1.0
BODIES = np.geomspace(0.1, 0.6, 8)  # radii of gyration, in travels per radian


def errors(task: Task, length: float) -> tuple[float, float]:
    """The root mean squares of both errors of the recommended linkage; nan without one."""
    found = synthesize(task, SynthesisOptions(length_per_radian=length)).usable
    if not found:
        return math.nan, math.nan
    error = found[0].error
    return error.rms, float(np.sqrt((error.angle**2).mean()))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=2)
    given = parser.parse_args()
    ratios = []
    for _, task in practical_tasks(given.count, given.seed):
        travel = default_length_per_radian(task) / TRAVEL_SHARE
        lengths = [characteristic_length(task), *(share * travel for share in SHARES)]
        position, angle = np.array([errors(task, length) for length in lengths]).T
        cost = np.hypot(position, np.outer(BODIES * travel, angle))
        ratios.append(cost / np.nanmin(cost, axis=1, keepdims=True))
    every = np.concatenate(ratios)
    mean = np.exp(np.nanmean(np.log(every), axis=0))
    decile = np.nanpercentile(every, 90, axis=0)
    print(f"{given.count} tasks, seed {given.seed}\n\nlength per radian | mean | ninth decile")
    names = ["characteristic length", *(f"{share:.2f} of the travel" for share in SHARES)]
    for row in zip(names, mean, decile, strict=True):
        print("{} | {:.2f} | {:.2f}".format(*row))


if __name__ == "__main__":
    main()
