"""The centre-point curve of four poses, coloured by what the best partner of each dyad allows."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from burmester.families.family_map import FamilyMap
from burmester.families.pair_verdicts import PairClass
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray
from burmester.plot.family_marks import TICKS, colors_of, place_name, pose_names, rings
from burmester.plot.maps import CURVE_REACH
from burmester.plot.plane import poses as draw_poses
from burmester.plot.style import BLACK, GREY, label, with_unit

ROOM: Final = 1.2  # around what is shown of a centre-point curve, as a factor


class PartnerCurve(NamedTuple):
    """The centre-point curve as drawn: a coloured line for each loop, marks of places along it."""

    loops: list[LineCollection]
    places: list[Line2D]


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
                label(
                    ax, place_name(found, number, share), pivots[k], pivots[k] - middle, fontsize=7
                )
    draw_poses(ax, found.task.poses, names=pose_names(found), color=GREY)
    rings(ax, recommended)
    box = ax.get_window_extent()
    half = half.max() * np.array([box.width, box.height]) / min(box.width, box.height)
    ax.set_xlim(middle[0] - half[0], middle[0] + half[0])
    ax.set_ylim(middle[1] - half[1], middle[1] + half[1])
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlabel(with_unit("X", found.task.length_unit))
    ax.set_ylabel(with_unit("Y", found.task.length_unit))
    return PartnerCurve(loops, places)


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


def _is_finite(pieces: FloatArray, half: float) -> NDArray[np.bool_]:
    """Which pieces (n, 3, 2) of a curve do not go through infinity.

    Seen from the middle of what is shown (`half` of its side), a piece that does has its ends on
    opposite sides, and is not in it.
    """
    one, at, other = np.moveaxis(pieces, 1, 0)
    out = np.linalg.norm(at, axis=-1) > half
    turned = ((one * at).sum(axis=-1) < 0) | ((other * at).sum(axis=-1) < 0)
    return np.asarray(~(out & turned))
