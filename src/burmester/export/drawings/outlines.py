"""The body at every pose and the regions to keep out of, as the assembly's drawing has them.

Regions are hatched by lines of their own: patterns are not read by all programs.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, final

import numpy as np

from burmester.export.drawings.dimension_lines import LETTER_WIDTH
from burmester.export.reference import Reference
from burmester.geometry.inner_point import inner_point
from burmester.numerics.arrays import FloatArray
from burmester.tasks.motion_task import Task

HATCH_SPACING: Final = 1.6  # of the text's height: between the lines of a hatch, at least
MOST_LINES: Final = 60  # of a hatch, about; over a large region they are farther apart


@final
@dataclass(frozen=True, slots=True, eq=False)
class Outlines:
    """Outlines in millimetres: body: (N, n, 2), at the place for each pose, n = 0 without one.

    regions: their names, which may be empty, and their corners (k, 2).
    """

    body: FloatArray
    regions: tuple[tuple[str, FloatArray], ...]

    @classmethod
    def of(cls, task: Task, reference: Reference) -> Outlines:
        """Those of a task, at the places of its linkage."""
        corners = np.empty((0, 2)) if task.body is None else task.body.vertices * reference.scale
        around = () if task.surroundings is None else task.surroundings.keep_out
        regions = ((each.name or "", each.polygon.vertices * reference.scale) for each in around)
        return cls(reference.places[:, None].act(corners), tuple(regions))

    def corners(self) -> FloatArray:
        """All corners (k, 2)."""
        return np.concatenate([self.body.reshape(-1, 2), *(each for _, each in self.regions)])

    def names(self, letters: float) -> FloatArray:
        """Where names begin and end (k, 2), in letters of that height."""
        ends = []
        for name, corners in self.regions:
            start = name_start(name, corners, letters)
            across = np.array([LETTER_WIDTH * len(name) * letters, letters])
            ends += [start, start + across]
        return np.reshape(ends, (-1, 2))


def name_start(name: str, corners: FloatArray, letters: float) -> FloatArray:
    """Where a region's name begins (2,), so that its middle is inside the region."""
    half = np.array([LETTER_WIDTH * len(name) * letters, letters]) / 2
    return np.asarray(inner_point(corners) - half)


def hatch(corners: FloatArray, letters: float) -> FloatArray:
    """The lines (m, 2, 2) of a hatch at 45 degrees inside a polygon (k, 2), convex or not."""
    across = np.array([-1.0, 1.0]) / np.sqrt(2)
    along = np.array([1.0, 1.0]) / np.sqrt(2)
    height, place = corners @ across, corners @ along
    low, high = float(height.min()), float(height.max())
    spacing = max(HATCH_SPACING * letters, (high - low) / MOST_LINES)
    lines = []
    for level in np.arange(low + spacing / 2, high, spacing).tolist():
        # Where the level crosses the edges; between an odd crossing and the next it is inside.
        after, beyond = np.roll(height, -1), np.roll(place, -1)
        crossed = (height > level) != (after > level)
        share = (level - height[crossed]) / (after[crossed] - height[crossed])
        at = np.sort(place[crossed] + share * (beyond[crossed] - place[crossed])).reshape(-1, 2)
        lines += [level * across + ends[:, None] * along for ends in at]
    return np.array(lines).reshape(-1, 2, 2)
