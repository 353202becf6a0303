"""The grid of values for dimensions: multiples of a step, decimal angles, lengths from stock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.linkage_batch import DIMENSIONS
from burmester.numerics.arrays import FloatArray

SIZE = 2 * DIMENSIONS
# A rounded value differs from the dimension by at most MAX_STEPS_OFF steps or MAX_SIZES_OFF sizes
# of the motion (radians for lines), whichever is more.
MAX_STEPS_OFF, MAX_SIZES_OFF = 1.5, 0.5
STEP_ROUNDING = 1e-12  # steps; a value that much beyond its reach is within it
EXACT_INTEGERS = 2.0**53  # every whole number below this is a double


def multiple(count: FloatArray, step: float) -> FloatArray:
    """Multiples (*,) of a step as its decimal digits say, each the nearest double."""
    exact = Fraction(repr(float(step)))
    over, under = exact.numerator, exact.denominator
    top = np.abs(count).max(initial=0.0)
    if top * over < EXACT_INTEGERS and under < 1e22 and int(float(under)) == under:
        return np.asarray(count * float(over) / float(under))  # of exact numbers: rounded once
    values = [float(int(each) * exact) for each in np.ravel(count)]
    return np.array(values).reshape(np.shape(count))


@final
@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """The values that the ten dimensions of one linkage may have, numbered by whole numbers.

    step: of lengths, in the task's unit; turn: of lines' angles, in degrees; None: not rounded.
    size: of the motion, in the task's unit.
    stock: the link lengths available, sorted; empty: multiples of the step.
    links, lines, lengths: (10,), which dimensions are link lengths, normal angles, other lengths.
    """

    step: float | None
    turn: float | None
    size: float
    stock: FloatArray
    links: NDArray[np.bool_]
    lines: NDArray[np.bool_]
    lengths: NDArray[np.bool_]

    @classmethod
    def of(
        cls, kinds: NDArray[np.int8], step: float | None, stock: Sequence[float], size: float
    ) -> Grid:
        """The grid of a linkage with dyads of kinds (2,), for a motion of this size."""
        links, lines = np.zeros((2, DIMENSIONS), dtype=bool), np.zeros((2, DIMENSIONS), dtype=bool)
        links[:, 4] = kinds == 0
        lines[:, 0], lines[:, 2] = kinds == 1, kinds == 2
        lengths = ~links & ~lines
        lengths[:, 4] = False
        turn = None
        if step is not None:
            turn = min(10.0, 10.0 ** np.floor(np.log10(np.degrees(step / size))))
            turn = float(f"{turn:.0e}")  # 10 ** -3.0 is not always 0.001
        parts = (each.reshape(SIZE) for each in (links, lines, lengths))
        return cls(step, turn, size, np.array(stock, dtype=float), *parts)

    @property
    def rounded(self) -> NDArray[np.bool_]:
        """Which dimensions are rounded at all."""
        links = self.links & (len(self.stock) > 0 or self.step is not None)
        return np.asarray(links | ((self.lines | self.lengths) & (self.step is not None)))

    def number(self, dimensions: FloatArray) -> FloatArray:
        """The numbers (*, 10) of dimensions (*, 10): whole for values of the grid, else between."""
        out = np.zeros(dimensions.shape)
        if self.step is not None:
            out = dimensions / self.step
            out[..., self.lines] = np.degrees(dimensions[..., self.lines]) / self.turn
        if len(self.stock):
            at = np.interp(dimensions[..., self.links], self.stock, np.arange(len(self.stock)))
            out[..., self.links] = at
        return out

    def possible(self, number: FloatArray, start: FloatArray) -> NDArray[np.bool_]:
        """Whether numbers (*, 10) have links that exist, and all are near a start (10,).

        Without the second condition a coarse step leads to huge dimensions.
        """
        least, most = (0, len(self.stock) - 1) if len(self.stock) else (1, np.inf)
        links = number[..., self.links]
        near = np.abs(number - start) <= self.reach() + STEP_ROUNDING
        return np.asarray(((links >= least) & (links <= most)).all(axis=-1) & near.all(axis=-1))

    def reach(self) -> FloatArray:
        """The greatest difference of numbers (10,) from the start."""
        stride = self.stride()
        size = np.where(self.lines, 1.0, self.size)
        with np.errstate(divide="ignore"):
            return np.where(
                stride > 0, np.maximum(MAX_STEPS_OFF, MAX_SIZES_OFF * size / stride), np.inf
            )

    def nearest(self, number: FloatArray) -> FloatArray:
        """The whole numbers nearest to numbers (*, 10), with links that exist."""
        out = np.rint(number)
        if len(self.stock):
            return out
        out[..., self.links] = np.maximum(out[..., self.links], 1.0)
        return out

    def beside(self, number: FloatArray) -> list[tuple[float, ...]]:
        """Both neighbours of the links' numbers among (10,), the nearest ones first."""
        at = number[self.links]
        sides = [sorted({float(np.floor(each)), float(np.ceil(each))}) for each in at]
        return sorted(product(*sides), key=lambda each: float(((np.array(each) - at) ** 2).sum()))

    def stride(self) -> FloatArray:
        """The distances between neighbouring values, (10,); 0 for stock and where not rounded."""
        out = np.zeros(SIZE)
        if self.step is not None and self.turn is not None:
            out[self.lengths] = self.step
            out[self.lines] = np.radians(self.turn)
            out[self.links] = 0.0 if len(self.stock) else self.step
        return out

    def values(self, number: FloatArray, dimensions: FloatArray) -> FloatArray:
        """Dimensions (*, 10), the rounded ones at the values of whole numbers (*, 10)."""
        out = np.array(np.broadcast_to(dimensions, number.shape))
        if self.step is not None and self.turn is not None:
            some = self.lengths | self.links
            out[..., some] = multiple(number[..., some], self.step)
            out[..., self.lines] = np.radians(multiple(number[..., self.lines], self.turn))
        if len(self.stock):
            out[..., self.links] = self.stock[number[..., self.links].astype(int)]
        return out + 0.0  # no minus zeros
