"""Poses that agree with a four-bar as soon as they are read in another convention.

Seven conventions of a whole file differ for a linkage in two things only: whether its angles count
the other way round than its coordinates do, and by what its angles are multiplied.  A mirror image
of all poses is as good as they are, and so are poses in frames that are turned.  So clockwise
angles, y pointing down and x exchanged with y are one reading here, and nobody can tell the three
apart by a fit: each makes the linkage of the others, or its mirror image.

The best linkage is fitted to the poses as read, and to those in each other convention.  Of poses
that belong to no linkage both sums of squares S have m = 2 N - 10 degrees of freedom, and

    P(S_other / S_read < q) <= C(m - 1, m / 2) (q / (1 + q))^(m / 2)

(an F test with m and m of them).  A smooth motion drawn by hand has fewer, and nobody knows how
many: one in fifty fits 30 times better with its angles negated.  So the chance has to be tiny, too
(`benchmarks.conventions`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np
from numpy.typing import NDArray

from burmester.diagnosis.leave_one_out import LeaveOneOut, pencil_pairs
from burmester.diagnosis.sampson_fits import (
    FITS_PER_LABEL,
    FULL_STEPS,
    NormalizedPoses,
    fit_linkages,
    refine_best,
)
from burmester.fourbar.dyad import Dyad
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, FloatArray, concatenate, even_numbers
from burmester.progress import time_for
from burmester.tasks.motion_class import MotionClass
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.wording import figure

COMPARING = "comparing each pose with the others"  # with odd_pose, as one step
MIN_POSES = 7  # distinct ones; any six fit too well in both readings
MAX_POSES = 60  # of more distinct ones so many are looked at, evenly chosen
MIN_ERROR_RATIO = 30.0  # of the errors as read to those in the other convention
FALSE_ALARM_CHANCE = 1e-10  # by the F test, up to which a convention is named
SCREENING_STEPS = 4  # of the descent from each of the first starts
SCREENED_SUBSETS, SUBSET_POSES = 6, 7  # poses whose pencils start the first fits
MIN_SCREENED_RATIO = 2.0  # of errors by the first fits; below it the best fits are not looked for
RADIANS_READ_AS_DEGREES = math.radians(7.0)  # numbers up to 7 (a turn is 6.28) may be radians


class Reading(NamedTuple):
    """Poses in another convention: their angles times a factor, and its names for --convention.

    Numbers in a file have the same errors whatever they mean, so each reading has a ratio of errors
    of angles (radians) to errors of positions (extents), and beside it the poses as read have one.
    """

    factor: float
    names: tuple[str, ...]

    @property
    def ratio(self) -> float:
        return min(1.0, abs(self.factor))

    @property
    def ratio_as_read(self) -> float:
        return min(1.0, 1 / abs(self.factor))


AS_READ = Reading(1.0, ())


@final
@dataclass(frozen=True, slots=True, eq=False)
class OtherConvention:
    """A convention in which the poses fit a four-bar far better.

    names: of the convention, for the option --convention.
    error_as_read, error: root mean square distances of the poses from the motion of the best
        linkage, as read and in that convention, in the task's unit.
    """

    task: Task
    names: tuple[str, ...]
    error_as_read: float
    error: float

    @property
    def message(self) -> str:
        """What fits better."""
        how = " and ".join(_WORDS[name] for name in self.names)
        ratio = self.error_as_read / max(self.error, np.finfo(float).tiny)
        times = figure(ratio) if ratio < 1e6 else "over a million"
        return f"the poses fit a four-bar {times} times better with all angles {how}"

    @property
    def why(self) -> str:
        """By which numbers."""
        return (
            f"as read they miss the best four-bar by {length_of(self.error_as_read, self.task)} "
            f"(root mean square), in that convention by {length_of(self.error, self.task)}"
        )

    @property
    def help(self) -> str:
        """What to type."""
        option = "--convention " + ",".join(self.names)
        if self.names[0] != "clockwise":
            return f"if that is what they are, read the file with {option}"
        rest = option.removeprefix("--convention clockwise")
        return (
            f"if the angles count clockwise, read the file with {option}; if y points down, with "
            f"--convention y-down{rest}; if x and y are exchanged, with --convention "
            f"swap-xy{rest}: all three fit alike, and make the same linkage or its mirror image"
        )


_WORDS = {"clockwise": "negated", "radians": "taken as radians", "degrees": "taken as degrees"}


def other_convention(
    task: Task, motion: MotionClass, dyads: Sequence[Dyad] = ()
) -> OtherConvention | None:
    """The convention in which the poses of a task fit a four-bar beyond doubt, and as read do not.

    None where they fit as read, for fewer than 7 distinct poses, and where nothing is certain.
    Weights count; limits, tolerances and requirements have no part.
    dyads: the best of all poses, where they are known; that saves time.
    """
    if motion.distinct < MIN_POSES or not time_for(COMPARING, whole=True):
        return None
    some = even_numbers(motion.distinct, MAX_POSES)
    poses, weights = task.poses[motion.first[some]], None
    if task.weights is not None:
        weights = np.bincount(motion.group, task.weights).astype(float)[some]
    comparison = Comparison(poses, weights, *(each / math.sqrt(3) for each in task.resolution))
    if comparison.fits_as_read(dyads):
        return None
    with np.errstate(all="ignore"):  # angles that are taken for what they are not
        found, bound = comparison.likeliest()
        if found is None:
            return None
        error = comparison.least_error(found, found.ratio)
        if not comparison.is_certain(found, bound, error):
            return None
        as_read = comparison.least_error(AS_READ, found.ratio_as_read, dyads)
        if not comparison.is_certain(found, as_read, error):
            return None
    length = comparison.length
    return OtherConvention(task, found.names, as_read * length, error * length)


@final
class Comparison(NamedTuple):
    """Poses (N,) with weights (N,), and standard deviations of their digits (length, radians).

    Errors are root mean squares over the poses, in the extent of the poses.
    """

    poses: Displacement
    weights: FloatArray | None
    position: float
    angle: float

    @property
    def length(self) -> float:
        """The extent of the poses."""
        return float(self._normalized(AS_READ).frames.length)

    def fits_as_read(self, dyads: Sequence[Dyad]) -> bool:
        """Whether two of the dyads miss so little that no other convention can be named."""
        misses = [float(np.sqrt((each.residual(self.poses) ** 2).mean())) for each in dyads]
        enough = MIN_ERROR_RATIO * self._digits(1.0) * self.length
        return sum(miss < enough for miss in misses) >= 2

    def likeliest(self) -> tuple[Reading | None, float]:
        """The reading with the least error by first fits, and by the same the error as read.

        None where it is not well below that.
        """
        others = self._others()
        # As read once for each ratio, then the others.
        ratios = sorted({each.ratio_as_read for each in others})
        ratio = np.array(ratios + [each.ratio for each in others])
        tasks = [self._normalized(each) for each in (*[AS_READ] * len(ratios), *others)]
        linkages, labels = _first_pairs(tasks)
        rows = np.stack([each.rows for each in tasks])[labels]
        share = np.tile(tasks[0].weights, (len(labels), 1))
        _, cost = fit_linkages(linkages, rows, share, SCREENING_STEPS, ratio[labels])
        error = np.sqrt([cost[labels == k].min() / rows.shape[1] for k in range(len(tasks))])
        as_read = [error[ratios.index(each.ratio_as_read)] for each in others]
        shares = error[len(ratios) :] / np.maximum(as_read, np.finfo(float).tiny)
        best = int(np.argmin(shares))
        found = others[best] if shares[best] * MIN_SCREENED_RATIO < 1 else None
        return found, float(as_read[best])

    def least_error(self, reading: Reading, ratio: float, dyads: Sequence[Dyad] = ()) -> float:
        """The error of the best linkage; ratio: of errors of angles to those of positions."""
        normalized = self._normalized(reading)
        pairs, whole = LeaveOneOut.fit_all(normalized, dyads, self.poses)
        linkages, cost = whole.linkages, whole.cost
        if ratio != 1:
            linkages = concatenate([pairs, linkages])
            share = np.tile(normalized.weights, (len(linkages), 1))
            linkages, cost = fit_linkages(
                linkages, normalized.rows, share, FULL_STEPS, np.array([ratio])
            )
        best = linkages[np.argsort(cost, kind="stable")[:FITS_PER_LABEL]]
        true, _ = refine_best(normalized, best, None, 1 / ratio)
        return math.sqrt((true if np.isfinite(true) else cost.min()) / len(normalized.rows))

    def is_certain(self, other: Reading, as_read: float, error: float) -> bool:
        """Whether an error as read is too much greater than another one for any chance."""
        digits = self._digits(1 / other.ratio_as_read)
        square = (error**2 + digits**2) / (as_read**2 + digits**2)
        half = self.poses.shape[0] - 5  # of the degrees of freedom
        chance = math.comb(2 * half - 1, half) * (square / (1 + square)) ** half
        return square * MIN_ERROR_RATIO**2 < 1 and chance < FALSE_ALARM_CHANCE

    def _digits(self, scale: float) -> float:
        """The error that digits explain; a radian as read counts as much as `scale` extents."""
        return max(self.position / self.length, scale * self.angle, ROUNDING)

    def _normalized(self, reading: Reading) -> NormalizedPoses:
        poses = Displacement(self.poses.translation, reading.factor * self.poses.angle)
        return NormalizedPoses.of(poses, self.weights)

    def _others(self) -> list[Reading]:
        """The other readings of angles as large as these."""
        most, turn = float(np.abs(self.poses.angle).max()), math.degrees(1)
        out = [Reading(-1.0, ("clockwise",))]
        for possible, factor, name in (
            (most < RADIANS_READ_AS_DEGREES, turn, "radians"),
            (most > 2 * math.pi, 1 / turn, "degrees"),
        ):
            if possible:
                out += [Reading(factor, (name,)), Reading(-factor, ("clockwise", name))]
        return out


def _first_pairs(tasks: Sequence[NormalizedPoses]) -> tuple[LinkageBatch, NDArray[np.intp]]:
    """Pairs of dyads (k,) near each task by pencils of all poses and of a few, and their tasks."""
    count, number = len(tasks[0].rows), len(tasks)
    # Fixed numbers, so that the same poses have the same answer.
    rng = np.random.default_rng(0)
    subsets = np.array([rng.permutation(count)[:SUBSET_POSES] for _ in range(SCREENED_SUBSETS)])
    starts, labels = [], []
    for index in (subsets, np.arange(count)[None]):
        rows = np.concatenate([each.rows[index] for each in tasks])
        pairs, _ = pencil_pairs(Displacement.from_poses(rows), None)
        starts.append(pairs)
        labels.append(np.repeat(np.arange(number), len(index)))
    return concatenate(starts), np.concatenate(labels)
