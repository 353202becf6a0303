"""The target of a linkage synthesis: poses in their frames, weights, limits, requirements."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.foot_points import places_of, rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import on_circuits
from burmester.geometry.displacement import Displacement
from burmester.linkages.constraints import (
    Constraints,
)
from burmester.linkages.refinement import Refined, refine
from burmester.numerics.arrays import FloatArray
from burmester.numerics.weights import shares
from burmester.tasks.requirements import Requirements

__all__ = ["Target"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Target:
    """Poses (N,) to come near to, in the frames of `pose_error.error_frames`, and what else holds.

    kept: the limits of the dyads, as constraints.
    weights, exact, worst: as in `refine`.
    """

    poses: Displacement
    length: float
    frames: CanonicalFrames
    requirements: Requirements
    kept: tuple[Constraints, ...] = ()
    weights: FloatArray | None = None
    exact: NDArray[np.bool_] | None = None
    worst: bool = False

    def refine(self, batch: LinkageBatch, rows: FloatArray, **how: Any) -> Refined:
        """Linkages (k,) with places (k, N, 3), refined to the least error; how: as in `refine`."""
        return refine(
            batch,
            self.places_of(rows),
            self.poses,
            self.length,
            weights=self.weights,
            exact=self.exact,
            **how,
        )

    def thinned(self, most: int) -> Target:
        """The target with at most `most` poses, evenly chosen; all exact poses stay."""
        count = self.poses.shape[0]
        if count <= most:
            return self
        index = np.linspace(0, count - 1, most).round().astype(np.intp)
        if self.exact is not None:
            index = np.union1d(index, np.flatnonzero(self.exact))
        return replace(
            self,
            poses=self.poses[index],
            weights=None if self.weights is None else self.weights[index],
            exact=None if self.exact is None else self.exact[index],
        )

    def places(self, batch: LinkageBatch) -> FloatArray:
        """Rows (k, N, 3) of the places nearest to the poses, on the circuit with the least cost."""
        rows = rows_of(on_circuits(batch, self.poses, self.length), self.length)
        cost = np.nan_to_num(self.cost(rows), nan=np.inf)
        return np.asarray(rows[np.arange(len(batch)), cost.argmin(axis=1)])

    def places_of(self, rows: FloatArray) -> Displacement:
        """Rows (*, 3) as displacements."""
        return places_of(rows, self.length)

    def rows_at(self, places: Displacement) -> FloatArray:
        """Rows (*, 3) of places in the task's own frames, the inverse of `places_of` and frames."""
        return rows_of(self.frames.to_canonical(places), self.length)

    def combined_error(self, rows: FloatArray) -> FloatArray:
        """The error (*,) of rows (*, N, 3) that a refinement makes least; infinite where nan."""
        gap = np.linalg.norm(rows - rows_of(self.poses, self.length), axis=-1)
        gap = np.nan_to_num(gap, nan=np.inf)
        if self.worst:
            return np.asarray(gap.max(axis=-1))
        share = shares(self.weights, self.poses.shape)
        return np.asarray(np.sqrt((gap * gap) @ share))

    def cost(self, rows: FloatArray) -> FloatArray:
        """The weighted sum of squared distances (*,) of rows (*, N, 3) from the poses."""
        gap = ((rows - rows_of(self.poses, self.length)) ** 2).sum(axis=-1)
        return np.asarray(gap.sum(axis=-1) if self.weights is None else gap @ self.weights)
