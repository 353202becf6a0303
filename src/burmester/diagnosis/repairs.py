"""What would make a pose agree with the others: a slip, or one wrong number."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple, final

import numpy as np

from burmester.diagnosis.sampson_fits import Seen, misses
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.numerics.arrays import ROUNDING, FloatArray, wrapped_angle
from burmester.numerics.differences import DifferenceQuotients
from burmester.tasks.motion_task import Task

__all__ = ["FACTORS", "NUMBERS", "Nearness", "Repair", "repairs_of", "unit_repair"]

NUMBERS = ("x", "y", "angle")
# Squared misses in standard deviations, of one number and of two, and as a share of those of the
# pose as given.  Coarse, as x, y and the angle may not be known equally well.
AGREES, MENDED = (16.0, 40.0), 0.03
FACTORS = (10.0, 25.4, 1000.0, 12.0, 100.0, 2.54, 304.8)  # between units, or a decimal point away
SWEEP = 720  # coupler angles looked at for a place
QUOTIENTS = DifferenceQuotients(stride=1e-6)  # of misses, by one number of a pose
NEWTON = 20


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


class Nearness(NamedTuple):
    """The linkage (1,) of the other poses, how exactly they know it, and their error."""

    stack: LinkageBatch
    known: FloatArray
    sigma: float

    @classmethod
    def of(cls, seen: Seen, stack: LinkageBatch, pose: int, sigma: float) -> Nearness:
        """To the linkage of all poses but one, whose errors are sigma."""
        share = np.where(seen.without(pose), seen.weights, 0.0)[None]
        _, slope = misses(stack, seen.rows, share)
        size = np.linalg.norm(slope[0], axis=0)
        size = np.where(size > 0, size, 1.0)
        _, spread, axes = np.linalg.svd(slope[0] / size, full_matrices=False)
        open_ = spread > ROUNDING * spread[0]
        axes = axes[open_] / spread[open_, None] / size
        return cls(stack, axes.T @ axes, sigma)

    def residual(self, rows: FloatArray) -> FloatArray:
        """The misses (n, 2) of poses (n, 3)."""
        return misses(self.stack, rows, np.ones((1, len(rows))))[0].reshape(-1, 2)

    def spread(self, row: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The misses (2,) of a pose (3,), and their covariance (2, 2) in sigma squared."""
        miss, slope = misses(self.stack, row[None], np.ones((1, 1)))
        spread: FloatArray = np.eye(2) + slope[0] @ self.known @ slope[0].T
        return miss[0], spread

    def at(self, row: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The misses (2,) of a pose (3,), and the inverse of their covariance."""
        miss, spread = self.spread(row)
        values, axes = np.linalg.eigh(spread)
        return miss, (axes / (np.maximum(values, 1.0) * self.sigma**2)) @ axes.T

    def off(self, row: FloatArray) -> float:
        """The squared miss, in standard deviations."""
        miss, weight = self.at(row)
        return float(miss @ weight @ miss)

    def changed(self, row: FloatArray, number: int) -> tuple[float, FloatArray, float]:
        """A pose (3,) with one number changed for the best: squared miss, pose, standard error."""
        power = 0.0
        for _ in range(NEWTON):
            miss, weight = self.at(row)
            beside = QUOTIENTS.points(row, np.eye(3)[[number]])
            slope = QUOTIENTS.jacobian(self.residual(beside))[:, 0]
            power = float(slope @ weight @ slope)
            if not power > 0:
                return np.inf, row, np.inf
            step = float(slope @ weight @ miss) / power
            row = row.copy()
            row[number] -= step
            if not abs(step) > 1e-3 / math.sqrt(power):
                break
        return self.off(row), row, 1 / math.sqrt(power)


def repairs_of(seen: Seen, near: Nearness, pose: int, task: Task) -> tuple[Repair, ...]:
    """What would make a pose agree: slips first, units before all, then single numbers."""
    length, origin = float(seen.frames.length), seen.frames.fixed_origin
    given = _given(seen, pose)
    limit = MENDED * near.off(seen.rows[pose])
    found: list[Repair] = []
    for kind, by, values, words in _slips(given):
        off = near.off(np.append((values[:2] - origin) / length, values[2]))
        if off <= min(AGREES[1], limit):
            found.append(Repair(kind, words, values, math.sqrt(off), by))
    found.sort(key=lambda each: (each.kind != "unit", each.miss))
    single: list[Repair] = []
    for number in range(3):
        starts = _starts(near.stack, seen.rows[pose], number)
        off, best, error = min((near.changed(start, number) for start in starts), key=_first)
        if off <= min(AGREES[0], limit):
            values, words = _digits(number, given, best, error, seen, task)
            single.append(Repair(NUMBERS[number], words, values, math.sqrt(off)))
    return (*found, *sorted(single, key=lambda each: each.miss))


def unit_repair(seen: Seen, pose: int, by: float, miss: float) -> Repair:
    """A pose whose x and y are to be multiplied."""
    return Repair("unit", _unit_words(by), _given(seen, pose) * [by, by, 1.0], miss, by)


def _first(of: tuple[float, FloatArray, float]) -> float:
    return of[0]


def _given(seen: Seen, pose: int) -> FloatArray:
    """A pose (3,) in the task's frames."""
    place = seen.frames.unseen(seen.poses[pose])
    return np.append(place.translation, place.angle)


def _starts(stack: LinkageBatch, row: FloatArray, number: int) -> list[FloatArray]:
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


def _digits(  # noqa: PLR0917
    number: int, given: FloatArray, best: FloatArray, error: float, seen: Seen, task: Task
) -> tuple[FloatArray, str]:
    """A pose (3,) with one number changed, with the digits that are certain; and the words."""
    values, (position, angle) = given.copy(), task.resolution
    if number == 2:
        values[2] = given[2] + wrapped_angle(best[2] - given[2])
        unit, resolution, scale = "°", math.degrees(angle), math.degrees(1.0)
    else:
        values[number] = best[number] * float(seen.frames.length) + seen.frames.fixed_origin[number]
        error *= float(seen.frames.length)
        unit, resolution, scale = f" {task.length_unit}" if task.length_unit else "", position, 1.0
    digits = math.floor(-math.log10(max(error * scale, 1.9 * resolution, 1e-15)))
    rounded = round(scale * values[number], digits)
    values[number] = rounded / scale
    said = f"{NUMBERS[number]} {scale * given[number]:.10g}{unit}"
    return values, f"its {said}: {rounded:.{max(digits, 0)}f}{unit} would agree"


def _unit_words(by: float) -> str:
    return (
        f"its unit: x and y {f'times {by:g}' if by > 1 else f'divided by {1 / by:g}'} would agree"
    )


def _slips(given: FloatArray) -> Iterator[tuple[str, float, FloatArray, str]]:
    """What one slip makes of a pose (3,): kind, factor, numbers (3,), words."""
    both_ways = [by for factor in FACTORS for by in (factor, 1 / factor)]
    for by in both_ways:
        yield "unit", by, given * [by, by, 1.0], _unit_words(by)
    tens = [by for factor in (10.0, 100.0, 1000.0) for by in (factor, 1 / factor)]
    turns = [math.degrees(1.0), math.radians(1.0)]
    for kind, said, factors, numbers in (
        ("slip", "its", tens, (0, 1, 2)),
        ("radians", "the unit of its", turns, (2,)),
        ("sign", "the sign of its", [-1.0], (0, 1, 2)),
    ):
        for by in factors:
            for number in numbers:
                values = given.copy()
                values[number] *= by
                scale, unit = (math.degrees(1.0), "°") if number == 2 else (1.0, "")
                old, new = (f"{scale * each[number]:.10g}{unit}" for each in (given, values))
                words = f"{said} {NUMBERS[number]} {old}: {new} would agree"
                yield kind, 1.0 if kind == "sign" else by, values, words
    both = "the signs of its x and y: both the other way would agree"
    yield "sign", 1.0, given * [-1.0, -1.0, 1.0], both
    yield "swap", 1.0, given[[1, 0, 2]], "its x and y: exchanged they would agree"
