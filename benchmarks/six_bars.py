"""Random five-pose tasks: for how many no four-bar works, and for how many a six-bar does.

    python -m benchmarks.six_bars --count 100 --seed 1 --chains 2000

Each task is a way that bends at random, with angles that grow.  A four-bar works where it is usable
within a thousandth of a step and 0.05 degrees; a six-bar meets the poses exactly.  The table also
has how many six-bars are sound (the standard of four-bars), and how long a chain takes.
"""

from __future__ import annotations

import argparse
import time

import numpy as np

from burmester.sixbar.six_bars import SixBarOptions
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.six_bars import synthesize_six_bars
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements


def random_task(random: np.random.Generator, spread: float) -> Task:
    """Five poses along a way that bends; spread: of its steps, in mean steps."""
    steps = random.normal([1.0, 0.2], spread, (5, 2)).cumsum(axis=0)
    angles = random.uniform(5, 35, 5).cumsum()
    asked = Requirements(within=1e-3, within_deg=0.05)
    rows = np.column_stack([steps, angles])
    return Task.from_rows(rows, angle_unit="deg", requirements=asked)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--chains", type=int, default=2000)
    parser.add_argument("--kind", default="all")
    parser.add_argument("--spread", type=float, default=0.5)
    given = parser.parse_args()
    random = np.random.default_rng(given.seed)
    options = SixBarOptions(given.chains, given.seed, kind=given.kind)
    four, six, sound, saved, seconds, angles = 0, 0, 0, 0, 0.0, []
    for _ in range(given.count):
        task = random_task(random, given.spread)
        works = bool(synthesize(task).usable)
        begun = time.perf_counter()
        answer = synthesize_six_bars(task, options).six_bars
        seconds += time.perf_counter() - begun
        assert answer is not None
        found = answer.found
        four += works
        six += bool(found)
        saved += bool(found) and not works
        sound += bool(found) and not found[0].shortcomings
        angles.append(np.degrees(found[0].transmission) if found else 0.0)
    count = given.count
    print(
        f"{count} tasks, seed {given.seed}, spread {given.spread:g}, {given.chains} chains a task"
    )
    print(f"a four-bar works within 0.001 and 0.05 deg: {four}")
    print(f"a six-bar works: {six}, a sound one: {sound}")
    print(f"a six-bar works where no four-bar does: {saved} of {count - four}")
    print(f"least transmission angle of the best six-bar, median: {np.median(angles):.0f} deg")
    print(f"{1e3 * seconds / count / given.chains:.3f} ms a chain")


if __name__ == "__main__":
    main()
