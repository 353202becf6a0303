"""The map of a family: pairs of dyads coloured by what becomes of them.

Pairs that work are coloured by their least transmission angle, in a scale that is dark where it is
small and grows lighter throughout; those with their pivots where they are assumed to lie have an
outline.  The others have four greys and tints of different lightness, so that nothing depends on
hue.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colorbar import Colorbar
from matplotlib.colors import Normalize, to_rgb
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from burmester.families.family_map import FamilyMap
from burmester.families.pair_verdicts import PairClass
from burmester.fourbar.dyad import RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray
from burmester.plot.maps import CURVE_REACH
from burmester.plot.plane import poses as draw_poses
from burmester.plot.style import (
    BLACK,
    GREY,
    VERMILION,
    figure,
    house_style,
    label,
    plain,
    settle_labels,
    with_unit,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["MapMarks", "PartnerCurve", "family_figure", "family_map", "partner_curve"]

SCALE: Final = "cividis"  # of transmission angles
SCALE_STEP: Final = 5.0  # degrees; that scale ends at a multiple of it
SPECK: Final = 6  # of nine pairs around one that does not work; no outline goes around that one
ROOM: Final = 1.2  # around what is shown of a centre-point curve, as a factor
TINTS: Final = {
    PairClass.OUTSIDE_BOUNDS: "#9fb4c7",
    PairClass.ORDER: "#d9bfa3",
    PairClass.BRANCH: "#dfe2e6",
    PairClass.CIRCUIT: "#f6f6f4",
    PairClass.NO_LINKAGE: "#ffffff",
}
NAMES: Final = {
    PairClass.OUTSIDE_BOUNDS: "outside limits or standard",
    PairClass.ORDER: "order defect",
    PairClass.BRANCH: "branch defect",
    PairClass.CIRCUIT: "circuit defect",
}
TICKS: Final = (0.0, 0.25, 0.5, 0.75)  # places along a loop that are marked, on both pictures
LONGEST_NAME: Final = 12  # characters; names of poses that are longer give way to numbers
LETTERS: Final = "ABCDEFGH"  # of loops, where there are several


class MapMarks(NamedTuple):
    """The map as drawn: the image, and the marks of the recommended linkage."""

    image: AxesImage
    recommended: list[Line2D]


class PartnerCurve(NamedTuple):
    """The centre-point curve as drawn: a coloured line for each loop, marks of places along it."""

    loops: list[LineCollection]
    places: list[Line2D]


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

    Returns
    -------
    MapMarks
        The image and the marks.

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


def partner_curve(
    ax: Axes, found: FamilyMap, recommended: Linkage | None = None, *, within: float | None = None
) -> PartnerCurve:
    """The centre-point curve of four poses, coloured by what the best partner of each dyad allows.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    found : FamilyMap
        A map of four poses.
    recommended : Linkage, optional
        A linkage whose fixed pivots are ringed.
    within : float, optional
        Distance from the middle of the poses that is shown, in the unit of lengths; by default as
        far as the dyads that have a partner with which they work.

    Returns
    -------
    PartnerCurve
        The artists.

    Examples
    --------
    >>> from burmester import plot, read_task
    >>> from burmester.families.family_map import curve_map
    >>> from dataclasses import replace
    >>> task = read_task("case:ge2012-exact")
    >>> found = curve_map(replace(task, poses=task.poses[:4]), samples=40)
    >>> ax = plot.figure(4, 4).add_subplot()
    >>> len(plot.partner_curve(ax, found).loops) == int(found.loop.max()) + 1
    True
    """
    middle, half = _view(found, within)
    colors = colors_of(found, *found.best_partner())
    loops, places = [], []
    assert isinstance(found.first, RR)
    for number in range(int(found.loop.max()) + 1):
        own = np.flatnonzero(found.loop == number)
        pivots = found.first.fixed_pivot[own]
        # Each dyad colours the line half way to its neighbours.
        joints = (pivots + np.roll(pivots, -1, axis=0)) / 2
        pieces = np.stack([np.roll(joints, 1, axis=0), pivots, joints], axis=1)
        near = _is_finite(pieces - middle, half.max())
        shown = list(pieces[near])
        ax.add_collection(LineCollection(shown, colors=BLACK, lw=4.4, zorder=2.3))
        line = LineCollection(shown, colors=colors[own][near].tolist(), lw=3.2, zorder=2.4)
        ax.add_collection(line)
        loops.append(line)
        for share in TICKS:
            k = int(np.argmin(np.abs(found.position[own] - share)))
            if (np.abs(pivots[k] - middle) < half).all():
                places += ax.plot(*pivots[k], "|", ms=7, mew=1.0, color=BLACK, zorder=3)
                label(ax, _tick(found, number, share), pivots[k], pivots[k] - middle, fontsize=7)
    draw_poses(ax, found.task.poses, names=_names(found), color=GREY)
    _rings(ax, recommended)
    box = ax.get_window_extent()
    half = half.max() * np.array([box.width, box.height]) / min(box.width, box.height)
    ax.set_xlim(middle[0] - half[0], middle[0] + half[0])
    ax.set_ylim(middle[1] - half[1], middle[1] + half[1])
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlabel(with_unit("X", found.task.length_unit))
    ax.set_ylabel(with_unit("Y", found.task.length_unit))
    return PartnerCurve(loops, places)


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


def colors_of(found: FamilyMap, classes: NDArray[np.int8], transmission: FloatArray) -> FloatArray:
    """The colours (*, 3) of pairs by their classes (*,) and transmission angles (*,)."""
    table = np.zeros((len(PairClass), 3))
    for kind, tint in TINTS.items():
        table[kind] = to_rgb(tint)
    works = classes <= PairClass.FARTHER
    shades = mpl.colormaps[SCALE](_norm(found)(np.degrees(np.where(works, transmission, 0.0))))
    return np.asarray(np.where(works[..., None], shades[..., :3], table[classes]))


def scale_bar(ax: Axes, found: FamilyMap) -> Colorbar:
    """The scale of transmission angles, in axes of its own."""
    drawing = ax.get_figure(root=True)
    assert drawing is not None
    bar = drawing.colorbar(ScalarMappable(_norm(found), SCALE), cax=ax)
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


def _norm(found: FamilyMap) -> Normalize:
    """From what is asked for to the next full step above the best pair."""
    asked = float(np.degrees(found.bounds.transmission))
    works = np.where(found.verdicts.classes <= PairClass.FARTHER, found.verdicts.transmission, 0.0)
    best = np.ceil(np.degrees(works.max(initial=0.0)) / SCALE_STEP) * SCALE_STEP
    return Normalize(asked, max(best, asked + SCALE_STEP))


def _view(found: FamilyMap, within: float | None) -> tuple[FloatArray, FloatArray]:
    """The middle and half the sides of what is shown of a centre-point curve."""
    at = found.task.poses.translation
    low, high = at.min(axis=0), at.max(axis=0)
    middle, most = (low + high) / 2, CURVE_REACH * float(np.ptp(at, axis=0).max()) / 2
    if within is not None:
        return middle, np.full(2, within)
    assert isinstance(found.first, RR)
    good = found.first.fixed_pivot[found.best_partner()[0] <= PairClass.FARTHER]
    good = good[(np.abs(good - middle) < most).all(axis=1)]
    if not len(good):
        return middle, np.full(2, most)
    low, high = np.minimum(low, good.min(axis=0)), np.maximum(high, good.max(axis=0))
    return (low + high) / 2, np.full(2, ROOM * float((high - low).max()) / 2)


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
        names += [_tick(found, number, share) for share in TICKS]
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
            marks = _ring(ax, [one + 0.5, other + 0.5], [other + 0.5, one + 0.5])
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
    draw_poses(ax, found.task.poses, names=_names(found), color=BLACK)
    names = ("12", "13", "23")
    for name, pole in zip(names, found.poles, strict=True):
        if (np.abs(pole - (low + high) / 2) <= (high - low) / 2).all():
            ax.plot(*pole, "^", ms=5.5, color=BLACK, mec="white", mew=0.8, zorder=5.2)
            label(ax, f"$P_{{{name}}}$", pole, (1.0, -1.0))
    if isinstance(found.first, RR | RP):
        c = found.first.fixed_pivot
        ax.plot(*c, "o", ms=6.5, color=BLACK, mec="white", mew=0.9, zorder=5.3)
        label(ax, "chosen", c)
    marks = _rings(ax, recommended)
    ax.set_xlim(x0, x1)
    ax.set_ylim(y0, y1)
    ax.set_xlabel(with_unit("X of the other fixed pivot", found.task.length_unit))
    ax.set_ylabel(with_unit("Y of the other fixed pivot", found.task.length_unit))
    return MapMarks(image, marks)


def _is_finite(pieces: FloatArray, half: float) -> NDArray[np.bool_]:
    """Which pieces (n, 3, 2) of a curve do not go through infinity.

    Seen from the middle of what is shown (`half` of its side), a piece that does has its ends on
    opposite sides, and is not in it.
    """
    one, at, other = np.moveaxis(pieces, 1, 0)
    out = np.linalg.norm(at, axis=-1) > half
    turned = ((one * at).sum(axis=-1) < 0) | ((other * at).sum(axis=-1) < 0)
    return np.asarray(~(out & turned))


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


def _rings(ax: Axes, recommended: Linkage | None) -> list[Line2D]:
    """Rings around the fixed pivots of a linkage, as far as it has any."""
    dyads: list[Dyad] = [] if recommended is None else [recommended.first, recommended.second]
    points = [each.fixed_pivot for each in dyads if isinstance(each, RR | RP)]
    return _ring(ax, *np.transpose(points)) if points else []


def _ring(ax: Axes, x: object, y: object) -> list[Line2D]:
    halo = [withStroke(linewidth=3.6, foreground="white")]
    style: dict[str, object] = {"ms": 10, "mfc": "none", "mec": VERMILION, "mew": 1.8, "zorder": 6}
    return ax.plot(x, y, "o", path_effects=halo, **style)  # type: ignore[arg-type]


def _names(found: FamilyMap) -> list[str] | None:
    """The names of the poses, where all are short; else their numbers stand there."""
    names = found.task.names
    if names is None or max(map(len, names)) > LONGEST_NAME:
        return None
    return [plain(name) or str(k) for k, name in enumerate(names, start=1)]


def _tick(found: FamilyMap, loop: int, share: float) -> str:
    """The name of a place along a loop: its share, after the loop's letter where there are some."""
    return f"{LETTERS[loop] if found.loop.max() else ''} {share:g}".strip()
