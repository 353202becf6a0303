"""Linkages as they are built, each dimension off within a tolerance, and moved to their poses.

Nothing here is linearised.  A built linkage is on one circuit: Newton's method leads from the
nominal places to its own; where these are not on one circuit, where the method does not converge
and where an error decides, both circuits are searched (`nearest_places`) and the better one counts.
A nominal linkage whose places are on two circuits keeps the nearer one at each pose.

A built linkage that has no circuit at all cannot be assembled.  All arguments are in one frame and
unit, where lengths are about 1 (`pose_error.error_frames`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import circuit_of
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import foot_points, places_of, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, DYAD_KINDS, LinkageBatch
from burmester.fourbar.nearest_places import on_circuits
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, concatenate, take
from burmester.verdicts.uncertainty import line_middle

DRAWS = 1000  # number of linkages built at random
PERCENTILE = 95.0  # per cent of the built linkages within `greatest_95`
TAIL = 0.2  # share of the linkages drawn whose places are searched on whole circuits, at least
STARTS = 6  # number of linkages from which the greatest error is searched
WORSE = 1e-6  # relative; an error that is greater by less is no improvement
STEPS = (2.0, 1.0, 0.5, 0.25, 0.125)  # tolerances, of one dimension's error


@final
@dataclass(frozen=True, slots=True, eq=False)
class Built:
    """Linkages (n,) built from one, with their places nearest to poses (N,).

    off: (n, 10), the errors of the dimensions, in tolerances.
    rows: (n, N, 3), of their places; nan where the linkage cannot be assembled.
    position: (n, N), their position errors, infinite for nan places.
    """

    off: FloatArray
    rows: FloatArray
    position: FloatArray

    @property
    def greatest(self) -> FloatArray:
        """The greatest position error (n,) at a pose."""
        return np.asarray(self.position.max(axis=-1))

    @property
    def assembled(self) -> NDArray[np.bool_]:
        """Which linkages (n,) can be assembled."""
        return np.isfinite(self.greatest)


@final
@dataclass(frozen=True, slots=True, eq=False)
class BuiltLinkages:
    """All linkages within a tolerance of a nominal one.

    kinds: (2,); nominal: (2, 5), the dimensions; by_errors: (2, 5, 5), their derivatives by errors
    that are lengths; tolerance: of each error.
    poses: (N,); start: (N, 3), rows of the nominal places; two_circuits: whether these are on both.
    """

    kinds: NDArray[np.int8]
    nominal: FloatArray
    by_errors: FloatArray
    tolerance: float
    poses: Displacement
    start: FloatArray
    two_circuits: bool
    length: float

    @classmethod
    def of(
        cls,
        batch: LinkageBatch,
        poses: Displacement,
        places: Displacement,
        length: float,
        tolerance: float,
    ) -> BuiltLinkages:
        """Those of a single linkage, batch and places of shapes (1,) and (1, N)."""
        (_, linkage), *_ = batch.alike()
        circuit = circuit_of(linkage, places, as_given=True).circuit
        by_errors = dimensions_by_errors(batch, line_middle(batch, places), length)[0]
        start = rows_of(places, length)[0]
        two = bool((circuit != circuit[:, :1]).any())
        own = batch.kinds[0], batch.dimensions[0], by_errors, tolerance
        return cls(*own, poses, start, two, length)

    def batch(self, off: FloatArray) -> LinkageBatch:
        """The linkages (n,) with errors (n, 10), in tolerances."""
        error = self.tolerance * off.reshape(-1, 2, DIMENSIONS)
        dimensions = self.nominal + np.einsum("sji,nsi->nsj", self.by_errors, error)
        return LinkageBatch(np.broadcast_to(self.kinds, (len(off), 2)), dimensions)

    def at_random(self, draws: int = DRAWS, seed: int = 0) -> Built:
        """Linkages built at random, their errors spread evenly within the tolerance.

        The places are searched on whole circuits for the TAIL that is farthest from the poses, and
        down to the 95th percentile of the errors; the other places may not be the nearest.
        """
        off = np.random.default_rng(seed).uniform(-1, 1, size=(draws, 2 * DIMENSIONS))
        built, sure = self._followed(off)
        away = self._away(built.rows)
        far = away >= np.sort(away)[int((1 - TAIL) * draws)]
        while True:
            far |= built.greatest >= percentile_95(built.greatest)
            unsure = np.flatnonzero(far & ~sure)
            if not len(unsure):
                return built
            built = self._searched(built, unsure)
            sure[unsure] = True

    def with_errors(self, off: FloatArray) -> Built:
        """The linkages with errors (n, 10), in tolerances, their places searched on circuits."""
        built, sure = self._followed(off)
        return self._searched(built, np.flatnonzero(~sure))

    def worst(self, starts: Built, *, corners_only: bool = False) -> Built:
        """The linkage (1,) with the greatest error that a search from others (n,) finds.

        The worst of them, and the corners of the tolerance beside these, are improved by steps of
        one dimension at a time, ever smaller ones; from corner to corner only if asked so.  That
        there is no worse linkage is not proved.
        """
        best = _worst_of(starts)
        corners = self.with_errors(np.where(best.off < 0, -1.0, 1.0))
        best = _worst_of(concatenate([best, corners]))
        used = np.flatnonzero(np.abs(self.by_errors).sum(axis=1).ravel() > 0)
        for step in STEPS[:1] if corners_only else STEPS:
            improved = True
            while improved:
                best, improved = self._improved(best, used, step)
        return take(best, [int(best.greatest.argmax())])

    def _improved(self, best: Built, used: NDArray[np.intp], step: float) -> tuple[Built, bool]:
        """Each linkage (n,) or the worst one a step away from it, and whether any got worse."""
        ways = step * np.concatenate([np.eye(2 * DIMENSIONS)[used], -np.eye(2 * DIMENSIONS)[used]])
        off = np.clip(best.off[:, None] + ways, -1, 1).reshape(-1, 2 * DIMENSIONS)
        least = np.repeat(best.greatest * (1 + WORSE), len(ways))
        built, sure = self._followed(off)
        far = self._away(built.rows) > np.repeat(self._away(best.rows), len(ways))
        far |= built.greatest > least
        built = self._searched(built, np.flatnonzero(far & ~sure))
        value = np.where(built.assembled, built.greatest, -np.inf)
        worse = value.reshape(len(best.off), -1)
        index = worse.argmax(axis=-1) + len(ways) * np.arange(len(worse))
        better = value[index] > least[index]
        rows = np.where(better, len(best.off) + index, np.arange(len(worse)))
        return take(concatenate([best, built]), rows), bool(better.any())

    def _followed(self, off: FloatArray) -> tuple[Built, NDArray[np.bool_]]:
        """Linkages with errors (n, 10), moved from the nominal places; which are sure."""
        batch = self.batch(off)
        start = np.broadcast_to(self.start, (len(off), *self.start.shape))
        rows = foot_points(batch, start, rows_of(self.poses, self.length), self.length)
        sound = np.asarray(np.isfinite(rows).all(axis=(1, 2)))
        if not self.two_circuits:
            for index, linkage in batch[sound].alike():
                at = np.flatnonzero(sound)[index]
                places = places_of(rows[at], self.length)
                circuit = circuit_of(linkage, places, as_given=True).circuit
                sound[at] = ((circuit >= 0) & (circuit == circuit[:, :1])).all(axis=-1)
        rows = np.where(sound[:, None, None], rows, np.nan)
        built = Built(off, rows, self._errors(rows))
        return self._searched(built, np.flatnonzero(~sound)), np.asarray(~sound)

    def _searched(self, built: Built, index: NDArray[np.intp]) -> Built:
        """The same with the places of some linkages searched on whole circuits."""
        if not len(index):
            return built
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            both = on_circuits(self.batch(built.off[index]), self.poses, self.length)
        rows = rows_of(both, self.length)
        square = self._squares(rows)
        if not self.two_circuits:  # one circuit for all poses
            square = np.broadcast_to(square.sum(axis=-1, keepdims=True), square.shape)
        side = square.argmin(axis=1)
        nearest = np.take_along_axis(rows, side[:, None, :, None], axis=1)[:, 0]
        squares = (self._squares(each).sum(axis=-1) for each in (nearest, built.rows[index]))
        nearer = np.less_equal(*squares)
        all_rows = built.rows.copy()
        all_rows[index[nearer]] = nearest[nearer]
        return Built(built.off, all_rows, self._errors(all_rows))

    def _away(self, rows: FloatArray) -> FloatArray:
        """The greatest distance (n,) of rows (n, N, 3) from the poses; infinite for nan ones."""
        return np.asarray(np.sqrt(self._squares(rows).max(axis=-1)))

    def _squares(self, rows: FloatArray) -> FloatArray:
        """The squared distances (n, N) of rows from the poses, angles counting; nan is far."""
        gap = rows - rows_of(self.poses, self.length)
        return np.asarray(np.nan_to_num((gap**2).sum(axis=-1), nan=np.inf))

    def _errors(self, rows: FloatArray) -> FloatArray:
        gap = rows[..., :2] - self.poses.translation
        return np.asarray(np.nan_to_num(np.hypot(gap[..., 0], gap[..., 1]), nan=np.inf))


def _worst_of(built: Built) -> Built:
    """The STARTS linkages, if there are so many, with the greatest errors that can be assembled."""
    assembled = np.flatnonzero(built.assembled)
    return take(built, assembled[np.argsort(built.greatest[assembled])[::-1][:STARTS]])


def dimensions_by_errors(batch: LinkageBatch, middle: FloatArray, length: float) -> FloatArray:
    """Derivatives (k, 2, 5, 5) of the dimensions of each dyad by building errors, as lengths.

    middle: (k, 2), where a slider's line turns (`line_middle`).
    """
    made = np.zeros((*batch.kinds.shape, DIMENSIONS, DIMENSIONS))
    made[:] = np.eye(DIMENSIONS)
    made[batch.kinds != DYAD_KINDS.index(RR), -1, -1] = 0.0
    for kind, at in ((PR, 0), (RP, 2)):
        rows = batch.kinds == DYAD_KINDS.index(kind)
        made[rows, at, at] = 1 / length
        made[rows, at + 1, at] = middle[rows] / length  # turned about the middle
    return made


def percentile_95(greatest: FloatArray) -> float:
    """The 95th percentile of the finite ones of (n,) values: one of them, no interpolation."""
    finite = greatest[np.isfinite(greatest)]
    return float(np.percentile(finite, PERCENTILE, method="higher")) if len(finite) else np.inf
