"""Pivot maps: the least error of a link whose one pivot is given, for a whole plane of pivots.

With the fixed pivot given the circle residual is linear in the moving pivot and in the mean square
it leaves, and the other way round; so the best partner of a pivot is a linear least-squares
problem in two unknowns, solved here in closed form for any number of pivots.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike

from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, shares

BLOCK_RESIDUALS = 1 << 18  # computed at a time, to bound the memory
# Sine of the least angle between two columns; below it the partner is not determined.
PARALLEL_SINE = 1e-12


@final
@dataclass(frozen=True, slots=True, eq=False)
class PivotMap:
    """The best links with one pivot given, (*,).

    dyads: (*,), of all links with that pivot the one with the least squared circle residual; its
        radius is the root mean square of the distances.
    residual: (*,), rms of the circle residual |R m + d - c|² - r², in the task's unit squared: the
        least that there is.
    rms_error, max_error: (*,), of that dyad's distance from its circle, in the task's unit; close
        to the least rms error, and never below it.
    """

    dyads: RR
    residual: FloatArray
    rms_error: FloatArray
    max_error: FloatArray


def grid(low: ArrayLike, high: ArrayLike, columns: int, rows: int) -> FloatArray:
    """Points (rows, columns, 2) that fill the box between two corners, edges included."""
    (x0, y0), (x1, y1) = np.asarray([low, high], dtype=np.float64)
    x, y = np.meshgrid(np.linspace(x0, x1, columns), np.linspace(y0, y1, rows))
    return np.stack([x, y], axis=-1)


def fixed_pivot_map(
    poses: Displacement, pivots: ArrayLike, weights: FloatArray | None = None
) -> PivotMap:
    """The best link of poses for each fixed pivot.

    nan where the moving pivot is not determined, as in a pure rotation about the pivot.

    Formula `pivot-map` of the theory.

    Parameters
    ----------
    poses : Displacement, (N,)
        N >= 4 poses.
    pivots : array_like, (*, 2)
        Points of F, of a `grid` for example.
    weights : array, (N,), optional
        Of the squared residuals.

    Returns
    -------
    PivotMap
        The links (*,) with their errors.

    Raises
    ------
    InputError
        E103 (a number that is not finite).

    Examples
    --------
    >>> t = np.linspace(0, 3, 7)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> fixed_pivot_map(poses, grid((-1, -1), (1, 1), columns=3, rows=3)).rms_error.round(3)
    array([[0.012, 0.221, 0.121],
           [0.322, 0.   , 0.084],
           [0.222, 0.184, 0.132]])
    """
    poses.require_finite()
    frames, seen = CanonicalFrames.of(poses, weights)
    at = (np.asarray(pivots, dtype=np.float64) - frames.fixed_origin) / frames.length
    root = np.sqrt(shares(weights, poses.shape))
    flat, block = at.reshape(-1, 2), max(1, BLOCK_RESIDUALS // poses.shape[0])
    parts = [
        _partners(seen, flat[start : start + block], root) for start in range(0, len(flat), block)
    ]
    moving, radius, residual, rms, worst = (
        np.concatenate(part).reshape(at.shape[:-1] + part[0].shape[1:])
        for part in zip(*parts, strict=True)
    )
    unit = frames.length
    dyads = RR(np.asarray(pivots), moving * unit + frames.moving_origin, radius * unit)
    return PivotMap(dyads, residual * unit**2, rms * unit, worst * unit)


def moving_pivot_map(
    poses: Displacement, pivots: ArrayLike, weights: FloatArray | None = None
) -> PivotMap:
    """The best link of poses for each moving pivot.

    The inverse motion exchanges the two pivots: all else is as of `fixed_pivot_map`, with points
    of M for those of F.

    Formula `pivot-map` of the theory.

    Examples
    --------
    >>> t = np.linspace(0, 3, 7)  # the origin of M runs on the unit circle of F
    >>> poses = Displacement.from_poses(np.stack([np.cos(t), np.sin(t), t**2 / 4], axis=-1))
    >>> moving_pivot_map(poses, [[0, 0], [1, 0]]).rms_error.round(3)
    array([0.   , 0.008])
    """
    there = fixed_pivot_map(poses.inverse(), pivots, weights)
    dyads = RR(there.dyads.moving_pivot, there.dyads.fixed_pivot, there.dyads.radius)
    return PivotMap(dyads, there.residual, there.rms_error, there.max_error)


def _partners(
    poses: Displacement, pivots: FloatArray, root: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """The best moving pivots of fixed pivots (k, 2).

    Returns moving pivots (k, 2), radii, residuals, rms and worst errors (k,).
    With b = R⁻¹(d - c): |R m + d - c|² = |m|² + |b|² + 2 b · m; the means are taken off.
    """
    back = poses.inverse().act(pivots[:, None])  # R⁻¹(c - d), (k, N, 2)
    columns = root[:, None] * _centred(2 * back, root)
    right = root * _centred((back * back).sum(axis=-1, keepdims=True), root)[..., 0]
    x, y = columns[..., 0], columns[..., 1]
    # Gram and Schmidt, the longer column first.
    swap = (y * y).sum(axis=-1, keepdims=True) > (x * x).sum(axis=-1, keepdims=True)
    x, y = np.where(swap, y, x), np.where(swap, x, y)
    with np.errstate(divide="ignore", invalid="ignore"):
        square = (x * x).sum(axis=-1)
        along = (x * y).sum(axis=-1) / square
        rest = y - along[:, None] * x
        rest_square = (rest * rest).sum(axis=-1)
        second = (rest * right).sum(axis=-1) / rest_square
        first = (x * right).sum(axis=-1) / square - along * second
        second = np.where(rest_square > PARALLEL_SINE**2 * np.maximum(square, 1.0), second, np.nan)
        first = np.where(np.isnan(second), np.nan, first)
    moving = np.stack([first, second], axis=-1)
    moving = np.where(swap, moving[:, ::-1], moving)
    left = right - (columns * moving[:, None]).sum(axis=-1)
    distance = RR(pivots, moving, np.zeros(len(pivots)))[:, None].residual(poses)
    radius = np.sqrt(((root * distance) ** 2).sum(axis=-1))
    error = distance - radius[:, None]
    rms, worst = np.sqrt((error * error).mean(axis=-1)), np.abs(error).max(axis=-1)
    return moving, radius, np.sqrt((left * left).sum(axis=-1)), rms, worst


def _centred(values: FloatArray, root: FloatArray) -> FloatArray:
    """Values (k, N, j) less their weighted means over N; root² are the weights, of sum 1."""
    mean = np.einsum("n,knj->kj", root**2, values)
    return np.asarray(values - mean[:, None])
