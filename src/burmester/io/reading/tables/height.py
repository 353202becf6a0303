"""A third coordinate of poses: passed over where it is constant, refused where it is not."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from burmester.errors import Advice, InputError
from burmester.io.reading.pose_table import NUMBER, Rows, shown

__all__ = ["height_notes"]

MAX_CHANGE = 1e-3  # of z, over the larger change of x and y; up to it z is constant
_IGNORE = 'begin the name of its column with #: "#z"'


def height_notes(
    heights: Sequence[str] | None,
    rows: Rows,
    locate: Callable[[int | None], str],
    ignore: str = _IGNORE,
) -> tuple[Advice, ...]:
    """W213, for a column z that is passed over; none without such a column.

    heights: the texts of z, with decimal points; locate: where a row stands, by its number from 0;
    ignore: how to have z ignored.
    Raises E113 where z changes, and E104 where it is no number.
    """
    if heights is None:
        return ()
    bad = next((row for row, text in enumerate(heights) if not NUMBER.fullmatch(text)), None)
    if bad is not None:
        message = f"row {bad + 1} has {shown(heights[bad])} for z, which is not a number"
        help = f"give a number; or if z says nothing, {ignore}"
        raise InputError("E104", message, where=locate(bad), help=help)
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
        raise InputError("E113", message, where=locate(odd), why=why, help=help)
    why = f"it is {least:g} in all poses"
    if least < most:
        why = f"it stays between {least:.6g} and {most:.6g}, x and y change by {across:.3g}"
    help = f"to have nothing said, {ignore}"
    return (Advice("W213", "the column z is passed over", help, why),)
