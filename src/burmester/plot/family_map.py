"""The map of a family: pairs of dyads coloured by what becomes of them.

Those with their pivots where they are assumed to lie have an outline, where others work with
farther ones.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from burmester.families.family_map import FamilyMap
from burmester.families.pair_verdicts import PairClass
from burmester.fourbar.dyad import RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray
from burmester.plot.partner_curve import (
    SCALE,
    TICKS,
    TINTS,
    colors_of,
    partner_curve,
    place_name,
    pose_names,
    ring,
    rings,
    scale_of,
)
from burmester.plot.plane import poses as draw_poses
from burmester.plot.style import (
    BLACK,
    GREY,
    VERMILION,
    figure,
    house_style,
    label,
    settle_labels,
    with_unit,
)

FRAME_SIZE: Final = 0.05  # of the width of a rectangle: the x axis of a pose
SPECK: Final = 6  # of nine pairs around one that does not work; no outline goes around that one
NAMES: Final = {
    PairClass.OUTSIDE_BOUNDS: "outside limits or standard",
    PairClass.ORDER: "order defect",
    PairClass.BRANCH: "branch defect",
    PairClass.CIRCUIT: "circuit defect",
}


class MapMarks(NamedTuple):
    """The map as drawn: the image, and the marks of the recommended linkage."""

    image: AxesImage
    recommended: list[Line2D]


def family_map(ax: Axes, found: FamilyMap, recommended: Linkage | None = None) -> MapMarks:
    """The pairs of a family, coloured by what becomes of them.

    Four poses: both axes run along the curve of dyads, loop by loop; a pair has its place twice.
    Three poses: each place is the fixed pivot in F of the second dyad; the fixed pivot of the dyad
    that was chosen, the poles and the poses are marked.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    found : FamilyMap
        The map.
    recommended : Linkage, optional
        A linkage to be marked by rings.

    Examples
    --------
    >>> from burmester import plot, read_task
    >>> from burmester.families.family_map import curve_map
    >>> from dataclasses import replace
    >>> task = read_task("case:ge2012-exact")
    >>> found = curve_map(replace(task, poses=task.poses[:4]), samples=20)
    >>> ax = plot.figure(4, 4).add_subplot()
    >>> plot.family_map(ax, found).image.get_array().shape
    (20, 20, 3)
    """
    colors = colors_of(found, found.verdicts.classes, found.verdicts.transmission)
    if found.kind == "curve":
        return _square(ax, found, np.swapaxes(colors, 0, 1), recommended)
    return _rectangle(ax, found, colors, recommended)


def family_figure(found: FamilyMap, recommended: Linkage | None = None) -> Figure:
    """The map as one figure with its scale and its legend; beside a square the curve itself.

    Parameters
    ----------
    found : FamilyMap
        The map.
    recommended : Linkage, optional
        A linkage to be marked.

    Returns
    -------
    Figure
        A Matplotlib figure.

    Examples
    --------
    >>> from burmester import plot, read_task
    >>> from burmester.families.family_map import curve_map
    >>> from dataclasses import replace
    >>> task = read_task("case:ge2012-exact")
    >>> found = curve_map(replace(task, poses=task.poses[:4]), samples=20)
    >>> len(plot.family_figure(found).axes)  # the square, the curve, the scale
    3
    """
    with house_style():
        if found.kind == "curve":
            drawing = figure(9.6, 5.4)
            square = drawing.add_axes((0.075, 0.17, 0.42, 0.7467))
            family_map(square, found, recommended)
            curve = drawing.add_axes((0.565, 0.17, 0.335, 0.7467))
            partner_curve(curve, found, recommended)
            square.set_title("pairs of dyads on the curve")
            curve.set_title("centre-point curve, by the best partner")
            settle_labels(curve)
            scale = drawing.add_axes((0.925, 0.17, 0.014, 0.7467))
        else:
            drawing = figure(7.6, 5.8)
            plane = drawing.add_axes((0.1, 0.18, 0.75, 0.8))
            family_map(plane, found, recommended)
            settle_labels(plane)
            scale = drawing.add_axes((0.885, 0.21, 0.018, 0.737))
        scale_bar(scale, found)
        class_legend(drawing, found, recommended is not None)
    return drawing


def scale_bar(ax: Axes, found: FamilyMap) -> Colorbar:
    """The scale of transmission angles, in axes of its own."""
    drawing = ax.get_figure(root=True)
    assert drawing is not None
    bar = drawing.colorbar(ScalarMappable(scale_of(found), SCALE), cax=ax)
    bar.set_label("works: least transmission angle, by the better driver")
    bar.ax.yaxis.set_major_formatter("{x:g}°")
    bar.outline.set_linewidth(0.6)
    return bar


def class_legend(drawing: Figure, found: FamilyMap, recommended: bool) -> Legend:
    """The tints of the pairs that do not work, and the marks, below everything."""
    handles: list[Patch | Line2D] = [
        Patch(facecolor=TINTS[kind], edgecolor=GREY, lw=0.6, label=name)
        for kind, name in NAMES.items()
    ]
    if PairClass.FARTHER in found.verdicts.classes:
        words = "works, pivots where assumed"
        handles.append(Line2D([], [], color=BLACK, lw=1.0, label=words))
    style: dict[str, object] = {"ls": "", "color": BLACK}
    if found.kind == "plane":
        handles.append(Line2D([], [], marker="^", ms=5.5, label="pole", **style))  # type: ignore[arg-type]
        handles.append(Line2D([], [], marker="o", ms=5.5, label="dyad chosen", **style))  # type: ignore[arg-type]
    if recommended:
        ring: dict[str, object] = {"marker": "o", "ms": 8, "mfc": "none", "mec": VERMILION}
        handles.append(Line2D([], [], ls="", mew=1.8, label="recommended", **ring))  # type: ignore[arg-type]
    return drawing.legend(
        handles=handles,
        loc="lower center",
        ncols=4 if found.kind == "plane" else 6,
        bbox_to_anchor=(0.5, 0.005),
        handlelength=1.4,
        columnspacing=1.6,
    )


def _square(
    ax: Axes, found: FamilyMap, colors: FloatArray, recommended: Linkage | None
) -> MapMarks:
    """The square of four poses; colors: (n, n, 3), the first dyad along the columns."""
    n = len(colors)
    image = ax.imshow(colors, origin="lower", extent=(0, n, 0, n), interpolation="nearest")
    ticks, names = [], []
    for number in range(int(found.loop.max()) + 1):
        own = np.flatnonzero(found.loop == number)
        ticks += [own[0] + share * len(own) for share in TICKS]
        names += [place_name(found, number, share) for share in TICKS]
        if number:
            for line in (ax.axhline, ax.axvline):
                line(own[0], color=BLACK, lw=0.8)
    ax.set_xticks(ticks, names)
    ax.set_yticks(ticks, names)
    ax.set_xlabel("place of one dyad along the curve")
    ax.set_ylabel("place of the other dyad along the curve")
    middles: FloatArray = np.arange(n, dtype=np.float64) + 0.5
    _outline(ax, found.verdicts.classes.T, middles, middles)
    marks: list[Line2D] = []
    if recommended is not None:
        one, other = (
            found.nearest(each) if isinstance(each, RR) else None
            for each in (recommended.first, recommended.second)
        )
        if one is not None and other is not None:
            marks = ring(ax, [one + 0.5, other + 0.5], [other + 0.5, one + 0.5])
    return MapMarks(image, marks)


def _rectangle(
    ax: Axes, found: FamilyMap, colors: FloatArray, recommended: Linkage | None
) -> MapMarks:
    """The rectangle of three poses; colors: (rows, columns, 3)."""
    at = found.second.fixed_pivot
    low, high = at[0, 0], at[-1, -1]
    half = (high - low) / (np.array(at.shape[1::-1]) - 1) / 2
    (x0, y0), (x1, y1) = low - half, high + half
    image = ax.imshow(
        colors, origin="lower", extent=(x0, x1, y0, y1), interpolation="nearest", zorder=0.5
    )
    _outline(ax, found.verdicts.classes, at[0, :, 0], at[:, 0, 1])
    poses = found.task.poses
    seen = (np.abs(poses.translation - (low + high) / 2) <= (high - low) / 2).all(axis=1)
    labels = pose_names(found) or [str(k + 1) for k in range(len(seen))]
    if seen.any():
        shown = [name for name, here in zip(labels, seen, strict=True) if here]
        draw_poses(ax, poses[seen], names=shown, color=BLACK, size=FRAME_SIZE * (x1 - x0))
    names = ("12", "13", "23")
    for name, pole in zip(names, found.poles, strict=True):
        if (np.abs(pole - (low + high) / 2) <= (high - low) / 2).all():
            ax.plot(*pole, "^", ms=5.5, color=BLACK, mec="white", mew=0.8, zorder=5.2)
            label(ax, f"$P_{{{name}}}$", pole, (1.0, -1.0))
    if isinstance(found.first, RR | RP):
        c = found.first.fixed_pivot
        ax.plot(*c, "o", ms=6.5, color=BLACK, mec="white", mew=0.9, zorder=5.3)
        label(ax, "chosen", c)
    marks = rings(ax, recommended)
    ax.set_xlim(x0, x1)
    ax.set_ylim(y0, y1)
    ax.set_xlabel(with_unit("X of the other fixed pivot", found.task.length_unit))
    ax.set_ylabel(with_unit("Y of the other fixed pivot", found.task.length_unit))
    return MapMarks(image, marks)


def _outline(ax: Axes, classes: NDArray[np.int8], x: FloatArray, y: FloatArray) -> None:
    """A line around the pairs (rows, columns) that work, where others work with farther pivots."""
    if PairClass.FARTHER in classes and PairClass.WORKS in classes:
        works = np.asarray(classes == PairClass.WORKS, dtype=np.float64)
        edged = np.pad(works, 1)
        rows, columns = works.shape
        around = sum(edged[i : i + rows, j : j + columns] for i in range(3) for j in range(3))
        works = np.where(around >= SPECK, 1.0, works)
        for color, width in (("white", 2.4), (BLACK, 1.0)):
            ax.contour(x, y, works, levels=[0.5], colors=color, linewidths=width, zorder=0.9)
