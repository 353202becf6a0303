"""The faces of limits on which the dyads of linkages lie, for many linkages at once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.limited_block import (
    Block,
    FaceConditions,
    circle_blocks,
    face_conditions,
    face_numbers,
)
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.numerics.arrays import FloatArray
from burmester.tasks.limits import Limits, limits_in

OUTSIDE = 1e-9  # lengths; a pivot that is farther outside its region has left it
KEPT_BLOCKS = 16  # limits that are remembered with their faces


def linkages_held(
    numbers: NDArray[np.intp], limits: Sequence[Limits], frames: CanonicalFrames
) -> FaceConditions | None:
    """The faces of these numbers (k, 2, 3) as conditions on dimensions (k, 10), in frames.

    limits: of a task, in its own frames.  None without limits.
    """
    if not limits:
        return None
    scale = _scale(frames)
    shift = np.array([*frames.fixed_origin, *frames.moving_origin, 0.0])
    sides = []
    for side in (0, 1):
        own = face_conditions(
            _blocks_of(_of_side(limits, side), scale), numbers[:, side], DIMENSIONS
        )
        sides.append(own._replace(at=(own.at * 2.0**scale - own.rows @ shift) / frames.length))
    one, two = sides
    return FaceConditions(
        _blocks(one.rows, two.rows),
        np.concatenate([one.at, two.at], axis=1),
        np.concatenate([one.active, two.active], axis=1),
        _blocks(one.inward, two.inward),
    )


def _blocks(one: FloatArray, two: FloatArray) -> FloatArray:
    """Rows (k, m, 5) on the first and (k, n, 5) on the second dyad, as (k, m + n, 10)."""
    out = np.zeros((len(one), one.shape[1] + two.shape[1], 2 * DIMENSIONS))
    out[:, : one.shape[1], :DIMENSIONS], out[:, one.shape[1] :, DIMENSIONS:] = one, two
    return out


def _of_side(limits: Sequence[Limits], side: int) -> Limits:
    return limits[min(side, len(limits) - 1)]


def _scale(frames: CanonicalFrames) -> int:
    """The power of two that is nearest to the unit of frames: it seldom changes."""
    return round(math.log2(float(frames.length)))


def _scaled(scale: int) -> CanonicalFrames:
    """The task's own frames with another unit."""
    return CanonicalFrames(np.zeros(2), np.zeros(2), np.asarray(2.0**scale))


@lru_cache(KEPT_BLOCKS)
def _blocks_of(limits: Limits, scale: int) -> tuple[Block, Block, Block]:
    """What limits say of the dimensions of a dyad, in units of a power of two."""
    return circle_blocks(limits_in(_scaled(scale), limits))


def _has(kind: int) -> NDArray[np.bool_]:
    """Which of fixed pivot, moving pivot and length a kind of dyad has."""
    return np.array([kind != 1, kind != 2, kind == 0])


def linkage_face_numbers(
    batch: LinkageBatch, limits: Sequence[Limits], frames: CanonicalFrames
) -> NDArray[np.intp]:
    """The faces (k, 2, 3) on which linkages (k,) lie; -1 of what a slider does not have."""
    numbers, scale = np.full((len(batch), 2, 3), -1, dtype=np.intp), _scale(frames)
    inside = brought_inside(batch, limits, frames)
    own = inside.from_canonical(frames).to_canonical(_scaled(scale))
    for side in (0, 1) if limits else ():
        blocks = _blocks_of(_of_side(limits, side), scale)
        for k in range(len(batch)):
            on = face_numbers(own.dimensions[k, side][None], blocks)[0]
            numbers[k, side] = np.where(_has(int(batch.kinds[k, side])), on, -1)
    return numbers


def faces_met(
    batch: LinkageBatch,
    numbers: NDArray[np.intp],
    limits: Sequence[Limits],
    frames: CanonicalFrames,
) -> tuple[LinkageBatch, NDArray[np.intp]]:
    """Linkages (k,) with what lies outside its limits moved to the nearest face.

    With the faces (k, 2, 3) on which they were before, or came to.
    """
    numbers, scale = numbers.copy(), _scale(frames)
    own = batch.from_canonical(frames).to_canonical(_scaled(scale))
    for side in (0, 1) if limits else ():
        blocks = _blocks_of(_of_side(limits, side), scale)
        for k in range(len(batch)):
            for at in np.flatnonzero(_has(int(batch.kinds[k, side]))):
                z = own.dimensions[k, side]
                if blocks[at].outside(z):
                    numbers[k, side, at], own.dimensions[k, side] = blocks[at].nearest_face(z)
    return own.from_canonical(_scaled(scale)).to_canonical(frames), numbers


def brought_inside(
    batch: LinkageBatch, limits: Sequence[Limits], frames: CanonicalFrames
) -> LinkageBatch:
    """Linkages (k,) with what lies outside its limits moved to the nearest face."""
    none = np.full((len(batch), 2, 3), -1, dtype=np.intp)
    return faces_met(batch, none, limits, frames)[0]


def outside_limits(
    batch: LinkageBatch, limits: Sequence[Limits], frames: CanonicalFrames
) -> NDArray[np.bool_]:
    """Which linkages (k,) have left their limits."""
    own, out = batch.from_canonical(frames), np.zeros(len(batch), dtype=bool)
    least = OUTSIDE * float(frames.length)
    for side in (0, 1) if limits else ():
        each, z, kind = _of_side(limits, side), own.dimensions[:, side], own.kinds[:, side]
        for region, at, other in ((each.fixed_pivot, 0, 1), (each.moving_pivot, 2, 2)):
            if region is not None:
                out |= (kind != other) & (region.distance(z[:, at : at + 2]) > least)
        beyond = (z[:, 4] < each.length[0] - least) | (z[:, 4] > each.length[1] + least)
        out |= (kind == 0) & beyond
    return out
