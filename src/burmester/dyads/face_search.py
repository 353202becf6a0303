"""The search on the faces of limits: what is minimised, and every way down from a start."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.face_descent import descend, inside
from burmester.dyads.geometric_fit import DistanceFunction, FitProblem, GeometricFit, Point
from burmester.dyads.least_powers import (
    SETTLED_STEP,
    free_minima,
    least_powers,
    least_squares,
    least_squares_step,
    pseudo_inverse,
)
from burmester.dyads.limited_block import Block
from burmester.numerics.arrays import Bundle, FloatArray, concatenate, put, unique_rows, where
from burmester.numerics.iteration import iterate
from burmester.numerics.linear_algebra import matvec
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


SINGULAR = 1e-15  # share of the greatest singular value, below which one is zero
MAX_MINIMAX_STEPS = 20  # of Newton's method once the worst poses are known
FIRST_MINIMAX_POWER = 32  # of the distances, from which on the worst poses are looked for
MAX_POWER = 4096  # of the distances; no higher sums are minimised
WORST_POSE_SHARE = 1e-3  # of the greatest multiplier, below which a pose is none of the worst
MAX_MINIMAX_STEP = 10.0  # lengths; a longer step has left the minimum
LEVEL_TOLERANCE = 1e-9  # relative; worst distances this near to each other are equal
BALANCE_TOLERANCE = 1e-8  # relative; what is left of the gradient at a minimax
MULTIPLIER_ROUNDING = 1e-9  # a multiplier so far below zero is zero
EXACT_RESIDUAL = 1e-11  # relative; an exact pose missed by less is met


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
        """Add the new minima to which dyads z (k, n) lead; False where that was given up."""
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
    """Most of the different rows z (k, n): where they come first, and which of these each is."""
    rounded = np.round(z / (SAME_DYAD * _size(z)[:, None]))
    _, first, each = np.unique(rounded, axis=0, return_index=True, return_inverse=True)
    return first, each.ravel()


def least_worst(problem: FitProblem, z: FloatArray, along: FloatArray) -> GeometricFit:
    """Local minima of the worst distance, counted by the root of weight / mean weight.

    Sums of ever higher powers of the distances; and once it is plain which poses are the worst,
    Newton's method on their distances being equal.
    """
    exact, weights = problem.exact, problem.weights
    root = np.where(exact, 1.0, np.sqrt(weights / weights[~exact].mean()))
    counted = problem.distances.times(root)
    unweighted = FitProblem(counted, np.where(exact, 0.0, 1.0), exact)
    best = least_squares(problem, z, along)
    worst = np.abs(unweighted.loose * counted.only(best.z)).max(axis=-1)
    rows, power = np.flatnonzero(~(worst < SETTLED_STEP)), 2
    while len(rows) and power < MAX_POWER:
        power *= 2
        fit = least_powers(unweighted, best.z[rows], along[rows], power)
        fit = fit._replace(settled=np.zeros(len(rows), dtype=bool))
        if power >= FIRST_MINIMAX_POWER:
            minimax = _minimax(unweighted, fit, along[rows])
            fit = where(minimax.settled, minimax, fit)
        unscaled = problem.distances.at(fit.z)
        put(best, rows, GeometricFit(unscaled, root * fit.by_distance, fit.settled))
        rows = rows[~fit.settled]
    return best


class _Balance(NamedTuple):
    """Dyads (k, n) on the way to where their worst distances are equal.

    level: (k,), of these; worst: (k, W), the poses that may be worst, sign: (k, W), of their
    distances, 0 where a pose is none of them; multipliers: (k, W + e), theirs and those of the
    exact poses; along: (k, n, n), projectors; failed: (k,).
    """

    at: Point
    level: FloatArray
    worst: NDArray[np.intp]
    sign: FloatArray
    multipliers: FloatArray
    along: FloatArray
    failed: NDArray[np.bool_]

    def by_distance(self, exact: NDArray[np.bool_]) -> FloatArray:
        """The derivatives (k, N) by the distances that the multipliers stand for."""
        out, count = np.zeros(self.at.here.distance.shape), self.worst.shape[1]
        np.put_along_axis(out, self.worst, self.multipliers[:, :count] * self.sign, axis=-1)
        out[:, exact] = self.multipliers[:, count:]
        return out

    def conditions(self, exact: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
        """What has to be zero (k, W + e), and its Jacobian (k, W + e, n + 1) by z and level."""
        here, among = self.at.here, self.sign != 0
        distance = np.take_along_axis(here.distance, self.worst, axis=-1)
        gap = np.where(among, self.sign * distance - self.level[:, None], 0.0)
        jacobian = here.jacobian @ self.along
        rows = np.take_along_axis(jacobian, self.worst[..., None], axis=1)
        rows = np.concatenate([self.sign[..., None] * rows, -among[..., None].astype(float)], -1)
        held = np.pad(jacobian[:, exact], ((0, 0), (0, 0), (0, 1)))
        return (
            np.concatenate([gap, here.distance[:, exact]], axis=-1),
            np.concatenate([rows, held], axis=1),
        )


def _minimax(problem: FitProblem, near: GeometricFit, along: FloatArray) -> GeometricFit:
    """Where the worst distances are equal and the exact poses met; settled if that is a minimum.

    Newton's method on z, the level, and the multipliers of these poses.
    """
    exact, size = problem.exact, near.z.shape[1]
    right = np.eye(size + 1)[-1]

    def advance(_: NDArray[np.intp], old: _Balance) -> tuple[_Balance, NDArray[np.bool_]]:
        gap, matrix = old.conditions(exact)
        transposed, count = np.swapaxes(matrix, -1, -2), size + 1 + gap.shape[1]
        whole = np.zeros((len(gap), count, count))
        curvature = old.at.here.curvature(old.by_distance(exact))
        whole[:, :size, :size] = old.along @ curvature @ old.along
        whole[:, : size + 1, size + 1 :], whole[:, size + 1 :, : size + 1] = transposed, matrix
        residual = np.concatenate([right + matvec(transposed, old.multipliers), gap], axis=-1)
        step = -matvec(pseudo_inverse(whole, SINGULAR), residual)
        z = old.at.z + matvec(old.along, step[:, :size])
        failed = ~(np.abs(step[:, :size]).max(axis=-1) <= MAX_MINIMAX_STEP)
        at = problem.distances.at(np.where(failed[:, None], old.at.z, z))
        short = np.abs(step[:, : size + 1]).max(axis=-1) < SETTLED_STEP * (
            1 + np.abs(z).max(axis=-1)
        )
        there = old._replace(
            at=at,
            level=old.level + step[:, size],
            multipliers=old.multipliers + step[:, size + 1 :],
            failed=failed,
        )
        return there, failed | short

    start = _start(problem, near, along)
    end, _ = iterate(advance, start, np.arange(len(near.z)), MAX_MINIMAX_STEPS)
    by_distance, distance = end.by_distance(exact), np.abs(end.at.here.distance)
    gradient = np.abs(((by_distance[:, None] @ end.at.here.jacobian) @ along)[:, 0]).max(axis=-1)
    sound = ~end.failed & (gradient < BALANCE_TOLERANCE * (1 + np.abs(by_distance).max(axis=-1)))
    highest = distance[:, ~exact].max(axis=-1)
    for level in (end.level, start.level):
        sound &= highest <= level * (1 + LEVEL_TOLERANCE)
    met = EXACT_RESIDUAL * (1 + np.abs(end.at.z).max(axis=-1))
    sound &= distance[:, exact].max(axis=-1, initial=0) < met
    sound &= (end.multipliers[:, : end.worst.shape[1]] > -MULTIPLIER_ROUNDING).all(axis=-1)
    return GeometricFit(end.at, by_distance, sound)


def _start(problem: FitProblem, near: GeometricFit, along: FloatArray) -> _Balance:
    """The poses that are worst near the least sum of high powers, and their multipliers."""
    exact, (count, size) = problem.exact, near.z.shape
    shares = np.where(exact, 0.0, np.abs(near.by_distance))
    worst = np.argsort(-shares, axis=-1, kind="stable")[:, : size + 1]
    largest = np.take_along_axis(shares, worst, axis=-1)
    most = np.rint(np.trace(along, axis1=-2, axis2=-1)) - exact.sum() + 1
    among = np.arange(worst.shape[1]) < most[:, None]
    among &= largest > WORST_POSE_SHARE * shares.max(axis=-1, keepdims=True)
    distance = near.at.here.distance
    sign = np.where(among, np.sign(np.take_along_axis(distance, worst, axis=-1)), 0.0)
    level = np.where(exact, 0.0, np.abs(distance)).max(axis=-1)
    none = np.zeros((count, worst.shape[1] + int(exact.sum())))
    start = _Balance(near.at, level, worst, sign, none, along, np.zeros(count, dtype=bool))
    _, matrix = start.conditions(exact)
    balance = pseudo_inverse(np.swapaxes(matrix, -1, -2), SINGULAR)
    return start._replace(multipliers=-balance[..., -1])
