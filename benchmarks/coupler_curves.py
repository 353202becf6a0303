"""How many points of coupler curves a second, in one call?

    python -m benchmarks.coupler_curves --linkages 20000 --points 360

Random linkages of every pair of dyads, all their circuits, one coupler point each.  A call finds
the circuits too.  The best of five calls counts; hold NumPy to one thread (OMP_NUM_THREADS=1),
though nothing here calls its linear algebra.  The goal is 10 million points a second on one core.
"""

import argparse
import time
from itertools import product

import numpy as np

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage


def dyads(kind, rng, count):
    """Random dyads (count,) of a kind."""
    pivots, angle = rng.normal(size=(2, count, 2)), rng.uniform(-np.pi, np.pi, count)
    if kind is RR:
        return RR(*pivots, rng.uniform(0.2, 2.5, count))
    if kind is PR:
        return PR(angle, rng.normal(size=count), pivots[0])
    return RP(pivots[0], angle, rng.normal(size=count))


def main():
    """Print the rate for each pair."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--linkages", type=int, default=20_000)
    parser.add_argument("--points", type=int, default=360, help="of a circuit")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    parameter = np.linspace(0, 2 * np.pi, given.points, endpoint=False)
    for first, second in product((RR, PR, RP), repeat=2):
        linkage = Linkage(
            dyads(first, rng, given.linkages),
            dyads(second, rng, given.linkages),
        )
        point, took = rng.normal(size=(given.linkages, 1, 2)), []
        for _ in range(5):
            begun = time.perf_counter()
            circuits = Circuits.of(linkage)
            there = circuits.exists
            circuits[there].curve(np.broadcast_to(point, (*there.shape, 2))[there], parameter)
            took.append(time.perf_counter() - begun)
        points = there.sum() * given.points
        print(
            f"{first.__name__}-{second.__name__}: {points / 1e6:.1f} million points, "
            f"{points / min(took) / 1e6:.1f} million a second"
        )


if __name__ == "__main__":
    main()
