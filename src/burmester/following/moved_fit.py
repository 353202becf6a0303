"""The locally best dyads of a task, with dyads where they are for another one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.local_minima import BestDyads, with_errors
from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

__all__ = ["circles_of", "listed", "moved_fit", "twins"]

SAME_DYAD = 1e-6  # relative; dyads that differ by less have become one


def circles_of(fit: BestDyads) -> FloatArray:
    """The circles (k, 5) of a fit, c, m, r, in its frames."""
    some = fit.circles
    return np.concatenate([some.fixed_pivot, some.moving_pivot, some.radius[:, None]], axis=-1)


def listed(fit: BestDyads) -> list[Dyad]:
    """The circles and sliders of a fit, in the task's frames."""
    every: list[Dyad] = [
        RR(fit.dyads.fixed_pivot[k], fit.dyads.moving_pivot[k], fit.dyads.radius[k])
        for k in range(len(fit.dyads.radius))
    ]
    return every + [fit.frames.line_from_canonical(each) for each in fit.sliders]


def moved_fit(
    fit: BestDyads, z: FloatArray, sliders: tuple[PR | RP, ...], seen: Displacement
) -> BestDyads:
    """The fit with other circles z (k, 5) and sliders, in the same frames."""
    every = RR(z[:, :2], z[:, 2:4], z[:, 4])
    return with_errors(fit.search, every, sliders, every[:, None].residual(seen))


def twins(z: FloatArray) -> NDArray[np.intp]:
    """The numbers of dyads (k, n) that are the same as one before them."""
    apart = np.abs(z[:, None] - z).max(axis=-1) / (1 + np.abs(z).max(axis=-1))
    return np.flatnonzero(np.tril(apart < SAME_DYAD, -1).any(axis=1))
