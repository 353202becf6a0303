"""The pivot map of a task as plain data: the error of the best link for every fixed pivot."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burmester.dyads.pivot_map import fixed_pivot_map, grid
from burmester.fourbar.dyad import RP, RR
from burmester.synthesis.result import Synthesis

FEWEST_POSES = 4  # three poses are met exactly from every pivot
COLUMNS, ROWS = 96, 72  # pivots of the grid
BORDER = 0.6  # scenes: the map is wider than poses and pivots by half of that on each side
FARTHEST_PIVOT = 2.0  # scenes from the middle: a pivot farther away does not widen the map
LEAST_ERROR = 1e-9  # scenes: an error below it is rounding
MOST_EXACT = 0.5  # share of pivots with no error above rounding, beyond which no map is drawn


def pivot_map(synthesis: Synthesis, scene: float) -> dict[str, Any] | None:
    """log10 of the least rms error of a link, over a grid of fixed pivots (row by row, from below).

    scene: the size of the drawing, in the task's unit.  None for fewer than four poses, where most
    pivots meet all poses, and for points, which leave every pivot open.
    """
    task = synthesis.task
    if task.poses.shape[0] < FEWEST_POSES or task.free_angles.any():
        return None
    at = task.poses.translation
    low, high = at.min(axis=0), at.max(axis=0)
    middle = (low + high) / 2
    every = [*synthesis.dyads, *(dyad for found in synthesis.linkages for dyad in found.dyads)]
    points = [each.dyad.fixed_pivot for each in every if isinstance(each.dyad, RR | RP)]
    pivots = np.array(points).reshape(-1, 2)
    near = pivots[(np.abs(pivots - middle) <= FARTHEST_PIVOT * scene).all(axis=-1)]
    if len(near):
        low, high = np.minimum(low, near.min(axis=0)), np.maximum(high, near.max(axis=0))
    low, high = low - BORDER * scene / 2, high + BORDER * scene / 2
    # As wide as the picture is.
    centre, half = (low + high) / 2, (high - low) / 2
    half = np.maximum(half, half[::-1] * np.array([COLUMNS / ROWS, ROWS / COLUMNS]))
    low, high = centre - half, centre + half
    rms = fixed_pivot_map(task.poses, grid(low, high, COLUMNS, ROWS), task.weights).rms_error
    if (~(rms >= LEAST_ERROR * scene)).mean() > MOST_EXACT:
        return None  # a translation or a rotation: most pivots meet all poses, or have no error
    levels = np.log10(np.maximum(rms, LEAST_ERROR * scene))
    flat = [None if math.isnan(each) else round(each, 3) for each in levels.ravel().tolist()]
    return {
        "low": low.tolist(),
        "high": high.tolist(),
        "columns": COLUMNS,
        "rows": ROWS,
        "log10_rms": flat,
    }
