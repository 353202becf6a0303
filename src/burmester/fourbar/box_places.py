"""The places of an assembled linkage deepest inside boxes around the poses, on each circuit.

A box bounds the deviations from a pose along two axes and in angle.  The place that is sought uses
the least share of its box: the greatest of the three deviations, each over its bound, is least.
Samples of the circuit give starts, and brackets around them are narrowed to rounding.  That no
other place is deeper is not proved.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Final, final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.foot_points import places_of, wrapped
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.nearest_places import Bracket, bracketed_least, places_at, sampled
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, take

SAMPLES: Final = 128  # of each circuit, at least
POSES_PER_BLOCK: Final = 64  # number of poses searched for at once; bounds the memory
STARTS: Final = 6  # number of samples whose neighbourhoods are searched first
# Rounds of bracketing and samples in each: of all starts, and of the best one.
FIRST_ROUNDS, FIRST_SAMPLES = 4, 17
LAST_ROUNDS, LAST_SAMPLES = 13, 9


@final
@dataclass(frozen=True, slots=True, eq=False)
class Boxes:
    """Boxes around N poses, as rows (x, y, length x angle) are measured.

    centre: (N, 3), the poses.  directions: (N, 2, 2), the unit vectors of both axes.
    bounds: (N, 3), above zero, along both axes and in length x angle; infinite for what is free.
    """

    centre: FloatArray
    directions: FloatArray
    bounds: FloatArray
    length: float

    def deviations(self, rows: FloatArray) -> FloatArray:
        """The deviations (*, N, 3) of rows (*, N, 3), along both axes and in length x angle."""
        gap = wrapped(rows - self.centre, self.length)
        first = (self.directions[:, 0] * gap[..., :2]).sum(axis=-1)
        second = (self.directions[:, 1] * gap[..., :2]).sum(axis=-1)
        return np.stack([first, second, gap[..., 2]], axis=-1)

    def share(self, rows: FloatArray, slack: FloatArray | float = 0.0) -> FloatArray:
        """The greatest share (*, N) of their bounds that rows (*, N, 3) use.

        slack: (*, N), added to the bounds.  Infinite where a row is nan.
        """
        bounds = self.bounds + np.asarray(slack)[..., None]
        with np.errstate(invalid="ignore"):
            used = np.abs(self.deviations(rows)) / bounds
        return np.asarray(np.nan_to_num(used.max(axis=-1), nan=np.inf))


def places_in_boxes(batch: LinkageBatch, boxes: Boxes) -> Displacement:
    """The places (k, 2, N) on both circuits of linkages (k,) deepest inside boxes (N,).

    In frames where lengths are about 1.  nan where the circuit does not exist.  Angles are within
    half a turn of the poses'.
    """
    number = len(boxes.centre)
    out = np.full((len(batch), 2, number, 3), np.nan)
    for index, linkage in batch.alike():
        circuits = Circuits.of(linkage, as_given=True)
        row, side = np.nonzero(circuits.exists)
        if not len(row):
            continue
        own = circuits[row, side]
        share, samples = sampled(own, boxes.length, SAMPLES)
        for at in range(0, number, POSES_PER_BLOCK):
            some = slice(at, at + POSES_PER_BLOCK)
            found = _deepest(own, share, samples, take(boxes, some))
            out[index[row], side, some] = found
    return places_of(out, boxes.length)


def _deepest(
    circuits: Circuits, share: FloatArray, samples: FloatArray, boxes: Boxes
) -> FloatArray:
    """The rows (n, N, 3) deepest inside boxes (N,); share: (n, s), of samples (n, s, 3)."""
    number = len(boxes.centre)
    gap = np.abs(wrapped(np.roll(samples, -1, axis=1) - samples, boxes.length)).max(axis=-1)
    gap = np.nan_to_num(np.maximum(gap, np.roll(gap, 1, axis=1)), nan=np.inf)
    # Bounds widened by the distance to the next sample: what lies between the samples is not lost.
    slack = np.repeat(gap[..., None], number, axis=-1)
    every_row = np.repeat(samples[:, :, None], number, axis=2)
    used, plain = boxes.share(every_row, slack), boxes.share(every_row)
    lowest = _is_lowest(used) | _is_lowest(plain)
    depth = np.where(lowest, used, np.inf)
    starts = np.argpartition(depth, STARTS - 1, axis=1)[:, :STARTS]  # (n, STARTS, N)
    width = np.roll(share, -1, axis=-1) - share
    width[:, -1:] += 1
    width = np.maximum(width, np.roll(width, 1, axis=-1))
    every = np.arange(len(share))[:, None, None]
    bracket = Bracket(share[every, starts], width[every, starts])
    down = partial(bracketed_least, circuits, measure=boxes.share, length=boxes.length)
    (middle, reach, *_), rows = down(bracket, rounds=FIRST_ROUNDS, count=FIRST_SAMPLES)
    ends = (middle + reach).reshape(len(middle), -1)
    beside = places_at(circuits, ends, boxes.length).reshape(rows.shape)
    spacing = np.abs(wrapped(beside - rows, boxes.length)).max(axis=-1)
    best = boxes.share(rows, np.nan_to_num(spacing, nan=np.inf)).argmin(axis=1)[:, None]
    bracket = Bracket(*(np.take_along_axis(each, best, axis=1) for each in (middle, reach)))
    rows = down(bracket, rounds=LAST_ROUNDS, count=LAST_SAMPLES)[1][:, 0]
    return np.asarray(boxes.centre + wrapped(rows - boxes.centre, boxes.length))


def _is_lowest(used: FloatArray) -> NDArray[np.bool_]:
    """The local minima of values (n, s, N) along a circuit, and its ends."""
    lowest = (used <= np.roll(used, 1, axis=1)) & (used <= np.roll(used, -1, axis=1))
    lowest[:, [0, -1]] = True  # an open circuit ends there
    return np.asarray(lowest)
