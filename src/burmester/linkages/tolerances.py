"""The pose errors of a linkage that is built within tolerances.

Every dimension of the built linkage is off by up to a tolerance t, evenly spread and independent
of the others: each coordinate of a pivot and each link length by +-t; a slider's line by +-t across
it, in the middle of the stretch that the poses use, and by +-t / length in its angle.
The driver is adjusted: the built linkage meets a pose at the place of its coupler nearest to it.

Near, here and everywhere, means the least |position error|² + (length x angle error)².  All
arguments are in one frame and unit, where lengths are about 1 (`pose_error.error_frames`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.foot_points import constraint_normals, newton_step, places_of, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, DYAD_KINDS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.linkages.uncertainty import line_middle
from burmester.numerics.arrays import FloatArray

__all__ = ["Built", "Spread", "monte_carlo", "sensitivity", "spread"]

DRAWS = 1000  # number of linkages built at random
PERCENTILE = 95.0  # per cent of the built linkages within `greatest_95`
TANGENT_STEP = 1e-5  # lengths along the coupler's curve, of the forces' difference quotients
DIRECTIONS = 90  # number of directions on half a circle in which the greatest error is computed
MAX_NEWTON_STEPS = 30  # number of steps to the nearest place of a built linkage at most
CONVERGED_STEP = 1e-9  # lengths; after a smaller step the next would be rounding
POSES_PER_BLOCK = 256  # number of poses computed at once; bounds the memory


@final
@dataclass(frozen=True, slots=True, eq=False)
class Spread:
    """Position errors of built linkages at poses (N,), to first order in the tolerance.

    deviation: (k, N), the rms distance between the places of built linkages and the nominal one.
    worst: (k, N), upper bound on the position error at that pose of linkages within the tolerance.
    rms: (k,), the root of the mean squared position error over built linkages and poses.
    greatest_95: (k,), 95 % of the built linkages come nearer than this to every pose; from
        1,000 draws, and so accurate to a few per cent.
    bound: (k,), the greatest `worst`.
    """

    deviation: FloatArray
    worst: FloatArray
    rms: FloatArray
    greatest_95: FloatArray
    bound: FloatArray

    def one(self, index: int, unit: float) -> Spread:
        """The spread of one linkage, in the unit in which the length 1 is `unit`."""
        parts = (self.deviation, self.worst, self.rms, self.greatest_95, self.bound)
        return Spread(*(unit * part[index] for part in parts))


@final
@dataclass(frozen=True, slots=True, eq=False)
class Built:
    """Linkages built at random within a tolerance, with their places.

    dimensions: (k, draws, 2, 5), as built, in the order of `LinkageBatch`.
    places: (k, draws, N), nearest to the poses; nan where Newton's method does not converge.
    position: (k, draws, N), their position errors, infinite for nan places.
    """

    dimensions: FloatArray
    places: Displacement
    position: FloatArray

    @property
    def lost(self) -> FloatArray:
        """The fraction (k,) of linkages without a place near some pose."""
        return np.asarray(np.isinf(self.position).any(axis=-1).mean(axis=-1))

    @property
    def greatest_95(self) -> FloatArray:
        """95 % of the linkages (k,) come nearer than this to every pose."""
        return _percentile_95(self.position.max(axis=-1))


def spread(
    batch: LinkageBatch,
    poses: Displacement,
    places: Displacement,
    length: float,
    tolerance: float,
    *,
    seed: int = 0,
) -> Spread:
    """The position errors of linkages (k,) built within a tolerance, to first order.

    poses: (N,); places: (k, N), the nominal linkages' nearest to them.
    """
    slope = tolerance * sensitivity(batch, poses, places, length)
    gap = places.translation - poses.translation
    deviation = np.sqrt((slope**2).sum(axis=(-2, -1)) / 3)
    # The farthest point of a convex figure is farthest in its own direction.
    worst = np.zeros(gap.shape[:-1])
    for angle in np.arange(DIRECTIONS) * (np.pi / DIRECTIONS):
        to = np.array([np.cos(angle), np.sin(angle)])
        along = np.abs(np.einsum("c,kncj->knj", to, slope)).sum(axis=-1)
        worst = np.maximum(worst, np.abs(gap @ to) + along)
    worst /= np.cos(np.pi / (2 * DIRECTIONS))  # a bound for directions in between, too
    square = (gap**2).sum(axis=-1) + deviation**2
    off = np.random.default_rng(seed).uniform(-1, 1, size=(DRAWS, slope.shape[-1]))
    greatest = np.zeros((len(batch), DRAWS))
    for at in _blocks(poses):
        moved = gap[:, None, at] + np.einsum("sj,kncj->ksnc", off, slope[:, at])
        greatest = np.maximum(greatest, np.hypot(moved[..., 0], moved[..., 1]).max(axis=-1))
    rms = np.sqrt(square.mean(axis=-1))
    return Spread(deviation, worst, rms, _percentile_95(greatest), worst.max(axis=-1))


def sensitivity(
    batch: LinkageBatch, poses: Displacement, places: Displacement, length: float
) -> FloatArray:
    """Derivatives (k, N, 2, 10) of the places nearest to poses (N,) by errors of the dimensions.

    Of their positions, by errors in the order of `LinkageBatch`, each as a length (see the top of
    the file); zero for unused slots.
    """
    miss, force, by_dimension = batch.jacobians(places)
    at = constraint_normals(miss, force, length)
    tangent, here = at.tangent, rows_of(places, length)
    gap = here - rows_of(poses, length)
    # At the nearest place gap + multipliers J = 0 with the forces J, whose turning along the
    # tangent bends the distance.
    multipliers = -at.solve(np.einsum("knac,knc->kna", at.force, gap))
    nudge = TANGENT_STEP * length * tangent
    ahead, behind = (batch.jacobians(places_of(here + sign * nudge, length)) for sign in (1, -1))
    step = 2 * TANGENT_STEP * length
    turning = np.einsum("kna,kanc->knc", multipliers, (ahead.force - behind.force) / step)
    turning[..., 2] /= length
    partial = (ahead.by_dimension - behind.by_dimension) / step
    curvature = 1 + (turning * tangent).sum(axis=-1)  # of the distance; positive at a minimum
    # One dimension after the other: back to the moved manifold, then along to the nearest place.
    moved = np.zeros((*places.shape, 3, 2, DIMENSIONS))
    for side in (0, 1):
        for j in range(DIMENSIONS):
            values = np.zeros((*places.shape, 2))
            values[..., side] = by_dimension[:, side, :, j]
            back = -np.einsum("kna,knac->knc", at.solve(values), at.force)
            along = (turning * back).sum(axis=-1) + multipliers[..., side] * partial[:, side, :, j]
            moved[..., side, j] = back - (along / curvature)[..., None] * tangent
    errors = _dimensions_by_errors(batch, line_middle(batch, places), length)
    return np.asarray(np.einsum("kncsj,ksji->kncsi", moved[..., :2, :, :], errors)).reshape(
        *places.shape, 2, 2 * DIMENSIONS
    )


def monte_carlo(
    batch: LinkageBatch,
    poses: Displacement,
    places: Displacement,
    length: float,
    tolerance: float,
    *,
    draws: int = DRAWS,
    seed: int = 0,
) -> Built:
    """Linkages built at random, each with its places nearest to the poses.

    As in `spread`, without linearisation.  Newton's method starts from the nominal places, so every
    linkage stays on its circuit as long as the circuits are apart.
    """
    rng = np.random.default_rng(seed)
    errors = _dimensions_by_errors(batch, line_middle(batch, places), length)
    off = tolerance * rng.uniform(-1, 1, size=(len(batch), draws, 2, DIMENSIONS))
    dimensions = batch.dimensions[:, None] + np.einsum("ksji,knsi->knsj", errors, off)
    rows = np.empty((len(batch), draws, poses.shape[0], 3))
    for k in range(len(batch)):
        built = LinkageBatch(np.broadcast_to(batch.kinds[k], (draws, 2)), dimensions[k])
        for at in _blocks(poses):
            rows[k, :, at] = _nearest(built, poses[at], places[k, at], length)
    reached = places_of(rows, length)
    gap = reached.translation - poses.translation
    position = np.nan_to_num(np.hypot(gap[..., 0], gap[..., 1]), nan=np.inf)
    return Built(dimensions, reached, position)


def _nearest(
    built: LinkageBatch, poses: Displacement, start: Displacement, length: float
) -> FloatArray:
    """The places (n, N, 3) of linkages (n,) nearest to poses (N,), by Newton's steps from (N,)."""
    shape = (len(built), poses.shape[0], 3)
    forms = built.forms()
    rows = np.broadcast_to(rows_of(start, length), shape)
    wanted = np.broadcast_to(rows_of(poses, length), shape)
    size = np.full(shape[:2], np.inf)
    for _ in range(MAX_NEWTON_STEPS):
        step, size = newton_step(forms, rows, wanted, length)
        rows = rows + step
        if not (size > CONVERGED_STEP).any():
            break
    return np.where((size <= CONVERGED_STEP)[..., None], rows, np.nan)


def _dimensions_by_errors(batch: LinkageBatch, middle: FloatArray, length: float) -> FloatArray:
    """Derivatives (k, 2, 5, 5) of the dimensions of each dyad by building errors, as lengths."""
    made = np.zeros((*batch.kinds.shape, DIMENSIONS, DIMENSIONS))
    made[:] = np.eye(DIMENSIONS)
    made[batch.kinds != DYAD_KINDS.index(RR), -1, -1] = 0.0
    for kind, at in ((PR, 0), (RP, 2)):
        rows = batch.kinds == DYAD_KINDS.index(kind)
        made[rows, at, at] = 1 / length
        made[rows, at + 1, at] = middle[rows] / length  # turned about the middle
    return made


def _percentile_95(greatest: FloatArray) -> FloatArray:
    """The 95th percentile (k,) of (k, draws): one of the values, no interpolation."""
    return np.asarray(np.percentile(greatest, PERCENTILE, axis=-1, method="higher"))


def _blocks(poses: Displacement) -> Iterator[slice]:
    return (slice(at, at + POSES_PER_BLOCK) for at in range(0, poses.shape[0], POSES_PER_BLOCK))
