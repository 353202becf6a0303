"""Films of a linkage that moves through the poses: GIF and MP4.

The camera stands still and both axes have one scale.  A driver that turns fully goes round once;
any other goes from the first pose to the last and back.  The wanted poses stand as frames, the
body's own frame moves with it, and the path of its origin grows.  The body's outline moves, too,
and stands faintly at the poses; regions to keep out of are hatched.

E160 what was written shows another motion        E162 a film that cannot be drawn
"""

from __future__ import annotations

import math
import re
import subprocess
from collections.abc import Iterator
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon
from numpy.typing import NDArray
from PIL import Image

from burmester import plot
from burmester.export.films.film import (
    DPI,
    MARK_COLOUR,
    MARK_POINTS,
    TALLEST,
    Film,
    Picture,
    blob,
    looks_of,
    require_film,
)
from burmester.export.options import Options, fault
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray
from burmester.plot.plane import X_AXIS_LENGTH, span_of
from burmester.plot.style import BLACK, BLUE, GREY, VERMILION, plain, settle_labels, with_unit
from burmester.progress import step
from burmester.synthesis.result import Candidate

MAX_GIF_RATE: Final = 25.0  # pictures a second; more would only make the file larger
# MP4 whatever the file is called; one thread and no version in it, so that the same film has the
# same bytes.
OUTPUT: Final = (
    "-f mp4 -crf 16 -preset medium -threads 1 -movflags +faststart "
    "-fflags +bitexact -flags:v +bitexact -map_metadata -1"
)
MAX_MARK_ERROR: Final = 1.5  # pixels: largest deviation of the mark read back
_off = partial(
    fault, message="what was written does not show the linkage's motion, so nothing was kept"
)


FITTED_PLACES: Final = 25  # places whose drawing has to fit into the picture
MARGIN: Final = (0.62, 0.12, 0.48, 0.34)  # inches left, right, below and above the axes
TALL, FLAT = TALLEST, 0.5  # the height of a picture at most and at least, in shares of its width
MAX_SHOWN_POSES: Final = 60  # more of them hide the linkage, and their numbers each other


def write_gif(chosen: Candidate, path: Path, options: Options) -> None:
    """Write a film as an endless GIF of 25 pictures a second or fewer."""
    film, rate = _gif(chosen, options)
    plot.write_gif(path, pictures(film), seconds=1 / rate, force=True)


def write_mp4(chosen: Candidate, path: Path, options: Options) -> None:
    """Write a film as an MP4 that every player shows: H.264, yuv420p, made to begin at once."""
    ffmpeg: Any = import_module("imageio_ffmpeg")
    drawn = pictures(_mp4(chosen, options))
    first = next(drawn)
    writer = ffmpeg.write_frames(
        str(path),
        (first.shape[1], first.shape[0]),
        fps=options.frames_per_second,
        codec="libx264",
        quality=None,
        macro_block_size=2,
        ffmpeg_log_level="quiet",  # it would write to the user's screen; the file is checked
        output_params=OUTPUT.split(),
    )
    writer.send(None)
    try:
        writer.send(np.ascontiguousarray(first))
        for picture in drawn:
            writer.send(np.ascontiguousarray(picture))
    finally:
        writer.close()


def check_gif(chosen: Candidate, path: Path, options: Options) -> None:
    """Read a GIF back with Pillow; raises E160 unless it shows this linkage's motion."""
    film, rate = _gif(chosen, options)
    with Image.open(path) as image:
        times, shown = [], []
        for number in range(getattr(image, "n_frames", 1)):
            image.seek(number)
            times.append(image.info.get("duration", 0) / 1000)
            shown.append(np.asarray(image.convert("RGB")))
        endless = image.info.get("loop") == 0
    ends = np.cumsum(times)
    if not endless:
        raise _off("it is shown once, not again and again")
    if abs(ends[-1] - film.count / rate) > 1e-6:
        raise _off(f"it lasts {ends[-1]:g} s, not {film.count / rate:g} s")
    looks = looks_of(film.count)
    at = np.searchsorted(ends, (looks + 0.5) / rate)
    _compare(film, looks, [shown[k] for k in at])


def check_mp4(chosen: Candidate, path: Path, options: Options) -> None:
    """Read an MP4 back with ffmpeg; raises E160 unless it shows this linkage's motion."""
    film = _mp4(chosen, options)
    program = import_module("imageio_ffmpeg").get_ffmpeg_exe()
    report = subprocess.run(
        [program, "-hide_banner", "-i", str(path)], capture_output=True, check=False
    ).stderr.decode(errors="replace")
    video = next((line for line in report.splitlines() if "Video:" in line), "")
    size = re.search(r", (\d+)x(\d+)", video)
    rate = re.search(r", ([\d.]+) fps", video)
    if size is None or rate is None or "h264" not in video or "yuv420p" not in video:
        raise _off(f"it is no film that every player shows: {video.strip() or 'no picture'}")
    width, height = int(size[1]), int(size[2])
    looks, kept, count = looks_of(film.count), list[Picture](), 0
    arguments = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-fps_mode", "passthrough", "-"]
    with subprocess.Popen(
        [program, "-v", "error", "-i", str(path), *arguments], stdout=subprocess.PIPE
    ) as reader:
        assert reader.stdout is not None
        while len(data := reader.stdout.read(3 * width * height)) == 3 * width * height:
            if count in looks:
                kept.append(np.frombuffer(data, dtype=np.uint8).reshape(height, width, 3))
            count += 1
    if count != film.count or abs(float(rate[1]) - options.frames_per_second) > 0.01:
        raise _off(f"it has {count} pictures at {rate[1]} a second, not {film.count}")
    _compare(film, looks, kept)


def _gif(chosen: Candidate, options: Options) -> tuple[Film, float]:
    """What is drawn, and its rate: a GIF counts in hundredths of a second."""
    most = min(MAX_GIF_RATE, options.frames_per_second)
    rate = 100 / math.ceil(100 / most - 1e-9) if most > 0 else most
    return Film(chosen, options.width_px, require_film(options, rate, kept=True)), rate


def _mp4(chosen: Candidate, options: Options) -> Film:
    rate = options.frames_per_second
    return Film(chosen, options.width_px, require_film(options, rate, kept=False))


def _compare(film: Film, looks: NDArray[np.intp], shown: list[Picture]) -> None:
    """Raise E160 unless the followed pivot is in the pictures where the linkage has it."""
    (width, height), wanted = marks(film, looks)
    for number, picture, at in zip(looks.tolist(), shown, wanted, strict=True):
        if picture.shape != (height, width, 3):
            raise _off(f"its pictures are {picture.shape[1]} x {picture.shape[0]} pixels")
        seen = blob(picture)
        # Rows run downwards, and the middle of the first one is at half a pixel.
        away = math.hypot(seen[0] + 0.5 - at[0], height - seen[1] - 0.5 - at[1])
        if not away <= MAX_MARK_ERROR:
            raise _off(f"in picture {number + 1} the driver is {away:.3g} pixels off")


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
