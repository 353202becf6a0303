"""Whether the lengths of one pose are in another unit, or a decimal point away.

That a pose times one of a few factors should agree with all the others by chance is so unlikely
that it tells where an F test on the pose left out does not: let S be the least sum of squared
distances of all poses, S' that with one of them multiplied, S_without that without it.  Where the
pose is right, its multiple is anywhere; then it comes so near to the motion of the others that
S' - S_without is no more than it is with a chance of

    pi (S' - S_without) sqrt(det C) / A,

where C is the covariance of its two misses (its own error and what the others leave open), and A
the area that poses range over across the motion.
"""

from __future__ import annotations

import math
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.diagnosis.leave_one_out import EVERY, LeaveOneOut, pencil_pairs
from burmester.diagnosis.repairs import FACTORS, Nearness
from burmester.diagnosis.sampson_fits import (
    EVEN,
    LONG,
    Fits,
    Seen,
    fitted,
    in_two_steps,
    misses,
    refined,
)
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.numerics.bundles import concatenate

__all__ = ["UnitError", "apart", "chance_of", "unit_error"]

BY = np.array([by for factor in FACTORS for by in (factor, 1 / factor)])
USUAL = 0.75  # chance that it is one of the first three factors
LIKELY = np.repeat([USUAL / 6] * 3 + [(1 - USUAL) / 8] * 4, 2)
TRIED = 4  # poses and factors whose fits are tried, of each way to find them
FITTED = 3  # poses without which fits start from dyads of their own
APART, BESIDE = 0.75, 3.0  # times the others' extent: hardly among them, and not at all
AMONG = 1.0  # times their extent from their middle: here it is


@final
class UnitError(NamedTuple):
    """A pose that agrees with the others when its lengths are multiplied.

    by: the factor; away: how far it lies from the others' middle, in times their extent.
    chance: that this is so by chance, see the module.  miss: how far it lies from the motion of
    the others then, in their standard deviations.  stack: linkages of the others.
    """

    pose: int
    by: float
    away: float
    beside: bool
    chance: float
    miss: float
    stack: LinkageBatch


def unit_error(left: LeaveOneOut, floor: float, sure: float) -> UnitError | None:
    """The likeliest pose and factor, if one is likely enough.

    floor: what digits alone make of sums of squares; sure: the chance of a false alarm.
    """
    seen, found = left.seen, None
    tried = _tried(left)
    if not len(tried):
        return None
    rows, fits = _multiples_fitted(left, tried)
    whole = float(left.whole.cost.min())
    for k in fits.by_cost()[:TRIED]:
        (pose, factor), stack = tried[k], fits.of(k).stack
        if fits.of(k).cost[0] >= whole:
            break
        none = np.full(len(stack), pose)
        alone = Fits(*fitted(stack, seen.rows, seen.shares(none), LONG), none).of(int(pose))
        mended, without = float(fits.of(k).cost[0]), float(alone.cost[0])
        costs = floor + np.array([whole, mended, min(without, mended)])
        slip = _slip(seen, alone.stack, int(pose), int(factor), rows[k, pose], costs)
        if found is None or slip.chance < found[0].chance:
            found = slip, factor, rows[k], stack
    if found is None or not (found[0].beside or found[0].chance < sure):
        return None
    # The same by true distances.
    slip, factor, row, stack = found
    places = Displacement(row[:, :2], row[:, 2])
    mended, _ = refined(seen._replace(rows=row, poses=places), stack, None)
    without, stack = refined(seen, slip.stack, slip.pose)
    of_all, _ = refined(seen, concatenate([left.whole.stack, stack]), None)
    of_all, without = min(of_all, whole), min(without, mended)
    if not mended < of_all:
        return None
    costs = floor + np.array([of_all, mended, without])
    slip = _slip(seen, stack, slip.pose, int(factor), row[slip.pose], costs)
    return slip if slip.beside or slip.chance < sure else None


def _multiples_fitted(left: LeaveOneOut, tried: NDArray[np.intp]) -> tuple[FloatArray, Fits]:
    """The poses (n, N, 3), each time with one multiplied, and the linkages that fit them."""
    seen, own = left.seen, np.arange(len(tried))
    rows = np.tile(seen.rows, (len(tried), 1, 1))
    rows[own, tried[:, 0]] = _multiplied(seen)[tried[:, 0], tried[:, 1]]
    poses = list(dict.fromkeys(tried[:, 0].tolist()))
    if len(seen.rows) > EVERY:  # one of many hardly moves a linkage
        starts = {k: left.fits.of(k).stack[:1] for k in poses}
    else:
        starts = {k: concatenate([left.fits.of(k).stack[:2], left.whole.stack[:2]]) for k in poses}
        for k in poses[:FITTED]:
            starts[k] = concatenate([starts[k], left.own_pairs(k)])
    stack, each = left.whole.stack[:0], np.empty(0, dtype=np.intp)
    for k in own:
        new = starts[int(tried[k, 0])]
        stack, each = concatenate([stack, new]), np.append(each, np.full(len(new), k))
    if len(seen.rows) <= EVERY:
        weights = np.broadcast_to(seen.weights, rows.shape[:2])
        pencils, _ = pencil_pairs(Displacement(rows[..., :2], rows[..., 2]), weights)
        stack, each = concatenate([stack, pencils]), np.append(each, own)
    share = np.broadcast_to(seen.weights, (len(stack), len(seen.rows)))
    return rows, in_two_steps(stack, each, rows[each], share)


def _slip(  # noqa: PLR0917
    seen: Seen, stack: LinkageBatch, pose: int, factor: int, row: FloatArray, costs: FloatArray
) -> UnitError:
    """A pose multiplied, its row (3,), by sums (3,): of all, of all so, and without it."""
    of_all, mended, without = np.maximum(costs, np.finfo(float).tiny).tolist()
    spare, away = 2 * len(seen.rows) - 12, _away(seen, pose)
    near = Nearness.of(seen, stack[:1], pose, math.sqrt(without / spare))
    landed = _landed(seen, near, row, pose, max(mended - without, without / spare))
    agreed = min(1.0, len(seen.rows) * (mended / of_all) ** (spare / 2))
    chance = chance_of(agreed, min(1.0, landed / LIKELY[factor]))
    beside = bool(away[0] > BESIDE and away[1 + factor] < AMONG)
    miss = math.sqrt((mended - without) * spare / without)
    return UnitError(pose, float(BY[factor]), float(away[0]), beside, chance, miss, stack)


def apart(seen: Seen) -> int | None:
    """The pose that lies apart from all others, and among them in another unit, if one does."""
    off = seen.rows[:, :2] - np.median(seen.rows[:, :2], axis=0)
    pose = int((off * off).sum(axis=-1).argmax())
    away = _away(seen, pose)
    return pose if away[0] > APART and (away[1:] < AMONG).any() else None


def chance_of(first: float, second: float) -> float:
    """That the product of two chances is no greater (Fisher's method)."""
    product = max(first * second, np.finfo(float).tiny)
    return min(1.0, product * (1 - math.log(product)))


def _tried(left: LeaveOneOut) -> NDArray[np.intp]:
    """Poses and factors (n, 2), by their indices, that may be slips."""
    seen, tried = left.seen, []
    rows, number = _multiplied(seen), len(BY)
    if (pose := apart(seen)) is not None:
        tried = [(pose, int(k)) for k in np.flatnonzero(_away(seen, pose)[1:] < AMONG)]
    # How near multiples come to the motions of the others,
    there = rows[left.fits.own]
    miss, _ = misses(left.fits.stack, there, np.ones(there.shape[:2]))
    off = (miss * miss).reshape(*there.shape[:2], 2).sum(axis=-1) + left.fits.cost[:, None]
    for k in np.argsort(off, axis=None, kind="stable")[: 3 * TRIED]:
        tried.append((int(left.fits.own[k // number]), int(k % number)))
    tried = list(dict.fromkeys(tried))[: 2 * TRIED]
    if len(rows) <= EVERY:  # and all poses to being held by two quadrics
        every = np.tile(seen.rows, (len(rows), number, 1, 1))
        every[np.arange(len(rows)), :, np.arange(len(rows))] = rows
        every = every.reshape(-1, len(rows), 3)
        weights = np.broadcast_to(seen.weights, every.shape[:2])
        _, held = pencil_pairs(Displacement(every[..., :2], every[..., 2]), weights)
        best = np.argsort(held, kind="stable")[:TRIED]
        tried += [(int(k // number), int(k % number)) for k in best]
    return np.array(list(dict.fromkeys(tried)), dtype=np.intp).reshape(-1, 2)


def _multiplied(seen: Seen) -> FloatArray:
    """All poses times all factors, (N, 14, 3)."""
    origin, length = seen.frames.fixed_origin, seen.frames.length
    given = seen.rows[:, None, :2] * length + origin
    turn = np.broadcast_to(seen.rows[:, None, 2:], (len(seen.rows), len(BY), 1))
    return np.concatenate([(given * BY[:, None] - origin) / length, turn], axis=-1)


def _away(seen: Seen, pose: int) -> FloatArray:
    """How far a pose and its multiples, (15,), lie from the others' middle, in their extent."""
    middle, extent = _others(seen, pose, 2)
    where = np.concatenate([seen.rows[[pose], :2], _multiplied(seen)[pose, :, :2]])
    return np.asarray(np.linalg.norm(where - middle, axis=-1) / np.linalg.norm(extent))


def _others(seen: Seen, pose: int, size: int) -> tuple[FloatArray, FloatArray]:
    """The middle (size,) of the other poses, and their extents (size,) along their main axes."""
    others = seen.rows[seen.without(pose), :size]
    middle = others.mean(axis=0)
    wide = np.linalg.svd(others - middle, compute_uv=False) * math.sqrt(EVEN / len(others))
    return middle, np.maximum(wide, np.finfo(float).tiny)


def _landed(seen: Seen, near: Nearness, row: FloatArray, pose: int, short: float) -> float:
    """The chance that a pose anywhere is no farther from the motion of the others."""
    _, spread = near.spread(row)
    _, extent = _others(seen, pose, 3)
    wide = math.pi * short * math.sqrt(max(float(np.linalg.det(spread)), 1.0))
    return min(1.0, wide / float(extent[1:].prod()))
