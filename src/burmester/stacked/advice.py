"""Which tasks of a stack have dyads to warn of: `dyad_advice` for stacks, codes only."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.long_links import OUT_OF_SIGHT, SENSIBLE_SWING, swings
from burmester.dyads.selection import DISTANCE_ROUNDING, MAX_POSE_ERRORS
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage_batch import DYAD_KINDS
from burmester.numerics.arrays import FloatArray
from burmester.stacked.found_dyads import Fits, Found, same_dyads

__all__ = ["DyadAdvice"]

Mask = NDArray[np.bool_]
CIRCLE, FIXED_LINE, MOVING_LINE = (DYAD_KINDS.index(kind) for kind in (RR, PR, RP))


class DyadAdvice(NamedTuple):
    """What is to be said of the dyads of tasks, (T,) each.

    pairs: how many pairs of different dyads there are; nearly_sliders: W204; twice: W205;
    left_out: W206; missing: W207.
    """

    pairs: NDArray[np.intp]
    nearly_sliders: Mask
    twice: Mask
    left_out: Mask
    missing: Mask

    @classmethod
    def of(cls, fits: Fits, found: Found) -> DyadAdvice:
        """What is to be said of the dyads that were found; `missing` of exact ones only."""
        tasks = len(fits.length)
        count = np.bincount(found.task, minlength=tasks)
        twice = np.bincount(same_dyads(found, fits.length), minlength=tasks)
        off = np.zeros(tasks, dtype=bool)
        if fits.exact:
            off = _any(found.task[~within_digits(fits, found)], tasks)
        return cls(
            count * (count - 1) // 2 - twice,
            _any(found.task[_nearly_sliders(fits, found)], tasks),
            twice > 0,
            found.left_out > 0,
            off,
        )

    @property
    def warnings(self) -> list[tuple[int, str]]:
        """Each task with a code, by rising task, the codes of one task in their order."""
        codes = {
            "W204": self.nearly_sliders,
            "W207": self.missing,
            "W206": self.left_out,
            "W205": self.twice,
        }
        said = np.stack(list(codes.values()), axis=1)
        names = list(codes)
        return [(int(task), names[which]) for task, which in zip(*np.nonzero(said), strict=True)]


def within_digits(fits: Fits, found: Found, times: float = 1.0) -> Mask:
    """Which dyads (D,) meet the poses within what their digits leave, as `within_digits` has it."""
    z, kind, task = found.dimensions, found.kind, found.task
    d, (position, angle) = fits.poses.translation, fits.stack.resolution
    size = np.abs(d).max(axis=(1, 2))[task]
    first, second = np.abs(z[:, :2]), np.abs(z[:, 2:4])
    parts = np.where(kind == FIXED_LINE, first.sum(axis=1), first.max(axis=1))
    parts = parts + np.where(kind == MOVING_LINE, second.sum(axis=1), second.max(axis=1)) + z[:, 4]
    lever = np.linalg.norm(z[:, 2:4], axis=1)
    slots = np.flatnonzero(kind == MOVING_LINE)
    if len(slots):
        away = z[slots, None, :2] - d[task[slots]]
        lever[slots] = np.linalg.norm(away, axis=-1).max(axis=1)
    turns = np.maximum(1.0, np.abs(fits.poses.angle).max(axis=1))[task]
    rounding = DISTANCE_ROUNDING * np.finfo(float).eps * (size + parts + lever * turns)
    allowed = MAX_POSE_ERRORS * (position + lever * angle) + rounding
    return np.asarray(found.worst <= times * allowed)


def _nearly_sliders(fits: Fits, found: Found) -> Mask:
    """Which dyads (D,) are links out of sight that hardly swing."""
    size = np.maximum(spans(fits), fits.length)
    long = (found.kind == CIRCLE) & (found.dimensions[:, 4] > OUT_OF_SIGHT * size[found.task])
    index = np.flatnonzero(long)
    z = found.dimensions[index]
    swung = swings(RR(z[:, :2], z[:, 2:4], z[:, 4]), fits.poses[found.task[index]])
    long[index] = swung < SENSIBLE_SWING
    return np.asarray(long)


def spans(fits: Fits) -> FloatArray:
    """The diagonals (T,) of the boxes around the poses' origins."""
    return np.asarray(np.linalg.norm(np.ptp(fits.poses.translation, axis=1), axis=1))


def _any(tasks: NDArray[np.intp], count: int) -> Mask:
    return np.asarray(np.bincount(tasks, minlength=count) > 0)
