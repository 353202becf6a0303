"""Clearance against a dense sweep: the least distance of body and links from keep-out regions.

    python -m benchmarks.clearance --count 10 --frames 100000 --seed 0

Random four-bars (two pins, a slider on the ground, a slot in the body) are driven by code of the
tests' own through a motion of three poses, with a concave outline, links with and without a width
and three concave regions.  Every frame is drawn with Shapely.  The table shows for each what the
sweep finds, by how much the clearance told differs, the error that it allows itself, the clearance
by 36 frames as searches take it, and the time of each.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from tests.oracles.clearance_sweep import Moved, moved_four_bar, random_outline, sweep

from burmester.clearance.least_clearance import Clearance, clearance_between_poses
from burmester.clearance.moving_parts import pairs_of
from burmester.fourbar.defects import judge
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.tasks.surroundings import Surroundings

FEW_FRAMES = 36
TRIES = 30  # of regions, until the least distance is not at an end of the motion
TOUCHING = 0.1  # of regions that touch, the share that is taken


@dataclass(frozen=True)
class Compared:
    """One linkage: what the sweep finds, what is told, and what few frames tell."""

    moved: Moved
    swept: float
    told: Clearance
    by_few: float
    sweep_time: float
    time: float
    there: float  # the distance by the sweep's drawing at the place told


def campaign(count: int, frames: int, seed: int) -> Iterator[Compared]:
    """Linkages compared, as many as asked for."""
    rng = np.random.default_rng(seed)
    done = 0
    while done < count:
        moved = moved_four_bar(rng, frames)
        poses = _places(moved, np.array([0, frames // 2, frames - 1]))
        alone = Linkage(moved.first, moved.second)
        one = Linkage(moved.first[None], moved.second[None])
        verdict = judge(one, poses[None], missed=np.zeros((1, 3)), reach=1e-3, length=30.0)[0]
        if verdict.defects or verdict.first.defects:
            continue
        body = random_outline(rng, 40)
        width = float(rng.choice([0.0, 8.0]))
        regions = _regions(rng, moved, body, width)
        start = time.perf_counter()
        swept = float(sweep(moved, body, regions, width).min())
        middle = time.perf_counter()
        around = Surroundings(tuple(Polygon(each) for each in regions), link_width=width)
        told = clearance_between_poses(alone, verdict.first, Polygon(body), around)
        end = time.perf_counter()
        assert told is not None
        few = _places(moved, np.linspace(0, frames - 1, FEW_FRAMES).astype(int))
        by_few = min(each.distances(few).min() for each in pairs_of(alone, Polygon(body), around))
        there = Moved(moved.first, moved.second, moved.drive[:1], 0)
        there.d = there.d * 0 + complex(*told.place.translation)
        there.phi = there.phi * 0 + float(told.place.angle)
        at = float(sweep(there, body, regions, width)[0])
        done += 1
        yield Compared(moved, swept, told, float(by_few), middle - start, end - middle, at)


def _regions(
    rng: np.random.Generator, moved: Moved, body: np.ndarray, width: float
) -> list[np.ndarray]:
    """Three regions, as a rule nearest to what moves somewhere on the way, not at its ends."""
    few = Moved(moved.first, moved.second, moved.drive[:: len(moved.drive) // 200], 0)
    few.d, few.phi = (part[:: len(moved.drive) // 200] for part in (moved.d, moved.phi))
    for _ in range(TRIES):
        regions = [random_outline(rng, 30, 6) + rng.uniform(-150, 150, 2) for _ in range(3)]
        apart = sweep(few, body, regions, width)
        if 0 < apart.argmin() < len(apart) - 1 and (apart.min() > 0 or rng.random() < TOUCHING):
            break
    return regions


def _places(moved: Moved, at: np.ndarray) -> Displacement:
    d = moved.d[at]
    return Displacement(np.stack([d.real, d.imag], axis=-1), moved.phi[at])


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--frames", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    print("dyads | sweep | differs by | error told | by 36 frames | what | sweep s | told ms")
    wrong = 0
    for each in campaign(given.count, given.frames, given.seed):
        dyads = "-".join(type(d).__name__ for d in (each.moved.first, each.moved.second))
        differs = each.told.least - each.swept
        wrong += not -each.told.error - 1e-9 <= -differs <= each.told.error + 1e-4
        print(
            f"{dyads} | {each.swept:.6f} | {differs:+.1e} | {each.told.error:.1e} | "
            f"{each.by_few - each.swept:+.4f} | {each.told.part}, {each.told.obstacle} | "
            f"{each.sweep_time:.2f} | {1e3 * each.time:.1f}"
        )
    print(f"{wrong} of {given.count} beyond what is told")


if __name__ == "__main__":
    main()
