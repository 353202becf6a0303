"""The pictures of a film of a six-bar.

It goes once round where its driver turns fully, else there and back.  The wanted poses stand as
frames, and the path of the body's origin grows.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Final, NamedTuple, final

import numpy as np
from matplotlib.patches import Circle
from numpy.typing import NDArray

from burmester import plot
from burmester.export.films.film import (
    DPI,
    MARK_COLOUR,
    MARK_POINTS,
    TALLEST,
    Picture,
    there_and_back,
)
from burmester.numerics.arrays import FloatArray
from burmester.plot.six_bar import limits_of
from burmester.plot.style import BLACK, BLUE, GREY, with_unit
from burmester.progress import step

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from burmester.sixbar.found import FoundSixBar

__all__ = ["SixBarScene"]

MARGIN: Final = (0.62, 0.14, 0.48, 0.34)  # inches left, right, below and above the axes
FLATTEST: Final = 0.5  # the height of a picture at least, in shares of its width
ROOM: Final = 0.06  # of the size of what moves: around it


class Stage(NamedTuple):
    """Axes whose limits stay, with what stands still."""

    figure: Figure
    ax: Axes


@final
class SixBarScene:
    """A film of a six-bar, to be drawn; see `film.Scene`."""

    def __init__(self, chosen: FoundSixBar, width: int, count: int) -> None:
        self.chosen = chosen
        self.width = width
        self.count = count

    @cached_property
    def drives(self) -> FloatArray:
        """The driver's angle in each picture (count,)."""
        found = self.chosen
        start, end = float(found.drive[0]), float(found.drive[-1])
        if found.turns_fully:
            way = math.copysign(2 * math.pi, end - start)
            return start + way * np.arange(self.count) / self.count
        low, high = found.drive_range
        start, end = (low, high) if end > start else (high, low)
        return start + (end - start) * there_and_back(self.count)

    @cached_property
    def followed(self) -> FloatArray:
        """The moving pivot (count, 2) of the driver in each picture, which is marked."""
        found = self.chosen
        return found.joints(self.drives)["C" if found.driver == "first" else "D"]

    def pictures(self) -> Iterator[Picture]:
        """The pictures (rows, columns, 3), all of one size."""
        found = self.chosen
        path = found.body(self.drives).translation
        there = np.abs(self.drives - self.drives[0])
        grown = np.minimum(np.arange(1, self.count + 1), there.argmax() + 1)
        with plot.house_style():
            figure, ax = self._stage()
            canvas = figure.canvas
            under = canvas.copy_from_bbox(figure.bbox)  # type: ignore[attr-defined]
            (line,) = ax.plot([], [], color=BLUE, lw=2.0, zorder=1.9)
            # No marker: those are drawn at whole pixels, and would tremble.
            unit = 1 / float(ax.transData.get_matrix()[0, 0])
            mark = Circle(
                (0, 0),
                MARK_POINTS / 2 * DPI / 72 * unit,
                fc=MARK_COLOUR,
                ec=BLACK,
                lw=1.2,
                zorder=10,
            )
            ax.add_patch(mark)
            told = ax.text(1, 1, "", transform=ax.transAxes, ha="right", va="bottom", fontsize=9)
            standing = set(ax.get_children()) - {line, mark, told}
            for number, drive in enumerate(self.drives.tolist()):
                step(f"drawing picture {number + 1} of {self.count}")
                plot.six_bar(ax, found, drive)
                line.set_data(*path[: grown[number]].T)
                mark.set_center(tuple(self.followed[number].tolist()))
                told.set_text(f"driver {math.degrees(drive) % 360:5.1f}°")
                moving = [each for each in ax.get_children() if each not in standing]
                canvas.restore_region(under)  # type: ignore[attr-defined]
                for artist in sorted(moving, key=lambda each: each.get_zorder()):
                    ax.draw_artist(artist)
                yield np.asarray(canvas.buffer_rgba())[..., :3].copy()  # type: ignore[attr-defined]
                for artist in moving:
                    if artist not in (line, mark, told):
                        artist.remove()

    def marks(self, numbers: NDArray[np.intp]) -> tuple[tuple[int, int], FloatArray]:
        """The size of pictures, and where in some of them the mark is; see `film.Scene`."""
        figure, ax = self._stage()
        wanted = np.asarray(ax.transData.transform(self.followed[numbers]))
        return figure.canvas.get_width_height(), wanted

    def _stage(self) -> Stage:
        """Axes that hold the whole motion, with the path and the poses, drawn once."""
        found, task = self.chosen, self.chosen.task
        low, high = limits_of(found, np.append(self.drives, found.drive))
        low = np.minimum(low, task.poses.translation.min(axis=0))
        high = np.maximum(high, task.poses.translation.max(axis=0))
        (x, y), (across, up) = (low + high) / 2, (high - low) * (1 + 2 * ROOM)
        beside, above = MARGIN[0] + MARGIN[1], MARGIN[2] + MARGIN[3]
        height = ((self.width / DPI - beside) * up / max(across, 1e-9 * up) + above) * DPI
        height = min(max(height, FLATTEST * self.width), TALLEST * self.width)
        w, h = (2 * round(pixels / 2) / DPI for pixels in (self.width, height))  # even in pixels
        half = max(across / (w - beside), up / (h - above)) / 2
        with plot.house_style():
            figure = plot.figure(w, h, DPI)
            ax = figure.add_axes((MARGIN[0] / w, MARGIN[2] / h, 1 - beside / w, 1 - above / h))
            ax.set(
                xlim=(x - half * (w - beside), x + half * (w - beside)),
                ylim=(y - half * (h - above), y + half * (h - above)),
                autoscale_on=False,
            )
            path = found.body(self.drives).translation
            ax.plot(*path.T, color=GREY, lw=0.9, ls=(0, (3, 2)), zorder=1.8)
            plot.poses(ax, task.poses)
            ax.set_xlabel(with_unit("X", task.length_unit), labelpad=1)
            ax.set_ylabel(with_unit("Y", task.length_unit), labelpad=1)
            ax.set_title(f"{self.chosen.id}  six-bar, Watt I", loc="left", fontsize=10, pad=4)
            figure.canvas.draw()
        return Stage(figure, ax)
