"""Is every locally best dyad found?  Random tasks, held against many random starts.

    python -m benchmarks.critical_points --tasks 2000 --starts 300 --seed 1

A task is 5 to 30 poses, wild ones or those of a random four-bar with noise of nothing to a tenth
of its size, with wild offsets and units.  Each is solved by `critical_dyads` and `best_dyads` (6
poses or more), and by Levenberg and Marquardt from random starts (NumPy, all starts at once, no
code of the package), for the squared residual and for the true distance.
Exit code 1 if a start ended lower than the best dyad listed, or at a minimum of the squared
residual that is not listed although all 25 points were accounted for.
"""

import argparse
import sys
import time

import numpy as np
from tests.oracles.random_starts import distance, local_fits, squared
from tests.oracles.witness import random_four_bar, random_poses

from burmester import Displacement, best_dyads, critical_dyads
from burmester.dyads.sliders import fixed_lines, moving_lines


def random_task(rng):
    """Rows x, y, angle, with the unit and the shift that make them handy again."""
    count = int(rng.integers(5, 31))
    if rng.random() < 0.5:
        rows = rng.normal(size=(count, 3)) * [1, 1, 10 ** rng.uniform(-1, 0.5)]
    else:
        rows = random_poses(random_four_bar(rng), rng, count)
        rows = rows + rng.choice([0, 1]) * 10 ** rng.uniform(-6, -1) * rng.normal(size=rows.shape)
    unit, shift = 10 ** rng.uniform(-6, 6), 10 ** rng.uniform(0, 3) * rng.normal(size=2)
    rows[:, :2] = (rows[:, :2] + shift) * unit
    return rows, unit, shift


def near_one(ends, listed):
    """Which end (k, 4) is at which minimum listed (n, 4)."""
    gap = np.abs(listed - ends[:, None]).max(axis=2)
    return gap < 1e-2 * (1 + np.abs(ends).max(axis=1, keepdims=True))


def lower(theirs, ours):
    """Whether an rms error is lower than ours by more than rounding."""
    return theirs < ours * (1 - 1e-6) - 1e-12


def judged(rows, unit, shift, starts, seed):
    """What the starts have to say of one task: a dictionary of yes and no, and counts."""
    poses = Displacement.from_poses(rows)
    found = critical_dyads(poses)
    # The other solver gets the task in a handy unit and place.
    d = (rows[:, 0] + 1j * rows[:, 1]) / unit - complex(*shift)
    t = np.exp(1j * rows[:, 2])
    x = np.random.default_rng(seed).normal(scale=3, size=(starts, 4))
    ends, rms = local_fits(squared, x, d, t)
    listed = np.column_stack(
        [found.dyads.fixed_pivot / unit - shift, found.dyads.moving_pivot / unit]
    )[found.minimum]
    reached = near_one(ends, listed)
    ours, best = found.residual[0] / unit**2, rms.min(initial=np.inf)
    result = {
        "found": int(found.found),
        "at infinity": int(found.at_infinity),
        "charts": int(found.charts),
        "lower": lower(best, ours),
        "best missed": lower(ours, best),
        "some missed": not reached.any(axis=0).all(),
        "ends unlisted": int((~reached.any(axis=1)).sum()),
        "ends": len(ends),
    }
    if len(rows) > 5:
        fit = best_dyads(poses)
        _, rms = local_fits(distance, x, d, t)
        ours, best = fit.rms_error.min(initial=np.inf) / unit, rms.min(initial=np.inf)
        x = found.points[: found.found].real * float(found.frames.length)
        origin = np.concatenate([found.frames.fixed_origin, found.frames.moving_origin])
        _, from_all = local_fits(distance, (x + origin) / unit - [*shift, 0, 0], d, t)
        slider = min(fixed_lines(poses)[1][0], moving_lines(poses)[1][0]) / unit
        result |= {
            "lower by distance": lower(best, ours),
            "lower than sliders, too": lower(best, min(ours, slider)),
            "lower than from all": lower(best, from_all.min(initial=np.inf)),
            "best missed by distance": lower(ours, best),
        }
    return result


def main():
    """Run the campaign and say what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    for name, value in (("--tasks", 500), ("--starts", 300), ("--seed", 0)):
        parser.add_argument(name, type=int, default=value)
    given = parser.parse_args()
    rng, start, results = np.random.default_rng(given.seed), time.perf_counter(), []
    for k in range(given.tasks):
        task = random_task(rng)
        results.append(judged(*task, given.starts, [given.seed, k]))
        if results[-1]["lower"] or results[-1].get("lower by distance"):
            print(f"task {k}, {len(task[0])} poses: {results[-1]}", flush=True)

    def total(key):
        return sum(result.get(key, 0) for result in results)

    found = np.array([result["found"] for result in results])
    far = np.array([result["at infinity"] for result in results])
    six = sum("lower by distance" in result for result in results)
    print(f"{given.tasks} tasks, {given.starts} starts each, seed {given.seed}", end=", ")
    print(f"{time.perf_counter() - start:.0f} s")
    print(f"all 25 critical points found in {(found == 25).sum()}; fewest {found.min()}", end="; ")
    print(f"accounted for with those at infinity in {(found + far == 25).sum()}")
    print(f"more than one chart needed in {sum(r['charts'] > 1 for r in results)}")
    print("squared residual:")
    print(f"  a start ended lower than the best dyad listed: {total('lower')}")
    print(f"  no start reached the best dyad listed: {total('best missed')}")
    print(f"  the starts missed a minimum that is listed: {total('some missed')} tasks")
    print(f"  {total('ends unlisted')} of {total('ends')} ends away from every minimum listed")
    print(f"true distance, {six} tasks of 6 poses or more:")
    print(
        f"  a start ended lower than the best dyad listed: {total('lower by distance')}", end="; "
    )
    print(f"lower than the best slider, too: {total('lower than sliders, too')}")
    print(f"  lower than from all 25 points (real parts): {total('lower than from all')}")
    print(f"  no start reached the best dyad listed: {total('best missed by distance')}")
    unlisted = any(r["ends unlisted"] and r["found"] == 25 for r in results)
    return int(bool(total("lower") or total("lower than sliders, too") or unlisted))


if __name__ == "__main__":
    sys.exit(main())
