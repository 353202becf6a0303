"""Repeated poses, exactly or within their errors, and how much the others differ."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray

Indices = NDArray[np.int_]

COORDINATE_ROUNDING = 8 * float(np.finfo(np.float64).eps)  # share of the greatest coordinate


def exact_repeats(poses: Displacement) -> tuple[Indices, Indices]:
    """The first (k,) of each distinct pose of (N,), in order, and which of them each pose is (N,).

    Two poses repeat each other where x, y and orientation (whole turns apart) are the same within
    `COORDINATE_ROUNDING` of the greatest of all.  Poses that differ by more are distinct, however
    little.
    """
    reach = float(np.abs(poses.translation).max())
    turns = max(1.0, float(np.abs(poses.angle).max()))
    twins, label = np.arange(len(poses.angle)), np.zeros(poses.shape, dtype=np.int64)
    for values, size in (
        (poses.translation[:, 0], reach),
        (poses.translation[:, 1], reach),
        (np.cos(poses.angle), turns),
        (np.sin(poses.angle), turns),
    ):
        # Those that may still be twins fall into runs of nearly the same value.
        order = np.argsort(values[twins])
        run = np.zeros(len(twins), dtype=np.int64)
        run[order[1:]] = np.cumsum(np.diff(values[twins][order]) > COORDINATE_ROUNDING * size)
        _, label, count = np.unique(
            label * len(twins) + run, return_inverse=True, return_counts=True
        )
        shared = count[label] > 1
        twins, label = twins[shared], label[shared]
    same_as = np.arange(len(poses.angle))
    earliest = np.full(len(same_as), len(same_as))
    np.minimum.at(earliest, label, twins)
    same_as[twins] = earliest[label]
    first = np.flatnonzero(same_as == np.arange(len(same_as)))
    return first, np.searchsorted(first, same_as)


def repeats_in_sequence(
    poses: Displacement, is_point: NDArray[np.bool_]
) -> tuple[Indices, Indices]:
    """The first (k,) of each distinct row of poses and points, and which of them each row is (N,).

    is_point: (N,), where the angle is free.  Poses repeat each other anywhere, as in
    `exact_repeats`.  A point repeats a row beside it only: a coupler curve may pass through one
    point twice, with other rows between.  Of a pose and points beside it the pose stays.
    """
    number, points = np.arange(len(is_point)), poses.translation
    reach = COORDINATE_ROUNDING * float(np.abs(points).max())
    run = np.concatenate([[0], (np.abs(np.diff(points, axis=0)) > reach).any(axis=1).cumsum()])
    same_as, posed = number.copy(), np.flatnonzero(~is_point)
    if len(posed):
        first, group = exact_repeats(poses[posed])
        same_as[posed] = posed[first[group]]
    stays = np.full(run[-1] + 1, len(number))
    np.minimum.at(stays, run[posed], same_as[posed])
    alone = stays[run] == len(number)
    np.minimum.at(stays, run[alone], number[alone])
    same_as[is_point] = stays[run[is_point]]
    first, group = np.unique(same_as, return_inverse=True)
    return first, group


def distinguishable(poses: Displacement, position: float, angle: float, most: int) -> Indices:
    """At most `most` poses of (N,) that can be told apart, each the farthest from those before.

    position, angle: bounds on the errors of a pose; two poses within twice both may be one.
    """
    turn = np.exp(1j * poses.angle)
    position = max(position, float(np.finfo(np.float64).tiny))
    chosen, nearest = [0], np.full(poses.shape, np.inf)
    while len(chosen) < most:
        last = chosen[-1]
        apart = np.linalg.norm(poses.translation - poses.translation[last], axis=-1) / position
        apart = np.maximum(apart, np.abs(turn - turn[last]) / angle)
        nearest = np.minimum(nearest, apart)
        farthest = int(nearest.argmax())
        if nearest[farthest] <= 2:
            break
        chosen.append(farthest)
    return np.array(sorted(chosen))


def spanning(rows: FloatArray, count: int) -> Indices:
    """`count` of the rows (N, k) that span the most, each the farthest from the span before."""
    left, chosen = rows.copy(), []
    for _ in range(count):
        chosen.append(int((left**2).sum(axis=1).argmax()))
        unit = left[chosen[-1]] / np.linalg.norm(left[chosen[-1]])
        left = left - (left @ unit)[:, None] * unit
    return np.array(sorted(chosen))


def rotation_range(angle: FloatArray) -> float:
    """The length of the least arc that holds all orientations (N,), in radians."""
    return orientation_arc(angle)[1]


def orientation_arc(angle: FloatArray) -> tuple[float, float]:
    """The least arc that holds all orientations (N,): its middle and its length, in radians."""
    middle, length = orientation_arcs(angle)
    return float(middle), float(length)


def orientation_arcs(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The same of many: for orientations (*, N) middles and lengths (*,)."""
    around = np.sort(angle % (2 * np.pi), axis=-1)
    gaps = np.diff(around, append=around[..., :1] + 2 * np.pi, axis=-1)
    widest = gaps.argmax(axis=-1)[..., None]
    length = 2 * np.pi - np.take_along_axis(gaps, widest, axis=-1)[..., 0]
    start = np.take_along_axis(around, (widest + 1) % around.shape[-1], axis=-1)[..., 0]
    return start + length / 2, length
