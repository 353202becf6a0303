"""Whether one pose disagrees with all the others: the fit with each pose left out in turn.

A residual cannot tell: a wrong pose bends the fit until every pose misses a little.  Here the best
pair of dyads is fitted to all poses, and again without each of them.  Two dyads leave a pose two
conditions to meet (the third way is along their motion), and have ten dimensions, so that N poses
have m = 2 N - 10 misses to spare.  With S the sum of squared distances of the poses from the
motion, of errors that are normal and equally large,

    P(S_without / S < q) = q^(m / 2 - 1)

(an F test with 2 and m - 2 degrees of freedom), N times that for the least of N such shares.  If
one number of a pose may be any, one condition is left: an F test with 1 and m - 1 of them, 3 N
times that.  The lesser chance counts, times two.  Lengths in another unit have a test of their own
(`unit_error`).
Poses of which most follow no linkage at all obey it well enough, too (`benchmarks.odd_pose`).
Not known is how large errors of angles are beside those of positions (`tangent_fits.Seen` says what
is taken); where they are three times as large or as small, some more false alarms must be expected.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.diagnosis.leave_one_out import LeaveOneOut
from burmester.diagnosis.repairs import NUMBERS, Nearness, Repair, repairs_of, unit_repair
from burmester.diagnosis.sampson_fits import Seen, refined
from burmester.diagnosis.unit_errors import UnitError, apart, unit_error
from burmester.fourbar.dyad import Dyad
from burmester.fourbar.foot_points import rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.nearest_places import on_circuits
from burmester.numerics.arrays import ROUNDING
from burmester.numerics.bundles import concatenate
from burmester.tasks.motion_class import MotionClass, classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.wording import figure, length_of

__all__ = ["OddPose", "odd_pose"]

LEAST, MOST = 7, 1000  # different poses
SURE, DOUBTFUL = 5e-3, 0.05  # chance of a false alarm; that it is another pose
TESTS = 2  # of one pose and of one number: the least chance counts
HOPELESS = 0.1  # a chance by the first fits that better ones hardly make telling
TELLING, OUTLYING = 2.0, 10.0  # times the error; or standard deviations away
EXPLAINED = 3.0  # times what the resolution makes of errors


@final
@dataclass(frozen=True, slots=True, eq=False)
class OddPose:
    """A pose that does not agree with the others.

    pose: its index; others: those that it may be instead, as they explain it nearly as well.
    error, error_without: of the best linkage, refined as a whole, to all poses and without this
        one: the root mean square distance of the poses counted from its motion, in the task's
        unit, where angles count as `length` times radians.
    miss: the distance of the pose from the motion of the linkage of the others.
    chance: that poses with errors alike would show as much anywhere.
    linkage: the one that the others agree on.
    repairs: what would make it agree, the likeliest first; none if nothing simple does.
    beside: how many times the others' extent away it lies, if it lies among them as repaired.
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
    beside: float | None = None

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
        if self.beside is not None:
            by = self.repairs[0].factor
            how = f"times {by:g}" if by > 1 else f"divided by {1 / by:g}"
            return (
                f"it lies {figure(self.beside)} times the others' extent away; {how} it lies "
                "among them"
            )
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
    motion: MotionClass | None = None,
    dyads: Sequence[Dyad] = (),
    *,
    sure: float = SURE,
) -> OddPose | None:
    """The pose of a task that does not agree with the others, if one can be told with certainty.

    motion: the task's motion class, dyads: the best dyads of all its poses, where they are known;
    that saves time.  The pose named is the one that leaves the least error when it is left out, or
    agrees with the others in another unit.  sure: the chance of a false alarm that is taken; 1
    names the likeliest pose in any case.

    Nothing is said of poses that a linkage meets as well as they are known (`Task.resolution`), of
    special motions, and of fewer than 7 or more than 1000 different poses.  Weights count as
    inverse variances.  Limits, marks for exact poses and requirements are left out: whether poses
    agree is asked of any linkage.  Repeats count once, and the first is named.
    """
    motion = classify_motion(task) if motion is None else motion
    fit = motion.determined or (motion.distinct >= LEAST and _is_general(task, motion))
    if not (fit and LEAST <= motion.distinct <= MOST):
        return None
    weights = (
        None if task.weights is None else np.bincount(motion.group, task.weights).astype(float)
    )
    poses = task.poses[motion.first]
    seen = Seen.of(poses, weights)
    position, angle = task.resolution
    known = max(max(position / float(seen.frames.length), angle) / math.sqrt(3), ROUNDING)
    count = len(seen.rows)
    pairs, whole = LeaveOneOut.whole_of(seen, dyads, poses)
    if whole.cost.min() <= (EXPLAINED * known) ** 2 * (2 * count - 10):
        return None
    left = LeaveOneOut.quickly(seen, pairs, whole)
    floor = (2 * count - 12) * known**2
    first = _chance(count, left.fits.cost.min() + floor, left.whole.cost.min() + floor)
    hopeless = first > max(HOPELESS, sure)
    if hopeless and apart(seen) is None:
        return None
    slip = unit_error(left, floor, sure)
    if slip is None and hopeless:
        return None
    if slip is None:
        left = left.thoroughly()
        pose = left.fits.by_cost()[0]
    else:
        pose = slip.pose
    odd = _told(task, motion, left, pose, floor, slip)
    if odd is None or sure >= 1 or odd.beside is not None:
        return odd
    sigma = odd.error_without * math.sqrt((count - 1) / (2 * count - 12))
    telling = odd.ratio >= TELLING or odd.miss >= OUTLYING * max(sigma, known * odd.length)
    return odd if telling and odd.chance <= sure else None


def _told(  # noqa: PLR0917
    task: Task,
    motion: MotionClass,
    left: LeaveOneOut,
    pose: int,
    floor: float,
    slip: UnitError | None,
) -> OddPose | None:
    """What is told of a pose; None where the places of a linkage are lost."""
    seen, fits = left.seen, left.fits
    count, length = len(seen.rows), float(seen.frames.length)
    spare = 2 * count - 12
    own = fits.of(pose).stack if slip is None else concatenate([slip.stack, fits.of(pose).stack])
    without, stack = refined(seen, own, pose)
    of_all, _ = refined(seen, concatenate([left.whole.stack, stack]), None)
    if not np.isfinite(without):
        return None
    place = on_circuits(stack, seen.poses[[pose]], 1.0)
    gap = rows_of(place, 1.0)[0, :, 0] - seen.rows[pose]
    miss = float(np.nanmin(np.append(np.linalg.norm(gap, axis=-1), 1e9)))
    # What is refined may be caught in a valley, but never is worse than this.
    of_all = min(of_all, float(left.whole.cost.min()), without + seen.weights[pose] * miss**2)
    sigma = math.sqrt(max(without, floor) / spare)
    repairs = repairs_of(seen, Nearness.of(seen, stack, pose, sigma), pose, task)
    chance = TESTS * _chance(count, without + floor, of_all + floor)
    for each in repairs:
        if each.kind in NUMBERS:
            mended = without + floor + (each.miss * sigma) ** 2
            chance = min(chance, TESTS * _chance_of_number(count, mended, of_all + floor))
    others: list[int] = []
    if slip is None:
        likely = {k: float(fits.of(k).cost[0]) for k in fits.by_cost() if k != pose}
        doubt = DOUBTFUL ** (1 / (count - 6))
        others = [k for k, cost in likely.items() if without + floor > doubt * (cost + floor)]
    else:
        chance = min(chance, slip.chance)
        rest = [each for each in repairs if each.kind != "unit" or each.factor != slip.by]
        repairs = (unit_repair(seen, pose, slip.by, slip.miss), *rest)
    shares = seen.weights.sum(), seen.weights.sum() - seen.weights[pose]
    error, rms = (
        math.sqrt(cost / share) for cost, share in zip((of_all, without), shares, strict=True)
    )
    return OddPose(
        task,
        int(motion.first[pose]),
        tuple(int(motion.first[k]) for k in others),
        error * length,
        rms * length,
        miss * length,
        length,
        min(1.0, chance),
        stack.back(seen.frames).linkage(0),
        repairs,
        slip.away if slip is not None and slip.beside else None,
    )


def _is_general(task: Task, motion: MotionClass) -> bool:
    """Whether a motion is special only beside one pose that is far, far off."""
    poses = task.poses[motion.first]
    middle = np.median(poses.translation, axis=0)
    far = int(((poses.translation - middle) ** 2).sum(axis=-1).argmax())
    others = poses[np.arange(poses.shape[0]) != far]
    return classify_motion(Task(others, resolution=task.resolution)).determined


def _chance(count: int, without: float, of_all: float) -> float:
    """That the least of so many sums of squares is no greater, see the module."""
    return float(min(1.0, count * min(1.0, without / of_all) ** (count - 6)))


def _chance_of_number(count: int, mended: float, of_all: float) -> float:
    """The same of 3 N sums with one number free: a bound on it, and nearly it where it is small."""
    half, share = (2 * count - 11) / 2, min(1.0, mended / of_all)
    if share == 1.0:
        return 1.0
    beta = math.exp(math.lgamma(half) + math.lgamma(0.5) - math.lgamma(half + 0.5))
    return float(min(1.0, 3 * count * share**half / (half * beta * math.sqrt(1 - share))))


def _called(task: Task, pose: int) -> str:
    return f"pose {pose + 1}" + ("" if task.names is None else f" ({task.names[pose]})")
