"""Columns with the cosine and the sine of the angle, in place of the angle.

E116 two numbers that are no cosine and sine of one angle
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from burmester.errors import InputError
from burmester.io.reading.pose_table import Rows
from burmester.numerics.arrays import FloatArray

__all__ = ["are_directions", "require_directions"]

MAX_LENGTH_ERROR = 0.02  # of a direction's length 1, beyond what its digits explain
LEAST_ROWS = 3  # of which all directions have length 1; fewer may do so by chance


def require_directions(rows: Rows, locate: Callable[[int | None], str]) -> None:
    """Refuse a row whose cosine and sine are far from those of an angle; raises E116."""
    if rows.lengths is None:
        return
    wrong = np.flatnonzero(np.abs(rows.lengths - 1) > _tolerance(rows.decimals[1]))
    if len(wrong):
        row = int(wrong[0])
        message = f"row {row + 1}: cos and sin are not those of an angle"
        why = f"the sum of their squares is {rows.lengths[row] ** 2:.3g}, and has to be 1"
        help = "give the cosine and the sine of the body's angle, or the angle as angle_deg"
        raise InputError("E116", message, where=locate(row), why=why, help=help)


def are_directions(cosine: Sequence[float], sine: Sequence[float], decimals: float) -> bool:
    """Whether two columns look like the cosine and the sine of angles, different ones."""
    both: FloatArray = np.array([cosine, sine])
    if both.shape[1] < LEAST_ROWS or not np.ptp(both, axis=1).all():
        return False
    return bool((np.abs(np.hypot(*both) - 1) <= _tolerance(decimals)).all())


def _tolerance(decimals: float) -> float:
    """Of a direction's length, printed with so many decimals."""
    return MAX_LENGTH_ERROR + 10.0**-decimals
