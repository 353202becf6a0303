"""Paths of many points: what they take beside what 200 take, and how near the answer is.

    .venv/bin/python -m benchmarks.large_paths [--count 3] [--seed 0] [--points 200 1000 100000]

Points lie around closed curves of random crank-driven linkages, with noise.  Told are the seconds
of the processor, their ratio to those of the first number of points, and how far the nearest
linkage is from the curve that was drawn (the noise is not in it), in percent of its size.
"""

import argparse
from time import process_time

import numpy as np
from tests.oracles.coupler_curves import distances, dyads_of, random_crank, traced

from burmester.geometry.displacement import Displacement
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.traced_path import TracedPath

NOISE = 0.01  # of the root mean square size
CHECKED = 60  # places of the drawn curve that are looked at


def drawn(rng, count):
    """A closed curve without noise and with it, as points (count, 2)."""
    z, side = random_crank(rng)
    curve = traced(dyads_of(z), side, np.linspace(0, 2 * np.pi, count, endpoint=False))
    noise = NOISE * np.sqrt(np.var(curve)) * (rng.normal(size=count) + 1j * rng.normal(size=count))
    return (np.column_stack([each.real, each.imag]) for each in (curve, curve + noise))


def main():
    """Print a line for each path."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--points", type=int, nargs="*", default=[200, 1000, 100_000])
    asked = parser.parse_args()
    synthesize(_task(next(drawn(np.random.default_rng(asked.seed), 40))))  # loads what it needs
    for number in range(asked.count):
        first = None
        for count in asked.points:
            curve, points = drawn(np.random.default_rng([asked.seed, number]), count)
            began = process_time()
            found = synthesize(_task(points))
            seconds = process_time() - began
            first = first or seconds
            near = np.nan
            if found.usable:
                nearest = min(found.usable, key=lambda each: each.error.rms).driver_first
                some = curve[:: max(1, count // CHECKED)]
                size = np.linalg.norm(np.ptp(curve, axis=0))
                near = 100 * distances((nearest.first, nearest.second), some).max() / size
            print(
                f"path {number}  {count:7} points  {seconds:6.2f} s  ratio {seconds / first:5.2f}"
                f"  usable {len(found.usable):2}  from the curve {near:.3g} %",
                flush=True,
            )


def _task(points):
    return Task(Displacement(points, np.zeros(len(points))), path=TracedPath(closed=True))


if __name__ == "__main__":
    main()
