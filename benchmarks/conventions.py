"""Files in another convention, and files that are right: how often a convention is named.

`python -m benchmarks.conventions --clean 2000 --wrong 400 --seed 1` makes so many tasks and counts.

clean: right poses of many kinds: on linkages with noise of none to 1e-2 of their span, printed with
    two to six decimals or not at all; smooth motions by hand, that no linkage makes; the same with
    small turns, or hardly any; poses anywhere; special motions; poses of the cases and templates.
wrong: 8 to 20 poses on a linkage, with noise or rounded, read in another convention.  Only those
    count that determine it: read wrongly and without noise, they miss the nearest linkage by over
    60 times the noise.
"""

import argparse
import math
from collections import Counter

import numpy as np
from tests.oracles.witness import random_four_bar, random_poses, span

from burmester import Displacement, Task, read_task
from burmester.diagnosis.conventions import AS_READ, Comparison, other_convention
from burmester.fourbar.dyad import PR, RP, RR
from burmester.io import cases
from burmester.tasks.motion_class import classify_motion

LEAST_MISFIT = 60.0  # times the noise; a wrong reading that misses less is not determined
CONVENTIONS = ("clockwise", "y-down", "swap-xy", "radians", "radians and clockwise", "degrees")


def of_linkage(rng, count):
    """Poses (count, 3) on a linkage of any kind without noise, their span 100, and in order or not.

    Angles go on from pose to pose where they are in order, as a person writes them.
    """
    size, second = 0.0, (RR, RR, RR, PR, RP)[rng.integers(5)]
    ordered = bool(rng.random() < 0.7)
    while size < 0.2:
        rows = random_poses(random_four_bar(rng, second), rng, count, ordered=ordered)
        size = span(rows)
    rows = rows * [100 / size, 100 / size, 1.0]
    if ordered:
        rows[:, 2] = np.unwrap(rows[:, 2])
    return rows


def task_of(rows, decimals=None):
    """A task of rows with angles in degrees, rounded to decimals, whose resolution it knows."""
    if decimals is None:
        return Task.from_rows(rows, angle_unit="deg")
    half = 0.5 * 10.0**-decimals
    rows = np.round(rows, decimals)
    poses = Displacement.from_poses(rows * [1, 1, math.pi / 180])
    return Task(poses, resolution=(half, math.radians(half)))


def degrees(rows):
    return rows * [1, 1, 180 / math.pi]


def noisy(rng, count):
    rows = of_linkage(rng, count)
    level = 0.0 if rng.random() < 0.2 else 10 ** rng.uniform(-6, -2)
    rows = rows + level * rng.normal(size=rows.shape) * [100, 100, 1]
    decimals = None if rng.random() < 0.3 else int(rng.integers(2, 7))
    return task_of(degrees(rows), decimals)


def by_hand(rng, count, most=90.0):
    """A smooth motion: polynomials or sums of sines."""
    t, terms, columns = np.linspace(-1, 1, count), int(rng.integers(1, 5)), []
    for _ in range(3):
        share = rng.normal(size=terms + 1)
        if rng.random() < 0.5:
            columns.append(np.polynomial.chebyshev.chebval(t, share))
        else:
            turns = [np.sin((k + 1) * t * rng.uniform(0.5, 2) + rng.uniform(0, 6)) for k in
                     range(terms)]  # fmt: skip
            columns.append(sum(each * s for each, s in zip(turns, share, strict=False)))
    rows = np.column_stack(columns) * [50, 50, 1]
    rows[:, 2] *= most / max(np.ptp(rows[:, 2]), 1e-9) * 10 ** rng.uniform(-0.7, 0.3)
    return task_of(rows, None if rng.random() < 0.5 else int(rng.integers(0, 4)))


def small_turns(rng, count):
    return by_hand(rng, count, 8.0)


def hardly_turning(rng, count):
    return by_hand(rng, count, 0.5)


def anywhere(rng, count):
    rows = np.column_stack([100 * rng.normal(size=(count, 2)), rng.uniform(-180, 180, count)])
    return task_of(rows, None if rng.random() < 0.5 else int(rng.integers(0, 3)))


def special(rng, count):
    """A turn about a point, a translation on a circle, an ellipse's trammel, a straight line."""
    t = np.sort(rng.uniform(-2, 2, count))
    turn, r = np.degrees(t), 50 * np.column_stack([np.cos(t), np.sin(t)])
    still, line = np.full(count, 20.0), np.column_stack([40 * t, 10 * t])
    made = ((r, turn), (r, still), (r * [1, 0.4], turn), (line, turn), (r, -turn), (line, still))
    places, angles = made[rng.integers(len(made))]
    level = 0.0 if rng.random() < 0.3 else 10 ** rng.uniform(-5, -2)
    rows = np.column_stack([places, angles])
    rows = rows + level * rng.normal(size=rows.shape) * [50, 50, 57]
    return task_of(rows, None if rng.random() < 0.3 else int(rng.integers(1, 5)))


def carried(rng, count):
    """The poses of a case of the package, all or some of them, a little displaced."""
    names = cases.names()
    while True:
        try:
            task = read_task(f"case:{names[rng.integers(len(names))]}")
        except Exception:  # a function, a path
            continue
        if task.path is None and task.tolerances is None and task.poses.shape[0] > 6:
            break
    rows = np.column_stack([task.poses.translation, task.poses.angle])
    keep = np.sort(rng.permutation(len(rows))[: max(7, count)])
    rows = rows[keep] + 10 ** rng.uniform(-5, -2) * rng.normal(size=(len(keep), 3)) * span(rows)
    return Task(Displacement.from_poses(rows), resolution=task.resolution)


CLEAN = (noisy, noisy, noisy, by_hand, small_turns, hardly_turning, anywhere, special, carried)


def read_wrongly(rows, how):
    """The rows (radians) as they are read, and what `other_convention` has to say of it."""
    rows, names = np.array(rows), ()
    if how == "y-down":
        rows[:, 1] *= -1
    if how == "swap-xy":
        rows[:, :2] = rows[:, 1::-1]
    if "clockwise" in how:
        rows[:, 2] *= -1
    if how in ("clockwise", "y-down", "swap-xy", "radians and clockwise"):
        names = ("clockwise",)
    if "radians" in how:
        rows[:, 2] = np.radians(rows[:, 2])
        names = (*names, "radians")
    if how == "degrees":
        rows[:, 2] = np.degrees(rows[:, 2])
        names = ("degrees",)
    return rows, names


def misfit(rows, how):
    """How far poses read wrongly are from the nearest linkage, in the poses' extent."""
    rows, names = read_wrongly(rows, how)
    compared = Comparison(Displacement.from_poses(rows), None, 0.0, 0.0)
    ratio = math.pi / 180 if "radians" in names else 1.0
    return compared.least_error(AS_READ, ratio)


def wrong(rng, how):
    """A task that determines its convention, and the names to be told."""
    while True:
        count = int(rng.integers(8, 21))
        rows = of_linkage(rng, count)
        if how == "degrees" and np.abs(np.degrees(rows[:, 2])).max() < 10:
            continue
        if "radians" in how and np.abs(rows[:, 2]).max() > 6.9:
            continue
        level = 10 ** rng.uniform(-6, -3.5)
        if misfit(rows, how) < LEAST_MISFIT * level:
            continue
        # The same level in extents, which are some 0.6 of the span: the noise is less than it.
        rows = rows + 0.6 * level * rng.normal(size=rows.shape) * [100, 100, 1]
        read, names = read_wrongly(rows, how)
        resolution = (0.0, 0.0)
        if rng.random() < 0.5:  # rounded as finely
            half = 0.6 * level * math.sqrt(3)
            places = 2 * half * 100
            read[:, :2] = np.round(read[:, :2] / places) * places
            resolution = (half * 100, 0.0)
        return Task(Displacement.from_poses(read), resolution=resolution), names


def told(task):
    """The names of the convention that is told, () for none."""
    found = other_convention(task, classify_motion(task))
    return () if found is None else found.names


def counted_clean(number, seed):
    """How many of so many clean tasks get a name, by kind: all, told."""
    every, wrongly = Counter(), Counter()
    for index in range(number):
        rng = np.random.default_rng([seed, index])
        kind = CLEAN[index % len(CLEAN)]
        task = kind(rng, int(rng.integers(7, 25)))
        every[kind.__name__] += 1
        if names := told(task):
            wrongly[kind.__name__] += 1
            print("  ", kind.__name__, index, names, task.poses.shape[0])
    return every, wrongly


def counted_wrong(number, seed):
    """How many of so many wrong tasks are told, by convention: all, told rightly, told wrongly."""
    every, right, others = Counter(), Counter(), Counter()
    for index in range(number):
        how = CONVENTIONS[index % len(CONVENTIONS)]
        task, names = wrong(np.random.default_rng([seed, 7, index]), how)
        found = told(task)
        every[how] += 1
        right[how] += found == names
        others[how] += found not in ((), names)
    return every, right, others


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clean", type=int, default=2000)
    parser.add_argument("--wrong", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    every, wrongly = counted_clean(given.clean, given.seed)
    for kind in every:
        print(f"{kind:24}{every[kind]:6} clean, {wrongly[kind]} told to be wrong")
    print(f"{'clean':24}{every.total():6}, {wrongly.total()} told to be wrong")
    every, right, others = counted_wrong(given.wrong, given.seed)
    for how in every:
        print(f"{how:24}{every[how]:6} wrong, {right[how]} told, {others[how]} told otherwise")
    print(f"{'wrong':24}{every.total():6}, {right.total()} told, {others.total()} told otherwise")


if __name__ == "__main__":
    main()
