"""Drawings in the plane of F: poses as frames, linkages, coupler curves, errors, centrodes.

Every function draws on axes that it is given and returns the artists that it made.  `style.finish`
comes last: equal axes, units, and labels moved apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.text import Annotation
from numpy.typing import ArrayLike

from burmester.fourbar.circuits import Circuits
from burmester.fourbar.instantaneous import Centrodes
from burmester.fourbar.instantaneous import centrodes as centrodes_of
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.style import BLACK, BLUE, GREEN, GREY, PURPLE, VERMILION, label
from burmester.scene.linkage_scene import longest

X_AXIS_LENGTH = 0.13  # of the poses' span: length of a frame's x axis
Y_AXIS_SHARE = 0.6  # of the x axis: length of the y axis
ENDLESS_CURVE_REACH = 2.0  # spans; an endless curve is cut off beyond
CIRCUITS = ((BLUE, "-"), (GREEN, (0, (5, 2))))


class Frames(NamedTuple):
    """Poses as drawn: one line for all x axes, one for all y axes, the origins, the numbers."""

    x_axes: Line2D
    y_axes: Line2D
    origins: Line2D
    labels: list[Annotation]


class CouplerCurve(NamedTuple):
    """A coupler curve as drawn: a list of lines for each circuit, and its dead points."""

    circuits: list[list[Line2D]]
    dead_points: list[Line2D]


class Achieved(NamedTuple):
    """Prescribed poses, achieved places, and lines between them, `scale` times as long."""

    prescribed: Frames
    achieved: Frames
    errors: LineCollection
    scale: float


def span_of(poses: Displacement) -> float:
    """The longer side of the box of the origins (N,), or 1 where there is none."""
    size = float(np.ptp(poses.translation.reshape(-1, 2), axis=0).max())
    return size if size > 0 else 1.0


def poses(
    ax: Axes,
    poses: Displacement,
    *,
    size: float | None = None,
    names: Sequence[str] | None = None,
    color: str = VERMILION,
    linestyle: str | tuple[int, tuple[float, ...]] = "-",
    numbers: bool = True,
    free: ArrayLike = False,
) -> Frames:
    """Poses as frames: a long x axis with a dot at its foot, a shorter y axis, and a number.

    A pose whose angle is free is a point: a dot and a number.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    poses : Displacement
        Shape (N,) or ().
    size : float, optional
        Length of the x axes, in the unit of lengths; by default 0.13 of the span of the poses.
    names : sequence of str, optional
        One name a pose, instead of the numbers from 1.
    color : str
        Colour of axes and labels.
    linestyle : str or tuple
        Line style of the axes, as in Matplotlib.
    numbers : bool
        Write the numbers of the poses, if there are no names.
    free : (N,) array_like of bool
        The poses whose angle is free, such as `task.free_angles`; by default none.

    Examples
    --------
    >>> from burmester import plot, read_task
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> task = read_task("case:ge2012-exact")
    >>> [label.get_text() for label in plot.poses(ax, task.poses).labels]
    ['1', '2', '3', '4', '5', '6', '7', '8', '9', '10']
    """
    row = poses if poses.shape else poses[None]
    long = X_AXIS_LENGTH * span_of(row) if size is None else size
    tips = row[:, None].act(np.array([[0.0, 0.0], [long, 0.0], [0.0, Y_AXIS_SHARE * long]]))
    style: dict[str, Any] = {
        "color": color,
        "ls": linestyle,
        "zorder": 5,
        "solid_capstyle": "round",
    }
    turned = tips[~np.broadcast_to(free, len(tips))]
    (x_axes,) = ax.plot(*_broken(turned[:, :2]).T, lw=1.7, **style)
    (y_axes,) = ax.plot(*_broken(turned[:, [0, 2]]).T, lw=1.0, **style)
    (origins,) = ax.plot(*tips[:, 0].T, "o", ms=3.2, color=color, zorder=5.1)
    labels = []
    if numbers or names is not None:
        texts = names or [str(k + 1) for k in range(len(tips))]
        away = row.rotate(np.array([-1.0, -1.0]))
        labels = [
            label(ax, text, at, way, color=color)
            for text, at, way in zip(texts, tips[:, 0], away, strict=True)
        ]
    return Frames(x_axes, y_axes, origins, labels)


def parameters(circuits: Circuits, samples: int = 721, reach: float = 1.0) -> list[FloatArray]:
    """Parameters along one circuit, a row for each of its branches, ends included.

    reach: of a drive that slides without end, in the unit of lengths.
    """
    closed, two = bool(circuits.closed), int(circuits.branches) == 2
    if closed:
        ends = [(0.0, np.pi), (np.pi, 2 * np.pi)] if two else [(0.0, 2 * np.pi)]
    elif circuits.loop.turns:
        ends = [(0.0, np.pi)]
    else:
        ends = [(-reach, 0.0), (0.0, reach)] if two else [(-reach, reach)]
    return [np.linspace(low, high, samples) for low, high in ends]


def coupler_curve(
    ax: Axes,
    linkage: Linkage,
    point: ArrayLike = (0.0, 0.0),
    *,
    samples: int = 721,
    only: int | None = None,
    size: float | None = None,
) -> CouplerCurve:
    """The coupler curve of a point: solid blue on the first circuit, dashed green on the second.

    The second branch of a circuit is drawn thinner.  A cross marks each dead point of the driver.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    linkage : Linkage
        Shape (), the driver first.
    point : (2,) array_like
        The point, in M.
    samples : int
        Points of each branch.
    only : int, optional
        The number of the one circuit to draw, 0 or 1.
    size : float, optional
        Size of the motion, which decides where an endless curve is cut off; by default that of the
        linkage.

    Raises
    ------
    InputError
        E401 where the first dyad cannot drive.

    Examples
    --------
    >>> from burmester import Displacement, Linkage, plot
    >>> from burmester.fourbar.dyad import RR
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> crank, rocker = RR([0, 0], [0, 0], 1.0), RR([4, 0], [3, 1], 5**0.5)
    >>> four_bar, place = Linkage(crank, rocker), Displacement([0, 1], 0.0)
    >>> len(plot.coupler_curve(ax, four_bar, (1.5, 1.0)).circuits)
    2
    """
    circuits = Circuits.of(linkage, as_given=True)
    drawn, dead = list[list[Line2D]](), list[Line2D]()
    reach = ENDLESS_CURVE_REACH * (longest(linkage) if size is None else size)
    for number, (color, style) in enumerate(CIRCUITS):
        own = circuits[number]
        if not own.exists or only not in (None, number):
            continue
        lines = []
        branches = parameters(own, samples, reach)
        for branch, row in enumerate(branches):
            curve = own.curve(np.asarray(point, dtype=np.float64), row)
            if not own.closed:
                curve = near_part(curve, reach)
            (line,) = ax.plot(
                *curve.T,
                color=color,
                ls=style,
                lw=0.8 if branch else 1.6,
                zorder=2.5,
                label=f"circuit {number + 1}" if branch == 0 else "_",
            )
            lines.append(line)
        if len(branches) == 2:
            ends = np.array([branches[0][-1]] + ([branches[0][0]] if own.closed else []))
            marks = own.curve(np.asarray(point, dtype=np.float64), ends)
            (cross,) = ax.plot(
                *marks.T,
                "X",
                ms=6.5,
                mfc="white",
                mec=color,
                mew=1.2,
                zorder=6,
                label="_" if dead else "dead point",
            )
            dead.append(cross)
        drawn.append(lines)
    return CouplerCurve(drawn, dead)


def achieved(
    ax: Axes,
    places: Displacement,
    poses_: Displacement,
    *,
    scale: float | None = None,
    size: float | None = None,
) -> Achieved:
    """Achieved places over the poses of a task, and the position errors as lines.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    places : Displacement
        Shape (N,), the places of the coupler.
    poses_ : Displacement
        Shape (N,), the poses of the task.
    scale : float, optional
        Factor by which the errors are drawn larger, which the legend states; by default a round
        number with which the largest error is well visible.
    size : float, optional
        Length of the x axes, in the unit of lengths.

    Examples
    --------
    >>> from burmester import plot, read_task
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> task = read_task("case:ge2012-exact")
    >>> plot.achieved(ax, task.poses, task.poses).scale
    1.0
    """
    gap = places.translation - poses_.translation
    turn = places.angle - poses_.angle
    turn = turn - 2 * np.pi * np.round(turn / (2 * np.pi))
    span = span_of(poses_)
    worst = float(max(np.hypot(*gap.T).max(), np.abs(turn).max() * X_AXIS_LENGTH * span))
    if scale is None:
        scale = 1.0
        if worst > 0:
            exact = 0.5 * X_AXIS_LENGTH * span / worst
            power = 10.0 ** np.floor(np.log10(exact))
            scale = float(max(1.0, *(m * power for m in (1, 2, 5) if m * power <= exact)))
    shown = Displacement(poses_.translation + scale * gap, poses_.angle + scale * turn)
    prescribed = poses(ax, poses_, size=size, color=GREY, linestyle=(0, (2, 1.2)), numbers=True)
    got = poses(
        ax, shown, size=X_AXIS_LENGTH * span if size is None else size, color=BLUE, numbers=False
    )
    errors = LineCollection(
        list(np.stack([poses_.translation, shown.translation], axis=1)),
        colors=BLACK,
        linewidths=1.4,
        zorder=6,
    )
    ax.add_collection(errors)
    prescribed.x_axes.set_label("wanted")
    got.x_axes.set_label(
        "achieved" if scale == 1 else f"achieved, errors drawn {scale:g} times as large"
    )
    return Achieved(prescribed, got, errors, scale)


class DrawnCentrodes(NamedTuple):
    """Both centrodes as drawn, and the points (n, 2) of them in F."""

    fixed: Line2D
    moving: Line2D
    points: Centrodes


def centrodes(
    ax: Axes, linkage: Linkage, place: Displacement, *, circuit: int = 0, samples: int = 721
) -> DrawnCentrodes:
    """The fixed centrode, solid, and the moving one, dashed, for the coupler at a place.

    Both are cut off far from the place, because they may run through infinity.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    linkage : Linkage
        Shape (), the driver first.
    place : Displacement
        Shape (), the place at which the moving centrode is drawn.
    circuit : int
        The number of the circuit, 0 or 1.
    samples : int
        Points of each branch.

    Examples
    --------
    >>> from burmester import Displacement, Linkage, plot
    >>> from burmester.fourbar.dyad import RR
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> crank, rocker = RR([0, 0], [0, 0], 1.0), RR([4, 0], [3, 1], 5**0.5)
    >>> four_bar, place = Linkage(crank, rocker), Displacement([0, 1], 0.0)
    >>> drawn = plot.centrodes(ax, four_bar, place, samples=90)
    >>> drawn.points.fixed.shape
    (90, 2)
    """
    own = Circuits.of(linkage, as_given=True)[circuit]
    size = longest(linkage)
    rows = np.concatenate(parameters(own, samples, ENDLESS_CURVE_REACH * size))
    both = centrodes_of(linkage, own.couplers(rows))
    fixed = near_part(both.fixed, ENDLESS_CURVE_REACH * size, place.translation)
    moving = near_part(place.act(both.moving), ENDLESS_CURVE_REACH * size, place.translation)
    (one,) = ax.plot(*fixed.T, color=GREEN, lw=1.5, zorder=2.2, label="fixed centrode")
    (two,) = ax.plot(
        *moving.T, color=PURPLE, lw=1.5, ls=(0, (4, 1.6)), zorder=2.2, label="moving centrode"
    )
    return DrawnCentrodes(one, two, Centrodes(fixed, moving))


def near_part(points: FloatArray, reach: float, middle: ArrayLike | None = None) -> FloatArray:
    """Points (n, 2) with nan for those far away, so that a line has a gap there."""
    if middle is None:
        finite = points[np.isfinite(points).all(axis=-1)]
        middle = np.median(finite, axis=0) if len(finite) else np.zeros(2)
    with np.errstate(invalid="ignore", over="ignore"):
        close = np.abs(points - np.asarray(middle)).max(axis=-1) <= reach
    out = np.where(close[:, None], points, np.nan)
    # A jump from one far side to the other is no piece of the curve.
    with np.errstate(invalid="ignore"):
        jump = np.abs(np.diff(out, axis=0)).max(axis=-1) > reach / 2
    out[1:][jump] = np.nan
    return np.asarray(out)


def _broken(lines: FloatArray) -> FloatArray:
    """Lines (n, k, 2) as one row with gaps between them."""
    gap = np.full((len(lines), 1, 2), np.nan)
    return np.concatenate([lines, gap], axis=1).reshape(-1, 2)
