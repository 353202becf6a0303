"""The numbers that dimensions may have: multiples of a step, decimal angles, lengths from stock.

And which whole numbers of steps are nearest to a linear least-squares problem.
"""

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
from burmester.numerics.integer_least_squares import ALIKE

__all__ = ["Grid", "multiple"]

SIZE = 2 * DIMENSIONS
BESIDE, REACH = 1.5, 0.5  # steps, or sizes (radians), that a rounding may be off
WHOLE = 2.0**53  # from here on not every whole number is a double


def multiple(count: FloatArray, step: float) -> FloatArray:
    """Multiples (*,) of a step as its decimal digits say, each the nearest double."""
    exact = Fraction(repr(float(step)))
    over, under = exact.numerator, exact.denominator
    top = np.abs(count).max(initial=0.0)
    if top * over < WHOLE and under < 1e22 and int(float(under)) == under:
        return np.asarray(count * float(over) / float(under))  # of exact numbers: rounded once
    values = [float(int(each) * exact) for each in np.ravel(count)]
    return np.array(values).reshape(np.shape(count))


@final
@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """The values that the ten dimensions of one linkage may have, numbered by whole numbers.

    links, lines, lengths: (10,), which are links' lengths, normal angles, and other lengths.
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
        """Of a linkage with dyads of kinds (2,), and a motion of this size."""
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
        """Where dimensions (*, 10) are among the values: whole numbers, and what is between."""
        out = np.zeros(dimensions.shape)
        if self.step is not None:
            out = dimensions / self.step
            out[..., self.lines] = np.degrees(dimensions[..., self.lines]) / self.turn
        if len(self.stock):
            at = np.interp(dimensions[..., self.links], self.stock, np.arange(len(self.stock)))
            out[..., self.links] = at
        return out

    def possible(self, number: FloatArray, start: FloatArray) -> NDArray[np.bool_]:
        """Whether there are links of these lengths, of numbers (*, 10), and all near a start (10,).

        A coarse step leads to giants otherwise.
        """
        least, most = (0, len(self.stock) - 1) if len(self.stock) else (1, np.inf)
        links = number[..., self.links]
        near = np.abs(number - start) <= self.reach() + ALIKE
        return np.asarray(((links >= least) & (links <= most)).all(axis=-1) & near.all(axis=-1))

    def reach(self) -> FloatArray:
        """How many whole numbers away values may be, (10,)."""
        stride = self.stride()
        size = np.where(self.lines, 1.0, self.size)
        with np.errstate(divide="ignore"):
            return np.where(stride > 0, np.maximum(BESIDE, REACH * size / stride), np.inf)

    def nearest(self, number: FloatArray) -> FloatArray:
        """The whole numbers nearest to numbers (*, 10), of links that are possible."""
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
        """How far apart the values are, (10,); 0 of stock and of what is not rounded."""
        out = np.zeros(SIZE)
        if self.step is not None and self.turn is not None:
            out[self.lengths] = self.step
            out[self.lines] = np.radians(self.turn)
            out[self.links] = 0.0 if len(self.stock) else self.step
        return out

    def values(self, number: FloatArray, dimensions: FloatArray) -> FloatArray:
        """Dimensions (*, 10) with those that are rounded at their whole numbers."""
        out = np.array(np.broadcast_to(dimensions, number.shape))
        if self.step is not None and self.turn is not None:
            some = self.lengths | self.links
            out[..., some] = multiple(number[..., some], self.step)
            out[..., self.lines] = np.radians(multiple(number[..., self.lines], self.turn))
        if len(self.stock):
            out[..., self.links] = self.stock[number[..., self.links].astype(int)]
        return out + 0.0  # no minus zeros
