"""Whether one pose disagrees with all the others: the fit with each pose left out in turn.

A residual cannot tell: a wrong pose bends the fit until every pose misses a little.  Here the best
pair of dyads is fitted to all poses, and again without each of them.  Two dyads leave a pose two
conditions to meet (the third way is along their motion), and have ten dimensions, so that N poses
have m = 2 N - 10 misses to spare.  With S the sum of squared distances of the poses from the
motion, of errors that are normal and equally large,

    P(S_without / S < q) = q^(m / 2 - 1)

(an F test with 2 and m - 2 degrees of freedom), N times that for the least of N such shares.
Poses of which most follow no linkage at all obey it well enough, too (`benchmarks.odd_pose`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.accuracy import on_circuits, rows_of, settled, wrapped_angle
from burmester.candidates import ROUNDING
from burmester.displacement import Displacement, FloatArray
from burmester.dyad import PP, Dyad
from burmester.fingerprint import Fingerprint, fingerprint
from burmester.frames import CanonicalFrames
from burmester.linkage import Linkage
from burmester.misses import SIZE
from burmester.optimal import best_dyads
from burmester.pencil import fit_pencil
from burmester.reasons import figure, length_of
from burmester.refinement import refine
from burmester.stack import DIMENSIONS, LinkageStack
from burmester.task import Task

__all__ = ["OddPose", "Repair", "odd_pose"]

LEAST, MOST = 7, 1000  # different poses
EVERY = 30  # of so few poses each is left out at first; of more the likeliest
LIKELY, FEW = 4, 2  # poses whose fits start from dyads of their own
BEST, SHARED = 5, 3  # dyads joined in pairs, of each fit; pairs of the whole fit to start from
SHORT, LONG, KEPT = 6, 30, 3  # steps for all starts, and for so many of each fit
ROUNDS, FAR = 5, 3.0  # of weighing down what is so many times as far as the most
SURE, DOUBTFUL = 2e-3, 0.05  # chance of a false alarm; that it is another pose
TELLING, OUTLYING = 2.0, 10.0  # times the error; or times as far away as the others
EXPLAINED = 3.0  # times what the resolution makes of errors
# Squared misses in standard deviations, of one number and of two, and as a share of those of the
# pose as given.  Coarse, as x, y and the angle may not be known equally well.
AGREES, MENDED = (16.0, 40.0), 0.03
CONVERGED, STIFF = 1e-4, 1e6  # of the steps: the last gain, and the last damping
FACTORS = (10.0, 25.4, 1000.0, 12.0, 100.0, 2.54, 304.8)  # between units, or a decimal point away
SWEEP = 720  # coupler angles looked at for a place
NUDGE, NEWTON = 1e-6, 20


@final
@dataclass(frozen=True, slots=True, eq=False)
class Repair:
    """A change of a pose that makes it agree with the others.

    kind: "unit" (x and y times a factor), "slip" (one number times a power of ten), "radians"
    (taken for degrees, or the other way), "sign", "swap" (x and y), or the one number that is
    to be changed: "angle", "x", "y".
    message: what would agree, in words; values: (3,), x, y, angle in radians; uncertain digits cut.
    factor: of units and slips, what the given numbers are to be multiplied by; else 1.
    miss: how far from agreeing it still is, in standard deviations.
    """

    kind: str
    message: str
    values: FloatArray
    miss: float
    factor: float = 1.0


@final
@dataclass(frozen=True, slots=True, eq=False)
class OddPose:
    """A pose that does not agree with the others.

    pose: its index; others: those that it may be instead, as they explain it nearly as well.
    error, error_without: of the best linkage, refined as a whole, to all poses and without this
        one: the root mean square distance of the poses counted from its motion, in the task's
        unit, where angles count as `length` times radians.
    miss: the distance of the pose from the motion of the linkage of the others.
    chance: that poses with errors alike would show as much anywhere, by the F test.
    linkage: the one that the others agree on.
    repairs: what would make it agree, the likeliest first; none if nothing simple does.
    """

    task: Task
    pose: int
    others: tuple[int, ...]
    error: float
    error_without: float
    miss: float
    length: float
    chance: float
    linkage: Linkage
    repairs: tuple[Repair, ...]

    @property
    def ratio(self) -> float:
        """How many times less the error is without it."""
        return self.error / max(self.error_without, np.finfo(float).tiny)

    @property
    def message(self) -> str:
        """What is wrong."""
        names = [_called(self.task, pose) for pose in (self.pose, *self.others)]
        return f"{' or '.join(names)} does not agree with the others"

    @property
    def why(self) -> str:
        """By which numbers."""
        told = f"pose {self.pose + 1}" if self.others else "it"
        without = length_of(self.error_without, self.task)
        if self.ratio >= TELLING:
            times = figure(self.ratio) if self.ratio < 1e6 else "a million"
            said = (
                f"leaving {told} out lowers the error from {figure(self.error)} to {without} "
                f"({times} times)"
            )
        else:
            said = (
                f"{told} lies {length_of(self.miss, self.task)} from the motion that the others "
                f"agree on, {figure(self.miss / self.error_without)} times as far as they do"
            )
        if self.others:
            said += (
                f"; leaving {' or '.join(str(k + 1) for k in self.others)} out does nearly as much"
            )
        return said

    @property
    def help(self) -> str:
        """What to do."""
        number = self.pose + 1
        drop = f"leave it out with --drop {number}"
        if not self.repairs:
            return f"check the numbers of pose {number}; or {drop}"
        words = self.repairs[0].message
        if self.repairs[0].kind in {"x", "y", "angle"} and len(self.repairs) > 1:
            words += f" (or {self.repairs[1].message})"
        return f"check {words}; or {drop}"


def odd_pose(
    task: Task,
    motion: Fingerprint | None = None,
    dyads: Sequence[Dyad] = (),
    *,
    sure: float = SURE,
) -> OddPose | None:
    """The pose of a task that does not agree with the others, if one can be told with certainty.

    motion: the task's fingerprint, dyads: the best dyads of all its poses, where they are known;
    that saves time.  The pose named is the one that leaves the least error when it is left out.
    sure: the chance of a false alarm that is taken; 1 names the likeliest pose in any case.

    Nothing is said of poses that a linkage meets as well as they are known (`Task.resolution`), of
    special motions, and of fewer than 7 or more than 1000 different poses.  Weights count as
    inverse variances.  Limits, marks for exact poses and requirements are left out: whether poses
    agree is asked of any linkage.  Repeats count once, and the first is named.
    """
    motion = fingerprint(task) if motion is None else motion
    fit = motion.determined or (motion.distinct >= LEAST and _is_general(task, motion))
    if not (fit and LEAST <= motion.distinct <= MOST):
        return None
    weights = (
        None if task.weights is None else np.bincount(motion.group, task.weights).astype(float)
    )
    seen = _Seen.of(task.poses[motion.first], weights)
    count, length = len(seen.rows), float(seen.frames.length)
    position, angle = task.resolution
    known = max(max(position / length, angle) / math.sqrt(3), ROUNDING)
    pairs = _pairs(seen, None, dyads)
    whole, _ = _left_out(seen, pairs, np.full(len(pairs), -1))
    if whole.cost.min() <= (EXPLAINED * known) ** 2 * (2 * count - 10):
        return None
    fits, own = _each_left_out(seen, pairs, whole)
    pose = int(own[fits.cost.argmin()])
    spare = 2 * count - 12
    floor = spare * known**2

    stack = fits.stack[own == pose]
    if _chance(count, fits.cost.min() + floor, whole.cost.min() + floor) > sure:
        return None
    without, stack = _refined(seen, stack, pose)
    of_all, _ = _refined(seen, whole.stack.and_(stack), None)
    if not np.isfinite(without):
        return None
    place = on_circuits(stack, seen.poses[[pose]], 1.0)
    gap = rows_of(place, 1.0)[0, :, 0] - seen.rows[pose]
    miss = float(np.nanmin(np.append(np.linalg.norm(gap, axis=-1), 1e9)))
    # What is refined may be caught in a valley, but never is worse than this.
    of_all = min(of_all, whole.cost.min(), without + seen.weights[pose] * miss**2)
    chance = _chance(count, without + floor, of_all + floor)
    shares = seen.weights.sum(), seen.weights.sum() - seen.weights[pose]
    error, rest = (
        math.sqrt(cost / share) for cost, share in zip((of_all, without), shares, strict=True)
    )
    telling = error >= TELLING * rest or miss >= OUTLYING * math.sqrt(max(without, floor) / spare)
    if chance > sure or not (telling or sure >= 1):
        return None
    likely = {int(k): fits.cost[own == k].min() for k in np.unique(own) if k != pose}
    doubt = DOUBTFUL ** (1 / (count - 6))
    others = [
        k
        for k in sorted(likely, key=likely.__getitem__)
        if without + floor > doubt * (likely[k] + floor)
    ]
    sigma = math.sqrt(max(without, floor) / spare)
    return OddPose(
        task,
        int(motion.first[pose]),
        tuple(int(motion.first[k]) for k in others),
        error * length,
        rest * length,
        miss * length,
        length,
        chance,
        stack.back(seen.frames).linkage(0),
        _repairs(seen, stack, pose, sigma, task),
    )


def _is_general(task: Task, motion: Fingerprint) -> bool:
    """Whether a motion is special only beside one pose that is far, far off."""
    poses = task.poses[motion.first]
    middle = np.median(poses.translation, axis=0)
    far = int(((poses.translation - middle) ** 2).sum(axis=-1).argmax())
    others = poses[np.arange(poses.shape[0]) != far]
    return fingerprint(Task(others, resolution=task.resolution)).determined


def _chance(count: int, without: float, of_all: float) -> float:
    """That the least of so many sums of squares is no greater, see the module."""
    return float(min(1.0, count * min(1.0, without / of_all) ** (count - 6)))


def _called(task: Task, pose: int) -> str:
    return f"pose {pose + 1}" + ("" if task.names is None else f" ({task.names[pose]})")


# --- the fits


class _Fits(NamedTuple):
    """Linkages (k,) fitted to weighted poses: weights (k, N), and sums (k,) of squares."""

    stack: LinkageStack
    share: FloatArray
    cost: FloatArray

    def some(self, index: NDArray[np.intp]) -> _Fits:
        return _Fits(self.stack[index], self.share[index], self.cost[index])


def _fitted(stack: LinkageStack, rows: FloatArray, share: FloatArray, steps: int) -> _Fits:
    """Linkages (k,) nearer to poses (N, 3), weighed by share (k, N).

    Levenberg and Marquardt's method; distances to first order, without the places.
    """
    z, kinds, count = stack.dimensions.reshape(-1, SIZE).copy(), stack.kinds, len(stack)
    damping = np.full(count, 1e-3)
    miss, slope = _misses(stack, rows, share)
    cost = (miss * miss).sum(axis=-1)
    run = np.arange(count)
    for _ in range(steps):
        turned = np.swapaxes(slope, -1, -2)
        flat = turned @ slope
        size = np.sqrt(np.einsum("kii->ki", flat))
        size = np.where(size > 1e-9 * size.max(axis=-1, keepdims=True), size, 1.0)
        flat /= size[:, :, None] * size[:, None]
        flat[:, range(SIZE), range(SIZE)] += damping[run, None]
        downhill = (turned @ miss[..., None])[..., 0] / size
        step = -np.linalg.solve(flat, downhill[..., None])[..., 0] / size
        to = z[run] + step
        there = LinkageStack(kinds[run], to.reshape(-1, 2, DIMENSIONS))
        new_miss, new_slope = _misses(there, rows, share[run])
        after = (new_miss * new_miss).sum(axis=-1)
        positive = (to.reshape(-1, 2, DIMENSIONS)[..., -1] > 0) | (kinds[run] > 0)
        better = (after < cost[run]) & positive.all(axis=-1)
        done = better & (after > cost[run] * (1 - 1e-4))
        z[run[better]], cost[run[better]] = to[better], after[better]
        miss = np.where(better[:, None], new_miss, miss)
        slope = np.where(better[:, None, None], new_slope, slope)
        damping[run] = np.maximum(damping[run] * np.where(better, 0.1, 10.0), 1e-10)
        keep = ~(done | (damping[run] > 1e6))
        run, miss, slope = run[keep], miss[keep], slope[keep]
        if not len(run):
            break
    return _Fits(LinkageStack(kinds, z.reshape(-1, 2, DIMENSIONS)), share, cost)


def _misses(
    stack: LinkageStack, rows: FloatArray, share: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Distances (k, 2 N) of poses (N, 3) from the motions of linkages (k,), to first order.

    In two directions normal to the motion, times the roots of share (k, N); and the derivatives
    (k, 2 N, 10) by the dimensions, but for the turn of the normals.
    """
    places = Displacement(rows[:, :2], rows[:, 2])
    count, number = len(stack), len(rows)
    places = Displacement(
        np.broadcast_to(places.translation, (count, number, 2)),
        np.broadcast_to(places.angle, (count, number)),
    )
    with np.errstate(all="ignore"):
        miss, force, partial = stack.bearing(places)
        a, b, c = ((force[:, i] * force[:, j]).sum(-1) for i, j in ((0, 0), (0, 1), (1, 1)))
        first, height = np.sqrt(a), np.sqrt(np.maximum(c - b * b / a, 1e-20 * c))
        root = np.sqrt(share)
        out = np.empty((count, number, 2))
        out[..., 0] = root * miss[:, 0] / first
        out[..., 1] = root * (miss[:, 1] - b / a * miss[:, 0]) / height
        slope = np.zeros((count, number, 2, SIZE))
        slope[..., 0, :DIMENSIONS] = (root / first)[..., None] * partial[:, 0]
        slope[..., 1, :DIMENSIONS] = -(root * b / a / height)[..., None] * partial[:, 0]
        slope[..., 1, DIMENSIONS:] = (root / height)[..., None] * partial[:, 1]
    lost = ~(np.isfinite(out).all(axis=(1, 2)) & np.isfinite(slope).all(axis=(1, 2, 3)))
    out[lost], slope[lost] = 1e50, 0.0
    return out.reshape(count, -1), slope.reshape(count, -1, SIZE)


class _Seen(NamedTuple):
    """Different poses as rows (N, 3), in lengths of their spread, and their weights, 1 on average.

    In these frames a radian is as much as the spread (rms, about the median): errors are taken to
    be as large a share of what positions and angles range over.
    """

    poses: Displacement
    rows: FloatArray
    weights: FloatArray
    frames: CanonicalFrames

    @classmethod
    def of(cls, poses: Displacement, weights: FloatArray | None) -> _Seen:
        count = poses.shape[0]
        share = np.ones(count) if weights is None else weights / weights.mean()
        middle = np.median(poses.translation, axis=0)
        # A wrong pose may be far off, and is not to be what others are measured by.
        away = np.sort(((poses.translation - middle) ** 2).sum(axis=-1))[:-1]
        length = np.sqrt(away.mean())
        frames = CanonicalFrames(middle, np.zeros(2), length if length > 0 else np.ones(()))
        seen = frames.see(poses)
        return cls(seen, rows_of(seen, 1.0), share, frames)

    def without(self, pose: int | None) -> NDArray[np.bool_]:
        """Which poses are left."""
        return np.asarray(np.arange(len(self.rows)) != (-1 if pose is None else pose))


def _pairs(seen: _Seen, left_out: int | None, dyads: Sequence[Dyad] = ()) -> LinkageStack:
    """The best dyads of the poses, but for one, joined in pairs."""
    if not dyads:
        keep = seen.without(left_out)
        best = best_dyads(seen.poses[keep], seen.weights[keep])
        frames, own = best.frames, seen.poses[keep]
        found: list[Dyad] = [best.dyads[i] for i in range(len(best.rms_error))]
        found += [frames.line_back(line) for line in best.sliders]
    else:
        found, own = list(dyads), seen.poses
    found = [each for each in found if not isinstance(each, PP)]
    error = [float((each.residual(own) ** 2).mean()) for each in found]
    order = np.argsort(np.nan_to_num(error, nan=np.inf), kind="stable")[:BEST]
    return LinkageStack.of([Linkage(found[a], found[b]) for a, b in combinations(order, 2)])


def _pencil_pairs(seen: _Seen, left_out: NDArray[np.intp]) -> tuple[LinkageStack, FloatArray]:
    """For each of left_out (n,) the pair of dyads of the paper's pencil without it, (n,).

    With how far (n,) the poses are from being held by two quadrics.
    """
    count = len(seen.rows)
    others = np.array([np.delete(np.arange(count), k) for k in left_out])
    found = fit_pencil(seen.poses[others], seen.weights[others])
    # A pencil may have one dyad only: any circle in the place of the other one.
    own = found.dyads.coefficients()
    lost = ~np.isfinite(own).all(axis=-1) | ~(found.rms_error < np.inf)
    z = np.concatenate(
        [found.dyads.fixed_pivot, found.dyads.moving_pivot, found.dyads.radius[..., None]], axis=-1
    )
    z[lost] = z[:, ::-1][lost] + np.array([0.1, 0.2, 0.3, 0.4, 0.0])
    z = np.where(np.isfinite(z), z, 1.0)
    pairs = LinkageStack(np.zeros(z.shape[:-1], dtype=np.int8), z)
    return pairs, found.noise * found.frames.length


def _left_out(
    seen: _Seen, starts: LinkageStack, left_out: NDArray[np.intp]
) -> tuple[_Fits, NDArray[np.intp]]:
    """Starts (k,) fitted without the poses left_out (k,), -1 for none; the best few of each.

    Sorted by what is left out; with those that are left out as `share` zero.
    """
    share = np.tile(seen.weights, (len(starts), 1))
    some = np.flatnonzero(left_out >= 0)
    share[some, left_out[some]] = 0.0
    rough = _fitted(starts, seen.rows, share, SHORT)
    order = np.lexsort((rough.cost, left_out))
    start = np.searchsorted(left_out[order], left_out[order])
    best = order[np.arange(len(order)) - start < KEPT]
    return _fitted(starts[best], seen.rows, share[best], LONG), left_out[best]


def _each_left_out(
    seen: _Seen, pairs: LinkageStack, whole: _Fits
) -> tuple[_Fits, NDArray[np.intp]]:
    """The best fits without each of the likeliest poses, and which poses those are, (k,)."""
    count = len(seen.rows)
    if count <= EVERY:
        each = np.arange(count)
        starts = pairs[:SHARED].and_(whole.stack)
        more, held = _pencil_pairs(seen, each)
    else:
        each, starts = _likely(seen, pairs)
        held = np.empty(0)
        more = LinkageStack(np.empty((0, 2), dtype=np.int8), np.empty((0, 2, DIMENSIONS)))
    stack = starts[np.tile(np.arange(len(starts)), len(each))].and_(more)
    own = np.concatenate([np.repeat(each, len(starts)), each[: len(more)]])
    fits, own = _left_out(seen, stack, own)
    likely = _by_cost(fits, own)[: LIKELY if count <= EVERY else FEW]
    if count <= EVERY:  # and where two quadrics hold the rest best: no start leads astray there
        likely = np.unique(np.append(likely, np.argsort(held, kind="stable")[:LIKELY]))
    stack, again = fits.stack, own
    for pose in likely:
        new = _pairs(seen, int(pose))
        stack, again = stack.and_(new), np.append(again, np.full(len(new), pose))
    # What leads to the best fit without one pose may do so without another.
    best = fits.stack[[int(np.flatnonzero(own == pose)[0]) for pose in likely]]
    for pose in likely:
        stack, again = stack.and_(best), np.append(again, np.full(len(best), pose))
    return _left_out(seen, stack, again)


def _by_cost(fits: _Fits, own: NDArray[np.intp]) -> NDArray[np.intp]:
    """The poses left out by the least cost without them."""
    order = own[np.argsort(fits.cost, kind="stable")]
    return np.asarray(list(dict.fromkeys(order.tolist())), dtype=np.intp)


def _likely(seen: _Seen, pairs: LinkageStack) -> tuple[NDArray[np.intp], LinkageStack]:
    """Of many poses those that may be odd, and linkages that pass the others by.

    Fits in which poses far away count less and less.
    """
    away = np.linalg.norm(seen.rows[:, :2] - np.median(seen.rows[:, :2], axis=0), axis=-1)
    farthest = int(away.argmax())
    stack = pairs.and_(_pairs(seen, farthest))
    share = np.tile(seen.weights, (len(stack), 1))
    for _ in range(ROUNDS):
        stack = _fitted(stack, seen.rows, share, SHORT).stack
        miss, _ = _misses(stack, seen.rows, np.ones_like(share))
        off = np.linalg.norm(miss.reshape(*share.shape, 2), axis=-1)
        middle = np.median(off, axis=-1, keepdims=True)
        share = seen.weights / (1 + (off / (FAR * middle + np.finfo(float).tiny)) ** 2) ** 2
    best = np.argsort(middle[:, 0], kind="stable")[:KEPT]
    far = np.argsort(-np.sqrt(seen.weights) * off[best], axis=-1)[:, :KEPT]
    each = np.unique(np.append(far.ravel(), farthest)).astype(np.intp)
    return each, stack[best]


def _refined(seen: _Seen, stack: LinkageStack, left_out: int | None) -> tuple[float, LinkageStack]:
    """The least sum of squared distances of poses, but for one, and the linkage (1,) that has it.

    By true distances; infinite where the places of all linkages (k,) were lost.
    """
    keep = seen.without(left_out)
    rows, weights = seen.rows[keep], seen.weights[keep]
    with np.errstate(all="ignore"):
        start = settled(stack, np.broadcast_to(rows, (len(stack), *rows.shape)), rows, 1.0)
        places = Displacement(start[..., :2], start[..., 2])
        fine = refine(stack, places, seen.poses[keep], 1.0, weights=weights)
        cost = (weights * ((fine.rows - rows) ** 2).sum(axis=-1)).sum(axis=-1)
    cost = np.nan_to_num(cost, nan=np.inf)
    best = int(cost.argmin())
    return float(cost[best]), fine.stack[[best]]


# --- what would make it agree


class _Test(NamedTuple):
    """The linkage (1,) of the other poses, how exactly they know it, and their error."""

    stack: LinkageStack
    known: FloatArray
    sigma: float

    @classmethod
    def of(cls, seen: _Seen, stack: LinkageStack, pose: int, sigma: float) -> _Test:
        share = np.where(seen.without(pose), seen.weights, 0.0)[None]
        _, slope = _misses(stack, seen.rows, share)
        size = np.linalg.norm(slope[0], axis=0)
        size = np.where(size > 0, size, 1.0)
        _, spread, axes = np.linalg.svd(slope[0] / size, full_matrices=False)
        open_ = spread > ROUNDING * spread[0]
        axes = axes[open_] / spread[open_, None] / size
        return cls(stack, axes.T @ axes, sigma)

    def at(self, row: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The misses (2,) of a pose (3,), and the inverse of their covariance."""
        miss, slope = _misses(self.stack, row[None], np.ones((1, 1)))
        spread = np.eye(2) + slope[0] @ self.known @ slope[0].T
        return miss[0], np.linalg.inv(spread) / self.sigma**2

    def off(self, row: FloatArray) -> float:
        """The squared miss, in standard deviations."""
        miss, weight = self.at(row)
        return float(miss @ weight @ miss)

    def changed(self, row: FloatArray, number: int) -> tuple[float, FloatArray, float]:
        """A pose (3,) with one number changed for the best: squared miss, pose, standard error."""
        power = 0.0
        for _ in range(NEWTON):
            miss, weight = self.at(row)
            ahead = row.copy()
            ahead[number] += NUDGE
            slope = (self.at(ahead)[0] - miss) / NUDGE
            power = float(slope @ weight @ slope)
            if not power > 0:
                return np.inf, row, np.inf
            step = float(slope @ weight @ miss) / power
            row = row.copy()
            row[number] -= step
            if not abs(step) > 1e-3 / math.sqrt(power):
                break
        return self.off(row), row, 1 / math.sqrt(power)


def _repairs(
    seen: _Seen, stack: LinkageStack, pose: int, sigma: float, task: Task
) -> tuple[Repair, ...]:
    test = _Test.of(seen, stack, pose, sigma)
    length, origin = float(seen.frames.length), seen.frames.fixed_origin
    x, y, angle = given = np.append(seen.rows[pose, :2] * length + origin, seen.rows[pose, 2])

    def row(values: FloatArray) -> FloatArray:
        return np.append((values[:2] - origin) / length, values[2])

    limit = MENDED * test.off(seen.rows[pose])
    found: list[Repair] = []
    for kind, factor, values, words in _slips(x, y, angle):
        off = test.off(row(np.array(values)))
        if off <= min(AGREES[1], limit):
            found.append(Repair(kind, words, np.array(values), math.sqrt(off), factor))
    found.sort(key=lambda each: (each.kind != "unit", each.miss))
    single: list[Repair] = []
    for number, name in enumerate(("x", "y", "angle")):
        tries = [test.changed(start, number) for start in _starts(stack, seen.rows[pose], number)]
        off, best, error = min(tries, key=lambda each: each[0])
        if off <= min(AGREES[0], limit):
            single.append(_single(name, number, given, best, error, off, seen, task))
    return (*found, *sorted(single, key=lambda each: each.miss))


def _starts(stack: LinkageStack, row: FloatArray, number: int) -> list[FloatArray]:
    """Poses (3,) that differ from a row (3,) by one number, near which the linkage (1,) may be."""
    out = [row]
    linkage = stack.linkage(0)
    with np.errstate(all="ignore"):
        if number < 2:
            places = linkage.couplers(row[2:])
            for value in places.translation[0, :, number]:
                if np.isfinite(value):
                    out.append(np.where(np.arange(3) == number, value, row))
            return out
        turn = row[2] + np.linspace(-np.pi, np.pi, SWEEP, endpoint=False)
        away = np.linalg.norm(linkage.couplers(turn).translation - row[:2], axis=-1)
    away = np.nan_to_num(away, nan=np.inf).min(axis=-1)
    low = (away <= np.roll(away, 1)) & (away <= np.roll(away, -1)) & np.isfinite(away)
    for k in np.flatnonzero(low)[np.argsort(away[low])][:3]:
        out.append(np.array([row[0], row[1], turn[k]]))
    return out


def _single(  # noqa: PLR0917
    name: str,
    number: int,
    given: FloatArray,
    best: FloatArray,
    error: float,
    off: float,
    seen: _Seen,
    task: Task,
) -> Repair:
    """One number changed, with the digits that are certain."""
    values = given.copy()
    if number == 2:
        values[2] = given[2] + wrapped_angle(best[2] - given[2])
        unit, resolution, scale = "°", math.degrees(task.resolution[1]), math.degrees(1.0)
    else:
        values[number] = best[number] * float(seen.frames.length) + seen.frames.fixed_origin[number]
        error *= float(seen.frames.length)
        unit, resolution, scale = (
            f" {task.length_unit}" if task.length_unit else "",
            task.resolution[0],
            1.0,
        )
    digits = math.floor(-math.log10(max(error * scale, 1.9 * resolution, 1e-15)))
    rounded = round(scale * values[number], digits)
    values[number] = rounded / scale
    told = f"{rounded:.{max(digits, 0)}f}"
    return Repair(
        name,
        f"its {name} {_given(scale * given[number])}{unit}: {told}{unit} would agree",
        values,
        math.sqrt(off),
    )


def _given(value: float) -> str:
    return f"{value:.10g}"


def _slips(
    x: float, y: float, angle: float
) -> list[tuple[str, float, tuple[float, float, float], str]]:
    """What one slip makes of a pose: kind, factor, numbers, words."""
    out = []
    degrees = math.degrees(angle)
    for factor in FACTORS:
        for by, said in ((factor, "times"), (1 / factor, "divided by")):
            words = f"its unit: x and y {said} {factor:g} would agree"
            out.append(("unit", by, (x * by, y * by, angle), words))
    for factor in (10.0, 100.0, 1000.0):
        for by in (factor, 1 / factor):
            out.append(
                ("slip", by, (x * by, y, angle), f"its x {_given(x)}: {_given(x * by)} would agree")
            )
            out.append(
                ("slip", by, (x, y * by, angle), f"its y {_given(y)}: {_given(y * by)} would agree")
            )
            words = f"its angle {_given(degrees)}°: {_given(degrees * by)}° would agree"
            out.append(("slip", by, (x, y, angle * by), words))
    for by in (math.degrees(1.0), math.radians(1.0)):
        words = f"the unit of its angle {_given(degrees)}°: {_given(degrees * by)}° would agree"
        out.append(("radians", by, (x, y, angle * by), words))
    for values, words in (
        ((-x, y, angle), f"the sign of its x {_given(x)}: {_given(-x)} would agree"),
        ((x, -y, angle), f"the sign of its y {_given(y)}: {_given(-y)} would agree"),
        ((-x, -y, angle), "the signs of its x and y: both the other way would agree"),
        (
            (x, y, -angle),
            f"the sign of its angle {_given(degrees)}°: {_given(-degrees)}° would agree",
        ),
    ):
        out.append(("sign", 1.0, values, words))
    out.append(("swap", 1.0, (y, x, angle), "its x and y: exchanged they would agree"))
    return out
