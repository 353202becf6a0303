"""The generators nearest to more pairs than a linkage can meet, and what better transmission costs.

A descent leads from every optimum of Freudenstein's residual, and from further starts, to the least
error of linkages that keep what is asked.  The same is done without what is asked, and once for
each of some greater transmission angles, with links that are sound: so the nearest linkage stands
beside those that transmit better.

Further starts are linkages drawn at random that go through the range and keep what is asked, the
nearest first: that may lead far from every optimum without it.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from burmester.functions.generator import Generator
from burmester.functions.kept_requirements import MOST_SIZE, KeptRequirements
from burmester.functions.refinement import SAME_GENERATOR, refined
from burmester.numerics.arrays import concatenate, wrapped_angle
from burmester.numerics.counted_draws import uniform_draws
from burmester.requirements.figures import Figures
from burmester.requirements.links import LINK_RATIO
from burmester.requirements.requirement import Bounds
from burmester.requirements.table import keeps
from burmester.requirements.transmission import TRANSMISSION
from burmester.requirements.types import TYPE
from burmester.tasks.function_task import FunctionTask
from burmester.verdicts.requirement_check import figures_of

DRAWN: Final = 20_000
SEED: Final = 20_001
MOST_PAIRS: Final = 13  # at which they are compared
CLOSE: Final = 0.3  # of the logarithm of a link, and radians; of starts as near one is taken
MOST_LOOKED_AT: Final = 400  # of the nearest, when some are taken that are not close

BETTER: Final = tuple(math.radians(each) for each in (20, 30, 40, 50, 60))  # transmission angles
FURTHER_STARTS: Final = 16  # at each level
LEVELLED: Final = 8  # optima of least squares at each level that minimax goes on from
MOST_OPTIMA: Final = 24  # generators that are kept
MOST_UNASKED: Final = 3  # of those that need not keep what is asked
MOST_BETTER: Final = 2  # of each greater transmission angle


class _Level(NamedTuple):
    """What the linkages of one search have to keep; most: how many of them are of interest."""

    transmission: float
    ratio: float
    types: frozenset[str] | None
    most: int

    @property
    def bounds(self) -> Bounds:
        """The same as requirements."""
        angle = math.degrees(self.transmission)
        asked = {} if self.types is None else {TYPE: self.types}
        return {TRANSMISSION: angle, LINK_RATIO: self.ratio, **asked}


def nearest_generators(optima: Generator, task: FunctionTask) -> Generator:
    """Generators (k,) of the least error, as the task counts it, that lie downhill.

    Where none keeps all that is asked, some are among them that keep all but one thing.
    optima: (m,), the starts that its pairs give.
    """
    further = FurtherStarts.of(task)
    wanted, asks = task.requirements, task.requirements.has_any
    asked = _Level(wanted.transmission, wanted.link_ratio, task.types, MOST_OPTIMA)
    plain = _Level(0.0, math.inf, None, MOST_UNASKED if asks else MOST_OPTIMA)
    sound = asked._replace(ratio=min(wanted.link_ratio, LINK_RATIO.standard), most=MOST_BETTER)
    better = [sound._replace(transmission=t) for t in BETTER if t > asked.transmission]
    found = _searched(list(dict.fromkeys([plain, asked, *better])), optima, further, task)
    if asks and not len(found[asked]):
        looser = [
            *(asked._replace(transmission=t) for t in (0.0, *BETTER) if t < asked.transmission),
            asked._replace(ratio=math.inf),
            asked._replace(types=None),
        ]
        looser = [each._replace(most=1) for each in looser if each not in (asked, plain)]
        found |= _searched(looser, optima, further, task)
    return concatenate(list(found.values()))


def _searched(
    levels: list[_Level], optima: Generator, further: FurtherStarts, task: FunctionTask
) -> dict[_Level, Generator]:
    """The best generators of each level, all levels with the same types in one descent."""
    found: dict[_Level, Generator] = {}
    for types in dict.fromkeys(each.types for each in levels):
        some = [each for each in levels if each.types == types]
        starts = [[optima, further.near(each.bounds, FURTHER_STARTS)] for each in some]
        every = [concatenate(each) for each in starts]
        for minimax in (False, True) if task.minimax else (False,):
            every = _descended(every, some, task, minimax=minimax)
        found |= dict(zip(some, every, strict=True))
    return found


def _descended(
    starts: list[Generator], levels: list[_Level], task: FunctionTask, *, minimax: bool
) -> list[Generator]:
    """The best generators of each level downhill of its starts, none twice."""
    which = np.repeat(np.arange(len(levels)), [len(each) for each in starts])
    kept = KeptRequirements(
        np.array([each.transmission for each in levels])[which],
        np.array([each.ratio for each in levels])[which],
        levels[0].types,
    )
    ends, error, arrived = refined(concatenate(starts), task, kept, minimax=minimax)
    best = []
    for number, level in enumerate(levels):
        at = np.flatnonzero(arrived & (which == number))
        some = ends[at[np.argsort(error[at], kind="stable")]]
        some = some[some.first_apart(SAME_GENERATOR, len(some), phases_only=False)]
        best.append(some[: level.most if minimax or not task.minimax else LEVELLED])
    return best


class FurtherStarts(NamedTuple):
    """Generators (k,) that go through the range of a task, those with the least errors first."""

    generators: Generator
    figures: Figures

    @classmethod
    def of(cls, task: FunctionTask) -> FurtherStarts:
        """Those drawn for a task; its given phases are theirs."""
        low, high = task.input_ends
        some = np.unique(np.linspace(0, len(task.inputs) - 1, MOST_PAIRS).astype(int))
        inputs, outputs = task.inputs[some], task.outputs[some]
        draw = uniform_draws(SEED, np.arange(DRAWN), 0, 5)
        a, r, b = np.exp(np.log(MOST_SIZE) * (2 * draw[:, :3].T - 1))
        first = 2 * np.pi * draw[:, 3]
        if task.input_phase is not None:
            first = np.full(DRAWN, task.input_phase)
        drawn = Generator(a, r, b, first, np.zeros(DRAWN), np.where(draw[:, 4] < 0.5, 1.0, -1.0))
        drawn = drawn[drawn.runs_through(low, high)]
        made = drawn.outputs(inputs) - outputs
        second = np.angle(np.exp(1j * made).sum(axis=1))
        if task.output_phase is not None:
            second = np.full(len(drawn), task.output_phase)
        error = (wrapped_angle(made - second[:, None]) ** 2).sum(axis=1)
        order = np.argsort(error, kind="stable")
        found = replace(drawn, output_phase=second)[order]
        return cls(found, figures_of(found.linkage(), found.least_transmission(low, high), True))

    def near(self, asked: Bounds, most: int) -> Generator:
        """At most so many of the nearest that keep what is asked, none close to another."""
        at = np.flatnonzero(keeps(asked, self.figures))[:MOST_LOOKED_AT]
        g = self.generators[at]
        return g[g.first_apart(CLOSE, most, phases_only=False)]
