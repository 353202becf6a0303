"""Starts beside the critical points: linkages drawn at random that come nearest to a function.

What a linkage has to keep may lead far from every optimum without it, so a descent begins at
others as well: of many linkages that go through the range, the nearest that keep all of it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.functions.function_task import FunctionTask
from burmester.functions.generator import Generator
from burmester.functions.kept_requirements import MOST_SIZE
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.numerics.counted_draws import uniform_draws

DRAWN: Final = 20_000
SEED: Final = 20_001
MOST_PAIRS: Final = 13  # at which they are compared
CLOSE: Final = 0.3  # of the logarithm of a link, and radians; of starts as near one is taken
MOST_LOOKED_AT: Final = 400  # of the nearest, when some are taken that are not close


class FurtherStarts(NamedTuple):
    """Generators (k,) that go through the range of a task, those with the least errors first.

    transmission: (k,), radians; ratio: (k,); type: (k,), names.
    """

    generators: Generator
    transmission: FloatArray
    ratio: FloatArray
    type: NDArray[np.str_]

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
        return cls(found, found.least_transmission(low, high), found.link_ratio, found.types)

    def near(
        self, transmission: float, ratio: float, types: frozenset[str] | None, most: int
    ) -> Generator:
        """At most so many of the nearest that keep what is asked, none close to another."""
        keeps = (self.transmission >= transmission) & (self.ratio <= ratio)
        if types is not None:
            keeps &= np.isin(self.type, list(types))
        at = np.flatnonzero(keeps)[:MOST_LOOKED_AT]
        g = self.generators[at]
        return g[g.first_apart(CLOSE, most, phases_only=False)]
