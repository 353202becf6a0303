"""The minima without limits, followed, and those that appear.

Newton's method moves each; one that it loses goes down from where it was.  The critical points of
the squared residual are followed, too, complex ones as well, as ways lead down from them to minima:
some steps of each for each task, so that a minimum that appears is met.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.circle_descent import further_down, steady_starts
from burmester.dyads.critical_points import CriticalDyads, continued_points, critical_dyads
from burmester.dyads.geometric_fit import circle_distances
from burmester.dyads.local_minima import BestDyads, is_hard, starts_of_one
from burmester.dyads.sliders import fixed_lines, moving_lines
from burmester.following.minimum_step import MovedMinima, moved_fit, moved_minima, twins
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import Dyad
from burmester.fourbar.linkage_batch import row_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, shares
from burmester.tasks.motion_task import Task

STEPS_DOWN = 12  # number of steps on each way down, for each task


class MovedFit(NamedTuple):
    """The best dyads of a new task, and where those of the task before went, if it is known."""

    strand: FreeMinima
    fit: BestDyads
    moves: list[tuple[Dyad, Dyad]]


@final
@dataclass(frozen=True, slots=True, eq=False)
class FreeMinima:
    """What is followed beside the minima themselves, in the frames of their fit.

    points: (c, 4), critical points; real: how many of them are; descents: (k, 5), circles on their
    way down.
    """

    points: ComplexArray
    real: int
    descents: FloatArray = field(default_factory=lambda: np.empty((0, 5)))

    @classmethod
    def of(cls, critical: CriticalDyads) -> Self:
        """Those of one task."""
        return cls(critical.points[: int(critical.found)], int(critical.real.sum()))

    def moved(self, fit: BestDyads, task: Task) -> MovedFit | None:
        """The minima of another task; None where all of them have to be found anew.

        That is where ways down are narrow and a minimum is lost or may appear.
        """
        seen, share = fit.frames.to_canonical(task.poses), shares(task.weights, task.poses.shape)
        there = self._watched(fit.frames, seen, task)
        hard = is_hard(np.array(len(there.points)), seen, share)
        moved = moved_minima(row_of(fit.circles), circle_distances(seen), share)
        if hard and not (moved.sound.all() and there.real == self.real):
            return None
        z, number = _down_where_lost(row_of(fit.circles), moved, seen, share)
        sliders = fixed_lines(seen, task.weights)[0][0], moving_lines(seen, task.weights)[0][0]
        if not hard:
            descents = there.descents
            if not len(descents):
                descents = steady_starts(starts_of_one(there.points, sliders, seen, share))
            down = further_down(descents, seen, share, STEPS_DOWN)
            z = np.concatenate([z, down.z[down.settled]])
            there = replace(there, descents=down.z[down.ended_at == 0])
        own = np.delete(np.arange(len(z)), twins(z))
        new = moved_fit(fit, z[own], sliders, seen)
        before, after = fit.listed(), new.listed()
        moves = list(zip(before[-len(sliders) :], after[-len(sliders) :], strict=True))
        moves += [
            (before[number[k]], each)
            for k, each in zip(own, after, strict=False)
            if k < len(number) and moved.sound[number[k]]
        ]
        return MovedFit(there, new, moves)

    def _watched(self, frames: CanonicalFrames, seen: Displacement, task: Task) -> Self:
        """With the critical points of another task; where they are others, all ways start anew."""
        points = continued_points(self.points, seen, task.weights)
        if points is not None:
            return replace(self, points=points)
        critical = critical_dyads(task.poses, task.weights)
        anew, own = type(self).of(critical), critical.frames
        origin, other = (
            np.concatenate([each.fixed_origin, each.moving_origin]) for each in (own, frames)
        )
        points = (anew.points * own.length + origin - other) / frames.length
        same = (len(points), anew.real) == (len(self.points), self.real)
        return replace(anew, points=points, descents=self.descents if same else anew.descents)


def _down_where_lost(
    z: FloatArray, moved: MovedMinima, seen: Displacement, share: FloatArray
) -> tuple[FloatArray, NDArray[np.intp]]:
    """Minima (k, 5), lost ones by the way down from before, with the number (k,) each had."""
    lost = np.flatnonzero(~moved.sound)
    if not len(lost):
        return moved.z, np.arange(len(z))
    there, here, down = moved.z.copy(), moved.sound.copy(), further_down(z[lost], seen, share)
    there[lost], here[lost] = down.z, down.settled
    return there[here], np.flatnonzero(here)
