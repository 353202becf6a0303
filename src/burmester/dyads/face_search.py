"""The search on the faces of limits: what is minimised, and every way down from a start."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.face_descent import descend, inside
from burmester.dyads.geometric_fit import DistanceFunction, FitProblem, GeometricFit, Point
from burmester.dyads.least_powers import free_minima, least_squares_step
from burmester.dyads.least_worst import least_worst
from burmester.dyads.limited_block import Block
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import Bundle, concatenate
from burmester.numerics.unique_rows import unique_rows
from burmester.polynomials.bilinear_fit import Parameters, Shape
from burmester.polynomials.stationary_points import StationaryPoints, stationary_points
from burmester.tasks.option_table import Norm

SAME_DYAD = 1e-7  # relative; dyads whose coordinates differ by less are one
NEAR_DYAD = 1e-6  # relative; from a dyad so near to a known one no way down is looked for
EXACT_TOLERANCE = 1e-9  # relative; an exact pose missed by less is met
EXACT_WEIGHT = 1e4  # of an exact pose where all weights are 1, for the line that a link begins at
SLIDER_LENGTH = (
    1e3  # characteristic lengths; a longer link that still grows is on its way to a line
)
NUMBERS_AT_ONCE = 1_000_000  # dyads times poses, of which all derivatives are held at once
SAME_SLIDER = 2 / SLIDER_LENGTH  # lengths; longer links whose distances differ by less are one
LINE_LENGTH = 1e9  # characteristic lengths; a longer link is a line to the last digits


@final
@dataclass
class FaceSearch:
    """What is minimised over the poses (N,), and counts of the search: see `LimitedDyads`.

    share: (N,), the weights; exact: (N,); norm: of the distances.
    """

    share: FloatArray
    exact: NDArray[np.bool_]
    norm: Norm
    systems: int = 0
    found: int = 0
    lost: int = 0
    unsettled: int = 0

    def centre(self, rows: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Residual rows (N, f) without the row of the best constant.

        That row is the mean where no pose is exact, or the first exact one's.
        Returns it, the Gram matrix G (f, f) of the rest, and the conditions A (k, f) of the other
        exact poses.
        """
        marked = np.flatnonzero(self.exact)
        base, others = rows[marked[0]] if len(marked) else self.share @ rows, marked[1:]
        loose = np.sqrt(np.where(self.exact, 0.0, self.share))[:, None] * (rows - base)
        conditions = rows[others] - base
        size = np.linalg.norm(conditions, axis=1, keepdims=True)
        return base, loose.T @ loose, conditions / np.where(size > 0, size, 1.0)

    def solve(self, shape: Shape, systems: Parameters) -> list[StationaryPoints]:
        """The stationary points of systems (T,) of one shape."""
        every = stationary_points(shape, systems)
        self.systems += len(every)
        self.found += sum(one.finite for one in every)
        self.lost += sum(one.lost for one in every)
        return every

    def in_batches(self, function: Callable[..., Bundle], *rows: FloatArray) -> Bundle:
        """What a function makes of rows (k, ...), of so many at once as fit into memory."""
        size = max(1, NUMBERS_AT_ONCE // len(self.share))
        begins = range(0, max(1, len(rows[0])), size)
        return concatenate([function(*(each[k : k + size] for each in rows)) for k in begins])

    @property
    def leaning(self) -> FloatArray:
        """The weights (N,) of squared distances from a line that nearly meets the exact poses."""
        return np.where(self.exact, EXACT_WEIGHT, self.share)

    @property
    def exact_or_share(self) -> FloatArray:
        """The weights (N,) of the poses that say how long a link is best."""
        return self.exact.astype(np.float64) if self.exact.any() else self.share


@final
@dataclass
class Descents:
    """The ways down from starts to the dyads of one kind.

    distances: of that kind; blocks: its limits; dyads: (k, n), what was found so far.
    """

    search: FaceSearch
    distances: DistanceFunction
    blocks: Sequence[Block]
    dyads: FloatArray

    def free_minima(self, starts: FloatArray, along: FloatArray) -> FloatArray:
        """The minima (k, n) of the distance to which starts (k, n) lead, were there no limits.

        along: (k, n, n), projectors on the directions of the starts' faces.
        Not a number where a start leads to none.
        """
        problem = FitProblem(self.distances, self.search.share, self.search.exact)
        return self.search.in_batches(partial(free_minima, problem), starts, along)

    def follow(self, starts: FloatArray) -> None:
        """Go down from starts (k, n) within limits; ways that are given up are counted."""
        starts = starts[inside(starts, self.blocks) & ~self.knows(starts)]
        ended = self._followed(starts)
        self.search.unsettled += int((~ended & ~self.knows(starts)).sum())

    def look(self, starts: FloatArray) -> None:
        """Go down from starts that only may lead to dyads, on the faces on which they lie."""
        self._followed(starts[inside(starts, self.blocks)], may_leave=False)

    def knows(self, z: FloatArray) -> NDArray[np.bool_]:
        """Whether dyads z (k, n) were found, up to a share of their size."""
        apart = np.abs(z[:, None] - self.dyads).max(axis=-1)
        return np.asarray((apart <= NEAR_DYAD * _size(z)[:, None]).any(axis=1))

    def in_order(self) -> FloatArray:
        """The dyads found (k, n), by rising sum of squared distances."""
        distance = self.distances.only(self.dyads)
        order = np.argsort((distance**2).sum(axis=-1), kind="stable")
        kept: list[int] = []
        for k in order:
            long = [j for j in kept if min(_size(self.dyads[[j, k]])) > SLIDER_LENGTH]
            # Where one of them came to rest is chance, on the way to one slider.
            if not any(np.abs(distance[j] - distance[k]).max() < SAME_SLIDER for j in long):
                kept.append(k)
        return self.dyads[kept]

    def _followed(self, z: FloatArray, *, may_leave: bool = True) -> NDArray[np.bool_]:
        """Add the minima of the norm to which dyads z (k, n) within limits lead, if they are new.

        Returns False where the way down was given up.
        """
        exact = self.search.exact
        problem = FitProblem(self.distances, self.search.share, exact)

        def step(at: Point, along: FloatArray) -> GeometricFit:
            return least_squares_step(problem, at, along)

        def minimax(at: Point, along: FloatArray) -> GeometricFit:
            best = least_worst(problem, at.z, along)
            # The others are on their way to a slider.
            near = best.settled | ~(np.abs(best.z).max(axis=-1) > SLIDER_LENGTH)
            z = np.where(near[:, None], best.z, np.nan)
            return GeometricFit(best.at._replace(z=z), best.by_distance, np.ones_like(near))

        down = partial(descend, distances=self.distances, minimise=step, blocks=self.blocks)
        z, settled = self.search.in_batches(partial(down, may_leave=may_leave), z)
        first, each = _distinct(np.column_stack([z, settled]))
        z, settled = z[first], settled[first]
        if self.search.norm == "worst" and not exact.all():
            rows = np.flatnonzero(settled)
            z[rows], settled[rows] = descend(z[rows], self.distances, minimax, self.blocks)
        size = _size(z)
        slider = ~(size < np.where(settled, LINE_LENGTH, SLIDER_LENGTH))  # or on its way to one
        gap = np.abs(self.distances.only(z)[:, exact]).max(axis=-1, initial=0)
        found = settled & ~slider & (gap <= EXACT_TOLERANCE * size)
        self.dyads = unique_rows(np.concatenate([self.dyads, z[found]]), SAME_DYAD, "maximum")
        # On an edge or at a corner there may be too little freedom to meet the exact poses.
        return np.asarray(found | slider)[each]


def _size(z: FloatArray) -> FloatArray:
    """The scales (k,) of dyads z (k, n)."""
    return np.asarray(1 + np.abs(z).max(axis=-1))


def _distinct(z: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Most of the different rows z (k, n): where they come first, and which of these each is.

    Two of them that are the same up to rounding may both remain.
    """
    rounded = np.round(z / (SAME_DYAD * _size(z)[:, None]))
    _, first, each = np.unique(rounded, axis=0, return_index=True, return_inverse=True)
    return first, each.ravel()
