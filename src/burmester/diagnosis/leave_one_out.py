"""The best linkages of some poses, and of all but one."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.diagnosis.sampson_fits import (
    KEPT,
    LONG,
    SHORT,
    Fits,
    Seen,
    fitted,
    in_two_steps,
    misses,
)
from burmester.dyads.local_minima import best_dyads
from burmester.dyads.pencil import fit_pencil
from burmester.fourbar.dyad import PP, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import concatenate, take

__all__ = ["EVERY", "LeaveOneOut", "pencil_pairs"]

EVERY = 30  # of so few poses each is left out; of more the likeliest
SAMPLE = 60  # of many poses so many lead to the first fits
LIKELY, FEW = 4, 2  # poses whose fits start from dyads of their own
BEST, SHARED = 5, 3  # dyads joined in pairs, of each fit; pairs of the whole fit to start from
ROUNDS, FAR = 5, 3.0  # of weighing down what is so many times as far as the most


class LeaveOneOut(NamedTuple):
    """The best fits to all poses, and without each of the likeliest.

    held: (N,), how far the others are from being held by two quadrics; (0,) for many poses.
    known: pairs of the best dyads without a pose, as far as they were looked for.
    """

    seen: Seen
    whole: Fits
    fits: Fits
    held: FloatArray
    known: dict[int, LinkageBatch]

    @classmethod
    def whole_of(
        cls, seen: Seen, dyads: Sequence[Dyad], poses: Displacement
    ) -> tuple[LinkageBatch, Fits]:
        """The best dyads of all poses (if given, in their own frames) in pairs, and the fits."""
        given = len(dyads) > 2
        pairs = _paired(dyads, poses).seen(seen.frames) if given else _own_pairs(seen, -1)
        none = np.full(len(pairs), -1)
        return pairs, in_two_steps(pairs, none, seen.rows, seen.shares(none))

    @classmethod
    def quickly(cls, seen: Seen, pairs: LinkageBatch, whole: Fits) -> LeaveOneOut:
        """Fits from the dyads of all poses, and from the pencils without each."""
        count = len(seen.rows)
        if count <= EVERY:
            each, starts = np.arange(count), concatenate([pairs[:SHARED], whole.stack])
            others = np.array([np.delete(each, k) for k in each])
            more, held = pencil_pairs(seen.poses[others], seen.weights[others])
        else:
            each, starts = _likely(seen, whole.stack)
            more, held = whole.stack[:0], np.empty(0)
        own = np.concatenate([np.repeat(each, len(starts)), each[: len(more)]])
        stack = concatenate([starts[np.tile(np.arange(len(starts)), len(each))], more])
        fits = in_two_steps(stack, own, seen.rows, seen.shares(own))
        return cls(seen, _and_again(seen, whole, fits), fits, held, {})

    def own_pairs(self, pose: int) -> LinkageBatch:
        """The best dyads without a pose, joined in pairs; looked for once."""
        if pose not in self.known:
            self.known[pose] = _own_pairs(self.seen, pose)
        return self.known[pose]

    def thoroughly(self) -> LeaveOneOut:
        """The same without the likeliest from the best dyads without them, too."""
        seen, fits = self.seen, self.fits
        many = len(seen.rows) > EVERY
        likely = fits.by_cost()[: FEW if many else LIKELY]
        # Where two quadrics hold the rest best: no start leads astray there.
        likely += [k for k in np.argsort(self.held, kind="stable")[:LIKELY] if k not in likely]
        stack, own = fits.stack, fits.own
        for pose in likely:
            new = self.own_pairs(pose)
            stack, own = concatenate([stack, new]), np.append(own, np.full(len(new), pose))
        # What leads to the best fit without one pose may do so without another.
        for pose in likely:
            best = fits.of(pose).stack[:1]
            for other in likely:
                stack, own = concatenate([stack, best]), np.append(own, other)
        fits = in_two_steps(stack, own, seen.rows, seen.shares(own))
        return self._replace(fits=fits, whole=_and_again(seen, self.whole, fits))


def _and_again(seen: Seen, whole: Fits, fits: Fits) -> Fits:
    """The fits to all poses, and from those without the likeliest: they may be the best of all."""
    best = fits.best(1)
    best = take(best, np.argsort(best.cost, kind="stable")[:LIKELY])
    none = np.full(len(best.cost), -1)
    stack, cost = fitted(best.stack, seen.rows, seen.shares(none), LONG)
    return concatenate([whole, Fits(stack, cost, none)]).best(KEPT)


def _dyads(poses: Displacement, weights: FloatArray | None) -> list[Dyad]:
    """The best dyads of poses (N,)."""
    best = best_dyads(poses, weights)
    circles: list[Dyad] = [best.dyads[i] for i in range(len(best.rms_error))]
    return circles + [best.frames.line_back(line) for line in best.sliders]


def _paired(dyads: Sequence[Dyad], poses: Displacement) -> LinkageBatch:
    """The best of the dyads, joined in pairs, those of the better ones first."""
    dyads = [each for each in dyads if not isinstance(each, PP)]
    error = [float((each.residual(poses) ** 2).mean()) for each in dyads]
    order = np.argsort(np.nan_to_num(error, nan=np.inf), kind="stable")[:BEST]
    return LinkageBatch.of([Linkage(dyads[a], dyads[b]) for a, b in combinations(order, 2)])


def _own_pairs(seen: Seen, left_out: int) -> LinkageBatch:
    """The best dyads of all poses but one (of many: of a sample), joined in pairs."""
    keep = np.flatnonzero(seen.without(left_out))
    keep = keep[:: max(1, len(keep) // SAMPLE)]
    return _paired(_dyads(seen.poses[keep], seen.weights[keep]), seen.poses[keep])


def pencil_pairs(
    poses: Displacement, weights: FloatArray | None
) -> tuple[LinkageBatch, FloatArray]:
    """For each of tasks (n, N) the pair of dyads of the paper's pencil, (n,).

    With how far (n,) the poses are from being held by two quadrics.
    """
    found = fit_pencil(poses, weights)
    # A pencil may have one dyad only: any circle in the place of the other one.
    own = found.dyads.coefficients()
    lost = ~np.isfinite(own).all(axis=-1) | ~(found.rms_error < np.inf)
    z = np.concatenate(
        [found.dyads.fixed_pivot, found.dyads.moving_pivot, found.dyads.radius[..., None]], axis=-1
    )
    z[lost] = z[:, ::-1][lost] + np.array([0.1, 0.2, 0.3, 0.4, 0.0])
    z = np.where(np.isfinite(z), z, 1.0)
    pairs = LinkageBatch(np.zeros(z.shape[:-1], dtype=np.int8), z)
    return pairs, found.noise * found.frames.length


def _likely(seen: Seen, pairs: LinkageBatch) -> tuple[NDArray[np.intp], LinkageBatch]:
    """Of many poses those that may be odd, and linkages that pass the others by.

    Fits in which poses far away count less and less.
    """
    away = np.linalg.norm(seen.rows[:, :2] - np.median(seen.rows[:, :2], axis=0), axis=-1)
    farthest = int(away.argmax())
    stack = concatenate([pairs, _own_pairs(seen, farthest)])
    some = np.arange(len(seen.rows))[:: max(1, len(seen.rows) // SAMPLE)]
    rows, weights = seen.rows[some], seen.weights[some]
    share = np.tile(weights, (len(stack), 1))
    for _ in range(ROUNDS):
        stack, _ = fitted(stack, rows, share, SHORT)
        off = _off(stack, rows)
        middle = np.median(off, axis=-1, keepdims=True)
        share = weights / (1 + (off / (FAR * middle + np.finfo(float).tiny)) ** 2) ** 2
    best = np.argsort(middle[:, 0], kind="stable")[:KEPT]
    off = _off(stack[best], seen.rows)
    far = np.argsort(-np.sqrt(seen.weights) * off, axis=-1)[:, :KEPT]
    each = np.unique(np.append(far.ravel(), farthest)).astype(np.intp)
    return each, stack[best]


def _off(stack: LinkageBatch, rows: FloatArray) -> FloatArray:
    """Distances (k, N) of poses (N, 3) from the motions of linkages (k,)."""
    miss, _ = misses(stack, rows, np.ones((len(stack), len(rows))))
    return np.asarray(np.linalg.norm(miss.reshape(len(stack), -1, 2), axis=-1))
