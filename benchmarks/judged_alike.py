"""Does `judge` say of each linkage of an answer what `synthesize` says of it?

    python -m benchmarks.judged_alike --count 200 --seed 1

A random four-bar leads a body through five to nine poses; each pose is off by a thousandth to a
fifth of the way, and every fourth task holds the fixed pivots to a box.  Every linkage that
synthesis lists, usable or not, is judged by its dimensions alone.  Whether it is usable, the kinds
of its defects and violations, its type and its errors have to be the same.

Exit code 1 if they are not.
"""

import argparse
import sys
import time
from collections import Counter

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import box
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task

NOISE = (1e-3, 2e-1)  # of the span of the poses
SAME_ERROR = 1e-6  # of the span of the poses, and radians; errors that differ by less are the same


def noisy_task(number: int, seed: int) -> Task:
    """Poses of the coupler of a random four-bar, each off by some noise."""
    rng = np.random.default_rng((seed, number))
    while True:
        ground, coupler, follower, crank = rng.uniform((0.5, 0.5, 0.5, 0.2), (4, 4, 4, 2))
        turned = np.sort(rng.uniform(0, rng.uniform(1, 2 * np.pi), rng.integers(5, 10)))
        pin = crank * np.exp(1j * turned)
        gap = ground - pin
        base = (abs(gap) ** 2 + coupler**2 - follower**2) / (2 * abs(gap) * coupler)
        if (abs(base) < 0.98).all():
            break
    angle = np.unwrap(np.angle(gap) + rng.choice([-1, 1]) * np.arccos(base))
    at = pin + (rng.normal() + 1j * rng.normal()) * np.exp(1j * angle)
    poses = np.column_stack([at.real, at.imag, angle])
    span = float(np.linalg.norm(np.ptp(poses[:, :2], axis=0)))
    off = rng.normal(size=poses.shape) * 10 ** rng.uniform(*np.log10(NOISE))
    poses += off * (span, span, max(0.3, float(np.ptp(angle))))
    limits = ()
    if number % 4 == 3:
        middle, reach = poses[:, :2].mean(axis=0), rng.uniform(0.5, 2) * span
        limits = (Limits(fixed_pivot=box(middle - reach, middle + reach)),)
    return Task(Displacement.from_poses(poses), limits=limits)


def said(found):
    """What is said of a linkage: verdict, kinds of defects and violations, type."""
    kinds = [sorted(each.kind for each in some) for some in (found.defects, found.violations)]
    return found.usable, *kinds, found.type


def differences(task: Task) -> list[str]:
    """What differs between synthesis and judgement, a line for each linkage; [] is right."""
    out, span = [], float(np.linalg.norm(np.ptp(task.poses.translation, axis=0)))
    for found in synthesize(task).linkages:
        own = judge_linkage(task, found.linkage).linkages[0]
        one, other = said(found), said(own)
        errors = [
            (float(e.error.worst) / span, float(np.nan_to_num(e.error.angle, nan=np.inf).max()))
            for e in (found, own)
        ]
        alike = np.isclose(*errors, rtol=0, atol=SAME_ERROR, equal_nan=True).all()
        if one != other or not alike:
            out.append(f"{found.id}: {one} {errors[0]}, judged {other} {errors[1]}")
    return out


def main() -> int:
    """The campaign."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    start, told = time.process_time(), Counter()
    for number in range(options.count):
        wrong = differences(noisy_task(number, options.seed))
        told["tasks"] += 1
        told["with differences"] += bool(wrong)
        for line in wrong:
            print(f"task {number}: {line}", flush=True)
    seconds = time.process_time() - start
    print(f"{told['tasks']} tasks, {told['with differences']} with differences, {seconds:.0f} s")
    return int(bool(told["with differences"]))


if __name__ == "__main__":
    sys.exit(main())
