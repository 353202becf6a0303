"""Dyads that pass through the poses, drawn from the family of all that do.

Random dyads within the limits are brought to the poses by the shortest way (`projection`).  Where
few of them arrive, further ones are drawn near those that did.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final, final

import numpy as np
from numpy.typing import NDArray

from burmester.families.open_task import DyadFreedom, OpenTask, Trials
from burmester.families.projection import projected
from burmester.fourbar.linkage_batch import DIMENSIONS, LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, concatenate, take

FEW: Final = 0.3  # share of the draws; where fewer arrive, their neighbours are drawn too
NEAR: Final = 0.1  # lengths; how far such a neighbour starts from a dyad that arrived
SAME: Final = 1e-7  # lengths; dyads whose dimensions differ by less are one
MOST_MORE: Final = 2.5  # times as many draws at most where regions are wide
LONGEST: Final = 1e3  # lengths; a longer link is no link


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadSamples:
    """Dyads (k,): their kinds (k,) as indices in DYAD_KINDS, and dimensions (k, 5)."""

    kinds: NDArray[np.int8]
    dimensions: FloatArray

    def __len__(self) -> int:
        return len(self.kinds)


def drawn_dyads(
    task: OpenTask,
    side: DyadFreedom,
    offsets: FloatArray,
    counts: Mapping[int, int],
    rng: np.random.Generator,
) -> DyadSamples:
    """Dyads of one side that pass through the poses at offsets (N, 3) from those given.

    counts: how many are drawn of each kind (an index in DYAD_KINDS).
    """
    still = replace(task, sides=(side, side), half_widths=np.zeros_like(task.half_widths))
    poses = task.places(offsets[None])[0]
    out = []
    for kind in side.kinds:
        count = round(counts.get(kind, 0) * _more(side, kind))
        start = _random(side, kind, 2 * (count // 2), poses, rng)
        if kind == 0 and side.given is not None:  # those of the timing are all there are
            start = np.repeat(side.given, 2, axis=0)
        found = _brought(start, kind, offsets, still)
        if 0 < len(found) < FEW * count:
            near = found[rng.integers(len(found), size=len(start))]
            near = near + NEAR * rng.normal(size=near.shape)
            found = np.concatenate([found, _brought(near, kind, offsets, still)])
        if side.rail is not None:  # those whose pins keep the travel, if any do
            kept = side.rail.beyond(found, poses) <= SAME
            found = found[kept] if kept.any() else found
        out.append(DyadSamples(np.full(len(found), kind, dtype=np.int8), found))
    samples = concatenate(out)
    return take(samples, _different(samples))


def _more(side: DyadFreedom, kind: int) -> float:
    """How many times as many dyads are drawn where pivots may lie far from the motion."""
    zones = [place.zones for place, other in ((side.fixed, 1), (side.moving, 2)) if kind != other]
    return min(MOST_MORE, math.sqrt(math.prod(map(len, zones))))


def _different(samples: DyadSamples) -> NDArray[np.intp]:
    """The indices of dyads that are no point at infinity, each once."""
    z = samples.dimensions
    near = np.flatnonzero(np.abs(z).max(axis=1, initial=0.0) < LONGEST)
    rows = np.column_stack([samples.kinds[near], np.round(z[near] / SAME)])
    return np.asarray(near[np.sort(np.unique(rows, axis=0, return_index=True)[1])])


def _random(
    side: DyadFreedom, kind: int, count: int, poses: Displacement, rng: np.random.Generator
) -> FloatArray:
    """Dyads (count, 5) of one kind, their pivots anywhere within the limits."""
    z = np.zeros((count, DIMENSIONS))
    if kind != 1:
        z[:, :2] = side.fixed.draw(count, rng)
    if kind != 2:
        z[:, 2:4] = side.moving.draw(count, rng)
    if kind == 0:
        # Of each three one keeps both pivots as drawn, of one the moving, of one the fixed follows.
        z[1::3, :2] = _centres(poses.act(z[1::3, None, 2:4]), z[1::3, :2])
        z[2::3, 2:4] = _centres(poses.inverse().act(z[2::3, None, :2]), z[2::3, 2:4])
        pins = poses.act(z[:, None, 2:4])
        z[:, 4] = np.linalg.norm(pins - z[:, None, :2], axis=-1).mean(axis=1)
        return z
    if side.rail is not None:
        z[:, side.rail.pin], z[:, side.rail.at] = side.rail.draw(z, poses, rng)
        return z
    at = 0 if kind == 1 else 2
    pins = poses.act(z[:, None, 2:4]) if kind == 1 else poses.inverse().act(z[:, None, :2])
    # The normal of the line along which the pins lie, on average.
    spread = pins - pins.mean(axis=1, keepdims=True)
    _, _, v = np.linalg.svd(spread, full_matrices=False)
    z[:, at] = np.arctan2(v[:, -1, 1], v[:, -1, 0])
    normal = np.stack([np.cos(z[:, at]), np.sin(z[:, at])], axis=-1)
    z[:, at + 1] = (pins.mean(axis=1) * normal).sum(axis=-1)
    return z


def _centres(points: FloatArray, near: FloatArray) -> FloatArray:
    """The centres (k, 2) of circles nearest to points (k, N, 2); of two, nearest to `near`."""
    chords = points[:, 1:] - points[:, :1]
    middles = (points[:, 1:] + points[:, :1]) / 2
    short = (chords * (middles - near[:, None])).sum(axis=-1)
    return np.asarray(near + np.einsum("kij,kj->ki", np.linalg.pinv(chords), short))


def _brought(start: FloatArray, kind: int, offsets: FloatArray, task: OpenTask) -> FloatArray:
    """The dyads (m, 5) to which starts (2 k, 5) of one kind come that meet the poses."""
    pairs = start.reshape(-1, 2, DIMENSIONS)
    kinds = np.full(pairs.shape[:2], kind, dtype=np.int8)
    every = np.broadcast_to(offsets, (len(pairs), *offsets.shape))
    trials = Trials(LinkageBatch(kinds, pairs), every, np.zeros(len(pairs), dtype=np.intp))
    found, met = projected(trials, task)
    return np.asarray(found.batch.dimensions.reshape(-1, DIMENSIONS)[met.reshape(-1)])
