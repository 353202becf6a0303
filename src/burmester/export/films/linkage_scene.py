"""The pictures of a film of a four-bar: what stands still is drawn once, what moves each time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final, NamedTuple, final

import numpy as np
from matplotlib.artist import Artist
from matplotlib.patches import Circle
from numpy.typing import NDArray

from burmester import plot
from burmester.export.films.film import DPI, MARK_COLOUR, MARK_POINTS, TALLEST, Film, Picture
from burmester.numerics.arrays import FloatArray
from burmester.plot.plane import X_AXIS_LENGTH, span_of
from burmester.plot.style import BLACK, BLUE, GREY, VERMILION, plain, settle_labels, with_unit
from burmester.progress import step

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["LinkageScene"]

FITTED_PLACES: Final = 25  # places whose drawing has to fit into the picture
MARGIN: Final = (0.62, 0.12, 0.48, 0.34)  # inches left, right, below and above the axes
TALL, FLAT = TALLEST, 0.5  # the height of a picture at most and at least, in shares of its width
MAX_SHOWN_POSES: Final = 60  # more of them hide the linkage, and their numbers each other


class Stage(NamedTuple):
    """Axes whose limits stay, the background without what moves, and what lies over it."""

    figure: Figure
    ax: Axes
    over: list[Artist]


@final
class LinkageScene:
    """A film of a four-bar, to be drawn; see `film.Scene`."""

    def __init__(self, film: Film) -> None:
        self.film = film
        self.count = film.count

    def pictures(self) -> Iterator[Picture]:
        """The pictures (rows, columns, 3), all of one size."""
        return _pictures(self.film)

    def marks(self, numbers: NDArray[np.intp]) -> tuple[tuple[int, int], FloatArray]:
        """The size of pictures, and where in some of them the mark is; see `film.Scene`."""
        stage = _stage(self.film)
        wanted = stage.ax.transData.transform(self.film.followed(numbers))
        return stage.figure.canvas.get_width_height(), np.asarray(wanted)


def _pictures(film: Film) -> Iterator[Picture]:
    """The pictures (rows, columns, 3) of a film."""
    motion, along = film.motion, (film.motion.places,)
    long = X_AXIS_LENGTH * span_of(film.chosen.task.poses)
    body = np.array([[long, 0.0], [0.0, 0.0], [0.0, 0.6 * long]])
    path = motion.places.translation
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
            place = motion.places[number]
            step(f"drawing picture {number + 1} of {film.count}")
            drawn = plot.linkage(ax, film.linkage, place, travel=along)
            own = [*drawn.links, drawn.coupler, *drawn.ground]
            own += [drawn.fixed_pivots, drawn.moving_pivots]
            if film.outline is not None:
                own += plot.body(ax, film.outline, place[None], at=0).places
            grown.set_data(*path[: film.grown[number]].T)
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
    chosen = film.chosen
    if chosen.task.surroundings is not None:
        plot.keep_out(ax, chosen.task.surroundings.keep_out)
    if film.outline is not None:
        plot.body(ax, film.outline, chosen.error.places[shown])


def _stage(film: Film) -> Stage:
    """Axes that hold the whole motion, with the path, the poses and a title, drawn once."""
    task, motion, linkage = film.chosen.task, film.motion, film.linkage
    shown = _shown_poses(task.poses.translation)
    with plot.house_style():
        # First all that is ever drawn, to see how large it is.
        trial = plot.figure(film.width / DPI, film.width / DPI, DPI)
        ax = trial.add_subplot()
        some = np.unique(np.linspace(0, film.count - 1, FITTED_PLACES).astype(np.intp))
        plot.poses(ax, task.poses[shown], numbers=False, free=task.free_angles[shown])
        for number in some:
            plot.linkage(ax, linkage, motion.places[number], travel=(motion.places,))
        if film.outline is not None:
            plot.body(ax, film.outline, motion.places[some])
        _background(film, shown, ax)
        plot.finish(ax, film.chosen.unit, room=0.04)
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
        curve = plot.coupler_curve(ax, linkage, only=motion.number)
        for line in [each for lines in curve.circuits for each in lines]:
            line.set(color=GREY, lw=0.9, linestyle=(0, (3, 2)))
        for cross in curve.dead_points:
            cross.remove()
        _background(film, shown, ax)
        over = list[Artist]()
        long = X_AXIS_LENGTH * span_of(task.poses)
        for color, reached in ((VERMILION, True), (GREY, False)):
            numbers = shown[np.isfinite(motion.pose_shares[shown]) == reached]
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
        ax.set_xlabel(with_unit("X", film.chosen.unit), labelpad=1)
        ax.set_ylabel(with_unit("Y", film.chosen.unit), labelpad=1)
        title = plain(f"{film.chosen.id}  {film.chosen.type}")
        ax.set_title(title, loc="left", fontsize=10, pad=4)
        settle_labels(ax)
        for artist in over:
            artist.set_animated(True)
        figure.canvas.draw()
    return Stage(figure, ax, over)
