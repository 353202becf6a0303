"""The spread of linkages built within a tolerance, held against linkages built by brute force.

    python -m benchmarks.tolerances --count 50 --seed 0 [--draws 500]

Random four-bars and five poses that they meet on one circuit, in order; every second one has a
crank of two to six tolerances and often poses near dead points.  Tolerances are 0.02, 0.05 and 0.1,
and links about 1.
`tests/oracles/built.py` builds other linkages within the tolerance and drives them crank angle by
crank angle.  Counted for what `spread` tells, and for first order: the share of the linkages that
can be assembled within the 95 % value, which should be 0.95; and whether a linkage worse than the
greatest error exists: by the draws and by an ascent over corners, both driven by brute force.
"""

import argparse
from itertools import product
from typing import NamedTuple

import numpy as np
from tests.oracles.built import built, greatest_error
from tests.oracles.witness import places, random_four_bar, random_poses

from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.verdicts.tolerances import sensitivity, spread

CORNERS = np.array(list(product((-1.0, 1.0), repeat=10)))
WORSE = 1.05  # times the greatest error that is told; a linkage beyond breaks it
HELD = "covered", "worst"  # fields of a row: as told, and to first order
CLIMBS = 3  # ascents over corners, from the worst linkages drawn


class Row(NamedTuple):
    """What is told of a linkage, and what brute force finds.

    covered: shares of the linkages within the 95 % values, as told and to first order; worst: the
    greatest error found by brute force, over the one as told and over the one to first order.
    """

    short: bool
    monte_carlo: bool
    covered: tuple[float, float]
    worst: tuple[float, float]
    lost: tuple[float, float]


def linkage(rng, tolerance, short):
    """A four-bar and poses (5, 3) that it meets."""
    while True:
        dyads = random_four_bar(rng)
        if short:
            radius = rng.uniform(2, 6) * tolerance
            dyads[0] = RR(dyads[0].fixed_pivot, dyads[0].moving_pivot, radius)
        where, _ = places(*dyads, np.linspace(-np.pi, np.pi, 181))
        if np.isfinite(where[0]).mean() > 0.2:
            return dyads, random_poses(dyads, rng, 5, side=0, ordered=True)


def row(rng, short, draws):
    """One linkage."""
    tolerance = float(rng.choice([0.02, 0.05, 0.1]))
    dyads, rows = linkage(rng, tolerance, short)
    batch = LinkageBatch.of([Linkage(*dyads)])
    asked = batch, Displacement.from_poses(rows), Displacement.from_poses(rows[None]), 1.0
    told = spread(*asked, tolerance)
    slope = tolerance * sensitivity(*asked)[0]

    def linear(offs):
        return np.linalg.norm(np.einsum("ncj,sj->snc", slope, offs), axis=-1).max(axis=-1)

    def brute(offs):
        return np.array([greatest_error(built(dyads, off, tolerance), rows, 1.0) for off in offs])

    offs = rng.uniform(-1, 1, size=(draws, 10))
    errors = brute(offs)
    there = np.isfinite(errors)
    first = np.percentile(linear(rng.uniform(-1, 1, size=(1000, 10))), 95), linear(CORNERS).max()
    worst = max(
        [errors[there].max(), *(climbed(brute, offs[k]) for k in worst_first(errors)[:CLIMBS])]
    )
    return Row(
        short,
        bool(told.monte_carlo[0]),
        tuple((errors[there] <= value).mean() for value in (told.greatest_95[0], first[0])),
        (worst / told.bound[0], worst / first[1]),
        (1 - there.mean(), float(told.lost[0])),
    )


def worst_first(errors):
    return np.argsort(np.where(np.isfinite(errors), errors, -np.inf))[::-1]


def climbed(brute, off):
    """The greatest error from the corner beside `off` on, one sign at a time."""
    off = np.sign(off)
    best = -np.inf
    while True:
        beside = np.concatenate([off[None], off * (1 - 2 * np.eye(10))])
        errors = brute(beside)
        k = worst_first(errors)[0]
        if not (np.isfinite(errors[k]) and errors[k] > best * (1 + 1e-9)):
            return best
        best, off = errors[k], beside[k]


def rows(count, seed, draws):
    """That many linkages, every second one with a short crank."""
    return [row(np.random.default_rng([seed, k]), bool(k % 2), draws) for k in range(count)]


def show(found):
    """The table, for each kind of linkages."""
    print(
        "| linkages | count | by Monte Carlo | within 95 %: told | first order "
        "| worst found over told | over first order | lost: true, told |"
    )
    print("|---|--:|--:|--:|--:|--:|--:|--:|")
    for name, short in (("random", False), ("short crank", True)):
        some = [each for each in found if each.short == short]
        cells = [name, str(len(some)), str(sum(each.monte_carlo for each in some))]
        for k in (0, 1):
            covered = np.array([each.covered[k] for each in some])
            low, middle, high = np.percentile(covered, [0, 50, 100])
            cells.append(f"{middle:.3f} ({low:.3f} to {high:.3f})")
        for k in (0, 1):
            ratio = np.array([each.worst[k] for each in some])
            cells.append(f"{ratio.max():.2f}; {(ratio > WORSE).sum()} broken")
        lost = np.mean([each.lost for each in some], axis=0)
        cells.append(f"{lost[0]:.3f}, {lost[1]:.3f}")
        print(f"| {' | '.join(cells)} |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--draws", type=int, default=500)
    given = parser.parse_args()
    show(rows(given.count, given.seed, given.draws))
