"""The outline of the body where poses have it and along its motion, and regions to keep out of."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.patches import Polygon
from matplotlib.text import Text
from numpy.typing import ArrayLike

from burmester.geometry.displacement import Displacement
from burmester.geometry.outlines import inner_point
from burmester.plot.style import GREEN, GREY, plain
from burmester.tasks.surroundings import KeepOut

FIRST, LAST = 0.45, 1.0  # strength of the outline at the first pose and at the last
FILL = 0.1  # of its strength: how opaque the inside of an outline is
SWEPT = 0.22  # opacity of the outlines along the motion
STRONG = GREEN  # colour of the body


class DrawnBody(NamedTuple):
    """A body as drawn: its outline at each place, and thin outlines along the motion, if any."""

    places: list[Polygon]
    swept: LineCollection | None


class DrawnKeepOut(NamedTuple):
    """Regions to keep out of as drawn, hatched, and their names."""

    regions: list[Polygon]
    labels: list[Text]


def body(
    ax: Axes,
    outline: ArrayLike,
    places: Displacement,
    *,
    at: int | None = None,
    along: Displacement | None = None,
) -> DrawnBody:
    """The outline of the body at places, the paler the earlier, and faintly along its motion.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    outline : (n, 2) array_like
        Corners in order around it, in M.
    places : Displacement
        Shape (N,); a place that is not finite is left out.
    at : int, optional
        The number of the place that is drawn strongly, from 0.
    along : Displacement, optional
        Shape (k,), places along the motion.

    Examples
    --------
    >>> from burmester import Displacement, plot
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> places = Displacement([[0, 0], [3, 1]], [0, 1.5])
    >>> drawn = plot.body(ax, [(0, 0), (2, 0), (2, 0.5)], places, at=1)
    >>> [len(polygon.get_xy()) - 1 for polygon in drawn.places]
    [3, 3]
    """
    corners = np.asarray(outline, dtype=np.float64)
    colour, polygons = to_rgb(STRONG), []
    for k in np.flatnonzero(np.isfinite(places.angle)).tolist():
        share = FIRST + (LAST - FIRST) * k / max(1, len(places.angle) - 1)
        strong = k == at
        polygons.append(
            Polygon(
                places[k].act(corners),
                closed=True,
                facecolor=(*colour, (3 if strong else 1) * FILL * share),
                edgecolor=(*colour, 1.0 if strong else share),
                lw=1.8 if strong else 0.9,
                zorder=1.5 if strong else 1.2,
                joinstyle="round",
            )
        )
        ax.add_patch(polygons[-1])
    swept = None
    if along is not None:
        ring = np.concatenate([corners, corners[:1]])
        swept = LineCollection(
            list(along[:, None].act(ring)), colors=[(*colour, SWEPT)], linewidths=0.5, zorder=1.1
        )
        ax.add_collection(swept)
    return DrawnBody(polygons, swept)


def keep_out(ax: Axes, regions: Iterable[KeepOut]) -> DrawnKeepOut:
    """Regions that body and links must not touch: hatched, with their names.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    regions : iterable of KeepOut
        The regions, in F.

    Examples
    --------
    >>> from burmester import KeepOut, Polygon, plot
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> shelf = KeepOut(Polygon([(0, 0), (2, 0), (2, 1)]), "shelf")
    >>> [each.get_text() for each in plot.keep_out(ax, [shelf]).labels]
    ['shelf']
    """
    polygons, labels = list[Polygon](), list[Text]()
    for region in regions:
        corners = region.polygon.vertices
        polygons.append(
            Polygon(
                corners,
                closed=True,
                facecolor=(*to_rgb(GREY), 0.10),
                edgecolor=GREY,
                hatch="////",
                lw=1.1,
                zorder=1.0,
            )
        )
        ax.add_patch(polygons[-1])
        if region.name:
            x, y = inner_point(corners).tolist()
            backing = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 1.0}
            labels.append(
                ax.text(
                    x, y, plain(region.name), bbox=backing, fontsize=7.5, ha="center", va="center"
                )
            )
            labels[-1].set(zorder=1.05, clip_on=True)
    return DrawnKeepOut(polygons, labels)
