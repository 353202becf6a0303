"""The six-bars of a task: what a search has found, each with all that is known of it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Final, final

import numpy as np

from burmester.errors import InputError
from burmester.requirements.figures import Figures
from burmester.requirements.loads import OF_LOADS
from burmester.requirements.table import excess
from burmester.sixbar.candidates import Candidates
from burmester.sixbar.chain_search import SEARCHED, is_sound, search
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.judged import judged_six_bar
from burmester.sixbar.load_excess import SEARCHED as SEARCHED_LOADS
from burmester.sixbar.load_excess import load_excess
from burmester.sixbar.search_space import POSES, SearchSpace
from burmester.tasks.problem import SynthesisProblem
from burmester.values import shown
from burmester.verdicts.quality import best_first
from burmester.wording import listed

CHAINS: Final = 20_000  # that are worked out where nobody says otherwise
MOST_CHAINS: Final = 10_000_000
WORSE: Final = 2.0  # what is too much at a pose counts as more than what is between them
SHOWN: Final = 8  # six-bars of an answer, at most
ALL: Final = "all"
CHOICES: Final = (ALL, *(name.removesuffix(" six-bar") for name in SEARCHED))
RULE: Final = (
    "recommended is the six-bar with the greatest least transmission angle of both loops; among "
    "those within half a degree of it, the smallest"
)


@final
@dataclass(frozen=True, slots=True)
class SixBarOptions:
    """How six-bars are looked for.

    chains: how many 3R chains are worked out for each class; seed: of the random numbers, the same
    one gives the same answer; most: six-bars of the answer, at most.
    kind: of one class only, such as "Watt I"; of all that are looked for where it is "all".
    Raises E197 where one makes no sense.
    """

    chains: int = CHAINS
    seed: int = 0
    most: int = SHOWN
    kind: str = ALL

    @property
    def kinds(self) -> tuple[str, ...]:
        """The names of the classes that are looked for."""
        every = tuple(SEARCHED)
        return every if self.kind == ALL else (every[CHOICES.index(self.kind) - 1],)

    def __post_init__(self) -> None:
        if self.kind not in CHOICES:
            raise InputError(
                "E197",
                f"{shown(self.kind)} is no kind of six-bar that is looked for",
                help=f"give one of {listed(CHOICES)}, or leave it out",
            )
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
    task, burden = problem.given, None
    if {*SEARCHED_LOADS} & {*task.requirements.bounds}:
        burden = partial(_burden, problem=problem)
    searches = search(
        space, options.kinds, options.chains, options.seed, options.most, burden=burden
    )
    best = [each.best for each in searches]
    sound = np.concatenate([is_sound(each, problem.motion_size) for each in best])
    transmission, extent = (
        np.concatenate([getattr(each, name) for each in best])
        for name in ("transmission", "extent")
    )
    order = best_first(transmission, extent, np.ones(len(extent)), enough=np.pi / 2)
    order = order[np.argsort(~sound[order], kind="stable")]
    rows = [(each, k) for each in best for k in range(len(each.chain))]
    found = list[FoundSixBar]()
    for each, k in (rows[at] for at in order.tolist()):
        pivot = each.linkages.skeleton.drivers[int(each.driver[k])]
        judged = judged_six_bar(each.linkages[k], problem, (pivot,))
        if judged.usable:  # most are: a search sees a driver at F at places only
            id = f"S{len(found) + 1}"
            found.append(replace(judged, id=id, chain=int(each.chain[k])))
        if len(found) == options.most:
            break
    return SixBars(
        tuple(found),
        sum(each.chains for each in searches),
        sum(each.designs for each in searches),
        sum(each.working for each in searches),
        options,
        space.assumed,
        POSES - problem.given.poses.shape[0],
    )


def _burden(found: Candidates, k: int, problem: SynthesisProblem) -> float:
    """By how much a six-bar bears too much: at the poses, and where it does not, in between."""
    rough = load_excess(found, k, problem.given)
    if rough > 0:
        return WORSE + rough
    linkage = found.linkages[k]
    judged = judged_six_bar(linkage, problem, (linkage.skeleton.drivers[int(found.driver[k])],))
    if judged.defects or judged.loads is None:
        return math.inf
    bounds = problem.given.requirements.bounds
    asked = {each: bound for each, bound in bounds.items() if each in OF_LOADS}
    return float(excess(asked, Figures(**judged.loads.measures)))
