"""One pose that disagrees with all the others: the fit with each pose left out in turn.

A residual cannot tell: a wrong pose bends the fit until every pose misses a little.  Here the best
pair of dyads is fitted to all poses, and again without each of them.  Two dyads leave a pose two
conditions to meet (the third way is along their motion), and have ten dimensions, so that N poses
have m = 2 N - 10 residuals to spare.  With S the sum of squared distances of the poses from the
motion, of errors that are normal and equally large,

    P(S_without / S < q) = q^(m / 2 - 1)

(an F test with 2 and m - 2 degrees of freedom), N times that for the least of N such shares.  If
one number of a pose may be any, one condition is left: an F test with 1 and m - 1 of them, 3 N
times that.  The lesser chance counts, times two.  How large errors of angles are beside those of
positions is unknown, and the chance is a mean over that ratio (`noise_ratio`).  Lengths in another
unit have a test of their own (`unit_errors`).
Poses of which most follow no linkage at all obey it well enough, too (`benchmarks.odd_pose`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, final

import numpy as np

from burmester.diagnosis.leave_one_out import LeaveOneOut
from burmester.diagnosis.noise_ratio import (
    RATIOS,
    chance_of_pose,
    first_order_chances,
    fits_by_ratio,
    floor_by_ratio,
)
from burmester.diagnosis.repairs import Prediction, Repair, by_evidence, repairs_of, unit_repair
from burmester.diagnosis.sampson_fits import NormalizedPoses, refine_best
from burmester.diagnosis.unit_errors import UnitError, pose_apart, unit_error
from burmester.errors import InputError
from burmester.fourbar.dyad import Dyad
from burmester.fourbar.foot_points import newton_steps, rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import on_circuits
from burmester.numerics.arrays import ROUNDING, FloatArray, concatenate, even_numbers, median
from burmester.progress import time_for
from burmester.tasks.motion_class import MotionClass, classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, pose_labels
from burmester.values import real_numbers, require_instance
from burmester.wording import figure, listed

MIN_POSES = 7  # distinct ones; fewer leave no residual to spare without one pose
# Of more distinct poses so many are looked at, evenly chosen, and the MANY_SUSPECTS farthest off
# their motion.
MAX_POSES, MANY_SUSPECTS = 200, 8
FALSE_ALARM_CHANCE = 5e-3  # up to which a pose is named
OTHER_POSE_CHANCE = 0.05  # above it another pose may be the odd one as well, and is named, too
MAX_SCREENING_CHANCE = 0.1  # by the first fits; above it better fits hardly turn up an odd pose
SUSPECTS = 3  # poses, by each of two first measures, that are looked at with every noise ratio
MIN_ERROR_RATIO = 2.0  # of the error with the pose to that without it; else its distance is told
FAR = 1e9  # extents; a pose that no place of a linkage comes near counts as so far away
MAX_EXPLAINED_ERROR = 3.0  # times the error by digits; a fit as good leaves nothing to explain


@final
@dataclass(frozen=True, slots=True, eq=False)
class OddPose:
    """A pose that does not agree with the others.

    Attributes
    ----------
    pose : int
        Its index.
    others : tuple of int
        Poses that may be the odd one instead: they explain the error nearly as well.
    error, error_without : float
        Of the best linkage, refined as a whole, to all poses and without this one: the root mean
        square distance of these poses from its motion, in the task's unit, where angles count as
        `length` times radians.
    miss : float
        The distance of the pose from the motion of the linkage of the others.
    length : float
        The extent of the poses.
    chance : float
        That poses with errors alike show as much somewhere.
    linkage : Linkage
        That of the others.
    repairs : tuple of Repair
        Changes that make the pose agree, the likeliest first (`repairs.by_evidence`); none if
        nothing simple does.
    extents : float or None
        How many times the others' extent away it lies, if it lies among them in another unit.
    factor : float
        Of its lengths, that brings it into the unit of the others; 1 if that is not its fault.
    deviations : float
        The distance of the pose from the motion of the others, in standard deviations: those of
        its own errors and of the motion, with the ratio of errors that is likeliest without it.
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
    extents: float | None = None
    factor: float = 1.0
    deviations: float = math.nan

    @property
    def ratio(self) -> float:
        """The error with the pose, over that without it."""
        return self.error / max(self.error_without, np.finfo(float).tiny)

    @property
    def message(self) -> str:
        """What is wrong."""
        labels = pose_labels(self.task, (self.pose, *self.others), "number and name")
        names = listed([f"pose {label}" for label in labels], "or")
        return f"{names} does not agree with the others"

    @property
    def why(self) -> str:
        """By which numbers."""
        which = f"pose {self.pose + 1}" if self.others else "it"
        if self.extents is not None:
            how = f"times {self.factor:g}" if self.factor > 1 else f"divided by {1 / self.factor:g}"
            return (
                f"it lies {figure(self.extents)} times the others' extent away; {how} it lies "
                "among them"
            )
        without = length_of(self.error_without, self.task)
        if self.ratio >= MIN_ERROR_RATIO:
            times = figure(self.ratio) if self.ratio < 1e6 else "a million"
            text = (
                f"leaving {which} out lowers the error from {figure(self.error)} to {without} "
                f"({times} times)"
            )
        else:
            text = (
                f"{which} lies {length_of(self.miss, self.task)} from the motion that the others "
                f"agree on, {figure(self.deviations)} standard deviations"
            )
        if self.others:
            others = listed([str(k + 1) for k in self.others], "or")
            text += f"; leaving {others} out does nearly as much"
        return text

    @property
    def help(self) -> str:
        """What to do."""
        name = pose_labels(self.task, [self.pose])[0]
        number = name if name.isdecimal() else self.pose + 1  # a numeric name is that of its row
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
    false_alarm_chance: float = FALSE_ALARM_CHANCE,
) -> OddPose | None:
    """The pose of a task that does not agree with the others, if one does so beyond doubt.

    It is the pose that leaves the least error without it, or that agrees with the others in
    another unit.  Nothing is said of poses that a linkage meets as well as they are known
    (`Task.resolution`), of special motions, and of fewer than 7 distinct poses.  Of more than 200
    some are looked at, evenly chosen, with those that lie farthest off the motion of these.
    Weights count as inverse variances.  Limits, marks for exact poses and requirements have no
    part: the question is whether poses agree with any linkage.  Repeats count once, and the first
    of them is named.

    Parameters
    ----------
    task : Task
        The poses.
    motion : MotionClass, optional
        The motion class of the task, if it is known; that saves time.
    dyads : sequence of Dyad
        The best dyads of all its poses, if they are known; that saves time.
    false_alarm_chance : float
        The highest chance of a false alarm, above 0 to 1; 1 names the likeliest pose in any case.

    Returns
    -------
    OddPose or None

    Raises
    ------
    InputError
        E125 (no `Task`, or no such chance).

    Examples
    --------
    One angle of the ten poses in Table 2 of the paper is misprinted:

    >>> from burmester.io.cases import load
    >>> rows = load("ge2012-exact")["poses_as_printed"]
    >>> poses = Task.from_rows(rows, angle_unit="deg").poses
    >>> odd = odd_pose(Task(poses, resolution=(5e-5, 8.7e-5)))
    >>> odd.pose, odd.repairs[0].message
    (5, 'its angle 52.67°: 52.87° would agree')
    """
    require_instance(
        task, Task, "task", 'give a Task, such as Task.from_rows(rows, angle_unit="deg")'
    )
    if not 0 < float(real_numbers(false_alarm_chance, (), "false_alarm_chance")) <= 1:
        raise InputError(
            "E125",
            f"false_alarm_chance is {false_alarm_chance}, not a chance",
            help=f"give a number above 0, up to 1, such as {FALSE_ALARM_CHANCE}",
        )
    motion = classify_motion(task) if motion is None else motion
    fit = motion.determined or (motion.distinct >= MIN_POSES and _is_general(task, motion))
    if not (fit and motion.distinct >= MIN_POSES):
        return None
    if not time_for("comparing each pose with the others", whole=True):
        return None
    look = _among_many if motion.distinct > MAX_POSES else _among_all
    return look(task, motion, dyads, false_alarm_chance)


def _among_all(
    task: Task, motion: MotionClass, dyads: Sequence[Dyad], false_alarm_chance: float
) -> OddPose | None:
    """`odd_pose`, each of the distinct poses left out."""
    weights = (
        None if task.weights is None else np.bincount(motion.group, task.weights).astype(float)
    )
    poses = task.poses[motion.first]
    normalized = NormalizedPoses.of(poses, weights)
    length, count = float(normalized.frames.length), len(normalized.rows)
    position, angle = (each / math.sqrt(3) for each in task.resolution)
    digit_error = max(position / length, angle, ROUNDING)
    explained = (MAX_EXPLAINED_ERROR * digit_error) ** 2 * (2 * count - 10)
    pairs, whole = LeaveOneOut.fit_all(normalized, dyads, poses, enough=explained)
    if whole.cost.min() <= explained:
        return None
    fits = LeaveOneOut.from_shared_starts(normalized, pairs, whole)
    floor = floor_by_ratio(count, position / length, angle)
    equal_floor = (2 * count - 12) * digit_error**2
    least, of_all = fits.fits_without_one.cost.min(), fits.fits_to_all.cost.min()
    by_fits = chance_of_pose(count, least + equal_floor, of_all + equal_floor)
    screened = first_order_chances(normalized, fits.fits_to_all.of(-1).linkages[:1], floor)
    hopeless = min(float(by_fits), screened.min()) > max(MAX_SCREENING_CHANCE, false_alarm_chance)
    if hopeless and pose_apart(normalized) is None:
        return None
    other_unit = unit_error(fits, equal_floor, false_alarm_chance)
    if other_unit is None and hopeless:
        return None
    if other_unit is None:
        fits = fits.with_own_starts()
    odd = _described(task, motion, fits, Suspects.of(fits, screened, floor, other_unit))
    if odd is None or false_alarm_chance >= 1 or odd.extents is not None:
        return odd
    return odd if odd.chance <= false_alarm_chance else None


def _among_many(
    task: Task, motion: MotionClass, dyads: Sequence[Dyad], false_alarm_chance: float
) -> OddPose | None:
    """`odd_pose` of some of many poses: an even sample, and those farthest off its motion."""
    count, weights = motion.distinct, None
    if task.weights is not None:
        weights = np.bincount(motion.group, task.weights).astype(float)
    poses, some = task.poses[motion.first], even_numbers(count, MAX_POSES - MANY_SUSPECTS)
    normalized = NormalizedPoses.of(poses, weights)
    sample = normalized._replace(
        poses=normalized.poses[some], rows=normalized.rows[some], weights=normalized.weights[some]
    )
    _, fits = LeaveOneOut.fit_all(sample, dyads, poses[some])
    rows = normalized.rows[None]
    with np.errstate(all="ignore"):  # to first order; where a pose is beyond all linkages nan
        there, _ = newton_steps(fits.of(-1).linkages[:1], rows, None, 1.0)
        size = normalized.weights * ((there - rows)[0] ** 2).sum(axis=-1)
    likeliest = np.argsort(-np.nan_to_num(size, nan=np.inf), kind="stable")[:MANY_SUSPECTS]
    index = np.sort(motion.first[np.union1d(some, likeliest)])
    part = Task(
        task.poses[index],
        None if task.weights is None else task.weights[index],
        None if task.names is None else tuple(task.names[k] for k in index.tolist()),
        task.length_unit,
        task.resolution,
    )
    # Chances are those of the sample: of all poses some is odd by chance as much more often.
    own = false_alarm_chance * len(index) / count if false_alarm_chance < 1 else 1.0
    odd = odd_pose(part, false_alarm_chance=own)
    if odd is None:
        return None
    others = tuple(int(index[k]) for k in odd.others)
    return replace(odd, task=task, pose=int(index[odd.pose]), others=others)


class Suspects(NamedTuple):
    """Poses that may be the odd one.

    floor: (R,), the part of sums of squares that comes from digits alone, for each noise ratio.
    unit_error: of the only suspect, where that is what stands out.
    """

    poses: list[int]
    floor: FloatArray
    unit_error: UnitError | None

    @classmethod
    def of(
        cls,
        fits: LeaveOneOut,
        screened: FloatArray,
        floor: FloatArray,
        unit_error: UnitError | None,
    ) -> Suspects:
        """By the fits without each, and by their chances (N,) to first order."""
        if unit_error is not None:
            return cls([unit_error.pose], floor, unit_error)
        likeliest = np.argsort(screened, kind="stable")[:SUSPECTS].tolist()
        poses = fits.fits_without_one.labels_by_cost()[:SUSPECTS] + likeliest
        return cls(list(dict.fromkeys(poses)), floor, None)

    def starts(self, fits: LeaveOneOut, pose: int) -> LinkageBatch:
        """Linkages that fit all poses but one."""
        found = fits.fits_without_one.of(pose).linkages
        return found if self.unit_error is None else concatenate([self.unit_error.linkages, found])


def _described(
    task: Task, motion: MotionClass, left_out: LeaveOneOut, suspects: Suspects
) -> OddPose | None:
    """The likeliest suspect with its numbers; None where a linkage cannot be followed."""
    normalized, other_unit = left_out.normalized, suspects.unit_error
    count, length = len(normalized.rows), float(normalized.frames.length)
    best_of_all = left_out.fits_to_all.linkages
    by_ratio = {
        k: fits_by_ratio(
            normalized,
            concatenate([suspects.starts(left_out, k), best_of_all[:1]]),
            best_of_all,
            k,
            suspects.floor,
        )
        for k in suspects.poses
    }
    chances = {k: float(each.chance(count)) for k, each in by_ratio.items()}
    pose = min(chances, key=lambda k: chances[k])
    chosen, likeliest = by_ratio[pose], [by_ratio[pose].best_ratio()]
    starts = concatenate([suspects.starts(left_out, pose), chosen.linkages[likeliest]])
    without, linkages = refine_best(normalized, starts, pose)
    of_all, _ = refine_best(normalized, concatenate([best_of_all, linkages]), None)
    if not np.isfinite(without):
        return None
    # Refinement may stop in a local minimum; these are upper bounds.
    miss = float(_misses(normalized, linkages, pose, np.ones(1))[0])
    bound = without + normalized.weights[pose] * miss**2
    of_all = min(of_all, float(left_out.fits_to_all.cost.min()), bound)
    chosen = chosen.bounded(
        normalized.weights[pose] * _misses(normalized, chosen.linkages, pose, RATIOS) ** 2
    )
    chance = float(chosen.chance(count))
    sigma = math.sqrt(float(chosen.without[likeliest[0]]) / (2 * count - 12))
    prediction = Prediction.of(
        normalized, chosen.linkages[likeliest], pose, sigma, RATIOS[likeliest]
    )
    repairs = repairs_of(normalized, prediction, pose, task)
    others: list[int] = []
    if other_unit is None:
        others = [k for k in chances if k != pose and chances[k] * OTHER_POSE_CHANCE < chance]
        others.sort(key=lambda k: chances[k])
    else:
        chance = min(chance, other_unit.chance)
        rest = [each for each in repairs if each.kind != "unit" or each.factor != other_unit.factor]
        unit = unit_repair(normalized, pose, other_unit.factor, other_unit.miss, task)
        repairs = by_evidence([unit, *rest], count)
    total = normalized.weights.sum()
    shares = total, total - normalized.weights[pose]
    error, error_without = (
        math.sqrt(cost / share) for cost, share in zip((of_all, without), shares, strict=True)
    )
    return OddPose(
        task,
        int(motion.first[pose]),
        tuple(int(motion.first[k]) for k in others),
        error * length,
        error_without * length,
        miss * length,
        length,
        min(1.0, chance),
        linkages.from_canonical(normalized.frames).linkage(0),
        repairs,
        other_unit.extents if other_unit is not None and other_unit.far_apart else None,
        1.0 if other_unit is None else other_unit.factor,
        chosen.deviations(count),
    )


def _misses(
    normalized: NormalizedPoses, linkages: LinkageBatch, pose: int, ratio: FloatArray
) -> FloatArray:
    """The distances (k,) of a pose from the motions of linkages (k,), one for each ratio (k,)."""
    at, out = normalized.poses[[pose]], []
    for k, radian in enumerate((1 / ratio).tolist()):
        gap = rows_of(on_circuits(linkages[[k]], at, radian), radian) - rows_of(at, radian)
        out.append(np.fmin.reduce(np.linalg.norm(gap, axis=-1), axis=None))
    return np.asarray(np.fmin(out, FAR))


def _is_general(task: Task, motion: MotionClass) -> bool:
    """Whether a motion is a general one but for the one pose that is farthest off."""
    poses = task.poses[motion.first]
    middle = median(poses.translation, 0)[0]
    far = int(((poses.translation - middle) ** 2).sum(axis=-1).argmax())
    others = poses[np.arange(poses.shape[0]) != far]
    return classify_motion(Task(others, resolution=task.resolution)).determined
