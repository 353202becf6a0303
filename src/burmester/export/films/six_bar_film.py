"""A film of a six-bar."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from burmester import plot
from burmester.export.films.film import Film, there_and_back
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    from burmester.sixbar.found import FoundSixBar

__all__ = ["SixBarFilm"]


@dataclass(frozen=True)
class SixBarFilm(Film):
    """A film of a six-bar; of one that turns fully all turns until all is as it was."""

    chosen: FoundSixBar

    @cached_property
    def parameter(self) -> FloatArray:
        """The driver's angle in each picture (count,)."""
        start, end = self.chosen.along(2).tolist()
        if self.full_turn:
            way = math.copysign(
                2 * math.pi * self.chosen.turns, self.chosen.drive[-1] - self.chosen.drive[0]
            )
            return float(self.chosen.drive[0]) + way * np.arange(self.count) / self.count
        return np.asarray(start + (end - start) * there_and_back(self.count))

    @cached_property
    def places(self) -> Displacement:
        """The place (count,) of the body in each picture."""
        return self.chosen.body(self.parameter)

    @property
    def full_turn(self) -> bool:
        return self.chosen.turns > 0

    @property
    def reached(self) -> NDArray[np.bool_]:
        return np.full(len(self.chosen.drive), fill_value=True)

    def followed(self, number: NDArray[np.intp]) -> FloatArray:
        end = self.chosen.skeleton.arm(self.chosen.driver_pivot)[1]
        return self.chosen.joints(self.parameter[number])[end]

    def drive_text(self, number: int) -> str:
        degrees = math.degrees(self.parameter[number])
        return f"driver {degrees % 360 if self.full_turn else degrees:5.1f}°"

    def drawn(self, ax: Axes, number: int) -> list[Artist]:
        return plot.six_bar(ax, self.chosen, float(self.parameter[number]))

    def curve(self, ax: Axes) -> list[Line2D]:
        return ax.plot(*self.places.translation.T)
