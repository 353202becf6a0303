"""The centre-point curve of four poses, coloured by what the best partner of each dyad allows."""

from __future__ import annotations

from typing import Final, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from burmester.families.family_map import FamilyMap
from burmester.families.pair_verdicts import PairClass
from burmester.fourbar.dyad import RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray
from burmester.plot.maps import CURVE_REACH
from burmester.plot.plane import poses as draw_poses
from burmester.plot.style import BLACK, GREY, VERMILION, label, plain, with_unit
from burmester.requirements.transmission import TRANSMISSION

ROOM: Final = 1.2  # around what is shown of a centre-point curve, as a factor


SCALE: Final = "cividis"  # of transmission angles
SCALE_STEP: Final = 5.0  # degrees; that scale ends at a multiple of it
TINTS: Final = {
    PairClass.OUTSIDE_BOUNDS: "#9fb4c7",
    PairClass.ORDER: "#d9bfa3",
    PairClass.BRANCH: "#dfe2e6",
    PairClass.CIRCUIT: "#f6f6f4",
    PairClass.NO_LINKAGE: "#ffffff",
}
TICKS: Final = (0.0, 0.25, 0.5, 0.75)  # places along a loop that are marked, on both pictures
LONGEST_NAME: Final = 12  # characters; names of poses that are longer give way to numbers
LETTERS: Final = "ABCDEFGH"  # of loops, where there are several


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
    """Which pieces (n, 3, 2) of a curve, seen from the middle (`half`), avoid infinity."""
    one, at, other = np.moveaxis(pieces, 1, 0)
    out = np.linalg.norm(at, axis=-1) > half
    turned = ((one * at).sum(axis=-1) < 0) | ((other * at).sum(axis=-1) < 0)
    return np.asarray(~(out & turned))


def colors_of(found: FamilyMap, classes: NDArray[np.int8], transmission: FloatArray) -> FloatArray:
    """The colours (*, 3) of pairs by their classes (*,) and transmission angles (*,)."""
    table = np.zeros((len(PairClass), 3))
    for kind, tint in TINTS.items():
        table[kind] = to_rgb(tint)
    works = classes <= PairClass.FARTHER
    shades = mpl.colormaps[SCALE](scale_of(found)(np.degrees(np.where(works, transmission, 0.0))))
    return np.asarray(np.where(works[..., None], shades[..., :3], table[classes]))


def scale_of(found: FamilyMap) -> Normalize:
    """From what is asked for to the next full step above the best pair."""
    asked = float(found.bounds.asked[TRANSMISSION])
    works = np.where(found.verdicts.classes <= PairClass.FARTHER, found.verdicts.transmission, 0.0)
    best = np.ceil(np.degrees(works.max(initial=0.0)) / SCALE_STEP) * SCALE_STEP
    return Normalize(asked, max(best, asked + SCALE_STEP))


def rings(ax: Axes, recommended: Linkage | None) -> list[Line2D]:
    """Rings around the fixed pivots of a linkage, as far as it has any."""
    dyads: list[Dyad] = [] if recommended is None else [recommended.first, recommended.second]
    points = [each.fixed_pivot for each in dyads if isinstance(each, RR | RP)]
    return ring(ax, *np.transpose(points)) if points else []


def ring(ax: Axes, x: object, y: object) -> list[Line2D]:
    halo = [withStroke(linewidth=3.6, foreground="white")]
    style: dict[str, object] = {"ms": 10, "mfc": "none", "mec": VERMILION, "mew": 1.8, "zorder": 6}
    return ax.plot(x, y, "o", path_effects=halo, **style)  # type: ignore[arg-type]


def pose_names(found: FamilyMap) -> list[str] | None:
    """The names of the poses, where all are short; else their numbers stand there."""
    names = found.task.names
    if names is None or max(map(len, names)) > LONGEST_NAME:
        return None
    return [plain(name) or str(k) for k, name in enumerate(names, start=1)]


def place_name(found: FamilyMap, loop: int, share: float) -> str:
    """The name of a place along a loop: its share, after the loop's letter where there are some."""
    return f"{LETTERS[loop] if found.loop.max() else ''} {share:g}".strip()
