"""What columns say together: cosine and sine in place of the angle, and z beside x and y.

E113 z changes, so that the poses are not in one plane
E116 two numbers that are no cosine and sine of one angle
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import NUMBER, Rows, decimals
from burmester.io.reading.tables.grid import Grid

MAX_LENGTH_ERROR = 0.02  # of a direction's length 1, beyond what its digits explain
MOST_LENGTH_ERROR = 0.1  # the same with what digits explain, where these are few
MAX_COSINE = 1.1  # numbers beyond it are no cosines
LEAST_ROWS = 4  # of which all directions have length 1; fewer may do so by chance
MAX_CHANGE = 1e-3  # of z, over the larger change of x and y; up to it z is constant


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


def direction_notes(
    texts: Sequence[str], other: Sequence[str], names: Sequence[str]
) -> tuple[Advice, ...]:
    """W243, where the cells of angles and of a column that is passed over seem to be a direction.

    names: of the two columns.
    """
    if not are_directions(texts, other):
        return ()
    both = " and ".join(f"`{name.strip()}`" for name in names)
    return (
        Advice(
            "W243",
            f"the columns {both} look like the cosine and the sine of an angle",
            "if that is what they are, name the columns x,y,cos,sin in the header or by --columns",
            "their squares add up to 1 in all rows",
        ),
    )


def are_directions(cosine: Sequence[str], sine: Sequence[str]) -> bool:
    """Whether numbers look like the cosine and the sine of angles that are not all the same."""
    if len(cosine) < LEAST_ROWS or not all(map(NUMBER.fullmatch, (*cosine, *sine))):
        return False
    both = np.array([cosine, sine], dtype=float)
    printed = max(map(decimals, (*cosine, *sine)))
    return bool(
        np.ptp(both, axis=1).all() and (abs(np.hypot(*both) - 1) <= _tolerance(printed)).all()
    )


def _tolerance(printed: float) -> float:
    """Of a direction's length, printed with so many decimals."""
    last_digit: float = 10.0**-printed
    return min(MAX_LENGTH_ERROR + math.sqrt(0.5) * last_digit, MOST_LENGTH_ERROR)


def height_notes(heights: Sequence[str] | None, rows: Rows, grid: Grid) -> tuple[Advice, ...]:
    """W213, for a column z that is passed over; none without such a column.

    heights: the texts of z, with decimal points.  Raises E113 where z changes.
    """
    if heights is None:
        return ()
    ignore = grid.ignore.format("z")
    z = np.array([float(text) for text in heights])
    with np.errstate(over="ignore", invalid="ignore"):
        across = float(np.ptp(rows.values[:, :2], axis=0).max())
        change = float(np.ptp(z))
    least, most = float(z.min()), float(z.max())
    if not change <= MAX_CHANGE * across:
        odd = int(np.abs(z - np.median(z)).argmax())
        why = (
            f"it goes from {least:g} to {most:g}, and a planar linkage keeps its body in one plane"
        )
        help = f"give x and y in the plane of the motion; or if z says nothing, {ignore}"
        message = "z is not the same in all poses"
        raise InputError("E113", message, where=grid.locate(odd), why=why, help=help)
    why = f"it is {least:g} in all poses"
    if least < most:
        why = f"it stays between {least:.6g} and {most:.6g}, x and y change by {across:.3g}"
    help = f"to have nothing said, {ignore}"
    return (Advice("W213", "the column z is passed over", help, why),)
