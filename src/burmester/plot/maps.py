"""Where pivots may be: the pivot map of many poses, and Burmester's curves of four."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm
from matplotlib.contour import QuadContourSet
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from burmester.dyads.burmester_curve import DyadCurve
from burmester.dyads.pivot_map import PivotMap, fixed_pivot_map, grid
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.plane import near_part
from burmester.plot.style import BLUE, VERMILION

MAX_DECADES = 4.0  # of errors that the colours distinguish, at most
CURVE_REACH = 3.0  # spans of the poses; the curve is cut off beyond


class DrawnMap(NamedTuple):
    """A pivot map as drawn: the map's numbers, its colours, and the lines of equal error."""

    pivot_map: PivotMap
    mesh: QuadMesh
    lines: QuadContourSet


def pivot_map(
    ax: Axes,
    poses: Displacement,
    low: ArrayLike,
    high: ArrayLike,
    *,
    columns: int = 240,
    rows: int | None = None,
    weights: FloatArray | None = None,
) -> DrawnMap:
    """The least error of a link for every fixed pivot in a rectangle of F.

    The colours show the logarithm of the rms distance from the circle, dark where it is small.
    There is a line at each power of ten and a dashed one at three times as much.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    poses : Displacement
        Shape (N,).
    low, high : (2,) array_like
        Two opposite corners of the rectangle, in F.
    columns : int
        Columns of the grid.
    rows : int, optional
        Rows of the grid; by default the cells are square.
    weights : (N,) array, optional
        Weights of the poses.

    Examples
    --------
    >>> from burmester import plot, read_task
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> task = read_task("case:ge2012-exact")
    >>> drawn = plot.pivot_map(ax, task.poses, (-5, -5), (5, 5), columns=20)
    >>> drawn.pivot_map.rms_error.shape
    (20, 20)
    """
    (x0, y0), (x1, y1) = np.asarray([low, high], dtype=np.float64)
    rows = max(2, round(columns * (y1 - y0) / (x1 - x0))) if rows is None else rows
    at = grid(low, high, columns, rows)
    numbers = fixed_pivot_map(poses, at, weights)
    error = np.where(np.isfinite(numbers.rms_error), numbers.rms_error, np.nan)
    greatest = float(np.nanmax(error))
    least = max(float(np.nanmin(error)), greatest * 10**-MAX_DECADES)
    if not 0 < least < greatest:  # every pivot does as well
        least, greatest = 0.5 * (greatest or 1.0), 2 * (greatest or 1.0)
    norm = LogNorm(least, greatest)
    mesh = ax.pcolormesh(
        at[..., 0],
        at[..., 1],
        np.maximum(error, least),
        norm=norm,
        cmap="cividis",
        shading="gouraud",
        zorder=0.5,
        rasterized=True,
    )
    powers = np.arange(np.floor(np.log10(least)), np.ceil(np.log10(greatest)) + 1)
    levels = np.sort(np.concatenate([10.0**powers, 3 * 10.0**powers]))
    levels = levels[(levels > least) & (levels < greatest)]
    lines = ax.contour(
        at[..., 0],
        at[..., 1],
        error,
        levels=levels if len(levels) else [np.sqrt(least * greatest)],
        colors="white",
        linewidths=0.8,
        linestyles=["-" if abs(np.log10(v) % 1) < 0.1 else "--" for v in levels] or "-",
        zorder=0.7,
    )
    return DrawnMap(numbers, mesh, lines)


def centre_point_curve(ax: Axes, curve: DyadCurve, *, within: float | None = None) -> list[Line2D]:
    """The fixed pivots of all dyads through four poses, in F: a solid line for each loop.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    curve : DyadCurve
        The Burmester curve of four poses.
    within : float, optional
        Distance from the middle of the poses at which the curve is cut off, in the unit of lengths.

    Returns
    -------
    list of Line2D
        One line for each loop.

    Examples
    --------
    >>> from burmester import dyad_curve, plot, read_task
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> curve = dyad_curve(read_task("case:ge2012-exact").poses[:4], samples=50)
    >>> len(plot.centre_point_curve(ax, curve)) == len(curve.components)
    True
    """
    return _loops(
        ax,
        [part.fixed_pivot for part in curve.components],
        curve.frames.fixed_origin,
        _reach(curve, within),
        {"color": BLUE, "ls": "-", "label": "centre-point curve (in F)"},
    )


def circle_point_curve(
    ax: Axes, curve: DyadCurve, *, place: Displacement | None = None, within: float | None = None
) -> list[Line2D]:
    """The moving pivots of all dyads through four poses: a dashed line for each loop.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    curve : DyadCurve
        The Burmester curve of four poses.
    place : Displacement, optional
        Shape (), the place of M at which the curve is drawn in F; by default it is drawn in M.
    within : float, optional
        Distance from the middle of the poses at which the curve is cut off, in the unit of lengths.

    Returns
    -------
    list of Line2D
        One line for each loop.

    Examples
    --------
    >>> from burmester import dyad_curve, plot, read_task
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> curve = dyad_curve(read_task("case:ge2012-exact").poses[:4], samples=50)
    >>> len(plot.circle_point_curve(ax, curve)) == len(curve.components)
    True
    """
    place = Displacement.identity() if place is None else place
    return _loops(
        ax,
        [place.act(part.moving_pivot) for part in curve.components],
        place.act(curve.frames.moving_origin),
        _reach(curve, within),
        {"color": VERMILION, "ls": (0, (5, 2)), "label": "circle-point curve (in M)"},
    )


def _reach(curve: DyadCurve, within: float | None) -> float:
    return CURVE_REACH * float(curve.frames.length) if within is None else within


def _loops(
    ax: Axes, loops: list[FloatArray], middle: FloatArray, reach: float, style: dict[str, object]
) -> list[Line2D]:
    """Loops (n, 2) with gaps where they are far away."""
    out = []
    for k, loop in enumerate(loops):
        points = np.concatenate([loop, loop[:1]])
        if k:
            style = style | {"label": "_"}
        (line,) = ax.plot(*near_part(points, reach, middle).T, lw=1.5, zorder=2.6, **style)  # type: ignore[arg-type]
        out.append(line)
    return out
