"""A film of a linkage, before it is drawn: what each picture shows, and how it is found again.

E162 a film that cannot be drawn, or not in the memory there is
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.options import Options
from burmester.numerics.arrays import FloatArray
from burmester.plot.style import with_unit
from burmester.scene.linkage_scene import Scene, scene_of
from burmester.synthesis.result import Candidate
from burmester.tasks.motion_task import Task
from burmester.verdicts.motion import Motion

Picture = NDArray[np.uint8]


MARK_COLOUR: Final = "#F0E442"  # of the followed pivot; nothing else comes near this colour
MARK_POINTS: Final = 9.0  # size of the mark, in points
COLOUR_DISTANCE: Final = 70  # of 3 x 255: largest deviation from the mark's colour
DPI: Final = 100.0
CHECKED_PICTURES: Final = 8  # pictures that are read back
HOLD_SHARE: Final = 0.08  # of a film that goes back and forth: pause at each end
SECONDS: Final = (0.1, 600.0)  # least and greatest duration
RATES: Final = (1.0, 240.0)  # pictures a second, least and most
WIDTHS: Final = (100, 4096)  # pixels; on less there is no room for the axes
MAX_PICTURES: Final = 20_000  # about twenty minutes of drawing
PIXEL_BYTES: Final = 5.0  # memory of a pixel of a picture that is kept to the end: colours, index
TALLEST: Final = 1.15  # height of a picture, in shares of its width
MAX_BYTES: Final = 7e8  # memory for pictures that are kept


def require_film(options: Options, rate: float, *, kept: bool) -> int:
    """The number of pictures at a rate, if they can be drawn; else raises E162.

    kept: whether all of them are in memory at once.
    """
    for cure, value, (least, most), noun in (
        (Cure("seconds"), options.seconds, SECONDS, "a duration of {:g} s"),
        (
            Cure("frames_per_second", option="--fps"),
            options.frames_per_second,
            RATES,
            "{:g} pictures a second",
        ),
        (Cure("width_px", option="--pixels"), options.width_px, WIDTHS, "a width of {:g} pixels"),
    ):
        if not least <= value <= most:
            raise InputError(
                "E162",
                f"{noun.format(value)} cannot be drawn",
                why=f"it is at least {least:g} and at most {most:g}",
                help=Help.of("give {}", replace(cure, value=most if value > most else least)),
            )
    count = max(2, round(options.seconds * rate))
    if count > MAX_PICTURES:
        raise InputError(
            "E162",
            f"{count} pictures are too many",
            why=f"they would take hours to draw; {MAX_PICTURES} are the most",
            help=Help.of(
                "give {}, or fewer pictures a second",
                Cure("seconds", float(f"{MAX_PICTURES / rate:.3g}")),
            ),
        )
    size = count * PIXEL_BYTES * TALLEST * options.width_px**2
    if kept and size > MAX_BYTES:
        width = int(options.width_px * math.sqrt(MAX_BYTES / size))
        raise InputError(
            "E162",
            f"{count} pictures of {options.width_px} pixels are too many for a GIF",
            why=f"they would need {size / 1e9:.2g} GB, and {MAX_BYTES / 1e9:g} GB are allowed",
            help=Help.of(
                "give {}, or fewer {}; or write an MP4",
                Cure("width_px", max(width, WIDTHS[0]), "--pixels"),
                Cure("seconds"),
            ),
        )
    return count


def there_and_back(count: int) -> FloatArray:
    """The share of the motion (count,) in each picture: there and back, with pauses."""
    share = np.arange(count) / count
    there = np.clip((1 - np.abs(2 * share - 1)) * (1 + 2 * HOLD_SHARE) - HOLD_SHARE, 0.0, 1.0)
    return np.asarray((1 - np.cos(np.pi * there)) / 2)


def looks_of(count: int) -> NDArray[np.intp]:
    """The numbers of the pictures that are looked at again, spread over a film."""
    return np.unique(np.linspace(0, count - 1, CHECKED_PICTURES).astype(np.intp))


@dataclass(frozen=True)
class Film:
    """A film that is to be drawn: what moves, picture by picture, and the size of the pictures.

    chosen: the linkage, its driver its first dyad; of one that turns fully all turns are shown
    until all is as it was.  width: of a picture, in pixels; count: of pictures.
    """

    chosen: Candidate
    width: int
    count: int

    @cached_property
    def motion(self) -> Motion:
        """The place of the body in each picture."""
        whole = Motion.of(self.chosen, 2).turns_fully
        return Motion.of(self.chosen, self._shares(whole), whole)

    def _shares(self, whole: bool) -> FloatArray:
        return np.arange(self.count) / self.count if whole else there_and_back(self.count)

    @property
    def task(self) -> Task:
        """The task of what moves."""
        return self.chosen.task

    def followed(self, number: NDArray[np.intp]) -> FloatArray:
        """The driver's moving pivot (n, 2) in F, which is marked, in pictures.

        The body's origin where the driver has none.
        """
        return np.array([self.scene(int(each)).driven for each in number])

    def scene(self, number: int) -> Scene:
        """What is drawn of the linkage in a picture."""
        drive = float(self.motion.drive[number])
        return scene_of(self.chosen, self.motion.places[number], drive, self.motion.places)

    def drive_text(self, number: int) -> str:
        """Where the driver is in a picture."""
        value = float(self.motion.drive[number])
        if not self.motion.in_turns:
            return with_unit(f"driver {value:.4g}".replace("-", "−"), self.chosen.unit)
        degrees = math.degrees(value)
        return f"driver {degrees % 360 if self.motion.full_turn else degrees:5.1f}°"

    @property
    def grown(self) -> NDArray[np.intp]:
        """How many pictures' points (count,) the path has."""
        whole = self.motion.full_turn
        return np.minimum(
            np.arange(1, self.count + 1),
            self.count if whole else int(self._shares(whole).argmax()) + 1,
        )


def blob(picture: Picture) -> tuple[float, float]:
    """The middle (column, row) of what has the colour of the followed pivot; nan if nothing."""
    colour = [int(MARK_COLOUR[at : at + 2], 16) for at in (1, 3, 5)]
    near = np.abs(picture.astype(np.int16) - colour).sum(axis=-1) < COLOUR_DISTANCE
    # Beside lines a film may have pixels of any colour, but no patch of it.
    solid = near[1:-1, 1:-1].copy()
    for part in (near[:-2, 1:-1], near[2:, 1:-1], near[1:-1, :-2], near[1:-1, 2:]):
        solid &= part
    if not solid.any():
        return math.nan, math.nan
    row, column = (np.median(each) + 1 for each in np.nonzero(solid))
    rows, columns = np.nonzero(near)
    spot = np.hypot(rows - row, columns - column) < MARK_POINTS * DPI / 72
    return float(columns[spot].mean()), float(rows[spot].mean())
