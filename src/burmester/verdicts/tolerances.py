"""The spread of a linkage's error, as its links and pivots are built within a tolerance.

A tolerance t gives independent errors, spread evenly: each coordinate of a pivot and each link
length by +-t; a slider's line by +-t across it, in the middle of the stretch that the poses use,
and by +-t / length in its angle.
The driver is adjusted: the built linkage meets a pose at the place of its coupler nearest to it.

Near, here and everywhere, means the least |position error|² + (length x angle error)².  All
arguments are in one frame and unit, where lengths are about 1 (`pose_error.error_frames`).

The spread is computed to first order in the tolerance, and by linkages that are built at random
(`built_linkages`) where these differ: short links and dead points make a tolerance no small one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.foot_points import ConstraintNormals, constraint_normals, places_of, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, concatenate, take
from burmester.progress import goes_on
from burmester.verdicts.built_linkages import (
    DRAWS,
    Built,
    BuiltLinkages,
    dimensions_by_errors,
    percentile_95,
)
from burmester.verdicts.uncertainty import line_middle

EXACT_GAP = 1e-9  # lengths; poses that are missed by less are met
NORMAL_NUDGE = 1e-7  # radians beside a normal; vectors nearer to parallel are as one
TANGENT_STEP = 1e-5  # lengths along the coupler's curve, of the forces' difference quotients
DIRECTIONS = 90  # number of directions on half a circle in which the greatest error is computed
PLACES_PER_BLOCK = 30_000  # number of places whose sensitivity is computed at once; the same
POSES_PER_BLOCK = 256  # number of poses computed at once; bounds the memory
# First order is kept if it is right to this share: at CORNERS corners of the tolerance, for the
# 95 % of PILOT_DRAWS linkages, and for the worst corner found from these.
FIRST_ORDER_SHARE = 0.1
CORNERS = 4
PILOT_DRAWS = 64
MAX_POSES_BUILT = 100  # number of poses at most that linkages are built for: those of most error


@final
@dataclass(frozen=True, slots=True, eq=False)
class Spread:
    """Position errors of built linkages (k,) at poses (N,).

    deviation: (k, N), the rms distance between the places of built linkages and the nominal one.
    worst: (k, N), the greatest position error at that pose of linkages within the tolerance.
    rms: (k,), the root of the mean squared position error over built linkages and poses.
    greatest_95: (k,), 95 % of the built linkages come nearer than this to every pose; from
        1,000 draws, and so accurate to a few per cent.
    bound: (k,), the greatest `worst`.
    monte_carlo: (k,), whether these numbers are those of linkages built at random; else they are
        to first order in the tolerance, and `worst` is a bound to first order.  Of linkages built
        at random, `worst` is the greatest error that was found, and no bound.
    lost: (k,), the share of the linkages built at random that cannot be assembled; the other
        numbers are about the rest, and infinite where there is none.
    """

    deviation: FloatArray
    worst: FloatArray
    rms: FloatArray
    greatest_95: FloatArray
    bound: FloatArray
    monte_carlo: NDArray[np.bool_]
    lost: FloatArray

    def one(self, index: int, unit: float) -> Spread:
        """The spread of one linkage, in the unit in which the length 1 is `unit`."""
        parts = (self.deviation, self.worst, self.rms, self.greatest_95, self.bound)
        deviation, worst, rms, greatest_95, bound = (unit * part[index] for part in parts)
        how = self.monte_carlo[index], self.lost[index]
        return Spread(deviation, worst, rms, greatest_95, bound, *how)


class _FirstOrder(NamedTuple):
    """Errors to first order: gap (k, N, 2) + slope (k, N, 2, 10) off, for errors off in tolerances.

    worst: (k, N), upper bounds on the lengths of these; corner: (k, N, 10), the off that has it.
    """

    gap: FloatArray
    slope: FloatArray
    worst: FloatArray
    corner: FloatArray

    def greatest(self, off: FloatArray) -> FloatArray:
        """The greatest errors (k, n) of linkages with errors (n, 10)."""
        greatest = np.zeros((len(self.gap), len(off)))
        for first in range(0, self.gap.shape[1], POSES_PER_BLOCK):
            at = slice(first, first + POSES_PER_BLOCK)
            moved = np.einsum("sj,kncj->ksnc", off, self.slope[:, at]) + self.gap[:, None, at]
            greatest = np.maximum(greatest, np.hypot(moved[..., 0], moved[..., 1]).max(axis=-1))
        return greatest


def spread(
    batch: LinkageBatch,
    poses: Displacement,
    places: Displacement,
    length: float,
    tolerance: float,
    *,
    seed: int = 0,
) -> Spread:
    """The position errors of linkages (k,) built within a tolerance.

    poses: (N,); places: (k, N), the nominal linkages' nearest to them.
    Where the time is over, numbers to first order stay so, unchecked.
    """
    first = _first_order(batch, poses, places, length, tolerance)
    off = np.random.default_rng(seed).uniform(-1, 1, size=(DRAWS, 2 * DIMENSIONS))
    deviation = np.sqrt((first.slope**2).sum(axis=(-2, -1)) / 3)
    square = (first.gap**2).sum(axis=-1) + deviation**2
    greatest = first.greatest(off)
    out = Spread(
        deviation,
        first.worst.copy(),
        np.sqrt(square.mean(axis=-1)),
        np.array([percentile_95(each) for each in greatest]),
        first.worst.max(axis=-1),
        np.zeros(len(batch), dtype=bool),
        np.zeros(len(batch)),
    )
    for k in range(len(batch)):
        if not goes_on(k + 1, len(batch), "linkage"):
            break
        at = np.sort(np.argsort(first.worst[k])[::-1][:MAX_POSES_BUILT])
        here = places[[k]][:, at]
        built = BuiltLinkages.of(batch[[k]], poses[at], here, length, tolerance)
        alone = _FirstOrder(*(part[[k]][:, at] for part in first))
        right, corner = _checked(alone, built, off)
        if right:
            out.worst[k, at] = np.maximum(out.worst[k, at], corner.position.max(axis=0))
            out.bound[k] = out.worst[k].max()
            continue
        drawn = built.at_random(seed=seed)
        out.monte_carlo[k], out.lost[k] = True, 1 - drawn.assembled.mean()
        if not drawn.assembled.any():
            for part in (out.deviation, out.worst, out.rms, out.greatest_95, out.bound):
                part[k] = np.inf
            continue
        drawn = take(drawn, drawn.assembled)
        worst = built.worst(concatenate([drawn, corner]))
        moved = drawn.rows[..., :2] - built.start[:, :2]
        out.deviation[k, at] = np.sqrt((moved**2).sum(axis=-1).mean(axis=0))
        out.worst[k, at] = np.maximum(drawn.position.max(axis=0), worst.position[0])
        out.rms[k] = np.sqrt((drawn.position**2).mean())
        out.greatest_95[k] = percentile_95(drawn.greatest)
        out.bound[k] = worst.position.max()
    return out


def _first_order(
    batch: LinkageBatch,
    poses: Displacement,
    places: Displacement,
    length: float,
    tolerance: float,
) -> _FirstOrder:
    slope = tolerance * sensitivity(batch, poses, places, length)
    gap = places.translation - poses.translation
    # The farthest point of a convex figure is farthest in its own direction.
    worst, corner = np.zeros(gap.shape[:-1]), np.zeros((*gap.shape[:-1], slope.shape[-1]))
    for angle in np.arange(DIRECTIONS) * (np.pi / DIRECTIONS):
        to = np.array([np.cos(angle), np.sin(angle)])
        along, off = np.einsum("c,kncj->knj", to, slope), gap @ to
        value = np.abs(off) + np.abs(along).sum(axis=-1)
        sign = np.where(off < 0, -1.0, 1.0)[..., None] * np.where(along < 0, -1.0, 1.0)
        corner = np.where((value > worst)[..., None], sign, corner)
        worst = np.maximum(worst, value)
    worst /= np.cos(np.pi / (2 * DIRECTIONS))  # a bound for directions in between, too
    return _FirstOrder(gap, slope, worst, corner)


def _checked(first: _FirstOrder, built: BuiltLinkages, off: FloatArray) -> tuple[bool, Built]:
    """Whether first order is right to a tenth, and the worst corner of the tolerance found."""
    most = np.argsort(first.worst[0])[::-1][:CORNERS]  # the poses of most error
    corners, draws = np.unique(first.corner[0, most], axis=0), off[:PILOT_DRAWS]
    some = built.with_errors(np.concatenate([corners, draws]))
    if not some.assembled.any():
        return False, take(some, slice(0))
    worst = built.worst(some, corners_only=True)
    true, linear, n = some.greatest, first.greatest(some.off)[0], len(corners)
    pairs = [*zip(true[:n], linear[:n], strict=True)]
    pairs.append((percentile_95(true[n:]), percentile_95(linear[n:])))
    pairs.append((max(worst.greatest[0], first.worst.max()), first.worst.max()))
    right = all(abs(one - other) <= FIRST_ORDER_SHARE * other for one, other in pairs)
    return right and bool(some.assembled.all()), worst


def sensitivity(
    batch: LinkageBatch, poses: Displacement, places: Displacement, length: float
) -> FloatArray:
    """Derivatives (k, N, 2, 10) of the places nearest to poses (N,) by errors of the dimensions.

    Of their positions, by errors in the order of `LinkageBatch`, each as a length (see the top of
    the file); zero for unused slots.

    Formula `sensitivity` of the theory.
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
    curvature = 1 + (turning * tangent).sum(axis=-1)  # of the distance; positive at a minimum
    errors = dimensions_by_errors(batch, line_middle(batch, places), length)
    by_error = by_dimension @ errors
    partial = (ahead.by_dimension - behind.by_dimension) / step @ errors
    moved = np.empty((*places.shape, 2, 2, DIMENSIONS))
    for side, way in enumerate(_ways_back(at)):
        # Back to the moved manifold, then along to the nearest place.
        along = multipliers[..., side, None] * partial[:, side]
        along = along - (turning * way).sum(axis=-1)[..., None] * by_error[:, side]
        along = along / curvature[..., None]
        for c in (0, 1):
            back = way[..., c, None] * by_error[:, side]
            moved[..., c, side, :] = -back - along * tangent[..., c, None]
    return moved.reshape(*places.shape, 2, 2 * DIMENSIONS)


def sensitivity_bound(
    batch: LinkageBatch, poses: Displacement, places: Displacement, length: float
) -> FloatArray:
    """The greatest position error (k, N) that errors of 1 cause at places nearest to poses.

    poses: (N,), or (k, N), of each linkage.

    All coordinates of pivots and lengths are off by up to 1, in the worst way.  To first order: t
    times this is what errors up to a small t do.  Arguments as in `sensitivity`.
    """
    poses = Displacement(
        np.broadcast_to(poses.translation, places.translation.shape),
        np.broadcast_to(poses.angle, places.angle.shape),
    )
    gap = np.abs(rows_of(places, length) - rows_of(poses, length)).max(axis=(-2, -1))
    out, met = np.empty(places.shape), gap <= EXACT_GAP
    count = max(1, PLACES_PER_BLOCK // places.shape[-1])
    for some in (np.flatnonzero(met), np.flatnonzero(~met)):
        for at in range(0, len(some), count):
            rows = some[at : at + count]
            if met[rows[0]]:
                out[rows] = _bound_where_met(batch[rows], places[rows], length)
            else:
                out[rows] = _greatest_sum(
                    sensitivity(batch[rows], poses[rows], places[rows], length)
                )
    return out


def _bound_where_met(batch: LinkageBatch, places: Displacement, length: float) -> FloatArray:
    """The same where poses are met: no gap bends the way, and all errors of a dyad push alike."""
    miss, force, by_dimension = batch.jacobians(places)
    errors = dimensions_by_errors(batch, line_middle(batch, places), length)
    most = np.abs(by_dimension @ errors).sum(axis=-1)
    one, two = (
        way[..., :2] * most[:, side, :, None]
        for side, way in enumerate(_ways_back(constraint_normals(miss, force, length)))
    )
    both = (np.hypot(end[..., 0], end[..., 1]) for end in (one + two, one - two))
    return np.asarray(np.maximum(*both))


def _ways_back(at: ConstraintNormals) -> Iterator[FloatArray]:
    """For either dyad the way (k, N, 3) to its manifold, off by 1, along that of the other."""
    for unit in np.eye(2):
        yield np.einsum("kna,knac->knc", at.solve(unit), at.force)


def _greatest_sum(parts: FloatArray) -> FloatArray:
    """The greatest length (*,) of a sum of vectors (*, 2, n), each with either sign."""
    normal = np.stack([-parts[..., 1, :], parts[..., 0, :]], axis=-2) + NORMAL_NUDGE * parts
    sign = np.sign(np.einsum("...cj,...ci->...ji", normal, parts))
    corner = np.einsum("...ji,...ci->...cj", sign, parts)
    return np.asarray(np.hypot(corner[..., 0, :], corner[..., 1, :]).max(axis=-1))
