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
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from burmester import plot
from burmester.export.films.film import Film, Picture, blob, looks_of, require_film
from burmester.export.films.pictures import marks, pictures
from burmester.export.options import Options
from burmester.export.reference import fault
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
