"""Changes that make a pose agree with the others: a slip undone, or one number replaced."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple, final

import numpy as np

from burmester.diagnosis.sampson_fits import EQUAL_ERRORS, NormalizedPoses, sampson_residuals
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.numerics.arrays import ROUNDING, FloatArray, wrapped_angle
from burmester.numerics.differences import DifferenceQuotients
from burmester.tasks.motion_task import Task

NUMBERS = ("x", "y", "angle")
# Mahalanobis distances, squared, up to which a changed pose agrees with the others.  Generous, as
# x, y and the angle may not be known equally well.
MAX_DISTANCE_OF_NUMBER = 16.0  # with one number replaced by the best
MAX_DISTANCE_OF_SLIP = 40.0  # with a slip undone, which leaves nothing to choose
AS_NEAR = 4.0  # more than the best; a number as near agrees as well, and the neighbours decide
MAX_DISTANCE_SHARE = 0.03  # of the squared distance of the pose as given, in either case
# Chances beforehand, a guess: of one factor between units, and of each other slip.  That of one
# number wrong in any way is its standard error over its range.
UNIT_CHANCE = 0.1
SLIP_CHANCE = 0.01
NUMBER_RANGE = (1.0, 1.0, math.pi)  # extents, radians
# Between two units of length, or a decimal point away; the first three are the usual ones.
UNIT_FACTORS = (10.0, 25.4, 1000.0, 12.0, 100.0, 2.54, 304.8)
SWEEP_ANGLES = 720  # coupler angles, half a degree apart, among which to look for places
QUOTIENTS = DifferenceQuotients(stride=1e-6)  # extents or radians; of residuals, by one number
MAX_NEWTON_STEPS = 20
MAX_PLACES = 3  # of the coupler, where the descent to the best angle starts


@final
@dataclass(frozen=True, slots=True, eq=False)
class Repair:
    """A change of a pose that makes it agree with the others.

    kind: "unit" (x and y times a factor), "slip" (one number times a power of ten), "radians"
        (taken for degrees, or the other way), "sign", "swap" (x and y), or the one number to
        replace: "angle", "x", "y".
    message: the change in words.
    values: (3,), x, y and angle in radians as changed, without uncertain digits.
    miss: the Mahalanobis distance that remains, in standard deviations.
    factor: of units and slips, the factor for the numbers as given; else 1.
    prior: its chance beforehand, a guess.
    strays: whether a changed number is farther from those of the poses before and after than the
        given one; the message says so.
    """

    kind: str
    message: str
    values: FloatArray
    miss: float
    factor: float = 1.0
    prior: float = SLIP_CHANCE
    strays: bool = False

    def evidence(self, count: int) -> float:
        """The logarithm of prior times likelihood (Student's), up to a constant; count: of poses.

        The standard deviation is known by the 2 N - 12 residuals to spare of all other poses.
        """
        spare = 2 * count - 12
        return math.log(self.prior) - (spare + 2) / 2 * math.log1p(self.miss**2 / spare)


def by_evidence(repairs: Iterable[Repair], count: int) -> tuple[Repair, ...]:
    """Repairs of one of `count` poses, the likeliest first."""
    return tuple(sorted(repairs, key=lambda each: -each.evidence(count)))


class Prediction(NamedTuple):
    """What the other poses predict of one pose: it lies on the motion of their linkage (1,).

    covariance: (10, 10), of its dimensions, in variances of a pose.
    sigma: the standard deviation of a position, in extents; ratio: (1,), that of an angle over it.
    """

    linkages: LinkageBatch
    covariance: FloatArray
    sigma: float
    ratio: FloatArray = EQUAL_ERRORS

    @classmethod
    def of(
        cls,
        normalized: NormalizedPoses,
        linkages: LinkageBatch,
        pose: int,
        sigma: float,
        ratio: FloatArray = EQUAL_ERRORS,
    ) -> Prediction:
        """By the linkage (1,) of all poses but one."""
        share = np.where(normalized.mask_without(pose), normalized.weights, 0.0)[None]
        _, jacobian = sampson_residuals(linkages, normalized.rows, share, ratio)
        size = np.linalg.norm(jacobian[0], axis=0)
        size = np.where(size > 0, size, 1.0)
        _, spread, axes = np.linalg.svd(jacobian[0] / size, full_matrices=False)
        determined = spread > ROUNDING * spread[0]
        axes = axes[determined] / spread[determined, None] / size
        return cls(linkages, axes.T @ axes, sigma, ratio)

    def residuals(self, rows: FloatArray) -> FloatArray:
        """The residuals (n, 2) of poses (n, 3)."""
        residuals, _ = sampson_residuals(self.linkages, rows, np.ones((1, len(rows))), self.ratio)
        return residuals.reshape(-1, 2)

    def residuals_and_covariance(self, row: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The residuals (2,) of a pose (3,), and their covariance (2, 2) in sigma squared."""
        residuals, jacobian = sampson_residuals(
            self.linkages, row[None], np.ones((1, 1)), self.ratio
        )
        spread: FloatArray = np.eye(2) + jacobian[0] @ self.covariance @ jacobian[0].T
        return residuals[0], spread

    def weighted_residuals(self, row: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The residuals (2,) of a pose (3,), and the inverse (2, 2) of their covariance."""
        residuals, spread = self.residuals_and_covariance(row)
        values, axes = np.linalg.eigh(spread)
        return residuals, (axes / (np.maximum(values, 1.0) * self.sigma**2)) @ axes.T

    def squared_distance(self, row: FloatArray) -> float:
        """The squared Mahalanobis distance of a pose (3,)."""
        residuals, weight = self.weighted_residuals(row)
        return float(residuals @ weight @ residuals)

    def best_change(self, row: FloatArray, number: int) -> Change:
        """The pose (3,) with one number replaced by the nearest that agrees best."""
        power = 0.0
        for _ in range(MAX_NEWTON_STEPS):
            residuals, weight = self.weighted_residuals(row)
            beside = QUOTIENTS.points(row, np.eye(3)[[number]])
            slope = QUOTIENTS.jacobian(self.residuals(beside))[:, 0]
            power = float(slope @ weight @ slope)
            if not power > 0:
                return Change(number, np.inf, row, np.inf)
            step = float(slope @ weight @ residuals) / power
            row = row.copy()
            row[number] -= step
            if not abs(step) > 1e-3 / math.sqrt(power):
                break
        return Change(number, self.squared_distance(row), row, 1 / math.sqrt(power))


class Change(NamedTuple):
    """A pose (3,) with one number replaced.

    number: its index; squared_distance: of the pose as changed, see `Prediction`.
    error: the standard error of the new number, in extents or radians.
    """

    number: int
    squared_distance: float
    row: FloatArray
    error: float


def repairs_of(
    normalized: NormalizedPoses, prediction: Prediction, pose: int, task: Task
) -> tuple[Repair, ...]:
    """The changes that make a pose agree: slips and single numbers, the likeliest first."""
    length, origin = float(normalized.frames.length), normalized.frames.fixed_origin
    given = _pose_as_given(normalized, pose)
    limit = MAX_DISTANCE_SHARE * prediction.squared_distance(normalized.rows[pose])
    found: list[Repair] = []
    for kind, factor, values, words in _slips(given):
        row = np.append((values[:2] - origin) / length, values[2])
        squared = prediction.squared_distance(row)
        if squared <= min(MAX_DISTANCE_OF_SLIP, limit):
            prior = UNIT_CHANCE if kind == "unit" else SLIP_CHANCE
            found.append(Repair(kind, words, values, math.sqrt(squared), factor, prior))
    for number, name in enumerate(NUMBERS):
        starts = _start_rows(prediction.linkages, normalized.rows[pose], number)
        changes = [prediction.best_change(start, number) for start in starts]
        least = min(each.squared_distance for each in changes)
        if least > min(MAX_DISTANCE_OF_NUMBER, limit):
            continue
        best = min(
            (each for each in changes if each.squared_distance <= least + AS_NEAR),
            key=lambda each: _away(normalized, pose, each.row, task)[number // 2],
        )
        values, words = _certain_digits(best, given, normalized, task)
        prior = min(best.error / NUMBER_RANGE[number], SLIP_CHANCE)
        miss = math.sqrt(best.squared_distance)
        found.append(Repair(name, words, values, miss, prior=max(prior, ROUNDING)))
    marked = [_marked(each, normalized, pose, task) for each in found]
    return by_evidence(marked, len(normalized.rows))


def unit_repair(
    normalized: NormalizedPoses, pose: int, factor: float, miss: float, task: Task
) -> Repair:
    """A pose with x and y times a factor."""
    values = _pose_as_given(normalized, pose) * [factor, factor, 1.0]
    agrees = miss**2 <= MAX_DISTANCE_OF_SLIP
    words = _unit_in_words(factor, "would agree" if agrees else "would come nearer")
    repair = Repair("unit", words, values, miss, factor, UNIT_CHANCE)
    return _marked(repair, normalized, pose, task)


def _away(
    normalized: NormalizedPoses, pose: int, row: FloatArray, task: Task
) -> tuple[float, float]:
    """How far position and angle of a row (3,) are from the neighbours' or given ones, in sum."""
    beside = [k for k in (pose - 1, pose + 1) if 0 <= k < len(normalized.rows)]
    gap = row - normalized.rows[[pose] if task.requirements.any_order else beside]
    turn = np.abs(wrapped_angle(gap[:, 2]))
    return float(np.linalg.norm(gap[:, :2], axis=-1).sum()), float(turn.sum())


def _marked(repair: Repair, normalized: NormalizedPoses, pose: int, task: Task) -> Repair:
    """A repair that says so where its numbers are farther from the neighbours than the given."""
    length, origin = float(normalized.frames.length), normalized.frames.fixed_origin
    given = normalized.rows[pose]
    changed = np.append((repair.values[:2] - origin) / length, repair.values[2])
    before, after = (_away(normalized, pose, row, task) for row in (given, changed))
    farther = any(b > a + ROUNDING for a, b in zip(before, after, strict=True))
    if not farther or task.requirements.any_order:
        return repair
    which = "neighbours" if 0 < pose < len(normalized.rows) - 1 else "neighbour"
    words = f"{repair.message}, but farther from its {which}"
    return replace(repair, message=words, strays=True)


def _pose_as_given(normalized: NormalizedPoses, pose: int) -> FloatArray:
    """A pose (3,) in the task's frames."""
    place = normalized.frames.from_canonical(normalized.poses[pose])
    return np.append(place.translation, place.angle)


def _start_rows(linkages: LinkageBatch, row: FloatArray, number: int) -> list[FloatArray]:
    """Poses (3,) that differ from a row (3,) by one number, near the motion of a linkage (1,)."""
    out = [row]
    linkage = linkages.linkage(0)
    with np.errstate(all="ignore"):
        if number < 2:
            places = linkage.couplers(row[2:])
            for value in places.translation[0, :, number]:
                if np.isfinite(value):
                    out.append(np.where(np.arange(3) == number, value, row))
            return out
        turn = row[2] + np.linspace(-np.pi, np.pi, SWEEP_ANGLES, endpoint=False)
        away = np.linalg.norm(linkage.couplers(turn).translation - row[:2], axis=-1)
    away = np.nan_to_num(away, nan=np.inf).min(axis=-1)
    low = (away <= np.roll(away, 1)) & (away <= np.roll(away, -1)) & np.isfinite(away)
    for k in np.flatnonzero(low)[np.argsort(away[low])][:MAX_PLACES]:
        out.append(np.array([row[0], row[1], turn[k]]))
    return out


def _certain_digits(
    change: Change, given: FloatArray, normalized: NormalizedPoses, task: Task
) -> tuple[FloatArray, str]:
    """A changed pose (3,) with the certain digits of its new number, and the change in words."""
    values, number, error = given.copy(), change.number, change.error
    position, angle = task.resolution
    if number == 2:
        values[2] = given[2] + wrapped_angle(change.row[2] - given[2])
        unit, resolution, scale = "°", math.degrees(angle), math.degrees(1.0)
    else:
        length, origin = float(normalized.frames.length), normalized.frames.fixed_origin[number]
        values[number] = change.row[number] * length + origin
        error *= length
        unit, resolution, scale = f" {task.length_unit}" if task.length_unit else "", position, 1.0
    digits = math.floor(-math.log10(max(error * scale, 1.9 * resolution, 1e-15)))
    rounded = round(scale * values[number], digits)
    values[number] = rounded / scale
    old = f"{NUMBERS[number]} {scale * given[number]:.10g}{unit}"
    return values, f"its {old}: {rounded:.{max(digits, 0)}f}{unit} would agree"


def _unit_in_words(factor: float, how: str = "would agree") -> str:
    way = f"times {factor:g}" if factor > 1 else f"divided by {1 / factor:g}"
    return f"its unit: x and y {way} {how}"


def _slips(given: FloatArray) -> Iterator[tuple[str, float, FloatArray, str]]:
    """A pose (3,) with each of the usual slips undone: kind, factor, numbers (3,), words."""
    for factor in (each for unit in UNIT_FACTORS for each in (unit, 1 / unit)):
        yield "unit", factor, given * [factor, factor, 1.0], _unit_in_words(factor)
    tens = [each for power in (10.0, 100.0, 1000.0) for each in (power, 1 / power)]
    turns = [math.degrees(1.0), math.radians(1.0)]
    for kind, what, factors, numbers in (
        ("slip", "its", tens, (0, 1, 2)),
        ("radians", "the unit of its", turns, (2,)),
        ("sign", "the sign of its", [-1.0], (0, 1, 2)),
    ):
        for factor in factors:
            for number in numbers:
                values = given.copy()
                values[number] *= factor
                scale, unit = (math.degrees(1.0), "°") if number == 2 else (1.0, "")
                old, new = (f"{scale * each[number]:.10g}{unit}" for each in (given, values))
                words = f"{what} {NUMBERS[number]} {old}: {new} would agree"
                yield kind, 1.0 if kind == "sign" else factor, values, words
    both = "the signs of its x and y: both the other way would agree"
    yield "sign", 1.0, given * [-1.0, -1.0, 1.0], both
    yield "swap", 1.0, given[[1, 0, 2]], "its x and y: exchanged they would agree"
