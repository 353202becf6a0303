"""What all figures share: colours, line styles, units, and labels that do not cover each other.

The colours are those of Okabe and Ito (Color universal design, 2008), which colour-blind eyes tell
apart; no two things differ by colour only.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from itertools import pairwise
from typing import Final, cast

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke
from matplotlib.text import Annotation
from numpy.typing import ArrayLike

from burmester.numerics.arrays import FloatArray
from burmester.printable import printable

BLACK: Final = "#1b2733"
GREY: Final = "#7b8794"
BLUE: Final = "#0072B2"
ORANGE: Final = "#E69F00"
GREEN: Final = "#009E73"
VERMILION: Final = "#D55E00"
PURPLE: Final = "#AA5A94"
PALETTE: Final = (BLUE, ORANGE, GREEN, PURPLE)

MOST_CHARACTERS: Final = 100  # of a text of others in a picture; one as wide as ten is cut
SCREEN_DPI: Final = 80  # pixels per inch of a figure in a notebook; drawn twice as fine
LABEL_ID: Final = "burmester.label"  # gid of labels that may be moved
LABEL_STEP: Final = 9.0  # points: first distance between a label and its target
DRAWING_MARGIN: Final = 0.07  # of a drawing's longer side: space left free around it
LINE_COST: Final = 30.0  # cost of a piece of a line under a label; another label costs 10,000
PIECE_LENGTH: Final = 3.0  # points: length of such a piece

# The 32 places of a label: 4 distances in 8 directions, the preferred one first.
_FAR: Final = np.repeat([1.0, 1.5, 2.2, 3.3], 8)
_ANGLES: Final = np.tile([0.0, 45, -45, 90, -90, 135, -135, 180], 4)
_TURNS: Final = np.moveaxis(
    np.array(
        [
            [np.cos(np.radians(_ANGLES)), np.sin(np.radians(_ANGLES))],
            [-np.sin(np.radians(_ANGLES)), np.cos(np.radians(_ANGLES))],
        ]
    ),
    2,
    0,
)
_LIKED: Final = 80 * (_FAR - 1) ** 1.5 + np.abs(_ANGLES) / 60  # near is better than free

_RC: Final = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "mathtext.fontset": "dejavusans",
    "axes.edgecolor": BLACK,
    "axes.labelcolor": BLACK,
    "text.color": BLACK,
    "xtick.color": BLACK,
    "ytick.color": BLACK,
    "axes.grid": False,
    "axes.titlesize": 10,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "svg.hashsalt": "burmester",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
    "path.simplify": False,
    "savefig.facecolor": "white",
}


@contextmanager
def house_style() -> Iterator[None]:
    """The fonts, colours and fixed ids of the package's own figures, as a context.

    A figure that is made and saved inside it is written with the same bytes each time.

    Returns
    -------
    context manager
        Matplotlib's settings are restored at its end.

    Examples
    --------
    >>> from burmester import plot
    >>> with plot.house_style():
    ...     ax = plot.figure(4, 3).add_subplot()
    """
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_RC)  # type: ignore[arg-type]
        yield


class ShownFigure(Figure):
    """A figure that a notebook shows as the last line of a cell.

    Matplotlib tells the notebook how to show its figures only once pyplot is imported. Where it is,
    the notebook's own settings for figures come first.
    """

    def _repr_png_(self) -> tuple[bytes, dict[str, int]]:
        """The picture, and the width and height at which its words are as large as the page's."""
        picture = BytesIO()
        self.savefig(picture, format="png", dpi=2 * SCREEN_DPI)
        width, height = (round(SCREEN_DPI * inches) for inches in self.get_size_inches())
        return picture.getvalue(), {"width": width, "height": height}


def figure(width: float, height: float, dpi: float = 160.0) -> Figure:
    """An empty figure that belongs to no screen and no window.

    Parameters
    ----------
    width, height : float
        Inches.
    dpi : float
        Pixels per inch.

    Returns
    -------
    Figure
        A Matplotlib figure with the Agg canvas. A notebook shows it without pyplot.

    Examples
    --------
    >>> from burmester import plot
    >>> plot.figure(4, 3, dpi=100).bbox.size.tolist()
    [400.0, 300.0]
    """
    out = ShownFigure(figsize=(width, height), dpi=dpi)
    FigureCanvasAgg(out)
    return out


def with_unit(text: str, unit: str | None) -> str:
    """A label with its unit in parentheses, where there is one."""
    return f"{text} ({plain(unit)})" if unit else text


def plain(text: str) -> str:
    r"""A text that Matplotlib draws as it is: one line, not too long, no formula."""
    line = printable(text)
    line = line if len(line) <= MOST_CHARACTERS else f"{line[: MOST_CHARACTERS - 3]}..."
    return line.replace("$", r"\$")


def label(
    ax: Axes, text: str, at: ArrayLike, away: ArrayLike = (1.0, 1.0), **style: object
) -> Annotation:
    """A label at a point (2,), a little away from it in a direction (2,).

    `settle_labels` moves it where it would cover something.
    """
    x, y = np.asarray(at, dtype=np.float64)
    direction = np.asarray(away, dtype=np.float64)
    size = float(np.hypot(*direction))
    direction = direction / size if size > 0 else np.array([0.0, 1.0])
    settings: dict[str, object] = {"fontsize": 7.5, "color": BLACK, "zorder": 9}
    settings |= {"path_effects": [withStroke(linewidth=1.8, foreground="white")]} | style
    out = ax.annotate(
        text,
        (x, y),
        xytext=cast("tuple[float, float]", tuple(LABEL_STEP * direction)),
        textcoords="offset points",
        ha="center",
        va="center",
        annotation_clip=False,
        **settings,  # type: ignore[arg-type]
    )
    out.set_gid(LABEL_ID)
    return out


def finish(ax: Axes, unit: str | None = None, *, room: float = DRAWING_MARGIN) -> None:
    """Set equal axes around the drawing, write the unit, move labels apart; to be called last.

    For drawings in the plane of F.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    unit : str, optional
        Unit of lengths, as the task states it.
    room : float
        Space left free around the drawing, in shares of its longer side.

    Examples
    --------
    >>> from burmester import plot, read_task
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> task = read_task("case:ge2012-exact")
    >>> frames = plot.poses(ax, task.poses)
    >>> plot.finish(ax, "mm")
    >>> ax.get_xlabel()
    'X (mm)'
    """
    ax.set_aspect("equal", adjustable="box")
    ax.relim()
    low, high = _extent(ax)
    free = room * max(high - low)
    ax.set_xlim(low[0] - free, high[0] + free)
    ax.set_ylim(low[1] - free, high[1] + free)
    ax.set_xlabel(with_unit("X", unit))
    ax.set_ylabel(with_unit("Y", unit))
    settle_labels(ax)


def legend(ax: Axes, columns: int = 2) -> Legend:
    """A legend above the axes, where it covers nothing.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    columns : int
        Columns of the legend.

    Returns
    -------
    Legend
        Matplotlib's legend.

    Examples
    --------
    >>> from burmester import Displacement, Linkage, plot
    >>> from burmester.fourbar.dyad import RR
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> crank, rocker = RR([0, 0], [0, 0], 1.0), RR([4, 0], [3, 1], 5**0.5)
    >>> four_bar, place = Linkage(crank, rocker), Displacement([0, 1], 0.0)
    >>> curve = plot.coupler_curve(ax, four_bar)
    >>> [text.get_text() for text in plot.legend(ax).get_texts()]
    ['circuit 1', 'circuit 2']
    """
    return ax.legend(
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=columns,
        borderaxespad=0.2,
        handlelength=2.6,
    )


def _extent(ax: Axes) -> tuple[FloatArray, FloatArray]:
    """The corners of what is drawn in data coordinates."""
    box = ax.dataLim
    points = [box.get_points()] if np.isfinite(box.get_points()).all() else []
    for collection in ax.collections:
        own = collection.get_datalim(ax.transData).get_points()
        if np.isfinite(own).all() and collection.get_offset_transform() != ax.transAxes:
            points.append(own)
    every = np.concatenate(points) if points else np.array([[0.0, 0.0], [1.0, 1.0]])
    low, high = every.min(axis=0), every.max(axis=0)
    flat = high - low <= 0
    return np.where(flat, low - 0.5, low), np.where(flat, high + 0.5, high)


def settle_labels(ax: Axes) -> list[Annotation]:
    """Move the labels of `label` to where they cover neither each other nor what is drawn.

    Of 8 directions and 4 distances each label takes the best one left, its preferred one first.
    """
    canvas = ax.figure.canvas
    renderer = canvas.get_renderer()  # type: ignore[attr-defined]
    ax.apply_aspect()
    own = [t for t in ax.texts if isinstance(t, Annotation) and t.get_gid() == LABEL_ID]
    taken = [t.get_window_extent(renderer) for t in ax.texts if t not in own and t.get_visible()]
    piece = PIECE_LENGTH * ax.figure.dpi / 72
    own_legend = ax.get_legend()
    if own_legend is not None:
        taken.append(own_legend.get_window_extent(renderer))
    paths = [line.get_transform().transform(_rows(line.get_xydata())) for line in ax.lines]
    drawn = [
        _along(path, piece) if line.get_linestyle() not in ("None", " ", "") else path
        for line, path in zip(ax.lines, paths, strict=True)
    ]
    drawn += [
        _along(patch.get_transform().transform(_rows(patch.get_xy())), piece)
        for patch in ax.patches
        if isinstance(patch, Polygon)
    ]
    drawn += [ax.transData.transform([t.xy for t in own])] if own else []
    points = np.concatenate(drawn) if drawn else np.zeros((0, 2))
    points = points[np.isfinite(points).all(axis=-1)]
    inside = ax.get_window_extent(renderer).get_points()
    boxes = [t.get_points() for t in taken]
    for text in own:
        preferred = np.array(text.get_position())
        preferred = preferred / max(float(np.hypot(*preferred)), 1e-9)
        size = text.get_window_extent(renderer)
        half = np.array([size.width, size.height]) / 2
        ways = preferred @ _TURNS  # (32, 2)
        # The label's near side, not its middle, is at the distance.
        reach = LABEL_STEP * 0.45 * _FAR * ax.figure.dpi / 72 + np.abs(ways) @ half
        away = reach[:, None] * ways
        middles = ax.transData.transform(text.xy) + away
        places = np.stack([middles - half - 1, middles + half + 1], axis=1)
        best = int((_costs(places, np.array(boxes).reshape(-1, 2, 2), points, inside)).argmin())
        x, y = away[best] * 72 / ax.figure.dpi
        text.set_position((float(x), float(y)))
        boxes.append(places[best])
    return own


def _rows(points: ArrayLike) -> FloatArray:
    return np.asarray(points, dtype=np.float64).reshape(-1, 2)


def _along(path: FloatArray, piece: float) -> FloatArray:
    """Points along a line (n, 2), about so many pixels apart."""
    if len(path) < 2:
        return path
    pieces = [path[:1]]
    for a, b in pairwise(path):
        length = np.hypot(*(b - a))
        if np.isfinite(length):
            many = int(min(length / piece, 400)) + 1
            pieces.append(a + (b - a) * (np.arange(1, many + 1) / many)[:, None])
    return np.concatenate(pieces)


def _costs(
    places: FloatArray, taken: FloatArray, points: FloatArray, inside: FloatArray
) -> FloatArray:
    """What places (32, 2, 2) for a label cost (32,): covering other labels costs most."""
    cost = _LIKED.copy()
    low, high = places[:, None, 0], places[:, None, 1]
    both = np.minimum(high, taken[None, :, 1]) - np.maximum(low, taken[None, :, 0])
    both = np.maximum(both, 0.0).prod(axis=-1)
    cost += (1e4 * (both > 0) + 100 * both).sum(axis=1)
    near = ((points > places[:, 0].min(axis=0)) & (points < places[:, 1].max(axis=0))).all(axis=-1)
    own = points[near]
    cost += LINE_COST * ((own > low) & (own < high)).all(axis=-1).sum(axis=1)
    size = (places[:, 1] - places[:, 0]).prod(axis=-1)
    seen = np.minimum(places[:, 1], inside[1]) - np.maximum(places[:, 0], inside[0])
    return np.asarray(cost + 20 * (size - np.maximum(seen, 0.0).prod(axis=-1)))
