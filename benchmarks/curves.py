"""Paths to trace: what the search misses, beside longer searches and random starts of SciPy.

Run it from the project's root: python -m benchmarks.curves --count 8 --seed 0

Closed paths of 40 points and open ones of 15, traced by random cranks, with noise of 1 % of their
radius of gyration.  Each is solved as `burmester synthesize` does; then with ten times as many
starts from the atlas and three times as many steps; then from the linkage that made it, by SciPy
with other code.  Printed are seconds and root mean square distances, relative to the noise.
"""

import argparse
import time

import numpy as np
from tests.oracles.coupler_curves import dyads_of, random_crank, refined_from, traced

from burmester.curves import path_fit

NOISE = 0.01
LONGER = {"STARTS": 8000, "ROUNDS": ((20, 3000), (60, 1000), (300, 100))}


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
    start = time.perf_counter()
    cost = path_fit.PathSearch.of(points, closed=closed).nearest().cost[0]
    seconds = time.perf_counter() - start
    for name, value in usual.items():
        setattr(path_fit, name, value)
    return seconds, cost


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=8)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    print("path       seconds  rms/noise   longer search   from the maker   ")
    for closed in (True, False):
        lost = 0
        for number in range(given.count):
            rng = np.random.default_rng([given.seed, number, closed])
            points, z, side, t = path(rng, closed)
            seconds, cost = solved(points, closed)
            more, best = solved(points, closed, **LONGER)
            made = refined_from(z, side, t, points)
            least = min(best, made)
            rms = [np.sqrt(each / len(points)) / NOISE for each in (cost, best, made)]
            lost += cost > 1.01 * least
            kind = "closed" if closed else "open"
            print(
                f"{kind:6} {number:3} {seconds:8.2f} {rms[0]:10.4f} {rms[1]:10.4f} ({more:4.1f} s) "
                f"{rms[2]:10.4f} {'' if cost <= 1.01 * least else 'missed'}"
            )
        print(f"{'closed' if closed else 'open'}: {given.count - lost} of {given.count} best found")


if __name__ == "__main__":
    main()
