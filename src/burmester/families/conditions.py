"""What linkages must be, in the frames in which errors are computed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Self, final

from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage_batch import DYAD_KINDS
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.refinement.target import Target
from burmester.requirements.footprint import FOOTPRINT
from burmester.requirements.requirement import Bounds
from burmester.requirements.transmission import TRANSMISSION
from burmester.requirements.types import TYPES
from burmester.tasks.options import Preference
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.surroundings import KeepOut, Surroundings
from burmester.verdicts.assumptions import Assumptions
from burmester.verdicts.quality import enough_transmission

__all__ = ["Conditions"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class Conditions:
    """What linkages of an open task must be; lengths in its frames.

    asked: what the task asks of them, and what is assumed.
    span: of the motion, by which the extent is measured.
    prefer: by which figure the recommended linkage is chosen.
    kinds: the pairs of kinds of dyads that are allowed; drivers: the sides that may drive.
    around: what body, its outline, and links must stay clear of.
    """

    asked: Bounds
    span: float
    kinds: frozenset[frozenset[type]]
    drivers: tuple[int, ...]
    any_order: bool
    prefer: Preference
    around: Surroundings | None = None
    body: Polygon | None = None

    @property
    def transmission(self) -> float:
        """The least transmission angle over the range, radians."""
        return math.radians(self.asked[TRANSMISSION])

    @property
    def enough(self) -> float:
        """The transmission angle beyond which more counts for nothing, radians."""
        return enough_transmission(self.transmission)

    @classmethod
    def of(
        cls, problem: SynthesisProblem, target: Target, assumed: Assumptions, *, pins: bool
    ) -> Self:
        """What a problem asks, and what is assumed; pins: whether both dyads may have two pins."""
        task, frames, unit = problem.task, target.frames, float(target.frames.length)
        asked = task.requirements
        bounds = {
            each: bound / unit if each.scaled else bound for each, bound in assumed.asked.items()
        }
        if asked.footprint is not None:
            bounds[FOOTPRINT] = _in_frame(asked.footprint, frames.fixed_origin, unit)
        classes = {kind.__name__: kind for kind in DYAD_KINDS}
        pairs = (pair for name, pair in TYPES.items() if asked.allows(name))
        kinds = frozenset(frozenset(classes[kind] for kind in pair) for pair in pairs)
        if pins and asked.types is None:
            kinds = frozenset(pair for pair in kinds if RR in pair)  # two sliders only if asked for
        return cls(
            asked=bounds,
            span=assumed.size / unit,
            kinds=kinds,
            drivers={"first": (0,), "second": (1,)}.get(asked.driver, (0, 1)),
            any_order=asked.any_order,
            prefer=problem.options.prefer,
            around=None if task.surroundings is None else _moved_around(task.surroundings, target),
            body=None if task.body is None else _in_frame(task.body, frames.moving_origin, unit),
        )


def _moved_around(around: Surroundings, target: Target) -> Surroundings:
    """The surroundings in the frames of an open task."""
    frames, unit = target.frames, float(target.frames.length)
    regions = (
        KeepOut(_in_frame(each.polygon, frames.fixed_origin, unit), each.name)
        for each in around.keep_out
    )
    width, margin = around.link_width / unit, around.margin / unit
    return Surroundings(tuple(regions), width, margin, around.body_in_plane)


def _in_frame(polygon: Polygon, origin: FloatArray, unit: float) -> Polygon:
    return Polygon((polygon.vertices - origin) / unit)
