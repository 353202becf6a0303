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
from matplotlib.text import Annotation, Text
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike, NDArray

from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.camera import Box, Camera, chart
from burmester.plot.common_curve import common_curve
from burmester.plot.raycast import Extent, Scene, Surface, cast, render
from burmester.plot.style import BLACK, GREY, PALETTE, label, settle_labels, with_unit

ON_SURFACE = 1e-6  # in t: a surface does not cover a curve that is nearer to it
MARKER_SIZE = 0.02  # of the box: half the size of an image point's marker
RINGS = 9  # lines of equal height on a surface as high as the box
MAX_CHART_HEIGHT = 3.0  # Z3/Z4 (at 143 degrees); the box does not include what is higher
NUMBER_MARGIN = 0.17  # of the box: space around it for its numbers


NUMBER, NAME = 11.0, 27.0  # points from the box to the numbers and names beside it


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


def box_axes(ax: Axes, box: Box, camera: Camera, unit: str | None) -> list[Artist]:
    """The box: its edges, a grid on the sides behind, numbers and names along three edges."""
    half, out = box.half, list[Artist]()
    # A side faces the eye if the eye is beyond it.
    facing = {(i, s): bool(s * camera.eye[i] > half[i]) for i in range(3) for s in (-1, 1)}

    def flat(*points: FloatArray) -> FloatArray:
        return camera.project(np.stack(points))[:, :2]

    def line(a: FloatArray, b: FloatArray, **style: object) -> None:
        out.extend(ax.plot(*flat(a, b).T, **style))  # type: ignore[arg-type]

    middle = camera.project(np.zeros((1, 3)))[0, :2]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        values = np.array(MaxNLocator(5, steps=[1, 2, 5, 10]).tick_values(box.low[i], box.high[i]))
        values = values[(values >= box.low[i]) & (values <= box.high[i])]
        step = (values - (box.low[i] + box.high[i]) / 2) * box.scale[i]
        outline = []
        for sj, sk in product((-1, 1), repeat=2):
            end = np.zeros((2, 3))
            end[:, i], end[:, j], end[:, k] = [-half[i], half[i]], sj * half[j], sk * half[k]
            front = facing[j, sj] + facing[k, sk]
            style = {"color": GREY, "lw": 0.6, "zorder": 3 if front == 2 else 1}
            line(end[0], end[1], **style)
            if front == 1:
                outline.append(end)
        for a, sa, b in ((j, -1, k), (j, 1, k), (k, -1, j), (k, 1, j)):
            if facing[a, sa]:
                continue
            for at in step:
                ends = np.zeros((2, 3))
                ends[:, i], ends[:, a], ends[:, b] = at, sa * half[a], [-half[b], half[b]]
                line(ends[0], ends[1], color="#d5dae0", lw=0.5, zorder=0)
        if not outline:  # seen end on
            continue
        # Numbers stand along an edge of the outline: the lowest, or for Z3 the leftmost.
        by = [flat(*end).mean(axis=0)[0 if i == 2 else 1] for end in outline]
        edge = outline[int(np.argmin(by))]
        ends = flat(*edge)
        along = (ends[1] - ends[0]) / np.hypot(*(ends[1] - ends[0]))
        normal = np.array([-along[1], along[0]])
        normal *= np.sign(normal @ (ends.mean(axis=0) - middle))
        size = max(np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim()))
        power = _power(values)
        values = values / 10.0**power
        digits = max(0, -int(np.floor(np.log10(np.diff(values)[0])))) if len(values) > 1 else 1
        for value, at in zip(values, step, strict=True):
            point = edge[0].copy()
            point[i] = at
            foot = flat(point)[0]
            tick = np.stack([foot, foot + 0.012 * size * normal])
            out.extend(ax.plot(*tick.T, color=BLACK, lw=0.7, zorder=3))
            out.append(
                _text(
                    ax,
                    f"{value:.{digits}f}".replace("-", "\N{MINUS SIGN}"),
                    foot,
                    NUMBER * normal,
                    fontsize=7,
                )
            )
        turn = np.degrees(np.arctan2(along[1], along[0]))
        turn = (turn + 60) % 180 - 60  # a name along a steep edge is read upwards
        unit_here = None if i == 2 else unit
        if power:
            unit_here = f"$10^{{{power}}}$ {unit_here or ''}".strip()
        name = with_unit(f"$Z_{i + 1}\\,/\\,Z_4$", unit_here)
        out.append(
            _text(ax, name, ends.mean(axis=0), NAME * normal, fontsize=9, rotation=float(turn))
        )
    return out


def _power(values: FloatArray) -> int:
    """The power of ten that numbers are better written without; 0 for ordinary ones."""
    greatest = float(np.abs(values).max(initial=0.0))
    power = int(np.floor(np.log10(greatest))) if greatest > 0 else 0
    return 0 if -3 <= power <= 3 else power


def _text(ax: Axes, text: str, at: FloatArray, away: FloatArray, **style: object) -> Text:
    """A number or a name beside the box, so many points away from a place on its edge."""
    return ax.annotate(
        text,
        (float(at[0]), float(at[1])),
        xytext=(float(away[0]), float(away[1])),
        textcoords="offset points",
        ha="center",
        va="center",
        color=BLACK,
        zorder=3,
        annotation_clip=False,
        **style,  # type: ignore[arg-type]
    )
