"""Are two-slider motions recognised, and general ones not taken for them?

    nice python -m benchmarks.two_slider_motions --count 200 --seed 0

For each turn of the body and each number of decimals (of x and y in units of about the radius, and
of the angle in radians): `count` planted two-slider motions, `count` inverted ones, and four times
as many motions of random four-bars (RR-RR, RR-PR, RR-RP), of 5 to 12 poses, in random frames.  The
table tells how many percent of the planted ones are recognised as what they are, and how many
percent of the general ones are called two sliders.  Of each cell 3 planted motions of either sort
are synthesised: how many of them have a usable linkage, and by how many degrees the best one of
the pairs of sliders offered transmits worse than the best of all pairs (brute force).
"""

import argparse

import numpy as np
from tests.oracles.two_slider_motions import best_pair, general, planted, printed

from burmester import synthesize
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_kinds import TwoSliders
from burmester.tasks.motion_task import Task

TURNS = (20, 40, 60, 90, 120, 150, 180)  # degrees
DECIMALS = (2, 3, 4, 5, 6, 8, 16)
SYNTHESISED = 3


def task_of(rows, decimals):
    rows, resolution = printed(rows, decimals) if decimals < 16 else (rows, (0.0, 0.0))
    return Task(Displacement.from_poses(rows), resolution=resolution)


def recognised(seed, turn, decimals, count):
    """The shares (3,) told as two sliders: of such motions, of inverted ones, of general ones.

    Of `count` two-slider motions, `count` inverted ones and 4 `count` general ones.
    """
    rng = np.random.default_rng([seed, turn, decimals])
    hits = np.zeros(3)
    for sort in range(3):
        times = 4 * count if sort == 2 else count
        for _ in range(times):
            n, angle = int(rng.integers(5, 13)), np.radians(turn)
            rows = general(rng, n, angle) if sort == 2 else planted(rng, n, angle, sort == 1)
            kind = classify_motion(task_of(rows, decimals)).kind
            told = isinstance(kind, TwoSliders)
            hits[sort] += told and (sort == 2 or kind.inverse == (sort == 1))
        hits[sort] /= times
    return hits


def offered(seed, turn, decimals, inverted):
    """Of a planted motion: the best least transmission angle of a pair of sliders that works.

    Radians; None where the motion is not recognised, 0 where no pair works.
    """
    rng = np.random.default_rng([seed, turn, decimals, inverted])
    rows = planted(rng, int(rng.integers(5, 13)), np.radians(turn), inverted)
    task = task_of(rows, decimals)
    if not isinstance(classify_motion(task).kind, TwoSliders):
        return None
    result = synthesize(task)
    least = [
        each.driven.least_over_range
        for each in result.usable
        if not any(isinstance(dyad.dyad, RR) for dyad in each.dyads)
    ]
    return max(least, default=0.0)


def main():
    """Run the campaign and print its tables."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    print("percent: two sliders / inverted told as such / general ones taken for either")
    print("| turn | " + " | ".join(f"{each} decimals" for each in DECIMALS) + " |")
    print("|--:|" + "--:|" * len(DECIMALS))
    for turn in TURNS:
        cells = []
        for decimals in DECIMALS:
            shares = recognised(given.seed, turn, decimals, given.count)
            cells.append(" / ".join(f"{100 * share:.3g}" for share in shares))
        print(f"| {turn}° | " + " | ".join(cells) + " |", flush=True)
    print()
    for inverted in (False, True):
        worse, works, every = [], 0, 0
        for turn in TURNS:
            best = np.pi / 2 if inverted else best_pair(np.radians(turn))
            for decimals in DECIMALS:
                for number in range(SYNTHESISED):
                    least = offered(given.seed + 1000 * number, turn, decimals, inverted)
                    if least is not None and best > np.radians(1):
                        every, works = every + 1, works + (least > 0)
                        worse.append(np.degrees(best - least))
        name = "inverted" if inverted else "two sliders"
        print(f"{name}: {every} recognised with pairs that work, {works} offered one that works;")
        print(f"  degrees worse than the best pair: median {np.median(worse):.3f}, ", end="")
        print(f"greatest {max(worse):.3f}")


if __name__ == "__main__":
    main()
