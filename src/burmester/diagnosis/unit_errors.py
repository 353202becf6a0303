"""A pose with lengths in another unit, or a decimal point away.

That a pose times one of a few factors agrees with all the others by chance is so unlikely that it
tells where an F test on the pose left out does not.  Let S be the least sum of squared distances
of all poses, S' that with one of them multiplied, S_without that without it.  Where the pose is
right, its multiple is anywhere; then it comes so near to the motion of the others that
S' - S_without is no more than it is with a chance of

    pi (S' - S_without) sqrt(det C) / A,

where C is the covariance of its two residuals (its own error and the uncertainty of the others'
linkage), and A the area that poses range over across the motion.
"""

from __future__ import annotations

import math
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.diagnosis.leave_one_out import MAX_POSES_ALL_LEFT_OUT, LeaveOneOut, pencil_pairs
from burmester.diagnosis.repairs import UNIT_FACTORS, Prediction
from burmester.diagnosis.sampson_fits import (
    FULL_STEPS,
    UNIFORM_EXTENT_SQUARED,
    Fits,
    NormalizedPoses,
    fit_in_two_steps,
    fit_linkages,
    refine_best,
    sampson_residuals,
)
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, concatenate, median

FACTORS = np.array([each for factor in UNIT_FACTORS for each in (factor, 1 / factor)])  # (14,)
USUAL_FACTOR_CHANCE = 0.75  # that a unit error is one of the first three factors, either way
FACTOR_CHANCES = np.repeat([USUAL_FACTOR_CHANCE / 6] * 3 + [(1 - USUAL_FACTOR_CHANCE) / 8] * 4, 2)
CANDIDATES = 4  # poses with a factor to fit, of each way to find them
POSES_WITH_OWN_STARTS = 3  # whose fits start from the best dyads without them, too
APART_EXTENTS = 0.75  # of the others, from their middle; farther out a pose may be apart from them
FAR_APART_EXTENTS = 3.0  # the same; farther out a pose surely is not one of them
AMONG_EXTENTS = 1.0  # the same; a multiple nearer to the middle is one of them


class Multiple(NamedTuple):
    """A pose times a factor (an index of FACTORS), as a row (3,)."""

    pose: int
    factor: int
    row: FloatArray


class Costs(NamedTuple):
    """Least sums of squared distances: of all poses, with one multiplied, and without that one."""

    of_all: float
    multiplied: float
    without: float


@final
class UnitError(NamedTuple):
    """A pose that agrees with the others when its lengths are multiplied.

    factor: of the lengths.
    extents: how far the pose lies from the others' middle, in their extents.
    far_apart: whether that is beyond doubt, and its multiple lies among the others.
    chance: of such agreement by coincidence, see the module.
    miss: the distance of the multiple from the motion of the others, in standard deviations.
    linkages: of the others.
    """

    pose: int
    factor: float
    extents: float
    far_apart: bool
    chance: float
    miss: float
    linkages: LinkageBatch


def unit_error(left_out: LeaveOneOut, floor: float, false_alarm_chance: float) -> UnitError | None:
    """The likeliest pose and factor, if one is likely enough.

    floor: the part of sums of squares that comes from digits alone.
    """
    normalized, best = left_out.normalized, None
    candidates = _candidates(left_out)
    if not len(candidates):
        return None
    rows, fits = _fit_multiples(left_out, candidates)
    of_all = float(left_out.fits_to_all.cost.min())
    for k in fits.labels_by_cost()[:CANDIDATES]:
        (pose, factor), linkages = candidates[k], fits.of(k).linkages
        if fits.of(k).cost[0] >= of_all:
            break
        labels = np.full(len(linkages), pose)
        weights = normalized.weights_without(labels)
        refits = Fits(*fit_linkages(linkages, normalized.rows, weights, FULL_STEPS), labels)
        alone = refits.of(int(pose))
        multiplied, without = float(fits.of(k).cost[0]), float(alone.cost[0])
        costs = Costs(floor + of_all, floor + multiplied, floor + min(without, multiplied))
        multiple = Multiple(int(pose), int(factor), rows[k, pose])
        error = _error_of(normalized, alone.linkages, multiple, costs)
        if best is None or error.chance < best[0].chance:
            best = error, multiple, rows[k], linkages
    if best is None or not (best[0].far_apart or best[0].chance < false_alarm_chance):
        return None
    # The same by true distances.
    error, multiple, row, linkages = best
    places = Displacement(row[:, :2], row[:, 2])
    multiplied, _ = refine_best(normalized._replace(rows=row, poses=places), linkages, None)
    without, linkages = refine_best(normalized, error.linkages, error.pose)
    refined, _ = refine_best(
        normalized, concatenate([left_out.fits_to_all.linkages, linkages]), None
    )
    of_all, without = min(refined, of_all), min(without, multiplied)
    if not multiplied < of_all:
        return None
    costs = Costs(floor + of_all, floor + multiplied, floor + without)
    error = _error_of(normalized, linkages, multiple._replace(row=row[error.pose]), costs)
    return error if error.far_apart or error.chance < false_alarm_chance else None


def _fit_multiples(left_out: LeaveOneOut, candidates: NDArray[np.intp]) -> tuple[FloatArray, Fits]:
    """The poses (n, N, 3), each time with one multiplied, and the linkages that fit them."""
    normalized, index = left_out.normalized, np.arange(len(candidates))
    whole, fits = left_out.fits_to_all, left_out.fits_without_one
    rows = np.tile(normalized.rows, (len(candidates), 1, 1))
    rows[index, candidates[:, 0]] = _multiples(normalized)[candidates[:, 0], candidates[:, 1]]
    poses = list(dict.fromkeys(candidates[:, 0].tolist()))
    if len(normalized.rows) > MAX_POSES_ALL_LEFT_OUT:  # one of many hardly moves a linkage
        starts = {k: fits.of(k).linkages[:1] for k in poses}
    else:
        starts = {k: concatenate([fits.of(k).linkages[:2], whole.linkages[:2]]) for k in poses}
        for k in poses[:POSES_WITH_OWN_STARTS]:
            starts[k] = concatenate([starts[k], left_out.best_pairs_without(k)])
    linkages, labels = whole.linkages[:0], np.empty(0, dtype=np.intp)
    for k in index:
        new = starts[int(candidates[k, 0])]
        linkages, labels = concatenate([linkages, new]), np.append(labels, np.full(len(new), k))
    if len(normalized.rows) <= MAX_POSES_ALL_LEFT_OUT:
        weights = np.broadcast_to(normalized.weights, rows.shape[:2])
        pencils, _ = pencil_pairs(Displacement.from_poses(rows), weights)
        linkages, labels = concatenate([linkages, pencils]), np.append(labels, index)
    share = np.broadcast_to(normalized.weights, (len(linkages), len(normalized.rows)))
    return rows, fit_in_two_steps(linkages, labels, rows[labels], share)


def _error_of(
    normalized: NormalizedPoses, linkages: LinkageBatch, multiple: Multiple, costs: Costs
) -> UnitError:
    """A pose multiplied, judged by the best of the linkages of the others."""
    of_all, multiplied, without = np.maximum(costs, np.finfo(float).tiny).tolist()
    pose, spare = multiple.pose, 2 * len(normalized.rows) - 12
    extents = _extents(normalized, pose)
    prediction = Prediction.of(normalized, linkages[:1], pose, math.sqrt(without / spare))
    increase = max(multiplied - without, without / spare)
    coincidence = coincidence_chance(normalized, prediction, multiple, increase)
    agreement = min(1.0, len(normalized.rows) * (multiplied / of_all) ** (spare / 2))
    chance = combined_chance(agreement, min(1.0, coincidence / FACTOR_CHANCES[multiple.factor]))
    among = extents[1 + multiple.factor] < AMONG_EXTENTS
    far_apart = bool(extents[0] > FAR_APART_EXTENTS and among)
    miss = math.sqrt((multiplied - without) * spare / without)
    factor = float(FACTORS[multiple.factor])
    return UnitError(pose, factor, float(extents[0]), far_apart, chance, miss, linkages)


def pose_apart(normalized: NormalizedPoses) -> int | None:
    """The pose that lies apart from all others, and among them in another unit, if one does."""
    off = normalized.rows[:, :2] - median(normalized.rows[:, :2], 0)
    pose = int((off * off).sum(axis=-1).argmax())
    extents = _extents(normalized, pose)
    among = (extents[1:] < AMONG_EXTENTS).any()
    return pose if extents[0] > APART_EXTENTS and among else None


def combined_chance(first: float, second: float) -> float:
    """The chance that the product of two chances is no greater (Fisher's method)."""
    product = max(first * second, np.finfo(float).tiny)
    return min(1.0, product * (1 - math.log(product)))


def _candidates(left_out: LeaveOneOut) -> NDArray[np.intp]:
    """Poses and factors (n, 2), by their indices, that may be unit errors."""
    normalized, fits = left_out.normalized, left_out.fits_without_one
    chosen: list[tuple[int, int]] = []
    multiples, count = _multiples(normalized), len(FACTORS)
    if (pose := pose_apart(normalized)) is not None:
        among = np.flatnonzero(_extents(normalized, pose)[1:] < AMONG_EXTENTS)
        chosen = [(pose, int(k)) for k in among]
    # Those whose multiples come nearest to the motions of the others,
    rows = multiples[fits.labels]
    residuals, _ = sampson_residuals(fits.linkages, rows, np.ones(rows.shape[:2]))
    squares = (residuals * residuals).reshape(*rows.shape[:2], 2).sum(axis=-1)
    cost = squares + fits.cost[:, None]
    for k in np.argsort(cost, axis=None, kind="stable")[: 3 * CANDIDATES]:
        chosen.append((int(fits.labels[k // count]), int(k % count)))
    chosen = list(dict.fromkeys(chosen))[: 2 * CANDIDATES]
    if len(multiples) <= MAX_POSES_ALL_LEFT_OUT:  # and all poses nearest to two quadrics
        every = np.tile(normalized.rows, (len(multiples), count, 1, 1))
        every[np.arange(len(multiples)), :, np.arange(len(multiples))] = multiples
        every = every.reshape(-1, len(multiples), 3)
        weights = np.broadcast_to(normalized.weights, every.shape[:2])
        _, distances = pencil_pairs(Displacement.from_poses(every), weights)
        best = np.argsort(distances, kind="stable")[:CANDIDATES]
        chosen += [(int(k // count), int(k % count)) for k in best]
    return np.array(list(dict.fromkeys(chosen)), dtype=np.intp).reshape(-1, 2)


def _multiples(normalized: NormalizedPoses) -> FloatArray:
    """All poses times all factors, (N, 14, 3)."""
    origin, length = normalized.frames.fixed_origin, normalized.frames.length
    given = normalized.rows[:, None, :2] * length + origin
    turn = np.broadcast_to(normalized.rows[:, None, 2:], (len(normalized.rows), len(FACTORS), 1))
    return np.concatenate([(given * FACTORS[:, None] - origin) / length, turn], axis=-1)


def _extents(normalized: NormalizedPoses, pose: int) -> FloatArray:
    """The distances (15,) of a pose and its multiples from the others' middle, in their extents."""
    middle, extent = _middle_and_extent(normalized, pose, 2)
    places = [normalized.rows[[pose], :2], _multiples(normalized)[pose, :, :2]]
    distances = np.linalg.norm(np.concatenate(places) - middle, axis=-1)
    return np.asarray(distances / np.linalg.norm(extent))


def _middle_and_extent(
    normalized: NormalizedPoses, pose: int, size: int
) -> tuple[FloatArray, FloatArray]:
    """The middle (size,) of the other poses, and their extents (size,) along their main axes."""
    others = normalized.rows[normalized.mask_without(pose), :size]
    middle = others.mean(axis=0)
    wide = np.linalg.svd(others - middle, compute_uv=False)
    wide = wide * math.sqrt(UNIFORM_EXTENT_SQUARED / len(others))
    return middle, np.maximum(wide, np.finfo(float).tiny)


def coincidence_chance(
    normalized: NormalizedPoses, prediction: Prediction, multiple: Multiple, increase: float
) -> float:
    """The chance that a multiple anywhere raises the cost of the others' motion by no more."""
    _, spread = prediction.residuals_and_covariance(multiple.row)
    _, extent = _middle_and_extent(normalized, multiple.pose, 3)
    area = math.pi * increase * math.sqrt(max(float(np.linalg.det(spread)), 1.0))
    return min(1.0, area / float(extent[1:].prod()))
