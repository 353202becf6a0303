"""The best linkages of all poses, and of all poses but one."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.diagnosis.sampson_fits import (
    FITS_PER_LABEL,
    FULL_STEPS,
    SCREENING_STEPS,
    Fits,
    NormalizedPoses,
    fit_in_two_steps,
    fit_linkages,
    sampson_residuals,
)
from burmester.dyads.local_minima import best_dyads
from burmester.dyads.pencil import fit_pencil
from burmester.fourbar.dyad import PP, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch, row_of
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, concatenate, median, take

MAX_POSES_ALL_LEFT_OUT = 30  # poses; of more only the suspects are left out, one at a time
SAMPLE_SIZE = 60  # poses; the first fits to many poses are to a sample of about as many
SUSPECTS = 4  # poses without which fits start from dyads of their own
SUSPECTS_OF_MANY = 2  # the same where not every pose is left out
PAIRED_DYADS = 5  # the best dyads of a task that are joined in pairs
SHARED_STARTS = 3  # pairs of dyads of all poses that start the fits without one
REWEIGHTING_ROUNDS = 5  # of fits in which distant poses count less and less
REWEIGHTING_SCALE = 3.0  # median distances; a pose as far away counts a quarter


class LeaveOneOut(NamedTuple):
    """The best fits to all poses, and without each of the suspects.

    quadric_distances: (N,), how far the other poses are from lying on two quadrics; (0,) for many
        poses.
    own_starts: pairs of the best dyads without a pose, kept once they are known.
    """

    normalized: NormalizedPoses
    fits_to_all: Fits
    fits_without_one: Fits
    quadric_distances: FloatArray
    own_starts: dict[int, LinkageBatch]

    @classmethod
    def fit_all(
        cls,
        normalized: NormalizedPoses,
        dyads: Sequence[Dyad],
        poses: Displacement,
        *,
        enough: float = 0.0,
    ) -> tuple[LinkageBatch, Fits]:
        """The best dyads of all poses in pairs, and the fits from them.

        dyads: the best of the poses (N,) in their own frames, if they are known.
        enough: a cost that is low enough; pairs are taken as they are where one has it already.
        """
        given = len(dyads) > 2
        pairs = (
            _paired(dyads, poses).to_canonical(normalized.frames)
            if given
            else _best_pairs(normalized, -1)
        )
        none = np.full(len(pairs), -1)
        share = normalized.weights_without(none)
        residual, _ = sampson_residuals(pairs, normalized.rows, share)
        cost = (residual * residual).sum(axis=-1)
        if (cost <= enough).any():
            return pairs, Fits(pairs, cost, none)
        return pairs, fit_in_two_steps(pairs, none, normalized.rows, share)

    @classmethod
    def from_shared_starts(
        cls, normalized: NormalizedPoses, pairs: LinkageBatch, whole: Fits
    ) -> LeaveOneOut:
        """Fits from the dyads of all poses, and from the pencils without each pose."""
        count = len(normalized.rows)
        if count <= MAX_POSES_ALL_LEFT_OUT:
            each, starts = np.arange(count), concatenate([pairs[:SHARED_STARTS], whole.linkages])
            others = np.array([np.delete(each, k) for k in each])
            more, distances = pencil_pairs(normalized.poses[others], normalized.weights[others])
        else:
            each, starts = _suspects(normalized, whole.linkages)
            more, distances = whole.linkages[:0], np.empty(0)
        labels = np.concatenate([np.repeat(each, len(starts)), each[: len(more)]])
        linkages = concatenate([starts[np.tile(np.arange(len(starts)), len(each))], more])
        fits = fit_in_two_steps(
            linkages, labels, normalized.rows, normalized.weights_without(labels)
        )
        return cls(normalized, _refit_to_all(normalized, whole, fits), fits, distances, {})

    def best_pairs_without(self, pose: int) -> LinkageBatch:
        """The best dyads without a pose, joined in pairs; computed once."""
        if pose not in self.own_starts:
            self.own_starts[pose] = _best_pairs(self.normalized, pose)
        return self.own_starts[pose]

    def with_own_starts(self) -> LeaveOneOut:
        """The same with fits without the suspects that start from the best dyads without them."""
        normalized, fits = self.normalized, self.fits_without_one
        many = len(normalized.rows) > MAX_POSES_ALL_LEFT_OUT
        suspects = fits.labels_by_cost()[: SUSPECTS_OF_MANY if many else SUSPECTS]
        # The rest lies nearest to two quadrics: that measure depends on no start.
        suspects += [
            k
            for k in np.argsort(self.quadric_distances, kind="stable")[:SUSPECTS]
            if k not in suspects
        ]
        linkages, labels = fits.linkages, fits.labels
        for pose in suspects:
            new = self.best_pairs_without(pose)
            linkages, labels = (
                concatenate([linkages, new]),
                np.append(labels, np.full(len(new), pose)),
            )
        # The best fit without one pose may lead to the best without another.
        for pose in suspects:
            best = fits.of(pose).linkages[:1]
            for other in suspects:
                linkages, labels = concatenate([linkages, best]), np.append(labels, other)
        fits = fit_in_two_steps(
            linkages, labels, normalized.rows, normalized.weights_without(labels)
        )
        return self._replace(
            fits_without_one=fits, fits_to_all=_refit_to_all(normalized, self.fits_to_all, fits)
        )


def _refit_to_all(normalized: NormalizedPoses, whole: Fits, fits: Fits) -> Fits:
    """The fits to all poses, also from the best fits without one, which may lead to better ones."""
    best = fits.best(1)
    best = take(best, np.argsort(best.cost, kind="stable")[:SUSPECTS])
    none = np.full(len(best.cost), -1)
    linkages, cost = fit_linkages(
        best.linkages, normalized.rows, normalized.weights_without(none), FULL_STEPS
    )
    return concatenate([whole, Fits(linkages, cost, none)]).best(FITS_PER_LABEL)


def _paired(dyads: Sequence[Dyad], poses: Displacement) -> LinkageBatch:
    """The best of the dyads, joined in pairs, those of better dyads first."""
    dyads = [each for each in dyads if not isinstance(each, PP)]
    error = [float((each.residual(poses) ** 2).mean()) for each in dyads]
    order = np.argsort(np.nan_to_num(error, nan=np.inf), kind="stable")[:PAIRED_DYADS]
    return LinkageBatch.of([Linkage(dyads[a], dyads[b]) for a, b in combinations(order, 2)])


def _best_pairs(normalized: NormalizedPoses, left_out: int) -> LinkageBatch:
    """The best dyads of all poses but one (of a sample, where there are many), joined in pairs."""
    keep = np.flatnonzero(normalized.mask_without(left_out))
    keep = keep[:: max(1, len(keep) // SAMPLE_SIZE)]
    poses = normalized.poses[keep]
    return _paired(best_dyads(poses, normalized.weights[keep]).listed(), poses)


def pencil_pairs(
    poses: Displacement, weights: FloatArray | None
) -> tuple[LinkageBatch, FloatArray]:
    """For each of tasks (n, N) the pair of dyads of the paper's pencil, (n,).

    With the distances (n,) of the poses from two quadrics.
    """
    pencil = fit_pencil(poses, weights)
    # A pencil may have one dyad only: another circle, any one, takes the place of the second.
    coefficients = pencil.dyads.coefficients()
    lost = ~np.isfinite(coefficients).all(axis=-1) | ~(pencil.rms_error < np.inf)
    z = row_of(pencil.dyads)
    z[lost] = z[:, ::-1][lost] + np.array([0.1, 0.2, 0.3, 0.4, 0.0])
    z = np.where(np.isfinite(z), z, 1.0)
    pairs = LinkageBatch(np.zeros(z.shape[:-1], dtype=np.int8), z)
    return pairs, pencil.noise * pencil.frames.length


def _suspects(
    normalized: NormalizedPoses, pairs: LinkageBatch
) -> tuple[NDArray[np.intp], LinkageBatch]:
    """Of many poses those that may be odd, and linkages that fit the others."""
    away = np.linalg.norm(normalized.rows[:, :2] - median(normalized.rows[:, :2], 0), axis=-1)
    farthest = int(away.argmax())
    linkages = concatenate([pairs, _best_pairs(normalized, farthest)])
    some = np.arange(len(normalized.rows))[:: max(1, len(normalized.rows) // SAMPLE_SIZE)]
    rows, weights = normalized.rows[some], normalized.weights[some]
    share = np.tile(weights, (len(linkages), 1))
    for _ in range(REWEIGHTING_ROUNDS):
        linkages, _ = fit_linkages(linkages, rows, share, SCREENING_STEPS)
        off = _distances(linkages, rows)
        middle = median(off, -1)
        share = (
            weights / (1 + (off / (REWEIGHTING_SCALE * middle + np.finfo(float).tiny)) ** 2) ** 2
        )
    best = np.argsort(middle[:, 0], kind="stable")[:FITS_PER_LABEL]
    off = _distances(linkages[best], normalized.rows)
    far = np.argsort(-np.sqrt(normalized.weights) * off, axis=-1)[:, :FITS_PER_LABEL]
    each = np.unique(np.append(far.ravel(), farthest)).astype(np.intp)
    return each, linkages[best]


def _distances(linkages: LinkageBatch, rows: FloatArray) -> FloatArray:
    """Distances (k, N) of poses (N, 3) from the motions of linkages (k,)."""
    miss, _ = sampson_residuals(linkages, rows, np.ones((len(linkages), len(rows))))
    return np.asarray(np.linalg.norm(miss.reshape(len(linkages), -1, 2), axis=-1))
