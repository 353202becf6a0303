"""A task that leaves its dyads open, in the frames in which errors are computed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final, Self, final

import numpy as np
from numpy.typing import NDArray

from burmester.dyads.timed_dyads import timed_dyads
from burmester.families.pivot_freedom import PivotFreedom
from burmester.families.rail_freedom import RailFreedom
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.fourbar.dyad import RR
from burmester.fourbar.foot_points import places_of, rows_of
from burmester.fourbar.linkage_batch import DIMENSIONS, DYAD_KINDS, LinkageBatch, row_of
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.refinement.target import Target
from burmester.requirements.footprint import FOOTPRINT
from burmester.requirements.requirement import Bounds
from burmester.requirements.transmission import TRANSMISSION
from burmester.requirements.types import TYPES
from burmester.tasks.crank_timing import CrankTiming
from burmester.tasks.limits import Limits
from burmester.tasks.motion_task import Task
from burmester.tasks.option_table import Preference
from burmester.tasks.problem import SynthesisProblem, driving_side
from burmester.tasks.surroundings import KeepOut, Surroundings
from burmester.verdicts.assumptions import Assumptions
from burmester.verdicts.quality import enough_transmission


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


ANYWHERE: Final = 1e3  # times the box in which pivots are assumed to lie
RADIUS_FREEDOM = 9.0  # squared; how much rather a link's length changes than its pivots move
FREE_ANGLE: Final = math.pi / 6  # radians; how far from its nominal value a free angle is sought
FREE_LENGTH: Final = 0.5  # motion sizes; the same for a free coordinate


@final
@dataclass(frozen=True, slots=True, eq=False)
class DyadFreedom:
    """What one dyad may be: where its pivots lie, how long its link is, and of which kinds it is.

    length: the least and the greatest; kinds: indices in DYAD_KINDS; rail: of the line of a slider.
    timing: of a driver that the crank times; given: the RR dyads (k, 5), where they are known.
    """

    fixed: PivotFreedom
    moving: PivotFreedom
    length: tuple[float, float]
    kinds: tuple[int, ...]
    rail: RailFreedom | None = None
    timing: CrankTiming | None = None
    given: FloatArray | None = None

    def metric(self) -> FloatArray:
        """How freely the dimensions of each kind of dyad change: projectors (3, 5, 5)."""
        out = np.zeros((len(DYAD_KINDS), DIMENSIONS, DIMENSIONS))
        out[:, :4, :4] = np.eye(4)
        for kind in (0, 2):
            out[kind, :2, :2] = self.fixed.projector
        for kind in (0, 1):
            out[kind, 2:4, 2:4] = self.moving.projector
        out[0, 4, 4] = RADIUS_FREEDOM
        return out


@final
@dataclass(frozen=True, slots=True, eq=False)
class Trials:
    """Linkages (k,) that are tried.

    offsets: (k, N, 3), how far they leave the poses, along the axes of the tolerances.
    driver: (k,), the side that drives.
    """

    batch: LinkageBatch
    offsets: FloatArray
    driver: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.batch)


@final
@dataclass(frozen=True, slots=True, eq=False)
class OpenTask:
    """Poses (N,) in error frames, and what the dyads on both sides may be.

    half_widths: (N, 3), the tolerances of x, y and length x angle; zero where a pose is exact.
    axes: (N, 3, 3), their directions, as columns.
    conditions: what linkages must be.
    """

    poses: Displacement
    length: float
    frames: CanonicalFrames
    sides: tuple[DyadFreedom, DyadFreedom]
    half_widths: FloatArray
    axes: FloatArray
    conditions: Conditions

    @classmethod
    def of(cls, problem: SynthesisProblem, target: Target, assumed: Assumptions) -> Self:
        """The poses and limits of a problem, in the frames of its target."""
        task, frames, unit = problem.task, target.frames, float(target.frames.length)
        sides = []
        for limits in task.limits or (Limits(),):
            pivots = (
                PivotFreedom.of(limits.fixed_pivot, assumed.fixed, frames.fixed_origin, unit),
                PivotFreedom.of(limits.moving_pivot, assumed.moving, frames.moving_origin, unit),
            )
            kinds = tuple(k for k, kind in enumerate(DYAD_KINDS) if kind.__name__ in limits.allowed)
            least, most = limits.length
            rail = RailFreedom.of(limits, frames)
            sides.append(DyadFreedom(*pivots, (least / unit, most / unit), kinds, rail))
        if (timing := task.timing) is not None:
            side = driving_side(task)
            sides[side] = _timed(sides[side], target, timing)
        both = sides[0], sides[-1]
        pins = all(0 in side.kinds for side in both)
        return cls(
            target.poses,
            target.length,
            frames,
            both,
            *_tolerances(task, target, assumed.size / unit),
            Conditions.of(problem, target, assumed, pins=pins),
        )

    @property
    def is_exact(self) -> bool:
        """Whether every pose is to be met exactly."""
        return not self.half_widths.any()

    @property
    def is_symmetric(self) -> bool:
        """Whether both dyads may be the same."""
        return self.sides[0] is self.sides[1]

    def rows(self, offsets: FloatArray) -> FloatArray:
        """The places (k, N, 3) at offsets (k, N, 3) from the poses, as rows."""
        moved = np.einsum("nij,knj->kni", self.axes, offsets)
        return np.asarray(rows_of(self.poses, self.length) + moved)

    def places(self, offsets: FloatArray) -> Displacement:
        """The same as places (k, N)."""
        return places_of(self.rows(offsets), self.length)


def _timed(side: DyadFreedom, target: Target, timing: CrankTiming) -> DyadFreedom:
    """What a driver may be that the crank times; where few are left, wherever they are."""
    found = timed_dyads(target.poses, timing)
    if found is None:
        return replace(side, timing=timing)
    z = np.array([row_of(each) for each in found])
    fixed, moving = (
        replace(place, around=_wide(place.around), region=_wide(place.around))
        if place.region is place.around
        else place
        for place in (side.fixed, side.moving)
    )
    given = z.reshape(-1, DIMENSIONS)
    return replace(side, fixed=fixed, moving=moving, timing=timing, given=given)


def _wide(box: Polygon) -> Polygon:
    """A box that is wider, by a factor."""
    middle = box.vertices.mean(axis=0)
    return Polygon(middle + ANYWHERE * (box.vertices - middle))


def _tolerances(task: Task, target: Target, size: float) -> tuple[FloatArray, FloatArray]:
    """Half widths (N, 3) of the tolerances of a task, and directions (N, 3, 3) of their axes."""
    count = target.poses.shape[0]
    axes = np.broadcast_to(np.eye(3), (count, 3, 3)).copy()
    if (given := task.tolerances) is None:
        return np.zeros((count, 3)), axes
    unit = float(target.frames.length)
    half = given.bounds * [1 / unit, 1 / unit, target.length]
    free = [FREE_LENGTH * size, FREE_LENGTH * size, FREE_ANGLE * target.length]
    axes[:, :2, :2] = given.directions(task.poses).swapaxes(-1, -2)
    return np.where(np.isinf(half), free, half), axes
