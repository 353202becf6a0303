"""Active-set descent over faces: from dyads within limits down to local minima within them.

A dyad z moves along the faces on which it lies (`minimise`).  Where that would leave a region it
stops at the edge and goes on along it; where a direction into a region leads down it leaves the
edge.  All dyads move at once, each on faces of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.geometric_fit import DistanceFunction, GeometricFit, Point
from burmester.dyads.limited_block import Block, face_numbers
from burmester.numerics.arrays import FloatArray, put, take
from burmester.numerics.iteration import iterate
from burmester.numerics.linear_algebra import matvec

STEEPNESS_ROUNDING = 1e-7  # share of the terms of a directional derivative that is rounding
MAX_MOVES = 200  # along a face, or from one face to another
MAX_SIZE = 1e9  # characteristic lengths; a dyad that went farther away does not come back

Minimise: TypeAlias = Callable[[Point, FloatArray], GeometricFit]
"""From dyads (k, n) a step, or the whole way, to minima along the range of projectors."""


class _State(NamedTuple):
    """Dyads (k, n) with their distances, and the faces on which they lie (k, blocks).

    eager: (k,), which leave a face before they are at its minimum; settled: (k,), which are at
    minima within limits.
    """

    at: Point
    on: NDArray[np.intp]
    eager: NDArray[np.bool_]
    settled: NDArray[np.bool_]


def inside(z: FloatArray, blocks: Sequence[Block]) -> NDArray[np.bool_]:
    """Whether dyads z (k, n) lie within all limits."""
    return np.asarray(~np.any([block.outside(z) for block in blocks], axis=0))


def descend(
    z: FloatArray,
    distances: DistanceFunction,
    minimise: Minimise,
    blocks: Sequence[Block],
    *,
    may_leave: bool = True,
) -> tuple[FloatArray, NDArray[np.bool_]]:
    """The local minima (k, n) within limits to which dyads z (k, n) inside them lead.

    may_leave: whether they may leave edges into the regions.
    Returns them, and which are settled (k,); where there is no minimum a dyad is not.
    """
    free = np.ones(z.shape[1])
    for block in blocks:
        free[block.at] = 0.0

    def along(on: NDArray[np.intp]) -> FloatArray:
        projectors = np.tile(np.diag(free), (len(on), 1, 1))
        for block, faces in zip(blocks, on.T, strict=True):
            projectors[:, block.at, block.at] = block.along(faces)
        return projectors

    def advance(_: NDArray[np.intp], old: _State) -> tuple[_State, NDArray[np.bool_]]:
        free_ways = along(old.on)
        fit = minimise(old.at, free_ways)
        on, at = old.on.copy(), fit.at
        lost = ~(np.abs(fit.z).max(axis=-1) < MAX_SIZE)
        to = np.where(lost[:, None], old.at.z, fit.z)
        shares = np.stack([block.share_inside(old.at.z, to) for block in blocks], axis=-1)
        first, share = shares.argmin(axis=-1), shares.min(axis=-1)
        stopped = share < 1
        rows = np.flatnonzero(stopped)
        if len(rows):
            z = (old.at.z + share[:, None] * (to - old.at.z))[rows]
            for k, block in enumerate(blocks):
                here = np.flatnonzero(first[rows] == k)
                on[rows[here], k] = block.lying_on(z[here])
                z[here] = block.projected(z[here], on[rows[here], k])
            put(at, rows, distances.at(z))
        settled = fit.settled & ~stopped & ~lost
        eager = old.eager & ~(share <= 0)
        rows = np.flatnonzero(settled | (eager & ~stopped & ~lost))
        faces = on[rows]
        left = rows[_leave(take(fit, rows), free_ways[rows], faces, blocks)]
        on[rows] = faces
        eager[left] = may_leave
        settled[left] = False
        ended = settled | lost
        if not may_leave:
            ended[left] = True
        return _State(at, on, eager, settled), ended

    on = face_numbers(z, blocks)
    start = _State(distances.at(z), on, np.full(len(z), may_leave), np.zeros(len(z), dtype=bool))
    ends, _ = iterate(advance, start, np.arange(len(z)), MAX_MOVES)
    return ends.at.z, ends.settled


def _leave(
    fit: GeometricFit,
    along: FloatArray,
    on: NDArray[np.intp],
    blocks: Sequence[Block],
) -> NDArray[np.bool_]:
    """Take dyads from which a way inwards leads down to wider faces, written to `on`.

    Where a dyad is not at the minimum of its face, the way has to be steeper than all along it.
    Also those that have gone past the end of an edge.  Returns which leave (k,).
    """
    past = np.zeros(len(on), dtype=bool)
    for k, block in enumerate(blocks):
        now = block.past_edges(fit.z, on[:, k])
        past |= now != on[:, k]
        on[:, k] = now
    slopes = (fit.by_distance[:, None] @ fit.at.here.jacobian)[:, 0]
    steepest = np.linalg.norm(matvec(along, slopes), axis=-1)
    ways = [
        block.steepest_inward(fit.at.here.jacobian, fit.by_distance, faces)
        for block, faces in zip(blocks, on.T, strict=True)
    ]
    steepness = np.stack([steepness for steepness, _ in ways], axis=-1)
    alone = np.arange(len(blocks)) == steepness.argmin(axis=-1)[:, None]
    leaves = np.zeros(steepness.shape, dtype=bool)
    for k, (block, (_, way)) in enumerate(zip(blocks, ways, strict=True)):
        slope = (slopes[:, block.at] * way).sum(axis=-1)
        leaves[:, k] = np.where(fit.settled, alone[:, k], slope < -steepest)
        leaves[:, k] &= ~past & (steepness[:, k] < -STEEPNESS_ROUNDING)
        rows = np.flatnonzero(leaves[:, k])
        if len(rows):
            on[rows, k] = block.wider(fit.z[rows], on[rows, k], way[rows])
    return np.asarray(past | leaves.any(axis=-1))
