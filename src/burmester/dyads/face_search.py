"""The search on the faces of limits: what is minimised, and every way down from a start."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.face_descent import Block, descend, inside
from burmester.dyads.geometric_fit import (
    DistanceFunction,
    FitProblem,
    GeometricFit,
    least_squares,
    least_worst,
)
from burmester.dyads.parameter_homotopy import (
    Parameters,
    Shape,
    StationaryPoints,
    stationary_points,
)
from burmester.numerics.arrays import FloatArray
from burmester.tasks.options import Norm

__all__ = ["Descents", "FaceSearch"]

SAME_DYAD = 1e-7  # relative; dyads whose coordinates differ by less are one
NEAR_DYAD = 1e-6  # relative; from a dyad so near to a known one no way down is looked for
EXACT_TOLERANCE = 1e-9  # relative; an exact pose missed by less is met
EXACT_WEIGHT = 1e4  # of an exact pose, where all weights are 1, on the way to its neighbourhood
NEARLY_EXACT = 0.01  # relative; an exact pose missed by more there has no dyad nearby
SLIDER_LENGTH = (
    1e3  # characteristic lengths; a longer link that still grows is on its way to a line
)


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

    def solve(self, shape: Shape, parameters: list[Parameters]) -> list[StationaryPoints]:
        """The stationary points of systems of one shape."""
        stacked = Parameters(*(np.stack(part) for part in zip(*parameters, strict=True)))
        every = stationary_points(shape, stacked)
        for one in every:
            self.systems += 1
            self.found += one.finite
            self.lost += one.lost
        return every

    @property
    def leaning(self) -> FloatArray:
        """The weights (N,) of squared distances whose minima lie near those with exact poses."""
        return np.where(self.exact, EXACT_WEIGHT, self.share)

    @property
    def exact_or_share(self) -> FloatArray:
        """The weights (N,) of the poses that say how long a link is best."""
        return self.exact.astype(np.float64) if self.exact.any() else self.share


@final
@dataclass
class Descents:
    """The ways down from starts to the dyads of one kind.

    distances: of that kind; blocks: its limits; dyads: what was found so far.
    """

    search: FaceSearch
    distances: DistanceFunction
    blocks: Sequence[Block]
    dyads: list[FloatArray] = field(default_factory=list)

    def follow(self, starts: Iterable[FloatArray]) -> None:
        """Go down from starts inside the limits; a way that is given up is counted."""
        for z in starts:
            self.search.unsettled += not self._followed(z)

    def look(self, starts: Iterable[FloatArray], *, may_leave: bool = True) -> None:
        """Go down from starts that only may lead to dyads: of these no way is counted.

        may_leave: whether a way may leave the edges on which it begins.
        """
        for z in starts:
            if self._nearly_exact(z):
                self._followed(z, may_leave=may_leave)

    def knows(self, z: FloatArray, tolerance: float = NEAR_DYAD) -> bool:
        """Whether a dyad z was found, up to a share of its size."""
        gap = tolerance * (1 + np.abs(z).max())
        return any(np.abs(z - other).max() <= gap for other in self.dyads)

    def in_order(self) -> list[FloatArray]:
        """The dyads found, by rising sum of squared distances."""
        return sorted(self.dyads, key=lambda z: float((self.distances(z).distance ** 2).sum()))

    def _gap(self, z: FloatArray) -> float:
        """The greatest distance at an exact pose."""
        return float(np.abs(self.distances(z).distance[self.search.exact]).max(initial=0))

    def _nearly_exact(self, z: FloatArray) -> bool:
        """Whether a dyad z nearly meets the exact poses."""
        return self._gap(z) < NEARLY_EXACT * float(1 + np.abs(z).max())

    def _followed(self, z: FloatArray, *, may_leave: bool = True) -> bool:
        """Add the minimum of the norm to which a dyad z leads, if it is within limits and new.

        Returns False where the way down was given up.
        """
        exact = self.search.exact
        problem = FitProblem(self.distances, np.eye(len(z)), self.search.share, exact)

        def newton_step(z: FloatArray, basis: FloatArray) -> GeometricFit:
            return least_squares(problem._replace(basis=basis), z, max_steps=1)

        def minimax(z: FloatArray, basis: FloatArray) -> GeometricFit:
            best = least_worst(problem._replace(basis=basis), z)
            if not best.settled and np.abs(best.z).max() > SLIDER_LENGTH:
                return best._replace(z=np.full_like(z, np.nan))  # on its way to a slider
            return best._replace(settled=True)

        if not inside(z, self.blocks) or self.knows(z):
            return True
        best = descend(z, self.distances, newton_step, self.blocks, may_leave=may_leave)
        if best.settled and self.search.norm == "worst" and not exact.all():
            best = descend(best.z, self.distances, minimax, self.blocks)
        size = 1 + np.abs(best.z).max()
        if not best.settled and not size < SLIDER_LENGTH:
            return True  # on its way to a slider
        # On an edge or at a corner there may be too little freedom to meet the exact poses.
        if not best.settled or self._gap(best.z) > EXACT_TOLERANCE * size:
            return False
        if not self.knows(best.z, SAME_DYAD):
            self.dyads.append(best.z)
        return True
