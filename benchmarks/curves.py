"""Paths to trace: what the search misses, beside longer searches and random starts of SciPy.

Run it from the project's root: python -m benchmarks.curves --count 8 --seed 0

Closed paths of 40 points and open ones of 15, traced by random cranks, with noise of 1 % of their
radius of gyration.  The nearest linkage is looked for as `burmester synthesize` does; then from all
curves of the atlas with three times as many steps; then from the linkage that made the path, by
SciPy with other code.  Printed are seconds and root mean square distances, relative to the noise;
and the processor time of the whole answer, from the points to the judged front.
"""

import argparse
import time

import numpy as np
from tests.oracles.coupler_curves import dyads_of, random_crank, refined_from, traced

from burmester.curves import path_fit
from burmester.geometry.displacement import Displacement
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.traced_path import TracedPath

NOISE = 0.01
LONGER = {
    "STARTS": 8000,
    "OPEN_STARTS": 8000,
    "OPEN_WORK": 1_000_000,
    "ROUNDS": ((20, 3 / 8), (60, 1 / 8), (300, 1 / 50)),
}


def path(rng, closed):
    """Points of a random linkage's curve with noise, and the linkage with its crank angles."""
    z, side = random_crank(rng)
    t = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    if not closed:
        t = rng.uniform(0, 2 * np.pi) + np.linspace(0, rng.uniform(1.5, 4), 15)
    z = z / np.sqrt(np.var(traced(dyads_of(z), side, t)))
    p = traced(dyads_of(z), side, t)
    p = p + NOISE * (rng.normal(size=len(t)) + 1j * rng.normal(size=len(t)))
    return np.column_stack([p.real, p.imag]), z, side, t


def solved(points, closed, **settings):
    """Seconds and the least sum of squares, with other settings of the search."""
    usual = {name: getattr(path_fit, name) for name in settings}
    for name, value in settings.items():
        setattr(path_fit, name, value)
    start = time.process_time()
    cost = path_fit.PathSearch.of(points, closed=closed).nearest().cost[0]
    seconds = time.process_time() - start
    for name, value in usual.items():
        setattr(path_fit, name, value)
    return seconds, cost


def answered(points, closed):
    """Seconds of the whole answer, the less of two runs."""
    poses = Displacement(points, np.zeros(len(points)))
    task, seconds = Task(poses, path=TracedPath(closed=closed)), []
    for _ in range(2):
        start = time.process_time()
        synthesize(task)
        seconds.append(time.process_time() - start)
    return min(seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=8)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    print("path         whole  seconds  rms/noise   longer search   from the maker   ")
    for closed in (True, False):
        lost, whole = 0, []
        for number in range(given.count):
            rng = np.random.default_rng([given.seed, number, closed])
            points, z, side, t = path(rng, closed)
            whole.append(answered(points, closed))
            seconds, cost = solved(points, closed)
            more, best = solved(points, closed, **LONGER)
            made = refined_from(z, side, t, points)
            least = min(best, made)
            rms = [np.sqrt(each / len(points)) / NOISE for each in (cost, best, made)]
            lost += cost > 1.01 * least
            kind = "closed" if closed else "open"
            print(
                f"{kind:6} {number:3} {whole[-1]:8.2f} {seconds:8.2f} "
                f"{rms[0]:10.4f} {rms[1]:10.4f} ({more:4.1f} s) "
                f"{rms[2]:10.4f} {'' if cost <= 1.01 * least else 'missed'}"
            )
        kind, found = "closed" if closed else "open", given.count - lost
        print(f"{kind}: {found} of {given.count} best found; the whole answer takes")
        print(f"    {np.median(whole):.2f} s in the median, {max(whole):.2f} s at most")


if __name__ == "__main__":
    main()
