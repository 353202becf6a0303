"""The task of a function generator: pairs of input and output angles, or a function of x.

The input link turns with x and the output link with y, each on a scale of its own: the input is
0 where x begins and the whole input range where it ends; the output is 0 where x begins, and the
difference of the greatest and the least y is the whole output range.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar, Final, TypeAlias, final

import numpy as np

from burmester.errors import Advice
from burmester.fourbar.linkage import TYPE_OF_SIGNS
from burmester.numerics.arrays import FloatArray
from burmester.tasks.requirements import Requirements

FUNCTION_SAMPLES: Final = 361  # inputs at which a function is compared with what a linkage does
Values: TypeAlias = Callable[[FloatArray], FloatArray]


@final
@dataclass(frozen=True, slots=True, eq=False)
class SampledFunction:
    """A function y = f(x) over a range of x, and the angles that stand for x and y.

    text: as it was written; values: y (*,) at x (*,); x: the ends of its range.
    input_range, output_range: radians; output_range is negative where the output turns against
        the input.
    written: whether `text` is an expression that can be read again.
    """

    text: str
    values: Values
    x: tuple[float, float]
    input_range: float
    output_range: float
    written: bool = True

    def at(self, share: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The input and output angles (*,) at shares (*,) of the range of x, radians."""
        share = np.asarray(share, dtype=np.float64)
        low, high = self.x
        y = self.values(low + (high - low) * share)
        first, every = (
            self.values(np.array([low])),
            self.values(np.linspace(*self.x, FUNCTION_SAMPLES)),
        )
        scale = self.output_range / (every.max() - every.min())
        return self.input_range * share, scale * (y - first)


@final
@dataclass(frozen=True, slots=True, eq=False)
class FunctionTask:
    """Pairs of angles that the input and the output link are to have together.

    inputs, outputs: (N,), radians, each from a zero of its own.
    input_phase, output_phase: the angles of the links, from the ground link, where the input and
        the output are 0, radians; None where they may be chosen.
    weights: (N,), of squared errors; None: all the same.
    ground: the length of the ground link.
    function: what the pairs are taken from, if anything.
    minimax: whether the greatest error is to be least, instead of the sum of squares.
    requirements: what a linkage has to keep over the range: transmission, link ratio, types.
    notes: what was assumed or passed over when the pairs were read.
    """

    length_unit: ClassVar[str | None] = None  # lengths are in that of the ground link
    inputs: FloatArray
    outputs: FloatArray
    input_phase: float | None = None
    output_phase: float | None = None
    weights: FloatArray | None = None
    ground: float = 1.0
    function: SampledFunction | None = None
    minimax: bool = False
    requirements: Requirements = field(default=Requirements())
    notes: tuple[Advice, ...] = ()

    def __post_init__(self) -> None:
        for name in ("inputs", "outputs"):
            object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=np.float64))

    @property
    def free_phases(self) -> int:
        """How many of the two phases may be chosen."""
        return (self.input_phase is None) + (self.output_phase is None)

    @property
    def exact_count(self) -> int:
        """The number of pairs that finitely many linkages meet exactly: 3, 4 or 5."""
        return 3 + self.free_phases

    @property
    def solutions(self) -> int | None:
        """How many linkages, or critical points, generic pairs have; None: infinitely many."""
        pairs, free = len(self.inputs), self.free_phases
        if pairs < self.exact_count:
            return None
        return 1 + free if pairs == self.exact_count else (1, 6, 28)[free]

    @property
    def types(self) -> frozenset[str] | None:
        """The types allowed of linkages with four pins; None: all."""
        allowed = self.requirements.allowed_types
        return None if allowed is None else allowed.intersection(TYPE_OF_SIGNS.values())

    @property
    def input_ends(self) -> tuple[float, float]:
        """The least and the greatest input that the linkage has to go through, radians."""
        inputs = self.inputs
        if self.function is not None:
            inputs = np.append(inputs, [0.0, self.function.input_range])
        return float(inputs.min()), float(inputs.max())

    @property
    def output_span(self) -> float:
        """The difference of the greatest and the least output, radians."""
        if self.function is not None:
            return abs(self.function.output_range)
        return float(np.ptp(self.outputs))

    def compared(self) -> tuple[FloatArray, FloatArray]:
        """The inputs and outputs (M,) by which the structural error is told.

        Of a function those at FUNCTION_SAMPLES even shares of its range, else the pairs.
        """
        if self.function is None:
            return self.inputs, self.outputs
        return self.function.at(even_spacing(FUNCTION_SAMPLES))


def chebyshev_spacing(count: int) -> FloatArray:
    """Shares (count,) of a range at the zeros of Chebyshev's polynomial of that degree.

    The error of an interpolation at these points oscillates most evenly.  The ends are not among
    them.

    Examples
    --------
    >>> chebyshev_spacing(3).round(6).tolist()
    [0.066987, 0.5, 0.933013]
    """
    return 0.5 - 0.5 * np.cos((2 * np.arange(count) + 1) * np.pi / (2 * count))


def even_spacing(count: int) -> FloatArray:
    """Shares (count,) of a range at even distances, with both ends."""
    return np.linspace(0.0, 1.0, count)
