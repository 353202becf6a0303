"""Tasks with one wrong pose, and tasks without: how often the right one is named.

`python -m benchmarks.odd_pose 200 1` makes so many tasks of each kind from a seed and counts:

wrong: poses on a linkage with noise of 1e-4 to 1e-3 of their span (and as many radians), and one
    pose more than 20 standard deviations off in x, y, angle or all, and as far from the linkage's
    motion: along it nobody can tell.
noisy: the same without the wrong pose; rough: poses on no linkage.
unit: noisy tasks with the lengths of one pose 10, 25.4 or 1000 times too large or too small.
swapped: noisy tasks in order, with two poses exchanged that are not neighbours; ordered: without.
"""

import sys
from collections import Counter
from typing import NamedTuple

import numpy as np
from tests.oracles.witness import places, random_four_bar, random_poses, span

from burmester import Displacement, Task
from burmester.diagnosis.checks import swapped_poses
from burmester.diagnosis.odd_pose import odd_pose
from burmester.fourbar.dyad import PR, RP, RR

WRONG = 20.0  # standard deviations, at least
FACTORS = (10.0, 25.4, 1000.0, 1 / 10.0, 1 / 25.4, 1 / 1000.0)
SWEEP = 20001


class Made(NamedTuple):
    """A task, the pose that is wrong, by what, and the dyads that it was made from."""

    task: Task
    wrong: int | None
    factor: float = 1.0
    dyads: tuple = ()


def of_linkage(rng, count, ordered=False):
    """Poses (count, 3) on a random linkage with noise, its standard deviations (3,), and dyads."""
    second = (RR, RR, RR, PR, RP)[rng.integers(5)]
    size = 0.0
    while size < 0.2:
        dyads = random_four_bar(rng, second)
        rows = random_poses(dyads, rng, count, ordered=ordered)
        size = span(rows)
    sigma = 10 ** rng.uniform(-4, -3) * size * np.array([1.0, 1.0, 1 / size])
    return rows + sigma * rng.normal(size=rows.shape), sigma, dyads


def away(dyads, row, sigma):
    """How far a pose is from the motion of two dyads, in standard deviations: a fine sweep."""
    where, phi = places(*dyads, np.linspace(-np.pi, np.pi, SWEEP))
    gap = where - row[0] - 1j * row[1]
    turn = np.angle(np.exp(1j * (phi - row[2])))
    return float(np.nanmin(np.hypot(np.abs(gap) / sigma[0], turn / sigma[2])))


def wrong(rng, count):
    """One pose off."""
    while True:
        rows, sigma, dyads = of_linkage(rng, count)
        pose = int(rng.integers(count))
        off = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]])[rng.integers(4)]
        size = WRONG * 10 ** rng.uniform(0, 1)
        rows[pose] += size * off * sigma * rng.choice([-1, 1], 3)
        if away(dyads, rows[pose], sigma) > WRONG:
            return Made(Task(Displacement.from_poses(rows)), pose, dyads=tuple(dyads))


def noisy(rng, count):
    """All poses right."""
    rows, _, dyads = of_linkage(rng, count)
    return Made(Task(Displacement.from_poses(rows)), None, dyads=tuple(dyads))


def rough(rng, count):
    """Poses on no linkage."""
    rows = np.column_stack([rng.normal(size=(count, 2)), rng.uniform(-1.5, 1.5, count)])
    return Made(Task(Displacement.from_poses(rows)), None)


def unit(rng, count):
    """One pose in another unit of length."""
    while True:
        rows, sigma, dyads = of_linkage(rng, count)
        pose, factor = int(rng.integers(count)), float(FACTORS[rng.integers(len(FACTORS))])
        rows[pose, :2] *= factor
        if away(dyads, rows[pose], sigma) > WRONG:
            return Made(Task(Displacement.from_poses(rows)), pose, factor, tuple(dyads))


def ordered(rng, count):
    """In the order in which the first dyad meets them."""
    rows, _, dyads = of_linkage(rng, count, ordered=True)
    return Made(Task(Displacement.from_poses(rows)), None, dyads=tuple(dyads))


def swapped(rng, count):
    """The same, with two poses exchanged that are no neighbours; and which."""
    rows, _, dyads = of_linkage(rng, count, ordered=True)
    first, second = 0, 0
    while second - first < 2:
        first, second = sorted(int(k) for k in rng.choice(count, 2, replace=False))
    rows[[first, second]] = rows[[second, first]]
    return Made(Task(Displacement.from_poses(rows)), None, dyads=tuple(dyads)), (first, second)


KINDS = {"wrong": wrong, "noisy": noisy, "rough": rough, "unit": unit}


def counted(kind, number, seed, *, least=8, most=15, top=False):
    """Of so many tasks of a kind, by their number of poses: named right, wrong, and not at all.

    top: where nothing is said, whether the likeliest pose would be the right one.  With them, how
    often the factor of a unit was told.
    """
    found, told = Counter(), 0
    for index in range(number):
        rng = np.random.default_rng([seed, index])
        count = int(rng.integers(least, most + 1))
        made = KINDS[kind](rng, count)
        odd = odd_pose(made.task)
        if odd is None:
            what = "silent"
            if top and made.wrong is not None:
                likeliest = odd_pose(made.task, false_alarm_chance=1.0)
                right = likeliest is not None and likeliest.pose == made.wrong
                what = "silent, but right" if right else "silent, else wrong"
        elif odd.pose == made.wrong:
            what = "right"
            told += any(
                each.kind == "unit" and abs(each.factor * made.factor - 1) < 1e-9
                for each in odd.repairs[:1]
            )
        else:
            what = "among others" if made.wrong in odd.others else "wrong"
        found[count, what] += 1
    return found, told


def counted_orders(number, seed):
    """Of so many ordered and swapped tasks how many are said to be out of order, and how."""
    found = Counter()
    for index in range(number):
        rng = np.random.default_rng([seed, index])
        made = ordered(rng, int(rng.integers(6, 16)))
        found["ordered: " + ("silent" if swapped_poses(made.task) is None else "wrong")] += 1
        made, pair = swapped(rng, int(rng.integers(6, 16)))
        said = swapped_poses(made.task)
        what = "silent" if said is None else "wrong"
        if said is not None and (said.first, said.second) == pair:
            what = "right"
        found["swapped: " + what] += 1
    return found


def main(number, seed, *kinds):
    """Count and print."""
    for kind in kinds or (*KINDS, "order"):
        if kind == "order":
            print(dict(counted_orders(int(number), int(seed))))
            continue
        most = 12 if kind == "rough" else 15
        found, told = counted(kind, int(number), int(seed), most=most, top=True)
        total = Counter()
        for (_, what), times in found.items():
            total[what] += times
        print(kind, dict(total), *([f"factor told {told}"] if kind == "unit" else []))
        for count in sorted({count for count, _ in found}):
            print("  N =", count, {w: t for (n, w), t in sorted(found.items()) if n == count})


if __name__ == "__main__":
    main(*sys.argv[1:])
