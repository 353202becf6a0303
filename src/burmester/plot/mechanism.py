"""A linkage at a place: links, pivots, sliders, slots, and the ground they stand on.

The body is the polygon of its pins and of its origin; so are other plates of three joints.  A rail
of the ground has a block on it, a slot of the body a block that turns on the ground.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.patheffects import Normal, Stroke
from matplotlib.text import Annotation

from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.outlines import body as draw_body
from burmester.plot.outlines import keep_out
from burmester.plot.plane import coupler_curve, poses, span_of
from burmester.plot.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    figure,
    finish,
    house_style,
    label,
    legend,
)
from burmester.scene.linkage_scene import Pivot, Scene, own_circuit, path_of, scene_at, scene_with
from burmester.synthesis.result import Candidate
from burmester.verdicts.found_linkage import FoundLinkage

if TYPE_CHECKING:
    from burmester.fourbar.linkage import Linkage

FAINT = "#aab3bd"
MARKS: dict[str, dict[str, Any]] = {  # lines beside the linkage: springs, and the arrow of a hand
    "spring": {"color": PURPLE, "lw": 1.2},
    "hand": {"color": ORANGE, "lw": 1.8},
}
PLATES = (ORANGE, GREEN, PURPLE)  # colours of plates beside the body
SYMBOL_SIZE = 0.045  # of the linkage's size: a ground pivot or a block
MOST_PLACES = 12  # at which a linkage is drawn; a path has too many


class DrawnLinkage(NamedTuple):
    """A linkage as drawn.

    links: a line for each link, rail or slot; coupler: the polygon of the body; plates: of others;
    ground: hatching; pivots: a line of markers, the fixed pivots and the moving pivots as far as
    there are any.
    """

    links: list[Line2D]
    coupler: Polygon
    plates: list[Polygon]
    ground: list[Artist]
    fixed_pivots: Line2D
    moving_pivots: Line2D
    labels: list[Annotation]

    @property
    def artists(self) -> list[Artist]:
        """All but the labels."""
        plates = [*self.links, self.coupler, *self.plates, *self.ground]
        return [*plates, self.fixed_pivots, self.moving_pivots]


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
    reached = Displacement(
        np.concatenate([np.zeros((0, 2)), *(each.translation for each in travel)]),
        np.concatenate([np.zeros(0), *(each.angle for each in travel)]),
    )
    return draw(ax, scene_with(linkage, place, reached), names=names, color=color, faint=faint)


def draw(
    ax: Axes, scene: Scene, *, names: bool = False, color: str = BLUE, faint: bool = False
) -> DrawnLinkage:
    """Draw what is to be seen of a linkage at a place; the options are those of `linkage`."""
    size, width = SYMBOL_SIZE * scene.size, 0.6 if faint else 2.6
    links, ground, plates = list[Line2D](), list[Artist](), list[Polygon]()
    if not faint:
        for pivot in scene.pivots:
            ground += _support(ax, pivot.at, size) if pivot.fixed else []
        for ends in scene.of("rail"):
            ground.append(_hatching(ax, ends[0], ends[1], 0.7 * size * _below(ends)))
        blocks = [each.block for each in scene.pivots if each.block is not None]
        ground += [_block(ax, at, along, size) for at, along in blocks]
    for role, points in scene.shapes:
        if role in ("body", "plate") or (faint and role in MARKS):
            continue
        style: dict[str, Any] = {"color": FAINT if faint else BLACK, "lw": width}
        style |= MARKS.get(role, {})
        if role == "rail":
            style["lw"] = width * 0.7
        elif role == "slot" and not faint:  # a bar that is open inside
            bar = [Stroke(linewidth=5.4, foreground=color), Normal()]
            style |= {"color": "white", "path_effects": bar}
        links += ax.plot(*points.T, zorder=2.1 if faint else 3.4, solid_capstyle="round", **style)
    (corners,) = scene.of("body")
    body = _plate(ax, corners, color, faint)
    for corners, own in zip(scene.of("plate"), PLATES, strict=False):
        plates.append(_plate(ax, corners, own, faint))
    fixed, moving = (
        _pins(ax, [each.at for each in scene.pivots if each.fixed == stands], faint)
        for stands in (True, False)
    )
    labels = _named(ax, scene.pivots, body.get_xy()[0]) if names else []
    return DrawnLinkage(links, body, plates, ground, fixed, moving, labels)


def path(ax: Axes, chosen: Candidate) -> list[Line2D]:
    """The path of the body's origin: of a four-bar the circuit on which it meets most poses."""
    if not isinstance(chosen, FoundLinkage):
        pieces = path_of(chosen, np.zeros((1, 2)))
        return [line for piece in pieces for line in ax.plot(*piece.T)]
    places = chosen.error.places[np.isfinite(chosen.error.places.angle)]
    own = own_circuit(chosen.driver_first, places)
    curve = coupler_curve(ax, chosen.driver_first, only=own)
    for cross in curve.dead_points:
        cross.remove()
    return [each for lines in curve.circuits for each in lines]


def linkage_figure(
    chosen: Candidate,
    ax: Axes | None = None,
    *,
    pose: int | None = None,
    along: Displacement | None = None,
) -> Figure:
    """A linkage at one of the poses of its task, faintly at others, with its path and its body.

    pose: a number from 0, the middle one that it reaches if None.
    along: (n,), places of the body along the motion, which are drawn as thin outlines.
    """
    task, places = chosen.task, chosen.error.places
    with house_style():
        if ax is None:
            ax = figure(7.0, 6.0).add_axes((0.1, 0.08, 0.86, 0.82))
        there = np.flatnonzero(np.isfinite(places.angle))
        middle = int(there[len(there) // 2]) if len(there) and pose is None else pose
        if not isinstance(chosen, FoundLinkage):
            for line in path(ax, chosen):
                line.set(color=GREY, lw=0.9, linestyle=(0, (3, 2)), zorder=1.8)
            ax.set_title(f"{chosen.id}  {chosen.type}", loc="left", fontsize=10)
        elif (own := own_circuit(chosen.driver_first, places[there])) is not None:
            coupler_curve(ax, chosen.driver_first, only=own, size=span_of(task.poses))
        if task.surroundings is not None:
            keep_out(ax, task.surroundings.keep_out)
        if task.body is not None:
            shown = places if len(there) else task.poses[~task.free_angles]
            draw_body(ax, task.body.vertices, shown, at=middle, along=along)
        some = there[np.linspace(0, len(there) - 1, min(len(there), MOST_PLACES)).astype(np.intp)]
        for k in sorted({*some.tolist(), *([] if middle is None else [middle])}):
            draw(ax, scene_at(chosen, k), faint=k != middle, names=k == middle)
        poses(ax, task.poses, free=task.free_angles)
        if isinstance(chosen, FoundLinkage):
            legend(ax)
        finish(ax, chosen.unit)
    drawing = ax.get_figure(root=True)
    assert drawing is not None
    return drawing


def _plate(ax: Axes, corners: FloatArray, color: str, faint: bool) -> Polygon:
    plate = Polygon(
        corners,
        closed=True,
        facecolor=(*to_rgb(color), 0.03 if faint else 0.16),
        edgecolor=FAINT if faint else color,
        lw=0.6 if faint else 1.8,
        zorder=2.0 if faint else 3.2,
        joinstyle="round",
    )
    ax.add_patch(plate)
    return plate


def _below(ends: FloatArray) -> FloatArray:
    """The unit vector across a rail, downwards."""
    along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    across = np.array([along[1], -along[0]])
    return across * (-1.0 if across[1] >= 0 else 1.0)


def _pins(ax: Axes, points: list[FloatArray], faint: bool) -> Line2D:
    """Markers at pivots as far as there are any."""
    at = np.reshape(points, (-1, 2))
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


def _named(ax: Axes, pivots: tuple[Pivot, ...], origin: FloatArray) -> list[Annotation]:
    """The names of pivots beside them, A0 as A with an index."""
    return [
        label(
            ax,
            f"${re.sub('0$', '_0', each.name)}$",
            each.at,
            (-1.0, 0.3) if each.fixed else each.at - origin,
            fontsize=9,
        )
        for each in pivots
    ]


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
