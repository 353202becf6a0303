"""Recorded crank-rockers: how near a linkage comes to the motion behind the noise.

    python -m benchmarks.recordings --count 40 --seed 1

Each is a random crank-rocker whose crank turns by most of a turn, with markers on its coupler,
recorded in 200 frames with noise of 0.3 mm in each coordinate (links of 20 to 200 mm) and written
as one of the formats.  Every tenth frame is read, by two markers or three, and a linkage is
synthesized.  It is then driven by a simulator that knows none of this, and compared with the
motion without noise between the first and the last of its poses.
"""

import argparse
import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np
from tests.oracles import recordings
from tests.oracles.recordings import FourBar, recording
from tests.oracles.simulation import driven_either_way

from burmester import read_task, synthesize

NOISE = 0.3
FORMATS = (recordings.nexus, recordings.trc, recordings.tracker, recordings.one_line)


def random_four_bar(rng):
    """A crank-rocker by Grashof, with sound transmission and markers beside the coupler."""
    while True:
        ground, coupler, rocker = rng.uniform(60, 200, 3)
        crank = rng.uniform(20, 60)
        longest, total = max(ground, coupler, rocker), crank + ground + coupler + rocker
        if crank + longest > 0.9 * (total - crank - longest):
            continue
        cosines = [
            (coupler**2 + rocker**2 - d**2) / (2 * coupler * rocker)
            for d in (ground - crank, ground + crank)
        ]
        if max(np.abs(cosines)) < np.cos(np.radians(30)):
            break
    turn = rng.uniform(-np.pi, np.pi)
    pivots = np.array([[0, 0], ground * np.array([np.cos(turn), np.sin(turn)])])
    markers = {
        "M1": tuple(rng.uniform([-0.2, 0.1], [0.3, 0.6]) * coupler),
        "M2": tuple(rng.uniform([0.7, 0.1], [1.2, 0.6]) * coupler),
        "M3": tuple(rng.uniform([0.2, -0.6], [0.8, -0.2]) * coupler),
    }
    return FourBar(pivots, (crank, coupler, rocker), markers)


def farthest(path, places):
    """How far the driven markers M1 and M2 are from where they were, at the worst frame."""
    size = np.hypot(*(places[0, 1] - places[0, 0]))
    direction = np.stack([np.cos(path[:, 2]), np.sin(path[:, 2])], axis=1)
    driven = np.stack([path[:, :2], path[:, :2] + size * direction], axis=1)
    gaps = np.linalg.norm(driven[None] - places[:, None], axis=-1).max(axis=-1)
    return float(gaps.min(axis=1).max())


def campaign(count, seed, folder):
    """For each case its outcome, and the worst distance in millimetres where it was driven."""
    rng = np.random.default_rng(seed)
    for case in range(count):
        linkage = random_four_bar(rng)
        begin = rng.uniform(-np.pi, np.pi)
        turn = (begin, begin + rng.uniform(3.0, 5.5))
        given = {"turn": turn, "linkage": linkage, "seed": int(rng.integers(1 << 30))}
        names, places = recording(noise=NOISE, **given)
        _, true = recording(noise=0.0, **given)
        path = Path(folder, "take.csv")
        path.write_text(FORMATS[case % len(FORMATS)](names, places))
        points = ("M1,M2", "M1,M2,M3")[case // len(FORMATS) % 2]
        task = read_task(path, points=points, every=10)
        usable = synthesize(task).usable
        if not usable:
            yield "none usable", np.nan
            continue
        # Within the noise others may transmit better, and come first.
        closest = min(usable, key=lambda each: each.error.rms)
        met = closest.error.places
        rows = np.column_stack([met.translation, np.unwrap(met.angle)])
        run = driven_either_way(closest.driver_first, rows)
        yield "driven" if run.meets else "stalled", farthest(run.path, true[:191, :2, :2])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        outcomes = list(campaign(options.count, options.seed, folder))
    worst = np.array([distance for name, distance in outcomes if name == "driven"])
    print(dict(Counter(name for name, _ in outcomes)))
    if len(worst):
        print(
            f"farthest from the motion, in {NOISE} mm: median {np.median(worst) / NOISE:.1f}, "
            f"nine of ten {np.quantile(worst, 0.9) / NOISE:.1f}, worst {worst.max() / NOISE:.1f}"
        )
    print(f"{(time.perf_counter() - start) / options.count:.1f} s a case")


if __name__ == "__main__":
    main()
