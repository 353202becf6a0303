"""The figures of Ge, Zhao, Purwar and Li 2012, made from the numbers that the paper prints.

Figures 1 to 7 are all that the paper has.  Figure 1 is a sketch without numbers, drawn here for a
displacement of our choice; the colours, the point of view and the piece of the image space shown
are ours too, for the paper does not give them.  Figures 5 and 6, one quadric a panel here, need v1
and v2 themselves, which an exact motion leaves free to turn in their plane: taken are those of the
plane computed that are nearest to the ones printed in Table 4 (known misprints put right).  The
linkages of Fig. 2 and Table 8 at the poses of Tables 2 and 5 are no figures of the paper.  No
figure can be made of Tables 1 and 9: the ten poses of Ravani and Roth on which they rest are not
printed.

Source: JCISE 12(4) 041003, doi 10.1115/1.4007447.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
from matplotlib.figure import Figure

from burmester.errors import InputError
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.io.cases import load
from burmester.io.files import atomic_file, require_writable
from burmester.numerics.arrays import FloatArray
from burmester.paper.fit import PaperFit
from burmester.plot.camera import Box
from burmester.plot.charts import pose_errors
from burmester.plot.common_curve import common_curve
from burmester.plot.mechanism import linkage as draw_linkage
from burmester.plot.plane import achieved, coupler_curve, poses, span_of
from burmester.plot.space import image_space
from burmester.plot.style import BLACK, GREY, PALETTE, figure, finish, house_style, label, legend
from burmester.plot.walk import steps, walk, write_gif
from burmester.progress import step

FORMATS: Final = ("png", "svg", "pdf", "gif")
EXACT_BOX: Final = Box(np.array([-2.9, -4.6, -2.6]), np.array([3.1, 1.4, 1.7]), 1.9)
NOISY_BOX: Final = Box(np.array([-2.2, -3.7, -1.5]), np.array([2.2, 0.7, 1.5]), 1.9)
FIGURE5: Final = (90.0, 80.21, 70.73, 60.00)  # theta in degrees, as in the captions
FIGURE6: Final = (0.0, -36.87, -42.84, -48.60)
DRAWN_POSE: Final = 2  # index of the pose at which linkages are drawn
_METADATA: Final[dict[str, dict[str, Any]]] = {
    "png": {"Software": None},
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None},
}


def write_figures(
    folder: str | os.PathLike[str],
    formats: Sequence[str] = ("png", "svg", "pdf"),
    force: bool = False,
) -> list[Path]:
    """Write the figures of the paper into a folder, which is created if necessary.

    The same call writes the same bytes.

    Parameters
    ----------
    folder : str or path
        The folder.
    formats : sequence of str
        Of "png", "svg" and "pdf"; with "gif" also the walk of theta as an animation.
    force : bool
        Replace files that exist.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        E140 (a file exists, without `force`) and E141 (a file cannot be written), before anything
        is drawn where that can be known.
    ValueError
        For an unknown format.

    Examples
    --------
    >>> from burmester import plot
    >>> plot.write_figures("figures", formats=["png"])  # doctest: +SKIP
    [PosixPath('figures/figure-1.png'), ...]
    """
    if unknown := [each for each in formats if each not in FORMATS]:
        raise ValueError(f"no such format: {unknown[0]!r}; there are {', '.join(FORMATS)}")
    room = Path(folder)
    try:
        room.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            "E141",
            f"the folder {room} cannot be made",
            why=error.strerror,
            help="give the name of a folder that is there, or can be made",
        ) from None
    files = [(name, kind) for name in NAMES for kind in formats if kind != "gif"]
    paths = [room / f"{name}.{kind}" for name, kind in files]
    moving = room / "walk.gif"
    for path in [*paths, *([moving] if "gif" in formats else [])]:
        require_writable(path, force=force)
    done = list[Path]()
    with house_style():
        for name in NAMES if paths else ():
            step(f"drawing {name}")
            drawing = paper_figure(name)
            for path in (p for p in paths if p.stem == name):
                kind = path.suffix[1:]
                with atomic_file(path, force=force) as temporary:
                    drawing.savefig(temporary, format=kind, dpi="figure", metadata=_METADATA[kind])
                done.append(path)
    if "gif" in formats:
        step("drawing the walk")
        fit = _exact()
        basis = _basis(fit)
        end = np.radians(fit.printed["theta_deg"])
        pictures = walk(
            basis,
            steps([0.0, np.pi / 2], end),
            poses=fit.poses[0],
            box=EXACT_BOX,
            curve=common_curve(*fit.p[0]),
        )
        write_gif(moving, pictures, force=force)
        done.append(moving)
    return done


def paper_figure(name: str) -> Figure:
    """One figure by its name, one of `NAMES`; to be made and saved within `style.house_style`."""
    return _FIGURES[name]()


def _exact() -> PaperFit:
    return PaperFit.of(load("ge2012-exact"), "Table 4", "singular_vectors_table4", 0, 0)


def _noisy() -> PaperFit:
    return PaperFit.of(load("ge2012-approximate"), "Table 7", "singular_vectors_table7", 0, 0)


def _basis(fit: PaperFit) -> FloatArray:
    """v1 and v2 (2, 8): of the plane computed, the orthonormal pair nearest to the print."""
    left, _, right = np.linalg.svd(fit.vectors @ fit.plane[0].T)
    return np.asarray(left @ right @ fit.plane[0])


def _linkage(rows: list[dict[str, Any]]) -> Linkage:
    """A linkage as the paper prints it."""
    first, second = (RR(r["fixed_pivot"], r["moving_pivot"], r["radius"]) for r in rows)
    return Linkage(first, second)


def _figure1() -> Figure:
    drawing = figure(4.4, 3.375, 200)
    ax = drawing.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    at = Displacement(np.array([1.9, 1.1]), np.radians(35.0))
    for place, name, color in ((Displacement.identity(), "F", BLACK), (at, "M", PALETTE[0])):
        tips = place.act(np.array([[1.1, 0.0], [0.0, 1.1]]))
        for tip, letter in zip(tips, ("X", "Y") if name == "F" else ("x", "y"), strict=True):
            ax.annotate(
                "",
                (float(tip[0]), float(tip[1])),
                (float(place.translation[0]), float(place.translation[1])),
                arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.6},
            )
            label(ax, f"${letter}$", tip, tip - place.translation, fontsize=11, color=color)
        corner = place.act(np.array([-0.12, -0.12]))
        label(
            ax, f"${name}$", place.translation, corner - place.translation, fontsize=12, color=color
        )
    d1, d2 = at.translation
    ax.plot([0, d1, d1], [0, 0, d2], color=GREY, lw=1.0, ls=(0, (4, 2)))
    label(ax, "$d_1$", (1.5, 0.0), (0, -1), fontsize=11)
    label(ax, "$d_2$", (d1, d2 / 2), (1, 0), fontsize=11)
    ax.plot([d1, d1 + 1.1], [d2, d2], color=GREY, lw=1.0, ls=(0, (4, 2)))
    arc = np.linspace(0, at.angle, 40)
    ax.plot(d1 + 0.7 * np.cos(arc), d2 + 0.7 * np.sin(arc), color=BLACK, lw=1.0)
    label(ax, r"$\phi$", (d1 + 0.7 * np.cos(0.3), d2 + 0.7 * np.sin(0.3)), (1, 0.3), fontsize=12)
    finish(ax)
    ax.set_xlim(-0.35, 3.3)
    ax.set_ylim(-0.4, 2.4)
    return drawing


def _figure2() -> Figure:
    fit = _exact()
    linkage, place = _linkage(fit.printed["linkage"]), fit.poses[0][DRAWN_POSE]
    drawing = figure(5.0, 6.0, 200)
    ax = drawing.add_axes((0.1, 0.08, 0.87, 0.9))
    coupler_curve(ax, linkage, only=1, size=span_of(fit.poses[0]))
    draw_linkage(ax, linkage, place, names=True)
    poses(ax, Displacement.identity((1,)), size=0.8, names=("F",), color=BLACK)
    poses(ax, place, size=0.8, names=("M",))
    finish(ax)
    return drawing


def _panels(
    fit: PaperFit,
    box: Box,
    size: tuple[float, float, float],
    panels: Sequence[tuple[FloatArray, Sequence[str]]],
    columns: int = 1,
    **more: Any,
) -> Figure:
    """Quadrics (k, 8) with their names, panel beside panel, and the poses and curve of a fit."""
    drawing, rows = figure(*size), len(panels) // columns
    for k, (p, names) in enumerate(panels):
        corner = k % columns / columns, 1 - (k // columns + 1) / rows
        ax = drawing.add_axes((*corner, 1 / columns, 1 / rows))
        curve = common_curve(*fit.p[0])
        image_space(ax, p, poses=fit.poses[0], curve=curve, box=box, names=names, **more)
    return drawing


def _figure3() -> Figure:
    fit = _exact()
    panel = _basis(fit), ("$v_1$: ellipsoid", "$v_2$: two sheets")
    return _panels(fit, EXACT_BOX, (6.4, 5.6, 250), [panel])


def _figure4() -> Figure:
    fit = _exact()
    panel = fit.p[0], (r"$\theta_1 = -43.13°$", r"$\theta_2 = 44.72°$")
    return _panels(fit, EXACT_BOX, (6.4, 5.6, 250), [panel])


def _between(theta: Sequence[float], color: str) -> Figure:
    """Four quadrics of the exact pencil, beside each other."""
    fit = _exact()
    turns = np.stack([np.cos(np.radians(theta)), np.sin(np.radians(theta))], axis=1)
    names = [(rf"$\theta = {degrees:.2f}°$",) for degrees in theta]
    panels = list(zip((turns @ _basis(fit))[:, None], names, strict=True))
    size = (8.0, 7.2, 200)
    return _panels(fit, EXACT_BOX, size, panels, 2, colours=(color,), numbers=False)


def _figure7() -> Figure:
    fit = _noisy()
    panels = [
        (fit.plane[0], ("$v_1$: ellipsoid", "$v_2$: two sheets")),
        (fit.p[0], (r"$\theta_1 = -21.28°$", r"$\theta_2 = 54.08°$")),
    ]
    return _panels(fit, NOISY_BOX, (10.0, 4.6, 200), panels, 2)


def _at_poses(fit: PaperFit, key: str) -> Figure:
    """A linkage at one pose, faintly at the others; over the prescribed poses; its errors."""
    linkage, prescribed = _linkage(fit.printed[key]), fit.poses[0]
    error = PoseError.of(linkage, prescribed, span_of(prescribed))
    drawing = figure(10.0, 5.2, 200)
    left, upper, lower = (
        drawing.add_axes(at)
        for at in ((0.05, 0.09, 0.40, 0.83), (0.52, 0.50, 0.42, 0.42), (0.54, 0.09, 0.38, 0.28))
    )
    coupler_curve(left, linkage, size=span_of(prescribed))
    for k in range(len(prescribed.angle)):
        draw_linkage(left, linkage, error.places[k], faint=k != DRAWN_POSE, names=k == DRAWN_POSE)
    poses(left, prescribed)
    legend(left)
    finish(left)
    upper.set_anchor("W")
    achieved(upper, error.places, prescribed)
    legend(upper)
    finish(upper)
    pose_errors(lower, error)
    return drawing


_FIGURES: Final[dict[str, Callable[[], Figure]]] = {
    "figure-1": _figure1,
    "figure-2": _figure2,
    "figure-3": _figure3,
    "figure-4": _figure4,
    "figure-5": lambda: _between(FIGURE5, PALETTE[1]),
    "figure-6": lambda: _between(FIGURE6, PALETTE[0]),
    "figure-7": _figure7,
    "table-2-linkage": lambda: _at_poses(_exact(), "linkage"),
    "table-8-linkage": lambda: _at_poses(_noisy(), "linkage_table8"),
}
NAMES: Final = tuple(_FIGURES)
