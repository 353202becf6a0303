"""A linkage at a place of its coupler: links, pivots, sliders, slots, and the ground they stand on.

RR is a link between two pins; PR a block on a rail of the ground; RP a slot of the coupler on a
block that turns on the ground.  The coupler is the polygon of its pins and of the body's origin.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.patheffects import Normal, Stroke
from matplotlib.text import Annotation

from burmester.fourbar.dyad import PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.style import BLACK, BLUE, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["DrawnLinkage", "dimension", "linkage"]

FAINT = "#aab3bd"
SYMBOL_SIZE = 0.045  # of the linkage's size: a ground pivot or a block
RAIL_MARGIN = 0.28  # of the linkage's size: half of a rail's or slot's length beyond the travel


class DrawnLinkage(NamedTuple):
    """A linkage as drawn.

    links: the line of each dyad's link, rail or slot; coupler: the polygon; ground: hatching;
    pivots: a line of markers, the fixed pivots and the moving pivots as far as there are any.
    """

    links: list[Line2D]
    coupler: Polygon
    ground: list[Artist]
    fixed_pivots: Line2D
    moving_pivots: Line2D
    labels: list[Annotation]


def linkage(
    ax: Axes,
    linkage: Linkage,
    place: Displacement,
    *,
    travel: tuple[Displacement, ...] = (),
    names: bool = False,
    color: str = BLUE,
    faint: bool = False,
) -> DrawnLinkage:
    """Draw a linkage with its coupler at a place.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    linkage : Linkage
        Shape (), the driver first.
    place : Displacement
        Shape (), the place of the coupler.
    travel : tuple of Displacement
        Shapes (n,), further places that a rail or a slot has to reach.
    names : bool
        Write A0, A and B0, B beside the pivots.
    color : str
        Colour of the coupler.
    faint : bool
        Thin lines without ground, for further places of one linkage.

    Returns
    -------
    DrawnLinkage
        The artists: links, coupler, ground, pivots and labels.

    Examples
    --------
    >>> from burmester import Displacement, Linkage, plot
    >>> from burmester.fourbar.dyad import RR
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> crank, rocker = RR([0, 0], [0, 0], 1.0), RR([4, 0], [3, 1], 5**0.5)
    >>> four_bar, place = Linkage(crank, rocker), Displacement([0, 1], 0.0)
    >>> drawn = plot.linkage(ax, four_bar, place, names=True)
    >>> [label.get_text() for label in drawn.labels]
    ['$A_0$', '$A$', '$B_0$', '$B$']
    """
    dyads = (linkage.first, linkage.second)
    size = SYMBOL_SIZE * dimension(linkage)
    guides = [_guide(dyad, place, travel, size / SYMBOL_SIZE) for dyad in dyads]
    links, ground = list[Line2D](), list[Artist]()
    width = 0.6 if faint else 2.6
    for dyad, guide in zip(dyads, guides, strict=True):
        if not faint:
            ground += _ground(ax, guide, size)
        style: dict[str, Any] = {"color": FAINT if faint else BLACK, "lw": width}
        if isinstance(dyad, PR):
            style["lw"] = width * 0.7
        elif isinstance(dyad, RP) and not faint:  # a slot: a bar that is open inside
            bar = [Stroke(linewidth=5.4, foreground=color), Normal()]
            style |= {"color": "white", "path_effects": bar}
        links += ax.plot(
            *guide.ends.T, zorder=2.1 if faint else 3.4, solid_capstyle="round", **style
        )
    corners = [place.translation, *(g.corner for g in guides if g.corner is not None)]
    body = Polygon(
        np.stack(corners),
        closed=True,
        facecolor=(*to_rgb(color), 0.03 if faint else 0.16),
        edgecolor=FAINT if faint else color,
        lw=0.6 if faint else 1.8,
        zorder=2.0 if faint else 3.2,
        joinstyle="round",
    )
    ax.add_patch(body)
    fixed, moving = (
        _pins(ax, [g.fixed for g in guides], faint),
        _pins(ax, [g.moving for g in guides], faint),
    )
    labels = _named(ax, guides, place) if names else []
    return DrawnLinkage(links, body, ground, fixed, moving, labels)


class _Guide(NamedTuple):
    """What one dyad looks like: points (2,), or None where there is no such thing.

    ends: (2, 2), of the link, rail or slot; corner: of the coupler; block: where it is, and along
    which direction it slides; below: the side of a rail that is hatched.
    """

    ends: FloatArray
    fixed: FloatArray | None = None
    moving: FloatArray | None = None
    corner: FloatArray | None = None
    block: tuple[FloatArray, FloatArray] | None = None
    below: FloatArray | None = None


def _guide(
    dyad: Dyad, place: Displacement, travel: tuple[Displacement, ...], size: float
) -> _Guide:
    """The guide of a dyad with the coupler at a place (); size: of the linkage."""
    if isinstance(dyad, RR):
        pin = place.act(dyad.moving_pivot)
        return _Guide(np.stack([dyad.fixed_pivot, pin]), dyad.fixed_pivot, pin, pin)
    if isinstance(dyad, PR):
        pin, (normal, along) = place.act(dyad.moving_pivot), _directions(dyad)
        others = [each.act(dyad.moving_pivot) @ along for each in travel]
        ends = dyad.offset * normal + along * _span(pin @ along, others, size)[:, None]
        on_rail = dyad.offset * normal + along * (pin @ along)
        below = normal * (-1.0 if normal[1] >= 0 else 1.0)
        return _Guide(ends, None, pin, pin, (on_rail, along), below)
    if isinstance(dyad, RP):
        normal, along = _directions(dyad)
        pin = place.inverse().act(dyad.fixed_pivot)  # all in M
        others = [each.inverse().act(dyad.fixed_pivot) @ along for each in travel]
        ends = dyad.offset * normal + along * _span(pin @ along, others, size)[:, None]
        corner = place.act(ends[int(np.hypot(*ends.T).argmin())])
        return _Guide(
            place.act(ends), dyad.fixed_pivot, None, corner, (dyad.fixed_pivot, place.rotate(along))
        )
    return _Guide(np.stack([place.translation, place.translation]))


def _directions(dyad: PR | RP) -> FloatArray:
    """The normal and the direction (2, 2) of its line."""
    c, s = np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)
    return np.array([[c, s], [-s, c]])


def _span(at: FloatArray, others: list[FloatArray], size: float) -> FloatArray:
    """The ends (2,) of a rail or slot that holds all these coordinates along it."""
    every = np.concatenate([np.ravel(at), *(np.ravel(o) for o in others)])
    return np.array([np.nanmin(every) - RAIL_MARGIN * size, np.nanmax(every) + RAIL_MARGIN * size])


def _ground(ax: Axes, guide: _Guide, size: float) -> list[Artist]:
    """What stands on the ground, and the blocks."""
    out: list[Artist] = []
    if guide.fixed is not None:
        out += _support(ax, guide.fixed, size)
    if guide.below is not None:
        out.append(_hatching(ax, guide.ends[0], guide.ends[1], guide.below * size * 0.7))
    if guide.block is not None:
        out.append(_block(ax, *guide.block, size))
    return out


def _pins(ax: Axes, points: list[FloatArray | None], faint: bool) -> Line2D:
    """Markers at pivots as far as there are any."""
    at = np.reshape([p for p in points if p is not None], (-1, 2))
    (line,) = ax.plot(
        *at.T,
        "o",
        ms=2.6 if faint else 5.6,
        mfc="white",
        mec=FAINT if faint else BLACK,
        mew=0.7 if faint else 1.4,
        zorder=2.2 if faint else 4.4,
        ls="none",
    )
    return line


def _named(ax: Axes, guides: list[_Guide], place: Displacement) -> list[Annotation]:
    """A0, A and B0, B beside the pivots that there are."""
    out = []
    for guide, letter in zip(guides, "AB", strict=True):
        if guide.fixed is not None:
            out.append(label(ax, f"${letter}_0$", guide.fixed, (-1.0, 0.3), fontsize=9))
        if guide.moving is not None:
            away = guide.moving - place.translation
            out.append(label(ax, f"${letter}$", guide.moving, away, fontsize=9))
    return out


def dimension(linkage: Linkage) -> float:
    """The longest of a linkage's lengths, or 1: the same wherever its coupler is.

    Between pivots of one frame, and from the body's origin to what the body holds.
    """
    dyads = (linkage.first, linkage.second)
    lengths = [0.0]
    for name in ("fixed_pivot", "moving_pivot"):
        pivots = [getattr(dyad, name) for dyad in dyads if hasattr(dyad, name)]
        if len(pivots) == 2:
            lengths.append(float(np.linalg.norm(pivots[1] - pivots[0])))
    for dyad in dyads:
        if isinstance(dyad, RR):
            lengths.append(float(dyad.radius))
        if isinstance(dyad, RR | PR):
            lengths.append(float(np.linalg.norm(dyad.moving_pivot)))
        if isinstance(dyad, RP):
            lengths.append(float(abs(dyad.offset)))
    return max(lengths) or 1.0


def _support(ax: Axes, pivot: FloatArray, size: float) -> list[Artist]:
    """A fixed pivot's foot: a triangle on hatched ground, in data coordinates."""
    left, right = pivot + size * np.array([[-0.62, -1.0], [0.62, -1.0]])
    foot = Polygon(
        np.stack([pivot, left, right]),
        closed=True,
        facecolor="white",
        edgecolor=BLACK,
        lw=1.1,
        zorder=3.3,
    )
    ax.add_patch(foot)
    out = size * np.array([0.35, 0.0])
    return [foot, _hatching(ax, left - out, right + out, np.array([0.0, -0.45 * size]))]


def _hatching(ax: Axes, start: FloatArray, end: FloatArray, away: FloatArray) -> LineCollection:
    """A line of ground from start to end, with strokes on the side of `away`."""
    long = float(np.hypot(*(end - start)))
    depth = float(np.hypot(*away))
    many = max(3, round(long / (0.75 * depth)))
    at = start + (end - start) * ((np.arange(many) + 0.7) / many)[:, None]
    slant = away - (end - start) / long * depth * 0.8
    strokes = np.stack([at, at + slant], axis=1)
    lines = [np.stack([start, end]), *strokes]
    hatch = LineCollection(lines, colors=BLACK, linewidths=[1.1] + [0.6] * many, zorder=3.1)
    ax.add_collection(hatch)
    return hatch


def _block(ax: Axes, at: FloatArray, along: FloatArray, size: float) -> Polygon:
    """A block that slides along a direction, its middle at a point."""
    across = np.array([-along[1], along[0]])
    corners = [
        at + size * (u * 0.95 * along + v * 0.55 * across)
        for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    block = Polygon(
        np.stack(corners), closed=True, facecolor="white", edgecolor=BLACK, lw=1.3, zorder=3.8
    )
    ax.add_patch(block)
    return block
