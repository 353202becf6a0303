"""A film of a four-bar."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from burmester import plot
from burmester.export.coupler_motion import CouplerMotion
from burmester.export.films.film import Film, there_and_back
from burmester.fourbar.dyad import PR, RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.style import with_unit

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    from burmester.verdicts.found_linkage import FoundLinkage

__all__ = ["FourBarFilm"]


@dataclass(frozen=True)
class FourBarFilm(Film):
    """A film of a four-bar, the driver its first dyad."""

    chosen: FoundLinkage

    @cached_property
    def motion(self) -> CouplerMotion:
        """The place of the coupler in each picture."""
        whole = CouplerMotion.of(self.chosen, 2).turns_fully
        share = np.arange(self.count) / self.count if whole else there_and_back(self.count)
        return CouplerMotion.of(self.chosen, share, whole)

    @property
    def places(self) -> Displacement:
        return self.motion.places

    @property
    def parameter(self) -> FloatArray:
        return self.motion.parameter

    @property
    def full_turn(self) -> bool:
        return self.motion.full_turn

    @property
    def reached(self) -> NDArray[np.bool_]:
        return np.isfinite(self.motion.pose_shares)

    def followed(self, number: NDArray[np.intp]) -> FloatArray:
        """The driver's moving pivot, or the body's origin after an RP."""
        places, first = self.places[number], self.chosen.driver_first.first
        return places.act(first.moving_pivot) if isinstance(first, RR | PR) else places.translation

    def drive_text(self, number: int) -> str:
        motion = self.motion
        value = float(motion.driver_coordinate[number])
        if not motion.circuit.loop.turns:
            return with_unit(f"driver {value:.4g}".replace("-", "−"), self.chosen.unit)
        degrees = math.degrees(value)
        return f"driver {degrees % 360 if motion.full_turn else degrees:5.1f}°"

    def drawn(self, ax: Axes, number: int) -> list[Artist]:
        drawn = plot.linkage(
            ax, self.chosen.driver_first, self.places[number], travel=(self.places,)
        )
        own = [*drawn.links, drawn.coupler, *drawn.ground]
        return [*own, drawn.fixed_pivots, drawn.moving_pivots]

    def curve(self, ax: Axes) -> list[Line2D]:
        curve = plot.coupler_curve(ax, self.chosen.driver_first, only=self.motion.number)
        for cross in curve.dead_points:
            cross.remove()
        return [each for lines in curve.circuits for each in lines]
