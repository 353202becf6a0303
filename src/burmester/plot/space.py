"""The image space in a picture: quadrics, the curve they share, and the image points of poses.

Drawn on ordinary Matplotlib axes.  The surfaces are ray-cast (`raycast`); the curve, the points,
the box with its numbers are vectors, drawn over the picture and broken where a surface covers them.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from matplotlib.text import Annotation
from numpy.typing import ArrayLike, NDArray

from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.box_axes import box_axes
from burmester.plot.camera import Box, Camera, chart
from burmester.plot.common_curve import common_curve
from burmester.plot.raycast import Extent, Scene, Surface, cast, render
from burmester.plot.style import BLACK, PALETTE, label, settle_labels

ON_SURFACE = 1e-6  # in t: a surface does not cover a curve that is nearer to it
MARKER_SIZE = 0.02  # of the box: half the size of an image point's marker
RINGS = 9  # lines of equal height on a surface as high as the box
MAX_CHART_HEIGHT = 3.0  # Z3/Z4 (at 143 degrees); the box does not include what is higher
NUMBER_MARGIN = 0.17  # of the box: space around it for its numbers


class ImageSpace(NamedTuple):
    """What `image_space` has drawn.

    picture: the surfaces; frame: the box, its grid and numbers; curve: the pieces of the common
    curve, seen ones and covered ones; points: the markers; labels: their numbers.
    """

    scene: Scene
    box: Box
    picture: AxesImage | None
    frame: list[Artist]
    curve: list[Line2D]
    points: list[Line2D]
    labels: list[Annotation]


def scene_of(
    quadrics: ArrayLike,
    box: Box,
    camera: Camera,
    colours: Sequence[str] = PALETTE,
    opacity: float = 0.45,
) -> Scene:
    """Quadrics, manifolds (k, 8) or matrices (k, 4, 4), as surfaces in a box of the chart."""
    given = np.asarray(quadrics, dtype=np.float64)
    forms = box.forms(given if given.shape[-2:] == (4, 4) else constraint_manifold.matrix(given))
    forms = forms.reshape(-1, 4, 4)
    ticks = 2 * box.half[2] / RINGS
    # Rings where Z3 = 0, and from there.
    zero = float(box.to_box(np.zeros(3))[2])
    surfaces = tuple(
        Surface(
            form / np.abs(form).max(),
            np.array(to_rgb(colours[k % len(colours)])),
            opacity,
            (float(ticks), zero),
        )
        for k, form in enumerate(forms)
    )
    return Scene(camera, box.half, surfaces)


def covered(
    scene: Scene, points: FloatArray, slack: FloatArray | float = ON_SURFACE
) -> NDArray[np.intp]:
    """How many surfaces lie between the eye and points (n, 3), as the eye has them: (n,).

    slack: of t, by which a surface has to be nearer.
    """
    x, y, t = scene.camera.project(points).T
    forms = np.stack([s.form for s in scene.surfaces])
    hits = cast(scene.camera, forms, scene.half * (1 + 1e-12), x, y)
    return np.asarray((hits < t - slack).sum(axis=0))


def image_space(
    ax: Axes,
    quadrics: ArrayLike = (),
    *,
    poses: Displacement | None = None,
    curve: Sequence[ArrayLike] | None = None,
    box: Box | None = None,
    camera: Camera | None = None,
    names: Sequence[str] = (),
    colours: Sequence[str] = PALETTE,
    opacity: float = 0.45,
    unit: str | None = None,
    numbers: bool = True,
    pixels: int | None = None,
) -> ImageSpace:
    """Draw quadrics of the image space, in the chart Z4 = 1.

    The axes get equal scales and no frame.  Z1 and Z2 have one scale; Z3, which is no length, has
    its own.  Covered parts of curves are dashed, covered points hollow.

    Parameters
    ----------
    ax : Axes
        Matplotlib axes.
    quadrics : (k, 8) or (k, 4, 4) array_like
        Constraint manifolds or matrices, none to four of them.
    poses : Displacement, optional
        Shape (N,), drawn as image points with their numbers.
    curve : sequence of (n, 4) array_like, optional
        Loops of image points; by default the curve that the first two quadrics share.
    box : Box, optional
        The part of the chart that is drawn; by default a box around curve and points.
    camera : Camera, optional
        The point of view; by default from the left in front, a little from above.
    names : sequence of str
        Names of the quadrics, for a legend.
    colours : sequence of str
        Colours of the quadrics.
    opacity : float
        Opacity of the surfaces, 0 to 1.
    unit : str, optional
        Unit of lengths.
    numbers : bool
        Write the numbers of the poses.
    pixels : int, optional
        Columns of the picture of the surfaces; by default those of the axes.

    Returns
    -------
    ImageSpace
        The scene, its box, and the artists.

    Examples
    --------
    >>> from burmester import plot, read_task
    >>> ax = plot.figure(4, 3).add_subplot()
    >>> task = read_task("case:ge2012-exact")
    >>> from burmester import fit_pencil
    >>> p = fit_pencil(task.poses).coefficients
    >>> drawn = plot.image_space(ax, p, poses=task.poses, pixels=40)
    >>> len(drawn.labels)
    10
    """
    given = np.asarray(quadrics, dtype=np.float64)
    if curve is None:
        loops = (
            common_curve(given[0], given[1]) if given.shape[-1:] == (8,) and len(given) > 1 else []
        )
    else:
        loops = [np.asarray(loop, dtype=np.float64) for loop in curve]
    places = np.zeros((0, 4)) if poses is None else poses.as_image_point()
    camera = Camera.at(np.radians(-145.0), np.radians(22.0)) if camera is None else camera
    if box is None:
        box = _box_around(loops, places)
    scene = (
        scene_of(quadrics, box, camera, colours, opacity)
        if given.size
        else Scene(camera, box.half, ())
    )
    corners = camera.project(np.array(list(product(*zip(-box.half, box.half, strict=True)))))
    low, high = corners[:, :2].min(axis=0), corners[:, :2].max(axis=0)
    free = NUMBER_MARGIN * max(high - low)
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlim(low[0] - free, high[0] + free * 0.4)
    ax.set_ylim(low[1] - free * 0.9, high[1] + free * (0.5 if names else 0.2))
    ax.set_axis_off()
    picture = None
    if scene.surfaces:
        if pixels is None:
            ax.apply_aspect()
            window = ax.get_window_extent()
            share = (high[0] - low[0]) / np.ptp(ax.get_xlim())
            pixels = max(16, round(window.width * share))
        extent = Extent(low[0], high[0], low[1], high[1])
        size = (pixels, max(1, round(pixels * (high[1] - low[1]) / (high[0] - low[0]))))
        limits = ax.get_xlim(), ax.get_ylim()
        picture = ax.imshow(
            render(scene, extent, size), extent=extent, zorder=2, interpolation="antialiased"
        )
        ax.set_xlim(limits[0])
        ax.set_ylim(limits[1])
    frame = box_axes(ax, box, camera, unit)
    lines = [line for loop in loops for line in _curve(ax, scene, box.to_box(chart(loop)))]
    markers, labels = _points(ax, scene, box.to_box(chart(places)), numbers)
    if names:
        patches = [
            Patch(facecolor=colours[k % len(colours)], edgecolor=BLACK, label=name)
            for k, name in enumerate(names)
        ]
        frame.append(
            ax.legend(
                handles=patches, loc="upper center", ncols=len(names), bbox_to_anchor=(0.5, 1.0)
            )
        )
    settle_labels(ax)
    return ImageSpace(scene, box, picture, frame, lines, markers, labels)


def _box_around(loops: Sequence[FloatArray], places: FloatArray) -> Box:
    """A box around loops and places (*, 4), without what is near the half turns."""
    at = chart(places)
    at = at[np.isfinite(at).all(axis=-1)]
    high = max(MAX_CHART_HEIGHT, 1.2 * float(np.abs(at[:, 2]).max(initial=0.0)))
    shown = np.concatenate([at, *(chart(loop) for loop in loops), np.zeros((0, 3))])
    with np.errstate(invalid="ignore"):
        shown = shown[np.abs(shown[:, 2]) <= high]
    return Box.around(shown if len(shown) else np.zeros((1, 3)))


def _curve(ax: Axes, scene: Scene, seen: FloatArray) -> list[Line2D]:
    """A loop (n, 3), as the eye has it, in pieces: thick where it is seen, dashed where covered."""
    inside = np.atleast_1d((np.abs(seen) <= scene.half * (1 + 1e-9)).all(axis=-1))
    seen = np.where(inside[:, None], seen, 0.0)
    xy = scene.camera.project(seen)[:, :2]
    state = np.where(covered(scene, seen) > 0, 1, 0) if scene.surfaces else np.zeros(len(seen), int)
    state = np.where(inside, state, 2)
    out = []
    cuts = np.flatnonzero(np.diff(state)) + 1
    for start, end in zip([0, *cuts], [*cuts, len(state)], strict=True):
        if state[start] == 2:
            continue
        piece = xy[start : min(end + 1, len(xy))]
        if end < len(xy) and state[end] == 2:
            piece = xy[start:end]
        if state[start] == 0:
            (line,) = ax.plot(
                *piece.T,
                color=BLACK,
                lw=1.9,
                zorder=6,
                solid_capstyle="round",
                path_effects=[withStroke(linewidth=3.4, foreground="white")],
            )
        else:
            (line,) = ax.plot(*piece.T, color=BLACK, lw=1.1, ls=(0, (3, 2)), zorder=5)
        out.append(line)
    return out


def _points(
    ax: Axes, scene: Scene, seen: FloatArray, numbers: bool
) -> tuple[list[Line2D], list[Annotation]]:
    """Markers at points (n, 3), filled where they are seen and hollow where covered."""
    numbered = np.flatnonzero((np.abs(seen) <= scene.half).all(axis=-1))
    if not numbered.size:
        return [], []
    seen = seen[numbered]
    flat = scene.camera.project(seen)
    slack = MARKER_SIZE * flat[:, 2] / np.sqrt(scene.camera.ahead @ scene.camera.ahead)
    layers = covered(scene, seen, slack) if scene.surfaces else np.zeros(len(seen), dtype=np.intp)
    behind = np.atleast_1d(layers > 0)
    out = []
    for hidden, face in ((False, "white"), (True, "none")):
        (line,) = ax.plot(
            *flat[np.flatnonzero(behind == hidden), :2].T,
            "o",
            ms=5,
            mfc=face,
            mec=BLACK,
            mew=1.2,
            zorder=7,
            ls="none",
        )
        out.append(line)
    if not numbers:
        return out, []
    middle = flat[:, :2].mean(axis=0)
    return out, [
        label(ax, str(k + 1), at, at - middle) for k, at in zip(numbered, flat[:, :2], strict=True)
    ]
