"""A drawing and a film of a six-bar.

E160 what was written is no picture of it        E162 a film or a pose that cannot be drawn
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np
from PIL import Image

from burmester import plot
from burmester.errors import InputError
from burmester.export.films.film import DPI, Picture, require_film
from burmester.export.options import Options
from burmester.export.reference import require_equal
from burmester.io.saved_six_bars import SavedSixBar
from burmester.numerics.arrays import FloatArray
from burmester.plot.six_bar import JOINTS_ID, limits_of
from burmester.plot.style import BLUE
from burmester.progress import step
from burmester.sixbar.watt import JOINTS

__all__ = ["check_gif", "check_svg", "write_gif", "write_svg"]

INCHES: Final = 6.4  # the width of a drawing
MOST_RATE: Final = 25.0  # pictures a second of a GIF


def write_svg(chosen: SavedSixBar, path: Path, options: Options) -> None:
    """The six-bar at a pose, faintly at the others, with the path of the body."""
    count = len(chosen.found.drive)
    if not 1 <= options.pose <= count:
        raise InputError(
            "E162",
            f"there is no pose {options.pose}",
            why=f"this task has {count}",
            help="give --pose 1",
        )
    with plot.house_style():
        drawn = plot.six_bar_figure(chosen.found, chosen.task, options.pose - 1, INCHES)
        drawn.savefig(path, format="svg", metadata={"Date": None})


def check_svg(chosen: SavedSixBar, path: Path, options: Options) -> None:
    """Whether the drawing has all joints."""
    groups = [each for each in ET.parse(path).iter() if each.get("id") == JOINTS_ID]
    marks = [mark for group in groups for mark in group.iter() if mark.tag.endswith("}use")]
    require_equal("the number of joints drawn", len(marks), len(JOINTS), 0)


def write_gif(chosen: SavedSixBar, path: Path, options: Options) -> None:
    """A film: once round where the driver turns fully, else there and back."""
    rate = min(options.frames_per_second, MOST_RATE)
    count = require_film(options, rate, kept=True)
    plot.write_gif(path, _pictures(chosen, count, options.width_px), seconds=1 / rate, force=True)


def _drives(chosen: SavedSixBar, count: int) -> FloatArray:
    """The driver's angle in each picture."""
    found, share = chosen.found, np.arange(count) / count
    if found.turns_fully:
        way = 1 if found.drive[-1] > found.drive[0] else -1
        return np.asarray(found.drive[0] + way * 2 * np.pi * share)
    low, high = found.drive_range
    start, end = (low, high) if found.drive[-1] > found.drive[0] else (high, low)
    return np.asarray(start + (end - start) * (1 - np.cos(2 * np.pi * share)) / 2)


def _pictures(chosen: SavedSixBar, count: int, width: int) -> Iterator[Picture]:
    """The pictures (rows, columns, 3) of a film; the camera stands still."""
    drives = _drives(chosen, count)
    low, high = limits_of(chosen.found, np.append(drives, chosen.found.drive))
    middle, half = (low + high) / 2, 0.56 * float((high - low).max())
    path = chosen.found.body(drives).translation
    with plot.house_style():
        for k, drive in enumerate(drives.tolist()):
            step(f"drawing picture {k + 1} of {count}")
            drawn = plot.figure(width / DPI, width / DPI, DPI)
            ax = drawn.add_axes((0.1, 0.08, 0.88, 0.87))
            plot.poses(ax, chosen.task.poses)
            ax.plot(*path[: k + 1].T, color=BLUE, lw=1.6, zorder=1.9)
            plot.six_bar(ax, chosen.found, drive)
            ax.set_aspect("equal")
            ax.set(
                xlim=(middle[0] - half, middle[0] + half),
                ylim=(middle[1] - half, middle[1] + half),
            )
            ax.set_title(f"{chosen.id}  six-bar, Watt I", loc="left", fontsize=10)
            drawn.canvas.draw()
            yield np.asarray(drawn.canvas.buffer_rgba())[..., :3].copy()  # type: ignore[attr-defined]


def check_gif(chosen: SavedSixBar, path: Path, options: Options) -> None:
    """Whether the film has a width and moves."""
    with Image.open(path) as film:
        require_equal("the width", film.width, options.width_px, 1)
        require_equal("whether it moves", getattr(film, "n_frames", 1) > 1, True, 0)
