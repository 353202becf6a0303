"""The pictures of a film: what stands still is drawn once, what moves each time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon
from numpy.typing import NDArray

from burmester import plot
from burmester.export.films.film import DPI, MARK_COLOUR, MARK_POINTS, TALLEST, Film, Picture
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.plane import X_AXIS_LENGTH, span_of
from burmester.plot.style import BLACK, BLUE, GREY, VERMILION, plain, settle_labels, with_unit
from burmester.progress import step

FITTED_PLACES: Final = 25  # places whose drawing has to fit into the picture
MARGIN: Final = (0.62, 0.12, 0.48, 0.34)  # inches left, right, below and above the axes
TALL, FLAT = TALLEST, 0.5  # the height of a picture at most and at least, in shares of its width
MAX_SHOWN_POSES: Final = 60  # more of them hide the linkage, and their numbers each other


class Stage(NamedTuple):
    """Axes whose limits stay, the background without what moves, and what lies over it."""

    figure: Figure
    ax: Axes
    over: list[Artist]


def marks(film: Film, numbers: NDArray[np.intp]) -> tuple[tuple[int, int], FloatArray]:
    """The width and height of pictures, and where the mark is in those of some numbers.

    (n, 2), pixels to the right and upwards from the lower left corner.
    """
    stage = _stage(film)
    wanted = stage.ax.transData.transform(film.followed(numbers))
    return stage.figure.canvas.get_width_height(), np.asarray(wanted)


def pictures(film: Film) -> Iterator[Picture]:
    """The pictures (rows, columns, 3) of a film, all of one size."""
    places = film.motion.places
    long = X_AXIS_LENGTH * span_of(film.task.poses)
    body = np.array([[long, 0.0], [0.0, 0.0], [0.0, 0.6 * long]])
    path, many = places.translation, film.grown
    pivot = film.followed(np.arange(film.count))
    with plot.house_style():
        stage = _stage(film)
        ax, canvas = stage.ax, stage.figure.canvas
        under = canvas.copy_from_bbox(stage.figure.bbox)  # type: ignore[attr-defined]
        (grown,) = ax.plot([], [], color=BLUE, lw=2.4, zorder=3.0)
        (frame,) = ax.plot([], [], color=BLACK, lw=1.6, zorder=5.5, solid_joinstyle="round")
        # No marker: those are drawn at whole pixels, and would tremble.
        unit = 1 / float(ax.transData.get_matrix()[0, 0])
        mark = Circle(
            (0, 0), MARK_POINTS / 2 * DPI / 72 * unit, fc=MARK_COLOUR, ec=BLACK, lw=1.2, zorder=10
        )
        ax.add_patch(mark)
        drive = ax.text(1.0, 1.0, "", transform=ax.transAxes, ha="right", va="bottom", fontsize=9)
        for number in range(film.count):
            place = places[number]
            step(f"drawing picture {number + 1} of {film.count}")
            own = plot.draw(ax, film.scene(number)).artists
            own += _body(film, ax, place[None], at=0)
            grown.set_data(*path[: many[number]].T)
            frame.set_data(*place.act(body).T)
            mark.set_center(tuple(pivot[number].tolist()))
            drive.set_text(film.drive_text(number))
            every = [*own, grown, frame, mark, drive, *stage.over]
            canvas.restore_region(under)  # type: ignore[attr-defined]
            for artist in sorted(every, key=lambda each: each.get_zorder()):
                ax.draw_artist(artist)
            yield np.asarray(canvas.buffer_rgba())[..., :3].copy()  # type: ignore[attr-defined]
            for artist in own:
                artist.remove()


def _shown_poses(points: FloatArray) -> NDArray[np.intp]:
    """The numbers of the poses that are drawn: some of very many, the outermost among them."""
    if len(points) <= MAX_SHOWN_POSES:
        return np.arange(len(points))
    some = np.linspace(0, len(points) - 1, MAX_SHOWN_POSES - 4).astype(np.intp)
    return np.unique(np.concatenate([some, points.argmin(axis=0), points.argmax(axis=0)]))


def _background(film: Film, shown: NDArray[np.intp], ax: Axes) -> None:
    """Draw the regions to keep out of, and the body faintly where it is at some of the poses."""
    if film.task.surroundings is not None:
        plot.keep_out(ax, film.task.surroundings.keep_out)
    _body(film, ax, film.chosen.error.places[shown])


def _body(film: Film, ax: Axes, places: Displacement, at: int | None = None) -> list[Polygon]:
    """Draw the outline of the body at places, if the task has one."""
    body = film.task.body
    return [] if body is None else plot.body(ax, body.vertices, places, at=at).places


def _stage(film: Film) -> Stage:
    """Axes that hold the whole motion, with the path, the poses and a title, drawn once."""
    task = film.task
    shown = _shown_poses(task.poses.translation)
    with plot.house_style():
        # First all that is ever drawn, to see how large it is.
        trial = plot.figure(film.width / DPI, film.width / DPI, DPI)
        ax = trial.add_subplot()
        some = np.unique(np.linspace(0, film.count - 1, FITTED_PLACES).astype(np.intp))
        plot.poses(ax, task.poses[shown], numbers=False, free=task.free_angles[shown])
        for number in some:
            plot.draw(ax, film.scene(int(number)))
        _body(film, ax, film.motion.places[some])
        _background(film, shown, ax)
        plot.finish(ax, task.length_unit, room=0.04)
        (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()

        beside, above = MARGIN[0] + MARGIN[1], MARGIN[2] + MARGIN[3]
        height = (film.width / DPI - beside) * (high - low) / (right - left) + above
        height = min(max(height * DPI, FLAT * film.width), TALL * film.width)
        w, h = (2 * round(pixels / 2) / DPI for pixels in (film.width, height))  # even in pixels
        figure = plot.figure(w, h, DPI)
        ax = figure.add_axes((MARGIN[0] / w, MARGIN[2] / h, 1 - beside / w, 1 - above / h))
        half = max((right - left) / (w - beside), (high - low) / (h - above)) / 2
        x, y = (left + right) / 2, (low + high) / 2
        ax.set(
            xlim=(x - half * (w - beside), x + half * (w - beside)),
            ylim=(y - half * (h - above), y + half * (h - above)),
            autoscale_on=False,
        )
        for line in plot.path(ax, film.chosen):
            line.set(color=GREY, lw=0.9, linestyle=(0, (3, 2)))
        _background(film, shown, ax)
        over = list[Artist]()
        long = X_AXIS_LENGTH * span_of(task.poses)
        for color, reached in ((VERMILION, True), (GREY, False)):
            numbers = shown[np.isfinite(film.motion.pose_shares[shown]) == reached]
            if len(numbers):
                names = [str(k + 1) for k in numbers]
                wanted = plot.poses(
                    ax,
                    task.poses[numbers],
                    size=long,
                    names=names,
                    color=color,
                    free=task.free_angles[numbers],
                )
                over += [wanted.x_axes, wanted.y_axes, wanted.origins, *wanted.labels]
        ax.set_xlabel(with_unit("X", task.length_unit), labelpad=1)
        ax.set_ylabel(with_unit("Y", task.length_unit), labelpad=1)
        title = plain(f"{film.chosen.id}  {film.chosen.type}")
        ax.set_title(title, loc="left", fontsize=10, pad=4)
        settle_labels(ax)
        for artist in over:
            artist.set_animated(True)
        figure.canvas.draw()
    return Stage(figure, ax, over)
