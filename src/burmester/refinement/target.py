"""The target of a linkage synthesis: poses in their frames, weights, limits, requirements."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.box_places import places_in_boxes
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.foot_points import places_of, rows_of
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import on_circuits
from burmester.fourbar.timed_places import places_at_turns
from burmester.fourbar.traced_places import places_along
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, even_numbers, shares, take
from burmester.numerics.linear_algebra import matvec
from burmester.refinement.constraints import Constraints
from burmester.refinement.kept_timing import TimingConstraint
from burmester.refinement.least_error import Refined, refine
from burmester.refinement.tolerance_boxes import ToleranceBoxes
from burmester.tasks.pose_sample import PoseSample
from burmester.tasks.requirements import Requirements
from burmester.tasks.traced_path import TracedPath

# Stay on one circuit if its worst error is at most this many times the unrestricted one.
ONE_CIRCUIT_RATIO = 2.0


@final
@dataclass(frozen=True, slots=True, eq=False)
class Target:
    """Poses (N,) to come near to, in the frames of `pose_error.error_frames`, and what else holds.

    kept: the limits of the dyads, as constraints, and the boxes.
    weights, exact, worst: as in `refine`.
    boxes: where the task has tolerances; then errors count in their metric.
    path: where the poses are points of a path; then places are those that trace it.
    least_links: (4,), the least lengths of links as `pin_distances` has them, in the same frames:
        searches for linkages that work keep to them.
    whole, index: where these are a sample of more poses, the target of them all, and which of
        them these are.
    """

    poses: Displacement
    length: float
    frames: CanonicalFrames
    requirements: Requirements
    kept: tuple[Constraints, ...] = ()
    weights: FloatArray | None = None
    exact: NDArray[np.bool_] | None = None
    worst: bool = False
    boxes: ToleranceBoxes | None = None
    path: TracedPath | None = None
    least_links: FloatArray | None = None
    whole: Target | None = None
    index: NDArray[np.intp] | None = None

    @property
    def relaxed(self) -> Target:
        """The same without the condition that places are inside the boxes."""
        return self if self.boxes is None else self._with_boxes(replace(self.boxes, binding=False))

    @property
    def without_boxes(self) -> Target:
        """The same without tolerances: distances count as they are."""
        kept = tuple(each for each in self.kept if not isinstance(each, ToleranceBoxes))
        return replace(self, kept=kept, boxes=None)

    def _with_boxes(self, boxes: ToleranceBoxes) -> Target:
        return replace(self, kept=(*self.without_boxes.kept, boxes), boxes=boxes)

    def refine(
        self, batch: LinkageBatch, rows: FloatArray, metric: FloatArray | None = None, **how: Any
    ) -> Refined:
        """Linkages (k,) with places (k, N, 3), refined to the least error; how: as in `refine`.

        metric: by default that of the boxes, where there are some.
        """
        if metric is None and self.boxes is not None:
            metric = self.boxes.metric
        return refine(
            batch,
            self.places_of(rows),
            self.poses,
            self.length,
            weights=self.weights,
            exact=self.exact,
            metric=metric,
            **how,
        )

    def thinned(self, most: int) -> Target:
        """The target with at most `most` poses, evenly chosen; all exact poses stay."""
        if self.poses.shape[0] <= most:
            return self
        index = self.thin_numbers(most)
        return self._at(index, None if self.weights is None else self.weights[index])

    def thin_numbers(self, most: int) -> NDArray[np.intp]:
        """The numbers of the poses that `thinned` chooses."""
        index = even_numbers(self.poses.shape[0], most)
        return index if self.exact is None else np.union1d(index, np.flatnonzero(self.exact))

    def sampled(self, sample: PoseSample) -> Target:
        """The target by a sample of its poses, which keeps the whole one."""
        weights: FloatArray | None = sample.cells
        if self.worst:  # of single poses
            weights = None if self.weights is None else self.weights[sample.index]
        return replace(self._at(sample.index, weights), whole=self, index=sample.index)

    def _at(self, index: NDArray[np.intp], weights: FloatArray | None) -> Target:
        thin = self if self.boxes is None else self._with_boxes(take(self.boxes, index))
        exact = None if self.exact is None else self.exact[index]
        path = self.path and self.path.at(index)
        kept = (
            part.at(index) if isinstance(part, TimingConstraint) else part for part in thin.kept
        )
        own = tuple(part for part in kept if part is not None)
        poses = self.poses[index]
        return replace(thin, poses=poses, kept=own, weights=weights, exact=exact, path=path)

    def places(self, batch: LinkageBatch, *, on_both: bool = False) -> FloatArray:
        """Rows (k, N, 3) of the places nearest to the poses, on the circuit with the least cost.

        Where there are boxes: of the places deepest inside them, on the circuit that uses the least
        share of all.  on_both: on both circuits, where only so all are inside, or where nothing has
        a tolerance and one circuit alone is much farther away.  Along a path: see
        `traced`.
        """
        if self.path is not None:
            return self.traced(batch)[0]
        if self.boxes is not None:
            rows, every = rows_of(places_in_boxes(batch, self.boxes.boxes), self.length), len(batch)
            used = self.boxes.boxes.share(rows)
            worst = used.max(axis=-1)
            one = rows[np.arange(every), worst.argmin(axis=1)]
            side = used.argmin(axis=1)
            mixed = np.take_along_axis(rows, side[:, None, :, None], axis=1)[:, 0]
            least, most = used.min(axis=1).max(axis=-1), worst.min(axis=1)
            nearer = (least <= 1) | (not self.boxes.give_room) & (most > ONE_CIRCUIT_RATIO * least)
            split = on_both & (most > 1) & nearer
            return np.where(split[:, None, None], mixed, one)
        rows = rows_of(on_circuits(batch, self.poses, self.length), self.length)
        cost = np.nan_to_num(self.cost(rows), nan=np.inf)
        return np.asarray(rows[np.arange(len(batch)), cost.argmin(axis=1)])

    def traced(self, batch: LinkageBatch) -> tuple[FloatArray, NDArray[np.intp] | None]:
        """Rows (k, N, 3) of the places that trace the path, and the sides (k,) of the cranks.

        In the order of the points, or at their crank angles; only these say which dyad drives.
        """
        assert self.path is not None
        points, turns, w = self.poses.translation, self.path.crank_angles, self.weights
        if turns is not None:
            return places_at_turns(batch, points, turns, self.length, weights=w)
        rows = places_along(
            batch,
            points,
            self.length,
            weights=w,
            boxes=None if self.boxes is None else self.boxes.boxes,
            any_order=self.requirements.any_order,
        )
        return rows, None

    def at_angles(self, batch: LinkageBatch, rows: FloatArray) -> FloatArray:
        """Rows (k, N, 3) of places, those of timed poses where the driver is at its angle."""
        wanted = rows_of(self.poses, self.length)
        for each in self.kept:
            if isinstance(each, TimingConstraint):
                return each.timed_places(batch, rows, wanted)
        return rows

    def places_of(self, rows: FloatArray) -> Displacement:
        """Rows (*, 3) as displacements."""
        return places_of(rows, self.length)

    def rows_at(self, places: Displacement) -> FloatArray:
        """Rows (*, 3) of places in the task's own frames, the inverse of `places_of` and frames."""
        return rows_of(self.frames.to_canonical(places), self.length)

    def combined_error(self, rows: FloatArray) -> FloatArray:
        """The error (*,) of rows (*, N, 3) that a refinement makes least; infinite where nan."""
        away = rows - rows_of(self.poses, self.length)
        if self.boxes is not None:
            away = self.boxes.counted(rows)
        gap = np.linalg.norm(away, axis=-1)
        gap = np.nan_to_num(gap, nan=np.inf)
        if self.worst:
            return np.asarray(gap.max(axis=-1))
        share = shares(self.weights, self.poses.shape)
        return np.asarray(np.sqrt((gap * gap) @ share))

    def cost(self, rows: FloatArray) -> FloatArray:
        """The weighted sum of squared distances (*,) of rows (*, N, 3) from the poses."""
        away = rows - rows_of(self.poses, self.length)
        if self.boxes is not None:
            away = matvec(self.boxes.metric, away)
        gap = (away**2).sum(axis=-1)
        return np.asarray(gap.sum(axis=-1) if self.weights is None else gap @ self.weights)
