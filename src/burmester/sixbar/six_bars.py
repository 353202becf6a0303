"""The six-bars of a task: what a search has found, each with all that is known of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, final

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.pose_error import PoseError
from burmester.sixbar.candidates import DRIVERS
from burmester.sixbar.chain_search import ChainSearch, search
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.motion import joints_at, poses_of
from burmester.sixbar.search_space import SearchSpace
from burmester.sixbar.standard import shortcomings
from burmester.tasks.motion_task import Task
from burmester.tasks.problem import SynthesisProblem
from burmester.values import shown

__all__ = ["CHAINS", "RULE", "SixBarOptions", "SixBars", "best_six_bars"]

CHAINS: Final = 20_000  # that are worked out where nobody says otherwise
MOST_CHAINS: Final = 10_000_000
SHOWN: Final = 8  # six-bars of an answer, at most
RULE: Final = (
    "recommended is the six-bar with the greatest least transmission angle of both loops; among "
    "those within half a degree of it, the smallest"
)


@final
@dataclass(frozen=True, slots=True)
class SixBarOptions:
    """How six-bars are looked for.

    chains: how many 3R chains are worked out; seed: of the random numbers, the same one gives the
    same answer; most: six-bars of the answer, at most.  Raises E197 where one makes no sense.
    """

    chains: int = CHAINS
    seed: int = 0
    most: int = SHOWN

    def __post_init__(self) -> None:
        bounds = {"chains": (1, MOST_CHAINS), "seed": (0, 2**63 - 1), "most": (1, 1000)}
        for name, (least, greatest) in bounds.items():
            value = getattr(self, name)
            whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
            if not whole or not least <= value <= greatest:
                raise InputError(
                    "E197",
                    f"{name} is {shown(value)}, not a whole number from {least:,} to {greatest:,}",
                    help=f"leave it out, or give such a number; {CHAINS:,} chains take a few "
                    "seconds",
                )


@final
@dataclass(frozen=True, slots=True, eq=False)
class SixBars:
    """What a search for six-bars has found.

    found: the best, in the order of `RULE`, sound ones first.
    chains: 3R chains that were worked out; designs: six-bars they made whose first loop works;
    working: those of them that work within limits and requirements.
    options: how it was looked for; assumed: what the task does not say, each with its option.
    free_poses: how many of the five poses were free.
    given: whether it is one that was given and judged, and nothing was searched.
    """

    found: tuple[FoundSixBar, ...]
    chains: int
    designs: int
    working: int
    options: SixBarOptions
    assumed: tuple[tuple[str, str], ...]
    free_poses: int
    given: bool = False

    def __iter__(self) -> Iterator[FoundSixBar]:
        return iter(self.found)

    def __len__(self) -> int:
        return len(self.found)

    def __getitem__(self, number: int) -> FoundSixBar:
        return self.found[number]


def best_six_bars(problem: SynthesisProblem, options: SixBarOptions) -> SixBars:
    """The best six-bars of a random search; raises E195 and E196, as `SearchSpace.of`."""
    space = SearchSpace.of(problem)
    result = search(space, options.chains, options.seed, options.most)
    order = range(len(result.best.chain))
    return SixBars(
        tuple(_found(result, k, space, problem.given) for k in order),
        result.chains,
        result.designs,
        result.working,
        options,
        space.assumed,
        5 - len(result.task_poses),
    )


def _found(result: ChainSearch, k: int, space: SearchSpace, task: Task) -> FoundSixBar:
    """The k-th of a search; drives and errors are those at the task's poses."""
    best, own = result.best, result.task_poses
    linkage, driver = best.linkages[k], DRIVERS[int(best.driver[k])]
    sides = best.sides.at(k)
    drive = best.drive[k, own]
    places = poses_of(linkage, joints_at(linkage, drive, sides, driver))
    transmission, extent = float(best.transmission[k]), float(best.extent[k])
    return FoundSixBar(
        id=f"S{k + 1}",
        linkage=linkage,
        driver=driver,
        drive=drive,
        room=best.room[k],
        sides=sides,
        transmission=transmission,
        extent=extent,
        error=PoseError.at(places, task.poses),
        shortcomings=shortcomings(linkage, transmission, extent, space.size, task),
        chain=int(best.chain[k]),
        task=task,
    )
