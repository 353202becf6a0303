"""Where a spring is in the way of nothing: of regions, of pins, and of a body in its plane.

A spring lies in a layer of its own beside the links, so that it may cross them.  It may not cross a
region that is to be kept free, nor a pin, which may go through its layer.  Where the body lies in
the plane of the links, it lies in that of the spring too: the spring then may lie over the body
only where it is attached, as links may.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.clearance.moving_parts import lugs, shortened
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon, feet
from burmester.geometry.shapes import distances
from burmester.loads.loaded_motion import LoadedMotion
from burmester.numerics.arrays import FloatArray
from burmester.tasks.motion_task import Task
from burmester.tasks.surroundings import Surroundings

PIN: Final = 0.4  # of the links' width: diameter of a pin, as in plates that are exported


@final
@dataclass(frozen=True, slots=True, eq=False)
class SpringClearance:
    """What a spring must stay clear of at places (n,) of the body; lengths in the task's unit.

    pins: (p, n, 2), in F.  body: its outline in M, where it is in the plane of the spring.
    """

    places: Displacement
    pins: FloatArray
    body: Polygon | None
    around: Surroundings

    @classmethod
    def of(cls, loaded: LoadedMotion, task: Task) -> Self:
        """That of a linkage of a task."""
        unit = 1 / loaded.of.metre
        around, places = task.surroundings or Surroundings(), loaded.places.scaled(unit)
        pins = [
            places[joint.holder].act(joint.holes[joint.holder] * unit)
            for joint in loaded.bodies.joints
        ]
        body = task.body if around.body_in_plane else None
        return cls(places[loaded.bodies.body], np.stack(pins), body, around)

    def at(self, every: int) -> SpringClearance:
        """It at one of so many places."""
        return replace(self, places=self.places[::every], pins=self.pins[:, ::every])

    def keeps(self, ends: FloatArray, diameter: float) -> NDArray[np.bool_]:
        """Whether springs with ends (m, 4), in F and in M, are clear of all, (m,)."""
        tips = self.places[:, None].act(ends[:, 2:])
        lines = np.stack([np.broadcast_to(ends[:, :2], tips.shape), tips], axis=-2)
        free = diameter / 2 + self.around.margin
        kept = np.arange(len(ends))
        for pin in self.pins:
            near = feet(pin[:, None], lines[:, kept, 0], lines[:, kept, 1])
            apart = np.linalg.norm(near - pin[:, None], axis=-1).min(axis=0)
            kept = kept[apart >= free + PIN * self.around.link_width / 2]
        for each in self.around.keep_out:
            kept = kept[~_near(each.polygon.vertices, lines[:, kept], free)]
        if self.body is not None:
            own = replace(self.around, link_width=diameter)
            lug = lugs(ends[kept, 2:], self.body, own)
            drawn = self.places[:, None].act(self.body.vertices)
            kept = kept[~_near(drawn, shortened(lines[:, kept], lug), free)]
        out = np.zeros(len(ends), dtype=bool)
        out[kept] = True
        return out


def _near(shapes: FloatArray, lines: FloatArray, apart: float) -> NDArray[np.bool_]:
    """Whether lines (n, m, 2, 2) are nearer than that to shapes (n, k, 2) or (k, 2), (m,)."""
    out = np.zeros(lines.shape[1], dtype=bool)
    every = np.broadcast_to(shapes, (len(lines), *shapes.shape[-2:]))
    for shape, there in zip(every, lines, strict=True):
        left = np.flatnonzero(~out)
        out[left] = distances(there[left], shape, apart) <= max(apart, 0.0)
    return out
