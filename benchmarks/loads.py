"""What loads cost: of one linkage along its motion, and of an answer beside the same without.

    python -m benchmarks.loads --rounds 5

All figures are medians of one run, in which both answers of a task take turns.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import replace
from statistics import median

import numpy as np
from tests.oracles.loaded_linkages import KINDS, WATT, loaded_linkage

from burmester import read_task, synthesize
from burmester.loads.load_figures import load_figures
from burmester.loads.loaded_motion import LoadedLinkage
from burmester.tasks.loads import Drive, End, Loads, Mass, Plates, Spring
from burmester.tasks.motion_task import Task

PLACES = 360
LINKAGES = 12  # of a kind
CASES = ("motiongen-shoulder", "ge2012-exact", "motiongen-mixed5")


def timed(work: Callable[[], object]) -> float:
    """Milliseconds of one call."""
    start = time.perf_counter()
    work()
    return 1000 * (time.perf_counter() - start)


def one_linkage(kind: str, rounds: int) -> tuple[float, float, float]:
    """Places alone, with efforts and reactions, and all figures of linkages of a kind, in ms."""
    every = [loaded_linkage(kind, seed)[1] for seed in range(LINKAGES)]
    shares = np.linspace(0.0, 1.0, PLACES)

    def loaded(linkage: LoadedLinkage) -> None:
        there = linkage.at(shares)
        there.pin_forces(-there.applied)
        assert there.effort.shape == (PLACES,)

    rows = [
        (
            timed(lambda: linkage.way(shares)),  # noqa: B023 (called at once)
            timed(lambda: loaded(linkage)),  # noqa: B023
            timed(lambda: load_figures(linkage.found)),  # noqa: B023
        )
        for _ in range(rounds)
        for linkage in every
    ]
    places, efforts, figures = (median(column) for column in zip(*rows, strict=True))
    return places, efforts, figures


def with_loads(task: Task) -> Task:
    """The task with a weight, plates, a hand, a spring and a drive."""
    size = float(np.ptp(task.poses.translation, axis=0).max())
    (x, y), reach = task.poses.translation[0], size / 2
    spring = Spring(
        "extension",
        (End("ground", (float(x) - reach, float(y) - reach)), End("body", (reach, 0.0))),
        {"rate_N_per_mm": 0.5, "free_length": 0.0},
    )
    loads = Loads(
        body=Mass(4.0, [reach, 0.0], 0.01),
        links=Plates("steel", size / 50, size / 20),
        hand=[size, 0.0],
        springs=(spring,),
        drive=Drive(2.0),
    )
    return replace(task, loads=loads)


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    print(f"one linkage at {PLACES} places, ms: places, with efforts and reactions, all figures")
    for kind in (KINDS[0], KINDS[1], KINDS[3], WATT, KINDS[-1]):
        places, efforts, figures = one_linkage(kind, rounds)
        print(f"  {kind:22} {places:6.2f} {efforts:6.2f} {figures:6.2f}")
    print("an answer, ms: without loads, with, ratio; linkages, of these with figures")
    for name in CASES:
        bare = replace(read_task(f"case:{name}"), length_unit="mm")
        heavy = with_loads(bare)
        found = synthesize(heavy).linkages
        pairs = [
            (timed(lambda: synthesize(bare)), timed(lambda: synthesize(heavy)))  # noqa: B023
            for _ in range(rounds)
        ]
        one, two = (median(column) for column in zip(*pairs, strict=True))
        told = sum(each.loads is not None for each in found)
        print(f"  {name:22} {one:8.1f} {two:8.1f} {two / one:6.2f}; {len(found)}, {told}")


if __name__ == "__main__":
    main()
